// Properties of growth over all modules: a film of any species from egg to decay has no jump.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/support/effort.h"
#include "tests/support/meshes.h"
#include "tests/support/orders.h"
#include "tests/support/surfaces.h"

namespace sporeprint::grow_growth_properties_test {
namespace {

class Growth : public ::testing::TestWithParam<std::string> {};

INSTANTIATE_TEST_SUITE_P(Atlas, Growth, ::testing::ValuesIn(species_ids()),
                         [](const auto& one) { return one.param; });

/// The largest jump of a film, relative to the mature diagonal, and its age.
struct Worst {
    double share = 0.0, age = 0.0;
};

Worst worst_jump(MushroomSpec spec, double from, double to, int frames) {
    spec.params.age = 0.6;
    const double size = diagonal(bounds(mesh_of(spec)));
    Worst worst;
    spec.params.age = from;
    Mesh last = mesh_of(spec);
    for (int i = 1; i <= frames; ++i) {
        spec.params.age = from + (to - from) * i / frames;
        Mesh now = mesh_of(spec);
        const double share = jump(last, now) / size;
        if (share > worst.share) worst = {share, spec.params.age};
        last = std::move(now);
    }
    return worst;
}

TEST_P(Growth, NoVertexMovesByTwoHundredthsOfTheMatureSizeInA256thOfALife) {
    struct One {
        int lod;
        std::uint32_t seed;
        double variation;
    };
    for (const One& one : {One{0, 2, 0.5}, One{1, 7, 1.0}}) {
        MushroomSpec spec = order_of(GetParam(), 0.0, one.seed, one.lod);
        spec.params.variation = one.variation;
        // With sanitizers a twentieth of a life is tested, in equally small steps.
        const int frames = static_cast<int>(effort(256, 1, 256));
        const Worst worst = worst_jump(spec, 0.0, frames / 256.0, frames);
        EXPECT_LT(worst.share, 0.02) << "lod " << one.lod << ", age " << worst.age;
    }
}

TEST_P(Growth, HasNoJumpAtAnyStepSize) {
    // A discontinuity, unlike fast movement, does not shrink in steps sixteen times as short.
    MushroomSpec spec = order_of(GetParam(), 0.0, 7, 1);
    const int frames = static_cast<int>(effort(64, 2, 128));
    for (const double age : {0.0, 0.1, 0.28, 0.45, 0.59, 0.72, 0.84, 0.95}) {
        const double to = std::min(age + frames / 4096.0, 1.0);
        const Worst worst = worst_jump(spec, age, to, frames);
        EXPECT_LT(worst.share, 0.02 / 16.0) << "age " << worst.age;
    }
}

}  // namespace
}  // namespace sporeprint::grow_growth_properties_test
