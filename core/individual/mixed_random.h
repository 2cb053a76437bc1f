// Random streams of mixes: each draw is a weighted mean of draws of several seeds.
#pragma once

#include <cstdint>
#include <vector>

#include "core/math/random.h"

namespace sporeprint {

/// One seed of a mix.
struct SeedShare {
    std::uint32_t seed = 1;
    double weight = 1.0;  ///< weights of a mix sum to 1
};
using SeedShares = std::vector<SeedShare>;

/// A stream whose draws move continuously from those of one seed to those of another while the
/// weights do; with one seed of weight 1 they are those of Random.
class MixedRandom {
  public:
    MixedRandom(const SeedShares& shares, std::uint32_t purpose, std::uint32_t object = 0) {
        for (const SeedShare& share : shares)
            streams_.push_back({Random(share.seed, purpose, object), share.weight});
    }

    [[nodiscard]] double uniform() {  ///< 0 <= x < 1
        double sum = 0.0;
        for (auto& [random, weight] : streams_) sum += weight * random.uniform();
        return sum;
    }
    [[nodiscard]] double uniform(double from, double to) { return from + (to - from) * uniform(); }
    [[nodiscard]] double symmetric() { return uniform(-1.0, 1.0); }

  private:
    struct Stream {
        Random random;
        double weight;
    };
    std::vector<Stream> streams_;
};

}  // namespace sporeprint
