#include "core/geometry/damage_dents.h"

#include <algorithm>

#include "core/math/elementary.h"

namespace sporeprint {

namespace {

constexpr double whole_turn = 2.0 * pi;

// Angle from the middle of a furrow to either side, radians.
constexpr double furrow_half_width = 0.045 * whole_turn;

}  // namespace

double furrow_valley(double middle, double angle) {
    const double x = turn_between(middle, angle) / furrow_half_width;
    return x <= -1.0 || x >= 1.0 ? 0.0 : (1.0 - x * x) * (1.0 - x * x);
}

double mean_radius(const SubCurve& stem) {
    double sum = 0.0;
    for (int i = 0; i <= 16; ++i) sum += stem.at(i / 16.0).r / 17.0;
    return sum;
}

double stem_freedom(double share) {
    return smooth_step(0.0, 0.06, share) * (1.0 - smooth_step(0.93, 0.995, share));
}

Dents::Dents(const Individual& individual)
    : outline_(individual.outline),
      bumps_(individual.damage.amounts.bumps),
      creases_(individual.damage.amounts.creases),
      clubs_(individual.damage.clubs) {
    if (bumps_ <= 0.0 && creases_ <= 0.0) return;
    radius_ = mean_radius(outline_.stem);
    for (const auto& [seed, weight] : damage_shares(individual)) {
        if (weight <= 0.0) continue;
        Share& share = shares_.emplace_back(Share{weight, {}, {}, {}});
        if (bumps_ > 0.0) {
            share.cap_lumps = damage_spots(DamageSpotKind::lump, CurveName::cap, seed);
            share.stem_lumps = damage_spots(DamageSpotKind::lump, CurveName::stem, seed);
        }
        if (creases_ > 0.0) share.furrows = furrows(seed);
    }
}

double Dents::lumps(const SubCurve& curve, std::vector<DamageSpot> Share::*spots, double unit,
                    bool stem, double sigma, double angle) const {
    const double length = curve.length(), ring = curve.at(stem ? sigma : 1.0 - sigma).r;
    double height = 0.0;
    for (const Share& share : shares_)
        for (const DamageSpot& spot : share.*spots) {
            const double scale = grown(spot.onset, bumps_);
            const double size = std::max(spot.radius * faded_in_size(scale), 1e-4) * unit;
            const double a = (sigma - spot.sigma) * length / (size * spot.elongation);
            if (scale <= 0.0 || a < -1.0 || a > 1.0) continue;
            const double r = std::max(curve.at(stem ? spot.sigma : 1.0 - spot.sigma).r, 1e-4);
            const double chord = 2.0 * sine(0.5 * turn_between(spot.theta, angle));
            const double square = a * a + r * ring * chord * chord / (size * size);
            if (square < 1.0)
                height += share.weight * lump_height(spot) * scale * unit * (1.0 - square) *
                          (1.0 - square);
        }
    return height;
}

double Dents::furrow(double sigma, double angle, bool on_stem) const {
    double deepest = 0.0;
    for (const Share& share : shares_)
        for (const Furrow& furrow : share.furrows) {
            const double scale = share.weight * grown(furrow.onset, creases_);
            if (scale <= 0.0) continue;
            deepest =
                std::max(deepest, (on_stem ? furrow_depth(furrow, sigma) : furrow.depth) * scale *
                                      furrow_valley(furrow_angle(furrow, sigma), angle));
        }
    return furrow_deep * radius_ * deepest;
}

double Dents::cap(double sigma, double angle) const {
    double height = 0.0;
    if (bumps_ > 0.0)
        height = lumps(outline_.cap, &Share::cap_lumps, outline_.cap.length(), false, sigma, angle);
    if (creases_ > 0.0 && clubs_ > 0.0) {
        const double share = 1.0 - sigma;
        height -= club_carried * clubs_ * club_fade(share) * smooth_step(0.0, 0.08, share) *
                  furrow(1.0 + share, angle, false);
    }
    return height;
}

double Dents::stem(double sigma, double angle) const {
    double height = 0.0;
    if (bumps_ > 0.0)
        height = lumps(outline_.stem, &Share::stem_lumps, whole_turn * radius_, true, sigma, angle);
    if (creases_ > 0.0) height = std::min(height, -furrow(sigma, angle, true));
    return height * stem_freedom(sigma);
}

}  // namespace sporeprint
