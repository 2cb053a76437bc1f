// The command as a process: whatever ends it, what it has made in the end is the same.
#include "server/bake/bake.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "core/math/random.h"
#include "core/params/types.h"
#include "tests/server/bake/folder.h"
#include "tests/server/raw_client.h"
#include "tests/server/real_server.h"
#include "tests/support/effort.h"
#include "tests/support/paths.h"

namespace sporeprint::server::bake_test {
namespace {

using baking::files_in;
using baking::text_of;
using Arguments = std::vector<std::string>;

class Bake : public baking::InFolder {
  protected:
    void SetUp() override {
        InFolder::SetUp();
        write_manifest(R"({"path":"/v1/mushrooms/{mix}.glb","count":60,"per_shard":7,
            "fixed":{"lod":3,"textures":"none"},"choice":{"mix":["boletus_edulis",
            "amanita_muscaria","no_such_one"]},"uniform":{"age":[0.4,1]},"number":{"seed":1}})");
    }

    void write_manifest(const std::string& text) const { std::ofstream(folder / "m.json") << text; }

    /// Starts the program; its output goes to the file `log`.
    pid_t start(const std::string& out, const Arguments& more, rlim_t most_bytes = 0) const {
        Arguments all = {"sporeprint", "bake", folder / "m.json", "--out", folder / out,
                         "--progress", "none"};
        all.insert(all.end(), more.begin(), more.end());
        std::vector<char*> arguments;
        for (std::string& one : all) arguments.push_back(one.data());
        arguments.push_back(nullptr);
        const pid_t pid = ::fork();
        if (pid != 0) return pid;
        if (most_bytes > 0) {
            const rlimit limit{most_bytes, most_bytes};
            setrlimit(RLIMIT_FSIZE, &limit);
            // Then writing fails as it does on a full disk, instead of ending the process.
            ::signal(SIGXFSZ, SIG_IGN);
        }
        ::dup2(::open((folder / "log").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO);
        ::execv(server_program(), arguments.data());
        ::_exit(127);
    }

    static int end_of(pid_t pid) {
        int status = 0;
        ::waitpid(pid, &status, 0);
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }

    int run(const std::string& out, const Arguments& more = {}, rlim_t most_bytes = 0) const {
        return end_of(start(out, more, most_bytes));
    }

    std::string log() const { return text_of(folder / "log"); }

    /// Returns what a folder has, after it was found to be complete.
    ///
    /// code  5 where some items cannot be made
    std::map<std::string, std::string> finished(const std::string& out, int code = 5) const {
        EXPECT_EQ(run(out, {"--finish"}), code) << log();
        return files_in(folder / out);
    }
};

TEST_F(Bake, MakesEqualTreesInAnyScheduleOfShards) {
    ASSERT_EQ(run("one", {"--threads", "1"}), 0) << log();
    const auto one = finished("one");
    EXPECT_EQ(one.size(), 9U + 9U + 2U);
    EXPECT_NE(log().find("60 items in 9 shards are complete, "), std::string::npos) << log();
    EXPECT_EQ(run("one"), 0) << "Nothing is left to do.";
    EXPECT_EQ(run("many", {"--shard", "2/3", "--threads", "2"}), 0);
    EXPECT_EQ(run("many", {"--finish"}), 3);
    EXPECT_NE(log().find("shard 3: missing"), std::string::npos) << log();
    EXPECT_NE(log().find("6 of 9 shards are missing or were damaged"), std::string::npos);
    EXPECT_EQ(run("many", {"--shard", "0/3"}), 0);
    EXPECT_EQ(run("many", {"--shard", "1/3", "--threads", "3"}), 0);
    EXPECT_EQ(finished("many"), one);
    // Four that do the same at once.
    std::vector<pid_t> same;
    for (int i = 0; i < 4; ++i) same.push_back(start("same", {"--threads", "1"}));
    for (const pid_t pid : same) EXPECT_EQ(end_of(pid), 0);
    EXPECT_EQ(finished("same"), one);
}

TEST_F(Bake, GoesOnAfterItWasKilled) {
    ASSERT_EQ(run("one"), 0) << log();
    const auto one = finished("one");
    Random random(5, 0);
    int killed = 0;
    for (int i = 0; i < 8; ++i) {
        const pid_t pid = start("killed", {"--threads", "1"});
        ::usleep((sanitized ? 600'000 : 40'000) + random.bits() % (sanitized ? 400'000 : 60'000));
        ::kill(pid, i % 2 == 0 ? SIGKILL : SIGTERM);
        killed += end_of(pid) != 0 ? 1 : 0;
    }
    EXPECT_GT(killed, 0) << "It was always faster.";
    EXPECT_EQ(run("killed"), 0) << log();
    EXPECT_EQ(finished("killed"), one);
}

TEST_F(Bake, GoesOnWhenAFullDiskHasRoomAgain) {
    ASSERT_EQ(run("one"), 0) << log();
    const auto one = finished("one");
    EXPECT_EQ(run("full", {}, 10'000), 1);
    EXPECT_NE(log().find("cannot be written: File too large; the same command goes on"),
              std::string::npos)
        << log();
    EXPECT_EQ(run("full"), 0) << log();
    EXPECT_EQ(finished("full"), one);
}

TEST_F(Bake, MakesADamagedShardAnew) {
    ASSERT_EQ(run("one"), 0) << log();
    const auto one = finished("one");
    const std::filesystem::path archive = folder / "one" / "000004.tar";
    std::string bad = text_of(archive);
    bad[bad.size() / 2] = static_cast<char>(bad[bad.size() / 2] ^ 1);
    std::ofstream(archive, std::ios::binary) << bad;
    EXPECT_EQ(run("one"), 0) << "A run alone does not read what is there.";
    EXPECT_EQ(run("one", {"--finish"}), 3);
    EXPECT_NE(log().find("shard 4: its archive is damaged"), std::string::npos) << log();
    EXPECT_EQ(run("one"), 0);
    EXPECT_EQ(finished("one"), one);
}

TEST_F(Bake, HasTheBytesThatAServerSends) {
    ASSERT_EQ(run("one"), 0) << log();
    const RealServer server;
    RawClient client(server.port());
    const std::string archive = text_of(folder / "one" / "000000.tar");
    std::ifstream index(folder / "one" / "000000.jsonl");
    std::string line;
    int compared = 0;
    for (std::getline(index, line); std::getline(index, line);) {
        std::vector<Problem> problems;
        const Value item = parse(line, problems);
        if (item.find("url") == nullptr) continue;
        const auto response =
            client.ask("GET " + item.find("url")->as_string() + " HTTP/1.1\r\nHost: x\r\n\r\n");
        EXPECT_EQ(response.status, 200);
        EXPECT_EQ(response.header("ETag"), item.find("etag")->as_string());
        EXPECT_EQ(response.body,
                  archive.substr(static_cast<std::size_t>(item.find("offset")->as_number()),
                                 static_cast<std::size_t>(item.find("bytes")->as_number())));
        ++compared;
    }
    EXPECT_GT(compared, 2);
}

TEST_F(Bake, LaysOutAFolderOfFiles) {
    write_manifest(R"({"path":"/v1/mushrooms/{mix}.glb","fixed":{"textures":"none"},
        "each":{"mix":["boletus_edulis","amanita_muscaria"],"lod":[2,3]}})");
    ASSERT_EQ(run("game", {"--layout", "files"}), 0) << log();
    const auto files = finished("game", 0);
    EXPECT_EQ(files.size(), 4U + 4U) << "Four files, their index, bake.json, manifest.json, sums.";
    std::vector<Problem> problems;
    const Value list = parse(files.at("manifest.json"), problems);
    ASSERT_TRUE(problems.empty());
    ASSERT_EQ(list.find("items")->items().size(), 4U);
    for (const Value& item : list.find("items")->items()) {
        const std::string& bytes = files.at(item.find("file")->as_string());
        EXPECT_EQ(sha256_hex(bytes.data(), bytes.size()), item.find("sha256")->as_string());
        EXPECT_NE(files.at("SHA256SUMS").find(item.find("file")->as_string()), std::string::npos);
    }
}

TEST_F(Bake, SaysThatProcessesHaveNothingToDo) {
    write_manifest(R"({"path":"/v1/mushrooms/boletus_edulis.glb","count":4,"per_shard":2,
        "fixed":{"lod":3,"textures":"none"},"number":{"seed":1}})");
    EXPECT_EQ(run("set", {"--shard", "0/2"}), 0);
    EXPECT_EQ(log(), "");
    EXPECT_EQ(run("set", {"--shard", "0/3"}), 0);
    EXPECT_NE(log().find("there are 2 shards, so 1 of 3 processes have nothing to do; "
                         "\"per_shard\": 1 in the manifest gives work to all"),
              std::string::npos)
        << log();
}

TEST_F(Bake, RecordsHowAListSpellsAnAddress) {
    const std::string spelled = "/v1/mushrooms/boletus_edulis.glb?textures=none&seed=2&lod=3";
    write_manifest(spelled + "\n");
    ASSERT_EQ(run("set"), 0) << log();
    const auto files = finished("set", 0);
    const std::string& index = files.at("000000.jsonl");
    EXPECT_NE(index.find("\"listed\":\"" + spelled + "&v="), std::string::npos) << index;
    EXPECT_NE(index.find("glb?seed=2&lod=3&"), std::string::npos) << index;
}

TEST_F(Bake, EndsWithACodeThatSaysWhy) {
    ASSERT_EQ(run("one"), 0) << log();
    write_manifest(R"({"path":"/v1/mushrooms/boletus_edulis.glb","count":3,"number":{"seed":1}})");
    EXPECT_EQ(run("one"), 4);
    EXPECT_NE(log().find("is of another manifest, generator or layout"), std::string::npos)
        << log();
    EXPECT_EQ(run("two", {"--layout", "files", "--finish"}), 2);
    EXPECT_NE(log().find("there is no folder"), std::string::npos) << log();
    EXPECT_FALSE(std::filesystem::exists(folder / "two"));
    EXPECT_EQ(run("two", {"--layout", "files", "--shard", "1/2"}), 0) << "The other has all.";
    EXPECT_EQ(run("two", {"--layout", "files", "--finish"}), 3);
    EXPECT_EQ(run("two", {"--finish"}), 3) << "It checks what is there, whatever its layout.";
    EXPECT_EQ(run("two", {"--layout", "tar"}), 4) << "Another layout is another set.";
    EXPECT_EQ(run("one", {"--shard", "3/3"}), 2);
    EXPECT_NE(log().find("allowed is i/n with 0 <= i < n"), std::string::npos) << log();
    EXPECT_EQ(run("one", {"--shard", "1"}), 2);
    EXPECT_EQ(run("one", {"--layout", "zip"}), 2);
    EXPECT_NE(log().find("there are tar, files"), std::string::npos) << log();
    write_manifest(R"({"path":"/v1/mushrooms/{mix}.glb","count":3})");
    EXPECT_EQ(run("new"), 2);
    EXPECT_NE(log().find("/path: {mix} has no rule"), std::string::npos) << log();
    write_manifest(R"({"path":"/v1/mushroms/boletus_edulis.glb","count":3})");
    EXPECT_EQ(run("new"), 2) << "Nothing can be made of it.";
    write_manifest(R"({"path":"/v1/mushrooms/boletus_edulis.glb","count":3,"generator":"1"})");
    EXPECT_EQ(run("new"), 2);
    EXPECT_NE(log().find("\"1\" is not this one, which is "), std::string::npos) << log();
    EXPECT_FALSE(std::filesystem::exists(folder / "new"));
    std::filesystem::remove(folder / "m.json");
    EXPECT_EQ(run("new"), 2);
    EXPECT_NE(log().find("cannot be read"), std::string::npos) << log();
    write_manifest("/v1/mushrooms/boletus_edulis.glb?lod=3\n");
    EXPECT_EQ(run("log"), 2) << "A file is where the folder should be.";
    EXPECT_EQ(run("log/below"), 2);
    EXPECT_NE(log().find("is no folder, or is below a file"), std::string::npos) << log();
}

}  // namespace
}  // namespace sporeprint::server::bake_test
