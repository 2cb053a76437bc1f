// The light that a point of a surface sends to the camera.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>

#include "core/render/draw_list.h"
#include "core/render/lighting.h"

namespace sporeprint::render {

/// A point of a surface and its material there; colours are linear.
struct SurfacePoint {
    glm::vec3 at{0.0F};
    glm::vec3 smooth_normal{0.0F, 1.0F, 0.0F};  ///< of the mesh, on the side of the camera
    glm::vec3 normal{0.0F, 1.0F, 0.0F};         ///< with the normal map
    glm::vec3 to_camera{0.0F, 1.0F, 0.0F};
    glm::vec3 base_color{0.8F};
    float occlusion = 1.0F, roughness = 0.9F;
    Ambient ambient;            ///< at smooth_normal
    float transmission = 0.0F;  ///< share of the matt light that passes through from behind
    bool scatters = false;      ///< light enters the flesh, which blurs what is fine in its relief
    glm::vec3 tint{1.0F};       ///< of that light
};

class Sky;

/// Lamps with their shadows. With several groups, each lamp is in one of them.
struct Lamps {
    std::span<const Light> lights;
    std::span<const ShadowMap> shadows;
    std::size_t groups = 1;
    const Sky* sky = nullptr;  ///< what mirrors show outdoors; null in a studio
};

/// Returns the light, linear, that a point sends to the camera: that of the surroundings, and that
/// of one group of lamps times the number of groups, so that the mean over all groups is the light
/// of all.
///
/// source  [Walter2007] for the highlights (GGX)
[[nodiscard]] glm::vec3 reflected(const SurfacePoint& point, const MaterialLook& look,
                                  const Lamps& lamps, std::size_t group);

/// Returns the colour of the display for light, both linear, 0..1 for any light: nearly unchanged
/// below 0.76, compressed above and less saturated near white.
///
/// source  Khronos PBR Neutral tone mapping
[[nodiscard]] glm::vec3 tone_mapped(glm::vec3 light);

}  // namespace sporeprint::render
