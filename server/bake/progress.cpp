#include "server/bake/progress.h"

#include <unistd.h>

#include <cmath>
#include <cstdio>

#include "core/params/value.h"

namespace sporeprint::server {

std::string time_text(double seconds) {
    const auto whole = static_cast<std::uint64_t>(std::llround(seconds));
    constexpr std::uint64_t minute = 60, hour = 60 * minute, day = 24 * hour;
    const auto two = [](std::uint64_t a, const char* unit, std::uint64_t b, const char* part) {
        const std::string text = std::to_string(a) + " " + unit;
        return b == 0 ? text : text + " " + std::to_string(b) + " " + part;
    };
    if (whole >= day) return two(whole / day, "d", whole % day / hour, "h");
    if (whole >= hour) return two(whole / hour, "h", whole % hour / minute, "min");
    if (whole >= minute) return two(whole / minute, "min", whole % minute, "s");
    return two(whole, "s", 0, "");
}

std::string grouped(std::uint64_t number) {
    std::string text = std::to_string(number);
    for (std::size_t at = text.size(); at > 3;) text.insert(at -= 3, ",");
    return text;
}

BakeProgress::BakeProgress(ProgressStyle style, std::uint64_t items, std::uint64_t before)
    : style_(style), items_(items), before_(before), is_terminal_(::isatty(STDERR_FILENO) == 1) {
    using std::chrono::milliseconds;
    interval_ = style == ProgressStyle::json ? milliseconds(1000)
                : is_terminal_               ? milliseconds(250)
                                             : milliseconds(10'000);
}

void BakeProgress::count(bool failed, std::uint64_t bytes) {
    ++done_;
    failed_ += failed ? 1 : 0;
    bytes_ += bytes;
    const Clock::time_point now = Clock::now();
    if (now - last_ >= interval_) report(now);
}

void BakeProgress::finish() {
    report(Clock::now());
    if (style_ == ProgressStyle::line && is_terminal_) std::fputc('\n', stderr);
}

void BakeProgress::report(Clock::time_point now) {
    last_ = now;
    if (style_ == ProgressStyle::none) return;
    const double seconds = std::chrono::duration<double>(now - begun_).count();
    if (style_ == ProgressStyle::json)
        std::fprintf(stderr, "%s\n", object(seconds).c_str());
    else if (is_terminal_)
        std::fprintf(stderr, "\r\x1b[K%s", line(seconds).c_str());
    else
        std::fprintf(stderr, "%s\n", line(seconds).c_str());
    std::fflush(stderr);
}

std::string BakeProgress::line(double seconds) const {
    const double rate = seconds > 0.0 ? static_cast<double>(done_) / seconds : 0.0;
    std::string text = grouped(before_ + done_) + " of " + grouped(before_ + items_) + " items";
    if (failed_ > 0) text += ", " + grouped(failed_) + " failed";
    char numbers[64];
    std::snprintf(numbers, sizeof numbers, ", %.*f/s, %.1f MB/s", rate < 10.0 ? 1 : 0, rate,
                  seconds > 0.0 ? 1e-6 * static_cast<double>(bytes_) / seconds : 0.0);
    text += numbers;
    if (done_ < items_ && rate > 0.0)
        text += ", " + time_text(static_cast<double>(items_ - done_) / rate) + " left";
    return text;
}

std::string BakeProgress::object(double seconds) const {
    const double rate = seconds > 0.0 ? static_cast<double>(done_) / seconds : 0.0;
    Value out = Value::object();
    out.set("items", Value(before_ + done_))
        .set("of", Value(before_ + items_))
        .set("failed", Value(failed_))
        .set("bytes", Value(bytes_))
        .set("seconds", Value(std::round(seconds * 1000.0) / 1000.0))
        .set("items_per_second", Value(std::round(rate * 1000.0) / 1000.0))
        .set("seconds_left",
             rate > 0.0 ? Value(std::round(static_cast<double>(items_ - done_) / rate)) : Value());
    return dump(out);
}

}  // namespace sporeprint::server
