#include "core/build/hymenium.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "core/build/directions.h"
#include "core/math/elementary.h"
#include "core/math/random.h"
#include "core/model/purposes.h"
#include "core/surface/charts.h"

namespace sporeprint {

namespace {

constexpr int stations = 64;       // of the meridian
constexpr double room_used = 0.6;  // of what lies between the edges and the cap's upper face
// As many rows to each blade in nearly every set of species: chords of other rows would lie off.
constexpr int most_segments = 8, least_segments = 2, stem_segments = 3;
constexpr std::size_t row_corners = 6;
/// Where the flesh has rings of its own: it rises from the stem and runs out at the margin.
constexpr std::array<double, 10> steep_places = {0.012, 0.026, 0.042, 0.06, 0.085,
                                                 0.12,  0.2,   0.7,   0.8,  0.9};
constexpr const Chart& chart = swept_charts[static_cast<std::size_t>(Part::blade)];

constexpr int triangles_of(int segments) { return 10 * segments - 2; }

bool is_bladed(HymeniumPattern pattern) {
    return pattern == HymeniumPattern::gills || pattern == HymeniumPattern::ridges;
}

/// How deep a blade may be along the meridian: it rises from the stem's skin and runs out towards the margin.
double envelope(double share) {
    const double out = std::clamp((1.0 - share) / 0.32, 0.0, 1.0);
    return smooth_step(0.0, 1.0, share / 0.06) * out * (2.0 - out);
}

/// How much of that depth a species uses where its blades meet the stem; they begin at their gap.
double attachment(const HymeniumOf<Plain>& h, double share) {
    const double from = std::max(share - h.inner_gap, 0.0);
    const double u = std::min(from / 0.28, 1.0), x = std::min(from / 0.18, 1.0);
    const double notch = 0.85 * h.notch * 16.0 * x * x * (1.0 - x) * (1.0 - x);
    return (h.inner_depth + (1.0 - h.inner_depth) * u * (2.0 - u)) * (1.0 - notch);
}

/// The same of pores and spines, which stand in the gap too, without any depth.
double carried(const HymeniumOf<Plain>& h, double share) {
    return attachment(h, share) * smooth_step(0.0, 1.0, 1.0 + (share - h.inner_gap) / 0.03);
}

/// How the solids share the triangles there are. What there is of one kind does not change how another looks, as far as the budget
/// allows: else no mix would end where its species begin.
struct Budget {
    int tiers = 0;     ///< of the comb that are built; finer ones are painted only
    int segments = 0;  ///< of a blade on the face
    int below = 0;     ///< of a blade on the stem
    int spines = 0;
    int pores = 0;
    int corners = 6;  ///< of a pore
    bool walls =
        true;  ///< whether the walls of pores are thick; else both their sides are one sheet
};

constexpr int spine_sides = 5;
constexpr int spine_triangles = 2 * spine_sides - 2;

/// Rings of corners of a pore: foot outside, rim, foot inside.
constexpr int pore_rings = 3;

int pore_triangles(const Budget& budget) { return budget.corners * (budget.walls ? 6 : 4); }

Budget shares_of(const Individual& individual) {
    Budget shares;
    for (const SpeciesShare& part : individual.parts)
        (part.model.surface.hymenium.pattern == HymeniumPattern::pores ? shares.pores
                                                                       : shares.spines) +=
            cell_count(part.cells);
    shares.corners = shares.pores <= 1000 ? 6 : 4;
    shares.walls = shares.pores <= 1500;
    const Comb& comb = individual.comb;
    // A body with relief has as many triangles more.
    const int most = individual.has_relief ? most_blade_triangles * 2 / 3 : most_blade_triangles;
    const int budget = shares.pores > 0 ? most / 6 : most;
    shares.tiers = individual.blade_tiers;
    shares.below = individual.runs_down ? stem_segments : 0;
    while (shares.tiers > 0 &&
           (comb.blades << shares.tiers) * triangles_of(least_segments + shares.below) > budget)
        --shares.tiers;
    const int blades = std::max(comb.blades << shares.tiers, 1);
    shares.segments =
        std::clamp((budget / blades + 2) / 10 - shares.below, least_segments, most_segments);
    return shares;
}

/// The tier that a slot belongs to when all tiers are filled; -1 for blades that reach the stem.
int tier_of(int slot, int tiers) {
    if (slot % (1 << tiers) == 0) return -1;
    int zeros = 0;
    while ((slot >> zeros & 1) == 0) ++zeros;
    return tiers - 1 - zeros;
}

/// Visits the slots that are built. All have as many rows: what reaches the stem in one species may be short in another.
template <class Work>
void for_each_blade(const Individual& individual, const Budget& shares, const Work& work) {
    const int slots = individual.comb.blades << individual.blade_tiers;
    for (int slot = 0; slot < slots; ++slot) {
        if (tier_of(slot, individual.blade_tiers) < shares.tiers) work(slot);
    }
}

/// A species' blades on the slots of the set. A slot says only which blades of two species are one; each stands at its own place, so
/// that a corner is the species itself, and no blade is farther from its slot than half-way to the next.
struct Wearer {
    double weight;
    const HymeniumOf<Plain>* h;
    bool ridges;
    BladeRow row;

    [[nodiscard]] const Blade& on(int slot) const {
        return row.blades()[static_cast<std::size_t>(slot)];
    }
};

std::vector<Wearer> wearers(const Individual& individual) {
    std::vector<Wearer> out;
    for (const SpeciesShare& part : individual.parts) {
        const HymeniumPattern pattern = part.model.surface.hymenium.pattern;
        if (!is_bladed(pattern) || part.weight <= 0.0) continue;
        const HymeniumOf<Plain>& h = part.model.hymenium;
        out.push_back({part.weight, &h, pattern == HymeniumPattern::ridges,
                       BladeRow(stand_on(0, pattern, h.blades, h.tiers), pattern, h.forking,
                                individual.effective.seed,
                                individual.comb.blades << individual.blade_tiers)});
    }
    return out;
}

/// How a blade strays to its sides along the meridian.
struct Ripple {
    double size, pitch, phase, other;

    Ripple(std::uint32_t seed, int number, double with_size) : size(with_size) {
        Random random(seed, purposes::blade_ripple, static_cast<std::uint32_t>(number));
        phase = random.uniform();
        other = random.uniform();
        pitch = random.uniform(1.6, 3.4);
    }
    [[nodiscard]] double at(double share) const {
        return size *
               (cubic_wave(pitch * share + phase) + 0.5 * cubic_wave(2.7 * pitch * share + other));
    }
};

/// Distance along a ray to a polyline in the half-plane; nothing nearer than `from` counts.
double distance_to(const std::vector<OutlineSample>& line, double r, double y, double dr, double dy,
                   double from) {
    double nearest = 1e9;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const double er = line[i + 1].r - line[i].r, ey = line[i + 1].y - line[i].y;
        const double across = dr * ey - dy * er;
        if (std::abs(across) < 1e-18) continue;
        const double qr = line[i].r - r, qy = line[i].y - y;
        const double t = (qr * ey - qy * er) / across, s = (qr * dy - qy * dr) / across;
        if (s >= 0.0 && s <= 1.0 && t > from) nearest = std::min(nearest, t);
    }
    return nearest;
}

class Builder {
  public:
    Builder(Mesh& mesh, const Individual& individual, const LowerFace& face, const Ground& ground)
        : mesh_(mesh),
          individual_(individual),
          face_(face),
          ground_(ground),
          flesh_(face.flesh(ground.outline, 0)) {}

    void blades(const Budget& shares);
    void spines();
    void pores(const Budget& shares);

  private:
    /// One cross-section of a blade: a place on its root, and which way it is deep and thick.
    struct Row {
        SurfacePoint root;  ///< meridian: the way it is deep; azimuth: the way it is thick
        double share = 0.0, height = 0.0, half = 0.0, stray = 0.0;
    };

    /// Where a solid begins: sunk into the flesh (rooted: 1), or, when all but gone (0), on the very chords that are swept.
    [[nodiscard]] OutlineSample root_at(double share, double rooted) const;
    /// Where a sample of a sub-curve comes to lie: its meridian becomes the way out of the skin.
    [[nodiscard]] SurfacePoint place(Part part, const OutlineSample& sample, double angle,
                                     const AxisStation& station) const;
    /// The same before it has a place in space.
    struct Plan {
        double along = 0.0;  ///< metres from the stem's top along the face; below 0 down the stem
        double angle = 0.0, height = 0.0, half = 0.0, stray = 0.0;
    };
    void row(const Plan& plan, double rooted);
    /// The vertex of the body nearest to a place: between vertices its chords lie off the skin, so that what is left of a solid that
    /// is all but gone would stand off there.
    struct Spot {
        double share, angle;
    };
    [[nodiscard]] Spot vertex_near(double share, double angle) const;
    /// Where a spine or a pore stands: at its own place, or, when all but gone (rooted: 0), at the vertex nearest to it.
    [[nodiscard]] SurfacePoint cell_root(const CellPlace& cell, double rooted,
                                         const AxisStation& station) const;
    void append(double shoulder, double waist, bool drawn);
    void vertex(const glm::dvec3& position, const glm::dvec3& normal, const glm::dvec3& along,
                double u, double v, float hand);

    Mesh& mesh_;
    const Individual& individual_;
    const LowerFace& face_;
    const Ground& ground_;
    std::vector<OutlineSample> flesh_;
    std::vector<Plan> plans_;
    std::vector<Row> rows_;
};

OutlineSample Builder::root_at(double share, double rooted) const {
    const LowerFace::Place at = face_.at(share);
    const double deeper = at.recess + rooted * at.sink;
    OutlineSample root{at.r - deeper * at.normal_r, at.y - deeper * at.normal_y, -at.normal_y,
                       at.normal_r, share};
    if (rooted >= 1.0) return root;
    const auto next =
        std::upper_bound(flesh_.begin() + 1, flesh_.end() - 1, share,
                         [](double a, const OutlineSample& b) { return a < b.share; });
    const OutlineSample &a = *(next - 1), &b = *next;
    const double t =
        b.share > a.share ? std::clamp((share - a.share) / (b.share - a.share), 0.0, 1.0) : 0.0;
    root.r += (1.0 - rooted) * (a.r + t * (b.r - a.r) - root.r);
    root.y += (1.0 - rooted) * (a.y + t * (b.y - a.y) - root.y);
    return root;
}

Builder::Spot Builder::vertex_near(double share, double angle) const {
    double nearest = flesh_[1].share;
    for (std::size_t i = 1; i + 1 < flesh_.size(); ++i)
        if (std::abs(flesh_[i].share - share) < std::abs(nearest - share))
            nearest = flesh_[i].share;
    const double column = 2.0 * pi / ground_.detail.columns;
    return {nearest, column * std::floor(angle / column + 0.5)};
}

SurfacePoint Builder::place(Part part, const OutlineSample& sample, double angle,
                            const AxisStation& station) const {
    SurfacePoint point = ground_.skin.at(part, sample, ground_.skin.column(angle));
    // Where a fan squeezes or stretches the face, what stands on it is as much thinner or thicker, and no deeper.
    const double along = std::sqrt(glm::dot(point.meridian, point.meridian));
    ground_.deformer.apply({&point, 1}, station);
    const glm::dvec3 outward = glm::cross(point.meridian, point.azimuth);
    point.meridian = std::min(along, 1.0) * unit_or(outward, {0.0, -1.0, 0.0});
    return point;
}

SurfacePoint Builder::cell_root(const CellPlace& cell, double rooted,
                                const AxisStation& station) const {
    const double own = 2.0 * pi * cell.turn;
    const Spot rest = vertex_near(cell.share, own);
    const double angle = rest.angle + rooted * (own - rest.angle);
    const double share = ground_.cuts.lower(rest.share + rooted * (cell.share - rest.share), angle);
    return place(Part::hymenium, root_at(share, rooted), angle, station);
}

// Roots are sunk into the flesh; those of blades that are all but gone less so (rooted: 1 to 0), or what is left of another species
// would stay under the skin until the last.
void Builder::row(const Plan& plan, double rooted) {
    Row row;
    row.half = plan.half;
    const SubCurve& stem = ground_.outline.stem;
    if (plan.along < 0.0) {
        OutlineSample root = stem.at(1.0 + plan.along / stem.length());
        const double deep = std::min(0.3 * plan.height, 0.05 * root.r);
        row.height = plan.height + deep;
        const AxisStation station =
            ground_.deformer.station(root.share == 1.0 ? ground_.deformer.top() : root.y);
        root.r -= deep * root.tangent_y;
        root.y += deep * root.tangent_r;
        row.root = place(Part::stem, root, plan.angle, station);
    } else {
        const double whole = plan.along / std::max(face_.length(), 1e-12);
        // Where the margin is cut back, blades end with it.
        const double share = ground_.cuts.lower(whole, plan.angle);
        const double deep = rooted * face_.at(share).sink;
        row.share = whole;
        row.height =
            plan.height + deep * std::min(1.0, plan.height / (0.01 * face_.length() + 1e-12));
        row.stray = plan.stray;
        row.root = place(Part::hymenium, root_at(share, rooted), plan.angle,
                         ground_.deformer.frozen_station(ground_.deformer.top()));
    }
    rows_.push_back(row);
}

void Builder::vertex(const glm::dvec3& position, const glm::dvec3& normal, const glm::dvec3& along,
                     double u, double v, float hand) {
    mesh_.positions.emplace_back(position);
    mesh_.normals.emplace_back(normal);
    if (!ground_.textured) return;
    const TexturePoint at = strip_point(chart, std::clamp(u, 0.0, 1.0), v);
    mesh_.texture_coordinates.emplace_back(at.u, at.v);
    const glm::dvec3 flat = along - glm::dot(along, normal) * normal;
    const glm::dvec3 other =
        std::abs(normal.y) < 0.8 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(1.0, 0.0, 0.0);
    mesh_.tangents.emplace_back(
        glm::vec3(unit_or(flat, unit_or(other - glm::dot(other, normal) * normal, other))), hand);
}

// Six corners a row: root, shoulder and tip of one face, tip, shoulder and root of the other. The first and the last row have no
// thickness, so that both faces meet there and the solid is closed.
void Builder::append(double shoulder, double waist, bool drawn) {
    const auto first = static_cast<std::uint32_t>(mesh_.positions.size());
    for (std::size_t j = 0; j < rows_.size(); ++j) {
        const Row& row = rows_[j];
        const glm::dvec3 &root = row.root.position, &deep = row.root.meridian,
                         &thick = row.root.azimuth;
        const glm::dvec3 along = rows_[std::min(j + 1, rows_.size() - 1)].root.position -
                                 rows_[j == 0 ? 0 : j - 1].root.position;
        const glm::dvec3 down = unit_or(deep, {0.0, -1.0, 0.0});
        const glm::dvec3 side = unit_or(glm::cross(along, down), unit_or(-thick, {1.0, 0.0, 0.0}));
        const double half = j == 0 || j + 1 == rows_.size() ? 0.0 : row.half;
        const glm::dvec3 bent = root + row.stray * thick;
        const glm::dvec3 middle = bent + shoulder * row.height * deep,
                         tip = bent + row.height * deep + row.stray * thick;
        const glm::dvec3 leaning = unit_or(side + 0.4 * down, side),
                         other = unit_or(-side + 0.4 * down, -side);
        const double u = row.share;
        vertex(root - half * thick, side, along, u, 0.0, -1.0F);
        vertex(middle - waist * half * thick, leaning, along, u, shoulder, -1.0F);
        vertex(tip, down, along, u, 1.0, -1.0F);
        vertex(tip, down, along, u, 1.0, 1.0F);
        vertex(middle + waist * half * thick, other, along, u, shoulder, 1.0F);
        vertex(root + half * thick, -side, along, u, 0.0, 1.0F);
    }
    if (drawn) {
        const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            mesh_.indices.insert(mesh_.indices.end(), {first + a, first + b, first + c});
        };
        const auto last = static_cast<std::uint32_t>(rows_.size()) - 2;
        for (std::uint32_t j = 0; j <= last; ++j) {
            const auto here = static_cast<std::uint32_t>(row_corners) * j;
            const auto next = here + static_cast<std::uint32_t>(row_corners);
            for (const std::uint32_t k : {0U, 1U, 3U, 4U}) {
                add(here + k, next + k, here + k + 1);
                add(here + k + 1, next + k, next + k + 1);
            }
            if (j > 0) add(here + 5, next, here);
            if (j < last) add(here + 5, next + 5, next);
        }
    }
    rows_.clear();
}

void Builder::blades(const Budget& shares) {
    const std::vector<Wearer> all = wearers(individual_);
    const int slots = individual_.comb.blades << individual_.blade_tiers;
    const double length = face_.length();
    const SubCurve& stem = ground_.outline.stem;
    // Blades are as thick all along, but where they crowd at the stem.
    const double rim = face_.at(1.0).r;
    double half_sum = 0.0, blunt = 0.0, weight = 0.0, reaching = 0.0;
    for (const Wearer& w : all) {
        const double gap = 2.0 * pi * rim /
                           static_cast<double>(w.ridges ? w.h->blades : w.h->blades << w.h->tiers);
        half_sum += w.weight * 0.5 * w.h->thickness * gap;
        blunt += w.weight * (w.ridges ? 1.0 : 0.0);
        reaching += w.weight * w.h->blades;
        weight += w.weight;
    }
    const double per = weight > 0.0 ? 1.0 / weight : 0.0;
    const double half_all = half_sum * per, shoulder = 0.92 - 0.34 * blunt * per,
                 waist = 0.62 + 0.2 * blunt * per;
    const double crowd = std::max(reaching * per, 1.0);
    std::vector<Ripple> ripples;
    for_each_blade(individual_, shares, [&](int slot) {
        double present = 0.0, begin = 0.0, down = 0.0, runs = 0.0;
        ripples.clear();
        for (const Wearer& w : all) {
            const Blade& blade = w.on(slot);
            const double here = w.weight * blade.presence;
            ripples.emplace_back(individual_.effective.seed, blade.number, here * w.h->edge_waves);
            present += here;
            begin += here * std::max(blade.begin, w.h->inner_gap);
            if (blade.begin > 0.0) continue;
            down += here * w.h->decurrent;
            // What stands out beyond the outline where blades run down the stem.
            runs += here * std::min(1.0, 12.0 * w.h->decurrent) * w.h->depth;
        }
        const double each = present > 0.0 ? 1.0 / present : 0.0;
        begin = present > 0.0 ? std::min(begin * each, 0.97) : 0.5;
        down = std::min(down * each, 0.98);
        const double even = static_cast<double>(slot) / slots;
        const auto angle_at = [&](double share) {
            if (present <= 0.0) return 2.0 * pi * even;
            double turn = 0.0;
            for (const Wearer& w : all) {
                const Blade& blade = w.on(slot);
                if (blade.presence <= 0.0) continue;
                // The first blade stands on both sides of the seam.
                const double own = w.row.turn(blade, share);
                turn += w.weight * blade.presence * (own - std::floor(own - even + 0.5));
            }
            return 2.0 * pi * turn * each;
        };
        const double beyond = shares.below > 0 ? 0.55 * length * runs : 0.0;
        plans_.clear();
        double most = 0.0;
        // Down the stem and up to where the blade begins on the face, for those that do.
        for (int j = 0; j < shares.below; ++j) {
            const double up = static_cast<double>(j) / shares.below;
            Plan plan;
            plan.along = begin * length - down * stem.length() * (1.0 - up);
            plan.height = beyond * up * (2.0 - up);
            plans_.push_back(plan);
        }
        // Rows crowd where a blade rises at the stem.
        const double crowding = 0.65 * smooth_step(0.0, 1.0, (0.3 - begin) / 0.3);
        for (int j = 0; j <= shares.segments; ++j) {
            const double t = static_cast<double>(j) / shares.segments;
            const double share = begin + (1.0 - begin) * (t + crowding * (t * t - t));
            Plan plan;
            plan.along = share * length;
            for (const Wearer& w : all) {
                const Blade& blade = w.on(slot);
                if (blade.presence <= 0.0) continue;
                const double rise = blade.rise > 0.0
                                        ? smooth_step(0.0, 1.0, 0.85 * (share - begin) / blade.rise)
                                        : 1.0;
                plan.height +=
                    w.weight * blade.presence * rise * w.h->depth * attachment(*w.h, share);
            }
            plan.height *= length * envelope(share) * face_.at(share).scale;
            plan.height += beyond * (1.0 - smooth_step(0.0, 1.0, share / 0.25));
            plans_.push_back(plan);
        }
        for (const Plan& plan : plans_) most = std::max(most, plan.height);
        // A blade that is all but gone is as thin and short, and stands no deeper in the flesh.
        const auto left = [&](double full) {
            return std::min(1.0, most / (full * length + 1e-12));
        };
        const double own_middle = 0.4 * begin + 0.6;
        const Spot rest = vertex_near(own_middle, angle_at(own_middle));
        const double middle = length * (rest.share + left(0.003) * (own_middle - rest.share));
        for (Plan& plan : plans_) {
            plan.along = middle + left(0.015) * (plan.along - middle);
            const double share = std::max(plan.along, 0.0) / std::max(length, 1e-12);
            const double r =
                plan.along < 0.0 ? stem.at(1.0 + plan.along / stem.length()).r : face_.at(share).r;
            const double room = 0.62 * pi * r / crowd;
            double ripple = 0.0;
            for (const Ripple& one : ripples)
                if (one.size > 0.0) ripple += one.at(share);
            plan.angle = rest.angle + left(0.003) * (angle_at(share) - rest.angle);
            plan.half = left(0.004) * std::min(half_all, room);
            // A blade that does not run down the stem begins on the face as sharp as where no species of the set does.
            if (&plan - plans_.data() <= shares.below) plan.half *= std::min(1.0, 12.0 * down);
            plan.stray = left(0.004) * 0.275 * each * std::min(room, 3.0 * half_all) * ripple *
                         smooth_step(0.0, 1.0, share / 0.15) *
                         smooth_step(0.0, 1.0, (1.0 - share) / 0.2);
            row(plan, left(0.01));
        }
        append(shoulder, waist, most > 0.0 || ground_.keep_absent);
    });
}

void Builder::spines() {
    const double length = face_.length();
    constexpr int sides = spine_sides;
    const AxisStation station = ground_.deformer.frozen_station(ground_.deformer.top());
    for (const SpeciesShare& part : individual_.parts) {
        if (part.cells.rows == 0 || part.model.surface.hymenium.pattern != HymeniumPattern::teeth)
            continue;
        const HymeniumOf<Plain>& h = part.model.hymenium;
        const double cell = length / part.cells.rows;
        for (const CellPlace& cell_at : cell_places(part.cells, individual_.effective.seed)) {
            const LowerFace::Place at = face_.at(cell_at.share);
            const double size = 1.0 + 0.25 * cell_at.lot;
            const double own = part.weight * length * h.depth * envelope(cell_at.share) *
                               carried(h, cell_at.share) * at.scale * std::min(size, 1.0);
            const double rooted = std::min(1.0, own / (0.01 * length + 1e-12));
            const double height = own > 0.0 ? own + rooted * at.sink : 0.0;
            const double radius =
                std::min(0.5 * h.thickness * cell * (0.9 + 0.1 * size), 0.45 * height + 1e-9);
            const SurfacePoint root = cell_root(cell_at, rooted, station);
            const glm::dvec3 down = unit_or(root.meridian, {0.0, -1.0, 0.0}),
                             round = unit_or(root.azimuth, {1.0, 0.0, 0.0}),
                             out = glm::cross(down, round);
            const glm::dvec3 lean = 0.12 * height * (cell_at.lot * round - 0.6 * cell_at.lot * out);
            const auto first = static_cast<std::uint32_t>(mesh_.positions.size());
            for (const double up : {0.0, 1.0}) {
                const double wide = 1.0 - up;
                for (int j = 0; j <= sides; ++j) {
                    const auto turn = sine_cosine(2.0 * pi * (j % sides) / sides);
                    const glm::dvec3 aside = turn.cosine * round + turn.sine * out;
                    const glm::dvec3 normal = unit_or(aside + (0.25 + 0.9 * up * up) * down, down);
                    vertex(root.position + up * (height * root.meridian + lean) +
                               wide * radius * aside,
                           normal, turn.cosine * out - turn.sine * round,
                           cell_at.share + 0.06 * (static_cast<double>(j) / sides - 0.5), up,
                           -1.0F);
                }
            }
            if (height <= 0.0 && !ground_.keep_absent) continue;
            const auto add = [&](int a, int b, int c2) {
                mesh_.indices.insert(mesh_.indices.end(), {first + static_cast<std::uint32_t>(a),
                                                           first + static_cast<std::uint32_t>(b),
                                                           first + static_cast<std::uint32_t>(c2)});
            };
            for (int j = 0; j < sides; ++j) add(j, j + 1, j + sides + 1);
            for (int j = 1; j + 1 < sides; ++j) add(0, j + 1, j);
        }
    }
}

// A pore is the end of a tube: a ring of flesh round its mouth, from the flesh between tubes to the rim and back inside. The rim has
// two rows of vertices, one for each side of the wall.
void Builder::pores(const Budget& shares) {
    const double length = face_.length();
    const int corners = shares.corners;
    const AxisStation station = ground_.deformer.frozen_station(ground_.deformer.top());
    for (const SpeciesShare& part : individual_.parts) {
        if (part.cells.rows == 0 || part.model.surface.hymenium.pattern != HymeniumPattern::pores)
            continue;
        const HymeniumOf<Plain>& h = part.model.hymenium;
        const double cell = length / part.cells.rows;
        for (const CellPlace& cell_at : cell_places(part.cells, individual_.effective.seed)) {
            const LowerFace::Place at = face_.at(cell_at.share);
            const double own = part.weight * length * h.depth * envelope(cell_at.share) *
                               carried(h, cell_at.share) * at.scale;
            const double rooted = std::min(1.0, own / (0.01 * length + 1e-12));
            const double height = own > 0.0 ? own + rooted * at.sink : 0.0;
            const double along = height > 0.0 ? 0.53 * cell : 0.0, round = along / h.elongation;
            const SurfacePoint root = cell_root(cell_at, rooted, station);
            const glm::dvec3 down = unit_or(root.meridian, {0.0, -1.0, 0.0}),
                             aside = unit_or(root.azimuth, {1.0, 0.0, 0.0}),
                             out = glm::cross(down, aside);
            const auto first = static_cast<std::uint32_t>(mesh_.positions.size());
            const double spin = 0.5 + 0.25 * cell_at.lot;
            // Outside foot, rim twice, inside foot.
            const double inner = shares.walls ? 0.72 : 0.96;
            const std::array<double, 4> wide = {0.96, 0.5 * (0.96 + inner), 0.5 * (0.96 + inner),
                                                inner};
            for (std::size_t i = 0; i < 4; ++i) {
                const bool rim = i == 1 || i == 2, outside = i < 2;
                for (int j = 0; j <= corners; ++j) {
                    const auto turn = sine_cosine(2.0 * pi * ((j % corners) + spin) / corners);
                    const glm::dvec3 to = turn.cosine * aside + turn.sine * out;
                    const glm::dvec3 reach = turn.cosine * round * aside + turn.sine * along * out;
                    const glm::dvec3 normal =
                        unit_or((outside ? 1.0 : -1.0) * to + (rim ? 0.8 : 0.0) * down, down);
                    vertex(root.position + wide[i] * reach + (rim ? height : 0.0) * root.meridian,
                           normal, turn.cosine * out - turn.sine * aside,
                           cell_at.share + 0.06 * (static_cast<double>(j) / corners - 0.5),
                           rim ? 1.0 : 0.0, outside ? -1.0F : 1.0F);
                }
            }
            if (height <= 0.0 && !ground_.keep_absent) continue;
            const int row = corners + 1;
            const auto add = [&](int a, int b, int c) {
                mesh_.indices.insert(mesh_.indices.end(), {first + static_cast<std::uint32_t>(a),
                                                           first + static_cast<std::uint32_t>(b),
                                                           first + static_cast<std::uint32_t>(c)});
            };
            const auto band = [&](int from, int to) {
                for (int j = 0; j < corners; ++j) {
                    const int a = from * row + j, b = a + 1, c = to * row + j, d = c + 1;
                    add(a, b, c);
                    add(b, d, c);
                }
            };
            band(0, 1);
            band(2, 3);
            if (shares.walls) band(3, 0);
        }
    }
}

}  // namespace

HymeniumCount hymenium_count(const Individual& individual, int lod) {
    HymeniumCount count;
    if (!has_solids(lod) || individual.outline.hymenium.empty()) return count;
    const Budget shares = shares_of(individual);
    const int segments = shares.segments + shares.below;
    for_each_blade(individual, shares, [&](int) {
        count.vertices += row_corners * static_cast<std::uint64_t>(segments + 1);
        count.triangles += static_cast<std::uint64_t>(triangles_of(segments));
    });
    count.vertices += static_cast<std::uint64_t>(shares.spines * 2 * (spine_sides + 1));
    count.triangles += static_cast<std::uint64_t>(shares.spines * spine_triangles);
    count.vertices +=
        static_cast<std::uint64_t>(shares.pores * (pore_rings + 1) * (shares.corners + 1));
    count.triangles += static_cast<std::uint64_t>(shares.pores * pore_triangles(shares));
    return count;
}

int flesh_rings(const Individual& individual, int lod) {
    const bool carries =
        std::any_of(individual.parts.begin(), individual.parts.end(), [](const SpeciesShare& part) {
            return part.model.surface.hymenium.pattern != HymeniumPattern::smooth;
        });
    if (!has_solids(lod) || individual.outline.hymenium.empty() || !carries) return 0;
    return static_cast<int>(steep_places.size());
}

LowerFace::LowerFace(const Individual& individual, int lod) {
    const SubCurve& curve = individual.outline.hymenium;
    if (curve.empty()) return;
    length_ = curve.length();
    carries_ = flesh_rings(individual, lod) > 0;
    std::vector<OutlineSample> line;
    for (int i = 0; i <= stations; ++i) line.push_back(curve.at(static_cast<double>(i) / stations));
    const auto cap = individual.outline.rings(CurveName::cap, 0);
    for (int i = 0; i <= stations; ++i) {
        const double share = static_cast<double>(i) / stations;
        const OutlineSample& at = line[static_cast<std::size_t>(i)];
        // Blades do not turn as sharply as the outline does at the stem: normals of a stretch of it.
        double normal_r = 0.0, normal_y = 0.0;
        for (int k = std::max(i - 5, 0); k <= std::min(i + 5, stations); ++k) {
            normal_r += line[static_cast<std::size_t>(k)].tangent_y;
            normal_y -= line[static_cast<std::size_t>(k)].tangent_r;
        }
        const double size = std::sqrt(normal_r * normal_r + normal_y * normal_y);
        Place place{.r = at.r, .y = at.y, .normal_r = at.tangent_y, .normal_y = -at.tangent_r};
        if (size > 1e-9) {
            place.normal_r = normal_r / size;
            place.normal_y = normal_y / size;
        }
        double room = distance_to(cap, at.r, at.y, -place.normal_r, -place.normal_y, 1e-9);
        if (place.normal_r > 1e-9) room = std::min(room, at.r / place.normal_r);
        if (room > 1e8) room = 0.0;
        double wanted = 0.0, groove = 0.0;
        for (const SpeciesShare& part : individual.parts) {
            const HymeniumOf<Plain>& h = part.model.hymenium;
            const HymeniumPattern pattern = part.model.surface.hymenium.pattern;
            if (is_bladed(pattern) || part.cells.rows > 0)
                wanted += part.weight * h.depth;
            else if (pattern == HymeniumPattern::pores)
                groove += part.weight * h.depth * (1.0 - carried(h, share));
        }
        // Tubes are the outline themselves, but for the groove round the stem.
        wanted = has_solids(lod) ? wanted * length_ * envelope(share) : 0.0;
        groove *= length_ * envelope(share);
        const double most = room_used * room;
        place.recess = std::min(wanted + groove, most);
        place.scale = wanted > 0.0 ? std::min(1.0, place.recess / (wanted + groove)) : 0.0;
        place.sink = std::min(0.12 * place.recess + 0.008 * length_, 0.15 * room);
        places_.push_back(place);
    }
    // Where the room ends abruptly the flesh still goes over smoothly.
    for (int pass = 0; pass < 2; ++pass) {
        const std::vector<Place> before = places_;
        for (std::size_t i = 1; i + 1 < places_.size(); ++i) {
            const double mean =
                0.25 * before[i - 1].recess + 0.5 * before[i].recess + 0.25 * before[i + 1].recess;
            const double recess = std::min(before[i].recess, mean);
            if (before[i].recess > 0.0) places_[i].scale *= recess / before[i].recess;
            places_[i].recess = recess;
        }
    }
}

LowerFace::Place LowerFace::at(double share) const {
    if (places_.empty()) return {};
    const double at = std::clamp(share, 0.0, 1.0) * stations;
    const double cell = std::min(std::floor(at), stations - 1.0);
    const double t = at - cell;
    const Place &a = places_[static_cast<std::size_t>(cell)],
                &b = places_[static_cast<std::size_t>(cell) + 1];
    const auto mix = [t](double x, double y) { return x + t * (y - x); };
    Place place{mix(a.r, b.r),
                mix(a.y, b.y),
                mix(a.normal_r, b.normal_r),
                mix(a.normal_y, b.normal_y),
                mix(a.recess, b.recess),
                mix(a.sink, b.sink),
                mix(a.scale, b.scale)};
    const double size =
        std::sqrt(place.normal_r * place.normal_r + place.normal_y * place.normal_y);
    if (size > 1e-9) {
        place.normal_r /= size;
        place.normal_y /= size;
    }
    return place;
}

std::vector<OutlineSample> LowerFace::flesh(const Outline& outline, int lod) const {
    std::vector<OutlineSample> rings = outline.rings(CurveName::hymenium, lod);
    if (!carries_) return rings;
    for (const double place : steep_places) rings.push_back(outline.hymenium.at(place));
    std::sort(rings.begin() + 1, rings.end(),
              [](const OutlineSample& a, const OutlineSample& b) { return a.share < b.share; });
    const auto moved = [&](double share) {
        const Place place = at(share);
        return glm::dvec2(-place.recess * place.normal_r, -place.recess * place.normal_y);
    };
    for (std::size_t i = 0; i < rings.size(); ++i) {
        OutlineSample& ring = rings[i];
        const double step = 0.25 / stations;
        const double low = std::max(ring.share - step, 0.0),
                     high = std::min(ring.share + step, 1.0);
        const glm::dvec2 by = moved(ring.share), slope = (moved(high) - moved(low)) / (high - low);
        const double tr = ring.tangent_r + slope.x / length_,
                     ty = ring.tangent_y + slope.y / length_;
        const double size = std::sqrt(tr * tr + ty * ty);
        if (i > 0 && i + 1 < rings.size()) {  // the ends belong to stem and cap too
            ring.r += by.x;
            ring.y += by.y;
        }
        if (size > 1e-9) {
            ring.tangent_r = tr / size;
            ring.tangent_y = ty / size;
        }
    }
    return rings;
}

void add_hymenium(Mesh& mesh, const Individual& individual, const LowerFace& face,
                  const Ground& ground) {
    if (face.empty()) return;
    const Budget shares = shares_of(individual);
    Builder builder(mesh, individual, face, ground);
    if (individual.comb.blades > 0) builder.blades(shares);
    if (shares.spines > 0) builder.spines();
    if (shares.pores > 0) builder.pores(shares);
}

}  // namespace sporeprint
