// What the machine grants this process and what the process takes: processors, memory, time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace sporeprint::server {

/// Processors that may be used at once: those this process may run on, and no more than the quota
/// of its control group, rounded up; at least 1.
[[nodiscard]] std::size_t granted_processors();

/// The quota in a cgroup v2 file cpu.max, "150000 100000" is 1.5; nothing for "max" or else.
[[nodiscard]] std::optional<double> quota_in(std::string_view cpu_max);

struct Usage {
    std::uint64_t resident_bytes = 0;
    double cpu_seconds = 0;
    double started = 0;  ///< seconds since 1970
    std::size_t open_files = 0;
};
[[nodiscard]] Usage usage();

/// Now, in whole seconds since 1970.
[[nodiscard]] std::int64_t seconds_since_1970();

/// The folder this program stands in.
[[nodiscard]] std::filesystem::path program_folder();

/// Lets this process open as many descriptors as the system ever allows it: each connection is one.
void raise_descriptor_limit();

/// Bounds what malloc() keeps for later: two arenas for all threads, so that memory which one frees
/// another uses again, and blocks of 4 MiB and more go back to the system as soon as they are freed.
/// By default the limit for such blocks grows to 32 MiB with the first that is freed, and bodies and
/// decoded images then fragment the heap.
///
/// Lower limits were measured too: 100 MB less at rest, but a tenth more time for each small answer,
/// since its pages are mapped anew. So was jemalloc 5.3, a minute of 400 mixed requests a second
/// twice each: 2 % less processor time, 3 % more memory at most (490 MB), equal latencies; that is
/// not worth a dependency.
void bound_malloc();

/// Gives the calling thread a lower priority (nice 10) than the other threads of this process, so that
/// answers from memory do not wait for computation when all processors are busy.
void lower_thread_priority();

}  // namespace sporeprint::server
