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

/// Weights of the large tears of an edge, of the unequal heights of its lobes, of fine tears and of
/// raggedness; their sum is 1.
constexpr double tear_weight = 0.48, uneven_weight = 0.28, fine_weight = 0.15, ragged_weight = 0.09;

/// How much wider than a large tear its shoulders are, over which the lobes on either side slope down
/// to it, and how deep they are, in depths of the tear.
constexpr double shoulder_width = 3.4, shoulder_depth = 0.4;

/// Depth at which a shell begins under the stem's surface: in radii of the stem, and at most in
/// widths of the shell.
constexpr double shell_depth = 0.02, ring_depth = 0.03, most_shell_depth = 0.25;

/// Largest thickness of ring and sac, in their widths, and largest depth of their tears.
constexpr double ring_thickness = 0.3, ring_tear = 0.85, sac_thickness = 0.2, sac_tear = 0.78;

/// How many more columns and rows a shell has than the body, whose surplus they are: its torn edge is
/// seen from near.
constexpr double surplus_columns = 0.5;

/// Amplitudes of a full ruffle and of full grooves, in widths of the ring.
constexpr double ruffle_size = 0.32, groove_size = 0.022;

/// How unevenly a ring leaves its stem: in widths the height of its attachment, in shares its flare
/// and its hang; how far even an edge that is not torn is uneven, as a share of the width.
constexpr double uneven_height = 0.2, uneven_flare = 0.34, uneven_hang = 0.25, uneven_edge = 0.1;

/// Share of a ring's width over which it clings to the stem before it flares, and over which it comes
/// out of the stem's surface; its distance from there on and the softness of that bound, in widths.
constexpr double clings_to = 0.24, ring_emerges = 0.5, ring_distance = 0.012, ring_softness = 0.04;

/// Radii, in those of the stem, within which a ring follows the bent axis as the stem does, and from
/// which on it is rigid.
constexpr double bends_within = 1.2, rigid_from = 2.2;

/// Thickness of a ring at its edge and its increase to the stem, and that of a double edge for `edge`
/// 1, which begins and is full at shares of the width; in thicknesses of the style.
constexpr double ring_at_edge = 0.16, ring_thickening = 0.9, double_edge = 4.2, edge_begins = 0.5,
                 edge_full = 0.84;

/// Shares of a sac's meridian at which its wall begins: at fine levels, and where it has a single
/// band of quads.
constexpr double sac_begins = 0.01, single_band_begins = 0.6;

/// Thickness of a sac's wall at its base and its decrease up to the edge, in that of the style.
constexpr double sac_at_base = 1.3, sac_thinning = 1.08;

/// Distance of a sac's wall from the stem, in thicknesses, and the share of its meridian over which
/// it comes out of the stem.
constexpr double sac_distance = 0.75, sac_emerges = 0.16;

/// Amplitude of folds, displacement of lobes to the inside, and largest displacement to the stem,
/// in distances of the loose wall from it.
constexpr double sac_fold = 0.5, sac_bend = 0.12, most_sac_bend = 0.8;

/// How far the lips of a sac's edge roll in or out, in distances of the loose wall from the stem, and
/// the share of the wall at which they begin.
constexpr double sac_lip = 0.75, lip_begins = 0.62;

/// Returns a count of the body as it is for shells.
int fine_count(int count, const OrnamentDetail& detail) {
    return static_cast<int>((1.0 + surplus_columns * detail.surplus) * count);
}

/// Returns how many rings of quads each side of a ring has.
int rings_of_ring(const OrnamentDetail& detail) { return fine_count(detail.veil_rings, detail); }

/// Returns the grid of a thin shell with `rings` rings of quads on each side; empty without any.
SolidGrid shell_grid(bool is_built, int rings, const OrnamentDetail& detail) {
    return {is_built && rings > 0 ? 2 * (rings + 1) : 0, fine_count(detail.columns, detail), true};
}
SolidGrid ring_grid(const Individual& individual, const OrnamentDetail& detail) {
    return shell_grid(individual.has_ring, rings_of_ring(detail), detail);
}
SolidGrid sac_grid(const Individual& individual, const OrnamentDetail& detail) {
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

/// Unevenness round the stem, -1..1: values at even angles, smoothly joined.
class RoundNoise {
  public:
    /// columns  of the mesh; values too dense for them would alias
    RoundNoise(Random& random, int cells, int columns) : values_(static_cast<std::size_t>(cells)) {
        const double shown = 2 * cells > columns ? 0.0 : 1.0;
        for (double& value : values_) value = shown * random.symmetric();
    }
    [[nodiscard]] double at(double angle) const {
        const double turns = angle / (2.0 * pi);
        const double place = (turns - std::floor(turns)) * static_cast<double>(values_.size());
        const double below = std::floor(place);
        const std::size_t i = static_cast<std::size_t>(below) % values_.size();
        const double from = values_[i], to = values_[(i + 1) % values_.size()];
        return from + smooth_step(0.0, 1.0, place - below) * (to - from);
    }

  private:
    std::vector<double> values_;
};

/// How many large tears an edge has, at least and at most, and how many fine ones.
struct RentCounts {
    int least, most, fine;
};

/// Depth of the tears of an edge at an angle, 0..1: a few large tears of unlike places, widths and
/// depths between lobes of unequal height, many fine ones, and raggedness.
class Rents {
  public:
    /// columns  of the mesh; tears and raggedness too fine for them would alias
    Rents(Random& random, RentCounts counts, int columns)
        : lobes_(random, 3, columns),
          crests_(random, 8, columns),
          frayed_(random, 6, columns),
          rags_(random, 23, columns),
          fibrils_(random, 61, columns) {
        const int large =
            counts.least + static_cast<int>(random.bits() % static_cast<std::uint32_t>(
                                                                counts.most - counts.least + 1));
        const double apart = 2.0 * pi / large, column = 2.0 * pi / columns;
        for (int k = 0; k < large; ++k) {
            const double at = (k + random.uniform(0.0, 0.95)) * apart;
            const double wide = random.uniform(), skew = random.uniform(0.15, 0.85),
                         deep = random.uniform(), bend = random.uniform(0.55, 2.2);
            add({at, 0.0, 0.0, tear_weight * (0.25 + 0.75 * deep), bend, true},
                apart * (0.16 + 0.8 * wide * wide), skew, column);
        }
        for (int k = 0; k < counts.fine; ++k) {
            const double at = random.uniform(0.0, 2.0 * pi), wide = random.uniform(),
                         skew = random.uniform(0.1, 0.9), deep = random.uniform(),
                         bend = random.uniform(0.6, 1.8);
            add({at, 0.0, 0.0, fine_weight * (0.1 + 0.9 * deep * deep), bend, false},
                0.03 + 0.22 * wide * wide * wide, skew, column);
        }
    }
    [[nodiscard]] double at(double angle) const {
        double rent = 0.0, fine = 0.0;
        for (const Tear& tear : tears_) {
            const double turns = (angle - tear.at) / (2.0 * pi);
            const double away = 2.0 * pi * (turns - std::floor(turns + 0.5));
            const double half = away < 0.0 ? tear.before : tear.after;
            const double within = 1.0 - std::abs(away) / half;
            // Some tears are pointed, others are round at their ends.
            double depth = within > 0.0 ? tear.depth * power(within, tear.bend) : 0.0;
            if (!tear.is_large) {
                fine = std::max(fine, depth);
                continue;
            }
            const double beside = std::max(1.0 - std::abs(away) / (shoulder_width * half), 0.0);
            depth = (1.0 - shoulder_depth) * depth + shoulder_depth * tear.depth * beside * beside;
            rent = std::max(rent, depth);
        }
        const double lobes = 0.5 + 0.28 * lobes_.at(angle) + 0.22 * crests_.at(angle);
        // Some stretches are frayed, others smooth.
        const double frayed = smooth_step(-0.5, 0.7, frayed_.at(angle));
        const double rags =
            0.5 + (0.1 + 0.2 * frayed) * rags_.at(angle) + 0.2 * frayed * fibrils_.at(angle);
        return rent + fine + uneven_weight * lobes + ragged_weight * rags;
    }

  private:
    struct Tear {
        double at, before, after, depth, bend;
        bool is_large;
    };
    void add(Tear tear, double width, double skew, double column) {
        tear.before = width * skew;
        tear.after = width - tear.before;
        // What is narrower than the columns of the mesh would alias.
        tear.depth *= smooth_step(1.0, 2.2, width / column);
        if (tear.depth > 0.0) tears_.push_back(tear);
    }

    RoundNoise lobes_, crests_, frayed_, rags_, fibrils_;
    std::vector<Tear> tears_;
};

/// A point of the centre line of a ring's cross-section.
struct RingStation {
    double r, y, normal_r, normal_y;

    [[nodiscard]] RingStation towards(const RingStation& to, double t) const {
        return {r + t * (to.r - r), y + t * (to.y - y), normal_r + t * (to.normal_r - normal_r),
                normal_y + t * (to.normal_y - normal_y)};
    }
};

/// What the section of a ring is at an angle.
struct RingColumn {
    SineCosine turn;
    double lift;         ///< of its attachment, metres
    double flare, hang;  ///< of this section, radians and 0..1
    double ruffle, groove, lip;
    double reach;  ///< share of the line that is left where the edge is torn
    double dent;   ///< of the stem's surface under it, metres
};

/// Returns the centre line, which clings to the stem, leaves it towards the flare angle and hangs
/// down towards its edge.
std::vector<RingStation> ring_line(double width, const OutlineSample& attachment,
                                   const RingColumn& column, int rings) {
    double r = attachment.r, y = attachment.y + column.lift;
    std::vector<RingStation> line;
    const auto direction = [&](double share) {
        // A single ring of quads has no room to cling.
        const double leaves = rings > 1 ? smooth_step(0.0, clings_to, share) : 1.0;
        return sine_cosine(column.flare * (1.0 - column.hang * share) * leaves);
    };
    for (int i = 0; i <= rings; ++i) {
        const double share = static_cast<double>(i) / rings;
        const SineCosine here = direction(share), ahead = direction(share + 0.5 / rings);
        line.push_back({r, y, here.cosine, here.sine});
        r += width / rings * ahead.sine;
        y -= width / rings * ahead.cosine;
    }
    return line;
}

std::vector<RingColumn> ring_columns(const RingStyle& style, const OutlineSample& attachment,
                                     const OrnamentContext& context, int count) {
    // Columns that are surplus show the same ring, only more smoothly.
    const int sure = context.detail.columns;
    Random groove_stream(context.seed, purposes::ring_grooves),
        tear_stream(context.seed, purposes::ring_tear), random(context.seed, purposes::ring_ruffle);
    const int groove_count = 27 + static_cast<int>(groove_stream.bits() % 9);
    const double groove_phase = groove_stream.uniform(0.0, 2.0 * pi);
    const RoundNoise furrowed(groove_stream, 9, sure);
    const Rents rents(tear_stream, {5, 8, 30}, sure);
    const RoundNoise broad(random, 3, sure), wide(random, 5, sure), folds(random, 11, sure),
        fine_folds(random, 23, sure), heights(random, 7, sure), hangs(random, 6, sure),
        lips(random, 13, sure), fine_lips(random, 37, sure), edges(random, 19, sure);
    const UnevenAngle uneven(random);
    std::vector<RingColumn> columns;
    for (int j = 0; j <= count; ++j) {
        const double angle = -2.0 * pi * (j % count) / count;  // counter-clockwise seen from above
        const double wavy = uneven.at(angle);
        const double flare = 0.6 * broad.at(wavy) + 0.4 * wide.at(wavy);
        // Grooves too fine for the columns of the mesh would alias.
        const double groove =
            3 * groove_count > sure
                ? 0.0
                : (0.6 + 0.4 * furrowed.at(angle)) * sine(groove_count * wavy + groove_phase);
        const double torn = style.tear * rents.at(angle);
        const double whole = 0.5 + 0.35 * broad.at(angle) + 0.15 * edges.at(angle);
        columns.push_back(
            {sine_cosine(angle),
             uneven_height * style.width * (0.6 * wide.at(angle) + 0.4 * heights.at(angle)),
             radians(style.flare_deg) * (1.0 + uneven_flare * flare),
             style.hang * (1.0 + uneven_hang * (hangs.at(wavy) - 1.0)),
             0.55 * folds.at(wavy) + 0.3 * wide.at(angle) + 0.15 * fine_folds.at(wavy), groove,
             0.55 + 0.3 * lips.at(angle) + 0.15 * fine_lips.at(angle),
             1.0 - ring_tear * torn - uneven_edge * whole,
             context.dents.stem(attachment.share, angle)});
    }
    return columns;
}

/// Returns the larger of two numbers, without an edge where they are alike.
double soft_max(double a, double b, double softness) {
    const double apart = a - b;
    return b + 0.5 * (apart + std::sqrt(apart * apart + softness * softness));
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

MeshCount shell_count(const Individual& individual, const OrnamentDetail& detail) {
    MeshCount sum = ring_grid(individual, detail).count();
    sum += sac_grid(individual, detail).count();
    return sum;
}

void add_ring(Mesh& mesh, const Individual& individual, const OrnamentContext& context) {
    const RingStyle& style = individual.ring;
    GridSolid solid{ring_grid(individual, context.detail), Part::veil, {}, {}};
    if (solid.rows == 0) return;
    const int rings = rings_of_ring(context.detail), count = solid.columns;
    const Rise stem_rise(context.outline.stem, least_rise);
    const double base = context.deformer.base();
    const OutlineSample attachment = stem_rise.at(style.height * stem_rise.whole());
    const double width = style.width;
    const double thickness = std::min(style.thickness, ring_thickness * width);
    // The ring begins slightly inside the stem; a vanishing ring no deeper than it is wide.
    const double sunk = std::min(ring_depth * attachment.r, most_shell_depth * width);
    const double clear = style.gap * std::min(attachment.r, width);
    // A vanishing ring follows the furrows and lumps of the stem; a full one spans them.
    const double conforms = conforming(width, attachment.r);
    const AxisStation rigid = context.deformer.frozen_station(attachment.y);
    const std::vector<RingColumn> columns = ring_columns(style, attachment, context, count);
    solid.corners.resize(static_cast<std::size_t>(solid.rows * (count + 1)));
    for (int j = 0; j <= count; ++j) {
        const RingColumn& column = columns[static_cast<std::size_t>(j)];
        const std::vector<RingStation> line = ring_line(width, attachment, column, rings);
        for (int row = 0; row <= rings; ++row) {
            const double whole = static_cast<double>(row) / rings, share = whole * column.reach;
            // Where the edge is torn, the line ends sooner.
            const double place = row * column.reach;
            const auto before =
                static_cast<std::size_t>(std::min<int>(static_cast<int>(place), rings - 1));
            const RingStation at =
                line[before].towards(line[before + 1], place - static_cast<double>(before));
            // It is thickest where it has grown to the stem; a double edge has two lips.
            const double rest = 1.0 - whole;
            const double half = 0.5 * thickness *
                                (ring_at_edge + ring_thickening * rest * rest +
                                 double_edge * style.edge * column.lip *
                                     smooth_step(edge_begins, edge_full, whole) *
                                     std::sqrt(std::max(1.0 - power(whole, 6.0), 0.0)));
            const double waved =
                style.ruffle * ruffle_size * width * share * std::sqrt(share) * column.ruffle +
                style.grooves * groove_size * width * share * column.groove;
            const double y = at.y + waved * at.normal_y;
            // No part of it goes into the stem, whose surface it leaves near its attachment.
            const double out = smooth_step(0.0, ring_emerges, whole);
            const double stem = std::max(stem_rise.at(y - base).r, 1e-6);
            const double emerged = out * (sunk + 2.0 * half + ring_distance * width) - sunk - half;
            const double floor = stem + clear + emerged;
            const double middle =
                soft_max(at.r + clear + std::min(emerged, 0.0) + waved * at.normal_r, floor,
                         out * ring_softness * width);
            const double dent =
                column.dent * (1.0 - (1.0 - conforms) * smooth_step(0.0, 0.5, whole));
            for (const bool lower : {true, false}) {
                const double off = lower ? -half : half;
                const double r = std::max(middle + off * at.normal_r + dent, 0.0);
                const glm::dvec3 rest_place = context.rest_surface.azimuth().moved(
                    {r * column.turn.cosine, y + off * at.normal_y, r * column.turn.sine});
                // What is close to the stem follows its bend, what stands off is rigid.
                glm::dvec3 near = rest_place, far = rest_place;
                const double stands = smooth_step(bends_within, rigid_from, r / stem);
                if (stands < 1.0)
                    context.deformer.apply(std::span(&near, 1),
                                           context.deformer.station(std::clamp(
                                               rest_place.y, base, context.deformer.top())));
                if (stands > 0.0) context.deformer.apply(std::span(&far, 1), rigid);
                const int at_row = lower ? row : solid.rows - 1 - row;
                solid.corners[static_cast<std::size_t>(at_row * (count + 1) + j)] =
                    stands <= 0.0   ? near
                    : stands >= 1.0 ? far
                                    : near + stands * (far - near);
            }
        }
    }
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
    const int sure = context.detail.columns;  // as for rings
    Random random(context.seed, purposes::sac);
    const Rents rents(random, {3, 5, 22}, sure);
    const RoundNoise lips(random, 5, sure), fine_lips(random, 13, sure);
    const SacFolds folds(context.seed, sure);
    const SacProfile profile(style, context.outline.stem, context.deformer.base());
    const double conforms = conforming(height, profile.widest());
    // The sac begins inside the stem and comes out of it soon after.
    const double sunk = std::min(shell_depth * profile.widest(), most_shell_depth * height);
    // A single band would cut through the bulb; at coarse levels only the wall is built.
    const double first = rings > 1 ? sac_begins : single_band_begins;
    std::vector<double> torn, rolled;  // by column
    for (int j = 0; j <= count; ++j) {
        const double angle = -2.0 * pi * (j % count) / count;  // as for rings
        torn.push_back(sac_tear * style.tear * rents.at(angle));
        rolled.push_back(0.65 * lips.at(angle) + 0.35 * fine_lips.at(angle) - 0.25);
    }
    for (int i = 0; i < solid.rows; ++i) {
        const bool outside = i <= rings;
        const double share = static_cast<double>(outside ? i : solid.rows - 1 - i) / rings;
        for (int j = 0; j <= count; ++j) {
            const double angle = -2.0 * pi * (j % count) / count;
            const auto column = static_cast<std::size_t>(j);
            const double up = first + (1.0 - first) * share * (1.0 - torn[column]);
            const SacProfile::Point at = profile.at(up);
            // The wall thins towards its edge and is folded where it is loose; its lobes bend
            // outwards or inwards.
            const double half =
                (outside ? 0.5 : -0.5) * thickness * (sac_at_base - sac_thinning * share);
            const double loose =
                at.clear * (sac_fold * folds.at(angle, up) - sac_bend * at.above +
                            sac_lip * rolled[column] * smooth_step(lip_begins, 1.0, share));
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
