#include "core/geometry/damage_solids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/geometry/append.h"
#include "core/individual/damage.h"
#include "core/math/direction.h"
#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/mesh/detail.h"

namespace sporeprint {

namespace {

constexpr double whole_turn = 2.0 * pi;

// Numbers of solids by LOD.
constexpr std::array<SolidCounts, 4> limits_by_lod = {
    {{5, 14, 22, 12}, {0, 0, 0, 6}, {0, 0, 0, 0}, {0, 0, 0, 0}}};
const SolidCounts& limits_at(DetailLevel level) { return at_level(limits_by_lod, level); }

constexpr int roll_sides = 5, drop_sides = 6, drip_sides = 5, drip_rows = 4;
constexpr std::uint64_t roll_vertices(int pieces) {
    return static_cast<std::uint64_t>((pieces + 1) * (roll_sides + 1) + 2);
}
constexpr std::uint64_t roll_triangles(int pieces) {
    return static_cast<std::uint64_t>(2 * pieces * roll_sides + 2 * roll_sides);
}
// Two rings, a tip and the centre of the base.
constexpr std::uint64_t drop_vertices = 2 * (drop_sides + 1) + 2;
constexpr std::uint64_t drop_triangles = 4 * drop_sides;
constexpr std::uint64_t drip_vertices = drip_rows * (drip_sides + 1) + 2;
constexpr std::uint64_t drip_triangles = 2 * (drip_rows - 1) * drip_sides + 2 * drip_sides;

}  // namespace

MeshCount damage_solid_count(const Individual& individual, DetailLevel level) {
    const SolidCounts& limits = limits_at(level);
    MeshCount count;
    const auto solids = [&](int number, std::uint64_t vertices, std::uint64_t triangles) {
        count.vertices += static_cast<std::uint64_t>(number) * vertices;
        count.triangles += static_cast<std::uint64_t>(number) * triangles;
    };
    if (individual.damage.peels)
        solids(limits.rolls, roll_vertices(limits.roll_pieces), roll_triangles(limits.roll_pieces));
    if (individual.damage.melts) solids(limits.drips, drip_vertices, drip_triangles);
    if (individual.damage.dew) solids(limits.drops, drop_vertices, drop_triangles);
    return count;
}

DamageSolids::DamageSolids(Mesh& mesh, const FaceGrid& cap, const Individual& individual,
                           const MarginCuts& cuts, DetailLevel level, bool keep_absent)
    : mesh_(mesh),
      cap_(cap),
      individual_(individual),
      limits_(limits_at(level)),
      amounts_(individual.damage.amounts),
      cuts_(cuts),
      keep_absent_(keep_absent),
      textured_(!mesh.texture_coordinates.empty()),
      columns_(cuts.turns().size()) {}

DamageSolids::CapPoint DamageSolids::cap_point(double share, double turn) const {
    turn -= std::floor(turn);
    const auto column = static_cast<std::size_t>(
        std::upper_bound(cuts_.placed_turns().begin(), cuts_.placed_turns().end(), turn) -
        cuts_.placed_turns().begin() - 1);
    const double next = column + 1 == columns_ ? 1.0 : cuts_.placed_turns()[column + 1];
    const double v = (turn - cuts_.placed_turns()[column]) / (next - cuts_.placed_turns()[column]);
    const auto above = std::upper_bound(cap_.shares.begin(), cap_.shares.end(), share);
    const std::size_t ring = std::min(
        static_cast<std::size_t>(std::max<std::ptrdiff_t>(above - cap_.shares.begin() - 1, 0)),
        cap_.shares.size() - 2);
    const double gap = cap_.shares[ring + 1] - cap_.shares[ring];
    const double u = gap > 0.0 ? std::clamp((share - cap_.shares[ring]) / gap, 0.0, 1.0) : 0.0;
    const std::size_t a = cap_.first + ring * (columns_ + 1) + column, b = a + columns_ + 1;
    const auto mixed = [&](const auto& of) {
        const auto low = of[a] + static_cast<float>(v) * (of[a + 1] - of[a]);
        const auto high = of[b] + static_cast<float>(v) * (of[b + 1] - of[b]);
        return low + static_cast<float>(u) * (high - low);
    };
    CapPoint spot;
    spot.position = glm::dvec3(mixed(mesh_.positions));
    spot.normal = unit_or(glm::dvec3(mixed(mesh_.normals)), glm::dvec3(mesh_.normals[a]));
    spot.meridian =
        square_to(spot.normal, glm::dvec3(mesh_.positions[b]) - glm::dvec3(mesh_.positions[a]));
    if (textured_) spot.texture = mixed(mesh_.texture_coordinates);
    return spot;
}

void DamageSolids::solid(const std::vector<glm::dvec3>& corners, const glm::dvec3& start,
                         const glm::dvec3& end, std::size_t sides,
                         const std::vector<glm::vec2>& textures, const glm::dvec3& fallback,
                         bool drawn) {
    const std::size_t rows = textures.size(), row = sides + 1;
    const auto first = mesh_.positions.size();
    std::vector<glm::dvec3> normals(rows * row + 2, glm::dvec3(0.0));
    const auto corner = [&](std::size_t i) {
        return i < rows * row ? corners[i] : i == rows * row ? start : end;
    };
    std::vector<std::array<std::size_t, 3>> faces;
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
        const glm::dvec3 n = glm::cross(corner(b) - corner(a), corner(c) - corner(a));
        for (const std::size_t k : {a, b, c}) normals[k] += n;
        faces.push_back({a, b, c});
    };
    for (std::size_t j = 0; j < sides; ++j) {
        add(rows * row, j + 1, j);
        for (std::size_t i = 0; i + 1 < rows; ++i) {
            const std::size_t a = i * row + j;
            add(a, a + 1, a + row);
            add(a + 1, a + row + 1, a + row);
        }
        const std::size_t a = (rows - 1) * row + j;
        add(a, a + 1, rows * row + 1);
    }
    for (std::size_t i = 0; i < rows; ++i) {
        normals[i * row] += normals[i * row + sides];
        normals[i * row + sides] = normals[i * row];
    }
    for (std::size_t i = 0; i < normals.size(); ++i)
        append_vertex(mesh_, textured_, corner(i), unit_or(normals[i], fallback),
                      glm::dvec3(1.0, 0.0, 0.0),
                      i < rows * row    ? textures[i / row]
                      : i == rows * row ? textures.front()
                                        : textures.back());
    if (!drawn && !keep_absent_) return;
    for (const auto& [a, b, c] : faces) append_triangle(mesh_, first + a, first + b, first + c);
}

void DamageSolids::add_rolls() {
    const std::vector<MarginDamage>& all = individual_.damage.margins;
    for (std::size_t k = 0; k < all.size(); ++k)
        add_rolls(all[k], own_share(limits_.rolls, all, k, &MarginDamage::can_peel));
}

void DamageSolids::add_rolls(const MarginDamage& species, std::size_t left) {
    const double most = individual_.model.surface.damage.peel_reach;
    const double length = individual_.outline.cap.length();
    const std::uint32_t seed = damage_seed(individual_.weather_seed, species.stream);
    for (const Tongue& tongue : tongues(seed)) {
        if (left-- == 0) break;
        const double scale = begun(tongue.onset, species.peel) * (most > 0.0 ? 1.0 : 0.0);
        const double deep = std::min(tongue.reach * most * scale, 0.95);
        const double wide = tongue.half_width * (0.6 + 0.4 * scale);
        const auto sides = static_cast<std::size_t>(roll_sides);
        const auto pieces = static_cast<std::size_t>(limits_.roll_pieces);
        std::vector<CapPoint> line;
        for (std::size_t k = 0; k <= pieces; ++k) {
            const double phase =
                pi * (0.015 + 0.97 * static_cast<double>(k) / static_cast<double>(pieces));
            const double far = 1.0 - tongue_ragged(tongue, phase / whole_turn);
            const double theta = tongue.theta + wide * far * cosine(phase);
            const double sigma =
                std::min(1.0 - std::min(0.985, deep * far * sine(phase)), cuts_.cap_end(theta));
            line.push_back(cap_point(1.0 - sigma, theta / whole_turn));
        }
        std::vector<glm::dvec3> corners;
        std::vector<glm::vec2> textures;
        for (std::size_t k = 0; k <= pieces; ++k) {
            const CapPoint& here = line[k];
            const glm::dvec3 ahead = square_to(here.normal, line[std::min(k + 1, pieces)].position -
                                                                line[k == 0 ? 0 : k - 1].position);
            const glm::dvec3 aside = glm::cross(here.normal, ahead);
            const double t = static_cast<double>(k) / static_cast<double>(pieces);
            // Rolls are thickest where most of the cuticle has peeled off.
            const double thick = 0.024 * length * std::min(1.0, 2.5 * deep) *
                                 (0.35 + 0.65 * sine(pi * t)) *
                                 (1.0 + 0.25 * sine(17.0 * t + tongue.theta));
            for (std::size_t j = 0; j <= sides; ++j) {
                const auto turn =
                    sine_cosine(whole_turn * static_cast<double>(j % sides) / roll_sides);
                corners.push_back(here.position + thick * (0.45 + 0.9 * turn.sine) * here.normal +
                                  thick * turn.cosine * aside);
            }
            textures.push_back(here.texture);
        }
        solid(corners, line.front().position, line.back().position, sides, textures,
              line.front().normal, deep > 0.0);
    }
}

void DamageSolids::add_drips() {
    if (!individual_.damage.melts || limits_.drips == 0) return;
    const double length = individual_.outline.cap.length();
    const SeedShares shares = damage_shares(individual_);
    for (int i = 0; i < limits_.drips; ++i) {
        MixedRandom random(shares, purposes::drips, static_cast<std::uint32_t>(i));
        const double round = random.symmetric();
        const double size = random.uniform(0.5, 1.0);
        const double hang = random.uniform(1.6, 4.2);
        const double scale = smooth_step(0.04 * i, 0.3 + 0.05 * i, amounts_.deliquescence) * size;
        const double turn = (5 * i % limits_.drips + 0.35 * round) / limits_.drips;
        const CapPoint edge = cap_point(0.0, turn);
        const double thick = 0.018 * length * scale;
        const auto sides = static_cast<std::size_t>(drip_sides);
        std::vector<glm::dvec3> corners;
        std::vector<glm::vec2> textures;
        constexpr std::array<double, drip_rows> down = {0.05, 0.45, 0.75, 0.95};
        constexpr std::array<double, drip_rows> wide = {0.62, 0.42, 0.85, 0.6};
        for (std::size_t k = 0; k < drip_rows; ++k) {
            const glm::dvec3 middle = edge.position - glm::dvec3(0.0, thick * hang * down[k], 0.0);
            for (std::size_t j = 0; j <= sides; ++j) {
                const auto at_turn =
                    sine_cosine(whole_turn * static_cast<double>(j % sides) / drip_sides);
                corners.push_back(middle +
                                  thick * wide[k] * glm::dvec3(at_turn.cosine, 0.0, at_turn.sine));
            }
            textures.push_back(edge.texture);
        }
        solid(corners, edge.position + glm::dvec3(0.0, 0.3 * thick, 0.0),
              edge.position - glm::dvec3(0.0, thick * hang, 0.0), sides, textures, edge.normal,
              scale > 0.0);
    }
}

void DamageSolids::add_drops() {
    if (!individual_.damage.dew || limits_.drops == 0) return;
    const double length = individual_.outline.cap.length();
    int left = limits_.drops;
    for (const DamageSpot& spot :
         damage_spots(DamageSpotKind::dew, CurveName::cap, individual_.weather_seed)) {
        if (left-- <= 0) break;
        const double scale = begun(spot.onset, amounts_.dew);
        const double radius = std::max(spot.radius * 1.15 * scale * length, 0.0);
        const double sigma = std::min(spot.sigma, cuts_.cap_end(spot.theta) - 0.02);
        const CapPoint here = cap_point(1.0 - sigma, spot.theta / whole_turn);
        const glm::dvec3 aside = glm::cross(here.meridian, here.normal);
        const auto sides = static_cast<std::size_t>(drop_sides);
        std::vector<glm::dvec3> corners;
        for (const auto& [up, wide] : {std::array{-0.12, 1.0}, std::array{0.42, 0.78}})
            for (std::size_t j = 0; j <= sides; ++j) {
                const auto turn =
                    sine_cosine(whole_turn * static_cast<double>(j % sides) / drop_sides);
                corners.push_back(here.position +
                                  radius * (up * here.normal + wide * turn.cosine * aside +
                                            wide * turn.sine * here.meridian));
            }
        solid(corners, here.position - 0.2 * radius * here.normal,
              here.position + 0.72 * radius * here.normal, sides, {here.texture, here.texture},
              here.normal, radius > 0.0);
    }
}

}  // namespace sporeprint
