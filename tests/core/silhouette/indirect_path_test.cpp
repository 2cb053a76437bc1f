#include "core/silhouette/indirect_path.h"

#include <gtest/gtest.h>

#include "core/math/random.h"

namespace sporeprint::silhouette_indirect_path_test {
namespace {

/// Returns the value at t of a polynomial given via its Bernstein coefficients, via de Casteljau's
/// algorithm.
double at(IndirectPaths::Weight weight, double t) {
    for (std::size_t left = weight.size() - 1; left > 0; --left)
        for (std::size_t i = 0; i < left; ++i)
            weight[i] = (1.0 - t) * weight[i] + t * weight[i + 1];
    return weight[0];
}

TEST(IndirectPaths, WeightsAlongAPathAreTheWeightsOfItsMixes) {
    const std::vector<SpeciesRange> species = {{0, 3, 1}, {3, 2, 4}};
    Random random(59, 0);
    for (const Via via : {Via::mature, Via::intermediate}) {
        IndirectPaths indirect_paths(species);
        indirect_paths.route(0, 3, via);
        indirect_paths.route(2, 3, via);
        for (int trial = 0; trial < 50; ++trial) {
            std::vector<double> from(5), to(5);
            double from_sum = 0.0, to_sum = 0.0;
            for (std::size_t s = 0; s < from.size(); ++s) {
                // Some shapes have weight zero along the path.
                from_sum += from[s] = trial % 3 && s == 1 ? 0.0 : random.uniform();
                to_sum += to[s] = trial % 3 && s == 1 ? 0.0 : random.uniform();
            }
            for (std::size_t s = 0; s < from.size(); ++s) {
                from[s] /= from_sum;
                to[s] /= to_sum;
            }
            const auto path = indirect_paths.effective_weights(from, to);
            for (const double t : {0.0, 0.1, 0.5, 0.8, 1.0}) {
                std::vector<double> mix(from.size());
                for (std::size_t s = 0; s < mix.size(); ++s)
                    mix[s] = (1.0 - t) * from[s] + t * to[s];
                const auto expected = indirect_paths.effective_weights(mix);
                ASSERT_EQ(path.size(), expected.size());
                for (std::size_t s = 0; s < path.size(); ++s)
                    EXPECT_NEAR(at(path[s], t), expected[s], 1e-12) << "shape " << s << " at " << t;
            }
        }
    }
}

}  // namespace
}  // namespace sporeprint::silhouette_indirect_path_test
