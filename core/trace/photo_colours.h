// The colours of a photographed mushroom, part by part, and a species that has them.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>

#include "core/model/species.h"
#include "core/surface/codecs.h"
#include "core/trace/photo.h"
#include "core/trace/trace.h"

namespace sporeprint::trace {

/// Colours of parts, CIE L*a*b*.
struct PartColours {
    static constexpr std::size_t places = 4;
    /// Of the quarters of the cap's meridian, from the apex to the margin; none if the photograph shows too
    /// little of a quarter.
    std::optional<std::array<glm::dvec3, places>> cap;
    /// Of the upper and the lower third of the stem; none if the photograph shows too little of one.
    std::optional<std::array<glm::dvec3, 2>> stem;
    /// Of the outer face of a funnel or cup, which hides its inside.
    std::optional<glm::dvec3> face;
};

/// Returns the colours of a mushroom as it is photographed: in each place the commonest hue, so that warts and
/// spots do not count, and of its pixels the median of the lighter 60 %, so that shade does not.
///
/// picture, mask  of one size
/// traced         in pixels of the mask
[[nodiscard]] PartColours part_colours(const Picture& picture, const Mask& mask,
                                       const Traced& traced);

/// Gives a species the colours of a photograph. The photographed stage has them; those of all others are
/// changed by the same difference, and so are the colours of patches and of faded skin. The inside of a
/// funnel or cup changes by the same difference as its outer face.
///
/// stage  the photographed one
void give_colours(Species& species, std::size_t stage, const PartColours& colours);

}  // namespace sporeprint::trace
