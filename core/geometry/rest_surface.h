// The surface of an individual while its axis is straight: where solids stand before dents and the
// axis displace them.
#pragma once

#include <glm/vec2.hpp>

#include "core/geometry/azimuth.h"
#include "core/geometry/relief.h"
#include "core/geometry/waves.h"
#include "core/surface/charts.h"

namespace sporeprint {

/// Evaluates the surface by (part, share, angle). `share` runs along the part's own sub-curve, base
/// to apex: on the cap it is 0 at the margin and 1 at the apex. Angles are those of the columns,
/// before a fan turns them to its front.
class RestSurface {
  public:
    /// detail   of the mesh; sources too fine for its columns and rings are left out
    /// carrier  the same for relief alone
    RestSurface(const Individual& individual, const Detail& detail, const Detail& carrier);
    RestSurface(const Individual& individual, const Detail& detail)
        : RestSurface(individual, detail, detail) {}

    /// Everything that depends on the angle alone.
    struct Column {
        double angle = 0.0;
        AzimuthMap::Column azimuth;
        Waves::Phases waves{};
    };
    [[nodiscard]] Column column(double angle) const;

    /// Returns true when the surface is the outline revolved about the axis and nothing more.
    [[nodiscard]] bool plain() const {
        return waves_.flat() && azimuth_.identity() && relief_.flat(Part::cap);
    }

    /// Returns the surface point of a sample of the part's sub-curve (stem, hymenium or cap). The
    /// directions are the derivatives by arc length of the outline at rest, base to apex, and by
    /// angle divided by the radius at rest; their cross product points outwards and is not a unit
    /// vector.
    [[nodiscard]] SurfacePoint at(Part part, const OutlineSample& sample,
                                  const Column& column) const;
    [[nodiscard]] SurfacePoint at(Part part, double share, double angle) const;

    /// Returns the point of a mesh over this surface with these rings and this number of even
    /// columns: between vertices the mesh is a chord, which lies off relief, fans and lobes. Its
    /// meridian is the unit tangent of the mesh.
    [[nodiscard]] SurfacePoint meshed(Part part, const std::vector<OutlineSample>& rings,
                                      int columns, double share, double angle) const;

    [[nodiscard]] const SubCurve& curve(Part part) const;
    [[nodiscard]] const AzimuthMap& azimuth() const { return azimuth_; }

  private:
    const Outline& outline_;
    Relief relief_;
    Waves waves_;
    /// Both faces wave by their distance from the margin in the half-plane, so that opposite points
    /// move alike: measured along each face, they would not where the margin is blunt, and thin
    /// flesh would come through the cap.
    glm::dvec2 margin_{0.0};
    double waved_ = 1.0;  ///< the distance at which all waves have ended, metres
    AzimuthMap azimuth_;
};

}  // namespace sporeprint
