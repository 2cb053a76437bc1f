// The light of a picture: many distant lights, those of a studio among them, and the shadows that a scene casts in it.
#pragma once

#include <cstddef>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "core/images.h"
#include "core/render/camera.h"
#include "core/render/draw_list.h"
#include "core/render/triangle_raster.h"

namespace sporeprint::render {

/// A distant light. A large lamp or a part of the sky is several of them.
struct Light {
    glm::vec3 direction{0.0F, 1.0F, 0.0F};  ///< unit vector to the light
    /// Light reflected by a white matt surface that faces it.
    glm::vec3 strength{0.0F};
};

/// The lights of a picture.
struct PictureLights {
    std::vector<Light> lamps;         ///< whose shadows have edges: lamps of a studio, or the sun
    std::vector<Light> surroundings;  ///< the sky and the ground
};

/// Adds the lights of a lamp that is seen as a disc.
///
/// direction  to it, of any length
/// radius     half the angle under which it is seen, radians
/// parts      number of its lights
/// strength   of all of them
void add_lamp(std::vector<Light>& lights, const glm::dvec3& direction, double radius, int parts,
              const glm::vec3& strength);

/// Adds the upper (sign 1) or the lower half (sign -1) of the surroundings, in equal solid angles.
///
/// light  from a direction, unit vector
void add_half(std::vector<Light>& lights, int parts, double sign,
              const std::function<glm::vec3(const glm::vec3& direction)>& light);

/// Returns the lights of a studio: a soft lamp before the scene and a weak one behind it, which turn with the camera.
/// Seen from below, the scene stands above a pale reflector in place of the dark ground.
///
/// detail  1 for all of them, 2 for about half as many, and so on
[[nodiscard]] PictureLights studio_lights(const CameraAxes& axes, int detail);

/// Returns the light that a smooth surface reflects from the surroundings, without the lamps.
///
/// direction  unit vector
[[nodiscard]] glm::vec3 surroundings(const glm::vec3& direction);

/// Returns what a surface of a roughness shows of them as a mirror: the border between ground and
/// sky is as wide as its highlights.
///
/// direction  of the mirrored ray, unit
[[nodiscard]] glm::vec3 mirrored_surroundings(const glm::vec3& direction, float roughness);

/// The part of a large scene whose shadows are seen from near.
struct ShadowFocus {
    Bounds box;
    int side = 0;  ///< of the maps of it, texels, at most largest_focus_side
    /// Whether leaves and blades (GlbRole::foliage) cast shadows in it; in the map of the whole scene they are too small.
    bool has_foliage = true;
};
inline constexpr int largest_focus_side = largest_raster_side / 2;

/// The depths at which a scene stops the light of one direction.
class ShadowMap {
  public:
    ShadowMap() = default;

    /// side   of the map of the whole scene, texels
    /// focus  has a map of its own
    /// cost   O(triangles + side^2)
    ShadowMap(const DrawList& list, const glm::vec3& direction, int side,
              const std::optional<ShadowFocus>& focus = {});

    /// Returns how much of the light reaches a point, 0..1, interpolated between the nearest depths: four, or sixteen in
    /// a scene with a focus.
    ///
    /// normal  of the surface at the point; zero for a point on no surface of the scene
    [[nodiscard]] float light_at(const glm::vec3& point, const glm::vec3& normal) const;

    /// Returns true if the light reaches a point, by the nearest depth.
    [[nodiscard]] bool reaches(const glm::vec3& point, const glm::vec3& normal) const;

  private:
    /// An image of depths.
    struct Level {
        float left = 0.0F, top = 0.0F, scale = 1.0F;  ///< of the image in the scene
        int side = 0;
        std::vector<float>
            depth;  ///< distance towards the light, of the lowest surface that stops it

        [[nodiscard]] float depth_at(int x, int y) const;
    };
    /// A point in an image: texels from the centre of the first one, and its depth.
    struct Place {
        float x = 0.0F, y = 0.0F, depth = 0.0F;
    };

    [[nodiscard]] Level level_round(const Bounds& box, int side) const;
    void draw_whole(const DrawList& list, Level& level, bool has_foliage) const;
    void draw_focus(const DrawList& list, Level& level, bool has_foliage) const;

    /// Returns the place of a point, moved off its surface and towards the light by three quarters
    /// of a texel.
    [[nodiscard]] Place place_of(const Level& level, const glm::vec3& point,
                                 const glm::vec3& normal) const;
    /// Returns the finest image that has a point, and its place in it; null if it is in none.
    [[nodiscard]] const Level* level_of(const glm::vec3& point, const glm::vec3& normal,
                                        Place& place) const;

    glm::vec3 right_{0.0F}, up_{0.0F}, direction_{0.0F};
    std::vector<Level> levels_;  ///< the finest first
    /// Texels by which light_at() looks beyond the four round a point. Few lights stand for the sun, so that each of them
    /// has soft shadows; those of a studio are many.
    int beyond_ = 0;
};

/// Returns the shadow maps of lights. Each is a task of its own.
///
/// side, focus  as for each map
[[nodiscard]] std::vector<ShadowMap> shadow_maps(const DrawList& list,
                                                 std::span<const Light> lights, int side,
                                                 const Parallel& parallel,
                                                 const std::optional<ShadowFocus>& focus = {});

/// The light of the surroundings at a vertex.
struct Ambient {
    glm::vec3 arriving{0.0F};  ///< that reaches it
    glm::vec3 stopped{0.0F};   ///< that the scene stops on its way
    /// That reaches its other side, and that is stopped on its way there; of translucent materials.
    glm::vec3 behind{0.0F}, stopped_behind{0.0F};
};

/// Returns the light of the surroundings at the vertices of each draw that are used; at others it is none.
///
/// shadows  of the lights
/// used     for each draw whether each of its vertices is, or nothing for a draw of which none is
/// cost     O(used vertices * lights)
[[nodiscard]] std::vector<std::vector<Ambient>> ambient_light(
    const DrawList& list, std::span<const Light> lights, std::span<const ShadowMap> shadows,
    std::span<const std::vector<bool>> used, const Parallel& parallel);

}  // namespace sporeprint::render
