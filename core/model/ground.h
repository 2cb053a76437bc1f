// The ground that a mushroom brings along: the clod of soil round its foot, the litter that lies on
// it, strands of its mycelium. It does not grow, so it belongs to a species, not to a stage.
#pragma once

#include "core/params/describe.h"
#include "core/params/types.h"

namespace sporeprint {

/// A clod round the foot, and the lumps on it. Its colour is `surface.stem.soil_colour`.
struct SoilStyle {
    double reach = 0.01;
    double rise = 0.0015;
    int lumps = 0;
    double size = 0.002;

    static constexpr void fields(auto visit) {
        using S = SoilStyle;
        visit(&S::reach, Info{.name = "reach",
                              .unit = "m",
                              .min = 0.0001,
                              .max = 0.1,
                              .doc = "How far from the foot the clod and the litter reach."});
        visit(&S::rise, Info{.name = "rise",
                             .unit = "m",
                             .min = 0,
                             .max = 0.03,
                             .doc = "How high the soil rises at the stem."});
        visit(&S::lumps, Info{.name = "lumps",
                              .min = 0,
                              .max = 200,
                              .doc = "Lumps on the clod; 0 is no clod either. Coarse levels of "
                                     "detail have fewer."});
        visit(&S::size, Info{.name = "size",
                             .unit = "m",
                             .min = 0.0001,
                             .max = 0.03,
                             .doc = "Radius of the largest lumps."});
    }
    bool operator==(const SoilStyle&) const = default;
};

/// What litter consists of.
enum class LitterKind { leaves, needles, grass, moss, chips };

constexpr const char* name(LitterKind kind) {
    switch (kind) {
        case LitterKind::leaves:
            return "leaves";
        case LitterKind::needles:
            return "needles";
        case LitterKind::grass:
            return "grass";
        case LitterKind::moss:
            return "moss";
        case LitterKind::chips:
            return "chips";
    }
    return nullptr;
}

/// What lies or grows on the soil.
struct LitterStyle {
    LitterKind kind = LitterKind::leaves;
    int pieces = 0;
    int fallen = 0;
    double length = 0.015;
    Colour colour = {146, 106, 62};
    Colour aged = {86, 62, 42};

    static constexpr void fields(auto visit) {
        using L = LitterStyle;
        visit(&L::kind,
              Info{.name = "kind",
                   .doc = "Scraps of leaves, needles, blades of grass, shoots of moss, or chips of "
                          "wood."});
        visit(&L::pieces, Info{.name = "pieces",
                               .min = 0,
                               .max = 120,
                               .doc = "Their number; coarse levels of detail have fewer."});
        visit(&L::fallen,
              Info{.name = "fallen",
                   .min = 0,
                   .max = 16,
                   .doc = "Pieces that have fallen on the cap of a grown mushroom; none on forms "
                          "without a cap."});
        visit(&L::length, Info{.name = "length",
                               .unit = "m",
                               .min = 0.0005,
                               .max = 0.1,
                               .doc = "Length of the longest pieces."});
        visit(&L::colour, Info{.name = "colour", .doc = "Colour of the freshest pieces."});
        visit(&L::aged, Info{.name = "aged", .doc = "Colour of the oldest pieces."});
    }
    bool operator==(const LitterStyle&) const = default;
};

/// Strands of mycelium that leave the buried foot.
struct StrandStyle {
    int count = 0;
    double length = 0.02;
    Colour colour = {232, 226, 210};

    static constexpr void fields(auto visit) {
        using S = StrandStyle;
        visit(&S::count, Info{.name = "count", .min = 0, .max = 40, .doc = "Their number."});
        visit(&S::length, Info{.name = "length",
                               .unit = "m",
                               .min = 0.0005,
                               .max = 0.2,
                               .doc = "Length of the longest ones."});
        visit(&S::colour, Info{.name = "colour", .doc = "Their colour."});
    }
    bool operator==(const StrandStyle&) const = default;
};

/// The ground of a species; lengths are those at its mature size.
struct GroundStyle {
    SoilStyle soil;
    LitterStyle litter;
    StrandStyle strands;

    static constexpr void fields(auto visit) {
        using G = GroundStyle;
        visit(&G::soil, Info{.name = "soil", .doc = "The clod round the foot."});
        visit(&G::litter, Info{.name = "litter", .doc = "What lies or grows on the soil."});
        visit(&G::strands, Info{.name = "strands", .doc = "Strands of mycelium below."});
    }
    /// Returns true if nothing is there.
    [[nodiscard]] constexpr bool empty() const {
        return soil.lumps == 0 && litter.pieces == 0 && strands.count == 0;
    }
    bool operator==(const GroundStyle&) const = default;
};

}  // namespace sporeprint
