// The curl of a margin that deliquesces or has split: how far what is left of cap and lower face is
// displaced from the swept surface.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "core/geometry/damage_cuts.h"
#include "core/individual/individual.h"

namespace sporeprint {

/// Displacement of a deliquescing margin, which rolls up and outwards, and of the lips of splits,
/// which are raised. Solids on the faces are displaced with them.
class Curl {
  public:
    Curl() = default;

    /// away  unit direction of displacement of each column of `cuts`; `cuts` must outlive this
    ///       object
    Curl(const Individual& individual, const MarginCuts& cuts, std::vector<glm::dvec3> away);

    [[nodiscard]] bool none() const { return away_.empty(); }

    /// Returns the displacement of a place, metres.
    ///
    /// at  place after the cuts: sigma on the cap, share on the lower face
    [[nodiscard]] glm::dvec3 moved(bool cap, double at, double angle) const;

    /// Returns the same for a column, given where the faces end there.
    [[nodiscard]] glm::dvec3 moved(bool cap, double at, double cap_end, double lower_end,
                                   std::size_t column) const;

    /// Returns the weight of the recomputed normal for a vertex with this displacement, 0..1.
    [[nodiscard]] double turned(const glm::dvec3& by) const;

  private:
    /// Returns how far a place is displaced, metres.
    ///
    /// lift  of the lips of splits there, metres
    [[nodiscard]] double height(bool cap, double at, double cap_end, double lower_end,
                                double lift) const;

    const MarginCuts* cuts_ = nullptr;
    double cap_length_ = 0.0, lower_length_ = 0.0, max_height_ = 0.0, max_lift_ = 0.0;
    std::vector<double> lifts_;  // per column, metres
    std::vector<glm::dvec3> away_;
};

}  // namespace sporeprint
