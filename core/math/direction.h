// Unit vectors that turn: what skeletons of trees and corals carry from limb to limb.
#pragma once

#include <glm/vec3.hpp>

namespace sporeprint {

/// A direction carried along as the heading turns from one unit vector to another, without twist. Headings that are all but opposite leave
/// it as it is.
[[nodiscard]] glm::dvec3 carried(const glm::dvec3& v, const glm::dvec3& from, const glm::dvec3& to);

/// `v`, which is square to the unit vector `axis`, turned about it.
///
/// angle  radians, right-handed
[[nodiscard]] glm::dvec3 turned_square(const glm::dvec3& v, const glm::dvec3& axis, double angle);

/// The unit vector nearest to `v` that is square to the unit vector `axis`; some such vector where v lies along it.
[[nodiscard]] glm::dvec3 square_to(const glm::dvec3& v, const glm::dvec3& axis);

}  // namespace sporeprint
