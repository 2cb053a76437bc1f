// The lower face as it is built: gills, ridges and spines as solids, and the flesh between them.
#pragma once

#include <vector>

#include "core/geometry/ornaments.h"
#include "core/geometry/sweep.h"
#include "core/individual/individual.h"

namespace sporeprint {

struct Budget;

/// Whether a level of detail carries the hymenium as solids; farther ones wear it in their images alone.
[[nodiscard]] constexpr bool has_solids(int lod) { return lod == 0; }

/// Rings that the flesh of an individual has beside those of its set, because it rises steeply between gills.
[[nodiscard]] int flesh_rings(const Individual& individual, int lod);

/// The lower face of an individual. Its outline is where the edges of the gills lie: the flesh lies deeper by what the blades are
/// deep there, at most by a share of the room under the cap. So blades pierce nothing, a closed button keeps its gills inside, and
/// every level of detail has one silhouette.
class LowerFace {
  public:
    LowerFace(const Individual& individual, int lod);

    /// The rings of the lower face at a level of detail, moved from the edges of the blades to the flesh between them.
    [[nodiscard]] std::vector<OutlineSample> flesh(const Outline& outline, int lod) const;

    /// A place on the meridian, 0 at the stem, 1 at the margin.
    struct Place {
        double r = 0.0, y = 0.0;                 ///< of the edges
        double normal_r = 0.0, normal_y = -1.0;  ///< out of the face
        double recess = 0.0;                     ///< how much deeper the flesh lies, metres
        double sink = 0.0;                       ///< how much deeper still solids may begin
        double scale = 1.0;  ///< factor on depths: less than 1 where there is not room enough
    };
    [[nodiscard]] Place at(double share) const;

    [[nodiscard]] bool empty() const { return places_.empty(); }
    [[nodiscard]] double length() const { return length_; }

  private:
    std::vector<Place> places_;
    double length_ = 0.0;
    bool carries_ = false;  ///< whether a species of the mix carries anything on it
};

/// Appends blades and spines: closed solids sunk a little into the flesh. What a weight or an age leaves nothing of keeps its
/// vertices and, in clips, its triangles.
///
/// source  algorithms of fine structure: profiles by attachment (free, adnexed, adnate, sinuate, decurrent), lamellulae in tiers
void add_hymenium(Mesh& mesh, const Individual& individual, const LowerFace& face,
                  const Ground& ground, const Budget& budget);

}  // namespace sporeprint
