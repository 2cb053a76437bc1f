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

/// Height field over the outline revolved about its axis, metres, never positive: the sum of folds,
/// pits and tiers, with its derivatives. What is too fine for a level of detail is reduced here and
/// painted instead; folds and pits lower the face instead. All depths are scaled by one factor
/// if any would reach another face, the axis or the centre of curvature.
class Relief {
  public:
    Relief(const Individual& individual, const Detail& detail);

    /// Height along the outline's normal, metres, and its derivatives by share and by radian.
    struct Height {
        double value = 0.0, by_share = 0.0, by_angle = 0.0;
    };

    /// Returns true if the height is 0 on the whole part, as it is on all parts but the cap.
    [[nodiscard]] bool flat(Part part) const { return part != Part::cap || layers_.empty(); }

    /// Returns the height at a place.
    ///
    /// share        share of arc length along the part's sub-curve: on the cap 0 at the margin and
    ///              1 at the apex
    /// angle, turn  angle round the axis before azimuthal deformation, radians, and its sine and
    ///              cosine
    [[nodiscard]] Height at(Part part, double share, double angle, const SineCosine& turn) const;

  private:
    /// Depth in lengths of the meridian, and its derivatives.
    struct Depth {
        double value = 0.0, by_sigma = 0.0, by_angle = 0.0;
    };
    /// The relief of one species, and the shares of its coarser and finer folds and of its pits that
    /// are no finer than the mesh.
    struct Layer {
        ReliefStyle style;
        double folds = 1.0, fine_folds = 1.0, pits = 1.0;
    };
    void add_folds(Depth& depth, const Layer& layer, double sigma, const SineCosine& turn) const;
    void add_pits(Depth& depth, const Layer& layer, double sigma, double angle) const;

    /// Returns the factor on depths that keeps the face clear of everything else in every
    /// half-plane.
    [[nodiscard]] double available_depth(const Outline& outline) const;

    std::vector<Layer> layers_;
    std::array<std::uint32_t, 3> seeds_;
    double meridian_;
};

/// Value of 3D gradient noise (gradient_noise()) and its gradient.
struct NoiseSample {
    double value = 0.0;
    std::array<double, 3> by{};  ///< partial derivatives by the three coordinates
};
/// Returns the noise at a point; the lattice has a spacing of 1.
[[nodiscard]] NoiseSample noise_sample(const std::array<double, 3>& at, std::uint32_t seed);

/// Distance to the border of the pit at a place, in cells, with its derivatives by turn and row;
/// and the relative depth of this pit, 0.7..1.
struct PitSample {
    double border = 0.0, by_turn = 0.0, by_row = 0.0, deep = 1.0;
};
/// Returns the nearest pit of the honeycomb.
///
/// turn  angle round the axis in turns, 0..1
/// row   distance from the apex along the meridian, in rows of pits: 0..style.pit_rows
[[nodiscard]] PitSample pit_sample(const ReliefStyle& style, double turn, double row,
                                   std::uint32_t seed);

}  // namespace sporeprint
