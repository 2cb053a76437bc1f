#include "core/trace/colour_mixture.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "core/math/elementary.h"
#include "core/math/principal_axes.h"

namespace sporeprint::trace {

namespace {

/// Variance that every colour has beside that of its group: noise and compression.
constexpr double least_variance = 4.0;

/// A group of colours and its distribution.
struct Group {
    std::vector<WeightedColour> colours;
    glm::dvec3 mean{0.0}, widest{1.0, 0.0, 0.0};
    double weight = 0.0, variance = 0.0;  ///< the greatest variance, along `widest`
};

struct Moments {
    glm::dvec3 mean{0.0};
    glm::dmat3 covariance{0.0};
    double weight = 0.0;
};

Moments moments_of(std::span<const WeightedColour> colours) {
    Moments found;
    for (const WeightedColour& one : colours) {
        found.mean += one.weight * one.colour;
        found.weight += one.weight;
    }
    found.mean /= std::max(found.weight, 1e-9);
    for (const WeightedColour& one : colours) {
        const glm::dvec3 away = one.colour - found.mean;
        found.covariance += one.weight * glm::outerProduct(away, away);
    }
    found.covariance /= std::max(found.weight, 1e-9);
    return found;
}

Group group_of(std::vector<WeightedColour> colours) {
    Group group{std::move(colours), {}, {}, 0.0, 0.0};
    const Moments moments = moments_of(group.colours);
    const PrincipalAxes axes = principal_axes(moments.covariance);
    group.mean = moments.mean;
    group.weight = moments.weight;
    group.widest = axes.directions[0];
    group.variance = axes.variances[0];
    return group;
}

}  // namespace

ColourMixture::ColourMixture(std::span<const WeightedColour> colours) {
    std::vector<Group> groups;
    groups.push_back(group_of({colours.begin(), colours.end()}));
    while (groups.size() < mixture_parts) {
        const auto widest =
            std::max_element(groups.begin(), groups.end(), [](const Group& a, const Group& b) {
                return a.weight * a.variance < b.weight * b.variance;
            });
        if (widest->variance <= 1e-9) break;
        std::vector<WeightedColour> low, high;
        for (const WeightedColour& one : widest->colours)
            (glm::dot(one.colour - widest->mean, widest->widest) > 0.0 ? high : low).push_back(one);
        if (low.empty() || high.empty()) break;
        *widest = group_of(std::move(low));
        groups.push_back(group_of(std::move(high)));
    }
    double all = 0.0;
    for (const WeightedColour& one : colours) all += one.weight;
    for (const Group& group : groups) parts_.push_back(fitted(group.colours, all));

    std::vector<std::vector<WeightedColour>> nearest(parts_.size());
    for (const WeightedColour& one : colours) {
        std::size_t best = 0;
        double least = 1e300;
        for (std::size_t k = 0; k < parts_.size(); ++k) {
            const glm::dvec3 away = one.colour - parts_[k].mean;
            const double cost =
                parts_[k].constant + 0.5 * glm::dot(away, parts_[k].precision * away);
            if (cost >= least) continue;
            least = cost;
            best = k;
        }
        nearest[best].push_back(one);
    }
    parts_.clear();
    for (const std::vector<WeightedColour>& group : nearest)
        if (!group.empty()) parts_.push_back(fitted(group, all));
}

ColourMixture::Part ColourMixture::fitted(std::span<const WeightedColour> colours, double all) {
    const Moments moments = moments_of(colours);
    const glm::dmat3 covariance = moments.covariance + glm::dmat3(least_variance);
    Part part;
    part.mean = moments.mean;
    part.precision = glm::inverse(covariance);
    const double share = std::max(moments.weight / std::max(all, 1e-9), 1e-9);
    part.constant = -logarithm(share) + 0.5 * logarithm(glm::determinant(covariance)) +
                    1.5 * logarithm(2.0 * pi);
    return part;
}

double ColourMixture::cost(const glm::dvec3& colour) const {
    // The sum of exponentials, relative to the greatest one; those below a millionth of it do not count.
    std::array<double, mixture_parts> costs{};
    double least = 1e300;
    for (std::size_t k = 0; k < parts_.size(); ++k) {
        const glm::dvec3 away = colour - parts_[k].mean;
        costs[k] = parts_[k].constant + 0.5 * glm::dot(away, parts_[k].precision * away);
        least = std::min(least, costs[k]);
    }
    constexpr double vanishing = 14.0;
    double sum = 0.0;
    for (std::size_t k = 0; k < parts_.size(); ++k)
        if (costs[k] - least < vanishing) sum += exponential(least - costs[k]);
    return least - logarithm(sum);
}

}  // namespace sporeprint::trace
