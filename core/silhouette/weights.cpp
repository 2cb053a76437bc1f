#include "core/silhouette/weights.h"

namespace sporeprint {

namespace {

constexpr double corner_width = 0.003;  // this weight counts half

}  // namespace

std::vector<double> eased_weights(std::vector<double> weights) {
    double sum = 0.0, eased_sum = 0.0;
    for (const double weight : weights) sum += weight;
    for (double& weight : weights) {
        const double share = weight / sum;
        weight = share * share / (share + corner_width);
        eased_sum += weight;
    }
    for (double& weight : weights) weight /= eased_sum;
    return weights;
}

}  // namespace sporeprint
