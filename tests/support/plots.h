// Plots with a few trees, trunks and fruit bodies, for tests.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/grow/world/plot.h"
#include "tests/support/slopes.h"

namespace sporeprint {

/// Returns a place of a world.
inline WorldPoint world_point(double x, double y) {
    return {static_cast<std::int32_t>(x * units_of_metre),
            static_cast<std::int32_t>(y * units_of_metre)};
}

/// A small world with what its plots show.
struct SmallWood {
    Ground ground = sloping_ground(0.12, -0.06);
    std::vector<StandTree> trees;
    std::vector<DeadWood> dead;
    std::vector<FruitBody> bodies;
    static constexpr int year = 60, day = 265;

    SmallWood() {
        for (std::uint64_t i = 0; i < 9; ++i) {
            StandTree tree;
            tree.id = (i << 32U) + 11 * i + 5;
            tree.at = world_point(-3.2 + 3.1 * static_cast<double>(i % 3),
                                  -2.9 + 2.8 * static_cast<double>(i / 3));
            tree.born = time_of(-30);
            tree.died = time_of(150);
            tree.kind = static_cast<std::uint8_t>(i % 2);
            tree.height = 20.0 + static_cast<double>(i);
            trees.push_back(tree);
        }
        DeadWood log;
        log.id = 901;
        log.at = world_point(-6.0, -1.0);
        log.died = time_of(40);
        log.fell = time_of(45);
        log.gone = time_of(90);
        log.direction = 0.3;
        log.length = 15.0;
        log.radius = 0.2;
        log.decay = 0.054;
        dead.push_back(log);
        log.id = 902;  // a snag
        log.at = world_point(0.7, 1.2);
        log.fell = time_of(80);
        dead.push_back(log);
        for (std::uint64_t i = 0; i < 40; ++i) {
            FruitBody body;
            body.id = (i * 7919U << 32U) + 31 * i + 1;
            body.at = world_point(-1.8 + 0.09 * static_cast<double>(i),
                                  1.5 - 0.07 * static_cast<double>((i * 13) % 40));
            body.species = static_cast<std::uint8_t>(i % 3);
            body.emerged = time_of(year, day) - static_cast<WorldTime>(5 * i);
            body.matured = body.emerged + 8 * ticks_of_day;
            body.gone = body.emerged + 20 * ticks_of_day;
            bodies.push_back(body);
        }
    }

    /// Returns what is on a plot at a place; the wood has to live as long.
    [[nodiscard]] PlotContent content(double x = 0.0, double y = 0.0, double size = 4.0) const {
        PlotContent content;
        content.ground = &ground;
        content.seed = 7;
        content.centre = world_point(x, y);
        content.size = size;
        content.time = time_of(year, day);
        content.kinds = {"broadleaf", "birch"};
        content.species = {"amanita_muscaria", "boletus_edulis", "laccaria_amethystina"};
        content.trees = trees;
        content.dead_wood = dead;
        content.bodies = bodies;
        return content;
    }
};

inline const SmallWood& small_wood() {
    static const SmallWood made;
    return made;
}

}  // namespace sporeprint
