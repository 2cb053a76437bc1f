// The axis S of a mushroom: a curve with rotation-minimising frames along which the outline is
// swept; it bends, twists and leans.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "core/individual/axis_curve.h"
#include "core/individual/individual.h"
#include "core/model/deformation.h"

namespace sporeprint {

/// Image of the plane of one height under the axial map, with its derivative by height; exact to
/// first order.
struct AxisStation {
    glm::dvec3 origin, x, y,
        z;  ///< images of the axis point and of the unit vectors; x and z include twist and taper
    glm::dvec3 d_origin, d_x, d_z;  ///< derivatives by height
    double height = 0.0;            ///< the height of this station, clamped to the span of the axis

    [[nodiscard]] glm::dvec3 point(const glm::dvec3& p) const {
        return origin + p.x * x + (p.y - height) * y + p.z * z;
    }
    /// Returns the image of a direction at p under the Jacobian of the axial map.
    [[nodiscard]] glm::dvec3 direction(const glm::dvec3& p, const glm::dvec3& v) const {
        return v.x * x + v.z * z + v.y * (d_origin + p.x * d_x + p.z * d_z);
    }
};

/// Azimuths of bend and lean of one individual, radians round the vertical.
struct AxisAngles {
    double bend = 0.0;
    double lean = 0.0;
};

/// Returns the random azimuths of an individual: means of those of its species, by their weights.
[[nodiscard]] AxisAngles axis_angles(const Individual& individual);

class Axis {
  public:
    /// curve      axis of the individual before bend and lean; it is scaled to the length of the
    ///            stem
    /// base, top  heights of the ends of the stem, metres, top > base; above `top` the frame is
    ///            constant, so caps stay rigid
    /// source     [Lazarus1994] axial deformation; [Wang2008] double reflection; zone of influence
    ///            along the axis
    Axis(const AxisCurve& curve, const DeformationOf<Plain>& deformation, const AxisAngles& angles,
         double base, double top);

    [[nodiscard]] AxisStation at(double height) const;

    /// Returns the same station as a rigid frame, so that what is attached there keeps its shape.
    [[nodiscard]] AxisStation frozen_at(double height) const;

    /// Returns the largest curvature, 1/m: a stem of radius r folds where curvature * r >= 1.
    [[nodiscard]] double greatest_curvature() const { return greatest_curvature_; }

  private:
    struct Frame {
        glm::dvec3 position, tangent, normal;
    };
    struct Local {
        glm::dvec3 origin, x, y, z;
    };
    [[nodiscard]] Local local(double height) const;

    DeformationOf<Plain> deformation_;
    double base_, top_;
    std::vector<Frame> frames_;
    double greatest_curvature_ = 0.0;
};

/// Transports a unit normal along a curve without twist.
///
/// positions, tangents  N >= 1 samples, unit tangents
/// first                unit normal at the first sample
/// returns              N unit normals; the error is O(h^4)
/// source               [Wang2008] sec. 4, double reflection
[[nodiscard]] std::vector<glm::dvec3> rotation_minimising_normals(
    const std::vector<glm::dvec3>& positions, const std::vector<glm::dvec3>& tangents,
    const glm::dvec3& first);

}  // namespace sporeprint
