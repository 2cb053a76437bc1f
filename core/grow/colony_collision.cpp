#include "core/grow/colony_collision.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <utility>

#include "core/math/direction.h"

namespace sporeprint {

namespace {

/// Returns the product of two unit quaternions x, y, z, w: first `b`, then `a`.
glm::dvec4 product_of(const glm::dvec4& a, const glm::dvec4& b) {
    const glm::dvec3 u(a), v(b);
    return {a.w * v + b.w * u + glm::cross(u, v), a.w * b.w - glm::dot(u, v)};
}

}  // namespace

Collision colony_collision(const ColonySite& site, const std::vector<ColonyMember>& members,
                           const std::vector<std::vector<CollisionShape>>& shapes,
                           const ColonyParams& params, const ColonyTraits& traits) {
    std::vector<Collision> models;
    models.reserve(shapes.size());
    for (const std::vector<CollisionShape>& of_model : shapes) models.push_back(body_of(of_model));
    Collision collision;
    std::vector<std::size_t> first_of(models.size());
    for (std::size_t i = 0; i < models.size(); ++i) {
        first_of[i] = collision.shapes.size();
        collision.shapes.insert(collision.shapes.end(), models[i].shapes.begin(),
                                models[i].shapes.end());
    }
    for (const ColonyMember& member : members) {
        const Pose& pose = member.pose;
        for (const Collider& own : models[member.model].colliders) {
            const glm::dvec4 turn = product_of(quaternion_of(pose.turn), own.place.rotation);
            collision.colliders.push_back(
                {first_of[member.model] + own.shape,
                 {pose.world(own.place.translation), turn, glm::dvec3(pose.scale)}});
        }
        if (!traits.capped) continue;
        const ColonyPlace& place = site.places[member.place];
        // The chords of n equal pieces are at most a quarter of the swing / n^2 off the stem.
        const double off = 0.25 * glm::length(member.swing) / (0.5 * place.radius);
        const int pieces = std::clamp(static_cast<int>(std::ceil(std::sqrt(off))), 1, 6);
        std::vector<glm::dvec3> points;
        for (int i = 0; i <= pieces; ++i) {
            const double t = static_cast<double>(i) / pieces;
            points.push_back(params.size * (place.foot + t * member.rise + t * t * member.swing));
        }
        const std::vector<double> radii(points.size(), params.size * place.radius);
        for (CollisionShape& stem : capsules_along("stem", points, radii, pieces))
            collision.add(std::move(stem));
    }
    return collision;
}

}  // namespace sporeprint
