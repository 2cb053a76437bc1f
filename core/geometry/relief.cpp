#include "core/geometry/relief.h"

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>
#include <limits>

namespace sporeprint {

namespace {

constexpr std::uint32_t prime_x = 0x9E3779B1U, prime_y = 0x85EBCA77U, prime_z = 0xC2B2AE3DU;

// Scalar version of the hash of core/math/noise.inl.
std::uint32_t hashed(std::uint32_t h) {
    h *= 0x27D4EB2DU;
    return h ^ (h >> 15U);
}

std::uint32_t whole_bits(double whole) {
    return 0x4B400000U + static_cast<std::uint32_t>(static_cast<std::int32_t>(whole));
}

double upper_part(std::uint32_t h) { return static_cast<std::int32_t>(h) / 2147483648.0; }

struct Step {
    double value, slope;
};

/// Returns smooth_step() and its derivative.
Step step_at(double from, double to, double x) {
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return {t * t * (3.0 - 2.0 * t), 6.0 * t * (1.0 - t) / (to - from)};
}

/// Returns the relative depth of folds at a value of noise: 1 where the noise is 0 between swollen
/// folds, 0 there where it is the line of a crest.
Step crease_at(double noise, double crests) {
    const double root = std::sqrt(noise * noise + crease_round * crease_round);
    const double away = std::min((root - crease_round) / crease_half, 1.0);
    const double swollen = (1.0 - away) * (1.0 - away);
    const double slope = -2.0 * (1.0 - away) * noise / (root * crease_half);
    return {swollen + crests * (1.0 - 2.0 * swollen), (1.0 - 2.0 * crests) * slope};
}

/// How deep relief too fine for a mesh seems in an outline, of which the heights alone are seen: the
/// share of its mean depth, by trial with the silhouettes of neighbouring levels of detail.
constexpr double seen_depth = 0.6;

/// Returns a window that is 0 at the apex and at the margin, where the face meets others.
Step window_at(double sigma) {
    const Step apex = step_at(relief_apex, relief_apex_end, sigma),
               margin = step_at(relief_margin, 1.0, sigma);
    return {apex.value * (1.0 - margin.value),
            apex.slope * (1.0 - margin.value) - apex.value * margin.slope};
}

}  // namespace

NoiseSample noise_sample(const std::array<double, 3>& at, std::uint32_t seed) {
    constexpr std::array<std::uint32_t, 3> primes = {prime_x, prime_y, prime_z};
    std::array<std::array<double, 2>, 3> offset{}, weight{}, weight_by{};
    std::array<std::array<std::uint32_t, 2>, 3> lattice{};
    for (std::size_t i = 0; i < 3; ++i) {
        const double floor = std::floor(at[i]), f = at[i] - floor;
        const double t = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
        const double by = 30.0 * f * f * (1.0 - f) * (1.0 - f);
        offset[i] = {f, f - 1.0};
        weight[i] = {1.0 - t, t};
        weight_by[i] = {-by, by};
        lattice[i][0] = whole_bits(floor) * primes[i] + (i == 1 ? seed : 0U);
        lattice[i][1] = lattice[i][0] + primes[i];
    }
    NoiseSample noise;
    for (std::size_t corner = 0; corner < 8; ++corner) {
        const std::array<std::size_t, 3> k = {corner & 1U, corner >> 1U & 1U, corner >> 2U};
        const std::uint32_t h = hashed(lattice[0][k[0]] ^ (lattice[1][k[1]] ^ lattice[2][k[2]]));
        const std::array<double, 3> gradient = {upper_part(h), upper_part(h << 11U),
                                                upper_part(h << 21U)};
        double slope = 0.0, all = 1.0;
        for (std::size_t i = 0; i < 3; ++i) {
            slope += gradient[i] * offset[i][k[i]];
            all *= weight[i][k[i]];
        }
        noise.value += all * slope;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t j = (i + 1) % 3, l = (i + 2) % 3;
            noise.by[i] +=
                all * gradient[i] + weight_by[i][k[i]] * weight[j][k[j]] * weight[l][k[l]] * slope;
        }
    }
    noise.value *= 1.8;
    for (double& by : noise.by) by *= 1.8;
    return noise;
}

namespace {

/// Returns the cubic approximation of a cosine of period 1 that core/surface/texel.inl has, and its
/// derivative.
Step wave_at(double t) {
    const double within = t - std::floor(t) - 0.5;
    const double u = 2.0 * std::abs(within);
    return {u * u * (6.0 - 4.0 * u) - 1.0, (within < 0.0 ? -24.0 : 24.0) * u * (1.0 - u)};
}

/// A place in the lattice of pits and its derivatives.
struct BentPlace {
    double turn, row;
    double turn_by_turn = 1.0, turn_by_row = 0.0, row_by_turn = 0.0, row_by_row = 1.0;
};

BentPlace bent(const ReliefStyle& style, double turn, double row, std::uint32_t seed) {
    BentPlace place{turn, row};
    const double waves = pit_bend_waves(style.pit_columns), pit = 1.0 / style.pit_columns;
    for (std::uint32_t i = 0; i < 2; ++i) {
        const PitBend& across = pit_bends_across[i];
        const double round = across.round * waves;
        const Step up = wave_at(round * turn + across.down * row + pit_bend_phase(seed, i));
        place.row += across.height * up.value;
        place.row_by_turn += across.height * round * up.slope;
        place.row_by_row += across.height * across.down * up.slope;
        const PitBend& along = pit_bends_along[i];
        const Step aside =
            wave_at(along.round * turn + along.down * row + pit_bend_phase(seed, 2 + i));
        place.turn += along.height * pit * aside.value;
        place.turn_by_turn += along.height * pit * along.round * aside.slope;
        place.turn_by_row += along.height * pit * along.down * aside.slope;
    }
    return place;
}

}  // namespace

PitSample pit_sample(const ReliefStyle& style, double turn_at, double row_at, std::uint32_t seed) {
    const BentPlace place = bent(style, turn_at, row_at, seed);
    const double turn = place.turn, row = place.row;
    struct Point {
        double x, y, columns;
        std::uint32_t id;
    };
    std::array<Point, 9> points{};
    std::size_t count = 0, nearest = 0;
    const double here = std::floor(row);
    for (int j = -1; j <= 1; ++j) {
        const double this_row = here + j;
        const double rise = pit_first + pit_rise * (this_row + 0.5) / style.pit_rows;
        const double columns =
            std::max(std::floor(style.pit_columns * std::clamp(rise, 0.0, 1.0) + 0.5), 3.0);
        const double half = 0.5 * this_row;
        const double x = turn * columns - (half - std::floor(half));
        const double column = std::floor(x);
        for (int i = -1; i <= 1; ++i) {
            double wrapped = column + i;
            if (wrapped < 0.0) wrapped += columns;
            if (wrapped >= columns) wrapped -= columns;
            const std::uint32_t h =
                hashed(whole_bits(wrapped) * prime_x ^ (whole_bits(this_row) * prime_y + seed));
            points[count] = {column + i + 0.5 + upper_part(h) * pit_jitter - x,
                             this_row + 0.5 + upper_part(h << 16U) * pit_jitter - row, columns, h};
            const auto square = [&](std::size_t k) {
                return points[k].x * points[k].x + points[k].y * points[k].y;
            };
            if (square(count) < square(nearest)) nearest = count;
            ++count;
        }
    }
    // Half the distance to the nearest bisector with another point, as in core/surface/texel.inl.
    const Point& near = points[nearest];
    PitSample sample{1e9, 0.0, 0.0, 0.85 + 0.15 * upper_part(hashed(near.id))};
    for (const Point& point : points) {
        const double ex = point.x - near.x, ey = point.y - near.y;
        const double apart = ex * ex + ey * ey;
        if (apart <= 1e-6) continue;
        const double root = std::sqrt(apart);
        const double twice =
            point.x * point.x + point.y * point.y - near.x * near.x - near.y * near.y;
        const double border = 0.5 * twice / root;
        if (border >= sample.border) continue;
        sample.border = border;
        // Points of rows with another number of columns move at another rate with the turn.
        const double px = -point.columns, nx = -near.columns, ex_by = px - nx;
        sample.by_turn = (point.x * px - near.x * nx) / root - border * ex * ex_by / apart;
        sample.by_row = -ey / root;
    }
    const double by_turn = sample.by_turn, by_row = sample.by_row;
    sample.by_turn = by_turn * place.turn_by_turn + by_row * place.row_by_turn;
    sample.by_row = by_turn * place.turn_by_row + by_row * place.row_by_row;
    return sample;
}

Relief::Relief(const Individual& individual, const Detail& detail)
    : seeds_(relief_seeds(individual.painted_seed)), meridian_(individual.outline.cap.length()) {
    for (const ReliefStyle& style : individual.reliefs) {
        const CarriedRelief carried = carried_relief(style, detail.columns, detail.cap_rings);
        ReliefStyle finer = style;
        finer.fold_count = static_cast<int>(finer_creases * style.fold_count);
        Layer layer{style, carried.folds,
                    carried_relief(finer, detail.columns, detail.cap_rings).folds, carried.pits};
        layer.style.tiers *= carried.tiers;
        if (layer.style.any()) layers_.push_back(layer);
    }
    if (layers_.empty()) return;
    const double keep = available_depth(individual.outline);
    for (Layer& layer : layers_) {
        layer.style.folds *= keep;
        layer.style.pits *= keep;
        layer.style.tiers *= keep;
    }
}

double Relief::available_depth(const Outline& outline) const {
    double deepest = 0.0;
    for (const Layer& layer : layers_)
        deepest += layer.style.folds + layer.style.pits + layer.style.tiers;
    deepest *= meridian_;
    std::vector<glm::dvec2> others;
    for (const SubCurve* curve : {&outline.stem, &outline.hymenium})
        for (int i = 0; i <= 24 && !curve->empty(); ++i) {
            const OutlineSample at = curve->at(i / 24.0);
            others.emplace_back(at.r, at.y);
        }
    constexpr double spare = 0.7;
    double keep = 1.0;
    for (int i = 1; i < 48; ++i) {
        const double sigma = i / 48.0;
        const double depth = deepest * window_at(sigma).value;
        if (depth <= 0.0) continue;
        const OutlineSample at = outline.cap.at(1.0 - sigma);
        // Curvature is measured over a stretch of the meridian: at a single point it differs
        // between the nodes of a species and those of a set, and all depths would differ with it.
        const OutlineSample before = outline.cap.at(1.0 - sigma - 1.0 / 48.0),
                            after = outline.cap.at(1.0 - sigma + 1.0 / 48.0);
        const double turn = before.tangent_r * after.tangent_y - before.tangent_y * after.tangent_r;
        double clear =
            turn > 0.0 ? meridian_ / (24.0 * turn) : std::numeric_limits<double>::infinity();
        if (at.tangent_y > 0.0) clear = std::min(clear, at.r / at.tangent_y);
        for (const glm::dvec2& other : others) {
            const double dr = other.x - at.r, dy = other.y - at.y;
            clear = std::min(clear, std::sqrt(dr * dr + dy * dy));
        }
        keep = std::min(keep, spare * clear / depth);
    }
    return keep;
}

void Relief::add_folds(Depth& depth, const Layer& layer, double sigma,
                       const SineCosine& turn) const {
    const ReliefStyle& style = layer.style;
    // Noise is evaluated on a hemisphere, which is the shape of the young face.
    const auto tilt = sine_cosine(0.5 * pi * sigma);
    std::array<Depth, 2> noises{};
    for (std::size_t octave = 0; octave < 2; ++octave) {
        const double f = 0.5 * style.fold_count * (octave == 0 ? 1.0 : finer_creases);
        const NoiseSample noise = noise_sample(
            {f * tilt.sine * turn.cosine, f * (1.0 - tilt.cosine), f * tilt.sine * turn.sine},
            seeds_[octave]);
        noises[octave] = {noise.value,
                          0.5 * pi * f *
                              (tilt.cosine * (noise.by[0] * turn.cosine + noise.by[2] * turn.sine) +
                               tilt.sine * noise.by[1]),
                          f * tilt.sine * (noise.by[2] * turn.cosine - noise.by[0] * turn.sine)};
    }
    noises[0].value += crease_winding * noises[1].value;
    noises[0].by_sigma += crease_winding * noises[1].by_sigma;
    noises[0].by_angle += crease_winding * noises[1].by_angle;
    const double mean = seen_depth * (crease_mean + style.crests * (1.0 - 2.0 * crease_mean));
    const std::array<double, 2> carried = {layer.folds, layer.fine_folds};
    for (std::size_t octave = 0; octave < 2; ++octave) {
        const double all = style.folds * (octave == 0 ? 1.0 - fine_creases : fine_creases);
        const double weight = all * carried[octave];
        const Step fold = crease_at(noises[octave].value, style.crests);
        // What is too fine for the mesh lowers the face instead, so that outlines agree.
        depth.value += weight * fold.value + (all - weight) * mean;
        depth.by_sigma += weight * fold.slope * noises[octave].by_sigma;
        depth.by_angle += weight * fold.slope * noises[octave].by_angle;
    }
}

void Relief::add_pits(Depth& depth, const Layer& layer, double sigma, double angle) const {
    const ReliefStyle& style = layer.style;
    const double rows = style.pit_rows;
    const PitSample pit = pit_sample(style, angle / (2.0 * pi), sigma * rows, seeds_[2]);
    const double rib = pit_rib * style.rib;
    const Step floor = step_at(rib, rib + pit_slope, pit.border);
    // About the share of a cell that lies within the middle of its slope.
    const double floors = 1.0 - 2.0 * rib - pit_slope;
    depth.value += style.pits * (1.0 - layer.pits) * seen_depth * mean_pit * floors * floors;
    const double weight = layer.pits * style.pits * pit.deep;
    depth.value += weight * floor.value;
    depth.by_sigma += weight * floor.slope * pit.by_row * rows;
    depth.by_angle += weight * floor.slope * pit.by_turn / (2.0 * pi);
}

Relief::Height Relief::at(Part part, double share, double angle, const SineCosine& turn) const {
    if (flat(part)) return {};
    const double sigma = 1.0 - share;
    Depth depth;
    for (const Layer& layer : layers_) {
        const ReliefStyle& style = layer.style;
        if (style.folds > 0.0) add_folds(depth, layer, sigma, turn);
        if (style.pits > 0.0) add_pits(depth, layer, sigma, angle);
        if (style.tiers > 0.0) {
            const auto wave = sine_cosine(2.0 * pi * style.tier_count * sigma);
            const double groove = 0.5 + 0.5 * wave.cosine;
            depth.value += style.tiers * groove * groove;
            depth.by_sigma -= style.tiers * groove * wave.sine * 2.0 * pi * style.tier_count;
        }
    }
    const Step window = window_at(sigma);
    return {-meridian_ * depth.value * window.value,
            meridian_ * (depth.by_sigma * window.value + depth.value * window.slope),
            -meridian_ * depth.by_angle * window.value};
}

}  // namespace sporeprint
