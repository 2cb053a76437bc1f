// Lumps and furrows of a worn skin: how high they stand at a place, for the body that is dented and for all that stands on it.
#pragma once

#include <vector>

#include "core/individual/damage.h"
#include "core/individual/individual.h"

namespace sporeprint {

/// How deep a full furrow is, in mean radii of the stem.
inline constexpr double furrow_deep = 0.20;

/// The upper part of a club swells between few rings: this share of its furrows is geometry, the rest of them is painted.
inline constexpr double club_carried = 0.35;

/// Depth of a furrow at an angle, 0..1: 1 at its middle, 0 beyond its sides.
[[nodiscard]] double furrow_valley(double middle, double angle);

/// Mean distance of the stem's skin from the axis, metres.
[[nodiscard]] double mean_radius(const SubCurve& stem);

/// How far from its neighbours' edges the skin of the stem may move, 0..1; share 0 at the ground.
[[nodiscard]] double stem_freedom(double share);

/// Lumps and furrows of the skin: what stands on it, or is all but gone, goes with them.
class Dents {
  public:
    explicit Dents(const Individual& individual);

    /// Height at a place of the cap (sigma 0 at the apex) or the stem (sigma 0 at the ground), metres.
    [[nodiscard]] double cap(double sigma, double angle) const;
    [[nodiscard]] double stem(double sigma, double angle) const;

  private:
    [[nodiscard]] double lumps(const SubCurve& curve, const std::vector<Mark>& marks, double unit,
                               bool stem, double sigma, double angle) const;
    [[nodiscard]] double furrow(double sigma, double angle, bool on_stem) const;

    const Outline& outline_;
    std::vector<Mark> cap_lumps_, stem_lumps_;
    std::vector<Furrow> furrows_;
    double bumps_, creases_, clubs_, radius_ = 0.0;
};

}  // namespace sporeprint
