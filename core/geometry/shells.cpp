#include "core/geometry/shells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "core/geometry/grid_solid.h"
#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"

namespace sporeprint {

namespace {

/// Least slope of a stem along which heights are measured; size of a shell, in radii of the stem,
/// from which on it spans the dents of the stem.
constexpr double least_rise = 0.2, spanning_size = 0.3;

/// Weights of the large tears of an edge, of their unevenness and of fine raggedness; their sum
/// is 1.
constexpr double tear_weight = 0.62, uneven_weight = 0.23, fine_weight = 0.15;

/// Depth at which a shell begins under the stem's surface: in radii of the stem, and at most in
/// widths of the shell.
constexpr double shell_depth = 0.02, most_shell_depth = 0.25;

/// Largest thickness of ring and sac, in their widths, and largest depth of their tears.
constexpr double ring_thickness = 0.3, ring_tear = 0.8, sac_thickness = 0.2, sac_tear = 0.62;

/// Amplitudes of a full ruffle and of full grooves, in widths of the ring.
constexpr double ruffle_size = 0.16, groove_size = 0.04;

/// Thickness of a ring at the stem, its increase up to the edge, and that of a double edge for
/// `edge` 1, which begins at a share of the width; in thicknesses of the style.
constexpr double ring_at_stem = 0.6, ring_widening = 0.8, double_edge = 5.0, edge_begins = 0.45;

/// Shares of a sac's meridian at which its wall begins: at fine levels, and where it has a single
/// band of quads.
constexpr double sac_begins = 0.01, single_band_begins = 0.6;

/// Thickness of a sac's wall at its base and its decrease up to the edge, in that of the style.
constexpr double sac_at_base = 1.2, sac_thinning = 0.6;

/// Distance of a sac's wall from the stem, in thicknesses, and the share of its meridian over which
/// it comes out of the stem.
constexpr double sac_distance = 0.75, sac_emerges = 0.16;

/// Amplitude of folds, displacement of lobes to the inside, and largest displacement to the stem,
/// in distances of the loose wall from it.
constexpr double sac_fold = 0.5, sac_bend = 0.12, most_sac_bend = 0.8;

/// Returns the grid of a thin shell with `rings` rings of quads on each side; empty without any.
SolidGrid shell_grid(bool is_built, int rings, const Detail& detail) {
    return {is_built && rings > 0 ? 2 * (rings + 1) : 0, detail.columns, true};
}
SolidGrid ring_grid(const Individual& individual, const Detail& detail) {
    return shell_grid(individual.has_ring, detail.veil_rings, detail);
}
SolidGrid sac_grid(const Individual& individual, const Detail& detail) {
    return shell_grid(individual.has_sac, detail.sac_rings, detail);
}

/// Cumulated rise of a stem along its length, metres. Stretches flatter than `least` count as
/// rising by that share of their length, so that a place given by its rise moves continuously along
/// a meridian that is level or bends down to the ground.
class Rise {
  public:
    Rise(const SubCurve& stem, double least) : stem_(stem) {
        OutlineSample last = stem.at(0.0);
        for (int i = 1; i <= samples; ++i) {
            const OutlineSample here = stem.at(static_cast<double>(i) / samples);
            risen_[static_cast<std::size_t>(i)] =
                risen_[static_cast<std::size_t>(i - 1)] +
                std::max(here.y - last.y, least * stem.length() / samples);
            last = here;
        }
    }
    [[nodiscard]] double whole() const { return risen_.back(); }
    [[nodiscard]] OutlineSample at(double rise) const {
        const auto above = std::upper_bound(risen_.begin() + 1, risen_.end() - 1, rise);
        const double from = *(above - 1), to = *above;
        const double t = to > from ? std::clamp((rise - from) / (to - from), 0.0, 1.0) : 0.0;
        return stem_.at((static_cast<double>(above - 1 - risen_.begin()) + t) / samples);
    }

  private:
    static constexpr int samples = 96;
    const SubCurve& stem_;
    std::array<double, samples + 1> risen_{};
};

/// Returns how far a shell of a size follows the dents of the stem inside it: fully when vanishing,
/// not at all from `spanning_size` on.
double conforming(double size, double radius) {
    return 1.0 - smooth_step(0.0, spanning_size * radius, size);
}

/// An angle round the stem that runs now faster, now slower, so that waves of it are neither equally
/// wide nor equally far apart.
class UnevenAngle {
  public:
    explicit UnevenAngle(Random& random) {
        for (double& phase : phases_) phase = random.uniform(0.0, 2.0 * pi);
    }
    [[nodiscard]] double at(double angle) const {
        // The derivatives of the waves sum to less than 1: it never runs backwards.
        return angle + 0.4 * sine(angle + phases_[0]) + 0.15 * sine(2.0 * angle + phases_[1]) +
               0.04 * sine(5.0 * angle + phases_[2]);
    }

  private:
    std::array<double, 3> phases_{};
};

/// Depth of the tears of an edge at an angle, 0..1: tears of their own places, widths and depths
/// between lobes, and a finer raggedness.
class Rents {
  public:
    /// columns  of the mesh; raggedness too fine for them would alias
    Rents(Random& random, int least, int most, int columns) {
        const int count =
            least + static_cast<int>(random.bits() % static_cast<std::uint32_t>(most - least + 1));
        const double apart = 2.0 * pi / count;
        for (int k = 0; k < count; ++k)
            tears_.push_back({(k + random.uniform(0.0, 0.7)) * apart,
                              apart * random.uniform(0.18, 0.5), random.uniform(0.35, 1.0)});
        double coarse = 0.0, fine = 0.0;
        for (std::size_t k = 0; k < waves_.size(); ++k) {
            waves_[k].phase = random.uniform(0.0, 2.0 * pi);
            waves_[k].size = random.uniform(0.3, 1.0);
            if (3.0 * waves_[k].turns > columns) waves_[k].size = 0.0;
            (k < coarse_waves ? coarse : fine) += waves_[k].size;
        }
        for (std::size_t k = 0; k < waves_.size(); ++k)
            waves_[k].size *=
                k < coarse_waves ? uneven_weight / coarse : fine_weight / std::max(fine, 0.3);
    }
    [[nodiscard]] double at(double angle) const {
        double rent = 0.0;
        for (const Tear& tear : tears_) {
            const double turns = (angle - tear.at) / (2.0 * pi);
            const double away = 2.0 * pi * std::abs(turns - std::floor(turns + 0.5));
            const double within = std::max(1.0 - away / tear.half, 0.0);
            rent = std::max(rent, tear.depth * within * std::sqrt(within));
        }
        double depth = tear_weight * rent;
        for (const Wave& wave : waves_)
            depth += wave.size * (0.5 + 0.5 * sine(wave.turns * angle + wave.phase));
        return depth;
    }

  private:
    struct Tear {
        double at, half, depth;
    };
    struct Wave {
        double turns, phase = 0.0, size = 0.0;
    };
    static constexpr std::size_t coarse_waves = 3;
    std::vector<Tear> tears_;
    std::array<Wave, 6> waves_ = {{{1.0}, {2.0}, {3.0}, {11.0}, {17.0}, {23.0}}};
};

/// A point of the centre line of a ring's cross-section.
struct RingStation {
    double r, y, normal_r, normal_y, share;

    [[nodiscard]] RingStation towards(const RingStation& to, double t) const {
        return {r + t * (to.r - r), y + t * (to.y - y), normal_r + t * (to.normal_r - normal_r),
                normal_y + t * (to.normal_y - normal_y), share + t * (to.share - share)};
    }
};

/// Returns the centre line, which leaves the stem at the flare angle and hangs down towards its
/// edge.
std::vector<RingStation> ring_line(const RingStyle& style, const OutlineSample& attachment,
                                   double thickness, int rings) {
    const double width = style.width;
    // The ring begins slightly inside the stem; a vanishing ring no deeper than it is wide.
    const double sunk = std::min(shell_depth * attachment.r, most_shell_depth * width);
    const double clear = style.gap * std::min(attachment.r, width);
    double r = std::max(attachment.r + clear - 0.5 * thickness - sunk, thickness), y = attachment.y;
    std::vector<RingStation> line;
    for (int i = 0; i <= rings; ++i) {
        const double share = static_cast<double>(i) / rings;
        const auto turn = sine_cosine(radians(style.flare_deg) * (1.0 - style.hang * share));
        line.push_back({r, y, turn.cosine, turn.sine, share});
        r += width / rings * turn.sine;
        y -= width / rings * turn.cosine;
    }
    return line;
}

/// Everything of a ring that depends on the angle alone.
struct RingColumn {
    SineCosine turn;
    double ruffle, groove;
    double reach;  ///< share of the line that is left where the edge is torn
    double dent;   ///< height of the stem's surface that the ring follows, metres
};

std::vector<RingColumn> ring_columns(const RingStyle& style, const OutlineSample& attachment,
                                     const OrnamentContext& context) {
    Random groove_stream(context.seed, purposes::ring_grooves),
        tear_stream(context.seed, purposes::ring_tear);
    const int groove_count = 15 + static_cast<int>(groove_stream.bits() % 5);
    const Rents rents(tear_stream, 9, 13, context.detail.columns);
    Random random(context.seed, purposes::ring_ruffle);
    const int waves = 5 + static_cast<int>(random.bits() % 4);
    const double phase = random.uniform(0.0, 2.0 * pi);
    const double other = random.uniform(0.0, 2.0 * pi);
    const UnevenAngle uneven(random);
    // A vanishing ring follows the furrows and lumps of the stem; a full one spans them.
    const double conforms = conforming(style.width, attachment.r);
    const int count = context.detail.columns;
    std::vector<RingColumn> columns;
    for (int j = 0; j <= count; ++j) {
        const double angle = -2.0 * pi * (j % count) / count;  // counter-clockwise seen from above
        const double wavy = uneven.at(angle);
        // Grooves too fine for the columns of the mesh would alias.
        columns.push_back(
            {sine_cosine(angle),
             sine(waves * wavy + phase) + 0.6 * sine((2 * waves + 1) * wavy + other),
             3 * groove_count > count ? 0.0 : sine(groove_count * angle + other),
             1.0 - ring_tear * style.tear * rents.at(angle),
             conforms > 0.0 ? conforms * context.dents.stem(attachment.share, angle) : 0.0});
    }
    return columns;
}

/// Profile of a sac: along the stem up to its widest place, and freely upwards from there.
class SacProfile {
  public:
    struct Point {
        double r, y, normal_r, normal_y;
        double clear;  ///< distance from the stem
        double above;  ///< 0 at the ground, 1 at the highest lobe
        double share;  ///< of the stem
    };

    SacProfile(const SacStyle& style, const SubCurve& stem, double base) {
        const double height = style.height;
        // The sac begins under the bulb, or at the end of a stem that grows from a vertical
        // substrate. A low sac includes only as much of the bulb as it is high; otherwise it would
        // extend under a flat base faster than it grows.
        const double level = std::min(std::max(base, 0.0), std::max(base, stem.at(1.0).y));
        const double buried = std::min(std::max(level - base, 0.0), 0.6 * height);
        const Rise stem_rise(stem, least_rise);
        for (int i = 0; i <= samples; ++i) {
            // Rows are denser under the bulb, where the stem turns.
            const double share = static_cast<double>(i) / samples;
            const double climb = share * (0.12 + 0.88 * share);
            const double y = level - buried + (buried + height) * climb;
            const OutlineSample at = stem_rise.at(y - base);
            const double above = height > 0.0 ? std::clamp((y - level) / height, 0.0, 1.0) : 0.0;
            widest_ = std::max(widest_, at.r);
            const double held = style.hold * (widest_ - at.r);
            const double off = held + style.gap * height * above * above;
            const bool free = at.r < widest_;
            points_[static_cast<std::size_t>(i)] = {
                at.r + off, at.y,    free ? 1.0 : at.tangent_y, free ? 0.0 : -at.tangent_r, off,
                above,      at.share};
        }
        for (std::size_t i = 1; i <= samples; ++i) {
            const double dr = points_[i].r - points_[i - 1].r, dy = points_[i].y - points_[i - 1].y;
            arcs_[i] = arcs_[i - 1] + std::sqrt(dr * dr + dy * dy);
        }
    }

    /// Returns the largest radius of the stem inside the sac.
    [[nodiscard]] double widest() const { return widest_; }

    /// Returns the point at a share of the arc length, so that rows are equally spaced under the
    /// bulb and above it.
    [[nodiscard]] Point at(double share) const {
        const double arc = share * arcs_.back();
        std::size_t k = 0;
        while (k + 1 < samples && arcs_[k + 1] < arc) ++k;
        const double step = arcs_[k + 1] - arcs_[k];
        const double t = step > 0.0 ? std::clamp((arc - arcs_[k]) / step, 0.0, 1.0) : share;
        const Point &a = points_[k], &b = points_[k + 1];
        const auto mix = [t](double x, double y) { return x + t * (y - x); };
        return {mix(a.r, b.r),
                mix(a.y, b.y),
                mix(a.normal_r, b.normal_r),
                mix(a.normal_y, b.normal_y),
                mix(a.clear, b.clear),
                mix(a.above, b.above),
                mix(a.share, b.share)};
    }

  private:
    static constexpr int samples = 48;
    std::array<Point, samples + 1> points_{};
    std::array<double, samples + 1> arcs_{};
    double widest_ = 0.0;
};

/// Folds of a sac's wall, -1..1, by angle and height.
class SacFolds {
  public:
    SacFolds(std::uint32_t seed, int columns)
        : SacFolds(Random(seed, purposes::sac_folds), columns) {}
    [[nodiscard]] double at(double angle, double share) const {
        const double wavy = uneven_.at(angle);
        const double coarse = sine(count_ * wavy + phases_[0] + lean_ * share);
        return 0.5 * coarse + 0.3 * sine(2.0 * angle + phases_[1]) +
               (fine_ ? 0.2 * sine((2 * count_ + 1) * wavy + phases_[2] - lean_ * share) : 0.0);
    }

  private:
    SacFolds(Random random, int columns) : uneven_(random) {
        count_ = 5 + static_cast<int>(random.bits() % 3);
        for (double& phase : phases_) phase = random.uniform(0.0, 2.0 * pi);
        lean_ = random.uniform(-1.5, 1.5);
        // Folds too fine for the columns of the mesh would alias.
        fine_ = 6 * (2 * count_ + 1) <= columns;
    }

    UnevenAngle uneven_;
    int count_ = 0;
    std::array<double, 3> phases_{};
    double lean_ = 0.0;
    bool fine_ = false;
};

}  // namespace

MeshCount shell_count(const Individual& individual, const Detail& detail) {
    MeshCount sum = ring_grid(individual, detail).count();
    sum += sac_grid(individual, detail).count();
    return sum;
}

void add_ring(Mesh& mesh, const Individual& individual, const OrnamentContext& context) {
    const RingStyle& style = individual.ring;
    GridSolid solid{ring_grid(individual, context.detail), Part::veil, {}, {}};
    if (solid.rows == 0) return;
    const int rings = context.detail.veil_rings;
    const Rise stem_rise(context.outline.stem, least_rise);
    const OutlineSample attachment = stem_rise.at(style.height * stem_rise.whole());
    const double width = style.width;
    const double thickness = std::min(style.thickness, ring_thickness * width);
    const AxisStation station = context.deformer.frozen_station(attachment.y);
    const std::vector<RingStation> line = ring_line(style, attachment, thickness, rings);
    const std::vector<RingColumn> columns = ring_columns(style, attachment, context);
    // The tears end level with the edge, which is thicker.
    for (int i = 0; i < solid.rows; ++i) {
        const bool lower = i <= rings;
        const int row = lower ? i : solid.rows - 1 - i;
        const double whole_share = static_cast<double>(row) / rings;
        // A double edge has two lips that stand off from each other.
        const double half = (lower ? -0.5 : 0.5) * thickness *
                            (ring_at_stem + ring_widening * whole_share +
                             double_edge * style.edge * smooth_step(edge_begins, 1.0, whole_share));
        for (const RingColumn& column : columns) {
            // Where the edge is torn, the line ends sooner.
            const double place = row * column.reach;
            const auto before =
                static_cast<std::size_t>(std::min<int>(static_cast<int>(place), rings - 1));
            const RingStation at =
                line[before].towards(line[before + 1], place - static_cast<double>(before));
            const double off =
                half + style.ruffle * ruffle_size * width * at.share * at.share * column.ruffle +
                style.grooves * groove_size * width * at.share * column.groove;
            const double rr = std::max(at.r + off * at.normal_r + column.dent, 0.0),
                         yy = at.y + off * at.normal_y;
            solid.corners.push_back(context.rest_surface.azimuth().moved(
                {rr * column.turn.cosine, yy, rr * column.turn.sine}));
        }
    }
    context.deformer.apply(solid.corners, station);
    append(mesh, solid, glm::dvec3(0.0, 1.0, 0.0), context.textured,
           width > 0.0 || context.keep_absent);
}

void add_sac(Mesh& mesh, const Individual& individual, const OrnamentContext& context) {
    const SacStyle& style = individual.sac;
    GridSolid solid{sac_grid(individual, context.detail), Part::veil, {}, {}};
    if (solid.rows == 0) return;
    const int rings = context.detail.sac_rings;
    const double height = style.height;
    const double thickness = std::min(style.thickness, sac_thickness * height);
    const int count = solid.columns;
    Random random(context.seed, purposes::sac);
    const Rents rents(random, 3, 5, count);
    const SacFolds folds(context.seed, count);
    const SacProfile profile(style, context.outline.stem, context.deformer.base());
    const double conforms = conforming(height, profile.widest());
    // The sac begins inside the stem and comes out of it soon after.
    const double sunk = std::min(shell_depth * profile.widest(), most_shell_depth * height);
    // A single band would cut through the bulb; at coarse levels only the wall is built.
    const double first = rings > 1 ? sac_begins : single_band_begins;
    for (int i = 0; i < solid.rows; ++i) {
        const bool outside = i <= rings;
        const double share = static_cast<double>(outside ? i : solid.rows - 1 - i) / rings;
        for (int j = 0; j <= count; ++j) {
            const double angle = -2.0 * pi * (j % count) / count;  // as for rings
            const double up =
                first + (1.0 - first) * share * (1.0 - sac_tear * style.tear * rents.at(angle));
            const SacProfile::Point at = profile.at(up);
            // The wall thins towards its edge and is folded where it is loose; its lobes bend
            // outwards or inwards.
            const double half =
                (outside ? 0.5 : -0.5) * thickness * (sac_at_base - sac_thinning * share);
            const double loose = at.clear * (sac_fold * folds.at(angle, up) - sac_bend * at.above);
            const double rise =
                (sunk + sac_distance * thickness) * smooth_step(0.0, sac_emerges, share) - sunk;
            const double off = half + rise + std::max(loose, -most_sac_bend * at.clear);
            double r = std::max(at.r + off * at.normal_r, thickness + half);
            if (conforms > 0.0)
                r = std::max(r + conforms * context.dents.stem(at.share, angle), 0.0);
            const auto turn = sine_cosine(angle);
            glm::dvec3 place = context.rest_surface.azimuth().moved(
                {r * turn.cosine, at.y + off * at.normal_y, r * turn.sine});
            context.deformer.apply(std::span(&place, 1), context.deformer.station(std::min(
                                                             place.y, context.deformer.top())));
            solid.corners.push_back(place);
        }
    }
    append(mesh, solid, glm::dvec3(0.0, 1.0, 0.0), context.textured,
           height > 0.0 || context.keep_absent);
}

}  // namespace sporeprint
