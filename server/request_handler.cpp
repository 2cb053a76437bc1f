#include "server/request_handler.h"

#include <chrono>
#include <exception>
#include <optional>
#include <utility>
#include <variant>

#include "api/http/query.h"
#include "api/http/response_builder.h"
#include "api/http/routes.h"
#include "api/http/stopwatch.h"
#include "server/operations/machine.h"

namespace sporeprint::server {

namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* alive = "alive\n";

/// Work of reading a body that is not begun for a client which owes: a millisecond.
constexpr std::uint64_t large_reading = 1000;

constexpr std::string_view own_paths[] = {"/livez", "/readyz", "/metrics"};

/// The path of a target in origin or absolute form below the base path, still encoded.
std::string_view path_of(std::string_view base, std::string_view target) {
    target = api::below(base, target);
    return target.substr(0, target.find('?'));
}

bool is_own(std::string_view path) {
    for (const std::string_view own : own_paths)
        if (path == own) return true;
    return false;
}

/// The template of a request's route, for the metrics.
std::string route_of(std::string_view base, std::string_view method, std::string_view target) {
    target = api::below(base, target);
    const std::string_view path = path_of({}, target);
    if (is_own(path)) return std::string(path);
    std::vector<Problem> ignored;
    const api::Target requested = api::split_target(target, ignored);
    for (const std::string_view tried : {method, std::string_view("GET")})
        if (const api::Match match = api::match_route(tried, requested.segments); match.route)
            return match.route->pattern;
    return "UNKNOWN";
}

std::string what(const std::exception_ptr& error) {
    try {
        std::rethrow_exception(error);
    } catch (const std::exception& known) {
        return known.what();
    } catch (...) {
        return "an exception of no known kind";
    }
}

}  // namespace

RequestHandler::RequestHandler(AppState state, Metrics& metrics, Log& log,
                               const RequestHandlerOptions& options)
    : state_(std::make_shared<const AppState>(std::move(state))),
      metrics_(metrics),
      log_(log),
      options_(options),
      pool_(options_.threads, options_.longest_queue),
      single_flight_(pool_, options_.most_waiters) {
    if (options_.budget.rate > 0) budgets_.emplace(options_.budget);
}

std::shared_ptr<const AppState> RequestHandler::state() const {
    const std::lock_guard lock(state_mutex_);
    return state_;
}

void RequestHandler::renew(AppState state) {
    auto renewed = std::make_shared<const AppState>(std::move(state));
    const std::lock_guard lock(state_mutex_);
    state_.swap(renewed);  // what was there is destroyed outside the lock
}

Handlers RequestHandler::handlers() {
    Handlers handlers;
    handlers.respond = [this](const std::shared_ptr<PendingRequest>& pending) { respond(pending); };
    handlers.refuse = [this](const api::Request& request, int status, std::string_view detail) {
        std::vector<api::Header> extra;
        if (status == 429 || status == 503) extra.emplace_back("Retry-After", "1");
        return state()->service->problem(request, status, detail, extra);
    };
    handlers.most_body = [this](std::string_view method, std::string_view target) {
        return state()->service->most_body(method, target);
    };
    handlers.judge_head = [this](const api::Request& request) -> std::optional<api::Response> {
        const std::string_view path = path_of(options_.base_path, request.target);
        if (!is_own(path)) return state()->service->response_to_head(request);
        if (request.method == "GET" || request.method == "HEAD") return std::nullopt;
        return housekeeping(request, path, options_.metrics);
    };
    handlers.label = [this](std::string_view method, std::string_view target) {
        return route_of(options_.base_path, method, target);
    };
    api::Request nobody;
    nobody.id = "standing";
    handlers.pinned_responses = {{"/livez", plain(nobody, alive)}};
    handlers.pinned_responses[0].second.cacheable = true;
    handlers.served = [this](const Served& served) { report(served); };
    return handlers;
}

Handlers RequestHandler::metrics_handlers() {
    Handlers handlers = this->handlers();
    handlers.respond = [this](const std::shared_ptr<PendingRequest>& pending) {
        const api::Request& request = pending->request();
        const std::string_view path = path_of(options_.base_path, request.target);
        pending->reply(is_own(path)
                           ? housekeeping(request, path, true)
                           : state()->service->problem(
                                 request, 404, "only /metrics, /livez and /readyz are here"));
    };
    handlers.most_body = [](std::string_view, std::string_view) { return std::size_t{0}; };
    handlers.judge_head = nullptr;  // no body is taken anyway
    return handlers;
}

bool RequestHandler::is_ready() const {
    const auto has_room = [](std::size_t waiting, std::size_t most) {
        return most == 0 || waiting * 10 < most * 9;
    };
    const Transport* const transport = transport_;
    const Transport::Load load = transport ? transport->load() : Transport::Load();
    return ready_ && has_room(pool_.waiting(), pool_.longest_queue()) &&
           has_room(load.queue, load.queue_limit);
}

void RequestHandler::respond(const std::shared_ptr<PendingRequest>& pending) {
    const std::string_view path = path_of(options_.base_path, pending->request().target);
    if (is_own(path))
        return pending->reply(housekeeping(pending->request(), path, options_.metrics));
    const Using state = this->state();
    const Requested requested = this->requested(*state, pending);
    if (!requested.why_not.empty()) {
        metrics_.rejected("signature");
        return pending->reply(state->service->problem(*requested.request, 403, requested.why_not));
    }
    respond(state, pending, requested, false);
}

void RequestHandler::respond(const Using& state, const std::shared_ptr<PendingRequest>& pending,
                             Requested requested, bool correspondence_ready) {
    api::Service& service = *state->service;
    const api::Request& request = *requested.request;
    // A body is read to know what it asks for, and costs that even if it is refused.
    const std::uint64_t reading = budgets_ && !correspondence_ready && !request.body.empty()
                                      ? service.cost_of_reading(request).work()
                                      : 0;
    if (reading > large_reading)
        if (const auto missing = budgets_->spend(client_of(pending->client()), 0, Clock::now());
            missing > missing.zero())
            return reply_over_budget(service, pending, request, missing);
    std::optional<SharedJobs::LookupGuard> lookup_guard(std::in_place, single_flight_);
    std::variant<api::Response, api::Job> planned = service.plan(request, correspondence_ready);
    if (api::Response* response = std::get_if<api::Response>(&planned)) {
        if (reading > 0) {
            budgets_->owe(client_of(pending->client()), reading, Clock::now());
            requested.is_charged = true;
        }
        return reply(pending, requested, std::move(*response));
    }

    auto& job = std::get<api::Job>(planned);
    std::uint64_t work = job.cost.work();
    if (const auto missing = charge(pending->client(), job.key, reading, work);
        missing > missing.zero())
        return reply_over_budget(service, pending, request, missing);
    requested.is_charged = requested.is_charged || (budgets_ && reading + work > 0);
    // Delivered by a worker of the transport: a slot is for making. After what only prepares it goes on when that has landed
    // and its own wait is known, or the next would be taken for that.
    const bool is_warm_up = job.is_warm_up;
    const auto go_on = [this, state, pending, requested,
                        other_came = std::make_shared<std::atomic<bool>>(false)] {
        if (other_came->exchange(true))
            pending->resume([=, this] { respond(state, pending, requested, true); });
    };
    const auto completed = [=, this](const SharedJobs::Completion& completion) {
        if (is_warm_up && !completion.error) return go_on();
        pending->resume([=, this] {
            reply(pending, requested, delivered(*state->service, *requested.request, completion));
        });
    };
    const std::optional<SharedJobs::Ticket> ticket = join(state, std::move(job), completed);
    lookup_guard.reset();
    if (!ticket) {
        if (work > 0) budgets_->give_back(client_of(pending->client()), work, Clock::now());
        metrics_.rejected("queue");
        return pending->reply(service.problem(
            request, 503, "too much is being made; try again in a moment", {{"Retry-After", "1"}}));
    }
    pending->wait([this, state, pending, requested, ticket = *ticket](PendingRequest::Over why) {
        if (!single_flight_.cancel(ticket)) return;  // it has landed
        const bool left = why == PendingRequest::Over::left;
        metrics_.rejected(left ? "left" : "deadline");
        if (left) {
            api::Response nobody;
            nobody.status = client_left;
            return pending->reply(std::move(nobody));
        }
        reply(pending, requested,
              state->service->problem(pending->request(), 504,
                                      "this took longer than a request may"));
    });
    if (is_warm_up) go_on();
}

void RequestHandler::reply(const std::shared_ptr<PendingRequest>& pending,
                           const Requested& requested, api::Response response) const {
    if (requested.expires) {
        response.cacheable = false;  // The next client must not get it without a look at the clock.
        api::bound_freshness(response, *requested.expires - seconds_since_1970());
    }
    if (requested.is_charged) tell_budget(pending->client(), response);
    pending->reply(std::move(response));
}

void RequestHandler::tell_budget(const Address& client, api::Response& response) const {
    // The unit is a millisecond of work; budgets count microseconds.
    const std::uint64_t rate = options_.budget.rate, burst = options_.budget.burst;
    const Budgets::Level level = budgets_->level(client_of(client), Clock::now());
    const auto seconds = std::chrono::ceil<std::chrono::seconds>(level.until_full).count();
    api::set_header(response, "RateLimit-Policy",
                    "\"work\";q=" + std::to_string(burst / 1000) +
                        ";w=" + std::to_string((burst + rate - 1) / rate));
    api::set_header(
        response, "RateLimit",
        "\"work\";r=" + std::to_string(level.work / 1000) + ";t=" + std::to_string(seconds));
    response.cacheable = false;
}

std::chrono::microseconds RequestHandler::charge(const Address& client, const api::Key& key,
                                                 std::uint64_t reading, std::uint64_t& work) {
    if (!budgets_ || single_flight_.is_in_flight(key)) {
        work = 0;
        if (budgets_) budgets_->owe(client_of(client), reading, Clock::now());
        return {};
    }
    // Both at once: a piece that is larger than the bucket needs it full, which it would never be
    // after its body was read.
    const auto missing = budgets_->spend(client_of(client), reading + work, Clock::now());
    if (missing == missing.zero()) return missing;
    budgets_->owe(client_of(client), reading, Clock::now());
    return missing + std::chrono::microseconds(reading * 1'000'000 / options_.budget.rate);
}

void RequestHandler::reply_over_budget(const api::Service& service,
                                       const std::shared_ptr<PendingRequest>& pending,
                                       const api::Request& request,
                                       std::chrono::microseconds missing) {
    metrics_.rejected("budget");
    const auto seconds = std::chrono::ceil<std::chrono::seconds>(missing).count();
    api::Response refusal = service.problem(
        request, 429, "this client has had much made; there is room for more in a while",
        {{"Retry-After", std::to_string(seconds)}});
    tell_budget(pending->client(), refusal);
    pending->reply(std::move(refusal));
}

RequestHandler::Requested RequestHandler::requested(
    const AppState& state, const std::shared_ptr<PendingRequest>& pending) const {
    const api::Request& whole = pending->request();
    Requested requested{{pending, &whole}, std::nullopt, {}, false};
    if (!state.signatures || whole.method == "OPTIONS") return requested;
    std::vector<Problem> ignored;
    const api::Match match = api::match_route(
        whole.method,
        api::split_target(api::below(options_.base_path, whole.target), ignored).segments);
    if (!match.route || !api::is_generated(match.route->endpoint)) return requested;
    Checked checked =
        state.signatures->check(whole.method, whole.target, whole.body, seconds_since_1970());
    if (!checked.good) {
        requested.why_not = std::move(checked.why);
        return requested;
    }
    auto rest = std::make_shared<api::Request>(whole);
    rest->target = std::move(checked.target);
    requested.expires = checked.expires;
    requested.request = std::move(rest);
    return requested;
}

/// Does a job, here and on idle slots, and keeps what comes of it.
RequestHandler::JobResult RequestHandler::generated(api::Service& service, const api::Job& job,
                                                    std::stop_token stop, double queue) {
    api::Stopwatch watch;
    JobResult generated;
    generated.response =
        job.run(std::move(stop), watch.observer(),
                [this](std::span<const std::function<void()>> pieces) { pool_.share(pieces); });
    generated.timing = watch.timing(queue);
    metrics_.generated(generated.timing);
    service.finish(job.key, generated.response);
    return generated;
}

std::vector<api::Response> RequestHandler::warm(std::span<const std::string> targets) {
    const Using state = this->state();
    std::vector<api::Response> responses(targets.size());
    std::vector<std::function<void()>> pieces;
    for (std::size_t i = 0; i < targets.size(); ++i)
        pieces.emplace_back([&, i] {
            api::Request request;
            request.method = "GET";
            request.target = targets[i];
            request.id = "warm";
            auto planned = api::plan_here(*state->service, request);
            if (const auto* job = std::get_if<api::Job>(&planned)) {
                try {
                    responses[i] = generated(*state->service, *job, {}, 0).response;
                } catch (...) {
                    responses[i] = state->service->problem(request, std::current_exception());
                }
            } else {
                responses[i] = std::move(std::get<api::Response>(planned));
            }
        });
    pool_.share(pieces);
    return responses;
}

std::optional<RequestHandler::SharedJobs::Ticket> RequestHandler::join(
    const Using& state, api::Job to_do, SharedJobs::OnComplete then) {
    const auto job = std::make_shared<const api::Job>(std::move(to_do));
    const Clock::time_point joined = Clock::now();
    const auto work = [this, state, job, joined](std::stop_token stop) {
        const double queue =
            std::chrono::duration<double, std::milli>(Clock::now() - joined).count();
        return generated(*state->service, *job, std::move(stop), queue);
    };
    return single_flight_.join(job->key, work, std::move(then));
}

api::Response RequestHandler::delivered(const api::Service& service, const api::Request& request,
                                        const SharedJobs::Completion& completion) {
    if (completion.error) {
        api::Response response = service.problem(request, completion.error);
        if (response.status == 500)
            log_.event(LogLevel::error, "making failed",
                       {{"id", Value(request.id)}, {"what", Value(what(completion.error))}});
        return response;
    }
    if (completion.collapsed) metrics_.collapsed();
    return service.deliver(request, completion.result->response,
                           completion.collapsed ? api::Outcome::collapsed : api::Outcome::generated,
                           completion.result->timing);
}

api::Response RequestHandler::housekeeping(const api::Request& request, std::string_view path,
                                           bool metrics) {
    const Using state = this->state();
    const api::Service& service = *state->service;
    if (request.method != "GET" && request.method != "HEAD")
        return service.problem(request, 405, "only GET and HEAD are answered here",
                               {{"Allow", "GET, HEAD"}});
    if (path == "/livez") return plain(request, alive);
    if (path == "/readyz") {
        if (is_ready()) return plain(request, "ready\n");
        return service.problem(
            request, 503, ready_ ? "too much is waiting" : "the server is starting or stopping",
            {{"Retry-After", "1"}});
    }
    if (!metrics)
        return service.problem(request, 404, "metrics are answered on a port of their own");
    return plain(request, metrics_.text(service.counters(), gauges()),
                 "text/plain; version=0.0.4; charset=utf-8");
}

api::Response RequestHandler::plain(const api::Request& request, const std::string& text,
                                    std::string type) const {
    api::Response response;
    response.headers = {{"Content-Type", std::move(type)},
                        {"Cache-Control", "no-store"},
                        {"X-Content-Type-Options", "nosniff"},
                        {"X-Request-Id", request.id}};
    response.body = {slice_of(text)};
    return response;
}

void RequestHandler::report(const Served& served) {
    metrics_.served(served);
    log_.request(served);
}

Gauges RequestHandler::gauges() const {
    Gauges gauges;
    gauges.workers = pool_.count();
    gauges.busy_workers = pool_.busy();
    gauges.queue = pool_.waiting();
    gauges.queue_limit = pool_.longest_queue();
    gauges.in_flight = single_flight_.in_flight();
    gauges.waiters = single_flight_.waiters();
    if (const Transport* transport = transport_) gauges.connections = transport->load();
    gauges.clients = budgets_ ? budgets_->clients() : 0;
    gauges.ready = is_ready();
    return gauges;
}

}  // namespace sporeprint::server
