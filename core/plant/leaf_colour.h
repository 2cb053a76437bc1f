// Colours of a leaf: gradations by affinity and homothety, and their change in autumn.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

#include "core/params/describe.h"
#include "core/plant/venation.h"

namespace sporeprint {

/// The law that maps a ratio of 0..1 to a share of colour.
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

/// Returns the share of colour for a ratio: 0 at 0, 1 at 1, non-decreasing; flat at both ends
/// (soft), steep only near 1 (late) or near 0 (early), in four steps (banded).
[[nodiscard]] double gradation(GradationLaw law, double ratio);

/// The colours of one face of a leaf.
/// source  [Viennot1989] section 6.1: in each lobe an affinity (axis: its main vein; direction: its
///         side veins) and a homothety about the root
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

/// Returns the summer colours of a leaf some time before: as it unfolds, it has less green and more light passes.
///
/// spring  0: summer; 1: unfolding
[[nodiscard]] LeafColours unfolding(const LeafColours& summer, double spring);

/// The colours of a kind of leaf through the year: the upper face in summer, in its first and in
/// its last autumn colour, and how much paler the lower face is.
struct LeafPalette {
    LeafColours summer, turning, fallen;
    double paler_below = 0.35;
    double marks = 0.0;

    static constexpr void fields(auto visit) {
        using P = LeafPalette;
        visit(&P::summer, Info{.name = "summer", .doc = "Upper face in summer."});
        visit(&P::turning, Info{.name = "turning", .doc = "Upper face in full autumn colour."});
        visit(&P::fallen, Info{.name = "fallen", .doc = "Upper face on the ground."});
        visit(&P::paler_below, Info{.name = "paler_below",
                                    .min = 0,
                                    .max = 1,
                                    .doc = "How much paler the lower face is."});
        visit(&P::marks, Info{.name = "marks",
                              .min = 0,
                              .max = 1,
                              .doc = "How much of the limb is marked by insects and fungi: dry "
                                     "spots with pale rims."});
    }
    bool operator==(const LeafPalette&) const = default;
};
static_assert(well_described<LeafPalette>());

/// Returns how early a place turns in autumn: 1 at the border of the tip, which turns first, 0 at the root, which turns
/// last.
[[nodiscard]] double autumn_depth(const LaminaPlace& place);

/// The linear colour of snow in the light.
inline constexpr glm::dvec3 snow_light{0.80, 0.84, 0.89};

/// Maps positions on a lamina to colours; the colours of the palette are converted to linear light
/// once.
class LeafColourMap {
  public:
    explicit LeafColourMap(const LeafPalette& palette);

    /// The linear colours of both faces at a position, 0..1.
    struct Faces {
        glm::dvec3 upper, lower;
    };

    /// Returns the colours at a position. Leaves turn from border and tip inwards, veins last.
    ///
    /// autumn  0: summer; 0.5: turning; 1: fallen
    [[nodiscard]] Faces at(const LaminaPlace& place, double autumn) const;

  private:
    struct Season {
        LeafColours colours;
        glm::dvec3 vein, inner, border, tip;
        glm::dvec3 beyond;  ///< colour beyond the border
    };
    [[nodiscard]] static Season season(const LeafColours& colours);
    [[nodiscard]] static glm::dvec3 lamina_colour(const Season& season, const LaminaPlace& place);

    std::array<Season, 3> seasons_;  ///< summer, turning, fallen
    double paler_below_;
    double widest_;  ///< largest vein width, in summer and when fallen
};

/// Returns the colour of one face at one position.
[[nodiscard]] glm::dvec3 leaf_colour(const LeafPalette& palette, const LaminaPlace& place,
                                     double autumn, bool upper);

/// Returns the `autumn` of one of many leaves, which turns earlier or later by `spread` (0..1),
/// from its own random stream; 0 and 1 are the same for all.
[[nodiscard]] double leaf_autumn(double autumn, double spread, std::uint32_t seed,
                                 std::uint32_t leaf);

}  // namespace sporeprint
