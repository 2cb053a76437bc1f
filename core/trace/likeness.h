// How like a mushroom on a picture is to others: by the widths of its outline and by its colours.
#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "core/trace/photo.h"

namespace sporeprint::trace {

/// What of a mushroom is compared.
struct Likeness {
    static constexpr std::size_t heights = 40, bands = 4;
    /// Half the width at even heights from the foot to the top, of the height.
    std::array<double, heights> half_widths{};
    /// The median colour of each quarter of the height from the foot, CIE L*a*b* with L* halved: light
    /// changes it more than hue.
    std::array<glm::dvec3, bands> colours{};
};

/// Returns the likeness of what a mask shows of a picture.
///
/// mask  of the size of the picture, at least one pixel
[[nodiscard]] Likeness likeness_of(const Picture& picture, const Mask& mask);

/// How unlike two mushrooms are.
struct Unlikeness {
    double shape = 0.0;   ///< root mean square of the differences of half widths, of the height
    double colour = 0.0;  ///< mean distance of the colours of bands, with L* halved

    /// Returns both as one number: a difference of 6 % in shape counts as much as one of 12 in colour.
    [[nodiscard]] double total() const { return shape / 0.06 + colour / 12.0; }
};

[[nodiscard]] Unlikeness unlikeness(const Likeness& a, const Likeness& b);

}  // namespace sporeprint::trace
