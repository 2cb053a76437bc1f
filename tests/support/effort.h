// How much of a property is looked at: the one switch that random draws, steps of films and samples of pairs take their counts from.
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

/// How many of `full` draws, steps or cases a test looks at, at least `least` and never more than `most_useful`.
/// All in a plain build. A twentieth under sanitizers: they look for faults of memory, which a few draws show, and each
/// takes five to twenty times as long. The environment's SPOREPRINT_EFFORT multiplies either: 10 for a night, 0.1 for a hurry.
inline std::size_t effort(std::size_t full, std::size_t least = 1,
                          std::size_t most_useful = static_cast<std::size_t>(-1)) {
    const char* wanted = std::getenv("SPOREPRINT_EFFORT");
    const double share = (sanitized ? 0.05 : 1.0) * (wanted ? std::atof(wanted) : 1.0);
    const double count = std::ceil(static_cast<double>(full) * share);
    return std::clamp(count > 1.0 ? static_cast<std::size_t>(count) : 1, least, most_useful);
}

}  // namespace sporeprint
