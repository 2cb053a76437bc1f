#include "core/render/render.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "core/math/elementary.h"
#include "core/math/srgb_table.h"
#include "core/problems.h"
#include "core/render/camera.h"
#include "core/render/clipping.h"
#include "core/render/close_up.h"
#include "core/render/cutout.h"
#include "core/render/daylight.h"
#include "core/render/draw_list.h"
#include "core/render/ground_shadow.h"
#include "core/render/lighting.h"
#include "core/render/shading.h"
#include "core/render/visibility.h"
#include "core/surface/codecs.h"

namespace sporeprint {

namespace render {
namespace {

/// Samples of a pixel in each direction.
constexpr int samples = 2;

/// Returns true for a picture that does not resolve the edges of the shadows of single lights.
bool is_small(const PictureParams& params) { return params.width * params.height <= 320 * 320; }

/// Returns the side of the shadow maps of lamps, texels. A close-up shows a part of each map.
int lamp_side(const PictureParams& params) {
    const int side = is_small(params) ? 160 : 256;
    return is_close_up(params.view) ? 4 * side : side;
}

/// Returns the side of the shadow maps of the surroundings, texels.
int surroundings_side(const PictureParams& params) {
    const int side = is_small(params) ? 80 : 128;
    return is_close_up(params.view) ? 3 * side : side;
}

/// Sides of the shadow maps outdoors, texels: of the sun and of the sky, of what is near and of the whole scene.
constexpr int near_sun_side = 1024, sun_side = 768, near_sky_side = 256, sky_side = 160;

/// How few of the lights outdoors are drawn: every second one.
constexpr int outdoors_detail = 2;

/// Rows of pixels that are shaded by one task, and bands in which triangles are found.
constexpr int band = 16, visible_bands = 4;

/// What is in front at each sample, and the vertices of all draws.
struct SeenScene : Visibility {
    std::vector<std::vector<glm::vec3>> seen;  ///< vertices of each draw in the axes of the camera

    SeenScene(int columns, int rows, std::size_t draws) : Visibility(columns, rows), seen(draws) {}
};

/// Returns vertices in the axes of a camera as corners in an image of samples.
std::vector<SnappedCorner> corners_of(const std::vector<glm::vec3>& seen, const Camera& camera,
                                      int columns, int rows) {
    const float middle_x = 0.5F * static_cast<float>(columns),
                middle_y = 0.5F * static_cast<float>(rows);
    const float scale_x = middle_x / camera.tangent_x, scale_y = middle_y / camera.tangent_y;
    std::vector<SnappedCorner> corners(seen.size());
    for (std::size_t i = 0; i < corners.size(); ++i) {
        // The camera is outside of what is in the image; what is nearer is in no triangle.
        const float nearness = 1.0F / std::max(seen[i].z, 1e-9F);
        corners[i] = snapped({middle_x + seen[i].x * nearness * scale_x,
                              middle_y - seen[i].y * nearness * scale_y, nearness});
    }
    return corners;
}

/// The triangles of a draw in an image of samples.
struct ImageTriangles {
    std::vector<SnappedCorner> corners;
    std::span<const std::uint32_t> indices;
    ClippedTriangles parts;  ///< of a camera that sees a part of the scene

    ImageTriangles() = default;
    ImageTriangles(const std::vector<glm::vec3>& seen, std::span<const std::uint32_t> whole,
                   const Camera& camera, int columns, int rows)
        : indices(whole) {
        const std::vector<glm::vec3>* places = &seen;
        if (camera.nearest > 0.0F) {
            parts = clipped(seen, whole, camera);
            places = &parts.corners;
            indices = parts.indices;
        }
        corners = corners_of(*places, camera, columns, rows);
    }
};

/// Returns where the samples of a camera look.
SampleRays rays_of(const Camera& camera, int columns, int rows) {
    const glm::vec2 step(2.0F * camera.tangent_x / static_cast<float>(columns),
                         -2.0F * camera.tangent_y / static_cast<float>(rows));
    return {glm::vec2(-camera.tangent_x, camera.tangent_y) + 0.5F * step, step};
}

/// Returns which parts of the triangles of a draw are drawn; nothing if all of each are.
///
/// seen  its vertices in the axes of the camera
Cutouts cutouts_of(const DrawList& list, std::size_t of, const std::vector<glm::vec3>& seen,
                   const SampleRays& rays) {
    const Draw& draw = list.draws[of];
    const DrawMaterial& material = list.materials[draw.material];
    if (material.alpha.empty()) return {};
    return [&, rays](std::uint32_t first) {
        const std::vector<std::uint32_t>& indices = draw.mesh->indices;
        return Cutout(*draw.mesh, material, first,
                      {seen[indices[first]], seen[indices[first + 1]], seen[indices[first + 2]]},
                      rays);
    };
}

SeenScene visible(const DrawList& list, const Camera& camera, int columns, int rows,
                  const Parallel& parallel) {
    SeenScene found(columns, rows, list.draws.size());
    std::vector<ImageTriangles> images(list.draws.size());
    std::vector<std::function<void()>> tasks;
    for (std::size_t d = 0; d < images.size(); ++d)
        tasks.emplace_back([&, d] {
            const Draw& draw = list.draws[d];
            found.seen[d].reserve(draw.mesh->positions.size());
            for (const glm::vec3& at : draw.mesh->positions)
                found.seen[d].push_back(camera.seen(draw.placement.point(at)));
            images[d] = ImageTriangles(found.seen[d], draw.mesh->indices, camera, columns, rows);
        });
    parallel(tasks);
    tasks.clear();
    const SampleRays rays = rays_of(camera, columns, rows);
    for (int part = 0; part < visible_bands; ++part)
        tasks.emplace_back(
            [&, from = rows * part / visible_bands, to = rows * (part + 1) / visible_bands] {
                for (std::size_t d = 0; d < images.size(); ++d)
                    found.show(d, images[d].indices, images[d].corners, from, to,
                               images[d].parts.of, cutouts_of(list, d, found.seen[d], rays));
            });
    parallel(tasks);
    return found;
}

/// A triangle ready to be sampled: its corners in the axes of the camera and their attributes.
class Facet {
  public:
    Facet(const DrawList& list, const SeenScene& visibility, std::size_t sample)
        : draw_index_(visibility.draw[sample]),
          draw_(&list.draws[draw_index_]),
          material_(&list.materials[draw_->material]) {
        const std::vector<glm::vec3>& seen = visibility.seen[draw_index_];
        for (std::size_t i = 0; i < 3; ++i) {
            index_[i] = draw_->mesh->indices[visibility.corner[sample] + i];
            corners_[i] = seen[index_[i]];
        }
        normal_ = glm::cross(corners_[1] - corners_[0], corners_[2] - corners_[0]);
    }

    [[nodiscard]] const MaterialLook& look() const { return material_->look; }

    /// Returns the index of its draw in the draw list.
    [[nodiscard]] std::size_t draw_index() const { return draw_index_; }

    /// Returns true if a facet of the same draw goes on with the surface of this one without a fold
    /// or a step: their normals are within 25 degrees, and where a ray meets the other, its
    /// distance from the plane of this one, along the ray, is at most a share of that from the
    /// camera.
    [[nodiscard]] bool continues_with(const Facet& other, const glm::vec3& ray, float nearness,
                                      float share) const {
        if (draw_ != other.draw_) return false;
        const float both = glm::dot(normal_, other.normal_);
        if (both <= 0.0F || both * both < 0.82F * glm::dot(normal_, normal_) *
                                              glm::dot(other.normal_, other.normal_))
            return false;
        const float facing = glm::dot(normal_, ray);
        return std::abs(glm::dot(corners_[0], normal_) * nearness - facing) <=
               share * std::abs(facing);
    }

    /// Returns the weights of the corners where a ray of the camera meets the triangle.
    [[nodiscard]] glm::vec3 weights(const glm::vec3& ray) const {
        const glm::vec3 w(glm::dot(ray, glm::cross(corners_[1], corners_[2])),
                          glm::dot(ray, glm::cross(corners_[2], corners_[0])),
                          glm::dot(ray, glm::cross(corners_[0], corners_[1])));
        const float sum = w.x + w.y + w.z;
        // A sample beside a triangle that is seen edge-on takes its nearest point.
        if (std::abs(sum) < 1e-30F) return glm::vec3(1.0F / 3.0F);
        const glm::vec3 inside = glm::clamp(w / sum, glm::vec3(0.0F), glm::vec3(1.0F));
        return inside / (inside.x + inside.y + inside.z);
    }

    [[nodiscard]] glm::vec3 point(const glm::vec3& w) const {
        return draw_->placement.point(mixed(draw_->mesh->positions, w));
    }

    /// ambient  at the vertices
    /// scale    pixels of a tangent of 1 in each direction
    [[nodiscard]] SurfacePoint surface(const glm::vec3& w, const glm::vec3& to_camera,
                                       const std::vector<Ambient>& ambient,
                                       const glm::vec2& scale) const {
        const Mesh& mesh = *draw_->mesh;
        SurfacePoint found;
        found.at = point(w);
        found.to_camera = to_camera;
        for (std::size_t i = 0; i < 3; ++i) {
            const auto corner = static_cast<glm::vec3::length_type>(i);
            found.ambient.arriving += ambient[index_[i]].arriving * w[corner];
            found.ambient.stopped += ambient[index_[i]].stopped * w[corner];
            found.ambient.behind += ambient[index_[i]].behind * w[corner];
            found.ambient.stopped_behind += ambient[index_[i]].stopped_behind * w[corner];
        }
        const glm::vec3 own = mixed(mesh.normals, w);
        glm::vec3 normal = normalised(draw_->placement.of_normals * own, to_camera);
        found.smooth_normal = normal;
        found.transmission = material_->transmission;
        found.scatters = material_->transmission > 0.0F;
        found.tint = material_->tint;
        if (!material_->base_color.empty() && !mesh.texture_coordinates.empty()) {
            const glm::vec2 uv = mixed(mesh.texture_coordinates, w);
            const float texels = texels_of_pixel(scale);
            found.base_color = material_->base_color.at(uv, texels);
            const glm::vec3 orm = material_->orm.at(uv, texels);
            found.occlusion = orm.x;
            found.roughness = orm.y;
            if (!material_->thinness.empty())
                found.transmission *= material_->thinness.at(uv, 1.0F).x;
            const glm::vec3 bump = material_->normal.at(uv, texels) * 2.0F - glm::vec3(1.0F);
            const glm::vec4 tangent = mixed(mesh.tangents, w);
            const glm::vec3 along = normalised(draw_->placement.linear * glm::vec3(tangent),
                                               glm::vec3(1.0F, 0.0F, 0.0F));
            const glm::vec3 across = glm::cross(normal, along) * (tangent.w < 0.0F ? -1.0F : 1.0F);
            normal = normalised(along * bump.x + across * bump.y + normal * bump.z, normal);
        }
        found.base_color *= draw_->tint;
        if (!mesh.tints.empty()) found.base_color *= mixed(mesh.tints, w);
        found.normal = normal;
        return found;
    }

  private:
    std::size_t draw_index_;
    const Draw* draw_;
    const DrawMaterial* material_;
    std::array<std::uint32_t, 3> index_{};
    std::array<glm::vec3, 3> corners_{};  ///< in the axes of the camera
    glm::vec3 normal_{0.0F};              ///< of any length, in the axes of the camera

    /// Returns the texels between two pixels.
    [[nodiscard]] float texels_of_pixel(const glm::vec2& scale) const {
        // A corner may be behind the camera of a close-up.
        const float near = 0.1F * std::max({corners_[0].z, corners_[1].z, corners_[2].z});
        const auto seen = [&](std::size_t i) {
            return glm::vec2(corners_[i]) * scale * (1.0F / std::max(corners_[i].z, near));
        };
        const auto image = [&](std::size_t i) {
            return draw_->mesh->texture_coordinates[index_[i]];
        };
        return texels_between_samples({image(0), image(1), image(2)}, {seen(0), seen(1), seen(2)},
                                      material_->base_color.side());
    }

    template <class T>
    T mixed(const std::vector<T>& of, const glm::vec3& w) const {
        return of[index_[0]] * w.x + of[index_[1]] * w.y + of[index_[2]] * w.z;
    }

    static glm::vec3 normalised(const glm::vec3& v, const glm::vec3& otherwise) {
        const float square = glm::dot(v, v);
        return square > 1e-20F ? v * (1.0F / std::sqrt(square)) : otherwise;
    }
};

/// Colour and coverage of a pixel or a sample; the colour is linear and multiplied by the coverage.
struct Pixel {
    glm::vec3 light{0.0F};
    float surface = 0.0F;  ///< share of samples on the product
    float shadow = 0.0F;   ///< sum of the darkness of samples on the ground
};

/// Draws one view of a scene.
class Drawing {
  public:
    /// Draws in a studio.
    ///
    /// ground  height of the plane that hides what is below it and shows the shadow, if there is one
    Drawing(const DrawList& list, const Camera& camera, const PictureParams& params,
            const std::optional<float>& ground, const Parallel& parallel)
        : Drawing(list, camera, params, nullptr,
                  studio_lights(camera.axes, detail_of_lights(params, list.triangles())),
                  {lamp_side(params), {}}, {surroundings_side(params), {}}, parallel) {
        if (ground)
            ground_ = GroundShadow(list.box, *ground, {lights_.lamps, lamp_shadows_},
                                   {lights_.surroundings, shadows_}, parallel);
    }

    /// Draws outdoors. The sky must outlive the drawing.
    Drawing(const DrawList& list, const Camera& camera, const PictureParams& params, const Sky& sky,
            const Outdoors& outdoors, const Parallel& parallel)
        : Drawing(list, camera, params, &sky, sky.lights(outdoors_detail),
                  {sun_side, ShadowFocus{outdoors.near, near_sun_side}},
                  {sky_side, ShadowFocus{outdoors.near, near_sky_side, false}}, parallel) {}

    static int detail_of_lights(const PictureParams& params, std::uint64_t triangles) {
        return triangles > 1'000'000 ? 4 : triangles > 250'000 || is_small(params) ? 2 : 1;
    }

    /// Draws into an image at a place.
    void draw(RgbaImage& image, int left, int top, const SrgbTable& srgb,
              const Parallel& parallel) const {
        each_pixel(parallel, [&](int x, int y) {
            const auto row =
                static_cast<std::size_t>(top + y) * static_cast<std::size_t>(image.width);
            write(pixel(x, y), srgb, &image.rgba[(row + static_cast<std::size_t>(left + x)) * 4]);
        });
    }

    /// Draws into a whole image, with the exposure that its light needs.
    ///
    /// shows_sky  behind the scene
    void expose(RgbaImage& image, bool shows_sky, const SrgbTable& srgb,
                const Parallel& parallel) const {
        const auto index = [&](int x, int y) {
            return static_cast<std::size_t>(y) * static_cast<std::size_t>(params_.width) +
                   static_cast<std::size_t>(x);
        };
        std::vector<Pixel> pixels(index(0, params_.height));
        each_pixel(parallel, [&](int x, int y) { pixels[index(x, y)] = pixel(x, y); });
        const float exposure = exposure_of(pixels);
        each_pixel(parallel, [&](int x, int y) {
            Pixel& own = pixels[index(x, y)];
            if (shows_sky) {
                const glm::vec3 behind = sky_->at(direction_of(x, y));
                own.light += behind * std::max(1.0F - own.surface, 0.0F);
                own.surface = 1.0F;
            }
            own.light = softened(own.light * exposure);
            write(own, srgb, &image.rgba[index(x, y) * 4]);
        });
    }

  private:
    /// The shadow maps of a kind of lights.
    struct MapSides {
        int whole = 0;
        std::optional<ShadowFocus> focus;
    };

    Drawing(const DrawList& list, const Camera& camera, const PictureParams& params, const Sky* sky,
            PictureLights lights, const MapSides& of_lamps, const MapSides& of_surroundings,
            const Parallel& parallel)
        : list_(list),
          camera_(camera),
          params_(params),
          sky_(sky),
          lights_(std::move(lights)),
          lamp_shadows_(shadow_maps(list, lights_.lamps, of_lamps.whole, parallel, of_lamps.focus)),
          shadows_(shadow_maps(list, lights_.surroundings, of_surroundings.whole, parallel,
                               of_surroundings.focus)),
          visible_(
              visible(list, camera, params.width * samples, params.height * samples, parallel)),
          ambient_(ambient_light(list, lights_.surroundings, shadows_, seen_vertices(), parallel)),
          scale_(glm::vec2(params.width, params.height) * 0.5F /
                 glm::vec2(camera.tangent_x, camera.tangent_y)) {}

    /// Calls a function for each pixel, by rows.
    template <class Call>
    void each_pixel(const Parallel& parallel, const Call& call) const {
        std::vector<std::function<void()>> tasks;
        for (int first = 0; first < params_.height; first += band)
            tasks.emplace_back([&, first] {
                const int last = std::min(first + band, params_.height);
                for (int y = first; y < last; ++y)
                    for (int x = 0; x < params_.width; ++x) call(x, y);
            });
        parallel(tasks);
    }

    /// Returns the factor that makes the geometric mean of the light of surfaces that of a photograph.
    [[nodiscard]] static float exposure_of(const std::vector<Pixel>& pixels) {
        constexpr double wanted = 0.17, least = 0.3, most = 8.0, darkest = 1e-3;
        double sum = 0.0, weight = 0.0;
        for (const Pixel& pixel : pixels) {
            if (pixel.surface <= 0.0F) continue;
            const glm::dvec3 light(pixel.light / pixel.surface);
            const double luminance = 0.2126 * light.x + 0.7152 * light.y + 0.0722 * light.z;
            sum += logarithm(std::max(luminance, darkest));
            weight += 1.0;
        }
        if (weight <= 0.0) return 1.0F;
        return static_cast<float>(std::clamp(wanted / exponential(sum / weight), least, most));
    }

    /// Returns light with less contrast: shade outdoors is darker than pictures can show, and eyes adapt to it.
    [[nodiscard]] static glm::vec3 softened(const glm::vec3& light) {
        constexpr double middle = 0.18, power = -0.2, darkest = 1e-3;
        const double luminance = 0.2126 * static_cast<double>(light.x) +
                                 0.7152 * static_cast<double>(light.y) +
                                 0.0722 * static_cast<double>(light.z);
        return light * static_cast<float>(
                           exponential(power * logarithm(std::max(luminance, darkest) / middle)));
    }

    /// Returns the direction through the middle of a pixel, a unit vector in the scene.
    [[nodiscard]] glm::vec3 direction_of(int x, int y) const {
        const glm::vec2 middle = (glm::vec2(x, y) + 0.5F) * static_cast<float>(samples);
        const glm::vec3 direction = camera_.in_scene(ray(middle));
        return direction * (1.0F / std::sqrt(glm::dot(direction, direction)));
    }

    const DrawList& list_;
    const Camera& camera_;
    const PictureParams& params_;
    const Sky* sky_;  ///< null in a studio
    PictureLights lights_;
    std::vector<ShadowMap> lamp_shadows_, shadows_;
    SeenScene visible_;
    std::vector<std::vector<Ambient>> ambient_;  ///< at the vertices of triangles that are seen
    glm::vec2 scale_;                            ///< pixels of a tangent of 1 to the right and up
    GroundShadow ground_;

    /// Returns for each draw which of its vertices are corners of triangles that are seen; nothing for a draw of which
    /// none is.
    [[nodiscard]] std::vector<std::vector<bool>> seen_vertices() const {
        std::vector<std::vector<bool>> used(list_.draws.size());
        for (std::size_t at = 0; at < visible_.nearness.size(); ++at) {
            if (!visible_.shows(at) || (at > 0 && visible_.same(at, at - 1))) continue;
            const Mesh& mesh = *list_.draws[visible_.draw[at]].mesh;
            std::vector<bool>& own = used[visible_.draw[at]];
            own.resize(mesh.positions.size(), false);
            for (std::size_t i = 0; i < 3; ++i) own[mesh.indices[visible_.corner[at] + i]] = true;
        }
        return used;
    }

    /// Returns the direction in the axes of the camera through a place, in samples from the upper
    /// left corner.
    [[nodiscard]] glm::vec3 ray(const glm::vec2& place) const {
        return camera_.ray({place.x / static_cast<float>(visible_.width),
                            place.y / static_cast<float>(visible_.height)});
    }

    /// Returns the darkness of the ground in a direction; 0 above the horizon.
    [[nodiscard]] float shadow(const glm::vec3& direction) const {
        if (ground_.empty() || direction.y >= 0.0F) return 0.0F;
        const float distance = (ground_.level() - camera_.position.y) / direction.y;
        return distance > 0.0F ? ground_.at(camera_.position + direction * distance) : 0.0F;
    }

    /// Returns the light of the point of a facet that a ray meets; nothing if it is below the
    /// ground.
    [[nodiscard]] std::optional<glm::vec3> light(const Facet& facet, const glm::vec3& ray,
                                                 const Lamps& lamps, std::size_t group) const {
        const glm::vec3 weights = facet.weights(ray);
        if (!ground_.empty() && facet.point(weights).y < ground_.level()) return std::nullopt;
        const glm::vec3 direction = camera_.in_scene(ray);
        const float length = std::sqrt(glm::dot(direction, direction));
        const SurfacePoint point = facet.surface(weights, direction * (-1.0F / length),
                                                 ambient_[facet.draw_index()], scale_);
        const glm::vec3 light = reflected(point, facet.look(), lamps, group);
        if (sky_ == nullptr) return light;
        return sky_->through_air(light, direction * (1.0F / length),
                                 glm::distance(point.at, camera_.position));
    }

    [[nodiscard]] Facet facet_at(std::size_t sample) const { return {list_, visible_, sample}; }

    /// Samples of a pixel that show one smooth surface: the middle of them stands for all.
    struct Patch {
        Facet facet;
        glm::vec2 sum{0.0F};  ///< of the places of its samples
        float samples = 0.0F;

        explicit Patch(const Facet& first) : facet(first) {}
    };

    [[nodiscard]] Pixel pixel(int x, int y) const {
        constexpr int all = samples * samples;
        std::array<std::size_t, all> at{};
        bool is_empty = true, is_one = true;
        for (int i = 0; i < all; ++i) {
            const auto k = static_cast<std::size_t>(i);
            at[k] = static_cast<std::size_t>((y * samples + i / samples) * visible_.width +
                                             x * samples + i % samples);
            const bool shows = visible_.shows(at[k]);
            is_empty = is_empty && !shows;
            is_one = is_one && shows && visible_.same(at[k], at[0]);
        }
        const glm::vec2 corner(static_cast<float>(x * samples), static_cast<float>(y * samples));
        const glm::vec3 middle = ray(corner + 0.5F * samples);
        if (is_empty) return {glm::vec3(0.0F), 0.0F, shadow(camera_.in_scene(middle))};
        Pixel sum;
        const auto add = [&](const Facet& facet, const glm::vec3& through, const Lamps& lamps,
                             std::size_t group, float weight) {
            if (const auto found = light(facet, through, lamps, group)) {
                sum.light += *found * weight;
                sum.surface += weight;
            } else {
                sum.shadow += shadow(camera_.in_scene(through)) * weight;
            }
        };
        if (is_one) {
            add(facet_at(at[0]), middle, {lights_.lamps, lamp_shadows_, 1, sky_}, 0, 1.0F);
            return sum;
        }

        std::array<std::optional<Patch>, all> patches;
        std::size_t count = 0;
        // How far apart two points in a pixel are, as a share of their distance.
        const float pixel = 2.0F * camera_.tangent_x / static_cast<float>(params_.width);
        constexpr float share = 1.0F / static_cast<float>(all);
        for (int i = 0; i < all; ++i) {
            const std::size_t sample = at[static_cast<std::size_t>(i)];
            const int across = i % samples, down = i / samples;
            const glm::vec2 place = corner + glm::vec2(static_cast<float>(across) + 0.5F,
                                                       static_cast<float>(down) + 0.5F);
            const float nearness = visible_.nearness[sample];
            if (!visible_.shows(sample)) {
                sum.shadow += shadow(camera_.in_scene(ray(place))) * share;
                continue;
            }
            const Facet facet = facet_at(sample);
            std::size_t of = 0;
            while (of < count &&
                   !patches[of]->facet.continues_with(facet, ray(place), nearness, pixel))
                ++of;
            if (of == count) patches[count++].emplace(facet);
            patches[of]->sum += place;
            patches[of]->samples += 1.0F;
        }
        // Patches share the lamps, so that a pixel at an edge costs little more than others.
        const Lamps lamps{lights_.lamps, lamp_shadows_, count, sky_};
        for (std::size_t i = 0; i < count; ++i) {
            const Patch& patch = *patches[i];
            add(patch.facet, ray(patch.sum * (1.0F / patch.samples)), lamps, i,
                patch.samples * share);
        }
        return sum;
    }

    void write(const Pixel& pixel, const SrgbTable& srgb, std::uint8_t* to) const {
        constexpr float darkest = 0.75F;
        const float shadow = pixel.shadow * darkest;
        glm::vec3 colour(0.0F);
        if (pixel.surface > 0.0F) colour = tone_mapped(pixel.light / pixel.surface);
        float alpha = pixel.surface + shadow;
        if (params_.background == Background::transparent) {
            // The shadow is black.
            if (alpha > 0.0F) colour *= pixel.surface / alpha;
        } else {
            const float behind = params_.background == Background::white  ? 1.0F
                                 : params_.background == Background::grey ? 0.21F
                                                                          : 0.0F;
            colour = colour * pixel.surface + glm::vec3(behind * std::max(1.0F - alpha, 0.0F));
            alpha = 1.0F;
        }
        for (int c = 0; c < 3; ++c) to[c] = srgb.of(colour[c]);
        to[3] = static_cast<std::uint8_t>(std::clamp(alpha, 0.0F, 1.0F) * 255.0F + 0.5F);
    }
};

/// Returns the camera of each view of a picture.
///
/// lowest  see fitted_cameras()
std::vector<Camera> cameras_of(const DrawList& list, const PictureParams& params, int frames,
                               float lowest) {
    const double aspect = static_cast<double>(params.width) / static_cast<double>(params.height);
    if (is_close_up(params.view)) return {camera_of(close_up_of(list, params), aspect)};
    std::vector<CameraAxes> axes;
    for (int frame = 0; frame < frames; ++frame) {
        const glm::dvec2 angles = angles_of(params, frame);
        axes.push_back(camera_axes(angles.x, angles.y));
    }
    return fitted_cameras(list, axes, aspect, lowest);
}

/// Returns the height to which the bark of a scene's wood reaches down, if it has wood, in the median
/// over its sides: what is torn out of its lower end farther down is in the ground.
std::optional<float> foot_of_wood(const DrawList& list) {
    constexpr std::size_t sides = 12;
    constexpr float of_bark = 0.9F;  // from which share of its greatest radius on it is bark
    std::optional<float> foot;
    for (const Draw& draw : list.draws) {
        if (draw.role != GlbRole::carrier || draw.mesh->positions.empty()) continue;
        glm::vec3 middle(0.0F);
        for (const glm::vec3& own : draw.mesh->positions) middle += draw.placement.point(own);
        middle *= 1.0F / static_cast<float>(draw.mesh->positions.size());
        std::array<float, sides> radius{}, lowest{};
        const auto each = [&](auto&& visit) {
            for (const glm::vec3& own : draw.mesh->positions) {
                const glm::vec3 at = draw.placement.point(own);
                const float x = at.x - middle.x, z = at.z - middle.z;
                const double turn =
                    arc_tangent(static_cast<double>(x), static_cast<double>(z)) / (2.0 * pi);
                visit(static_cast<std::size_t>((turn - std::floor(turn)) * sides) % sides,
                      std::sqrt(x * x + z * z), at.y);
            }
        };
        each([&](std::size_t side, float far, float) {
            radius[side] = std::max(radius[side], far);
        });
        lowest.fill(list.box.max.y);
        each([&](std::size_t side, float far, float y) {
            if (far >= of_bark * radius[side]) lowest[side] = std::min(lowest[side], y);
        });
        std::sort(lowest.begin(), lowest.end());
        foot = std::min(foot.value_or(lowest[sides / 2]), lowest[sides / 2]);
    }
    return foot;
}

/// Returns the height of the ground of a picture, if it has one.
std::optional<float> ground_of(const DrawList& list, const PictureParams& params) {
    if (params.view == View::below || params.view == View::underside) return std::nullopt;
    if (list.stands_on_ground) {
        // The greater part of it is above the ground: roots that reach far below are to be seen, a
        // clod of soil is not.
        constexpr float deepest_clod = 2.2F;  // in heights above the ground
        if (list.box.min.y <= -deepest_clod * list.box.max.y) return std::nullopt;
        return 0.0F;
    }
    return foot_of_wood(list);
}

void refuse_over_triangles(const DrawList& list) {
    if (list.triangles() > most_pictured_triangles)
        throw Impossible("/lod", std::to_string(list.triangles()) +
                                     " triangles would be drawn; at most " +
                                     std::to_string(most_pictured_triangles) + " are. Raise lod");
}

Camera standing_camera(const StandingCamera& standing, double aspect) {
    if (!(standing.angle_deg >= 1.0 && standing.angle_deg <= 150.0))
        throw InvalidInput("/angle_deg", "is 1..150 degrees");
    const glm::dvec3 way = standing.target - standing.eye;
    const double level = std::sqrt(way.x * way.x + way.z * way.z);
    // Cameras of pictures look from a direction, this one looks in one.
    const double azimuth = arc_tangent(-way.x, -way.z) * (180.0 / pi),
                 elevation = arc_tangent(-way.y, level) * (180.0 / pi);
    Camera camera = camera_with(camera_axes(azimuth, elevation), aspect);
    camera.position = glm::vec3(standing.eye);
    const SineCosine half = sine_cosine(radians(0.5 * standing.angle_deg));
    camera.tangent_x = static_cast<float>(half.sine / half.cosine);
    camera.tangent_y = camera.tangent_x / static_cast<float>(aspect);
    camera.nearest = 0.05F;
    return camera;
}

}  // namespace
}  // namespace render

std::size_t pictured_lights(const PictureParams& params, std::uint64_t triangles) {
    const render::PictureLights lights =
        render::studio_lights({}, render::Drawing::detail_of_lights(params, triangles));
    return lights.lamps.size() + lights.surroundings.size();
}

RgbaImage rendered(const GlbScene& scene, const PictureParams& params, const Parallel& parallel) {
    require_valid(params);
    // A close-up shows a part of each image, at its full size.
    const render::DrawList list =
        render::draw_list(scene, parallel,
                          render::is_close_up(params.view) ? largest_upload_side
                                                           : std::max(params.width, params.height));
    render::refuse_over_triangles(list);
    const bool is_sheet = params.view == View::turntable;
    const int columns = is_sheet ? turntable_columns : 1, rows = is_sheet ? turntable_rows : 1;
    RgbaImage image{params.width * columns, params.height * rows, {}};
    image.rgba.resize(static_cast<std::size_t>(image.width) *
                      static_cast<std::size_t>(image.height) * 4);
    const std::optional<float> ground = render::ground_of(list, params);
    const std::vector<render::Camera> cameras =
        render::cameras_of(list, params, columns * rows, ground.value_or(list.box.min.y));
    const SrgbTable& srgb = srgb_table();
    for (int frame = 0; frame < columns * rows; ++frame)
        render::Drawing(list, cameras[static_cast<std::size_t>(frame)], params, ground, parallel)
            .draw(image, frame % columns * params.width, frame / columns * params.height, srgb,
                  parallel);
    return image;
}

Bytes rendered_png(const GlbScene& scene, const PictureParams& params, const Parallel& parallel) {
    const RgbaImage image = rendered(scene, params, parallel);
    return png(image.rgba, image.width, image.height);
}

RgbaImage rendered_from(const StandingCamera& camera, const GlbScene& scene,
                        const PictureParams& params, const Outdoors& outdoors,
                        const Parallel& parallel) {
    require_valid(params);
    const render::Sky sky(outdoors.light);
    // What is near shows a part of each image, at its full size.
    render::DrawList list = render::draw_list(scene, parallel, largest_upload_side);
    render::refuse_over_triangles(list);
    for (render::Draw& draw : list.draws)
        if (const auto found = outdoors.casters.find(draw.mesh); found != outdoors.casters.end())
            draw.caster = found->second;
    const render::Camera from = render::standing_camera(
        camera, static_cast<double>(params.width) / static_cast<double>(params.height));
    RgbaImage image{params.width, params.height, {}};
    image.rgba.resize(static_cast<std::size_t>(image.width) *
                      static_cast<std::size_t>(image.height) * 4);
    render::Drawing(list, from, params, sky, outdoors, parallel)
        .expose(image, outdoors.shows_sky, srgb_table(), parallel);
    return image;
}

}  // namespace sporeprint
