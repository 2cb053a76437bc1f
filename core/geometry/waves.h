// Waves of the margin, which has grown longer than its circle.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/math/elementary.h"

namespace sporeprint {

/// Height added at a share of a face (0 centre, 1 margin) by the waves of the margin, with
/// derivatives.
class Waves {
  public:
    Waves(double amount, double cap_radius, int columns, std::uint32_t seed);

    struct Value {
        double height = 0.0, by_share = 0.0, by_angle = 0.0;
    };
    [[nodiscard]] bool flat() const { return amplitude_ == 0.0; }
    [[nodiscard]] Value at(double share, double angle) const { return at(share, phases(angle)); }

    /// Phases of the waves at an azimuth; computed once per column.
    using Phases = std::array<SineCosine, 3>;
    [[nodiscard]] Phases phases(double angle) const;
    [[nodiscard]] Value at(double share, const Phases& phases) const;

  private:
    struct Mode {
        int count;
        double size, phase, from;
    };
    double amplitude_;
    std::vector<Mode> modes_;
};

}  // namespace sporeprint
