#include "core/silhouette/weights.h"

namespace sporeprint {

namespace {

constexpr double corner_width = 0.003;  // a weight of so much counts half

}  // namespace

std::vector<double> eased_weights(std::vector<double> weights) {
    double given = 0.0, eased = 0.0;
    for (const double weight : weights) given += weight;
    for (double& weight : weights) {
        const double share = weight / given;
        weight = share * share / (share + corner_width);
        eased += weight;
    }
    for (double& weight : weights) weight /= eased;
    return weights;
}

}  // namespace sporeprint
