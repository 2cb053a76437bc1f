// Limits per client of the real program: connections and work, by client address or the address
// reported by a trusted proxy.

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "tests/server/raw_client.h"
#include "tests/server/real_server.h"

namespace sporeprint::server::http_limits_test {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

const std::string generated = "/v1/mushrooms/amanita_muscaria.glb?lod=3&textures=none&seed=";

std::string get(const std::string& target, const std::string& more = {}) {
    return "GET " + target + " HTTP/1.1\r\nHost: x\r\n" + more + "\r\n";
}

void expect_problem(const RawClient::Response& response, int status) {
    EXPECT_EQ(response.status, status);
    EXPECT_EQ(response.header("Content-Type"), "application/problem+json");
    EXPECT_GE(std::atoi(response.header("Retry-After").c_str()), 1);
    EXPECT_EQ(response.header("Retry-After").find_first_not_of("0123456789"), std::string::npos);
}

TEST(Limits, ConnectionsAreCountedPerAddress) {
    const RealServer server(0, {"--client-connections", "4"});
    ASSERT_GT(server.port(), 0);
    std::vector<std::unique_ptr<RawClient>> held;
    for (int i = 0; i < 4; ++i) {
        held.push_back(std::make_unique<RawClient>(server.port()));
        EXPECT_EQ(held.back()->ask(get("/v1")).status, 200);
    }
    for (int i = 0; i < 20; ++i) {
        RawClient fifth(server.port());
        expect_problem(fifth.ask(get(i % 2 == 0 ? "/v1" : "/readyz")), 429);
        EXPECT_TRUE(fifth.is_closed());
    }
    RawClient silent(server.port());
    expect_problem(silent.receive(), 429);
    RawClient probe(server.port());
    EXPECT_EQ(probe.ask(get("/livez")).body, "alive\n")
        << "health checks are served beyond the limit";
    EXPECT_TRUE(probe.is_closed()) << "one request only";
    EXPECT_EQ(RawClient(server.port(), 0, "127.0.0.2").ask(get("/v1")).status, 200);
    EXPECT_EQ(held[0]->ask(get("/v1")).status, 200) << "open connections are not affected";

    held.pop_back();
    int status = 0;
    for (int i = 0; i < 500 && status != 200; ++i) {
        status = RawClient(server.port()).ask(get("/v1")).status;
        if (status != 200) std::this_thread::sleep_for(10ms);
    }
    EXPECT_EQ(status, 200) << "a closed connection no longer counts";
    const std::string metrics = held[0]->ask(get("/metrics")).body;
    EXPECT_NE(metrics.find("\nsporeprint_connections_limited_total "), std::string::npos);
    EXPECT_EQ(metrics.find("\nsporeprint_connections_limited_total 0\n"), std::string::npos);
}

TEST(Limits, AFloodOfOneAddressDoesNotAffectOthers) {
    const RealServer server(0, {"--client-connections", "8"});
    std::vector<std::unique_ptr<RawClient>> flood;
    for (int i = 0; i < 600; ++i) flood.push_back(std::make_unique<RawClient>(server.port()));
    const auto begun = Clock::now();
    RawClient other(server.port(), 0, "127.0.0.3");
    EXPECT_EQ(other.ask(get("/v1")).status, 200);
    EXPECT_LT(Clock::now() - begun, 5s) << "milliseconds on a quiet machine";
    EXPECT_LT(server.open_files(), 8u + 256 + 100) << "few connections of the flood stay open";
    EXPECT_EQ(other.ask(get("/livez")).status, 200);
}

TEST(Limits, WorkPerClientIsBoundedAndCachedResourcesAreFree) {
    // A resource as above costs about half a millisecond of work; the bucket fills slowly.
    const RealServer server(0, {"--client-work", "1", "--client-burst", "20"});
    RawClient greedy(server.port()), other(server.port(), 0, "127.0.0.2");
    const auto begun = Clock::now();
    int granted = 0;
    RawClient::Response refusal;
    for (int i = 0; i < 2000 && refusal.status == 0; ++i) {
        RawClient::Response response = greedy.ask(get(generated + std::to_string(i)));
        if (response.status == 200)
            ++granted;
        else
            refusal = response;
    }
    expect_problem(refusal, 429);
    EXPECT_GE(granted, 5);
    // Each cost at least a tenth of a millisecond.
    const double passed = std::chrono::duration<double, std::milli>(Clock::now() - begun).count();
    EXPECT_LE(granted * 0.1, 20 + passed / 1000 + 1);
    for (int i = 0; i < 50; ++i) {
        EXPECT_EQ(greedy.ask(get(generated + "0")).status, 200) << "cached";
        EXPECT_EQ(greedy.ask(get("/v1/species")).status, 200) << "a document";
        EXPECT_EQ(greedy.ask(get(generated + "0&age=2")).status, 400) << "a refusal";
    }
    const std::string etag = greedy.ask(get(generated + "1")).header("ETag");
    EXPECT_EQ(greedy.ask(get(generated + "1", "If-None-Match: " + etag + "\r\n")).status, 304);
    EXPECT_EQ(other.ask(get(generated + "5000")).status, 200) << "budgets are independent";
    expect_problem(
        greedy.ask(get("/v1/mushrooms/boletus_edulis.glb", "X-Forwarded-For: 9.9.9.9\r\n")), 429);
    EXPECT_NE(
        other.ask(get("/metrics")).body.find("sporeprint_queue_rejected_total{reason=\"budget\"}"),
        std::string::npos);
}

TEST(Limits, OnlyATrustedProxyReportsClients) {
    const auto log =
        std::filesystem::temp_directory_path() / ("limits." + std::to_string(::getpid()));
    const RealServer server(0,
                            {"--client-work", "1", "--client-burst", "1", "--client-connections",
                             "2", "--trusted-proxies", "127.0.0.2,10.0.0.0/8"},
                            log);
    std::vector<std::unique_ptr<RawClient>> proxy;
    for (int i = 0; i < 6; ++i) {
        proxy.push_back(std::make_unique<RawClient>(server.port(), 0, "127.0.0.2"));
        EXPECT_EQ(proxy.back()->ask(get("/v1")).status, 200) << "trusted proxies are exempt";
    }
    // One resource costs many seconds of the budget, so that it does not fill during the test.
    const std::string owed = "/v1/trees/broadleaf.glb?textures=none&lod=1&seed=";
    int seed = 0;
    const auto until_refused = [&](RawClient& by, const std::string& for_whom) {
        for (int i = 0; i < 100; ++i) {
            const auto response =
                by.ask(get(owed + std::to_string(++seed), "X-Forwarded-For: " + for_whom + "\r\n"));
            if (response.status != 200) return response.status;
        }
        return 200;
    };
    const auto first = [&](RawClient& by, const std::string& for_whom) {
        return by.ask(get(owed + std::to_string(++seed), "X-Forwarded-For: " + for_whom + "\r\n"))
            .status;
    };
    EXPECT_EQ(until_refused(*proxy[0], "203.0.113.7"), 429);
    EXPECT_EQ(first(*proxy[1], "203.0.113.8"), 200) << "another client of the same proxy";
    EXPECT_EQ(first(*proxy[1], "8.8.8.8, 203.0.113.7, 10.1.1.1"), 429)
        << "forged addresses to the left are ignored";
    EXPECT_EQ(until_refused(*proxy[2], "2001:db8::1"), 429);
    EXPECT_EQ(first(*proxy[2], "2001:db8::2:3"), 429) << "one /64 is one client";
    EXPECT_EQ(first(*proxy[2], "2001:db8:0:1::1"), 200);
    RawClient stranger(server.port());
    EXPECT_EQ(until_refused(stranger, "198.51.100.1"), 429);
    EXPECT_EQ(first(stranger, "198.51.100.2"), 429) << "the header of an untrusted peer is ignored";
    EXPECT_EQ(first(*proxy[3], "198.51.100.2"), 200);

    EXPECT_TRUE(server.logs("\"peer\":\"127.0.0.2\",\"client\":\"203.0.113.8\""));
    EXPECT_EQ(server.log().find("\"client\":\"198.51.100.1\""), std::string::npos);
    std::filesystem::remove(log);
}

TEST(Limits, SlowLargeUploadsOfOneClientLeaveMemoryForOthers) {
    constexpr std::size_t megabyte = 1 << 20;
    const RealServer server;
    const auto upload = [](std::size_t length) {
        return "POST /v1/inspect HTTP/1.1\r\nHost: x\r\nContent-Type: model/gltf-binary\r\n"
               "Content-Length: " +
               std::to_string(length) + "\r\n\r\n";
    };
    const auto gauge = [&](const std::string& name) {
        const std::string text = RawClient(server.port(), 0, "127.0.0.3").ask(get("/metrics")).body;
        const std::size_t at = text.find('\n' + name + ' ');
        return at == text.npos ? -1.0 : std::atof(text.c_str() + at + name.size() + 2);
    };
    std::vector<std::unique_ptr<RawClient>> slow;
    for (int i = 0; i < 4; ++i) {
        slow.push_back(std::make_unique<RawClient>(server.port()));
        EXPECT_TRUE(slow.back()->send(upload(64 * megabyte) + std::string(100'000, 'x')));
    }
    const auto others_upload = [&] {
        RawClient other(server.port(), 0, "127.0.0.2");
        other.send(upload(megabyte) + std::string(megabyte, 'y'));
        const int status = other.receive().status;
        return status == 400 || status == 422;  // read and rejected as malformed
    };
    for (int i = 0; i < 1000 && gauge("sporeprint_body_bytes") < 400'000; ++i) continue;
    EXPECT_EQ(gauge("sporeprint_body_bytes"), 400'000);
    EXPECT_TRUE(others_upload());

    // Each sends more until together they exceed the limit of one client.
    for (auto& one : slow) one->send(std::string(20 * megabyte, 'x'));
    for (int i = 0; i < 1000 && gauge("sporeprint_uploads_given_up_total") < 1; ++i)
        std::this_thread::sleep_for(10ms);
    EXPECT_EQ(gauge("sporeprint_uploads_given_up_total"), 1);
    EXPECT_LE(gauge("sporeprint_body_bytes"), 64.0 * megabyte);
    EXPECT_TRUE(others_upload());
    // The slowest of them is given up; which one that is depends on buffers of the system.
    int given_up = 0;
    for (auto& one : slow) {
        const RawClient::Response response = one->receive();
        if (response.status != 503) continue;
        expect_problem(response, 503);
        ++given_up;
    }
    EXPECT_EQ(given_up, 1);
    slow.clear();
    for (int i = 0; i < 1000 && gauge("sporeprint_body_bytes") > 0; ++i)
        std::this_thread::sleep_for(10ms);
    EXPECT_EQ(gauge("sporeprint_body_bytes"), 0);
}

TEST(Limits, AreOffByDefault) {
    const RealServer server;
    std::vector<std::unique_ptr<RawClient>> many;
    for (int i = 0; i < 100; ++i) many.push_back(std::make_unique<RawClient>(server.port()));
    for (int i = 0; i < 100; ++i)
        EXPECT_EQ(many[static_cast<std::size_t>(i)]->ask(get(generated + std::to_string(i))).status,
                  200);
}

}  // namespace
}  // namespace sporeprint::server::http_limits_test
