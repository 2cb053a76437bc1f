#include "server/warm.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "tests/server/raw_client.h"
#include "tests/server/real_server.h"
#include "tests/support/paths.h"

namespace sporeprint::server::warm_test {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

std::string get(const std::string& target, const std::string& more = {}) {
    return "GET " + target + " HTTP/1.1\r\nHost: x\r\n" + more + "\r\n";
}

const std::string first = "/v1/mushrooms/amanita_muscaria.glb?lod=3&textures=none",
                  second = "/v1/mushrooms/boletus_edulis.glb?lod=3&texture_size=128";

class WarmStart : public testing::Test {
  protected:
    void SetUp() override {
        folder = fs::temp_directory_path() / ("warm." + std::to_string(::getpid()));
        fs::create_directories(folder);
    }
    void TearDown() override { fs::remove_all(folder); }

    fs::path folder;
};

TEST_F(WarmStart, GeneratesListedTargetsBeforeReadinessAndNamesFailures) {
    std::ofstream(folder / "list") << "# for a test\n"
                                   << first << "\n"
                                   << second << "\n"
                                   << "/v1/mushrooms/amanita_muscara.glb\nnonsense\n"
                                   << first << "&age=7\n/v1/species\n";
    const RealServer server(0, {"--warm", folder / "list"}, folder / "log");
    ASSERT_GT(server.port(), 0) << "no line is fatal";
    RawClient client(server.port());
    EXPECT_EQ(client.ask(get("/readyz")).status, 200);
    EXPECT_EQ(client.ask(get(first)).header("Cache-Status"), "sporeprint; hit");
    EXPECT_EQ(client.ask(get(second)).header("Cache-Status"), "sporeprint; hit");
    EXPECT_TRUE(server.logs("\"good\":3,\"faulty\":3,\"left\":0"));
    const std::string log = server.log();
    EXPECT_NE(log.find("\"line\":4,\"target\":\"/v1/mushrooms/amanita_muscara.glb\""),
              std::string::npos)
        << log;
    EXPECT_NE(log.find("did you mean 'amanita_muscaria'"), std::string::npos);
    EXPECT_NE(log.find("\"line\":5,\"target\":\"nonsense\""), std::string::npos);
    EXPECT_NE(log.find("7 is outside 0..1"), std::string::npos);
}

TEST_F(WarmStart, FailsWithoutItsFile) {
    for (const fs::path& file : {folder / "nowhere", folder}) {
        RealServer server(0, {"--warm", file}, folder / "log");
        EXPECT_EQ(server.port(), 0);
        EXPECT_EQ(server.wait(), 2);
        EXPECT_NE(server.log().find("--warm: " + file.string() + " cannot be read"),
                  std::string::npos)
            << server.log();
    }
}

TEST_F(WarmStart, LogLinesCarryTheTraceOfTheirRequest) {
    const RealServer server(0, {}, folder / "log");
    const std::string trace = "4bf92f3577b34da6a3ce929d0e0e4736", parent = "00f067aa0ba902b7";
    RawClient client(server.port());
    for (int i = 0; i < 4; ++i)  // the last one from the hot-response table
        client.ask(get(first, "X-Request-Id: with" + std::to_string(i) + "\r\ntraceparent: 00-" +
                                  trace + '-' + parent + "-01\r\n"));
    client.ask(get(first, "X-Request-Id: without\r\n"));
    client.ask(get(first, "X-Request-Id: forged\r\ntraceparent: 00-" + trace + "\",\"a\":\"b\r\n"));
    EXPECT_TRUE(server.logs("\"forged\""));
    const std::string log = server.log();
    const auto line_of = [&](const std::string& id) {
        const std::size_t at = log.find("\"id\":\"" + id + '"');
        return at == log.npos ? "" : log.substr(at, log.find('\n', at) - at);
    };
    for (int i = 0; i < 4; ++i)
        EXPECT_NE(line_of("with" + std::to_string(i))
                      .find("\"trace_id\":\"" + trace + "\",\"parent_id\":\"" + parent + '"'),
                  std::string::npos)
            << log;
    for (const char* none : {"without", "forged"}) {
        EXPECT_NE(line_of(none), "");
        EXPECT_EQ(line_of(none).find("trace"), std::string::npos) << line_of(none);
    }
}

TEST_F(WarmStart, IsAliveButNotReadyMeanwhileAndStopsOnSigterm) {
    // More than can be generated during this test: SIGTERM has to skip the rest.
    std::ofstream list(folder / "list");
    for (int i = 0; i < 100'000; ++i)
        list << "/v1/mushrooms/boletus_edulis.glb?texture_size=1024&seed=" << i << '\n';
    list.close();
    // A currently free port, since the server prints its own only when it is ready.
    int port = 0;
    {
        const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        socklen_t size = sizeof address;
        ASSERT_EQ(::bind(socket, reinterpret_cast<sockaddr*>(&address), size), 0);
        ::getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size);
        port = ntohs(address.sin_port);
        ::close(socket);
    }
    const pid_t pid = ::fork();
    if (pid == 0) {
        ::dup2(::open((folder / "output").c_str(), O_WRONLY | O_CREAT, 0600), STDOUT_FILENO);
        ::execl(server_program(), "sporeprint", "--port", std::to_string(port).c_str(), "--warm",
                (folder / "list").c_str(), "--log-level", "off", static_cast<char*>(nullptr));
        ::_exit(127);
    }
    int ready = 0, alive = 0;
    for (int i = 0; i < 1000 && ready == 0; ++i) {
        std::this_thread::sleep_for(10ms);
        ready = RawClient(port).ask(get("/readyz")).status;
    }
    alive = RawClient(port).ask(get("/livez")).status;
    EXPECT_EQ(ready, 503);
    EXPECT_EQ(alive, 200);
    ::kill(pid, SIGTERM);
    int status = 0;
    ::waitpid(pid, &status, 0);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    std::ifstream output(folder / "output");
    EXPECT_EQ(output.peek(), std::ifstream::traits_type::eof()) << "it never became ready";
}

}  // namespace
}  // namespace sporeprint::server::warm_test
