#include "api/service.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "api/compression.h"
#include "api/conditions.h"
#include "api/endpoints.h"
#include "api/query.h"
#include "api/routes.h"
#include "api/shelf.h"
#include "api/stopwatch.h"
#include "api/text.h"
#include "core/grow/mushroom.h"
#include "core/params/messages.h"

namespace sporeprint::api {

namespace {

bool kept_by_key(const Key& key) {
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
std::optional<Answer> refuse_body(const Answers& answers, const Request& request,
                                  const Route& route) {
    if (!request.header("Content-Encoding").empty())
        return answers.problem(request, 415,
                               "bodies with a Content-Encoding are not taken; send it plain");
    const std::string_view given = request.header("Content-Type");
    const std::string_view type = trimmed(given.substr(0, given.find(';')));
    if (!same_word(type, route.takes))
        return answers.problem(request, 415,
                               "the body is " +
                                   (type.empty() ? "of no stated type" : in_quotes(type)) +
                                   "; send Content-Type: " + route.takes);
    if (request.body.size() > longest_body(route))
        return answers.problem(request, 413,
                               "the body has " + std::to_string(request.body.size()) +
                                   " bytes; at most " + std::to_string(longest_body(route)) +
                                   " are taken");
    return std::nullopt;
}

/// What the head of a request says: where it goes, and what is wrong with it so far.
struct Head {
    Target target;
    Match match;
    Faults faults;
};

/// Reads the head of a request; an answer if that is final whatever the body is.
std::optional<Answer> read_head(const Answers& answers, const Request& request, Head& head) {
    if (request.target.size() > longest_target)
        return answers.problem(request, 414,
                               "the address has " + std::to_string(request.target.size()) +
                                   " bytes; at most " + std::to_string(longest_target) +
                                   " are taken");
    if (request.method == "OPTIONS" && request.target == "*")
        return answers.options(request, "GET, HEAD, POST, OPTIONS");
    const std::string& base = answers.base_path();
    if (const std::string_view asked = origin_form(request.target);
        !base.empty() && asked.substr(0, asked.find('?')) == base &&
        (request.method == "GET" || request.method == "HEAD"))
        return answers.to_page(request, asked.substr(base.size()));
    std::vector<Problem> malformed;
    head.target = split_target(below(base, request.target), malformed);
    const bool path_malformed = std::any_of(malformed.begin(), malformed.end(),
                                            [](const Problem& one) { return one.path == "path"; });
    head.faults.add(400, malformed);
    if (path_malformed) return answers.problem(request, head.faults);

    head.match = match_route(request.method, head.target.segments);
    const Match& match = head.match;
    if (match.allow.empty()) {
        const std::string meant = closest_route(head.target.segments);
        const std::string detail =
            "there is nothing at " + in_quotes(head.target.path) +
            (meant.empty() ? "" : "; did you mean " + in_quotes(meant) + "?");
        return answers.problem(request, 404, detail, head.faults.problems());
    }
    if (request.method == "OPTIONS") return answers.options(request, match.allow);
    if (!match.route) {
        Answer answer = answers.problem(
            request, 405,
            in_quotes(request.method) + " is not answered here; " + match.allow + " are");
        set_header(answer, "Allow", match.allow);
        return answer;
    }
    return *match.route->takes ? refuse_body(answers, request, *match.route) : std::nullopt;
}

/// The answer to a request, or the job that leads to it. Throws NotKept where `context` keeps to what is kept.
Plan plan_route(Context& context, const Shelf& shelf, const Request& request) {
    Head head;
    if (std::optional<Answer> answer = read_head(context.answers, request, head))
        return *std::move(answer);
    const Atlas& atlas = *context.atlas;
    const Target& target = head.target;
    const Match& match = head.match;
    Faults& faults = head.faults;
    const Route& route = *match.route;

    switch (route.endpoint) {
        case Endpoint::page:
            return shelf.page(request, "index.html");
        case Endpoint::docs:
            return shelf.page(request, "docs.html");
        case Endpoint::asset:
            return shelf.asset(request, match.captured[0]);
        case Endpoint::root:
            return shelf.about(request, target, faults);
        case Endpoint::mushroom_list:
            return shelf.mushroom_list(request, target, faults);
        case Endpoint::mushroom_schema:
            return shelf.mushroom_schema(request, target, faults);
        case Endpoint::openapi:
            return shelf.openapi(request, target, faults);
        case Endpoint::species_list:
            return shelf.species_list(request, target, faults);
        case Endpoint::species:
            return shelf.species(request, target, match.captured[0], faults);
        case Endpoint::mushroom_glb:
        case Endpoint::mushroom_json: {
            MushroomRequest asked = read_mushroom(match.captured[0], target.query, atlas, faults);
            asked.product = route.endpoint == Endpoint::mushroom_glb ? Product::glb : Product::json;
            return plan_mushroom(context, request, std::move(asked), faults);
        }
        case Endpoint::mushroom_post:
            refuse_query(target, faults);
            return plan_mushroom(context, request, read_mushroom(request.body, atlas, faults),
                                 faults);
        case Endpoint::morph:
            return plan_morph(
                context, request,
                read_morph(read_pair(match.captured[0], match.captured[1], atlas, faults),
                           target.query, faults),
                faults);
        case Endpoint::morph_post: {
            refuse_query(target, faults);
            const SpeciesPair pair = read_pair(match.captured[0], match.captured[1], atlas, faults);
            return plan_mushroom(context, request, read_morph(pair, request.body, faults), faults);
        }
        case Endpoint::problem_type:
            return shelf.problem_type(request, target, match.captured[0], faults);
        case Endpoint::colony_list:
            return shelf.colony_list(request, target, faults);
        case Endpoint::colony_schema:
            return shelf.colony_schema(request, target, faults);
        case Endpoint::colony_glb:
        case Endpoint::colony_json: {
            ColonyRequest asked = read_colony(match.captured[0], target.query, atlas, faults);
            asked.product = route.endpoint == Endpoint::colony_glb ? Product::glb : Product::json;
            return plan_colony(context, request, std::move(asked), faults);
        }
        case Endpoint::colony_post:
            refuse_query(target, faults);
            return plan_colony(context, request, read_colony(request.body, atlas, faults), faults);
        case Endpoint::leaf_list:
            return shelf.leaf_list(request, target, faults);
        case Endpoint::leaf_schema:
            return shelf.leaf_schema(request, target, faults);
        case Endpoint::leaf_glb:
        case Endpoint::leaf_json: {
            auto asked = read_preset<Leaves>(match.captured[0], target.query, faults);
            asked.product = route.endpoint == Endpoint::leaf_glb ? Product::glb : Product::json;
            return plan_leaf(context, request, std::move(asked), faults);
        }
        case Endpoint::leaf_post:
            refuse_query(target, faults);
            return plan_leaf(context, request, read_preset<Leaves>(request.body, faults), faults);
        case Endpoint::leaf_surface:
            return plan_surface(context, request,
                                read_preset_surface<Leaves>(match.captured[0], match.captured[1],
                                                            target.query, faults),
                                faults);
        case Endpoint::tree_list:
            return shelf.tree_list(request, target, faults);
        case Endpoint::tree_schema:
            return shelf.tree_schema(request, target, faults);
        case Endpoint::tree_glb:
        case Endpoint::tree_json: {
            auto asked = read_preset<Trees>(match.captured[0], target.query, faults);
            asked.product = route.endpoint == Endpoint::tree_glb ? Product::glb : Product::json;
            return plan_tree(context, request, std::move(asked), faults);
        }
        case Endpoint::tree_post:
            refuse_query(target, faults);
            return plan_tree(context, request, read_preset<Trees>(request.body, faults), faults);
        case Endpoint::tree_surface:
            return plan_surface(context, request,
                                read_preset_surface<Trees>(match.captured[0], match.captured[1],
                                                           target.query, faults),
                                faults);
        case Endpoint::surface:
            return plan_surface(
                context, request,
                read_surface(match.captured[0], match.captured[1], target.query, atlas, faults),
                faults);
        case Endpoint::inspect:
            refuse_query(target, faults);
            return plan_inspection(context, request, faults);
        case Endpoint::livez:
        case Endpoint::readyz:
        case Endpoint::metrics:
            break;  // the server's own; match_route never finds them
    }
    return context.answers.problem(request, 404, "there is nothing at " + in_quotes(target.path));
}

}  // namespace

struct Service::Parts {
    std::shared_ptr<Store> store;  ///< perhaps of other services too
    Context context, prepared;
    Shelf shelf;

    Parts(std::shared_ptr<const Atlas> atlas, const ServiceOptions& options,
          std::shared_ptr<Store> the_store)
        : store(std::move(the_store)),
          context{std::move(atlas), options, Answers(options.allow_origin, options.base_path),
                  *store, kept_only(*store)},
          prepared{context.atlas, options, context.answers, *store, made_at_once(*store)},
          shelf(context.atlas, context.answers, options) {}

    /// The image that a request for one asks for; nothing, with faults, for none, and for a route that is not of images.
    std::optional<ImageResource> image_asked(const Match& match, const Target& target,
                                             Faults& faults) const;
};

Service::Service(std::shared_ptr<const Atlas> atlas, const ServiceOptions& options)
    : parts_(std::make_unique<Parts>(std::move(atlas), options, std::make_shared<Store>(options))) {
}

Service::Service(std::shared_ptr<const Atlas> atlas, const Service& other)
    : parts_(std::make_unique<Parts>(std::move(atlas), other.parts_->context.options,
                                     other.parts_->store)) {}

Service::~Service() = default;

std::optional<ImageResource> Service::Parts::image_asked(const Match& match, const Target& target,
                                                         Faults& faults) const {
    const auto image = [&](const auto& asked) {
        return faults.empty() ? std::optional(image_of(context, asked)) : std::nullopt;
    };
    const Endpoint endpoint = match.route ? match.route->endpoint : Endpoint::inspect;
    if (endpoint == Endpoint::surface)
        return image(read_surface(match.captured[0], match.captured[1], target.query,
                                  *context.atlas, faults));
    if (endpoint == Endpoint::leaf_surface)
        return image(read_preset_surface<Leaves>(match.captured[0], match.captured[1], target.query,
                                                 faults));
    if (endpoint == Endpoint::tree_surface)
        return image(
            read_preset_surface<Trees>(match.captured[0], match.captured[1], target.query, faults));
    return std::nullopt;
}

std::variant<Answer, Job> Service::plan(const Request& request, bool prepared) {
    try {
        return plan_route(prepared ? parts_->prepared : parts_->context, parts_->shelf, request);
    } catch (const NotKept& missing) {
        auto run = [this, request](std::stop_token, const Observer& observer, const Parallel&) {
            observer(Step::resolve);
            static_cast<void>(plan(request, true));
            return Answer();
        };
        return Job{"correspondence\n" + missing.key, Cost{.base = 300} + missing.cost,
                   std::move(run), true};
    } catch (...) {
        return problem(request, std::current_exception());
    }
}

void Service::finish(const Key& key, const Answer& answer) {
    if (answer.status != 200 || !kept_by_key(key)) return;
    Cache<Kept>& answers = parts_->context.store.answers;
    auto kept = std::make_shared<Answer>(answer);
    take_header(*kept, "Cache-Status");
    if (!kept->gzipped.empty()) {
        auto variant = std::make_shared<Answer>(*kept);
        select_gzip(*variant);
        kept->gzipped.clear();
        if (kept->body.empty()) {  // of a job that made the variant alone
            answers.insert(key, std::move(variant));
            return;
        }
        answers.insert(gzip_key(key), std::move(variant));
    }
    answers.insert(key, std::move(kept));
}

Answer Service::deliver(const Request& request, const Answer& shared, Outcome outcome,
                        const Timing& timing) const {
    const Context& context = parts_->context;
    Answer answer = shared;
    if (!answer.gzipped.empty() && (answer.body.empty() || accepts_gzip(request)))
        select_gzip(answer);
    answer.gzipped.clear();
    std::string status = take_header(answer, "Cache-Status");
    if (outcome == Outcome::collapsed && !status.ends_with("; hit")) {
        if (status.ends_with("; stored"))
            status.resize(status.size() - std::string_view("; stored").size());
        status += "; collapsed";
    }
    std::vector<Problem> ignored;
    const Target target = split_target(below(context.options.base_path, request.target), ignored);
    const Match match = match_route(request.method, target.segments);
    const Endpoint endpoint = match.route ? match.route->endpoint : Endpoint::inspect;

    Faults none;
    const std::optional<ImageResource> image = parts_->image_asked(match, target, none);
    if (!none.empty()) return context.answers.problem(request, none);
    if (image && answer.status == 200) {
        answer = delivered_image(context.answers, *image, std::move(answer));
        set_header(answer, "Cache-Status", std::move(status));
    } else if (endpoint != Endpoint::inspect && answer.status == 200) {
        const bool versioned = std::any_of(target.query.begin(), target.query.end(),
                                           [](const auto& pair) { return pair.first == "v"; });
        set_header(answer, "Cache-Control", cache_control(versioned));
        set_header(answer, "Cache-Status", std::move(status));
    }
    std::string spent = server_timing(timing);
    if (!spent.empty()) set_header(answer, "Server-Timing", std::move(spent));
    context.answers.represent(request, answer);
    return answer;
}

Answer Service::problem(const Request& request, int status, std::string_view detail,
                        const std::vector<Header>& extra) const {
    Answer answer = parts_->context.answers.problem(request, status, detail);
    for (const auto& [name, value] : extra) set_header(answer, name, value);
    return answer;
}

Answer Service::problem(const Request& request, std::exception_ptr error) const {
    Answer answer = problem_answer(request, std::move(error), parts_->context.options.base_path);
    parts_->context.answers.add_common_headers(request, answer);
    return answer;
}

bool Service::self_test() {
    try {
        const Atlas& atlas = *parts_->context.atlas;
        if (atlas.entries().empty()) return false;
        MushroomOrder order;
        order.mix = {{atlas.entries().front().species.id.string(), 1000}};
        order.params.lod = 3;
        order.params.texture_size = {128};
        return size_of(grow_mushroom(order, atlas).glb) > 0;
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

std::optional<Answer> Service::answer_to_head(const Request& request) const {
    Head head;
    return read_head(parts_->context.answers, request, head);
}

const Counters& Service::counters() const {
    parts_->context.store.measure();
    return parts_->context.store.counters;
}

std::variant<Answer, Job> plan_here(Service& service, const Request& request) {
    std::variant<Answer, Job> planned = service.plan(request);
    const Job* const job = std::get_if<Job>(&planned);
    return job && job->prepares ? service.plan(request, true) : std::move(planned);
}

Answer handle(Service& service, const Request& request) {
    std::variant<Answer, Job> planned = plan_here(service, request);
    if (Answer* answer = std::get_if<Answer>(&planned)) return std::move(*answer);
    Job& job = std::get<Job>(planned);
    try {
        Stopwatch watch;
        const Answer shared = job.run({}, watch.observer(), in_turn);
        service.finish(job.key, shared);
        return service.deliver(request, shared, Outcome::made, watch.timing());
    } catch (...) {
        return service.problem(request, std::current_exception());
    }
}

}  // namespace sporeprint::api
