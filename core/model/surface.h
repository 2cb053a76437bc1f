// Painting parameters, from which the images of [Desbenoit2004] are generated: colours and patterns
// of each part, and optional material effects.
#pragma once

#include <vector>

#include "core/model/hymenium.h"
#include "core/params/describe.h"
#include "core/params/types.h"

namespace sporeprint {

/// The structure of a skin at the scale of a millimetre and below.
enum class SkinKind { smooth, fibrillose, silky, velvety, granular, viscid, matt };

constexpr const char* name(SkinKind kind) {
    switch (kind) {
        case SkinKind::smooth:
            return "smooth";
        case SkinKind::fibrillose:
            return "fibrillose";
        case SkinKind::silky:
            return "silky";
        case SkinKind::velvety:
            return "velvety";
        case SkinKind::granular:
            return "granular";
        case SkinKind::viscid:
            return "viscid";
        case SkinKind::matt:
            return "matt";
    }
    return nullptr;
}

/// Texture of a skin: painted at two to six texels, whatever the resolution, in colour, relief and
/// roughness.
struct SkinTexture {
    SkinKind kind = SkinKind::smooth;
    double strength = 0.5;
    double bloom = 0.0;
    double grain = 0.001;

    static constexpr void fields(auto visit) {
        using S = SkinTexture;
        visit(&S::kind,
              Info{.name = "kind",
                   .doc = "What the skin is made of: fibres that run outwards or down the stem, "
                          "silk, upright hairs, granules, a viscid film, or a dry matt layer."});
        visit(&S::strength, Info{.name = "strength",
                                 .min = 0,
                                 .max = 1,
                                 .doc = "How distinct that structure is; 0 is a flat skin."});
        visit(
            &S::bloom,
            Info{.name = "bloom", .min = 0, .max = 1, .doc = "Pale powder on the skin (pruina)."});
        visit(&S::grain,
              Info{.name = "grain",
                   .unit = "m",
                   .min = 0.0001,
                   .max = 0.01,
                   .doc = "Size of the largest features at full strength; larger ones are fainter "
                          "in proportion to their size."});
    }
    bool operator==(const SkinTexture&) const = default;
};

/// The upper face: colours run from the apex (first) to the margin (last).
struct CapSurface {
    std::vector<Colour> ramp = {{200, 160, 120}, {180, 140, 100}};
    double ramp_noise = 0.3;
    double fibrils = 0.0;
    int fibril_count = 90;
    double zones = 0.0;
    int zone_count = 6;
    double patches = 0.0;
    double patch_size = 0.01;
    double patch_softness = 0.2;
    Colour patch_colour = {230, 210, 180};
    double streaks = 0.0;
    double veins = 0.0;
    double striae = 0.0;
    double bumps = 0.2;
    SkinTexture skin;
    double colour_drift = 0.3;
    double roughness = 0.6;
    Colour hollow = {120, 90, 60};
    double hollow_tint = 0.0;
    Upload image;

    static constexpr void fields(auto visit) {
        using C = CapSurface;
        visit(&C::ramp, Info{.name = "ramp",
                             .most = 6,
                             .doc = "Colours along the meridian, apex to margin, evenly spaced."});
        visit(&C::ramp_noise, Info{.name = "ramp_noise",
                                   .min = 0,
                                   .max = 1,
                                   .doc = "How unevenly the ramp's borders run."});
        visit(&C::fibrils,
              Info{.name = "fibrils", .min = 0, .max = 1, .doc = "Strength of radial fibres."});
        visit(&C::fibril_count, Info{.name = "fibril_count",
                                     .min = 8,
                                     .max = 400,
                                     .doc = "Radial fibres round the cap."});
        visit(&C::zones,
              Info{.name = "zones", .min = 0, .max = 1, .doc = "Strength of concentric bands."});
        visit(&C::zone_count, Info{.name = "zone_count",
                                   .min = 1,
                                   .max = 30,
                                   .doc = "Concentric bands between apex and margin."});
        visit(&C::patches, Info{.name = "patches",
                                .min = 0,
                                .max = 1,
                                .doc = "Share of the face that wears the patch colour."});
        visit(&C::patch_size, Info{.name = "patch_size",
                                   .unit = "m",
                                   .min = 0.0005,
                                   .max = 0.1,
                                   .doc = "Size of a patch."});
        visit(&C::patch_softness,
              Info{.name = "patch_softness",
                   .min = 0,
                   .max = 1,
                   .doc = "0: patches have an edge, as torn veils do; 1: they are stains."});
        visit(&C::patch_colour, Info{.name = "patch_colour", .doc = "Colour of the patches."});
        visit(&C::streaks, Info{.name = "streaks",
                                .min = 0,
                                .max = 1,
                                .doc = "Strength of irregular radial streaks of darker colour."});
        visit(&C::veins, Info{.name = "veins",
                              .min = 0,
                              .max = 1,
                              .doc = "Raised net of veins, strongest at the centre (cups)."});
        visit(&C::striae,
              Info{.name = "striae",
                   .min = 0,
                   .max = 1,
                   .doc = "Share of the radius that is grooved from the margin inwards."});
        visit(&C::bumps,
              Info{.name = "bumps", .min = 0, .max = 1, .doc = "Fine unevenness of the skin."});
        visit(&C::skin, Info{.name = "skin", .doc = "Texture of the skin, finer than bumps."});
        visit(&C::colour_drift,
              Info{.name = "colour_drift",
                   .min = 0,
                   .max = 1,
                   .doc = "How much the hue varies from one side of the face to the other, and "
                          "between individuals."});
        visit(&C::roughness,
              Info{.name = "roughness", .min = 0.05, .max = 1, .doc = "0 is polished, 1 is matt."});
        visit(&C::hollow, Info{.name = "hollow",
                               .doc = "Colour in the hollows of the relief: pits, creases, "
                                      "grooves."});
        visit(&C::hollow_tint, Info{.name = "hollow_tint",
                                    .min = 0,
                                    .max = 1,
                                    .doc = "How much of that colour the hollows show."});
        visit(&C::image,
              Info{.name = "image",
                   .most = 3000000,
                   .doc = "The paper's own way: a PNG, JPEG or WebP of the cap seen from above, up "
                          "to 2048 x 2048, used instead of the painting."});
    }
    bool operator==(const CapSurface&) const = default;
};

/// The lower face.
struct HymeniumSurface {
    HymeniumPattern pattern = HymeniumPattern::gills;
    Colour colour = {240, 230, 210};
    Colour edge = {240, 230, 210};
    Colour depth = {190, 170, 140};
    double mottle = 0.2;
    double felt = 0.0;
    double cracks = 0.0;
    double roughness = 0.8;
    Upload image;

    static constexpr void fields(auto visit) {
        using H = HymeniumSurface;
        visit(&H::pattern,
              Info{.name = "pattern", .doc = "Gills, ridges, pores, teeth or a smooth face."});
        visit(&H::colour,
              Info{.name = "colour", .doc = "Colour of the faces of the gills, or between pores."});
        visit(&H::edge,
              Info{.name = "edge", .doc = "Colour of the edges of gills or the rims of pores."});
        visit(&H::depth,
              Info{.name = "depth", .doc = "Colour deep between the gills or inside the pores."});
        visit(
            &H::mottle,
            Info{.name = "mottle", .min = 0, .max = 1, .doc = "Cloudy unevenness of the colour."});
        visit(&H::felt, Info{.name = "felt",
                             .min = 0,
                             .max = 1,
                             .doc = "Matted hairs on a smooth face, as outside of a bird's nest."});
        visit(&H::cracks, Info{.name = "cracks",
                               .min = 0,
                               .max = 1,
                               .doc = "How far a smooth face is cracked like dry mud, as the rays "
                                      "of an earthstar are."});
        visit(&H::roughness,
              Info{.name = "roughness", .min = 0.05, .max = 1, .doc = "0 is polished, 1 is matt."});
        visit(&H::image, Info{.name = "image",
                              .most = 3000000,
                              .doc = "A PNG, JPEG or WebP of the lower face, up to 2048 x 2048, "
                                     "used instead of the painting."});
    }
    bool operator==(const HymeniumSurface&) const = default;
};

/// The stem: `base` is the ground end.
struct StemSurface {
    Colour top = {240, 230, 210};
    Colour base = {220, 200, 170};
    double base_stain = 0.2;
    Colour stain = {120, 90, 60};
    double soil = 0.85;
    Colour soil_colour = {72, 50, 30};
    double mycelium = 0.25;
    double fibrils = 0.3;
    double bands = 0.0;
    Colour band_colour = {160, 130, 100};
    double net = 0.0;
    Colour net_colour = {242, 234, 219};
    double bumps = 0.2;
    SkinTexture skin;
    double roughness = 0.75;
    Upload image;

    static constexpr void fields(auto visit) {
        using S = StemSurface;
        visit(&S::top, Info{.name = "top", .doc = "Colour at the hymenium."});
        visit(&S::base, Info{.name = "base", .doc = "Colour at the ground."});
        visit(&S::base_stain, Info{.name = "base_stain",
                                   .min = 0,
                                   .max = 1,
                                   .doc = "Share of the stem that is stained from the ground up."});
        visit(&S::stain, Info{.name = "stain", .doc = "Colour of the stain."});
        visit(&S::soil, Info{.name = "soil",
                             .min = 0,
                             .max = 1,
                             .doc = "How much soil clings to the stem at the ground."});
        visit(&S::soil_colour,
              Info{.name = "soil_colour", .doc = "Colour of soil, humus or rotten wood."});
        visit(&S::mycelium, Info{.name = "mycelium",
                                 .min = 0,
                                 .max = 1,
                                 .doc = "How much white felt of the mycelium covers the foot of "
                                        "the stem."});
        visit(&S::fibrils,
              Info{.name = "fibrils", .min = 0, .max = 1, .doc = "Strength of lengthwise fibres."});
        visit(&S::bands, Info{.name = "bands",
                              .min = 0,
                              .max = 1,
                              .doc = "Strength of zig-zag bands (snake skin)."});
        visit(&S::band_colour, Info{.name = "band_colour", .doc = "Colour of the bands."});
        visit(&S::net, Info{.name = "net",
                            .min = 0,
                            .max = 1,
                            .doc = "Raised net, strongest in the upper third (boletes)."});
        visit(&S::net_colour, Info{.name = "net_colour", .doc = "Colour of the net."});
        visit(&S::bumps,
              Info{.name = "bumps", .min = 0, .max = 1, .doc = "Fine unevenness of the skin."});
        visit(&S::skin, Info{.name = "skin", .doc = "Texture of the skin, finer than bumps."});
        visit(&S::roughness,
              Info{.name = "roughness", .min = 0.05, .max = 1, .doc = "0 is polished, 1 is matt."});
        visit(
            &S::image,
            Info{.name = "image",
                 .most = 3000000,
                 .doc = "A PNG, JPEG or WebP of the stem unrolled (ground at the left, once round "
                        "from top to bottom), up to 2048 x 2048, used instead of the painting."});
    }
    bool operator==(const StemSurface&) const = default;
};

/// The veil: ring, warts, scales.
struct VeilSurface {
    Colour colour = {248, 244, 230};
    Colour tip = {240, 226, 190};
    double roughness = 0.85;
    double pits = 0.0;

    static constexpr void fields(auto visit) {
        visit(&VeilSurface::colour,
              Info{.name = "colour", .doc = "Colour of ring, warts and the base of scales."});
        visit(&VeilSurface::tip,
              Info{.name = "tip",
                   .doc = "Colour of the edge of the ring and the tips of warts and scales."});
        visit(&VeilSurface::roughness,
              Info{.name = "roughness", .min = 0.05, .max = 1, .doc = "0 is polished, 1 is matt."});
        visit(&VeilSurface::pits,
              Info{.name = "pits",
                   .min = 0,
                   .max = 1,
                   .doc = "How deeply the sponge of a receptacle's arms is pitted and chambered; 0 "
                          "is smooth."});
    }
    bool operator==(const VeilSurface&) const = default;
};

/// The flesh that a tear, a bite or a crack exposes.
struct FleshSurface {
    Colour colour = {244, 238, 222};
    double roughness = 0.9;

    static constexpr void fields(auto visit) {
        visit(&FleshSurface::colour,
              Info{.name = "colour", .doc = "Colour of the flesh under the skin."});
        visit(&FleshSurface::roughness,
              Info{.name = "roughness", .min = 0.05, .max = 1, .doc = "0 is polished, 1 is matt."});
    }
    bool operator==(const FleshSurface&) const = default;
};

/// The species' parameters of painted damage: colours, and how its skin fails.
struct DamageSurface {
    Colour faded = {226, 204, 160};
    Colour bruise = {132, 92, 58};
    Colour dust = {246, 240, 226};
    double cracking = 0.0;
    double peel_reach = 0.4;

    static constexpr void fields(auto visit) {
        using S = DamageSurface;
        visit(&S::faded,
              Info{.name = "faded", .doc = "Colour that sun and rain leave of the cap."});
        visit(&S::bruise, Info{.name = "bruise", .doc = "Colour where it was handled."});
        visit(&S::dust, Info{.name = "dust", .doc = "Colour of the spore print."});
        visit(&S::cracking,
              Info{.name = "cracking",
                   .min = -1,
                   .max = 1,
                   .doc = "0: the cap cracks as its growth has strained it; towards -1 into a net "
                          "of islands, towards 1 from the margin inwards."});
        visit(&S::peel_reach,
              Info{.name = "peel_reach",
                   .min = 0,
                   .max = 1,
                   .doc = "How far the skin can be peeled off, in shares of the cap's meridian "
                          "from the margin."});
    }
    bool operator==(const DamageSurface&) const = default;
};

/// Painting parameters of all parts; they replace the images I of [Desbenoit2004].
struct Surface {
    CapSurface cap;
    HymeniumSurface hymenium;
    StemSurface stem;
    VeilSurface veil;
    FleshSurface flesh;
    DamageSurface damage;

    static constexpr void fields(auto visit) {
        visit(&Surface::cap, Info{.name = "cap", .doc = "Upper face."});
        visit(&Surface::hymenium, Info{.name = "hymenium", .doc = "Lower face."});
        visit(&Surface::stem, Info{.name = "stem", .doc = "Stem."});
        visit(&Surface::veil, Info{.name = "veil", .doc = "Ring, warts and scales."});
        visit(&Surface::flesh, Info{.name = "flesh", .doc = "What tears lay open."});
        visit(&Surface::damage, Info{.name = "scars", .doc = "What weathering shows."});
    }
    bool operator==(const Surface&) const = default;
};

/// Material effects beyond colour and roughness: optional material extensions of the file.
struct Material {
    double slime = 0.0;
    double velvet = 0.0;
    double translucency = 0.0;
    Colour glow_colour = {150, 255, 190};

    static constexpr void fields(auto visit) {
        using S = Material;
        visit(
            &S::slime,
            Info{.name = "slime", .min = 0, .max = 1, .doc = "A clear coat of slime on the cap."});
        visit(&S::velvet, Info{.name = "velvet",
                               .min = 0,
                               .max = 1,
                               .doc = "Sheen of fine hairs against the light."});
        visit(&S::translucency,
              Info{.name = "translucency",
                   .unit = "m",
                   .min = 0,
                   .max = 0.02,
                   .doc = "Depth of flesh in which the light that passes through it falls to 1/e; "
                          "0: opaque. Files and pictures show it with materials=rich."});
        visit(&S::glow_colour,
              Info{.name = "glow_colour",
                   .doc = "Light from inside, where it glows; the skin's own colour filters it."});
    }
    bool operator==(const Material&) const = default;
};

}  // namespace sporeprint
