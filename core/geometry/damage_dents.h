// Lumps and furrows of a damaged surface: height at a place, for the body itself and for everything
// that stands on it.
#pragma once

#include <vector>

#include "core/individual/damage.h"
#include "core/individual/individual.h"

namespace sporeprint {

/// Depth of a full furrow, in mean radii of the stem.
inline constexpr double furrow_deep = 0.20;

/// Fraction of furrow depth on the upper part of a club that is geometry; the club has few rings
/// there, so the rest is painted.
inline constexpr double club_carried = 0.35;

/// Returns the relative depth of a furrow at an angle, 0..1: 1 at its middle, 0 beyond its sides.
[[nodiscard]] double furrow_valley(double middle, double angle);

/// Returns the mean distance of the stem's surface from the axis, metres.
[[nodiscard]] double mean_radius(const SubCurve& stem);

/// Returns how far the stem may be displaced, 0..1: it falls to 0 at its ends, which are shared
/// with other faces. share is 0 at the ground.
[[nodiscard]] double stem_freedom(double share);

/// Height field of lumps and furrows. Solids that stand on the surface, and those that vanish,
/// follow it.
class Dents {
  public:
    explicit Dents(const Individual& individual);

    /// Return the height at a place of the cap (sigma 0 at the apex) or of the stem (sigma 0 at the
    /// ground), metres.
    [[nodiscard]] double cap(double sigma, double angle) const;
    [[nodiscard]] double stem(double sigma, double angle) const;

  private:
    /// What befell one species.
    struct Share {
        double weight;
        std::vector<DamageSpot> cap_lumps, stem_lumps;
        std::vector<Furrow> furrows;
    };
    [[nodiscard]] double lumps(const SubCurve& curve, std::vector<DamageSpot> Share::*spots,
                               double unit, bool stem, double sigma, double angle) const;
    [[nodiscard]] double furrow(double sigma, double angle, bool on_stem) const;

    const Outline& outline_;
    std::vector<Share> shares_;
    double bumps_, creases_, clubs_, radius_ = 0.0;
};

}  // namespace sporeprint
