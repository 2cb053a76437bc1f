#include "server/reception.h"

#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <utility>
#include <variant>

#include "api/query.h"
#include "api/routes.h"
#include "api/stopwatch.h"

namespace sporeprint::server {

namespace {

using Clock = std::chrono::steady_clock;

/// How often a waiting request looks whether its client is still there.
constexpr std::chrono::milliseconds between_looks{100};

constexpr std::string_view own_paths[] = {"/livez", "/readyz", "/metrics"};

/// The path of a target in origin or absolute form, still encoded.
std::string_view path_of(std::string_view target) {
    if (const std::size_t scheme = target.find("://");
        scheme != std::string_view::npos && !target.starts_with('/')) {
        const std::size_t slash = target.find('/', scheme + 3);
        target = slash == std::string_view::npos ? "/" : target.substr(slash);
    }
    return target.substr(0, target.find('?'));
}

bool is_own(std::string_view path) {
    for (const std::string_view own : own_paths)
        if (path == own) return true;
    return false;
}

/// The template of a request's route, for the metrics.
std::string route_of(const Served& served) {
    const std::string_view path = path_of(served.target);
    if (is_own(path)) return std::string(path);
    std::vector<Problem> ignored;
    const api::Target target = api::split_target(served.target, ignored);
    for (const std::string_view method : {std::string_view(served.method), std::string_view("GET")})
        if (const api::Match match = api::match_route(method, target.segments); match.route)
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

Reception::Reception(api::Service& service, Metrics& metrics, Log& log, ReceptionOptions options)
    : service_(service),
      metrics_(metrics),
      log_(log),
      options_(options),
      slots_(options.slots, options.longest_queue),
      flights_(slots_, options.most_waiters) {}

Handlers Reception::handlers() {
    Handlers handlers;
    handlers.answer = [this](const api::Request& request, const Gone& gone) {
        return answer(request, gone);
    };
    handlers.refuse = [this](const api::Request& request, int status, std::string_view detail) {
        std::vector<api::Header> extra;
        if (status == 503) extra.emplace_back("Retry-After", "1");
        return service_.problem(request, status, detail, extra);
    };
    handlers.most_body = [this](std::string_view method, std::string_view target) {
        return service_.most_body(method, target);
    };
    handlers.served = [this](const Served& served) { report(served); };
    return handlers;
}

Handlers Reception::metrics_handlers() {
    Handlers handlers = this->handlers();
    handlers.answer = [this](const api::Request& request, const Gone&) {
        const std::string_view path = path_of(request.target);
        if (is_own(path)) return housekeeping(request, path, true);
        return service_.problem(request, 404, "only /metrics, /livez and /readyz are here");
    };
    handlers.most_body = [](std::string_view, std::string_view) { return std::size_t{0}; };
    return handlers;
}

bool Reception::is_ready() const {
    return ready_ && slots_.waiting() * 10 < slots_.longest_queue() * 9;
}

api::Answer Reception::answer(const api::Request& request, const Gone& gone) {
    const std::string_view path = path_of(request.target);
    if (is_own(path)) return housekeeping(request, path, options_.metrics);
    std::optional<Answers::Glance> glance(std::in_place, flights_);
    std::variant<api::Answer, api::Job> planned = service_.plan(request);
    if (api::Answer* answer = std::get_if<api::Answer>(&planned)) return std::move(*answer);

    struct Arrival {
        std::mutex mutex;
        std::condition_variable changed;
        std::optional<Answers::Landing> landing;
    };
    const auto arrival = std::make_shared<Arrival>();
    const auto job = std::make_shared<const api::Job>(std::move(std::get<api::Job>(planned)));
    const Clock::time_point boarded = Clock::now();
    const auto work = [this, job, boarded](std::stop_token stop) {
        const double queue =
            std::chrono::duration<double, std::milli>(Clock::now() - boarded).count();
        api::Stopwatch watch;
        Made made;
        made.answer = job->run(
            std::move(stop), watch.observer(),
            [this](std::span<const std::function<void()>> pieces) { slots_.share(pieces); });
        made.timing = watch.timing(queue);
        metrics_.made(made.timing);
        service_.finish(job->key, made.answer);
        return made;
    };
    const auto seat = flights_.board(job->key, work, [arrival](const Answers::Landing& landing) {
        const std::lock_guard lock(arrival->mutex);
        arrival->landing = landing;
        arrival->changed.notify_all();
    });
    glance.reset();
    if (!seat) {
        metrics_.rejected("queue");
        return service_.problem(request, 503, "too much is being made; try again in a moment",
                                {{"Retry-After", "1"}});
    }

    const Clock::time_point deadline = boarded + options_.deadline;
    std::unique_lock lock(arrival->mutex);
    while (!arrival->landing) {
        const Clock::time_point look = std::min(deadline, Clock::now() + between_looks);
        if (arrival->changed.wait_until(lock, look, [&] { return arrival->landing.has_value(); }))
            break;
        lock.unlock();
        const bool late = Clock::now() >= deadline;
        const bool left = gone();
        if ((late || left) && flights_.leave(*seat)) {
            metrics_.rejected(left ? "left" : "deadline");
            if (left) {
                api::Answer nobody;
                nobody.status = client_left;
                return nobody;
            }
            return service_.problem(request, 504, "this took longer than a request may");
        }
        lock.lock();
    }
    const Answers::Landing landing = std::move(*arrival->landing);
    lock.unlock();
    return delivered(request, landing);
}

api::Answer Reception::delivered(const api::Request& request, const Answers::Landing& landing) {
    if (landing.error) {
        api::Answer answer = service_.problem(request, landing.error);
        if (answer.status == 500)
            log_.event(LogLevel::error, "making failed",
                       {{"id", Value(request.id)}, {"what", Value(what(landing.error))}});
        return answer;
    }
    if (landing.collapsed) metrics_.collapsed();
    return service_.deliver(request, landing.result->answer,
                            landing.collapsed ? api::Outcome::collapsed : api::Outcome::made,
                            landing.result->timing);
}

api::Answer Reception::housekeeping(const api::Request& request, std::string_view path,
                                    bool metrics) {
    if (request.method != "GET" && request.method != "HEAD")
        return service_.problem(request, 405, "only GET and HEAD are answered here",
                                {{"Allow", "GET, HEAD"}});
    if (path == "/livez") return plain(request, "alive\n");
    if (path == "/readyz") {
        if (is_ready()) return plain(request, "ready\n");
        return service_.problem(
            request, 503, ready_ ? "too much is being made" : "the server is starting or stopping",
            {{"Retry-After", "1"}});
    }
    if (!metrics)
        return service_.problem(request, 404, "metrics are answered on a port of their own");
    return plain(request, metrics_.text(service_.counters(), gauges()),
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
    metrics_.served(served, route_of(served));
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
    gauges.ready = is_ready();
    return gauges;
}

}  // namespace sporeprint::server
