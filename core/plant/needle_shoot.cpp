#include "core/plant/needle_shoot.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <span>

#include "core/math/noise.h"
#include "core/plant/cell_middle.h"
#include "core/plant/leaf_shell.h"

namespace sporeprint {

namespace {

// Needles of a layer: how many along a shoot, how far their tips are ahead of their roots, how far
// they reach from the twig, half their breadth in their distance, and their light.
struct Layer {
    double count, ahead, length, half, light;
    std::uint32_t salt;
};
constexpr std::array<Layer, 3> layers = {Layer{44.0, 0.060, 1.0, 0.27, 0.95, 5},
                                         Layer{37.0, 0.085, 0.92, 0.26, 1.40, 31},
                                         Layer{30.0, 0.110, 0.62, 0.25, 1.85, 77}};

// The linear colour of snow where it is thin; columns and rows of the table of its lumps, and how many lumps are
// along a shoot and across it.
constexpr glm::dvec3 thin_snow(0.30, 0.35, 0.43);
constexpr std::size_t lump_columns = 128, lump_rows = 32;
constexpr int lumps_along = 9;
constexpr double lumps_across = 3.0;

// Returns the length of a needle in that of the longest ones, by where it is along a shoot: less at both ends.
double needle_length(double along) {
    return std::min({1.0, 0.45 + 6.0 * along, 7.0 * (1.0 - along)});
}

}  // namespace

ShootPainter::ShootPainter(const Colours& colours, double snow, std::uint32_t seed)
    : colours_(colours), snow_(snow), seed_(seed), sides_(sides()) {
    if (snow_ <= 0.0) return;
    lumps_.resize(lump_columns * lump_rows);
    std::vector<float> x(lump_columns), y(lump_columns);
    for (std::size_t i = 0; i < lump_columns; ++i)
        x[i] = static_cast<float>(lumps_along * static_cast<double>(i) / lump_columns);
    for (std::size_t row = 0; row < lump_rows; ++row) {
        std::fill(y.begin(), y.end(),
                  static_cast<float>(lumps_across * static_cast<double>(row) / lump_rows));
        periodic_noise(x, y, lumps_along, seed_ * 2U + 1U,
                       std::span(lumps_).subspan(row * lump_columns, lump_columns));
    }
}

PanelPoint ShootPainter::between_needles() const {
    return {0.7 * colours_.needle.upper, 0.7 * colours_.needle.lower, {}, 0.6, false};
}

PanelPoint ShootPainter::needles_at(double along, double across, double dense) const {
    PanelPoint seen = between_needles();
    const double out = std::abs(across);
    const auto put = [&](const glm::dvec3& upper, const glm::dvec3& lower, double tilt,
                         double open) {
        seen = {upper, lower, {0.35 * tilt, tilt}, open};
    };
    for (std::size_t k = 0; k < layers.size(); ++k) {
        const Layer& layer = layers[k];
        if (k + 1 == layers.size() && out < 0.05 * (1.1 - along))
            put(0.8 * colours_.twig, 0.8 * colours_.twig, 0.0, 0.7);
        // Two needles can meet at a point, since each leans by itself.
        const double nearest = (along - layer.ahead * out / std::sqrt(dense)) * layer.count * dense;
        for (int next = -1; next <= 1; ++next) {
            const double index = std::floor(nearest) + next;
            const glm::dvec2 own =
                cell_middle(static_cast<int>(index), across < 0.0 ? 1 : 2, layer.salt + seed_);
            const double moved = own.x - std::floor(own.x), drawn = own.y - std::floor(own.y);
            const double root = (index + 0.5) / (layer.count * dense);
            const double reach = layer.length * (0.72 + 0.28 * drawn) * needle_length(root);
            if (reach <= 0.0) continue;
            const double t = out / reach;
            if (t >= 1.0) continue;
            const double lean = 0.5 * (drawn - 0.5) * t;
            const double off = nearest - (index + 0.5 + 0.5 * (moved - 0.5) + lean);
            const double half =
                layer.half * std::min(1.0, 3.0 * (1.0 - t)) * std::min(1.0, 0.6 + 2.0 * t);
            if (std::abs(off) >= half) continue;
            const double round = off / half, keel = 1.0 - 0.45 * round * round;
            const double tone = layer.light * keel * (0.8 + 0.4 * moved) * (0.75 + 0.4 * t);
            const double fresh =
                0.5 * smooth_step(0.75, 1.0, t) + 0.35 * smooth_step(0.8, 1.0, along);
            put(tone * (colours_.needle.upper +
                        fresh * (colours_.young.upper - colours_.needle.upper)),
                tone * (colours_.needle.lower +
                        fresh * (colours_.young.lower - colours_.needle.lower)),
                0.55 * round, std::min(1.0, 0.55 + 0.3 * layer.light));
        }
    }
    return seen;
}

ShootPainter::Snow ShootPainter::snow_at(double along, double across, std::uint32_t shoot) const {
    // Each shoot has another part of the lumps.
    const double begin = 0.37 * shoot;
    const auto lump = [&](double x, double y) {
        const auto column = static_cast<std::size_t>((x + begin) * lump_columns),
                   row = static_cast<std::size_t>((0.5 + 0.5 * y) * (lump_rows - 1) + 0.5);
        return static_cast<double>(
            lumps_[std::min(row, lump_rows - 1) * lump_columns + column % lump_columns]);
    };
    constexpr double step = 1.0 / lump_columns, most = 0.999;
    const double x = std::clamp(along, 0.0, most), y = std::clamp(across, -1.0, 1.0);
    // It slides off the tips of needles and off the young tip of the shoot.
    const auto depth = [&](double at) {
        return 2.0 * snow_ * (1.6 - 0.6 * snow_) - 0.75 + 0.8 * lump(at, y) - 0.7 * y * y -
               0.5 * at * at;
    };
    const double here = depth(x);
    return {here, {1.1 * y, -1.2 * (depth(std::min(x + 4.0 * step, most)) - here)}};
}

PanelPoint ShootPainter::snowy(double along, double across, double dense,
                               std::uint32_t shoot) const {
    if (along < 0.0 || along > 1.0) return between_needles();
    PanelPoint seen = needles_at(along, across, dense);
    if (snow_ <= 0.0) return seen;
    const Snow snow = snow_at(along, across, shoot);
    // Deep snow reaches over the gaps between needles, as far as these hold it.
    constexpr double over_gaps = 0.3, held = 0.72;
    if (!seen.is_drawn &&
        (snow.depth < over_gaps || std::abs(across) > held * needle_length(along)))
        return seen;
    const double covers = smooth_step(0.0, 0.18, snow.depth);
    if (covers <= 0.0) return seen;
    const glm::dvec3 white = glm::mix(thin_snow, snow_light, smooth_step(-0.05, 0.45, snow.depth));
    if (!seen.is_drawn) seen.lower = 0.6 * colours_.needle.lower;
    seen.is_drawn = true;
    seen.upper = glm::mix(seen.upper, white, covers);
    seen.slope = glm::mix(seen.slope, snow.slope, covers);
    seen.open = glm::mix(seen.open, 1.0, covers);
    return seen;
}

std::array<ShootPainter::Side, 2 * ShootPainter::shoots_on_side> ShootPainter::sides() const {
    constexpr double longest = 0.42;
    std::array<Side, 2 * shoots_on_side> shoots;
    for (std::size_t i = 0; i < shoots.size(); ++i) {
        const std::size_t k = i % shoots_on_side;
        const bool is_left = i < shoots_on_side;
        const glm::dvec2 own = cell_middle(static_cast<int>(k), is_left ? 3 : 4, 11 + seed_);
        const double drawn = own.x - std::floor(own.x), leaning = own.y - std::floor(own.y);
        Side& one = shoots[i];
        one.root = 0.9 *
                   (static_cast<double>(k) + (is_left ? 0.05 : 0.55) + 0.3 * (leaning - 0.5)) /
                   static_cast<double>(shoots_on_side);
        one.length = longest * (0.35 + 0.65 * (1.0 - one.root)) * (0.6 + 0.4 * drawn);
        // They lean forward, more so towards the tip.
        one.open = sine_cosine(radians(62.0 - 16.0 * one.root + 16.0 * (leaning - 0.5)));
    }
    return shoots;
}

PanelPoint ShootPainter::spray_at(double along, double across) const {
    constexpr double half = 0.052, dense_side = 0.7;
    const double x = across * spray_panel.half_breadth, out = std::abs(x);
    // The shoot in the middle is before the others, and later ones are before earlier ones.
    if (out < half)
        if (const PanelPoint one = snowy(along, x / half, 1.0, 0); one.is_drawn) return one;
    const std::size_t first = x < 0.0 ? 0 : shoots_on_side;
    for (std::size_t k = first + shoots_on_side; k-- > first;) {
        const auto& [root, length, open] = sides_[k];
        const double up = along - root, t = (out * open.sine + up * open.cosine) / length;
        const double off = (up * open.sine - out * open.cosine) / half;
        if (t < 0.0 || t > 1.0 || std::abs(off) > 1.0) continue;
        if (const PanelPoint one = snowy(t, off, dense_side, static_cast<std::uint32_t>(k) + 1);
            one.is_drawn)
            return one;
    }
    return between_needles();
}

}  // namespace sporeprint
