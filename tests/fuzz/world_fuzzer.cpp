// Fuzzes what names a world, a time and a rectangle in URLs, one line each: read, written in canonical form, and read
// again; and what follows as the edits in a body.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "api/http/errors.h"
#include "api/products/worlds/edits.h"
#include "api/products/worlds/parts.h"
#include "api/products/worlds/worlds.h"
#include "core/atlas/atlas.h"
#include "core/params/canonical.h"
#include "core/world/absence.h"
#include "core/world/ground.h"
#include "tests/fuzz/expect.h"

using namespace sporeprint;

namespace {

std::string_view take_line(std::string_view& text) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(line.size() == text.size() ? line.size() : line.size() + 1);
    return line;
}

void read_as_world(std::string_view text, const Atlas& atlas) {
    api::ValidationErrors errors;
    const api::WorldRequest request = api::read_world(text, atlas, errors);
    if (!errors.empty()) return;
    const std::string own = api::world_text(request.spec, atlas);
    api::ValidationErrors none;
    const api::WorldRequest again = api::read_world(own, atlas, none);
    expect(none.empty(), "the canonical text of a world is read");
    expect(canonical_text(again.spec.params) == canonical_text(request.spec.params),
           "it names the same world");
    expect(api::world_text(again.spec, atlas) == own, "it is its own canonical form");
    for (const AtlasEntry& entry : atlas.entries())
        static_cast<void>(reason_of_absence(entry.species.ecology, request.spec.params));
}

void read_as_time(std::string_view text) {
    api::ValidationErrors errors;
    const api::WorldTimeRead time = api::read_world_time(text, errors);
    expect(time.is_valid == errors.empty(), "a time is valid or an error");
    if (!time.is_valid) return;
    std::string own = 'y' + std::to_string(time.year);
    if (time.day != 0) (own += 'd') += std::to_string(time.day);
    expect(own == text, "a time has one text");
}

void read_as_box(std::string_view text) {
    const WorldBox extent{-128.0, -128.0, 128.0, 128.0};
    api::ValidationErrors errors;
    const WorldBox box = api::read_box(text, extent, extent, errors);
    if (!errors.empty()) return;
    expect(box.west >= -128.0 && box.south >= -128.0 && box.east <= 128.0 && box.north <= 128.0,
           "a rectangle lies in its world");
    api::ValidationErrors none;
    expect(api::read_box(api::text_of(box), extent, extent, none) == box && none.empty(),
           "a rectangle as it is written reads back as itself");
}

void read_as_edits(std::string_view text, const Atlas& atlas) {
    std::vector<Problem> problems;
    Value body = parse(text, problems);
    if (!problems.empty() || !body.is_object()) return;
    WorldParams params = params_of(*atlas.find_world("meadow"));
    params.extent.value = 256;
    api::ValidationErrors errors;
    const SharedEdits edits = api::take_edits(body, params, atlas, errors);
    expect(errors.empty() || !edits, "edits with an error are none");
    expect(!body.find("masks"), "what was read is no longer in the body");
    if (!edits) return;
    expect(!edits->empty() && !edits->text.empty(), "edits change something");
    expect(settled(*edits).text == edits->text, "edits are settled");
    for (const auto& [name, mask] : edits->masks) {
        const double share = mask->at({-123 * units_of_metre, 45 * units_of_metre});
        expect(share >= 0.0 && share <= 1.0, "a mask has shares");
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const auto atlas = built_in_atlas();
    std::string_view text(reinterpret_cast<const char*>(data), size);
    read_as_world(take_line(text), *atlas);
    read_as_time(take_line(text));
    read_as_box(take_line(text));
    read_as_edits(text, *atlas);
    return 0;
}
