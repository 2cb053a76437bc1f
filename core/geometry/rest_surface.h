// The skin of an individual while its axis is straight: where solids stand before dents and the axis move them.
#pragma once

#include "core/geometry/azimuth.h"
#include "core/geometry/relief.h"
#include "core/geometry/waves.h"
#include "core/surface/charts.h"

namespace sporeprint {

/// Places of the skin by (part, share, angle). `share` runs along the part's own sub-curve, base to apex: on the cap it is 0 at the
/// margin and 1 at the apex. Angles are those of the columns, before a fan turns them to its front.
class Skin {
  public:
    /// detail  of the mesh: what its columns and rings cannot carry is left out
    Skin(const Individual& individual, const Detail& detail);

    /// All that depends on the angle alone.
    struct Column {
        double angle = 0.0;
        AzimuthMap::Column azimuth;
        Waves::Phases waves{};
    };
    [[nodiscard]] Column column(double angle) const;

    /// Whether it is the outline turned about the axis and nothing more.
    [[nodiscard]] bool plain() const {
        return waves_.flat() && azimuth_.identity() && relief_.flat(Part::cap);
    }

    /// The place of a sample of the part's sub-curve. The directions are the derivatives by arc length of the outline at rest, base
    /// to apex, and by angle over the radius at rest; their cross product points outwards and is not unit. part: stem, hymenium or cap
    [[nodiscard]] SurfacePoint at(Part part, const OutlineSample& sample,
                                  const Column& column) const;
    [[nodiscard]] SurfacePoint at(Part part, double share, double angle) const;

    /// The place of a mesh over this skin with these rings and so many even columns: between its vertices lie chords, which relief,
    /// fans and lobes stand off from. Its meridian is that of the mesh, of length 1.
    [[nodiscard]] SurfacePoint meshed(Part part, const std::vector<OutlineSample>& rings,
                                      int columns, double share, double angle) const;

    [[nodiscard]] const SubCurve& curve(Part part) const;
    [[nodiscard]] const AzimuthMap& azimuth() const { return azimuth_; }

  private:
    const Outline& outline_;
    Relief relief_;
    Waves waves_;
    AzimuthMap azimuth_;
};

}  // namespace sporeprint
