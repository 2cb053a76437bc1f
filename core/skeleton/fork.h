// The quads' corners where limbs meet: shared by cleaning, which must know how far a fork reaches, and the scaffold.
// Private to core/skeleton.
#pragma once

#include <array>
#include <glm/vec3.hpp>

namespace sporeprint {

/// Control points of a fork of three limbs about the origin, in radii of its node: two poles that are equally far from all three
/// limbs, and a crotch between each two.
/// Each limb owns the lune between its crotches: the poles are where the cells of the three meet on a sphere.
struct Fork {
    std::array<std::size_t, 3> order{};  ///< limbs, counter-clockwise about the pole
    glm::dvec3 pole{0.0};                ///< unit
    std::array<glm::dvec3, 3> crotch{};  ///< k lies between order[k] and order[k + 1]
    double cone = 0.0;                   ///< how far the limbs lean towards the pole, a sine
};

/// From the factor by which tubes of controls are wider than their skin (see tube_factor) and the unit directions of the limbs.
[[nodiscard]] Fork fork_of(const std::array<glm::dvec3, 3>& limbs, double factor);

/// How far along a limb its corners at the fork reach, in radii of the node, at least 0.
[[nodiscard]] double reach_of(const Fork& fork, const glm::dvec3& limb, std::size_t place,
                              double factor);

/// The same for a node of two limbs, whose ring lies in the plane between them.
[[nodiscard]] double bend_reach(const glm::dvec3& first, const glm::dvec3& second, double factor);

/// Controls stand this many times farther from the axis than the skin that they make after `levels` subdivisions: a ring of four
/// shrinks. By area of the section.
[[nodiscard]] constexpr double tube_factor(int levels) {
    constexpr std::array<double, 4> factors = {1.2533141, 1.4472025, 1.5030434, 1.5174764};
    return factors[static_cast<std::size_t>(levels)];
}

/// Reaches are judged for the finest skin, so that all levels of detail have the same forks.
inline constexpr int judged_levels = 3;

}  // namespace sporeprint
