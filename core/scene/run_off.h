// Where the rain runs that falls on a scene: over its surface to lower surfels, and down from where it drips.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/scene/scene_substrates.h"
#include "core/scene/surfel_graph.h"
#include "core/scene/surfels.h"
#include "core/scene/triangle_tree.h"

namespace sporeprint {

/// The ways of water over a scene. Where none leads on, water stays; from overhangs it falls.
struct RunOff {
    struct Way {
        std::uint32_t to = 0;
        float share = 0.0F;  ///< of the water that a surfel passes on
        bool operator==(const Way&) const = default;
    };
    std::vector<std::uint32_t> order;  ///< surfels, each before those that its water runs to
    std::vector<std::uint32_t>
        first;  ///< of the ways of each surfel, by number; one more at the end
    std::vector<Way> ways;
    /// Share of the water that runs over a surfel which it passes on; where no way leads on, that leaves the scene.
    std::vector<float> passing;
    std::vector<float>
        water;  ///< what stays at a surfel, as a multiple of the rain on open level ground

    /// Returns the memory that it takes.
    [[nodiscard]] std::size_t bytes() const;
    bool operator==(const RunOff&) const = default;
};

/// Returns where the rain on a scene runs. A share of it runs off, which grows with the slope and is greater on rock and
/// bark than on soil, to lower neighbours by their slopes; on its way it sinks in, on soil within decimetres, on rock
/// within metres. What runs over an edge or hangs below an overhang falls onto what is below.
///
/// rain    rain_on() the surfels
/// source  shares of neighbours: [Quinn1991]; run-off coefficients of roofs, lawns and woods as in hydraulic practice
/// cost    0.1 s for 100,000 surfels
[[nodiscard]] RunOff run_off_of(const Surfels& surfels, const SurfelGraph& graph,
                                const TriangleTree& tree, const SurfelSubstrates& substrates,
                                std::span<const float> rain);

/// Lets water carry a share of what lies on surfels.
///
/// strength  the share, 0..1
/// amounts   changed: what lies there in the end
/// returns   what leaves the scene: with the amounts it adds up to what there was before
double wash_down(const RunOff& run_off, double strength, std::vector<double>& amounts);

}  // namespace sporeprint
