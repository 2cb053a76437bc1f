#include "server/http/transport.h"

#include <fcntl.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <semaphore>
#include <stdexcept>
#include <thread>

#include "server/http/deadlines.h"
#include "tests/server/raw_client.h"

namespace sporeprint::server::http_transport_test {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

api::Response text_response(const std::string& text, int status = 200) {
    api::Response response;
    response.status = status;
    response.headers = {{"Content-Type", "text/plain"}};
    response.body = {slice_of(text)};
    return response;
}

using IsDisconnected = std::function<bool()>;

/// A transport on a free port whose responses the test supplies.
struct Fixture {
    explicit Fixture(
        std::function<api::Response(const api::Request&, const IsDisconnected&)> response,
        TransportOptions options = without_timeouts())
        : Fixture(
              [response = std::move(response)](const std::shared_ptr<PendingRequest>& pending) {
                  pending->reply(
                      response(pending->request(), [&] { return pending->is_disconnected(); }));
              },
              options) {}

    Fixture(std::function<void(const std::shared_ptr<PendingRequest>&)> response,
            TransportOptions options) {
        options.port = 0;
        Handlers handlers;
        handlers.respond = std::move(response);
        handlers.route = [](const api::Request& request) {
            auto routed = std::make_shared<api::RoutedRequest>();
            routed->match.pattern = request.method == "GET" ? "some GET" : "some other";
            routed->most_body = request.target == "/large" ? std::size_t{64} << 20 : 1000;
            return routed;
        };
        handlers.refuse = [](const api::Request&, int status, std::string_view detail) {
            api::Response refusal = text_response(std::string(detail), status);
            refusal.headers[0].second = "application/problem+json";
            return refusal;
        };
        handlers.served = [this](const Served& one) {
            const std::lock_guard lock(mutex);
            served.push_back(one);
            changed.notify_all();
        };
        transport.emplace(options, std::move(handlers));
        transport->start();
    }
    ~Fixture() { transport.reset(); }

    /// For tests without deadlines: long enough for any busy machine.
    static TransportOptions without_timeouts() {
        TransportOptions options;
        options.idle = options.silence = options.head = options.body = options.blocked_write = 60s;
        return options;
    }

    /// For tests of deadlines.
    static TransportOptions short_timeouts() {
        TransportOptions options;
        options.idle = 400ms;
        options.silence = 300ms;
        options.head = 900ms;
        options.body = 900ms;
        options.blocked_write = 400ms;
        return options;
    }

    int port() const { return transport->port(); }

    Served wait_for_served(std::size_t count = 1) {
        std::unique_lock lock(mutex);
        changed.wait_for(lock, 20s, [&] { return served.size() >= count; });
        return served.size() >= count ? served[count - 1] : Served{};
    }

    std::mutex mutex;
    std::condition_variable changed;
    std::vector<Served> served;
    std::optional<Transport> transport;
};

api::Response echo(const api::Request& request, const IsDisconnected&) {
    std::string text = request.method + ' ' + request.target + '\n';
    for (const auto& [name, value] : request.headers) text += name + '=' + value + '\n';
    return text_response(text + '[' + request.body + ']');
}

TEST(Transport, ServesSeveralRequestsOnOneConnection) {
    Fixture server(echo);
    RawClient client(server.port());
    for (int i = 0; i < 3; ++i) {
        const auto response = client.ask("GET /a?b=%20 HTTP/1.1\r\nHost: here\r\n\r\n");
        EXPECT_EQ(response.status, 200);
        EXPECT_EQ(response.body, "GET /a?b=%20\nHost=here\n[]");
        EXPECT_EQ(response.header("Content-Length"), std::to_string(response.body.size()));
        EXPECT_EQ(response.header("Connection"), "");
        EXPECT_TRUE(response.header("Date").ends_with(" GMT")) << response.head;
        EXPECT_EQ(response.header("Date").size(), 29u);
        EXPECT_EQ(response.count("Accept-Ranges"), 0u);
    }
    const Served served = server.wait_for_served(3);
    EXPECT_EQ(served.status, 200);
    EXPECT_EQ(served.target, "/a?b=%20");
    EXPECT_EQ(served.peer, "127.0.0.1");
    EXPECT_GT(served.bytes, 100u);
    EXPECT_TRUE(served.complete);
    EXPECT_EQ(served.id.size(), 16u);
    EXPECT_EQ(served.label, "some GET");
}

TEST(Transport, ServesPipelinedRequestsInOrder) {
    Fixture server(echo);
    RawClient client(server.port());
    client.send(
        "POST /1 HTTP/1.1\r\nContent-Length: 3\r\n\r\nabcGET /2 HTTP/1.1\r\n\r\nGET /3 HTTP/1.1");
    EXPECT_EQ(client.receive().body, "POST /1\nContent-Length=3\n[abc]");
    EXPECT_EQ(client.receive().body, "GET /2\n[]");
    client.send("\r\n\r\n");
    EXPECT_EQ(client.receive().body, "GET /3\n[]");
}

TEST(Transport, SendsAllSlices) {
    std::string large(3 << 20, 'x');
    for (std::size_t i = 0; i < large.size(); ++i) large[i] = static_cast<char>(i * 31 >> 3);
    const Slice whole = slice_of(large);
    Fixture server([&](const api::Request&, const IsDisconnected&) {
        api::Response response = text_response("head,");
        response.body.push_back(whole);
        response.body.push_back(Slice());
        response.body.push_back(Slice(whole.owner, 1000, 5));
        return response;
    });
    RawClient client(server.port());
    const std::string expected = "head," + large + large.substr(1000, 5);
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(client.ask("GET / HTTP/1.1\r\n\r\n").body == expected);
}

TEST(Transport, SendsHeadWithLengthButWithoutBody) {
    Fixture server([](const api::Request& request, const IsDisconnected&) {
        api::Response response = text_response("12345");
        response.has_body = request.target == "/known";
        return response;
    });
    RawClient client(server.port());
    const auto known = client.ask("HEAD /known HTTP/1.1\r\n\r\n", true);
    EXPECT_EQ(known.status, 200);
    EXPECT_EQ(known.header("Content-Length"), "5");
    EXPECT_EQ(known.count("Accept-Ranges"), 0u);
    const auto unknown = client.ask("HEAD /unknown HTTP/1.1\r\n\r\n", true);
    EXPECT_EQ(unknown.status, 200);
    EXPECT_EQ(unknown.count("Content-Length"), 0u);
    EXPECT_EQ(client.ask("GET /known HTTP/1.1\r\n\r\n").body, "12345")
        << "no stray bytes in between";
}

TEST(Transport, SendsNotModifiedWithoutLengthOrBody) {
    Fixture server([](const api::Request&, const IsDisconnected&) {
        api::Response response;
        response.status = 304;
        response.headers = {{"ETag", "\"a\""}};
        response.has_body = false;
        return response;
    });
    RawClient client(server.port());
    for (int i = 0; i < 2; ++i) {
        const auto response = client.ask("GET / HTTP/1.1\r\n\r\n");
        EXPECT_EQ(response.status, 304);
        EXPECT_EQ(response.header("ETag"), "\"a\"");
        EXPECT_EQ(response.count("Content-Length"), 0u);
        EXPECT_EQ(response.count("Content-Type"), 0u);
    }
}

TEST(Transport, SendsNoDuplicateOrMalformedHeaders) {
    Fixture server([](const api::Request&, const IsDisconnected&) {
        api::Response response = text_response("x");
        response.headers.insert(response.headers.end(), {{"content-length", "99"},
                                                         {"Date", "never"},
                                                         {"Vary", "A"},
                                                         {"vary", "B"},
                                                         {"X-One", "1"},
                                                         {"x-one", "2"},
                                                         {"X-Split", "a\r\nX-Evil: 1"},
                                                         {"X-Bad\r\nX-Evil", "1"},
                                                         {"Accept-Ranges", "none"}});
        return response;
    });
    RawClient client(server.port());
    const auto response = client.ask("GET / HTTP/1.1\r\n\r\n");
    EXPECT_EQ(response.body, "x");
    EXPECT_EQ(response.count("Content-Length") + response.count("content-length"), 1u);
    EXPECT_EQ(response.header("Vary") + response.header("vary"), "A, B");
    EXPECT_EQ(response.count("X-One") + response.count("x-one"), 1u);
    EXPECT_EQ(response.head.find("Evil"), std::string::npos);
    EXPECT_NE(response.header("Date"), "never");
}

TEST(Transport, IgnoresRanges) {
    Fixture server(
        [](const api::Request&, const IsDisconnected&) { return text_response("0123456789"); });
    RawClient client(server.port());
    std::string many = "0-0";
    for (int i = 0; i < 3000; ++i) many += ",0-";
    for (const std::string& range : {std::string("bytes=0-3000000"), std::string("bytes=2-3"),
                                     std::string("bytes=-99999999999999999999"), "bytes=" + many}) {
        const auto response = client.ask("GET / HTTP/1.1\r\nRange: " + range + "\r\n\r\n");
        EXPECT_EQ(response.status, 200);
        EXPECT_EQ(response.body, "0123456789");
        EXPECT_EQ(response.count("Content-Range"), 0u);
    }
}

TEST(Transport, NeverCompressesByItself) {
    const std::string text(100'000, 'a');
    Fixture server([&](const api::Request&, const IsDisconnected&) { return text_response(text); });
    RawClient client(server.port());
    const auto response = client.ask("GET / HTTP/1.1\r\nAccept-Encoding: br, gzip\r\n\r\n");
    EXPECT_EQ(response.count("Content-Encoding"), 0u);
    EXPECT_EQ(response.body, text);
}

TEST(Transport, PassesHeadersUndecoded) {
    Fixture server(echo);
    RawClient client(server.port());
    EXPECT_EQ(client.ask("GET / HTTP/1.1\r\nX-A: %0d%0aB\r\nRemote_Addr: evil\r\n\r\n").body,
              "GET /\nX-A=%0d%0aB\nRemote_Addr=evil\n[]");
}

TEST(Transport, RefusesBeforeRoutingWithAProblem) {
    Fixture server(echo);
    const std::vector<std::pair<std::string, int>> cases = {
        {"GET / HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\n", 411},
        {"POST / HTTP/1.1\r\nContent-Length: 1\r\nTransfer-Encoding: chunked\r\n\r\n", 411},
        {"POST / HTTP/1.1\r\nContent-Length: 1\r\nContent-Length: 2\r\n\r\n", 400},
        {"POST / HTTP/1.1\r\nContent-Encoding: gzip\r\nContent-Length: 1\r\n\r\nx", 415},
        {"GET /" + std::string(5000, 'a') + " HTTP/1.1\r\n\r\n", 414},
        {"GET / HTTP/1.1\r\nA: " + std::string(20000, 'a') + "\r\n\r\n", 431},
        {"GET / HTTP/1.1\n\n", 400},
        {"\x16\x03\x01\x02\r\n\r\n", 400},
        {"POST / HTTP/1.1\r\nContent-Length: 1001\r\n\r\n", 413},
        {"POST /large HTTP/1.1\r\nContent-Length: 99999999999\r\n\r\n", 413}};
    std::size_t count = 0;
    for (const auto& [request, status] : cases) {
        RawClient client(server.port());
        const auto response = client.ask(request);
        EXPECT_EQ(response.status, status) << request.substr(0, 80);
        EXPECT_EQ(response.header("Content-Type"), "application/problem+json");
        EXPECT_EQ(response.header("Connection"), "close");
        EXPECT_FALSE(response.body.empty());
        EXPECT_EQ(server.wait_for_served(++count).status, status);
    }
}

TEST(Transport, PassesAnyMethodAndKeepsTheConnection) {
    Fixture server(echo);
    RawClient client(server.port());
    for (const char* method : {"PROPFIND", "BREW", "TRACE", "DELETE", "get", "M-SEARCH", "QUERY"}) {
        const auto response = client.ask(std::string(method) + " /a HTTP/1.1\r\n\r\n");
        EXPECT_EQ(response.status, 200) << method;
        EXPECT_EQ(response.body, std::string(method) + " /a\n[]");
    }
    EXPECT_EQ(client.ask("PUT /a HTTP/1.1\r\nContent-Length: 2\r\n\r\nok").body,
              "PUT /a\nContent-Length=2\n[ok]");
}

TEST(Transport, DeliversTheRefusalOfALargeBody) {
    Fixture server(echo);
    RawClient client(server.port());
    const std::string body(5 << 20, 'x');
    client.send("POST / HTTP/1.1\r\nContent-Length: " + std::to_string(body.size()) + "\r\n\r\n");
    client.send(body);
    EXPECT_EQ(client.receive().status, 413);
}

TEST(Transport, ReceivesBodies) {
    Fixture server(echo);
    RawClient client(server.port());
    EXPECT_EQ(
        client
            .ask(
                "GET /a HTTP/1.1\r\nContent-Length: 30\r\n\r\nGET /evil HTTP/1.1\r\nX: y\r\n\r\n--")
            .body,
        "GET /a\nContent-Length=30\n[GET /evil HTTP/1.1\r\nX: y\r\n\r\n--]")
        << "the body of a GET is not the next request";
    EXPECT_EQ(client.ask("POST /b HTTP/1.1\r\n\r\n").body, "POST /b\n[]") << "no length, no body";

    const std::string large(2 << 20, 'y');
    client.send("POST /large HTTP/1.1\r\nExpect: 100-continue\r\nContent-Length: " +
                std::to_string(large.size()) + "\r\n\r\n");
    EXPECT_EQ(client.receive().status, 100);
    client.send(large);
    EXPECT_TRUE(client.receive().body.ends_with('[' + large + ']'));
    EXPECT_EQ(client.ask("POST /b HTTP/1.1\r\nExpect: 100-continue\r\nContent-Length: 2000\r\n\r\n")
                  .status,
              413)
        << "no 100 before a refusal";
}

TEST(Transport, SendsTheFinalStatusInsteadOf100Continue) {
    TransportOptions options = Fixture::without_timeouts();
    options.port = 0;
    std::atomic<int> routed{0};
    Handlers handlers;
    handlers.respond = [](const std::shared_ptr<PendingRequest>& pending) {
        pending->reply(text_response(pending->request().body));
    };
    handlers.refuse = [](const api::Request&, int status, std::string_view) {
        return text_response("", status);
    };
    handlers.served = [](const Served&) {};
    handlers.route = [&](const api::Request& request) {
        if (request.target == "/throws") throw std::runtime_error("secret");
        ++routed;
        EXPECT_EQ(request.header("A"), "b");
        auto found = std::make_shared<api::RoutedRequest>();
        found->most_body = 1000;
        if (request.target == "/bad") found->response = text_response("no", 404);
        return found;
    };
    Transport transport(options, handlers);
    transport.start();
    const std::string rest =
        " HTTP/1.1\r\nA: b\r\nExpect: 100-continue\r\nContent-Length: 2\r\n\r\n";
    RawClient good(transport.port());
    EXPECT_EQ(good.ask("POST /good" + rest).status, 100);
    EXPECT_EQ(good.ask("ab").body, "ab");
    RawClient thrown(transport.port());
    EXPECT_EQ(thrown.ask("POST /throws" + rest).status, 413) << "no route accepts this body";
    RawClient bad(transport.port());
    const auto response = bad.ask("POST /bad" + rest);
    EXPECT_EQ(response.status, 404);
    EXPECT_EQ(response.body, "no");
    EXPECT_EQ(response.header("Connection"), "close");
    EXPECT_TRUE(bad.is_closed()) << "further bytes are ambiguous: body or next request";
    RawClient head(transport.port());
    EXPECT_EQ(head.ask("HEAD /bad" + rest, true).status, 404);
    EXPECT_TRUE(head.is_closed()) << "and no body was sent";
    EXPECT_EQ(routed, 3);
    RawClient plain(transport.port());
    EXPECT_EQ(plain.ask("POST /bad HTTP/1.1\r\nA: b\r\nContent-Length: 2\r\n\r\nab").body, "ab");
    EXPECT_EQ(plain.ask("POST /bad HTTP/1.1\r\nA: b\r\nExpect: 100-continue\r\n\r\n").body, "")
        << "there is no body to wait for";
    EXPECT_EQ(routed, 5) << "the route of each request is found once";
}

constexpr std::size_t megabyte = 1 << 20;

std::string head_of_upload(std::size_t length, const std::string& more = {}) {
    return "POST /large HTTP/1.1\r\n" + more + "Content-Length: " + std::to_string(length) +
           "\r\n\r\n";
}

std::size_t in_phase(const Transport::Load& load, Transport::Phase phase) {
    return load.connections[static_cast<std::size_t>(phase)];
}

/// Waits until this many bytes of request bodies have arrived in total.
void expect_body_bytes(const Fixture& server, std::size_t bytes) {
    const auto load = [&] { return server.transport->load(); };
    for (int i = 0; i < 2000 && load().body_bytes != bytes; ++i) std::this_thread::sleep_for(5ms);
    EXPECT_EQ(load().body_bytes, bytes);
}

std::size_t length_of_body(const RawClient::Response& response) {
    return response.body.size() - response.body.find('[') - 2;
}

TEST(Transport, CountsReceivedBytesOfBodiesNotAnnouncedOnes) {
    TransportOptions options = Fixture::without_timeouts();
    options.most_body_memory = options.most_body_of_client = 4 * megabyte;
    Fixture server(echo, options);
    std::vector<std::unique_ptr<RawClient>> slow;
    for (int i = 0; i < 8; ++i) {
        slow.push_back(std::make_unique<RawClient>(server.port()));
        // 100 Continue reserves no memory either.
        EXPECT_EQ(slow.back()->ask(head_of_upload(4 * megabyte, "Expect: 100-continue\r\n")).status,
                  100);
        slow.back()->send(std::string(1000, 'x'));
    }
    expect_body_bytes(server, 8000);
    RawClient other(server.port(), 0, "127.0.0.2");
    other.send(head_of_upload(2 * megabyte));
    other.send(std::string(2 * megabyte, 'y'));
    const auto response = other.receive();
    EXPECT_EQ(response.status, 200);
    EXPECT_EQ(length_of_body(response), 2 * megabyte);
    expect_body_bytes(server, 8000);
    slow[0]->reset();
    expect_body_bytes(server, 7000);
    slow.clear();
    expect_body_bytes(server, 0);
    EXPECT_EQ(server.transport->load().aborted_uploads, 0u);
}

TEST(Transport, AbortsTheSlowestOfTheLargestUploadsWhenMemoryIsFull) {
    TransportOptions options = Fixture::without_timeouts();
    options.most_body_memory = 4 * megabyte;
    options.most_body_of_client = 2 * megabyte;
    Fixture server(echo, options);
    RawClient slow(server.port(), 0, "127.0.0.2"), quicker(server.port(), 0, "127.0.0.3"),
        small(server.port(), 0, "127.0.0.4"), other(server.port(), 0, "127.0.0.5");
    const std::size_t part = 1'900'000;
    slow.send(head_of_upload(2 * megabyte) + std::string(part, 'a'));
    small.send(head_of_upload(1000) + "a");
    expect_body_bytes(server, part + 1);
    std::this_thread::sleep_for(200ms);
    quicker.send(head_of_upload(2 * megabyte) + std::string(part, 'b'));
    expect_body_bytes(server, 2 * part + 1);
    other.send(head_of_upload(megabyte) + std::string(megabyte, 'c'));
    EXPECT_EQ(length_of_body(other.receive()), megabyte);
    const auto refusal = slow.receive();
    EXPECT_EQ(refusal.status, 503);
    EXPECT_EQ(refusal.header("Connection"), "close");
    expect_body_bytes(server, part + 1);
    EXPECT_EQ(server.transport->load().aborted_uploads, 1u);
    quicker.send(std::string(2 * megabyte - part, 'b'));
    EXPECT_EQ(length_of_body(quicker.receive()), 2 * megabyte);
    small.send(std::string(999, 'a'));
    EXPECT_EQ(length_of_body(small.receive()), 1000u);
    expect_body_bytes(server, 0);
}

TEST(Transport, LimitsTheBodyMemoryOfEachClient) {
    TransportOptions options = Fixture::without_timeouts();
    options.most_body_of_client = megabyte;
    options.proxies.trusted = Networks("127.0.0.9");
    Fixture server(echo, options);
    RawClient first(server.port()), second(server.port()), third(server.port());
    EXPECT_EQ(third.ask(head_of_upload(megabyte + 1)).status, 413)
        << "larger than the limit per client";
    const std::size_t part = 700'000;
    first.send(head_of_upload(megabyte) + std::string(part, 'a'));
    expect_body_bytes(server, part);
    std::this_thread::sleep_for(50ms);
    second.send(head_of_upload(megabyte) + std::string(part, 'b'));
    EXPECT_EQ(first.receive().status, 503);
    expect_body_bytes(server, part);
    second.send(std::string(megabyte - part, 'b'));
    EXPECT_EQ(length_of_body(second.receive()), megabyte);
    EXPECT_EQ(server.transport->load().aborted_uploads, 1u);

    // Clients behind a trusted proxy have a limit each; the proxy itself has none.
    const std::vector<std::string> behind = {"X-Forwarded-For: 192.0.2.1\r\n",
                                             "X-Forwarded-For: 192.0.2.2\r\n", "", ""};
    std::vector<std::unique_ptr<RawClient>> proxy;
    for (const std::string& header : behind) {
        proxy.push_back(std::make_unique<RawClient>(server.port(), 0, "127.0.0.9"));
        proxy.back()->send(head_of_upload(megabyte, header) + std::string(part, 'p'));
    }
    expect_body_bytes(server, 4 * part);
    RawClient same(server.port(), 0, "127.0.0.9");
    same.send(head_of_upload(megabyte, behind[1]) + std::string(part, 'p'));
    EXPECT_EQ(proxy[1]->receive().status, 503) << "the same client on another connection";
    expect_body_bytes(server, 4 * part);
    proxy[1] = nullptr;
    for (const auto& one : proxy)
        if (one) one->send(std::string(megabyte - part, 'p'));
    for (const auto& one : proxy)
        if (one) {
            EXPECT_EQ(length_of_body(one->receive()), megabyte);
        }
    EXPECT_EQ(server.transport->load().aborted_uploads, 2u);
    same.close();
    expect_body_bytes(server, 0);
}

TEST(Transport, AbortsUploadsBelowTheMinimumRateEarly) {
    TransportOptions options = Fixture::without_timeouts();
    options.body = 1s;
    options.body_rate = megabyte;
    Fixture server(echo, options);
    const std::size_t length = 16 * megabyte;  // 17 s
    const auto since = [begun = Clock::now()] { return Clock::now() - begun; };
    RawClient dripping(server.port()), half(server.port()), small(server.port());
    dripping.send(head_of_upload(length));
    half.send(head_of_upload(4 * megabyte) + std::string(2 * megabyte, 'h'));  // 5 s
    small.send(head_of_upload(10));
    for (int i = 0; i < 10; ++i) {
        dripping.send(std::string(2000, 'd'));
        small.send("s");
        std::this_thread::sleep_for(10ms);
    }
    const auto receiving = [&] {
        return in_phase(server.transport->load(), Transport::Phase::body);
    };
    for (int i = 0; i < 1000 && receiving() > 1 && dripping.send(std::string(2000, 'd')); ++i)
        std::this_thread::sleep_for(10ms);
    EXPECT_EQ(dripping.receive().status, 408);
    EXPECT_LT(since(), 8s) << "a second on a quiet machine";
    EXPECT_EQ(small.receive().status, 200) << "small bodies have the fixed time";
    EXPECT_EQ(half.receive().status, 408);
    EXPECT_GT(since(), 2s) << "half of the body is allowed half of the time";
    expect_body_bytes(server, 0);
    RawClient short_timeouts(server.port());
    short_timeouts.send(head_of_upload(length));
    short_timeouts.send(std::string(length, 'q'));
    EXPECT_EQ(length_of_body(short_timeouts.receive()), length);
}

TEST(Transport, ClosesSilentAndDrippingConnections) {
    Fixture server(echo, Fixture::short_timeouts());
    RawClient silent(server.port()), half(server.port()), bodiless(server.port());
    half.send("GET / HT");
    bodiless.send("POST / HTTP/1.1\r\nContent-Length: 10\r\n\r\nabc");
    EXPECT_TRUE(silent.is_closed()) << "without a response, as there was no request";
    EXPECT_EQ(half.receive().status, 408);
    EXPECT_EQ(bodiless.receive().status, 408);
    RawClient dripping(server.port());
    for (int i = 0; i < 60 && dripping.send("G"); ++i) std::this_thread::sleep_for(50ms);
    EXPECT_EQ(dripping.receive().status, 408) << "each byte was in time, but not the whole head";
}

TEST(Transport, ClosesConnectionsWhoseClientDoesNotRead) {
    const Slice large = slice_of(std::string(64 << 20, 'z'));
    Fixture server(
        [&](const api::Request&, const IsDisconnected&) {
            api::Response response = text_response("");
            response.body = {large};
            return response;
        },
        Fixture::short_timeouts());
    RawClient client(server.port(), 4096);
    client.send("GET / HTTP/1.1\r\n\r\n");
    const Served served = server.wait_for_served();
    EXPECT_FALSE(served.complete);
    EXPECT_LT(served.bytes, 64u << 20);
}

TEST(Transport, SurvivesHandlersThatThrow) {
    TransportOptions options = Fixture::without_timeouts();
    options.port = 0;
    Handlers handlers;
    handlers.respond = [](const std::shared_ptr<PendingRequest>& pending) {
        const std::string& target = pending->request().target;
        if (target == "/forgotten") return;
        if (target == "/odd") throw 42;
        if (target == "/later")
            pending->resume([] { throw std::runtime_error("secret later"); });
        else
            throw std::runtime_error("secret detail");
    };
    handlers.route = [](const api::Request& request) {
        if (request.method == "POST") throw std::runtime_error("secret route");
        return std::make_shared<const api::RoutedRequest>();
    };
    handlers.refuse = [](const api::Request&, int, std::string_view) -> api::Response {
        throw std::runtime_error("secret too");
    };
    handlers.served = [](const Served&) { throw std::runtime_error("and this"); };
    Transport transport(options, handlers);
    transport.start();
    RawClient client(transport.port());
    for (const char* target : {"/", "/odd", "/later", "/forgotten"}) {
        const auto response = client.ask("GET " + std::string(target) + " HTTP/1.1\r\n\r\n");
        EXPECT_EQ(response.status, 500);
        EXPECT_EQ(response.head.find("secret"), std::string::npos);
    }
    EXPECT_EQ(client.ask("POST / HTTP/1.1\r\nContent-Length: 1\r\n\r\nx").status, 413);
}

TEST(Transport, ReportsToHandlersThatTheClientHasDisconnected) {
    std::binary_semaphore begun(0);
    std::atomic<bool> noticed{false};
    Fixture server([&](const api::Request&, const IsDisconnected& is_disconnected) {
        EXPECT_FALSE(is_disconnected());
        begun.release();
        for (int i = 0; i < 2000 && !is_disconnected(); ++i) std::this_thread::sleep_for(5ms);
        noticed = is_disconnected();
        return text_response("", client_left);
    });
    {
        RawClient client(server.port());
        client.send("GET / HTTP/1.1\r\n\r\nGET /pipelined");
        begun.acquire();
    }
    const Served served = server.wait_for_served();
    EXPECT_TRUE(noticed);
    EXPECT_EQ(served.status, client_left);
    EXPECT_EQ(served.bytes, 0u);
}

TEST(Transport, AcceptsValidRequestIds) {
    Fixture server([](const api::Request& request, const IsDisconnected&) {
        return text_response(request.id);
    });
    RawClient client(server.port());
    EXPECT_EQ(client.ask("GET / HTTP/1.1\r\nx-request-id: Abc_1-2\r\n\r\n").body, "Abc_1-2");
    const std::string first = client.ask("GET / HTTP/1.1\r\nX-Request-Id: a b\r\n\r\n").body;
    const std::string second =
        client.ask("GET / HTTP/1.1\r\nX-Request-Id: " + std::string(65, 'a') + "\r\n\r\n").body;
    EXPECT_EQ(first.size(), 16u);
    EXPECT_EQ(second.size(), 16u);
    EXPECT_NE(first, second);
}

TEST(Transport, ClosesAfterTheLastRequestOfAConnection) {
    TransportOptions options = Fixture::without_timeouts();
    options.most_requests = 2;
    Fixture server(echo, options);
    RawClient client(server.port());
    EXPECT_EQ(client.ask("GET / HTTP/1.1\r\n\r\n").header("Connection"), "");
    EXPECT_EQ(client.ask("GET / HTTP/1.1\r\n\r\n").header("Connection"), "close");
    EXPECT_TRUE(client.is_closed());
    RawClient modest(server.port());
    EXPECT_EQ(modest.ask("GET / HTTP/1.1\r\nConnection: Close\r\n\r\n").header("Connection"),
              "close");
    EXPECT_TRUE(modest.is_closed());
    RawClient old(server.port());
    EXPECT_EQ(old.ask("GET / HTTP/1.0\r\n\r\n").status, 200);
    EXPECT_TRUE(old.is_closed());
}

TEST(Transport, RefusesAPortThatIsTaken) {
    Fixture server(echo);
    TransportOptions options;
    options.port = server.port();
    try {
        Transport second(options, {});
        FAIL() << "two servers share a port";
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("port " + std::to_string(server.port())),
                  std::string::npos);
        EXPECT_NE(std::string(error.what()).find("in use"), std::string::npos) << error.what();
    }
    options.host = "no.such.host.invalid";
    EXPECT_THROW(Transport(options, {}), std::runtime_error);
}

TEST(Transport, ClosesTheLongestIdleConnectionForANewOne) {
    TransportOptions options = Fixture::without_timeouts();
    options.most_connections = 4;
    Fixture server(echo, options);
    std::vector<std::unique_ptr<RawClient>> clients;
    for (int i = 0; i < 4; ++i) {
        clients.push_back(std::make_unique<RawClient>(server.port()));
        EXPECT_EQ(clients.back()->ask("GET / HTTP/1.1\r\n\r\n").status, 200);
        std::this_thread::sleep_for(2 * Deadlines::tick);
    }
    RawClient late(server.port());
    EXPECT_EQ(late.ask("GET / HTTP/1.1\r\n\r\n").status, 200);
    EXPECT_TRUE(clients[0]->is_closed()) << "the one idle longest is closed";
    EXPECT_EQ(clients[1]->ask("GET / HTTP/1.1\r\n\r\n").status, 200) << "the others stay open";
    EXPECT_EQ(server.transport->load().refused, 0u);
}

/// A handler that holds requests until the test responds to them.
struct Waiting {
    void operator()(const std::shared_ptr<PendingRequest>& pending) {
        const std::lock_guard lock(mutex);
        pending_requests.push_back(pending);
        changed.notify_all();
    }
    void await(std::size_t count) {
        std::unique_lock lock(mutex);
        EXPECT_TRUE(changed.wait_for(lock, 20s, [&] { return pending_requests.size() >= count; }));
    }
    void respond_to_all(const std::string& text) {
        const std::lock_guard lock(mutex);
        for (const auto& pending : pending_requests) pending->reply(text_response(text));
        pending_requests.clear();
    }
    std::mutex mutex;
    std::condition_variable changed;
    std::vector<std::shared_ptr<PendingRequest>> pending_requests;
};

TEST(Transport, RefusesConnectionsBeyondTheLimit) {
    TransportOptions options = Fixture::without_timeouts();
    options.most_connections = 4;
    options.workers = 1;
    Waiting waiting;
    Fixture server(std::ref(waiting), options);
    std::vector<std::unique_ptr<RawClient>> clients;
    for (std::size_t i = 0; i < 4; ++i) {
        clients.push_back(std::make_unique<RawClient>(server.port()));
        clients.back()->send("GET / HTTP/1.1\r\nConnection: close\r\n\r\n");
    }
    waiting.await(4);  // one worker and four waiting requests: a waiting request occupies no thread
    const auto load = server.transport->load();
    EXPECT_EQ(load.open(), 4u);
    EXPECT_EQ(load.connections[static_cast<std::size_t>(Transport::Phase::busy)], 4u);
    RawClient surplus(server.port());
    surplus.send("GET / HTTP/1.1\r\n\r\n");
    const auto refusal = surplus.receive();
    EXPECT_EQ(refusal.status, 503);
    EXPECT_EQ(refusal.header("Connection"), "close");
    EXPECT_EQ(server.transport->load().refused, 1u);
    waiting.respond_to_all("late");
    for (auto& client : clients) EXPECT_EQ(client->receive().body, "late");
}

TEST(Transport, RefusesRequestsBeyondTheWorkerQueue) {
    TransportOptions options = Fixture::without_timeouts();
    options.workers = 1;
    options.longest_queue = 1;
    std::counting_semaphore<> gate(0), begun(0);
    Fixture server(
        [&](const api::Request&, const IsDisconnected&) {
            begun.release();
            gate.acquire();
            return text_response("late");
        },
        options);
    RawClient first(server.port()), second(server.port());
    first.send("GET / HTTP/1.1\r\n\r\n");
    begun.acquire();
    second.send("GET / HTTP/1.1\r\n\r\n");
    for (int i = 0; i < 2000 && server.transport->load().queue == 0; ++i)
        std::this_thread::sleep_for(5ms);
    RawClient surplus(server.port());
    EXPECT_EQ(surplus.ask("GET / HTTP/1.1\r\n\r\n").status, 503);
    gate.release(2);
    EXPECT_EQ(first.receive().body, "late");
    EXPECT_EQ(second.receive().body, "late");
}

TEST(Transport, CallsBackOnTimeoutAndOnDisconnection) {
    TransportOptions options = Fixture::without_timeouts();
    options.response = 100ms;
    std::atomic<int> late{0}, disconnected{0};
    Fixture server(
        [&](const std::shared_ptr<PendingRequest>& pending) {
            pending->wait([&, pending](PendingRequest::CancelReason reason) {
                ++(reason == PendingRequest::CancelReason::timed_out ? late : disconnected);
                EXPECT_EQ(pending->is_disconnected(),
                          reason == PendingRequest::CancelReason::disconnected);
                pending->reply(text_response(
                    "", reason == PendingRequest::CancelReason::timed_out ? 504 : client_left));
                pending->reply(text_response("only the first response counts"));
            });
        },
        options);
    RawClient patient(server.port());
    EXPECT_EQ(patient.ask("GET /1 HTTP/1.1\r\n\r\n").status, 504);
    EXPECT_EQ(patient.ask("GET /2 HTTP/1.1\r\n\r\n").status, 504) << "the connection stays open";
    EXPECT_EQ(late, 2);
    options.response = 60s;
    Fixture slow(
        [&](const std::shared_ptr<PendingRequest>& pending) {
            pending->wait([&, pending](PendingRequest::CancelReason reason) {
                ++(reason == PendingRequest::CancelReason::timed_out ? late : disconnected);
                pending->reply(text_response("", client_left));
            });
        },
        options);
    { RawClient(slow.port()).send("GET / HTTP/1.1\r\n\r\n"); }
    EXPECT_EQ(slow.wait_for_served().status, client_left);
    EXPECT_EQ(late, 2);
    EXPECT_EQ(disconnected, 1);
}

/// Returns the headers except those that differ per request.
std::vector<std::pair<std::string, std::string>> stable_headers(
    const RawClient::Response& response) {
    std::vector<std::pair<std::string, std::string>> headers = response.headers;
    std::erase_if(headers, [](const auto& header) {
        return header.first == "Date" || header.first == "X-Request-Id";
    });
    std::sort(headers.begin(), headers.end());
    return headers;
}

TEST(Transport, ReusesCacheableResponses) {
    for (const std::size_t size : {std::size_t{0}, std::size_t{1000}, std::size_t{3} << 20}) {
        std::atomic<int> requested{0};
        const std::string text(size, 'x');
        Fixture server([&](const api::Request& request, const IsDisconnected&) {
            ++requested;
            api::Response response = text_response(text);
            response.headers.insert(
                response.headers.end(),
                {{"ETag", "\"tag\""}, {"Cache-Status", "here; hit"}, {"X-Request-Id", request.id}});
            response.cacheable = request.target == "/again";
            if (request.target == "/differs") {
                response.cacheable = true;
                response.headers.emplace_back("Vary", "Cookie");
            }
            return response;
        });
        RawClient client(server.port());
        const auto first = client.ask("GET /again HTTP/1.1\r\n\r\n");
        const auto again = client.ask("GET /again HTTP/1.1\r\nX-Request-Id: mine\r\n\r\n");
        EXPECT_EQ(requested, 1);
        EXPECT_EQ(again.status, 200);
        EXPECT_TRUE(again.body == text);
        EXPECT_EQ(stable_headers(again), stable_headers(first));
        EXPECT_EQ(again.header("X-Request-Id"), "mine");
        EXPECT_EQ(again.header("Date").size(), 29u);

        const auto head = client.ask("HEAD /again HTTP/1.1\r\n\r\n", true);
        EXPECT_EQ(stable_headers(head), stable_headers(first));
        const auto fresh = client.ask("GET /again HTTP/1.1\r\nIf-None-Match: \"tag\"\r\n\r\n");
        EXPECT_EQ(fresh.status, 304);
        EXPECT_EQ(fresh.header("Cache-Status"), "here; hit; detail=not-modified");
        EXPECT_EQ(fresh.header("ETag"), "\"tag\"");
        EXPECT_EQ(fresh.count("Content-Type") + fresh.count("Content-Length"), 0u);
        EXPECT_EQ(client
                      .ask("GET /again HTTP/1.1\r\nIf-None-Match: \"other\"\r\n"
                           "If-None-Match: \"tag\"\r\n\r\n")
                      .status,
                  304)
            << "all lines form one list";
        EXPECT_TRUE(client.ask("GET /again HTTP/1.1\r\nIf-None-Match: \"other\"\r\n\r\n").body ==
                    text);
        EXPECT_EQ(requested, 1);

        client.send(
            "GET /again HTTP/1.1\r\n\r\nGET /again HTTP/1.1\r\n\r\nGET /again HTTP/1.1\r\n\r\n");
        for (int i = 0; i < 3; ++i) EXPECT_TRUE(client.receive().body == text);
        EXPECT_EQ(requested, 1);
        for (const char* header :
             {"Range: bytes=0-0", "If-Match: \"tag\"", "Cache-Control: no-cache"})
            EXPECT_EQ(
                client.ask("GET /again HTTP/1.1\r\n" + std::string(header) + "\r\n\r\n").status,
                200);
        EXPECT_EQ(client.ask("POST /again HTTP/1.1\r\n\r\n").status, 200);
        EXPECT_EQ(requested, 5);
        for (const char* target : {"/differs", "/never", "/differs", "/never"})
            EXPECT_EQ(client.ask("GET " + std::string(target) + " HTTP/1.1\r\n\r\n").status, 200);
        EXPECT_EQ(requested, 9);
        const auto last = client.ask("GET /again HTTP/1.1\r\nConnection: close\r\n\r\n");
        EXPECT_EQ(last.header("Connection"), "close");
        EXPECT_TRUE(last.body == text && last.count("Keep-Alive") == 0);
        EXPECT_TRUE(client.is_closed());
        EXPECT_EQ(requested, 9);

        const auto load = server.transport->load();
        EXPECT_EQ(load.hot_hits, 7u);
        EXPECT_EQ(load.hot_not_modified, 2u);
        EXPECT_EQ(load.hot_entries, 1u);
        const Served served = server.wait_for_served(2);
        EXPECT_EQ(served.id, "mine");
        EXPECT_EQ(served.label, "some GET");
        EXPECT_EQ(served.cache, "here; hit");
        EXPECT_EQ(served.bytes, again.head.size() + 2 + size);
        EXPECT_EQ(server.wait_for_served(4).status, 304);
    }
}

TEST(Transport, ReusesResponsesPerEncoding) {
    std::atomic<int> requested{0};
    Fixture server([&](const api::Request& request, const IsDisconnected&) {
        ++requested;
        const bool gzip = request.header("Accept-Encoding") == "gzip";
        api::Response response = text_response(gzip ? "zipped" : "plain");
        response.cacheable = true;
        response.headers.emplace_back("ETag", gzip ? "\"tag-gz\"" : "\"tag\"");
        response.headers.emplace_back("Vary", "Accept-Encoding");
        if (gzip) response.headers.emplace_back("Content-Encoding", "gzip");
        return response;
    });
    RawClient client(server.port());
    const auto ask = [&](const std::string& headers) {
        return client.ask("GET /a HTTP/1.1\r\n" + headers + "\r\n");
    };
    const std::string gzip = "Accept-Encoding: gzip\r\n";
    for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(ask("").body, "plain");
        EXPECT_EQ(ask(gzip).body, "zipped");
        EXPECT_EQ(ask("Accept-Encoding: br\r\n").header("Content-Encoding"), "");
    }
    EXPECT_EQ(requested, 2) << "one request for each";
    EXPECT_EQ(ask(gzip + "If-None-Match: \"tag-gz\"\r\n").status, 304);
    EXPECT_EQ(ask("If-None-Match: \"tag\"\r\n").status, 304);
    EXPECT_EQ(ask("If-None-Match: \"tag-gz\"\r\n").body, "plain");
    EXPECT_EQ(requested, 2);
    ask(gzip + "If-None-Match: \"tag\"\r\n");
    EXPECT_EQ(requested, 3) << "a client with the identity variant is passed on";
    EXPECT_EQ(server.transport->load().hot_entries, 2u);
}

TEST(Transport, SendsPinnedResponsesWhileAllWorkersAreBusy) {
    TransportOptions options = Fixture::without_timeouts();
    options.workers = 1;
    options.longest_queue = 1;
    std::counting_semaphore<> gate(0), begun(0);
    Handlers handlers;
    handlers.respond = [&](const std::shared_ptr<PendingRequest>& pending) {
        begun.release();
        gate.acquire();
        pending->reply(text_response("late"));
    };
    api::Response alive = text_response("alive");
    alive.cacheable = true;
    handlers.pinned_responses = {{"/livez", alive}};
    handlers.refuse = [](const api::Request&, int status, std::string_view) {
        return text_response("", status);
    };
    handlers.served = [](const Served&) {};
    handlers.route = [](const api::Request&) {
        return std::make_shared<const api::RoutedRequest>();
    };
    options.port = 0;
    Transport transport(options, handlers);
    transport.start();
    RawClient working(transport.port()), waiting(transport.port()), probe(transport.port());
    working.send("GET / HTTP/1.1\r\n\r\n");
    begun.acquire();
    waiting.send("GET / HTTP/1.1\r\n\r\n");
    for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(probe.ask("GET /livez HTTP/1.1\r\n\r\n").body, "alive");
        EXPECT_EQ(probe.ask("HEAD /livez HTTP/1.1\r\n\r\n", true).status, 200);
    }
    gate.release(2);
    EXPECT_EQ(working.receive().body, "late");
    EXPECT_EQ(waiting.receive().body, "late");
}

TEST(Transport, InvalidatesStoredAndPendingResponses) {
    std::atomic<int> requested{0};
    std::counting_semaphore<> gate(0), begun(0);
    Fixture server([&](const api::Request&, const IsDisconnected&) {
        api::Response response = text_response(std::to_string(++requested));
        response.cacheable = true;
        begun.release();
        gate.acquire();
        return response;
    });
    const std::string request = "GET /a HTTP/1.1\r\n\r\n";
    RawClient client(server.port());
    client.send(request);
    begun.acquire();
    server.transport->invalidate();  // the state behind the response has changed
    gate.release();
    EXPECT_EQ(client.receive().body, "1");
    gate.release(10);
    EXPECT_EQ(client.ask(request).body, "2") << "not reused";
    EXPECT_EQ(client.ask(request).body, "2") << "but this one is";
    server.transport->invalidate();
    EXPECT_EQ(client.ask(request).body, "3");
    EXPECT_EQ(client.ask(request).body, "3");
    EXPECT_EQ(server.transport->load().hot_entries, 1u);
}

TEST(Transport, BoundsTheMemoryOfSlowClientsByAbortingTheSlowest) {
    TransportOptions options = Fixture::without_timeouts();
    options.most_pinned = 20 * megabyte;
    const auto common = std::make_shared<const Bytes>(8 * megabyte, std::uint8_t{'c'});
    Fixture server(
        [&](const api::Request& request, const IsDisconnected&) {
            api::Response response;
            response.body = {request.target == "/common" ? Slice(common)
                                                         : Slice(std::make_shared<const Bytes>(
                                                               4 * megabyte, std::uint8_t{'o'}))};
            return response;
        },
        options);
    const auto load = [&] { return server.transport->load(); };
    std::vector<std::unique_ptr<RawClient>> slow;
    const auto add_slow = [&](const std::string& target) {
        slow.push_back(std::make_unique<RawClient>(server.port(), 4096));
        slow.back()->send("GET " + target + " HTTP/1.1\r\n\r\n");
    };
    const auto writing = [&] {
        return load().connections[static_cast<std::size_t>(Transport::Phase::writing)];
    };
    for (int i = 0; i < 20; ++i) add_slow("/common");
    for (int i = 0; i < 2000 && (writing() < 20 || load().pinned == 0); ++i)
        std::this_thread::sleep_for(5ms);
    EXPECT_EQ(load().pinned, 8 * megabyte) << "shared buffers count once";
    EXPECT_EQ(load().aborted_responses, 0u);

    for (int i = 0; i < 12; ++i) add_slow("/own");
    // All have begun to be written, and those that do not fit have been aborted.
    for (int i = 0;
         i < 2000 && (load().aborted_responses < 9 || writing() + load().aborted_responses < 32);
         ++i)
        std::this_thread::sleep_for(5ms);
    EXPECT_GE(load().aborted_responses, 9u) << "three buffers fit beside the shared one";
    EXPECT_LE(load().pinned, options.most_pinned);
    RawClient short_timeouts(server.port());
    for (int i = 0; i < 10; ++i)
        EXPECT_EQ(short_timeouts.ask("GET /own HTTP/1.1\r\n\r\n").body.size(), 4 * megabyte)
            << "a reading client is not aborted";
    // Which of the slow ones make room is a matter of timing: while one that shares a buffer is the
    // slowest, all that share it have to go.
    EXPECT_LE(load().aborted_responses, slow.size());

    slow.clear();
    for (int i = 0; i < 2000 && load().pinned > 0; ++i) std::this_thread::sleep_for(5ms);
    EXPECT_EQ(load().pinned, 0u);
}

TEST(Transport, NeverAbortsASingleSlowClient) {
    TransportOptions options = Fixture::without_timeouts();
    options.most_pinned = 1000;
    Fixture server([&](const api::Request&,
                       const IsDisconnected&) { return text_response(std::string(4 << 20, 'a')); },
                   options);
    RawClient slow(server.port(), 4096);
    slow.send("GET / HTTP/1.1\r\n\r\n");
    for (int i = 0; i < 2000 && server.transport->load().pinned == 0; ++i)
        std::this_thread::sleep_for(5ms);
    EXPECT_EQ(slow.receive().body.size(), 4u << 20);
    EXPECT_EQ(server.transport->load().aborted_responses, 0u);
}

TEST(Transport, CompletesBegunRequestsWhenDraining) {
    std::counting_semaphore<> gate(0), begun(0);
    Fixture server([&](const api::Request&, const IsDisconnected&) {
        begun.release();
        gate.acquire();
        return text_response("done");
    });
    RawClient working(server.port()), idle(server.port());
    working.send("GET / HTTP/1.1\r\n\r\n");
    begun.acquire();
    std::atomic<bool> drained{false};
    std::jthread drain([&] {
        server.transport->drain();
        drained = true;
    });
    EXPECT_TRUE(idle.is_closed());
    EXPECT_FALSE(drained);
    gate.release();
    const auto response = working.receive();
    EXPECT_EQ(response.body, "done");
    EXPECT_EQ(response.header("Connection"), "close");
    drain.join();
    EXPECT_FALSE(RawClient(server.port()).connected());
}

TEST(Transport, ServesManyConcurrentClients) {
    Fixture server(echo);
    std::atomic<int> good{0};
    std::vector<std::jthread> threads;
    for (int thread = 0; thread < 32; ++thread)
        threads.emplace_back([&, thread] {
            for (int round = 0; round < 5; ++round) {
                RawClient client(server.port());
                for (int i = 0; i < 10; ++i) {
                    const std::string target =
                        "/" + std::to_string(thread) + '/' + std::to_string(i);
                    if (client.ask("GET " + target + " HTTP/1.1\r\n\r\n").body ==
                        "GET " + target + "\n[]")
                        ++good;
                }
            }
        });
    threads.clear();
    EXPECT_EQ(good, 32 * 50);
}

}  // namespace
}  // namespace sporeprint::server::http_transport_test
