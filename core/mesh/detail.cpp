#include "core/mesh/detail.h"

#include <algorithm>
#include <cmath>

namespace sporeprint {

namespace {

int rounded(double value) { return static_cast<int>(std::floor(value + 0.5)); }

}  // namespace

double between(double from, double to, DetailLevel level) {
    static_assert(DetailLevel::steps == 8, "an eighth of the way is three square roots");
    const double step = std::sqrt(std::sqrt(std::sqrt(to / from)));
    for (int i = 0; i < level.eighths; ++i) from *= step;
    return from;
}

Detail detail_of(DetailLevel level) {
    if (level.lod >= farthest_lod) return farthest_detail;
    const Detail& finer = details[static_cast<std::size_t>(level.lod)];
    if (level.is_whole()) return finer;
    const Detail& coarser = details[static_cast<std::size_t>(level.lod) + 1];
    const auto count = [&](int Detail::*member) {
        return rounded(between(finer.*member, coarser.*member, level));
    };
    const bool is_nearer = level.nearest() == level.lod;
    Detail detail = is_nearer ? finer : coarser;
    detail.stem_rings = count(&Detail::stem_rings);
    detail.hymenium_rings = count(&Detail::hymenium_rings);
    detail.cap_rings = count(&Detail::cap_rings);
    detail.columns = 2 * rounded(0.5 * between(finer.columns, coarser.columns, level));
    detail.veil_rings = count(&Detail::veil_rings);
    detail.sac_rings = count(&Detail::sac_rings);
    if (coarser.patch_sides > 0)
        detail.patch_sides = count(&Detail::patch_sides);
    else if (is_nearer)
        detail.patches = 1.0 - 2.0 * level.eighths / DetailLevel::steps;
    return detail;
}

}  // namespace sporeprint
