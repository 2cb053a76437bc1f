#include "core/grow/translucency.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/common.hpp>
#include <memory>
#include <utility>

#include "core/grow/mushroom.h"
#include "core/impostor/fill.h"
#include "core/math/elementary.h"
#include "core/mesh/thickness.h"
#include "core/render/triangle_raster.h"
#include "core/surface/charts.h"
#include "core/surface/codecs.h"

namespace sporeprint {

namespace {

/// Texels of an image of thinness, which is smooth.
constexpr int thinness_side = 128;

/// Rays are no longer than the flesh through which as much of the light passes as rounds to nothing.
constexpr double deepest = 6.0;

/// Share of light that passes through a film of flesh, and through a leaf: flesh scatters, so that
/// as much of the light leaves a film on the side where it entered.
constexpr double through_film = 0.5, through_leaf = 0.5;

/// Tint of a leaf, which absorbs more blue from what passes than from what it reflects.
constexpr glm::dvec3 leaf_tint(1.0, 0.95, 0.3);

/// Level of detail of the mesh in which thickness is measured.
constexpr int measured_lod = 1;

std::uint8_t byte_of(double share) {
    return static_cast<std::uint8_t>(std::clamp(share, 0.0, 1.0) * 255.0 + 0.5);
}

/// Returns the tint of light that passed through flesh: its own colour without its darkness.
glm::dvec3 tint_of(const Colour& flesh) {
    const glm::dvec3 light(srgb_to_linear(flesh.r / 255.0), srgb_to_linear(flesh.g / 255.0),
                           srgb_to_linear(flesh.b / 255.0));
    const double brightest = std::max({light.x, light.y, light.z});
    return brightest > 0.0 ? light / brightest : glm::dvec3(1.0);
}

/// Returns a PNG image whose alpha is the thinness of tiles; the colour is white.
Slice thinness_png(TileGrid grid, const std::vector<const Thinness*>& tiles) {
    const auto side = static_cast<std::size_t>(thinness_side);
    const std::size_t width = side * static_cast<std::size_t>(grid.columns);
    Bytes rgba(4 * side * side * grid.size(), 255);
    for (std::size_t i = 3; i < rgba.size(); i += 4) rgba[i] = 0;
    for (std::size_t tile = 0; tile < tiles.size(); ++tile) {
        if (tiles[tile]->side == 0) continue;
        const std::size_t left = side * static_cast<std::size_t>(grid.column_of(tile)),
                          top = side * static_cast<std::size_t>(grid.row_of(tile));
        for (std::size_t y = 0; y < side; ++y)
            for (std::size_t x = 0; x < side; ++x)
                rgba[4 * ((top + y) * width + left + x) + 3] = tiles[tile]->shares[y * side + x];
    }
    return Slice(std::make_shared<const Bytes>(
        png(rgba, static_cast<int>(width), thinness_side * grid.rows)));
}

}  // namespace

Thinness thinness_of(const Mesh& mesh, double translucency, int side, const Parallel& parallel) {
    const std::vector<float> depths = thickness(mesh, deepest * translucency, parallel);
    const auto share = [&](double depth) { return exponential(-depth / translucency); };
    Thinness found{side, {}, 0.0};
    for (const float depth : depths)
        found.mean += share(static_cast<double>(depth)) / static_cast<double>(depths.size());
    // Faces that lie over each other in the image, as those of a gill, have their mean.
    FilledFrame frame(side);
    std::vector<render::SnappedCorner> corners;
    corners.reserve(depths.size());
    const auto scale = static_cast<float>(side);
    for (std::size_t i = 0; i < depths.size(); ++i)
        corners.push_back(render::snapped({mesh.texture_coordinates[i].x * scale,
                                           mesh.texture_coordinates[i].y * scale, depths[i]}));
    const auto plot = [&](int x, int y, float depth) {
        FilledTexel& texel = frame.texel(x, y);
        texel.depth += static_cast<float>(share(std::max(static_cast<double>(depth), 0.0)));
        texel.coverage += 1.0F;
    };
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const auto& a = corners[mesh.indices[i]];
        const auto& b = corners[mesh.indices[i + 1]];
        const auto& c = corners[mesh.indices[i + 2]];
        // One of both orders is clockwise, and the other plots nothing.
        render::rasterize(a, b, c, side, side, plot);
        render::rasterize(a, c, b, side, side, plot);
    }
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            FilledTexel& texel = frame.texel(x, y);
            if (!(texel.coverage > 0.0F)) continue;
            texel.depth /= texel.coverage;
            texel.coverage = 1.0F;
        }
    frame.fill();
    found.shares.reserve(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            found.shares.push_back(byte_of(static_cast<double>(frame.texel(x, y).depth)));
    return found;
}

Flesh flesh_of(const Individual& individual, const Parallel& parallel) {
    const double translucency = individual.model.material.translucency;
    if (!(translucency > 0.0)) return {};
    Individual bare = individual;
    bare.grounds.clear();
    Thinness thinness = thinness_of(body_mesh(bare, DetailLevel(measured_lod)), translucency,
                                    thinness_side, parallel);
    // Soil and litter are no flesh, however thin.
    for (int y = 0; y < thinness_side; ++y)
        for (int x = 0; x < thinness_side; ++x)
            if (part_at((x + 0.5) / thinness_side, (y + 0.5) / thinness_side) == Part::ground)
                thinness.shares[static_cast<std::size_t>(y * thinness_side + x)] = 0;
    return {std::move(thinness), tint_of(individual.model.surface.flesh.colour)};
}

GlbTransmission transmission_of(const Individual& individual, const FileOptions& file,
                                const ExecutionContext& execution) {
    if (file.materials != MaterialSet::rich) return {};
    throw_if_cancelled(execution);
    return transmission_of(TileGrid{}, {flesh_of(individual, execution.parallel)});
}

GlbTransmission transmission_of(TileGrid grid, const std::vector<Flesh>& tiles) {
    GlbTransmission through;
    through.tint = glm::dvec3(0.0);
    through.mean = 0.0;
    std::vector<const Thinness*> images;
    for (const Flesh& tile : tiles) {
        images.push_back(&tile.thinness);
        if (tile.thinness.side == 0) continue;
        through.factor = through_film;
        through.tint = glm::max(through.tint, tile.tint);
        through.mean += tile.thinness.mean / static_cast<double>(tiles.size());
    }
    if (!(through.factor > 0.0)) return {};
    through.thinness = thinness_png(grid, images);
    return through;
}

std::uint64_t bytes_of_thinness(Textures textures, const FileOptions& file) {
    // Measured: 6 to 15 kB.
    const bool has_image = textures == Textures::embedded || textures == Textures::linked;
    return has_image && file.materials == MaterialSet::rich ? 15'000 : 0;
}

GlbTransmission transmission_of_leaves(const FileOptions& file) {
    if (file.materials != MaterialSet::rich) return {};
    return {through_leaf, leaf_tint, {}, 1.0};
}

}  // namespace sporeprint
