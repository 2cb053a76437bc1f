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
constexpr int finest_row = 512;  // points that show the veins of a leaf whole
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

    // A texel of a small image is wider than a vein: it is the mean of several points.
    const auto points = static_cast<std::size_t>(std::clamp(finest_row / side, 1, 4));
    const std::size_t half = count / 2;
    const double share = 1.0 / static_cast<double>(points * points);
    in_pieces([&](std::size_t y) {
        struct Texel {
            glm::dvec3 light{0.0};
            double height = 0.0, occlusion = 0.0, roughness = 0.0;
        };
        std::vector<Texel> row(count);
        const bool of_petiole = along(y) > petiole_strip;
        for (std::size_t line = 0; line < points; ++line) {
            const auto offset = [&](std::size_t i) {
                return (static_cast<double>(i) + 0.5) / static_cast<double>(points);
            };
            const double v = (static_cast<double>(y) + offset(line)) / static_cast<double>(count);
            // Both faces show the same places, and blotches go through the leaf: what is seen is looked up once for the two.
            std::vector<glm::dvec2> places(half * points);
            std::vector<float> across(places.size()), down(places.size());
            for (std::size_t i = 0; i < places.size(); ++i) {
                const std::size_t column = i / points;
                const double u =
                    (static_cast<double>(column) + offset(i % points)) / static_cast<double>(count);
                bool upper = false;
                places[i] = chart.place({u, v}, upper);
                across[i] = static_cast<float>(places[i].x + 8.0);
                down[i] = static_cast<float>(places[i].y + 8.0);
            }
            const auto noise = [&](float scale, std::uint32_t purpose) {
                std::vector<float> a = across, b = down, out(places.size());
                for (float& one : a) one *= scale;
                for (float& one : b) one *= scale;
                gradient_noise(a, b, seed * 2U + purpose, out);
                return out;
            };
            const std::vector<float> spots = noise(blotches, 0U), cells = noise(net, 1U);
            for (std::size_t i = 0; i < places.size(); ++i) {
                const auto blotch = static_cast<double>(spots[i]);
                const auto cell = static_cast<double>(cells[i]);
                LimbPlace place;
                double depth = 0.0, own = autumn;
                if (of_petiole) {
                    place.from_side = 0.0;
                } else {
                    place = reader.at(places[i]);
                    depth = vein_depth(place);
                    own = std::clamp(autumn + blotch * autumn * (1.0 - autumn), 0.0, 1.0);
                }
                for (const bool upper : {true, false}) {
                    // The strip of the petiole goes on where both halves meet.
                    const std::size_t x = i / points;
                    Texel& texel = row[upper ? x : of_petiole ? count - 1 - x : half + x];
                    const double shade =
                        of_petiole ? 0.8 + 0.2 * blotch : 1.0 + 0.16 * blotch + 0.1 * cell;
                    texel.light += share * shade * colourist.at(place, own, upper || of_petiole);
                    texel.occlusion += share * (upper ? 1.0 - 0.25 * shape.relief * depth : 1.0);
                    texel.roughness +=
                        share * ((upper && !of_petiole ? 0.5 : 0.75) + 0.08 * cell + 0.2 * autumn);
                    const double relief = shape.relief * (0.006 * depth - 0.0006 * cell);
                    if (!of_petiole) texel.height += share * (upper ? -relief : relief);
                }
            }
        }
        for (std::size_t x = 0; x < count; ++x) {
            const std::size_t texel = y * count + x;
            for (std::size_t k = 0; k < 3; ++k)
                images.rgb[0][3 * texel + k] = encoded(row[x].light[static_cast<int>(k)]);
            heights[texel] = static_cast<float>(row[x].height);
            images.rgb[2][3 * texel] = byte(row[x].occlusion);
            images.rgb[2][3 * texel + 1] = byte(row[x].roughness);
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
