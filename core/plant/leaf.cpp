#include "core/plant/leaf.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "core/math/elementary.h"
#include "core/math/random.h"
#include "core/mesh/tangents.h"
#include "core/model/purposes.h"

namespace sporeprint {

namespace {

constexpr double petiole_radius = 0.011, petiole_reach = 0.12;  // in lengths of the limb
constexpr double least_foot_gap = 4e-3;
constexpr double faces_height = 0.9;  // of the image, above the petiole's strip

// --- The limb in its plane ----------------------------------------------------------------------

struct Flat {
    glm::dvec2 place{0.0};
    double affinity = 0.0;
    bool rim = false;
    double groove = 0.0;  ///< 0..1: how deep a vein lies here
    double rib = 0.0;     ///< 0..1: how far it stands out below
    double swell = 0.0;   ///< 0..1: how far the limb rises between veins
};

struct FlatLimb {
    std::vector<Flat> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise from above
};

// Lays a grid of feet and affinities over each half and closes the gaps between grids: along the main vein and along the rays
// between lobes both sides share the places of either.
class FlatMaker {
  public:
    FlatMaker(const Limb& limb, std::vector<double> rows, std::size_t fill)
        : limb_(limb), rows_(std::move(rows)) {
        const std::size_t lobes = limb.lobes.size();
        for (std::size_t i = 0; i < lobes; ++i)
            for (std::size_t side = 0; side < 2; ++side)
                feet_.push_back(feet_of(limb.lobes[i], limb.lobes[i].halves[side], fill));
        root_ = add({});
        for (std::size_t i = 0; i + 1 < lobes; ++i) seams_.push_back(seam(i));
        for (std::size_t i = 0; i < lobes; ++i) {
            const Line middle = main_vein(i);
            half(i, 0, middle);
            half(i, 1, middle);
        }
    }

    FlatLimb take() { return std::move(made_); }

  private:
    // Vertices along a line, by how far along it they lie.
    struct Line {
        std::vector<double> at;
        std::vector<std::uint32_t> vertices;

        // Those from one place to another, both included.
        [[nodiscard]] std::vector<std::uint32_t> between(double from, double to) const {
            std::vector<std::uint32_t> found;
            for (std::size_t i = 0; i < at.size(); ++i)
                if (at[i] >= from - tolerance && at[i] <= to + tolerance)
                    found.push_back(vertices[i]);
            return found;
        }
    };
    static constexpr double tolerance = 1e-7;

    static std::vector<double> feet_of(const Lobe& lobe, const HalfLobe& half, std::size_t fill) {
        std::vector<double> feet = half.feet;
        const auto put = [&](double foot) {
            const auto after = std::lower_bound(feet.begin(), feet.end(), foot);
            if (after == feet.begin() || after == feet.end()) return;
            if (*after - foot < least_foot_gap * lobe.reach ||
                foot - *(after - 1) < least_foot_gap * lobe.reach)
                return;
            feet.insert(after, foot);
        };
        if (fill == 0) return feet;
        std::vector<double> veins = {0.0};
        for (const HalfLobe::SideVein& vein : half.side_veins) veins.push_back(vein.foot);
        veins.push_back(lobe.nodes.back());
        for (std::size_t i = 1; i < veins.size(); ++i) {
            for (std::size_t k = 1; k < fill; ++k)
                put(veins[i - 1] +
                    (veins[i] - veins[i - 1]) * static_cast<double>(k) / static_cast<double>(fill));
            put(veins[i]);
        }
        return feet;
    }

    std::uint32_t add(const Flat& vertex) {
        made_.vertices.push_back(vertex);
        return static_cast<std::uint32_t>(made_.vertices.size() - 1);
    }

    void triangle(bool mirrored, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        if (mirrored)
            made_.triangles.push_back({a, c, b});
        else
            made_.triangles.push_back({a, b, c});
    }

    static void tidy(std::vector<double>& sorted) {
        std::sort(sorted.begin(), sorted.end());
        sorted.erase(std::unique(sorted.begin(), sorted.end(),
                                 [](double a, double b) { return b - a < tolerance; }),
                     sorted.end());
    }

    Line main_vein(std::size_t lobe) {
        const Lobe& one = limb_.lobes[lobe];
        Line line{feet_[2 * lobe], {}};
        line.at.insert(line.at.end(), feet_[2 * lobe + 1].begin(), feet_[2 * lobe + 1].end());
        tidy(line.at);
        for (std::size_t i = 0; i < line.at.size(); ++i) {
            Flat vertex;
            vertex.place = one.place(0, line.at[i], 0.0);
            const double share = line.at[i] / one.reach;
            vertex.groove = 1.0 - share;
            vertex.rib = 1.0 - 0.9 * share;
            vertex.rim = i + 1 == line.at.size();
            line.vertices.push_back(i == 0 ? root_ : add(vertex));
        }
        return line;
    }

    // The ray between a lobe and the next: by distance from the root.
    Line seam(std::size_t lobe) {
        const Lobe& right = limb_.lobes[lobe];
        Line line;
        for (std::size_t k = 0; k < 2; ++k) {
            const Lobe& one = limb_.lobes[lobe + k];
            const HalfLobe& half = one.halves[k];
            for (const double foot : feet_[2 * (lobe + k) + k])
                if (foot <= half.joined) line.at.push_back(distance(one, k, foot));
        }
        tidy(line.at);
        const SineCosine ray = sine_cosine(right.turn + right.halves[0].limit);
        for (std::size_t i = 0; i < line.at.size(); ++i) {
            Flat vertex;
            vertex.place = line.at[i] * glm::dvec2(-ray.sine, ray.cosine);
            vertex.affinity = 1.0;
            vertex.rim = i + 1 == line.at.size();
            line.vertices.push_back(i == 0 ? root_ : add(vertex));
        }
        return line;
    }

    static double distance(const Lobe& lobe, std::size_t side, double foot) {
        return glm::length(lobe.place(side, foot, lobe.halves[side].height(foot)));
    }

    void half(std::size_t lobe, std::size_t side, const Line& middle) {
        const Lobe& one = limb_.lobes[lobe];
        const HalfLobe& half = one.halves[side];
        const std::vector<double>& feet = feet_[2 * lobe + side];
        const bool mirrored = side == 1;
        const Line* seam = nullptr;
        if (half.joined > 0.0) seam = &seams_[side == 0 ? lobe : lobe - 1];
        // Vertices of each foot, from the first row off the main vein to the border.
        const std::size_t rows = rows_.size();
        std::vector<std::vector<std::uint32_t>> grid(feet.size());
        for (std::size_t i = 1; i + 1 < feet.size(); ++i)
            for (std::size_t k = 1; k < rows; ++k) {
                if (k + 1 == rows && seam != nullptr && feet[i] <= half.joined) {
                    const double t = distance(one, side, feet[i]);
                    grid[i].push_back(seam->between(t, t).front());
                    continue;
                }
                Flat vertex;
                vertex.place = one.place(side, feet[i], rows_[k] * half.height(feet[i]));
                vertex.affinity = rows_[k];
                vertex.rim = k + 1 == rows;
                relief(half, feet[i], rows_[k] * half.height(feet[i]), vertex);
                grid[i].push_back(add(vertex));
            }
        for (std::size_t i = 0; i + 1 < feet.size(); ++i) {
            const bool first = i == 0, last = i + 2 == feet.size();
            const std::vector<std::uint32_t> inner = middle.between(feet[i], feet[i + 1]);
            std::vector<std::uint32_t> outer;
            if (seam != nullptr && feet[i + 1] <= half.joined)
                outer =
                    seam->between(distance(one, side, feet[i]), distance(one, side, feet[i + 1]));
            else
                outer = {first ? root_ : grid[i].back(),
                         last ? middle.vertices.back() : grid[i + 1].back()};
            if (rows == 2) {
                const std::uint32_t apex = outer[first ? 1 : 0];
                for (std::size_t k = 1; k < inner.size(); ++k)
                    triangle(mirrored, inner[k - 1], inner[k], apex);
                if (last) continue;
                for (std::size_t k = first ? 2 : 1; k < outer.size(); ++k)
                    triangle(mirrored, inner.back(), outer[k], outer[k - 1]);
                continue;
            }
            const std::uint32_t low_apex = first ? grid[i + 1].front() : grid[i].front();
            for (std::size_t k = 1; k < inner.size(); ++k)
                triangle(mirrored, inner[k - 1], inner[k], low_apex);
            if (!first && !last)
                triangle(mirrored, inner.back(), grid[i + 1].front(), grid[i].front());
            for (std::size_t k = 1; k + 2 < rows; ++k) {
                const std::uint32_t a0 = first ? root_ : grid[i][k - 1];
                const std::uint32_t b0 = first ? root_ : grid[i][k];
                const std::uint32_t a1 = last ? middle.vertices.back() : grid[i + 1][k - 1];
                const std::uint32_t b1 = last ? middle.vertices.back() : grid[i + 1][k];
                if (!last) triangle(mirrored, a0, a1, b1);
                if (!first) triangle(mirrored, a0, b1, b0);
            }
            const std::uint32_t near_root = first ? root_ : grid[i][rows - 3];
            const std::uint32_t near_tip = last ? middle.vertices.back() : grid[i + 1][rows - 3];
            const std::uint32_t high_apex = first ? near_tip : near_root;
            for (std::size_t k = 1; k < outer.size(); ++k)
                triangle(mirrored, high_apex, outer[k], outer[k - 1]);
            if (!first && !last) triangle(mirrored, near_root, near_tip, outer.back());
        }
    }

    // Grooves over side veins, swells between them; nothing at the border.
    static void relief(const HalfLobe& half, double foot, double height, Flat& vertex) {
        const std::vector<HalfLobe::SideVein>& veins = half.side_veins;
        const double fade = 1.0 - vertex.affinity * vertex.affinity;
        double nearest = 1e9, gap = 1.0, length = 0.0;
        for (std::size_t i = 0; i < veins.size(); ++i) {
            const double away = std::abs(foot - veins[i].foot);
            if (away >= nearest) continue;
            nearest = away;
            length = veins[i].length;
            gap =
                foot < veins[i].foot
                    ? veins[i].foot - (i == 0 ? 0.0 : veins[i - 1].foot)
                    : (i + 1 < veins.size() ? veins[i + 1].foot : half.feet.back()) - veins[i].foot;
        }
        const double from_vein = std::min(nearest / (0.5 * std::max(gap, 1e-9)), 1.0);
        vertex.swell = from_vein * fade * std::min(1.0, 4.0 * vertex.affinity);
        if (from_vein < 0.05 && height < length) {
            vertex.groove = 0.6 * fade;
            vertex.rib = 0.5 * fade;
        }
    }

    const Limb& limb_;
    std::vector<double> rows_;
    std::vector<std::vector<double>> feet_;  ///< of each half: 2 lobe + side
    FlatLimb made_;
    std::uint32_t root_ = 0;
    std::vector<Line> seams_;
};

struct Level {
    int steps;
    std::vector<double> rows;
    std::size_t fill;
    int petiole_sides, petiole_rings;
};

// The more corners a border has, the less is spent on each.
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

// --- Out of the plane ----------------------------------------------------------------------------

// The middle surface: folded about the middle vein, waving, bent along it. Lengths of the limb.
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
        // What stands on the inner side of the bend never reaches its centre.
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

void refuse_faults(const LeafShape& shape) {
    std::vector<Problem> problems;
    check(shape, Info{.name = ""}, "", problems);
    if (!problems.empty()) throw InvalidInput(std::move(problems));
}

// Positions in lengths of the limb until the end, so that normals are as exact for needles as for palms.
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

// A tube that begins under the middle vein in a point and ends, a little thicker, in a disc at the pivot.
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

LeafChart chart_of(const Limb& limb) {
    glm::dvec2 low(0.0), high(0.0);
    for (const glm::dvec2& place : border_of(limb)) {
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

// Leaves `count` corners of the right half of a border, from the root to the tip, which stay: that whose loss changes the area
// least goes first. All are seen from the centre.
std::vector<glm::dvec2> simplified(std::vector<glm::dvec2> half, const glm::dvec2& centre,
                                   std::size_t count) {
    const auto ahead = [&](std::size_t a, std::size_t b) {
        return twice_area(centre, half[a], half[b]) > 1e-6;
    };
    // Of two corners that lie behind each other the one nearer to the centre goes.
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

double limb_area(const LeafShape& shape) {
    return area_of(border_of(limb_of(shape.venation, leaf_steps(shape.venation, 0)))) *
           shape.length * shape.length;
}

namespace {

// The limb alone, root at the origin.
Shell foliage_shell(const LeafShape& shape, const Bending& bent, std::size_t triangles) {
    const Limb limb = limb_of(shape.venation, leaf_steps(shape.venation, 0));
    // Between its veins' ends the border goes straight, or every corner would go into the bays of a frond.
    Venation plain = shape.venation;
    plain.sinus = plain.teeth = 0.0;
    const Limb outline = limb_of(plain, plain.lobes.value == 1 ? 2 : 1);
    const Lobe& middle = outline.lobes[outline.lobes.size() / 2];
    const glm::dvec2 centre(0.0, outline.lobes.size() > 1 ? 0.3 : 0.5);
    const glm::dvec2 tip = middle.place(0, middle.reach, 0.0);
    std::vector<glm::dvec2> half;
    for (const glm::dvec2& place : border_of(outline)) {
        half.push_back(place);
        if (place == tip) break;
    }
    std::vector<glm::dvec2> border = simplified(half, centre, triangles / 4 + 1);
    for (std::size_t i = border.size() - 2; i > 0; --i)
        border.emplace_back(-border[i].x, border[i].y);
    // As much area as the limb has.
    const double grown = std::sqrt(area_of(border_of(limb)) / area_of(border));
    const LeafChart chart = chart_of(limb);
    Shell shell;
    const auto count = static_cast<std::uint32_t>(border.size());
    for (const bool upper : {true, false}) {
        for (const glm::dvec2& place : border)
            shell.add(bent.at(grown * place, 0.0), chart.texture_point(place, upper));
        const double lift = upper ? 0.5 * shape.thickness : -0.5 * shape.thickness;
        shell.add(bent.at(grown * centre, lift), chart.texture_point(centre, upper));
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
    refuse_faults(shape);
    if (triangles < 8 || triangles > most_foliage_triangles || triangles % 4 != 0)
        throw InvalidInput("/triangles", std::to_string(triangles) + " is not 8, 12 or 16");
    return foliage_shell(shape, Bending(shape), triangles).mesh(shape.length);
}

namespace {

// Both faces on the grid of a level.
Shell limb_shell(const LeafShape& shape, const Bending& bent, const Level& level) {
    const Limb limb = limb_of(shape.venation, level.steps);
    const LeafChart chart = chart_of(limb);
    const FlatLimb flat = FlatMaker(limb, level.rows, level.fill).take();
    Shell shell;
    const auto count = static_cast<std::uint32_t>(flat.vertices.size());
    for (const bool upper : {true, false})
        for (const Flat& vertex : flat.vertices) {
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

}  // namespace

Mesh leaf_mesh(const LeafShape& shape, int lod, double size) {
    refuse_faults(shape);
    if (lod < 0 || lod >= leaf_lods)
        throw InvalidInput("/lod",
                           std::to_string(lod) + " is outside 0.." + std::to_string(leaf_lods - 1));
    const Level level = level_of(shape.venation, lod);
    const Bending bent(shape);
    Shell shell = limb_shell(shape, bent, level);
    if (lod + 1 == leaf_lods && shell.triangles.size() > most_foliage_triangles)
        shell = foliage_shell(shape, bent, most_foliage_triangles);
    add_petiole(shape, bent, level, shell);
    for (glm::dvec3& place : shell.places) place.z += shape.petiole;
    return shell.mesh(shape.length * size);
}

LeafCount most_of_leaf(const Venation& venation, int lod) {
    const Level level = level_of(venation, lod);
    const auto sides = static_cast<std::uint64_t>(level.petiole_sides);
    const auto rings = static_cast<std::uint64_t>(level.petiole_rings);
    LeafCount count{rings * (sides + 1) + sides + 2, 2 * sides * rings};
    // The polygon of a needle has fewer corners, and then two to a triangle at the most.
    if (lod + 1 == leaf_lods)
        return {count.vertices + 2 * most_foliage_triangles,
                count.triangles + most_foliage_triangles};
    // Feet of half a lobe: its border's corners and what lies between them, where it is joined to its neighbour, and filled in.
    const auto nodes = static_cast<std::uint64_t>(venation.nodes);
    const auto lobes = static_cast<std::uint64_t>(venation.lobes.value);
    const std::uint64_t between =
        (venation.sinus > 0.0 ? 2 : 1) * std::max<std::uint64_t>(nodes, 2);
    const bool toothed = level.steps > 1 && venation.teeth > 0.0;
    const int places = std::max(level.steps, toothed ? 2 * venation.teeth_per_vein : 0);
    const std::uint64_t feet =
        between * static_cast<std::uint64_t>(places) + 6 + level.fill * (nodes + 1);
    const std::uint64_t rows = level.rows.size();
    // Both halves of a lobe share their main vein, neighbours the ray between; either line has the feet of both sides.
    count.vertices += 2 * lobes * (2 * feet * (rows - 1) + 4 * feet);
    count.triangles += 2 * lobes * (2 * feet * 2 * (rows - 1) + 8 * feet);
    return count;
}

namespace {

LeafPalette palette(LeafColours summer, LeafColours turning, LeafColours fallen, double paler) {
    return {summer, turning, fallen, paler};
}

std::vector<LeafPreset> make_presets() {
    std::vector<LeafPreset> presets;
    {
        LeafShape maple;
        maple.venation = {.lobes = {5},
                          .nodes = 5,
                          .node_loss = 0.9,
                          .vein_deg = 46,
                          .side_deg = 42,
                          .law = LengthLaw::logarithmic,
                          .rise = 0.5,
                          .side_length = 1.2,
                          .narrow_tip = 0.5,
                          .border = 1.2,
                          .sinus = 0.45,
                          .smooth = 0.8,
                          .pointed = 1.0};
        maple.length = 0.11;
        maple.petiole = 0.8;
        maple.curl_deg = 20;
        maple.fold_deg = 8;
        presets.push_back({"maple", "Maple-like", maple,
                           palette({{170, 186, 104},
                                    {62, 104, 38},
                                    {84, 128, 46},
                                    {92, 132, 50},
                                    0.016,
                                    GradationLaw::soft,
                                    GradationLaw::late,
                                    0.4},
                                   {{226, 196, 92},
                                    {226, 150, 30},
                                    {206, 62, 20},
                                    {176, 28, 22},
                                    0.016,
                                    GradationLaw::linear,
                                    GradationLaw::soft,
                                    0.6},
                                   {{150, 108, 62},
                                    {132, 66, 30},
                                    {104, 46, 26},
                                    {88, 40, 26},
                                    0.016,
                                    GradationLaw::soft,
                                    GradationLaw::late,
                                    0.4},
                                   0.35)});
    }
    {
        LeafShape oak;
        oak.venation = {.lobes = {1},
                        .nodes = 7,
                        .side_deg = 54,
                        .law = LengthLaw::logarithmic,
                        .rise = 0.25,
                        .side_length = 2.7,
                        .narrow_base = 0.9,
                        .narrow_tip = 0.85,
                        .border = 1.06,
                        .sinus = 0.36,
                        .smooth = 1.0,
                        .pointed = 0.0};
        oak.length = 0.11;
        oak.petiole = 0.07;
        oak.curl_deg = 25;
        oak.wave = 0.35;
        presets.push_back({"oak", "Oak-like", oak,
                           palette({{152, 168, 92},
                                    {58, 92, 34},
                                    {74, 110, 40},
                                    {82, 114, 44},
                                    0.014,
                                    GradationLaw::soft,
                                    GradationLaw::late,
                                    0.3},
                                   {{196, 158, 84},
                                    {172, 118, 44},
                                    {160, 92, 34},
                                    {138, 70, 30},
                                    0.014,
                                    GradationLaw::soft,
                                    GradationLaw::late,
                                    0.5},
                                   {{136, 98, 60},
                                    {116, 76, 44},
                                    {100, 62, 36},
                                    {86, 54, 34},
                                    0.014,
                                    GradationLaw::soft,
                                    GradationLaw::late,
                                    0.4},
                                   0.3)});
    }
    {
        LeafShape birch;
        birch.venation = {.lobes = {1},
                          .nodes = 8,
                          .side_deg = 48,
                          .base_deg = 14,
                          .law = LengthLaw::logarithmic,
                          .rise = 3,
                          .side_length = 2.4,
                          .narrow_base = 0.15,
                          .narrow_tip = 0.95,
                          .border = 1.06,
                          .smooth = 0.9,
                          .pointed = 0.7,
                          .teeth = 0.6,
                          .teeth_per_vein = 3};
        birch.length = 0.055;
        birch.petiole = 0.4;
        birch.curl_deg = 18;
        birch.fold_deg = 12;
        presets.push_back({"birch", "Birch-like", birch,
                           palette({{158, 182, 92},
                                    {78, 122, 40},
                                    {98, 142, 50},
                                    {104, 146, 54},
                                    0.012,
                                    GradationLaw::soft,
                                    GradationLaw::late,
                                    0.4},
                                   {{206, 200, 96},
                                    {226, 190, 40},
                                    {236, 200, 44},
                                    {220, 170, 34},
                                    0.012,
                                    GradationLaw::early,
                                    GradationLaw::late,
                                    0.4},
                                   {{158, 124, 60},
                                    {150, 108, 46},
                                    {130, 86, 38},
                                    {112, 72, 34},
                                    0.012,
                                    GradationLaw::soft,
                                    GradationLaw::late,
                                    0.4},
                                   0.3)});
    }
    {
        LeafShape ivy;
        ivy.venation = {.lobes = {5},
                        .nodes = 6,
                        .node_loss = 1.0,
                        .vein_deg = 48,
                        .side_deg = 46,
                        .base_deg = 20,
                        .law = LengthLaw::logarithmic,
                        .rise = 0.8,
                        .side_length = 1.6,
                        .narrow_base = 0,
                        .narrow_tip = 0.95,
                        .border = 1.1,
                        .smooth = 0.7,
                        .pointed = 1.0};
        ivy.length = 0.065;
        ivy.petiole = 0.9;
        ivy.thickness = 0.01;
        ivy.curl_deg = 30;
        ivy.fold_deg = 4;
        presets.push_back({"ivy", "Ivy-like", ivy,
                           palette({{176, 192, 138},
                                    {34, 70, 34},
                                    {44, 84, 40},
                                    {50, 88, 42},
                                    0.024,
                                    GradationLaw::soft,
                                    GradationLaw::late,
                                    0.3},
                                   {{164, 156, 108},
                                    {66, 62, 34},
                                    {92, 52, 40},
                                    {106, 44, 42},
                                    0.024,
                                    GradationLaw::late,
                                    GradationLaw::soft,
                                    0.5},
                                   {{138, 116, 76},
                                    {112, 84, 48},
                                    {98, 70, 42},
                                    {88, 62, 40},
                                    0.02,
                                    GradationLaw::soft,
                                    GradationLaw::late,
                                    0.4},
                                   0.4)});
    }
    {
        LeafShape fern;
        fern.venation = {.lobes = {1},
                         .nodes = 24,
                         .side_deg = 70,
                         .law = LengthLaw::linear,
                         .rise = 0.06,
                         .side_length = 4.6,
                         .narrow_base = 0.5,
                         .narrow_tip = 0.9,
                         .border = 1.06,
                         .sinus = 0.9,
                         .smooth = 0.6,
                         .pointed = 0.4};
        fern.length = 0.5;
        fern.petiole = 0.35;
        fern.relief = 0.3;
        fern.curl_deg = 55;
        fern.fold_deg = 6;
        fern.wave = 0.1;
        presets.push_back({"fern", "Fern frond", fern,
                           palette({{122, 140, 66},
                                    {74, 122, 40},
                                    {102, 150, 52},
                                    {116, 158, 60},
                                    0.012,
                                    GradationLaw::linear,
                                    GradationLaw::late,
                                    0.4},
                                   {{160, 128, 66},
                                    {186, 156, 60},
                                    {170, 116, 48},
                                    {150, 92, 42},
                                    0.012,
                                    GradationLaw::linear,
                                    GradationLaw::soft,
                                    0.5},
                                   {{118, 80, 48},
                                    {128, 84, 46},
                                    {108, 66, 38},
                                    {94, 58, 36},
                                    0.012,
                                    GradationLaw::linear,
                                    GradationLaw::late,
                                    0.4},
                                   0.25)});
    }
    {
        // A shoot of a conifer as one leaf: needles in two rows.
        LeafShape shoot;
        shoot.venation = {.lobes = {1},
                          .nodes = 24,
                          .side_deg = 55,
                          .law = LengthLaw::constant,
                          .rise = 0,
                          .side_length = 4.0,
                          .narrow_base = 0.3,
                          .narrow_tip = 0.9,
                          .border = 1.05,
                          .sinus = 0.95,
                          .smooth = 0.3,
                          .pointed = 0.6};
        shoot.length = 0.12;
        shoot.petiole = 0.05;
        shoot.thickness = 0.012;
        shoot.relief = 0.0;
        shoot.curl_deg = 12;
        shoot.fold_deg = 14;
        shoot.wave = 0;
        presets.push_back({"shoot", "Shoot of needles", shoot,
                           palette({{78, 70, 44},
                                    {30, 60, 36},
                                    {40, 78, 44},
                                    {74, 112, 56},
                                    0.03,
                                    GradationLaw::soft,
                                    GradationLaw::late,
                                    0.6},
                                   {{104, 84, 48},
                                    {104, 96, 44},
                                    {124, 108, 48},
                                    {134, 106, 48},
                                    0.03,
                                    GradationLaw::soft,
                                    GradationLaw::late,
                                    0.4},
                                   {{104, 76, 46},
                                    {118, 78, 42},
                                    {112, 72, 40},
                                    {104, 66, 38},
                                    0.03,
                                    GradationLaw::soft,
                                    GradationLaw::late,
                                    0.4},
                                   0.3)});
    }
    {
        LeafShape needle;
        needle.venation = {.lobes = {1},
                           .nodes = 2,
                           .side_deg = 20,
                           .law = LengthLaw::constant,
                           .rise = 0,
                           .side_length = 0.1,
                           .border = 1.0,
                           .smooth = 1.0,
                           .pointed = 0.0};
        needle.length = 0.018;
        needle.petiole = 0.04;
        needle.thickness = 0.045;
        needle.relief = 0;
        needle.curl_deg = 14;
        needle.fold_deg = 0;
        needle.wave = 0;
        presets.push_back({"needle", "Needle", needle,
                           palette({{96, 124, 76},
                                    {38, 72, 40},
                                    {46, 82, 46},
                                    {58, 92, 52},
                                    0.012,
                                    GradationLaw::soft,
                                    GradationLaw::late,
                                    0.4},
                                   {{130, 120, 60},
                                    {118, 108, 48},
                                    {128, 112, 50},
                                    {140, 112, 52},
                                    0.012,
                                    GradationLaw::soft,
                                    GradationLaw::late,
                                    0.4},
                                   {{130, 92, 52},
                                    {124, 82, 44},
                                    {116, 74, 40},
                                    {104, 66, 38},
                                    0.012,
                                    GradationLaw::soft,
                                    GradationLaw::late,
                                    0.4},
                                   0.3)});
    }
    return presets;
}

}  // namespace

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
    // Angles that leave lobes no room stay as they were.
    std::vector<Problem> problems;
    veins.check("", problems);
    if (problems.empty()) return leaf;
    veins.side_deg = shape.venation.side_deg;
    veins.vein_deg = shape.venation.vein_deg;
    return leaf;
}

std::span<const LeafPreset> leaf_presets() {
    static const std::vector<LeafPreset> presets = make_presets();
    return presets;
}

const LeafPreset* leaf_preset(std::string_view id) {
    for (const LeafPreset& preset : leaf_presets())
        if (id == preset.id) return &preset;
    return nullptr;
}

}  // namespace sporeprint
