// The shade and damp where trunks touch the ground, in images of a floor.
#pragma once

#include <glm/vec2.hpp>
#include <span>

#include "core/images.h"
#include "core/world/ground.h"

namespace sporeprint {

/// What touches the ground: a trunk that lies, or the foot of one that stands, whose ends are the same.
struct Contact {
    glm::dvec2 from{0.0}, to{0.0};  ///< metres to the east and north
    double radius = 0.1;            ///< of the trunk, metres
};

/// How far from the axis of a trunk the ground is shaded, in its radii.
inline constexpr double contact_reach = 2.0;

/// Darkens a floor beside trunks: its occlusion more than its colour. Texels at one place of the world are shaded alike
/// in all images whose texels are of one size.
///
/// box       of the images, whose first row is the northern one
/// contacts  those that reach into the box, in any order
void add_contact_shade(RawImages& images, const WorldBox& box, std::span<const Contact> contacts);

}  // namespace sporeprint
