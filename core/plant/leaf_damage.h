// Where insects have eaten a leaf: holes in its lamina and bites at its border.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "core/plant/lamina.h"
#include "core/plant/venation.h"

namespace sporeprint {

/// A place that is eaten: a disc with an uneven border, in the plane of the lamina.
struct EatenSpot {
    glm::dvec2 middle{0.0};
    double radius = 0.0;  ///< mean, in lengths of the lamina
    std::array<glm::dvec2, 3>
        waves{};  ///< of its border: cosine and sine parts of 2, 3 and 5 turns

    /// The border is nowhere farther from the middle, in radii.
    static constexpr double farthest = 1.45;

    /// Returns about how far a point is outside of the border; less than 0 inside.
    [[nodiscard]] double outside(const glm::dvec2& place) const;
};

/// The largest number of spots of a leaf, by what is eaten.
[[nodiscard]] int most_eaten_spots(double eaten);

/// Returns the spots of an individual leaf: about two in five are bites at the border. None
/// reaches the main vein of its lobe or the root, so that the lamina stays in one piece.
///
/// eaten  share of the lamina, 0..0.3
[[nodiscard]] std::vector<EatenSpot> eaten_spots(const Lamina& lamina, double eaten,
                                                 std::uint32_t seed);

/// Cuts spots out of the mesh of a lamina, which is divided more finely about them first. Vertices of
/// the new borders are on the rim; what is cut off from the root falls.
///
/// fineness  length of edges at a spot, in its radius
void cut_out(LaminaMesh& lamina, const std::vector<EatenSpot>& spots, double fineness);

}  // namespace sporeprint
