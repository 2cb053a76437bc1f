#include "core/geometry/wrap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/individual/proportion.h"
#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"

namespace sporeprint {

namespace {

/// A value and its derivative.
struct Sloped {
    double value = 0.0, slope = 0.0;
};

/// How far a circle of radius 1 is behind its tangent, by the place along that; straight beyond
/// `widest`.
Sloped behind_tangent(double x) {
    constexpr double widest = 0.8;
    const double within = std::clamp(x, -widest, widest);
    const double height = std::sqrt(1.0 - within * within);
    const double slope = within / height;
    return {1.0 - height + slope * (x - within), slope};
}

/// The share of points that follows the trunk, by their distance in front of the wall in radii of
/// the trunk: from 1 to 0 as a cubic, flat at both ends.
Sloped following(double z) {
    const double at = std::clamp(z, 0.0, 1.0), rest = 1.0 - at;
    return {rest * rest * (1.0 + 2.0 * at), -6.0 * at * rest};
}

/// How far a base reaches in front of the wall, and to each side, in widest radii of the outline.
constexpr double base_reach = 0.4, base_half = 0.85;
/// How much less a base runs up the wall than down.
constexpr double upward = 0.3;
/// The waves of a base along the wall: their size, and their lengths in reaches of the base.
constexpr std::array<double, 2> wave_size = {0.3, 0.2}, wave_length = {4.0, 1.7};
/// Share of the range above Azimuth::wall_from over which a base grows in a mix of brackets with what
/// stands on the ground.
constexpr double base_range = 0.5;

/// The share of a base by the distance in front of the wall in its reaches: from 1 to 0 as a cubic
/// that leaves the wall steeply.
Sloped base_at(double z) {
    if (z >= 1.0) return {};
    const double rest = 1.0 - std::max(z, 0.0);
    return {rest * rest * rest, z > 0.0 ? -3.0 * rest * rest : 0.0};
}

/// The share of a base by the distance from its middle in its half widths: from 1 to 0, flat at both
/// ends.
Sloped beside_middle(double x) {
    const double rest = std::max(1.0 - x * x, 0.0);
    return {rest * rest, -4.0 * x * rest};
}

/// Turns the normal and the tangent of a vertex of which one coordinate has been moved.
///
/// moved  index of the coordinate
/// by     derivatives of the moved coordinate by the three old ones
void turn_with(Mesh& mesh, std::size_t vertex, glm::length_t moved, const glm::dvec3& by) {
    glm::dvec3 normal(mesh.normals[vertex]);
    normal[moved] /= by[moved];
    for (glm::length_t k = 0; k < 3; ++k)
        if (k != moved) normal[k] -= by[k] * normal[moved];
    normal = glm::normalize(normal);
    mesh.normals[vertex] = glm::vec3(normal);
    if (mesh.tangents.empty()) return;
    glm::dvec3 tangent(mesh.tangents[vertex]);
    tangent[moved] = by.x * tangent.x + by.y * tangent.y + by.z * tangent.z;
    tangent = glm::normalize(tangent - glm::dot(tangent, normal) * normal);
    mesh.tangents[vertex] = glm::vec4(glm::vec3(tangent), mesh.tangents[vertex].w);
}

}  // namespace

BracketBase::BracketBase(const Individual& individual) {
    const double bracket =
        std::clamp((individual.azimuth.lateral - Azimuth::wall_from) / base_range, 0.0, 1.0);
    if (bracket * individual.azimuth.base <= 0.0) return;
    const Outline& outline = individual.outline;
    Extent extent{individual.stem_base, individual.stem_base};
    for (const SubCurve* curve : {&outline.hymenium, &outline.cap}) extent.include(*curve);
    *this = BracketBase((outline.cap.empty() ? outline.stem.at(1.0) : outline.cap.at(0.0)).y,
                        base_reach * extent.radius,
                        base_half * extent.radius * individual.azimuth.width,
                        bracket * individual.azimuth.base, individual.shape_seed);
}

BracketBase::BracketBase(double middle, double reach, double half, double amount,
                         std::uint32_t seed)
    : middle_(middle), reach_(reach), half_(half), amount_(amount) {
    Random random(seed, purposes::bracket_base);
    for (double& phase : phases_) phase = random.uniform(0.0, 2.0 * pi);
}

std::pair<double, double> BracketBase::range(double low, double high) const {
    const double most = amount_ * (1.0 + wave_size[0] + wave_size[1]);
    return {low + most * std::min(low - middle_, 0.0),
            high + upward * most * std::max(high - middle_, 0.0)};
}

void BracketBase::apply(Mesh& mesh) const {
    if (amount_ <= 0.0) return;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::dvec3 at(mesh.positions[i]);
        const Sloped share = base_at(at.z / reach_);
        if (share.value <= 0.0) continue;
        const Sloped side = beside_middle(at.x / half_);
        if (side.value <= 0.0) continue;
        Sloped wave{1.0, 0.0};
        for (std::size_t k = 0; k < phases_.size(); ++k) {
            const double turns = 2.0 * pi / (wave_length[k] * reach_);
            const SineCosine along = sine_cosine(turns * at.x + phases_[k]);
            wave.value += wave_size[k] * along.sine;
            wave.slope += wave_size[k] * turns * along.cosine;
        }
        wave = {wave.value * side.value, wave.slope * side.value + wave.value * side.slope / half_};
        const double over = at.y - middle_;
        const double amount = over < 0.0 ? amount_ : upward * amount_;
        // The derivatives of the new height by the old coordinates.
        const double by_x = over * amount * wave.slope * share.value;
        const double by_y = 1.0 + amount * wave.value * share.value;
        const double by_z = over * amount * wave.value * share.slope / reach_;
        mesh.positions[i].y = static_cast<float>(middle_ + over * by_y);
        turn_with(mesh, i, 1, {by_x, by_y, by_z});
    }
}

void wrap_round_trunk(Mesh& mesh, double radius) {
    if (radius <= 0.0) return;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        glm::vec3& position = mesh.positions[i];
        const Sloped back = behind_tangent(static_cast<double>(position.x) / radius);
        const Sloped share = following(static_cast<double>(position.z) / radius);
        position.z -= static_cast<float>(radius * back.value * share.value);
        // The derivatives of the new z by the old x and z; those of the other coordinates are 0 or 1.
        const double by_x = -back.slope * share.value, by_z = 1.0 - back.value * share.slope;
        turn_with(mesh, i, 2, {by_x, 0.0, by_z});
    }
}

}  // namespace sporeprint
