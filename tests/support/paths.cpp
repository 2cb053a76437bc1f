#include "tests/support/paths.h"

namespace sporeprint {

const char* source_folder() { return SPOREPRINT_SOURCE; }

const char* server_program() { return SPOREPRINT_PROGRAM; }

}  // namespace sporeprint
