// Relief of the upper face: heights along the outline's normal, by place, with derivatives.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/individual/individual.h"
#include "core/individual/relief.h"
#include "core/math/elementary.h"
#include "core/mesh/detail.h"
#include "core/surface/charts.h"

namespace sporeprint {

/// Height field over the outline revolved about its axis, metres: a sum of sources, each with its
/// derivatives. Sources too fine for a level of detail are reduced, and painted instead. All depths
/// are scaled down where they would reach another face, the axis or the centre of curvature.
class Relief {
  public:
    Relief(const Individual& individual, const Detail& detail);

    struct Height {
        double value = 0.0, by_share = 0.0, by_angle = 0.0;
    };

    [[nodiscard]] bool flat(Part part) const { return part != Part::cap || styles_.empty(); }

    /// Returns the height at a place.
    ///
    /// share        along the part's sub-curve, base to apex
    /// angle, turn  angle at rest, and its sine and cosine
    [[nodiscard]] Height at(Part part, double share, double angle, const SineCosine& turn) const;

  private:
    /// Depth in lengths of the meridian, and its derivatives.
    struct Depth {
        double value = 0.0, by_sigma = 0.0, by_angle = 0.0;
    };
    void add_folds(Depth& depth, const ReliefStyle& style, double sigma,
                   const SineCosine& turn) const;
    void add_pits(Depth& depth, const ReliefStyle& style, double sigma, double angle) const;

    /// Returns the factor on depths that keeps the face clear of everything else in every
    /// half-plane.
    [[nodiscard]] double available_depth(const Outline& outline) const;

    std::vector<ReliefStyle> styles_;
    std::array<std::uint32_t, 3> seeds_;
    double meridian_;
};

/// Value of gradient_noise() in space, with its derivatives.
struct NoiseSample {
    double value = 0.0;
    std::array<double, 3> by{};
};
[[nodiscard]] NoiseSample noise_sample(const std::array<double, 3>& at, std::uint32_t seed);

/// Distance to the border of the pit at a place, in cells, with its derivatives by turn and row;
/// and the relative depth of this pit, 0.7..1.
struct PitSample {
    double border = 0.0, by_turn = 0.0, by_row = 0.0, deep = 1.0;
};
[[nodiscard]] PitSample pit_sample(const ReliefStyle& style, double turn, double row,
                                   std::uint32_t seed);

}  // namespace sporeprint
