// From a photograph to a species, all steps in order. For pictures, never for identifying mushrooms to eat.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/atlas/atlas.h"
#include "core/grow/nearest_species.h"
#include "core/surface/codecs.h"
#include "core/trace/photo.h"
#include "core/trace/trace.h"
#include "core/trace/trace_spec.h"
#include "core/trace/whole_species.h"

namespace sporeprint {

/// Something about a trace that a person should know.
struct TraceWarning {
    const char* code;    ///< for programs: asymmetry, method, likeness, images
    std::string detail;  ///< a sentence
};

/// A traced photograph.
struct SpeciesFromPhoto {
    trace::Traced traced;  ///< in pixels of the photograph
    std::vector<NearSpecies> nearest;
    std::string template_id;
    trace::WholeSpecies whole;
    std::vector<TraceWarning> warnings;
};

/// Returns the mushroom on a photograph, as a mask of its large working copy.
///
/// cut_out  the mushroom on a picture that is cut out already, of any size; none for others
/// throws   Impossible (paths below "/views/side") if there is no gesture where one is needed, if it is not on
///          the photograph, or if nothing hangs together on it
/// cost     about 0.25 s, a few milliseconds for a picture that is cut out
[[nodiscard]] trace::Mask mushroom_on(const Picture& photo,
                                      const std::optional<trace::Mask>& cut_out,
                                      const trace::TraceSpec& spec);

/// Returns the species of a photographed mushroom.
///
/// mask    as of mushroom_on()
/// pre     the template is "auto" or a species of the atlas
/// throws  Impossible (paths as in a TraceSpec) if the mask shows no mushroom that can be traced, or the
///         template is no mushroom with a stem and a cap
/// cost    about 40 ms
[[nodiscard]] SpeciesFromPhoto species_from_photo(const Picture& photo, const trace::Mask& mask,
                                                  const trace::TraceSpec& spec, const Atlas& atlas,
                                                  const NearestSpecies& nearest);

}  // namespace sporeprint
