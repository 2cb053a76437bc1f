// Waves of the edges of flat segments.
#pragma once

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "core/geometry/tube.h"
#include "core/math/elementary.h"

namespace sporeprint {

/// The waves of the two edges of a flat segment, against each other as of a twisted ribbon. They are
/// linear in the sum of squares that flattens the segment, so that it may turn into another plane
/// without a jump.
class Ruffle {
  public:
    /// amount  0..1; phase: of the segment
    Ruffle(double amount, double phase) : amount_(amount), phase_(phase) {}

    /// Moves on to the next ring of the segment.
    void advance(const Station& station) {
        const double width = station.radius * (station.wide - station.thin);
        size_ = amount_ * ruffle_size * width;
        if (size_ <= 0.0) return;
        if (begun_) {
            const double turn = std::min(2.0 * pi * glm::distance(station.at, last_) /
                                             (ruffle_length * station.radius * station.wide),
                                         most_ruffle_turn);
            phase_ += turn;
            turned_ += turn;
        }
        // Waves grow from nothing, since a segment begins with the last ring of what bears it.
        size_ *= std::min(turned_ / most_ruffle_turn, 1.0);
        along_ = station.along;
        flat_ = station.flat;
        last_ = station.at;
        begun_ = true;
    }

    /// Returns the displacement of the corner in a direction from the middle of the ring, metres.
    [[nodiscard]] glm::dvec3 displacement(const glm::dvec3& out) const {
        if (size_ <= 0.0) return glm::dvec3(0.0);
        return size_ * sine(phase_) * glm::cross(along_, flat_ * out);
    }

  private:
    /// Size of the waves in widths of the segment, their length in its half widths, and the largest
    /// turn from one ring to the next, beyond which they would alias.
    static constexpr double ruffle_size = 0.6, ruffle_length = 3.8, most_ruffle_turn = 1.5;

    double amount_, phase_, turned_ = 0.0, size_ = 0.0;
    glm::dvec3 along_{0.0}, last_{0.0};
    glm::dmat3 flat_{0.0};
    bool begun_ = false;
};

}  // namespace sporeprint
