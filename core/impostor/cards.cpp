#include "core/impostor/cards.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>

#include "core/math/elementary.h"

namespace sporeprint {

namespace {

constexpr FrameCell from_above{frame_grid / 2, frame_grid / 2};

/// Returns the height above the centre at which the outline of a frame is widest, metres: the mean of
/// its widest rows.
float widest_height(const ImpostorAtlas& atlas, FrameCell cell) {
    const int frame = atlas.frame_side;
    int most = -1, sum = 0, rows = 0;
    for (int y = 0; y < frame; ++y) {
        int first = frame, last = -1;
        for (int x = 0; x < frame; ++x) {
            const int at = (cell.row * frame + y) * atlas.side() + cell.column * frame + x;
            if (atlas.base_color[4 * static_cast<std::size_t>(at) + 3] < 128) continue;
            first = std::min(first, x);
            last = x;
        }
        if (last - first > most) {
            most = last - first;
            sum = rows = 0;
        }
        if (last - first < most) continue;
        sum += 2 * y + 1;
        ++rows;
    }
    return (1.0F - static_cast<float>(sum) / static_cast<float>(rows * frame)) * atlas.radius;
}

/// Adds the card of a frame.
///
/// lift  along its normal, metres
void add_card(Mesh& mesh, const ImpostorAtlas& atlas, FrameCell cell, float lift) {
    const FrameAxes axes = axes_of(cell);
    const FrameContent& content = atlas.content_of(cell);
    const auto frame = static_cast<float>(atlas.frame_side);
    const auto side = static_cast<float>(atlas.side());
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const auto add = [&](int column, int row) {
        // The border of what is seen is interpolated with the texel beside it.
        const auto x = static_cast<float>(std::clamp(column, 0, atlas.frame_side)),
                   y = static_cast<float>(std::clamp(row, 0, atlas.frame_side));
        mesh.positions.push_back(
            atlas.centre + axes.toward * lift +
            (axes.right * (2.0F * x / frame - 1.0F) + axes.up * (1.0F - 2.0F * y / frame)) *
                atlas.radius);
        mesh.texture_coordinates.emplace_back((static_cast<float>(cell.column) * frame + x) / side,
                                              (static_cast<float>(cell.row) * frame + y) / side);
        mesh.normals.push_back(axes.toward);
        mesh.tangents.emplace_back(axes.right, 1.0F);
    };
    add(content.left - 1, content.bottom + 1);
    add(content.right + 1, content.bottom + 1);
    add(content.right + 1, content.top - 1);
    add(content.left - 1, content.top - 1);
    for (const std::uint32_t corner : {0U, 1U, 2U, 0U, 2U, 3U})
        mesh.indices.push_back(first + corner);
}

}  // namespace

double card_error() {
    const double widest = pi / static_cast<double>(upright_cards.size());
    return 1.0 - sine(widest) / widest;
}

Mesh impostor_cards(const ImpostorAtlas& atlas) {
    Mesh mesh;
    float height = 0.0F;
    for (const FrameCell cell : upright_cards) {
        // Through the foot at the origin, so that all cards show the stem at one place.
        add_card(mesh, atlas, cell, -glm::dot(atlas.centre, axes_of(cell).toward));
        height += widest_height(atlas, cell) / static_cast<float>(upright_cards.size());
    }
    add_card(mesh, atlas, from_above, height);
    return mesh;
}

}  // namespace sporeprint
