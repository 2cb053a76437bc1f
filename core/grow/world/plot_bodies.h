// The fruit bodies on a plot: each is shown by the nearest of a few individuals.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/gltf/glb.h"
#include "core/grow/world/plot.h"
#include "core/grow/world/plot_places.h"
#include "core/individual/individual.h"

namespace sporeprint {

struct PlotBodies {
    /// An individual that stands for others of its species and of about its age.
    struct Shape {
        MushroomSpec spec;
        Individual individual;
        Mesh mesh;
        std::string name;
    };
    struct Placed {
        std::size_t shape = 0;
        std::uint64_t id = 0;
        std::size_t species = 0;
        double age = 0.6;
        GlbTransform place;
    };
    std::vector<Shape> shapes;   ///< at most most_plot_mushrooms
    std::vector<Placed> bodies;  ///< in the order of the content
};

/// Returns the bodies that stand on a plot.
///
/// most    number of triangles that they may have; fewer ones than at the level of detail of the options
/// throws  InvalidInput (path "/species") for an unknown species
[[nodiscard]] PlotBodies bodies_of(const PlotContent& content, const PlotOptions& options,
                                   const PlotFrame& frame, std::uint64_t most, const Atlas& atlas,
                                   const ExecutionContext& execution);

}  // namespace sporeprint
