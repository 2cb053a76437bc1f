// Control points of the quads where segments meet, shared by cleaning (which needs the reach of a
// fork) and the scaffold. Private to core/skeleton.
#pragma once

#include <array>
#include <glm/vec3.hpp>

namespace sporeprint {

/// Control points of a fork of three segments about the origin, in radii of its node: two poles
/// that are equally far from all three segments, and a crotch between each two. Each segment owns
/// the lune between its crotches: the poles are where the Voronoi cells of the three meet on a
/// sphere.
struct Fork {
    std::array<std::size_t, 3> order{};  ///< segments, counter-clockwise about the pole
    glm::dvec3 pole{0.0};                ///< unit
    std::array<glm::dvec3, 3> crotch{};  ///< k lies between order[k] and order[k + 1]
    double cone = 0.0;  ///< sine of the angle by which the segments lean towards the pole
};

/// Returns the fork of three unit directions; `factor` is the ratio of the control tube's radius to
/// that of the skin (see tube_factor).
[[nodiscard]] Fork fork_of(const std::array<glm::dvec3, 3>& directions, double factor);

/// Returns how far along a segment its corners at the fork reach, in radii of the node, at least 0.
[[nodiscard]] double reach_of(const Fork& fork, const glm::dvec3& direction, std::size_t place,
                              double factor);

/// Returns the same for a node of two segments, whose ring lies in the plane between them.
[[nodiscard]] double bend_reach(const glm::dvec3& first, const glm::dvec3& second, double factor);

/// Returns the ratio of the radius of a ring of four control points to that of the surface after
/// `levels` subdivisions, which shrink it. The ratio preserves the area of the section.
[[nodiscard]] constexpr double tube_factor(int levels) {
    constexpr std::array<double, 4> factors = {1.2533141, 1.4472025, 1.5030434, 1.5174764};
    return factors[static_cast<std::size_t>(levels)];
}

/// Reaches are computed for the finest skin, so that all levels of detail have the same forks.
inline constexpr int judged_levels = 3;

}  // namespace sporeprint
