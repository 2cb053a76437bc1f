// Compound leaves: copies of one leaflet along a bent axis.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <utility>
#include <vector>

#include "core/plant/lamina.h"
#include "core/plant/leaf_shell.h"

namespace sporeprint {

namespace {

// Radii of the axis at the far end of the petiole, at the lowest leaflets and at its tip, in its
// lengths; no source or measurement is recorded.
constexpr double foot_radius = 0.0085, root_radius = 0.006, tip_radius = 0.0016;

// Bend of a leaflet in that of the axis.
constexpr double leaflet_curl = 0.4;

// How far the tip of a leaflet is swept towards that of the axis, in its lengths.
constexpr double sweep = 0.12;

// Edges of the border of a leaflet from one of its corners to the next at LOD 0, finest first.
constexpr std::array<int, 4> leaflet_steps = {4, 3, 2, 1};

// By level of detail: sides of the axis, and its rings along petiole and leaflets.
struct AxisLevel {
    std::uint32_t sides, petiole_rings, rings;
};
constexpr std::array<AxisLevel, leaf_lods> axis_levels = {AxisLevel{6, 3, 12}, AxisLevel{4, 2, 8},
                                                          AxisLevel{3, 1, 5}, AxisLevel{3, 1, 4}};

// Adds the axis: a closed tube from the far end of the petiole to a point at the tip.
void add_axis(const LeafShape& shape, const Bending& bent, int lod, Shell& shell) {
    const auto [sides, before, after] = axis_levels[static_cast<std::size_t>(lod)];
    const double last = placed_leaflets(shape.leaflets).back().size;
    const std::uint32_t count = before + after;
    const auto texture = [&](double along, double round) {
        return glm::dvec2(0.01 + 0.98 * along,
                          petiole_strip + 0.01 + (0.98 - petiole_strip) * round);
    };
    const auto at = [&](double y, double x, double up) {
        return y < 0.0 ? glm::dvec3(-x, up, y) : bent.at({x, y}, up);
    };
    std::vector<std::vector<std::uint32_t>> rows;
    for (std::uint32_t i = 0; i < count; ++i) {
        const double y = i < before ? -shape.petiole * (1.0 - static_cast<double>(i) / before)
                                    : (1.0 - 0.9 * last) * (i - before) / (after - 1.0);
        const double radius = y < 0.0
                                  ? root_radius - (foot_radius - root_radius) * y / shape.petiole
                                  : root_radius + (tip_radius - root_radius) * y;
        std::vector<std::uint32_t> row;
        for (std::uint32_t k = 0; k <= sides; ++k) {
            const double round = static_cast<double>(k % sides) / sides;
            const SineCosine turn = sine_cosine(2.0 * pi * round);
            row.push_back(
                shell.add(at(y, -radius * turn.cosine, radius * turn.sine),
                          texture(0.05 + 0.9 * i / count, static_cast<double>(k) / sides)));
        }
        rows.push_back(std::move(row));
    }
    const std::uint32_t point = shell.add(at(1.0 - 0.8 * last, 0.0, 0.0), texture(0.96, 0.5));
    for (std::uint32_t i = 0; i + 1 < count; ++i)
        for (std::uint32_t k = 0; k < sides; ++k) {
            shell.triangles.push_back({rows[i][k], rows[i][k + 1], rows[i + 1][k + 1]});
            shell.triangles.push_back({rows[i][k], rows[i + 1][k + 1], rows[i + 1][k]});
        }
    for (std::uint32_t k = 0; k < sides; ++k)
        shell.triangles.push_back({rows.back()[k], rows.back()[k + 1], point});
    const std::uint32_t middle = shell.add(at(-shape.petiole, 0.0, 0.0), texture(0.0, 0.5));
    std::vector<std::uint32_t> rim;
    for (std::uint32_t k = 0; k < sides; ++k)
        rim.push_back(shell.add(shell.places[rows.front()[k]],
                                texture(0.02, static_cast<double>(k) / sides)));
    for (std::uint32_t k = 0; k < sides; ++k)
        shell.triangles.push_back({rim[(k + 1) % sides], rim[k], middle});
}

// Returns the area of a leaflet with its smooth border.
double smooth_area(const LeafShape& leaflet) {
    const std::vector<glm::dvec2> border = border_of(lamina_of(leaflet.venation, 3));
    double twice = 0.0;
    for (std::size_t i = 0; i < border.size(); ++i) {
        const glm::dvec2 a = border[i], b = border[(i + 1) % border.size()];
        twice += a.x * b.y - a.y * b.x;
    }
    return 0.5 * twice;
}

// Returns a leaflet of length 1 as a flat kite from its root to its tip, of the area of its lamina.
Shell kite_of(const LeafShape& leaflet) {
    const double half = smooth_area(leaflet);
    const std::array<glm::dvec2, 4> corners = {glm::dvec2(0.0), glm::dvec2(half, 0.45),
                                               glm::dvec2(0.0, 1.0), glm::dvec2(-half, 0.45)};
    const LeafChart chart = chart_of(lamina_of(leaflet.venation, leaf_steps(leaflet.venation, 0)));
    Shell shell;
    for (const bool upper : {true, false})
        for (const glm::dvec2& corner : corners)
            shell.add({-corner.x, 0.0, corner.y}, chart.texture_point(corner, upper));
    shell.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 6, 5}, {4, 7, 6}};
    return shell;
}

// Returns a leaflet of length 1 at a level of detail of its leaf.
Shell leaflet_shell(const LeafShape& compound, int lod) {
    const LeafShape leaflet = leaflet_of(compound);
    if (lod >= 2) return kite_of(leaflet);
    const Bending bent(leaflet);
    const std::size_t fan = lod == 0 ? most_foliage_triangles : most_foliage_triangles / 2;
    if (lod == 0)
        for (const int steps : leaflet_steps) {
            Shell drawn = coarse_lamina_shell(leaflet, bent, steps);
            if (drawn.triangles.size() * static_cast<std::uint64_t>(compound.leaflets.count) <=
                most_leaflet_triangles)
                return drawn;
        }
    Shell polygon = coarse_lamina_shell(leaflet, bent, 1);
    if (polygon.triangles.size() <= fan) return polygon;
    return foliage_shell(leaflet, bent, fan, Preserved::area);
}

}  // namespace

LeafShape leaflet_of(const LeafShape& compound) {
    LeafShape leaflet = compound;
    leaflet.leaflets = {};
    leaflet.length = 1.0;
    leaflet.curl_deg *= leaflet_curl;
    leaflet.bow = 0.0;
    return leaflet;
}

Shell compound_shell(const LeafShape& shape, int lod) {
    LeafShape axis = shape;
    axis.fold_deg = axis.wave = 0.0;
    const Bending bent(axis);
    const Shell leaflet = leaflet_shell(shape, lod);
    Shell shell;
    for (const PlacedLeaflet& one : placed_leaflets(shape.leaflets)) {
        const auto shift = static_cast<std::uint32_t>(shell.places.size());
        // Leaflets turn with the axis, but are not bent with it: they may be longer than its radius
        // of curvature.
        const SineCosine turn = sine_cosine(radians(shape.curl_deg) * one.at);
        const glm::dvec3 root = bent.at({0.0, one.at}, 0.0), up(0.0, turn.cosine, turn.sine),
                         on(0.0, -turn.sine, turn.cosine);
        for (std::size_t i = 0; i < leaflet.places.size(); ++i) {
            glm::dvec3 place = one.place(leaflet.places[i]);
            // All but the last, which goes on along the axis.
            const double out = leaflet.places[i].z * std::sqrt(std::max(0.0, 1.0 - one.along.z));
            place.z += sweep * one.size * out * out;
            shell.add(root + glm::dvec3(place.x, 0.0, 0.0) + place.y * up + (place.z - one.at) * on,
                      glm::dvec2(leaflet.texture[i]));
        }
        for (const auto& t : leaflet.triangles)
            shell.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
    }
    add_axis(shape, bent, lod, shell);
    return shell;
}

LeafCount count_of_compound(const LeafShape& shape, int lod) {
    const auto [sides, before, after] = axis_levels[static_cast<std::size_t>(lod)];
    const auto count = static_cast<std::uint64_t>(shape.leaflets.count);
    const Shell leaflet = leaflet_shell(shape, lod);
    return {count * leaflet.places.size() + (before + after) * (sides + 1ULL) + sides + 2,
            count * leaflet.triangles.size() + 2ULL * sides * (before + after)};
}

LeafShape star_of(const LeafShape& compound) {
    const Leaflets& leaflets = compound.leaflets;
    LeafShape star = compound;
    star.leaflets = {};
    star.venation = {.lobes = {1},
                     .nodes = 3,
                     .node_loss = 1.0,
                     .vein_deg = 45.0,
                     .side_deg = std::clamp(0.75 * leaflets.angle_deg, 30.0, 60.0),
                     .base_deg = 0.0,
                     .law = LengthLaw::constant,
                     .rise = 0.0,
                     .side_length = 1.0 + 2.0 * leaflets.length,
                     .narrow_base = std::min(leaflets.narrow_base, 0.5),
                     .narrow_tip = std::min(leaflets.narrow_tip, 0.5),
                     .border = 1.0,
                     .sinus = 0.3,
                     .smooth = 0.0,
                     .pointed = 1.0};
    return star;
}

}  // namespace sporeprint
