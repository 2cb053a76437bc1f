#include "server/log.h"

#include <spdlog/async.h>
#include <spdlog/async_logger.h>
#include <spdlog/sinks/stdout_sinks.h>

#include <array>
#include <chrono>
#include <cmath>
#include <ctime>
#include <utility>

namespace sporeprint::server {

namespace {

constexpr std::size_t most_waiting_lines = 8192;

std::string timestamp() {
    const auto now = std::chrono::system_clock::now();
    const std::time_t seconds = std::chrono::system_clock::to_time_t(now);
    const auto milliseconds = std::chrono::duration_cast<std::chrono::milliseconds>(
                                  now.time_since_epoch() % std::chrono::seconds(1))
                                  .count();
    std::tm utc{};
    gmtime_r(&seconds, &utc);
    std::array<char, 64> text{};
    const std::size_t length = std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%S", &utc);
    std::string result(text.data(), length);
    const std::string fraction = std::to_string(1000 + milliseconds).substr(1);
    return result + '.' + fraction + 'Z';
}

spdlog::level::level_enum level_of(LogLevel level) {
    switch (level) {
        case LogLevel::debug:
            return spdlog::level::debug;
        case LogLevel::info:
            return spdlog::level::info;
        case LogLevel::warning:
            return spdlog::level::warn;
        case LogLevel::error:
            return spdlog::level::err;
        case LogLevel::off:
            return spdlog::level::off;
    }
    return spdlog::level::off;
}

bool is_health_check(std::string_view target) {
    const std::string_view path = target.substr(0, target.find('?'));
    return path == "/livez" || path == "/readyz" || path == "/metrics";
}

}  // namespace

struct Log::Sink {
    std::shared_ptr<spdlog::async_logger> logger;
    std::shared_ptr<spdlog::details::thread_pool> writer;  ///< ends first: it writes what waits
};

Log::Log(LogLevel least) : sink_(std::make_unique<Sink>()) {
    sink_->writer = std::make_shared<spdlog::details::thread_pool>(most_waiting_lines, 1);
    sink_->logger = std::make_shared<spdlog::async_logger>(
        "sporeprint", std::make_shared<spdlog::sinks::stderr_sink_mt>(), sink_->writer,
        spdlog::async_overflow_policy::overrun_oldest);
    sink_->logger->set_pattern("%v");
    sink_->logger->set_level(level_of(least));
    sink_->logger->flush_on(spdlog::level::warn);
}

Log::~Log() = default;

Value::Object request_members(const Served& served) {
    Value::Object members;
    members.emplace_back("id", served.id);
    members.emplace_back("peer", served.peer);
    members.emplace_back("method", served.method);
    members.emplace_back("target", served.target);
    members.emplace_back("status", served.status);
    members.emplace_back("bytes", served.bytes);
    members.emplace_back("ms", std::round(served.milliseconds * 1000.0) / 1000.0);
    if (!served.cache.empty()) members.emplace_back("cache", served.cache);
    if (!served.complete) members.emplace_back("complete", false);
    return members;
}

void Log::request(const Served& served) {
    const LogLevel level = served.status >= 500 && served.status != 503 ? LogLevel::error
                           : is_health_check(served.target)             ? LogLevel::debug
                                                                        : LogLevel::info;
    if (!sink_->logger->should_log(level_of(level))) return;
    write(level, request_members(served));
}

void Log::event(LogLevel level, std::string_view message, Value::Object members) {
    if (!sink_->logger->should_log(level_of(level))) return;
    members.insert(members.begin(), {"message", Value(message)});
    write(level, std::move(members));
}

void Log::write(LogLevel level, Value::Object members) {
    members.insert(members.begin(), {{"time", timestamp()}, {"level", Value(name(level))}});
    // Given as an argument: braces in a client's bytes are no format.
    sink_->logger->log(level_of(level), "{}", dump(Value(std::move(members))));
}

}  // namespace sporeprint::server
