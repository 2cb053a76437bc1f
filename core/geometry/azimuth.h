// A map of space round the axis that makes the radius of a mushroom depend on the angle: lateral
// fans, lobes, rays.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "core/geometry/free_form.h"
#include "core/individual/individual.h"
#include "core/math/elementary.h"
#include "core/params/blend.h"

namespace sporeprint {

/// Maps (r, y, theta) to (r', y', theta'): each half-plane through the axis goes to a half-plane,
/// r' increases with r and y' with y. So a simple outline stays simple in every half-plane,
/// whatever it is; the axis itself does not move.
///
/// Lobes are applied first, one species after another. Let q be the normalised distance from the
/// round core (r = c) to the widest circle (r = R) and K the lobe's reach. Then r' = c + (r - c) m
/// and y' = y0 + (y - y0) (1 + pull (m - 1)) with m = k + (1 - k) / (1 + q / s). The choice k = 6
/// K^2 / (1 + 5 K) and s = K / (1 + 5 K) makes m fall from 1 at the core, with slope 1 there, to K
/// at q = 1, and keeps r' increasing for every K > 0. Then each vertical line outside of the core is
/// lifted as a whole, by a height that grows with the square of its distance from the core.
/// The fan then does the same to r with its own core and reach; it also turns the half-planes
/// towards the front, where columns are seen most.
class AzimuthMap {
  public:
    /// columns  of the mesh; lobes too fine for them become a circle of the same area
    AzimuthMap(const Individual& individual, int columns);

    /// Returns true when the map is the identity.
    [[nodiscard]] bool identity() const { return layers_.empty() && !has_fan_; }

    /// Radius of the widest circle outside the core at an angle, relative to its radius at rest,
    /// and its derivative by angle; the same of its lift, metres.
    struct Reach {
        double value = 1.0, by_angle = 0.0;
        double lift = 0.0, lift_by_angle = 0.0;
    };

    /// Everything that depends on the angle alone; computed once per column.
    struct Column {
        SineCosine from, to;   ///< directions of the half-plane at rest and after the map
        double turning = 1.0;  ///< derivative of the mapped angle by the angle at rest
        std::array<Reach, most_blended> lobes;  ///< one per layer
        Reach fan;
    };
    [[nodiscard]] Column column(double angle) const;

    /// Maps a point that lies in the column's half-plane, and its two directions by the Jacobian
    /// there.
    void apply(SurfacePoint& point, const Column& column) const;

    /// Returns the image of any point.
    [[nodiscard]] glm::dvec3 moved(const glm::dvec3& point) const;

  private:
    /// The lobes of one species.
    struct Layer {
        Azimuth form;
        double root = 0.0;        ///< height towards which notches are pulled, metres
        bool carried = true;      ///< whether the mesh has enough columns for the lobes
        double mean_reach = 1.0;  ///< reach of the circle of equal area used otherwise
    };
    /// A point of a half-plane, and the derivatives of its image.
    struct Place {
        double r, y;
        double r_by_r = 1.0, r_by_angle = 0.0;
        double y_by_r = 0.0, y_by_y = 1.0, y_by_angle = 0.0;
    };
    [[nodiscard]] Place placed(double r, double y, const Column& column) const;
    /// Position among the lobes, 2 pi for each: odd multiples of pi are crests.
    struct Phase {
        double value, by_angle;
    };
    [[nodiscard]] Phase phase_of(const Layer& layer, double angle) const;
    [[nodiscard]] Reach lobe_at(const Layer& layer, double angle) const;
    /// Returns the angle to which a column at rest gathers at the crests of pointed lobes, and its
    /// derivative.
    [[nodiscard]] Phase gathered(double angle) const;
    [[nodiscard]] Reach fan_at(const SineCosine& direction, double turning) const;

    Azimuth azimuth_;
    std::vector<Layer> layers_;
    double radius_;
    bool has_fan_;
    double phase_, first_, second_, third_;
    double lift_phase_, second_lift_phase_;
};

}  // namespace sporeprint
