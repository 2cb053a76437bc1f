#include "core/render/texture.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/math/elementary.h"
#include "core/problems.h"

namespace sporeprint::render {

namespace {

/// Smallest copy of an image. In smaller ones the charts of an atlas would run into each other.
constexpr int least_level_side = 32;

/// Returns the mean of each four pixels.
Bytes halved(const Bytes& rgb, std::size_t side) {
    const std::size_t row = 3 * side, half = side / 2;
    Bytes means(half * half * 3);
    for (std::size_t y = 0; y < half; ++y) {
        const std::uint8_t* const from = &rgb[2 * y * row];
        std::uint8_t* const to = &means[y * half * 3];
        for (std::size_t x = 0; x < half; ++x)
            for (std::size_t c = 0; c < 3; ++c) {
                const std::size_t i = 6 * x + c;
                const unsigned sum =
                    unsigned{from[i]} + from[i + 3] + from[i + row] + from[i + row + 3];
                to[3 * x + c] = static_cast<std::uint8_t>((sum + 2) / 4);
            }
    }
    return means;
}

}  // namespace

Texture::Texture(std::span<const std::uint8_t> file, Encoding encoding, bool repeats_u,
                 int least_side)
    : repeats_u_(repeats_u) {
    Picture picture = encoding == Encoding::alpha ? decoded_alpha(file, "/image")
                                                  : decoded_smaller(file, "/image", least_side);
    if (picture.width != picture.height) throw GenerationError("an image of a material is square");
    for (std::size_t i = 0; i < light_.size(); ++i) {
        const double value = static_cast<double>(i) / 255.0;
        light_[i] = static_cast<float>(encoding == Encoding::srgb ? srgb_to_linear(value) : value);
    }
    levels_.push_back({picture.width, std::move(picture.rgb)});
    while (levels_.back().side / 2 >= least_level_side) {
        const Level& fine = levels_.back();
        levels_.push_back({fine.side / 2, halved(fine.rgb, static_cast<std::size_t>(fine.side))});
    }
}

template <class T, class Texel>
T Texture::interpolated(const glm::vec2& coordinate, float texels, const Texel& texel) const {
    std::size_t which = 0;
    while (texels > 1.4F && which + 1 < levels_.size()) {
        texels *= 0.5F;
        ++which;
    }
    const Level& level = levels_[which];
    const auto side = static_cast<float>(level.side);
    float u = coordinate.x;
    if (repeats_u_) u -= std::floor(u);
    const float x = u * side - 0.5F, y = coordinate.y * side - 0.5F;
    const float floor_x = std::floor(x), floor_y = std::floor(y);
    const float part_x = x - floor_x, part_y = y - floor_y;
    const int last = level.side - 1;
    const auto column = [&](float at) {
        const int i = static_cast<int>(std::clamp(at, -1.0F, side));
        if (repeats_u_) return static_cast<std::size_t>(i < 0 ? last : i > last ? 0 : i) * 3;
        return static_cast<std::size_t>(std::clamp(i, 0, last)) * 3;
    };
    const auto row = [&](float at) {
        const int i = std::clamp(static_cast<int>(std::clamp(at, -1.0F, side)), 0, last);
        return static_cast<std::size_t>(i) * static_cast<std::size_t>(level.side) * 3;
    };
    const std::size_t left = column(floor_x), right = column(floor_x + 1.0F);
    const std::size_t upper = row(floor_y), lower = row(floor_y + 1.0F);
    const auto at = [&](std::size_t i) { return texel(&level.rgb[i]); };
    const T above = at(upper + left) * (1.0F - part_x) + at(upper + right) * part_x;
    const T below = at(lower + left) * (1.0F - part_x) + at(lower + right) * part_x;
    return above * (1.0F - part_y) + below * part_y;
}

glm::vec3 Texture::at(const glm::vec2& coordinate, float texels) const {
    return interpolated<glm::vec3>(coordinate, texels, [&](const std::uint8_t* rgb) {
        return glm::vec3(light_[rgb[0]], light_[rgb[1]], light_[rgb[2]]);
    });
}

float Texture::grey_at(const glm::vec2& coordinate, float texels) const {
    return interpolated<float>(coordinate, texels,
                               [&](const std::uint8_t* rgb) { return light_[rgb[0]]; });
}

float texels_between_samples(const std::array<glm::vec2, 3>& image,
                             const std::array<glm::vec2, 3>& seen, int side) {
    const auto twice_area = [](const std::array<glm::vec2, 3>& at) {
        const glm::vec2 b = at[1] - at[0], c = at[2] - at[0];
        return std::abs(b.x * c.y - b.y * c.x);
    };
    return static_cast<float>(side) *
           std::sqrt(twice_area(image) / std::max(twice_area(seen), 0.0025F));
}

}  // namespace sporeprint::render
