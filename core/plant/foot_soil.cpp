#include "core/plant/foot_soil.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/math/elementary.h"
#include "core/math/noise.h"
#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/mesh/tangents.h"
#include "core/plant/bark_image.h"

namespace sporeprint {

namespace {

// By level of detail: sides of the piece, and rings of its upper face.
struct Rings {
    std::uint32_t sides, rings;
};
constexpr std::array<Rings, tree_lods> rings_of_level = {Rings{72, 14}, Rings{32, 6}, Rings{14, 2},
                                                         Rings{8, 1}};

// Reach of the border and height of the middle above the ground, in radii of the trunk, for a flare of
// 1; half the least thickness of the piece; how far its border lies under the ground.
constexpr double reach = 4.4, height = 0.42, rim = 0.03, under = 0.04;

// Colours of soil and of dry litter in it, as linear light.
constexpr glm::dvec3 soil(0.060, 0.040, 0.026), litter(0.17, 0.105, 0.055), moss(0.05, 0.065, 0.02);

const Rings& level_of(int lod) {
    return rings_of_level[static_cast<std::size_t>(std::clamp(lod, 0, tree_lods - 1))];
}

std::size_t vertices_of(const Rings& level) {
    return 2 * (static_cast<std::size_t>(level.sides) * level.rings + 1);
}

float noise_at(const glm::dvec3& p, double per, std::uint32_t seed) {
    const std::array<float, 1> x = {static_cast<float>(p.x * per + 40.3)},
                               y = {static_cast<float>(p.y * per + 40.7)},
                               z = {static_cast<float>(p.z * per + 40.1)};
    std::array<float, 1> out{};
    gradient_noise(x, y, z, seed, out);
    return out[0];
}

std::uint32_t seed_of(std::uint32_t seed) {
    Random random(seed, purposes::root_flare, 1);
    return random.bits();
}

}  // namespace

std::size_t add_foot_soil(Bark& bark, const Tree& tree, double flare, std::uint32_t seed, int lod) {
    if (flare <= 0.0) return 0;
    const double radius = tree.skeleton.nodes.front().radius;
    const Rings& level = level_of(lod);
    const std::uint32_t own = seed_of(seed);
    const double wide = reach * radius * (0.55 + 0.45 * std::min(flare, 1.0)),
                 high = height * radius * std::min(1.0, 0.4 + flare);
    Mesh piece;
    const double girths = 1.0 / (2.0 * pi * radius);
    const auto add = [&](const glm::dvec3& place) {
        piece.positions.emplace_back(place);
        // Finer than on the trunk, and ridges no longer than wide: crumbs instead of furrows. Triangles of
        // coarse levels would be wider than an image.
        const double fine = lod < 2 ? 1.7 : 0.6, shorter = lod < 2 ? 2.5 : 1.0;
        piece.texture_coordinates.emplace_back(
            mirrored_place(20.5 + fine * girths * place.x),
            mirrored_place(20.5 + shorter * fine * girths * place.z / bark_girths));
    };
    const auto place_of = [&](std::uint32_t ring, std::uint32_t side, bool is_upper) {
        const double along = static_cast<double>(ring) / level.rings;
        const SineCosine at = sine_cosine(2.0 * pi * static_cast<double>(side) / level.sides);
        const glm::dvec3 way(at.cosine, 0.0, at.sine);
        const double border =
            wide * (1.0 + 0.28 * static_cast<double>(noise_at(way, 1.1, own)) +
                    (lod < 2 ? 0.07 * static_cast<double>(noise_at(way, 4.0, own + 1U)) : 0.0));
        glm::dvec3 place = border * along * way;
        const double fall = 1.0 - along;
        double rise = high * fall * fall * (3.0 - 2.0 * fall);
        if (lod < 2 && ring > 0)
            rise += radius * fall *
                    (0.10 * static_cast<double>(noise_at(place, 1.3 / radius, own + 2U)) +
                     0.06 * static_cast<double>(noise_at(place, 4.0 / radius, own + 3U)));
        // The border lies a little under the ground, which ends the piece where the ground is uneven.
        place.y = (is_upper ? std::max(rise, rim * radius * fall) : -rim * radius * fall) -
                  under * radius * along * along;
        return place;
    };
    for (const bool is_upper : {true, false}) {
        const auto shift = static_cast<std::uint32_t>(piece.positions.size());
        add(place_of(0, 0, is_upper));
        for (std::uint32_t ring = 1; ring <= level.rings; ++ring)
            for (std::uint32_t side = 0; side < level.sides; ++side)
                add(place_of(ring, side, is_upper));
        const auto vertex = [&](std::uint32_t ring, std::uint32_t side) {
            return ring == 0 ? shift : shift + 1 + (ring - 1) * level.sides + side % level.sides;
        };
        const auto triangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            piece.indices.insert(piece.indices.end(), {a, is_upper ? c : b, is_upper ? b : c});
        };
        for (std::uint32_t side = 0; side < level.sides; ++side) {
            triangle(shift, vertex(1, side), vertex(1, side + 1));
            for (std::uint32_t ring = 1; ring < level.rings; ++ring) {
                triangle(vertex(ring, side), vertex(ring + 1, side), vertex(ring + 1, side + 1));
                triangle(vertex(ring, side), vertex(ring + 1, side + 1), vertex(ring, side + 1));
            }
        }
    }
    std::vector<glm::dvec3> normals(piece.positions.size(), glm::dvec3(0.0));
    for (std::size_t t = 0; t < piece.indices.size(); t += 3) {
        const auto at = [&](std::size_t k) {
            return glm::dvec3(piece.positions[piece.indices[t + k]]);
        };
        const glm::dvec3 across = glm::cross(at(1) - at(0), at(2) - at(0));
        for (std::size_t k = 0; k < 3; ++k) normals[piece.indices[t + k]] += across;
    }
    for (const glm::dvec3& normal : normals) piece.normals.emplace_back(glm::normalize(normal));
    add_tangents(piece);
    append(bark.mesh, piece);
    bark.edges.insert(bark.edges.end(), piece.positions.size(), 0U);
    return piece.positions.size();
}

TreeCount count_of_foot_soil(const TreeShape& shape, int lod) {
    if (shape.root_flare <= 0.0) return {};
    const Rings& level = level_of(lod);
    return {static_cast<double>(vertices_of(level)),
            2.0 * static_cast<double>(level.sides * (2 * level.rings - 1))};
}

void tint_foot(std::vector<glm::vec3>& tints, const Bark& bark, const Tree& tree, double flare,
               std::uint32_t seed, std::size_t of_soil, double black, const glm::vec3& light) {
    if (flare <= 0.0) return;
    const double radius = tree.skeleton.nodes.front().radius;
    const std::uint32_t own = seed_of(seed);
    const int trunk = tree.ramification.nodes.front().order;
    const std::size_t of_bark = tints.size() - of_soil;
    const auto noise = [&](const glm::dvec3& p, double per, std::uint32_t salt) {
        return static_cast<double>(noise_at(p, per / radius, own + salt));
    };
    for (std::size_t i = 0; i < of_bark; ++i) {
        const glm::dvec3 p(bark.mesh.positions[i]);
        if (tree.ramification.nodes[bark.edges[i]].order != trunk || p.y > 9.0 * radius) continue;
        // Fissures reach up in tongues; the ground keeps the lowest bark damp.
        const double up = std::max(p.y, 0.0) / radius;
        const double tongue = noise({p.x, 0.25 * p.y, p.z}, 1.7, 5U) + 0.5 * noise(p, 3.5, 6U);
        const double torn = smooth_step(0.0, 0.25, tongue + 0.62 - 0.24 * up);
        const double damp = 1.0 - smooth_step(0.0, 2.2, up + 0.8 * noise(p, 1.2, 7U));
        tints[i] *= static_cast<float>((1.0 - black * torn) * (1.0 - 0.35 * damp));
    }
    for (std::size_t i = of_bark; i < tints.size(); ++i) {
        const glm::dvec3 p(bark.mesh.positions[i]);
        const double dry = smooth_step(0.05, 0.5, noise(p, 5.0, 8U) + 0.4 * noise(p, 1.1, 9U)),
                     green = smooth_step(0.1, 0.5, noise(p, 0.9, 10U));
        const glm::dvec3 wanted = soil + dry * (litter - soil) + 0.7 * green * (moss - soil);
        const glm::dvec3 factor = (1.0 + 0.35 * noise(p, 8.0, 11U)) * wanted /
                                  glm::max(glm::dvec3(light), glm::dvec3(0.02));
        tints[i] = glm::vec3(glm::clamp(factor, glm::dvec3(0.02), glm::dvec3(1.0)));
    }
}

}  // namespace sporeprint
