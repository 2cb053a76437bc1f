// Shortest ways over the surface of a scene from some of its surfels to all that are near enough.
#pragma once

#include <cstddef>
#include <cstdint>
#include <queue>
#include <span>
#include <tuple>
#include <vector>

#include "core/scene/surfel_graph.h"

namespace sporeprint {

/// Where a search begins.
struct SearchStart {
    std::uint32_t surfel = 0;
    double cost = 0.0;   ///< metres, with which the way begins
    double reach = 0.0;  ///< length of the ways from here, metres
};

/// What a search finds at a surfel.
struct SearchFind {
    std::uint32_t surfel = 0,
                  start = 0;  ///< start: number of the start from which it is reached first
    double cost = 0.0;        ///< of the start and the way, metres
};

/// Searches on one graph, whose memory serves all of them. Not for use by several threads.
///
/// source  [Dijkstra1959]
class SurfelSearch {
  public:
    explicit SurfelSearch(const SurfelGraph& graph, std::size_t surfels)
        : graph_(graph), nodes_(surfels) {}

    /// Calls visit(find) for the surfels that are reached, by ascending costs, until it returns false. Of starts that
    /// reach a surfel at the same cost the one with the lower number has it, and no way of another start leads on
    /// through it.
    ///
    /// most      greatest cost
    /// is_open   whether ways lead over a surfel
    template <class IsOpen, class Visit>
    void run(std::span<const SearchStart> starts, double most, const IsOpen& is_open,
             const Visit& visit) {
        ++round_;
        Queue queue;
        const auto reach_node = [&](std::uint32_t surfel, std::uint32_t start, double cost) {
            if (cost > most || cost - starts[start].cost > starts[start].reach || !is_open(surfel))
                return;
            Node& node = nodes_[surfel];
            if (node.round == round_ &&
                (node.is_done || node.cost < cost || (node.cost == cost && node.start <= start)))
                return;
            node = {round_, start, cost, false};
            queue.emplace(cost, start, surfel);
        };
        for (std::uint32_t i = 0; i < starts.size(); ++i)
            reach_node(starts[i].surfel, i, starts[i].cost);
        while (!queue.empty()) {
            const auto [cost, start, surfel] = queue.top();
            queue.pop();
            Node& node = nodes_[surfel];
            if (node.is_done || node.cost != cost || node.start != start) continue;
            node.is_done = true;
            if (!visit(SearchFind{surfel, start, cost})) return;
            for (const SurfelGraph::Way& way : graph_.ways(surfel))
                reach_node(way.to, start, cost + static_cast<double>(way.length));
        }
    }

  private:
    struct Node {
        std::uint32_t round = 0, start = 0;
        double cost = 0.0;
        bool is_done = false;
    };
    using Entry = std::tuple<double, std::uint32_t, std::uint32_t>;
    using Queue = std::priority_queue<Entry, std::vector<Entry>, std::greater<>>;

    const SurfelGraph& graph_;
    std::vector<Node> nodes_;
    std::uint32_t round_ = 0;
};

}  // namespace sporeprint
