#include "api/products/offspring.h"

#include <xxhash.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "api/http/schemas.h"
#include "api/products/catalogue.h"
#include "api/products/mix.h"
#include "api/products/pictures.h"
#include "api/products/plan_product.h"
#include "core/grow/names.h"
#include "core/grow/offspring.h"
#include "core/params/canonical.h"
#include "core/params/messages.h"
#include "core/params/query.h"
#include "core/params/reader.h"
#include "core/params/schema.h"

namespace sporeprint::api {

namespace {

using Pairs = std::vector<std::pair<std::string, std::string>>;

/// The names of the parameters of a bred species.
constexpr std::array<const char*, 4> breeding_names = {"seed", "share", "mutation", "lock"};

/// The seed of the mushroom, since `seed` is that of the breeding.
constexpr const char* individual = "individual";

bool is_of_breeding(std::string_view name) {
    return std::find(breeding_names.begin(), breeding_names.end(), name) != breeding_names.end();
}

/// Returns a parent; nothing if it is unknown.
const Species* species_of(const Parent& parent, const Atlas& atlas) {
    if (parent.own) return parent.own.get();
    const AtlasEntry* const entry = find_species(parent.id, atlas);
    return entry ? &entry->species : nullptr;
}

/// Replaces the names of the parents by their ids. Adds errors for unknown species, and for two families.
///
/// mark  "" for parameters of a URL, "/" for members of a body
void check_parents(OffspringSpec& spec, const std::string& mark, const Atlas& atlas,
                   ValidationErrors& errors) {
    const Species* const first = species_of(spec.a, atlas);
    const Species* const second = species_of(spec.b, atlas);
    if (!first) errors.add(404, mark + "a", unknown_species(spec.a.id, atlas));
    if (!second) errors.add(404, mark + "b", unknown_species(spec.b.id, atlas));
    if (!first || !second) return;
    if (!spec.a.own) spec.a.id = first->id.string();
    if (!spec.b.own) spec.b.id = second->id.string();
    const Family family = family_of(*first), other = family_of(*second);
    if (family != other)
        errors.add(422, mark + "b",
                   in_quotes(spec.b.id) + " is " + name(other) + " and " + in_quotes(spec.a.id) +
                       " is " + name(family) + "; only species of one family can be crossed");
}

/// Adds the parts that a value of `lock` names, separated by commas.
void read_locks(std::string_view text, std::vector<Text<64>>& locks, ValidationErrors& errors) {
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        const std::string_view part = text.substr(begin, end - begin);
        begin = end + 1;
        if (part.empty())
            errors.add(400, "lock", "names no part; write lock=surface.cap or leave it out");
        else if (part.size() > Text<64>::capacity)
            errors.add(400, "lock", in_quotes(part) + " is longer than 64 bytes");
        else
            locks.emplace_back(part);
    }
}

/// Sorts the locks and removes repeated ones, so that equal sets are equal requests.
void sort_locks(BreedingParams& params) {
    std::vector<Text<64>>& locks = params.lock;
    std::sort(locks.begin(), locks.end(),
              [](const Text<64>& one, const Text<64>& other) { return one.view() < other.view(); });
    locks.erase(std::unique(locks.begin(), locks.end()), locks.end());
}

/// Reads the parameters of a breeding from their pairs.
BreedingParams read_breeding(const Pairs& pairs, const Species* first, ValidationErrors& errors) {
    BreedingParams params;
    Pairs numbers;
    std::vector<Text<64>> locks;
    for (const auto& pair : pairs)
        if (pair.first == "lock")
            read_locks(pair.second, locks, errors);
        else
            numbers.push_back(pair);
    params.lock = std::move(locks);
    sort_locks(params);
    std::vector<Problem> problems;
    QueryReader query(numbers, problems);
    read_query_members(query, params, "");
    if (problems.empty()) problems = problems_in(params);
    if (problems.empty() && first) problems = lock_problems(*first, params);
    for (const Problem& problem : problems)
        errors.add(400, problem.path.starts_with("/lock") ? "lock" : query_name(problem.path),
                   problem.message);
    without_negative_zero(params);
    return params;
}

/// Reads the parameters of the mushroom from the other pairs.
MushroomParams read_mushroom_params(Pairs pairs, ValidationErrors& errors) {
    MushroomParams params;
    for (auto& pair : pairs)
        if (pair.first == individual) pair.first = "seed";
    std::vector<Problem> problems;
    apply_profile(requested_profile(pairs), params);
    QueryReader query(pairs, problems);
    for (const char* name : breeding_names)
        query.take(name == breeding_names[0] ? individual : name);
    read_query_members(query, params, "");
    query.refuse_the_rest();
    if (problems.empty())
        for (Problem& problem : problems_in(params))
            report(problems, query_name(problem.path), std::move(problem.message));
    drop_excluded_defaults(params, named_options(pairs));
    for (Problem& problem : problems)
        if (problem.path == "seed") problem.path = individual;
    add_problems(problems, params, "", false, errors);
    if (has_addresses(params.textures))
        errors.add(422, "textures",
                   "the images of an offspring have no addresses; ask for embedded or none");
    without_negative_zero(params);
    params.drop_equal_seeds();
    return params;
}

/// Reads a parent of a body, an id or a whole species, and removes it; returns false if there is none.
bool read_parent(Value& json, const char* member, Parent& parent, ValidationErrors& errors) {
    const std::string path = std::string("/") + member;
    const Value* const value = json.find(member);
    if (!value) {
        errors.add(400, path, "is missing; give the id of a species, or a whole species");
        return false;
    }
    bool is_read = true;
    if (value->is_string()) {
        parent.id = value->as_string();
    } else {
        auto species = std::make_shared<Species>();
        std::vector<Problem> problems;
        read(*value, *species, Info{.name = ""}, path, problems);
        if (problems.empty()) check(*species, Info{.name = ""}, path, problems);
        is_read = problems.empty();
        add_problems(problems, *species, path, true, errors);
        without_negative_zero(*species);
        parent.id = species->id.string();
        parent.own = std::move(species);
    }
    json.erase(member);
    return is_read;
}

/// Reads the parameters of the mushroom from the rest of a body.
MushroomParams read_mushroom_params(Value json, ValidationErrors& errors) {
    MushroomParams params;
    std::vector<Problem> problems;
    // These are of the breeding where they stand alone.
    if (const Value* seed = json.find(individual)) {
        json.set("seed", *seed);
        json.erase(individual);
    }
    apply_profile(requested_profile(json), params);
    read(json, params, Info{.name = ""}, "", problems);
    drop_excluded_defaults(params, named_options(json));
    for (Problem& problem : problems)
        if (problem.path == "/seed") problem.path = std::string("/") + individual;
    add_problems(problems, params, "", true, errors);
    if (has_addresses(params.textures))
        errors.add(422, "/textures",
                   "the images of an offspring have no addresses; ask for embedded or none");
    without_negative_zero(params);
    params.drop_equal_seeds();
    return params;
}

/// Adds an error for each parameter of a file in the query of a species.
void refuse_others(const Pairs& pairs, ValidationErrors& errors) {
    std::vector<Problem> problems;
    QueryReader query(pairs, problems);
    for (const char* name : breeding_names) query.take(name);
    query.refuse_the_rest();
    errors.add(400, problems);
}

/// Returns the request for a mushroom of a bred species.
MushroomSpec mushroom_of(const OffspringSpec& spec, const std::string& id) {
    MushroomSpec mushroom;
    mushroom.mix = {{id, 1000}};
    mushroom.params = spec.params;
    return mushroom;
}

std::string breeding_key(const OffspringSpec& spec, const std::string& version) {
    std::string key = "offspring " + version;
    for (const Parent* parent : {&spec.a, &spec.b}) {
        key += '\n';
        if (parent->own)
            canonical(*parent->own, key);
        else
            key += parent->id;
    }
    return key + '\n' + canonical_text(spec.breeding);
}

/// Returns the atlas of the bred species alone.
std::shared_ptr<const Atlas> bred(const Context& context, const OffspringSpec& spec,
                                  const Caches& caches) {
    const Atlas& atlas = *context.atlas;
    return caches.offspring(breeding_key(spec, OffspringOfTwo::document_version(spec, atlas)), [&] {
        const Offspring child = offspring(*species_of(spec.a, atlas), *species_of(spec.b, atlas),
                                          spec.breeding, caches.morphs);
        return std::make_shared<const Atlas>(AtlasTexts{.species = {dump(write(child.species))}});
    });
}

/// Breeds unless that is done, and returns the context in which its mushrooms are grown.
Context context_of_child(const Context& context, const OffspringSpec& spec, const Caches& caches,
                         OffspringOfTwo::Resolved& resolved) {
    if (!resolved.atlas) resolved.atlas = bred(context, spec, caches);
    Context of_child = context;
    of_child.atlas = resolved.atlas;
    return of_child;
}

std::string id_of(const Atlas& bred) { return bred.entries().front().species.id.string(); }

}  // namespace

OffspringRequest read_offspring(std::string_view a, std::string_view b, Query query,
                                Product product, const Atlas& atlas, ValidationErrors& errors) {
    OffspringRequest request;
    request.product = product;
    request.spec.a.id = std::string(a);
    request.spec.b.id = std::string(b);
    check_parents(request.spec, "", atlas, errors);
    Pairs rest, of_breeding, of_mushroom;
    request.version = take_version(query, rest, errors);
    for (const auto& pair : rest)
        (is_of_breeding(pair.first) ? of_breeding : of_mushroom).push_back(pair);
    request.spec.breeding = read_breeding(of_breeding, species_of(request.spec.a, atlas), errors);
    if (product == Product::json)
        refuse_others(of_mushroom, errors);
    else
        request.spec.params = read_mushroom_params(std::move(of_mushroom), errors);
    return request;
}

OffspringRequest read_offspring(std::string_view body, Product product, const Atlas& atlas,
                                ValidationErrors& errors) {
    OffspringRequest request;
    request.product = product;
    OffspringSpec& spec = request.spec;
    std::optional<Value> read = read_body(body, errors);
    if (!read) return request;
    Value& json = *read;
    const bool is_first_read = read_parent(json, "a", spec.a, errors),
               is_second_read = read_parent(json, "b", spec.b, errors);
    const bool are_parents_read = is_first_read && is_second_read;
    if (are_parents_read) check_parents(spec, "/", atlas, errors);
    std::vector<Problem> problems;
    request.version = take_version(json, problems);
    Value of_breeding = Value::object();
    for (const char* name : breeding_names)
        if (const Value* value = json.find(name)) of_breeding.set(name, *value);
    sporeprint::read(of_breeding, spec.breeding, Info{.name = ""}, "", problems);
    for (const char* name : breeding_names) json.erase(name);
    sort_locks(spec.breeding);
    const Species* const first = are_parents_read ? species_of(spec.a, atlas) : nullptr;
    if (problems.empty() && first)
        for (Problem& problem : lock_problems(*first, spec.breeding))
            problems.push_back({"/lock", std::move(problem.message)});
    errors.add(400, problems);
    without_negative_zero(spec.breeding);
    if (product == Product::json)
        for (const auto& [name, value] : json.members())
            errors.add(400, '/' + pointer_token(name),
                       "is of a mushroom; a species has a, b, seed, share, mutation and lock");
    else
        spec.params = read_mushroom_params(std::move(json), errors);
    return request;
}

std::string OffspringOfTwo::version(const OffspringSpec& spec, const Atlas& atlas) {
    Weights weights;
    for (const Parent* parent : {&spec.a, &spec.b})
        if (!parent->own && (weights.empty() || weights.front().first != parent->id))
            weights.emplace_back(parent->id, 1.0);
    return version_token(weights.empty() ? Mix{} : canonical_mix(std::move(weights)), atlas);
}

std::string OffspringOfTwo::document_version(const OffspringSpec& spec, const Atlas& atlas) {
    std::string templates = version(spec, atlas);
    for (const Parent* parent : {&spec.a, &spec.b})
        if (const AtlasEntry* entry = parent->own ? nullptr : atlas.find(parent->id))
            templates += '\n' + parent->id + ' ' + std::to_string(entry->ecology_hash);
    return token_of(templates);
}

std::string OffspringOfTwo::url(const OffspringSpec& spec, Product product, const Atlas&) {
    if (spec.a.own || spec.b.own) return {};
    std::string query = query_text(spec.breeding);
    const auto add = [&query](const std::string& more) {
        if (more.empty()) return;
        if (!query.empty()) query += '&';
        query += more;
    };
    for (const Text<64>& lock : spec.breeding.lock) add("lock=" + percent_encoded(lock));
    if (product != Product::json) {
        MushroomParams params = spec.params;
        if (params.seed != MushroomParams{}.seed)
            add(individual + ('=' + std::to_string(params.seed)));
        params.seed = MushroomParams{}.seed;
        add(query_text(params, with_profile(MushroomParams{}, params)));
    }
    return with_query("/v1/offspring/" + spec.a.id + '/' + spec.b.id + ending_of(product), query);
}

std::string OffspringOfTwo::key(const OffspringSpec& spec, Product product,
                                const std::string& version) {
    std::string key = ending_of(product) + (' ' + breeding_key(spec, version));
    if (product == Product::json) return key;
    key += '\n';
    canonical(spec.params, key);
    return key;
}

std::string OffspringOfTwo::file_name(const OffspringSpec& spec, Product product, const Atlas&) {
    std::string text = canonical_text(spec.breeding) + canonical_text(spec.params);
    for (const Parent* parent : {&spec.a, &spec.b})
        if (parent->own) canonical(*parent->own, text);
    std::uint32_t hash = XXH32(text.data(), text.size(), 0);
    std::string name = name_of_species(spec.a.id) + "_x_" + name_of_species(spec.b.id) + '_';
    for (int digit = 0; digit < 8; ++digit, hash <<= 4U) name += "0123456789abcdef"[hash >> 28U];
    if (product == Product::json) return name + ending_of(product);
    return sporeprint::file_name(name, spec.params.lod, spec.params.triangles, spec.params.file) +
           ending_of(product);
}

Cost OffspringOfTwo::cost(const Context& context, const OffspringSpec& spec, Product product,
                          const Caches& caches, Resolved& resolved) {
    if (product == Product::json) return search(spec, *context.atlas);
    const Context of_child = context_of_child(context, spec, caches, resolved);
    return Mushrooms::cost(of_child, mushroom_of(spec, id_of(*resolved.atlas)), product, caches,
                           resolved.individual);
}

Cost OffspringOfTwo::search(const OffspringSpec& spec, const Atlas& atlas) {
    if (family_of(*species_of(spec.a, atlas)) == Family::branched) return {.base = 2000};
    // The correspondences of the parents, of the proof and of the individual. A crossed outline has
    // the control points of both, so its proof takes longer.
    if (spec.a.own || spec.b.own || spec.a.id != spec.b.id)
        return {.base = 4500, .outlines = 4, .pairs = 1};
    return {.base = 1500, .outlines = 3};
}

Cost OffspringOfTwo::guess(const OffspringSpec& spec, Product product, const Atlas& atlas) {
    return Mushrooms::guess(mushroom_of(spec, spec.a.id), product, atlas);
}

ImageUrls OffspringOfTwo::image_urls(const Context&, const OffspringSpec&, const std::string&,
                                     const ExecutionContext&) {
    return {};
}

Body OffspringOfTwo::grow(const Context& context, const OffspringSpec& spec, Resolved& resolved,
                          const Extras& extras, int depth, const ExecutionContext& execution) {
    const Context of_child = context_of_child(context, spec, execution.caches, resolved);
    return Mushrooms::grow(of_child, mushroom_of(spec, id_of(*resolved.atlas)), resolved.individual,
                           extras, depth, execution);
}

Value OffspringOfTwo::describe(const Context& context, const OffspringSpec& spec,
                               Resolved& resolved, const std::string&,
                               const ExecutionContext& execution) {
    execution.observer(Step::resolve);
    if (!resolved.atlas) resolved.atlas = bred(context, spec, execution.caches);
    execution.observer(Step::pack);
    return write(resolved.atlas->entries().front().species);
}

namespace {

template <Product Format>
Plan plan_from_url(RouteCall& call) {
    return plan_product<OffspringOfTwo>(
        call.context, call.request,
        read_offspring(call.captured[0], call.captured[1], call.target.query, Format,
                       *call.context.atlas, call.errors),
        call.errors);
}

Plan plan_picture_from_url(RouteCall& call) {
    const PictureQuery query = read_picture_query(call.target.query, call.errors);
    return plan_picture<OffspringOfTwo>(
        call, query,
        read_offspring(call.captured[0], call.captured[1], query.product, Product::png,
                       *call.context.atlas, call.errors));
}

template <Product Format>
Plan plan_from_body(RouteCall& call) {
    refuse_query(call.target, call.errors);
    return plan_product<OffspringOfTwo>(
        call.context, call.request,
        read_offspring(call.request.body, Format, *call.context.atlas, call.errors), call.errors);
}

/// Returns the schema of the query of a species.
Value species_schema(const Atlas&) {
    Value out = schema<BreedingParams>();
    const std::string doc =
        "Parts that stay as in the first parent, separated by commas, or one lock each: such as "
        "surface.cap, silhouette or size. No other part changes with it.";
    out.find("properties")
        ->set("lock", object({{"type", "string"}, {"description", doc}, {"maxLength", 4000}}));
    return out;
}

/// Returns the schema of the query of a mushroom: that of mushrooms, whose `seed` is `individual`,
/// and whose images are its own.
Value mushroom_schema(const Atlas& atlas) {
    Value out = species_schema(atlas);
    Value& properties = *out.find("properties");
    const Value of_mushroom = schema<MushroomParams>();
    for (const auto& [name, property] : of_mushroom.find("properties")->members()) {
        if (name == "seed")
            properties.set(individual, property);
        else if (!is_of_breeding(name))
            properties.set(name, property);
    }
    return out;
}

/// Returns the schema of a body.
///
/// params  of what is made, beside the parents
Value order_schema(Value params) {
    const auto parent = [](const char* doc) {
        return object(
            {{"oneOf", Value(Value::Array{typed("string"), reference("schemas/species")})},
             {"description", doc}});
    };
    params.find("properties")
        ->set("lock", *schema<BreedingParams>().find("properties")->find("lock"));
    Value order = with_members({{"a", parent("The first parent: an id, or a whole species.")},
                                {"b", parent("The second parent, or the first again.")},
                                {"v", version_member()}},
                               std::move(params), "");
    order.set("required", Value(Value::Array{"a", "b"}));
    return order;
}

constexpr const char *json = "application/json", *glb = "model/gltf-binary";

constexpr Route routes[] = {
    {.kind = RouteKind::product,
     .method = "GET",
     .pattern = "/v1/offspring/{a}/{b}.glb",
     .id = "get_offspring",
     .summary = "Crosses two species, or mutates one named twice, and grows a mushroom of what "
                "comes of it.",
     .media_type = glb,
     .query_schema = mushroom_schema,
     .plan = plan_from_url<Product::glb>},
    {.kind = RouteKind::product,
     .method = "GET",
     .pattern = "/v1/offspring/{a}/{b}.json",
     .id = "breed_species",
     .summary = "The species that comes of two: as whole as one of the atlas.",
     .media_type = json,
     .response_schema = "species",
     .query_schema = species_schema,
     .plan = plan_from_url<Product::json>},
    {.kind = RouteKind::product,
     .method = "GET",
     .pattern = "/v1/offspring/{a}/{b}.png",
     .id = "draw_offspring",
     .summary = "A picture of a mushroom of the species that comes of two.",
     .media_type = "image/png",
     .query_schema = [](const Atlas& atlas) { return picture_schema(mushroom_schema(atlas)); },
     .plan = plan_picture_from_url},
    {.kind = RouteKind::product,
     .method = "POST",
     .pattern = "/v1/offspring.glb",
     .id = "post_offspring",
     .summary = "The same from a body, whose parents may be whole species of your own, such as "
                "offspring.",
     .media_type = glb,
     .body_type = json,
     .most_body = 4u << 20,  // species may have images
     .request_body = "offspring_order",
     .plan = plan_from_body<Product::glb>},
    {.kind = RouteKind::product,
     .method = "POST",
     .pattern = "/v1/offspring.json",
     .id = "post_breeding",
     .summary = "The species that comes of two, which may be of your own.",
     .media_type = json,
     .body_type = json,
     .most_body = 4u << 20,
     .response_schema = "species",
     .request_body = "breeding_order",
     .plan = plan_from_body<Product::json>},
};

void add_links(Value& links, const Atlas& atlas) {
    if (atlas.entries().size() > 1)  // an example of two species
        links.set("offspring", "/v1/offspring/" + atlas.entries()[0].species.id.string() + '/' +
                                   atlas.entries()[1].species.id.string() + ".glb");
}

void add_bodies(Value& bodies, const Atlas& atlas) {
    const Value example = object({{"a", example_id(atlas)}, {"b", other_id(atlas)}, {"seed", 7}});
    bodies
        .set("offspring_order",
             json_body("Two parents, the genes of their offspring, and how it is grown.",
                       order_schema(mushroom_schema(atlas)), example))
        .set("breeding_order", json_body("Two parents, and the genes of their offspring.",
                                         order_schema(species_schema(atlas)), example));
}

}  // namespace

const RouteGroup offspring_routes = {
    .tag = "offspring",
    .description = "Species bred of two, and mushrooms of them.",
    .routes = routes,
    .add_links = add_links,
    .add_bodies = add_bodies,
};

}  // namespace sporeprint::api
