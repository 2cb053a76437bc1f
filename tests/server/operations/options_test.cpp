#include "server/operations/options.h"

#include <gtest/gtest.h>

#include <set>

#include "core/problems.h"

namespace sporeprint::server::operations_options_test {
namespace {

Options read(std::string_view file, const Given& environment = {}, const Given& flags = {}) {
    return options_from("my.json", file, environment, flags);
}

/// Returns every problem as "path: message".
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
    EXPECT_EQ(options.world_cache_mb, 128);
}

TEST(Options, AFlagOverridesAVariableWhichOverridesTheFile) {
    const std::string_view file = R"({"port": 1, "cache_mb": 11, "threads": 21})";
    const Given environment = {{"port", "2"}, {"cache_mb", "12"}};
    const Options options = read(file, environment, {{"port", "3"}, {"log_level", "error"}});
    EXPECT_EQ(options.port, 3);
    EXPECT_EQ(options.cache_mb, 12);
    EXPECT_EQ(options.threads, 21);
    EXPECT_EQ(options.image_cache_mb, 128);
    EXPECT_EQ(options.log_level, LogLevel::error);
}

TEST(Options, RoundTripThroughAFile) {
    const Options options =
        read("", {}, {{"host", "::1"}, {"atlas", "/a b"}, {"allow_origin", "https://a.example"}});
    EXPECT_EQ(read(config_text(options)), options);
    EXPECT_EQ(read(config_text(Options{})), Options{});
}

TEST(Options, AProblemNamesTheOptionItsValueAndTheAllowedValues) {
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
        << "all problems are reported at once";
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

TEST(Options, CheckTheBasePath) {
    for (const char* good : {"", "/a", "/sporeprint", "/a/b-c/d.e_f~g", "/%7Ejo/x%2F", "/a:b@c,d"})
        EXPECT_EQ(read("", {}, {{"base_path", good}}).base_path.string(), good);
    const std::vector<std::pair<const char*, const char*>> bad = {
        {"a", "does not begin with '/'"},
        {"/", "ends with '/'"},
        {"/a/", "ends with '/'"},
        {"/a//b", "has an empty segment"},
        {"/a/../b", "has an empty segment, '.' or '..'"},
        {"/.", "has an empty segment, '.' or '..'"},
        {"/a?b", "has a query or a fragment"},
        {"/a#b", "has a query or a fragment"},
        {"/a%2", "has a '%' without two hexadecimal digits"},
        {"/a%zz", "has a '%' without two hexadecimal digits"},
        {"/a b", "holds what has to be percent-encoded"},
        {"/\xc3\xa4", "holds what has to be percent-encoded"},
        {"/a\"b", "holds what has to be percent-encoded"}};
    for (const auto& [text, why] : bad) {
        const std::vector<std::string> problems = problems_of("", {}, {{"base_path", text}});
        ASSERT_EQ(problems.size(), 1U) << text;
        EXPECT_EQ(problems[0].find("--base-path: "), 0U) << problems[0];
        EXPECT_NE(problems[0].find(why), std::string::npos) << problems[0];
        EXPECT_NE(problems[0].find("give one like /sporeprint"), std::string::npos);
    }
}

TEST(Options, AllowOneSerializedOrigin) {
    const auto allowed = [](const std::string& origin) {
        return problems_of("", {}, {{"allow_origin", origin}}).empty();
    };
    for (const char* origin :
         {"", "*", "https://a.example", "http://localhost:8080", "https://xn--bcher-kva.example",
          "http://192.0.2.1:81", "http://[2001:db8::1]", "https://[2001:db8::1]:8443",
          "http://a.example:443", "capacitor://localhost", "chrome-extension://abcdef"})
        EXPECT_TRUE(allowed(origin)) << origin;
    for (const char* origin : {"foo",
                               "null",
                               "a.example",
                               "https://",
                               "https://a.example/",
                               "https://a.example/x",
                               "https://a.example?x",
                               "https://A.example",
                               "HTTPS://a.example",
                               "https://a.example:443",
                               "http://a.example:80",
                               "https://a.example:",
                               "https://a.example:0",
                               "https://a.example:08",
                               "https://a.example:65536",
                               "https://a.example:+1",
                               "https://user@a.example",
                               "https://*.example",
                               "https://a.example https://b.example",
                               "https://a.example,https://b.example",
                               "https://b\xc3\xbc.example",
                               "https://.example",
                               "https://a..example",
                               "http://[::1",
                               "http://[2001:DB8::1]",
                               "http://[1.2.3.4]",
                               "://a.example",
                               "1a://b",
                               "*\r\nX-Evil: 1",
                               "https://a.example\n"})
        EXPECT_FALSE(allowed(origin)) << origin;
    EXPECT_EQ(problems_of("", {}, {{"allow_origin", "foo"}})[0].substr(0, 38),
              "--allow-origin: 'foo' is not an origin");
}

TEST(Options, AreReadFromTheEnvironment) {
    const Environment environment = environment_from({{"SPOREPRINT_IMAGE_CACHE_MB", "7"},
                                                      {"SPOREPRINT_HOST", ""},
                                                      {"SPOREPRINT_CONFIG", "/a"},
                                                      {"PORT", "1"},
                                                      {"sporeprint_port", "2"}});
    EXPECT_EQ(environment.options, (Given{{"image_cache_mb", "7"}}));
    EXPECT_EQ(environment.config, "/a");
    EXPECT_TRUE(environment.unknown.empty() && environment.service_links.empty());
}

TEST(Options, UnknownVariablesAreReportedWithSuggestions) {
    const Environment environment = environment_from(
        {{"SPOREPRINT_PROT", "9000"}, {"SPOREPRINT_", "x"}, {"SPOREPRINT_URL", ""}});
    EXPECT_TRUE(environment.options.empty());
    EXPECT_EQ(environment.unknown,
              (std::vector<std::string>{"SPOREPRINT_PROT; did you mean 'SPOREPRINT_PORT'?",
                                        "SPOREPRINT_", "SPOREPRINT_URL"}));
}

// As kubelet generates them: pkg/kubelet/envvars of Kubernetes.
TEST(Options, VariablesOfAKubernetesServiceAreIgnored) {
    const Given injected = {{"SPOREPRINT_SERVICE_HOST", "10.0.0.1"},
                            {"SPOREPRINT_SERVICE_PORT", "8080"},
                            {"SPOREPRINT_SERVICE_PORT_HTTP", "8080"},
                            {"SPOREPRINT_PORT", "tcp://10.0.0.1:8080"},
                            {"SPOREPRINT_PORT_8080_TCP", "tcp://10.0.0.1:8080"},
                            {"SPOREPRINT_PORT_8080_TCP_PROTO", "tcp"},
                            {"SPOREPRINT_PORT_8080_TCP_PORT", "8080"},
                            {"SPOREPRINT_PORT_8080_TCP_ADDR", "10.0.0.1"},
                            {"SPOREPRINT_PORT_53_UDP", "udp://10.0.0.1:53"},
                            {"SPOREPRINT_PORT_9_SCTP_PROTO", "sctp"},
                            {"SPOREPRINT_METRICS_PORT", "tcp://[fd00::1]:9090"},
                            {"SPOREPRINT_METRICS_SERVICE_HOST", "fd00::1"},
                            {"SPOREPRINT_METRICS_SERVICE_PORT_PLAIN_TEXT", "9090"},
                            {"SPOREPRINT_MY_2_PORT_9090_TCP_ADDR", "fd00::1"},
                            {"SPOREPRINT_SERVICE_PORT", "tcp://10.0.0.1:8080"}};
    Environment environment = environment_from(injected);
    std::vector<std::string> names;
    for (const auto& [name, value] : injected) names.push_back(name);
    EXPECT_EQ(environment.service_links, names);
    EXPECT_TRUE(environment.unknown.empty());
    EXPECT_EQ(read("", environment.options), Options{});

    // Slightly different ones are treated as set by the operator: a wrong value, or an unknown
    // name.
    for (const char* value : {"tcp://", "tcp://10.0.0.1", "tcp://10.0.0.1:", "tcp://10.0.0.1:0",
                              "tcp://10.0.0.1:x", "tcp://10.0.0.1:80/", "http://10.0.0.1:80",
                              "tcp://a.example:80", "tcp://fd00::1:80", "tcp://[10.0.0.1]:80",
                              "TCP://10.0.0.1:80", "tcp//10.0.0.1:80", "x", " tcp://10.0.0.1:80"}) {
        EXPECT_FALSE(is_service_link("SPOREPRINT_PORT", value)) << value;
        environment = environment_from({{"SPOREPRINT_PORT", value}});
        EXPECT_EQ(problems_of("", environment.options).size(), 1u) << value;
    }
    const Given others = {{"SPOREPRINT_SERVICE_HOST", "a.example"},
                          {"SPOREPRINT_SERVICE_PORT", "http"},
                          {"SPOREPRINT_SERVICE_PORT_", "80"},
                          {"SPOREPRINT_SERVICE_PORT_http", "80"},
                          {"SPOREPRINT_PORT_TCP", "tcp://10.0.0.1:80"},
                          {"SPOREPRINT_PORT_80_TCP_HOST", "10.0.0.1"},
                          {"SPOREPRINT_PORT_80_QUIC", "tcp://10.0.0.1:80"},
                          {"SPOREPRINT_PORT_80_TCP_PROTO", "TCP"},
                          {"SPOREPRINT__SERVICE_HOSTS", "10.0.0.1"},
                          {"SPOREPRINT_x_SERVICE_HOST", "10.0.0.1"}};
    for (const auto& [name, value] : others) EXPECT_FALSE(is_service_link(name, value)) << name;
    EXPECT_EQ(environment_from(others).unknown.size(), others.size());
    EXPECT_EQ(environment_from({{"SPOREPRINT_PORT", "9000"}}).options, (Given{{"port", "9000"}}));
}

TEST(Options, HaveHelpTexts) {
    std::set<std::string> flags;
    for (const OptionLine& line : option_lines()) {
        EXPECT_TRUE(flags.insert(line.flag).second);
        EXPECT_GT(line.help.size(), 10u);
    }
    for (const char* flag : {"--host",
                             "--port",
                             "--cache-mb",
                             "--image-cache-mb",
                             "--morph-cache-mb",
                             "--world-cache-mb",
                             "--threads",
                             "--atlas",
                             "--assets",
                             "--metrics-port",
                             "--log-level",
                             "--simd",
                             "--allow-origin",
                             "--client-connections",
                             "--client-work",
                             "--client-burst",
                             "--trusted-proxies",
                             "--proxy-header",
                             "--warm",
                             "--base-path"})
        EXPECT_TRUE(flags.contains(flag)) << flag;
}

}  // namespace
}  // namespace sporeprint::server::operations_options_test
