// The geometry of an impostor: cards that stand across each other, each showing the frame that is
// seen from its side, so that viewers need no shader.
#pragma once

#include <array>
#include <cstdint>

#include "core/impostor/impostor_atlas.h"
#include "core/mesh/mesh.h"

namespace sporeprint {

/// The frames of the upright cards: of those on the horizon the nearest to five equal angles.
inline constexpr std::array<FrameCell, 5> upright_cards = {
    {{0, 6}, {5, 6}, {6, 2}, {4, 0}, {0, 1}}};

/// The counts of every impostor: one card more lies and is seen from above.
inline constexpr std::uint64_t card_vertices = 4 * (upright_cards.size() + 1),
                               card_triangles = 2 * (upright_cards.size() + 1);

/// Returns about how far the outline of the cards is from that of what they show, in half its width:
/// a card is seen at an angle of up to 36 degrees, and narrower by its cosine; this is the mean.
[[nodiscard]] double card_error();

/// Returns the cards, in metres: each is a rectangle around what its frame shows, through the axis on
/// which the product stands, and one-sided, because the reverse of a card would be lit from below. The lying one
/// is at the height at which the frames from the side are widest.
///
/// returns  with tangents and texture coordinates
[[nodiscard]] Mesh impostor_cards(const ImpostorAtlas& atlas);

}  // namespace sporeprint
