// Streams of draws that belong to a cell of the plane or to a record of a world.
#pragma once

#include <cstdint>

#include "core/math/random.h"

namespace sporeprint {

/// The draws of one purpose for an object in a cell. Assign every draw to a variable before use.
class CellRandom : public Random {
  public:
    CellRandom(std::uint32_t seed, std::uint32_t purpose, std::uint32_t object, std::uint32_t x,
               std::uint32_t y)
        : Random(seed, purpose, object,
                 {static_cast<std::int32_t>(x), static_cast<std::int32_t>(y)}) {}
    /// The draws of an object that belongs to a record.
    CellRandom(std::uint32_t seed, std::uint32_t purpose, std::uint32_t object, std::uint64_t id)
        : CellRandom(seed, purpose, object, static_cast<std::uint32_t>(id >> 32),
                     static_cast<std::uint32_t>(id)) {}

    /// Returns 64 bits, an identifier.
    [[nodiscard]] std::uint64_t identifier() {
        const std::uint64_t high = bits();
        const std::uint64_t low = bits();
        return high << 32 | low;
    }
    /// Returns 24 bits.
    [[nodiscard]] std::uint32_t bits24() { return bits() >> 8; }
    /// Returns a draw of mean 0 and standard deviation 1 near a normal one, within -3..3: three uniforms.
    [[nodiscard]] double bell() {
        double sum = -1.5;
        for (int i = 0; i < 3; ++i) sum += uniform();
        return 2.0 * sum;
    }
};

/// Returns the number of a Poisson distribution that belongs to a uniform draw.
///
/// mean  at most 20
/// none  e^-mean, which many draws share
[[nodiscard]] inline int poisson(double mean, double none, double draw, int most) {
    double chance = none, sum = chance;
    int number = 0;
    while (draw >= sum && number < most) {
        ++number;
        chance *= mean / number;
        sum += chance;
    }
    return number;
}

/// Returns an identifier that two others and a number determine.
[[nodiscard]] inline std::uint64_t mixed(std::uint64_t first, std::uint64_t second,
                                         std::uint32_t number) {
    const auto words =
        philox({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(first >> 32),
                static_cast<std::uint32_t>(second), static_cast<std::uint32_t>(second >> 32)},
               {number, 0x9E3779B9U});
    return static_cast<std::uint64_t>(words[0]) << 32 | words[1];
}

}  // namespace sporeprint
