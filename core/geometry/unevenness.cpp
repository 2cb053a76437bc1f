#include "core/geometry/unevenness.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/individual/proportion.h"
#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"

namespace sporeprint {

namespace {

// The largest coefficients.
constexpr double beside = 0.06;
constexpr std::array<double, 4> of_sides{0.05, 0.066, 0.035, 0.02};
constexpr std::array<double, 3> of_lifts{0.03, 0.05, 0.035};
/// Of the winding, in lengths of the stem and, at most, in radii.
constexpr std::array<double, 4> of_winding{0.016, 0.008, 0.003, 0.0015};
constexpr std::array<double, 4> most_winding{0.55, 0.45, 0.1, 0.07};
constexpr std::array<double, 4> of_swelling{0.1, 0.06, 0.028, 0.02};
/// Of the cross section of the stem: the part that is the same all along it, and that of its waves.
constexpr std::array<double, 2> of_ovals{0.04, 0.025}, of_oval_waves{0.055, 0.035};
/// How often the cross section changes along the stem, in waves.
constexpr std::array<double, 2> oval_waves{1.3, 2.1};
/// Least height over which the margin lifts, in greatest radii.
constexpr double least_rise = 0.35;

/// Returns the product of two complex numbers.
glm::dvec2 product(const glm::dvec2& a, const glm::dvec2& b) {
    return {a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x};
}

/// Returns the product of the conjugate of one complex number and another.
glm::dvec2 turned(const glm::dvec2& a, const glm::dvec2& b) {
    return {a.x * b.x + a.y * b.y, a.x * b.y - a.y * b.x};
}

/// Returns a random complex number with `least` to 1 of a length.
glm::dvec2 drawn(Random& random, double length, double least = 0.6) {
    const double share = random.uniform(least, 1.0);
    const auto [s, c] = sine_cosine(random.uniform(0.0, 2.0 * pi));
    return {length * share * c, length * share * s};
}

/// The coefficients c2 to c5.
using Sides = std::array<glm::dvec2, of_sides.size()>;

/// How an outline differs from a circle of radius 1, to first order in its coefficients.
struct Roundness {
    double corner = 0.0;     ///< greatest curvature, less 1
    double bay = 0.0;        ///< 1, less the least curvature
    double deviation = 0.0;  ///< greatest deviation from an oval
};

Roundness roundness(const Sides& sides) {
    constexpr int samples = 64;
    Roundness round;
    for (int i = 0; i < samples; ++i) {
        const auto [s, c] = sine_cosine(2.0 * pi * i / samples);
        const glm::dvec2 direction(c, s);
        glm::dvec2 power = direction;
        double curvature = 0.0, deviation = 0.0;
        for (std::size_t k = 0; k < sides.size(); ++k) {
            power = product(power, direction);
            const double n = static_cast<double>(k) + 2.0, side = glm::dot(sides[k], power);
            curvature += (n * n - 1.0) * side;
            if (k > 0) deviation += side;
        }
        round.corner = std::max(round.corner, curvature);
        round.bay = std::max(round.bay, -curvature);
        round.deviation = std::max(round.deviation, std::abs(deviation));
    }
    return round;
}

/// Most of what `roundness` measures, at irregularity 1: a cap has lobes, flat sides and shallow bays,
/// but no corners.
constexpr double most_corner = 0.7, most_bay = 1.15;

/// Returns the coefficients of an outline without corners. Of several draws it takes the one that
/// deviates most from an oval for the curvature of its corners. It is scaled down where it exceeds
/// the limits, which a weighted mean of such outlines then keeps as well.
Sides drawn_sides(Random& random) {
    constexpr int draws = 8;
    constexpr double least = 0.5;
    Sides roundest{};
    Roundness found;
    for (int i = 0; i < draws; ++i) {
        Sides sides;
        for (std::size_t k = 0; k < sides.size(); ++k) sides[k] = drawn(random, of_sides[k], least);
        const Roundness round = roundness(sides);
        if (i > 0 && round.corner * found.deviation >= found.corner * round.deviation) continue;
        roundest = sides;
        found = round;
    }
    const double excess = std::max(found.corner / most_corner, found.bay / most_bay);
    if (excess > 1.0)
        for (glm::dvec2& side : roundest) side /= excess;
    return roundest;
}

/// Distance from the axis, in the radius that is made uneven, from which on places move in proportion
/// to it. Powers of greater distances would turn a wide net or a tall wart inside out.
constexpr double farthest = 1.6;

}  // namespace

Unevenness::Unevenness(const Individual& individual) {
    const double amount = individual.model.deformation.irregularity;
    if (!(amount > 0.0)) return;
    is_uneven_ = true;
    const Outline& outline = individual.outline;
    Extent cap{individual.stem_top, individual.stem_top};
    cap.include(outline.hymenium);
    cap.include(outline.cap);
    Extent whole{individual.stem_base, individual.stem_base};
    for (const CurveName name : curve_names) whole.include(outline.of(name));
    radius_ = std::max(whole.radius, 1e-9);
    low_ = whole.low;
    rise_ = std::max(0.5 * (whole.high - whole.low), least_rise * radius_);
    base_ = individual.stem_base;
    length_ = std::max(cap.low - base_, 0.0);
    const double stem_radius = greatest_radius(outline.stem);
    stem_radius_ = length_ > 0.0 ? stem_radius : 0.0;
    const double slender = length_ < stem_radius ? length_ / stem_radius : 1.0;
    for (const SpeciesShare& part : individual.parts) {
        Random random(individual.shape_seed, purposes::unevenness, stream_of(part.id));
        const double share = amount * part.weight;
        beside_ += share * drawn(random, beside);
        for (std::size_t i = 0; i < lifts; ++i) lifts_[i] += share * drawn(random, of_lifts[i]);
        for (std::size_t i = 0; i < waves; ++i) {
            winding_[i] += share * drawn(random, std::min(of_winding[i] * length_,
                                                          most_winding[i] * stem_radius));
            // On a stem shorter than it is wide, swellings would turn the face inside out.
            swelling_[i] += share * of_swelling[i] * random.uniform(0.4, 1.0) * slender;
        }
        // In streams of their own: how many draws an outline takes changes nothing else.
        Random of_section(individual.shape_seed, purposes::unevenness, stream_of(part.id) + 2);
        for (std::size_t i = 0; i < ovals; ++i) {
            oval_[i] += share * slender * drawn(of_section, of_ovals[i]);
            oval_wave_[i] += share * slender * drawn(of_section, of_oval_waves[i]);
        }
        Random of_outline(individual.shape_seed, purposes::unevenness, stream_of(part.id) + 1);
        const Sides own = drawn_sides(of_outline);
        for (std::size_t i = 0; i < sides; ++i) sides_[i] += share * own[i];
    }
    Random random(individual.shape_seed, purposes::unevenness);
    for (std::size_t i = 0; i < waves; ++i) {
        winding_from_[i] = random.uniform(0.0, 2.0 * pi);
        swelling_from_[i] = random.uniform(0.0, 2.0 * pi);
    }
    for (double& from : oval_from_) from = random.uniform(0.0, 2.0 * pi);
}

Unevenness::Level Unevenness::level_at(double y) const {
    Level level;
    const double above = (y - low_) / rise_;
    if (above >= 1.0) {
        level.lift = 1.0;
    } else if (above > 0.0) {
        level.lift = above * above * (3.0 - 2.0 * above);
        level.lift_by = 6.0 * above * (1.0 - above) / rise_;
    }
    const double along = length_ > 0.0 ? (y - base_) / length_ : 0.0;
    if (along <= 0.0 || along >= 1.0) return level;
    // Both ends of the stem stay where they are, and as wide.
    const double middle = along * (1.0 - along);
    const double window = 16.0 * middle * middle;
    const double window_by = 32.0 * middle * (1.0 - 2.0 * along);
    for (std::size_t i = 0; i < waves; ++i) {
        const double turns = 2.0 * pi * static_cast<double>(i + 1);
        const auto wind = sine_cosine(turns * along + winding_from_[i]);
        level.shift += window * wind.cosine * winding_[i];
        level.shift_by += (window_by * wind.cosine - window * turns * wind.sine) * winding_[i];
        const auto swell = sine_cosine(turns * along + swelling_from_[i]);
        level.widening += window * swell.cosine * swelling_[i];
        level.widening_by +=
            (window_by * swell.cosine - window * turns * swell.sine) * swelling_[i];
    }
    // The cross section is that of the whole stem almost to its ends.
    const double off = 2.0 * along - 1.0, cube = off * off * off;
    const double inside = 1.0 - cube * off;
    const double flat = inside * inside, flat_by = -16.0 * inside * cube;
    for (std::size_t i = 0; i < ovals; ++i) {
        const double turns = 2.0 * pi * oval_waves[i];
        const auto wave = sine_cosine(turns * along + oval_from_[i]);
        const glm::dvec2 oval = oval_[i] + wave.cosine * oval_wave_[i];
        level.oval[i] = flat * oval;
        level.oval_by[i] = (flat_by * oval - flat * turns * wave.sine * oval_wave_[i]) / length_;
    }
    level.shift_by /= length_;
    level.widening_by /= length_;
    return level;
}

Unevenness::Section Unevenness::section_at(const Level& level, const glm::dvec2& w) const {
    Section section;
    if (!(stem_radius_ > 0.0)) return section;
    constexpr double far = 16.0;
    const glm::dvec2 u = w / stem_radius_, conjugate(u.x, -u.y);
    const double square = glm::dot(u, u);
    const double phi = 1.0 / (1.0 + square * square / far);
    const double phi_by = -2.0 * square / far * phi * phi;
    const glm::dvec2 second = product(conjugate, conjugate);
    const auto sum = [&](const std::array<glm::dvec2, ovals>& of) {
        return product(of[0], conjugate) + product(of[1], second);
    };
    const glm::dvec2 deviation = sum(level.oval);
    section.shift = stem_radius_ * phi * deviation;
    section.by_height = stem_radius_ * phi * sum(level.oval_by);
    section.turn = phi * (level.oval[0] + 2.0 * product(level.oval[1], conjugate));
    section.fall = 2.0 * phi_by * deviation / stem_radius_;
    return section;
}

template <class Directions>
void Unevenness::move(glm::dvec3& position, Directions&& each_direction) const {
    const Level level = level_at(position.y);
    const glm::dvec2 w(position.x, position.z);
    const double scale = 1.0 / radius_;
    const Section section = section_at(level, w);
    glm::dvec2 q = (w * level.widening + level.shift + section.shift) * scale;
    const double beyond = std::max(glm::length(q) / farthest, 1.0);
    q /= beyond;
    const glm::dvec2 conjugate(q.x, -q.y);
    // Powers of the conjugate, and of q.
    std::array<glm::dvec2, sides> far{conjugate};
    for (std::size_t i = 1; i < sides; ++i) far[i] = product(far[i - 1], conjugate);
    glm::dvec2 to = q + glm::dot(q, q) * beside_;
    for (std::size_t i = 0; i < sides; ++i) to += product(sides_[i], far[i]);
    // Re(b q^n) is the real part of the product with the conjugate of conj(q)^n.
    double rise = 0.0;
    for (std::size_t i = 0; i < lifts; ++i) rise += turned(far[i], lifts_[i]).x;
    each_direction([&](glm::dvec3& direction) {
        const glm::dvec2 across(direction.x, direction.z);
        const glm::dvec2 across_conjugate(across.x, -across.y);
        const glm::dvec2 dq =
            (across * level.widening + product(section.turn, across_conjugate) +
             section.fall * glm::dot(w, across) +
             direction.y * (w * level.widening_by + level.shift_by + section.by_height)) *
            scale;
        const glm::dvec2 dq_conjugate(dq.x, -dq.y);
        glm::dvec2 turn = sides_[0];
        glm::dvec2 slope = lifts_[0];
        for (std::size_t i = 1; i < sides; ++i)
            turn += static_cast<double>(i + 1) * product(sides_[i], far[i - 1]);
        for (std::size_t i = 1; i < lifts; ++i)
            slope += static_cast<double>(i + 1) * turned(far[i - 1], lifts_[i]);
        const glm::dvec2 moved =
            radius_ * (dq + 2.0 * glm::dot(q, dq) * beside_ + product(turn, dq_conjugate));
        direction = {moved.x,
                     direction.y * (1.0 + radius_ * level.lift_by * rise) +
                         radius_ * level.lift * product(slope, dq).x,
                     moved.y};
    });
    position = {radius_ * beyond * to.x, position.y + radius_ * level.lift * rise,
                radius_ * beyond * to.y};
}

void Unevenness::apply(std::span<SurfacePoint> points) const {
    if (!is_uneven_) return;
    for (SurfacePoint& point : points)
        move(point.position, [&](auto moved) {
            moved(point.meridian);
            moved(point.azimuth);
        });
}

void Unevenness::apply(std::span<glm::dvec3> places) const {
    if (!is_uneven_) return;
    for (glm::dvec3& place : places) move(place, [](auto) {});
}

double Unevenness::reach_of_stem(double radius) const {
    double swell = 1.0, wind = 0.0;
    for (std::size_t i = 0; i < waves; ++i) {
        swell += swelling_[i];
        wind += glm::length(winding_[i]);
    }
    for (std::size_t i = 0; i < ovals; ++i)
        wind += stem_radius_ * (glm::length(oval_[i]) + glm::length(oval_wave_[i]));
    const double q = (radius * swell + wind) / radius_;
    double reach = q + q * q * glm::length(beside_), power = q;
    for (const glm::dvec2& side : sides_) {
        reach += power * glm::length(side);
        power *= q;
    }
    return is_uneven_ ? radius_ * reach : radius;
}

}  // namespace sporeprint
