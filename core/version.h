// The generator's version: part of every cache key, ETag and golden hash.
#pragma once

namespace sporeprint {

/// It is raised whenever bytes change for an unchanged request.
inline constexpr int generator_version = 41;

}  // namespace sporeprint
