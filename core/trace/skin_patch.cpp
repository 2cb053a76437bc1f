#include "core/trace/skin_patch.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "core/math/elementary.h"

namespace sporeprint::trace {

namespace {

double luminance(const glm::dvec3& light) {
    return 0.2126 * light.x + 0.7152 * light.y + 0.0722 * light.z;
}

/// A copy of a patch whose texels are means of those that are seen.
struct Level {
    std::size_t rows, columns;
    std::vector<glm::dvec3> light;
    std::vector<double> weight;

    /// Returns the light at the middle of a texel of the finer copy.
    [[nodiscard]] glm::dvec3 between(std::size_t row, std::size_t column) const {
        const auto nearest = [](std::size_t fine, std::size_t count) {
            const std::size_t own = fine / 2;
            const std::size_t other = fine % 2 == 0 ? (own > 0 ? own - 1 : own) : own + 1;
            return std::array<std::size_t, 2>{own, std::min(other, count - 1)};
        };
        const auto [own_row, other_row] = nearest(row, rows);
        const auto [own_column, other_column] = nearest(column, columns);
        const auto texel = [this](std::size_t i, std::size_t j) { return light[i * columns + j]; };
        return 0.75 * (0.75 * texel(own_row, own_column) + 0.25 * texel(own_row, other_column)) +
               0.25 * (0.75 * texel(other_row, own_column) + 0.25 * texel(other_row, other_column));
    }
};

Level halved(const Level& of) {
    Level half{(of.rows + 1) / 2, (of.columns + 1) / 2, {}, {}};
    half.light.assign(half.rows * half.columns, glm::dvec3(0.0));
    half.weight.assign(half.rows * half.columns, 0.0);
    for (std::size_t row = 0; row < of.rows; ++row)
        for (std::size_t column = 0; column < of.columns; ++column) {
            const std::size_t from = row * of.columns + column,
                              to = (row / 2) * half.columns + column / 2;
            half.light[to] += of.weight[from] * of.light[from];
            half.weight[to] += of.weight[from];
        }
    for (std::size_t i = 0; i < half.light.size(); ++i) {
        if (half.weight[i] > 0.0) half.light[i] /= half.weight[i];
        half.weight[i] = std::min(half.weight[i], 1.0);
    }
    return half;
}

/// Solves a linear system of three equations by Cramer's rule; zero if it has no single solution.
glm::dvec3 solved(const std::array<glm::dvec3, 3>& columns, const glm::dvec3& right) {
    const auto determinant = [](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
        return glm::dot(a, glm::cross(b, c));
    };
    const double whole = determinant(columns[0], columns[1], columns[2]);
    if (std::abs(whole) < 1e-12) return glm::dvec3(0.0);
    return {determinant(right, columns[1], columns[2]) / whole,
            determinant(columns[0], right, columns[2]) / whole,
            determinant(columns[0], columns[1], right) / whole};
}

}  // namespace

PhotoLight::PhotoLight(const Picture& picture) : picture_(picture) {
    for (std::size_t i = 0; i < linear_.size(); ++i)
        linear_[i] = srgb_to_linear(static_cast<double>(i) / 255.0);
}

Pixel PhotoLight::pixel(const glm::dvec2& place) const {
    const auto i = first_of(static_cast<std::size_t>(place.x), static_cast<std::size_t>(place.y));
    return {picture_.rgb[i], picture_.rgb[i + 1], picture_.rgb[i + 2]};
}

glm::dvec3 PhotoLight::at(const glm::dvec2& place) const {
    const double x = std::clamp(place.x - 0.5, 0.0, picture_.width - 1.001),
                 y = std::clamp(place.y - 0.5, 0.0, picture_.height - 1.001);
    return between_texels(x, y, [this](std::size_t column, std::size_t row) {
        const std::size_t i = first_of(column, row);
        return glm::dvec3(linear_[picture_.rgb[i]], linear_[picture_.rgb[i + 1]],
                          linear_[picture_.rgb[i + 2]]);
    });
}

bool is_well_inside(const Mask& mask, const glm::dvec2& place) {
    constexpr int border = 2;
    const int x = static_cast<int>(std::floor(place.x)), y = static_cast<int>(std::floor(place.y));
    return mask.at(x, y) && mask.at(x - border, y) && mask.at(x + border, y) &&
           mask.at(x, y - border) && mask.at(x, y + border);
}

bool shows_enough(const SkinPatch& patch, std::size_t texels) {
    const auto seen = std::count(patch.is_seen.begin(), patch.is_seen.end(), true);
    return static_cast<double>(seen) >= least_seen * static_cast<double>(texels);
}

void fill(SkinPatch& patch) {
    std::vector<Level> levels = {{patch.rows, patch.columns, patch.light, {}}};
    levels[0].weight.reserve(patch.is_seen.size());
    for (const bool is_seen : patch.is_seen) levels[0].weight.push_back(is_seen ? 1.0 : 0.0);
    while (levels.back().rows > 1 || levels.back().columns > 1)
        levels.push_back(halved(levels.back()));
    for (std::size_t k = levels.size() - 1; k > 0; --k) {
        const Level& coarse = levels[k];
        Level& fine = levels[k - 1];
        for (std::size_t row = 0; row < fine.rows; ++row)
            for (std::size_t column = 0; column < fine.columns; ++column) {
                const std::size_t i = row * fine.columns + column;
                const glm::dvec3 around = coarse.between(row, column);
                fine.light[i] = fine.weight[i] * fine.light[i] + (1.0 - fine.weight[i]) * around;
                fine.weight[i] = 1.0;
            }
    }
    patch.light = std::move(levels[0].light);
    patch.is_seen.assign(patch.light.size(), true);
}

void unshade(SkinPatch& patch, const std::vector<ShadePlace>& places, std::size_t rows) {
    // Light over the mean of its row, so that colours along the part do not count.
    std::vector<double> means(rows, 0.0);
    std::vector<std::size_t> counts(rows, 0);
    for (const ShadePlace& place : places)
        if (place.row != ShadePlace::nowhere) ++counts[place.row];
    for (std::size_t i = 0; i < places.size(); ++i)
        if (const std::size_t row = places[i].row; row != ShadePlace::nowhere)
            means[row] += luminance(patch.light[i]) / static_cast<double>(counts[row]);
    constexpr int rounds = 4;
    constexpr double outlier = 0.15;  // a difference that counts half
    glm::dvec3 shade(1.0, 0.0, 0.0);
    for (int round = 0; round < rounds; ++round) {
        std::array<glm::dvec3, 3> system = {};
        glm::dvec3 right(0.0);
        for (std::size_t i = 0; i < places.size(); ++i) {
            const auto& [row, normal] = places[i];
            if (row == ShadePlace::nowhere || means[row] <= 0.0) continue;
            const glm::dvec3 terms(1.0, normal[0], normal[1]);
            const double light = luminance(patch.light[i]) / means[row];
            const double apart = (light - glm::dot(shade, terms)) / outlier;
            const double weight = round == 0 ? 1.0 : 1.0 / (1.0 + apart * apart);
            for (int k = 0; k < 3; ++k)
                system[static_cast<std::size_t>(k)] += weight * terms[k] * terms;
            right += weight * light * terms;
        }
        if (system[2] == glm::dvec3(0.0)) system[2] = {0.0, 0.0, 1.0};
        const glm::dvec3 found = solved(system, right);
        if (found == glm::dvec3(0.0)) return;
        shade = found;
    }
    constexpr double least_shade = 0.25;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const std::array<double, 2>& normal = places[i].normal;
        const double here = shade.x + shade.y * normal[0] + shade.z * normal[1];
        patch.light[i] /= std::max(here, least_shade);
    }
}

void unshade(SkinPatch& patch, bool has_depth) {
    std::vector<ShadePlace> places;
    places.reserve(patch.light.size());
    for (std::size_t row = 0; row < patch.rows; ++row)
        for (std::size_t column = 0; column < patch.columns; ++column) {
            const SineCosine angle = sine_cosine(patch.angle(column));
            places.push_back({row, {angle.sine, has_depth ? angle.cosine : 0.0}});
        }
    unshade(patch, places, patch.rows);
}

}  // namespace sporeprint::trace
