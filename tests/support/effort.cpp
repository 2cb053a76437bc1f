#include "tests/support/effort.h"

#include <string>

namespace sporeprint {
namespace {

/// RapidCheck reads its counts from the environment, when the first property runs: a hundred draws each, ten under sanitizers. Who
/// sets RC_PARAMS knows better.
[[maybe_unused]] const int told = setenv(
    "RC_PARAMS", ("max_success=" + std::to_string(effort(100, 10))).c_str(), /*overwrite=*/0);

}  // namespace
}  // namespace sporeprint
