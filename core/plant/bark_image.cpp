#include "core/plant/bark_image.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "core/math/elementary.h"
#include "core/math/noise.h"

namespace sporeprint {

namespace {

constexpr int rows_per_piece = 32;
// Largest depth of a furrow, in girths.
constexpr double deepest = 0.02;

std::uint8_t byte(double share) {
    return static_cast<std::uint8_t>(std::floor(std::clamp(share, 0.0, 1.0) * 255.0 + 0.5));
}

glm::dvec3 linear(const Colour& colour) {
    return {srgb_to_linear(colour.r / 255.0), srgb_to_linear(colour.g / 255.0),
            srgb_to_linear(colour.b / 255.0)};
}

}  // namespace

RawImages bark_images(const BarkStyle& style, std::uint32_t seed, int side,
                      const Parallel& parallel) {
    std::vector<Problem> problems;
    check(style, Info{.name = ""}, "", problems);
    if (side < 16 || side > 2048 || (side & (side - 1)) != 0)
        report(problems, "/side", std::to_string(side) + " is no power of two in 16..2048");
    if (!problems.empty()) throw InvalidInput(std::move(problems));

    const auto count = static_cast<std::size_t>(side);
    RawImages images;
    images.side = side;
    for (Bytes& image : images.rgb) image.assign(3 * count * count, 0);
    std::vector<float> heights(count * count, 0.0F);  // in girths
    const glm::dvec3 ridge = linear(style.ridge), furrow = linear(style.furrow),
                     dash = linear(style.lenticel);
    const auto in_pieces = [&](const auto& row) {
        std::vector<std::function<void()>> pieces;
        for (int first = 0; first < side; first += rows_per_piece)
            pieces.emplace_back([&row, first, side] {
                for (int y = first; y < std::min(side, first + rows_per_piece); ++y)
                    row(static_cast<std::size_t>(y));
            });
        parallel(pieces);
    };

    in_pieces([&](std::size_t y) {
        std::vector<float> u(count), v(count);
        const double down =
            bark_girths * (static_cast<double>(y) + 0.5) / static_cast<double>(side);
        // Noise with `round` features round the segment, each `longer` times as long as wide.
        const auto noise = [&](int round, double longer, std::uint32_t purpose) {
            for (std::size_t x = 0; x < count; ++x) {
                u[x] = static_cast<float>((static_cast<double>(x) + 0.5) * round / side);
                v[x] = static_cast<float>(down * round / longer);
            }
            std::vector<float> out(count);
            periodic_noise(u, v, round, seed * 8U + purpose, out);
            return out;
        };
        const std::vector<float> coarse = noise(style.ridges, style.stretch, 0U);
        const std::vector<float> middle = noise(2 * style.ridges, style.stretch, 1U);
        const std::vector<float> fine = noise(8 * style.ridges, 2.0, 2U);
        const std::vector<float> spots = noise(5, 1.0, 3U);
        const std::vector<float> dashes = noise(9, 0.16, 4U);
        for (std::size_t x = 0; x < count; ++x) {
            const double grain = static_cast<double>(fine[x]);
            // Furrows follow the zero set of the noise: lines that diverge and meet.
            const double from_furrow =
                std::abs(static_cast<double>(coarse[x]) + 0.45 * static_cast<double>(middle[x]));
            const double rise = smooth_step(0.0, 0.3, from_furrow + 0.05 * grain);
            const double lenticel =
                style.lenticels > 0.0
                    ? smooth_step(0.62 - 0.42 * style.lenticels, 0.7 - 0.42 * style.lenticels,
                                  static_cast<double>(dashes[x]) + 0.06 * grain)
                    : 0.0;
            glm::dvec3 light = ridge + style.furrows * (1.0 - rise) * (furrow - ridge);
            light *= 1.0 + 0.22 * grain + 0.2 * static_cast<double>(spots[x]);
            light += lenticel * (dash - light);
            const std::size_t at = y * count + x;
            for (std::size_t k = 0; k < 3; ++k)
                images.rgb[0][3 * at + k] =
                    byte(linear_to_srgb(std::clamp(light[static_cast<int>(k)], 0.0, 1.0)));
            heights[at] = static_cast<float>(deepest * (style.furrows * rise * 12.0 / style.ridges +
                                                        0.04 * grain - 0.08 * lenticel));
            images.rgb[2][3 * at] = byte(1.0 - 0.55 * style.furrows * (1.0 - rise));
            images.rgb[2][3 * at + 1] = byte(0.85 + 0.1 * grain - 0.25 * (1.0 - style.furrows));
        }
    });
    const double round = static_cast<double>(side);
    in_pieces([&](std::size_t y) {
        for (std::size_t x = 0; x < count; ++x) {
            const std::size_t left = (x + count - 1) % count, right = (x + 1) % count;
            const std::size_t above = y == 0 ? y : y - 1, below = std::min(y + 1, count - 1);
            const auto height = [&](std::size_t i, std::size_t k) {
                return static_cast<double>(heights[k * count + i]);
            };
            const double slope_x = 0.5 * round * (height(right, y) - height(left, y));
            const double slope_y =
                0.5 * (round / bark_girths) * (height(x, above) - height(x, below));
            const glm::dvec3 normal = glm::normalize(glm::dvec3(-slope_x, -slope_y, 1.0));
            for (std::size_t k = 0; k < 3; ++k)
                images.rgb[1][3 * (y * count + x) + k] =
                    byte(0.5 + 0.5 * normal[static_cast<int>(k)]);
        }
    });
    return images;
}

}  // namespace sporeprint
