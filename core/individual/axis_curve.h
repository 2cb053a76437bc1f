// The shape of an axis independent of its length, as rotations between stations, in which axes
// blend linearly.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "core/model/swept.h"

namespace sporeprint {

/// An axis as relative rotations: the first tips the vertical into the start of the axis, each
/// other one transports the frame from one station to the next without twist. Stations lie at equal
/// steps of arc length, so blends preserve the length whatever the curves are; opposite bends
/// cancel.
class AxisCurve {
  public:
    static constexpr int stations = 96;  ///< steps; there is one station more

    /// Builds a straight axis.
    AxisCurve() = default;

    /// Builds the spline through control points, ground to top; it is straight for fewer than two
    /// distinct points.
    explicit AxisCurve(const std::vector<AxisPoint>& controls);

    /// Adds `weight` times the rotations of another axis. A blend is such a sum, starting with the
    /// straight axis.
    void add(const AxisCurve& other, double weight);

    /// Returns the unit tangents at the stations.
    [[nodiscard]] std::vector<glm::dvec3> tangents() const;

    /// Returns the largest rotation between stations, radians over the whole length: curvature
    /// times length.
    [[nodiscard]] double greatest_turn() const;

    /// Returns the same axis with each rotation multiplied by `by`.
    [[nodiscard]] AxisCurve scaled(double by) const;

    bool operator==(const AxisCurve&) const = default;

  private:
    // Rotation vectors in the frame that they act on; they are perpendicular to its tangent, so two
    // components suffice.
    std::array<glm::dvec2, stations + 1> turns_{};
};

/// Returns `v` rotated about the unit vector `about` by `angle` radians.
[[nodiscard]] glm::dvec3 turned(const glm::dvec3& v, const glm::dvec3& about, double angle);

}  // namespace sporeprint
