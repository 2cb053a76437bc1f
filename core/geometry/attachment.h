// Where solids of the lower face begin, and how deep they may be there: what gills, ridges, spines and tubes have in common.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "core/geometry/hymenium.h"

namespace sporeprint {

/// How deep a solid may be along the meridian, 0..1: it rises from the stem's skin, slowly where it runs down that, and runs out
/// towards the margin.
[[nodiscard]] double envelope(const HymeniumOf<Plain>& h, double share);

/// 0..1: how much of what runs down the stem stands out beyond the outline.
[[nodiscard]] double running_down(const HymeniumOf<Plain>& h);

/// How much of that depth a species uses where its blades meet the stem; they begin at their gap.
[[nodiscard]] double attachment(const HymeniumOf<Plain>& h, double share);

/// The same of pores and spines, which stand in the gap too, without any depth.
[[nodiscard]] double carried(const HymeniumOf<Plain>& h, double share);

/// Roots of solids on the flesh of one lower face, and the vertices that stand on them.
class Roots {
  public:
    Roots(Mesh& mesh, const Individual& individual, const LowerFace& face, const Ground& ground);

    /// Where a solid begins: sunk into the flesh (rooted: 1), or, when all but gone (0), on the very chords that are swept.
    [[nodiscard]] OutlineSample at(double share, double rooted) const;

    /// Where a sample of a sub-curve comes to lie: its meridian becomes the way out of the skin.
    /// hangs  in its own half-plane, as gills do; else it stands upright on the face
    [[nodiscard]] SurfacePoint place(Part part, const OutlineSample& sample, double angle,
                                     const AxisStation& station, bool hangs) const;

    /// The vertex of the body nearest to a place: between vertices its chords lie off the skin, so that what is left of a solid that
    /// is all but gone would stand off there.
    struct Spot {
        double share, angle;
    };
    [[nodiscard]] Spot vertex_near(double share, double angle) const;

    /// Appends a vertex of a solid: u from stem to margin, v from its root to its edge.
    void vertex(const glm::dvec3& position, const glm::dvec3& normal, const glm::dvec3& along,
                double u, double v, float hand) const;

    Mesh& mesh;
    const Individual& individual;
    const LowerFace& face;
    const Ground& ground;

  private:
    std::vector<OutlineSample> flesh_;
};

}  // namespace sporeprint
