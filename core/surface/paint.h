// Paints the image atlas of a mushroom: base colour, normal and occlusion-roughness-metalness.
#pragma once

#include "core/images.h"
#include "core/individual/gill_layout.h"
#include "core/individual/mushroom_spec.h"
#include "core/individual/patches.h"
#include "core/individual/relief.h"
#include "core/model/ground.h"
#include "core/surface/metrics.h"

namespace sporeprint {

/// Amounts of painted ornaments, 0..1; see OrnamentsOf.
struct PaintedOrnaments {
    double warts = 0.0, scales = 0.0;

    static constexpr void fields(auto visit) {
        using P = PaintedOrnaments;
        visit(&P::warts, Info{.name = "warts", .min = 0, .max = 1, .doc = "Of the warts."});
        visit(&P::scales, Info{.name = "scales", .min = 0, .max = 1, .doc = "Of the scales."});
    }
    bool operator==(const PaintedOrnaments&) const = default;
};

/// The colours of what a mushroom brings along of its ground.
struct PaintedGround {
    Colour litter = LitterStyle{}.colour, aged = LitterStyle{}.aged, strands = StrandStyle{}.colour;

    static constexpr void fields(auto visit) {
        using G = PaintedGround;
        visit(&G::litter, Info{.name = "litter", .doc = "Freshest pieces of litter."});
        visit(&G::aged, Info{.name = "aged", .doc = "Oldest pieces of litter."});
        visit(&G::strands, Info{.name = "strands", .doc = "Strands of mycelium."});
    }
    bool operator==(const PaintedGround&) const = default;
};

/// Everything that painting depends on. Equal canonical text means equal images, so the text is the
/// key of the image cache.
struct PaintParams {
    std::uint32_t seed = 1;
    double lightness = 1.0;
    int side = 1024;
    SurfaceMetrics metrics;
    Surface surface;
    PaintedGround ground;
    HymeniumOf<Plain> hymenium;
    int gill_layout = 0;
    CellRows cells;
    PatchStyle warts;
    PatchStyle scales;
    ReliefStyle relief;
    CarriedRelief carried;
    PaintedOrnaments ornaments;
    double slime = 0.0;
    PaintedWeathering<Plain> weathering;
    std::uint32_t damage_seed = 1;
    std::optional<std::uint32_t> surface_seed, dew_seed;

    static constexpr void fields(auto visit) {
        using P = PaintParams;
        visit(&P::seed,
              Info{.name = "seed", .min = 0, .max = 4294967295.0, .doc = "The individual."});
        visit(&P::lightness,
              Info{.name = "lightness",
                   .min = 0.4,
                   .max = 2.5,
                   .doc = "Factor on the linear colour of the cap: the individual's own tone."});
        visit(&P::side, Info{.name = "side",
                             .unit = "texels",
                             .min = 16,
                             .max = 2048,
                             .doc = "Side of the square atlas, a power of two."});
        visit(&P::metrics, Info{.name = "metrics", .doc = "Lengths of the shape."});
        visit(&P::surface, Info{.name = "surface", .doc = "What is painted."});
        visit(&P::ground, Info{.name = "ground", .doc = "Colours of the ground at the foot."});
        visit(&P::hymenium, Info{.name = "hymenium", .doc = "Gills, ridges or pores."});
        visit(&P::gill_layout,
              Info{.name = "comb",
                   .min = 0,
                   .max = 400,
                   .doc = "Blades that reach the stem in the comb of a set of species: where the "
                          "blades of each of them stand. 0: where its own stand."});
        visit(&P::cells,
              Info{.name = "cells", .doc = "Rows of spines of the species, whatever the lengths."});
        visit(&P::warts, Info{.name = "warts", .doc = "Remnants of the universal veil."});
        visit(&P::scales, Info{.name = "scales", .doc = "Scales of the torn skin."});
        visit(&P::relief, Info{.name = "relief", .doc = "Relief of the upper face."});
        visit(&P::carried,
              Info{.name = "carried", .doc = "How much of the relief the mesh carries."});
        visit(&P::ornaments, Info{.name = "ornaments", .doc = "How much of them is left."});
        visit(&P::slime, Info{.name = "slime", .min = 0, .max = 1, .doc = "Slime on the cap."});
        visit(&P::weathering, Info{.name = "weathering", .doc = "What time and weather did."});
        visit(&P::damage_seed, Info{.name = "damage_seed",
                                    .min = 0,
                                    .max = 4294967295.0,
                                    .doc = "Where they did it: the individual and its species."});
        visit(&P::surface_seed,
              Info{.name = "surface_seed",
                   .min = 0,
                   .max = 4294967295.0,
                   .doc = "Of colours and patterns, unless it is that of the individual."});
        visit(&P::dew_seed, Info{.name = "dew_seed",
                                 .min = 0,
                                 .max = 4294967295.0,
                                 .doc = "Of drops, unless it is that of the individual."});
    }
    /// Returns the seed of what is painted but has no place in the mesh.
    [[nodiscard]] std::uint32_t paint_seed() const { return surface_seed.value_or(seed); }
    bool operator==(const PaintParams&) const = default;
};

/// Paints and encodes an atlas.
///
/// params   its side is 16..2048 texels, a power of two (texture_size halved per LOD). The three
///          RGB images have the layout of swept_charts and are padded beyond every chart
/// returns  base colour (sRGB), normal (+Y up, linear), and occlusion R, roughness G, metalness
///          B = 0. As JPEG: quality 88 and 4:2:0, 89 and 4:4:4, 88 and 4:2:0; as WebP: quality 75,
///          68 and 50
/// throws   InvalidInput if an uploaded image cannot be read (path /surface/<part>/image) or the
///          side is invalid (path /side); what `parallel` throws, such as Cancelled
/// cost     O(side^2)
/// source   [Desbenoit2004] sec. 3.3 for the maps; hymenium occlusion by view factors of slots
[[nodiscard]] ImageSet paint(const PaintParams& params, const Parallel& parallel = in_turn,
                             ImageFormat format = ImageFormat::jpg);

/// Encodes pixels as paint() does.
///
/// format  jpg: without alpha; png: the base colour is a PNG file with alpha, the others are JPEG files; webp: the base
///         colour has alpha if the pixels have
[[nodiscard]] ImageSet encoded(const RawImages& images, ImageFormat format,
                               const Parallel& parallel = in_turn);

/// Rotation of uploaded images about the axis, in turns: a texel at angle x shows the image at
/// angle x plus this.
struct ImageRotations {
    double cap = 0.0, hymenium = 0.0, stem = 0.0;
    bool operator==(const ImageRotations&) const = default;
};

/// Paints an atlas without encoding it, for blending; otherwise like paint().
[[nodiscard]] RawImages paint_raw(const PaintParams& params, const Parallel& parallel = in_turn,
                                  const ImageRotations& turns = {});

}  // namespace sporeprint
