// How the radius of a mushroom depends on the angle: fans that grow from one side, lobes, rays. A map of space round the axis.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "core/geometry/free_form.h"
#include "core/individual/individual.h"
#include "core/math/elementary.h"
#include "core/params/blend.h"

namespace sporeprint {

/// Moves (r, y, theta) to (r', y', theta'): each half-plane through the axis onto a half-plane, r' rising with r and y' with y.
/// So an outline that is simple stays simple in every half-plane, whatever it is; nothing moves at the axis.
///
/// Lobes come first, those of one species after another: with q the share of the way from the round core (r = c) to the widest circle (r = R), K the lobe's reach,
/// r' = c + (r - c) m and y' = y0 + (y - y0) (1 + pull (m - 1)), m = k + (1 - k) / (1 + q / s). k = 6 K^2 / (1 + 5 K) and
/// s = K / (1 + 5 K) make m fall from 1 at the core, with slope 1 there, to K at q = 1, and r' rise for every K > 0.
/// Then the fan does the same to r with its own core and reach; it also turns the half-planes towards the front, where most is seen.
class AzimuthMap {
  public:
    /// columns  of the mesh: lobes that they cannot carry become a circle of the same area
    AzimuthMap(const Individual& individual, int columns);

    /// Whether nothing moves at all.
    [[nodiscard]] bool identity() const { return layers_.empty() && !has_fan_; }

    /// Reach at an angle: how far outside the core the widest circle goes, over what it went at rest; and its derivative.
    struct Reach {
        double value = 1.0, by_angle = 0.0;
    };

    /// All that depends on the angle alone; worked out once for a column.
    struct Column {
        SineCosine from, to;   ///< of the half-plane at rest and of where it goes
        double turning = 1.0;  ///< derivative of the angle gone to by the angle at rest
        std::array<Reach, most_blended> lobes;  ///< of each layer
        Reach fan;
    };
    [[nodiscard]] Column column(double angle) const;

    /// Moves a point that lies in the column's half-plane, and its two directions by the Jacobian there.
    void apply(SurfacePoint& point, const Column& column) const;

    /// Moves any point.
    [[nodiscard]] glm::dvec3 moved(const glm::dvec3& point) const;

  private:
    /// The lobes of one species.
    struct Layer {
        Azimuth form;
        double root = 0.0;        ///< height that notches draw back to, metres
        bool carried = true;      ///< by the columns
        double mean_reach = 1.0;  ///< of the circle that they are otherwise
    };
    /// A place of a half-plane and the derivatives of where it goes.
    struct Place {
        double r, y;
        double r_by_r = 1.0, r_by_angle = 0.0;
        double y_by_r = 0.0, y_by_y = 1.0, y_by_angle = 0.0;
    };
    [[nodiscard]] Place placed(double r, double y, const Column& column) const;
    [[nodiscard]] Reach lobe_at(const Layer& layer, double angle) const;
    [[nodiscard]] Reach fan_at(const SineCosine& direction, double turning) const;

    Azimuth azimuth_;
    std::vector<Layer> layers_;
    double radius_;
    bool has_fan_;
    double phase_, first_, second_, third_;
};

}  // namespace sporeprint
