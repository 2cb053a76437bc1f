// Fuzzes request targets: split, their query read, written in canonical form, and read again.

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "api/http/errors.h"
#include "api/http/query.h"
#include "api/library/names.h"
#include "api/products/mix.h"
#include "core/atlas/atlas.h"
#include "core/grow/names.h"
#include "core/individual/mushroom_spec.h"
#include "core/params/canonical.h"
#include "core/params/query.h"
#include "tests/fuzz/expect.h"

using namespace sporeprint;

namespace {

void read_as_mix(std::string_view text, const Atlas& atlas) {
    api::ValidationErrors errors;
    const Mix mix = api::read_mix(text, atlas, errors);
    if (mix.empty()) return;
    api::ValidationErrors none;
    const Mix again = api::read_mix(std::string_view(mix_text(mix)), atlas, none);
    expect(again == mix, "a canonical mix is its own canonical form");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const auto atlas = built_in_atlas();
    const std::string_view text(reinterpret_cast<const char*>(data), size);

    std::vector<Problem> problems;
    const api::Target target = api::split_target(text, problems);
    if (!target.segments.empty()) {
        try {
            read_as_mix(target.segments.back(), *atlas);
        } catch (const api::SpeciesOfLibrary& wanted) {  // the service loads them
            for (const std::string& id : wanted.ids())
                expect(api::is_of_library(id),
                       "what is loaded is named like a species of the library");
        }
    }

    MushroomParams params;
    read_query(target.query, params, problems);
    if (!problems.empty()) return 0;

    const std::string own = query_text(params);
    std::vector<Problem> none;
    const api::Target own_target = api::split_target("/?" + own, none);
    MushroomParams again;
    if (!own.empty()) read_query(own_target.query, again, none);
    std::string before, after;
    canonical(params, before);
    canonical(again, after);
    expect(none.empty() && before == after, "our own query text reads back as the same parameters");
    return 0;
}
