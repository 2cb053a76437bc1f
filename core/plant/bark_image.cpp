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
    // Returns a row of noise with `round` features round the segment, each `longer` times as long
    // as wide.
    [[nodiscard]] std::vector<float> noise_row(std::size_t y, int round, double longer,
                                               std::uint32_t purpose) const {
        const double down =
            bark_girths * (static_cast<double>(y) + 0.5) / static_cast<double>(images_.side);
        std::vector<float> u(count_), v(count_), out(count_);
        for (std::size_t x = 0; x < count_; ++x) {
            u[x] = static_cast<float>((static_cast<double>(x) + 0.5) * round / images_.side);
            v[x] = static_cast<float>(down * round / longer);
        }
        periodic_noise(u, v, round, seed_ * 8U + purpose, out);
        return out;
    }

    const BarkStyle& style_;
    std::uint32_t seed_;
    std::size_t count_;  ///< texels of a row
    RawImages images_;
    std::vector<float> heights_;  ///< in girths
    glm::dvec3 ridge_, furrow_, dash_;
    const SrgbTable& srgb_ = srgb_table();
};

void BarkPainter::paint_row(std::size_t y) {
    const std::vector<float> coarse = noise_row(y, style_.ridges, style_.stretch, 0U);
    const std::vector<float> middle = noise_row(y, 2 * style_.ridges, style_.stretch, 1U);
    const std::vector<float> fine = noise_row(y, 8 * style_.ridges, 2.0, 2U);
    const std::vector<float> spots = noise_row(y, 5, 1.0, 3U);
    const std::vector<float> dashes = noise_row(y, 9, 0.16, 4U);
    for (std::size_t x = 0; x < count_; ++x) {
        const double grain = static_cast<double>(fine[x]);
        // Furrows follow the zero set of the noise: lines that diverge and meet.
        const double from_furrow =
            std::abs(static_cast<double>(coarse[x]) + 0.45 * static_cast<double>(middle[x]));
        const double rise = smooth_step(0.0, 0.3, from_furrow + 0.05 * grain);
        const double lenticel =
            style_.lenticels > 0.0
                ? smooth_step(0.58 - 0.42 * style_.lenticels, 0.76 - 0.42 * style_.lenticels,
                              static_cast<double>(dashes[x]) + 0.06 * grain)
                : 0.0;
        glm::dvec3 light = ridge_ + style_.furrows * (1.0 - rise) * (furrow_ - ridge_);
        light *= 1.0 + 0.22 * grain + 0.2 * static_cast<double>(spots[x]);
        light += lenticel * (dash_ - light);
        const std::size_t at = y * count_ + x;
        for (std::size_t k = 0; k < 3; ++k)
            images_.rgb[0][3 * at + k] = srgb_.of(static_cast<float>(light[static_cast<int>(k)]));
        heights_[at] = static_cast<float>(deepest * (style_.furrows * rise * 12.0 / style_.ridges +
                                                     0.04 * grain - 0.08 * lenticel));
        images_.rgb[2][3 * at] = share_as_byte(1.0 - 0.55 * style_.furrows * (1.0 - rise));
        images_.rgb[2][3 * at + 1] =
            share_as_byte(0.85 + 0.1 * grain - 0.25 * (1.0 - style_.furrows));
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
