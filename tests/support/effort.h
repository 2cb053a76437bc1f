// The test effort: the one setting from which random draws, animation steps and samples of pairs
// derive their counts.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>

namespace sporeprint {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool sanitized = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
constexpr bool sanitized = true;
#else
constexpr bool sanitized = false;
#endif
#else
constexpr bool sanitized = false;
#endif

/// Returns how many of `full` draws, steps or cases a test runs: at least `least`, at most
/// `most_useful`. It is `full` in a plain build and a twentieth of it under sanitizers, which need
/// few draws to find memory errors, while each draw takes five to twenty times as long. The
/// variable SPOREPRINT_EFFORT multiplies both: 10 for a nightly run, 0.1 for a quick one.
inline std::size_t effort(std::size_t full, std::size_t least = 1,
                          std::size_t most_useful = static_cast<std::size_t>(-1)) {
    const char* wanted = std::getenv("SPOREPRINT_EFFORT");
    const double share = (sanitized ? 0.05 : 1.0) * (wanted ? std::atof(wanted) : 1.0);
    const double count = std::ceil(static_cast<double>(full) * share);
    return std::clamp(count > 1.0 ? static_cast<std::size_t>(count) : 1, least, most_useful);
}

}  // namespace sporeprint
