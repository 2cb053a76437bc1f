// The shadow of a scene on the ground, a level plane.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "core/images.h"
#include "core/render/lighting.h"

namespace sporeprint::render {

/// The shadow of a scene on a level plane, as darkness 0..1 on a grid around it.
class GroundShadow {
  public:
    /// Lights and their shadows; those that come from below do not count.
    struct Falling {
        const std::vector<Light>& lights;
        const std::vector<ShadowMap>& shadows;

        /// Returns the light that reaches a point of the ground.
        ///
        /// is_sharp  shadows have edges, which are interpolated
        [[nodiscard]] float light_at(const glm::vec3& at, bool is_sharp) const;
    };

    /// No ground: there is no shadow.
    GroundShadow() = default;

    /// Finds the shadows of lamps, whose edges are seen, and of the sky, which has none.
    ///
    /// box    of the scene
    /// level  height of the ground
    GroundShadow(const Bounds& box, float level, const Falling& lamps, const Falling& sky,
                 const Parallel& parallel);

    /// Returns the height of the ground.
    [[nodiscard]] float level() const { return level_; }

    /// Returns true if there is no ground.
    [[nodiscard]] bool empty() const { return darkness_.empty(); }

    /// Returns the darkness at a point of the ground, 0 far from the scene.
    [[nodiscard]] float at(const glm::vec3& point) const;

  private:
    static constexpr int side = 72;
    float level_ = 0.0F;
    glm::vec2 from_{0.0F}, step_{1.0F};
    std::vector<float> darkness_;
};

}  // namespace sporeprint::render
