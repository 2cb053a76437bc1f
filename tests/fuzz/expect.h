// The assertion of fuzz targets: prints a message and aborts, so that libFuzzer saves the input.
#pragma once

#include <cstdio>
#include <cstdlib>

inline void expect(bool holds, const char* condition) {
    if (holds) return;
    std::fprintf(stderr, "violated: %s\n", condition);
    std::abort();
}
