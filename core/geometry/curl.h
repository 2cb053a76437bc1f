// The curl of a melting margin: how far what is left of cap and lower face has rolled away from where it was swept.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "core/geometry/damage_cuts.h"
#include "core/individual/individual.h"

namespace sporeprint {

/// A melting margin rolls up and outwards. What stands on the faces goes with them.
class Curl {
  public:
    Curl() = default;

    /// away  where each column of `cuts`, which must outlive this, goes to: unit vectors
    Curl(const Individual& individual, const Cuts& cuts, std::vector<glm::dvec3> away);

    [[nodiscard]] bool none() const { return away_.empty(); }

    /// How far a place goes, metres. at: on the cap its sigma, on the lower face its share, where the cuts have brought it
    [[nodiscard]] glm::dvec3 moved(bool cap, double at, double angle) const;

    /// The same in a column, where the faces end there.
    [[nodiscard]] glm::dvec3 moved(bool cap, double at, double cap_end, double lower_end,
                                   std::size_t column) const;

    /// How much of its new normal a vertex takes that has gone so far, 0..1.
    [[nodiscard]] double turned(const glm::dvec3& by) const;

  private:
    [[nodiscard]] double height(bool cap, double at, double cap_end, double lower_end) const;

    const Cuts* cuts_ = nullptr;
    double cap_length_ = 0.0, lower_length_ = 0.0, reach_ = 0.0, most_ = 0.0;
    std::vector<glm::dvec3> away_;
};

}  // namespace sporeprint
