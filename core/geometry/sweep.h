// Turns an individual into a mesh: the outline is swept round the axis, with deformation, waves and
// ornaments.
#pragma once

#include <span>
#include <vector>

#include "core/geometry/axis.h"
#include "core/geometry/free_form.h"
#include "core/geometry/rest_surface.h"
#include "core/individual/individual.h"
#include "core/mesh/detail.h"
#include "core/mesh/mesh.h"

namespace sporeprint {

/// Maps points from the rest surface to their final position: imperfections first, then the axis.
class Deformer {
  public:
    /// throws  Impossible if the stem would fold: "/deformation/bend_deg", or "/model/axis" if it
    ///         folds without a bend
    explicit Deformer(const Individual& individual);

    /// Maps points that belong to one station of the axis: the stem's surface uses the station of
    /// its height, caps and rings the rigid one where they are attached. A dent moves a point by
    /// far less than the axis' radius of curvature, so the point keeps its station.
    void apply(std::span<SurfacePoint> points, const AxisStation& station) const;
    void apply(std::span<glm::dvec3> places, const AxisStation& station) const;

    /// Returns the station of a place on the surface: that of its height on the stem, and that of
    /// the stem's top for everything the stem supports.
    [[nodiscard]] AxisStation station(Part part, const OutlineSample& sample) const;

    [[nodiscard]] AxisStation station(double height) const { return axis_.at(height); }
    [[nodiscard]] AxisStation frozen_station(double height) const {
        return axis_.frozen_at(height);
    }
    [[nodiscard]] double base() const { return base_; }
    [[nodiscard]] double top() const { return top_; }

  private:
    double base_, top_;
    Axis axis_;
    std::vector<FreeForm> dents_;
};

/// Options of swept_mesh() and branched_mesh().
struct SweepOptions {
    /// Makes texture coordinates and tangents.
    bool textured = true;
    /// Keeps triangles of absent parts, with zero area; then all ages have the same triangles.
    bool keep_absent = false;
    /// Rings swept in place of the stem's own, from the axis to its end (share 1); empty: its own.
    std::span<const OutlineSample> stem = {};
};

/// Returns the mesh of an individual at a level of detail, 0..3.
///
/// returns   closed mesh, rings base to apex, column 0 repeated bit for bit as the last. Number and
///           order of the vertices are those of the set of species: ages and weights inside the mix
///           do not change them
/// throws    Impossible for a stem that folds, and for a user-defined model so thin that its dents
///           turn it inside out
/// source    [Desbenoit2004] sec. 3.2-3.4 with R(theta) about the tangent; texture coordinates by
///           meridian arc length, so that they never fold
[[nodiscard]] Mesh swept_mesh(const Individual& individual, int lod,
                              const SweepOptions& options = {});

}  // namespace sporeprint
