// The real program with hostile clients: after each test it runs, serves other clients, and has
// allocated little memory.

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/server/raw_client.h"
#include "tests/server/real_server.h"

namespace sporeprint::server::hostile_test {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using Clients = std::vector<std::unique_ptr<RawClient>>;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr long megabyte = 32 << 20;  // shadow memory, and memory not released at once
#else
constexpr long megabyte = 1 << 20;
#endif
const std::string cached = "/v1/mushrooms/amanita_muscaria.glb?lod=3&textures=none";
const std::string large = "/v1/mushrooms/amanita_muscaria.glb?lod=0&textures=none";
const std::string smuggled = "GET /v1/smuggled HTTP/1.1\r\nHost: x\r\n\r\n";

std::string get(const std::string& target, const std::string& more = {}) {
    return "GET " + target + " HTTP/1.1\r\nHost: x\r\n" + more + "\r\n";
}

class Hostile : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        rlimit limit{};
        getrlimit(RLIMIT_NOFILE, &limit);
        limit.rlim_cur = limit.rlim_max;
        setrlimit(RLIMIT_NOFILE, &limit);
        server = std::make_unique<RealServer>();
        for (const std::string& target : {cached, large})
            for (int i = 0; i < 2; ++i) RawClient(port()).ask(get(target));
    }
    static void TearDownTestSuite() {
        EXPECT_EQ(server->stop(), 0);
        server.reset();
    }
    void SetUp() override { before = server->resident(); }

    /// Checks that the server runs, serves other clients, and has released its resources.
    void TearDown() override {
        ASSERT_TRUE(server->runs());
        expect_others_are_served();
        for (int i = 0; i < 1000 && metric("sporeprint_connections") > 1; ++i)
            std::this_thread::sleep_for(10ms);
        EXPECT_EQ(metric("sporeprint_connections"), 1) << "only the one of this request";
        EXPECT_LT(server->resident() - before, most_growth);
    }

    static int port() { return server->port(); }

    static void expect_others_are_served() {
        const auto begun = Clock::now();
        RawClient other(port());
        EXPECT_EQ(other.ask(get("/livez")).body, "alive\n");
        EXPECT_EQ(other.ask(get(cached)).status, 200);
        EXPECT_EQ(other.ask(get("/v1/species?limit=nonsense")).status, 400);
        EXPECT_LT(Clock::now() - begun, 5s) << "milliseconds on a quiet machine";
    }

    /// Returns the sum of a metric over its labels.
    static long metric(const std::string& name) {
        const std::string text = RawClient(port()).ask(get("/metrics")).body;
        double sum = 0;
        for (std::size_t at = 0; (at = text.find('\n' + name, at)) != std::string::npos; ++at) {
            const char after = text[at + 1 + name.size()];
            if (after == '{' || after == ' ')
                sum += std::atof(text.c_str() + text.rfind(' ', text.find('\n', at + 1)));
        }
        return static_cast<long>(sum);
    }

    static inline std::unique_ptr<RealServer> server;
    long before = 0;
    long most_growth = 48 * megabyte;
};

TEST_F(Hostile, AThousandIdleAndFiveHundredDrippingConnectionsDoNotBlockOthers) {
    Clients idle, dripping;
    for (int i = 0; i < 1000; ++i) idle.push_back(std::make_unique<RawClient>(port()));
    for (int i = 0; i < 500; ++i) {
        dripping.push_back(std::make_unique<RawClient>(port()));
        dripping.back()->send(i % 2 == 0 ? "GE"
                                         : "POST /v1/inspect HTTP/1.1\r\nHost: x\r\nContent-Type: "
                                           "model/gltf-binary\r\nContent-Length: 100000\r\n\r\n");
    }
    for (int round = 0; round < 5; ++round) {
        for (auto& one : dripping) one->send("T");
        expect_others_are_served();
        std::this_thread::sleep_for(50ms);
    }
    EXPECT_GE(metric("sporeprint_connections"), 1500) << "all stay open";
    EXPECT_LT(server->resident() - before, 32 * megabyte);
}

TEST_F(Hostile, ClientsThatDoNotReadDoNotBlockOthersOrCopyBodies) {
    Clients clients;
    for (int i = 0; i < 100; ++i) {
        clients.push_back(std::make_unique<RawClient>(port(), 4096));
        for (int k = 0; k < 5; ++k) clients.back()->send(get(large));
    }
    for (int round = 0; round < 5; ++round) expect_others_are_served();
    EXPECT_LT(server->resident() - before, 32 * megabyte);
}

TEST_F(Hostile, PipelinedResponsesKeepTheirOrder) {
    RawClient client(port());
    const std::vector<std::string> targets = {cached,        "/v1/nowhere", "/livez", cached,
                                              "/v1/species", large,         "/readyz"};
    std::string all;
    for (int i = 0; i < 70; ++i)
        all += get(targets[static_cast<std::size_t>(i) % targets.size()],
                   "X-Request-Id: n" + std::to_string(i) + "\r\n");
    std::jthread sender([&] { client.send(all); });
    for (int i = 0; i < 70; ++i) {
        const auto response = client.receive();
        EXPECT_EQ(response.header("X-Request-Id"), "n" + std::to_string(i));
        EXPECT_EQ(response.status, i % 7 == 1 ? 404 : 200);
    }
}

TEST_F(Hostile, ResetsAnywhereLeaveNothingBehind) {
    const std::size_t files = server->open_files();
    const std::string post =
        "POST /v1/inspect HTTP/1.1\r\nHost: x\r\nContent-Type: "
        "model/gltf-binary\r\nContent-Length: 2000000\r\n\r\n";
    const std::vector<std::string> beginnings = {
        "",
        "GET / HT",
        post,
        post + std::string(500'000, 'x'),
        get(large),
        get(large) + get(large),
        get("/v1/mushrooms/boletus_edulis.glb?lod=2&seed=99"),
        "GET / HTTP/1.1\nbad"};
    for (int round = 0; round < 20; ++round)
        for (const std::string& beginning : beginnings) {
            RawClient client(port(), 4096);
            client.send(beginning);
            if (round % 2 == 0) std::this_thread::sleep_for(1ms);
            client.reset();
        }
    expect_others_are_served();
    for (int i = 0; i < 500 && server->open_files() > files; ++i) std::this_thread::sleep_for(10ms);
    EXPECT_LE(server->open_files(), files + 8) << "except for newly stored responses";
}

TEST_F(Hostile, HalfClosedClientsGetCachedResponsesButNoWork) {
    RawClient client(port());
    client.send(get(cached) + get("/v1/species"));
    client.finish();
    EXPECT_EQ(client.receive().status, 200);
    EXPECT_EQ(client.receive().status, 200);
    EXPECT_TRUE(client.is_closed());

    most_growth = 256 * megabyte;  // begun jobs complete
    const long left = metric("sporeprint_queue_rejected_total");
    Clients is_disconnected;
    for (int i = 0; i < 16; ++i) {
        is_disconnected.push_back(std::make_unique<RawClient>(port()));
        is_disconnected.back()->send(get(
            "/v1/mushrooms/boletus_edulis.glb?texture_size=2048&seed=" + std::to_string(7000 + i)));
        is_disconnected.back()->finish();
    }
    for (int i = 0; i < 2000 && metric("sporeprint_queue_rejected_total") == left; ++i)
        std::this_thread::sleep_for(10ms);
    EXPECT_GT(metric("sporeprint_queue_rejected_total"), left);
}

TEST_F(Hostile, NoFramingSmugglesASecondRequest) {
    const std::string post = "POST /v1/inspect HTTP/1.1\r\nHost: x\r\n";
    const std::vector<std::string> variants = {
        post + "Content-Length: 6\r\nTransfer-Encoding: chunked\r\n\r\n0\r\n\r\nG",
        post + "Transfer-Encoding: chunked\r\nContent-Length: 6\r\n\r\n0\r\n\r\n",
        post + "Transfer-Encoding: identity\r\n\r\n",
        post + "Transfer-Encoding:\tchunked\r\n\r\n0\r\n\r\n",
        post + "Transfer-Encoding : chunked\r\n\r\n0\r\n\r\n",
        post + "tRANSFER-eNCODING: xchunked\r\n\r\n0\r\n\r\n",
        post + "Transfer-Encoding: chunked\r\nTransfer-Encoding: identity\r\n\r\n0\r\n\r\n",
        post + "X: y\r\n Transfer-Encoding: chunked\r\n\r\n0\r\n\r\n",
        post + "Content-Length: 0\r\nContent-Length: 44\r\n\r\n",
        post + "Content-Length: 44\r\nContent-Length: 44\r\n\r\n",
        post + "Content-Length: 0, 44\r\n\r\n",
        post + "Content-Length: +0\r\n\r\n",
        post + "Content-Length: -1\r\n\r\n",
        post + "Content-Length: 0x0\r\n\r\n",
        post + "Content-Length: 0 4\r\n\r\n",
        post + "Content-Length:\r\n\r\n",
        post + "Content-Length: 99999999999999999999999\r\n\r\n",
        post + "Content-Length\r\n\r\n",
        post + "Content-Length: 0\r\n folded: 1\r\n\r\n",
        post + "Content-Encoding: gzip\r\nContent-Length: 0\r\n\r\n",
        "GET / HTTP/1.1\nHost: x\n\n",
        "GET / HTTP/1.1\r\nHost: x\n\r\n",
        "GET / HTTP/1.1\r\nHost: x\r\n\n",
        "GET / HTTP/1.1\r\nA: b\rGET /v1/smuggled HTTP/1.1\r\n\r\n",
        std::string("GET / HTTP/1.1\r\nA: b\0c\r\n\r\n", 25),
        "GET / HTTP/1.1\r\n: empty\r\n\r\n",
        "GET / HTTP/1.1\r\nno colon\r\n\r\n",
        "GET  / HTTP/1.1\r\n\r\n",
        "GET\t/\tHTTP/1.1\r\n\r\n",
        "GET / HTTP/1.1 HTTP/1.1\r\n\r\n",
        "GET / HTTP/2.0\r\n\r\n",
        "GET / http/1.1\r\n\r\n",
        "GET /\r\n\r\n",
        "GET nowhere HTTP/1.1\r\n\r\n",
        "CONNECT x:80 HTTP/1.1\r\n\r\n",
        "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n"};
    for (const std::string& variant : variants) {
        RawClient client(port());
        client.send(variant + smuggled);
        client.finish();
        const std::string all = client.receive_all();
        EXPECT_TRUE(all.starts_with("HTTP/1.1 4")) << variant << all.substr(0, 200);
        for (const char* second : {"HTTP/1.1 2", "HTTP/1.1 3", "HTTP/1.1 4", "HTTP/1.1 5"})
            EXPECT_EQ(all.find(second, 9), std::string::npos) << "one response to: " << variant;
        EXPECT_EQ(all.find("smuggled"), std::string::npos) << variant;
    }
    RawClient client(port());
    EXPECT_EQ(client
                  .ask("GET " + cached + " HTTP/1.1\r\nContent-Length: " +
                       std::to_string(smuggled.size()) + "\r\n\r\n" + smuggled)
                  .status,
              200);
    EXPECT_EQ(client.ask(get("/livez")).body, "alive\n") << "the body of a GET is not a request";
}

TEST_F(Hostile, RangesBombsAndEndlessHeadsAreCheap) {
    RawClient whole(port());
    const std::string body = whole.ask(get(large)).body;
    std::string many = "bytes=0-";
    for (int i = 0; i < 2000; ++i) many += ",0-";
    for (const std::string& range :
         {std::string("bytes=0-99999999999"), std::string("bytes=-99999999999"), many})
        EXPECT_TRUE(whole.ask(get(large, "Range: " + range + "\r\n")).body == body);
    const std::string block(1 << 20, 'a');
    const std::vector<std::string> beginnings = {
        "",
        "GET /",
        "GET / HTTP/1.1\r\nA: ",
        "GET / HTTP/1.1\r\n",
        "POST /v1/inspect HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\n40000000\r\n",
        "POST /v1/inspect HTTP/1.1\r\nContent-Length: 99999999999\r\n\r\n"};
    for (const std::string& beginning : beginnings) {
        RawClient client(port());
        client.send(beginning);
        int sent = 0;
        while (sent < 64 && client.send(block)) ++sent;
        EXPECT_LT(sent, 64) << "all of it was read: " << beginning;
        EXPECT_LT(server->resident() - before, 32 * megabyte);
    }
    std::string headers;
    for (int i = 0; i < 5000; ++i) headers += "A:\r\n";
    RawClient client(port());
    EXPECT_EQ(client.ask(get("/livez", headers)).status, 431);
}

// cpp-httplib would match these against regular expressions that recurse once per character.
TEST_F(Hostile, LongValuesReachNoRegularExpression) {
    RawClient client(port());
    const std::string body = client.ask(get(large)).body;
    const std::string digits(8100, '9'), document = "/v1/species";
    EXPECT_TRUE(client.ask(get(large, "Range: bytes=0-" + digits + "\r\n")).body == body);
    for (const char* range : {"bytes=", "bytes=1-", "bytes=-"}) {
        const auto response = client.ask(get(document, "Range: " + (range + digits) + "\r\n"));
        EXPECT_EQ(response.status, 200);
        EXPECT_EQ(response.header("Content-Range"), "");
    }

    const std::string part =
        "--x\r\nContent-Disposition: form-data; name=\"a\"; filename*=UTF-8''" +
        std::string(60'000, 'a') + "\r\n\r\nb\r\n--x--\r\n";
    EXPECT_EQ(client
                  .ask("POST /v1/inspect HTTP/1.1\r\nHost: x\r\nContent-Length: " +
                       std::to_string(part.size()) +
                       "\r\nContent-Type: multipart/form-data; boundary=x\r\n\r\n" + part)
                  .status,
              415);
    EXPECT_EQ(client.ask(get("/livez")).status, 200) << "on the same connection";

    EXPECT_EQ(client.ask(get("/" + std::string(4000, 'a'))).status, 404);
    const auto begun = Clock::now();
    RawClient longer(port());
    longer.send(get("/" + std::string(100'000, 'a')));
    EXPECT_TRUE(longer.receive_all().starts_with("HTTP/1.1 414 "));
    EXPECT_LT(Clock::now() - begun, 4s) << "it does not wait for the idle timeout";
}

TEST(HostileLog, ClientsForgeNeitherLinesNorAddresses) {
    const auto log =
        std::filesystem::temp_directory_path() / ("hostile." + std::to_string(::getpid()));
    RealServer server(0, {}, log);
    const std::string line = "{\"level\":\"error\",\"message\":\"FAKE\"}";
    const std::vector<std::string> headers = {"User-Agent: x%0d%0a" + line,
                                              "X-Request-Id: x%0d%0a" + line,
                                              "Traceparent: 00-%0d%0a" + line,
                                              "X-Forwarded-For: 1.2.3.4%0a" + line,
                                              "Referer: \x1b[2J\xe2\x80\xa8" + line,
                                              "REMOTE_ADDR: 1.2.3.4",
                                              "REMOTE_PORT: 1",
                                              "LOCAL_ADDR: 1.2.3.4",
                                              "LOCAL_PORT: 1"};
    for (const std::string& header : headers) {
        RawClient client(server.port());
        const std::string target = "/v1/species?limit=nonsense%0d%0a" + line;
        EXPECT_EQ(client.ask(get(target, header + "\r\n")).status, 400) << header;
    }
    EXPECT_EQ(RawClient(server.port()).ask(get("/v1")).status, 200);
    EXPECT_TRUE(server.logs("\"target\":\"/v1\""));
    std::istringstream lines(server.log());
    int count = 0;
    for (std::string one; std::getline(lines, one); ++count) {
        if (one.starts_with("sporeprint: the page is not built")) continue;
        const auto entry = nlohmann::json::parse(one, nullptr, false);
        ASSERT_TRUE(entry.is_object()) << one;
        EXPECT_NE(entry.value("message", ""), "FAKE") << one;
        EXPECT_EQ(entry.value("client", "127.0.0.1"), "127.0.0.1") << one;
        EXPECT_EQ(entry.value("peer", "127.0.0.1"), "127.0.0.1") << one;
    }
    EXPECT_GT(count, 9);
    std::filesystem::remove(log);
}

TEST(HostileLog, UnknownMethodsAreNotServerErrors) {
    const auto log =
        std::filesystem::temp_directory_path() / ("methods." + std::to_string(::getpid()));
    RealServer server(0, {}, log);
    RawClient client(server.port());
    for (const char* method : {"PROPFIND", "BREW", "get", "TRACE", "M-SEARCH"}) {
        const std::string line = std::string(method) + ' ';
        for (const std::string& path :
             {std::string("/v1/species"), std::string("/livez"), cached}) {
            const auto response = client.ask(line + path + " HTTP/1.1\r\nHost: x\r\n\r\n");
            EXPECT_EQ(response.status, 405) << method << ' ' << path;
            EXPECT_TRUE(response.header("Allow").starts_with("GET, HEAD")) << path;
            EXPECT_EQ(response.header("Content-Type"), "application/problem+json");
        }
        EXPECT_EQ(
            client.ask(line + "/v1/inspect HTTP/1.1\r\nContent-Length: 1\r\n\r\nx").header("Allow"),
            "POST, OPTIONS");
        EXPECT_EQ(client.ask(line + "/nowhere HTTP/1.1\r\n\r\n").status, 404);
    }
    EXPECT_TRUE(server.logs("\"method\":\"M-SEARCH\",\"target\":\"/nowhere\",\"status\":404"));
    EXPECT_EQ(server.log().find("\"level\":\"error\""), std::string::npos) << server.log();
    const std::string metrics = client.ask(get("/metrics")).body;
    EXPECT_EQ(metrics.find("code=\"5"), std::string::npos) << metrics;
    EXPECT_NE(metrics.find("code=\"405\""), std::string::npos);
    std::filesystem::remove(log);
}

TEST(HostileLog, ContainsNoSignature) {
    const auto log =
        std::filesystem::temp_directory_path() / ("secrets." + std::to_string(::getpid()));
    std::ofstream(log.string() + ".list") << cached << "&key=k&sig=LISTED\n";
    RealServer server(0, {"--warm", log.string() + ".list"}, log);
    RawClient client(server.port());
    for (int i = 0; i < 3; ++i) client.ask(get("/v1/species?key=k1&expires=9&sig=SECRET"));
    client.ask("GET /v1?sig=SECRET HTTP/1.1\r\nbad\r\n\r\n");
    RawClient slow(server.port());
    slow.ask("POST /v1/inspect?sig=SECRET HTTP/1.1\r\nContent-Length: 99999999999\r\n\r\n");
    EXPECT_TRUE(server.logs("\"target\":\"/v1/inspect?sig=[redacted]\""));
    EXPECT_TRUE(server.logs("\"target\":\"/v1/species?key=k1&expires=9&sig=[redacted]\""));
    EXPECT_EQ(server.log().find("SECRET"), std::string::npos) << server.log();
    EXPECT_EQ(server.log().find("LISTED"), std::string::npos) << server.log();
    std::filesystem::remove(log);
    std::filesystem::remove(log.string() + ".list");
}

TEST(HostileLog, ReportsAnUnwritableStoreAndForeignFiles) {
    namespace fs = std::filesystem;
    const fs::path folder = fs::temp_directory_path() / ("store." + std::to_string(::getpid()));
    fs::create_directories(folder / "store" / "ab");
    const std::string name = "ab" + std::string(30, '0') + ".body";
    std::ofstream(folder / "store" / "ab" / name) << "x";
    fs::resize_file(folder / "store" / "ab" / name, std::uintmax_t{20} << 30);
    RealServer server(0, {"--store", folder / "store"}, folder / "log");
    ASSERT_GT(server.port(), 0);
    EXPECT_TRUE(server.logs("files in the store's folder that are not its own are left alone"));
    EXPECT_NE(server.log().find(name), std::string::npos);
    RawClient client(server.port());
    EXPECT_EQ(client.ask(get(cached)).status, 200);
    // A file in place of the folder for new files simulates a full disk.
    fs::remove_all(folder / "store" / "aside");
    std::ofstream(folder / "store" / "aside") << "x";
    for (int i = 0; i < 5; ++i)
        EXPECT_EQ(client.ask(get(cached + "&seed=" + std::to_string(50 + i))).status, 200);
    EXPECT_TRUE(server.logs("finished files cannot be written to the store"));
    const std::string text = server.log();
    EXPECT_NE(text.find("\"why\":\"Not a directory\",\"times\":1"), std::string::npos) << text;
    EXPECT_EQ(text.find("cannot be written to the store"),
              text.rfind("cannot be written to the store"))
        << "once per minute";
    EXPECT_NE(client.ask(get("/metrics"))
                  .body.find("sporeprint_store_faults_total{fault=\"unwritten\"} 5"),
              std::string::npos);
    EXPECT_EQ(server.stop(), 0);
    fs::remove_all(folder);
}

TEST(HostileLimits, ExpectContinueGetsTheFinalStatusThatTheHeadDetermines) {
    const RealServer server;
    const auto requested = [&](const std::string& line, const std::string& type) {
        return RawClient(server.port())
            .ask(line + " HTTP/1.1\r\nHost: x\r\n" + type +
                 "Expect: 100-continue\r\nContent-Length: 20\r\n\r\n")
            .status;
    };
    const std::string json = "Content-Type: application/json\r\n";
    EXPECT_EQ(requested("POST /v1/trees.glb", json), 100);
    EXPECT_EQ(requested("POST /v1/trees.glb", "Content-Type: application/json; charset=utf-8\r\n"),
              100);
    EXPECT_EQ(requested("POST /v1/trees.glb", ""), 415);
    EXPECT_EQ(requested("POST /v1/inspect", json), 415);
    EXPECT_EQ(requested("POST /v1/trees.glb", json + "Content-Encoding: gzip\r\n"), 415);
    EXPECT_EQ(requested("POST /v1/nowhere", json), 404);
    EXPECT_EQ(requested("POST /v1/%zz", json), 400);
    EXPECT_EQ(requested("POST /v1/species", json), 405);
    EXPECT_EQ(requested("PUT /v1/trees.glb", json), 405);
    EXPECT_EQ(requested("POST /livez", json), 405);
    EXPECT_EQ(requested("GET /v1/species", json), 100) << "a body that is not read";
    RawClient announced(server.port());
    EXPECT_EQ(announced
                  .ask("POST /v1/trees.glb HTTP/1.1\r\n" + json +
                       "Expect: 100-continue\r\nContent-Length: 9999999\r\n\r\n")
                  .status,
              413);
}

TEST(HostileLimits, RunningOutOfDescriptorsIsSurvived) {
    RealServer server(64);
    ASSERT_GT(server.port(), 0);
    for (int round = 0; round < 2; ++round) {
        Clients clients;
        for (int i = 0; i < 200; ++i) clients.push_back(std::make_unique<RawClient>(server.port()));
        std::this_thread::sleep_for(100ms);
        ASSERT_TRUE(server.runs());
        clients.clear();
        int status = 0;
        for (int i = 0; i < 500 && status != 200; ++i) {
            status = RawClient(server.port()).ask(get("/livez")).status;
            if (status != 200) std::this_thread::sleep_for(10ms);
        }
        EXPECT_EQ(status, 200);
    }
    EXPECT_EQ(server.stop(), 0);
}

}  // namespace
}  // namespace sporeprint::server::hostile_test
