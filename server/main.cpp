// The program: reads the options and runs the service until SIGTERM or SIGINT.
#include <pthread.h>
#include <signal.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "api/batch/version.h"
#include "api/cache/directory_store.h"
#include "api/service.h"
#include "core/math/noise.h"
#include "server/bake/bake.h"
#include "server/http/transport.h"
#include "server/operations/health.h"
#include "server/operations/log.h"
#include "server/operations/machine.h"
#include "server/operations/metrics.h"
#include "server/operations/options.h"
#include "server/operations/signatures.h"
#include "server/operations/text_files.h"
#include "server/records/administration.h"
#include "server/records/open.h"
#include "server/records/watch.h"
#include "server/reload.h"
#include "server/request_handler.h"
#include "server/warm.h"

namespace {

using namespace sporeprint;
using namespace sporeprint::server;

constexpr int wrong_usage = 2, failed = 1, fine = 0;

int complain(const std::string& sentence, int code) {
    std::fprintf(stderr, "sporeprint: %s\n", sentence.c_str());
    return code;
}

/// Returns the text of the configuration file; empty if no file is named.
///
/// throws  std::runtime_error if it cannot be read
std::string config_text(const std::string& file) {
    if (file.empty()) return {};
    if (std::optional<std::string> text = read_text(file)) return *std::move(text);
    throw std::runtime_error("--config: " + file + " cannot be read");
}

/// Returns the folder of the built page: the one given, or that of the build or installation.
std::filesystem::path page_folder(const Options& options) {
    namespace fs = std::filesystem;
    if (!options.assets.empty()) return options.assets.string();
    const fs::path here = program_folder();
    std::error_code ignored;
    for (const fs::path& folder :
         {here / "../../../web_viewer/dist", here / "../share/sporeprint/web_viewer",
          here / "web_viewer", fs::path("/usr/share/sporeprint/web_viewer")})
        if (fs::exists(folder / "index.html", ignored)) return fs::canonical(folder, ignored);
    return {};
}

bool is_loopback(std::string_view host) {
    return host == "localhost" || host == "::1" || host.starts_with("127.");
}

std::string url_of(std::string_view host, int port) {
    const bool bare_v6 = host.find(':') != std::string_view::npos;
    return "http://" + (bare_v6 ? '[' + std::string(host) + ']' : std::string(host)) + ':' +
           std::to_string(port) + '/';
}

/// Returns the generator version that the API reports at /v1.
std::string generator_version(api::Service& service) {
    api::Request request;
    request.method = "GET";
    request.target = "/v1";
    const api::Plan planned = service.plan(request, service.route(request));
    const auto* response = std::get_if<api::Response>(&planned);
    if (!response || response->body.empty()) return "unknown";
    const Slice& slice = response->body.front();
    std::vector<Problem> ignored;
    const Value about = parse({reinterpret_cast<const char*>(slice.data()), slice.size}, ignored);
    const Value* version = about.find("generator_version");
    if (!version) return "unknown";
    return version->is_string() ? version->as_string() : dump(*version);
}

/// Waits for one of these signals, which all threads have blocked. Returns 0 after the timeout.
int next_signal(const sigset_t& signals, std::chrono::milliseconds timeout) {
    const timespec time{timeout.count() / 1000, (timeout.count() % 1000) * 1'000'000};
    return std::max(sigtimedwait(&signals, nullptr, &time), 0);
}

/// Returns true if SIGTERM or SIGINT, both blocked, is pending.
bool is_stop_requested() {
    sigset_t waiting;
    return sigpending(&waiting) == 0 &&
           (sigismember(&waiting, SIGTERM) == 1 || sigismember(&waiting, SIGINT) == 1);
}

/// Prints the URL of the service, and warnings about its configuration.
void announce(const Options& options, bool has_page, int port) {
    if (!is_loopback(options.host) && options.sign_keys.empty())
        std::fprintf(stderr,
                     "sporeprint: WARNING: listening on %s, beyond this machine, unsigned:\n"
                     "sporeprint: WARNING: anyone who can reach this port can have anything made. "
                     "Give --sign-keys a file, or put a reverse proxy in front.\n",
                     options.host.string().c_str());
    if (!has_page)
        std::fprintf(stderr, "sporeprint: the page is not built; the API is served without it\n");
    std::printf("Sporeprint is ready at %s\n", url_of(options.host, port).c_str());
    std::fflush(stdout);
}

/// Returns the library that the options name; nullptr for none.
///
/// throws  api::Unavailable, InvalidInput
std::shared_ptr<api::Library> library_of(const Options& options) {
    if (options.library.empty()) return nullptr;
    return std::make_shared<api::Library>(open_records(options.library.view()), seconds_since_1970);
}

/// Gives the operator of a service with an empty library the means to write to it. The token is in a fragment,
/// which browsers send to nobody.
void announce_first_token(api::Library& library, const Options& options, int port) {
    if (const std::optional<std::string> token = first_token(library.records(), library.now())) {
        std::printf(
            "The library is empty; its first owner is %s. Open this once:\n%seditor#token=%s\n",
            first_owner, url_of(options.host, port).c_str(), token->c_str());
        std::fflush(stdout);
    }
}

/// Returns the environment variables of this process.
Given variables_of_process() {
    Given variables;
    for (char* const* one = environ; *one; ++one) {
        const std::string_view line = *one;
        const std::size_t equals = line.find('=');
        if (equals != line.npos)
            variables.emplace_back(line.substr(0, equals), line.substr(equals + 1));
    }
    return variables;
}

Value list_of(const std::vector<std::string>& texts) {
    Value::Array list;
    for (const std::string& text : texts) list.emplace_back(text);
    return Value(std::move(list));
}

/// Logs the variables that have no effect.
void report_ignored(const Environment& environment, Log& log) {
    if (!environment.service_links.empty())
        log.event(LogLevel::info,
                  "variables that Kubernetes injects for a Service of this name are ignored; "
                  "'enableServiceLinks: false' in the pod's spec leaves them out",
                  {{"variables", list_of(environment.service_links)}});
    if (!environment.unknown.empty())
        log.event(LogLevel::warning, "unknown SPOREPRINT_* variables are ignored",
                  {{"variables", list_of(environment.unknown)}});
}

/// Returns the text of a file named by an option.
///
/// throws  InvalidInput if it cannot be read
std::string text_of_option(const std::string& flag, const std::string& file) {
    if (std::optional<std::string> text = read_text(file)) return *std::move(text);
    throw InvalidInput(flag, file + " cannot be read; allowed is the path of a file");
}

/// Blocks the signals that end or reload the service in this thread and all that it creates later.
sigset_t blocked_signals() {
    sigset_t signals;
    sigemptyset(&signals);
    sigaddset(&signals, SIGTERM);
    sigaddset(&signals, SIGINT);
    sigaddset(&signals, SIGHUP);
    pthread_sigmask(SIG_BLOCK, &signals, nullptr);
    signal(SIGPIPE, SIG_IGN);
    return signals;
}

/// Returns the options of the service. Events of its store are logged.
///
/// unwritten  must outlive the service, as must `log`
api::ServiceOptions service_options_of(const Options& options, RepeatedWarning& unwritten,
                                       Log& log) {
    api::ServiceOptions result;
    result.store_event = [&](const api::StoreEvent& event) {
        Value::Object about = {{"file", Value(event.file.string())}, {"why", Value(event.why)}};
        if (event.kind == api::StoreEvent::Kind::unwritten) return unwritten(std::move(about));
        if (event.kind == api::StoreEvent::Kind::bound)
            return log.event(LogLevel::warning, "the bound of the store's folder is another one",
                             about);
        about.emplace_back("files", Value(static_cast<double>(event.files)));
        log.event(LogLevel::warning,
                  "files in the store's folder that are not its own are left alone and not counted",
                  about);
    };
    result.cache_bytes = static_cast<std::size_t>(options.cache_mb) << 20;
    result.image_cache_bytes = static_cast<std::size_t>(options.image_cache_mb) << 20;
    result.morph_cache_bytes = static_cast<std::size_t>(options.morph_cache_mb) << 20;
    result.world_cache_bytes = static_cast<std::size_t>(options.world_cache_mb) << 20;
    result.assets = page_folder(options);
    result.store = options.store.string();
    result.store_bytes = static_cast<std::uint64_t>(options.store_mb) << 20;
    result.terrain_bytes = static_cast<std::uint64_t>(options.terrain_mb) << 20;
    result.signed_urls = !options.sign_keys.empty();
    result.allow_origin = options.allow_origin.string();
    result.base_path = options.base_path.string();
    return result;
}

/// Returns how many files are made at once.
std::size_t threads_of(const Options& options) {
    return options.threads > 0 ? static_cast<std::size_t>(options.threads) : granted_processors();
}

RequestHandlerOptions request_handler_options_of(const Options& options) {
    RequestHandlerOptions result;
    result.threads = threads_of(options);
    result.metrics = options.metrics_port == 0;
    result.base_path = options.base_path.string();
    result.budget.rate = static_cast<std::uint64_t>(options.client_work) * 1000;
    result.budget.burst = static_cast<std::uint64_t>(options.client_burst) * 1000;
    return result;
}

TransportOptions transport_options_of(const Options& options) {
    TransportOptions result;
    result.host = options.host.string();
    result.port = options.port;
    result.most_of_client = static_cast<std::size_t>(options.client_connections);
    result.proxies = {Networks(options.trusted_proxies), options.proxy_header};
    result.hot_bytes = static_cast<std::size_t>(options.hot_cache_mb) << 20;
    result.workers = std::max<std::size_t>(granted_processors(), 4);
    return result;
}

/// Returns the options of the port for metrics, which few clients use.
TransportOptions metrics_transport_options_of(const Options& options) {
    TransportOptions result = transport_options_of(options);
    result.port = options.metrics_port;
    result.workers = 2;
    result.most_connections = 64;
    result.most_of_client = 0;
    return result;
}

/// Waits until both transports have sent their last responses; a second signal ends the program at
/// once.
void drain_transports(Transport& transport, std::optional<Transport>& metrics_transport,
                      const sigset_t& signals) {
    std::atomic<bool> drained{false};
    const std::jthread drain([&] {
        transport.drain();
        if (metrics_transport) metrics_transport->drain();
        drained = true;
    });
    while (!drained)
        if (const int signal = next_signal(signals, std::chrono::milliseconds(20));
            signal == SIGTERM || signal == SIGINT)
            _exit(failed);
}

/// Runs the service until SIGTERM or SIGINT, and returns the exit code. One function, because the
/// order in which its parts are constructed is the order in which they depend on each other.
int serve(const Options& options, const Environment& environment) {
    const sigset_t signals = blocked_signals();
    Log log(options.log_level);
    report_ignored(environment, log);
    std::string warm_list;
    if (!options.warm.empty()) warm_list = text_of_option("--warm", options.warm.string());
    raise_descriptor_limit();
    force_simd(options.simd);
    const std::shared_ptr<const Atlas> atlas =
        options.atlas.empty() ? built_in_atlas() : atlas_from(options.atlas.string());

    RepeatedWarning unwritten(log,
                              "finished files cannot be written to the store; they are served, and "
                              "made anew after a restart",
                              std::chrono::minutes(1));
    const api::ServiceOptions service_options = service_options_of(options, unwritten, log);
    const std::shared_ptr<api::Library> library = library_of(options);
    std::optional<LibraryWatch> watch;
    if (library) watch.emplace(library, log, std::chrono::seconds(2));
    AppState state;
    state.service = std::make_shared<api::Service>(atlas, service_options, library);
    const RequestHandlerOptions request_handler_options = request_handler_options_of(options);
    const Sources sources{options.atlas.string(), options.sign_keys.string()};
    if (!sources.keys.empty())
        state.signatures = std::make_shared<const Signatures>(Signatures::from_file(sources.keys));
    Metrics metrics(SPOREPRINT_VERSION, generator_version(*state.service));
    RequestHandler request_handler(state, metrics, log, request_handler_options);
    Transport transport(transport_options_of(options), request_handler.handlers());
    std::optional<Transport> metrics_transport;
    if (options.metrics_port != 0)
        metrics_transport.emplace(metrics_transport_options_of(options),
                                  request_handler.metrics_handlers());
    request_handler.watch(&transport);
    if (!state.service->self_test())
        return complain("the first thing made for a test could not be made; not starting", failed);
    transport.start();
    if (metrics_transport) metrics_transport->start();
    if (!options.warm.empty())
        warm(options.warm.string(), warm_list, request_handler, log, is_stop_requested);
    if (!is_stop_requested()) {
        request_handler.open();
        announce(options, !service_options.assets.empty(), transport.port());
        if (library) announce_first_token(*library, options, transport.port());
        log.event(LogLevel::info, "ready",
                  {{"version", Value(SPOREPRINT_VERSION)},
                   {"port", Value(transport.port())},
                   {"slots", Value(request_handler_options.threads)}});
    }

    state = {};  // from here on owned by the request handler only, so that a reload frees it
    for (int signal = 0; signal != SIGTERM && signal != SIGINT;) {
        signal = next_signal(signals, std::chrono::hours(1));
        if (signal == SIGHUP && reload(sources, request_handler, log)) transport.invalidate();
    }
    log.event(LogLevel::info, "stopping: no new connections, finishing what has begun");
    request_handler.close();
    drain_transports(transport, metrics_transport, signals);
    log.event(LogLevel::info, "stopped");
    return fine;
}

/// Does what `sporeprint bake ...` says; returns the exit code.
int bake_set(const BakeCommand& command, const Options& options) {
    blocked_signals();
    Log log(options.log_level);
    force_simd(options.simd);
    const std::shared_ptr<const Atlas> atlas =
        options.atlas.empty() ? built_in_atlas() : atlas_from(options.atlas.string());
    RepeatedWarning unwritten(log, "finished files cannot be written to the store",
                              std::chrono::minutes(1));
    api::ServiceOptions service_options = service_options_of(options, unwritten, log);
    // No file is made twice.
    service_options.cache_bytes = 0;
    service_options.store.clear();
    api::Service service(atlas, service_options, library_of(options));
    return static_cast<int>(
        bake(command, service, api::version_of(*atlas), threads_of(options), is_stop_requested));
}

/// The values of --sign and related flags.
struct SigningRequest {
    std::string target;
    std::string method = "GET";
    std::string body;          ///< file of the body of a POST, "-" for standard input
    std::int64_t seconds = 0;  ///< of validity from now on; 0: it does not expire
};

/// Reads standard input to its end.
///
/// throws  std::runtime_error if it cannot be read
std::string standard_input() {
    std::string text;
    std::array<char, 65536> block{};
    while (const std::size_t got = std::fread(block.data(), 1, block.size(), stdin))
        text.append(block.data(), got);
    if (std::ferror(stdin) != 0)
        throw std::runtime_error("--sign-body: cannot read standard input");
    return text;
}

/// Prints a target with the signature of the first key.
int sign(const Options& options, const SigningRequest& requested) {
    const std::string& target = requested.target;
    if (options.sign_keys.empty())
        return complain("--sign needs --sign-keys, the file of keys", wrong_usage);
    if (!target.starts_with('/'))
        return complain("--sign takes path and query, all of an address after its host",
                        wrong_usage);
    const bool is_post = requested.method == "POST";
    if (is_post && requested.body.empty())
        return complain("--sign-method POST needs --sign-body, as the signature covers the body",
                        wrong_usage);
    if (!is_post && !requested.body.empty())
        return complain("--sign-body needs --sign-method POST; no other method has a body",
                        wrong_usage);
    std::string body;
    if (requested.body == "-") {
        body = standard_input();
    } else if (is_post) {
        std::optional<std::string> text = read_text(requested.body);
        if (!text) return complain("--sign-body: " + requested.body + " cannot be read", failed);
        body = *std::move(text);
    }
    std::optional<std::int64_t> expires;
    if (requested.seconds > 0) expires = seconds_since_1970() + requested.seconds;
    const auto signatures = Signatures::from_file(options.sign_keys.string());
    std::printf("%s\n", signatures.signed_target(requested.method, target, body, expires).c_str());
    return fine;
}

/// Flags that only the command line has.
struct CommandLine {
    std::string config, health;
    bool print_config = false;
    SigningRequest to_sign;
    LibraryCommand library;
    BakeCommand bake;
};

/// Adds `bake MANIFEST`. It ends the program.
void add_bake_command(CLI::App& app, BakeCommand& command) {
    CLI::App* const bake = app.add_subcommand(
        "bake",
        "Make the files that a manifest lists, in shards that can be begun again, and end. "
        "Options of the program that concern files, such as --threads and --atlas, may follow");
    bake->fallthrough();
    bake->add_option("MANIFEST", command.manifest,
                     "A spec in JSON, or a list of path and query, one a line")
        ->required();
    bake->add_option("--out", command.out, "Folder of the shards; made if it is missing")
        ->required()
        ->type_name("DIR");
    bake->add_option("--shard", command.shard,
                     "Make only the shards k with k mod n = i, so that n processes make all")
        ->type_name("I/N");
    bake->add_option("--layout", command.layout,
                     "tar, the default: an archive for each shard; files: a file for each item")
        ->type_name("LAYOUT");
    bake->add_option("--progress", command.progress,
                     "line, json (an object a second) or none, to standard error")
        ->type_name("STYLE");
    bake->add_flag("--finish", command.finish,
                   "Check all shards, list what is missing, and write SHA256SUMS");
    bake->footer(
        "\nA shard has 1000 items unless the manifest says otherwise with per_shard.\n"
        "Exit codes: 0 done; 1 the disk, the system or a signal ended it, begin it again;\n"
        "2 the manifest, a flag or the folder is wrong; 3 --finish: shards are missing;\n"
        "4 the folder is of another manifest, generator or layout; 5 --finish: complete, but\n"
        "some items cannot be made.");
}

/// Adds `library owner add NAME` and related commands. They end the program.
void add_library_commands(CLI::App& app, LibraryCommand& command) {
    CLI::App* const library =
        app.add_subcommand("library", "Owners, tokens, backup and copies of --library, and end");
    library->require_subcommand(1);
    // Options of the program, such as --library itself, may follow.
    library->fallthrough();
    CLI::App* const owner = library->add_subcommand("owner", "Owners and their limits");
    owner->require_subcommand(1);
    owner->fallthrough();
    const auto verb = [&command](CLI::App* parent, const char* name, const char* help,
                                 std::string text, bool has_owner) {
        CLI::App* const added = parent->add_subcommand(name, help);
        added->fallthrough();
        added->callback([&command, text = std::move(text)] { command.verb = text; });
        if (has_owner) added->add_option("NAME", command.owner, "The owner")->required();
        return added;
    };
    verb(owner, "add", "Add an owner and print a token", "owner-add", true);
    verb(owner, "list", "Print all owners, and what they have", "owner-list", false);
    verb(owner, "disable", "Make all tokens of an owner useless", "owner-disable", true);
    verb(owner, "enable", "Make them useful again", "owner-enable", true);
    CLI::App* const limit = verb(owner, "limit", "Set what an owner may have", "owner-limit", true);
    limit->add_option("--documents", command.max_documents, "Greatest number of documents")
        ->check(CLI::Range(std::int64_t{0}, std::int64_t{1'000'000}));
    limit->add_option("--bytes", command.max_bytes, "Greatest number of bytes")
        ->check(CLI::Range(std::int64_t{0}, std::int64_t{1} << 50));
    verb(library, "token", "Make another token of an owner and print it", "token", true);
    verb(library, "backup", "Copy the database, which may be in use, into a new file", "backup",
         false)
        ->add_option("FILE", command.file, "The new file")
        ->required();
    verb(library, "copy", "Copy everything into another database, which is empty", "copy", false)
        ->add_option("TO", command.to, "A file, or postgres://user@host/database")
        ->required();
}

void add_flags(CLI::App& app, CommandLine& line) {
    app.add_option(
           "--config", line.config,
           "JSON file with any of these options, named like cache_mb (or SPOREPRINT_CONFIG)")
        ->type_name("FILE");
    add_library_commands(app, line.library);
    add_bake_command(app, line.bake);
    app.add_flag("--print-config", line.print_config,
                 "Print all options as such a file, where they come to, and end");
    app.add_option("--health", line.health,
                   "Ask a running server: 0 if this address answers 200, else 1")
        ->type_name("URL");
    app.add_option("--sign", line.to_sign.target,
                   "Print this path and query with the signature of the first of --sign-keys, "
                   "and end")
        ->type_name("TARGET");
    app.add_option("--sign-method", line.to_sign.method,
                   "Method that it is good for: GET, which is also good for HEAD, or POST")
        ->type_name("METHOD")
        ->check(CLI::IsMember({"GET", "POST"}));
    app.add_option("--sign-body", line.to_sign.body,
                   "File with the body of the POST, byte for byte; - reads standard input")
        ->type_name("FILE");
    app.add_option("--sign-for", line.to_sign.seconds,
                   "Seconds for which it is good; for ever by itself")
        ->type_name("SECONDS")
        ->check(CLI::Range(std::int64_t{1}, std::int64_t{1} << 40));
    app.footer(
        "Each option is also a variable, --cache-mb is SPOREPRINT_CACHE_MB; a flag wins over a "
        "variable,\na variable over the file.");
}

/// Does what `sporeprint library ...` says.
int administer_library(const LibraryCommand& command, const Options& options) {
    if (options.library.empty())
        return complain("library needs --library, the database", wrong_usage);
    std::printf("%s", administer(command, options.library.string(), seconds_since_1970()).c_str());
    return fine;
}

/// Does what the command line requests, with the resulting options; returns the exit code.
int perform(const CLI::App& app, const CommandLine& line, const Options& options,
            const Environment& environment) {
    const SigningRequest& to_sign = line.to_sign;
    if (line.print_config || !to_sign.target.empty())
        for (const std::string& unknown : environment.unknown)
            complain("ignored: unknown variable " + unknown, fine);
    if (line.print_config) {
        std::printf("%s\n", config_text(options).c_str());
        return fine;
    }
    try {
        if (!line.bake.manifest.empty()) return bake_set(line.bake, options);
        if (!line.library.verb.empty()) return administer_library(line.library, options);
        if (to_sign.target.empty() && (app.count("--sign-method") > 0 || !to_sign.body.empty()))
            return complain("--sign-method and --sign-body need --sign, the URL to sign",
                            wrong_usage);
        return to_sign.target.empty() ? serve(options, environment) : sign(options, to_sign);
    } catch (const InvalidInput& invalid) {  // an invalid instruction set or template
        for (const Problem& problem : invalid.problems())
            complain((problem.path == "simd" ? "--simd" : problem.path) + ": " + problem.message,
                     wrong_usage);
        return wrong_usage;
    }
}

int run(int argc, char** argv) {
    CLI::App app("GLB files grown on demand, over HTTP.", "sporeprint");
    app.set_version_flag("--version", "sporeprint " SPOREPRINT_VERSION, "Print the version");
    app.set_help_flag("--help,-h", "Print this help");
    const std::vector<OptionLine> lines = option_lines();
    std::vector<std::string> texts(lines.size());
    for (std::size_t i = 0; i < lines.size(); ++i)
        app.add_option(lines[i].flag, texts[i], lines[i].help)->type_name("");
    CommandLine line;
    add_flags(app, line);
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& done) {
        return app.exit(done);
    } catch (const CLI::ParseError& error) {
        return complain(std::string(error.what()) + "; --help lists the options", wrong_usage);
    }
    if (!line.health.empty()) {
        std::string reason;
        return is_healthy(line.health, reason) ? fine
                                               : complain(line.health + ": " + reason, failed);
    }
    Given flags;
    for (std::size_t i = 0; i < lines.size(); ++i)
        if (app.count(lines[i].flag) > 0) flags.emplace_back(lines[i].name, texts[i]);
    const Environment environment = environment_from(variables_of_process());
    if (line.config.empty()) line.config = environment.config;
    Options options;
    try {
        options = options_from(line.config, config_text(line.config), environment.options, flags);
    } catch (const InvalidInput& invalid) {
        for (const Problem& problem : invalid.problems())
            complain(problem.path + ": " + problem.message, wrong_usage);
        return wrong_usage;
    } catch (const std::runtime_error& error) {
        return complain(error.what(), wrong_usage);
    }
    return perform(app, line, options, environment);
}

}  // namespace

int main(int argc, char** argv) {
    try {
        bound_malloc();
        return run(argc, argv);
    } catch (const std::exception& error) {
        return complain(error.what(), failed);
    }
}
