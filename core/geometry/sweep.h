// Turns an individual into a mesh: the outline is swept round the axis, with deformation, waves and
// ornaments.
#pragma once

#include <span>
#include <vector>

#include "core/geometry/axis.h"
#include "core/geometry/free_form.h"
#include "core/geometry/rest_surface.h"
#include "core/geometry/unevenness.h"
#include "core/individual/individual.h"
#include "core/mesh/detail.h"
#include "core/mesh/mesh.h"

namespace sporeprint {

/// Maps points from the rest surface to their final position: imperfections first, then
/// irregularity, then the axis.
class Deformer {
  public:
    /// throws  Impossible if the stem would fold: "/deformation/bend_deg", or "/model/axis" if it
    ///         folds without a bend
    explicit Deformer(const Individual& individual);

    /// Maps surface points (positions and both directions) in place, all by the same station of the
    /// axis. Points of the stem's surface need station() of their height; caps and rings need
    /// frozen_station() of the height at which they are attached. A dent moves a point by far less
    /// than the axis' radius of curvature, so the station of the undented point is used.
    void apply(std::span<SurfacePoint> points, const AxisStation& station) const;
    /// Maps positions in place in the same way.
    void apply(std::span<glm::dvec3> places, const AxisStation& station) const;

    /// Returns the station for a ring of the outline: on the stem that of the ring's height, on all
    /// other parts the rigid one at the stem's top.
    [[nodiscard]] AxisStation station(Part part, const OutlineSample& sample) const;

    /// Returns the station at a height above the ground, metres.
    [[nodiscard]] AxisStation station(double height) const { return axis_.at(height); }
    /// Returns that station as a rigid frame, so that what is attached there keeps its shape.
    [[nodiscard]] AxisStation frozen_station(double height) const {
        return axis_.frozen_at(height);
    }
    /// Returns the height of the stem's base, metres.
    [[nodiscard]] double base() const { return base_; }
    /// Returns the height of the stem's top, metres, greater than base().
    [[nodiscard]] double top() const { return top_; }

  private:
    double base_, top_;
    Axis axis_;
    Unevenness unevenness_;
    std::vector<FreeForm> dents_;
};

/// Options of swept_mesh() and branched_mesh().
struct SweepOptions {
    /// Makes texture coordinates and tangents.
    bool textured = true;
    /// Retains the triangles of parts that do not exist at this age, with zero area, so that the
    /// meshes of all ages have the same triangles.
    bool keep_absent = false;
    /// Rings that replace those of the outline's stem, from the axis (r = 0) to the stem's end
    /// (share 1); empty: the outline's own.
    std::span<const OutlineSample> stem = {};
};

/// Returns the mesh of an individual at a level of detail.
///
/// returns   a closed mesh, rings from base to apex; the last column of each ring repeats the
///           positions of column 0 bit for bit. Number and order of the vertices depend only on the
///           set of species and the level of detail, not on ages and weights
/// throws    Impossible for a stem that folds, and for a user-defined model so thin that its dents
///           turn it inside out
/// source    [Desbenoit2004] sec. 3.2-3.4 with R(theta) about the tangent; texture coordinates by
///           meridian arc length, so that they never fold
[[nodiscard]] Mesh swept_mesh(const Individual& individual, DetailLevel level,
                              const SweepOptions& options = {});

}  // namespace sporeprint
