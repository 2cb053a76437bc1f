// Position of a texel among the gills or ridges that reach the stem: on the lower face, and down
// the stem where they are decurrent.
#if defined(SPOREPRINT_CORE_SURFACE_GILL_LAYOUT_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SPOREPRINT_CORE_SURFACE_GILL_LAYOUT_INL
#undef SPOREPRINT_CORE_SURFACE_GILL_LAYOUT_INL
#else
#define SPOREPRINT_CORE_SURFACE_GILL_LAYOUT_INL
#endif

#include "core/surface/texel.inl"

HWY_BEFORE_NAMESPACE();
namespace sporeprint {
namespace HWY_NAMESPACE {

/// Returns a hash of a whole number, as a number in -1..1.
HWY_INLINE VF signed_hash(VF whole, std::uint32_t seed) {
    const VU h = whole_bits(whole) * word(prime_x);
    return upper_part(hash(hn::Xor(hash(h), word(seed))));
}

/// Returns x modulo `period`, for -period <= x < 2 period.
HWY_INLINE VF wrapped(VF x, float period) {
    x = x + hn::IfThenElseZero(x < set(0.0F), set(period));
    return x - hn::IfThenElseZero(x >= set(period), set(period));
}

/// Position of a texel among the blades that reach the stem.
struct GillPosition {
    VF x;     ///< blade k is at x = k
    VF wide;  ///< width of this gap relative to the mean
};

/// Returns the slot of blade k, the one nearest to its even place. The offset is not exactly a
/// half, so that a tie is resolved the same way under any rounding.
HWY_INLINE VF slot_of(const GillLayoutPlan& plan, VF k) {
    return hn::Floor(k * set(plan.slots / plan.occupied) + set(0.501F));
}

/// Returns the position among evenly spaced blades or, on a gill layout with more slots, among
/// blades that are assigned to slots.
HWY_INLINE GillPosition blades_at(const GillLayoutPlan& plan, VF turn, VF wander) {
    if (plan.slots == 0.0F) {
        const float n = static_cast<float>(plan.blades);
        return {turn * set(n) + wander * set(n * plan.bend), set(1.0F)};
    }
    const VF one = set(1.0F);
    const VF x = turn * set(plan.slots) + wander * set(plan.slots * plan.bend);
    VF k = hn::Floor(x * set(plan.occupied / plan.slots));
    k = k - hn::IfThenElseZero(slot_of(plan, k) > x, one);
    k = k + hn::IfThenElseZero(slot_of(plan, k + one) <= x, one);
    const VF from = slot_of(plan, k);
    const VF wide = slot_of(plan, k + one) - from;
    return {(k + (x - from) / wide) * set(1.0F / plan.stride),
            wide * set(plan.occupied / plan.slots)};
}

/// Returns the lateral displacement of blades from their meridians, -1..1.
HWY_INLINE VF wander_at(const GillLayoutPlan& plan, VF turn, VF share) {
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
