// What a fuzz target does when a promise is broken: says which and stops, so that the input is kept.
#pragma once

#include <cstdio>
#include <cstdlib>

inline void expect(bool cached, const char* promise) {
    if (cached) return;
    std::fprintf(stderr, "broken promise: %s\n", promise);
    std::abort();
}
