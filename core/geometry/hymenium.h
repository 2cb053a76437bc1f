// Geometry of the lower face: gills, ridges, spines and pores as solids, and the flesh between
// them.
#pragma once

#include <vector>

#include "core/geometry/ornaments.h"
#include "core/geometry/sweep.h"
#include "core/individual/individual.h"

namespace sporeprint {

struct Budget;

/// Returns true when a level of detail may have the hymenium as solids; coarser levels only paint
/// it. LOD 0 always has them; Budget::solids says so of the levels between it and LOD 1.
[[nodiscard]] constexpr bool has_solids(DetailLevel level) { return level.lod == 0; }

/// Returns the number of extra rings of the flesh, which rises steeply between gills.
///
/// solids  whether they are built where the level may have them
[[nodiscard]] int flesh_rings(const Individual& individual, DetailLevel level, bool solids = true);

/// The lower face of an individual. Its outline is where the edges of the gills lie; the flesh is
/// recessed by the depth of the blades, at most by a fixed fraction of the room under the cap. So
/// blades intersect nothing, a closed button encloses its gills, and all levels of detail have the
/// same silhouette.
class LowerFace {
  public:
    /// solids  whether they are built where the level may have them
    LowerFace(const Individual& individual, DetailLevel level, bool solids = true);

    /// Returns the rings of the lower face at a level of detail, displaced from the edges of the
    /// blades to the flesh between them.
    [[nodiscard]] std::vector<OutlineSample> flesh(const Outline& outline, DetailLevel level) const;

    /// A place on the meridian, from 0 at the stem to 1 at the margin.
    struct Place {
        double r = 0.0, y = 0.0;                 ///< position of the edges, metres
        double normal_r = 0.0, normal_y = -1.0;  ///< outward unit normal of the face
        double recess = 0.0;                     ///< depth of the flesh below the edges, metres
        double sink = 0.0;   ///< further depth at which solids may begin, metres
        double scale = 1.0;  ///< factor on depths; below 1 where there is not enough room
    };
    [[nodiscard]] Place at(double share) const;

    [[nodiscard]] bool empty() const { return places_.empty(); }
    [[nodiscard]] double length() const { return length_; }

  private:
    std::vector<Place> places_;
    double length_ = 0.0;
    bool has_solids_ = false;  ///< whether a species of the mix has solids on it
};

/// Appends blades, spines and pores: closed solids sunk a little into the flesh. A solid that a
/// weight or an age reduces to nothing keeps its vertices and, in growth clips, its triangles.
///
/// source  profiles by attachment (free, adnexed, adnate, sinuate, decurrent), lamellulae in tiers
void add_hymenium(Mesh& mesh, const Individual& individual, const LowerFace& face,
                  const OrnamentContext& context, const Budget& budget);

}  // namespace sporeprint
