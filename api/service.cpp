#include "api/service.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "api/http/compression.h"
#include "api/http/conditions.h"
#include "api/http/stopwatch.h"
#include "api/http/text.h"
#include "api/products/context.h"
#include "api/products/library_access.h"
#include "api/products/library_drafts.h"
#include "api/routes.h"
#include "api/static_documents.h"
#include "core/grow/mushroom.h"
#include "core/params/messages.h"

namespace sporeprint::api {

namespace {

/// Returns "queue;dur=0.01, build;dur=2.5" for the steps that were measured.
std::string server_timing(const Timing& timing) {
    std::string spent;
    timing.each([&](const char* step, double milliseconds) {
        if (!spent.empty()) spent += ", ";
        ((spent += step) += ";dur=") += number_text(
            static_cast<double>(static_cast<std::int64_t>(milliseconds * 1000.0 + 0.5)) / 1000.0);
    });
    return spent;
}

/// Returns 415 if a route does not accept the media type of a request's body.
std::optional<Response> refuse_body_type(const ResponseBuilder& responses, const Request& request,
                                         const Route& route) {
    if (!request.header("Content-Encoding").empty())
        return responses.problem(request, 415,
                                 "bodies with a Content-Encoding are not taken; send it plain");
    const std::string_view given = request.header("Content-Type");
    const std::string_view type = trimmed(given.substr(0, given.find(';')));
    std::string accepted;
    for (const std::string_view one : body_types(route)) {
        if (same_word(type, one)) return std::nullopt;
        (accepted += accepted.empty() ? "" : " or ") += one;
    }
    return responses.problem(request, 415,
                             "the body is " +
                                 (type.empty() ? "of no stated type" : in_quotes(type)) +
                                 "; send Content-Type: " + accepted);
}

/// Parses the target of a request and finds its route.
///
/// returns  the response if the head alone decides it
std::optional<Response> route_head(const ResponseBuilder& responses, const Request& request,
                                   RoutedRequest& routed) {
    const std::string& base = responses.base_path();
    std::vector<Problem> malformed;
    routed.target = split_target(below(base, request.target), malformed);
    const bool path_malformed = std::any_of(malformed.begin(), malformed.end(),
                                            [](const Problem& one) { return one.path == "path"; });
    routed.errors.add(400, malformed);
    routed.match = route_table().match(request.method, routed.target.segments);

    if (request.target.size() > longest_target)
        return responses.problem(request, 414,
                                 "the address has " + std::to_string(request.target.size()) +
                                     " bytes; at most " + std::to_string(longest_target) +
                                     " are taken");
    if (request.method == "OPTIONS" && request.target == "*")
        return responses.options(request, "GET, HEAD, POST, PUT, DELETE, OPTIONS");
    if (const std::string_view requested = origin_form(request.target);
        !base.empty() && requested.substr(0, requested.find('?')) == base &&
        (request.method == "GET" || request.method == "HEAD"))
        return responses.to_page(request, requested.substr(base.size()));
    if (path_malformed) return responses.problem(request, routed.errors);

    const Match& match = routed.match;
    if (match.allow.empty()) {
        const std::string meant = route_table().closest(routed.target.segments);
        const std::string detail =
            "there is nothing at " + in_quotes(routed.target.path) +
            (meant.empty() ? "" : "; did you mean " + in_quotes(meant) + "?");
        return responses.problem(request, 404, detail, routed.errors.problems());
    }
    if (request.method == "OPTIONS") return responses.options(request, match.allow);
    if (!match.route) {
        Response response = responses.problem(
            request, 405,
            in_quotes(request.method) + " is not answered here; " + match.allow + " are");
        set_header(response, "Allow", match.allow);
        return response;
    }
    return *match.route->body_type ? refuse_body_type(responses, request, *match.route)
                                   : std::nullopt;
}

/// Returns the response to a request, or the job that computes it. Throws CacheMiss if a
/// correspondence is needed that the caches of the context may not compute.
Plan plan_route(Context& context, const Request& request, const RoutedRequest& routed) {
    if (routed.response) return *routed.response;
    const Route& route = *routed.match.route;
    if (*route.body_type && request.body.size() > route.most_body)
        return context.responses.problem(request, 413,
                                         "the body has " + std::to_string(request.body.size()) +
                                             " bytes; at most " + std::to_string(route.most_body) +
                                             " are taken");
    ValidationErrors errors = routed.errors;
    if (route.document) return context.documents->document(route, request, routed.target, errors);
    RouteCall call{context, request, route, routed.target, routed.match.captured, errors};
    return route.plan(call);
}

/// Thrown for species of the library that are not in memory.
struct ToBeLoaded {
    std::vector<LibraryName> names;
};

/// Returns the plan of a request whose atlas has guests. The plan owns its context. Its response is that of this
/// moment only: the species may be withdrawn, and without the number of a version another one may be published.
///
/// is_open  a species was named without the number of its version
Plan plan_with_guests(const std::shared_ptr<Context>& context, const Request& request,
                      const RoutedRequest& routed, bool is_open) {
    Plan plan = plan_route(*context, request, routed);
    const auto finish = [is_open](Response& response) {
        response.cacheable = false;
        if (is_open && response.status < 300) set_header(response, "Cache-Control", "no-cache");
    };
    if (Response* const response = std::get_if<Response>(&plan)) {
        finish(*response);
        return plan;
    }
    Job& job = std::get<Job>(plan);
    job.run = [context, run = std::move(job.run)](std::stop_token stop, const Observer& observer,
                                                  const Parallel& parallel) {
        return run(std::move(stop), observer, parallel);
    };
    job.delivery = [context, finish, delivery = std::move(job.delivery)](Response& response) {
        if (delivery) delivery(response);
        finish(response);
    };
    return plan;
}

/// Returns the response to a request, or the job that computes it, with the species of the library that it names as
/// guests of the atlas.
///
/// loads   reads species that are not in memory, which blocks; otherwise they are thrown as ToBeLoaded
/// throws  CacheMiss, ToBeLoaded
Plan plan_with_library(Context& context, const Request& request, const RoutedRequest& routed,
                       bool loads) {
    std::shared_ptr<Context> own;
    std::vector<AtlasGuest> guests;
    bool is_open = false;
    for (;;) {
        try {
            return own ? plan_with_guests(own, request, routed, is_open)
                       : plan_route(context, request, routed);
        } catch (const SpeciesOfLibrary& wanted) {
            if (!context.library) return context.responses.problem(request, 404, no_library);
            if (has_draft(wanted.ids()))
                return plan_with_drafts(context, request, wanted.ids(),
                                        [request, routed](Context& with_drafts) {
                                            return plan_route(with_drafts, request, routed);
                                        });
            ToBeLoaded missing;
            for (const std::string& id : wanted.ids()) {
                Library::Found found = context.library->find(id);
                if (found.status != 200) return not_found(context.responses, request, found);
                if (!found.entry && loads) found.entry = context.library->load(found.name);
                if (!found.entry) {
                    missing.names.push_back(found.name);
                    continue;
                }
                is_open = is_open || id != text_of(found.name);
                guests.push_back({id, std::move(found.entry)});
            }
            if (!missing.names.empty()) throw ToBeLoaded(std::move(missing));
            own = with_guests(context, guests);
        }
    }
}

ServiceOptions with_library(ServiceOptions options, bool has_library) {
    options.has_library = has_library;
    return options;
}

}  // namespace

struct Service::Parts {
    std::shared_ptr<Store> store;  ///< shared with the services before and after a reload
    LazyNearestSpecies nearest;
    Context context, correspondence_ready;
    StaticDocuments documents;

    Parts(std::shared_ptr<const Atlas> atlas, const ServiceOptions& options,
          std::shared_ptr<Store> the_store, std::shared_ptr<Library> library)
        : store(std::move(the_store)),
          context{std::move(atlas),
                  options,
                  ResponseBuilder(options.allow_origin, options.base_path),
                  *store,
                  cached_only(*store),
                  route_table(),
                  &documents,
                  nearest,
                  std::move(library)},
          correspondence_ready(context),
          documents(context.atlas, context.responses, options, route_table()) {
        correspondence_ready.caches = computed_inline(*store);
        correspondence_ready.has_prerequisites = true;
    }
};

Service::Service(std::shared_ptr<const Atlas> atlas, const ServiceOptions& options,
                 std::shared_ptr<Library> library)
    : parts_(std::make_unique<Parts>(std::move(atlas), with_library(options, library != nullptr),
                                     std::make_shared<Store>(options), std::move(library))) {}

Service::Service(std::shared_ptr<const Atlas> atlas, const Service& other)
    : parts_(std::make_unique<Parts>(std::move(atlas), other.parts_->context.options,
                                     other.parts_->store, other.parts_->context.library)) {}

Service::~Service() = default;

RoutedRequest Service::route(const Request& request) const {
    RoutedRequest routed;
    routed.response = route_head(parts_->context.responses, request, routed);
    if (routed.match.route) routed.most_body = routed.match.route->most_body;
    return routed;
}

Plan Service::plan(const Request& request, const RoutedRequest& routed, bool correspondence_ready) {
    Context& context = correspondence_ready ? parts_->correspondence_ready : parts_->context;
    try {
        return plan_with_library(context, request, routed, correspondence_ready);
    } catch (const ToBeLoaded& missing) {
        auto run = [library = context.library, names = missing.names](
                       std::stop_token, const Observer& observer, const Parallel&) {
            observer(Step::resolve);
            for (const LibraryName& name : names) static_cast<void>(library->load(name));
            return Response();
        };
        std::string key = "library";
        for (const LibraryName& name : missing.names) (key += '\n') += text_of(name);
        return Job{std::move(key), Cost{.base = 2000 * missing.names.size()}, std::move(run), true};
    } catch (const CacheMiss& missing) {
        auto run = [this, request, routed](std::stop_token, const Observer& observer,
                                           const Parallel&) {
            observer(Step::resolve);
            static_cast<void>(plan(request, routed, true));
            return Response();
        };
        return Job{"correspondence\n" + missing.key, Cost{.base = 300} + missing.cost,
                   std::move(run), true};
    } catch (...) {
        return problem(request, std::current_exception());
    }
}

std::string Service::owner_of(const Request& request) const {
    const std::shared_ptr<Library>& library = parts_->context.library;
    return library ? known_owner(*library, request) : std::string();
}

void Service::finish(const Key& key, const Response& response) {
    if (response.status != 200 || !response.is_stored) return;
    Cache<CachedResponse>& responses = parts_->context.store.responses;
    auto cached = std::make_shared<Response>(response);
    take_header(*cached, "Cache-Status");
    if (!cached->gzipped.empty()) {
        auto variant = std::make_shared<Response>(*cached);
        select_gzip(*variant);
        cached->gzipped.clear();
        if (cached->body.empty()) {  // the job computed only the variant
            responses.insert(key, std::move(variant));
            return;
        }
        responses.insert(gzip_key(key), std::move(variant));
    }
    responses.insert(key, std::move(cached));
}

Response Service::deliver(const Request& request, const Delivery& delivery, const Response& shared,
                          Outcome outcome, const Timing& timing) const {
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
    if (delivery && response.status == 200) {
        delivery(response);
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

Cost Service::cost_of_reading(const Request& request, const RoutedRequest& routed) {
    const Route* const route = routed.match.route;
    // Other bodies are not parsed; for an upload to /v1/inspect the job is charged.
    if (!route || std::string_view(route->body_type) != "application/json" ||
        request.body.size() > route->most_body)
        return {};
    return cost_of_json(request.body);
}

const Counters& Service::counters() const {
    parts_->context.store.measure();
    return parts_->context.store.counters;
}

Plan plan_here(Service& service, const Request& request) {
    const RoutedRequest routed = service.route(request);
    Plan planned = service.plan(request, routed);
    const Job* const job = std::get_if<Job>(&planned);
    return job && job->is_warm_up ? service.plan(request, routed, true) : std::move(planned);
}

Response handle(Service& service, const Request& request) {
    Plan planned = plan_here(service, request);
    if (Response* response = std::get_if<Response>(&planned)) return std::move(*response);
    Job& job = std::get<Job>(planned);
    try {
        Stopwatch watch;
        const Response shared = job.run({}, watch.observer(), in_turn);
        service.finish(job.key, shared);
        return service.deliver(request, job.delivery, shared, Outcome::generated, watch.timing());
    } catch (...) {
        return service.problem(request, std::current_exception());
    }
}

}  // namespace sporeprint::api
