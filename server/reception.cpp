#include "server/reception.h"

#include <chrono>
#include <exception>
#include <optional>
#include <utility>
#include <variant>

#include "api/answers.h"
#include "api/query.h"
#include "api/routes.h"
#include "api/stopwatch.h"
#include "server/machine.h"

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
    const api::Target asked = api::split_target(target, ignored);
    for (const std::string_view tried : {method, std::string_view("GET")})
        if (const api::Match match = api::match_route(tried, asked.segments); match.route)
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

Reception::Reception(Means means, Metrics& metrics, Log& log, const ReceptionOptions& options)
    : means_(std::make_shared<const Means>(std::move(means))),
      metrics_(metrics),
      log_(log),
      options_(options),
      slots_(options_.slots, options_.longest_queue),
      flights_(slots_, options_.most_waiters) {
    if (options_.budget.rate > 0) budgets_.emplace(options_.budget);
}

std::shared_ptr<const Means> Reception::means() const {
    const std::lock_guard lock(means_mutex_);
    return means_;
}

void Reception::renew(Means means) {
    auto renewed = std::make_shared<const Means>(std::move(means));
    const std::lock_guard lock(means_mutex_);
    means_.swap(renewed);  // what was there is destroyed outside the lock
}

Handlers Reception::handlers() {
    Handlers handlers;
    handlers.answer = [this](const std::shared_ptr<Visit>& visit) { answer(visit); };
    handlers.refuse = [this](const api::Request& request, int status, std::string_view detail) {
        std::vector<api::Header> extra;
        if (status == 429 || status == 503) extra.emplace_back("Retry-After", "1");
        return means()->service->problem(request, status, detail, extra);
    };
    handlers.most_body = [this](std::string_view method, std::string_view target) {
        return means()->service->most_body(method, target);
    };
    handlers.judge_head = [this](const api::Request& request) -> std::optional<api::Answer> {
        const std::string_view path = path_of(options_.base_path, request.target);
        if (!is_own(path)) return means()->service->answer_to_head(request);
        if (request.method == "GET" || request.method == "HEAD") return std::nullopt;
        return housekeeping(request, path, options_.metrics);
    };
    handlers.label = [this](std::string_view method, std::string_view target) {
        return route_of(options_.base_path, method, target);
    };
    api::Request nobody;
    nobody.id = "standing";
    handlers.standing = {{"/livez", plain(nobody, alive)}};
    handlers.standing[0].second.repeatable = true;
    handlers.served = [this](const Served& served) { report(served); };
    return handlers;
}

Handlers Reception::metrics_handlers() {
    Handlers handlers = this->handlers();
    handlers.answer = [this](const std::shared_ptr<Visit>& visit) {
        const api::Request& request = visit->request();
        const std::string_view path = path_of(options_.base_path, request.target);
        visit->reply(is_own(path)
                         ? housekeeping(request, path, true)
                         : means()->service->problem(request, 404,
                                                     "only /metrics, /livez and /readyz are here"));
    };
    handlers.most_body = [](std::string_view, std::string_view) { return std::size_t{0}; };
    handlers.judge_head = nullptr;  // no body is taken anyway
    return handlers;
}

bool Reception::is_ready() const {
    const auto has_room = [](std::size_t waiting, std::size_t most) {
        return most == 0 || waiting * 10 < most * 9;
    };
    const Transport* const transport = transport_;
    const Transport::Load load = transport ? transport->load() : Transport::Load();
    return ready_ && has_room(slots_.waiting(), slots_.longest_queue()) &&
           has_room(load.queue, load.queue_limit);
}

void Reception::answer(const std::shared_ptr<Visit>& visit) {
    const std::string_view path = path_of(options_.base_path, visit->request().target);
    if (is_own(path)) return visit->reply(housekeeping(visit->request(), path, options_.metrics));
    const Using means = this->means();
    const Asked asked = this->asked(*means, visit);
    if (!asked.why_not.empty()) {
        metrics_.rejected("signature");
        return visit->reply(means->service->problem(*asked.request, 403, asked.why_not));
    }
    answer(means, visit, asked, false);
}

void Reception::answer(const Using& means, const std::shared_ptr<Visit>& visit, Asked asked,
                       bool prepared) {
    api::Service& service = *means->service;
    const api::Request& request = *asked.request;
    // A body is read to know what it asks for, and costs that even if it is refused.
    const std::uint64_t reading = budgets_ && !prepared && !request.body.empty()
                                      ? service.cost_of_reading(request).work()
                                      : 0;
    if (reading > large_reading)
        if (const auto missing = budgets_->spend(client_of(visit->client()), 0, Clock::now());
            missing > missing.zero())
            return reply_over_budget(service, visit, request, missing);
    std::optional<Answers::Glance> glance(std::in_place, flights_);
    std::variant<api::Answer, api::Job> planned = service.plan(request, prepared);
    if (api::Answer* answer = std::get_if<api::Answer>(&planned)) {
        if (reading > 0) {
            budgets_->owe(client_of(visit->client()), reading, Clock::now());
            asked.is_charged = true;
        }
        return reply(visit, asked, std::move(*answer));
    }

    auto& job = std::get<api::Job>(planned);
    std::uint64_t work = job.cost.work();
    if (const auto missing = charge(visit->client(), job.key, reading, work);
        missing > missing.zero())
        return reply_over_budget(service, visit, request, missing);
    asked.is_charged = asked.is_charged || (budgets_ && reading + work > 0);
    // Delivered by a worker of the transport: a slot is for making. After what only prepares it goes on when that has landed
    // and its own wait is known, or the next would be taken for that.
    const bool prepares = job.prepares;
    const auto go_on = [this, means, visit, asked,
                        other_came = std::make_shared<std::atomic<bool>>(false)] {
        if (other_came->exchange(true))
            visit->resume([=, this] { answer(means, visit, asked, true); });
    };
    const auto landed = [=, this](const Answers::Landing& landing) {
        if (prepares && !landing.error) return go_on();
        visit->resume([=, this] {
            reply(visit, asked, delivered(*means->service, *asked.request, landing));
        });
    };
    const std::optional<Answers::Seat> seat = board(means, std::move(job), landed);
    glance.reset();
    if (!seat) {
        if (work > 0) budgets_->give_back(client_of(visit->client()), work, Clock::now());
        metrics_.rejected("queue");
        return visit->reply(service.problem(
            request, 503, "too much is being made; try again in a moment", {{"Retry-After", "1"}}));
    }
    visit->wait([this, means, visit, asked, seat = *seat](Visit::Over why) {
        if (!flights_.leave(seat)) return;  // it has landed
        const bool left = why == Visit::Over::left;
        metrics_.rejected(left ? "left" : "deadline");
        if (left) {
            api::Answer nobody;
            nobody.status = client_left;
            return visit->reply(std::move(nobody));
        }
        reply(
            visit, asked,
            means->service->problem(visit->request(), 504, "this took longer than a request may"));
    });
    if (prepares) go_on();
}

void Reception::reply(const std::shared_ptr<Visit>& visit, const Asked& asked,
                      api::Answer answer) const {
    if (asked.expires) {
        answer.repeatable = false;  // The next client must not get it without a look at the clock.
        api::bound_freshness(answer, *asked.expires - seconds_since_1970());
    }
    if (asked.is_charged) tell_budget(visit->client(), answer);
    visit->reply(std::move(answer));
}

void Reception::tell_budget(const Address& client, api::Answer& answer) const {
    // The unit is a millisecond of work; budgets count microseconds.
    const std::uint64_t rate = options_.budget.rate, burst = options_.budget.burst;
    const Budgets::Level level = budgets_->level(client_of(client), Clock::now());
    const auto seconds = std::chrono::ceil<std::chrono::seconds>(level.until_full).count();
    api::set_header(answer, "RateLimit-Policy",
                    "\"work\";q=" + std::to_string(burst / 1000) +
                        ";w=" + std::to_string((burst + rate - 1) / rate));
    api::set_header(
        answer, "RateLimit",
        "\"work\";r=" + std::to_string(level.work / 1000) + ";t=" + std::to_string(seconds));
    answer.repeatable = false;
}

std::chrono::microseconds Reception::charge(const Address& client, const api::Key& key,
                                            std::uint64_t reading, std::uint64_t& work) {
    if (!budgets_ || flights_.flies(key)) {
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

void Reception::reply_over_budget(const api::Service& service, const std::shared_ptr<Visit>& visit,
                                  const api::Request& request, std::chrono::microseconds missing) {
    metrics_.rejected("budget");
    const auto seconds = std::chrono::ceil<std::chrono::seconds>(missing).count();
    api::Answer refusal = service.problem(
        request, 429, "this client has had much made; there is room for more in a while",
        {{"Retry-After", std::to_string(seconds)}});
    tell_budget(visit->client(), refusal);
    visit->reply(std::move(refusal));
}

Reception::Asked Reception::asked(const Means& means, const std::shared_ptr<Visit>& visit) const {
    const api::Request& whole = visit->request();
    Asked asked{{visit, &whole}, std::nullopt, {}, false};
    if (!means.signatures || whole.method == "OPTIONS") return asked;
    std::vector<Problem> ignored;
    const api::Match match = api::match_route(
        whole.method,
        api::split_target(api::below(options_.base_path, whole.target), ignored).segments);
    if (!match.route || !api::makes(match.route->endpoint)) return asked;
    Checked checked =
        means.signatures->check(whole.method, whole.target, whole.body, seconds_since_1970());
    if (!checked.good) {
        asked.why_not = std::move(checked.why);
        return asked;
    }
    auto rest = std::make_shared<api::Request>(whole);
    rest->target = std::move(checked.target);
    asked.expires = checked.expires;
    asked.request = std::move(rest);
    return asked;
}

/// Does a job, here and on idle slots, and keeps what comes of it.
Reception::Made Reception::made(api::Service& service, const api::Job& job, std::stop_token stop,
                                double queue) {
    api::Stopwatch watch;
    Made made;
    made.answer =
        job.run(std::move(stop), watch.observer(),
                [this](std::span<const std::function<void()>> pieces) { slots_.share(pieces); });
    made.timing = watch.timing(queue);
    metrics_.made(made.timing);
    service.finish(job.key, made.answer);
    return made;
}

std::vector<api::Answer> Reception::warm(std::span<const std::string> targets) {
    const Using means = this->means();
    std::vector<api::Answer> answers(targets.size());
    std::vector<std::function<void()>> pieces;
    for (std::size_t i = 0; i < targets.size(); ++i)
        pieces.emplace_back([&, i] {
            api::Request request;
            request.method = "GET";
            request.target = targets[i];
            request.id = "warm";
            auto planned = api::plan_here(*means->service, request);
            if (const auto* job = std::get_if<api::Job>(&planned)) {
                try {
                    answers[i] = made(*means->service, *job, {}, 0).answer;
                } catch (...) {
                    answers[i] = means->service->problem(request, std::current_exception());
                }
            } else {
                answers[i] = std::move(std::get<api::Answer>(planned));
            }
        });
    slots_.share(pieces);
    return answers;
}

std::optional<Reception::Answers::Seat> Reception::board(const Using& means, api::Job to_do,
                                                         Answers::Then then) {
    const auto job = std::make_shared<const api::Job>(std::move(to_do));
    const Clock::time_point boarded = Clock::now();
    const auto work = [this, means, job, boarded](std::stop_token stop) {
        const double queue =
            std::chrono::duration<double, std::milli>(Clock::now() - boarded).count();
        return made(*means->service, *job, std::move(stop), queue);
    };
    return flights_.board(job->key, work, std::move(then));
}

api::Answer Reception::delivered(const api::Service& service, const api::Request& request,
                                 const Answers::Landing& landing) {
    if (landing.error) {
        api::Answer answer = service.problem(request, landing.error);
        if (answer.status == 500)
            log_.event(LogLevel::error, "making failed",
                       {{"id", Value(request.id)}, {"what", Value(what(landing.error))}});
        return answer;
    }
    if (landing.collapsed) metrics_.collapsed();
    return service.deliver(request, landing.result->answer,
                           landing.collapsed ? api::Outcome::collapsed : api::Outcome::made,
                           landing.result->timing);
}

api::Answer Reception::housekeeping(const api::Request& request, std::string_view path,
                                    bool metrics) {
    const Using means = this->means();
    const api::Service& service = *means->service;
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

api::Answer Reception::plain(const api::Request& request, const std::string& text,
                             std::string type) const {
    api::Answer answer;
    answer.headers = {{"Content-Type", std::move(type)},
                      {"Cache-Control", "no-store"},
                      {"X-Content-Type-Options", "nosniff"},
                      {"X-Request-Id", request.id}};
    answer.body = {slice_of(text)};
    return answer;
}

void Reception::report(const Served& served) {
    metrics_.served(served);
    log_.request(served);
}

Gauges Reception::gauges() const {
    Gauges gauges;
    gauges.workers = slots_.count();
    gauges.busy_workers = slots_.busy();
    gauges.queue = slots_.waiting();
    gauges.queue_limit = slots_.longest_queue();
    gauges.in_the_air = flights_.in_the_air();
    gauges.waiters = flights_.waiters();
    if (const Transport* transport = transport_) gauges.connections = transport->load();
    gauges.clients = budgets_ ? budgets_->clients() : 0;
    gauges.ready = is_ready();
    return gauges;
}

}  // namespace sporeprint::server
