// Comparison of paintings between all instruction sets of this processor.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <functional>
#include <string>

#include "core/math/noise.h"
#include "core/surface/paint.h"

namespace sporeprint {

/// Expects that `make` paints the same bytes with every instruction set as in scalar code. Restores
/// the automatic choice of the instruction set.
///
/// returns  the images
inline RawImages expect_equal_with_every_instruction_set(const std::function<RawImages()>& make,
                                                         const std::string& what) {
    struct Automatic {
        Automatic() = default;
        Automatic(const Automatic&) = delete;
        Automatic& operator=(const Automatic&) = delete;
        ~Automatic() { force_simd("auto"); }
    } const afterwards;
    force_simd("scalar");
    RawImages expected = make();
    for (const std::string& name : simd_names()) {
        force_simd(name);
        const RawImages found = make();
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_TRUE(found.rgb[i] == expected.rgb[i]) << name << ' ' << what << ", image " << i;
    }
    return expected;
}

}  // namespace sporeprint
