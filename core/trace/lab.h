// Colours by how different they look: CIE L*a*b* in daylight (D65).
#pragma once

#include <glm/vec3.hpp>

namespace sporeprint::trace {

/// Returns the L*a*b* colour of sRGB, 0..255 in each channel.
///
/// source  CIE 15:2004 eq. 8.3 to 8.11; the matrix is that of IEC 61966-2-1
[[nodiscard]] glm::dvec3 lab_of(const glm::dvec3& rgb);

/// Returns the sRGB colour of L*a*b*, 0..255 in each channel. A colour that sRGB lacks is moved to the nearest
/// value in each channel.
[[nodiscard]] glm::dvec3 rgb_of(const glm::dvec3& lab);

}  // namespace sporeprint::trace
