#include "core/plant/venation.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "core/math/elementary.h"
#include "core/params/messages.h"

namespace sporeprint {

namespace {

// No source or measurement is recorded for these values down to `arch_spread`.
constexpr double most_turn_deg = 165.0;                // angle of the outermost main vein
constexpr double behind_deg = 177.0, clear_deg = 3.0;  // minimum distance to the petiole's line
constexpr double least_reach_deg = 5.0;    // least angle of side veins to the ray to the neighbour
constexpr double least_join = 0.08;        // least abscissa up to which neighbours are joined
constexpr double least_half_width = 0.02;  // least half width of a lobe
constexpr double clearance = 0.97;         // parts not joined reach this share of the ray's height
constexpr double least_gap = 1e-3;         // between two abscissas of a border
constexpr double slope_run = 0.6;          // of the slope beside a joined part, in its heights
constexpr double least_share = 0.3;        // of the angle between two main veins for either lobe
constexpr int limit_halvings = 40;         // of that angle: its error is below 1e-12 radians
constexpr double least_angle = 1e-6;       // radians, below which lines count as parallel
constexpr double unlimited = 1e9;          // height where no ray limits a border

// Tangents of a smooth border, in chords: at the root across and along the chord's axes, steep so
// that the base is round; at the tip along the side veins.
constexpr double root_tangent_x = 0.25, root_tangent_y = 1.25;
constexpr double tip_tangent_y = 1.2, tip_tangent_x = 0.2;

// Position of the tip of a tooth in its two steps: beyond the middle, so that a tooth leans to the
// tip of the lobe, rises slowly and falls steeply.
constexpr double tooth_tip = 1.55;

// The points of finely drawn teeth between their ends and tips: on the back as a share of it, on the
// front likewise, and their heights in that of the tip.
constexpr double tooth_back = 0.45, tooth_back_lift = 0.66;
constexpr double tooth_front = 0.45, tooth_front_lift = 0.3;

// How much longer the tangents of blunt ends of veins are than those of bays.
constexpr double blunt_breadth = 0.5;

// For asymmetry 1: how much narrower the angle between two main veins and how much shorter a side lobe
// may be, and how much the halves differ in breadth.
constexpr double turn_spread = 0.14, lobe_spread = 0.14, half_spread = 0.05;

// Length below which side veins fade: needles show their main vein alone.
constexpr double least_vein = 0.1;

// How much less the flattest side veins arch than the most curved ones.
constexpr double arch_spread = 0.7;

// For unevenness 1: how much shorter the shortest tooth is than the longest, and how far side veins
// differ from their mean length.
constexpr double teeth_spread = 0.75, vein_spread = 0.12;

// Returns 0..1 for the n-th of many things, so that neighbours are unlike.
//
// source  multiples of the golden ratio, modulo 1
double unlike(double n) {
    const double turns = n * 0.6180339887498949;
    return turns - std::floor(turns);
}

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

double edge_length(const Venation& venation, int d) {
    switch (venation.law) {
        case LengthLaw::constant:
            return 1.0;
        case LengthLaw::linear:
            return 1.0 + venation.rise * d;
        case LengthLaw::logarithmic:
            return 1.0 + venation.rise * logarithm(1.0 + d);
    }
    return 1.0;
}

// A point of the border over the main vein: its abscissa and its height.
using BorderPoint = glm::dvec2;

// A corner of a half's border: the end of a vein, lifted by the border factor, or a point between
// two of them.
struct Corner {
    BorderPoint at{0.0};
    bool end = false;  ///< end of a vein
};

// Returns half the width of a lobe that has only its main vein.
double least_height(const Lobe& lobe, double abscissa) {
    const double share = abscissa / lobe.reach;
    return least_half_width * lobe.reach * 4.0 * share * (1.0 - share);
}

std::vector<Corner> corners_of(const Venation& venation, const Lobe& lobe, const HalfLobe& half) {
    std::vector<Corner> ends = {{{0.0, 0.0}, true}};
    for (const HalfLobe::SideVein& vein : half.side_veins)
        ends.push_back({{vein.abscissa, venation.border * vein.length}, true});
    if (half.side_veins.empty())
        ends.push_back({{0.5 * lobe.reach, least_height(lobe, 0.5 * lobe.reach)}, true});
    ends.push_back({{lobe.reach, 0.0}, true});
    if (venation.sinus == 0.0) return ends;
    // Next to the petiole neighbours are joined, so only a single lobe has a bay there.
    std::vector<Corner> corners = {ends[0]};
    if (venation.lobes.value > 1) corners.push_back(ends[1]);
    for (std::size_t i = corners.size(); i < ends.size(); ++i) {
        BorderPoint between = 0.5 * (ends[i - 1].at + ends[i].at);
        between.y *= 1.0 - venation.sinus;
        corners.push_back({between, false});
        corners.push_back(ends[i]);
    }
    return corners;
}

// Returns the control point of a cubic for a tangent, limited so that abscissas do not pass the
// middle and heights do not become negative: the border remains a function.
BorderPoint bounded_handle(const BorderPoint& from, const BorderPoint& tangent, double sign,
                           const BorderPoint& other) {
    const BorderPoint handle = from + (sign / 3.0) * tangent;
    const double middle = 0.5 * (from.x + other.x);
    return {
        sign > 0.0 ? std::clamp(handle.x, from.x, middle) : std::clamp(handle.x, middle, from.x),
        std::max(handle.y, 0.0)};
}

std::vector<BorderPoint> border_curve(const Venation& venation, const Lobe& lobe, std::size_t which,
                                      int steps) {
    const HalfLobe& half = lobe.halves[which];
    const std::vector<Corner> corners = corners_of(venation, lobe, half);
    std::vector<BorderPoint> border = {corners.front().at};
    const int teeth = steps == 1 || venation.teeth == 0.0 ? 0
                      : venation.sinus == 0.0             ? venation.teeth_per_vein
                                                          : (venation.teeth_per_vein + 1) / 2;
    for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
        const BorderPoint from = corners[i].at, to = corners[i + 1].at, chord = to - from;
        const auto tangent = [&](std::size_t k) {
            BorderPoint turned = chord;
            if (k == 0) {
                turned = {root_tangent_x * chord.x, root_tangent_y * chord.y};
            } else if (k + 1 == corners.size()) {
                const SineCosine side = sine_cosine(lobe.side_angle[which]);
                const double size = tip_tangent_y * std::abs(chord.y) + tip_tangent_x * chord.x;
                turned = {size * std::max(0.0, side.cosine), -size};
            } else {
                turned = 0.5 * (corners[k + 1].at - corners[k - 1].at);
            }
            // Between bays, blunt ends of veins are broader than their bays.
            if (corners[k].end && k > 0 && k + 1 < corners.size() && venation.sinus > 0.0)
                turned.x *= 1.0 + blunt_breadth * (1.0 - venation.pointed);
            if (corners[k].end && k > 0) turned += venation.pointed * (chord - turned);
            return chord + venation.smooth * (turned - chord);
        };
        const BorderPoint leaving = bounded_handle(from, tangent(i), 1.0, to);
        const BorderPoint arriving = bounded_handle(to, tangent(i + 1), -1.0, from);
        const double tooth = teeth == 0 ? 0.0 : venation.teeth * 0.5 * glm::length(chord) / teeth;
        const auto put = [&](double t, double lift) {
            const double s = 1.0 - t;
            border.push_back(s * s * s * from + 3.0 * s * s * t * leaving +
                             3.0 * s * t * t * arriving + t * t * t * to + BorderPoint(0.0, lift));
        };
        for (int step = 1; teeth == 0 && step <= steps; ++step)
            put(static_cast<double>(step) / steps, 0.0);
        for (int k = 0; k < teeth; ++k) {
            // The first tooth after the end of a vein is the longest, as in doubly serrate leaves.
            const double own = k == 0 ? 0.0
                                      : unlike(static_cast<double>(i) * teeth + 2.0 * k + 1.0 +
                                               7.0 * static_cast<double>(which));
            const double tip = 0.5 * (tooth_tip - 0.3 * venation.unevenness * own);
            const double lift = tooth * (1.0 - teeth_spread * venation.unevenness * own);
            const bool fine = tooth_edges(steps) > 2;
            if (fine) put((k + tooth_back * tip) / teeth, tooth_back_lift * lift);
            put((k + tip) / teeth, lift);
            if (fine) put((k + tip + tooth_front * (1.0 - tip)) / teeth, tooth_front_lift * lift);
            put((k + 1.0) / teeth, 0.0);
        }
    }
    for (BorderPoint& place : border) place.y = std::max(place.y, least_height(lobe, place.x));
    border.front().y = border.back().y = 0.0;
    return border;
}

// Returns the height at which the line parallel to the side veins from an abscissa meets the ray
// from the root at `limit`; `unlimited` if it never does.
double limit_at(const Lobe& lobe, std::size_t side, double limit, double abscissa) {
    const double between = lobe.angle(side, abscissa) - limit;
    return between <= least_angle ? unlimited : abscissa * sine(limit) / sine(between);
}

// Returns the abscissa at which a border crosses the ray at `limit` for the last time; 0 if it
// never reaches it. Inner halves only: there the ray is a straight line over the abscissas.
double last_crossing(const Lobe& lobe, std::size_t side, double limit,
                     const std::vector<BorderPoint>& border) {
    const double slope = limit_at(lobe, side, limit, 1.0);
    for (std::size_t i = border.size() - 1; i > 0; --i) {
        const double after = border[i].y - slope * border[i].x;
        const double before = border[i - 1].y - slope * border[i - 1].x;
        if (before >= 0.0 && after < 0.0)
            return border[i - 1].x + (border[i].x - border[i - 1].x) * before / (before - after);
    }
    return 0.0;
}

// Returns the distance from the root, along the ray at `limit`, of the line parallel to the side
// veins from abscissa 1.
double along_limit(const Lobe& lobe, std::size_t side, double limit) {
    return sine(lobe.side_angle[side]) / sine(lobe.side_angle[side] - limit);
}

// Clips a border to its wedge and joins it to its neighbour; `joined` and `own` are abscissas, the
// first not beyond the second.
//
// fine  whether the slope that leads from the joined part to the border is a curve
void join_border(const Lobe& lobe, std::size_t side, double joined, double own,
                 const std::vector<BorderPoint>& border, bool fine, HalfLobe& half) {
    half.joined = joined;
    half.abscissas = {0.0};
    half.heights = {0.0};
    const auto put = [&](double abscissa, double height, double share) {
        if (abscissa - half.abscissas.back() < least_gap * lobe.reach) return;
        half.abscissas.push_back(abscissa);
        half.heights.push_back(std::min(std::max(height, least_height(lobe, abscissa)),
                                        share * limit_at(lobe, side, half.limit, abscissa)));
    };
    if (joined > 0.0) {
        half.abscissas.push_back(joined);
        half.heights.push_back(limit_at(lobe, side, half.limit, joined));
        put(own, unlimited, 1.0);
    }
    const double last = half.abscissas.back(), high = half.heights.back();
    std::vector<BorderPoint> places = border;
    // Where the joined part is wider than the border, a slope leads down to it.
    const double run = slope_run * high;
    const auto over = [&](double abscissa) {
        if (!(joined > 0.0)) return 0.0;
        const double share = (abscissa - last) / run;
        if (!fine) return high * (1.0 - share);
        const double left = std::max(0.0, 1.0 - 0.5 * share);
        return high * left * left;
    };
    const std::vector<double> shares =
        fine ? std::vector<double>{0.25, 0.5, 0.75, 1.0, 1.4} : std::vector<double>{0.5, 1.0};
    if (joined > 0.0)
        for (const double share : shares) {
            const double abscissa = last + share * run;
            const auto after =
                std::upper_bound(places.begin(), places.end(), abscissa,
                                 [](double x, const BorderPoint& place) { return x < place.x; });
            if (after == places.begin() || after == places.end()) continue;
            const BorderPoint a = *(after - 1), b = *after;
            const double t = (abscissa - a.x) / (b.x - a.x);
            places.insert(after, {abscissa, a.y + t * (b.y - a.y)});
        }
    for (const BorderPoint& place : places)
        if (place.x > last && place.x < (1.0 - least_gap) * lobe.reach)
            put(place.x, std::max(place.y, over(place.x)), clearance);
    half.abscissas.push_back(lobe.reach);
    half.heights.push_back(0.0);
}

bool crossing(const Vein& a, const Vein& b) {
    const glm::dvec2 along = a.to - a.from, other = b.to - b.from;
    const double sides = cross(along, b.from - a.from) * cross(along, b.to - a.from);
    const double others = cross(other, a.from - b.from) * cross(other, a.to - b.from);
    return sides < 0.0 && others < 0.0;
}

Vein side_vein(const Lamina& lamina, std::size_t lobe, std::size_t side,
               const HalfLobe::SideVein& vein) {
    const Lobe& one = lamina.lobes[lobe];
    return {lobe, false, side, one.place(side, vein.abscissa, 0.0),
            one.place(side, vein.abscissa, vein.length)};
}

Vein main_vein(const Lamina& lamina, std::size_t lobe) {
    return {lobe, true, 0, glm::dvec2(0.0),
            lamina.lobes[lobe].place(0, lamina.lobes[lobe].nodes.back(), 0.0)};
}

// Visits the lobes from the middle outwards and deletes side veins that cross any remaining vein.
void delete_crossings(Lamina& lamina) {
    const std::size_t count = lamina.lobes.size(), middle = count / 2;
    std::vector<Vein> retained;
    for (std::size_t lobe = 0; lobe < count; ++lobe) retained.push_back(main_vein(lamina, lobe));
    for (std::size_t out = 0; out <= middle; ++out)
        for (const std::size_t lobe : {middle - out, middle + out}) {
            if (out == 0 && lobe != middle) continue;
            const std::size_t before = retained.size();
            for (std::size_t side = 0; side < 2; ++side) {
                std::vector<HalfLobe::SideVein>& veins = lamina.lobes[lobe].halves[side].side_veins;
                std::vector<HalfLobe::SideVein> remaining;
                for (const HalfLobe::SideVein& vein : veins) {
                    const Vein line = side_vein(lamina, lobe, side, vein);
                    // Veins of one lobe do not cross, because their lines diverge.
                    const bool crosses =
                        std::any_of(retained.begin(), retained.begin() + static_cast<long>(before),
                                    [&](const Vein& other) {
                                        return other.lobe != lobe && crossing(line, other);
                                    });
                    if (!crosses) {
                        remaining.push_back(vein);
                        retained.push_back(line);
                    }
                }
                veins = std::move(remaining);
            }
            if (out == 0) break;
        }
}

}  // namespace

void Venation::check(const std::string& path, std::vector<Problem>& problems) const {
    const int pairs = lobes.value / 2;
    if (pairs * vein_deg > most_turn_deg)
        report(problems, path + "/vein_deg",
               number_text(vein_deg) + " would turn the outermost of " +
                   std::to_string(lobes.value) + " lobes onto the petiole; at most " +
                   number_text(std::floor(most_turn_deg / pairs)));
    if (pairs > 0 && side_deg < 0.5 * vein_deg + least_reach_deg)
        report(problems, path + "/side_deg",
               number_text(side_deg) +
                   " is too flat for side veins to reach the next lobe; at "
                   "least half of vein_deg and " +
                   number_text(least_reach_deg));
}

double HalfLobe::height(double abscissa) const {
    const auto after = std::upper_bound(abscissas.begin(), abscissas.end(), abscissa);
    if (after == abscissas.begin() || after == abscissas.end()) return 0.0;
    const auto i = static_cast<std::size_t>(after - abscissas.begin());
    const double t = (abscissa - abscissas[i - 1]) / (abscissas[i] - abscissas[i - 1]);
    return heights[i - 1] + t * (heights[i] - heights[i - 1]);
}

double Lobe::angle(std::size_t side, double abscissa) const {
    const double left = 1.0 - abscissa / reach;
    return side_angle[side] + (base_angle[side] - side_angle[side]) * left * left;
}

glm::dvec2 Lobe::place(std::size_t side, double abscissa, double height) const {
    const SineCosine at = sine_cosine(angle(side, abscissa)), turned = sine_cosine(turn);
    const double along = abscissa + height * at.cosine;
    const double left = (side == 0 ? height : -height) * at.sine;
    return {-turned.sine * along - turned.cosine * left,
            turned.cosine * along - turned.sine * left};
}

namespace {

// Returns a lobe with straight main vein, `outwards` places from the middle one, turned to the
// left; in the unit of the law of lengths until scale().
Lobe planned_lobe(const Venation& venation, int outwards) {
    Lobe lobe;
    const int nodes = std::max(
        2, venation.nodes - static_cast<int>(std::floor(venation.node_loss * outwards + 0.5)));
    double along = 0.0, edge = 0.0;
    std::vector<HalfLobe::SideVein> side_veins;
    for (int q = 0; q < nodes; ++q) {
        edge = edge_length(venation, nodes - q);
        if (q > 0) {
            const double on = static_cast<double>(q) / nodes, back = 1.0 - on;
            side_veins.push_back(
                {along, edge * venation.side_length * (1.0 - venation.narrow_base * back * back) *
                            (1.0 - venation.narrow_tip * on * on)});
        }
        along += edge;
        lobe.nodes.push_back(along);
    }
    lobe.reach = along + (venation.border - 1.0) * edge;
    for (std::size_t side = 0; side < 2; ++side) {
        std::vector<HalfLobe::SideVein>& own = lobe.halves[side].side_veins;
        own = side_veins;
        for (std::size_t i = 0; i < own.size(); ++i) {
            const double begin = i == 0 ? 0.0 : side_veins[i - 1].abscissa;
            if (side == 1)
                own[i].abscissa -= 0.5 * venation.asymmetry * (side_veins[i].abscissa - begin);
            const double drawn = unlike(2.0 * static_cast<double>(i) + static_cast<double>(side));
            own[i].length *= 1.0 + vein_spread * venation.unevenness * (2.0 * drawn - 1.0);
            own[i].length *= 1.0 + half_spread * venation.asymmetry * (side == 0 ? 1.0 : -1.0);
            own[i].arch =
                venation.arch * (1.0 - arch_spread * unlike(3.0 * static_cast<double>(i) +
                                                            1.4 * static_cast<double>(side) + 0.3));
        }
    }
    return lobe;
}

// Multiplies all lengths of a planned lobe by `unit`.
void scale(Lobe& lobe, double unit) {
    for (double& node : lobe.nodes) node *= unit;
    for (HalfLobe& half : lobe.halves)
        for (HalfLobe::SideVein& vein : half.side_veins)
            vein = {vein.abscissa * unit, vein.length * unit, vein.arch};
    lobe.reach *= unit;
}

// Sets the angles of a lobe's side veins; those of an outermost one on the side of the petiole keep
// clear of its line.
void set_angles(const Venation& venation, bool is_outermost, bool is_single, Lobe& lobe) {
    const double side = radians(venation.side_deg);
    lobe.side_angle = {side, side};
    if (is_outermost) {
        // Lines that stay in front of the petiole's line never meet it.
        const double largest_angle = radians(behind_deg) - lobe.turn - radians(clear_deg);
        lobe.side_angle[0] = std::min(side, largest_angle);
        lobe.base_angle[0] = std::min(side + radians(venation.base_deg), largest_angle);
        if (!is_single) lobe.base_angle[1] = side;
    } else {
        lobe.base_angle = lobe.side_angle;
    }
    if (is_single) {
        lobe.side_angle[1] = lobe.side_angle[0];
        lobe.base_angle[1] = lobe.base_angle[0];
    }
}

// Returns the lobes with their veins, from the rightmost to the leftmost, without borders.
std::vector<Lobe> planned_lobes(const Venation& venation) {
    const int pairs = venation.lobes.value / 2;
    const double between = radians(venation.vein_deg);
    std::vector<Lobe> lobes;
    double unit = 1.0;
    std::array<double, 2> turn{};  // of the left and the right lobe
    // The middle lobe is laid out first, because its reach is the unit of length.
    for (int j = 0; j <= pairs; ++j) {
        const Lobe planned = planned_lobe(venation, j);
        if (j == 0) unit = 1.0 / planned.reach;
        for (std::size_t side = 0; side < (j == 0 ? 1U : 2U); ++side) {
            // Main veins never stand farther apart than requested, so that they stay clear of the
            // petiole.
            const double draw = 2.0 * j + 5.0 * static_cast<double>(side);
            const double shorter =
                j == 0 ? 0.0 : lobe_spread * venation.asymmetry * unlike(draw + 1.0);
            if (j > 0)
                turn[side] += between * (1.0 - turn_spread * venation.asymmetry * unlike(draw));
            Lobe lobe = planned;
            scale(lobe, unit * (1.0 - shorter));
            lobe.turn = turn[side];
            set_angles(venation, j == pairs, pairs == 0, lobe);
            if (side == 0) {
                lobes.push_back(lobe);
                continue;
            }
            std::swap(lobe.side_angle[0], lobe.side_angle[1]);
            std::swap(lobe.base_angle[0], lobe.base_angle[1]);
            lobe.turn = -lobe.turn;
            lobes.insert(lobes.begin(), lobe);
        }
    }
    return lobes;
}

// Divides the wedge between two neighbouring lobes by a ray from the root and joins their borders
// along it. The borders meet where both have their last crossing of the ray at the same distance
// from the root.
//
// right_border, left_border  the facing borders before clipping
void join_neighbours(const Venation& venation, const std::vector<BorderPoint>& right_border,
                     const std::vector<BorderPoint>& left_border, bool fine, Lobe& right,
                     Lobe& left) {
    const double between = left.turn - right.turn;
    const auto reach = [&](const Lobe& lobe, std::size_t side, double limit,
                           const std::vector<BorderPoint>& border) {
        return last_crossing(lobe, side, limit, border) * along_limit(lobe, side, limit);
    };
    const double flat = radians(venation.side_deg - clear_deg);
    double low = std::max(least_share * between, between - flat),
           high = std::min((1.0 - least_share) * between, flat);
    for (int halving = 0; halving < limit_halvings; ++halving) {
        const double limit = 0.5 * (low + high);
        const double gap =
            reach(right, 0, limit, right_border) - reach(left, 1, between - limit, left_border);
        (gap > 0.0 ? low : high) = limit;
    }
    const double limit = 0.5 * (low + high);
    right.halves[0].limit = limit;
    left.halves[1].limit = between - limit;
    const double from_right = reach(right, 0, limit, right_border);
    const double from_left = reach(left, 1, between - limit, left_border);
    const double least = least_join * std::min(right.reach, left.reach);
    const double shared = std::max(std::min(from_right, from_left), least);
    const double scale_right = along_limit(right, 0, limit);
    const double scale_left = along_limit(left, 1, between - limit);
    join_border(right, 0, shared / scale_right, std::max(shared, from_right) / scale_right,
                right_border, fine, right.halves[0]);
    join_border(left, 1, shared / scale_left, std::max(shared, from_left) / scale_left, left_border,
                fine, left.halves[1]);
}

}  // namespace

Lamina lamina_of(const Venation& venation, int steps) {
    std::vector<Problem> problems;
    sporeprint::check(venation, Info{.name = ""}, "", problems);
    if (!problems.empty()) throw InvalidInput(std::move(problems));
    Lamina lamina{planned_lobes(venation)};
    delete_crossings(lamina);
    const std::size_t count = lamina.lobes.size();
    std::vector<std::array<std::vector<BorderPoint>, 2>> borders(count);
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t side = 0; side < 2; ++side)
            borders[i][side] = border_curve(venation, lamina.lobes[i], side, steps);
    const bool fine = tooth_edges(steps) > 2;
    Lobe& first = lamina.lobes.front();
    Lobe& last = lamina.lobes.back();
    first.halves[1].limit = radians(behind_deg) + first.turn;
    last.halves[0].limit = radians(behind_deg) - last.turn;
    join_border(first, 1, 0.0, 0.0, borders.front()[1], fine, first.halves[1]);
    join_border(last, 0, 0.0, 0.0, borders.back()[0], fine, last.halves[0]);
    for (std::size_t i = 0; i + 1 < count; ++i)
        join_neighbours(venation, borders[i][0], borders[i + 1][1], fine, lamina.lobes[i],
                        lamina.lobes[i + 1]);
    for (Lobe& lobe : lamina.lobes)
        for (HalfLobe& half : lobe.halves)
            for (HalfLobe::SideVein& vein : half.side_veins)
                vein.length = std::min(vein.length, half.height(vein.abscissa));
    return lamina;
}

std::vector<Vein> veins_of(const Lamina& lamina) {
    std::vector<Vein> veins;
    for (std::size_t lobe = 0; lobe < lamina.lobes.size(); ++lobe)
        veins.push_back(main_vein(lamina, lobe));
    for (std::size_t lobe = 0; lobe < lamina.lobes.size(); ++lobe)
        for (std::size_t side = 0; side < 2; ++side)
            for (const HalfLobe::SideVein& vein : lamina.lobes[lobe].halves[side].side_veins)
                veins.push_back(side_vein(lamina, lobe, side, vein));
    return veins;
}

std::vector<glm::dvec2> border_of(const Lamina& lamina) {
    std::vector<glm::dvec2> border = {glm::dvec2(0.0)};
    for (const Lobe& lobe : lamina.lobes) {
        const HalfLobe& right = lobe.halves[1];
        for (std::size_t i = 1; i < right.abscissas.size(); ++i)
            if (right.abscissas[i] > right.joined)
                border.push_back(lobe.place(1, right.abscissas[i], right.heights[i]));
        const HalfLobe& left = lobe.halves[0];
        for (std::size_t i = left.abscissas.size() - 1; i > 1; --i)
            if (left.abscissas[i - 1] >= left.joined)
                border.push_back(lobe.place(0, left.abscissas[i - 1], left.heights[i - 1]));
    }
    return border;
}

namespace {

constexpr std::size_t directions = 2048;
constexpr double per_radian = static_cast<double>(directions) / (2.0 * pi);

constexpr double near_sine =
    0.0125;  // of a point to the direction of the last one: four directions

// Largest number of steps of Newton's method, after which bisection alone would leave 4e-15 of the
// bracket, and the last step at which it ends.
constexpr int most_newton_steps = 48;
constexpr double abscissa_tolerance = 1e-7;

// Returns the index of a direction, counted from straight back to the left.
double direction_of(const glm::dvec2& p) { return (arc_tangent(-p.x, p.y) + pi) * per_radian; }

}  // namespace

LaminaSampler::LaminaSampler(Lamina lamina)
    : lamina_(std::move(lamina)), reach_(directions + 1, 0.0) {
    const std::vector<glm::dvec2> border = border_of(lamina_);
    for (const Lobe& lobe : lamina_.lobes) {
        turns_.push_back(sine_cosine(lobe.turn));
        for (std::size_t side = 0; side < 2; ++side) {
            const SineCosine root = sine_cosine(lobe.base_angle[side]);
            Half half;
            half.root = root;
            half.tip = sine_cosine(lobe.side_angle[side]);
            half.cotangent = root.cosine / root.sine;
            half.parallel = lobe.base_angle[side] == lobe.side_angle[side];
            const HalfLobe& drawn = lobe.halves[side];
            for (std::size_t i = 0; i + 1 < drawn.abscissas.size(); ++i)
                half.slopes.push_back((drawn.heights[i + 1] - drawn.heights[i]) /
                                      (drawn.abscissas[i + 1] - drawn.abscissas[i]));
            halves_.push_back(std::move(half));
        }
    }
    // Directions are angles to the left of the middle main vein.
    for (std::size_t k = 0; k <= directions; ++k) {
        const SineCosine ray = sine_cosine(static_cast<double>(k) / per_radian - pi);
        rays_.emplace_back(-ray.sine, ray.cosine);
    }
    for (std::size_t i = 1; i + 1 < border.size(); ++i) {
        const glm::dvec2 a = border[i], b = border[i + 1];
        const double from = direction_of(a), to = direction_of(b);
        if (std::abs(from - to) > 0.5 * directions) continue;
        const double low = std::min(from, to), high = std::max(from, to);
        for (auto k = static_cast<std::size_t>(std::max(0.0, std::floor(low)));
             k <= directions && static_cast<double>(k) <= high + 1.0; ++k) {
            const glm::dvec2& along = rays_[k];
            const double across = cross(along, b - a);
            if (std::abs(across) < 1e-12) continue;
            const double t = std::clamp(-cross(along, a) / across, 0.0, 1.0);
            reach_[k] = std::max(reach_[k], glm::dot(along, a + t * (b - a)));
        }
    }
}

// Returns the angle to the left of the middle main vein, and the distance of the border there.
double LaminaSampler::turn_of(const glm::dvec2& point, double distance, Hint& hint,
                              double& reach) const {
    const glm::dvec2& ray = rays_[hint.direction];
    const double sine = cross(ray, point) / distance, z = sine * sine;
    double where = 0.0;
    if (z < near_sine * near_sine && glm::dot(ray, point) > 0.0) {
        // Series of the arcsine for a small sine; the truncation error is below 1e-17.
        const double arc = sine * (1.0 + z * (1.0 / 6.0 + z * (3.0 / 40.0 + z * (15.0 / 336.0))));
        where = static_cast<double>(hint.direction) + arc * per_radian;
        if (where < 0.0) where += static_cast<double>(directions);
        if (where >= static_cast<double>(directions)) where -= static_cast<double>(directions);
    } else {
        where = std::max(direction_of(point), 0.0);
    }
    const std::size_t k =
        std::min(static_cast<std::size_t>(static_cast<int>(where)), directions - 1);
    if (z > 0.25 * near_sine * near_sine) hint.direction = k;
    reach = reach_[k] + (where - static_cast<double>(k)) * (reach_[k + 1] - reach_[k]);
    return where / per_radian - pi;
}

double LaminaSampler::border_over(const HalfLobe& half, double abscissa, Hint& hint) const {
    if (!(abscissa >= half.abscissas.front() && abscissa < half.abscissas.back())) return 0.0;
    std::size_t i = std::min(hint.corner, half.abscissas.size() - 2);
    while (abscissa < half.abscissas[i]) --i;
    while (abscissa >= half.abscissas[i + 1]) ++i;
    hint.corner = i;
    return half.heights[i] + (abscissa - half.abscissas[i]) * halves_[hint.half].slopes[i];
}

LaminaPlace LaminaSampler::at(const glm::dvec2& point) const {
    Hint hint;
    return at(point, hint);
}

namespace {

// Returns a starting abscissa for Newton's method, extrapolated from those of the previous points
// on the same half, newest first.
double extrapolated(const std::array<double, 3>& f, std::size_t known) {
    return known == 1 ? f[0] : known == 2 ? 2.0 * f[0] - f[1] : 3.0 * (f[0] - f[1]) + f[2];
}

// Finds the abscissa at which the line through a point inside a half meets the main vein, from the
// starting value in `place` or `at`: by Newton's method. The function is monotonic, so steps that
// leave the bracket are replaced by bisection.
//
// at  the direction of the line at the abscissa, before and after
void solve_abscissa(const Lobe& lobe, double along, LaminaPlace& place, SineCosine& at) {
    double low = 0.0, high = lobe.reach;
    const double bend =
        2.0 * (lobe.base_angle[place.side] - lobe.side_angle[place.side]) / lobe.reach;
    for (int step = 0; step < most_newton_steps; ++step) {
        const double value = place.abscissa + place.from_main * at.cosine / at.sine - along;
        (value < 0.0 ? low : high) = place.abscissa;
        const double slope = 1.0 + place.from_main * bend * (1.0 - place.abscissa / lobe.reach) /
                                       (at.sine * at.sine);
        const double next = place.abscissa - value / slope, before = place.abscissa;
        place.abscissa = next >= low && next <= high ? next : 0.5 * (low + high);
        const double moved = place.abscissa - before;
        const double turning =
            lobe.angle(place.side, place.abscissa) - lobe.angle(place.side, before);
        if (std::abs(moved) < abscissa_tolerance) {
            // The rotation to second order: its error is of the order of that of the abscissas.
            at = {at.sine + turning * (at.cosine - 0.5 * turning * at.sine),
                  at.cosine - turning * (at.sine + 0.5 * turning * at.cosine)};
            return;
        }
        at = sine_cosine(lobe.angle(place.side, place.abscissa));
    }
}

}  // namespace

// Sets the abscissa of a point and returns the direction of the line of side veins through it.
// Lines diverge, so there is at most one through a point.
SineCosine LaminaSampler::line_through(const Lobe& lobe, const Half& known, double along,
                                       double at_root, Hint& hint, LaminaPlace& place) {
    if (known.parallel) {
        place.abscissa = -at_root;
        return known.root;
    }
    if (lobe.reach + place.from_main * known.tip.cosine / known.tip.sine <= along) {
        // Beyond the tip.
        place.abscissa = lobe.reach;
        hint.known = 0;
        return known.tip;
    }
    if (!(at_root < 0.0)) {
        hint.known = 0;
        return known.root;
    }
    SineCosine at = known.root;
    if (hint.known > 0) {
        place.abscissa = std::clamp(extrapolated(hint.abscissas, hint.known), 0.0, lobe.reach);
        at = sine_cosine(lobe.angle(place.side, place.abscissa));
    }
    solve_abscissa(lobe, along, place, at);
    hint.abscissas = {place.abscissa, hint.abscissas[0], hint.abscissas[1]};
    hint.known = std::min(hint.known + 1, hint.abscissas.size());
    return at;
}

// Sets the distance from the nearest side vein: one of the two whose abscissas enclose that of the
// point, or the one after them.
void LaminaSampler::measure_side_vein(const HalfLobe& half, const SineCosine& at, Hint& hint,
                                      LaminaPlace& place) {
    const std::vector<HalfLobe::SideVein>& veins = half.side_veins;
    if (veins.empty()) return;
    std::size_t next = std::min(hint.vein, veins.size());
    while (next > 0 && place.abscissa < veins[next - 1].abscissa) --next;
    while (next < veins.size() && place.abscissa >= veins[next].abscissa) ++next;
    hint.vein = next;
    // Drawn veins sag towards the root, so that the one after the next may be the nearest.
    const std::size_t first = next - std::min<std::size_t>(next, 1);
    std::size_t nearest = first;
    double least = 1e9;
    for (std::size_t i = first; i < std::min(next + 2, veins.size()); ++i) {
        const double away = std::abs(place.abscissa - veins[i].line(place.height));
        if (away >= least) continue;
        least = away;
        nearest = i;
    }
    const HalfLobe::SideVein& vein = veins[nearest];
    place.from_side = least * at.sine + std::max(0.0, least_vein - vein.length);
    place.along_side = vein.length > 0.0 ? place.height / vein.length : 1.0;
}

LaminaPlace LaminaSampler::at(const glm::dvec2& point, Hint& hint) const {
    LaminaPlace place;
    const double distance = glm::length(point);
    double reach = reach_[directions / 2], turn = 0.0;
    if (distance > 0.0) turn = turn_of(point, distance, hint, reach);
    while (place.lobe + 1 < lamina_.lobes.size() &&
           turn > lamina_.lobes[place.lobe].turn + lamina_.lobes[place.lobe].halves[0].limit)
        ++place.lobe;
    const Lobe& lobe = lamina_.lobes[place.lobe];
    const SineCosine turned = turns_[place.lobe];
    const double along = -turned.sine * point.x + turned.cosine * point.y;
    const double left = -turned.cosine * point.x - turned.sine * point.y;
    place.side = left >= 0.0 ? 0 : 1;
    const HalfLobe& half = lobe.halves[place.side];
    const Half& known = halves_[2 * place.lobe + place.side];
    if (hint.half != 2 * place.lobe + place.side) {
        hint.half = 2 * place.lobe + place.side;
        hint.known = 0;
    }
    place.from_main = std::abs(left);
    const double at_root = place.from_main * known.cotangent - along;
    const SineCosine at = line_through(lobe, known, along, at_root, hint, place);
    place.height = place.from_main / at.sine;
    const double border = border_over(half, place.abscissa, hint);
    place.inside = place.abscissa >= 0.0 && place.abscissa <= lobe.reach &&
                   place.height <= border && at_root <= 0.0;
    place.affinity = border > 0.0 ? place.height / border : 1.0;
    place.homothety = reach > 0.0 ? std::min(distance / reach, 1.0) : 1.0;
    measure_side_vein(half, at, hint, place);
    return place;
}

}  // namespace sporeprint
