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

namespace sporeprint {

namespace {

constexpr double petiole_radius = 0.011, petiole_reach = 0.12;  // in lengths of the lamina
constexpr double faces_height = 0.9;  // of the image, above the petiole's strip

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
        if (corners <= 30) return {4, {0.0, 0.1, 0.4, 0.75, 1.0}, 2, 6, 5};
        if (corners <= 60) return {3, {0.0, 0.15, 0.6, 1.0}, 1, 6, 5};
        if (corners <= 80) return {3, {0.0, 0.3, 1.0}, 1, 6, 5};
        return {2, {0.0, 0.3, 1.0}, 1, 6, 5};
    }
    if (lod == 1) {
        if (corners <= 30) return {2, {0.0, 0.5, 1.0}, 0, 4, 3};
        return {1, {0.0, 0.6, 1.0}, 0, 4, 3};
    }
    return {1, {0.0, 1.0}, 0, 3, 2};
}

// The middle surface: folded about the middle vein, with waves, bent along it. Unit: length of the
// lamina.
class Bending {
  public:
    explicit Bending(const LeafShape& shape)
        : shape_(shape),
          fold_(sine_cosine(shape.fold_deg * (pi / 180.0))),
          curl_(shape.curl_deg * (pi / 180.0)) {}

    [[nodiscard]] glm::dvec3 at(const glm::dvec2& place, double lift) const {
        constexpr double soft = 0.04;
        const double x = place.x, y = place.y;
        const double across = std::sqrt(x * x + soft * soft) - soft;
        double up = lift + across * fold_.sine;
        const SineCosine phase = sine_cosine(2.0 * pi * shape_.waves * y);
        up += shape_.wave * 0.6 * (x * x * phase.sine + x * std::abs(x) * phase.cosine);
        const double side = x * fold_.cosine;
        if (std::abs(curl_) < 1e-9) return {-side, up, y};
        // Relief on the inner side of the bend must not reach the centre of curvature.
        up /= 1.0 + std::max(0.0, -curl_ * up);
        const SineCosine turn = sine_cosine(curl_ * y);
        return {-side, (turn.cosine - 1.0) / curl_ + up * turn.cosine,
                turn.sine / curl_ + up * turn.sine};
    }

  private:
    const LeafShape& shape_;
    SineCosine fold_;
    double curl_;
};

void throw_if_invalid(const LeafShape& shape) {
    std::vector<Problem> problems;
    check(shape, Info{.name = ""}, "", problems);
    if (!problems.empty()) throw InvalidInput(std::move(problems));
}

// A mesh under construction. Positions are in lengths of the lamina until the end, so that normals
// are equally exact for small and large leaves.
struct Shell {
    std::vector<glm::dvec3> places;
    std::vector<glm::vec2> texture;
    std::vector<std::array<std::uint32_t, 3>> triangles;

    std::uint32_t add(const glm::dvec3& place, const glm::dvec2& texture_point) {
        places.push_back(place);
        texture.emplace_back(glm::clamp(texture_point, 0.0, 1.0));
        return static_cast<std::uint32_t>(places.size() - 1);
    }

    [[nodiscard]] Mesh mesh(double scale) const {
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
};

// Adds a tube that starts at a point under the middle vein and ends, slightly thicker, in a disc at
// the pivot.
void add_petiole(const LeafShape& shape, const Bending& bent, const Level& level, Shell& shell) {
    const auto sides = static_cast<std::size_t>(level.petiole_sides);
    const auto rings = static_cast<std::size_t>(level.petiole_rings);
    const double deep = std::max(0.5 * shape.thickness, 0.4 * petiole_radius);
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

LeafChart chart_of(const Lamina& lamina) {
    glm::dvec2 low(0.0), high(0.0);
    for (const glm::dvec2& place : border_of(lamina)) {
        low = glm::min(low, place);
        high = glm::max(high, place);
    }
    return {low, std::min(0.48 / (high.x - low.x), faces_height / (high.y - low.y))};
}

int leaf_steps(const Venation& venation, int lod) { return level_of(venation, lod).steps; }

namespace {

double area_of(const std::vector<glm::dvec2>& border) {
    double twice = 0.0;
    for (std::size_t i = 0; i < border.size(); ++i) {
        const glm::dvec2 a = border[i], b = border[(i + 1) % border.size()];
        twice += a.x * b.y - a.y * b.x;
    }
    return 0.5 * twice;
}

double twice_area(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Returns the right half of a border, from the root to the tip, reduced to `count` corners: the
// corner whose removal changes the area least is removed first. All remain visible from the centre.
std::vector<glm::dvec2> simplified(std::vector<glm::dvec2> half, const glm::dvec2& centre,
                                   std::size_t count) {
    const auto ahead = [&](std::size_t a, std::size_t b) {
        return twice_area(centre, half[a], half[b]) > 1e-6;
    };
    // Of two corners in the same direction from the centre the nearer one is removed.
    for (std::size_t i = 0; i + 1 < half.size();) {
        if (ahead(i, i + 1) || half.size() == 2) {
            ++i;
            continue;
        }
        const bool first_goes =
            i > 0 && (i + 2 == half.size() ||
                      glm::distance(half[i], centre) < glm::distance(half[i + 1], centre));
        half.erase(half.begin() + static_cast<long>(first_goes ? i : i + 1));
        i -= i > 0 ? 1 : 0;
    }
    while (half.size() > count) {
        std::size_t least = 0;
        double smallest = 1e300;
        for (std::size_t i = 1; i + 1 < half.size(); ++i) {
            if (!ahead(i - 1, i + 1)) continue;
            const double loss = std::abs(twice_area(half[i - 1], half[i], half[i + 1]));
            if (loss >= smallest) continue;
            smallest = loss;
            least = i;
        }
        if (least == 0) break;
        half.erase(half.begin() + static_cast<long>(least));
    }
    return half;
}

}  // namespace

double lamina_area(const LeafShape& shape) {
    return area_of(border_of(lamina_of(shape.venation, leaf_steps(shape.venation, 0)))) *
           shape.length * shape.length;
}

namespace {

/// The property of the lamina that a polygon of few corners preserves.
enum class Preserved {
    area,   ///< seen from above; bays of the border make it shorter
    extent  ///< length and width; the area as far as moving other corners allows
};

/// Scales the right half of a border, from the root to the tip, to the length and width of the
/// whole border, and moves the corners that are neither widest nor tip inwards until the areas are
/// equal.
void stretch(std::vector<glm::dvec2>& half, glm::dvec2& centre,
             const std::vector<glm::dvec2>& whole) {
    glm::dvec2 low(0.0), high(0.0);
    for (const glm::dvec2& place : whole) {
        low = glm::min(low, place);
        high = glm::max(high, place);
    }
    const auto widest = static_cast<std::size_t>(
        std::max_element(half.begin(), half.end(),
                         [](const glm::dvec2& a, const glm::dvec2& b) { return a.x < b.x; }) -
        half.begin());
    double lowest = 0.0, highest = 0.0;
    for (const glm::dvec2& place : half) {
        lowest = std::min(lowest, place.y);
        highest = std::max(highest, place.y);
    }
    if (half[widest].x < 1e-9 || highest < 1e-9) return;
    const double wider = high.x / half[widest].x, longer = high.y / highest,
                 deeper = lowest < -1e-9 ? std::clamp(low.y / lowest, 0.5, 2.0) : 1.0;
    for (glm::dvec2& place : half) {
        place.x *= wider;
        place.y *= place.y < 0.0 ? deeper : longer;
    }
    centre.y *= longer;
    // Twice the area of the half is the sum over its corners of x times the difference in y of the
    // two neighbours.
    double fixed = 0.0, drawn = 0.0;
    for (std::size_t i = 1; i + 1 < half.size(); ++i)
        (i == widest ? fixed : drawn) += half[i].x * (half[i + 1].y - half[i - 1].y);
    if (drawn <= 0.0) return;
    double share = std::clamp((area_of(whole) - fixed) / drawn, 0.2, 1.0);
    const std::vector<glm::dvec2> before = half;
    for (int tries = 0; tries < 8; ++tries, share += 0.3 * (1.0 - share)) {
        bool seen = true;
        for (std::size_t i = 1; i + 1 < half.size(); ++i)
            half[i].x = (i == widest ? 1.0 : share) * before[i].x;
        for (std::size_t i = 0; i + 1 < half.size(); ++i)
            seen = seen && twice_area(centre, half[i], half[i + 1]) > 1e-6;
        if (seen) return;
    }
    half = before;
}

// Returns the lamina alone, root at the origin.
Shell foliage_shell(const LeafShape& shape, const Bending& bent, std::size_t triangles,
                    Preserved preserved) {
    const Lamina lamina = lamina_of(shape.venation, leaf_steps(shape.venation, 0));
    // The border is straight between the ends of veins; otherwise all corners would be spent on the
    // bays of a frond.
    Venation plain = shape.venation;
    plain.sinus = plain.teeth = 0.0;
    const Lamina outline = lamina_of(plain, plain.lobes.value == 1 ? 2 : 1);
    const Lobe& middle = outline.lobes[outline.lobes.size() / 2];
    glm::dvec2 centre(0.0, outline.lobes.size() > 1 ? 0.3 : 0.5);
    const glm::dvec2 tip = middle.place(0, middle.reach, 0.0);
    std::vector<glm::dvec2> half;
    for (const glm::dvec2& place : border_of(outline)) {
        half.push_back(place);
        if (place == tip) break;
    }
    // Four triangles are a kite on either face, more are fans about a centre.
    const bool kite = triangles == 4;
    std::vector<glm::dvec2> border = simplified(half, centre, kite ? 3 : triangles / 4 + 1);
    const std::vector<glm::dvec2> whole = border_of(lamina);
    if (preserved == Preserved::extent) stretch(border, centre, whole);
    for (std::size_t i = border.size() - 2; i > 0; --i)
        border.emplace_back(-border[i].x, border[i].y);
    const double grown =
        preserved == Preserved::area ? std::sqrt(area_of(whole) / area_of(border)) : 1.0;
    const LeafChart chart = chart_of(lamina);
    Shell shell;
    const auto count = static_cast<std::uint32_t>(border.size());
    for (const bool upper : {true, false}) {
        for (const glm::dvec2& place : border)
            shell.add(bent.at(grown * place, 0.0), chart.texture_point(place, upper));
        if (kite) continue;
        const double lift = upper ? 0.5 * shape.thickness : -0.5 * shape.thickness;
        shell.add(bent.at(grown * centre, lift), chart.texture_point(centre, upper));
    }
    if (kite) {
        shell.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 6, 5}, {4, 7, 6}};
        return shell;
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t next = (i + 1) % count, below = count + 1;
        shell.triangles.push_back({i, next, count});
        shell.triangles.push_back({below + next, below + i, below + count});
    }
    return shell;
}

}  // namespace

Mesh foliage_leaf(const LeafShape& shape, std::size_t triangles) {
    throw_if_invalid(shape);
    if (triangles < 4 || triangles > most_foliage_triangles || triangles % 4 != 0)
        throw InvalidInput("/triangles", std::to_string(triangles) + " is not 4, 8, 12 or 16");
    return foliage_shell(shape, Bending(shape), triangles, Preserved::area).mesh(shape.length);
}

namespace {

// Returns both faces on the grid of a level.
Shell lamina_shell(const LeafShape& shape, const Bending& bent, const Level& level) {
    const Lamina lamina = lamina_of(shape.venation, level.steps);
    const LeafChart chart = chart_of(lamina);
    const LaminaMesh flat = lamina_mesh(lamina, level.rows, level.fill);
    Shell shell;
    const auto count = static_cast<std::uint32_t>(flat.vertices.size());
    for (const bool upper : {true, false})
        for (const LaminaVertex& vertex : flat.vertices) {
            double lift = 0.0;
            if (!vertex.rim && &vertex != flat.vertices.data()) {
                lift = shape.relief * (0.012 * vertex.swell - 0.008 * vertex.groove);
                lift += upper ? 0.5 * shape.thickness
                              : -0.5 * shape.thickness - shape.relief * 0.012 * vertex.rib;
            }
            shell.add(bent.at(vertex.place, lift), chart.texture_point(vertex.place, upper));
        }
    for (const auto& t : flat.triangles) shell.triangles.push_back(t);
    for (const auto& t : flat.triangles)
        shell.triangles.push_back({t[0] + count, t[2] + count, t[1] + count});
    return shell;
}

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

Mesh leaf_mesh(const LeafShape& shape, int lod, double size) {
    throw_if_invalid(shape);
    if (lod < 0 || lod >= leaf_lods)
        throw InvalidInput("/lod",
                           std::to_string(lod) + " is outside 0.." + std::to_string(leaf_lods - 1));
    const Level level = level_of(shape.venation, lod);
    const Bending bent(shape);
    Shell shell = lamina_shell(shape, bent, level);
    if (lod + 1 == leaf_lods && shell.triangles.size() > most_foliage_triangles) {
        Shell far = foliage_shell(shape, bent, most_foliage_triangles, Preserved::extent);
        fit_to(shell, far);
        shell = std::move(far);
    }
    add_petiole(shape, bent, level, shell);
    for (glm::dvec3& place : shell.places) place.z += shape.petiole;
    return shell.mesh(shape.length * size);
}

LeafCount most_of_leaf(const Venation& venation, int lod) {
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
    const int places = std::max(level.steps, toothed ? 2 * venation.teeth_per_vein : 0);
    const std::uint64_t abscissas =
        between * static_cast<std::uint64_t>(places) + 6 + level.fill * (nodes + 1);
    const std::uint64_t rows = level.rows.size();
    // Both halves of a lobe share their main vein, neighbours the ray between them; either line has
    // the abscissas of both sides.
    count.vertices += 2 * lobes * (2 * abscissas * (rows - 1) + 4 * abscissas);
    count.triangles += 2 * lobes * (2 * abscissas * 2 * (rows - 1) + 8 * abscissas);
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
    // Angles that would leave too little space for the lobes keep their original values.
    std::vector<Problem> problems;
    veins.check("", problems);
    if (problems.empty()) return leaf;
    veins.side_deg = shape.venation.side_deg;
    veins.vein_deg = shape.venation.vein_deg;
    return leaf;
}

}  // namespace sporeprint
