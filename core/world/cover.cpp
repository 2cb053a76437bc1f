#include "core/world/cover.h"

#include <algorithm>
#include <cmath>

#include "core/math/elementary.h"
#include "core/problems.h"

namespace sporeprint {

namespace {

/// Decay of the litter of broad leaves and of needles, per year.
constexpr double decay_of_leaves = 0.75, decay_of_needles = 0.3;

/// Days between which leaves fall.
constexpr double first_fall = 262.0, last_fall = 330.0;

/// Returns the leaves on the ground, in those that fall in a year.
double leaves_lying(int day) {
    const double d = day;
    const double fallen = smooth_step(first_fall, last_fall, d);
    const double since = (d + 365.0 - 0.5 * (first_fall + last_fall)) / 365.0;
    const double of_last_years =
        exponential(-decay_of_leaves * since) / (1.0 - exponential(-decay_of_leaves));
    return fallen + of_last_years;
}

/// Returns how far herbs are out, 0..1.
double herbs_on(int day) {
    const double d = day;
    return 0.4 * smooth_step(70.0, 110.0, d) * (1.0 - smooth_step(280.0, 320.0, d)) +
           0.6 * smooth_step(70.0, 110.0, d) * (1.0 - smooth_step(140.0, 190.0, d));
}

/// Takes a share of what is left.
double take(double& left, double share) {
    const double taken = left * std::clamp(share, 0.0, 1.0);
    left -= taken;
    return taken;
}

}  // namespace

double Cover::all_leaves() const {
    double sum = 0.0;
    for (const double share : leaves) sum += share;
    return sum;
}

Cover cover_of(const CoverConditions& at) {
    std::array<double, most_kinds> lying{};
    double leaves = 0.0, needles = 0.0;
    const double years_of_leaves = leaves_lying(at.day);
    for (std::size_t kind = 0; kind < most_kinds; ++kind) {
        if (at.has_needles[kind]) {
            needles += at.fall[kind] / decay_of_needles;
        } else {
            lying[kind] = years_of_leaves * at.fall[kind];
            leaves += lying[kind];
        }
    }
    // A leaf that falls on others covers nothing more: those of a year cover nine tenths of the ground.
    const double litter = 1.0 - exponential(-2.2 * (leaves + 0.5 * needles));
    // Where crowns are placed at random, what passes between them is a power of their area: twice the area, the square.
    const double light = at.light * at.light, shade = 1.0 - light;
    const double moisture = at.wetness * (0.3 + 0.7 * shade) * (0.35 + 0.65 * at.acidity);
    const double broad = leaves + needles > 0.0 ? leaves / (leaves + needles) : 0.0;
    Cover cover;
    double left = 1.0;
    cover.water = take(left, smooth_step(0.35, 0.75, at.stream));
    cover.rock = take(left, smooth_step(0.8, 1.4, at.slope));
    cover.moss =
        take(left, 0.85 * smooth_step(0.12, 0.62, moisture) * (1.0 - 0.8 * litter * broad));
    cover.grass = take(left, 0.95 * smooth_step(0.2, 0.7, light) * (1.0 - 0.6 * litter * broad));
    cover.herb = take(left, 0.5 * herbs_on(at.day) * smooth_step(0.1, 0.5, at.wetness) *
                                (1.0 - 0.8 * at.acidity) * smooth_step(0.02, 0.25, at.light));
    const double covered = take(left, litter);
    cover.soil = left;
    const double all = leaves + 0.5 * needles;
    if (all <= 0.0) return cover;
    cover.needles = covered * (0.5 * needles / all);
    for (std::size_t kind = 0; kind < most_kinds; ++kind)
        cover.leaves[kind] = covered * (lying[kind] / all);
    return cover;
}

FallenLeaves fallen_leaves(int day) {
    const double d = day, since = (d + 365.0 - last_fall) / 365.0;
    if (d <= first_fall) return {1.0, since, 0.0};
    if (d <= last_fall) return {smooth_step(first_fall, last_fall, d), 0.0, 1.0};
    return {1.0, since - 1.0, 1.0 - smooth_step(last_fall, 365.0, d)};
}

double litterfall(double x, double y, double radius, double wind_x, double wind_y) {
    const double along = x * wind_x + y * wind_y, across = y * wind_x - x * wind_y;
    const double square = radius * radius - across * across;
    if (square <= 0.0) return 0.0;
    const double half = std::sqrt(square);
    if (along <= -half || along >= half + most_litter_drift) return 0.0;
    return exponential(-std::max(along - half, 0.0) / litter_drift) -
           exponential(-(along + half) / litter_drift);
}

std::array<double, most_kinds> litterfall(std::span<const LitterSource> sources, double x, double y,
                                          double wind_x, double wind_y) {
    std::array<double, most_kinds> sum{};
    for (const LitterSource& one : sources)
        sum[one.kind] +=
            litterfall(x - one.x, y - one.y, crown_filling * one.radius, wind_x, wind_y);
    return sum;
}

void set_ground(CoverConditions& conditions, const Ground& ground, double x, double y,
                double soil_water) {
    const Coordinate column = coordinate_at(ground.grid, x), row = coordinate_at(ground.grid, y);
    const Place place = place_at(ground, column, row);
    conditions.wetness = wetness_on(ground, wetness_index_at(ground, column, row), soil_water);
    conditions.slope = std::sqrt(place.east * place.east + place.north * place.north);
    conditions.stream = stream_at(ground, column, row);
}

Cover CoverField::at(double x, double y) const {
    const double u = x / step, v = y / step;
    const double column = std::floor(u), row = std::floor(v);
    const int i = std::clamp(static_cast<int>(column) - west, 0, columns - 2),
              j = std::clamp(static_cast<int>(row) - south, 0, rows - 2);
    const double s = u - column, t = v - row;
    const Cover &a = node(i, j), &b = node(i + 1, j), &c = node(i, j + 1), &d = node(i + 1, j + 1);
    const double wa = (1.0 - s) * (1.0 - t), wb = s * (1.0 - t), wc = (1.0 - s) * t, wd = s * t;
    const auto mixed = [&](double Cover::*share) {
        return wa * a.*share + wb * b.*share + wc * c.*share + wd * d.*share;
    };
    Cover out;
    out.soil = mixed(&Cover::soil);
    out.needles = mixed(&Cover::needles);
    out.moss = mixed(&Cover::moss);
    out.grass = mixed(&Cover::grass);
    out.herb = mixed(&Cover::herb);
    out.rock = mixed(&Cover::rock);
    out.water = mixed(&Cover::water);
    for (std::size_t kind = 0; kind < most_kinds; ++kind)
        out.leaves[kind] =
            wa * a.leaves[kind] + wb * b.leaves[kind] + wc * c.leaves[kind] + wd * d.leaves[kind];
    return out;
}

CoverField cover_lattice(const WorldBox& box, double margin, double step) {
    double power = CoverField::finest_step;
    while (power < step) power *= 2.0;
    if (power != step)
        throw InvalidInput("/step", "the step of a cover is half a metre times a power of two");
    const auto number = [step](double metres) {
        return static_cast<int>(std::floor(metres / step));
    };
    CoverField field;
    field.step = step;
    field.west = number(box.west - margin);
    field.south = number(box.south - margin);
    field.columns = number(box.east + margin) + 2 - field.west;
    field.rows = number(box.north + margin) + 2 - field.south;
    return field;
}

CoverField cover_field(const WorldBox& box, double margin,
                       const std::function<Cover(double, double)>& cover, double step) {
    CoverField field = cover_lattice(box, margin, step);
    field.nodes.reserve(static_cast<std::size_t>(field.columns) *
                        static_cast<std::size_t>(field.rows));
    for (int row = 0; row < field.rows; ++row)
        for (int column = 0; column < field.columns; ++column)
            field.nodes.push_back(cover((field.west + column) * step, (field.south + row) * step));
    return field;
}

}  // namespace sporeprint
