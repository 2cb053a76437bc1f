// The veins of a leaf and the border that follows from them: Viennot's leaf, flat.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "core/math/elementary.h"
#include "core/params/describe.h"

namespace sporeprint {

/// How long an edge of the venation is, by its distance d in edges from its beginning to the tip of its main vein.
enum class LengthLaw { constant, linear, logarithmic };

constexpr const char* name(LengthLaw law) {
    switch (law) {
        case LengthLaw::constant:
            return "constant";
        case LengthLaw::linear:
            return "linear";
        case LengthLaw::logarithmic:
            return "logarithmic";
    }
    return nullptr;
}

/// What a leaf's veins and border are made from.
/// source [Viennot1989] section 6.1; beyond it: base_deg, side_length, narrow_base, narrow_tip, sinus, pointed,
/// teeth
struct Venation {
    Choice<1, 3, 5, 7, 9, 11, 13> lobes{1};
    int nodes = 8;
    double node_loss = 1.0;
    double vein_deg = 45.0;
    double side_deg = 45.0;
    double base_deg = 0.0;
    LengthLaw law = LengthLaw::logarithmic;
    double rise = 1.0;
    double side_length = 1.0;
    double narrow_base = 0.0;
    double narrow_tip = 0.0;
    double border = 1.15;
    double sinus = 0.0;
    double smooth = 1.0;
    double pointed = 0.5;
    double teeth = 0.0;
    int teeth_per_vein = 2;

    static constexpr void fields(auto visit) {
        using V = Venation;
        visit(&V::lobes, Info{.name = "lobes",
                              .doc = "Main veins that leave the petiole; 1 is a simple leaf."});
        visit(&V::nodes, Info{.name = "nodes",
                              .min = 2,
                              .max = 24,
                              .doc = "Nodes on the middle main vein, its tip included."});
        visit(&V::node_loss, Info{.name = "node_loss",
                                  .min = 0,
                                  .max = 8,
                                  .doc = "How many fewer on each main vein farther out."});
        visit(&V::vein_deg, Info{.name = "vein_deg",
                                 .unit = "deg",
                                 .min = 8,
                                 .max = 80,
                                 .doc = "Angle between two neighbouring main veins."});
        visit(&V::side_deg, Info{.name = "side_deg",
                                 .unit = "deg",
                                 .min = 15,
                                 .max = 88,
                                 .doc = "Angle between a side vein and its main vein."});
        visit(&V::base_deg,
              Info{.name = "base_deg",
                   .unit = "deg",
                   .min = 0,
                   .max = 75,
                   .doc = "How much farther back the outermost side veins stand at the petiole, as "
                          "far as it leaves room: a rounded or heart-shaped base."});
        visit(&V::law, Info{.name = "law", .doc = "How edges shorten towards the tip."});
        visit(&V::rise, Info{.name = "rise",
                             .min = 0,
                             .max = 4,
                             .doc = "A of the law A d + B or A ln(1 + d) + B, in lengths of B."});
        visit(&V::side_length,
              Info{.name = "side_length",
                   .min = 0.05,
                   .max = 8,
                   .doc = "Length of side veins in edges of the main vein, by the same law."});
        visit(&V::narrow_base,
              Info{.name = "narrow_base",
                   .min = 0,
                   .max = 1,
                   .doc = "How far side veins shorten towards the petiole again; 1 to nothing."});
        visit(&V::narrow_tip,
              Info{.name = "narrow_tip",
                   .min = 0,
                   .max = 0.95,
                   .doc = "How far side veins shorten towards the tip, beyond the law."});
        visit(&V::border, Info{.name = "border",
                               .min = 1,
                               .max = 2,
                               .doc = "How far beyond its end the border crosses a vein, in "
                                      "lengths of its last edge."});
        visit(&V::sinus, Info{.name = "sinus",
                              .min = 0,
                              .max = 0.95,
                              .doc = "How deep the border comes in between two side veins; near 1 "
                                     "a frond."});
        visit(&V::smooth, Info{.name = "smooth",
                               .min = 0,
                               .max = 1,
                               .doc = "0 a polygon from vein to vein, 1 a smooth border."});
        visit(&V::pointed, Info{.name = "pointed",
                                .min = 0,
                                .max = 1,
                                .doc = "How sharp the border stands at the ends of veins."});
        visit(&V::teeth, Info{.name = "teeth",
                              .min = 0,
                              .max = 1,
                              .doc = "Depth of the teeth of the border, in half their lengths."});
        visit(&V::teeth_per_vein, Info{.name = "teeth_per_vein",
                                       .min = 1,
                                       .max = 6,
                                       .doc = "Teeth from one side vein to the next."});
    }
    bool operator==(const Venation&) const = default;

    /// Outermost lobes that would meet behind the petiole, side veins too flat to reach a neighbour.
    void check(const std::string& path, std::vector<Problem>& problems) const;
};
static_assert(well_described<Venation>());

/// Half of a lobe, on one side of its main vein. A place in it is a foot on the main vein and a height above it along the
/// direction that a side vein has there: the affinity of the source, in which the border is a function of the foot.
struct HalfLobe {
    /// Angle from the main vein to the ray from the root that this half never crosses.
    double limit = 0.0;
    /// Foot up to which it is joined to its neighbour along that ray; 0 for the two outermost.
    double joined = 0.0;
    struct SideVein {
        double foot = 0.0, length = 0.0;
    };
    std::vector<SideVein> side_veins;  ///< from the root to the tip
    /// The border from the root (0, 0) to the tip (reach, 0): feet ascend, heights are above 0 between.
    std::vector<double> feet, heights;

    [[nodiscard]] double height(double foot) const;
};

/// A lobe: a main vein from the root, its side veins and the border around both.
struct Lobe {
    double turn = 0.0;          ///< of its main vein from the middle one, radians, to the left
    std::vector<double> nodes;  ///< along the main vein, from the first after the root to its tip
    double reach = 0.0;         ///< foot of the tip of its border
    /// Of side veins, left and right: at the tip and, never flatter, at the root. Radians; those of the outermost halves keep
    /// clear of the petiole's line.
    std::array<double, 2> side_angle{}, base_angle{};
    std::array<HalfLobe, 2> halves;  ///< left and right

    /// Angle of side veins at a foot, left (0) or right (1).
    [[nodiscard]] double angle(std::size_t side, double foot) const;
    /// In the plane of the lamina: x to the right, y along the middle main vein.
    [[nodiscard]] glm::dvec2 place(std::size_t side, double foot, double height) const;
};

/// The lamina of a leaf in its plane: root at the origin, the tip of the middle lobe's border at (0, 1).
struct Lamina {
    std::vector<Lobe> lobes;  ///< from the rightmost to the leftmost
};

/// A vein, from its node to its end.
struct Vein {
    std::size_t lobe = 0;
    bool main = false;
    std::size_t side = 0;  ///< of a side vein: 0 left, 1 right
    glm::dvec2 from{0.0}, to{0.0};
};

/// Lays out veins and border. Of two veins that cross the one on the outer lobe is deleted, of a main and a side vein the latter.
///
/// steps    places of the border from one of its corners to the next, at least 1; from 2 on where there are teeth, a tip and
///          a notch each. 1 is the polygon of the source: no curves, no teeth
/// returns  halves that share nothing but their main vein and the rays between lobes, so that the border is a simple polygon
/// throws   InvalidInput with what check() finds
/// source   [Viennot1989] section 6.1; differs: lobes part along the ray on which both borders cross it last at one place,
///          not by a search for crossings of their borders
[[nodiscard]] Lamina lamina_of(const Venation& venation, int steps);

/// Every vein that was not deleted, main veins first.
[[nodiscard]] std::vector<Vein> veins_of(const Lamina& lamina);

/// The border of the whole lamina, counter-clockwise from the root, no place twice.
[[nodiscard]] std::vector<glm::dvec2> border_of(const Lamina& lamina);

/// Where in the lamina a point of its plane lies: what a colour gradation, a relief or a painter asks for.
struct LaminaPlace {
    bool inside = false;
    std::size_t lobe = 0, side = 0;
    double foot = 0.0, height = 0.0;
    double affinity = 0.0;  ///< height over that of the border: 0 on the main vein, 1 on the border
    double homothety = 0.0;  ///< 0 at the root, 1 on the border, along the ray from the root
    double from_main = 0.0;  ///< distance from the main vein
    double from_side =
        1e9;  ///< distance from the line of the nearest side vein; 1e9 if there is none
    double along_side = 0.0;  ///< height over the length of that vein
};

/// Answers places of one lamina; what can be known beforehand is.
class LaminaReader {
  public:
    /// What is known of the last point asked for, from which one beside it is found at once. A trail is no part of an answer, but for
    /// its rounding.
    struct Trail {
        std::size_t direction = 0, half = 0, corner = 0, vein = 0;
        std::array<double, 3> feet{};  ///< the last ones on this half, newest first
        std::size_t known = 0;         ///< of them
    };

    explicit LaminaReader(Lamina lamina);
    [[nodiscard]] LaminaPlace at(const glm::dvec2& point) const;
    /// The same, for points in even steps along a line.
    [[nodiscard]] LaminaPlace at(const glm::dvec2& point, Trail& trail) const;
    [[nodiscard]] const Lamina& lamina() const { return lamina_; }

  private:
    /// Direction of side veins at the root and the tip, and whether they are one; how steep the border is from each corner on.
    struct Half {
        SineCosine root{0.0, 1.0}, tip{0.0, 1.0};
        double cotangent = 0.0;
        bool parallel = true;
        std::vector<double> slopes;
    };
    [[nodiscard]] double turn_of(const glm::dvec2& point, double distance, Trail& trail,
                                 double& reach) const;
    [[nodiscard]] double border_over(const HalfLobe& half, double foot, Trail& trail) const;

    Lamina lamina_;
    std::vector<SineCosine> turns_;  ///< of each lobe
    std::vector<Half> halves_;       ///< 2 lobe + side
    std::vector<glm::dvec2> rays_;   ///< directions from the root
    std::vector<double> reach_;      ///< farthest place of the border along each
};

}  // namespace sporeprint
