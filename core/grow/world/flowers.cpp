#include "core/grow/world/flowers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>

#include "core/grow/world/scattering.h"
#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"

namespace sporeprint {

namespace {

constexpr glm::vec3 stalk_green(0.07F, 0.14F, 0.03F), pollen(0.75F, 0.45F, 0.02F);

constexpr glm::vec3 white(0.87F, 0.85F, 0.85F), yellow(0.85F, 0.60F, 0.01F),
    purple(0.42F, 0.08F, 0.40F), dark_purple(0.16F, 0.03F, 0.16F);

constexpr std::array kinds = {
    FlowerKind{"wood_anemone", 76, 128, 30.0, true, 6, 0.032, 0.14, white, pollen},
    FlowerKind{"daisy", 75, 300, 7.0, false, 12, 0.02, 0.08, white, pollen},
    FlowerKind{"meadow_buttercup", 120, 200, 9.0, false, 5, 0.024, 0.30, yellow, pollen},
    FlowerKind{"brown_knapweed", 175, 275, 3.5, false, 14, 0.028, 0.36, purple, dark_purple}};

/// Sides of the cells in which flowers stand, and of those over which their number varies, metres.
constexpr double cell = 0.5, patch = 3.0;

/// Adds a triangle with a face on each side.
void add_sheet(Mesh& mesh, const std::array<glm::dvec3, 3>& at, const glm::vec3& tint) {
    const glm::dvec3 up = glm::normalize(glm::cross(at[1] - at[0], at[2] - at[0]));
    for (const double face : {1.0, -1.0}) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (const glm::dvec3& corner : at) {
            mesh.positions.emplace_back(corner);
            mesh.normals.emplace_back(face * up);
            mesh.tints.push_back(tint);
        }
        const std::uint32_t second = face > 0.0 ? 1 : 2;
        mesh.indices.insert(mesh.indices.end(), {first, first + second, first + 3 - second});
    }
}

void add_petals(Mesh& mesh, const FlowerKind& kind) {
    const glm::dvec3 middle(0.0, kind.height, 0.0);
    const double length = 0.5 * kind.width, wide = 1.15 * pi * 0.62 * length / kind.petals;
    for (int k = 0; k < kind.petals; ++k) {
        const SineCosine turn = sine_cosine(2.0 * pi * k / kind.petals);
        const glm::dvec3 out(turn.cosine, 0.0, turn.sine), across(-turn.sine, 0.0, turn.cosine);
        const auto place = [&](double along, double aside) {
            // Petals rise a little towards their tips.
            return middle + along * length * out + aside * across +
                   glm::dvec3(0.0, 0.22 * along * length, 0.0);
        };
        const std::array<glm::dvec3, 4> at = {place(0.1, 0.0), place(0.62, wide), place(1.0, 0.0),
                                              place(0.62, -wide)};
        add_sheet(mesh, {at[0], at[1], at[2]}, kind.petal);
        add_sheet(mesh, {at[0], at[2], at[3]}, kind.petal);
    }
}

/// Adds a solid between two points on the axis, with a ring of corners at its widest.
void add_spindle(Mesh& mesh, double from, double widest, double to, double radius, int sides,
                 const glm::vec3& tint) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const auto add = [&](const glm::dvec3& at, const glm::dvec3& normal) {
        mesh.positions.emplace_back(at);
        mesh.normals.emplace_back(normal);
        mesh.tints.push_back(tint);
    };
    add({0.0, from, 0.0}, {0.0, -1.0, 0.0});
    add({0.0, to, 0.0}, {0.0, 1.0, 0.0});
    for (int k = 0; k < sides; ++k) {
        const SineCosine turn = sine_cosine(2.0 * pi * k / sides);
        add({radius * turn.cosine, widest, radius * turn.sine}, {turn.cosine, 0.0, turn.sine});
    }
    const auto count = static_cast<std::uint32_t>(sides);
    for (std::uint32_t k = 0; k < count; ++k) {
        const std::uint32_t a = first + 2 + k, b = first + 2 + (k + 1) % count;
        mesh.indices.insert(mesh.indices.end(), {first, a, b, first + 1, b, a});
    }
}

}  // namespace

std::span<const FlowerKind> flower_kinds() { return kinds; }

Mesh flower_mesh(const FlowerKind& kind) {
    Mesh mesh;
    add_spindle(mesh, -0.01, 0.02, kind.height, 0.0016, 3, stalk_green);
    add_petals(mesh, kind);
    const double thick = 0.14 * kind.width;
    add_spindle(mesh, kind.height - thick, kind.height, kind.height + thick, 0.13 * kind.width, 6,
                kind.middle);
    return mesh;
}

double open_on(const FlowerKind& kind, int day) {
    constexpr double opening = 14.0, fading = 18.0;
    return smooth_step(kind.first, kind.first + opening, day) *
           (1.0 - smooth_step(kind.last - fading, kind.last, day));
}

std::vector<GlbTransform> places_of(const FlowerKind& kind, const PlotContent& content,
                                    const PlotFrame& frame, const CoverField& cover, double rim) {
    std::vector<GlbTransform> places;
    const double open = open_on(kind, content.northern_day());
    if (open <= 0.0) return places;
    const auto number = static_cast<int>(&kind - kinds.data());
    // Where they are most frequent there are twice as many as in the mean.
    constexpr double most = 2.0;
    const int tries = static_cast<int>(std::ceil(most * kind.per_m2 * cell * cell));
    struct Flower {
        double chance, size, turn, lean;
    };
    const auto draw = [](Random& random) {
        const double chance = random.uniform(), size = random.uniform(), turn = random.uniform(),
                     lean = random.uniform();
        return Flower{chance, size, turn, lean};
    };
    for_each_place(content.seed, {cell, tries, static_cast<std::uint32_t>(5 + number)}, frame.box(),
                   rim, draw, [&](double x, double y, const Flower& flower) {
                       Random of_patch(content.seed, purposes::plot_pieces,
                                       static_cast<std::uint32_t>(25 + number),
                                       {cell_of(x, patch), cell_of(y, patch)});
                       const double here = of_patch.uniform();
                       const Cover ground = cover.at(x, y);
                       const double liked = kind.in_woods
                                                ? ground.all_leaves() * (1.0 - content.acidity)
                                                : ground.grass * ground.grass;
                       const double wanted = open * liked * here * most * kind.per_m2 * cell * cell;
                       if (flower.chance * tries >= wanted) return;
                       const double scale = 0.75 + 0.5 * flower.size;
                       const SineCosine half = sine_cosine(pi * flower.turn),
                                        tilt = sine_cosine(0.15 * flower.lean);
                       // Turned about the vertical axis, then leaning.
                       places.push_back({frame.on_floor(x, y),
                                         {tilt.sine * half.cosine, half.sine * tilt.cosine,
                                          -tilt.sine * half.sine, half.cosine * tilt.cosine},
                                         glm::dvec3(scale)});
                   });
    return places;
}

std::vector<PlotFlowers> flowers_on(const PlotContent& content, const PlotFrame& frame,
                                    const CoverField& cover, double rim) {
    std::vector<PlotFlowers> flowers;
    for (const FlowerKind& kind : flower_kinds()) {
        std::vector<GlbTransform> places = places_of(kind, content, frame, cover, rim);
        if (!places.empty())
            flowers.push_back({{flower_mesh(kind), std::move(places)}, std::string(kind.name)});
    }
    return flowers;
}

}  // namespace sporeprint
