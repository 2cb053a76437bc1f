#include "core/trace/max_flow.h"

#include <algorithm>
#include <limits>

namespace sporeprint::trace {

namespace {

constexpr std::int32_t unreachable = std::numeric_limits<std::int32_t>::max();

constexpr std::size_t opposite(std::size_t step) { return 7 - step; }

}  // namespace

GridFlow::GridFlow(int width, int height) : width_(width), height_(height), stride_(width + 2) {
    const auto nodes = static_cast<std::size_t>(stride_) * static_cast<std::size_t>(height + 2);
    for (std::size_t d = 0; d < 8; ++d)
        offset_[d] = static_cast<std::ptrdiff_t>(grid_steps[d][1]) * stride_ + grid_steps[d][0];
    capacity_.resize(nodes);
    terminal_.resize(nodes, 0);
    tree_.resize(nodes, Tree::none);
    parent_.resize(nodes, no_parent);
    time_.resize(nodes, 0);
    distance_.resize(nodes, 0);
    is_active_.resize(nodes, false);
}

void GridFlow::add_terminal(int x, int y, std::int32_t from_source, std::int32_t to_sink) {
    // What both have in common is cut in any case.
    std::int32_t& left = terminal_[node(x, y)];
    if (left > 0)
        from_source += left;
    else
        to_sink -= left;
    flow_ += std::min(from_source, to_sink);
    left = from_source - to_sink;
}

void GridFlow::add_edge(int x, int y, std::size_t step, std::int32_t capacity) {
    const int u = x + grid_steps[step][0], v = y + grid_steps[step][1];
    if (u < 0 || v < 0 || u >= width_ || v >= height_) return;
    capacity_[node(x, y)][step] += capacity;
}

void GridFlow::activate(Node of) {
    if (is_active_[of]) return;
    is_active_[of] = true;
    active_.push_back(of);
}

void GridFlow::make_orphan(Node of) {
    parent_[of] = orphan;
    orphans_.push_back(of);
}

std::int32_t& GridFlow::outward(Tree tree, Node from, std::size_t step) {
    return tree == Tree::source ? capacity_[from][step]
                                : capacity_[beside(from, step)][opposite(step)];
}

std::int64_t GridFlow::solve() {
    for (int y = 0; y < height_; ++y)
        for (int x = 0; x < width_; ++x) {
            const Node at = node(x, y);
            if (terminal_[at] == 0) continue;
            tree_[at] = terminal_[at] > 0 ? Tree::source : Tree::sink;
            parent_[at] = to_terminal;
            distance_[at] = 1;
            activate(at);
        }
    while (!active_.empty()) {
        const Node at = active_.front();
        // A node stays active while paths are found through it.
        if (tree_[at] == Tree::none || !grow(at)) {
            active_.pop_front();
            is_active_[at] = false;
        }
    }
    return flow_;
}

/// Lets a tree grow into the neighbours of an active node. Where it meets the other tree, flow is
/// sent along the path.
///
/// returns  false if nothing is left to grow into
bool GridFlow::grow(Node from) {
    const Tree tree = tree_[from];
    for (std::size_t step = 0; step < 8; ++step) {
        if (outward(tree, from, step) == 0) continue;
        const Node to = beside(from, step);
        if (tree_[to] == Tree::none) {
            tree_[to] = tree;
            parent_[to] = static_cast<std::uint8_t>(opposite(step));
            time_[to] = time_[from];
            distance_[to] = distance_[from] + 1;
            activate(to);
        } else if (tree_[to] != tree) {
            ++now_;
            if (tree == Tree::source)
                augment(from, step);
            else
                augment(to, opposite(step));
            while (!orphans_.empty()) {
                const Node next = orphans_.front();
                orphans_.pop_front();
                adopt(next);
            }
            return true;
        } else if (time_[to] <= time_[from] && distance_[to] > distance_[from]) {
            // This way to the terminal is shorter.
            parent_[to] = static_cast<std::uint8_t>(opposite(step));
            time_[to] = time_[from];
            distance_[to] = distance_[from] + 1;
        }
    }
    return false;
}

/// Sends flow from the source to a node, over an edge, and from its other end to the sink.
void GridFlow::augment(Node from, std::size_t step) {
    const Node to = beside(from, step);
    std::int32_t most = capacity_[from][step];
    const auto along = [&](Tree tree, Node start, const auto& use) {
        Node at = start;
        while (parent_[at] != to_terminal) {
            const std::size_t up = parent_[at];
            const Node parent = beside(at, up);
            use(outward(tree, parent, opposite(up)), at, up);
            at = parent;
        }
        return at;
    };
    const auto least = [&](std::int32_t left, Node, std::size_t) { most = std::min(most, left); };
    most = std::min(most, terminal_[along(Tree::source, from, least)]);
    most = std::min(most, -terminal_[along(Tree::sink, to, least)]);

    capacity_[from][step] -= most;
    capacity_[to][opposite(step)] += most;
    for (const Tree tree : {Tree::source, Tree::sink}) {
        const Node root = along(tree, tree == Tree::source ? from : to,
                                [&](std::int32_t& left, Node at, std::size_t up) {
                                    left -= most;
                                    // The opposite edge can take as much more.
                                    outward(tree, at, up) += most;
                                    if (left == 0) saturated_.push_back(at);
                                });
        terminal_[root] += tree == Tree::source ? -most : most;
        if (terminal_[root] == 0) saturated_.push_back(root);
    }
    for (const Node at : saturated_) make_orphan(at);
    saturated_.clear();
    flow_ += most;
}

/// Returns the number of edges from a node to its terminal; unreachable if it hangs on an orphan.
std::int32_t GridFlow::distance_from_terminal(Node of) {
    std::int32_t steps = 0;
    Node at = of;
    while (true) {
        if (time_[at] == now_) {
            steps += distance_[at];
            break;
        }
        ++steps;
        if (parent_[at] == to_terminal) {
            time_[at] = now_;
            distance_[at] = 1;
            break;
        }
        if (parent_[at] == orphan) return unreachable;
        at = beside(at, parent_[at]);
    }
    // Others that pass here need not go all the way.
    std::int32_t left = steps;
    for (Node mark = of; time_[mark] != now_; mark = beside(mark, parent_[mark])) {
        time_[mark] = now_;
        distance_[mark] = left--;
    }
    return steps;
}

/// Finds another parent for a node that has lost its own, or sets it free.
void GridFlow::adopt(Node of) {
    const Tree tree = tree_[of];
    std::int32_t nearest = unreachable;
    std::size_t best = 0;
    for (std::size_t step = 0; step < 8; ++step) {
        const Node other = beside(of, step);
        if (tree_[other] != tree || outward(tree, other, opposite(step)) == 0) continue;
        const std::int32_t distance = distance_from_terminal(other);
        if (distance >= nearest) continue;
        nearest = distance;
        best = step;
    }
    if (nearest != unreachable) {
        parent_[of] = static_cast<std::uint8_t>(best);
        time_[of] = now_;
        distance_[of] = nearest + 1;
        return;
    }
    for (std::size_t step = 0; step < 8; ++step) {
        const Node other = beside(of, step);
        if (tree_[other] != tree) continue;
        if (outward(tree, other, opposite(step)) > 0) activate(other);
        if (parent_[other] == opposite(step)) make_orphan(other);
    }
    tree_[of] = Tree::none;
    parent_[of] = no_parent;
    time_[of] = 0;
}

}  // namespace sporeprint::trace
