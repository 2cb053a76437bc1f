// The public noise functions over arrays, compiled once per instruction set; see noise.h.
#if defined(SPOREPRINT_CORE_MATH_NOISE_BATCH_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SPOREPRINT_CORE_MATH_NOISE_BATCH_INL
#undef SPOREPRINT_CORE_MATH_NOISE_BATCH_INL
#else
#define SPOREPRINT_CORE_MATH_NOISE_BATCH_INL
#endif

#include "core/math/noise.inl"

HWY_BEFORE_NAMESPACE();
namespace sporeprint {
namespace HWY_NAMESPACE {

// Loads the rest of an array, padded with zeros.
HWY_INLINE VF load_some(const float* from, std::size_t count) {
    HWY_ALIGN float lanes[8] = {};
    for (std::size_t i = 0; i < count; ++i) lanes[i] = from[i];
    return hn::Load(Floats(), lanes);
}

HWY_INLINE void store_some(VF values, float* to, std::size_t count) {
    HWY_ALIGN float lanes[8];
    hn::Store(values, Floats(), lanes);
    for (std::size_t i = 0; i < count; ++i) to[i] = lanes[i];
}

HWY_INLINE std::size_t lanes_left(std::size_t at, std::size_t count) {
    const std::size_t lanes = hn::Lanes(Floats());
    return count - at < lanes ? count - at : lanes;
}

void noise2_batch(const float* x, const float* y, std::uint32_t seed, float* out,
                  std::size_t count) {
    for (std::size_t i = 0; i < count; i += hn::Lanes(Floats())) {
        const std::size_t some = lanes_left(i, count);
        store_some(noise2(load_some(x + i, some), load_some(y + i, some), seed), out + i, some);
    }
}

void noise3_batch(const float* x, const float* y, const float* z, std::uint32_t seed, float* out,
                  std::size_t count) {
    for (std::size_t i = 0; i < count; i += hn::Lanes(Floats())) {
        const std::size_t some = lanes_left(i, count);
        store_some(
            noise3(load_some(x + i, some), load_some(y + i, some), load_some(z + i, some), seed),
            out + i, some);
    }
}

void periodic_batch(const float* x, const float* y, int period, std::uint32_t seed, float* out,
                    std::size_t count) {
    for (std::size_t i = 0; i < count; i += hn::Lanes(Floats())) {
        const std::size_t some = lanes_left(i, count);
        store_some(periodic_noise2(load_some(x + i, some), load_some(y + i, some), period, seed),
                   out + i, some);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace sporeprint
HWY_AFTER_NAMESPACE();

#endif
