#include "api/products/traces.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "api/http/schemas.h"
#include "api/products/context.h"
#include "api/products/mix.h"
#include "api/products/photos.h"
#include "api/products/product.h"
#include "core/grow/species_from_photo.h"
#include "core/params/reader.h"
#include "core/params/schema.h"
#include "core/trace/outline_check.h"
#include "core/trace/photo_file.h"

namespace sporeprint::api {

namespace {

constexpr const char* json = "application/json";

// --- Responses --------------------------------------------------------------------------

double rounded(double value, double unit) { return std::round(value / unit) * unit; }

double hundredths(double value) { return std::round(value * 100.0) / 100.0; }

Value point(const glm::dvec2& pixel) {
    return Value::Array{hundredths(pixel.x), hundredths(pixel.y)};
}

Value points(std::span<const glm::dvec2> pixels) {
    Value list = Value::array();
    for (const glm::dvec2& pixel : pixels) list.push(point(pixel));
    return list;
}

double percent(double share) { return hundredths(100.0 * share); }

Value named(const std::vector<NearSpecies>& nearest, const Atlas& atlas) {
    Value list = Value::array();
    for (const NearSpecies& one : nearest) {
        Value species = Value::object();
        species.set("id", one.id);
        species.set("name", atlas.find(one.id)->species.facts.common_name.view());
        species.set("age", one.age);
        species.set("shape_pct", percent(one.apart.shape));
        species.set("colour", hundredths(one.apart.colour));
        list.push(std::move(species));
    }
    return list;
}

Value trace_body(const SpeciesFromPhoto& found, const Atlas& atlas) {
    const trace::Traced& traced = found.traced;
    Value outline = Value::object();
    outline.set("left", points(traced.left)).set("right", points(traced.right));
    outline.set("axis", points(traced.axis));
    Value marks = Value::object();
    marks.set("junctions", points(traced.junctions)).set("margins", points(traced.margins));
    marks.set("cap_turn_deg", hundredths(traced.cap_turn_deg.value_or(0.0)));
    Value angles = Value::object();
    angles.set("lean_deg", hundredths(traced.lean_deg))
        .set("bend_deg", hundredths(traced.bend_deg));
    angles.set("pitch_deg", traced.pitch_deg ? Value(hundredths(*traced.pitch_deg)) : Value());
    Value ring;
    if (traced.ring) {
        ring.set("height_m", rounded(traced.ring->height_m, 1e-6));
        ring.set("width_m", rounded(traced.ring->width_m, 1e-6));
    }
    Value warnings = Value::array();
    for (const TraceWarning& warning : found.warnings) {
        Value one = Value::object();
        one.set("code", warning.code).set("detail", warning.detail);
        warnings.push(std::move(one));
    }
    Value body = Value::object();
    body.set("outline", std::move(outline)).set("marks", std::move(marks));
    body.set("angles", std::move(angles));
    body.set("asymmetry_pct", percent(traced.asymmetry)).set("error_pct", percent(traced.error));
    body.set("ring", std::move(ring));
    body.set("nearest", named(found.nearest, atlas)).set("template", found.template_id);
    body.set("form", trace::name(traced.form)).set("method", trace::name(traced.method));
    body.set("certificate", write(found.whole.certificate));
    body.set("likeness", found.whole.likeness);
    body.set("warnings", std::move(warnings));
    body.set("stage", found.whole.stage).set("species", write(found.whole.species));
    return body;
}

/// Reads a body as a described struct, and what is wrong with it.
template <class Spec>
std::pair<Spec, std::vector<Problem>> read_spec(std::string_view body, ValidationErrors& errors) {
    std::pair<Spec, std::vector<Problem>> read;
    if (const std::optional<Value> value = read_body(body, errors))
        read.first = read_all<Spec>(*value, read.second);
    return read;
}

// --- Traces -----------------------------------------------------------------------------

Picture decoded(const StoredPhoto& photo) {
    return decoded_layers({photo.jpeg.data(), photo.jpeg.size}, trace::decoded_side, "").picture;
}

/// Returns what a gesture cuts out of a photograph, which the last trace of it has perhaps cut out already; the cut
/// of `made` otherwise, which is stored.
template <class Make>
std::shared_ptr<const StoredCut> cut_of(Photos& photos, std::string_view name,
                                        const std::string& gesture, Make made) {
    const auto now = std::chrono::steady_clock::now();
    if (auto known = photos.cut(name, gesture, now)) return known;
    auto cut = std::make_shared<const StoredCut>(made());
    photos.store_cut(name, cut, now);
    return cut;
}

/// A view of a trace with its photograph.
struct PhotographedView {
    std::string_view name;
    std::string path;     ///< in the TraceSpec
    std::string gesture;  ///< canonical text; empty for none
    std::shared_ptr<const StoredPhoto> photo;

    [[nodiscard]] bool is_cut(Photos& photos) const {
        return photo->cut_out || photos.cut(name, gesture, std::chrono::steady_clock::now());
    }
};

MushroomOnPhoto mushroom_on_stored(Photos& photos, const PhotographedView& view,
                                   const trace::TraceSpec& spec) {
    const StoredPhoto& photo = *view.photo;
    if (spec.outline) {
        const auto last = photos.last_cut(view.name, std::chrono::steady_clock::now());
        return last ? outlined_on(last->picture, {photo.width, photo.height}, spec)
                    : mushroom_on(decoded(photo), photo.cut_out, spec);
    }
    const auto cut = cut_of(photos, view.name, view.gesture, [&] {
        MushroomOnPhoto on = mushroom_on(decoded(photo), photo.cut_out, spec);
        return StoredCut{view.gesture, std::move(on.picture), std::move(on.mask)};
    });
    return {cut->picture, cut->mask, static_cast<double>(cut->picture.width) / photo.width};
}

trace::FaceView face_on_stored(Photos& photos, const PhotographedView& view,
                               const trace::FaceViewSpec& spec) {
    const StoredPhoto& photo = *view.photo;
    const auto cut = cut_of(photos, view.name, view.gesture, [&] {
        trace::FaceView face = face_on(decoded(photo), photo.cut_out, spec, view.path);
        return StoredCut{view.gesture, std::move(face.picture), std::move(face.mask)};
    });
    return face_on_copy(cut->picture, cut->mask, {photo.width, photo.height}, spec, view.path);
}

/// Finds the photograph of a view and what is missing of it.
template <class View>
PhotographedView photographed(Photos& photos, const View& view, const char* path, bool needs_none,
                              ValidationErrors& errors) {
    PhotographedView found{view.photo.view(), path,
                           view.gesture ? dump(write(*view.gesture)) : std::string(),
                           photos.find(view.photo.view(), std::chrono::steady_clock::now())};
    if (!found.photo)
        errors.add(404, found.path + "/photo", photo_is_gone);
    else if (!found.photo->cut_out && !view.gesture && !needs_none)
        errors.add(422, found.path + "/gesture",
                   "is missing; only a picture that is cut out already, or an outline with marks, "
                   "needs none");
    return found;
}

/// The views of a trace.
struct PhotographedViews {
    PhotographedView side;
    std::optional<PhotographedView> above, below;
};

Plan plan_trace(RouteCall& call) {
    refuse_query(call.target, call.errors);
    Context& context = call.context;
    ValidationErrors& errors = call.errors;
    auto read = read_spec<trace::TraceSpec>(call.request.body, errors);
    for (Problem& problem : read.second)
        if (problem.path.starts_with("/views/") && problem.path.ends_with("/gesture") &&
            problem.message.starts_with("null"))
            problem.message =
                "expected an object with the line axis, got null; leave it out for a picture that "
                "is cut out already";
    errors.add(400, read.second);
    const auto spec = std::make_shared<const trace::TraceSpec>(std::move(read.first));
    if (errors.empty() && spec->template_id.view() != "auto" &&
        !find_species(spec->template_id.view(), *context.atlas))
        errors.add(404, "/template", unknown_species(spec->template_id.view(), *context.atlas));
    if (!errors.empty()) return context.responses.problem(call.request, errors);

    Photos& photos = context.store.photos;
    const trace::ViewsSpec& written = spec->views;
    auto views = std::make_shared<PhotographedViews>();
    views->side =
        photographed(photos, written.side, "/views/side", spec->outline.has_value(), errors);
    if (written.above)
        views->above = photographed(photos, *written.above, "/views/above", false, errors);
    if (written.below)
        views->below = photographed(photos, *written.below, "/views/below", false, errors);
    if (!errors.empty()) return context.responses.problem(call.request, errors);

    Cost cost{.base = spec->images ? 80'000U : 0U};
    cost.base += spec->outline || views->side.is_cut(photos) ? 80'000U : 400'000U;
    for (const auto* face : {&views->above, &views->below})
        if (*face) cost.base += (*face)->is_cut(photos) ? 80'000U : 400'000U;
    auto run = [spec, views, &context](const std::stop_token& stop, const Observer& observer,
                                       const Parallel& parallel) {
        const auto go_on = [&stop] {
            if (stop.stop_requested()) throw Cancelled();
        };
        Photos& stored = context.store.photos;
        observer(Step::resolve);
        const MushroomOnPhoto on = mushroom_on_stored(stored, views->side, *spec);
        go_on();
        FacesOnPhotos faces;
        if (views->above) faces.above = face_on_stored(stored, *views->above, *spec->views.above);
        go_on();
        if (views->below) faces.below = face_on_stored(stored, *views->below, *spec->views.below);
        go_on();
        const NearestSpecies& nearest = context.nearest.get(*context.atlas, parallel);
        go_on();
        observer(Step::build);
        return private_json(trace_body(
            species_from_photo(on, faces, *spec, *context.atlas, nearest), *context.atlas));
    };
    return Job{"trace " + std::to_string(context.store.uploads++), cost, std::move(run)};
}

// --- Outlines ---------------------------------------------------------------------------

Plan plan_outline_check(RouteCall& call) {
    refuse_query(call.target, call.errors);
    auto read = read_spec<trace::OutlineSpec>(call.request.body, call.errors);
    add_problems(read.second, read.first, "", true, call.errors);
    auto spec = std::make_shared<trace::OutlineSpec>(std::move(read.first));
    if (!call.errors.empty()) return call.context.responses.problem(call.request, call.errors);
    auto run = [spec](const std::stop_token&, const Observer& observer, const Parallel&) {
        observer(Step::resolve);
        const std::optional<trace::OutlineProblem> problem = trace::outline_problem(*spec);
        Value where;
        if (problem)
            where.set("curve", problem->curve)
                .set("index", problem->index)
                .set("detail", problem->detail);
        Value body = Value::object();
        body.set("simple", !problem).set("method", name(ProofMethod::exact));
        body.set("problem", std::move(where));
        return private_json(body);
    };
    return Job{"outline " + std::to_string(call.context.store.uploads++), Cost{.base = 300},
               std::move(run)};
}

// --- Routes -----------------------------------------------------------------------------

constexpr Route routes[] = {
    {.kind = RouteKind::upload,
     .method = "POST",
     .pattern = "/v1/traces",
     .id = "trace",
     .summary = "The species of a photographed mushroom. For pictures, never for identifying "
                "mushrooms to eat.",
     .media_type = json,
     .body_type = json,
     .response_schema = "trace",
     .request_body = "trace_order",
     .plan = plan_trace},
    {.kind = RouteKind::upload,
     .method = "POST",
     .pattern = "/v1/outlines/check",
     .id = "check_outline",
     .summary = "Whether an outline can be grown: it neither crosses itself nor folds on its axis.",
     .media_type = json,
     .body_type = json,
     .response_schema = "outline_check",
     .request_body = "outline",
     .plan = plan_outline_check},
};

/// Returns the schema of a value that may be null.
Value or_null(Value schema) {
    return object({{"oneOf", Value(Value::Array{std::move(schema), typed("null")})}});
}

Value described(Value schema, const char* description) {
    schema.set("description", description);
    return schema;
}

/// Returns the schema of the names of an enum from one of them on.
template <class Enum>
Value one_of(int first) {
    Value names = Value::array();
    for (int i = first; const char* one = name(static_cast<Enum>(i)); ++i) names.push(one);
    return object({{"type", "string"}, {"enum", std::move(names)}});
}

void add_schemas(Value& schemas, const Atlas&) {
    const Value text = typed("string"), number = typed("number"), whole = typed("integer");
    const Value pixel =
        object({{"type", "array"}, {"items", number}, {"minItems", 2}, {"maxItems", 2}});
    const Value line = list_of(pixel);
    const Value warning = objects({{"code", text}, {"detail", text}});
    const Value near = objects(
        {{"id", text}, {"name", text}, {"age", number}, {"shape_pct", number}, {"colour", number}});
    schemas.set(
        "trace",
        objects(
            {{"outline",
              described(objects({{"left", line}, {"right", line}, {"axis", line}}),
                        "On the photograph, in its pixels: both sides from the foot to the apex, "
                        "and the axis.")},
             {"marks",
              described(objects({{"junctions", line}, {"margins", line}, {"cap_turn_deg", number}}),
                        "Where stem and lower face meet, and the margin of the cap: left "
                        "and right; how the cap stands against the top of the stem, to "
                        "the right where positive. Outline, marks and form, sent back, "
                        "give the same shape without a cut.")},
             {"angles",
              described(
                  objects(
                      {{"lean_deg", number}, {"bend_deg", number}, {"pitch_deg", or_null(number)}}),
                  "Of the line from the foot to the top of the stem, to the right where "
                  "positive; between the directions of the axis at the foot and at the "
                  "cap; of the camera above the horizon, null where it cannot be told from "
                  "how far the margin of the cap hangs before the stem.")},
             {"asymmetry_pct",
              described(number, "Half the mean distance between both sides, in % of the height.")},
             {"error_pct", described(number,
                                     "Greatest distance of the species' outline from the "
                                     "photographed one, in % of the height.")},
             {"ring",
              described(or_null(objects({{"height_m", number}, {"width_m", number}})),
                        "How high above the foot a ring is, and how far it stands out from the "
                        "stem.")},
             {"nearest", described(list_of(near),
                                   "The species that it looks like, the nearest first: no "
                                   "identification. How far outlines differ, in % of the height, "
                                   "and colours, as a distance in L*a*b* with L* halved.")},
             {"template", described(text,
                                    "The species that lends what the photograph does not "
                                    "show.")},
             {"form", described(one_of<trace::Form>(1), "How the mushroom is built.")},
             {"method",
              described(one_of<trace::TraceMethod>(0),
                        "refined: what grows has the contour of the photograph, by comparing "
                        "both; fitted: the mean of both sides, which is nearer to the contour; "
                        "straightened: the stem would fold as it is bent on the "
                        "photograph; simplified: the outline would cross itself; template: neither "
                        "can be grown, so it is the template's, stretched to the same "
                        "heights and widths.")},
             {"certificate", reference("schemas/certificate")},
             {"likeness",
              described(
                  number,
                  "How far other ages have the proportions of the photographed one, 0 to 1.")},
             {"warnings",
              described(list_of(warning),
                        "asymmetry, method, likeness, reversed, soil or images, each with "
                        "a sentence.")},
             {"stage", described(whole,
                                 "The stage of the species that was photographed, from "
                                 "0.")},
             {"species", reference("schemas/species")}}));
    schemas.set(
        "outline_check",
        objects({{"simple", typed("boolean")},
                 {"method", text},
                 {"problem",
                  or_null(objects({{"curve", text}, {"index", whole}, {"detail", text}}))}}));
}

void add_bodies(Value& bodies, const Atlas&) {
    const auto pixel = [](double x, double y) { return Value(Value::Array{x, y}); };
    Value order = schema<trace::TraceSpec>();
    const auto require = [](Value& object, const char* member) -> Value& {
        object.set("required", Value(Value::Array{member}));
        return *object.find("properties")->find(member);
    };
    Value& views = require(order, "views");
    static_cast<void>(require(require(views, "side"), "photo"));
    for (const char* face : {"above", "below"})
        static_cast<void>(require(*views.find("properties")->find(face), "photo"));
    const auto give_example = [&order](const char* member, Value example) {
        order.find("properties")
            ->find(member)
            ->set("examples", Value(Value::Array{std::move(example)}));
    };
    const auto side = [&](double outwards) {
        const auto at = [&](double x, double y) { return pixel(512 + outwards * x, y); };
        return Value(Value::Array{at(0, 900), at(60, 890), at(60, 700), at(60, 500), at(60, 400),
                                  at(280, 410), at(290, 360), at(200, 200), at(0, 120)});
    };
    give_example("outline",
                 object({{"left", side(-1)},
                         {"right", side(1)},
                         {"axis", Value(Value::Array{pixel(512, 900), pixel(512, 120)})}}));
    give_example("marks",
                 object({{"junctions", Value(Value::Array{pixel(452, 400), pixel(572, 400)})},
                         {"margins", Value(Value::Array{pixel(232, 410), pixel(792, 410)})}}));
    bodies.set(
        "trace_order",
        json_body(
            "Stored photographs, where the mushroom is on them, and what is known "
            "beside them.",
            std::move(order),
            object(
                {{"views",
                  object({{"side",
                           object({{"photo", "AAAAAAAAAAAAAAAAAAAAAA"},
                                   {"gesture",
                                    object({{"axis",
                                             Value(Value::Array{pixel(512, 900), pixel(512, 120)})},
                                            {"cap", Value(Value::Array{pixel(250, 200),
                                                                       pixel(780, 200)})}})}})}})},
                 {"height_m", 0.08}})));
    Value outline = schema<trace::OutlineSpec>();
    outline.set("required", Value(Value::Array{"silhouette"}));
    const auto at = [](double r, double y) { return object({{"r", r}, {"y", y}}); };
    bodies.set(
        "outline",
        json_body(
            "An outline and its axis, as in a model.", std::move(outline),
            object(
                {{"silhouette",
                  object({{"stem", Value(Value::Array{at(0, -0.005), at(0.01, 0), at(0.01, 0.07)})},
                          {"hymenium", Value(Value::Array{at(0.01, 0.07), at(0.04, 0.065)})},
                          {"cap",
                           Value(Value::Array{at(0.04, 0.065), at(0.03, 0.09), at(0, 0.1)})}})}})));
}

}  // namespace

const RouteGroup trace_routes = {
    .tag = "traces",
    .description =
        "From a photograph to a species: for pictures, never for identifying mushrooms "
        "to eat.",
    .routes = routes,
    .add_links = nullptr,
    .add_schemas = add_schemas,
    .add_bodies = add_bodies};

}  // namespace sporeprint::api
