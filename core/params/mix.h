// The mix of several kinds: ids with weights, in one canonical form.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace sporeprint {

/// One part of a mix, such as a species; weights are thousandths and sum to 1000.
struct MixPart {
    std::string id;
    int weight = 1000;
    bool operator==(const MixPart&) const = default;
};

using Mix = std::vector<MixPart>;

/// Ids with weights as somebody wrote them.
using Weights = std::vector<std::pair<std::string, double>>;

/// Returns the canonical form: weights in thousandths by largest remainder (ties by id, sum 1000),
/// without those that round to 0, sorted by id. Idempotent.
///
/// weights  positive and finite, ids distinct, not empty
[[nodiscard]] Mix canonical_mix(Weights weights);

}  // namespace sporeprint
