// The options, each described once: flag, SPOREPRINT_* variable, key of the configuration file,
// range, default and help text are derived from this description.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/params/describe.h"
#include "server/http/addresses.h"

namespace sporeprint::server {

enum class LogLevel { debug, info, warning, error, off };

constexpr const char* name(LogLevel level) {
    switch (level) {
        case LogLevel::debug:
            return "debug";
        case LogLevel::info:
            return "info";
        case LogLevel::warning:
            return "warning";
        case LogLevel::error:
            return "error";
        case LogLevel::off:
            return "off";
    }
    return nullptr;
}

/// All options of the server with their defaults.
struct Options {
    Text<255> host = "127.0.0.1";
    int port = 8080;
    int cache_mb = 256;
    int image_cache_mb = 128;
    int morph_cache_mb = 16;
    int world_cache_mb = 128;
    int hot_cache_mb = 64;
    int threads = 0;
    Text<1023> atlas;
    Text<1023> assets;
    Text<1023> store;
    int store_mb = 1024;
    int terrain_mb = 512;
    Text<1023> library;
    Text<1023> sign_keys;
    Text<1023> warm;
    int client_connections = 0;
    int client_work = 0;
    int client_burst = 20'000;
    Text<1023> trusted_proxies;
    ProxyHeader proxy_header = ProxyHeader::x_forwarded_for;
    int metrics_port = 0;
    LogLevel log_level = LogLevel::info;
    Text<15> simd = "auto";
    Text<255> allow_origin = "*";
    Text<255> base_path;

    static constexpr void fields(auto visit) {
        using O = Options;
        visit(&O::host, Info{.name = "host",
                             .doc = "Name or address to listen on; 0.0.0.0 for every interface."});
        visit(&O::port, Info{.name = "port",
                             .min = 0,
                             .max = 65535,
                             .doc = "TCP port to listen on; 0 takes any that is free."});
        visit(&O::cache_mb, Info{.name = "cache_mb",
                                 .unit = "MiB",
                                 .min = 0,
                                 .max = 1048576,
                                 .doc = "Memory for finished files."});
        visit(&O::image_cache_mb, Info{.name = "image_cache_mb",
                                       .unit = "MiB",
                                       .min = 0,
                                       .max = 1048576,
                                       .doc = "Memory for painted images."});
        visit(&O::morph_cache_mb,
              Info{.name = "morph_cache_mb",
                   .unit = "MiB",
                   .min = 0,
                   .max = 1048576,
                   .doc = "Memory for what lies between shapes that are mixed."});
        visit(&O::world_cache_mb, Info{.name = "world_cache_mb",
                                       .unit = "MiB",
                                       .min = 0,
                                       .max = 1048576,
                                       .doc = "Memory for the ground of worlds, 2 MB each."});
        visit(&O::hot_cache_mb, Info{.name = "hot_cache_mb",
                                     .unit = "MiB",
                                     .min = 0,
                                     .max = 1048576,
                                     .doc = "Memory for answers that are given again at once."});
        visit(&O::threads,
              Info{.name = "threads",
                   .min = 0,
                   .max = 1024,
                   .doc = "Files made at once; 0 takes as many as there are processors."});
        visit(&O::atlas,
              Info{.name = "atlas",
                   .doc = "Folder of templates, of further kinds in subfolders, that replace "
                          "those compiled in."});
        visit(&O::assets,
              Info{.name = "assets",
                   .doc = "Folder of the built page; found beside the program by itself."});
        visit(&O::store,
              Info{.name = "store",
                   .doc = "Folder that finished files are kept in for the next start; none by "
                          "itself. Made if it is missing."});
        visit(&O::store_mb, Info{.name = "store_mb",
                                 .unit = "MiB",
                                 .min = 1,
                                 .max = 1048576,
                                 .doc = "Room for the files of that folder."});
        visit(&O::terrain_mb, Info{.name = "terrain_mb",
                                   .unit = "MiB",
                                   .min = 128,
                                   .max = 1048576,
                                   .doc = "Room for terrains that clients send, in that folder "
                                          "too, and again for scenes; those that were used least "
                                          "lately make room."});
        visit(
            &O::library,
            Info{.name = "library",
                 .doc = "Database of what users store: a file of SQLite, made if it is missing, or "
                        "postgres://user@host/database; none by itself."});
        visit(&O::sign_keys,
              Info{.name = "sign_keys",
                   .doc = "File of keys, \"ID HEX\" a line, of which addresses of what is made "
                          "have to carry a signature; none for open addresses."});
        visit(&O::warm, Info{.name = "warm",
                             .doc = "File of addresses, path and query, one a line, that are made "
                                    "at start before it is ready; none by itself."});
        visit(&O::client_connections,
              Info{.name = "client_connections",
                   .min = 0,
                   .max = 1048576,
                   .doc = "Connections that one address (of IPv6 its /64) may have open; 0 for as "
                          "many as there are."});
        visit(&O::client_work,
              Info{.name = "client_work",
                   .unit = "ms/s",
                   .min = 0,
                   .max = 1000000,
                   .doc = "Work that may be done for one client, in milliseconds of one processor "
                          "a second by estimate; 0 for any. What is kept costs nothing."});
        visit(&O::client_burst,
              Info{.name = "client_burst",
                   .unit = "ms",
                   .min = 1,
                   .max = 1000000000,
                   .doc = "Work that a client which has asked for nothing for long may have done "
                          "at once."});
        visit(&O::trusted_proxies,
              Info{.name = "trusted_proxies",
                   .doc = "Networks of proxies that are believed whom they ask for, as in "
                          "10.0.0.0/8,2001:db8::/32; nobody by itself."});
        visit(&O::proxy_header,
              Info{.name = "proxy_header",
                   .doc = "The one header in which they say so; the other is never looked at."});
        visit(&O::metrics_port,
              Info{.name = "metrics_port",
                   .min = 0,
                   .max = 65535,
                   .doc = "Port of its own for /metrics; 0 answers it on the main port."});
        visit(&O::log_level, Info{.name = "log_level", .doc = "Least level that is logged."});
        visit(&O::simd,
              Info{.name = "simd", .doc = "Instruction set to use; the bytes made are the same."});
        visit(&O::allow_origin,
              Info{.name = "allow_origin",
                   .doc = "Access-Control-Allow-Origin of every answer: *, or one origin as a "
                          "browser sends it, https://a.example; empty sends none."});
        visit(&O::base_path,
              Info{.name = "base_path",
                   .doc = "Path under which clients see the service, as in /sporeprint: links are "
                          "told with it, requests are answered with it and without; none by "
                          "itself."});
    }

    /// Checks the options whose rules are more than a range.
    void check(const std::string& path, std::vector<Problem>& problems) const;
    bool operator==(const Options&) const = default;
};

static_assert(well_described<Options>());

/// Names and texts of the options given, in order.
using Given = std::vector<std::pair<std::string, std::string>>;

/// One option as --help shows it.
struct OptionLine {
    std::string name;      ///< "cache_mb", the key of the file
    std::string flag;      ///< "--cache-mb"
    std::string variable;  ///< "SPOREPRINT_CACHE_MB"
    std::string help;      ///< with the allowed values and the default
};
[[nodiscard]] std::vector<OptionLine> option_lines();

/// The SPOREPRINT_* variables, sorted by use.
struct Environment {
    Given options;       ///< the non-empty ones, by option name
    std::string config;  ///< SPOREPRINT_CONFIG
    /// names of those that Kubernetes injects for a Service whose name begins with "sporeprint"
    std::vector<std::string> service_links;
    /// all others, "SPOREPRINT_PROT; did you mean 'SPOREPRINT_PORT'?"
    std::vector<std::string> unknown;
};

/// Sorts the variables of a process into options, those injected by Kubernetes, and unknown ones.
///
/// variables  name and value of each, as in environ; those without SPOREPRINT_ prefix are ignored
[[nodiscard]] Environment environment_from(const Given& variables);

/// Returns true if a variable is one that Kubernetes injects into every container for a Service of
/// its namespace whose name begins with "sporeprint", unless the pod has
/// `enableServiceLinks: false`. In the grammar of RFC 5234, with the required values as comments:
///
///     service = "SPOREPRINT" *("_" 1*(ALPHA / DIGIT))
///     name    = service "_SERVICE_HOST"                    ; an IP address
///             / service "_SERVICE_PORT" ["_" port-name]    ; 1..65535
///             / service "_PORT"                            ; tcp://10.0.0.1:8080
///             / service "_PORT_" 1*DIGIT "_" ("TCP" / "UDP" / "SCTP")  ; the same
///                 ["_PROTO" / "_PORT" / "_ADDR"]           ; tcp, 8080 or 10.0.0.1
[[nodiscard]] bool is_service_link(std::string_view name, std::string_view value);

/// Merges all sources of options: a flag overrides a variable, a variable overrides the file.
///
/// file_name    for messages
/// file         text of the configuration file, a JSON object; empty for none
/// environment  by option name
/// flags        by option name
/// throws       InvalidInput with every problem: its path is the flag, variable, or file and key;
///              its message has the value and the allowed values
[[nodiscard]] Options options_from(const std::string& file_name, std::string_view file,
                                   const Given& environment, const Given& flags);

/// Formats the options as a configuration file.
[[nodiscard]] std::string config_text(const Options& options);

}  // namespace sporeprint::server
