#include "core/params/mix.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace sporeprint {

Mix canonical_mix(Weights weights) {
    std::sort(weights.begin(), weights.end());
    double most = 0.0, sum = 0.0;
    for (const auto& [id, weight] : weights) most = std::max(most, weight);
    // The division keeps the sum of huge weights finite.
    for (auto& [id, weight] : weights) sum += weight /= most;

    // In millionths of a thousandth: rounding errors of the division are far smaller, so equal
    // remainders compare as equal.
    struct Share {
        std::size_t index;
        std::int64_t whole, rest;
    };
    constexpr std::int64_t unit = 1'000'000;
    std::vector<Share> shares;
    std::int64_t missing = 1000;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const auto scaled = static_cast<std::int64_t>(
            std::floor(weights[i].second / sum * 1000.0 * double(unit) + 0.5));
        shares.push_back({i, scaled / unit, scaled % unit});
        missing -= shares.back().whole;
    }
    std::stable_sort(shares.begin(), shares.end(),
                     [](const Share& a, const Share& b) { return a.rest > b.rest; });
    for (std::size_t i = 0; missing > 0; ++i, --missing) ++shares[i % shares.size()].whole;
    std::sort(shares.begin(), shares.end(),
              [](const Share& a, const Share& b) { return a.index < b.index; });

    Mix mix;
    for (const Share& share : shares)
        if (share.whole > 0)
            mix.push_back({weights[share.index].first, static_cast<int>(share.whole)});
    return mix;
}

}  // namespace sporeprint
