#include "server/operations/log.h"

#include <spdlog/logger.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_sinks.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <ctime>
#include <utility>

#include "api/library/tokens.h"
#include "api/products/photos.h"

namespace sporeprint::server {

namespace {

constexpr std::size_t block = 64u << 10;  ///< bytes of lines that are written or dropped together
constexpr std::size_t most_blocks = 64;   ///< queued: 4 MB
constexpr std::chrono::milliseconds batch_time{10};

/// Appends the time, "2026-01-31T23:59:59.123Z"; the part up to the seconds is formatted once per
/// second.
void append_time(std::string& to) {
    const auto now = std::chrono::system_clock::now();
    const std::time_t seconds = std::chrono::system_clock::to_time_t(now);
    const auto milliseconds = std::chrono::duration_cast<std::chrono::milliseconds>(
                                  now.time_since_epoch() % std::chrono::seconds(1))
                                  .count();
    thread_local std::time_t formatted_at = -1;
    thread_local std::string text;
    if (seconds != formatted_at) {
        std::tm utc{};
        gmtime_r(&seconds, &utc);
        std::array<char, 64> line{};
        text.assign(line.data(),
                    std::strftime(line.data(), line.size(), "%Y-%m-%dT%H:%M:%S.", &utc));
        formatted_at = seconds;
    }
    to += text;
    for (const auto digit : {milliseconds / 100, milliseconds / 10 % 10, milliseconds % 10})
        to += static_cast<char>('0' + digit);
    to += 'Z';
}

/// Appends a JSON string with all special characters escaped.
void append_text(std::string& to, std::string_view text) {
    const bool plain = std::all_of(text.begin(), text.end(), [](char c) {
        return c >= 0x20 && c < 0x7f && c != '"' && c != '\\';
    });
    if (plain)
        ((to += '"') += text) += '"';
    else
        to += json_string(text);
}

template <class Number>
void append_number(std::string& to, Number number) {
    std::array<char, 32> text;
    to.append(text.data(), std::to_chars(text.data(), text.data() + text.size(), number).ptr);
}

void begin_line(std::string& to, LogLevel level) {
    to = "{\"time\":\"";
    append_time(to);
    ((to += "\",\"level\":\"") += name(level)) += '"';
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

/// Returns true if the name of a parameter, percent-encoded or not, is "sig".
bool is_secret(std::string_view name) {
    constexpr std::string_view secret = "sig";
    const auto digit = [](char c) {
        return c >= '0' && c <= '9'   ? c - '0'
               : c >= 'A' && c <= 'F' ? c - 'A' + 10
               : c >= 'a' && c <= 'f' ? c - 'a' + 10
                                      : -1;
    };
    std::size_t length = 0;
    for (std::size_t i = 0; i < name.size(); ++i, ++length) {
        int byte = static_cast<unsigned char>(name[i]);
        if (byte == '%' && i + 2 < name.size() && digit(name[i + 1]) >= 0 &&
            digit(name[i + 2]) >= 0) {
            byte = digit(name[i + 1]) * 16 + digit(name[i + 2]);
            i += 2;
        }
        if (byte >= 'A' && byte <= 'Z') byte += 'a' - 'A';
        if (length == secret.size() || byte != secret[length]) return false;
    }
    return length == secret.size();
}

/// Replaces tokens and keys of shares, wherever they stand.
std::string without_tokens(std::string_view target) {
    std::string text(target);
    for (const std::string_view prefix : {api::token_prefix, api::share_prefix})
        for (std::size_t at = text.find(prefix); at != text.npos; at = text.find(prefix, at + 1)) {
            const auto end = std::find_if_not(
                text.begin() + static_cast<std::ptrdiff_t>(at), text.end(), [](char c) {
                    return c == '_' || c == '-' || (c >= '0' && c <= '9') ||
                           (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
                });
            text.replace(text.begin() + static_cast<std::ptrdiff_t>(at), end, "[redacted]");
        }
    return text;
}

}  // namespace

std::string redacted(std::string_view target) {
    const std::size_t query = target.find('?');
    std::string text(target.substr(0, query));
    if (query == target.npos) return text;
    std::string_view rest = target.substr(query);
    while (!rest.empty()) {  // begins with the separator before a parameter
        const std::size_t end = std::min(rest.find_first_of("?&;#", 1), rest.size());
        const std::string_view parameter = rest.substr(1, end - 1);
        const std::size_t equals = parameter.find('=');
        if (equals != parameter.npos && is_secret(parameter.substr(0, equals)))
            (text += rest.substr(0, equals + 2)) += "[redacted]";
        else
            text += rest.substr(0, end);
        rest.remove_prefix(end);
    }
    return text;
}

Log::Log(LogLevel least)
    : logger_(std::make_unique<spdlog::logger>("sporeprint",
                                               std::make_shared<spdlog::sinks::stderr_sink_st>())) {
    // Each record is a block of many lines that include their line ends.
    logger_->set_formatter(
        std::make_unique<spdlog::pattern_formatter>("%v", spdlog::pattern_time_type::utc, ""));
    logger_->set_level(level_of(least));
    writer_ = std::jthread([this] { write(); });
}

Log::~Log() {
    {
        const std::lock_guard lock(mutex_);
        ending_ = true;
    }
    wake_.notify_all();
    writer_.join();
}

void Log::request(const Served& served) {
    const LogLevel level = served.status >= 500 && served.status != 503 ? LogLevel::error
                           : is_health_check(served.target)             ? LogLevel::debug
                                                                        : LogLevel::info;
    if (!logger_->should_log(level_of(level))) return;
    thread_local std::string line;
    begin_line(line, level);
    const auto text = [](const char* member, std::string_view value) {
        line += member;
        append_text(line, value);
    };
    text(",\"id\":", served.id);
    text(",\"peer\":", served.peer);
    if (!served.client.empty()) text(",\"client\":", served.client);
    if (!served.trace_id.empty()) {
        text(",\"trace_id\":", served.trace_id);
        text(",\"parent_id\":", served.parent_id);
    }
    text(",\"method\":", served.method);
    // The address of a photograph is a secret, and that of a draft may have the key of a share.
    std::string_view target =
        served.label == api::photo_pattern ? std::string_view(served.label) : served.target;
    if (std::string_view(served.label).starts_with("/v1/library/"))
        target = target.substr(0, target.find('?'));
    const std::string shown = without_tokens(target);
    if (shown.find('?') == shown.npos)
        text(",\"target\":", shown);
    else
        text(",\"target\":", redacted(shown));
    line += ",\"status\":";
    append_number(line, served.status);
    line += ",\"bytes\":";
    append_number(line, served.bytes);
    line += ",\"ms\":";
    append_number(line, std::round(served.milliseconds * 1000.0) / 1000.0);
    if (!served.cache.empty()) text(",\"cache\":", served.cache);
    if (!served.complete) line += ",\"complete\":false";
    line += "}\n";
    enqueue(line);
}

void Log::event(LogLevel level, std::string_view message, const Value::Object& members) {
    if (!logger_->should_log(level_of(level))) return;
    std::string line;
    begin_line(line, level);
    line += ",\"message\":";
    append_text(line, message);
    for (const auto& [member, value] : members)
        ((line += ',') += json_string(member) + ':') += dump(value);
    line += "}\n";
    enqueue(line);
}

void RepeatedWarning::operator()(Value::Object members, Clock::time_point now) {
    {
        const std::lock_guard lock(mutex_);
        ++times_;
        if (now < next_) return;
        next_ = now + pause_;
        members.emplace_back("times", static_cast<double>(std::exchange(times_, 0)));
    }
    log_.event(LogLevel::warning, message_, members);
}

void Log::enqueue(std::string_view line) {
    bool first = false;
    {
        const std::lock_guard lock(mutex_);
        first = waiting_.empty();
        if (first || waiting_.back().size() + line.size() > block) {
            if (waiting_.size() == most_blocks) waiting_.pop_front();
            waiting_.emplace_back().reserve(block);
        }
        waiting_.back() += line;
    }
    if (first) wake_.notify_one();
}

void Log::write() {
    std::unique_lock lock(mutex_);
    for (;;) {
        wake_.wait(lock, [&] { return ending_ || !waiting_.empty(); });
        if (waiting_.empty()) return;
        if (!ending_) wake_.wait_for(lock, batch_time, [&] { return ending_; });
        while (!waiting_.empty()) {
            const std::string lines = std::move(waiting_.front());
            waiting_.pop_front();
            lock.unlock();
            // Each line has passed its own level. The text is an argument, since braces in it must
            // not be read as a format.
            logger_->log(spdlog::level::critical, "{}", lines);
            logger_->flush();
            lock.lock();
        }
    }
}

}  // namespace sporeprint::server
