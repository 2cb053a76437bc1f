// The cap of a mushroom without its stem, to be set on a stem of a colony.
#pragma once

#include "core/individual/individual.h"
#include "core/mesh/mesh.h"

namespace sporeprint {

/// Lengths of an individual that a colony needs to set it on its stem, metres.
struct StemFit {
    double radius = 0.0;      ///< where stem and hymenium (or, of clubs, stem and cap) meet
    double height = 0.0;      ///< of that junction over the ground
    double length = 0.0;      ///< of the stem's meridian: what its image is painted for
    double cap_radius = 0.0;  ///< largest
};
[[nodiscard]] StemFit stem_fit(const Individual& individual);

/// How a cap is cut off.
struct CapCut {
    int lod = 1;  ///< of the mushroom, up to farthest_lod
    /// The stem that will bear it is this many times thinner than its own: between them stands a neck. At least 1.
    double neck = 1.0;
    bool textured = true;
};

/// Length of the neck below the junction, in radii of the stem that bears the cap.
[[nodiscard]] double neck_length(double neck);

/// What an individual bears above its stem, ring and blades that run down included, closed by a neck that is hidden in the stem.
/// It is built on a straight stem, so that whatever stands on the stem fits one that is as thick as this all along.
///
/// individual  with a stem; its place in a mix, its draws and its seed stay
/// returns     closed mesh, the middle of the junction at the origin, its axis +y, not scaled. Rings stand no lower than three fifths
///             of the stem's height: stems of a colony are not all as long
/// throws      as swept_mesh()
[[nodiscard]] Mesh cap_mesh(Individual individual, const CapCut& cut);

}  // namespace sporeprint
