#include "server/request_handler.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <iterator>
#include <optional>
#include <utility>
#include <variant>

#include "api/http/query.h"
#include "api/http/response_builder.h"
#include "api/http/stopwatch.h"
#include "api/routes.h"
#include "server/operations/machine.h"

namespace sporeprint::server {

namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* alive = "alive\n";

/// A body that takes more microseconds of work than this to read is not read for a client whose
/// budget is overdrawn.
constexpr std::uint64_t expensive_reading = 1000;

/// Jobs of more work than this are overtaken by others, such as the ground of a world.
constexpr std::uint64_t lengthy_work = 100'000;

constexpr std::string_view operational_paths[] = {"/livez", "/readyz", "/metrics"};

/// Returns the operational path of a request, whose path must not be percent-encoded; an empty text
/// if it has none.
std::string_view operational_path(std::string_view base, std::string_view target) {
    target = api::below(base, target);
    const std::string_view path = target.substr(0, target.find('?'));
    for (const std::string_view operational : operational_paths)
        if (path == operational) return operational;
    return {};
}

bool is_operational(const api::RoutedRequest& routed) {
    return std::find(std::begin(operational_paths), std::end(operational_paths),
                     routed.match.pattern) != std::end(operational_paths);
}

std::string message_of(const std::exception_ptr& error) {
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
    handlers.route = [this](const api::Request& request) {
        return std::make_shared<const api::RoutedRequest>(route(request));
    };
    api::Request nobody;
    nobody.id = "standing";
    handlers.pinned_responses = {{"/livez", text_response(nobody, alive)}};
    handlers.pinned_responses[0].second.cacheable = true;
    handlers.served = [this](const Served& served) { report(served); };
    return handlers;
}

Handlers RequestHandler::metrics_handlers() {
    Handlers handlers = this->handlers();
    handlers.respond = [this](const std::shared_ptr<PendingRequest>& pending) {
        const api::Request& request = pending->request();
        pending->reply(is_operational(pending->routed())
                           ? operational_response(request, pending->routed(), true)
                           : state()->service->problem(
                                 request, 404, "only /metrics, /livez and /readyz are here"));
    };
    handlers.route = [this](const api::Request& request) {
        api::RoutedRequest routed = route(request);
        if (!is_operational(routed)) routed.response.reset();
        routed.most_body = 0;
        return std::make_shared<const api::RoutedRequest>(std::move(routed));
    };
    return handlers;
}

api::RoutedRequest RequestHandler::route(const api::Request& request) const {
    const std::string_view operational = operational_path(options_.base_path, request.target);
    if (operational.empty()) return state()->service->route(request);
    api::RoutedRequest routed;
    routed.match.pattern = operational;
    if (request.method != "GET" && request.method != "HEAD")
        routed.response = state()->service->problem(
            request, 405, "only GET and HEAD are answered here", {{"Allow", "GET, HEAD"}});
    return routed;
}

bool RequestHandler::is_ready() const {
    const auto has_capacity = [](std::size_t waiting, std::size_t most) {
        return most == 0 || waiting * 10 < most * 9;
    };
    const Transport* const transport = transport_;
    const Transport::Load load = transport ? transport->load() : Transport::Load();
    return ready_ && has_capacity(pool_.waiting(), pool_.longest_queue()) &&
           has_capacity(load.queue, load.queue_limit);
}

void RequestHandler::respond(const std::shared_ptr<PendingRequest>& pending) {
    const api::RoutedRequest& routed = pending->routed();
    if (is_operational(routed))
        return pending->reply(operational_response(pending->request(), routed, options_.metrics));
    const StatePointer state = this->state();
    CheckedRequest checked = check_signature(*state, pending);
    if (!checked.refusal.empty()) {
        metrics_.rejected("signature");
        return pending->reply(state->service->problem(*checked.request, 403, checked.refusal));
    }
    checked.payer = payer_of(*state, *pending);
    respond(state, pending, std::move(checked), false);
}

Payer RequestHandler::payer_of(const AppState& state, const PendingRequest& pending) const {
    if (!budgets_) return {};
    std::string owner = state.service->owner_of(pending.request());
    return owner.empty() ? Payer(client_of(pending.client())) : Payer(std::move(owner));
}

std::uint64_t RequestHandler::work_of_reading(const CheckedRequest& checked) const {
    return budgets_ && !checked.request->body.empty()
               ? api::Service::cost_of_reading(*checked.request, *checked.routed).work()
               : 0;
}

void RequestHandler::respond(const StatePointer& state,
                             const std::shared_ptr<PendingRequest>& pending, CheckedRequest checked,
                             bool correspondence_ready) {
    api::Service& service = *state->service;
    const api::Request& request = *checked.request;
    const std::uint64_t reading = correspondence_ready ? 0 : work_of_reading(checked);
    if (reading > expensive_reading)
        if (const auto missing = budgets_->spend(checked.payer, 0, Clock::now());
            missing > missing.zero())
            return reply_over_budget(service, pending, checked, missing);
    std::optional<SharedJobs::LookupGuard> lookup_guard(std::in_place, single_flight_);
    api::Plan planned = service.plan(request, *checked.routed, correspondence_ready);
    if (api::Response* response = std::get_if<api::Response>(&planned)) {
        if (reading > 0) {
            budgets_->owe(checked.payer, reading, Clock::now());
            checked.is_charged = true;
        }
        return reply(pending, checked, std::move(*response));
    }

    auto& job = std::get<api::Job>(planned);
    std::uint64_t work = job.cost.work();
    if (const auto missing = charge(checked.payer, job.key, reading, work);
        missing > missing.zero())
        return reply_over_budget(service, pending, checked, missing);
    checked.is_charged = checked.is_charged || (budgets_ && reading + work > 0);
    // A worker of the transport delivers the response, so that the threads of the pool are left to
    // generation. After a warm-up job, proceed() runs twice: when that job has completed and when
    // wait() has been called. Only the second call resumes the request; otherwise the wait() of the
    // next job could be mistaken for that of the warm-up job.
    const bool is_warm_up = job.is_warm_up;
    const auto proceed = [this, state, pending, checked,
                          called_before = std::make_shared<std::atomic<bool>>(false)] {
        if (called_before->exchange(true))
            pending->resume([=, this] { respond(state, pending, checked, true); });
    };
    const auto completed =
        [=, this, delivery = std::move(job.delivery)](const SharedJobs::Completion& completion) {
            if (is_warm_up && !completion.error) return proceed();
            pending->resume([=, this] {
                reply(pending, checked,
                      deliver(*state->service, *checked.request, delivery, completion));
            });
        };
    const std::optional<SharedJobs::Ticket> ticket = join(state, std::move(job), completed);
    lookup_guard.reset();
    if (!ticket) {
        if (work > 0) budgets_->give_back(checked.payer, work, Clock::now());
        metrics_.rejected("queue");
        return pending->reply(service.problem(request, 503,
                                              "too many jobs are waiting; try again in a moment",
                                              {{"Retry-After", "1"}}));
    }
    pending->wait(
        [this, state, pending, checked, ticket = *ticket](PendingRequest::CancelReason reason) {
            // False: it has completed.
            if (single_flight_.cancel(ticket)) reply_cancelled(*state, pending, checked, reason);
        });
    if (is_warm_up) proceed();
}

void RequestHandler::reply_cancelled(const AppState& state,
                                     const std::shared_ptr<PendingRequest>& pending,
                                     const CheckedRequest& checked,
                                     PendingRequest::CancelReason reason) {
    const bool disconnected = reason == PendingRequest::CancelReason::disconnected;
    metrics_.rejected(disconnected ? "left" : "deadline");
    if (disconnected) {
        api::Response nobody;
        nobody.status = client_left;
        return pending->reply(std::move(nobody));
    }
    reply(pending, checked,
          state.service->problem(pending->request(), 504, "this took longer than a request may"));
}

void RequestHandler::reply(const std::shared_ptr<PendingRequest>& pending,
                           const CheckedRequest& checked, api::Response response) const {
    if (checked.expires) {
        response.cacheable = false;  // The expiry is to be checked for each client.
        api::bound_freshness(response, *checked.expires - seconds_since_1970());
    }
    if (checked.is_charged) set_rate_limit_headers(checked.payer, response);
    pending->reply(std::move(response));
}

void RequestHandler::set_rate_limit_headers(const Payer& payer, api::Response& response) const {
    // The unit is a millisecond of work; budgets count microseconds.
    const std::uint64_t rate = options_.budget.rate, burst = options_.budget.burst;
    const Budgets::Level level = budgets_->level(payer, Clock::now());
    const auto seconds = std::chrono::ceil<std::chrono::seconds>(level.until_full).count();
    api::set_header(response, "RateLimit-Policy",
                    "\"work\";q=" + std::to_string(burst / 1000) +
                        ";w=" + std::to_string((burst + rate - 1) / rate));
    api::set_header(
        response, "RateLimit",
        "\"work\";r=" + std::to_string(level.work / 1000) + ";t=" + std::to_string(seconds));
    response.cacheable = false;
}

std::chrono::microseconds RequestHandler::charge(const Payer& payer, const api::Key& key,
                                                 std::uint64_t reading, std::uint64_t& work) {
    if (!budgets_ || single_flight_.is_in_flight(key)) {
        work = 0;
        if (budgets_) budgets_->owe(payer, reading, Clock::now());
        return {};
    }
    // One charge for both: a job that costs more than the bucket holds needs a full bucket, which
    // it would never find after a separate charge for reading its body.
    const auto missing = budgets_->spend(payer, reading + work, Clock::now());
    if (missing == missing.zero()) return missing;
    budgets_->owe(payer, reading, Clock::now());
    return missing + std::chrono::microseconds(reading * 1'000'000 / options_.budget.rate);
}

void RequestHandler::reply_over_budget(const api::Service& service,
                                       const std::shared_ptr<PendingRequest>& pending,
                                       const CheckedRequest& checked,
                                       std::chrono::microseconds missing) {
    metrics_.rejected("budget");
    const auto seconds = std::chrono::ceil<std::chrono::seconds>(missing).count();
    api::Response refusal = service.problem(
        *checked.request, 429,
        "the work budget of this client is exhausted; Retry-After says when it suffices",
        {{"Retry-After", std::to_string(seconds)}});
    set_rate_limit_headers(checked.payer, refusal);
    pending->reply(std::move(refusal));
}

RequestHandler::CheckedRequest RequestHandler::check_signature(
    const AppState& state, const std::shared_ptr<PendingRequest>& pending) const {
    const api::Request& original = pending->request();
    const api::Route* const route = pending->routed().match.route;
    CheckedRequest checked{
        {pending, &original}, {pending, &pending->routed()}, std::nullopt, {}, false};
    if (!state.signatures || original.method == "OPTIONS" || !route || !api::is_generated(*route))
        return checked;
    SignatureCheck signature = state.signatures->check(original.method, original.target,
                                                       original.body, seconds_since_1970());
    if (!signature.is_valid) {
        checked.refusal = std::move(signature.refusal);
        return checked;
    }
    auto unsigned_request = std::make_shared<api::Request>(original);
    unsigned_request->target = std::move(signature.target);
    checked.expires = signature.expires;
    // The target without its signature is another one.
    checked.routed =
        std::make_shared<const api::RoutedRequest>(state.service->route(*unsigned_request));
    checked.request = std::move(unsigned_request);
    return checked;
}

RequestHandler::JobResult RequestHandler::run_job(api::Service& service, const api::Job& job,
                                                  std::stop_token stop, double queue) {
    api::Stopwatch watch;
    JobResult result;
    result.response =
        job.run(std::move(stop), watch.observer(),
                [this](std::span<const std::function<void()>> tasks) { pool_.share(tasks); });
    result.timing = watch.timing(queue);
    metrics_.generated(result.timing);
    service.finish(job.key, result.response);
    return result;
}

std::vector<api::Response> RequestHandler::warm(std::span<const std::string> targets) {
    const StatePointer state = this->state();
    std::vector<api::Response> responses(targets.size());
    std::vector<std::function<void()>> tasks;
    for (std::size_t i = 0; i < targets.size(); ++i)
        tasks.emplace_back([&, i] {
            api::Request request;
            request.method = "GET";
            request.target = targets[i];
            request.id = "warm";
            auto planned = api::plan_here(*state->service, request);
            if (const auto* job = std::get_if<api::Job>(&planned)) {
                try {
                    responses[i] = run_job(*state->service, *job, {}, 0).response;
                } catch (...) {
                    responses[i] = state->service->problem(request, std::current_exception());
                }
            } else {
                responses[i] = std::move(std::get<api::Response>(planned));
            }
        });
    pool_.share(tasks);
    return responses;
}

std::optional<RequestHandler::SharedJobs::Ticket> RequestHandler::join(
    const StatePointer& state, api::Job to_do, SharedJobs::OnComplete then) {
    const auto job = std::make_shared<const api::Job>(std::move(to_do));
    const Clock::time_point joined = Clock::now();
    const auto work = [this, state, job, joined](std::stop_token stop) {
        const double queue =
            std::chrono::duration<double, std::milli>(Clock::now() - joined).count();
        return run_job(*state->service, *job, std::move(stop), queue);
    };
    const TaskLength length =
        job->cost.work() < lengthy_work ? TaskLength::brief : TaskLength::lengthy;
    return single_flight_.join(job->key, work, std::move(then), length);
}

api::Response RequestHandler::deliver(const api::Service& service, const api::Request& request,
                                      const api::Delivery& delivery,
                                      const SharedJobs::Completion& completion) {
    if (completion.error) {
        api::Response response = service.problem(request, completion.error);
        if (response.status == 500)
            log_.event(LogLevel::error, "making failed",
                       {{"id", Value(request.id)}, {"what", Value(message_of(completion.error))}});
        return response;
    }
    if (completion.collapsed) metrics_.collapsed();
    return service.deliver(request, delivery, completion.result->response,
                           completion.collapsed ? api::Outcome::collapsed : api::Outcome::generated,
                           completion.result->timing);
}

api::Response RequestHandler::operational_response(const api::Request& request,
                                                   const api::RoutedRequest& routed, bool metrics) {
    if (routed.response) return *routed.response;
    const std::string_view path = routed.match.pattern;
    const StatePointer state = this->state();
    const api::Service& service = *state->service;
    if (path == "/livez") return text_response(request, alive);
    if (path == "/readyz") {
        if (is_ready()) return text_response(request, "ready\n");
        return service.problem(
            request, 503, ready_ ? "too much is waiting" : "the server is starting or stopping",
            {{"Retry-After", "1"}});
    }
    if (!metrics)
        return service.problem(request, 404, "metrics are answered on a port of their own");
    return text_response(request, metrics_.text(service.counters(), gauges()),
                         "text/plain; version=0.0.4; charset=utf-8");
}

api::Response RequestHandler::text_response(const api::Request& request, const std::string& text,
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
