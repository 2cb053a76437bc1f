#include "core/plant/bark_image.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "core/math/elementary.h"
#include "core/math/noise.h"
#include "core/math/srgb_table.h"
#include "core/plant/image_rows.h"

namespace sporeprint {

namespace {

// Largest depth of a furrow, in girths.
constexpr double deepest = 0.02;

// Features of the field that bends ridges, round a segment.
constexpr int warp_cells = 7;

// How much of bark lichen hides where it grows, and its colour, as linear light.
constexpr double most_lichen = 0.55;
constexpr glm::dvec3 lichen_light(0.30, 0.33, 0.25);

// Colour of the under side of thin bark that has peeled, as a factor of the upper one.
constexpr glm::dvec3 peeled_tint(0.86, 0.60, 0.42);

glm::dvec3 linear(const Colour& colour) {
    return {srgb_to_linear(colour.r / 255.0), srgb_to_linear(colour.g / 255.0),
            srgb_to_linear(colour.b / 255.0)};
}

// Paints bark row by row: first colour, roughness and occlusion with heights, then the normals that
// follow from the heights.
class BarkPainter {
  public:
    BarkPainter(const BarkStyle& style, std::uint32_t seed, int side)
        : style_(style),
          seed_(seed),
          paper_(smooth_step(0.12, 0.4, style.lenticels) *
                 (1.0 - smooth_step(0.1, 0.3, style.furrows))),
          count_(static_cast<std::size_t>(side)),
          heights_(count_ * count_, 0.0F),
          ridge_(linear(style.ridge)),
          furrow_(linear(style.furrow)),
          dash_(linear(style.lenticel)) {
        images_.side = side;
        for (Bytes& image : images_.rgb) image.assign(3 * count_ * count_, 0);
    }

    void paint_row(std::size_t y);
    void resolve_normals(std::size_t y);
    RawImages take() && { return std::move(images_); }

  private:
    /// How far texels of a row are displaced before a noise is looked up, in features of `warp_cells`.
    struct Warp {
        std::vector<float> across, along;
    };

    // Returns a row of noise with `round` features round the segment, each `longer` times as long
    // as wide.
    //
    // warp  displaces its features by so many of their widths; null for none
    [[nodiscard]] std::vector<float> noise_row(std::size_t y, int round, double longer,
                                               std::uint32_t purpose, const Warp* warp = nullptr,
                                               double by = 0.0) const {
        const double down =
            bark_girths * (static_cast<double>(y) + 0.5) / static_cast<double>(images_.side);
        const auto period = static_cast<float>(round), far = static_cast<float>(by);
        std::vector<float> u(count_), v(count_), out(count_);
        for (std::size_t x = 0; x < count_; ++x) {
            u[x] = static_cast<float>((static_cast<double>(x) + 0.5) * round / images_.side);
            v[x] = static_cast<float>(down * round / longer);
            if (warp == nullptr) continue;
            u[x] += far * warp->across[x];
            u[x] = std::clamp(u[x] - period * std::floor(u[x] / period), 0.0F, period);
            v[x] += far * warp->along[x];
        }
        periodic_noise(u, v, round, seed_ * 16U + purpose, out);
        return out;
    }

    const BarkStyle& style_;
    std::uint32_t seed_;
    double paper_;       ///< how far bark peels in thin level sheets: smooth bark with dashes
    std::size_t count_;  ///< texels of a row
    RawImages images_;
    std::vector<float> heights_;  ///< in girths
    glm::dvec3 ridge_, furrow_, dash_;
    const SrgbTable& srgb_ = srgb_table();
};

void BarkPainter::paint_row(std::size_t y) {
    const int ridges = style_.ridges;
    const Warp warp{noise_row(y, warp_cells, 1.7, 8U), noise_row(y, warp_cells - 1, 1.3, 9U)};
    const std::vector<float> coarse = noise_row(y, ridges, style_.stretch, 0U, &warp, 0.35);
    const std::vector<float> middle =
        noise_row(y, 2 * ridges + 1, 0.8 * style_.stretch, 1U, &warp, 0.35);
    const std::vector<float> across = noise_row(y, ridges, 0.35 * style_.stretch, 5U, &warp, 0.6);
    const std::vector<float> uneven = noise_row(y, 3 * ridges + 2, 1.6, 6U);
    const std::vector<float> fine = noise_row(y, 8 * ridges + 3, 2.0, 2U);
    const std::vector<float> flakes = noise_row(y, 17 * ridges + 5, 1.4, 7U);
    const std::vector<float> spots = noise_row(y, 5, 1.0, 3U);
    const std::vector<float> lichen = noise_row(y, 19, 1.1, 10U, &warp, 0.5);
    const std::vector<float> dashes = noise_row(y, 9, 0.16, 4U);
    // Thin sheets: fine level streaks, bands that have peeled, fine dashes, and black flaws.
    const bool peels = paper_ > 0.0;
    const auto of_paper = [&](int round, double longer, std::uint32_t purpose, double by) {
        return peels ? noise_row(y, round, longer, purpose, &warp, by) : std::vector<float>();
    };
    const std::vector<float> streaks = of_paper(11, 0.05, 11U, 0.02),
                             threads = of_paper(29, 0.06, 12U, 0.0),
                             bands = of_paper(4, 0.20, 13U, 0.10),
                             ragged = of_paper(23, 0.30, 14U, 0.0),
                             small = of_paper(31, 0.10, 15U, 0.0),
                             flaws = of_paper(3, 0.75, 16U, 0.2);
    // Lichen finds hold on rough bark.
    const double hold = most_lichen * smooth_step(0.2, 0.6, style_.furrows);
    for (std::size_t x = 0; x < count_; ++x) {
        const auto of = [x](const std::vector<float>& row) { return static_cast<double>(row[x]); };
        const double grain = of(fine), scale = of(flakes);
        const double rough = 0.09 * of(uneven) + 0.05 * grain;
        // Furrows follow a level set of the noise: lines that diverge and meet. That of 0 would go
        // through every point of the lattice.
        const double from_furrow = std::abs(of(coarse) + 0.1 + 0.45 * of(middle) + rough);
        const double ridge = smooth_step(0.0, 0.30, from_furrow);
        // Shorter cracks across the ridges part them into pieces.
        const double piece = smooth_step(0.0, 0.13, std::abs(of(across) + 0.13 + rough));
        const double rise =
            ridge * (1.0 - 0.45 * (1.0 - piece)) + 0.10 * ridge * (of(uneven) + 0.6 * scale);
        const double lenticel =
            style_.lenticels > 0.0
                ? smooth_step(0.58 - 0.42 * style_.lenticels, 0.76 - 0.42 * style_.lenticels,
                              of(dashes) + 0.10 * grain + 0.08 * of(uneven))
                : 0.0;
        const double deep = style_.furrows * (1.0 - rise);
        glm::dvec3 light = ridge_ + std::clamp(deep, 0.0, 1.0) * (furrow_ - ridge_);
        // What stands out is bleached, and every flake has a tone of its own.
        light *= 1.0 + 0.20 * grain + 0.16 * scale + 0.22 * of(spots) + 0.14 * of(uneven);
        light += lenticel * (dash_ - light);
        const double grown = hold *
                             smooth_step(0.30, 0.55, of(lichen) + 0.35 * of(spots) + 0.20 * scale) *
                             smooth_step(0.35, 0.8, rise) * (1.0 - lenticel);
        light += grown * (lichen_light * (1.0 + 0.25 * scale + 0.2 * grain) - light);
        double sheet = 0.0, worn = 0.0;
        if (peels) {
            const double edge = of(bands) + 0.16 * of(ragged) + 0.10 * of(streaks);
            const double open = smooth_step(0.24, 0.27, edge);
            // The border of a sheet curls up and throws a thin shadow.
            const double shadow = smooth_step(0.19, 0.24, edge) * (1.0 - open),
                         lip =
                             smooth_step(0.265, 0.28, edge) * (1.0 - smooth_step(0.28, 0.34, edge));
            const double dashlet = smooth_step(0.34, 0.5, of(small)) * (1.0 - open);
            worn = smooth_step(0.40, 0.52,
                               of(flaws) + 0.22 * of(ragged) + 0.12 * of(uneven) + 0.06 * grain);
            glm::dvec3 paper = ridge_ * (1.0 + 0.13 * of(streaks) + 0.10 * of(threads) +
                                         0.10 * of(spots) + 0.04 * grain);
            paper +=
                paper_ * 0.75 * open *
                (ridge_ * peeled_tint * (0.85 + 0.25 * of(threads) + 0.15 * of(streaks)) - paper);
            paper *= 1.0 - 0.45 * shadow;
            paper += 0.55 * lip * (glm::dvec3(0.86, 0.84, 0.80) - paper);
            paper += 0.55 * dashlet * (dash_ * 2.5 - paper);
            paper += std::max(lenticel * (1.0 - 0.5 * open), 0.0) * (dash_ - paper);
            paper += worn * (dash_ * (0.55 + 0.5 * scale + 0.6 * std::max(grain, 0.0)) - paper);
            light += paper_ * (paper - light);
            sheet = 0.05 * of(streaks) + 0.04 * of(threads) - 0.30 * open + 0.25 * lip -
                    0.06 * dashlet - 0.08 * lenticel +
                    worn * (0.35 * of(uneven) + 0.30 * grain + 0.25 * scale - 0.1);
        }
        const std::size_t at = y * count_ + x;
        for (std::size_t k = 0; k < 3; ++k)
            images_.rgb[0][3 * at + k] =
                srgb_.of(static_cast<float>(std::clamp(light[static_cast<int>(k)], 0.0, 1.0)));
        heights_[at] = static_cast<float>(
            deepest * (style_.furrows * rise * 14.0 / ridges + 0.05 * grain + 0.03 * scale +
                       0.05 * of(uneven) + 0.05 * grown - 0.08 * lenticel));
        if (peels)
            heights_[at] += static_cast<float>(
                paper_ * (deepest * 0.28 * sheet - static_cast<double>(heights_[at])));
        images_.rgb[2][3 * at] = share_as_byte(1.0 - 0.6 * deep);
        images_.rgb[2][3 * at + 1] =
            share_as_byte(0.87 + 0.1 * grain - 0.22 * (1.0 - style_.furrows) + 0.1 * grown +
                          paper_ * (0.08 * of(spots) + 0.2 * worn));
    }
}

void BarkPainter::resolve_normals(std::size_t y) {
    const double round = static_cast<double>(images_.side);
    for (std::size_t x = 0; x < count_; ++x) {
        const std::size_t left = (x + count_ - 1) % count_, right = (x + 1) % count_;
        const std::size_t above = y == 0 ? y : y - 1, below = std::min(y + 1, count_ - 1);
        const auto height = [&](std::size_t i, std::size_t k) {
            return static_cast<double>(heights_[k * count_ + i]);
        };
        const double slope_x = 0.5 * round * (height(right, y) - height(left, y));
        const double slope_y = 0.5 * (round / bark_girths) * (height(x, above) - height(x, below));
        const glm::dvec3 normal = glm::normalize(glm::dvec3(-slope_x, -slope_y, 1.0));
        for (std::size_t k = 0; k < 3; ++k)
            images_.rgb[1][3 * (y * count_ + x) + k] =
                share_as_byte(0.5 + 0.5 * normal[static_cast<int>(k)]);
    }
}

}  // namespace

RawImages bark_images(const BarkStyle& style, std::uint32_t seed, int side,
                      const Parallel& parallel) {
    std::vector<Problem> problems;
    check(style, Info{.name = ""}, "", problems);
    if (side < 16 || side > 2048 || (side & (side - 1)) != 0)
        report(problems, "/side", std::to_string(side) + " is no power of two in 16..2048");
    if (!problems.empty()) throw InvalidInput(std::move(problems));
    BarkPainter painter(style, seed, side);
    for_each_row(side, parallel, [&](std::size_t y) { painter.paint_row(y); });
    for_each_row(side, parallel, [&](std::size_t y) { painter.resolve_normals(y); });
    return std::move(painter).take();
}

}  // namespace sporeprint
