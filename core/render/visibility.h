// What is in front at each sample of an image.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "core/render/cutout.h"
#include "core/render/triangle_raster.h"

namespace sporeprint::render {

/// Returns which part of a triangle is drawn, by its first corner.
using Cutouts = std::function<Cutout(std::uint32_t)>;

/// The nearest triangle at each sample.
struct Visibility {
    int width = 0, height = 0;          ///< in samples
    std::vector<float> nearness;        ///< greater is nearer; `nothing` where nothing is
    std::vector<std::uint32_t> draw;    ///< index into the draw list
    std::vector<std::uint32_t> corner;  ///< index of the triangle's first corner

    static constexpr float nothing = -std::numeric_limits<float>::max();

    Visibility(int columns, int rows);

    /// Shows the triangles of a draw where they are nearer than what was shown before; of equally
    /// near ones the first stays.
    ///
    /// corners   of its vertices, whose third component is their nearness
    /// from, to  rows of samples; others do not change
    /// of        for parts of triangles, the first corner of the whole one; none for whole ones
    /// cutouts   returns which part of a triangle is drawn, by its first corner; none for all of each
    void show(std::size_t of_draw, std::span<const std::uint32_t> indices,
              std::span<const SnappedCorner> corners, int from, int to,
              std::span<const std::uint32_t> of = {}, const Cutouts& cutouts = {});

    [[nodiscard]] bool shows(std::size_t at) const { return nearness[at] > nothing; }
    [[nodiscard]] bool same(std::size_t a, std::size_t b) const {
        return draw[a] == draw[b] && corner[a] == corner[b];
    }
};

}  // namespace sporeprint::render
