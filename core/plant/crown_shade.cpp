#include "core/plant/crown_shade.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/math/elementary.h"

namespace sporeprint {

namespace {

// Least twigs of a tree whose crown has shade.
constexpr double least_twigs = 40.0;

// Optical depth of the mean cell with twigs, and the least light; chosen on pictures.
constexpr double depth_of_cell = 0.14, least_light = 0.30;

// Ways to the sky, in cells, and their weights.
struct Way {
    int x, y, z;
    double weight;
};
constexpr std::array<Way, 9> ways = {{{0, 1, 0, 2.0},
                                      {1, 1, 0, 1.0},
                                      {-1, 1, 0, 1.0},
                                      {0, 1, 1, 1.0},
                                      {0, 1, -1, 1.0},
                                      {1, 0, 0, 0.75},
                                      {-1, 0, 0, 0.75},
                                      {0, 0, 1, 0.75},
                                      {0, 0, -1, 0.75}}};

}  // namespace

CrownShade::CrownShade(const Tree& tree)
    : dense_(cells * cells * cells, 0.0), open_(cells * cells * cells, 1.0) {
    glm::dvec3 low(1e9), high(-1e9);
    double twigs = 0.0;
    const auto each_twig = [&](const auto& use) {
        for (std::uint32_t i = 0; i < tree.ramification.nodes.size(); ++i)
            if (tree.ramification.leaf(i)) use(tree.skeleton.nodes[i + 1].place);
    };
    each_twig([&](const glm::dvec3& place) {
        low = glm::min(low, place);
        high = glm::max(high, place);
        twigs += 1.0;
    });
    if (twigs < least_twigs) return;
    const glm::dvec3 size = high - low;
    cell_ = std::max({size.x, size.y, size.z}) / (static_cast<double>(cells) - 2.0);
    low_ = 0.5 * (low + high) - glm::dvec3(0.5 * static_cast<double>(cells) * cell_);
    const auto index_of = [&](double at, int axis) {
        const double cell = std::floor((at - low_[axis]) / cell_);
        return static_cast<std::size_t>(std::clamp(cell, 0.0, static_cast<double>(cells) - 1.0));
    };
    each_twig([&](const glm::dvec3& p) {
        dense_[(index_of(p.x, 0) * cells + index_of(p.y, 1)) * cells + index_of(p.z, 2)] += 1.0;
    });
    double occupied = 0.0;
    for (const double count : dense_) occupied += count > 0.0 ? 1.0 : 0.0;
    for (double& count : dense_) count *= depth_of_cell * occupied / twigs;
    for (std::size_t x = 0; x < cells; ++x)
        for (std::size_t y = 0; y < cells; ++y)
            for (std::size_t z = 0; z < cells; ++z)
                open_[(x * cells + y) * cells + z] = open_of(x, y, z);
}

double CrownShade::open_of(std::size_t x, std::size_t y, std::size_t z) const {
    double light = 0.0, weights = 0.0;
    for (const Way& way : ways) {
        double depth = 0.0;
        int i = static_cast<int>(x), j = static_cast<int>(y), k = static_cast<int>(z);
        const double step =
            std::sqrt(static_cast<double>(way.x * way.x + way.y * way.y + way.z * way.z));
        const auto inside = [](int at) { return at >= 0 && at < static_cast<int>(cells); };
        for (double share = 0.5; inside(i) && inside(j) && inside(k); share = 1.0) {
            depth +=
                share * step *
                dense_[(static_cast<std::size_t>(i) * cells + static_cast<std::size_t>(j)) * cells +
                       static_cast<std::size_t>(k)];
            i += way.x;
            j += way.y;
            k += way.z;
        }
        light += way.weight * exponential(-depth);
        weights += way.weight;
    }
    return least_light + (1.0 - least_light) * light / weights;
}

double CrownShade::at(const glm::dvec3& place) const {
    // Between the middles of cells the factor changes evenly.
    const glm::dvec3 at = (place - low_) / cell_ - 0.5;
    double factor = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        double share = 1.0;
        std::size_t index = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const double bound = std::clamp(at[axis], 0.0, static_cast<double>(cells) - 1.001);
            const double from = std::floor(bound), t = bound - from;
            const bool is_next = ((corner >> axis) & 1) != 0;
            share *= is_next ? t : 1.0 - t;
            index = index * cells + static_cast<std::size_t>(from) + (is_next ? 1U : 0U);
        }
        factor += share * open_[index];
    }
    return factor;
}

}  // namespace sporeprint
