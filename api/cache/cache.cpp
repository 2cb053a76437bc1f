#include "api/cache/cache.h"

#include <xxhash.h>

namespace sporeprint::api {

std::uint64_t hash_of(std::string_view key) { return XXH3_64bits(key.data(), key.size()); }

}  // namespace sporeprint::api
