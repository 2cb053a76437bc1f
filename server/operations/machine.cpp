#include "server/operations/machine.h"

#include <malloc.h>
#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <sstream>
#include <system_error>

#include "server/http/body_memory.h"
#include "server/operations/text_files.h"

namespace sporeprint::server {

namespace {

namespace fs = std::filesystem;

const double process_started =
    std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();

/// Returns the text of a system file; empty if it cannot be read.
std::string text_of(const fs::path& file) { return read_text(file).value_or(""); }

std::optional<double> number_in(std::string_view text) {
    double number = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || stop == text.data()) return std::nullopt;
    return number;
}

/// Returns the smallest CPU quota of this process's control group and its ancestors.
std::optional<double> group_quota() {
    const fs::path root = "/sys/fs/cgroup";
    std::optional<double> least;
    const auto take = [&](std::optional<double> quota) {
        if (quota && *quota > 0 && (!least || *quota < *least)) least = quota;
    };
    std::istringstream groups(text_of("/proc/self/cgroup"));
    for (std::string line; std::getline(groups, line);) {
        if (!line.starts_with("0::/")) continue;
        for (fs::path group = line.substr(4); !group.empty(); group = group.parent_path())
            take(quota_in(text_of(root / group / "cpu.max")));
    }
    take(quota_in(text_of(root / "cpu.max")));
    const auto quota = number_in(text_of(root / "cpu/cpu.cfs_quota_us"));  // version 1
    const auto period = number_in(text_of(root / "cpu/cpu.cfs_period_us"));
    if (quota && period && *quota > 0 && *period > 0) take(*quota / *period);
    return least;
}

}  // namespace

std::optional<double> quota_in(std::string_view cpu_max) {
    const std::size_t space = cpu_max.find(' ');
    if (space == std::string_view::npos) return std::nullopt;
    const auto quota = number_in(cpu_max.substr(0, space));
    const auto period = number_in(cpu_max.substr(space + 1));
    if (!quota || !period || *quota <= 0 || *period <= 0) return std::nullopt;
    return *quota / *period;
}

std::size_t granted_processors() {
    cpu_set_t set;
    CPU_ZERO(&set);
    int processors = 0;
    if (sched_getaffinity(0, sizeof set, &set) == 0) processors = CPU_COUNT(&set);
    if (processors < 1) processors = static_cast<int>(sysconf(_SC_NPROCESSORS_ONLN));
    if (const auto quota = group_quota())
        processors = std::min(processors, static_cast<int>(std::ceil(*quota)));
    return static_cast<std::size_t>(std::max(processors, 1));
}

Usage usage() {
    Usage now;
    std::istringstream pages(text_of("/proc/self/statm"));
    std::uint64_t total = 0, resident = 0;
    pages >> total >> resident;
    now.resident_bytes = resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
    rusage used{};
    if (getrusage(RUSAGE_SELF, &used) == 0) {
        const auto seconds = [](const timeval& time) {
            return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
        };
        now.cpu_seconds = seconds(used.ru_utime) + seconds(used.ru_stime);
    }
    now.started = process_started;
    std::error_code error;
    for (fs::directory_iterator entry("/proc/self/fd", error), end; !error && entry != end;
         entry.increment(error))
        ++now.open_files;
    return now;
}

std::int64_t seconds_since_1970() {
    using std::chrono::duration_cast, std::chrono::seconds, std::chrono::system_clock;
    return duration_cast<seconds>(system_clock::now().time_since_epoch()).count();
}

fs::path program_folder() {
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    return error ? fs::path() : program.parent_path();
}

void raise_descriptor_limit() {
    rlimit limit{};
    if (getrlimit(RLIMIT_NOFILE, &limit) != 0 || limit.rlim_cur >= limit.rlim_max) return;
    limit.rlim_cur = limit.rlim_max;
    setrlimit(RLIMIT_NOFILE, &limit);  // on failure the limit stays as it is
}

void bound_malloc() {
    mallopt(M_ARENA_MAX, 2);
    mallopt(M_MMAP_THRESHOLD, static_cast<int>(mapped_block));
    mallopt(M_TRIM_THRESHOLD, 64 << 20);  // a fixed limit above would set this one to 128 KiB
}

void lower_thread_priority() {
    constexpr int nice = 10;
    const auto thread =
        static_cast<id_t>(gettid());  // on Linux each thread has a nice value of its own
    // On failure all threads keep the same priority.
    if (getpriority(PRIO_PROCESS, thread) < nice) setpriority(PRIO_PROCESS, thread, nice);
}

}  // namespace sporeprint::server
