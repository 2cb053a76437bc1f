// The version of everything that a service generates.
#pragma once

#include <string>

#include "core/atlas/atlas.h"

namespace sporeprint::api {

/// Returns a token that changes with the generator and with any template: generator version, '-', 8 hexadecimal digits.
[[nodiscard]] std::string version_of(const Atlas& atlas);

}  // namespace sporeprint::api
