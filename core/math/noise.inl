// Gradient noise and its hash on vectors of floats, compiled once per instruction set: included by
// noise.cpp and by the kernels of core/surface and core/world only. Products and sums are never
// fused and every operation is exact or correctly rounded, so that all instruction sets agree.
#if defined(SPOREPRINT_CORE_MATH_NOISE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SPOREPRINT_CORE_MATH_NOISE_INL
#undef SPOREPRINT_CORE_MATH_NOISE_INL
#else
#define SPOREPRINT_CORE_MATH_NOISE_INL
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace sporeprint {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// The lane count is at most eight: wider vectors would need wider images than the smallest atlas
// has.
using Floats = hn::CappedTag<float, 8>;
using Ints = hn::RebindToSigned<Floats>;
using Words = hn::RebindToUnsigned<Floats>;
using VF = hn::Vec<Floats>;
using VI = hn::Vec<Ints>;
using VU = hn::Vec<Words>;

HWY_INLINE VF set(float value) { return hn::Set(Floats(), value); }
HWY_INLINE VU word(std::uint32_t value) { return hn::Set(Words(), value); }
HWY_INLINE VF clamped(VF x, float low, float high) {
    return hn::Min(hn::Max(x, set(low)), set(high));
}
HWY_INLINE VF unit(VF x) { return clamped(x, 0.0F, 1.0F); }
HWY_INLINE VF mix(VF a, VF b, VF weight) { return a + (b - a) * weight; }

/// Returns 0 below `from`, 1 above it by 1/slope, with zero end slopes.
HWY_INLINE VF smooth(VF x, float from, float slope) {
    const VF t = unit((x - set(from)) * set(slope));
    return t * t * (set(3.0F) - set(2.0F) * t);
}

/// Returns bits that identify an integer, |x| < 2^22; consecutive integers have consecutive bits.
/// It is cheaper than a conversion, and as exact.
HWY_INLINE VU whole_bits(VF x) { return hn::BitCast(Words(), x + set(12582912.0F)); }

/// Returns a quintic whose first two derivatives are zero at 0 and 1.
HWY_INLINE VF fade(VF t) { return t * t * t * (t * (t * set(6.0F) - set(15.0F)) + set(10.0F)); }

HWY_INLINE VU hash(VU h) {
    h = h * word(0x27D4EB2DU);
    return hn::Xor(h, hn::ShiftRight<15>(h));
}

/// Returns hash bits as a number, -1 <= x <= 1: all of them, or the lower half.
HWY_INLINE VF upper_part(VU h) {
    return hn::ConvertTo(Floats(), hn::BitCast(Ints(), h)) * set(1.0F / 2147483648.0F);
}
HWY_INLINE VF lower_part(VU h) { return upper_part(hn::ShiftLeft<16>(h)); }

inline constexpr std::uint32_t prime_x = 0x9E3779B1U;
inline constexpr std::uint32_t prime_y = 0x85EBCA77U;
inline constexpr std::uint32_t prime_z = 0xC2B2AE3DU;

// Returns the dot product of gradient and offset, not yet scaled to 1. Each component is the hash
// from another bit on; the bits after its own are too small to matter.
HWY_INLINE VF slope2(VU h, VF dx, VF dy) {
    h = hash(h);
    const VF gx = hn::ConvertTo(Floats(), hn::BitCast(Ints(), h));
    const VF gy = hn::ConvertTo(Floats(), hn::BitCast(Ints(), hn::ShiftLeft<16>(h)));
    return gx * dx + gy * dy;
}

HWY_INLINE VF slope3(VU h, VF dx, VF dy, VF dz) {
    h = hash(h);
    const VF gx = hn::ConvertTo(Floats(), hn::BitCast(Ints(), h));
    const VF gy = hn::ConvertTo(Floats(), hn::BitCast(Ints(), hn::ShiftLeft<11>(h)));
    const VF gz = hn::ConvertTo(Floats(), hn::BitCast(Ints(), hn::ShiftLeft<21>(h)));
    return gx * dx + gy * dy + gz * dz;
}

HWY_INLINE VF noise2_of(VU hx0, VU hx1, VF fx, VF y, std::uint32_t seed) {
    const VF y0 = hn::Floor(y);
    const VF fy = y - y0;
    const VU hy0 = whole_bits(y0) * word(prime_y) + word(seed);
    const VU hy1 = hy0 + word(prime_y);
    const VF gx = fx - set(1.0F);
    const VF gy = fy - set(1.0F);
    const VF u = fade(fx);
    const VF near = mix(slope2(hn::Xor(hx0, hy0), fx, fy), slope2(hn::Xor(hx1, hy0), gx, fy), u);
    const VF far = mix(slope2(hn::Xor(hx0, hy1), fx, gy), slope2(hn::Xor(hx1, hy1), gx, gy), u);
    return mix(near, far, fade(fy)) * set(1.6F / 2147483648.0F);
}

HWY_INLINE VF noise2(VF x, VF y, std::uint32_t seed) {
    const VF x0 = hn::Floor(x);
    const VU hx0 = whole_bits(x0) * word(prime_x);
    return noise2_of(hx0, hx0 + word(prime_x), x - x0, y, seed);
}

/// A cache of the gradients at the corners of the cells that points lie in: neighbours along a row
/// mostly lie in one cell.
struct NoiseCells {
    VF x0, y0;
    VF slope_x[4], slope_y[4];

    // A member function, because the compiler would build a constructor without the instruction
    // set.
    HWY_INLINE void begin() {
        x0 = y0 = set(1e9F);  // no cell
        for (VF& slope : slope_x) slope = set(0.0F);
        for (VF& slope : slope_y) slope = set(0.0F);
    }

    HWY_INLINE void find(VF x, VF y, std::uint32_t seed) {
        if (hn::AllTrue(Floats(), hn::And(x == x0, y == y0))) return;
        x0 = x;
        y0 = y;
        const VU hx0 = whole_bits(x) * word(prime_x);
        const VU hy0 = whole_bits(y) * word(prime_y) + word(seed);
        for (std::size_t corner = 0; corner < 4; ++corner) {
            const VU hx = corner % 2 == 0 ? hx0 : hx0 + word(prime_x);
            const VU hy = corner < 2 ? hy0 : hy0 + word(prime_y);
            const VU h = hash(hn::Xor(hx, hy));
            slope_x[corner] = hn::ConvertTo(Floats(), hn::BitCast(Ints(), h));
            slope_y[corner] = hn::ConvertTo(Floats(), hn::BitCast(Ints(), hn::ShiftLeft<16>(h)));
        }
    }
};

/// Returns the same noise, to the bit, for consecutive points.
///
/// cells  cache of one seed
HWY_INLINE VF noise2(VF x, VF y, std::uint32_t seed, NoiseCells& cells) {
    const VF x0 = hn::Floor(x);
    const VF y0 = hn::Floor(y);
    cells.find(x0, y0, seed);
    const VF fx = x - x0;
    const VF fy = y - y0;
    const VF gx = fx - set(1.0F);
    const VF gy = fy - set(1.0F);
    const auto at = [&](std::size_t corner, VF dx, VF dy) {
        return cells.slope_x[corner] * dx + cells.slope_y[corner] * dy;
    };
    const VF u = fade(fx);
    const VF near = mix(at(0, fx, fy), at(1, gx, fy), u);
    const VF far = mix(at(2, fx, gy), at(3, gx, gy), u);
    return mix(near, far, fade(fy)) * set(1.6F / 2147483648.0F);
}

/// Returns noise that is periodic in x with `period`, for -period <= x < 2 period.
HWY_INLINE VF periodic_noise2(VF x, VF y, int period, std::uint32_t seed) {
    const VF x0 = hn::Floor(x);
    const VF whole = set(static_cast<float>(period));
    VF i0 = x0;
    i0 = i0 + hn::IfThenElseZero(i0 < set(0.0F), whole);
    i0 = i0 - hn::IfThenElseZero(i0 >= whole, whole);
    VF i1 = i0 + set(1.0F);
    i1 = hn::IfThenZeroElse(i1 == whole, i1);
    const VU hx0 = whole_bits(i0) * word(prime_x);
    const VU hx1 = whole_bits(i1) * word(prime_x);
    return noise2_of(hx0, hx1, x - x0, y, seed);
}

HWY_INLINE VF noise3(VF x, VF y, VF z, std::uint32_t seed) {
    const VF x0 = hn::Floor(x);
    const VF y0 = hn::Floor(y);
    const VF z0 = hn::Floor(z);
    const VF fx = x - x0;
    const VF fy = y - y0;
    const VF fz = z - z0;
    const VF gx = fx - set(1.0F);
    const VF gy = fy - set(1.0F);
    const VF gz = fz - set(1.0F);
    const VU hx0 = whole_bits(x0) * word(prime_x);
    const VU hy0 = whole_bits(y0) * word(prime_y) + word(seed);
    const VU hz0 = whole_bits(z0) * word(prime_z);
    const VU hx1 = hx0 + word(prime_x);
    const VU hy1 = hy0 + word(prime_y);
    const VU hz1 = hz0 + word(prime_z);
    const VU h00 = hn::Xor(hy0, hz0);
    const VU h10 = hn::Xor(hy1, hz0);
    const VU h01 = hn::Xor(hy0, hz1);
    const VU h11 = hn::Xor(hy1, hz1);
    const VF u = fade(fx);
    const VF v = fade(fy);
    const VF n00 =
        mix(slope3(hn::Xor(hx0, h00), fx, fy, fz), slope3(hn::Xor(hx1, h00), gx, fy, fz), u);
    const VF n10 =
        mix(slope3(hn::Xor(hx0, h10), fx, gy, fz), slope3(hn::Xor(hx1, h10), gx, gy, fz), u);
    const VF n01 =
        mix(slope3(hn::Xor(hx0, h01), fx, fy, gz), slope3(hn::Xor(hx1, h01), gx, fy, gz), u);
    const VF n11 =
        mix(slope3(hn::Xor(hx0, h11), fx, gy, gz), slope3(hn::Xor(hx1, h11), gx, gy, gz), u);
    return mix(mix(n00, n10, v), mix(n01, n11, v), fade(fz)) * set(1.8F / 2147483648.0F);
}

}  // namespace HWY_NAMESPACE
}  // namespace sporeprint
HWY_AFTER_NAMESPACE();

#endif
