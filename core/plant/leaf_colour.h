// Colours of a leaf as data for a painter: gradations by affinity and homothety, and what autumn makes of them.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

#include "core/params/describe.h"
#include "core/plant/venation.h"

namespace sporeprint {

/// How a ratio of 0..1 becomes a share of colour.
enum class GradationLaw { linear, soft, late, early, banded };

constexpr const char* name(GradationLaw law) {
    switch (law) {
        case GradationLaw::linear:
            return "linear";
        case GradationLaw::soft:
            return "soft";
        case GradationLaw::late:
            return "late";
        case GradationLaw::early:
            return "early";
        case GradationLaw::banded:
            return "banded";
    }
    return nullptr;
}

/// 0 at 0, 1 at 1, never falling; flat at both ends (soft), only near 1 (late), at once (early), in four steps (banded).
[[nodiscard]] double gradation(GradationLaw law, double ratio);

/// Colours of one face of a leaf.
/// source [Viennot1989] section 6.1: each lobe by an affinity (axis its main vein, direction its side veins) and a homothety about
/// the root
struct LeafColours {
    Colour vein{150, 176, 92};
    Colour inner{74, 116, 42};
    Colour border{98, 140, 52};
    Colour tip{112, 146, 58};
    double vein_width = 0.012;
    GradationLaw affinity = GradationLaw::soft;
    GradationLaw homothety = GradationLaw::late;
    double homothety_share = 0.4;

    static constexpr void fields(auto visit) {
        using C = LeafColours;
        visit(&C::vein, Info{.name = "vein", .doc = "Colour of veins."});
        visit(&C::inner, Info{.name = "inner", .doc = "Colour beside the main veins."});
        visit(&C::border, Info{.name = "border", .doc = "Colour at the border, by the affinity."});
        visit(&C::tip, Info{.name = "tip", .doc = "Colour far from the root, by the homothety."});
        visit(&C::vein_width, Info{.name = "vein_width",
                                   .min = 0,
                                   .max = 0.1,
                                   .doc = "Of a main vein at the root, in lengths of the limb."});
        visit(&C::affinity,
              Info{.name = "affinity", .doc = "From inner to border along the side veins."});
        visit(&C::homothety,
              Info{.name = "homothety", .doc = "To the tip's colour from the root outwards."});
        visit(&C::homothety_share, Info{.name = "homothety_share",
                                        .min = 0,
                                        .max = 1,
                                        .doc = "How much of the tip's colour is there at most."});
    }
    bool operator==(const LeafColours&) const = default;
};
static_assert(well_described<LeafColours>());

/// Colours of a kind of leaf through the year: the upper face in summer, in its first autumn colour and in its last, and how much
/// paler the lower one is.
struct LeafPalette {
    LeafColours summer, turning, fallen;
    double paler_below = 0.35;

    static constexpr void fields(auto visit) {
        using P = LeafPalette;
        visit(&P::summer, Info{.name = "summer", .doc = "Upper face in summer."});
        visit(&P::turning, Info{.name = "turning", .doc = "Upper face in full autumn colour."});
        visit(&P::fallen, Info{.name = "fallen", .doc = "Upper face on the ground."});
        visit(&P::paler_below, Info{.name = "paler_below",
                                    .min = 0,
                                    .max = 1,
                                    .doc = "How much paler the lower face is."});
    }
    bool operator==(const LeafPalette&) const = default;
};
static_assert(well_described<LeafPalette>());

/// Colours the places of one face after another; what a palette says is made linear once.
class LeafColourist {
  public:
    explicit LeafColourist(const LeafPalette& palette);

    /// Linear colours of both faces at a place, 0..1.
    struct Faces {
        glm::dvec3 upper, lower;
    };

    /// autumn   0 summer, 0.5 turning, 1 fallen. Leaves turn from their border and tip inwards, veins last
    [[nodiscard]] Faces at(const LaminaPlace& place, double autumn) const;

  private:
    struct Season {
        LeafColours colours;
        glm::dvec3 vein, inner, border, tip;
        glm::dvec3 beyond;  ///< of the lamina's border
    };
    [[nodiscard]] static Season season(const LeafColours& colours);
    [[nodiscard]] static glm::dvec3 blade(const Season& season, const LaminaPlace& place);

    std::array<Season, 3> seasons_;  ///< summer, turning, fallen
    double paler_below_;
    double widest_;  ///< of all veins in summer and when fallen
};

/// The same for one place.
[[nodiscard]] glm::dvec3 leaf_colour(const LeafPalette& palette, const LaminaPlace& place,
                                     double autumn, bool upper);

/// When one of many leaves turns: its own share of `autumn`, earlier and later by `spread` (0..1), from its own stream; 0 and 1
/// stay themselves for all.
[[nodiscard]] double leaf_autumn(double autumn, double spread, std::uint32_t seed,
                                 std::uint32_t leaf);

}  // namespace sporeprint
