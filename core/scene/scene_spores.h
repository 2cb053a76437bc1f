// How the spores of a species reach the surfels of a scene: on the wind, down the surface with the rain, and from
// bodies that already grow on it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/scene/scene_habitat.h"
#include "core/world/mycelia.h"
#include "core/world/spread.h"
#include "core/world/wind.h"

namespace sporeprint {

/// Packets of spores that are followed for each species: those that the wind brings, and those that leave surfels.
inline constexpr std::size_t arriving_packets = 6'000, leaving_packets = 4'000;

/// Returns how many spores the wind brings to each square metre of the surfels of a scene, compared with what would fall
/// on level ground of its size in the open. Packets enter upwind and above, by the rose; each drifts with the wind of its height and sinks and
/// is tossed until it meets a triangle or leaves.
///
/// stream  of the species
/// source  turbulence as in [Katul2005]: the deviation of the vertical wind is a quarter of the wind, over lengths of
///         0.4 of the height
/// cost    0.3 s
[[nodiscard]] std::vector<double> arriving_spores(const SceneHabitat& habitat, const WindRose& rose,
                                                  const SporeHabit& spores, std::uint32_t stream);

/// The way of a packet of spores from one surfel to another.
struct SporePath {
    std::uint32_t from = 0, to = 0;
    bool operator==(const SporePath&) const = default;
};

/// Returns where packets of spores land that leave the surfels on which a species may live, as many from each square
/// metre. Those that leave the scene are not among them.
///
/// suits  of each surfel: 0 where the species cannot live
[[nodiscard]] std::vector<SporePath> spore_paths(const SceneHabitat& habitat, const WindRose& rose,
                                                 const SporeHabit& spores, std::uint32_t stream,
                                                 const std::vector<float>& suits);

/// How far a species has spread over a scene: for each moment and surfel 255 where it is as common as it can be.
struct SceneEstablishment {
    std::array<std::vector<std::uint8_t>, spread_moments> shares;

    /// Returns the share at a surfel, 0..1, linear between moments; that of year 0 before it.
    [[nodiscard]] double at(std::size_t surfel, double year) const;
    /// Returns the memory that it takes.
    [[nodiscard]] std::size_t bytes() const;
    bool operator==(const SceneEstablishment&) const = default;
};

/// Computes the spread of a species over a scene. It begins 40 years before year 0; from then on the wind brings spores
/// from outside, and from where the species has established itself they fall beside its bodies, drift on and are
/// washed down.
///
/// cost  1 s for 100,000 surfels
[[nodiscard]] SceneEstablishment scene_spread(const SceneHabitat& habitat,
                                              const FungusSpecies& species);

}  // namespace sporeprint
