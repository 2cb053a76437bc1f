// The recipe of a correspondence: what of one species becomes what of another, as a picture shows it.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/atlas/atlas.h"
#include "core/grow/workshop.h"
#include "core/silhouette/morph_set.h"
#include "core/silhouette/outline.h"

namespace sporeprint {

/// Two species of one age, each as its template is: no individual's own proportions.
struct SpeciesMorph {
    /// [species][CurveName] rings at LOD 0, metres: ring k of one species becomes ring k of the other.
    std::array<std::array<std::vector<OutlineSample>, 3>, 2> outlines;
    std::vector<Arc> arcs;  ///< some of what belongs together; the ends of sub-curves do anyway
    Certificate
        certificate;  ///< whether an outline on the way between the two touches itself, at any level of detail
};

/// Finds what belongs together.
///
/// species  two different ids of one family, in any order
/// throws   InvalidInput, Impossible; Cancelled
[[nodiscard]] SpeciesMorph species_morph(const std::array<std::string, 2>& species, double age,
                                         const Atlas& atlas, const Workshop& workshop = {});

}  // namespace sporeprint
