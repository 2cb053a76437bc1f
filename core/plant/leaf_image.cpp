#include "core/plant/leaf_image.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "core/math/elementary.h"
#include "core/math/noise.h"

namespace sporeprint {

namespace {

constexpr int rows_per_piece = 32;
// Features of blotches and of the net between veins, to the length of a limb.
constexpr float blotches = 7.0F, net = 60.0F;

std::uint8_t byte(double share) {
    return static_cast<std::uint8_t>(std::floor(std::clamp(share, 0.0, 1.0) * 255.0 + 0.5));
}

// sRGB of linear light in 4096 steps: finer than its 256 bytes, but for the darkest.
const std::vector<std::uint8_t>& encoded_table() {
    static const std::vector<std::uint8_t> table = [] {
        std::vector<std::uint8_t> made;
        for (int i = 0; i <= 4096; ++i) made.push_back(byte(linear_to_srgb(i / 4096.0)));
        return made;
    }();
    return table;
}

std::uint8_t encoded(double linear) {
    return encoded_table()[static_cast<std::size_t>(std::clamp(linear, 0.0, 1.0) * 4096.0 + 0.5)];
}

// 1 on a line, 0 beside it, round between.
double bead(double distance, double width) { return 1.0 - smooth_step(0.0, width, distance); }

// How far a vein lies in the limb here, 0..1.
double vein_depth(const LimbPlace& place) {
    const double main = bead(place.from_main, 0.028 * (1.0 - 0.7 * place.homothety));
    const double side =
        bead(place.from_side, 0.014) * (1.0 - smooth_step(0.7, 1.1, place.along_side));
    return std::max(main, 0.6 * side);
}

}  // namespace

RawImages leaf_images(const LeafShape& shape, const LeafPalette& palette, double autumn,
                      std::uint32_t seed, int side, const Parallel& parallel) {
    std::vector<Problem> problems;
    check(shape, Info{.name = ""}, "", problems);
    check(palette, Info{.name = ""}, "", problems);
    if (side < 16 || side > 2048 || (side & (side - 1)) != 0)
        report(problems, "/side", std::to_string(side) + " is no power of two in 16..2048");
    if (!(autumn >= 0.0 && autumn <= 1.0)) report(problems, "/autumn", "is outside 0..1");
    if (!problems.empty()) throw InvalidInput(std::move(problems));

    const LimbReader reader(limb_of(shape.venation, leaf_steps(shape.venation, 0)));
    const LeafChart chart = chart_of(reader.limb());
    const LeafColourist colourist(palette);
    const auto count = static_cast<std::size_t>(side);
    RawImages images;
    images.side = side;
    for (Bytes& image : images.rgb) image.assign(3 * count * count, 0);
    std::vector<float> heights(count * count, 0.0F);  // outwards, in lengths of the limb
    const auto along = [&](std::size_t i) {
        return (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    };
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
        std::vector<float> across(count), down(count), spots(count), cells(count);
        for (std::size_t x = 0; x < count; ++x) {
            bool upper = false;
            const glm::dvec2 at = chart.place({along(x), along(y)}, upper);
            // Blotches go through the leaf: both faces have the same.
            across[x] = static_cast<float>(at.x + 8.0);
            down[x] = static_cast<float>(at.y + 8.0);
        }
        const auto noise = [&](float scale, std::uint32_t purpose, std::vector<float>& out) {
            std::vector<float> u = across, v = down;
            for (float& one : u) one *= scale;
            for (float& one : v) one *= scale;
            gradient_noise(u, v, seed * 2U + purpose, out);
        };
        noise(blotches, 0U, spots);
        noise(net, 1U, cells);
        for (std::size_t x = 0; x < count; ++x) {
            std::uint8_t* colour = &images.rgb[0][3 * (y * count + x)];
            std::uint8_t* surface = &images.rgb[2][3 * (y * count + x)];
            const auto blotch = static_cast<double>(spots[x]);
            const auto cell = static_cast<double>(cells[x]);
            glm::dvec3 light;
            double depth = 0.0;
            bool upper = false;
            if (along(y) > petiole_strip) {
                LimbPlace petiole;
                petiole.from_side = 0.0;
                light = colourist.at(petiole, autumn, true) * (0.8 + 0.2 * blotch);
            } else {
                const LimbPlace place = reader.at(chart.place({along(x), along(y)}, upper));
                const double own =
                    std::clamp(autumn + 0.5 * blotch * autumn * (1.0 - autumn) * 2.0, 0.0, 1.0);
                light = colourist.at(place, own, upper) * (1.0 + 0.16 * blotch + 0.1 * cell);
                depth = vein_depth(place);
                const double relief = shape.relief * (0.006 * depth - 0.0006 * cell);
                heights[y * count + x] = static_cast<float>(upper ? -relief : relief);
            }
            for (int k = 0; k < 3; ++k) colour[k] = encoded(light[k]);
            surface[0] = byte(upper ? 1.0 - 0.25 * shape.relief * depth : 1.0);
            surface[1] = byte((upper ? 0.5 : 0.75) + 0.08 * cell + 0.2 * autumn);
        }
    });
    const double texels = chart.scale * static_cast<double>(side);
    in_pieces([&](std::size_t y) {
        for (std::size_t x = 0; x < count; ++x) {
            const auto height = [&](std::size_t i, std::size_t k) {
                return static_cast<double>(heights[k * count + i]);
            };
            const std::size_t left = x == 0 ? x : x - 1, right = std::min(x + 1, count - 1);
            const std::size_t above = y == 0 ? y : y - 1, below = std::min(y + 1, count - 1);
            // The faces lie side by side, and their slopes are no slope between them.
            const bool border = along(left) < 0.5 && along(right) > 0.5;
            const double slope_x =
                border ? 0.0 : 0.5 * texels * (height(right, y) - height(left, y));
            const double slope_y = 0.5 * texels * (height(x, above) - height(x, below));
            const glm::dvec3 normal = glm::normalize(glm::dvec3(-slope_x, -slope_y, 1.0));
            for (int k = 0; k < 3; ++k)
                images.rgb[1][3 * (y * count + x) + static_cast<std::size_t>(k)] =
                    byte(0.5 + 0.5 * normal[k]);
        }
    });
    return images;
}

}  // namespace sporeprint
