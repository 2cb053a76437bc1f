#include "api/products/worlds/part_request.h"

#include <memory>
#include <string_view>

#include "api/http/schemas.h"
#include "api/products/product.h"
#include "api/products/worlds/edits.h"
#include "core/params/messages.h"

namespace sporeprint::api {

namespace {

constexpr const char* some_time = "y80d270";

bool is_posted(const RouteCall& call) { return call.request.method == "POST"; }

/// Removes a text from a body. If it is none, that is an error.
std::optional<std::string> take_text(Value& body, const char* name, std::string_view example,
                                     ValidationErrors& errors) {
    std::optional<std::string> text;
    const std::string path = std::string("/") + name;
    if (const Value* const given = body.find(name); !given)
        errors.add(400, path, "is missing; give a text such as " + in_quotes(example));
    else if (!given->is_string())
        errors.add(400, path, "expected text, got " + shown(*given));
    else
        text = given->as_string();
    body.erase(name);
    return text;
}

/// Returns the first of the presets.
std::string some_world(const Atlas& atlas) { return atlas.worlds().front().id.string(); }

/// Reads the text of a world in a body, whose errors are those of one member.
WorldRequest read_world_member(std::string_view text, const Context& context,
                               ValidationErrors& errors) {
    ValidationErrors of_text;
    WorldRequest world = read_world(text, context, of_text);
    for (const Problem& problem : of_text.problems())
        errors.add(
            of_text.status(), "/world",
            problem.path == "world" ? problem.message : problem.path + ": " + problem.message);
    return world;
}

PartRequest read_body_of_part(const RouteCall& call, ValidationErrors& errors) {
    const Atlas& atlas = *call.context.atlas;
    PartRequest part;
    std::optional<Value> body = read_body(call.request.body, errors);
    part.body = body ? std::move(*body) : Value::object();
    const std::string world = some_world(atlas);
    if (!body) {
        part.world = read_world(world, atlas, errors);
        part.time = some_time;
        return part;
    }
    const std::optional<std::string> text = take_text(*part.body, "world", world, errors);
    part.world = read_world_member(text.value_or(world), call.context, errors);
    part.time = take_text(*part.body, "time", some_time, errors).value_or(some_time);
    std::vector<Problem> problems;
    if (std::optional<std::string> version = take_version(*part.body, problems))
        part.world.version = std::move(version);
    errors.add(400, problems);
    part.world.edits = take_edits(*part.body, part.world.spec.params, atlas, errors);
    return part;
}

}  // namespace

PartRequest read_part(const RouteCall& call, ValidationErrors& errors) {
    if (is_posted(call)) return read_body_of_part(call, errors);
    PartRequest part;
    part.world = read_world(call.captured[0], call.context, errors);
    part.time = call.captured[1];
    part.query = query_of_world(call.target, errors);
    return part;
}

void finish_reading(const RouteCall& call, ValidationErrors& errors) {
    if (!is_posted(call)) return;
    errors.point_into_body();
    refuse_query(call.target, errors);
}

Value part_body_schema(const Atlas& atlas, Value params) {
    Value::Object first = {
        {"world",
         object({{"type", "string"},
                 {"maxLength", longest_world},
                 {"description", "A preset and what differs from it, as in the path of GET: " +
                                     some_world(atlas) + ",seed=7."}})},
        {"time", object({{"type", "string"},
                         {"pattern", "^y\\d{1,3}(d\\d{1,3})?$"},
                         {"description", "A year and a day, as in the path of GET: y80d270."}})},
        {"v", version_member()}};
    for (Value::Member& member : edit_members()) first.push_back(std::move(member));
    Value schema = with_members(std::move(first), std::move(params), "");
    return schema.set("required", Value(Value::Array{"world", "time"}));
}

Value part_body_example(const Atlas& atlas) {
    return object({{"world", some_world(atlas) + ",seed=7,extent=256"}, {"time", some_time}});
}

}  // namespace sporeprint::api
