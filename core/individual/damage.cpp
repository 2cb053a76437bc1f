#include "core/individual/damage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/individual/individual.h"
#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"

namespace sporeprint {
namespace {

constexpr double whole_turn = 2.0 * pi;

double wrapped(double theta) {
    while (theta >= whole_turn) theta -= whole_turn;
    while (theta < 0.0) theta += whole_turn;
    return theta;
}

// The random distribution of a kind of damage on a part.
struct Distribution {
    int count = 0;
    double from = 0.0, to = 1.0;      // of the meridian
    double small = 0.0, large = 0.0;  // radius
    double elongation = 1.0;          // greatest elongation
};

Distribution distribution_of(DamageSpotKind kind, CurveName part) {
    const bool cap = part == CurveName::cap, stem = part == CurveName::stem;
    switch (kind) {
        case DamageSpotKind::pit:
            if (cap) return {7, 0.10, 0.80, 0.055, 0.15, 1.5};
            if (stem) return {4, 0.25, 0.85, 0.03, 0.07, 2.0};
            return {};
        case DamageSpotKind::bruise:
            if (cap) return {7, 0.25, 0.98, 0.07, 0.22, 1.6};
            if (stem) return {8, 0.12, 0.92, 0.08, 0.22, 2.6};
            return {6, 0.15, 0.98, 0.06, 0.17, 1.6};
        case DamageSpotKind::dew:
            if (cap) return {150, 0.03, 0.99, 0.011, 0.034, 1.0};
            if (stem) return {40, 0.25, 0.97, 0.012, 0.03, 1.25};
            return {};
        case DamageSpotKind::lump:
            if (cap) return {34, 0.06, 0.97, 0.10, 0.24, 1.3};
            if (stem) return {26, 0.05, 0.95, 0.10, 0.22, 2.4};
            return {};
    }
    return {};
}

// A grid for nearest-point queries on the points of cracks.
class CrackGrid {
  public:
    struct Found {
        double square = 4.0;
        double x = 0.0, y = 0.0;
        std::uint32_t crack = 0;
        bool any = false;
    };
    void add(double x, double y, std::uint32_t crack) {
        cells_[cell(x, y)].push_back({x, y, crack});
    }
    // Returns the nearest point of a crack other than `own` within the side of one cell.
    [[nodiscard]] Found nearest(double x, double y, std::uint32_t own) const {
        Found found;
        const int i = index(x), j = index(y);
        for (int v = std::max(j - 1, 0); v <= std::min(j + 1, side - 1); ++v)
            for (int u = std::max(i - 1, 0); u <= std::min(i + 1, side - 1); ++u)
                for (const Point& p : cells_[static_cast<std::size_t>(v * side + u)]) {
                    if (p.crack == own) continue;
                    const double dx = p.x - x, dy = p.y - y, square = dx * dx + dy * dy;
                    if (square < found.square) found = {square, p.x, p.y, p.crack, true};
                }
        return found;
    }

  private:
    static constexpr int side = 22;
    struct Point {
        double x, y;
        std::uint32_t crack;
    };
    static int index(double x) {
        return std::clamp(static_cast<int>((x + 1.1) * (side / 2.2)), 0, side - 1);
    }
    static std::size_t cell(double x, double y) {
        return static_cast<std::size_t>(index(y) * side + index(x));
    }
    std::array<std::vector<Point>, static_cast<std::size_t>(side* side)> cells_;
};

struct Heading {
    double x, y;
};

Heading unit(double x, double y, Heading fallback) {
    const double square = x * x + y * y;
    if (square < 1e-18) return fallback;
    const double inverse = 1.0 / std::sqrt(square);
    return {x * inverse, y * inverse};
}

constexpr double crack_step = 0.03, net_spacing = 0.082, longest_crack = 0.9;

// Grows one end of a crack until it meets another or leaves the face.
std::vector<CrackPoint> grow_end(CrackPoint at, Heading heading, std::uint32_t own,
                                 const CrackGrid& grown_before, Random& random) {
    std::vector<CrackPoint> out;
    double left = longest_crack;
    while (left > 0.0) {
        const double swerve = 0.26 * random.symmetric();
        heading = unit(heading.x - swerve * heading.y, heading.y + swerve * heading.x, heading);
        const auto near = grown_before.nearest(at.x, at.y, own);
        if (near.any && near.square < 2.25 * crack_step * crack_step && left < longest_crack) {
            out.push_back({near.x, near.y, 0.0});
            return out;
        }
        // Stress is released along an open crack: a new one turns towards it and meets it at a
        // right angle.
        if (near.any) {
            const double distance = std::sqrt(near.square);
            const double dx = (near.x - at.x) / distance, dy = (near.y - at.y) / distance;
            if (dx * heading.x + dy * heading.y > 0.2) {
                const double pull = 0.5 * smooth_step(0.0, 1.0, 1.0 - distance / 0.1);
                heading = unit(heading.x + pull * dx, heading.y + pull * dy, heading);
            }
        }
        at = {at.x + crack_step * heading.x, at.y + crack_step * heading.y, 0.0};
        out.push_back(at);
        left -= crack_step;
        if (at.x * at.x + at.y * at.y > 1.0) return out;
    }
    return out;
}

}  // namespace

std::uint32_t damage_seed(std::uint32_t individual, std::uint32_t stream) {
    return Random(individual, purposes::species_damage, stream).bits();
}

SeedShares damage_shares(const Individual& individual) {
    SeedShares shares;
    for (const SpeciesShare& part : individual.parts)
        shares.push_back({damage_seed(individual.weather_seed, stream_of(part.id)), part.weight});
    return shares;
}

double turn_between(double from, double to) {
    double turn = to - from;
    while (turn > pi) turn -= whole_turn;
    while (turn < -pi) turn += whole_turn;
    return turn;
}

double grown(double onset, double amount) {
    if (amount <= onset) return 0.0;
    const double t = (amount - onset) / (1.0 - onset);
    return t * (2.0 - t);
}

double begun(double onset, double amount) {
    constexpr double least = 0.01;
    return std::max(0.0, grown(onset, amount) - least) / (1.0 - least);
}

std::vector<DamageSpot> damage_spots(DamageSpotKind kind, CurveName part, std::uint32_t seed) {
    const Distribution distribution = distribution_of(kind, part);
    const auto purpose = purposes::damage_spots + 4 * static_cast<std::uint32_t>(kind) +
                         static_cast<std::uint32_t>(part);
    std::vector<DamageSpot> out;
    out.reserve(static_cast<std::size_t>(distribution.count));
    Random start(seed, purpose, 0x80000000U);
    double theta = start.uniform(0.0, whole_turn);
    const double first = start.uniform();
    for (int i = 0; i < distribution.count; ++i) {
        const auto id = static_cast<std::uint32_t>(i);
        Random random(seed, purpose, id);
        const double along = random.uniform();
        const double jitter = random.symmetric();
        const double size = random.uniform();
        const double elongation = random.uniform();
        // The golden angle covers all sides of the mushroom and keeps equal sizes apart.
        theta = wrapped(theta + 2.39996322972865332 + 0.35 * jitter);
        DamageSpot spot;
        // The distribution is uniform along a stem, and uniform over the area of a disc.
        const double place = first + 0.61803398874989485 * i + 0.12 * along;
        const double share = place - std::floor(place);
        const double mixed = part == CurveName::stem ? share : std::sqrt(share);
        spot.sigma = distribution.from + (distribution.to - distribution.from) * mixed;
        spot.theta = theta;
        spot.radius = distribution.small + (distribution.large - distribution.small) * size * size;
        spot.elongation = 1.0 + (distribution.elongation - 1.0) * elongation;
        spot.onset = 0.75 * i / std::max(distribution.count, 1);
        spot.id = id;
        out.push_back(spot);
    }
    return out;
}

namespace {

/// Returns the depth of a scallop at a place of its bite, relative to the bite's.
double scallop_depth(const Scallop& scallop, double place) {
    const double x = (place - scallop.middle) / scallop.half_width;
    return x <= -1.0 || x >= 1.0 ? 0.0 : scallop.depth * std::sqrt(1.0 - x * x);
}

/// Returns the place where the first scallop becomes shallower than the second, between their middles.
double cusp_between(const Scallop& first, const Scallop& second) {
    double from = first.middle, to = second.middle;
    for (int step = 0; step < 40; ++step) {
        const double place = 0.5 * (from + to);
        (scallop_depth(first, place) > scallop_depth(second, place) ? from : to) = place;
    }
    return 0.5 * (from + to);
}

/// Draws the scallops of a bite: the deepest one about its middle, one on either side that reaches
/// the bite's end.
void draw_scallops(Notch& bite, Random& random) {
    const double middle = random.uniform(-0.28, 0.28);
    const double half = random.uniform(0.40, 0.60);
    Scallop& centre = bite.scallops[1];
    centre = {middle, half, 1.0};
    for (const std::size_t side : {0U, 1U}) {
        const double sign = side == 0 ? -1.0 : 1.0;
        const double inner = sign * middle + half * random.uniform(0.45, 0.85);
        bite.scallops[2 * side] = {sign * 0.5 * (1.0 + inner), 0.5 * (1.0 - inner),
                                   random.uniform(0.45, 0.90)};
        if (bite.scallops[2 * side].half_width < 0.12)
            bite.scallops[2 * side] = {sign * 0.88, 0.12, 0.45};
    }
    bite.cusps = {cusp_between(bite.scallops[0], centre), cusp_between(centre, bite.scallops[2])};
    bite.undercut = random.uniform(-0.30, 0.20);
}

}  // namespace

std::vector<Notch> bites(std::uint32_t seed) {
    constexpr int count = 4;
    std::vector<Notch> out;
    const double phase = Random(seed, purposes::bites, 0x80000000U).uniform(0.0, whole_turn);
    for (int i = 0; i < count; ++i) {
        Random random(seed, purposes::bites, static_cast<std::uint32_t>(i));
        const double jitter = random.symmetric();
        const double width = random.uniform(0.17, 0.36);
        const double depth = random.uniform(0.85, 1.35);
        Notch notch;
        notch.theta = wrapped(phase + 2.39996322972865332 * i + 0.3 * jitter);
        notch.half_width = width;
        notch.depth = std::min(depth * width, 0.42);
        notch.onset = 0.6 * i / count;
        notch.id = static_cast<std::uint32_t>(i);
        draw_scallops(notch, random);
        out.push_back(notch);
    }
    return out;
}

namespace {

/// Depths of the corners of a lip, from the tip outwards, and how far they may lie from the curve
/// of the lip, relative to its distance from the tip.
constexpr std::array<double, 4> corner_depths = {0.72, 0.45, 0.18, 0.0};
constexpr double lip_waves = 0.45;
/// The angle beside a split over which its lip sinks back to the margin, radians.
constexpr double lip_reach = 0.2;

/// Returns a lip.
///
/// width  angle on the margin from the tip to the lip, radians
Lip drawn_lip(double width, Random& random) {
    Lip lip;
    double inner = 0.0;
    for (std::size_t k = 0; k < lip.corners.size(); ++k) {
        const double deep = corner_depths[k], wave = random.symmetric();
        const double even = width * power(1.0 - deep, lip_power);
        const double waved = deep > 0.0 ? even * (1.0 + lip_waves * wave) : even;
        // The lip never leans over itself: a column of the mesh crosses it once.
        inner = std::max(waved, inner + 0.08 * width);
        lip.corners[k] = {std::min(inner, width * (1.0 - 0.08 * static_cast<double>(3 - k))), deep};
    }
    lip.lift = random.uniform();
    return lip;
}

}  // namespace

std::vector<Notch> splits(std::uint32_t seed) {
    constexpr int count = 7;                           // all of them are built at LOD 0
    constexpr double shortest = 0.07, longest = 0.54;  // radii of the cap
    constexpr double narrowest = 0.008;                // radians
    std::vector<Notch> out;
    const double phase = Random(seed, purposes::splits, 0x80000000U).uniform(0.0, whole_turn);
    for (int i = 0; i < count; ++i) {
        Random random(seed, purposes::splits, static_cast<std::uint32_t>(i));
        const double jitter = random.symmetric();
        const double opening = random.uniform(0.03, 0.10);
        const double draw = random.uniform();
        const double skew = random.uniform(-0.45, 0.45);
        Notch notch;
        notch.bitten = false;
        notch.theta = wrapped(phase + whole_turn * ((5 * i % count) + 0.4 * jitter) / count);
        // Long ones are rare, except among the first two.
        const double rare = i < 2 ? draw * std::sqrt(draw) : draw * draw * draw;
        notch.depth = shortest + (longest - shortest) * rare;
        const double width = narrowest + opening * notch.depth;
        notch.lips[0] = drawn_lip(width * (1.0 - skew), random);
        notch.lips[1] = drawn_lip(width * (1.0 + skew), random);
        notch.half_width = width * (1.0 + std::abs(skew));
        notch.onset = 0.7 * i / count;
        notch.id = 100 + static_cast<std::uint32_t>(i);
        out.push_back(notch);
    }
    return out;
}

namespace {

/// A column at the edge of a notch counts as outside, however its angle was rounded.
constexpr double edge = 1.0 - 1e-6;

/// Returns the lip of a split on the side of a turn from its tip.
const Lip& lip_beside(const Notch& split, double turn) { return split.lips[turn < 0.0 ? 0 : 1]; }

/// Returns the depth of the tear between the tip and a lip, relative to that of the tip.
double torn(const Lip& lip, double across) {
    if (across >= edge * lip.corners.back().across) return 0.0;
    Lip::Corner inner{0.0, 1.0};
    for (const Lip::Corner& outer : lip.corners) {
        if (across < outer.across)
            return inner.deep + (outer.deep - inner.deep) * (across - inner.across) /
                                    (outer.across - inner.across);
        inner = outer;
    }
    return 0.0;
}

}  // namespace

double notch_profile(const Notch& notch, double theta) {
    const double turn = turn_between(notch.theta, theta);
    if (!notch.bitten) return torn(lip_beside(notch, turn), std::abs(turn));
    const double place = turn / notch.half_width;
    if (place <= -edge || place >= edge) return 0.0;
    double deepest = 0.0;
    for (const Scallop& scallop : notch.scallops)
        deepest = std::max(deepest, scallop_depth(scallop, place));
    return deepest;
}

double notch_depth(const Notch& notch, double size, double theta) {
    const double whole = notch_profile(notch, theta);
    return notch.bitten ? size * whole : std::max(0.0, whole - (1.0 - size));
}

double lip_lift(const Notch& notch, double size, double theta) {
    if (notch.bitten || size <= 0.0) return 0.0;
    const double turn = turn_between(notch.theta, theta);
    const Lip& lip = lip_beside(notch, turn);
    const double across = std::abs(turn), width = lip.corners.back().across;
    const double near = std::min(across / width, 1.0);
    const double far = smooth_step(0.0, lip_reach, across - width);
    return lip.lift * size * near * (1.0 - far);
}

double tongue_ragged(const Tongue& tongue, double turn) {
    // The paint kernels use the same cubic approximation of a cosine of period 1.
    const auto wave = [](double t) {
        const double u = std::abs(t - std::floor(t) - 0.5) * 2.0;
        return u * u * (6.0 - 4.0 * u) - 1.0;
    };
    return 0.08 * wave(3.0 * turn + tongue.phases[0]) + 0.06 * wave(7.0 * turn + tongue.phases[1]) +
           0.035 * wave(15.0 * turn + tongue.phases[2]);
}

std::vector<Tongue> tongues(std::uint32_t seed) {
    constexpr int count = 5;
    std::vector<Tongue> out;
    const double phase = Random(seed, purposes::tongues, 0x80000000U).uniform(0.0, whole_turn);
    for (int i = 0; i < count; ++i) {
        Random random(seed, purposes::tongues, static_cast<std::uint32_t>(i));
        const double jitter = random.symmetric();
        const double width = random.uniform(0.22, 0.55);
        const double reach = random.uniform(0.55, 1.0);
        Tongue tongue;
        for (double& one : tongue.phases) one = random.uniform();
        tongue.theta = wrapped(phase + whole_turn * ((2 * i % count) + 0.3 * jitter) / count);
        tongue.half_width = width;
        tongue.reach = reach;
        tongue.onset = 0.6 * i / count;
        tongue.id = static_cast<std::uint32_t>(i);
        out.push_back(tongue);
    }
    return out;
}

std::vector<Crack> crack_net(std::uint32_t seed) {
    constexpr int seeds_across = 23;
    struct Seed {
        double x, y, strength;
        std::uint32_t id;
    };
    std::vector<Seed> seeds;
    for (int j = 0; j < seeds_across; ++j)
        for (int i = 0; i < seeds_across; ++i) {
            const auto id = static_cast<std::uint32_t>(j * seeds_across + i);
            Random random(seed, purposes::crack_net, id);
            const double off_x = random.uniform();
            const double off_y = random.uniform();
            const double strength = random.uniform();
            const double x = 2.0 * (i + off_x) / seeds_across - 1.0;
            const double y = 2.0 * (j + off_y) / seeds_across - 1.0;
            if (x * x + y * y < 0.92) seeds.push_back({x, y, strength, id});
        }
    std::sort(seeds.begin(), seeds.end(), [](const Seed& a, const Seed& b) {
        return a.strength != b.strength ? a.strength > b.strength : a.id < b.id;
    });
    CrackGrid points;
    std::vector<Crack> out;
    for (const Seed& from : seeds) {
        const auto own = static_cast<std::uint32_t>(out.size());
        const auto near = points.nearest(from.x, from.y, own);
        if (near.any && near.square < net_spacing * net_spacing) continue;
        Random random(seed, purposes::crack_net, 0x10000U + from.id);
        const SineCosine turn = sine_cosine(random.uniform(0.0, whole_turn));
        // The heading points repulsion from the nearest crack, or is uniform if there is none.
        const double repulsion = near.any ? 0.8 : 0.0;
        const double distance = near.any ? std::sqrt(near.square) : 1.0;
        const Heading heading =
            unit(turn.cosine + repulsion * (from.x - near.x) / distance,
                 turn.sine + repulsion * (from.y - near.y) / distance, {1.0, 0.0});
        const CrackPoint start{from.x, from.y, 0.0};
        const auto ahead = grow_end(start, heading, own, points, random);
        const auto behind = grow_end(start, {-heading.x, -heading.y}, own, points, random);
        Crack crack;
        crack.points.assign(behind.rbegin(), behind.rend());
        crack.points.push_back(start);
        crack.points.insert(crack.points.end(), ahead.begin(), ahead.end());
        const double last = static_cast<double>(crack.points.size() - 1);
        // A crack opens at its seed first.
        const double middle = static_cast<double>(behind.size());
        for (std::size_t i = 0; i < crack.points.size(); ++i) {
            const double off = static_cast<double>(i) - middle;
            crack.points[i].along =
                (off < 0.0 ? -off : off) / std::max({middle, last - middle, 1.0});
            points.add(crack.points[i].x, crack.points[i].y, own);
        }
        const double order = static_cast<double>(out.size());
        crack.onset = 0.55 * std::min(1.0, order / 80.0);
        crack.width = 1.25 - 0.65 * std::min(1.0, order / 40.0);
        out.push_back(std::move(crack));
    }
    return out;
}

std::vector<Crack> radial_cracks(std::uint32_t seed) {
    constexpr int count = 44;
    std::vector<Crack> out;
    const double phase =
        Random(seed, purposes::radial_cracks, 0x80000000U).uniform(0.0, whole_turn);
    for (int i = 0; i < count; ++i) {
        Random random(seed, purposes::radial_cracks, static_cast<std::uint32_t>(i));
        const double jitter = random.symmetric();
        const double draw = random.uniform();
        const double rank = random.uniform();
        double theta = phase + whole_turn * (i + 0.36 * jitter) / count;
        const double length = 0.12 + 0.62 * draw * draw * draw;
        const int steps = 4 + static_cast<int>(length / 0.05);
        double drift = 0.0;
        Crack crack;
        for (int k = 0; k <= steps; ++k) {
            const double along = static_cast<double>(k) / steps;
            const double swerve = random.symmetric();
            drift = 0.6 * drift + 0.035 * swerve;
            const double rho = 1.0 - length * along;
            theta += k == 0 ? 0.0 : drift * 0.05 / std::max(rho, 0.15);
            const SineCosine turn = sine_cosine(theta);
            crack.points.push_back({rho * turn.cosine, rho * turn.sine, along});
        }
        crack.onset = 0.65 * rank * (1.0 - 0.5 * draw * draw);
        crack.width = 0.55 + 0.6 * length;
        out.push_back(std::move(crack));
    }
    return out;
}

std::vector<Furrow> furrows(std::uint32_t seed) {
    constexpr int count = 15;
    std::vector<Furrow> out;
    const double phase = Random(seed, purposes::furrows, 0x80000000U).uniform(0.0, whole_turn);
    for (int i = 0; i < count; ++i) {
        Random random(seed, purposes::furrows, static_cast<std::uint32_t>(i));
        const double jitter = random.symmetric();
        const double wander = random.uniform(0.05, 0.16);
        const double start = random.uniform(0.0, whole_turn);
        const double low = random.uniform();
        const double high = random.uniform();
        const double depth = random.uniform(0.45, 1.0);
        const double where = random.uniform();
        Furrow furrow;
        furrow.theta = wrapped(phase + whole_turn * ((4 * i % count) + 0.33 * jitter) / count);
        furrow.wander = wander;
        furrow.phase = start;
        furrow.from = 0.30 * low * low;
        furrow.to = 1.0 - 0.35 * high * high;
        furrow.depth = depth;
        furrow.onset = 0.5 * i / count;
        furrow.split_from = furrow.from + (furrow.to - furrow.from) * (0.15 + 0.45 * where);
        furrow.split_to = furrow.split_from + (furrow.to - furrow.from) * 0.32;
        out.push_back(furrow);
    }
    return out;
}

double furrow_angle(const Furrow& furrow, double sigma) {
    return furrow.theta + furrow.wander * sine(furrow.phase + 5.0 * sigma);
}

double furrow_depth(const Furrow& furrow, double sigma) {
    return furrow.depth * smooth_step(furrow.from - 0.12, furrow.from + 0.12, sigma) *
           (1.0 - smooth_step(furrow.to - 0.08, furrow.to + 0.1, sigma));
}

double radial_strain(const SubCurve& young, const SubCurve& now) {
    if (young.empty() || now.empty() || young.length() <= 0.0 || now.length() <= 0.0) return 0.0;
    // The cap runs from the margin (0) to the apex (1): the margin tears in its outer part.
    double hoop_young = 0.0, hoop_now = 0.0;
    for (const double share : {0.05, 0.12, 0.2}) {
        hoop_young += young.at(share).r;
        hoop_now += now.at(share).r;
    }
    if (hoop_young <= 0.0) return 0.0;
    const double excess = (hoop_now / hoop_young) / (now.length() / young.length()) - 1.0;
    return smooth_step(-0.05, 0.45, excess);
}

}  // namespace sporeprint
