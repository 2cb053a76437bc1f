#include "tests/support/effort.h"

#include <string>

namespace sporeprint {
namespace {

/// Sets the draws per property, a hundred or ten under sanitizers, unless RC_PARAMS is set.
/// RapidCheck reads that variable when the first property runs.
[[maybe_unused]] const int result = setenv(
    "RC_PARAMS", ("max_success=" + std::to_string(effort(100, 10))).c_str(), /*overwrite=*/0);

}  // namespace
}  // namespace sporeprint
