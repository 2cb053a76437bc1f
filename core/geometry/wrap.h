// Brackets meet the wood that they grow on: they thicken at their base and follow the trunk.
#pragma once

#include <array>
#include <cstdint>
#include <utility>

#include "core/individual/individual.h"
#include "core/mesh/mesh.h"

namespace sporeprint {

/// Thickens what grows on a flat wall, z = 0, where it meets the wall: heights over and under a
/// middle are multiplied by a factor that falls to 1 in front and to both sides. Flesh below the
/// middle runs farther down the wall than that above it runs up, and unevenly along x.
class BracketBase {
  public:
    /// individual  grows from a wall; without a base of its model, nothing is moved
    explicit BracketBase(const Individual& individual);

    /// middle  height of the margin, metres
    /// reach   how far in front of the wall the base ends, metres; > 0
    /// half    half of its width, metres; > 0
    /// amount  factor at the wall, less 1, under the middle; >= 0
    BracketBase(double middle, double reach, double half, double amount, std::uint32_t seed);

    void apply(Mesh& mesh) const;

    /// Returns heights between which the base lies, metres.
    ///
    /// low, high  those of the bracket without it
    [[nodiscard]] std::pair<double, double> range(double low, double high) const;

  private:
    double middle_ = 0.0, reach_ = 0.0, half_ = 0.0, amount_ = 0.0;
    std::array<double, 2> phases_{};
};

/// Bends what grows on a flat wall, z = 0, round an upright trunk whose bark touches the wall along
/// the y axis: at the wall, points move back by their distance from the trunk, and less and less the
/// farther they are in front of it. Every line along z keeps the order of its points, so that no
/// surface comes to cross itself.
///
/// radius  of the trunk, metres; from 0.8 of it to either side on, the trunk goes on straight.
///         0: the wall stays flat
void wrap_round_trunk(Mesh& mesh, double radius);

}  // namespace sporeprint
