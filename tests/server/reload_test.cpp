#include "server/reload.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <thread>

#include "core/atlas/atlas.h"
#include "core/params/reader.h"
#include "server/operations/signatures.h"
#include "tests/server/raw_client.h"
#include "tests/server/real_server.h"

namespace sporeprint::server::reload_test {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

std::string get(const std::string& target) {
    return "GET " + target + " HTTP/1.1\r\nHost: x\r\n\r\n";
}

/// Returns true if a condition becomes true within 10 s.
bool becomes_true(const std::function<bool()>& condition) {
    for (int i = 0; i < 1000; ++i) {
        if (condition()) return true;
        std::this_thread::sleep_for(10ms);
    }
    return false;
}

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; ++at) ++found;
    return found;
}

class Reload : public testing::Test {
  protected:
    void SetUp() override {
        folder = fs::temp_directory_path() / ("reload." + std::to_string(::getpid()));
        fs::create_directories(folder / "atlas");
    }
    void TearDown() override { fs::remove_all(folder); }

    void write(const std::string& name, const std::string& text) const {
        std::ofstream(folder / "new", std::ios::trunc) << text;
        fs::rename(folder / "new", folder / name);
    }
    static std::string template_of(const std::string& id) {
        return built_in_atlas()->find(id)->json;
    }
    RawClient::Response ask(const RealServer& server, const std::string& target) const {
        return RawClient(server.port()).ask(get(target));
    }

    fs::path folder;
    const std::string first = "/v1/mushrooms/amanita_muscaria.glb?lod=3&textures=none",
                      second = "/v1/mushrooms/boletus_edulis.glb?lod=3&textures=none";
};

TEST_F(Reload, ReplacesTemplatesAndKeepsCachesOfUnchangedOnes) {
    write("atlas/a.json", template_of("amanita_muscaria"));
    const RealServer server(0, {"--atlas", folder / "atlas"}, folder / "log");
    const auto kinds = [&] {
        return count(ask(server, "/v1/species").body, "\"scientific_name\"");
    };
    EXPECT_EQ(kinds(), 1u);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(kinds(), 1u) << "from the hot-response table";
    const std::string tag = ask(server, first).header("ETag");
    const std::string versioned = ask(server, first).header("Content-Location");
    EXPECT_EQ(ask(server, second).status, 404);

    write("atlas/b.json", template_of("boletus_edulis"));
    EXPECT_EQ(kinds(), 1u) << "not before SIGHUP";
    server.hang_up();
    EXPECT_TRUE(becomes_true([&] { return kinds() == 2; }));
    EXPECT_EQ(ask(server, second).status, 200);
    const auto cached = ask(server, first);
    EXPECT_EQ(cached.header("ETag"), tag);
    EXPECT_NE(cached.header("Cache-Status").find("; hit"), std::string::npos)
        << "its templates have not changed";

    std::string changed = template_of("amanita_muscaria");
    changed.replace(changed.find("Fly agaric"), 10, "Fly Agaric");
    write("atlas/a.json", changed);
    server.hang_up();
    EXPECT_TRUE(becomes_true([&] { return ask(server, versioned).status == 410; }));
    EXPECT_NE(ask(server, first).header("ETag"), tag);
    EXPECT_EQ(ask(server, second).status, 200);
    EXPECT_EQ(ask(server, "/readyz").status, 200);
}

TEST_F(Reload, ReplacesLeavesAndTrees) {
    for (const char* kind : {"species", "leaves", "trees"})
        fs::create_directories(folder / "atlas" / kind);
    write("atlas/species/a.json", template_of("amanita_muscaria"));
    const auto atlas = built_in_atlas();
    const auto named = [](Value preset, const char* id, const char* leaf) {
        preset.set("id", id);
        if (*leaf) preset.set("leaf", leaf);
        return dump(preset);
    };
    const Value leaf = sporeprint::write(*atlas->find_leaf("birch")),
                tree = sporeprint::write(*atlas->find_tree("herb"));
    write("atlas/leaves/elm.json", named(leaf, "elm", ""));
    write("atlas/trees/elm.json", named(tree, "young_elm", "elm"));
    const RealServer server(0, {"--atlas", folder / "atlas"}, folder / "log");
    const std::string grown = "/v1/trees/young_elm.glb?lod=3&textures=none";
    EXPECT_EQ(count(ask(server, "/v1/species").body, "\"scientific_name\""), 1u);
    EXPECT_EQ(ask(server, grown).status, 200);
    EXPECT_EQ(ask(server, grown + "&leaf=alder").status, 400);
    EXPECT_EQ(ask(server, "/v1/leaves/elm.glb?lod=3&textures=none").status, 200);
    EXPECT_EQ(ask(server, "/v1/trees/herb.glb").status, 404);

    write("atlas/leaves/alder.json", named(leaf, "alder", ""));
    server.hang_up();
    EXPECT_TRUE(becomes_true([&] { return ask(server, grown + "&leaf=alder").status == 200; }));
    EXPECT_EQ(count(ask(server, "/v1/leaves").body, "\"name\""), 2u);

    write("atlas/trees/elm.json", named(tree, "young_elm", "adler"));
    server.hang_up();
    EXPECT_TRUE(becomes_true([&] { return count(server.log(), "reloading failed") == 1; }));
    EXPECT_NE(server.log().find("did you mean 'alder'"), std::string::npos) << server.log();
    EXPECT_EQ(ask(server, grown).status, 200);
}

TEST_F(Reload, KeepsTheStateAndNamesTheFileIfOneIsInvalid) {
    write("atlas/a.json", template_of("amanita_muscaria"));
    write("keys", "k1 00112233445566778899aabbccddeeff\n");
    const RealServer server(0, {"--atlas", folder / "atlas", "--sign-keys", folder / "keys"},
                            folder / "log");
    write("atlas/worse.json", "{\"id\": ");
    write("keys", "k1 tooshort\n");
    server.hang_up();
    EXPECT_TRUE(becomes_true([&] { return count(server.log(), "reloading failed") >= 2; }));
    const std::string log = server.log();
    EXPECT_NE(log.find("worse.json"), std::string::npos) << log;
    EXPECT_NE(log.find((folder / "keys").string()), std::string::npos);
    EXPECT_EQ(log.find("tooshort"), std::string::npos) << "it may be a secret";
    EXPECT_EQ(ask(server, "/v1/species/amanita_muscaria").status, 200);
    const Signatures old = Signatures::from_text("", "k1 00112233445566778899aabbccddeeff");
    const std::string signed_first = old.signed_target("GET", first, {}, std::nullopt);
    EXPECT_EQ(ask(server, signed_first).status, 200);
    EXPECT_EQ(ask(server, first).status, 403) << "invalid keys do not disable signatures";

    // The keys become valid again, the templates do not: sources are independent.
    write("keys", "k2 ffeeddccbbaa99887766554433221100\n");
    for (int i = 0; i < 3; ++i)
        EXPECT_EQ(ask(server, signed_first).status, 200) << "from the hot-response table";
    server.hang_up();
    EXPECT_TRUE(becomes_true([&] { return ask(server, signed_first).status == 403; }));
    const Signatures current = Signatures::from_text("", "k2 ffeeddccbbaa99887766554433221100");
    EXPECT_EQ(ask(server, current.signed_target("GET", first, {}, std::nullopt)).status, 200);
}

TEST_F(Reload, DoesNotDisturbConcurrentRequests) {
    write("atlas/a.json", template_of("amanita_muscaria"));
    RealServer server(0, {"--atlas", folder / "atlas"}, folder / "log");
    std::atomic<bool> over{false};
    std::atomic<int> requested{0}, wrong{0};
    {
        std::vector<std::jthread> clients;
        for (int t = 0; t < 4; ++t)
            clients.emplace_back([&, t] {
                RawClient client(server.port());
                for (int i = 0; !over && i < 900; ++i, ++requested) {
                    const std::string target =
                        i % 3 == 0 ? "/v1/species" : first + "&seed=" + std::to_string(t * 900 + i);
                    if (client.ask(get(target)).status != 200) ++wrong;
                }
            });
        for (int i = 0; i < 10; ++i) {
            std::string changed = template_of("amanita_muscaria");
            if (i % 2 == 0) changed.replace(changed.find("Fly agaric"), 10, "Fly Agaric");
            write("atlas/a.json", changed);
            server.hang_up();
            EXPECT_TRUE(becomes_true([&] {
                return count(server.log(), "\"message\":\"reloaded\"") >
                       static_cast<std::size_t>(i);
            }));
        }
        over = true;
    }
    EXPECT_GT(requested, 40);
    EXPECT_EQ(wrong, 0);
    EXPECT_EQ(server.stop(), 0);
}

}  // namespace
}  // namespace sporeprint::server::reload_test
