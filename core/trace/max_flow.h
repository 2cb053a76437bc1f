// The greatest flow through a grid of pixels, and with it the cheapest cut between two parts of an image.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

namespace sporeprint::trace {

/// Steps to the eight neighbours of a pixel; the opposite of step d is step 7 - d.
inline constexpr std::array<std::array<int, 2>, 8> grid_steps = {
    {{-1, -1}, {0, -1}, {1, -1}, {-1, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}}};

/// A network on a grid: each pixel has edges to its eight neighbours, to the source and to the sink.
/// Capacities are integers, so that every machine finds the same cut.
///
/// source  [BoykovKolmogorov2004]
class GridFlow {
  public:
    /// A capacity that no cut of finite cost reaches. The sum of all others must be less.
    static constexpr std::int32_t endless = 1 << 28;

    /// width, height  pixels, at least 1
    GridFlow(int width, int height);

    /// Adds to the cost of having a pixel on the side of the sink (`from_source`) and on that of the source
    /// (`to_sink`).
    ///
    /// pre  both are at least 0
    void add_terminal(int x, int y, std::int32_t from_source, std::int32_t to_sink);

    /// Adds to the cost of having a pixel on the side of the source and its neighbour on that of the sink.
    /// A neighbour beyond the border is left out.
    ///
    /// step  of grid_steps
    void add_edge(int x, int y, std::size_t step, std::int32_t capacity);

    /// Finds the greatest flow. No edge may be added afterwards.
    ///
    /// returns  its value, which is the cost of the cheapest cut
    /// cost     tens of milliseconds for 100,000 pixels of a photograph
    std::int64_t solve();

    /// Returns true if a pixel is on the side of the source in the cheapest cut; of several, in that with
    /// the fewest pixels on that side.
    [[nodiscard]] bool on_source_side(int x, int y) const {
        return tree_[node(x, y)] == Tree::source;
    }

  private:
    enum class Tree : std::uint8_t { none, source, sink };
    /// The step to the parent of a node, or one of these.
    static constexpr std::uint8_t to_terminal = 8, orphan = 9, no_parent = 10;
    using Node = std::uint32_t;

    int width_, height_, stride_;
    std::array<std::ptrdiff_t, 8> offset_{};
    std::vector<std::array<std::int32_t, 8>> capacity_;  // what is left of each edge of a node
    std::vector<std::int32_t> terminal_;  // what is left from the source, negative to the sink
    std::vector<Tree> tree_;
    std::vector<std::uint8_t> parent_;
    std::vector<std::int32_t> time_, distance_;  // when the distance from the terminal was true
    std::vector<bool> is_active_;
    std::deque<Node> active_, orphans_;
    std::vector<Node> saturated_;  // nodes whose edge to the parent is full
    std::int32_t now_ = 0;
    std::int64_t flow_ = 0;

    /// Nodes have a border of one pixel without capacities.
    [[nodiscard]] Node node(int x, int y) const {
        return static_cast<Node>((y + 1) * stride_ + x + 1);
    }
    [[nodiscard]] Node beside(Node from, std::size_t step) const {
        return static_cast<Node>(static_cast<std::ptrdiff_t>(from) + offset_[step]);
    }
    void activate(Node of);
    void make_orphan(Node of);
    /// What is left of the edge between a node and its neighbour, in the direction of the flow in a tree:
    /// away from the source or towards the sink.
    [[nodiscard]] std::int32_t& outward(Tree tree, Node from, std::size_t step);
    bool grow(Node from);
    void augment(Node from, std::size_t step);
    void adopt(Node of);
    [[nodiscard]] std::int32_t distance_from_terminal(Node of);
};

}  // namespace sporeprint::trace
