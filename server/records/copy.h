// Moves a library from one database to another.
#pragma once

#include <cstdint>

#include "api/library/records.h"

namespace sporeprint::server {

/// What was copied.
struct Copied {
    std::int64_t owners = 0, documents = 0, versions = 0;
};

/// Copies all owners with their limits, the tokens and shares that are still good, all documents with their versions,
/// and the names of purged ones into an empty database. Texts, hashes, blobs and times stay as they are, so every
/// published address has the bytes that it had. What is written to `from` meanwhile may be missing.
///
/// now     the time, by which tokens and shares are good or expired
/// throws  api::Unavailable if one of the two cannot be used, or does not take what the other one has; InvalidInput
///         (path "TO") if `to` has owners already
Copied copy_records(api::Records& from, api::Records& to, api::Seconds now);

}  // namespace sporeprint::server
