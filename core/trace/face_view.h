// A cap that is photographed from above or below: where its skin is on the photograph, and its image and colours.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "core/silhouette/outline.h"
#include "core/surface/codecs.h"
#include "core/trace/photo.h"

namespace sporeprint::trace {

/// The faces of a cap that a photograph can show.
enum class Face : std::uint8_t { upper, lower };

/// A photograph of a face, in pixels of its working copy.
struct FaceView {
    Picture picture;
    Mask mask;  ///< of the same size
    std::optional<glm::dvec2>
        centre{};  ///< the apex, or where the stem is fixed; without it the middle of the mask
    std::optional<glm::dvec2> stem_end{};  ///< of a lower face: the stem between is hidden
};

/// What a photograph shows of a face.
struct FaceShown {
    static constexpr std::size_t places = 4;

    /// What is cut out has the outline of a cap, as an ellipse nearly; otherwise nothing is shown.
    bool is_round = true;
    /// Disc in the layout of core/surface/charts.h; none if too little of the face is seen.
    std::optional<Picture> image;
    /// Colours of the quarters of the meridian from the middle to the margin, CIE L*a*b*; none of a quarter of which
    /// too little is seen, and none at all without an image.
    std::array<std::optional<glm::dvec3>, places> quarters;
};

/// Returns what is seen of a face, without its shade; what is hidden has the colours of what is round it.
///
/// The margin is a circle that the camera, somewhat askew, sees as an ellipse: that of the mask's second
/// moments. Each direction reaches as far as the mask does, and what lies higher than the margin moves with the
/// centre as far as it is higher. A stem whose end is known is left out of the mask. What is not of the commonest hue
/// (warts, a stem of another colour, leaves) is hidden.
///
/// outline  of the same mushroom; its upper face is its cap, its lower one its hymenium, which is not empty
/// cost     about 60 ms
[[nodiscard]] FaceShown face_shown(const FaceView& view, const Outline& outline, Face face);

}  // namespace sporeprint::trace
