#include "api/service.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "api/http/compression.h"
#include "api/http/conditions.h"
#include "api/http/query.h"
#include "api/http/routes.h"
#include "api/http/stopwatch.h"
#include "api/http/text.h"
#include "api/products/endpoints.h"
#include "api/static_documents.h"
#include "core/grow/mushroom.h"
#include "core/params/messages.h"

namespace sporeprint::api {

namespace {

bool is_cached_by_key(const Key& key) {
    return key.starts_with("mushroom.") || key.starts_with("morph.") || key.starts_with("leaf.") ||
           key.starts_with("tree.") || key.starts_with("colony.");
}

/// "queue;dur=0.01, build;dur=2.5" of the steps that were taken.
std::string server_timing(const Timing& timing) {
    const std::array<std::pair<const char*, double>, 5> steps = {{{"queue", timing.queue},
                                                                  {"resolve", timing.resolve},
                                                                  {"build", timing.build},
                                                                  {"paint", timing.paint},
                                                                  {"pack", timing.pack}}};
    std::string spent;
    for (const auto& [step, milliseconds] : steps) {
        if (milliseconds < 0.0) continue;
        if (!spent.empty()) spent += ", ";
        ((spent += step) += ";dur=") += number_text(
            static_cast<double>(static_cast<std::int64_t>(milliseconds * 1000.0 + 0.5)) / 1000.0);
    }
    return spent;
}

/// 413 and 415 of routes that take a body.
std::optional<Response> refuse_body(const ResponseBuilder& responses, const Request& request,
                                    const Route& route) {
    if (!request.header("Content-Encoding").empty())
        return responses.problem(request, 415,
                                 "bodies with a Content-Encoding are not taken; send it plain");
    const std::string_view given = request.header("Content-Type");
    const std::string_view type = trimmed(given.substr(0, given.find(';')));
    if (!same_word(type, route.takes))
        return responses.problem(request, 415,
                                 "the body is " +
                                     (type.empty() ? "of no stated type" : in_quotes(type)) +
                                     "; send Content-Type: " + route.takes);
    if (request.body.size() > longest_body(route))
        return responses.problem(request, 413,
                                 "the body has " + std::to_string(request.body.size()) +
                                     " bytes; at most " + std::to_string(longest_body(route)) +
                                     " are taken");
    return std::nullopt;
}

/// What the head of a request says: where it goes, and what is wrong with it so far.
struct Head {
    Target target;
    Match match;
    ValidationErrors errors;
};

/// Reads the head of a request; an answer if that is final whatever the body is.
std::optional<Response> read_head(const ResponseBuilder& responses, const Request& request,
                                  Head& head) {
    if (request.target.size() > longest_target)
        return responses.problem(request, 414,
                                 "the address has " + std::to_string(request.target.size()) +
                                     " bytes; at most " + std::to_string(longest_target) +
                                     " are taken");
    if (request.method == "OPTIONS" && request.target == "*")
        return responses.options(request, "GET, HEAD, POST, OPTIONS");
    const std::string& base = responses.base_path();
    if (const std::string_view requested = origin_form(request.target);
        !base.empty() && requested.substr(0, requested.find('?')) == base &&
        (request.method == "GET" || request.method == "HEAD"))
        return responses.to_page(request, requested.substr(base.size()));
    std::vector<Problem> malformed;
    head.target = split_target(below(base, request.target), malformed);
    const bool path_malformed = std::any_of(malformed.begin(), malformed.end(),
                                            [](const Problem& one) { return one.path == "path"; });
    head.errors.add(400, malformed);
    if (path_malformed) return responses.problem(request, head.errors);

    head.match = match_route(request.method, head.target.segments);
    const Match& match = head.match;
    if (match.allow.empty()) {
        const std::string meant = closest_route(head.target.segments);
        const std::string detail =
            "there is nothing at " + in_quotes(head.target.path) +
            (meant.empty() ? "" : "; did you mean " + in_quotes(meant) + "?");
        return responses.problem(request, 404, detail, head.errors.problems());
    }
    if (request.method == "OPTIONS") return responses.options(request, match.allow);
    if (!match.route) {
        Response response = responses.problem(
            request, 405,
            in_quotes(request.method) + " is not answered here; " + match.allow + " are");
        set_header(response, "Allow", match.allow);
        return response;
    }
    return *match.route->takes ? refuse_body(responses, request, *match.route) : std::nullopt;
}

/// The answer to a request, or the job that leads to it. Throws CacheMiss where `context` keeps to what is kept.
Plan plan_route(Context& context, const StaticDocuments& documents, const Request& request) {
    Head head;
    if (std::optional<Response> response = read_head(context.responses, request, head))
        return *std::move(response);
    const Atlas& atlas = *context.atlas;
    const Target& target = head.target;
    const Match& match = head.match;
    ValidationErrors& errors = head.errors;
    const Route& route = *match.route;

    switch (route.endpoint) {
        case Endpoint::page:
            return documents.page(request, "index.html");
        case Endpoint::docs:
            return documents.page(request, "docs.html");
        case Endpoint::asset:
            return documents.asset(request, match.captured[0]);
        case Endpoint::root:
            return documents.about(request, target, errors);
        case Endpoint::mushroom_list:
            return documents.mushroom_list(request, target, errors);
        case Endpoint::mushroom_schema:
            return documents.mushroom_schema(request, target, errors);
        case Endpoint::openapi:
            return documents.openapi(request, target, errors);
        case Endpoint::species_list:
            return documents.species_list(request, target, errors);
        case Endpoint::species:
            return documents.species(request, target, match.captured[0], errors);
        case Endpoint::mushroom_glb:
        case Endpoint::mushroom_json: {
            MushroomRequest requested =
                read_mushroom(match.captured[0], target.query, atlas, errors);
            requested.product =
                route.endpoint == Endpoint::mushroom_glb ? Product::glb : Product::json;
            return plan_mushroom(context, request, std::move(requested), errors);
        }
        case Endpoint::mushroom_post:
            refuse_query(target, errors);
            return plan_mushroom(context, request, read_mushroom(request.body, atlas, errors),
                                 errors);
        case Endpoint::morph:
            return plan_morph(
                context, request,
                read_morph(read_pair(match.captured[0], match.captured[1], atlas, errors),
                           target.query, errors),
                errors);
        case Endpoint::morph_post: {
            refuse_query(target, errors);
            const SpeciesPair pair = read_pair(match.captured[0], match.captured[1], atlas, errors);
            return plan_mushroom(context, request, read_morph(pair, request.body, errors), errors);
        }
        case Endpoint::problem_type:
            return documents.problem_type(request, target, match.captured[0], errors);
        case Endpoint::colony_list:
            return documents.colony_list(request, target, errors);
        case Endpoint::colony_schema:
            return documents.colony_schema(request, target, errors);
        case Endpoint::colony_glb:
        case Endpoint::colony_json: {
            ColonyRequest requested = read_colony(match.captured[0], target.query, atlas, errors);
            requested.product =
                route.endpoint == Endpoint::colony_glb ? Product::glb : Product::json;
            return plan_colony(context, request, std::move(requested), errors);
        }
        case Endpoint::colony_post:
            refuse_query(target, errors);
            return plan_colony(context, request, read_colony(request.body, atlas, errors), errors);
        case Endpoint::leaf_list:
            return documents.leaf_list(request, target, errors);
        case Endpoint::leaf_schema:
            return documents.leaf_schema(request, target, errors);
        case Endpoint::leaf_glb:
        case Endpoint::leaf_json: {
            auto requested = read_preset<Leaves>(match.captured[0], target.query, errors);
            requested.product = route.endpoint == Endpoint::leaf_glb ? Product::glb : Product::json;
            return plan_leaf(context, request, std::move(requested), errors);
        }
        case Endpoint::leaf_post:
            refuse_query(target, errors);
            return plan_leaf(context, request, read_preset<Leaves>(request.body, errors), errors);
        case Endpoint::leaf_surface:
            return plan_surface(context, request,
                                read_preset_surface<Leaves>(match.captured[0], match.captured[1],
                                                            target.query, errors),
                                errors);
        case Endpoint::tree_list:
            return documents.tree_list(request, target, errors);
        case Endpoint::tree_schema:
            return documents.tree_schema(request, target, errors);
        case Endpoint::tree_glb:
        case Endpoint::tree_json: {
            auto requested = read_preset<Trees>(match.captured[0], target.query, errors);
            requested.product = route.endpoint == Endpoint::tree_glb ? Product::glb : Product::json;
            return plan_tree(context, request, std::move(requested), errors);
        }
        case Endpoint::tree_post:
            refuse_query(target, errors);
            return plan_tree(context, request, read_preset<Trees>(request.body, errors), errors);
        case Endpoint::tree_surface:
            return plan_surface(context, request,
                                read_preset_surface<Trees>(match.captured[0], match.captured[1],
                                                           target.query, errors),
                                errors);
        case Endpoint::surface:
            return plan_surface(
                context, request,
                read_surface(match.captured[0], match.captured[1], target.query, atlas, errors),
                errors);
        case Endpoint::inspect:
            refuse_query(target, errors);
            return plan_inspection(context, request, errors);
        case Endpoint::livez:
        case Endpoint::readyz:
        case Endpoint::metrics:
            break;  // the server's own; match_route never finds them
    }
    return context.responses.problem(request, 404, "there is nothing at " + in_quotes(target.path));
}

}  // namespace

struct Service::Parts {
    std::shared_ptr<Store> store;  ///< perhaps of other services too
    Context context, correspondence_ready;
    StaticDocuments documents;

    Parts(std::shared_ptr<const Atlas> atlas, const ServiceOptions& options,
          std::shared_ptr<Store> the_store)
        : store(std::move(the_store)),
          context{std::move(atlas), options,
                  ResponseBuilder(options.allow_origin, options.base_path), *store,
                  cached_only(*store)},
          correspondence_ready{context.atlas, options, context.responses, *store,
                               computed_inline(*store)},
          documents(context.atlas, context.responses, options) {}

    /// The image that a request for one asks for; nothing, with faults, for none, and for a route that is not of images.
    std::optional<ImageResource> requested_image(const Match& match, const Target& target,
                                                 ValidationErrors& errors) const;
};

Service::Service(std::shared_ptr<const Atlas> atlas, const ServiceOptions& options)
    : parts_(std::make_unique<Parts>(std::move(atlas), options, std::make_shared<Store>(options))) {
}

Service::Service(std::shared_ptr<const Atlas> atlas, const Service& other)
    : parts_(std::make_unique<Parts>(std::move(atlas), other.parts_->context.options,
                                     other.parts_->store)) {}

Service::~Service() = default;

std::optional<ImageResource> Service::Parts::requested_image(const Match& match,
                                                             const Target& target,
                                                             ValidationErrors& errors) const {
    const auto image = [&](const auto& requested) {
        return errors.empty() ? std::optional(image_of(context, requested)) : std::nullopt;
    };
    const Endpoint endpoint = match.route ? match.route->endpoint : Endpoint::inspect;
    if (endpoint == Endpoint::surface)
        return image(read_surface(match.captured[0], match.captured[1], target.query,
                                  *context.atlas, errors));
    if (endpoint == Endpoint::leaf_surface)
        return image(read_preset_surface<Leaves>(match.captured[0], match.captured[1], target.query,
                                                 errors));
    if (endpoint == Endpoint::tree_surface)
        return image(
            read_preset_surface<Trees>(match.captured[0], match.captured[1], target.query, errors));
    return std::nullopt;
}

std::variant<Response, Job> Service::plan(const Request& request, bool correspondence_ready) {
    try {
        return plan_route(correspondence_ready ? parts_->correspondence_ready : parts_->context,
                          parts_->documents, request);
    } catch (const CacheMiss& missing) {
        auto run = [this, request](std::stop_token, const Observer& observer, const Parallel&) {
            observer(Step::resolve);
            static_cast<void>(plan(request, true));
            return Response();
        };
        return Job{"correspondence\n" + missing.key, Cost{.base = 300} + missing.cost,
                   std::move(run), true};
    } catch (...) {
        return problem(request, std::current_exception());
    }
}

void Service::finish(const Key& key, const Response& response) {
    if (response.status != 200 || !is_cached_by_key(key)) return;
    Cache<CachedResponse>& responses = parts_->context.store.responses;
    auto cached = std::make_shared<Response>(response);
    take_header(*cached, "Cache-Status");
    if (!cached->gzipped.empty()) {
        auto variant = std::make_shared<Response>(*cached);
        select_gzip(*variant);
        cached->gzipped.clear();
        if (cached->body.empty()) {  // of a job that made the variant alone
            responses.insert(key, std::move(variant));
            return;
        }
        responses.insert(gzip_key(key), std::move(variant));
    }
    responses.insert(key, std::move(cached));
}

Response Service::deliver(const Request& request, const Response& shared, Outcome outcome,
                          const Timing& timing) const {
    const Context& context = parts_->context;
    Response response = shared;
    if (!response.gzipped.empty() && (response.body.empty() || accepts_gzip(request)))
        select_gzip(response);
    response.gzipped.clear();
    std::string status = take_header(response, "Cache-Status");
    if (outcome == Outcome::collapsed && !status.ends_with("; hit")) {
        if (status.ends_with("; stored"))
            status.resize(status.size() - std::string_view("; stored").size());
        status += "; collapsed";
    }
    std::vector<Problem> ignored;
    const Target target = split_target(below(context.options.base_path, request.target), ignored);
    const Match match = match_route(request.method, target.segments);
    const Endpoint endpoint = match.route ? match.route->endpoint : Endpoint::inspect;

    ValidationErrors none;
    const std::optional<ImageResource> image = parts_->requested_image(match, target, none);
    if (!none.empty()) return context.responses.problem(request, none);
    if (image && response.status == 200) {
        response = delivered_image(context.responses, *image, std::move(response));
        set_header(response, "Cache-Status", std::move(status));
    } else if (endpoint != Endpoint::inspect && response.status == 200) {
        const bool versioned = std::any_of(target.query.begin(), target.query.end(),
                                           [](const auto& pair) { return pair.first == "v"; });
        set_header(response, "Cache-Control", cache_control(versioned));
        set_header(response, "Cache-Status", std::move(status));
    }
    std::string spent = server_timing(timing);
    if (!spent.empty()) set_header(response, "Server-Timing", std::move(spent));
    context.responses.represent(request, response);
    return response;
}

Response Service::problem(const Request& request, int status, std::string_view detail,
                          const std::vector<Header>& extra) const {
    Response response = parts_->context.responses.problem(request, status, detail);
    for (const auto& [name, value] : extra) set_header(response, name, value);
    return response;
}

Response Service::problem(const Request& request, std::exception_ptr error) const {
    Response response =
        problem_response(request, std::move(error), parts_->context.options.base_path);
    parts_->context.responses.add_common_headers(request, response);
    return response;
}

bool Service::self_test() {
    try {
        const Atlas& atlas = *parts_->context.atlas;
        if (atlas.entries().empty()) return false;
        MushroomSpec spec;
        spec.mix = {{atlas.entries().front().species.id.string(), 1000}};
        spec.params.lod = 3;
        spec.params.texture_size = {128};
        return size_of(grow_mushroom(spec, atlas).glb) > 0;
    } catch (...) {
        return false;
    }
}

Cost Service::cost_of_reading(const Request& request) const {
    std::vector<Problem> ignored;
    const std::string_view target =
        below(parts_->context.options.base_path,
              std::string_view(request.target).substr(0, longest_target));
    const Match match = match_route(request.method, split_target(target, ignored).segments);
    // Other bodies are not looked at; of an upload to /v1/inspect its job is charged.
    if (!match.route || std::string_view(match.route->takes) != "application/json" ||
        request.body.size() > longest_body(*match.route))
        return {};
    return cost_of_json(request.body);
}

std::size_t Service::most_body(std::string_view method, std::string_view target) const {
    std::vector<Problem> ignored;
    target = below(parts_->context.options.base_path, target.substr(0, longest_target));
    const Match match = match_route(method, split_target(target, ignored).segments);
    return match.route ? longest_body(*match.route) : 256u << 10;
}

std::optional<Response> Service::response_to_head(const Request& request) const {
    Head head;
    return read_head(parts_->context.responses, request, head);
}

const Counters& Service::counters() const {
    parts_->context.store.measure();
    return parts_->context.store.counters;
}

std::variant<Response, Job> plan_here(Service& service, const Request& request) {
    std::variant<Response, Job> planned = service.plan(request);
    const Job* const job = std::get_if<Job>(&planned);
    return job && job->is_warm_up ? service.plan(request, true) : std::move(planned);
}

Response handle(Service& service, const Request& request) {
    std::variant<Response, Job> planned = plan_here(service, request);
    if (Response* response = std::get_if<Response>(&planned)) return std::move(*response);
    Job& job = std::get<Job>(planned);
    try {
        Stopwatch watch;
        const Response shared = job.run({}, watch.observer(), in_turn);
        service.finish(job.key, shared);
        return service.deliver(request, shared, Outcome::generated, watch.timing());
    } catch (...) {
        return service.problem(request, std::current_exception());
    }
}

}  // namespace sporeprint::api
