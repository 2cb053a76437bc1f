// The shape of an axis without its length, in the form in which axes mix: how its frame turns from station to station.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "core/model/swept.h"

namespace sporeprint {

/// An axis as rotations relative to one another: the first tips the vertical into the axis' own start, each other carries the frame
/// from one station to the next without twist. Stations stand at equal steps of arc length, so blends keep the length
/// whatever the curves do: opposite bends straighten.
class AxisCurve {
  public:
    static constexpr int stations = 96;  ///< steps; there is one station more

    /// A straight axis.
    AxisCurve() = default;

    /// The spline through control points, ground to top; straight for fewer than two places.
    explicit AxisCurve(const std::vector<AxisPoint>& controls);

    /// Adds `weight` times the turns of another axis; a blend is such a sum, begun with the straight axis.
    void add(const AxisCurve& other, double weight);

    /// Unit tangents at the stations.
    [[nodiscard]] std::vector<glm::dvec3> tangents() const;

    /// Largest turn between stations, radians over the whole length: curvature times length.
    [[nodiscard]] double greatest_turn() const;

    /// The same axis with each turn `by` times as far.
    [[nodiscard]] AxisCurve scaled(double by) const;

    bool operator==(const AxisCurve&) const = default;

  private:
    // Rotation vectors in the frame they act on; square to its tangent, so two components say all.
    std::array<glm::dvec2, stations + 1> turns_{};
};

/// `v` turned about the unit vector `about`.
[[nodiscard]] glm::dvec3 turned(const glm::dvec3& v, const glm::dvec3& about, double angle);

}  // namespace sporeprint
