// Where a texel lies among gills or ridges that reach the stem: on the lower face, and where they run down it.
#if defined(SPOREPRINT_CORE_SURFACE_COMB_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SPOREPRINT_CORE_SURFACE_COMB_INL
#undef SPOREPRINT_CORE_SURFACE_COMB_INL
#else
#define SPOREPRINT_CORE_SURFACE_COMB_INL
#endif

#include "core/surface/texel.inl"

HWY_BEFORE_NAMESPACE();
namespace sporeprint {
namespace HWY_NAMESPACE {

/// Where a texel lies among the blades that reach the stem.
struct Among {
    VF x;     ///< the k-th blade stands at k
    VF wide;  ///< width of the gap here over that of the others
};

/// Slot of the k-th blade: the one nearest to its even place. Not quite a half, so that a place half-way between two goes one
/// way however it is rounded.
HWY_INLINE VF slot_of(const CombPlan& plan, VF k) {
    return hn::Floor(k * set(plan.slots / plan.stands) + set(0.501F));
}

/// Blades that stand evenly; or, on a comb with more of them, each on a slot.
HWY_INLINE Among comb_of(const CombPlan& plan, VF turn, VF wander) {
    if (plan.slots == 0.0F) {
        const float n = static_cast<float>(plan.blades);
        return {turn * set(n) + wander * set(n * plan.bend), set(1.0F)};
    }
    const VF one = set(1.0F);
    const VF x = turn * set(plan.slots) + wander * set(plan.slots * plan.bend);
    VF k = hn::Floor(x * set(plan.stands / plan.slots));
    k = k - hn::IfThenElseZero(slot_of(plan, k) > x, one);
    k = k + hn::IfThenElseZero(slot_of(plan, k + one) <= x, one);
    const VF from = slot_of(plan, k);
    const VF wide = slot_of(plan, k + one) - from;
    return {(k + (x - from) / wide) * set(1.0F / plan.stride),
            wide * set(plan.stands / plan.slots)};
}

/// How far blades stray from their meridians, -1..1.
HWY_INLINE VF wander_at(const CombPlan& plan, VF turn, VF share) {
    VF sum = set(0.0F);
    for (const WavePlan& one : plan.wander)
        sum = sum +
              wave(turn * set(one.count) + share * set(one.lean) + set(one.phase)) * set(one.size);
    return sum;
}

}  // namespace HWY_NAMESPACE
}  // namespace sporeprint
HWY_AFTER_NAMESPACE();

#endif
