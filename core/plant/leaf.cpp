#include "core/plant/leaf.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/mesh/tangents.h"
#include "core/plant/lamina.h"
#include "core/plant/leaf_damage.h"
#include "core/plant/leaf_shell.h"

namespace sporeprint {

namespace {

constexpr double petiole_radius = 0.011, petiole_reach = 0.12;  // in lengths of the lamina
constexpr double thickest = 0.9;  // half the thickness of a lamina, at most, in its half breadth
constexpr double bow_variation = 0.05;  // of individuals, as a standard deviation
constexpr double faces_height = 0.9;    // of the image, above the petiole's strip
constexpr double small_lamina = 0.47;   // beside sprays, by its size without them

// By level of detail: lengths of edges about what is eaten, in radii of a spot, of which the first one
// is taken that is not too many; vertices and triangles of a face for each spot at most. Coarser levels
// have no openings.
constexpr int open_lods = 2;
constexpr std::array<std::array<double, 4>, open_lods> fineness = {
    {{0.5, 0.7, 1.0, 1.5}, {0.9, 1.3, 1.8, 3.0}}};
constexpr std::array<std::size_t, open_lods> spot_vertices = {120, 20}, spot_triangles = {200, 28};

struct Level {
    int steps;
    std::vector<double> rows;
    std::size_t fill;
    int petiole_sides, petiole_rings;
};

// Returns the resolution of a level of detail: the more corners a border has, the fewer triangles
// each gets.
Level level_of(const Venation& venation, int lod) {
    int corners = 0;
    for (int j = 0; j <= venation.lobes.value / 2; ++j) {
        const int nodes = std::max(2, venation.nodes - static_cast<int>(venation.node_loss * j));
        corners += (j == 0 ? 2 : 4) * (venation.sinus > 0.0 ? 2 : 1) * nodes;
    }
    if (lod == 0) {
        if (corners <= 30) return {8, {0.0, 0.12, 0.55, 1.0}, 2, 8, 7};
        if (corners <= 60) return {6, {0.0, 0.15, 0.6, 1.0}, 1, 8, 7};
        if (corners <= 100) return {6, {0.0, 0.3, 1.0}, 1, 8, 7};
        return {2, {0.0, 0.3, 1.0}, 1, 6, 5};
    }
    if (lod == 1) {
        if (corners <= 30) return {2, {0.0, 0.5, 1.0}, 0, 4, 3};
        return {1, {0.0, 0.6, 1.0}, 0, 4, 3};
    }
    return {1, {0.0, 1.0}, 0, 3, 2};
}

}  // namespace

void throw_if_invalid(const LeafShape& shape) {
    std::vector<Problem> problems;
    check(shape, Info{.name = ""}, "", problems);
    if (!problems.empty()) throw InvalidInput(std::move(problems));
}

Mesh Shell::mesh(double scale) const {
    std::vector<glm::dvec3> normals(places.size(), glm::dvec3(0.0));
    Mesh mesh;
    mesh.indices.reserve(3 * triangles.size());
    for (const auto& t : triangles) {
        const glm::dvec3 across =
            glm::cross(places[t[1]] - places[t[0]], places[t[2]] - places[t[0]]);
        for (const std::uint32_t corner : t) {
            normals[corner] += across;
            mesh.indices.push_back(corner);
        }
    }
    for (std::size_t i = 0; i < places.size(); ++i) {
        const double size = glm::length(normals[i]);
        if (!(size > 0.0)) throw GenerationError("a vertex of a leaf has no normal");
        mesh.positions.emplace_back(scale * places[i]);
        mesh.normals.emplace_back(normals[i] / size);
    }
    mesh.texture_coordinates = texture;
    add_tangents(mesh);
    return mesh;
}

namespace {

// Adds a tube that starts at a point under the middle vein and ends, slightly thicker, in a disc at
// the pivot.
void add_petiole(const LeafShape& shape, const Bending& bent, const Level& level, Shell& shell) {
    const auto sides = static_cast<std::size_t>(level.petiole_sides);
    const auto rings = static_cast<std::size_t>(level.petiole_rings);
    // However thick the lamina is in its middle, it is thin at its root, where the petiole meets it.
    const double deep =
        std::clamp(0.5 * shape.thickness, 0.4 * petiole_radius, 0.5 * petiole_radius);
    const auto texture = [&](double along, double round) {
        return glm::dvec2(0.01 + 0.98 * along,
                          petiole_strip + 0.01 + (0.98 - petiole_strip) * round);
    };
    std::vector<std::vector<std::uint32_t>> rows;
    for (std::size_t i = 0; i < rings; ++i) {
        // The first ring lies under the root, the last at the pivot.
        const double share = static_cast<double>(i) / static_cast<double>(rings - 1);
        const double radius = petiole_radius * (0.8 + 0.6 * share * share);
        std::vector<std::uint32_t> row;
        for (std::size_t k = 0; k <= sides; ++k) {
            const double round = static_cast<double>(k % sides) / static_cast<double>(sides);
            const SineCosine at = sine_cosine(2.0 * pi * round);
            row.push_back(shell.add(
                {radius * at.cosine, radius * at.sine - deep, -share * shape.petiole},
                texture(0.1 + 0.85 * share, static_cast<double>(k) / static_cast<double>(sides))));
        }
        rows.push_back(std::move(row));
    }
    const std::uint32_t point = shell.add(bent.at({0.0, petiole_reach}, -deep), texture(0.0, 0.5));
    for (std::size_t k = 0; k < sides; ++k)
        shell.triangles.push_back({rows[0][k], rows[0][k + 1], point});
    for (std::size_t i = 0; i + 1 < rings; ++i)
        for (std::size_t k = 0; k < sides; ++k) {
            shell.triangles.push_back({rows[i + 1][k], rows[i + 1][k + 1], rows[i][k + 1]});
            shell.triangles.push_back({rows[i + 1][k], rows[i][k + 1], rows[i][k]});
        }
    const double end = -shape.petiole;
    const std::uint32_t middle = shell.add({0.0, -deep, end}, texture(1.0, 0.5));
    std::vector<std::uint32_t> rim;
    for (std::size_t k = 0; k < sides; ++k)
        rim.push_back(
            shell.add(shell.places[rows.back()[k]],
                      texture(0.97, static_cast<double>(k) / static_cast<double>(sides))));
    for (std::size_t k = 0; k < sides; ++k)
        shell.triangles.push_back({rim[(k + 1) % sides], rim[k], middle});
}

}  // namespace

glm::dvec2 LeafChart::texture_point(const glm::dvec2& place, bool upper) const {
    const glm::dvec2 in = scale * (place - corner);
    return {in.x + (upper ? 0.01 : 0.51), faces_height + 0.01 - in.y};
}

glm::dvec2 LeafChart::place(const glm::dvec2& texture_point, bool& upper) const {
    upper = texture_point.x < 0.5;
    return corner + glm::dvec2(texture_point.x - (upper ? 0.01 : 0.51),
                               faces_height + 0.01 - texture_point.y) /
                        scale;
}

LeafChart chart_of(const Lamina& lamina, LeafLayout layout) {
    glm::dvec2 low(0.0), high(0.0);
    for (const glm::dvec2& place : border_of(lamina)) {
        low = glm::min(low, place);
        high = glm::max(high, place);
    }
    return {low, (layout == LeafLayout::with_sprays ? small_lamina : 1.0) *
                     std::min(0.48 / (high.x - low.x), faces_height / (high.y - low.y))};
}

double half_breadth(const Lamina& lamina) {
    double half = 0.0;
    for (const glm::dvec2& place : border_of(lamina)) half = std::max(half, std::abs(place.x));
    return half;
}

bool is_slim(const Lamina& lamina) {
    constexpr double slim = 0.045;
    return half_breadth(lamina) < slim;
}

int leaf_steps(const Venation& venation, int lod) { return level_of(venation, lod).steps; }

std::vector<EatenSpot> spots_of(const LeafShape& shape, std::uint32_t seed) {
    if (shape.leaflets.count > 0 || !(shape.eaten > 0.0)) return {};
    return eaten_spots(lamina_of(shape.venation, leaf_steps(shape.venation, 0)), shape.eaten, seed);
}

namespace {

/// Cuts spots out as finely as the level of detail allows.
void cut_out_spots(LaminaMesh& lamina, const std::vector<EatenSpot>& spots, int lod) {
    if (spots.empty()) return;
    const auto level = static_cast<std::size_t>(lod);
    for (const double fine : fineness[level]) {
        LaminaMesh open = lamina;
        cut_out(open, spots, fine);
        if (open.vertices.size() > lamina.vertices.size() + spots.size() * spot_vertices[level] ||
            open.triangles.size() > lamina.triangles.size() + spots.size() * spot_triangles[level])
            continue;
        lamina = std::move(open);
        return;
    }
}

/// Returns both faces of a flat lamina, bent and with its thickness.
Shell faces_shell(const LeafShape& shape, const Bending& bent, const LaminaMesh& flat) {
    const LeafChart chart = chart_of(lamina_of(shape.venation, leaf_steps(shape.venation, 0)));
    Shell shell;
    const auto count = static_cast<std::uint32_t>(flat.vertices.size());
    for (const bool upper : {true, false})
        for (const LaminaVertex& vertex : flat.vertices) {
            double lift = 0.0;
            if (!vertex.rim && &vertex != flat.vertices.data()) {
                lift = shape.relief * (0.012 * vertex.swell - 0.008 * vertex.groove);
                const double half = std::min(0.5 * shape.thickness, thickest * vertex.breadth);
                lift += upper ? half : -half - shape.relief * 0.012 * vertex.rib;
            }
            shell.add(bent.at(vertex.place, lift), chart.texture_point(vertex.place, upper));
        }
    for (const auto& t : flat.triangles) shell.triangles.push_back(t);
    for (const auto& t : flat.triangles)
        shell.triangles.push_back({t[0] + count, t[2] + count, t[1] + count});
    return shell;
}

}  // namespace

Shell lamina_shell(const LeafShape& shape, const Bending& bent, int lod, std::uint32_t seed) {
    const Level level = level_of(shape.venation, lod);
    const Lamina lamina = lamina_of(shape.venation, level.steps);
    LaminaMesh flat = lamina_mesh(lamina, level.rows, level.fill);
    if (lod < open_lods) cut_out_spots(flat, spots_of(shape, seed), lod);
    return faces_shell(shape, bent, flat);
}

Shell coarse_lamina_shell(const LeafShape& shape, const Bending& bent, int steps) {
    return faces_shell(shape, bent, lamina_mesh(lamina_of(shape.venation, steps), {0.0, 1.0}, 0));
}

namespace {

/// Scales a lamina of few corners, which approximates curl and waves coarsely, to the bounding box
/// of another; the root stays in place.
void fit_to(const Shell& like, Shell& shell) {
    const auto box = [](const Shell& one) {
        std::array<glm::dvec3, 2> corners = {glm::dvec3(0.0), glm::dvec3(0.0)};
        for (const glm::dvec3& place : one.places) {
            corners[0] = glm::min(corners[0], place);
            corners[1] = glm::max(corners[1], place);
        }
        return corners;
    };
    const std::array<glm::dvec3, 2> wanted = box(like), own = box(shell);
    std::array<glm::dvec3, 2> scale = {glm::dvec3(1.0), glm::dvec3(1.0)};
    for (std::size_t end = 0; end < 2; ++end)
        for (int axis = 0; axis < 3; ++axis)
            if (std::abs(own[end][axis]) > 1e-3)
                scale[end][axis] = std::clamp(wanted[end][axis] / own[end][axis], 0.4, 4.0);
    for (glm::dvec3& place : shell.places)
        for (int axis = 0; axis < 3; ++axis)
            place[axis] *= scale[place[axis] < 0.0 ? 0U : 1U][axis];
    // Folds between its corners may reach above all of them, so the highest corner on either side
    // is raised to that height.
    double top = 0.0, highest = -1e9;
    const auto beside = [](const glm::dvec3& place) { return std::abs(place.x) > 1e-6; };
    for (const glm::dvec3& place : shell.places) {
        top = std::max(top, place.y);
        if (beside(place)) highest = std::max(highest, place.y);
    }
    if (top > wanted[1].y - 1e-9) return;
    for (glm::dvec3& place : shell.places)
        if (beside(place) && place.y > highest - 1e-9) place.y = wanted[1].y;
}

}  // namespace

Mesh leaf_mesh(const LeafShape& shape, int lod, double size, std::uint32_t seed) {
    throw_if_invalid(shape);
    if (lod < 0 || lod >= leaf_lods)
        throw InvalidInput("/lod",
                           std::to_string(lod) + " is outside 0.." + std::to_string(leaf_lods - 1));
    if (shape.leaflets.count > 0) {
        Shell compound = compound_shell(shape, lod);
        for (glm::dvec3& place : compound.places) place.z += shape.petiole;
        return compound.mesh(shape.length * size);
    }
    const Level level = level_of(shape.venation, lod);
    const Bending bent(shape);
    Shell shell = lamina_shell(shape, bent, lod, seed);
    if (lod + 1 == leaf_lods && shell.triangles.size() > most_foliage_triangles) {
        Shell far = foliage_shell(shape, bent, most_foliage_triangles, Preserved::extent);
        fit_to(shell, far);
        shell = std::move(far);
    }
    add_petiole(shape, bent, level, shell);
    for (glm::dvec3& place : shell.places) place.z += shape.petiole;
    return shell.mesh(shape.length * size);
}

LeafCount most_of_leaf(const LeafShape& shape, int lod) {
    if (shape.leaflets.count > 0) return count_of_compound(shape, lod);
    const Venation& venation = shape.venation;
    const Level level = level_of(venation, lod);
    const auto sides = static_cast<std::uint64_t>(level.petiole_sides);
    const auto rings = static_cast<std::uint64_t>(level.petiole_rings);
    LeafCount count{rings * (sides + 1) + sides + 2, 2 * sides * rings};
    // The polygon of a needle has fewer corners, with at most two per triangle.
    if (lod + 1 == leaf_lods)
        return {count.vertices + 2 * most_foliage_triangles,
                count.triangles + most_foliage_triangles};
    // Abscissas of half a lobe: the corners of its border and those between them, where it is
    // joined to its neighbour, and filled ones.
    const auto nodes = static_cast<std::uint64_t>(venation.nodes);
    const auto lobes = static_cast<std::uint64_t>(venation.lobes.value);
    const std::uint64_t between =
        (venation.sinus > 0.0 ? 2 : 1) * std::max<std::uint64_t>(nodes, 2);
    const bool toothed = level.steps > 1 && venation.teeth > 0.0;
    const int places =
        std::max(level.steps, toothed ? tooth_edges(level.steps) * venation.teeth_per_vein : 0);
    const std::uint64_t abscissas =
        between * static_cast<std::uint64_t>(places) + 10 + level.fill * (nodes + 1);
    const std::uint64_t rows = level.rows.size();
    // Both halves of a lobe share their main vein, neighbours the ray between them; either line has
    // the abscissas of both sides.
    count.vertices += 2 * lobes * (2 * abscissas * (rows - 1) + 4 * abscissas);
    count.triangles += 2 * lobes * (2 * abscissas * 2 * (rows - 1) + 8 * abscissas);
    if (lod < open_lods) {
        const auto spots = static_cast<std::uint64_t>(most_eaten_spots(shape.eaten));
        count.vertices += 2 * spots * spot_vertices[static_cast<std::size_t>(lod)];
        count.triangles += 2 * spots * spot_triangles[static_cast<std::size_t>(lod)];
    }
    return count;
}

LeafShape individual_leaf(const LeafShape& shape, std::uint32_t seed, double variation) {
    Random random(seed, purposes::leaf_variation);
    const auto departure = [&] {
        const double drawn = random.normal();
        return variation * std::clamp(drawn, -2.5, 2.5);
    };
    const auto within = [](const Info& info, double value) {
        return std::clamp(value, info.min, info.max);
    };
    LeafShape leaf = shape;
    const auto scaled = [&](const char* name, double value, double spread) {
        const double by = departure();
        return within(info_of<LeafShape>(name), value * exponential(spread * by));
    };
    const auto turned = [&](const Info& info, double value, double spread) {
        const double by = departure();
        return within(info, value + spread * by);
    };
    leaf.length = scaled("length", leaf.length, 0.15);
    leaf.petiole = scaled("petiole", leaf.petiole, 0.2);
    leaf.wave = scaled("wave", leaf.wave, 0.4);
    leaf.waves = scaled("waves", leaf.waves, 0.15);
    leaf.curl_deg = turned(info_of<LeafShape>("curl_deg"), leaf.curl_deg, 12.0);
    leaf.fold_deg = turned(info_of<LeafShape>("fold_deg"), leaf.fold_deg, 5.0);
    Venation& veins = leaf.venation;
    const double longer = departure();
    veins.side_length =
        within(info_of<Venation>("side_length"), veins.side_length * exponential(0.1 * longer));
    veins.side_deg = turned(info_of<Venation>("side_deg"), veins.side_deg, 2.5);
    veins.vein_deg = turned(info_of<Venation>("vein_deg"), veins.vein_deg, 2.5);
    leaf.bow = turned(info_of<LeafShape>("bow"), leaf.bow, bow_variation);
    // Angles that would leave too little space for the lobes keep their original values.
    std::vector<Problem> problems;
    veins.check("", problems);
    if (problems.empty()) return leaf;
    veins.side_deg = shape.venation.side_deg;
    veins.vein_deg = shape.venation.vein_deg;
    return leaf;
}

}  // namespace sporeprint
