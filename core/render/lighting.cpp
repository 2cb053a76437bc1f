#include "core/render/lighting.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "core/math/direction.h"
#include "core/math/elementary.h"
#include "core/render/cutout.h"
#include "core/render/triangle_raster.h"

namespace sporeprint::render {

namespace {

// Strengths were chosen by eye: a white matt ball is just below white where it faces the lamp, and
// about a sixth of that in its shadow.
constexpr glm::vec3 lamp_strength(0.95F, 0.92F, 0.86F);
constexpr glm::vec3 back_lamp_strength(0.34F, 0.36F, 0.40F);
constexpr glm::vec3 zenith(0.46F, 0.50F, 0.56F), horizon(0.40F, 0.40F, 0.40F),
    ground(0.24F, 0.22F, 0.19F);

/// Light of a pale reflector that lies below the scene in place of the ground when it is seen from below,
/// as photographers light gills and pores; the camera's rise, as a sine, from which on it is there.
constexpr glm::vec3 reflector(0.50F, 0.49F, 0.47F);
constexpr double reflector_rise = 0.3;

/// Lights of the lamp, of the lamp behind, of the sky and of the ground.
constexpr int lamp_parts = 12, back_lamp_parts = 2, sky_parts = 20, ground_parts = 8;

/// Half the angle under which the lamps are seen, radians.
constexpr double lamp_radius = 0.19, back_lamp_radius = 0.2;

/// Returns a point of a spiral in a disc of radius 1: its radius and angle.
glm::dvec2 in_disc(int i, int count) {
    const double radius = std::sqrt((i + 0.5) / count);
    const auto [sine, cosine] = sine_cosine(golden_angle * i);
    return {radius * cosine, radius * sine};
}

SnappedCorner snapped(const glm::vec3& at) { return render::snapped(Corner{at.x, at.y, at.z}); }

/// Draws a triangle that stops light: where a depth is greater than that in the map, and its material leaves no hole.
/// Few triangles have such a place, so where the holes are is found at the first one.
///
/// a, b, c  its corners in the map: texels and depths
/// depth    returns the depth of a texel, or null beside the map
template <class Depth>
void stop_light(const Mesh& mesh, const DrawMaterial& material, std::size_t first_corner,
                const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, int side, int first,
                const Depth& depth_at) {
    std::optional<Cutout> cutout;
    const auto shows = [&](int x, int y) {
        if (material.alpha.empty()) return true;
        if (!cutout) {
            const auto seen = [](const glm::vec3& at) { return glm::vec3(at.x, at.y, 1.0F); };
            cutout.emplace(mesh, material, first_corner, std::array{seen(a), seen(b), seen(c)},
                           SampleRays{});
        }
        return cutout->shows(x, y);
    };
    // Meshes are closed, so what stops light on one side leaves the mesh on the other. Depths
    // are those of the far side, which is dark by itself: the near side cannot shade itself.
    rasterize(
        snapped(a), snapped(c), snapped(b), side, side,
        [&](int x, int y, float depth) {
            float* const nearest = depth_at(x, y);
            if (nearest != nullptr && depth > *nearest && shows(x, y)) *nearest = depth;
        },
        first);
}

}  // namespace

void add_lamp(std::vector<Light>& lights, const glm::dvec3& direction, double radius, int parts,
              const glm::vec3& strength) {
    const glm::dvec3 to_lamp = unit_or(direction, {0.0, 1.0, 0.0});
    const glm::dvec3 side = square_to(to_lamp, {0.0, 1.0, 0.01});
    const glm::dvec3 other = glm::cross(to_lamp, side);
    for (int i = 0; i < parts; ++i) {
        const glm::dvec2 at = in_disc(i, parts) * radius;
        const glm::dvec3 part = unit_or(to_lamp + side * at.x + other * at.y, to_lamp);
        lights.push_back({glm::vec3(part), strength * (1.0F / static_cast<float>(parts))});
    }
}

void add_half(std::vector<Light>& lights, int parts, double sign,
              const std::function<glm::vec3(const glm::vec3& direction)>& light) {
    for (int i = 0; i < parts; ++i) {
        const double height = (i + 0.5) / parts;
        const double level = std::sqrt(1.0 - height * height);
        const auto [sine, cosine] = sine_cosine(golden_angle * i + 0.4);
        const glm::vec3 direction(glm::dvec3(level * cosine, sign * height, level * sine));
        // A half of even light 1 illuminates a surface that faces it by 1: the mean of the cosine
        // is 1/2.
        lights.push_back({direction, light(direction) * (2.0F / static_cast<float>(parts))});
    }
}

glm::vec3 surroundings(const glm::vec3& direction) {
    if (direction.y <= 0.0F) return ground;
    return horizon + (zenith - horizon) * direction.y;
}

glm::vec3 mirrored_surroundings(const glm::vec3& direction, float roughness) {
    const auto width = static_cast<double>(std::max(roughness, 0.15F));
    const auto sky =
        static_cast<float>(smooth_step(-width, width, static_cast<double>(direction.y)));
    const glm::vec3 above = horizon + (zenith - horizon) * std::max(direction.y, 0.0F);
    return ground + (above - ground) * sky;
}

PictureLights studio_lights(const CameraAxes& axes, int detail) {
    const auto share = [&](int parts) { return std::max(parts / detail, 2); };
    const glm::dvec3 right(axes.right), up(axes.up), forward(axes.forward);
    PictureLights lights;
    add_lamp(lights.lamps, -0.62 * right + 0.72 * up - 0.66 * forward, lamp_radius,
             share(lamp_parts), lamp_strength);
    add_lamp(lights.lamps, 0.75 * right + 0.45 * up + 0.75 * forward, back_lamp_radius,
             share(back_lamp_parts), back_lamp_strength);
    const auto from_below =
        static_cast<float>(smooth_step(0.0, reflector_rise, static_cast<double>(axes.forward.y)));
    const glm::vec3 lower = ground + (reflector - ground) * from_below;
    add_half(lights.surroundings, share(sky_parts), 1.0, surroundings);
    add_half(lights.surroundings, share(ground_parts), -1.0,
             [&](const glm::vec3&) { return lower; });
    return lights;
}

ShadowMap::ShadowMap(const DrawList& list, const glm::vec3& direction, int side,
                     const std::optional<ShadowFocus>& focus)
    : direction_(direction) {
    right_ = glm::vec3(square_to(glm::dvec3(direction), {1.0, 0.01, 0.0}));
    up_ = glm::cross(direction, right_);
    if (focus) {
        beyond_ = 1;
        levels_.push_back(level_round(focus->box, focus->side));
        draw_focus(list, levels_.back(), focus->has_foliage);
    }
    levels_.push_back(level_round(list.box, side));
    draw_whole(list, levels_.back(), !focus);
}

ShadowMap::Level ShadowMap::level_round(const Bounds& box, int side) const {
    Level level;
    level.side = side;
    level.depth.assign(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), -1e30F);
    float right = -1e30F, bottom = -1e30F;
    level.left = level.top = 1e30F;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 at((corner & 1) != 0 ? box.max.x : box.min.x,
                           (corner & 2) != 0 ? box.max.y : box.min.y,
                           (corner & 4) != 0 ? box.max.z : box.min.z);
        const float x = glm::dot(at, right_), y = -glm::dot(at, up_);
        level.left = std::min(level.left, x);
        right = std::max(right, x);
        level.top = std::min(level.top, y);
        bottom = std::max(bottom, y);
    }
    const float extent = std::max({right - level.left, bottom - level.top, 1e-6F});
    level.scale = static_cast<float>(side - 2) / extent;
    return level;
}

void ShadowMap::draw_whole(const DrawList& list, Level& level, bool has_foliage) const {
    const int side = level.side;
    std::vector<glm::vec3> places;
    // From the scene to texels and depths; its columns are images of the axes.
    const glm::mat3 to_image =
        glm::transpose(glm::mat3(right_ * level.scale, up_ * -level.scale, direction_));
    const glm::vec3 origin(1.0F - level.left * level.scale, 1.0F - level.top * level.scale, 0.0F);
    for (const Draw& draw : list.draws) {
        if (!has_foliage && draw.role == GlbRole::foliage) continue;
        const glm::mat3 linear = to_image * draw.placement.linear;
        const glm::vec3 moved = to_image * draw.placement.translation + origin;
        const Mesh& mesh = *draw.caster;
        places.resize(mesh.positions.size());
        for (std::size_t i = 0; i < places.size(); ++i)
            places[i] = linear * mesh.positions[i] + moved;
        const std::vector<std::uint32_t>& indices = mesh.indices;
        for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
            stop_light(mesh, list.materials[draw.material], i, places[indices[i]],
                       places[indices[i + 1]], places[indices[i + 2]], side, 0, [&](int x, int y) {
                           return &level.depth[static_cast<std::size_t>(y * side + x)];
                       });
    }
}

void ShadowMap::draw_focus(const DrawList& list, Level& level, bool has_foliage) const {
    // The image lies in the middle of one that is twice as wide, so that triangles at its border keep their shape; what
    // reaches beyond that is too large to be a leaf or a branch, and too far away to be seen.
    const int side = level.side, margin = side / 2;
    const auto wide = static_cast<float>(2 * side);
    const glm::mat3 to_image =
        glm::transpose(glm::mat3(right_ * level.scale, up_ * -level.scale, direction_));
    const glm::vec3 origin(1.0F - level.left * level.scale + static_cast<float>(margin),
                           1.0F - level.top * level.scale + static_cast<float>(margin), 0.0F);
    const auto misses = [&](const glm::vec3& low, const glm::vec3& high) {
        const auto first = static_cast<float>(margin), last = static_cast<float>(margin + side);
        return high.x < first || high.y < first || low.x > last || low.y > last;
    };
    std::vector<glm::vec3> places;
    for (const Draw& draw : list.draws) {
        if (!has_foliage && draw.role == GlbRole::foliage) continue;
        const glm::mat3 linear = to_image * draw.placement.linear;
        const glm::vec3 moved = to_image * draw.placement.translation + origin;
        // Its box is beside the image more often than not.
        const glm::vec3 middle = linear * (0.5F * (draw.box.min + draw.box.max)) + moved,
                        half = 0.5F * (draw.box.max - draw.box.min);
        const glm::vec3 reach = glm::abs(linear[0]) * half.x + glm::abs(linear[1]) * half.y +
                                glm::abs(linear[2]) * half.z + 1.0F;
        if (misses(middle - reach, middle + reach)) continue;
        places.resize(draw.mesh->positions.size());
        glm::vec3 low(1e30F), high(-1e30F);
        for (std::size_t i = 0; i < places.size(); ++i) {
            places[i] = linear * draw.mesh->positions[i] + moved;
            low = glm::min(low, places[i]);
            high = glm::max(high, places[i]);
        }
        if (misses(low, high)) continue;
        const std::vector<std::uint32_t>& indices = draw.mesh->indices;
        for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
            const glm::vec3 &a = places[indices[i]], &b = places[indices[i + 1]],
                            &c = places[indices[i + 2]];
            const glm::vec3 least = glm::min(a, glm::min(b, c)), most = glm::max(a, glm::max(b, c));
            if (misses(least, most) || least.x < 0.0F || least.y < 0.0F || most.x > wide ||
                most.y > wide)
                continue;
            stop_light(
                *draw.mesh, list.materials[draw.material], i, a, b, c, margin + side, margin,
                [&](int x, int y) -> float* {
                    if (x < margin) return nullptr;
                    return &level.depth[static_cast<std::size_t>((y - margin) * side + x - margin)];
                });
        }
    }
}

float ShadowMap::Level::depth_at(int x, int y) const {
    if (x < 0 || y < 0 || x >= side || y >= side) return -1e30F;
    return depth[static_cast<std::size_t>(y * side + x)];
}

ShadowMap::Place ShadowMap::place_of(const Level& level, const glm::vec3& point,
                                     const glm::vec3& normal) const {
    const float off = 0.75F / level.scale;
    const glm::vec3 at = point + normal * off;
    return {(glm::dot(at, right_) - level.left) * level.scale + 0.5F,
            (-glm::dot(at, up_) - level.top) * level.scale + 0.5F, glm::dot(at, direction_) + off};
}

const ShadowMap::Level* ShadowMap::level_of(const glm::vec3& point, const glm::vec3& normal,
                                            Place& place) const {
    for (const Level& level : levels_) {
        place = place_of(level, point, normal);
        const auto limit = static_cast<float>(level.side);
        if (place.x >= -1.0F && place.y >= -1.0F && place.x < limit && place.y < limit)
            return &level;
    }
    return nullptr;
}

float ShadowMap::light_at(const glm::vec3& point, const glm::vec3& normal) const {
    Place place;
    const Level* const level = level_of(point, normal, place);
    if (level == nullptr) return 1.0F;
    const float floor_x = std::floor(place.x), floor_y = std::floor(place.y);
    const float part_x = place.x - floor_x, part_y = place.y - floor_y;
    const int column = static_cast<int>(floor_x), row = static_cast<int>(floor_y);
    const int first = -beyond_, last = 1 + beyond_;
    // Of the outer rows and columns as much counts as a square of 1 + 2 beyond_ texels round the point has of them.
    const auto weight = [&](int i, float part) {
        return i == first ? 1.0F - part : i == last ? part : 1.0F;
    };
    float sum = 0.0F;
    for (int j = first; j <= last; ++j) {
        float of_row = 0.0F;
        for (int i = first; i <= last; ++i)
            if (level->depth_at(column + i, row + j) <= place.depth) of_row += weight(i, part_x);
        sum += of_row * weight(j, part_y);
    }
    const auto side = static_cast<float>(1 + 2 * beyond_);
    return sum / (side * side);
}

bool ShadowMap::reaches(const glm::vec3& point, const glm::vec3& normal) const {
    Place place;
    const Level* const level = level_of(point, normal, place);
    if (level == nullptr) return true;
    const float x = place.x + 0.5F, y = place.y + 0.5F;
    if (!(x >= 0.0F && y >= 0.0F)) return true;
    return level->depth_at(static_cast<int>(x), static_cast<int>(y)) <= place.depth;
}

std::vector<ShadowMap> shadow_maps(const DrawList& list, std::span<const Light> lights, int side,
                                   const Parallel& parallel,
                                   const std::optional<ShadowFocus>& focus) {
    std::vector<ShadowMap> maps(lights.size());
    std::vector<std::function<void()>> tasks;
    for (std::size_t i = 0; i < lights.size(); ++i)
        tasks.emplace_back([&, i] { maps[i] = ShadowMap(list, lights[i].direction, side, focus); });
    parallel(tasks);
    return maps;
}

std::vector<std::vector<Ambient>> ambient_light(const DrawList& list, std::span<const Light> lights,
                                                std::span<const ShadowMap> shadows,
                                                std::span<const std::vector<bool>> used,
                                                const Parallel& parallel) {
    constexpr std::size_t chunk = 4096;  // vertices of a task
    std::vector<std::vector<Ambient>> found(list.draws.size());
    std::vector<std::function<void()>> tasks;
    for (std::size_t d = 0; d < list.draws.size(); ++d) {
        const Draw& draw = list.draws[d];
        const std::size_t count = used[d].size();
        const bool is_translucent = list.materials[draw.material].transmission > 0.0F;
        found[d].resize(count);
        for (std::size_t from = 0; from < count; from += chunk)
            tasks.emplace_back([&, d, from, count, is_translucent] {
                for (std::size_t i = from; i < std::min(from + chunk, count); ++i) {
                    if (!used[d][i]) continue;
                    const glm::vec3 at = draw.placement.point(draw.mesh->positions[i]);
                    const glm::vec3 normal = glm::vec3(
                        unit_or(glm::dvec3(draw.placement.of_normals * draw.mesh->normals[i]), {}));
                    Ambient& sum = found[d][i];
                    for (std::size_t k = 0; k < lights.size(); ++k) {
                        const float lit = glm::dot(normal, lights[k].direction);
                        if (lit <= 0.0F) {
                            if (is_translucent)
                                (shadows[k].reaches(at, -normal) ? sum.behind
                                                                 : sum.stopped_behind) -=
                                    lights[k].strength * lit;
                            continue;
                        }
                        (shadows[k].reaches(at, normal) ? sum.arriving : sum.stopped) +=
                            lights[k].strength * lit;
                    }
                }
            });
    }
    parallel(tasks);
    return found;
}

}  // namespace sporeprint::render
