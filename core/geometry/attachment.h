// Attachment of solids of the lower face (gills, ridges, spines, tubes) to the flesh, and limits of
// their depth.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "core/geometry/hymenium.h"

namespace sporeprint {

/// Returns the depth limit of a solid at a share of the meridian, 0..1: it rises from the stem
/// (slowly where the hymenium is decurrent) and falls to 0 at the margin.
[[nodiscard]] double depth_envelope(const HymeniumOf<Plain>& hymenium, double share);

/// Returns 0..1: how much of the decurrent part (the part that continues down the stem) stands out
/// beyond the outline.
[[nodiscard]] double decurrence(const HymeniumOf<Plain>& hymenium);

/// Returns the fraction of that depth which a species uses near the stem, according to its
/// attachment (free, adnexed, sinuate, ...); blades begin at the species' inner gap.
[[nodiscard]] double attached_depth(const HymeniumOf<Plain>& hymenium, double share);

/// Returns the same factor for pores and spines, which also stand in the inner gap, with depth 0
/// there.
[[nodiscard]] double cell_depth(const HymeniumOf<Plain>& hymenium, double share);

/// The root of one cross-section of a blade, which stays in its half-plane through the axis: along the
/// waves of the face or the turning of a fan, neighbours would overlap.
struct BladeRoot {
    SurfacePoint point;  ///< its `azimuth`, the direction of thickness, runs round the axis
    /// The same for the base, up or down with the face, so that a thick base stays in thin flesh.
    glm::dvec3 base;
};

/// Computes where solids attach to the flesh of one lower face, and appends their vertices.
class Attachment {
  public:
    Attachment(Mesh& mesh, const Individual& individual, const LowerFace& face,
               const OrnamentContext& context);

    /// Returns the base point of a solid: sunk into the flesh (embedding 1) or, for a vanishing
    /// solid (embedding 0), exactly on the chords of the swept mesh.
    [[nodiscard]] OutlineSample at(double share, double embedding) const;

    /// Returns the world-space point of a sample of the lower face, for a solid that stands
    /// perpendicular to it; its `meridian` is the outward normal of the surface.
    [[nodiscard]] SurfacePoint place(const OutlineSample& sample, double angle,
                                     const AxisStation& station) const;

    /// Returns the same of a sample of any sub-curve, for a blade.
    [[nodiscard]] BladeRoot blade_root(Part part, const OutlineSample& sample, double angle,
                                       const AxisStation& station) const;

    /// A place on the lower face.
    struct FacePoint {
        double share, angle;
    };
    /// Returns the vertex of the body nearest to a place. Between vertices the mesh is a chord that
    /// lies off the surface, so a vanishing solid that stood there would be visible as a gap.
    [[nodiscard]] FacePoint nearest_vertex(double share, double angle) const;

    /// Appends a vertex of a solid: u runs from stem to margin, v from the base of the solid to its
    /// edge.
    void add_vertex(const glm::dvec3& position, const glm::dvec3& normal, const glm::dvec3& along,
                    double u, double v, float handedness) const;

    Mesh& mesh;
    const Individual& individual;
    const LowerFace& face;
    const OrnamentContext& context;

  private:
    /// Turns the meridian of a placed point outwards.
    ///
    /// depth  of solids there, relative to that at rest
    void finish(Part part, const OutlineSample& sample, double angle, double depth,
                SurfacePoint& point) const;

    std::vector<OutlineSample> flesh_;
};

}  // namespace sporeprint
