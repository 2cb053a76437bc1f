// The cap of a mushroom without its stem, to be placed on a stem of a colony.
#pragma once

#include "core/individual/individual.h"
#include "core/mesh/mesh.h"

namespace sporeprint {

/// Lengths of an individual that a colony needs to place it on a stem, metres.
struct StemFit {
    double radius = 0.0;      ///< at the junction of stem and hymenium (clubs: of stem and cap)
    double height = 0.0;      ///< of that junction above the ground
    double length = 0.0;      ///< of the stem's meridian, for which its image is painted
    double cap_radius = 0.0;  ///< largest radius of the cap
};
[[nodiscard]] StemFit stem_fit(const Individual& individual);

/// Parameters of cutting off a cap.
struct CapCut {
    int lod = 1;  ///< of the mushroom, up to farthest_lod
    /// The ratio of the mushroom's own stem radius to that of the stem that carries the cap, at
    /// least 1; a neck connects the two.
    double neck = 1.0;
    bool textured = true;
};

/// Returns the length of the neck below the junction, in radii of the stem that carries the cap.
[[nodiscard]] double neck_length(double neck);

/// Returns the part of an individual above its stem, including ring and decurrent blades, closed by
/// a neck that is hidden in the stem. It is built on a straight stem of constant radius, so that
/// everything attached to the stem fits any such stem.
///
/// individual  with a stem; mix, random draws and seed are unchanged
/// returns     a closed mesh with the centre of the junction at the origin and axis +y, not scaled.
///             Rings are placed no lower than three fifths of the stem's height, because stems of a
///             colony differ in length
/// throws      as swept_mesh()
[[nodiscard]] Mesh cap_mesh(Individual individual, const CapCut& cut);

}  // namespace sporeprint
