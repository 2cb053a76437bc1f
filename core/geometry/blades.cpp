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

// No source or measurement is recorded for the values down to `vein_depth`.

// Rows of a blade on the face. They are equal in all but large sets, so that weight 1 reproduces
// the single-species mesh.
constexpr int face_segments = 11, usual_segments = 6, least_segments = 3;
constexpr int stem_segments = 3, usual_below = 2;
constexpr int most_blade_triangles = 36000, most_smooth_triangles = 29000;
constexpr std::size_t row_corners = 6;
constexpr int vein_segments = 4, usual_vein_segments = 3, least_veins = 100, most_veins = 400;
/// Half the width of the last veins, relative to their distance from the margin.
constexpr double margin_vein = 0.2;

// Decurrence from which on blades stand on the stem's surface, as a share of its length: all
// decurrent species of the atlas have more.
constexpr double least_decurrence = 0.01;

// Heights below which a blade counts as vanishing, in lengths of the meridian: its place moves to
// the nearest vertex, it becomes thin, short and less deeply embedded.
constexpr double vanishing_place = 0.003, vanishing_width = 0.004, vanishing_length = 0.015,
                 vanishing_embedding = 0.01, vanishing_vein = 0.006;

// Share by which rows of a blade are moved towards the stem, where its edge is most curved.
constexpr double row_crowding = 0.55;

// Shortest part of a decurrent blade on the stem, in that of the longest: blades do not end in a line,
// and few are long.
constexpr double shortest_down = 0.15;

// Share of the meridian within which blades that are not decurrent begin at the stem, and the
// shares before the margin between which blades end: unlike each other, so that neither line is
// drawn sharply, and before the margin, which stays a smooth curve.
constexpr double begins_within = 0.035, ends_before = 0.006, ends_within = 0.022;

// Shares of the meridian over which a blade that is not decurrent, and the outer end of each, are
// rounded.
constexpr double begin_rounding = 0.035, end_rounding = 0.045, ridge_end = 0.24;

// Share of the meridian within which the first rows of a decurrent blade stand, where it turns from
// the stem to the cap.
constexpr double turning = 0.17;

// Rows of a blade within either rounded end, and the share of it after which the second one stands.
constexpr int end_rows = 2;
constexpr double second_row = 0.22;

// Largest part of its depth by which a blade is shallower than others, and by which its edge is
// eroded between undulations; undulations from stem to margin.
constexpr double shallower = 0.12, eroded = 0.1, least_undulations = 1.0, most_undulations = 2.4;

// Length of the rise of a short blade, relative to that of the gill layout, and its thickness
// where it begins, relative to that where it has its whole height.
constexpr double shortest_rise = 1.0, longest_rise = 2.3, rising_thickness = 0.4;

// Share of the meridian up to which the edge of a decurrent blade is a curve from the stem.
constexpr double curve_reach = 0.3;

// Height by which the curve lies beyond the edge from which on it is followed, in that of the blade.
constexpr double least_filling = 0.12;

// Share of the meridian over which the part of a decurrent blade beyond the outline ends.
constexpr double protrusion_fades = 0.25;

// Share of the gap between two blades at the stem that both fill at most.
constexpr double usable_gap = 0.62;

// Amplitude of ripples for a species with full edge waves, in half thicknesses.
constexpr double ripple_size = 0.275;

// Waves of a ripple from stem to margin, random, and factor on them for the second wave.
constexpr double least_ripples = 1.0, most_ripples = 2.2, second_ripple = 1.7;

// Shares of the meridian at stem and margin over which ripples fade out.
constexpr double ripple_begins = 0.15, ripple_ends = 0.2;

// Height of the shoulder of gills and its decrease for ridges, in depths; thickness there and its
// increase for ridges, in that at the base.
constexpr double gill_shoulder = 0.92, ridge_bluntness = 0.34, gill_waist = 0.62, ridge_waist = 0.2;

// The same of cross veins.
constexpr double vein_shoulder = 0.7, vein_waist = 0.85;

// Largest share of the meridian at which a blade of a mix begins, and of the stem that it covers.
constexpr double last_begin = 0.97, most_down = 0.98;

// Depth of the base of a blade on the stem: in heights of the blade, and at most in radii.
constexpr double stem_depth = 0.3, most_stem_depth = 0.05;

// Depth, in lengths of the meridian, below which a blade is extended less deep into the flesh.
constexpr double shallow = 0.01;

// How far the normals of shoulders lean to the edge.
constexpr double shoulder_lean = 0.4;

// Rise of a short blade from its beginning, relative to that of the gill layout.
constexpr double rise_steepness = 0.65;

// Share of the blades' image along which one blade reaches.
constexpr double image_window = 0.6;

// Share of a blade's length after which its middle lies.
constexpr double blade_middle = 0.6;

// Factor from the share of the stem that a blade covers to its relative thickness there, at most 1.
constexpr double decurrent_thickness = 12.0;

// Largest height of a decurrent blade beyond the outline: in depths, and in lengths of the part on
// the stem, so that a hardly decurrent blade tapers.
constexpr double protrusion = 0.55, most_protrusion = 0.2;

// Length of a cross vein on the blades' image, in lengths of the meridian.
constexpr double vein_texture_length = 0.06;

// Depth of a cross vein of full height, relative to that of ridges; the shares of it and of the
// width that are missing half-way; and how far a vein bends, in its tilt.
constexpr double vein_depth = 0.46, vein_sag = 0.15, vein_narrowing = 0.25, vein_bend = 0.35;

constexpr int triangles_of(int segments) { return 10 * segments - 2; }

/// Returns the cross veins of one species that are built, absent ones included.
std::vector<CrossVein> built_veins(const SpeciesShare& part, const BladeBudget& budget,
                                   std::uint32_t seed) {
    std::vector<CrossVein> built;
    if (part.model.surface.hymenium.pattern != HymeniumPattern::ridges) return built;
    const HymeniumOf<Plain>& hymenium = part.model.hymenium;
    const std::vector<CrossVein> all = cross_veins(hymenium.blades, hymenium.forking, seed);
    for (std::size_t i = 0; i < all.size(); i += static_cast<std::size_t>(budget.vein_stride))
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

/// Returns the tier of a slot when all tiers are filled; -1 for blades that reach the stem.
int tier_of(int slot, int tiers) {
    if (slot % (1 << tiers) == 0) return -1;
    int zeros = 0;
    while ((slot >> zeros & 1) == 0) ++zeros;
    return tiers - 1 - zeros;
}

/// Visits the slots that are built. All have the same number of rows, because a blade that reaches
/// the stem in one species may be short in another.
template <class Work>
void for_each_blade(const Individual& individual, const BladeBudget& budget, const Work& work) {
    const int slots = individual.gill_layout.blades << individual.blade_tiers;
    for (int slot = 0; slot < slots; ++slot) {
        if (tier_of(slot, individual.blade_tiers) < budget.tiers) work(slot);
    }
}

/// The blades of one species on the slots of the set. A slot only says which blades of two species
/// correspond; each blade stands at its own place, so that weight 1 reproduces the species itself,
/// and no blade is farther from its slot than half the distance to the next.
struct SpeciesBlades {
    double weight;
    const HymeniumOf<Plain>* hymenium;
    bool ridges;
    BladeRow row;

    [[nodiscard]] const Blade& on(int slot) const {
        return row.blades()[static_cast<std::size_t>(slot)];
    }
};

std::vector<SpeciesBlades> species_blades(const Individual& individual) {
    std::vector<SpeciesBlades> out;
    for (const SpeciesShare& part : individual.parts) {
        const HymeniumPattern pattern = part.model.surface.hymenium.pattern;
        if (!is_bladed(pattern) || part.weight <= 0.0) continue;
        const HymeniumOf<Plain>& hymenium = part.model.hymenium;
        out.push_back({part.weight, &hymenium, pattern == HymeniumPattern::ridges,
                       BladeRow(slot_assignment(0, pattern, hymenium.blades, hymenium.tiers),
                                pattern, hymenium.forking, individual.painted_seed,
                                individual.gill_layout.blades << individual.blade_tiers)});
    }
    return out;
}

/// Sideways displacement of a blade along the meridian, and how far it runs down the stem.
struct Ripple {
    double size, pitch, phase, other;
    double down;                 ///< in the length of the longest blade on the stem
    double start, finish;        ///< 0..1: how late it begins at the stem, how early it ends
    double shallow;              ///< 0..1: how much shallower than others it is
    double undulations, offset;  ///< waves of its edge
    double image;                ///< 0..1: place of its window of the blades' image
    double rise;                 ///< factor on the length over which a short blade rises

    Ripple(std::uint32_t seed, int number, double with_size) : size(with_size) {
        Random random(seed, purposes::blade_ripple, static_cast<std::uint32_t>(number));
        phase = random.uniform();
        other = random.uniform();
        pitch = random.uniform(least_ripples, most_ripples);
        const double long_down = random.uniform();
        down = shortest_down + (1.0 - shortest_down) * long_down * (0.4 + 0.6 * long_down);
        start = random.uniform();
        finish = random.uniform();
        shallow = random.uniform();
        undulations = random.uniform(least_undulations, most_undulations);
        offset = random.uniform();
        rise = random.uniform(shortest_rise, longest_rise);
        image = random.uniform();
    }
    /// Returns the depth of its edge at a share of the meridian, relative to that of the species.
    [[nodiscard]] double depth(double share) const {
        const double wave =
            0.5 + 0.5 * cubic_wave(undulations * share * (1.0 + 0.5 * share) + offset);
        return 1.0 - shallower * shallow - eroded * shallow * wave;
    }
    [[nodiscard]] double at(double share) const {
        return size * (cubic_wave(pitch * share + phase) +
                       0.5 * cubic_wave(second_ripple * pitch * share + other));
    }
};

/// Values that all blades of a mesh share: means over the species by weight.
struct BladeShape {
    double half;      ///< half thickness, metres
    double shoulder;  ///< height of the shoulder, as a share of the depth
    double waist;     ///< thickness at the shoulder, as a share of that at the base
    double crowd;     ///< number of blades that reach the stem, at least 1
};

/// Returns the shape of blades on a face with radius `rim` at the margin. Blades have the same
/// thickness along their length, except where they are close together at the stem; those of ridges
/// are blunter than those of gills.
BladeShape blade_shape(const std::vector<SpeciesBlades>& all, double rim) {
    double half_sum = 0.0, blunt = 0.0, weight = 0.0, reaching = 0.0;
    for (const SpeciesBlades& w : all) {
        const double gap = 2.0 * pi * rim /
                           static_cast<double>(w.ridges ? w.hymenium->blades
                                                        : w.hymenium->blades << w.hymenium->tiers);
        half_sum += w.weight * 0.5 * w.hymenium->thickness * gap;
        blunt += w.weight * (w.ridges ? 1.0 : 0.0);
        reaching += w.weight * w.hymenium->blades;
        weight += w.weight;
    }
    const double per = weight > 0.0 ? 1.0 / weight : 0.0;
    return {half_sum * per, gill_shoulder - ridge_bluntness * blunt * per,
            gill_waist + ridge_waist * blunt * per, std::max(reaching * per, 1.0)};
}

/// The blades of all species on one slot, combined by weight and presence.
struct SlotBlend {
    int slot = 0;
    double even = 0.0;         ///< position of the slot, in turns
    double present = 0.0;      ///< sum of weight times presence
    double each = 0.0;         ///< 1 / present, or 0
    double begin = 0.0;        ///< on the meridian, 0 at the stem
    double end = 1.0;          ///< the same, 1 at the margin
    double rounded_end = 0.0;  ///< share of the meridian over which its outer end is rounded
    double down = 0.0;         ///< share of the stem's length that the blade covers
    double image = 0.0;        ///< where its window of the blades' image begins
    double protruding = 0.0;   ///< depth beyond the outline where the blade is decurrent
    std::vector<Ripple> ripples;
};

SlotBlend blended_slot(const std::vector<SpeciesBlades>& all, int slot, int slots,
                       std::uint32_t seed) {
    SlotBlend blend;
    blend.slot = slot;
    blend.even = static_cast<double>(slot) / slots;
    blend.ripples.reserve(all.size());
    for (const SpeciesBlades& w : all) {
        const Blade& blade = w.on(slot);
        const double here = w.weight * blade.presence;
        blend.ripples.emplace_back(seed, blade.number, here * w.hymenium->edge_waves);
        blend.present += here;
        const Ripple& own = blend.ripples.back();
        blend.begin += here * std::max(blade.begin, w.hymenium->inner_gap);
        blend.image += here * (1.0 - image_window) * own.image;
        blend.rounded_end += here * (w.ridges ? ridge_end : end_rounding);
        blend.end -= here * (ends_before + ends_within * own.finish);
        if (blade.begin > 0.0) continue;
        blend.begin += here * begins_within * own.start * (1.0 - decurrence(*w.hymenium));
        blend.down += here * w.hymenium->decurrent * own.down;
        blend.protruding += here * decurrence(*w.hymenium) * w.hymenium->depth;
    }
    blend.each = blend.present > 0.0 ? 1.0 / blend.present : 0.0;
    blend.begin = blend.present > 0.0 ? std::min(blend.begin * blend.each, last_begin) : 0.5;
    blend.rounded_end *= blend.each;
    blend.end = std::max(1.0 - (1.0 - blend.end) * blend.each, 0.5 * (1.0 + blend.begin));
    blend.image *= blend.each;
    blend.down = std::min(blend.down * blend.each, most_down);
    return blend;
}

/// Returns the angle at which the blade of a slot crosses a share of the meridian.
double angle_at(const std::vector<SpeciesBlades>& all, const SlotBlend& blend, double share) {
    if (blend.present <= 0.0) return 2.0 * pi * blend.even;
    double turn = 0.0;
    for (const SpeciesBlades& w : all) {
        const Blade& blade = w.on(blend.slot);
        if (blade.presence <= 0.0) continue;
        // The first blade stands on both sides of the seam, so its turn is taken modulo 1.
        const double own = w.row.turn(blade, share);
        turn += w.weight * blade.presence * (own - std::floor(own - blend.even + 0.5));
    }
    return 2.0 * pi * turn * blend.each;
}

class Builder {
  public:
    explicit Builder(const Attachment& attachment)
        : attachment_(attachment),
          individual_(attachment.individual),
          face_(attachment.face),
          context_(attachment.context) {}

    void blades(const BladeBudget& budget);
    void veins(const BladeBudget& budget);

  private:
    /// One cross-section of a blade: its base point, with the directions of depth and thickness.
    struct Row {
        SurfacePoint root;     ///< meridian: direction of depth; azimuth: direction of thickness
        glm::dvec3 base{0.0};  ///< direction of thickness at the root
        double along = 0.0, share = 0.0, height = 0.0, half = 0.0, stray = 0.0;
    };
    /// The part of the edge of a decurrent blade that is a curve.
    struct EdgeCurve {
        double strength = 0.0;   ///< 0..1: the share by which the edge is moved onto it
        std::size_t corner = 0;  ///< row at the end of the stem
        double to = 0.0;         ///< metres along the face up to which it reaches
    };
    /// The same in coordinates of the face, before it is placed in space.
    struct Plan {
        /// Metres from the top of the stem along the face; below 0 down the stem.
        double along = 0.0;
        /// 0..1: how far a base point on the stem is sunk into the flesh, as on the face.
        double buried = 0.0;
        double angle = 0.0, height = 0.0, stray = 0.0;
        double half = 1.0;  ///< at first relative to that of the other blades
    };
    void plan_stem_rows(const BladeBudget& budget, const SlotBlend& blend, double beyond);
    void plan_face_rows(const std::vector<SpeciesBlades>& all, const BladeBudget& budget,
                        const SlotBlend& blend, double beyond);
    void place_blade(const std::vector<SpeciesBlades>& all, const BladeBudget& budget,
                     const BladeShape& shape, const SlotBlend& blend, double most);
    void plan_vein(const SpeciesShare& part, const CrossVein& vein, const BladeRow& row_of,
                   const BladeBudget& budget);
    void place_vein(const CrossVein& vein, double most, const BladeBudget& budget);
    void row(const Plan& plan, double embedding);
    /// Returns the direction of the blade at a row, from its neighbours.
    [[nodiscard]] glm::dvec3 along_at(std::size_t j) const;
    void straighten();
    [[nodiscard]] std::vector<glm::dvec3> edge_offsets(const EdgeCurve& curve) const;
    void append_rows(double shoulder, double waist, const EdgeCurve& curve);
    void append(double shoulder, double waist, bool drawn, const EdgeCurve& curve);

    const Attachment& attachment_;
    const Individual& individual_;
    const LowerFace& face_;
    const OrnamentContext& context_;
    std::vector<Plan> plans_;
    std::vector<Row> rows_;
};

// Base points are sunk into the flesh; those of vanishing blades less so (embedding 1 to 0),
// otherwise the rest of an absent species would stay visible under the surface.
void Builder::row(const Plan& plan, double embedding) {
    Row row;
    row.half = plan.half;
    row.along = plan.along;
    const SubCurve& stem = context_.outline.stem;
    if (plan.along < 0.0) {
        OutlineSample root = stem.at(1.0 + plan.along / stem.length());
        const double deep = std::min(stem_depth * plan.height, most_stem_depth * root.r);
        row.height = plan.height + deep;
        const AxisStation station =
            context_.deformer.station(root.share == 1.0 ? context_.deformer.top() : root.y);
        root.r -= deep * root.tangent_y;
        root.y += deep * root.tangent_r;
        const OutlineSample inner = attachment_.at(0.0, embedding), stem_end = stem.at(1.0);
        root.r += plan.buried * (inner.r - stem_end.r);
        root.y += plan.buried * (inner.y - stem_end.y);
        row.root = attachment_.blade_root(Part::stem, root, plan.angle, station).point;
        row.base = row.root.azimuth;
    } else {
        const double whole = plan.along / std::max(face_.length(), 1e-12);
        // Where the margin is cut back, blades end with it.
        const double share = context_.cuts.lower(whole, plan.angle);
        const double deep = embedding * face_.at(share).sink;
        row.share = whole;
        row.height =
            plan.height + deep * std::min(1.0, plan.height / (shallow * face_.length() + 1e-12));
        row.stray = plan.stray;
        const OutlineSample root = attachment_.at(share, embedding);
        const AxisStation station = context_.deformer.frozen_station(context_.deformer.top());
        const BladeRoot placed = attachment_.blade_root(Part::hymenium, root, plan.angle, station);
        row.root = placed.point;
        row.base = placed.base;
    }
    rows_.push_back(row);
}

// Returns the displacements of the edge of a decurrent blade onto a quadratic curve from its end on
// the stem to the face: the outline has a corner at the end of the stem, which a blade fills.
std::vector<glm::dvec3> Builder::edge_offsets(const EdgeCurve& curve) const {
    std::vector<glm::dvec3> offsets(rows_.size(), glm::dvec3(0.0));
    if (curve.strength <= 0.0) return offsets;
    const auto edge = [&](std::size_t j) {
        return rows_[j].root.position + rows_[j].height * rows_[j].root.meridian;
    };
    std::size_t last = curve.corner + 1;
    while (last + 1 < rows_.size() && rows_[last].along < curve.to) ++last;
    const Row &before = rows_[last - 1], &after = rows_[last];
    const double t = std::clamp(
        (curve.to - before.along) / std::max(after.along - before.along, 1e-12), 0.0, 1.0);
    const glm::dvec3 from = edge(0), corner = edge(curve.corner),
                     to = edge(last - 1) + t * (edge(last) - edge(last - 1));
    const double span = std::max(curve.to - rows_[0].along, 1e-12);
    for (std::size_t j = 1; j < last; ++j) {
        const double u = std::clamp((rows_[j].along - rows_[0].along) / span, 0.0, 1.0);
        const glm::dvec3 point =
            (1.0 - u) * (1.0 - u) * from + 2.0 * u * (1.0 - u) * corner + u * u * to;
        // Where the outline bends the other way, the edge stays where it is.
        const glm::dvec3 offset = point - edge(j);
        const double outwards = glm::dot(offset, rows_[j].root.meridian) /
                                (least_filling * std::max(rows_[j].height, 1e-9));
        offsets[j] = curve.strength * std::clamp(outwards, 0.0, 1.0) * offset;
    }
    return offsets;
}

glm::dvec3 Builder::along_at(std::size_t j) const {
    return rows_[std::min(j + 1, rows_.size() - 1)].root.position -
           rows_[j == 0 ? 0 : j - 1].root.position;
}

// Where a fan turns back to its substrate, some rows of a blade may have their thickness against that
// of the others. They become thin, or the blade would intersect itself.
void Builder::straighten() {
    std::vector<double> agreement;
    double sum = 0.0;
    for (std::size_t j = 0; j < rows_.size(); ++j) {
        const SurfacePoint& root = rows_[j].root;
        const glm::dvec3 side = glm::cross(root.meridian, along_at(j));
        agreement.push_back(
            glm::dot(unit_or(side, root.azimuth), unit_or(root.azimuth, glm::dvec3(0.0))));
        sum += rows_[j].half * rows_[j].height * agreement.back();
    }
    constexpr double steepness = 4.0;
    for (std::size_t j = 0; j < rows_.size(); ++j)
        rows_[j].half *= std::clamp(steepness * (sum < 0.0 ? -1.0 : 1.0) * agreement[j], 0.0, 1.0);
}

// A row has six corners: root, shoulder and tip of one face; tip, shoulder and root of the other.
// The first and the last row have no thickness, so that both faces meet there and the solid is
// closed.
void Builder::append_rows(double shoulder, double waist, const EdgeCurve& curve) {
    straighten();
    const std::vector<glm::dvec3> offsets = edge_offsets(curve);
    for (std::size_t j = 0; j < rows_.size(); ++j) {
        const Row& row = rows_[j];
        const glm::dvec3 &root = row.root.position, &deep = row.root.meridian,
                         &thick = row.root.azimuth;
        const glm::dvec3 along = along_at(j);
        const glm::dvec3 down = unit_or(deep, {0.0, -1.0, 0.0});
        const glm::dvec3 side = unit_or(glm::cross(along, down), unit_or(-thick, {1.0, 0.0, 0.0}));
        const double half = j == 0 || j + 1 == rows_.size() ? 0.0 : row.half;
        const glm::dvec3 bent = root + row.stray * thick;
        const glm::dvec3 middle = bent + shoulder * (row.height * deep + offsets[j]),
                         tip = bent + row.height * deep + row.stray * thick + offsets[j];
        const glm::dvec3 leaning = unit_or(side + shoulder_lean * down, side),
                         other = unit_or(-side + shoulder_lean * down, -side);
        const double u = row.share;
        attachment_.add_vertex(root - half * row.base, side, along, u, 0.0, -1.0F);
        attachment_.add_vertex(middle - waist * half * thick, leaning, along, u, shoulder, -1.0F);
        attachment_.add_vertex(tip, down, along, u, 1.0, -1.0F);
        attachment_.add_vertex(tip, down, along, u, 1.0, 1.0F);
        attachment_.add_vertex(middle + waist * half * thick, other, along, u, shoulder, 1.0F);
        attachment_.add_vertex(root + half * row.base, -side, along, u, 0.0, 1.0F);
    }
}

// Returns the triangles of a blade of some rows, whose vertices begin at `first`.
std::vector<std::array<std::uint32_t, 3>> blade_faces(std::uint32_t first, std::size_t rows) {
    std::vector<std::array<std::uint32_t, 3>> faces;
    const auto last = static_cast<std::uint32_t>(rows) - 2;
    for (std::uint32_t j = 0; j <= last; ++j) {
        const auto here = first + static_cast<std::uint32_t>(row_corners) * j;
        const auto next = here + static_cast<std::uint32_t>(row_corners);
        for (const std::uint32_t k : {3U, 4U}) {
            faces.push_back({here + k, next + k, here + k + 1});
            faces.push_back({here + k + 1, next + k, next + k + 1});
        }
        // The diagonals of both faces lie opposite each other, so that a bent blade stays thick.
        for (const std::uint32_t k : {0U, 1U}) {
            faces.push_back({here + k, next + k, next + k + 1});
            faces.push_back({here + k, next + k + 1, here + k + 1});
        }
        if (j > 0) faces.push_back({here + 5, next, here});
        if (j < last) faces.push_back({here + 5, next + 5, next});
    }
    return faces;
}

// Returns six times the volume of a blade whose vertices begin at `first`.
double volume_of(const Mesh& mesh, std::uint32_t first,
                 const std::vector<std::array<std::uint32_t, 3>>& faces) {
    double volume = 0.0;
    const glm::dvec3 origin(mesh.positions[first]);
    for (const auto& [a, b, c] : faces)
        volume += glm::dot(glm::dvec3(mesh.positions[a]) - origin,
                           glm::cross(glm::dvec3(mesh.positions[b]) - origin,
                                      glm::dvec3(mesh.positions[c]) - origin));
    return volume;
}

// Swaps both sides of a blade, whose vertices are the last of the mesh and begin at `first`, if its
// faces point inwards. Where a fan turns back to its substrate, a blade may run round the axis
// against its thickness direction. A tiny blade that is bent to a hook has more volume inside out
// than outside in either way: it becomes a sheet.
void orient_blade(Mesh& mesh, std::uint32_t first,
                  const std::vector<std::array<std::uint32_t, 3>>& faces) {
    if (!(volume_of(mesh, first, faces) < 0.0)) return;
    const auto for_each_pair = [&](const auto& visit) {
        for (std::uint32_t row = first; row < mesh.positions.size(); row += row_corners)
            for (std::uint32_t k = 0; k < row_corners / 2; ++k)
                visit(row + k, row + static_cast<std::uint32_t>(row_corners) - 1 - k);
    };
    for_each_pair([&](std::uint32_t one, std::uint32_t other) {
        std::swap(mesh.positions[one], mesh.positions[other]);
        std::swap(mesh.normals[one], mesh.normals[other]);
        if (!mesh.tangents.empty()) std::swap(mesh.tangents[one], mesh.tangents[other]);
    });
    if (!(volume_of(mesh, first, faces) < 0.0)) return;
    for_each_pair([&](std::uint32_t one, std::uint32_t other) {
        mesh.positions[one] = mesh.positions[other] =
            0.5F * (mesh.positions[one] + mesh.positions[other]);
    });
}

// Appends the placed rows as a blade; without `drawn` only its vertices.
void Builder::append(double shoulder, double waist, bool drawn, const EdgeCurve& curve) {
    Mesh& mesh = attachment_.mesh;
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    append_rows(shoulder, waist, curve);
    const auto faces = blade_faces(first, rows_.size());
    orient_blade(mesh, first, faces);
    if (drawn)
        for (const auto& face : faces)
            mesh.indices.insert(mesh.indices.end(), face.begin(), face.end());
    rows_.clear();
}

/// Returns the share of the meridian over which an end of a blade is rounded: more than 0, also where a
/// species has no blade.
double rounding(double most, double length) {
    return std::max(std::min(most, 0.25 * length), 1e-6);
}

/// Returns the share of the meridian at which a row of a blade stands: some are within its rounded
/// ends, the others between them.
///
/// rounded_begin, rounded_end  shares over which its ends are rounded
double row_share(int row, int segments, double begin, double end, double rounded_begin,
                 double rounded_end) {
    const double first = rounding(rounded_begin, end - begin),
                 last = rounding(rounded_end, end - begin);
    const int rows = std::min(end_rows, (segments - 2) / 4);
    const auto within = [&](int at) { return at == 0 ? 0.0 : at == rows ? 1.0 : second_row; };
    if (row <= rows) return begin + first * within(row);
    if (segments - row <= rows) return end - last * within(segments - row);
    const double t = static_cast<double>(row - rows) / (segments - 2 * rows);
    return begin + first + (end - last - begin - first) * t * (1.0 - row_crowding * (1.0 - t));
}

/// Returns the height of a quarter of a circle, which rises from 0 at 0 to 1 at 1 and beyond.
double rounded(double x) {
    const double left = 1.0 - std::clamp(x, 0.0, 1.0);
    return std::sqrt(1.0 - left * left);
}

// Rows on the stem, up to where the blade begins on the face, for decurrent blades.
void Builder::plan_stem_rows(const BladeBudget& budget, const SlotBlend& blend, double beyond) {
    const double stem_length = context_.outline.stem.length();
    for (int j = 0; j < budget.below; ++j) {
        const double up = static_cast<double>(j) / budget.below;
        Plan plan;
        plan.along = blend.begin * face_.length() - blend.down * stem_length * (1.0 - up);
        // It ends as thin and as low as it can be, along the stem.
        plan.height = beyond * up * up * (1.6 - 0.6 * up);
        plan.half = up * (2.0 - up);
        // A blade that is hardly decurrent begins in the flesh, where it does in a species that is
        // not.
        plan.buried = std::max(0.0, 1.0 - blend.down / least_decurrence);
        plans_.push_back(plan);
    }
}

// Rows on the face, from the beginning of the blade to the margin.
void Builder::plan_face_rows(const std::vector<SpeciesBlades>& all, const BladeBudget& budget,
                             const SlotBlend& blend, double beyond) {
    const double length = face_.length();
    const double begin = blend.begin, reach = blend.end - begin;
    const double decurrent = std::min(1.0, decurrent_thickness * blend.down);
    for (int j = 0; j <= budget.segments; ++j) {
        const double share =
            row_share(j, budget.segments, begin, blend.end,
                      begin_rounding + decurrent * (turning - begin_rounding), blend.rounded_end);
        Plan plan;
        plan.along = share * length;
        double risen = 0.0;
        for (std::size_t i = 0; i < all.size(); ++i) {
            const SpeciesBlades& w = all[i];
            const Blade& blade = w.on(blend.slot);
            if (blade.presence <= 0.0) continue;
            const Ripple& own = blend.ripples[i];
            const double rise =
                blade.rise > 0.0
                    ? smooth_step(0.0, 1.0,
                                  rise_steepness * (share - begin) / (blade.rise * own.rise))
                    : 1.0;
            risen += w.weight * blade.presence * rise;
            plan.height += w.weight * blade.presence * rise * own.depth(share) * w.hymenium->depth *
                           attached_depth(*w.hymenium, share) * depth_envelope(*w.hymenium, share);
        }
        // Both ends are rounded, seen from below and from the side; where a blade continues down the
        // stem it does not end at its beginning on the face.
        const double first = rounded((share - begin) / rounding(begin_rounding, reach)),
                     last = rounded((blend.end - share) / rounding(blend.rounded_end, reach));
        const double ends = (decurrent + (1.0 - decurrent) * first) * last;
        plan.half = ends * (rising_thickness + (1.0 - rising_thickness) * risen * blend.each);
        plan.height *= length * face_.at(share).scale * ends;
        plan.height += beyond * (1.0 - smooth_step(0.0, 1.0, share / protrusion_fades));
        plans_.push_back(plan);
    }
}

// Gives the planned rows their angles, thickness and ripples, and places them. A vanishing blade,
// of which `most` is the largest height, also becomes thin and short, and is sunk less deep into
// the flesh.
void Builder::place_blade(const std::vector<SpeciesBlades>& all, const BladeBudget& budget,
                          const BladeShape& shape, const SlotBlend& blend, double most) {
    const double length = face_.length();
    const SubCurve& stem = context_.outline.stem;
    const auto left = [&](double full) { return std::min(1.0, most / (full * length + 1e-12)); };
    const double own_middle = (1.0 - blade_middle) * blend.begin + blade_middle;
    const Attachment::FacePoint rest =
        attachment_.nearest_vertex(own_middle, angle_at(all, blend, own_middle));
    const double middle = length * (rest.share + left(vanishing_place) * (own_middle - rest.share));
    for (Plan& plan : plans_) {
        plan.along = middle + left(vanishing_length) * (plan.along - middle);
        const double share = std::max(plan.along, 0.0) / std::max(length, 1e-12);
        const double r =
            plan.along < 0.0 ? stem.at(1.0 + plan.along / stem.length()).r : face_.at(share).r;
        const double available = usable_gap * pi * r / shape.crowd;
        double ripple = 0.0;
        for (const Ripple& one : blend.ripples)
            if (one.size > 0.0) ripple += one.at(share);
        plan.angle =
            rest.angle + left(vanishing_place) * (angle_at(all, blend, share) - rest.angle);
        const double relative = plan.half;
        plan.half *= left(vanishing_width) * std::min(shape.half, available);
        // A blade that is not decurrent begins on the face as sharp as in a set without decurrent
        // species.
        if (&plan - plans_.data() <= budget.below)
            plan.half *= std::min(1.0, decurrent_thickness * blend.down);
        plan.stray = left(vanishing_width) * ripple_size * blend.each * relative *
                     std::min(available, 3.0 * shape.half) * ripple *
                     smooth_step(0.0, 1.0, share / ripple_begins) *
                     smooth_step(0.0, 1.0, (1.0 - share) / ripple_ends);
        row(plan, left(vanishing_embedding));
    }
}

void Builder::blades(const BladeBudget& budget) {
    const std::vector<SpeciesBlades> all = species_blades(individual_);
    const int slots = individual_.gill_layout.blades << individual_.blade_tiers;
    const double length = face_.length();
    const SubCurve& stem = context_.outline.stem;
    const BladeShape shape = blade_shape(all, face_.at(1.0).r);
    for_each_blade(individual_, budget, [&](int slot) {
        const SlotBlend blend = blended_slot(all, slot, slots, individual_.painted_seed);
        // The height of a slightly decurrent blade is limited to that of a taper.
        const double beyond = budget.below > 0
                                  ? std::min(protrusion * length * blend.protruding,
                                             most_protrusion * blend.down * stem.length())
                                  : 0.0;
        plans_.clear();
        plan_stem_rows(budget, blend, beyond);
        plan_face_rows(all, budget, blend, beyond);
        double most = 0.0;
        for (const Plan& plan : plans_) most = std::max(most, plan.height);
        place_blade(all, budget, shape, blend, most);
        const EdgeCurve curve{
            std::min(1.0, decurrent_thickness * blend.down) * (budget.below > 0 ? 1.0 : 0.0),
            static_cast<std::size_t>(budget.below), curve_reach * length};
        // On the image a blade begins where it does on the stem.
        const double below = std::min(rows_.front().along / std::max(length, 1e-12), 0.0);
        for (Row& row : rows_)
            row.share = blend.image + image_window * (row.along / std::max(length, 1e-12) - below) /
                                          (1.0 - below);
        append(shape.shoulder, shape.waist, most > 0.0 || context_.keep_absent, curve);
    });
}

// Plans the rows of a cross vein from one ridge to the next.
void Builder::plan_vein(const SpeciesShare& part, const CrossVein& vein, const BladeRow& row_of,
                        const BladeBudget& budget) {
    const HymeniumOf<Plain>& hymenium = part.model.hymenium;
    const double length = face_.length();
    const double half = vein_width * length / cross_vein_rows(hymenium.blades);
    const double full = part.weight * vein.height * vein_depth * length * hymenium.depth;
    plans_.clear();
    for (int j = 0; j <= budget.vein_segments; ++j) {
        // A vein rises from inside one ridge, sags between both and bends along its way.
        const double t = static_cast<double>(j) / budget.vein_segments;
        const double middle = 4.0 * t * (1.0 - t);
        const double share =
            std::clamp(vein.share + (t - 0.5) * vein.tilt +
                           vein_bend * vein.tilt * (middle - 0.5) * (2.0 * vein.height - 1.0),
                       0.0, 1.0);
        const double gaps = vein.ridge + t;
        Plan plan;
        plan.along = share * length;
        plan.angle = 2.0 * pi * row_of.turn({.from = gaps, .to = gaps}, share);
        plan.height = full * (1.0 - vein_sag * middle) * attached_depth(hymenium, share) *
                      depth_envelope(hymenium, share) * face_.at(share).scale;
        // The last veins become narrow, or they would leave the thin flesh at the margin.
        plan.half = std::min(half * (1.0 - vein_narrowing * middle),
                             margin_vein * std::max(1.0 - share, 0.0) * length);
        plans_.push_back(plan);
    }
}

// Places the planned rows of a vein, of which `most` is the largest height.
void Builder::place_vein(const CrossVein& vein, double most, const BladeBudget& budget) {
    const double length = face_.length();
    const auto left = [&](double whole) { return std::min(1.0, most / (whole * length + 1e-12)); };
    const std::size_t half = plans_.size() / 2;
    const Attachment::FacePoint rest =
        attachment_.nearest_vertex(vein.share, 0.5 * (plans_[half - 1].angle + plans_[half].angle));
    for (Plan& plan : plans_) {
        plan.along =
            length * rest.share + left(vanishing_vein) * (plan.along - length * rest.share);
        plan.angle = rest.angle + left(vanishing_vein) * (plan.angle - rest.angle);
        plan.half *= left(vanishing_vein);
        row(plan, left(vanishing_embedding));
    }
    for (std::size_t j = 0; j < rows_.size(); ++j) {
        const glm::dvec3 along = along_at(j);
        // A vein is thick along the meridian; its texture runs along its length.
        rows_[j].share = vein.share + vein_texture_length *
                                          (static_cast<double>(j) / budget.vein_segments - 0.5);
        rows_[j].base = rows_[j].root.azimuth =
            unit_or(glm::cross(rows_[j].root.meridian, along), rows_[j].root.azimuth);
    }
}

// A vein is a low blade across the gap: both its ends lie inside the ridges that it joins.
void Builder::veins(const BladeBudget& budget) {
    const std::uint32_t seed = individual_.painted_seed;
    for (const SpeciesShare& part : individual_.parts) {
        const HymeniumOf<Plain>& hymenium = part.model.hymenium;
        const std::vector<CrossVein> all = built_veins(part, budget, seed);
        if (all.empty()) continue;
        const BladeRow row_of(
            slot_assignment(0, HymeniumPattern::ridges, hymenium.blades, hymenium.tiers),
            HymeniumPattern::ridges, hymenium.forking, seed, hymenium.blades << hymenium.tiers);
        for (const CrossVein& vein : all) {
            plan_vein(part, vein, row_of, budget);
            double most = 0.0;
            for (const Plan& plan : plans_) most = std::max(most, plan.height);
            place_vein(vein, most, budget);
            append(vein_shoulder, vein_waist, most > 0.0 || context_.keep_absent, EdgeCurve{});
        }
    }
}

}  // namespace

BladeBudget blade_budget(const Individual& individual, bool beside_pores) {
    BladeBudget budget;
    while (built_vein_count(individual, budget.vein_stride) > most_veins) ++budget.vein_stride;
    budget.veins = built_vein_count(individual, budget.vein_stride);
    const GillLayout& gill_layout = individual.gill_layout;
    const int max_triangles = beside_pores ? most_blade_triangles / 6 : most_blade_triangles;
    budget.tiers = individual.blade_tiers;
    budget.below = individual.runs_down ? stem_segments : 0;
    budget.segments = face_segments;
    budget.vein_segments = vein_segments;
    // Rows are dropped first, then the shortest blades.
    const auto triangles = [&] {
        return (gill_layout.blades << budget.tiers) * triangles_of(budget.segments + budget.below);
    };
    const auto too_many = [&] { return triangles() > max_triangles; };
    while ((triangles() > most_smooth_triangles || too_many()) && drop_row(budget)) continue;
    while (budget.below > 1 && too_many()) --budget.below;
    while (budget.tiers > 0 && too_many()) --budget.tiers;
    return budget;
}

bool drop_row(BladeBudget& budget) {
    if (budget.segments > usual_segments)
        --budget.segments;
    else if (budget.below > usual_below)
        --budget.below;
    else if (budget.vein_segments > usual_vein_segments)
        --budget.vein_segments;
    else
        return false;
    return true;
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
    count.vertices +=
        row_corners * static_cast<std::uint64_t>(budget.veins * (budget.vein_segments + 1));
    count.triangles +=
        static_cast<std::uint64_t>(budget.veins * triangles_of(budget.vein_segments));
    return count;
}

void add_blades(const Attachment& attachment, const BladeBudget& budget) {
    Builder builder(attachment);
    if (attachment.individual.gill_layout.blades > 0) builder.blades(budget);
    if (budget.veins > 0) builder.veins(budget);
}

}  // namespace sporeprint
