#include "core/individual/relief.h"

#include <algorithm>

#include "core/math/purposes.h"
#include "core/math/random.h"

namespace sporeprint {

std::array<std::uint32_t, 3> relief_seeds(std::uint32_t seed) {
    Random random(seed, purposes::relief);
    std::array<std::uint32_t, 3> seeds{};
    for (std::uint32_t& one : seeds) one = random.bits();
    return seeds;
}

CarriedRelief carried_relief(const ReliefStyle& style, int columns, int rings) {
    // The share is zero below two samples per period and one from four on; forms without depth are
    // not carried either.
    const auto share = [](double depth, double samples) {
        return depth == 0.0 ? 0.0 : std::clamp(0.5 * samples - 1.0, 0.0, 1.0);
    };
    // A fold extends from crease to crease; there are about three times as many around the face as
    // across it.
    return {share(style.folds,
                  std::min(columns / (3.0 * style.fold_count), 2.0 * rings / style.fold_count)),
            share(style.pits, std::min(static_cast<double>(columns) / style.pit_columns,
                                       static_cast<double>(rings) / style.pit_rows)),
            share(style.tiers, static_cast<double>(rings) / style.tier_count)};
}

}  // namespace sporeprint
