#include "core/geometry/blades.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

#include "core/math/direction.h"
#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"

namespace sporeprint {

namespace {

// Rows of a blade on the face: equal in all but crowded sets, or a mix would not end where its species begin.
constexpr int face_segments = 6, least_segments = 3, stem_segments = 2;
constexpr int most_blade_triangles = 36000;
constexpr std::size_t row_corners = 6;
constexpr std::array<double, 4> vein_rows = {0.1, 0.22, 0.78, 0.9};  // from ridge to ridge
constexpr int vein_segments = 3, least_veins = 100, most_veins = 400;

// Share of the stem's length from which on blades stand on its skin: no species of the atlas that has them there has less.
constexpr double least_decurrence = 0.01;

constexpr int triangles_of(int segments) { return 10 * segments - 2; }

/// Cross veins of one species that are built, whatever of them is there.
std::vector<CrossVein> built_veins(const SpeciesShare& part, const BladeBudget& shares,
                                   std::uint32_t seed) {
    std::vector<CrossVein> built;
    if (part.model.surface.hymenium.pattern != HymeniumPattern::ridges) return built;
    const HymeniumOf<Plain>& h = part.model.hymenium;
    const std::vector<CrossVein> all = cross_veins(h.blades, h.forking, seed);
    for (std::size_t i = 0; i < all.size(); i += static_cast<std::size_t>(shares.vein_stride))
        built.push_back(all[i]);
    return built;
}
int built_vein_count(const Individual& individual, int stride) {
    int count = 0;
    for (const SpeciesShare& part : individual.parts) {
        if (part.model.surface.hymenium.pattern != HymeniumPattern::ridges) continue;
        const int blades = part.model.hymenium.blades;
        count += (blades * cross_vein_rows(blades) + stride - 1) / stride;
    }
    return count;
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
void for_each_blade(const Individual& individual, const BladeBudget& shares, const Work& work) {
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

class Builder {
  public:
    explicit Builder(const Roots& roots)
        : roots_(roots), individual_(roots.individual), face_(roots.face), ground_(roots.ground) {}

    void blades(const BladeBudget& shares);
    void veins(const BladeBudget& shares);

  private:
    /// One cross-section of a blade: a place on its root, and which way it is deep and thick.
    struct Row {
        SurfacePoint root;  ///< meridian: the way it is deep; azimuth: the way it is thick
        double share = 0.0, height = 0.0, half = 0.0, stray = 0.0;
    };
    /// The same before it has a place in space.
    struct Plan {
        double along = 0.0;  ///< metres from the stem's top along the face; below 0 down the stem
        double buried =
            0.0;  ///< 0..1: how far a root on the stem stands in the flesh, as on the face
        double angle = 0.0, height = 0.0, half = 0.0, stray = 0.0;
    };
    void row(const Plan& plan, double rooted);
    void append(double shoulder, double waist, bool drawn);

    const Roots& roots_;
    const Individual& individual_;
    const LowerFace& face_;
    const Ground& ground_;
    std::vector<Plan> plans_;
    std::vector<Row> rows_;
};

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
        const OutlineSample inner = roots_.at(0.0, rooted), skin = stem.at(1.0);
        root.r += plan.buried * (inner.r - skin.r);
        root.y += plan.buried * (inner.y - skin.y);
        row.root = roots_.place(Part::stem, root, plan.angle, station, true);
    } else {
        const double whole = plan.along / std::max(face_.length(), 1e-12);
        // Where the margin is cut back, blades end with it.
        const double share = ground_.cuts.lower(whole, plan.angle);
        const double deep = rooted * face_.at(share).sink;
        row.share = whole;
        row.height =
            plan.height + deep * std::min(1.0, plan.height / (0.01 * face_.length() + 1e-12));
        row.stray = plan.stray;
        row.root = roots_.place(Part::hymenium, roots_.at(share, rooted), plan.angle,
                                ground_.deformer.frozen_station(ground_.deformer.top()), true);
    }
    rows_.push_back(row);
}

// Six corners a row: root, shoulder and tip of one face, tip, shoulder and root of the other. The first and the last row have no
// thickness, so that both faces meet there and the solid is closed.
void Builder::append(double shoulder, double waist, bool drawn) {
    const auto first = static_cast<std::uint32_t>(roots_.mesh.positions.size());
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
        roots_.vertex(root - half * thick, side, along, u, 0.0, -1.0F);
        roots_.vertex(middle - waist * half * thick, leaning, along, u, shoulder, -1.0F);
        roots_.vertex(tip, down, along, u, 1.0, -1.0F);
        roots_.vertex(tip, down, along, u, 1.0, 1.0F);
        roots_.vertex(middle + waist * half * thick, other, along, u, shoulder, 1.0F);
        roots_.vertex(root + half * thick, -side, along, u, 0.0, 1.0F);
    }
    std::vector<std::array<std::uint32_t, 3>> faces;
    const auto last = static_cast<std::uint32_t>(rows_.size()) - 2;
    for (std::uint32_t j = 0; j <= last; ++j) {
        const auto here = first + static_cast<std::uint32_t>(row_corners) * j;
        const auto next = here + static_cast<std::uint32_t>(row_corners);
        for (const std::uint32_t k : {0U, 1U, 3U, 4U}) {
            faces.push_back({here + k, next + k, here + k + 1});
            faces.push_back({here + k + 1, next + k, next + k + 1});
        }
        if (j > 0) faces.push_back({here + 5, next, here});
        if (j < last) faces.push_back({here + 5, next + 5, next});
    }
    // Where a fan turns back to its wall, a blade may run the other way round the axis than its thickness points.
    Mesh& mesh = roots_.mesh;
    double volume = 0.0;
    const glm::dvec3 origin(mesh.positions[first]);
    for (const auto& [a, b, c] : faces)
        volume += glm::dot(glm::dvec3(mesh.positions[a]) - origin,
                           glm::cross(glm::dvec3(mesh.positions[b]) - origin,
                                      glm::dvec3(mesh.positions[c]) - origin));
    if (volume < 0.0)
        for (std::uint32_t row = first; row < mesh.positions.size(); row += row_corners)
            for (std::uint32_t k = 0; k < row_corners / 2; ++k) {
                std::swap(mesh.positions[row + k], mesh.positions[row + row_corners - 1 - k]);
                std::swap(mesh.normals[row + k], mesh.normals[row + row_corners - 1 - k]);
                if (!mesh.tangents.empty())
                    std::swap(mesh.tangents[row + k], mesh.tangents[row + row_corners - 1 - k]);
            }
    if (drawn)
        for (const auto& face : faces)
            mesh.indices.insert(mesh.indices.end(), face.begin(), face.end());
    rows_.clear();
}

void Builder::blades(const BladeBudget& shares) {
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
            runs += here * running_down(*w.h) * w.h->depth;
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
        // No steeper than a taper where they run down but a little.
        const double beyond =
            shares.below > 0 ? std::min(0.55 * length * runs, 0.3 * down * stem.length()) : 0.0;
        plans_.clear();
        double most = 0.0;
        // Down the stem and up to where the blade begins on the face, for those that do.
        for (int j = 0; j < shares.below; ++j) {
            const double up = static_cast<double>(j) / shares.below;
            Plan plan;
            plan.along = begin * length - down * stem.length() * (1.0 - up);
            plan.height = beyond * smooth_step(0.0, 1.0, up);
            // What hardly runs down begins where it does in a species that does not: in the flesh.
            plan.buried = std::max(0.0, 1.0 - down / least_decurrence);
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
                plan.height += w.weight * blade.presence * rise * w.h->depth *
                               attachment(*w.h, share) * envelope(*w.h, share);
            }
            plan.height *= length * face_.at(share).scale;
            plan.height += beyond * (1.0 - smooth_step(0.0, 1.0, share / 0.25));
            plans_.push_back(plan);
        }
        for (const Plan& plan : plans_) most = std::max(most, plan.height);
        // A blade that is all but gone is as thin and short, and stands no deeper in the flesh.
        const auto left = [&](double full) {
            return std::min(1.0, most / (full * length + 1e-12));
        };
        const double own_middle = 0.4 * begin + 0.6;
        const Roots::Spot rest = roots_.vertex_near(own_middle, angle_at(own_middle));
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

// A vein is a low blade across the gap: both its ends are inside the ridges that it joins.
void Builder::veins(const BladeBudget& shares) {
    const double length = face_.length();
    const std::uint32_t seed = individual_.effective.seed;
    for (const SpeciesShare& part : individual_.parts) {
        const HymeniumOf<Plain>& h = part.model.hymenium;
        const std::vector<CrossVein> all = built_veins(part, shares, seed);
        if (all.empty()) continue;
        const BladeRow row_of(stand_on(0, HymeniumPattern::ridges, h.blades, h.tiers),
                              HymeniumPattern::ridges, h.forking, seed, h.blades << h.tiers);
        const double half = vein_width * length / cross_vein_rows(h.blades);
        for (const CrossVein& vein : all) {
            plans_.clear();
            const double full = part.weight * vein.height * 0.45 * length * h.depth;
            double most = 0.0;
            for (int j = 0; j <= vein_segments; ++j) {
                const double t = vein_rows[static_cast<std::size_t>(j)];
                const double share = vein.share + (t - 0.5) * vein.tilt;
                const double gaps = vein.ridge + t;
                Plan plan;
                plan.along = share * length;
                plan.angle = 2.0 * pi * row_of.turn({.from = gaps, .to = gaps}, share);
                plan.height =
                    full * attachment(h, share) * envelope(h, share) * face_.at(share).scale;
                plan.half = half;
                most = std::max(most, plan.height);
                plans_.push_back(plan);
            }
            const auto left = [&](double whole) {
                return std::min(1.0, most / (whole * length + 1e-12));
            };
            const Roots::Spot rest =
                roots_.vertex_near(vein.share, 0.5 * (plans_[1].angle + plans_[2].angle));
            for (Plan& plan : plans_) {
                plan.along = length * rest.share + left(0.006) * (plan.along - length * rest.share);
                plan.angle = rest.angle + left(0.006) * (plan.angle - rest.angle);
                plan.half *= left(0.006);
                row(plan, left(0.01));
            }
            for (std::size_t j = 0; j < rows_.size(); ++j) {
                const glm::dvec3 along = rows_[std::min(j + 1, rows_.size() - 1)].root.position -
                                         rows_[j == 0 ? 0 : j - 1].root.position;
                // A vein is thick along the meridian; its image runs along itself.
                rows_[j].share = vein.share + 0.06 * (static_cast<double>(j) / vein_segments - 0.5);
                rows_[j].root.azimuth =
                    unit_or(glm::cross(rows_[j].root.meridian, along), rows_[j].root.azimuth);
            }
            append(0.7, 0.85, most > 0.0 || ground_.keep_absent);
        }
    }
}

}  // namespace

BladeBudget blade_budget(const Individual& individual, bool beside_pores) {
    BladeBudget shares;
    while (built_vein_count(individual, shares.vein_stride) > most_veins) ++shares.vein_stride;
    shares.veins = built_vein_count(individual, shares.vein_stride);
    const Comb& comb = individual.comb;
    const int budget = beside_pores ? most_blade_triangles / 6 : most_blade_triangles;
    shares.tiers = individual.blade_tiers;
    shares.below = individual.runs_down ? stem_segments : 0;
    // Rows down the stem go first, then the shortest blades.
    const auto too_many = [&] {
        return (comb.blades << shares.tiers) * triangles_of(face_segments + shares.below) > budget;
    };
    while (shares.below > 1 && too_many()) --shares.below;
    while (shares.tiers > 0 && too_many()) --shares.tiers;
    shares.segments = face_segments;
    return shares;
}

bool coarsen(const Individual& individual, BladeBudget& budget) {
    if (budget.tiers > 0)
        --budget.tiers;
    else if (budget.veins > least_veins)
        budget.veins = built_vein_count(individual, ++budget.vein_stride);
    else if (budget.segments > least_segments)
        --budget.segments;
    else
        return false;
    return true;
}

MeshCount solid_count(const Individual& individual, const BladeBudget& budget) {
    MeshCount count;
    const int segments = budget.segments + budget.below;
    for_each_blade(individual, budget, [&](int) {
        count.vertices += row_corners * static_cast<std::uint64_t>(segments + 1);
        count.triangles += static_cast<std::uint64_t>(triangles_of(segments));
    });
    count.vertices += row_corners * static_cast<std::uint64_t>(budget.veins * (vein_segments + 1));
    count.triangles += static_cast<std::uint64_t>(budget.veins * triangles_of(vein_segments));
    return count;
}

void add_blades(const Roots& roots, const BladeBudget& budget) {
    Builder builder(roots);
    if (roots.individual.comb.blades > 0) builder.blades(budget);
    if (budget.veins > 0) builder.veins(budget);
}

}  // namespace sporeprint
