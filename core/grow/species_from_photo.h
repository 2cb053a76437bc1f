// From a photograph to a species, all steps in order. For pictures, never for identifying mushrooms to eat.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/atlas/atlas.h"
#include "core/grow/nearest_species.h"
#include "core/surface/codecs.h"
#include "core/trace/face_view.h"
#include "core/trace/photo.h"
#include "core/trace/trace.h"
#include "core/trace/trace_spec.h"
#include "core/trace/whole_species.h"

namespace sporeprint {

/// Something about a trace that a person should know.
struct TraceWarning {
    const char* code;  ///< for programs: asymmetry, method, likeness, reversed, edge, soil, images
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

/// A photograph as it is traced: its large working copy, and what is the mushroom on it.
struct MushroomOnPhoto {
    Picture picture;
    trace::Mask mask;     ///< of the same size
    double factor = 1.0;  ///< pixels of the copy of a pixel of the photograph
};

/// Returns the mushroom on a photograph: what is inside of an outline that is given, or else what the gesture cuts
/// out.
///
/// cut_out  the mushroom on a picture that is cut out already, of any size; none for others
/// throws   Impossible (paths as in a TraceSpec) if there is neither an outline nor a gesture where one is
///          needed, if they are not on the photograph, if nothing hangs together on the gesture, or if the
///          outline cannot be measured
/// cost     about 0.25 s, a few milliseconds for a picture that is cut out or has an outline
[[nodiscard]] MushroomOnPhoto mushroom_on(const Picture& photo,
                                          const std::optional<trace::Mask>& cut_out,
                                          const trace::TraceSpec& spec);

/// Returns what is inside of the outline of a specification, on a photograph of which the working copy is known.
///
/// size    of the photograph
/// pre     the specification has an outline and marks
/// throws  as above
[[nodiscard]] MushroomOnPhoto outlined_on(Picture copy, const trace::PictureSize& size,
                                          const trace::TraceSpec& spec);

/// Returns the face of a cap on a photograph from above or below: what the gesture cuts out.
///
/// cut_out  as of mushroom_on()
/// path     of the view in the TraceSpec, "/views/above" or "/views/below"
/// throws   Impossible (paths below `path`) if the gesture is missing where one is needed, if it, the centre or
///          the end of the stem are not on the photograph, or if nothing hangs together on it
/// cost     as of mushroom_on()
[[nodiscard]] trace::FaceView face_on(const Picture& photo,
                                      const std::optional<trace::Mask>& cut_out,
                                      const trace::FaceViewSpec& spec, const std::string& path);

/// Returns the face of a cap on a photograph of which the working copy and the cap on it are known.
///
/// size    of the photograph
/// throws  as above
[[nodiscard]] trace::FaceView face_on_copy(Picture copy, trace::Mask mask,
                                           const trace::PictureSize& size,
                                           const trace::FaceViewSpec& spec,
                                           const std::string& path);

/// Other photographs of the same mushroom.
struct FacesOnPhotos {
    std::optional<trace::FaceView> above, below;
};

/// Returns the species of a photographed mushroom.
///
/// on      as of mushroom_on()
/// faces   as of face_on(); colours and images of what they show
/// pre     the template is "auto" or a species of the atlas
/// throws  Impossible (paths as in a TraceSpec) if the mask shows no mushroom that can be traced, the
///         template is no mushroom with a stem and a cap, or a form without a lower face is seen from below
/// cost    about 40 ms, 60 more for each face
[[nodiscard]] SpeciesFromPhoto species_from_photo(const MushroomOnPhoto& on,
                                                  const FacesOnPhotos& faces,
                                                  const trace::TraceSpec& spec, const Atlas& atlas,
                                                  const NearestSpecies& nearest);

}  // namespace sporeprint
