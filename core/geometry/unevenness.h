// A map of space that makes a swept body irregular: caps that are no circles, margins that lie in no
// plane, stems that are oval, swollen and winding.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "core/geometry/free_form.h"
#include "core/individual/individual.h"

namespace sporeprint {

/// The irregularity of an individual as one smooth map of space, so that gills, warts, rings and the
/// flesh of damage follow it, and nothing can pass through anything that it did not pass through
/// before.
///
/// Let w = x + iz be the place across the axis, R the greatest radius of the outline and q = w / R.
/// Between the ground and the lowest point of the cap the stem winds and swells: w' = w (1 + S(y)) +
/// K(y) + r phi(|u|^2) (a2(y) conj(u) + a3(y) conj(u)^2), where r is the greatest radius of the stem
/// and u = w / r: its cross section is an oval with a flat side that turns along it. phi(s) = 1 / (1 +
/// s^2 / 16) leaves a wide ring or volva alone. Then q' = q + c1 |q|^2 + sum over n = 2..5 of cn conj(q)^(n - 1), which adds cn cos(n
/// theta) to a circle of radius 1 in first order: c1 moves it beside the axis, c2 makes it oval, the
/// others give it n sides. Coefficients are chosen so that the outline has no corners: the sum of
/// (n^2 - 1) cn cos(n theta), by which its curvature differs from 1 in first order, is at most 0.7,
/// and at least -1.15, for the largest irregularity. At last y' = y + R h(y) Re(b1 q + b2 q^2 + b3
/// q^3), where h rises from 0 at the lowest point of the outline. All coefficients are proportional
/// to `deformation.irregularity`; at 0 the map is the identity.
///
/// q' is injective where 2 |c1| |q| + sum of (n - 1) |cn| |q|^(n - 2) < 1, up to 1.15 R even for the
/// largest coefficients, and y' increases with y.
class Unevenness {
  public:
    /// Coefficients come from the seed and the species; those of a mix are blended.
    explicit Unevenness(const Individual& individual);

    [[nodiscard]] bool identity() const { return !is_uneven_; }

    /// Maps points, and their directions by the Jacobian there.
    void apply(std::span<SurfacePoint> points) const;
    /// Maps positions in the same way.
    void apply(std::span<glm::dvec3> places) const;

    /// Returns an upper bound of the distance from the axis of the surface of a stem.
    ///
    /// radius  of the stem at rest, metres
    [[nodiscard]] double reach_of_stem(double radius) const;

  private:
    static constexpr std::size_t sides = 4;  ///< n = 2..5
    static constexpr std::size_t lifts = 3;  ///< powers of q
    static constexpr std::size_t waves = 4;  ///< of the stem
    static constexpr std::size_t ovals = 2;  ///< powers of conj(u)

    /// The terms of all maps that depend on the height alone, with derivatives by height.
    struct Level {
        double widening = 1.0, widening_by = 0.0;
        glm::dvec2 shift{0.0}, shift_by{0.0};             ///< metres
        std::array<glm::dvec2, ovals> oval{}, oval_by{};  ///< a2 and a3
        double lift = 0.0, lift_by = 0.0;                 ///< h
    };
    [[nodiscard]] Level level_at(double y) const;
    /// The deviation of the stem's cross section from a circle, metres, and its derivatives.
    struct Section {
        glm::dvec2 shift{0.0};  ///< r phi (a2 conj(u) + a3 conj(u)^2)
        glm::dvec2 by_height{0.0};
        glm::dvec2 turn{0.0};  ///< factor on the conjugate of a step of w
        glm::dvec2 fall{0.0};  ///< factor on the product of w and a step of it
    };
    [[nodiscard]] Section section_at(const Level& level, const glm::dvec2& w) const;
    template <class Directions>
    void move(glm::dvec3& position, Directions&& each_direction) const;

    bool is_uneven_ = false;
    double radius_ = 1.0;               ///< R, metres
    double low_ = 0.0, rise_ = 1.0;     ///< where the margin begins to lift, and over what height
    double base_ = 0.0, length_ = 0.0;  ///< of the stem below the cap
    glm::dvec2 beside_{0.0};            ///< c1
    std::array<glm::dvec2, sides> sides_{};
    std::array<glm::dvec2, lifts> lifts_{};
    std::array<glm::dvec2, waves> winding_{};  ///< metres
    std::array<double, waves> winding_from_{}, swelling_{}, swelling_from_{};
    double stem_radius_ = 0.0;  ///< r, metres; 0 without a stem
    std::array<glm::dvec2, ovals> oval_{}, oval_wave_{};
    std::array<double, ovals> oval_from_{};
};

}  // namespace sporeprint
