#include "core/render/close_up.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "core/math/direction.h"
#include "core/math/elementary.h"
#include "core/problems.h"

namespace sporeprint::render {

namespace {

/// Lengths that close-ups show, metres; part of the height that one of a base shows of tall products.
constexpr double margin_frame = 0.05, underside_frame = 0.06, base_frame = 0.08,
                 tall_base_part = 0.125;

/// Part of the longest side of a scene that its close-ups show at most.
constexpr double most_of_scene = 0.7;

/// Where the underside is looked at, between the middle and the margin.
constexpr float between_middle_and_margin = 0.6F;

/// The cap of what stands on the ground is above this part of its height; ring, volva and litter are
/// below.
constexpr float cap_from = 0.5F;

/// How high above the ground the middle of the close-up of a base is, as a part of its frame.
constexpr float base_height = 0.3F;

/// An individual grows sideways if its middle is farther beside its origin than this part of the
/// frame, and than this part of its height, so that it does not only lean. Its base is looked at
/// from obliquely below, at an angle to the side that it grows to.
constexpr float sideways_from = 0.25F, leaning_up_to = 0.5F;
constexpr double sideways_turn_deg = 40.0, sideways_elevation_deg = -33.0;

/// Returns the bounds of a mesh; instances share it.
class MeshBounds {
  public:
    /// Meshes of instances follow each other, so that the last one found is nearly always wanted.
    const Bounds& of(const Mesh& mesh) {
        const auto at = std::find_if(found_.rbegin(), found_.rend(),
                                     [&](const auto& one) { return one.first == &mesh; });
        if (at != found_.rend()) return at->second;
        found_.emplace_back(&mesh, bounds(mesh));
        return found_.back().second;
    }

  private:
    std::vector<std::pair<const Mesh*, Bounds>> found_;
};

/// One that is looked at: a draw, and its extent in the scene.
struct Individual {
    const Draw* draw = nullptr;
    glm::vec3 middle{0.0F};
};

bool has(const DrawList& list, GlbRole role) {
    return std::any_of(list.draws.begin(), list.draws.end(),
                       [&](const Draw& draw) { return draw.role == role; });
}

/// Returns the individual that is farthest in a direction.
///
/// role  of those that are compared; if the scene has none, all are
Individual foremost(const DrawList& list, const glm::vec3& direction, GlbRole role) {
    Individual best;
    float most = -1e30F;
    MeshBounds mesh_bounds;
    const bool has_role = has(list, role);
    for (const Draw& draw : list.draws) {
        if ((has_role && draw.role != role) || draw.mesh->triangles() == 0) continue;
        const Bounds& box = mesh_bounds.of(*draw.mesh);
        const glm::vec3 middle = draw.placement.point((box.min + box.max) * 0.5F);
        const float at = glm::dot(middle, direction);
        if (at <= most) continue;
        most = at;
        best = {&draw, middle};
    }
    return best;
}

struct Extent {
    float lowest = 1e30F, highest = -1e30F;
    float cap = -1e30F;  ///< from where on there is a cap
};

Extent extent_of(const Draw& draw, bool stands_on_ground) {
    Extent extent;
    for (const glm::vec3& at : draw.mesh->positions) {
        const float y = draw.placement.point(at).y;
        extent.lowest = std::min(extent.lowest, y);
        extent.highest = std::max(extent.highest, y);
    }
    if (!stands_on_ground) return extent;
    // What is under the ground does not count.
    extent.lowest = std::max(extent.lowest, std::min(draw.placement.translation.y, extent.highest));
    extent.cap = extent.lowest + cap_from * (extent.highest - extent.lowest);
    return extent;
}

/// Returns the point of the upper part of an individual that is farthest in a direction.
glm::vec3 margin_of(const Draw& draw, const Extent& extent, const glm::vec3& direction) {
    glm::vec3 margin(0.0F);
    float most = -1e30F;
    for (const glm::vec3& own : draw.mesh->positions) {
        const glm::vec3 at = draw.placement.point(own);
        if (at.y < extent.cap || glm::dot(at, direction) <= most) continue;
        most = glm::dot(at, direction);
        margin = at;
    }
    return margin;
}

/// Returns the weights of the corners of a triangle, seen from above, at a place; negative ones outside.
glm::vec3 horizontal_weights(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
                             const glm::vec3& place) {
    const auto area = [&](const glm::vec3& from, const glm::vec3& to, const glm::vec3& at) {
        return (to.z - from.z) * (at.x - from.x) - (to.x - from.x) * (at.z - from.z);
    };
    const float all = area(a, b, c);
    if (all == 0.0F) return glm::vec3(-1.0F);
    return glm::vec3(area(b, c, place), area(c, a, place), area(a, b, place)) * (1.0F / all);
}

/// Returns the triangle that faces downwards nearest to the vertical line through a place, as a point
/// of it; of several on the line the lowest. One of the cap is preferred.
std::optional<glm::vec3> underside_at(const Draw& draw, const Extent& extent,
                                      const glm::vec3& place) {
    struct Found {
        bool is_cap = false;
        float aside = 0.0F;
        glm::vec3 at{0.0F};

        [[nodiscard]] auto order() const { return std::tuple(!is_cap, aside, at.y); }
    };
    std::optional<Found> best;
    const std::vector<std::uint32_t>& indices = draw.mesh->indices;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const glm::vec3 a = draw.placement.point(draw.mesh->positions[indices[i]]),
                        b = draw.placement.point(draw.mesh->positions[indices[i + 1]]),
                        c = draw.placement.point(draw.mesh->positions[indices[i + 2]]);
        const glm::vec3 normal = glm::cross(b - a, c - a);
        if (normal.y >= 0.0F || normal.y * normal.y < 0.04F * glm::dot(normal, normal)) continue;
        const glm::vec3 weights = horizontal_weights(a, b, c, place);
        const bool is_inside = std::min({weights.x, weights.y, weights.z}) >= 0.0F;
        const glm::vec3 at =
            is_inside ? a * weights.x + b * weights.y + c * weights.z : (a + b + c) * (1.0F / 3.0F);
        const float x = at.x - place.x, z = at.z - place.z;
        const Found found{at.y > extent.cap, is_inside ? 0.0F : x * x + z * z, at};
        if (!best || found.order() < best->order()) best = found;
    }
    return best ? std::optional(best->at) : std::nullopt;
}

/// Returns the close-up of the base, a little above the place where an individual touches what it
/// grows on: there meshes have their origin.
CloseUp base_of(const DrawList& list, const Individual& individual, double azimuth, float frame) {
    glm::vec3 target = individual.draw->placement.translation;
    const Extent extent = extent_of(*individual.draw, list.stands_on_ground);
    glm::vec3 away(individual.middle.x - target.x, 0.0F, individual.middle.z - target.z);
    const bool has_carrier = has(list, GlbRole::carrier);
    const bool is_on_wood = has_carrier && !list.stands_on_ground;
    // Brackets grow forwards from their wood. Stems of a colony carry caps, whose origins are high
    // above the ground.
    if (is_on_wood) away = individual.draw->placement.linear * glm::vec3(0.0F, 0.0F, 1.0F);
    if (has_carrier && !is_on_wood) target.y = 0.0F;
    const float aside = std::sqrt(glm::dot(away, away));
    if (is_on_wood ||
        aside > std::max(sideways_from * frame, leaning_up_to * (extent.highest - extent.lowest))) {
        const double turn =
            arc_tangent(static_cast<double>(away.x), static_cast<double>(away.z)) * (180.0 / pi);
        return {target, camera_axes(turn + sideways_turn_deg, sideways_elevation_deg), frame};
    }
    target.y += std::clamp(individual.middle.y - target.y, 0.0F, base_height * frame);
    return {target, camera_axes(azimuth, 9.0), frame};
}

}  // namespace

bool is_close_up(View view) {
    return view == View::margin || view == View::underside || view == View::base;
}

CloseUp close_up_of(const DrawList& list, const PictureParams& params) {
    const double azimuth = angles_of(params, 0).x;
    const auto [sine, cosine] = sine_cosine(radians(azimuth));
    const glm::vec3 towards(glm::dvec3(sine, 0.0, cosine));
    const glm::vec3 size = list.box.max - list.box.min;
    const double longest = static_cast<double>(std::max({size.x, size.y, size.z}));
    const auto at_most = [&](double frame) {
        return static_cast<float>(std::min(frame, most_of_scene * longest));
    };
    if (params.view == View::base)
        return base_of(list, foremost(list, towards, GlbRole::body), azimuth,
                       at_most(std::max(base_frame, tall_base_part * static_cast<double>(size.y))));
    const Individual individual =
        foremost(list, towards, has(list, GlbRole::foliage) ? GlbRole::foliage : GlbRole::body);
    const Extent extent = extent_of(*individual.draw, list.stands_on_ground);
    const glm::vec3 margin = margin_of(*individual.draw, extent, towards);
    if (params.view == View::margin)
        return {margin, camera_axes(azimuth, 10.0), at_most(margin_frame)};
    const glm::vec3 place =
        individual.middle + (margin - individual.middle) * between_middle_and_margin;
    const std::optional<glm::vec3> target = underside_at(*individual.draw, extent, place);
    if (!target)
        throw Impossible("/view",
                         "nothing of this product faces downwards, so it has no underside to "
                         "show. Ask for another view");
    return {*target, camera_axes(azimuth, -34.0), at_most(underside_frame)};
}

Camera camera_of(const CloseUp& close_up, double aspect) {
    Camera camera = camera_with(close_up.axes, aspect);
    const float distance = close_up.frame / (2.0F * std::min(camera.tangent_x, camera.tangent_y));
    camera.position = close_up.target - close_up.axes.forward * distance;
    camera.nearest = 0.1F * distance;
    return camera;
}

}  // namespace sporeprint::render
