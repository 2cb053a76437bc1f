// Files that are made in advance: shards of items, each a pure function of the manifest and of its number, so that any
// number of processes may make them, be ended at any moment and begin again.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "api/service.h"
#include "server/bake/item.h"
#include "server/bake/progress.h"

namespace sporeprint::server {

/// What `sporeprint bake` says.
struct BakeCommand {
    std::string manifest;           ///< file; empty: the command was not given
    std::string out;                ///< folder
    std::string shard = "0/1";      ///< "i/n": shards k with k mod n = i
    std::string layout;             ///< "tar", "files"; empty: that of the folder, or "tar"
    std::string progress = "line";  ///< or "json", "none"
    bool finish = false;            ///< check all shards and complete the folder
};

/// Exit codes.
enum class BakeEnd : int {
    complete = 0,     ///< all that was to be done is done
    impossible = 1,   ///< the disk, the system or a signal ended it; begin it again
    wrong_usage = 2,  ///< the manifest or a flag is wrong
    unfinished = 3,   ///< --finish: shards are missing or were damaged
    other_set = 4,    ///< the folder is of another manifest, generator or layout
    some_failed = 5,  ///< --finish: all shards are there, but some items cannot be made
};

/// Makes the shards that are not there yet, or with `finish` checks that all are.
///
/// version  of the generator and the templates of the service
/// threads  items made at once
/// stop     called between items; if it returns true, the run ends
/// returns  how it ended; sentences about it were printed to standard error
[[nodiscard]] BakeEnd bake(const BakeCommand& command, api::Service& service,
                           const std::string& version, std::size_t threads,
                           const std::function<bool()>& stop);

}  // namespace sporeprint::server
