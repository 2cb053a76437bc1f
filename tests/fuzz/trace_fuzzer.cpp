// Fuzzes what a person draws on a photograph: bodies of traces, with lines, outlines and marks. Each gives a species
// that is proven, or is refused by name.

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/grow/nearest_species.h"
#include "core/grow/species_from_photo.h"
#include "core/params/reader.h"
#include "core/params/value.h"
#include "core/problems.h"
#include "tests/fuzz/expect.h"
#include "tests/support/drawn_mushroom.h"
#include "tests/support/small_atlas.h"

using namespace sporeprint;

namespace {

/// A mushroom as small as can be traced.
Picture photograph() {
    DrawnMushroom drawn;
    drawn.side = 180;
    drawn.pixels = 150.0;
    drawn.bend_deg = 10.0;
    return photograph_of(drawn);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const Picture photo = photograph();
    static LazyNearestSpecies lazy;
    const NearestSpecies& nearest = lazy.get(*small_atlas(), in_turn);
    std::vector<Problem> problems;
    const auto spec =
        read_json<trace::TraceSpec>({reinterpret_cast<const char*>(data), size}, problems);
    if (!problems.empty()) return 0;
    if (spec.template_id.view() != "auto" && !small_atlas()->find(spec.template_id.view()))
        return 0;
    try {
        FacesOnPhotos faces;
        const MushroomOnPhoto on = mushroom_on(photo, std::nullopt, spec);
        if (spec.views.above)
            faces.above = face_on(photo, std::nullopt, *spec.views.above, "/views/above");
        if (spec.views.below)
            faces.below = face_on(photo, std::nullopt, *spec.views.below, "/views/below");
        const SpeciesFromPhoto found = species_from_photo(on, faces, spec, *small_atlas(), nearest);
        expect(found.whole.certificate.simple, "a species is proven at all ages");
    } catch (const InvalidInput& refused) {
        expect(!refused.problems().empty() && !refused.problems().front().path.empty(),
               "a refusal names the parameter");
    }
    return 0;
}
