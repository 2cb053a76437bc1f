#include "core/math/noise.h"

#include <hwy/targets.h>

#include <cstddef>
#include <utility>

#include "core/problems.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/math/noise_batch.inl"
#include <hwy/foreach_target.h>

#include "core/math/noise_batch.inl"

namespace sporeprint {

HWY_EXPORT(noise2_batch);
HWY_EXPORT(noise3_batch);
HWY_EXPORT(periodic_batch);

namespace {

struct Target {
    const char* name;
    std::int64_t bits;
};

// "scalar" is whichever plain C++ fallback the compiler can build.
constexpr Target targets[] = {
    {"scalar", HWY_TARGETS&(HWY_SCALAR | HWY_EMU128)},
    {"ssse3", HWY_TARGETS& HWY_SSSE3},
    {"sse4", HWY_TARGETS& HWY_SSE4},
    {"avx2", HWY_TARGETS& HWY_AVX2},
    {"avx3", HWY_TARGETS& HWY_AVX3},
};

// Returns the instruction sets of the processor, whatever is forced.
std::int64_t processor_targets() {
    static const std::int64_t found = [] {
        hwy::SetSupportedTargetsForTest(0);
        return static_cast<std::int64_t>(hwy::SupportedTargets());
    }();
    return found | HWY_SCALAR | HWY_EMU128;
}

void check_lengths(std::size_t x, std::size_t y, std::size_t out) {
    if (x != y || x != out) throw InvalidInput("", "coordinates and results differ in number");
}

}  // namespace

void gradient_noise(std::span<const float> x, std::span<const float> y, std::uint32_t seed,
                    std::span<float> out) {
    check_lengths(x.size(), y.size(), out.size());
    HWY_DYNAMIC_DISPATCH(noise2_batch)(x.data(), y.data(), seed, out.data(), out.size());
}

void gradient_noise(std::span<const float> x, std::span<const float> y, std::span<const float> z,
                    std::uint32_t seed, std::span<float> out) {
    check_lengths(x.size(), y.size(), out.size());
    check_lengths(x.size(), z.size(), out.size());
    HWY_DYNAMIC_DISPATCH(noise3_batch)(x.data(), y.data(), z.data(), seed, out.data(), out.size());
}

void periodic_noise(std::span<const float> x, std::span<const float> y, int period,
                    std::uint32_t seed, std::span<float> out) {
    check_lengths(x.size(), y.size(), out.size());
    if (period < 1 || period > 65536) throw InvalidInput("", "the period is outside 1..65536");
    HWY_DYNAMIC_DISPATCH(periodic_batch)(x.data(), y.data(), period, seed, out.data(), out.size());
}

std::vector<std::string> simd_names() {
    std::vector<std::string> names = {"auto"};
    for (const Target& target : targets)
        if ((target.bits & processor_targets()) != 0) names.emplace_back(target.name);
    return names;
}

void force_simd(std::string_view name) {
    const std::int64_t have = processor_targets();
    if (name == "auto") {
        hwy::SetSupportedTargetsForTest(0);
        return;
    }
    for (const Target& target : targets) {
        if (name != target.name) continue;
        if ((target.bits & have) == 0)
            throw InvalidInput("simd", "this processor has no " + std::string(name));
        hwy::SetSupportedTargetsForTest(target.bits);
        return;
    }
    std::string known;
    for (const std::string& one : simd_names()) known += (known.empty() ? "" : ", ") + one;
    throw InvalidInput("simd", "'" + std::string(name) + "' is none of " + known);
}

}  // namespace sporeprint
