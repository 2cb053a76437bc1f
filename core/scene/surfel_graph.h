// Which surfels of a scene are neighbours on its surface, so that what spreads along it finds its way.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/images.h"
#include "core/scene/surfels.h"
#include "core/scene/triangle_tree.h"

namespace sporeprint {

/// Neighbours of a surfel are at most so many spacings away, and it looks for so many of them.
inline constexpr double neighbour_spacings = 2.5;
inline constexpr std::size_t nearest_neighbours = 10;

/// The graph of neighbours: each is a neighbour of its neighbours.
class SurfelGraph {
  public:
    struct Way {
        std::uint32_t to = 0;
        float length = 0.0F;  ///< metres
        bool operator==(const Way&) const = default;
    };
    SurfelGraph() = default;
    SurfelGraph(std::vector<std::uint32_t> first, std::vector<Way> ways)
        : first_(std::move(first)), ways_(std::move(ways)) {}

    /// Returns the ways to the neighbours of a surfel, by their numbers.
    [[nodiscard]] std::span<const Way> ways(std::size_t surfel) const {
        return std::span(ways_).subspan(first_[surfel], first_[surfel + 1] - first_[surfel]);
    }
    /// Returns the memory that it takes.
    [[nodiscard]] std::size_t bytes() const {
        return sizeof(*this) + first_.size() * sizeof(first_[0]) + ways_.size() * sizeof(Way);
    }
    bool operator==(const SurfelGraph&) const = default;

  private:
    std::vector<std::uint32_t> first_{0};
    std::vector<Way> ways_;
};

/// Returns which surfels are neighbours.
///
/// Two are if the one is among the nearest of the other, nothing stands on the way between them over the surface or
/// below it, and the surface goes on between them: three places of the way have some of it below them. So nothing
/// spreads through a wall, or over a gap wider than a quarter of the way.
///
/// parallel  looks at stripes of surfels
/// cost      about 2 s for 100,000 surfels
[[nodiscard]] SurfelGraph graph_of(const Surfels& surfels, const TriangleTree& tree,
                                   const Parallel& parallel = in_turn);

}  // namespace sporeprint
