#include "api/products/sets.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "api/http/compression.h"
#include "api/http/encoding.h"
#include "api/http/schemas.h"
#include "api/http/zip.h"
#include "api/products/mix.h"
#include "api/products/mushrooms.h"
#include "api/products/resource.h"
#include "core/grow/mushroom.h"
#include "core/grow/set_file.h"
#include "core/params/canonical.h"
#include "core/params/messages.h"
#include "core/params/profile.h"
#include "core/params/reader.h"
#include "core/params/schema.h"

namespace sporeprint::api {

namespace {

/// What a route responds with.
enum class Output { manifest, archive, file };

constexpr const char* ending_of(Output output) {
    switch (output) {
        case Output::manifest:
            return ".json";
        case Output::archive:
            return ".zip";
        case Output::file:
            return ".glb";
    }
    return nullptr;
}

constexpr const char* json = "application/json";

constexpr const char* type_of(Output output) {
    switch (output) {
        case Output::manifest:
            return json;
        case Output::archive:
            return "application/zip";
        case Output::file:
            return glb_type;
    }
    return nullptr;
}

/// Largest archive or file that is generated, bytes. A larger set is fetched by the URLs of its
/// manifest.
constexpr std::uint64_t most_archive_bytes = 256'000'000;

/// Parameters of a mushroom that a set chooses itself, and what a client gives instead.
constexpr std::pair<const char*, const char*> chosen[] = {
    {"seed", "first_seed and seeds"}, {"age", "ages"}, {"lod", "levels"}, {"triangles", "levels"}};

/// Reads the species of a set: a list of mixes as they stand in URLs.
std::vector<Mix> read_species(const Value& body, const Atlas& atlas, ValidationErrors& errors,
                              std::vector<Problem>& problems) {
    std::vector<Mix> mixes;
    const Value* const given = body.find("species");
    if (!given || !given->is_array() || given->items().empty()) {
        report(problems, "/species",
               !given ? "is missing; give {\"species\":[\"" + example_id(atlas) + "\"]}"
                      : "expected a list of species or mixes, got " + shown(*given));
        return mixes;
    }
    if (given->items().size() > most_set_species) {
        report(problems, "/species",
               std::to_string(given->items().size()) + " species; at most " +
                   std::to_string(most_set_species) + " are allowed");
        return mixes;
    }
    for (std::size_t i = 0; i < given->items().size(); ++i) {
        const std::string path = "/species/" + std::to_string(i);
        const Value& item = given->items()[i];
        if (!item.is_string()) {
            report(problems, path, "expected text, got " + shown(item));
            continue;
        }
        ValidationErrors of_mix;
        Mix mix = read_mix(item.as_string(), atlas, of_mix);
        for (const Problem& problem : of_mix.problems())
            errors.add(of_mix.status(), path, problem.message);
        if (of_mix.empty() && std::find(mixes.begin(), mixes.end(), mix) != mixes.end())
            report(problems, path, mix_text(mix) + " is given more than once");
        mixes.push_back(std::move(mix));
    }
    return mixes;
}

/// Moves the members that belong to the parameters of a set into an object of their own.
Value taken_set_params(Value& body) {
    Value own = Value::object();
    SetParams::fields([&](auto, const Info& info) {
        if (const Value* given = body.find(info.name)) own.set(info.name, *given);
        body.erase(info.name);
    });
    return own;
}

/// Returns the version token of a set: that of all of its templates.
std::string version_of(const SetSpec& spec, const Atlas& atlas) {
    std::string tokens;
    for (const Mix& mix : spec.species) tokens += version_token(mix, atlas) + '\n';
    return token_of(tokens);
}

Key key_of(const SetSpec& spec, const char* ending, const std::string& version) {
    Key key = std::string("set") + ending + ' ' + version;
    for (const Mix& mix : spec.species) (key += '\n') += mix_text(mix);
    key += '\n';
    canonical(spec.params, key);
    key += '\n';
    canonical(spec.mushroom, key);
    return key;
}

/// Calls visit(spec, individual, level) for every file of a plan.
template <class Visit>
void each_file(const SetSpec& spec, const SetPlan& plan, Visit visit) {
    for (const SetIndividual& individual : plan.individuals)
        for (std::size_t level = 0; level < spec.params.levels.size(); ++level)
            visit(file_spec(spec, individual, level), individual, level);
}

/// Returns the bounding box of an individual from its farthest level of detail, which is within a
/// few percent of all others.
Bounds bounds_of(MushroomSpec spec, const Context& context, const ExecutionContext& execution) {
    spec.params.lod = 3;
    spec.params.textures = Textures::none;
    return mushroom_bounds(spec, resolve(spec, *context.atlas, execution.caches.morphs));
}

/// Returns the manifest of a set.
///
/// sizes  bytes of each file, in order; empty where they are only estimated
Value manifest(const Context& context, const SetSpec& spec, const SetPlan& plan,
               const std::vector<std::uint64_t>& sizes, const ExecutionContext& execution) {
    const Atlas& atlas = *context.atlas;
    Value individuals = Value::array(), files = Value::array();
    std::uint64_t shown = 0, bytes = 0;
    std::size_t index = 0;
    for (const SetIndividual& one : plan.individuals) {
        throw_if_cancelled(execution);
        Value item = Value::object();
        item.set("species", mix_text(spec.species[one.species]));
        item.set("seed", one.params.seed).set("age", one.params.age).set("shown", one.shown);
        item.set("bounds_m", description(bounds_of(file_spec(spec, one, 0), context, execution)));
        shown += one.shown;
        individuals.push(std::move(item));
    }
    std::size_t individual = 0;
    each_file(spec, plan, [&](const MushroomSpec& file, const SetIndividual& one, std::size_t i) {
        const std::string version = version_token(file.mix, atlas);
        const std::uint64_t size = index < sizes.size() ? sizes[index] : one.files[i].bytes;
        Value item = Value::object();
        item.set("name", Mushrooms::file_name(file, Product::glb, *context.atlas));
        item.set("url", context.responses.link(with_version(canonical_address(file), version)));
        item.set("individual", individual).set("lod", file.params.lod);
        item.set("vertices", one.files[i].vertices).set("triangles", one.files[i].triangles);
        item.set("bytes", size);
        if (has_addresses(file.params.textures)) {
            Value images = Value::array();
            const auto add_images = [&](const ImageUrls& urls) {
                for (const std::string& url :
                     file.params.file.image_format == ImageFormats::jpg ? urls.jpg : urls.webp)
                    images.push(context.responses.link(url));
            };
            add_images(Mushrooms::image_urls(context, file, version, execution));
            if (const std::optional<ImageUrls> wood =
                    Mushrooms::wood_urls(file, resolve(file, atlas, execution.caches.morphs)))
                add_images(*wood);
            item.set("images", std::move(images));
        }
        files.push(std::move(item));
        bytes += size;
        if (i + 1 == spec.params.levels.size()) ++individual;
        ++index;
    });
    Value body = Value::object();
    body.set("v", version_of(spec, atlas));
    body.set("seeds", plan.seeds).set("texture_size", plan.texture_size);
    body.set("individuals", std::move(individuals)).set("files", std::move(files));
    body.set("totals", Value::object()
                           .set("files", index)
                           .set("shown", shown)
                           .set("draw_calls", index)
                           .set("triangles", plan.total().triangles)
                           .set("bytes", bytes));
    return body;
}

/// Returns the archive of a set: its files and their manifest.
Body archive(const Context& context, const SetSpec& spec, const SetPlan& plan,
             const ExecutionContext& execution) {
    std::vector<ArchiveFile> files;
    std::vector<std::uint64_t> sizes;
    each_file(spec, plan, [&](const MushroomSpec& file, const SetIndividual&, std::size_t) {
        throw_if_cancelled(execution);
        const Individual individual = resolve(file, *context.atlas, execution.caches.morphs);
        Extras extras;
        extras.canonical = canonical_address(file);
        Body glb = grow_mushroom(file, individual, *context.atlas, extras, execution).glb;
        sizes.push_back(size_of(glb));
        files.push_back({Mushrooms::file_name(file, Product::glb, *context.atlas), std::move(glb)});
    });
    files.push_back(
        {"manifest.json", {slice_of(dump(manifest(context, spec, plan, sizes, execution)))}});
    return zip_archive(files);
}

/// Returns the cost of copying images into atlases and of encoding free tiles, beside that of the
/// images.
Cost cost_of_atlases(const SetSpec& spec) {
    const std::size_t tiles = tiles_of_atlas(spec);
    if (tiles == 0 || tiles > most_tiles) return {};  // refused later
    const auto side =
        static_cast<std::uint64_t>(spec.mushroom.texture_size.value >> spec.params.levels.front());
    const std::uint64_t texels = atlases_of(spec) * grid_of(tiles).size() * 3 * side * side;
    Cost cost{.pixels = texels};
    if (spec.mushroom.file.image_format != ImageFormats::jpg)
        cost.webp_texels = texels - texels / grid_of(tiles).size() * tiles;
    return cost;
}

/// Returns the approximate cost of a set, from its counts alone.
///
/// is_made  its files are generated, not only listed
Cost guessed_cost(const SetSpec& spec, bool is_made, const Atlas& atlas) {
    Cost cost{.base = 200};
    for (const Mix& mix : spec.species) {
        MushroomSpec file{.mix = mix, .model = {}, .params = spec.mushroom};
        cost += Mushrooms::search(file, atlas);
        const std::uint64_t of_mix =
            spec.params.ages.size() * static_cast<std::uint64_t>(spec.params.seeds);
        cost += cost_of_individuals(mix, is_branched(mix, atlas), 2 * of_mix);
        cost.vertices += 400 * of_mix;  // of the farthest level
        if (!is_made) continue;
        if (spec.packing == SetPacking::one_file) {
            file.params.file.lods = Lods::single;
            file.params.substrate = Substrate::none;
        }
        for (std::size_t level = 0; level < spec.params.levels.size(); ++level) {
            file.params.lod = spec.params.levels[level];
            for (int seed = 0; seed < spec.params.seeds; ++seed) {
                file.params.textures = counted_textures(spec, seed, level);
                const Cost one = Mushrooms::guess(file, Product::glb, atlas);
                for (std::size_t age = 0; age < spec.params.ages.size(); ++age) cost += one;
            }
        }
    }
    if (is_made) cost += cost_of_atlases(spec);
    return cost;
}

/// Throws Impossible for more files than one request may have.
void refuse_large(const SetSpec& spec, const Cost& cost, bool is_made) {
    if (const std::uint64_t files = most_files(spec); files > most_set_files)
        throw Impossible("/seeds", std::to_string(files) + " files; at most " +
                                       std::to_string(most_set_files) +
                                       " are made. Lower seeds, ages or levels, or ask for some "
                                       "of the species");
    if (is_made && spec.params.megabytes == 0.0 && cost.bytes > most_archive_bytes)
        throw Impossible("/megabytes",
                         "it would have about " + std::to_string(cost.bytes / 1'000'000) +
                             " MB; at most " + std::to_string(most_archive_bytes / 1'000'000) +
                             " are made. Give a budget of megabytes, lower seeds "
                             "or levels, or fetch the files of the manifest");
    if (is_made && spec.params.megabytes * 1e6 > static_cast<double>(most_archive_bytes))
        throw Impossible("/megabytes",
                         number_text(spec.params.megabytes) + " MB in one response; at most " +
                             std::to_string(most_archive_bytes / 1'000'000) + " are made");
}

/// Throws Impossible for a file of more vertices than one request may have.
void refuse_over_budget(const ServiceOptions& options, const SetPlan& plan) {
    if (const std::uint64_t vertices = plan.total().vertices; vertices > options.most_vertices)
        throw Impossible("/seeds", std::to_string(vertices) +
                                       " vertices would be made in one file; at most " +
                                       std::to_string(options.most_vertices) +
                                       " are. Lower seeds, ages or levels, or fetch the files of "
                                       "the manifest");
}

/// Returns one file of a set.
///
/// depth  link_depth() of the request
Body file_of(const Context& context, const SetSpec& spec, const SetPlan& plan, int depth,
             const ExecutionContext& execution) {
    const auto links = [&](const MushroomSpec& one) {
        return references_from(depth, Mushrooms::image_urls(context, one, {}, execution));
    };
    return grow_set(spec, plan, *context.atlas, links, execution).glb;
}

template <Output Made>
Plan plan_set(RouteCall& call) {
    Context& context = call.context;
    refuse_query(call.target, call.errors);
    SetRequest requested = read_set(call.request.body, *context.atlas, call.errors);
    if (!call.errors.empty()) return context.responses.problem(call.request, call.errors);
    constexpr bool is_made = Made != Output::manifest;
    if (Made == Output::file) requested.spec.packing = SetPacking::one_file;
    const auto spec = std::make_shared<const SetSpec>(std::move(requested.spec));
    Resource resource;
    resource.version = version_of(*spec, *context.atlas);
    resource.key = key_of(*spec, ending_of(Made), resource.version);
    resource.type = type_of(Made);
    resource.file_name = std::string("mushrooms") + ending_of(Made);
    resource.is_linked = Made == Output::file && has_addresses(spec->mushroom.textures);
    resource.requested_version = std::move(requested.version);
    resource.estimate_cost = [&context, spec](const Caches&) {
        const Cost cost = guessed_cost(*spec, is_made, *context.atlas);
        if (Made == Output::file)
            refuse_in_one_file(*spec);
        else
            refuse_impossible_atlas(*spec);
        if (Made == Output::archive && has_addresses(spec->mushroom.textures))
            throw Impossible("/textures",
                             "links of files in an archive lead nowhere; ask for embedded or none");
        refuse_large(*spec, cost, is_made);
        return cost;
    };
    resource.make = [&context, spec,
                     depth = link_depth(context, call.request)](JobContext& job) -> Body {
        const ExecutionContext& execution = job.execution();
        execution.observer(Step::resolve);
        const SetPlan plan = planned_set(*spec, *context.atlas, execution);
        for (const SetIndividual& one : plan.individuals)
            for (const Estimate& file : one.files)
                refuse_over_budget(context.options, file, false, false, spec->mushroom.file);
        execution.observer(Step::build);
        if (Made == Output::archive) return archive(context, *spec, plan, execution);
        if (Made == Output::file) {
            refuse_over_budget(context.options, plan);
            return file_of(context, *spec, plan, depth, execution);
        }
        return {slice_of(dump(manifest(context, *spec, plan, {}, execution)))};
    };
    return plan_resource(context, call.request, std::move(resource), call.errors);
}

constexpr Route routes[] = {
    {.kind = RouteKind::product,
     .method = "POST",
     .pattern = "/v1/sets.json",
     .id = "plan_set",
     .summary = "The files of a set of mushrooms within a budget of bytes and draw calls: names, "
                "URLs, sizes, triangles and bounds.",
     .media_type = json,
     .body_type = json,
     .response_schema = "set_manifest",
     .request_body = "set_order",
     .plan = plan_set<Output::manifest>},
    {.kind = RouteKind::product,
     .method = "POST",
     .pattern = "/v1/sets.zip",
     .id = "post_set",
     .summary = "The files of a set and their manifest in one archive.",
     .media_type = "application/zip",
     .body_type = json,
     .request_body = "set_order",
     .plan = plan_set<Output::archive>},
    {.kind = RouteKind::product,
     .method = "POST",
     .pattern = "/v1/sets.glb",
     .id = "post_set_file",
     .summary = "A set in one file: individuals on a grid at all their levels, those with the same "
                "images with one material; asset.extras lists them.",
     .media_type = glb_type,
     .body_type = json,
     .request_body = "set_order",
     .plan = plan_set<Output::file>},
};

/// Returns the schema of the parameters of a body beside its species.
Value order_schema() {
    Value schema = sporeprint::schema<SetParams>();
    Value& properties = *schema.find("properties");
    for (const char* list : {"ages", "levels"})
        properties.find(list)->set("minItems", 1).set("uniqueItems", true);
    const Value mushroom = sporeprint::schema<MushroomParams>();
    // Of two parameters with one name, such as `seeds`, the set has its own.
    for (const auto& [name, property] : mushroom.find("properties")->members())
        if (!properties.find(name) &&
            std::none_of(std::begin(chosen), std::end(chosen),
                         [&, &name = name](const auto& one) { return name == one.first; }))
            properties.set(name, property);
    return schema;
}

void add_schemas(Value& schemas, const Atlas&) {
    const Value text = typed("string"), number = typed("number"), count = typed("integer");
    Value file = objects({{"name", text},
                          {"url", text},
                          {"individual", count},
                          {"lod", count},
                          {"vertices", count},
                          {"triangles", count},
                          {"bytes", count}});
    file.find("properties")->set("images", list_of(text));
    schemas.set("set_manifest",
                objects({{"v", text},
                         {"seeds", count},
                         {"texture_size", count},
                         {"individuals", list_of(objects({{"species", text},
                                                          {"seed", count},
                                                          {"age", number},
                                                          {"shown", count},
                                                          {"bounds_m", bounds_schema()}}))},
                         {"files", list_of(std::move(file))},
                         {"totals", objects({{"files", count},
                                             {"shown", count},
                                             {"draw_calls", count},
                                             {"triangles", count},
                                             {"bytes", count}})}}));
}

void add_bodies(Value& bodies, const Atlas& atlas) {
    Value species = object({{"type", "array"},
                            {"description", "Species, or mixes as they stand in URLs."},
                            {"items", typed("string")},
                            {"minItems", 1},
                            {"uniqueItems", true},
                            {"maxItems", most_set_species}});
    bodies.set(
        "set_order",
        json_body("Species, the individuals and levels of each, and a budget.",
                  with_members({{"species", std::move(species)}, {"v", version_member()}},
                               order_schema(), "species"),
                  object({{"species", Value(Value::Array{example_id(atlas), other_id(atlas)})},
                          {"ages", Value(Value::Array{0.3, 0.6})},
                          {"seeds", 8},
                          {"levels", Value(Value::Array{1, 2, 3})},
                          {"individuals", 300},
                          {"draw_calls", 100},
                          {"megabytes", 30},
                          {"profile", "web"}})));
}

}  // namespace

SetRequest read_set(std::string_view body, const Atlas& atlas, ValidationErrors& errors) {
    SetRequest request;
    std::optional<Value> read_json = read_body(body, errors);
    if (!read_json) return request;
    Value& order = *read_json;
    std::vector<Problem> problems;
    request.spec.species = read_species(order, atlas, errors, problems);
    order.erase("species");
    request.version = take_version(order, problems);
    for (const auto& [name, instead] : chosen)
        if (order.find(name)) {
            report(problems, std::string("/") + name,
                   std::string("is chosen by the set; give ") + instead);
            order.erase(name);
        }
    errors.add(400, problems);
    problems.clear();
    const Value own = taken_set_params(order);
    read(own, request.spec.params, Info{.name = ""}, "", problems);
    add_problems(problems, request.spec.params, "", true, errors);
    problems.clear();
    std::sort(request.spec.params.levels.begin(), request.spec.params.levels.end());
    apply_profile(requested_profile(order), request.spec.mushroom);
    read(order, request.spec.mushroom, Info{.name = ""}, "", problems);
    drop_excluded_defaults(request.spec.mushroom, named_options(order));
    add_problems(problems, request.spec.mushroom, "", true, errors);
    without_negative_zero(request.spec.params);
    without_negative_zero(request.spec.mushroom);
    return request;
}

const RouteGroup set_routes = {.tag = "sets",
                               .description = "Many mushrooms of several species for one scene.",
                               .routes = routes,
                               .add_links = nullptr,
                               .add_schemas = add_schemas,
                               .add_bodies = add_bodies};

}  // namespace sporeprint::api
