#include "core/geometry/spines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <utility>
#include <vector>

#include "core/geometry/budget.h"
#include "core/geometry/grid_solid.h"
#include "core/math/direction.h"
#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/surface/charts.h"

namespace sporeprint {

namespace {

// No source or measurement is recorded for the values down to `taper`.

/// How much farther than SpineStyle::stand a spine stands out that does not droop, in its own lengths.
constexpr double upright_stand = 0.25;

/// Largest deviation of a spine from its direction.
constexpr double astray = 0.12;

/// How much farther shaggy hairs stray; how much they lean to the middle of their tuft, and how far
/// aside they bend, in their own lengths and in deviations from their direction.
constexpr double shaggy_stray = 2.0, shaggy_lean = 0.5, shaggy_bend = 0.6;

/// Tufts of shaggy hair round the axis and along the meridian, and how far their rows wind, in
/// distances between them.
constexpr int tufts_round = 23, tufts_along = 13, round_turns = 5, along_turns = 7;
constexpr double tuft_winding = 0.35;

/// SpineStyle::stand up to which a spine has a slender root, and from which on it is widest there;
/// width of a slender root, in that which it would have otherwise, and where the inner rings of such
/// a spine are, in the places that they would have.
constexpr double slender_stand = 0.08, full_stand = 0.15, slender_root = 0.25, slender_middle = 0.6;

/// Depth of its base in the body, in its own widths.
constexpr double sunk = 0.6;

/// How much slimmer than a cone it is: the exponent of its radius over the distance from the tip.
constexpr double taper = 0.75;

/// Depth of an upright fold in the body, in its heights above it.
constexpr double fold_sunk = 0.45;

/// How far the middle of a fold winds aside, in its widths for a meander of 1; how much farther its
/// crest does; how far it is bowed, in its half lengths; how often it winds along its length, at least
/// and at most, in turns.
constexpr double fold_aside = 0.9, crest_aside = 0.7, fold_bow = 0.55, least_turns = 0.4,
                 most_turns = 0.85;

/// How far the crest of a fold sinks between its tops, in its height, and how much thinner it is there.
constexpr double crest_waves = 0.45, crest_thin = 0.3;

/// Exponents of the height and of the width of a fold over 1 - u^2, where u is -1 and 1 at its ends;
/// least width there. Exponent of its cross-section, which is an ellipse at 1.
constexpr double fold_rise = 0.55, fold_taper = 0.45, least_taper = 0.2, fold_section = 0.85;

/// How far the crest of a fold lies in the body at both its ends, in the depth of its bottom there.
constexpr double fold_end = 0.8;

/// Length of the longest fold, and depth of the deepest in the body, in its radii: a longer one would
/// wrap round it.
constexpr double longest_fold = 1.3, deepest_fold = 0.6;

/// How far a fold leans to a side, in its heights.
constexpr double fold_lean = 0.35;

/// Resolution by the columns of a level of detail, and the most spines of a layer there.
struct Resolution {
    int least_columns, rows, sides, most;
};
constexpr std::array<Resolution, 5> resolutions = {
    {{64, 3, 3, 6000}, {48, 3, 3, 1000}, {28, 2, 3, 570}, {12, 2, 3, 80}, {0, 2, 3, 25}}};
/// The same of upright folds, of which each is a part of the outline.
constexpr std::array<Resolution, 6> fold_resolutions = {{{90, 18, 8, 60},
                                                         {60, 14, 8, 60},
                                                         {48, 12, 6, 60},
                                                         {28, 9, 5, 50},
                                                         {12, 5, 3, 50},
                                                         {0, 4, 3, 8}}};

/// The largest factor on the width of a spine that stands for several.
constexpr double most_wide = 2.5;

const Resolution& resolution_of(const SpineStyle& style, const Detail& detail) {
    return style.is_folded() ? by_columns(fold_resolutions, detail)
                             : by_columns(resolutions, detail);
}

/// Returns how many spines of a layer a level builds: the first ones of the sequence.
int built(const SpineLayer& layer, const OrnamentDetail& detail) {
    const Resolution& resolution = resolution_of(layer.style, detail);
    const double most = std::min(detail.offered(layer.style.count, sure_spines),
                                 static_cast<double>(resolution.most));
    return static_cast<int>(std::floor(most * detail.free_solids + 0.5));
}

bool is_present(const SpineLayer& layer) { return layer.weight * layer.style.length > 0.0; }

/// Radius and length of the outline by the share of its meridian, for places of equal density.
class Meridian {
  public:
    /// from, to  see SpineStyle; of a form without a lower face both run over the cap alone
    Meridian(const Outline& outline, double from, double to)
        : cap_alone_(outline.hymenium.empty()) {
        // As the lower face of a mix vanishes, its share passes to the cap.
        const double lower =
            cap_alone_
                ? 0.0
                : smooth_step(0.0, whole_lower,
                              outline.hymenium.length() / std::max(outline.cap.length(), 1e-9));
        from_ = lower * from + (1.0 - lower) * (1.0 + 0.5 * from);
        to_ = lower * to + (1.0 - lower) * (1.0 + 0.5 * to);
        const double step = (to_ - from_) / samples;
        for (int i = 0; i < samples; ++i) {
            const double share = from_ + (i + 0.5) * step;
            const bool on_cap = is_on_cap(share);
            const SubCurve& curve = on_cap ? outline.cap : outline.hymenium;
            const double area = curve.at(on_cap ? share - 1.0 : share).r * curve.length();
            areas_[static_cast<std::size_t>(i) + 1] = areas_[static_cast<std::size_t>(i)] + area;
        }
    }
    /// Returns true for a share of the meridian on the cap: above 1.
    [[nodiscard]] bool is_on_cap(double share) const { return cap_alone_ || share > 1.0; }

    /// Returns the share of the meridian below which this share of the area lies.
    [[nodiscard]] double at(double share) const {
        const double area = share * areas_.back();
        std::size_t k = 0;
        while (k + 1 < samples && areas_[k + 1] < area) ++k;
        const double step = areas_[k + 1] - areas_[k];
        const double within = step > 0.0 ? std::clamp((area - areas_[k]) / step, 0.0, 1.0) : 0.5;
        return from_ + (to_ - from_) * (static_cast<double>(k) + within) / samples;
    }

    /// Returns 0 where spines begin on the meridian, 1 where they end.
    [[nodiscard]] double within(double share) const {
        return to_ > from_ ? (share - from_) / (to_ - from_) : 0.0;
    }

  private:
    static constexpr int samples = 96;
    /// Length of a lower face from which on it has a share of its own, in that of the cap.
    static constexpr double whole_lower = 0.1;
    bool cap_alone_;
    double from_ = 0.0, to_ = 0.0;
    std::array<double, samples + 1> areas_{};
};

/// Tufts of shaggy hair: hairs lean to the middle of the tuft that they stand in.
class Tufts {
  public:
    explicit Tufts(std::uint32_t seed) {
        Random random(seed, purposes::spines, tuft_stream);
        round_ = random.uniform(0.0, 2.0 * pi);
        along_ = random.uniform(0.0, 2.0 * pi);
    }
    /// Returns the lean of a hair, round the axis and along the meridian, each -1..1.
    ///
    /// at  its place in the unit square
    [[nodiscard]] glm::dvec2 lean(const SpinePlace& at) const {
        // Rows of tufts wind, so that they are not seen as rows.
        const double up = 2.0 * pi * at.along, turn = 2.0 * pi * at.round;
        const double winding = 2.0 * pi * tuft_winding;
        return {-sine(tufts_round * turn + winding * sine(round_turns * up + along_) + round_),
                -sine(tufts_along * up + winding * sine(along_turns * turn + round_) + along_)};
    }

  private:
    static constexpr std::uint32_t tuft_stream = 0xFFFFFFFFU;
    double round_, along_;
};

/// Builds one spine: rows of rings along a curve from its root to its tip.
void build_spine(GridSolid& solid, const SpineRoot& root, double length, double width,
                 const SpineStyle& style, Random& random) {
    glm::dvec3 off(0.0);
    off.x = astray * random.symmetric();
    off.y = astray * random.symmetric();
    off.z = astray * random.symmetric();
    const glm::dvec3 strays = off;
    off = (1.0 + shaggy_stray * style.shag) * off + shaggy_lean * style.shag * root.lean;
    const double turned = random.uniform(0.0, 2.0 * pi);
    const glm::dvec3 down(0.0, -1.0, 0.0);
    glm::dvec3 hangs =
        unit_or((1.0 - style.droop) * root.outwards + style.droop * down + off, down);
    // Where the surface faces upwards a spine lies on it instead of hanging through the body.
    const double inwards = std::min(glm::dot(hangs, root.outwards), 0.0);
    hangs = unit_or(hangs - inwards * root.outwards, root.outwards);
    // A hair bends to its sides alone: it neither turns back nor into the body.
    const glm::dvec3 sideways = unit_or(glm::cross(root.outwards, hangs), down);
    const glm::dvec3 aside =
        shaggy_bend * style.shag * length * glm::dot(strays, sideways) * sideways;
    glm::dvec3 start = root.place - sunk * width * root.outwards;
    const double stands = style.stand + upright_stand * (1.0 - style.droop);
    const glm::dvec3 bend = root.place + length * stands * root.outwards + aside;
    const glm::dvec3 tip = bend - aside + length * hangs;
    // A straight spine begins on the way to the bend, so that it lies as the curved one does.
    if (solid.rows == 2) start = 0.5 * (start + bend);
    solid.corners.clear();
    glm::dvec3 side = square_to(root.outwards, glm::dvec3(0.36, 0.48, 0.8));
    // A spine that hangs down at once lies on the surface, and comes out of it slender.
    const double stands_out = smooth_step(slender_stand, full_stand, style.stand);
    const double root_width = slender_root + (1.0 - slender_root) * stands_out;
    const double inner = slender_middle + (1.0 - slender_middle) * stands_out;
    for (int i = 0; i < solid.rows; ++i) {
        const double t =
            (i + 1 < solid.rows ? inner : 1.0) * static_cast<double>(i) / (solid.rows - 1);
        // A quadratic curve that leaves the surface at a right angle.
        const glm::dvec3 centre =
            (1.0 - t) * (1.0 - t) * start + 2.0 * t * (1.0 - t) * bend + t * t * tip;
        const glm::dvec3 along = unit_or((1.0 - t) * (bend - start) + t * (tip - bend), down);
        side = square_to(along, side);
        const glm::dvec3 third = glm::cross(along, side);
        const double radius =
            t < 1.0 ? 0.5 * width * power(1.0 - t, taper) * (i == 0 ? root_width : 1.0) : 0.0;
        for (int j = 0; j <= solid.columns; ++j) {
            const SineCosine turn =
                sine_cosine(turned + 2.0 * pi * (j % solid.columns) / solid.columns);
            solid.corners.push_back(centre + radius * (turn.cosine * side + turn.sine * third));
        }
    }
}

double signed_power(double value, double exponent) {
    const double size = power(std::abs(value), exponent);
    return value < 0.0 ? -size : size;
}

/// Builds one upright fold: rows of cross-sections along a winding line on the surface, from one end to
/// the other; both ends lie in the body. Columns begin at the bottom.
///
/// wider  how much thicker it is than others at the finest level; it is no longer and winds no more
void build_fold(GridSolid& solid, const SpineRoot& root, double height, double full_width,
                double wider, const SpineStyle& style, Random& random) {
    const double width = std::min(
        full_width, longest_fold / (std::max(style.breadth, 1.0) * std::max(root.curvature, 1e-9)));
    const double heading = random.uniform(0.0, 2.0 * pi), bow = random.symmetric();
    const double lean = random.symmetric();
    const double turns = random.uniform(least_turns, most_turns);
    const double aside_phase = random.uniform(0.0, 2.0 * pi),
                 crest_phase = random.uniform(0.0, 2.0 * pi),
                 wave_phase = random.uniform(0.0, 2.0 * pi);
    const glm::dvec3& out = root.outwards;
    const glm::dvec3 first = square_to(out, glm::dvec3(0.36, 0.48, 0.8)),
                     second = glm::cross(out, first);
    const SineCosine turn = sine_cosine(heading);
    const glm::dvec3 forwards = turn.cosine * first + turn.sine * second,
                     sideways = glm::cross(out, forwards);
    const double half = 0.5 * style.breadth * width;
    const double sunk_depth =
        std::min(fold_sunk * height, deepest_fold / std::max(root.curvature, 1e-9));
    // A tall fold leans no farther than it is long, so that it does not cross itself where it winds.
    const double leaning = fold_lean * lean * std::min(height, 2.0 * half);
    // Returns the middle of the fold on the surface at a place along it, -1..1.
    const auto middle = [&](double u) {
        const double wind = sine_cosine(aside_phase + 2.0 * pi * turns * u).sine;
        const glm::dvec3 flat =
            half * u * forwards +
            (style.meander * (fold_aside * width * wind + fold_bow * half * bow * (u * u - 0.4))) *
                sideways;
        return root.place + flat - 0.5 * root.curvature * glm::dot(flat, flat) * out;
    };
    solid.corners.clear();
    for (int i = 0; i < solid.rows; ++i) {
        const double u = 2.0 * i / (solid.rows - 1.0) - 1.0;
        const glm::dvec3 centre = middle(u);
        if (i == solid.rows - 1) {
            // The end of the fold is one point in the body.
            solid.corners.insert(solid.corners.end(), static_cast<std::size_t>(solid.columns) + 1,
                                 centre - 0.9 * sunk_depth * out);
            continue;
        }
        const double step = 0.05;
        const glm::dvec3 along = unit_or(middle(u + step) - middle(u - step), forwards);
        // Seen along the fold, columns run counter-clockwise from the bottom.
        const glm::dvec3 left = unit_or(glm::cross(out, along), sideways);
        const double inside = std::max(1.0 - u * u, 0.0);
        const double wave =
            0.5 + 0.5 * sine_cosine(wave_phase + 2.0 * pi * (turns + 0.35) * u).sine;
        const double rise = power(inside, fold_rise);
        const double top = height * rise * (1.0 - crest_waves * style.meander * wave) -
                           fold_end * sunk_depth * (1.0 - rise);
        const double thick = 0.5 * wider * width *
                             std::max(power(inside, fold_taper), least_taper) *
                             (1.0 - crest_thin * style.meander * wave);
        const double over = sine_cosine(crest_phase + 2.0 * pi * (turns + 0.2) * u).sine;
        for (int j = 0; j <= solid.columns; ++j) {
            const SineCosine round = sine_cosine(2.0 * pi * (j % solid.columns) / solid.columns);
            const double up = 0.5 - 0.5 * signed_power(round.cosine, fold_section);
            const double aside = thick * signed_power(round.sine, fold_section);
            const double crest =
                up * up * rise * (style.meander * crest_aside * width * over + leaning);
            solid.corners.push_back(centre + (up * (top + sunk_depth) - sunk_depth) * out +
                                    (aside + crest) * left);
        }
    }
}

/// What all spines of a swept individual share.
struct SweptFace {
    const OrnamentContext& context;
    Tufts tufts;
    AxisStation station;
    std::vector<OutlineSample> upper;  ///< rings of the cap's mesh
    double curvature;                  ///< about that of the body, 1/m
};

/// Returns the root of the k-th spine of a layer.
SpineRoot root_on(const SweptFace& face, const Meridian& meridian, const SpineStyle& style, int k) {
    const OrnamentContext& context = face.context;
    const SpinePlace at = spine_place(k);
    const double rank = static_cast<double>(k) / style.count;
    const double share = meridian.at(at.along + style.shortening * (rank - at.along));
    const bool on_cap = meridian.is_on_cap(share);
    const double theta = 2.0 * pi * at.round;
    // Where the margin is cut, spines move inwards with the surface.
    const double cut =
        on_cap ? 1.0 - context.cuts.cap(2.0 - share, theta) : context.cuts.lower(share, theta);
    SurfacePoint point = context.rest_surface.meshed(on_cap ? Part::cap : Part::hymenium,
                                                     on_cap ? face.upper : context.flesh,
                                                     detail_of(context.level).columns, cut, theta);
    if (on_cap)
        point.position +=
            context.dents.cap(2.0 - share, theta) *
            unit_or(glm::cross(point.meridian, point.azimuth), glm::dvec3(0.0, 1.0, 0.0));
    context.deformer.apply({&point, 1}, face.station);
    if (!context.curl.none())
        point.position += context.curl.moved(on_cap, on_cap ? 1.0 - cut : cut, theta);
    const glm::dvec3 outwards =
        unit_or(glm::cross(point.meridian, point.azimuth), glm::dvec3(0.0, -1.0, 0.0));
    const glm::dvec2 lean = face.tufts.lean({share, at.round});
    return {
        point.position,
        outwards,
        meridian.within(share),
        1.0,
        lean.x * square_to(outwards, point.azimuth) + lean.y * square_to(outwards, point.meridian),
        face.curvature};
}

}  // namespace

SpinePlace spine_place(int number) {
    // The additive sequence of the plastic constant fills the square evenly at every length.
    const double along = 0.5 + 0.7548776662466927 * number,
                 round = 0.5 + 0.5698402909980532 * number;
    return {along - std::floor(along), round - std::floor(round)};
}

MeshCount spine_count(const std::vector<SpineLayer>& layers, const OrnamentDetail& detail,
                      bool keep_absent) {
    MeshCount sum;
    for (const SpineLayer& layer : layers) {
        const Resolution& resolution = resolution_of(layer.style, detail);
        MeshCount all =
            SolidGrid{resolution.rows, resolution.sides, false}.count().times(built(layer, detail));
        if (!keep_absent && !is_present(layer)) all.triangles = 0;
        sum += all;
    }
    return sum;
}

OrnamentDetail spine_detail(const std::vector<SpineLayer>& layers, DetailLevel level) {
    OrnamentDetail detail = detail_of(level);
    // From afar the branches need all triangles for their outline.
    if (level.nearest() >= 2) detail.free_solids = 0.0;
    while (detail.free_solids > 0.0 &&
           spine_count(layers, detail).triangles > triangle_limit(level) / 2)
        detail.free_solids -= 0.125;
    return detail;
}

void add_spines(Mesh& mesh, const SpineLayer& layer, const OrnamentDetail& detail,
                std::uint32_t seed, bool textured, bool keep_absent,
                const std::function<SpineRoot(int)>& root_of) {
    const SpineStyle& style = layer.style;
    const Resolution& resolution = resolution_of(style, detail);
    GridSolid solid{{resolution.rows, resolution.sides, false}, Part::blade, {}, {}};
    if (style.is_folded()) {
        solid.turned = true;
        solid.folds = 2;
    }
    const int count = built(layer, detail);
    if (count == 0) return;
    // Those that become shorter along the meridian lose the shortest ones, which nobody misses.
    const double all = std::sqrt(static_cast<double>(style.count) / count);
    // Folds cover the body, however few they are.
    const double stands_for = style.is_folded() ? all : power(all, 0.9);
    const double wider =
        1.0 + (1.0 - 0.5 * style.shortening) * (std::min(stands_for, most_wide) - 1.0);
    for (int k = 0; k < count; ++k) {
        Random random(seed, purposes::spines, static_cast<std::uint32_t>(k));
        // Coarse levels build the first spines, so these are the longest: by chance or, where spines
        // become shorter along the meridian, by their place.
        const double lot = random.uniform();
        const double rank = static_cast<double>(k) / style.count;
        const double shorter =
            1.0 - style.unevenness * (std::sqrt(rank) + style.shortening * (lot - std::sqrt(rank)));
        const double thinner = 1.0 - 0.5 * style.unevenness * random.uniform();
        const SpineRoot root = root_of(k);
        const double scale = layer.weight * root.grown;
        const double reach = 1.0 - style.shortening * root.along;
        const double length = scale * shorter * reach * style.length,
                     width = scale * thinner * style.width;
        if (style.is_folded())
            build_fold(solid, root, length, width, wider, style, random);
        else
            build_spine(solid, root, length, scale * thinner * wider * style.width, style, random);
        append(mesh, solid, root.outwards, textured, is_present(layer) || keep_absent);
    }
}

void add_spines(Mesh& mesh, const Individual& individual, const OrnamentContext& context) {
    std::vector<OutlineSample> upper = context.outline.rings(CurveName::cap, context.level);
    // The body is about as much bent as a ball with its least half extent.
    double widest = 1e-6, low = 1e9, high = -1e9;
    for (const OutlineSample& at : upper) {
        widest = std::max(widest, at.r);
        low = std::min(low, at.y);
        high = std::max(high, at.y);
    }
    const double ball = std::min(widest, std::max(0.5 * (high - low), 1e-6));
    const SweptFace face{context, Tufts(context.seed),
                         context.deformer.frozen_station(context.deformer.top()), std::move(upper),
                         1.0 / ball};
    for (const SpineLayer& layer : individual.spines) {
        const Meridian meridian(context.outline, layer.style.from, layer.style.to);
        add_spines(mesh, layer, context.detail, context.seed, context.textured, context.keep_absent,
                   [&](int k) { return root_on(face, meridian, layer.style, k); });
    }
}

}  // namespace sporeprint
