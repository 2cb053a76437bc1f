// The veins of a leaf and the border that follows from them, as in [Viennot1989], in the plane.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "core/math/elementary.h"
#include "core/params/describe.h"

namespace sporeprint {

/// The law by which the length of an edge of a vein depends on d, the number of edges from its
/// start to the tip of its main vein: constant, linear or logarithmic in d.
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

/// The parameters of a leaf's veins and border.
/// source  [Viennot1989] section 6.1; additional: base_deg, side_length, narrow_base, narrow_tip,
///         sinus, pointed, teeth, unevenness, asymmetry, arch, net
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
    double unevenness = 0.0;
    double asymmetry = 0.0;
    double arch = 0.0;
    double net = 0.0;

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
        visit(&V::unevenness, Info{.name = "unevenness",
                                   .min = 0,
                                   .max = 1,
                                   .doc = "How unlike teeth and side veins are in length."});
        visit(&V::asymmetry,
              Info{.name = "asymmetry",
                   .min = 0,
                   .max = 1,
                   .doc = "How far the side veins of both halves stand one after the "
                          "other; 1 half-way between. Lobes and halves differ as much in size."});
        visit(&V::arch, Info{.name = "arch",
                             .min = 0,
                             .max = 0.6,
                             .doc = "How far side veins leave their main vein more steeply than "
                                    "they run on, and arch towards the tip."});
        visit(&V::net, Info{.name = "net",
                            .min = 0,
                            .max = 1,
                            .doc = "How far veins of third order show, which join the side veins, "
                                   "and the net between them."});
    }
    bool operator==(const Venation&) const = default;

    /// Reports outermost lobes that would meet behind the petiole, and side veins too flat to reach
    /// a neighbour.
    void check(const std::string& path, std::vector<Problem>& problems) const;
};
static_assert(well_described<Venation>());

/// Half of a lobe, on one side of its main vein. It has oblique coordinates: the line through a
/// point in the direction of the side veins there meets the main vein at the abscissa of the point
/// (distance from the root along the main vein), and the height of the point is its distance from
/// the main vein along that line. In these coordinates, the affinity of the source, the border is a
/// function of the abscissa. Lengths are in units of the reach of the middle lobe.
struct HalfLobe {
    /// Angle from the main vein, radians, of the ray from the root that separates this half from
    /// its neighbour (outermost halves: from the petiole). The half lies between main
    /// vein and ray.
    double limit = 0.0;
    /// Abscissa up to which it is joined to its neighbour along that ray; 0 for the outermost
    /// halves.
    double joined = 0.0;
    struct SideVein {
        double abscissa = 0.0, length = 0.0;
        double arch = 0.0;  ///< slope at its start, towards the root, of its line over the heights

        /// Returns the abscissa of the drawn vein at a height: it begins at its node and ends where
        /// the straight vein ends, but sags towards the root between both.
        [[nodiscard]] double line(double height) const {
            return height < length ? abscissa - arch * height * (1.0 - height / length) : abscissa;
        }
    };
    std::vector<SideVein> side_veins;  ///< from the root to the tip
    /// The border from the root (0, 0) to the tip (reach, 0): ascending abscissas, positive heights
    /// between the ends.
    std::vector<double> abscissas, heights;

    /// Returns the height of the border at an abscissa, linear between its points; 0 beyond its
    /// ends.
    [[nodiscard]] double height(double abscissa) const;
};

/// A lobe: a main vein from the root, its side veins and the border around both.
struct Lobe {
    double turn = 0.0;          ///< of its main vein from the middle one, radians to the left
    std::vector<double> nodes;  ///< along the main vein, from the first after the root to its tip
    double reach = 0.0;         ///< abscissa of the tip of its border
    /// Angles of side veins, left and right, radians: at the tip and, never smaller, at the root.
    /// Those of the outermost halves keep clear of the petiole's line.
    std::array<double, 2> side_angle{}, base_angle{};
    std::array<HalfLobe, 2> halves;  ///< left and right

    /// Returns the angle between main vein and side veins at an abscissa on a side, 0 left or 1
    /// right, radians.
    [[nodiscard]] double angle(std::size_t side, double abscissa) const;
    /// Returns the position of a point of a half in the plane of the lamina: x to the right, y
    /// along the middle main vein.
    [[nodiscard]] glm::dvec2 place(std::size_t side, double abscissa, double height) const;
};

/// The lamina of a leaf in its plane: the root is at the origin and the tip of the middle lobe's
/// border at (0, 1).
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

/// Lays out veins and border. If two veins cross, the one on the outer lobe is deleted; of a main
/// and a side vein the latter.
///
/// steps    number of edges of the border from one of its corners to the next, at least 1. A border
///          with teeth has tooth_edges(steps) edges per tooth instead if steps is 2 or more. 1 gives
///          the polygon of the source, without curves and teeth
/// returns  halves that share only their main vein and the rays between lobes, so that the border
///          is a simple polygon
/// throws   InvalidInput with all that check() reports
/// source   [Viennot1989] section 6.1; differs: neighbouring lobes are divided by the ray on which
///          both borders have their last crossing at one point, not by a search for intersections
///          of their borders
[[nodiscard]] Lamina lamina_of(const Venation& venation, int steps);

/// Returns the number of edges per tooth: 2, straight ones; with many steps 4, for a convex back and
/// a hollow front.
constexpr int tooth_edges(int steps) { return steps >= 5 ? 4 : 2; }

/// Returns every vein that was not deleted, main veins first.
[[nodiscard]] std::vector<Vein> veins_of(const Lamina& lamina);

/// Returns the border of the whole lamina, counter-clockwise from the root, each point once.
[[nodiscard]] std::vector<glm::dvec2> border_of(const Lamina& lamina);

/// Coordinates of a point of the plane relative to the lamina, for colour gradations, relief and
/// painting. Lengths are in units of the reach of the middle lobe.
struct LaminaPlace {
    bool inside = false;
    std::size_t lobe = 0, side = 0;
    double abscissa = 0.0, height = 0.0;
    double affinity = 0.0;  ///< height over that of the border: 0 on the main vein, 1 on the border
    /// Distance from the root over that of the border along the same ray: 0 at the root, 1 on the
    /// border and beyond.
    double homothety = 0.0;
    double from_main = 0.0;  ///< distance from the main vein
    /// Distance from the drawn line of the nearest side vein of this half; 1e9 if it has none.
    double from_side = 1e9;
    double along_side = 0.0;  ///< height divided by the length of that vein
    /// How far a vein of third order or the net is here, 0..1; painters set it.
    double net = 0.0;
};

/// Computes the coordinates of points of one lamina; everything that does not depend on the point
/// is computed once.
class LaminaSampler {
  public:
    /// State of the previous lookup, which speeds up the lookup of a point next to it. It affects
    /// results by rounding only.
    struct Hint {
        std::size_t direction = 0, half = 0, corner = 0, vein = 0;
        std::array<double, 3> abscissas{};  ///< previous ones on this half, newest first
        std::size_t known = 0;              ///< how many of them are valid
    };

    explicit LaminaSampler(Lamina lamina);
    /// Returns the coordinates of a point, also of one outside of the lamina.
    [[nodiscard]] LaminaPlace at(const glm::dvec2& point) const;
    /// Returns the same, but faster for successive points in equal steps along a line. Updates
    /// `hint`, which begins as Hint().
    [[nodiscard]] LaminaPlace at(const glm::dvec2& point, Hint& hint) const;
    [[nodiscard]] const Lamina& lamina() const { return lamina_; }

  private:
    /// Directions of side veins at the root and the tip, whether they are equal, and the slope of
    /// the border from each corner on.
    struct Half {
        SineCosine root{0.0, 1.0}, tip{0.0, 1.0};
        double cotangent = 0.0;
        bool parallel = true;
        std::vector<double> slopes;
    };
    [[nodiscard]] double turn_of(const glm::dvec2& point, double distance, Hint& hint,
                                 double& reach) const;
    [[nodiscard]] double border_over(const HalfLobe& half, double abscissa, Hint& hint) const;
    static SineCosine line_through(const Lobe& lobe, const Half& known, double along,
                                   double at_root, Hint& hint, LaminaPlace& place);
    static void measure_side_vein(const HalfLobe& half, const SineCosine& at, Hint& hint,
                                  LaminaPlace& place);

    Lamina lamina_;
    std::vector<SineCosine> turns_;  ///< direction of each lobe
    std::vector<Half> halves_;       ///< indexed by 2 lobe + side
    std::vector<glm::dvec2> rays_;   ///< directions from the root
    std::vector<double> reach_;      ///< largest distance of the border along each
};

}  // namespace sporeprint
