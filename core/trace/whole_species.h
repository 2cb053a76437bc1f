// From one traced shape to a species: all other stages follow those of a species that it looks like.
#pragma once

#include <cstddef>
#include <vector>

#include "core/model/species.h"
#include "core/model/swept.h"
#include "core/silhouette/morph_set.h"
#include "core/trace/trace.h"

namespace sporeprint::trace {

/// A species with a traced stage.
struct WholeSpecies {
    Species species;
    std::size_t stage = 0;  ///< the one that has the traced shape
    /// How far the other stages have the proportions of the traced one, 0..1: halved until the outlines of
    /// all ages are simple. At 0 they are those of the template in another size.
    double likeness = 1.0;
    Certificate certificate;  ///< of its outlines from each age to the next
};

/// Returns true if a species can be the template of a whole species: all its stages are swept.
///
/// has_face  of what was traced: all stages have a lower face, or none has
[[nodiscard]] bool can_be_template(const Species& species, bool has_face);

/// Returns the height of the stage that is nearest to an age, metres.
///
/// pre  all stages are swept
[[nodiscard]] double height_at(const Species& species, double age);

/// Returns the outline of the stage that is nearest to an age.
///
/// pre  all stages are swept
[[nodiscard]] const Silhouette& silhouette_at(const Species& species, double age);

/// Requires that a species can be the template of a whole species.
///
/// throws  InvalidInput (path "/template")
void require_template(const Species& species, bool has_face);

/// Returns what is proven about the outlines of a species on the way from each stage to the next, and from the
/// first to the last.
///
/// pre  all stages are swept
[[nodiscard]] Certificate growth_certificate(const Species& species);

/// Returns a species whose stage nearest to an age has a traced shape. All others have the outlines of the
/// template, changed as the traced stage changes its own: at equal shares of each part's length, distances
/// from the axis and heights are multiplied by the same ratios, less so the farther a stage is in age.
/// Everything but shapes is the template's.
///
/// template_species  a species whose stages are swept and have a lower face if the shape has one, none
///                   otherwise
/// shape             as of traced()
/// age               of the photographed mushroom, 0..1
/// throws            InvalidInput (path "/template") if the template is no such species
/// cost              about 10 ms, nearly all of it for the proof
[[nodiscard]] WholeSpecies whole_species(const Species& template_species, const Swept& shape,
                                         double age);

/// Returns a species that stands on an axis and is as high at an age as stated: in all else it is the template.
///
/// template_species  a species whose stages are swept
[[nodiscard]] WholeSpecies sized_species(const Species& template_species,
                                         const std::vector<AxisPoint>& axis, double height_m,
                                         double age);

/// Moves the ages of a species so that one of its stages is at a given age: those before and after it keep their
/// order and their shares of the time to 0 and to 1. Its shapes stay, and what is proven of them.
///
/// age  greater than 0 and less than 1, or what the stage has already
void move_ages(Species& species, std::size_t stage, double age);

/// Returns how deep the cap of an outline is, of the height of its edge above its stem: what TraceParams::hollow
/// says of a traced one, within its range.
///
/// silhouette  with a lower face
[[nodiscard]] double hollow_of(const Silhouette& silhouette);

/// Returns how a mushroom is traced that is to become like a species: with its form, and the hollow of its stage
/// nearest to an age. Where its form cannot be traced, it is automatic.
[[nodiscard]] TraceParams params_like(const Species& species, double age, double height_m);

}  // namespace sporeprint::trace
