#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <vector>

#include "core/math/elementary.h"
#include "core/plant/bark_image.h"
#include "core/plant/tree.h"
#include "tests/support/orders.h"

namespace sporeprint::plant_bark_test {
namespace {

/// The brightness of a trunk, unrolled: columns round it, rows up it.
struct Unrolled {
    static constexpr int columns = 48;
    int rows = 0;
    double rows_of_girth = 0.0;
    std::vector<double> brightness;  ///< by column, then by row; below 0 where nothing is

    [[nodiscard]] double at(int column, int row) const {
        return brightness[static_cast<std::size_t>(column * rows + row)];
    }
};

/// Returns the middle of a trunk at a height.
glm::dvec2 middle_of(const Tree& tree, double height) {
    const int trunk = tree.ramification.nodes[0].order;
    glm::dvec3 before = tree.skeleton.nodes[0].place;
    for (std::uint32_t i = 0; i < tree.ramification.nodes.size(); ++i) {
        if (tree.ramification.nodes[i].order != trunk) continue;
        const glm::dvec3 after = tree.skeleton.nodes[i + 1].place;
        if (after.y >= height) {
            const double t = (height - before.y) / (after.y - before.y);
            return {before.x + t * (after.x - before.x), before.z + t * (after.z - before.z)};
        }
        before = after;
    }
    return {before.x, before.z};
}

/// Returns the trunk of a tree as its mesh shows its image.
Unrolled unrolled(const Tree& tree, const Bark& bark, const RawImages& images) {
    const int trunk = tree.ramification.nodes[0].order;
    double top = 0.0;
    for (std::uint32_t i = 0; i < tree.ramification.nodes.size(); ++i)
        if (tree.ramification.nodes[i].order == trunk)
            top = std::max(top, tree.skeleton.nodes[i + 1].place.y);
    Unrolled found;
    const double girth = 2.0 * pi * tree.skeleton.nodes[0].radius, step = girth / 24.0;
    found.rows_of_girth = girth / step;
    found.rows = static_cast<int>(0.95 * top / step);
    found.brightness.assign(static_cast<std::size_t>(Unrolled::columns * found.rows), -1.0);
    const auto side = static_cast<double>(images.side);
    const auto texel = [&](const glm::dvec2& uv) {
        const auto of = [&](double x) {
            return static_cast<std::size_t>(std::clamp(x * side, 0.0, side - 1.0));
        };
        const std::size_t at = 3 * (of(uv.y) * static_cast<std::size_t>(images.side) + of(uv.x));
        return static_cast<double>(images.rgb[0][at]) + static_cast<double>(images.rgb[0][at + 1]) +
               static_cast<double>(images.rgb[0][at + 2]);
    };
    const Mesh& mesh = bark.mesh;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        std::array<glm::dvec2, 3> at{}, uv{};
        bool is_trunk = true;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t corner = mesh.indices[i + k];
            is_trunk = is_trunk && tree.ramification.nodes[bark.edges[corner]].order == trunk;
            const glm::dvec3 place(mesh.positions[corner]);
            const glm::dvec2 way = glm::dvec2(place.x, place.z) - middle_of(tree, place.y);
            double turns = std::atan2(way.y, way.x) / (2.0 * pi);
            if (k > 0) turns -= std::floor(turns - at[0].x + 0.5);
            at[k] = {turns, place.y};
            uv[k] = glm::dvec2(mesh.texture_coordinates[corner]);
        }
        if (!is_trunk) continue;
        const auto twice = [](const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
            return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        };
        const double whole = twice(at[0], at[1], at[2]);
        if (std::abs(whole) < 1e-12) continue;
        const auto [low_x, high_x] = std::minmax({at[0].x, at[1].x, at[2].x});
        const auto [low_y, high_y] = std::minmax({at[0].y, at[1].y, at[2].y});
        for (int x = static_cast<int>(std::floor(low_x * Unrolled::columns));
             x <= static_cast<int>(std::ceil(high_x * Unrolled::columns)); ++x)
            for (int y = std::max(0, static_cast<int>(low_y / step));
                 y < std::min(found.rows, static_cast<int>(high_y / step) + 1); ++y) {
                const glm::dvec2 p(static_cast<double>(x) / Unrolled::columns, y * step);
                const glm::dvec3 w = glm::dvec3(twice(p, at[1], at[2]), twice(p, at[2], at[0]),
                                                twice(p, at[0], at[1])) /
                                     whole;
                if (std::min({w.x, w.y, w.z}) < 0.0) continue;
                const int column = (x % Unrolled::columns + Unrolled::columns) % Unrolled::columns;
                found.brightness[static_cast<std::size_t>(column * found.rows + y)] =
                    texel(w.x * uv[0] + w.y * uv[1] + w.z * uv[2]);
            }
    }
    return found;
}

/// Returns the greatest correlation of a trunk with itself farther up, from one girth on to two
/// thirds of its length.
double greatest_repetition(const Unrolled& trunk) {
    double greatest = -1.0;
    for (int lag = static_cast<int>(trunk.rows_of_girth); 3 * lag < 2 * trunk.rows; ++lag) {
        double product = 0.0, first = 0.0, second = 0.0;
        for (int column = 0; column < Unrolled::columns; ++column) {
            double mean = 0.0, seen = 0.0;
            for (int row = 0; row < trunk.rows; ++row)
                if (trunk.at(column, row) >= 0.0) {
                    mean += trunk.at(column, row);
                    seen += 1.0;
                }
            mean /= std::max(seen, 1.0);
            for (int row = 0; row + lag < trunk.rows; ++row) {
                if (trunk.at(column, row) < 0.0 || trunk.at(column, row + lag) < 0.0) continue;
                const double a = trunk.at(column, row) - mean,
                             b = trunk.at(column, row + lag) - mean;
                product += a * b;
                first += a * a;
                second += b * b;
            }
        }
        greatest = std::max(greatest, product / std::sqrt(first * second));
    }
    return greatest;
}

TEST(BarkOfTrunks, DoesNotRepeatAlongThem) {
    for (const TreePreset& preset : tree_presets()) {
        SCOPED_TRACE(preset.id.string());
        for (const std::uint32_t seed : {1U, 2U}) {
            const Tree tree = grown_tree(preset.shape, seed);
            const RawImages images = bark_images(preset.bark, 1, 256);
            for (int lod = 0; lod < 2; ++lod) {
                const Unrolled trunk = unrolled(tree, bark_of(tree, lod), images);
                // What is shorter than two images shows none twice.
                if (trunk.rows < 4.0 * bark_girths * trunk.rows_of_girth) continue;
                EXPECT_LT(greatest_repetition(trunk), 0.3) << seed << ' ' << lod;
                const auto seen = std::count_if(trunk.brightness.begin(), trunk.brightness.end(),
                                                [](double x) { return x >= 0.0; });
                EXPECT_GT(static_cast<double>(seen),
                          0.9 * static_cast<double>(trunk.brightness.size()));
            }
        }
    }
}

// A skin that is wound about its middle line has the radii of the one that is not.
TEST(BarkOfTrunks, IsAsThickAsTheTreeSays) {
    for (const TreePreset& preset : tree_presets()) {
        SCOPED_TRACE(preset.id.string());
        const Tree tree = grown_tree(preset.shape, 1);
        const int order = tree.ramification.nodes[0].order;
        const double foot = tree.skeleton.nodes[0].radius;
        const Bark bark = bark_of(tree, 0);
        for (std::size_t i = 0; i < bark.edges.size(); ++i) {
            if (tree.ramification.nodes[bark.edges[i]].order != order) continue;
            const glm::dvec3 place(bark.mesh.positions[i]);
            if (place.y < foot) continue;
            EXPECT_LT(glm::distance(glm::dvec2(place.x, place.z), middle_of(tree, place.y)),
                      1.3 * foot);
        }
    }
}

}  // namespace
}  // namespace sporeprint::plant_bark_test
