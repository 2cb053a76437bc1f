#include "api/products/catalogue.h"

#include <algorithm>
#include <string_view>

#include "api/http/schemas.h"
#include "api/http/text.h"
#include "api/products/product.h"
#include "core/params/reader.h"

namespace sporeprint::api {

static_assert(well_described<SpeciesFilter>());

Family family_of(const Species& species) {
    for (const Stage& stage : species.stages)
        if (std::string_view(form_of(stage.model.shape)) != name(Family::swept))
            return Family::branched;
    return Family::swept;
}

bool passes(const Species& species, const SpeciesFilter& filter) {
    const Facts& facts = species.facts;
    const auto contains = [](std::string_view text, std::string_view part) {
        return lower(text).find(lower(part)) != std::string::npos;
    };
    if (filter.form && facts.form != *filter.form) return false;
    if (filter.family && family_of(species) != *filter.family) return false;
    if (filter.substrate && !contains(facts.substrate, *filter.substrate)) return false;
    if (filter.habit && !contains(facts.habit, *filter.habit)) return false;
    if (filter.month &&
        std::find(facts.season.begin(), facts.season.end(), *filter.month) == facts.season.end())
        return false;
    if (filter.colour && !contains(facts.colour, *filter.colour)) return false;
    if ((filter.min_diameter_m || filter.max_diameter_m) && !facts.cap_diameter_m) return false;
    if (filter.min_diameter_m && facts.cap_diameter_m->to < *filter.min_diameter_m) return false;
    return !(filter.max_diameter_m && facts.cap_diameter_m->to > *filter.max_diameter_m);
}

Value species_list(const Atlas& atlas, const SpeciesFilter& filter) {
    Value list = Value::array();
    for (const AtlasEntry& entry : atlas.entries()) {
        const Species& species = entry.species;
        if (!passes(species, filter)) continue;
        const Facts& facts = species.facts;
        const std::string id = species.id.string();
        Value row = Value::object();
        row.set("id", id);
        row.set("scientific_name", facts.scientific_name.view());
        row.set("common_name", facts.common_name.view());
        row.set("family", name(family_of(species)));
        row.set("form", name(facts.form));
        row.set("cap_diameter_m", facts.cap_diameter_m ? write(*facts.cap_diameter_m) : Value());
        row.set("height_m", write(facts.height_m));
        row.set("substrate", facts.substrate.view());
        row.set("habit", facts.habit.view());
        row.set("season", write(facts.season));
        Value links = Value::object();
        links.set("self", "/v1/species/" + id);
        links.set("model", "/v1/mushrooms/" + id + ".glb");
        links.set("image", "/v1/mushrooms/" + id + ".png");
        row.set("links", std::move(links));
        list.push(std::move(row));
    }
    return Value::object().set("species", std::move(list));
}

Value product_list(const Atlas& atlas, const std::string& product) {
    const std::string root = folder_of(product);
    Value list = Value::array();
    for (const AtlasEntry& entry : atlas.entries()) {
        const std::string id = entry.species.id.string();
        Value links = Value::object();
        links.set("self", root + id + ".json").set("model", root + id + ".glb");
        links.set("image", root + id + ".png");
        links.set("schema", root + "schema").set("species", "/v1/species/" + id);
        list.push(Value::object()
                      .set("id", id)
                      .set("name", entry.species.facts.common_name.view())
                      .set("links", std::move(links)));
    }
    return Value::object().set(product, std::move(list));
}

Value product_list_schema() {
    const Value text = typed("string");
    return list_of(objects({{"id", text}, {"name", text}, {"links", map_of(text)}}));
}

Value with_branched_order(Value schema) {
    each_schema(schema, [](Value& one) {
        if (Value* properties = one.find("properties"))
            if (Value* ramification = properties->find("ramification"))
                if (Value* inner = ramification->find("properties"))
                    inner->find("order")->set("minimum", 2);
    });
    return schema;
}

}  // namespace sporeprint::api
