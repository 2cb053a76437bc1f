// Hues of pixels: the shares of red and green in them, which shade hardly changes.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace sporeprint::trace {

/// A colour of sRGB.
using Pixel = std::array<std::uint8_t, 3>;

/// Shares of red and of green in a colour, in steps of a thirty-first.
using Hue = std::array<int, 2>;

/// Returns the hue of a pixel; black has that of grey.
[[nodiscard]] Hue hue_of(const Pixel& pixel);

/// Returns true if neither share differs by more than some steps.
[[nodiscard]] bool are_near(const Hue& a, const Hue& b, int steps);

/// Returns the hue that most pixels have or nearly have. Those that are much darker than the light ones do not
/// count: they are outlines and deep shade. Of two different colours that which more pixels have is meant, even if its
/// hue varies more.
[[nodiscard]] Hue commonest_hue(std::vector<Pixel> pixels);

}  // namespace sporeprint::trace
