// The axis S of a mushroom: a curve with rotation-minimising frames that carries the outline, bent, twisted and leaning.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "core/individual/axis_curve.h"
#include "core/model/deformation.h"

namespace sporeprint {

/// Where the axis takes the plane of one height, and how fast that changes with height. Exact to first order.
struct AxisStation {
    glm::dvec3 origin, x, y,
        z;  ///< images of the axis point and of the unit vectors; x and z carry twist and taper
    glm::dvec3 d_origin, d_x, d_z;  ///< their derivatives by height
    double height = 0.0;  ///< the height this station stands for, inside the axis' own span

    [[nodiscard]] glm::dvec3 point(const glm::dvec3& p) const {
        return origin + p.x * x + (p.y - height) * y + p.z * z;
    }
    /// Image of a direction at p: the Jacobian of the axial map.
    [[nodiscard]] glm::dvec3 direction(const glm::dvec3& p, const glm::dvec3& v) const {
        return v.x * x + v.z * z + v.y * (d_origin + p.x * d_x + p.z * d_z);
    }
};

/// Directions drawn for one individual, radians round the vertical.
struct AxisAngles {
    double bend = 0.0;
    double lean = 0.0;
};

class Axis {
  public:
    /// curve     the individual's own, before it bends and leans; it is given the stem's length
    /// base, top heights between which the stem lives, metres, top > base; above the top the frame is frozen, so caps stay rigid
    /// source    [Lazarus1994] axial deformation; [Wang2008] double reflection; zone of influence along the axis
    Axis(const AxisCurve& curve, const DeformationOf<Plain>& deformation, const AxisAngles& angles,
         double base, double top);

    [[nodiscard]] AxisStation at(double height) const;

    /// The same place as a rigid frame: what is attached there keeps its shape.
    [[nodiscard]] AxisStation frozen_at(double height) const;

    /// Largest curvature, 1/m: a stem of radius r folds where curvature * r >= 1.
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

/// Carries a unit normal along a curve without twist.
///
/// positions, tangents  N >= 1 samples, unit tangents; first  unit normal at the first sample
/// returns  N unit normals. error O(h^4)
/// source   [Wang2008] sec. 4, double reflection
[[nodiscard]] std::vector<glm::dvec3> rotation_minimising_normals(
    const std::vector<glm::dvec3>& positions, const std::vector<glm::dvec3>& tangents,
    const glm::dvec3& first);

}  // namespace sporeprint
