#include "server/request_handler.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <semaphore>
#include <thread>
#include <utility>

#include "api/library/library.h"
#include "api/library/tokens.h"
#include "core/atlas/atlas.h"
#include "server/operations/machine.h"
#include "server/records/open.h"
#include "tests/server/raw_client.h"
#include "tests/server/records/contract.h"

namespace sporeprint::server::request_handler_test {
namespace {

using namespace std::chrono_literals;

const std::string small = "/v1/mushrooms/amanita_muscaria.glb?lod=3&texture_size=128&seed=";
const std::string heavy = "/v1/mushrooms/amanita_muscaria.glb?texture_size=1024&seed=";

/// A pending request without a transport; its creator waits for the response.
class TestRequest final : public PendingRequest {
  public:
    TestRequest(api::Request request, const Handlers& handlers, const Address& client = {})
        : request_(std::move(request)), routed_(handlers.route(request_)), client_(client) {}

    const api::Request& request() const override { return request_; }
    const api::RoutedRequest& routed() const override { return *routed_; }
    const Address& client() const override { return client_; }
    bool is_disconnected() const override { return false; }
    void reply(api::Response response) override {
        const std::lock_guard lock(mutex_);
        if (!response_) response_ = std::move(response);
        changed_.notify_all();
    }
    void resume(std::function<void()> task) override { task(); }
    void wait(std::function<void(CancelReason)> on_cancel) override {
        const std::lock_guard lock(mutex_);
        on_cancel_ = std::move(on_cancel);
    }

    /// Waits for the response and cancels the request after the timeout. Sanitizers slow everything
    /// down, so five minutes mean no timeout.
    api::Response response(std::chrono::milliseconds timeout = 5min,
                           CancelReason reason = CancelReason::timed_out) {
        std::unique_lock lock(mutex_);
        if (!changed_.wait_for(lock, timeout, [&] { return response_.has_value(); })) {
            const auto on_cancel = std::exchange(on_cancel_, nullptr);
            lock.unlock();
            on_cancel(reason);
            lock.lock();
            changed_.wait(lock, [&] { return response_.has_value(); });
        }
        on_cancel_ = nullptr;  // it may own this request
        return *response_;
    }

  private:
    const api::Request request_;
    const std::shared_ptr<const api::RoutedRequest> routed_;
    const Address client_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::optional<api::Response> response_;
    std::function<void(CancelReason)> on_cancel_;
};

/// A request handler with the real service, called without sockets.
struct Harness {
    explicit Harness(RequestHandlerOptions options = {},
                     std::shared_ptr<const Signatures> signatures = nullptr,
                     std::shared_ptr<api::Library> library = nullptr)
        : service(std::make_shared<api::Service>(built_in_atlas(), api::ServiceOptions(),
                                                 std::move(library))),
          request_handler({service, std::move(signatures)}, metrics, log, options) {
        handlers = request_handler.handlers();
        request_handler.open();
    }

    api::Response ask(const std::string& target, const std::string& method = "GET",
                      std::chrono::milliseconds timeout = 5min,
                      PendingRequest::CancelReason reason = PendingRequest::CancelReason::timed_out,
                      std::vector<api::Header> headers = {}) {
        api::Request request = request_of(method, target);
        request.headers = std::move(headers);
        return ask(std::move(request), timeout, reason);
    }

    api::Response post(const std::string& target, std::string body) {
        api::Request request = request_of("POST", target);
        request.headers = {{"Content-Type", "application/json"}};
        request.body = std::move(body);
        return ask(std::move(request), 5min, PendingRequest::CancelReason::timed_out);
    }

    static api::Request request_of(const std::string& method, const std::string& target) {
        api::Request request;
        request.method = method;
        request.target = target;
        request.id = "test";
        return request;
    }

    api::Response ask(api::Request request, std::chrono::milliseconds timeout,
                      PendingRequest::CancelReason reason) {
        const auto pending = std::make_shared<TestRequest>(std::move(request), handlers);
        handlers.respond(pending);
        return pending->response(timeout, reason);
    }

    std::shared_ptr<api::Service> service;
    Metrics metrics{"1.2.3", "7"};
    Log log{LogLevel::off};
    RequestHandler request_handler;
    Handlers handlers;
};

std::string text_of(const api::Response& response) {
    std::string text;
    for (const Slice& slice : response.body)
        text.append(reinterpret_cast<const char*>(slice.data()), slice.size);
    return text;
}

/// Starts threads that each request another expensive resource. When it returns, all of them wait,
/// or half of them have been served.
std::vector<std::jthread> start_waiting_requests(Harness& harness, int count) {
    std::vector<std::jthread> clients;
    for (int i = 0; i < count; ++i)
        clients.emplace_back(
            [&harness, i] { EXPECT_EQ(harness.ask(heavy + std::to_string(i)).status, 200); });
    const std::string all_wait = "sporeprint_waiters " + std::to_string(count) + '\n';
    while (text_of(harness.ask("/metrics")).find(all_wait) == std::string::npos &&
           harness.service->counters().generated < static_cast<std::uint64_t>(count) / 2)
        std::this_thread::yield();
    return clients;
}

std::string header(const api::Response& response, std::string_view name) {
    for (const auto& [key, value] : response.headers)
        if (key == name) return value;
    return {};
}

TEST(RequestHandler, GeneratesOnceForConcurrentEqualRequests) {
    RequestHandlerOptions options;
    options.threads = 4;
    Harness harness(options);
    std::atomic<int> collapsed{0}, good{0};
    {
        std::vector<std::jthread> threads;
        for (int i = 0; i < 64; ++i)
            threads.emplace_back([&] {
                const api::Response response = harness.ask(small + "9");
                if (response.status == 200 && size_of(response.body) > 1000) ++good;
                if (header(response, "Cache-Status").ends_with("collapsed")) ++collapsed;
            });
    }
    EXPECT_EQ(good, 64);
    EXPECT_EQ(harness.service->counters().generated, 1u);
    const api::Response again = harness.ask(small + "9");
    EXPECT_EQ(header(again, "Cache-Status"), "sporeprint; hit");
    EXPECT_EQ(harness.service->counters().generated, 1u);
}

TEST(RequestHandler, RespondsToHealthChecksAndCachedTargetsWhileThePoolIsBusy) {
    Harness harness;
    ASSERT_EQ(harness.ask(small + "1").status, 200);
    std::atomic<int> running{0};
    std::vector<std::jthread> threads;
    for (int i = 0; i < 16; ++i)
        threads.emplace_back([&, i] {
            ++running;
            EXPECT_EQ(harness.ask(heavy + std::to_string(i)).status, 200);
            --running;
        });
    while (running < 16) std::this_thread::yield();
    EXPECT_EQ(text_of(harness.ask("/livez")), "alive\n");
    EXPECT_EQ(harness.ask(small + "1").status, 200);
    const int still_running = running;
    EXPECT_GT(still_running, 0) << "the jobs must outlast the requests above";
}

TEST(RequestHandler, ReportsReadinessOnlyBetweenOpenAndClose) {
    Harness harness;
    EXPECT_EQ(harness.ask("/readyz").status, 200);
    EXPECT_EQ(harness.ask("/readyz", "HEAD").status, 200);
    harness.request_handler.close();
    const api::Response response = harness.ask("/readyz");
    EXPECT_EQ(response.status, 503);
    EXPECT_EQ(header(response, "Content-Type"), "application/problem+json");
    EXPECT_EQ(header(response, "Retry-After"), "1");
    EXPECT_EQ(harness.ask("/livez").status, 200);
    const api::Response posted = harness.ask("/livez", "POST");
    EXPECT_EQ(posted.status, 405);
    EXPECT_EQ(header(posted, "Allow"), "GET, HEAD");
}

TEST(RequestHandler, ExportsPrometheusMetrics) {
    Harness harness;
    harness.ask(small + "5");
    Served served;
    served.method = "GET";
    served.status = 200;
    served.milliseconds = 3;
    for (const char* target :
         {"/v1/species/amanita_muscaria", "/nowhere", "/nowhere/else", "/livez"}) {
        served.label = harness.handlers.route(Harness::request_of("GET", target))->label();
        harness.handlers.served(served);
    }
    const api::Response response = harness.ask("/metrics");
    EXPECT_TRUE(header(response, "Content-Type").starts_with("text/plain; version=0.0.4"));
    const std::string text = text_of(response);
    for (const char* line :
         {"sporeprint_generated_total 1",
          "sporeprint_build_info{version=\"1.2.3\",generator_version=\"7\"} 1",
          "{code=\"200\",method=\"GET\",route=\"UNKNOWN\"} 2", "route=\"/v1/species/{id}\"",
          "route=\"/livez\"", "sporeprint_cache_requests_total{cache=\"glb\",result=\"miss\"} 1",
          "sporeprint_queue_depth 0", "sporeprint_request_span_seconds_count{span=\"paint\"} 1",
          "process_resident_memory_bytes ", "sporeprint_http_request_duration_seconds_bucket"})
        EXPECT_NE(text.find(line), std::string::npos) << line << "\n" << text;
}

TEST(RequestHandler, ServesMetricsOnTheirOwnPortOnly) {
    RequestHandlerOptions options;
    options.metrics = false;
    Harness harness(options);
    EXPECT_EQ(harness.ask("/metrics").status, 404);
    harness.handlers = harness.request_handler.metrics_handlers();
    EXPECT_EQ(harness.ask("/metrics").status, 200);
    EXPECT_EQ(harness.ask("/livez").status, 200);
    EXPECT_EQ(harness.ask("/v1/species").status, 404);
}

TEST(RequestHandler, IsNotReadyWhileTooManyWaitForAWorker) {
    Harness harness;
    std::counting_semaphore<> gate(0), begun(0);
    Handlers slow = harness.handlers;
    slow.respond = [&](const std::shared_ptr<PendingRequest>& pending) {
        begun.release();
        gate.acquire();
        harness.handlers.respond(pending);
    };
    TransportOptions options;
    options.port = 0;
    options.workers = 1;
    options.longest_queue = 10;
    Transport transport(options, slow);
    harness.request_handler.watch(&transport);
    transport.start();
    EXPECT_TRUE(harness.request_handler.is_ready());
    std::vector<std::unique_ptr<RawClient>> waiting;
    for (int i = 0; i < 10; ++i) {
        waiting.push_back(std::make_unique<RawClient>(transport.port()));
        waiting.back()->send("GET /v1 HTTP/1.1\r\n\r\n");
        if (i == 0) begun.acquire();
    }
    for (int i = 0; i < 1000 && harness.request_handler.is_ready(); ++i)
        std::this_thread::sleep_for(5ms);
    EXPECT_EQ(transport.load().queue, 9u);
    EXPECT_EQ(harness.ask("/readyz").status, 503);
    EXPECT_EQ(harness.ask("/livez").status, 200);
    gate.release(10);
    for (auto& one : waiting) EXPECT_EQ(one->receive().status, 200);
    EXPECT_EQ(harness.ask("/readyz").status, 200);
    transport.drain();
    harness.request_handler.watch(nullptr);
}

TEST(RequestHandler, RefusesJobsBeyondTheQueue) {
    RequestHandlerOptions options;
    options.longest_queue = 0;
    Harness harness(options);
    std::atomic<int> good{0}, refused{0};
    {
        std::vector<std::jthread> threads;
        for (int i = 0; i < 12; ++i)
            threads.emplace_back([&, i] {
                const api::Response response = harness.ask(heavy + std::to_string(i));
                if (response.status == 200) ++good;
                if (response.status == 503 && header(response, "Retry-After") == "1") ++refused;
            });
    }
    EXPECT_EQ(good + refused, 12);
    EXPECT_GE(good, 1);
    EXPECT_GE(refused, 1);
    api::Response again = harness.ask(heavy + "99");
    for (int i = 0; i < 1000 && again.status == 503;
         ++i) {  // the last thread may still be finishing
        std::this_thread::sleep_for(5ms);
        again = harness.ask(heavy + "99");
    }
    EXPECT_EQ(again.status, 200) << "the handler recovers";
}

TEST(RequestHandler, CancelsAtTheDeadlineAndWhenTheClientDisconnects) {
    Harness late;
    const api::Response response = late.ask(heavy + "1", "GET", 1ms);
    EXPECT_EQ(response.status, 504);
    EXPECT_EQ(header(response, "Content-Type"), "application/problem+json");

    Harness disconnected;  // one thread: the last request waits for all earlier ones
    std::vector<std::jthread> clients = start_waiting_requests(disconnected, 60);
    EXPECT_EQ(
        disconnected.ask(heavy + "1000", "GET", 0ms, PendingRequest::CancelReason::disconnected)
            .status,
        client_left);
    clients.clear();
    EXPECT_EQ(disconnected.service->counters().generated, 60u) << "the cancelled job does not run";
    EXPECT_NE(text_of(disconnected.ask("/metrics")).find("{reason=\"left\"} 1\n"),
              std::string::npos);
}

TEST(RequestHandler, ChargesASharedJobOnceAndNoJobThatCouldNotBegin) {
    RequestHandlerOptions options;
    options.budget = {.rate = 1, .burst = 1};  // full: one job of any size, then none for long
    Harness once(options);
    std::atomic<int> good{0};
    {
        std::vector<std::jthread> threads;
        for (int i = 0; i < 12; ++i)
            threads.emplace_back([&] {
                if (once.ask(heavy + "1").status == 200) ++good;
            });
    }
    EXPECT_GE(good, 1);
    EXPECT_EQ(once.service->counters().generated, 1u);
    EXPECT_EQ(once.ask(heavy + "1").status, 200) << "cached";
    const api::Response refused = once.ask(heavy + "2");
    EXPECT_EQ(refused.status, 429);
    EXPECT_GT(std::stoll(header(refused, "Retry-After")), 10'000)
        << "microseconds of work at one per second";

    options.most_waiters = 0;
    Harness full(options);
    for (int i = 0; i < 3; ++i)
        EXPECT_EQ(full.ask(heavy + "1").status, 503) << "the charge is returned";
}

TEST(RequestHandler, ChargesOwnersOfTheLibraryApartFromTheAddressTheyShare) {
    const test::TemporaryFolder folder;
    auto library =
        std::make_shared<api::Library>(open_records((folder / "library.sqlite").string()),
                                       [] { return api::Seconds{1'800'000'000}; });
    std::vector<std::string> tokens;
    for (const char* const owner : {"kaja", "sami"}) {
        ASSERT_TRUE(library->records().add_owner(owner, 1));
        const api::Secret secret = api::new_secret(api::token_prefix);
        ASSERT_EQ(
            library->records().add_token(api::stored_token(secret, owner, "", api::Scope::read, 1)),
            api::WriteResult::done);
        tokens.push_back(secret.text);
    }
    RequestHandlerOptions options;
    options.budget = {.rate = 1, .burst = 7000};  // two requests to the library
    Harness harness(options, nullptr, library);
    const auto ask = [&](const std::string& token) {
        return harness.ask("/v1/library/quota", "GET", 5min,
                           PendingRequest::CancelReason::timed_out,
                           {{"Authorization", "Bearer " + token}});
    };
    // Who an owner is has to be found out once, at the cost of the address.
    EXPECT_EQ(ask(tokens[0]).status, 200);
    EXPECT_EQ(ask(tokens[1]).status, 200);
    EXPECT_EQ(ask("spk_").status, 429) << "the address has spent its budget";
    EXPECT_EQ(ask(tokens[0]).status, 200);
    EXPECT_EQ(ask(tokens[0]).status, 200);
    EXPECT_EQ(ask(tokens[0]).status, 429);
    const api::Response other = ask(tokens[1]);
    EXPECT_EQ(other.status, 200) << "another owner behind the same address";
    EXPECT_EQ(header(other, "RateLimit").substr(0, 12), "\"work\";r=3;t");
    // What needs no job is free for everybody.
    EXPECT_EQ(ask(tokens[0]).status, 429);
    EXPECT_EQ(harness.ask("/v1/species").status, 200);
}

TEST(RequestHandler, ChargesForReadingABodyThatIsRefused) {
    RequestHandlerOptions options;
    options.budget = {.rate = 1, .burst = 3000};
    Harness harness(options);
    std::string body = "{\"model\":[0";
    while (body.size() < 250'000) body += ",0";
    body += "]}";
    EXPECT_EQ(harness.post("/v1/mushrooms.glb", body).status, 400);
    EXPECT_EQ(harness.post("/v1/mushrooms.glb", body).status, 429)
        << "the level is negative, so the body is not read";
    EXPECT_EQ(harness.ask(small + "1").status, 429);
    EXPECT_EQ(harness.ask("/v1/species").status, 200);

    // Reading and the job are charged together; otherwise a job larger than the bucket would never
    // find it full.
    options.budget = {.rate = 1'000'000'000, .burst = 1};
    Harness fast(options);
    const std::string mix = "{\"mix\":{\"amanita_muscaria\":1},\"lod\":3,\"texture_size\":128}";
    EXPECT_EQ(fast.post("/v1/mushrooms.glb", mix).status, 200);
    options.budget = {.rate = 1, .burst = 1};
    Harness once(options);
    EXPECT_EQ(once.post("/v1/mushrooms.glb", mix).status, 200) << "from a full bucket";
    EXPECT_EQ(once.ask(small + "2").status, 429);
}

TEST(RequestHandler, ComputesCorrespondencesOnThePoolAndChargesThem) {
    const std::string mix = "/v1/mushrooms/amanita_muscaria:0.5,boletus_edulis:0.5.glb?lod=3";
    const std::string image =
        "/v1/mushrooms/amanita_muscaria:0.5,russula_vinosa:0.5/normal.jpg?side=64";
    Harness alone, harness;
    alone.ask(mix, "HEAD");
    alone.ask(image);
    {
        std::vector<std::jthread> threads;
        for (int i = 0; i < 32; ++i)
            threads.emplace_back([&, i] {
                const bool body = i % 2 == 1;
                const api::Response response =
                    harness.ask(body ? image : mix, body ? "GET" : "HEAD");
                EXPECT_EQ(response.status, 200);
                EXPECT_EQ(size_of(response.body) > 0, body);
            });
    }
    EXPECT_EQ(harness.service->counters().morph_misses, alone.service->counters().morph_misses)
        << "each computed once";
    EXPECT_EQ(harness.service->counters().painted, 1u);
    EXPECT_EQ(harness.ask(mix, "HEAD").status, 200);
    EXPECT_EQ(harness.ask(mix + "&v=old").status, 410);

    RequestHandlerOptions options;
    options.budget = {.rate = 1, .burst = 1};
    Harness charged(options);
    EXPECT_EQ(charged.ask(mix, "HEAD").status, 200) << "the first job may be of any size";
    EXPECT_EQ(charged.ask(mix, "HEAD").status, 200) << "cached";
    EXPECT_EQ(charged.ask(image).status, 429);

    options = {};
    options.longest_queue = 0;
    options.most_waiters = 0;
    Harness full(options);
    EXPECT_EQ(full.ask(mix, "HEAD").status, 503);
    Harness slow;
    std::vector<std::jthread> clients = start_waiting_requests(slow, 30);
    EXPECT_EQ(slow.ask(mix, "HEAD", 0ms).status, 504);
    EXPECT_EQ(slow.ask(mix, "HEAD", 0ms, PendingRequest::CancelReason::disconnected).status,
              client_left);
    clients.clear();
    EXPECT_EQ(slow.service->counters().morph_misses, 1u) << "only that of the waiting requests";
}

TEST(RequestHandler, BoundsTheFreshnessOfSignedUrls) {
    const auto signatures =
        std::make_shared<const Signatures>(std::vector<SigningKey>{{"a", std::string(32, 's')}});
    Harness harness({}, signatures);
    const auto max_age = [&](const std::string& target, std::int64_t seconds,
                             const std::string& method, std::vector<api::Header> headers = {}) {
        const std::string url =
            signatures->signed_target("GET", target, "", seconds_since_1970() + seconds);
        const api::Response response =
            harness.ask(url, method, 5min, PendingRequest::CancelReason::timed_out, headers);
        EXPECT_EQ(response.status, headers.empty() ? 200 : 304);
        EXPECT_FALSE(response.cacheable);
        const std::string given = header(response, "Cache-Control");
        const std::string begin = "public, max-age=", end = ", must-revalidate";
        EXPECT_TRUE(given.starts_with(begin) && given.ends_with(end)) << given;
        return std::stoll(given.substr(begin.size()));
    };
    const std::string image = "/v1/mushrooms/amanita_muscaria/orm.jpg?side=64&seed=";
    int seed = 0;
    for (const std::string& target : {small, image}) {
        for (const char* method : {"HEAD", "GET", "GET", "HEAD"})  // generated, then cached
            EXPECT_LE(max_age(target + std::to_string(seed), 100, method), 100);
        const auto left =
            max_age(target + std::to_string(seed), 100, "GET", {{"If-None-Match", "*"}});
        EXPECT_LE(left, 100);
        EXPECT_GT(left, 50);
        EXPECT_EQ(max_age(target + std::to_string(seed), 100'000, "GET"), 3600);
        ++seed;
    }
    // With `v` the freshness would be a year.
    const std::string versioned = small + "1&v=" + [&] {
        Harness open;
        const std::string where = header(open.ask(small + "1", "HEAD"), "Content-Location");
        return where.substr(where.find("v=") + 2);
    }();
    EXPECT_LE(max_age(versioned, 7200, "GET"), 7200);
    EXPECT_GT(max_age(versioned, 7200, "GET"), 3600);
    EXPECT_EQ(header(harness.ask(signatures->signed_target("GET", versioned, "", std::nullopt)),
                     "Cache-Control"),
              "public, max-age=31536000, immutable")
        << "this URL does not expire";
}

TEST(RequestHandler, ReportsTheRemainingBudget) {
    RequestHandlerOptions options;
    options.budget = {.rate = 1000,
                      .burst = 4'000'000};  // four seconds, filled by a millisecond per second
    Harness harness(options);
    const std::string policy = "\"work\";q=4000;w=4000";
    const auto left = [&](const api::Response& response) {
        EXPECT_EQ(header(response, "RateLimit-Policy"), policy);
        EXPECT_FALSE(response.cacheable);
        const std::string given = header(response, "RateLimit"), begin = "\"work\";r=";
        EXPECT_TRUE(given.starts_with(begin)) << given;
        const std::size_t until = given.find(";t=");
        EXPECT_NE(until, std::string::npos) << given;
        const std::int64_t remaining = std::stoll(given.substr(begin.size())),
                           seconds = std::stoll(given.substr(until + 3));
        EXPECT_GE(seconds, 4000 - remaining - 1) << "until the bucket is full";
        EXPECT_LE(seconds, 4000 - remaining);
        return remaining;
    };
    const std::int64_t first = left(harness.ask(heavy + "1"));
    EXPECT_LT(first, 4000);
    EXPECT_GT(first, 3000);
    EXPECT_LT(left(harness.ask(heavy + "2")), first);
    for (const api::Response& uncharged :
         {harness.ask(heavy + "1"), harness.ask("/v1/species"), harness.ask(heavy + "1&age=7"),
          harness.ask(heavy + "1", "HEAD")}) {
        EXPECT_EQ(header(uncharged, "RateLimit"), "") << uncharged.status;
        EXPECT_EQ(header(uncharged, "RateLimit-Policy"), "");
    }
    EXPECT_TRUE(harness.ask(heavy + "1").cacheable);

    options.budget = {.rate = 1000, .burst = 1000};
    Harness poor(options);
    EXPECT_EQ(header(poor.ask(heavy + "1"), "RateLimit").substr(0, 12), "\"work\";r=0;t")
        << "the level is negative";
    const api::Response refused = poor.ask(heavy + "2");
    EXPECT_EQ(refused.status, 429);
    EXPECT_EQ(header(refused, "RateLimit-Policy"), "\"work\";q=1;w=1");
    EXPECT_TRUE(header(refused, "RateLimit").starts_with("\"work\";r=0;t="));
    Harness unlimited;
    EXPECT_EQ(header(unlimited.ask(heavy + "1"), "RateLimit"), "");
}

TEST(RequestHandler, RefusesWithProblemJson) {
    Harness harness;
    api::Request request;
    request.id = "abc";
    for (const int status : {400, 408, 411, 413, 414, 415, 429, 431, 501, 503}) {
        const api::Response response = harness.handlers.refuse(request, status, "why");
        EXPECT_EQ(response.status, status);
        EXPECT_EQ(header(response, "Content-Type"), "application/problem+json");
        EXPECT_EQ(header(response, "Retry-After"), status == 429 || status == 503 ? "1" : "");
        EXPECT_NE(text_of(response).find("\"abc\""), std::string::npos);
        EXPECT_EQ(text_of(response).find("nternal error"), std::string::npos);
    }
}

}  // namespace
}  // namespace sporeprint::server::request_handler_test
