#include "core/grow/world/tile_ground.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "core/grow/world/plot_of_world.h"
#include "core/grow/world/tiling.h"
#include "core/math/elementary.h"
#include "core/math/noise.h"
#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/plant/leaf_colour.h"
#include "core/plant/venation.h"
#include "core/surface/codecs.h"
#include "core/world/floor_image.h"
#include "core/world/patches.h"

namespace sporeprint {

namespace {

/// Places along each side of a tile at which the crowns are looked at.
constexpr int canopy_nodes = 65;

/// The light below crowns that are not known one by one.
constexpr double light_below_crowns = 0.3;

/// Crowns hide the ground from this height on, metres.
constexpr double closed_height = 4.0;

/// Crowns as hills: their size in metres, and their height as a share of the trees'.
constexpr double crown_size = 9.0, crown_relief = 0.16;

bool shows_crowns(const PlotContent& content) { return content.size > coarsest_of_trees; }

/// Returns the height of the crowns at places, with the hills that they are from above.
std::vector<double> crown_heights(PatchCanopy& canopy, const PlotContent& content,
                                  std::span<const double> x, std::span<const double> y) {
    Random random(content.seed, purposes::floor_noise, 2);
    const std::uint32_t seed = random.bits();
    std::vector<float> u(x.size()), v(x.size()), noise(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) u[i] = static_cast<float>(x[i] / crown_size);
    std::vector<double> heights;
    heights.reserve(x.size() * y.size());
    for (const double north : y) {
        std::fill(v.begin(), v.end(), static_cast<float>(north / crown_size));
        gradient_noise(u, v, seed, noise);
        for (std::size_t i = 0; i < x.size(); ++i)
            heights.push_back(canopy.at(point_at(x[i], north)) *
                              (1.0 - crown_relief + crown_relief * static_cast<double>(noise[i])));
    }
    return heights;
}

/// Returns the colour of the crowns of a kind from above, sRGB, and how much of the ground they hide.
glm::dvec4 look_of_crowns(const TreePreset& tree, const LeafPreset& leaf,
                          const PlotContent& content) {
    const bool evergreen = has_needles({leaf.shape, leaf.palette});
    const LeafState state = evergreen ? LeafState{} : leaves_on(content.northern_day());
    if (state.bare) return {0.36, 0.32, 0.29, 0.55};
    LaminaPlace middle;
    middle.inside = true;
    middle.affinity = middle.homothety = 0.5;
    middle.from_main = 0.3;
    const auto params = params_of(tree);
    LeafPalette palette = leaf.palette;
    palette.summer = unfolding(palette.summer, state.spring);
    glm::dvec3 light =
        LeafColourMap(palette).at(middle, evergreen ? params.autumn : state.autumn).upper;
    // From above, branches without snow show between those with it.
    constexpr double seen_snow = 0.6;
    if (evergreen) light = glm::mix(light, snow_light, seen_snow * content.snow);
    // Gaps between leaves are dark.
    constexpr double of_light = 0.55;
    return {linear_to_srgb(of_light * light.x), linear_to_srgb(of_light * light.y),
            linear_to_srgb(of_light * light.z), 1.0};
}

/// Returns the mean look of the crowns of a stand.
glm::dvec4 look_of_stand(const World& world, const PlotContent& content, const Atlas& atlas) {
    glm::dvec4 sum(0.0);
    for (const StandKind& kind : world.stand.kinds) {
        const TreePreset* const tree = atlas.find_tree(kind.id);
        if (tree == nullptr) continue;
        const LeafPreset* const leaf = atlas.find_leaf(params_of(*tree).look.leaf.id.string());
        if (leaf == nullptr) continue;
        sum += kind.share * look_of_crowns(*tree, *leaf, content);
    }
    return sum;
}

/// Mixes crowns into the base colour of a tile, and takes the gloss and the relief of the ground below them.
void paint_crowns(RawImages& images, const World& world, const PlotContent& content,
                  PatchCanopy& canopy, const Atlas& atlas) {
    const WorldBox box = box_of(content);
    std::vector<double> x, y;
    for (int i = 0; i < canopy_nodes; ++i) {
        const double t = static_cast<double>(i) / (canopy_nodes - 1);
        x.push_back(box.west + t * content.size);
        y.push_back(box.north - t * content.size);
    }
    const std::vector<double> heights = crown_heights(canopy, content, x, y);
    const glm::dvec4 look = look_of_stand(world, content, atlas);
    const auto node = [&](int column, int row) {
        return heights[static_cast<std::size_t>(row * canopy_nodes + column)];
    };
    const double per_texel = static_cast<double>(canopy_nodes - 1) / (images.side - 1);
    for (int row = 0; row < images.side; ++row)
        for (int column = 0; column < images.side; ++column) {
            const double across = column * per_texel, down = row * per_texel;
            const int i = std::min(static_cast<int>(across), canopy_nodes - 2),
                      j = std::min(static_cast<int>(down), canopy_nodes - 2);
            const double s = across - i, t = down - j;
            const double height = (1.0 - t) * ((1.0 - s) * node(i, j) + s * node(i + 1, j)) +
                                  t * ((1.0 - s) * node(i, j + 1) + s * node(i + 1, j + 1));
            const double hidden = look.w * std::clamp(height / closed_height, 0.0, 1.0);
            if (hidden <= 0.0) continue;
            // Crowns differ, and so do those of one crown's sides.
            const auto draw =
                philox({0, 1, static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row)},
                       {content.seed, purposes::floor_pieces})[0];
            const double bright = 0.86 + 0.28 * static_cast<double>(draw >> 8U) / 16777216.0;
            std::uint8_t* const colour =
                &images.rgb[0][3 * (static_cast<std::size_t>(row) *
                                        static_cast<std::size_t>(images.side) +
                                    static_cast<std::size_t>(column))];
            for (int k = 0; k < 3; ++k) {
                const double own = 255.0 * std::clamp(bright * look[k], 0.0, 1.0);
                colour[k] = static_cast<std::uint8_t>(colour[k] + hidden * (own - colour[k]) + 0.5);
            }
        }
}

/// Returns the means of two by two texels, rounded.
///
/// side  of the image, even
Bytes halved(std::span<const std::uint8_t> rgb, std::size_t side) {
    const std::size_t half = side / 2, stride = 3 * side;
    Bytes out(3 * half * half);
    std::uint8_t* to = out.data();
    for (std::size_t row = 0; row < half; ++row) {
        const std::uint8_t* above = rgb.data() + 2 * row * stride;
        const std::uint8_t* below = above + stride;
        for (std::size_t column = 0; column < half; ++column, above += 6, below += 6)
            for (std::size_t k = 0; k < 3; ++k)
                *to++ = static_cast<std::uint8_t>(
                    (above[k] + above[k + 3] + below[k] + below[k + 3] + 2) / 4);
    }
    return out;
}

/// Returns an image with fewer texels as a file.
///
/// from, to  sides, texels: powers of two
Bytes jpeg_of(std::span<const std::uint8_t> rgb, int from, int to, int quality, Chroma chroma) {
    Bytes smaller;
    for (int side = from; side > to; side /= 2) {
        smaller = halved(rgb, static_cast<std::size_t>(side));
        rgb = smaller;
    }
    return jpeg(rgb, to, to, quality, chroma);
}

/// Returns a content whose light and litter are those below crowns that are not known one by one.
///
/// canopy  must outlive the result, as the world must
PlotContent below_crowns(const World& world, PlotContent content, PatchCanopy& canopy) {
    const auto shade = [&canopy](double x, double y) {
        return std::clamp(canopy.at(point_at(x, y)) / closed_height, 0.0, 1.0);
    };
    content.light = [&world, shade](double x, double y) {
        return world.site_at(point_at(x, y)).light *
               (1.0 - (1.0 - light_below_crowns) * shade(x, y));
    };
    content.fall = [&world, shade](double x, double y) {
        std::array<double, most_kinds> fall{};
        const double here = shade(x, y);
        for (std::size_t kind = 0; kind < world.stand.kinds.size(); ++kind)
            fall[kind] = here * world.stand.kinds[kind].share;
        return fall;
    };
    return content;
}

}  // namespace

std::uint64_t TileTexels::all() const {
    std::uint64_t sum = 0;
    for (const int side : {colour, normal, orm})
        sum += static_cast<std::uint64_t>(side) * static_cast<std::uint64_t>(side);
    return sum;
}

TileTexels texels_of_tile(double side) {
    if (side <= finest_tile) return {512, 256, 128};
    if (side <= 8.0 * finest_tile) return {256, 128, 64};
    return {256, 0, 0};
}

double cover_step_of_tile(double side) {
    constexpr double nodes = 16.0;
    return std::max(side / nodes, CoverField::finest_step);
}

double step_of_tile(double side) {
    // Heights of origins are multiples of a sixteenth too.
    return std::min(slab_step * std::max(1.0, side / finest_tile), 1.0 / 16.0);
}

TileGround::TileGround(const World& world, const PlotContent& content)
    : world_(world), content_(content), canopy_(world.stand, content.time) {}

Mesh TileGround::slab(const FloorHeights& floor, double height) {
    SlabParams params;
    params.box = box_of(content_);
    params.nodes = tile_nodes;
    params.texture_side = texels_of_tile(content_.size).colour;
    params.height = height;
    params.step = step_of_tile(content_.size);
    params.is_seen_from_above = true;
    // Walls hide the cracks between tiles of different sizes.
    params.depth = std::max(0.4, content_.size / 16.0);
    return slab_mesh(params, [&](std::span<const double> x, std::span<const double> y) {
        return heights(floor, x, y);
    });
}

std::vector<double> TileGround::heights(const FloorHeights& floor, std::span<const double> x,
                                        std::span<const double> y) {
    std::vector<double> all = floor.at(x, y);
    if (!shows_crowns(content_)) return all;
    const std::vector<double> crowns = crown_heights(canopy_, content_, x, y);
    for (std::size_t i = 0; i < all.size(); ++i) all[i] += crowns[i];
    return all;
}

RawImages TileGround::images(const Atlas& atlas, const Parallel& parallel) {
    const bool is_finest = content_.size <= finest_tile;
    const double step = cover_step_of_tile(content_.size);
    const int side = texels_of_tile(content_.size).colour;
    if (!shows_crowns(content_))
        return floor_of(content_, cover_of(content_, atlas, step), side, is_finest, atlas,
                        parallel);
    const PlotContent below = below_crowns(world_, content_, canopy_);
    RawImages images =
        floor_of(below, cover_of(below, atlas, step), side, is_finest, atlas, parallel);
    paint_crowns(images, world_, content_, canopy_, atlas);
    return images;
}

ImageSet TileGround::files(const Atlas& atlas, const Parallel& parallel) {
    const RawImages painted = images(atlas, parallel);
    const TileTexels texels = texels_of_tile(content_.size);
    ImageSet set;
    std::vector<std::function<void()>> tasks;
    const auto add = [&](ImageKind kind, int side, int quality, Chroma chroma) {
        if (side == 0) return;
        const auto i = static_cast<std::size_t>(kind);
        tasks.emplace_back([&painted, &set, i, side, quality, chroma] {
            set.files[i] = Slice(std::make_shared<const Bytes>(
                jpeg_of(painted.rgb[i], painted.side, side, quality, chroma)));
        });
    };
    // The image that takes longest first.
    add(ImageKind::base_color, texels.colour, 84, Chroma::halved);
    add(ImageKind::normal, texels.normal, 91, Chroma::full);
    add(ImageKind::orm, texels.orm, 80, Chroma::halved);
    parallel(tasks);
    return set;
}

}  // namespace sporeprint
