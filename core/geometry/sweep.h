// Turns an individual into a mesh: the outline swept round the axis, with deformation, waves and ornaments.
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

/// Everything that moves a point from rest to its place: imperfections, then the axis.
class Deformer {
  public:
    /// throws Impossible if the stem would fold: "/deformation/bend_deg", or "/model/axis" if it folds without a bend
    explicit Deformer(const Individual& individual);

    /// Moves points that belong to one station of the axis: the stem's skin to that of its height, caps and rings to the frozen one
    /// where they are attached. A dent moves a point by far less than the axis' radius of curvature, so it keeps its station.
    void apply(std::span<SurfacePoint> points, const AxisStation& station) const;
    void apply(std::span<glm::dvec3> places, const AxisStation& station) const;

    /// The station of a place on the skin: that of its height on the stem, the top for all that the stem carries.
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

/// What a mesh is for.
struct SweepOptions {
    bool textured = true;  ///< whether texture coordinates and tangents are made
    bool keep_absent =
        false;  ///< whether triangles of what is absent stay, without area: then all ages have the same triangles
    /// Rings that are swept in place of the stem's own, from the axis to its end (share 1); none: its own.
    std::span<const OutlineSample> stem = {};
};

/// Mesh of an individual at a level of detail, 0..3.
///
/// returns   closed mesh, rings base to apex, column 0 repeated bit for bit as the last. The number and order of its vertices are
///           those of the set of species: ages and weights inside the mix do not change them
/// throws    Impossible for a stem that folds, and for a model of one's own so thin that its dents turn it inside out
/// source    [Desbenoit2004] sec. 3.2-3.4 with R(theta) about the tangent; texture coordinates by meridian arc length, so that they never fold
[[nodiscard]] Mesh swept_mesh(const Individual& individual, int lod,
                              const SweepOptions& options = {});

}  // namespace sporeprint
