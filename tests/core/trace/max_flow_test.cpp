#include "core/trace/max_flow.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cstdint>
#include <tuple>
#include <vector>

namespace sporeprint::trace_max_flow_test {
namespace {

using trace::grid_steps;
using trace::GridFlow;

/// A network whose capacities are known, so that any cut of it can be priced.
struct Network {
    int width, height;
    std::vector<std::int32_t> from_source, to_sink;
    std::vector<std::tuple<int, int, std::size_t, std::int32_t>> edges;

    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y * width + x);
    }
    [[nodiscard]] GridFlow flow() const {
        GridFlow made(width, height);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                made.add_terminal(x, y, from_source[index(x, y)], to_sink[index(x, y)]);
        for (const auto& [x, y, step, capacity] : edges) made.add_edge(x, y, step, capacity);
        return made;
    }
    /// Returns the cost of having the pixels whose bit is set on the side of the source.
    [[nodiscard]] std::int64_t cost(std::uint32_t on_source) const {
        const auto is_source = [&](int x, int y) { return (on_source >> index(x, y) & 1U) != 0; };
        std::int64_t sum = 0;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                sum += is_source(x, y) ? to_sink[index(x, y)] : from_source[index(x, y)];
        for (const auto& [x, y, step, capacity] : edges) {
            const int u = x + grid_steps[step][0], v = y + grid_steps[step][1];
            if (u < 0 || v < 0 || u >= width || v >= height) continue;
            if (is_source(x, y) && !is_source(u, v)) sum += capacity;
        }
        return sum;
    }
};

Network any_network() {
    Network network{*rc::gen::inRange(1, 5), *rc::gen::inRange(1, 4), {}, {}, {}};
    const auto pixels = static_cast<std::size_t>(network.width * network.height);
    const auto capacities = [&] {
        return *rc::gen::container<std::vector<std::int32_t>>(pixels, rc::gen::inRange(0, 30));
    };
    network.from_source = capacities();
    network.to_sink = capacities();
    const int edges = *rc::gen::inRange(0, 60);
    for (int i = 0; i < edges; ++i)
        network.edges.emplace_back(*rc::gen::inRange(0, network.width),
                                   *rc::gen::inRange(0, network.height),
                                   *rc::gen::inRange<std::size_t>(0, 8), *rc::gen::inRange(0, 30));
    return network;
}

RC_GTEST_PROP(GridFlow, IsTheCostOfTheCheapestOfAllCuts, ()) {
    const Network network = any_network();
    GridFlow flow = network.flow();
    const std::int64_t value = flow.solve();
    std::int64_t least = network.cost(0);
    const auto cuts = 1U << static_cast<unsigned>(network.width * network.height);
    for (std::uint32_t cut = 0; cut < cuts; ++cut) least = std::min(least, network.cost(cut));
    RC_ASSERT(value == least);
}

RC_GTEST_PROP(GridFlow, ItsCutHasThatCostAndTheFewestPixelsOfTheSource, ()) {
    const Network network = any_network();
    GridFlow flow = network.flow();
    const std::int64_t value = flow.solve();
    std::uint32_t own = 0;
    for (int y = 0; y < network.height; ++y)
        for (int x = 0; x < network.width; ++x)
            if (flow.on_source_side(x, y)) own |= 1U << network.index(x, y);
    RC_ASSERT(network.cost(own) == value);
    const auto cuts = 1U << static_cast<unsigned>(network.width * network.height);
    // The smallest of all cheapest cuts is within each of them.
    for (std::uint32_t cut = 0; cut < cuts; ++cut)
        if (network.cost(cut) == value) RC_ASSERT((own & ~cut) == 0U);
}

TEST(GridFlow, IsStoppedByTheNarrowestPlaceOfALine) {
    GridFlow flow(5, 1);
    flow.add_terminal(0, 0, GridFlow::endless, 0);
    flow.add_terminal(4, 0, 0, GridFlow::endless);
    for (const auto& [x, capacity] : {std::pair{0, 9}, {1, 4}, {2, 7}, {3, 8}})
        flow.add_edge(x, 0, 4, capacity);
    EXPECT_EQ(flow.solve(), 4);
    EXPECT_TRUE(flow.on_source_side(1, 0));
    EXPECT_FALSE(flow.on_source_side(2, 0));
}

TEST(GridFlow, HasNoEdgesBeyondTheBorder) {
    GridFlow flow(1, 1);
    for (std::size_t step = 0; step < 8; ++step) flow.add_edge(0, 0, step, 100);
    flow.add_terminal(0, 0, 3, 5);
    EXPECT_EQ(flow.solve(), 3);
    EXPECT_FALSE(flow.on_source_side(0, 0));
}

}  // namespace
}  // namespace sporeprint::trace_max_flow_test
