#include "server/options.h"

#include <gtest/gtest.h>

#include <set>

#include "core/params/problems.h"

namespace sporeprint::server {
namespace {

Options read(std::string_view file, const Given& environment = {}, const Given& flags = {}) {
    return options_from("my.json", file, environment, flags);
}

/// Every problem as "path: message".
std::vector<std::string> problems_of(std::string_view file, const Given& environment = {},
                                     const Given& flags = {}) {
    std::vector<std::string> all;
    try {
        read(file, environment, flags);
    } catch (const InvalidInput& invalid) {
        for (const Problem& problem : invalid.problems())
            all.push_back(problem.path + ": " + problem.message);
    }
    return all;
}

TEST(Options, HaveDefaults) {
    const Options options = read("");
    EXPECT_EQ(options, Options{});
    EXPECT_EQ(options.host.view(), "127.0.0.1");
    EXPECT_EQ(options.port, 8080);
    EXPECT_EQ(options.cache_mb, 256);
    EXPECT_EQ(options.image_cache_mb, 128);
    EXPECT_EQ(options.morph_cache_mb, 16);
}

TEST(Options, AFlagWinsOverAVariableAndThatOverTheFile) {
    const std::string_view file = R"({"port": 1, "cache_mb": 11, "threads": 21})";
    const Given environment = {{"port", "2"}, {"cache_mb", "12"}};
    const Options options = read(file, environment, {{"port", "3"}, {"log_level", "error"}});
    EXPECT_EQ(options.port, 3);
    EXPECT_EQ(options.cache_mb, 12);
    EXPECT_EQ(options.threads, 21);
    EXPECT_EQ(options.image_cache_mb, 128);
    EXPECT_EQ(options.log_level, LogLevel::error);
}

TEST(Options, AreWrittenAsAFileThatReadsBack) {
    const Options options =
        read("", {}, {{"host", "::1"}, {"atlas", "/a b"}, {"allow_origin", "https://a.example"}});
    EXPECT_EQ(read(config_text(options)), options);
    EXPECT_EQ(read(config_text(Options{})), Options{});
}

TEST(Options, AProblemNamesTheOptionItsValueAndWhatIsAllowed) {
    using Lines = std::vector<std::string>;
    EXPECT_EQ(problems_of("", {}, {{"port", "99999"}}), Lines{"--port: 99999 is outside 0..65535"});
    EXPECT_EQ(problems_of("", {{"cache_mb", "-1"}}),
              Lines{"SPOREPRINT_CACHE_MB: -1 is outside 0..1048576"});
    EXPECT_EQ(problems_of(R"({"threads": 1.5})"),
              Lines{"my.json: threads: expected a whole number, got 1.5"});
    EXPECT_EQ(problems_of("", {}, {{"port", "http"}}),
              Lines{"--port: expected a whole number, got 'http'"});
    EXPECT_EQ(problems_of("", {}, {{"log_level", "loud"}}).size(), 1u);
    EXPECT_NE(problems_of("", {}, {{"log_level", "loud"}})[0].find("debug, info, warning"),
              std::string::npos);
    EXPECT_NE(problems_of(R"({"prot": 1})")[0].find("did you mean 'port'"), std::string::npos);
    EXPECT_EQ(problems_of(R"({"port": 1, "port": 2})").size(), 1u) << "repeated";
    EXPECT_EQ(problems_of("{").size(), 1u);
    EXPECT_EQ(problems_of(R"({"port": 70000})", {{"threads", "x"}}, {{"host", ""}}).size(), 2u)
        << "all that is wrong is told at once";
    EXPECT_EQ(problems_of("", {}, {{"host", ""}}).size(), 1u);
    EXPECT_EQ(problems_of("", {}, {{"host", "a b"}}).size(), 1u);
    EXPECT_EQ(problems_of("", {}, {{"allow_origin", "*\r\nX-Evil: 1"}}).size(), 1u);
    EXPECT_EQ(problems_of("", {}, {{"port", "9000"}, {"metrics_port", "9000"}}),
              Lines{"--metrics-port: 9000 is the main port too; allowed is any other"});
    EXPECT_EQ(problems_of("", {}, {{"trusted_proxies", "10.0.0.0/8, 10.0.0.1/8"}}),
              Lines{"--trusted-proxies: '10.0.0.1/8' has bits beyond its length; a network is "
                    "written with zeros there"});
    EXPECT_EQ(problems_of("", {}, {{"proxy_header", "x-real-ip"}}).size(), 1u);
}

TEST(Options, ComeFromTheEnvironmentByTheirOwnNamesOnly) {
    const Given given = given_by_environment([](const char* name) -> const char* {
        const std::string_view wanted = name;
        if (wanted == "SPOREPRINT_IMAGE_CACHE_MB") return "7";
        if (wanted == "SPOREPRINT_HOST") return "";
        return nullptr;
    });
    EXPECT_EQ(given, (Given{{"image_cache_mb", "7"}}));
}

TEST(Options, EachHasHelp) {
    std::set<std::string> flags;
    for (const OptionLine& line : option_lines()) {
        EXPECT_TRUE(flags.insert(line.flag).second);
        EXPECT_GT(line.help.size(), 10u);
    }
    for (const char* flag :
         {"--host", "--port", "--cache-mb", "--image-cache-mb", "--morph-cache-mb", "--threads",
          "--atlas", "--assets", "--metrics-port", "--log-level", "--simd", "--allow-origin",
          "--client-connections", "--client-work", "--client-burst", "--trusted-proxies",
          "--proxy-header", "--warm"})
        EXPECT_TRUE(flags.contains(flag)) << flag;
}

}  // namespace
}  // namespace sporeprint::server
