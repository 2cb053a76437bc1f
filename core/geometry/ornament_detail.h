// Resolution of ornaments, of which a species may have more than every set has triangles for.
#pragma once

#include <algorithm>

#include "core/mesh/detail.h"

namespace sporeprint {

/// Warts or scales of a layer, and spines of a layer, that a species keeps in every set and at
/// every level that builds them. What it has beyond them, granules and fine hairs, is its surplus.
inline constexpr int sure_patches = 270, sure_spines = 1000;

/// The counts of one level of detail, and how much of the surplus it builds.
struct OrnamentDetail : Detail {
    double surplus = 1.0;  ///< share of the surplus, the largest pieces first

    OrnamentDetail() = default;
    // NOLINTNEXTLINE(google-explicit-constructor): a level of detail has all of the surplus
    OrnamentDetail(const Detail& detail) : Detail(detail) {}

    /// Returns how many of `count` pieces this level has for a layer, of which `sure` are no
    /// surplus.
    [[nodiscard]] double offered(int count, int sure) const {
        return std::min(count, sure) + surplus * std::max(count - sure, 0);
    }
};

}  // namespace sporeprint
