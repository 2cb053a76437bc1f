// Counter-based random streams: every draw is a pure function of (seed, purpose, object, position
// in the stream).
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace sporeprint {

/// Returns one block of Philox4x32-10.
///
/// source  [Salmon2011]
[[nodiscard]] std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter,
                                                  std::array<std::uint32_t, 2> key);

/// Returns the object of a stream that belongs to a name, as that of a species.
///
/// source  XXH32 of its bytes
[[nodiscard]] std::uint32_t stream_of(std::string_view name);

/// A square of a plane that is divided into squares of one size.
struct CellIndex {
    std::int32_t x = 0, y = 0;
    auto operator<=>(const CellIndex&) const = default;
};

/// A stream of draws for one purpose and object, so that a new draw in one place changes nothing
/// elsewhere. Assign every draw to a variable before use: the order of evaluation of arguments
/// differs between compilers.
class Random {
  public:
    Random(std::uint32_t seed, std::uint32_t purpose, std::uint32_t object = 0)
        : seed_(seed), purpose_(purpose), object_(object) {}
    /// A stream for an object of a cell of the plane of a world.
    Random(std::uint32_t seed, std::uint32_t purpose, std::uint32_t object, CellIndex cell)
        : seed_(seed), purpose_(purpose), object_(object), cell_(cell) {}

    [[nodiscard]] std::uint32_t bits();
    [[nodiscard]] double uniform();                        ///< 0 <= x < 1, 24 bits
    [[nodiscard]] double uniform(double from, double to);  ///< from <= x < to
    [[nodiscard]] double symmetric();                      ///< -1 <= x < 1
    [[nodiscard]] double
    normal();  ///< mean 0, deviation 1, |x| < 6: the sum of twelve uniforms minus six

  private:
    std::uint32_t seed_, purpose_, object_;
    CellIndex cell_;
    std::uint32_t block_ = 0;
    int used_ = 4;
    std::array<std::uint32_t, 4> words_{};
};

}  // namespace sporeprint
