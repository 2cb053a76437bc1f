// Fuzzes bodies of POST: read as requests, written in canonical form, and read again.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "api/http/query.h"
#include "api/library/names.h"
#include "api/products/colonies.h"
#include "api/products/leaves.h"
#include "api/products/morphs.h"
#include "api/products/mushrooms.h"
#include "api/products/presets.h"
#include "api/products/sets.h"
#include "api/products/trees.h"
#include "core/atlas/atlas.h"
#include "core/grow/set_file.h"
#include "core/params/canonical.h"
#include "core/params/reader.h"
#include "tests/fuzz/expect.h"

using namespace sporeprint;

namespace {

std::string key(const MushroomSpec& spec, const Atlas& atlas) {
    return api::key_of(spec, api::Product::glb, api::version_token(spec.mix, atlas));
}

void read_as_mushroom(std::string_view text, const Atlas& atlas) {
    api::ValidationErrors errors;
    const MushroomSpec spec = api::read_mushroom(text, atlas, errors).spec;
    if (!errors.empty()) return;
    Value own = write(spec.params);
    if (spec.model) {
        // Omitted values are checked when the individual is resolved.
        std::vector<Problem> problems;
        check(*spec.model, Info{.name = ""}, "/model", problems);
        if (!problems.empty()) return;
        own.set("model", write(*spec.model));
    } else {
        Value mix = Value::object();
        int sum = 0;
        for (const MixPart& part : spec.mix) {
            mix.set(part.id, part.weight);
            sum += part.weight;
        }
        expect(sum == 1000, "weights sum to a thousand");
        own.set("mix", std::move(mix));
    }
    api::ValidationErrors none;
    const MushroomSpec again = api::read_mushroom(dump(own), atlas, none).spec;
    expect(none.empty() && key(again, atlas) == key(spec, atlas),
           "an order reads back from its own text");
}

void read_as_morph(std::string_view text, const Atlas& atlas) {
    const api::SpeciesPair pair = {atlas.entries()[0].species.id.string(),
                                   atlas.entries()[1].species.id.string()};
    api::ValidationErrors errors;
    const MushroomSpec spec = api::read_morph(pair, text, errors).spec;
    if (!errors.empty()) return;
    Value own = write(spec.params);
    double t = 0.0;
    for (const MixPart& part : spec.mix)
        if (part.id == pair[1]) t = part.weight / 1000.0;
    own.set("t", t);
    own.set("arcs", write(spec.arcs));
    api::ValidationErrors none;
    const MushroomSpec again = api::read_morph(pair, dump(own), none).spec;
    expect(none.empty() && key(again, atlas) == key(spec, atlas),
           "a morph reads back from its own text");

    // With the species swapped it is the same.
    Value mirrored = Value::array();
    for (Arc arc : spec.arcs) {
        std::swap(arc.a, arc.b);
        mirrored.push(write(arc));
    }
    own.set("t", (1000 - static_cast<int>(t * 1000.0 + 0.5)) / 1000.0);
    own.set("arcs", std::move(mirrored));
    const MushroomSpec other = api::read_morph({pair[1], pair[0]}, dump(own), none).spec;
    expect(none.empty() && key(other, atlas) == key(spec, atlas),
           "a morph is the same from either side");
}

void read_as_colony(std::string_view text, const Atlas& atlas) {
    const auto key = [&](const ColonySpec& one) {
        return api::key_of(one, api::Product::glb, api::version_token(one.mix, atlas));
    };
    api::ValidationErrors errors;
    const ColonySpec spec = api::read_colony(text, atlas, errors).spec;
    if (!errors.empty()) return;
    Value own = write(spec.params);
    Value mix = Value::object();
    for (const MixPart& part : spec.mix) mix.set(part.id, part.weight);
    own.set("mix", std::move(mix));
    api::ValidationErrors none;
    const ColonySpec again = api::read_colony(dump(own), atlas, none).spec;
    expect(none.empty() && key(again) == key(spec), "a colony reads back from its own text");
}

void read_as_set(std::string_view text, const Atlas& atlas) {
    api::ValidationErrors errors;
    SetSpec spec = api::read_set(text, atlas, errors).spec;
    if (!errors.empty()) return;
    const auto key = [](const SetSpec& one) {
        std::string of;
        for (const Mix& mix : one.species) (of += mix_text(mix)) += ' ';
        return of + canonical_text(one.params) + canonical_text(one.mushroom);
    };
    Value own = Value::object(), species = Value::array();
    for (const Mix& mix : spec.species) species.push(mix_text(mix));
    own.set("species", std::move(species));
    const Value of_set = write(spec.params), of_mushroom = write(spec.mushroom);
    for (const auto& [name, value] : of_set.members()) own.set(name, value);
    for (const auto& [name, value] : of_mushroom.members())
        if (name != "seed" && name != "age" && name != "lod") own.set(name, value);
    api::ValidationErrors none;
    const SetSpec again = api::read_set(dump(own), atlas, none).spec;
    expect(none.empty() && key(again) == key(spec), "a set reads back from its own text");
    expect(most_files(spec) >= spec.species.size(), "a set has a file for each species");
    spec.packing = SetPacking::one_file;
    try {
        refuse_in_one_file(spec);
    } catch (const Impossible& refused) {
        expect(!refused.problems().empty(), "a refusal says why");
    }
}

template <class Kind>
void read_as(std::string_view text, const Atlas& atlas) {
    using Spec = typename Kind::Spec;
    api::ValidationErrors errors;
    const Spec spec = api::read_preset<Kind>(atlas, text, errors).spec;
    if (!errors.empty()) return;
    const auto key = [](const Spec& one) { return api::key_of<Kind>(one, api::Product::glb, "v"); };
    Value own = write(spec.params);
    // Without rows there is no matrix.
    if (const Value* rows = own.find("rows"); rows && rows->items().empty()) own.erase("rows");
    own.set("preset", spec.preset);
    api::ValidationErrors none;
    const Spec again = api::read_preset<Kind>(atlas, dump(own), none).spec;
    expect(none.empty() && key(again) == key(spec), "it reads back from its own text");
    // It also reads back from its URL, if it has one.
    const std::string address = api::canonical_address<Kind>(atlas, spec, api::Product::glb);
    if (address.empty()) return;
    std::vector<Problem> problems;
    const api::Target target = api::split_target(address, problems);
    const Spec there = api::read_preset<Kind>(atlas, spec.preset, target.query, none).spec;
    expect(problems.empty() && none.empty() && key(there) == key(spec),
           "it reads back from its URL");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const auto atlas = built_in_atlas();
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    for (const auto read : {read_as_mushroom, read_as_morph, read_as_colony, read_as_set}) try {
            read(text, *atlas);
        } catch (const api::SpeciesOfLibrary&) {
            // The service loads the species that are named, and plans the request again.
        }
    read_as<api::Leaves>(text, *atlas);
    read_as<api::Trees>(text, *atlas);
    return 0;
}
