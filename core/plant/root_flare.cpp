#include "core/plant/root_flare.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/math/direction.h"
#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/mesh/refinement.h"
#include "core/mesh/tangents.h"

namespace sporeprint {

namespace {

/// Height within which the flare falls to 1 / e, in radii of the trunk.
constexpr double flare_height = 1.9;

/// Height from which on nothing flares, in heights of the flare: there it is below a ten-thousandth.
constexpr double flare_end = 3.6;

/// How far roots dip below the ground, in radii of the trunk, for a flare of 1: the foot of a tree on
/// uneven ground stays covered.
constexpr double dip = 0.6;

/// Height below which the skin of a trunk is refined before it flares, in radii of the trunk: roots turn
/// more sharply than a trunk.
constexpr double refined_height = 3.0;

/// The map of space about the foot of a trunk.
class Flare {
  public:
    Flare(double radius, double flare, std::uint32_t seed) : radius_(radius), flare_(flare) {
        Random random(seed, purposes::root_flare);
        roots_ = 4 + static_cast<int>(random.bits() % 3);
        for (double& phase : phases_) phase = random.uniform(0.0, 2.0 * pi);
    }

    [[nodiscard]] glm::dvec3 at(const glm::dvec3& p) const {
        const double height = std::max(p.y, 0.0) / (flare_height * radius_);
        const double fallen = exponential(-height * (1.0 + 0.5 * height));
        const double angle = arc_tangent(p.z, p.x);
        // Roots are neither equally far apart nor equally strong.
        const double uneven = angle + 0.35 * sine(angle + phases_[1]);
        const double root = 0.5 + 0.5 * sine(roots_ * uneven + phases_[0]);
        const double strong = 0.8 + 0.2 * sine(2.0 * angle + phases_[2]);
        // At the ground roots are narrow ridges that run out far.
        const double ridge = root * root * root * root * fallen;
        const double factor =
            1.0 + flare_ * fallen * strong * (0.30 + 0.8 * root * root + 0.5 * ridge);
        return {p.x * factor, p.y - dip * flare_ * radius_ * fallen * (0.3 + 0.7 * root * root),
                p.z * factor};
    }

  private:
    double radius_, flare_;
    int roots_ = 5;
    std::array<double, 3> phases_{};
};

/// Returns how often the skin is refined at a level of detail. Where trunks have few sides, the corners of their feet
/// would be seen on the ground.
int passes(int lod) { return lod == 0 ? 2 : 1; }

}  // namespace

TreeCount count_of_flare(const TreeShape& shape, int lod) {
    TreeCount count;
    if (shape.root_flare <= 0.0) return count;
    // Sides and rows below that height of the skin of bark_of(), where each pass makes four triangles
    // of one.
    const double sides = lod == 0 ? 16.0 : 8.0, rows = lod == 0 ? 15.0 : lod == 1 ? 6.0 : 4.0;
    const double parts = lod == 0 ? 16.0 : 4.0;
    count.triangles = 2.0 * sides * rows * (parts - 1.0);
    count.vertices = 0.55 * count.triangles;
    return count;
}

void plant_foot(Bark& bark, const Tree& tree) {
    const auto radius = static_cast<float>(tree.skeleton.nodes.front().radius);
    const int trunk = tree.ramification.nodes.front().order;
    for (std::size_t i = 0; i < bark.mesh.positions.size(); ++i) {
        glm::vec3& at = bark.mesh.positions[i];
        // Its first ring and what closes it.
        if (tree.ramification.nodes[bark.edges[i]].order == trunk && at.y < 0.05F * radius)
            at.y -= radius;
    }
}

void flare_roots(Bark& bark, const Tree& tree, double flare, std::uint32_t seed, int lod) {
    if (flare <= 0.0) return;
    const double radius = tree.skeleton.nodes.front().radius;
    const Flare map(radius, flare, seed);
    const int trunk = tree.ramification.nodes.front().order;
    const double step = 1e-4 * radius, axis = 0.02 * radius;
    Mesh& mesh = bark.mesh;
    for (int pass = 0; pass < passes(lod); ++pass) {
        mesh.tangents.clear();
        const std::vector<std::uint32_t>& edges = bark.edges;
        const auto parents = refine(mesh, [&](std::uint32_t i) {
            return tree.ramification.nodes[edges[i]].order == trunk &&
                   static_cast<double>(mesh.positions[i].y) < refined_height * radius;
        });
        for (const auto& [a, b] : parents) bark.edges.push_back(bark.edges[a]);
    }
    add_tangents(mesh);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::dvec3 place(mesh.positions[i]);
        if (tree.ramification.nodes[bark.edges[i]].order != trunk ||
            place.y > flare_end * flare_height * radius)
            continue;
        // The map has no derivative on the axis, where the middle of the foot is.
        if (place.x * place.x + place.z * place.z < axis * axis) continue;
        const glm::dvec3 normal(mesh.normals[i]), aside = square_to(normal, {1.0, 0.0, 0.0}),
                                                  up = glm::cross(normal, aside);
        const auto moved_along = [&](const glm::dvec3& way) {
            return map.at(place + step * way) - map.at(place - step * way);
        };
        mesh.positions[i] = glm::vec3(map.at(place));
        const glm::dvec3 across = glm::cross(moved_along(aside), moved_along(up));
        mesh.normals[i] = glm::vec3(glm::normalize(across));
        if (mesh.tangents.empty()) continue;
        const glm::dvec3 tangent(mesh.tangents[i]);
        mesh.tangents[i] =
            glm::vec4(glm::vec3(square_to(glm::normalize(across), tangent)), mesh.tangents[i].w);
    }
}

}  // namespace sporeprint
