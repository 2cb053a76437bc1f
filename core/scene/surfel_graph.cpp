#include "core/scene/surfel_graph.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <utility>

#include "core/math/direction.h"

namespace sporeprint {

namespace {

/// Ways do not lead to surfels that face away more than this (cosine).
constexpr double least_facing = -0.5;

/// How far above and below the surface a way is looked at, in spacings.
constexpr double lift_spacings = 0.1;

/// How far from the surface the places on a way may be, as a share of its length.
constexpr double farthest_share = 0.75;

constexpr std::uint32_t stripe = 1024;

/// Looks for the neighbours of surfels.
class Neighbours {
  public:
    Neighbours(const Surfels& surfels, const TriangleTree& tree) : surfels_(surfels), tree_(tree) {}

    /// Returns the nearest neighbours of a surfel, as pairs of numbers of which the first is the lower one.
    void append(std::uint32_t number, std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs) {
        const Surfel& own = surfels_[number];
        const double reach = neighbour_spacings * surfels_.spacing();
        near_.clear();
        surfels_.each_near(glm::dvec3(own.at), reach, [&](std::uint32_t other) {
            if (other == number) return;
            const glm::dvec3 way = glm::dvec3(surfels_[other].at) - glm::dvec3(own.at);
            const double square = glm::dot(way, way);
            if (square > reach * reach || square <= 0.0) return;
            if (glm::dot(glm::dvec3(own.normal), glm::dvec3(surfels_[other].normal)) >=
                least_facing)
                near_.emplace_back(square, other);
        });
        std::ranges::sort(near_);
        // Pairs are looked at from both sides; what is found must not depend on which of them is the first.
        std::size_t found = 0, looked_at = 0;
        for (const auto& [square, other] : near_) {
            if (found == nearest_neighbours || looked_at++ == 3 * nearest_neighbours) break;
            const auto low = std::min(number, other), high = std::max(number, other);
            if (!are_joined(surfels_[low], surfels_[high])) continue;
            pairs.emplace_back(low, high);
            ++found;
        }
    }

  private:
    [[nodiscard]] bool are_joined(const Surfel& a, const Surfel& b) const {
        const glm::dvec3 from(a.at), to(b.at), up(a.normal), up_there(b.normal);
        const double lift = lift_spacings * surfels_.spacing();
        const auto is_free = [&](double height) {
            const glm::dvec3 start = from + height * up, end = to + height * up_there;
            return !tree_.is_blocked(start, end - start, 0.0, 1.0);
        };
        // Over an edge the way leads below the surface.
        if (!is_free(lift) && !is_free(-lift)) return false;
        const double length = glm::length(to - from);
        const double high = std::max(farthest_share * length, lift);
        const glm::dvec3 mean = unit_or(up + up_there, up);
        for (const double share : {0.25, 0.5, 0.75}) {
            const glm::dvec3 place = from + share * (to - from);
            if (!tree_.is_blocked(place + high * mean, mean, -2.0 * high, 0.0)) return false;
        }
        return true;
    }

    const Surfels& surfels_;
    const TriangleTree& tree_;
    std::vector<std::pair<double, std::uint32_t>> near_;
};

}  // namespace

SurfelGraph graph_of(const Surfels& surfels, const TriangleTree& tree, const Parallel& parallel) {
    const auto count = static_cast<std::uint32_t>(surfels.size());
    using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;
    std::vector<Pairs> parts((count + stripe - 1) / stripe);
    std::vector<std::function<void()>> tasks;
    for (std::uint32_t part = 0; part < parts.size(); ++part)
        tasks.emplace_back([&, part] {
            Neighbours neighbours(surfels, tree);
            for (std::uint32_t i = part * stripe; i < std::min(count, (part + 1) * stripe); ++i)
                neighbours.append(i, parts[part]);
        });
    parallel(tasks);
    Pairs pairs;
    for (const Pairs& part : parts) pairs.insert(pairs.end(), part.begin(), part.end());
    std::ranges::sort(pairs);
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    std::vector<std::uint32_t> first(count + std::size_t{1}, 0);
    for (const auto& [a, b] : pairs) {
        ++first[a + std::size_t{1}];
        ++first[b + std::size_t{1}];
    }
    for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
    std::vector<SurfelGraph::Way> ways(2 * pairs.size());
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    const auto add = [&](std::uint32_t from, std::uint32_t to) {
        const glm::dvec3 way = glm::dvec3(surfels[to].at) - glm::dvec3(surfels[from].at);
        ways[next[from]++] = {to, static_cast<float>(glm::length(way))};
    };
    for (const auto& [a, b] : pairs) {
        add(a, b);
        add(b, a);
    }
    for (std::uint32_t i = 0; i < count; ++i)
        std::sort(ways.begin() + first[i], ways.begin() + first[i + std::size_t{1}],
                  [](const SurfelGraph::Way& a, const SurfelGraph::Way& b) { return a.to < b.to; });
    return {std::move(first), std::move(ways)};
}

}  // namespace sporeprint
