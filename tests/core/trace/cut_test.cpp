#include "core/trace/cut.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/support/effort.h"
#include "tests/support/photographs.h"
#include "tests/support/refusals.h"

namespace sporeprint::trace_cut_test {
namespace {

/// The agreement of cuts with the truth.
struct Agreement {
    double mean = 0.0, least = 1.0;
};

Agreement agreement(Scenery scenery, std::size_t scenes) {
    const std::vector<Sitter> sitters = {
        {"amanita_muscaria", 0.7, 1, View::front, 1024},
        {"boletus_edulis", 0.6, 2, View::front, 1024},
        {"mycena_galericulata", 0.7, 3, View::front, 1024},
        {"russula_emetica", 0.8, 4, View::front, 1024},
        {"hygrocybe_coccinea", 0.6, 5, View::front, 1024},
        {"lactarius_deliciosus", 0.8, 6, View::front, 1024},
        {"macrolepiota_procera", 0.6, 7, View::front, 1024},
        {"psilocybe_semilanceata", 0.7, 8, View::front, 1024},
    };
    Agreement found;
    for (std::size_t i = 0; i < scenes; ++i) {
        Sitter sitter = sitters[i % sitters.size()];
        sitter.seed += static_cast<std::uint32_t>(10 * (i / sitters.size()));
        const Photograph photo = photograph(sitter, scenery);
        const double overlap =
            intersection_over_union(trace::cut_out(photo.picture, photo.gesture), photo.truth);
        EXPECT_GT(overlap, scenery == Scenery::crowded ? 0.8 : 0.85) << sitter.species;
        found.mean += overlap / static_cast<double>(scenes);
        found.least = std::min(found.least, overlap);
    }
    return found;
}

TEST(Cut, OfAPlainBackgroundIsTheMushroom) {
    EXPECT_GE(agreement(Scenery::plain, effort(16, 2)).mean, 0.97);
}

TEST(Cut, OfASharpForestFloorIsTheMushroom) {
    EXPECT_GE(agreement(Scenery::forest, effort(16, 2)).mean, 0.97);
}

TEST(Cut, BetweenLeavesAndNeighboursIsTheMushroomOfTheGesture) {
    EXPECT_GE(agreement(Scenery::crowded, effort(16, 2)).mean, 0.94);
}

/// A red disc on green paper.
Picture disc(int side) {
    Picture photo{side, side, {}};
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const int u = 2 * x + 1 - side, v = 2 * y + 1 - side;
            const bool inside = 4 * (u * u + v * v) < side * side;
            for (const int value : {inside ? 200 : 40, inside ? 30 : 120, 40})
                photo.rgb.push_back(static_cast<std::uint8_t>(value));
        }
    return photo;
}

TEST(Cut, OfADiscHasItsAreaAtEverySize) {
    for (const int side : {60, 200, 700, 1500}) {
        const trace::Gesture gesture{
            {{0.5 * side, 0.7 * side}, {0.5 * side, 0.3 * side}}, {}, {}, {}, {}};
        const trace::Mask mask = trace::cut_out(disc(side), gesture);
        const double area =
            static_cast<double>(mask.area()) / static_cast<double>(mask.inside.size());
        EXPECT_NEAR(area, 3.14159 / 16.0, 0.006) << side;
    }
}

/// Returns a disc under noise, by whole numbers alone.
Picture noisy_disc(int side, std::uint32_t seed) {
    Picture photo = disc(side);
    std::uint32_t state = seed;
    for (std::uint8_t& value : photo.rgb) {
        state = state * 1664525U + 1013904223U;
        value = static_cast<std::uint8_t>((3U * value + (state >> 24U)) / 4U);
    }
    return photo;
}

/// Returns the FNV-1a hash of the pixels of a mask.
std::uint64_t hash_of(const trace::Mask& mask) {
    std::uint64_t hash = 0xcbf29ce484222325U;
    for (const std::uint8_t pixel : mask.inside) hash = (hash ^ pixel) * 0x100000001b3U;
    return hash;
}

TEST(Cut, LinesThatAreDrawnTooFarMakeNoSpikes) {
    // From a tenth of the side below a disc to as much above it, and across it likewise.
    constexpr int side = 700;
    const trace::Gesture gesture{{{0.5 * side, 0.85 * side}, {0.5 * side, 0.15 * side}},
                                 {{0.15 * side, 0.5 * side}, {0.85 * side, 0.5 * side}},
                                 {},
                                 {},
                                 {}};
    const trace::Mask mask = trace::cut_out(disc(side), gesture);
    for (int y = 0; y < mask.height; ++y)
        for (int x = 0; x < mask.width; ++x) {
            const double u = (x + 0.5) / mask.width - 0.5, v = (y + 0.5) / mask.height - 0.5;
            if (u * u + v * v > 0.256 * 0.256) {
                ASSERT_FALSE(mask.at(x, y)) << x << ", " << y;
            }
        }
}

TEST(Cut, IsTheSameByEveryCompiler) {
    // Where the cut is changed on purpose, so are these.
    const std::vector<std::uint64_t> hashes = {11723727663604739837U, 9944585835144833713U,
                                               13725892264572733425U};
    for (std::size_t i = 0; i < hashes.size(); ++i) {
        const double side = 240.0 + 70.0 * static_cast<double>(i);
        const trace::Gesture gesture{
            {{0.5 * side, 0.7 * side}, {0.48 * side, 0.3 * side}}, {}, {}, {}, {}};
        const Picture photo = noisy_disc(static_cast<int>(side), static_cast<std::uint32_t>(7 + i));
        const trace::Mask mask = trace::cut_out(photo, gesture);
        EXPECT_EQ(hash_of(mask), hashes[i]) << side;
        EXPECT_NEAR(static_cast<double>(mask.area()) / (side * side), 3.14159 / 16.0, 0.02);
    }
}

TEST(Cut, LeavesOutWhatIsDroppedAndWhatIsBeyondTheFrame) {
    const double side = 300.0;
    trace::Gesture gesture{{{150.0, 200.0}, {150.0, 100.0}}, {}, {}, {}, {}};
    gesture.drop = {{{180.0, 190.0}, {180.0, 110.0}}};
    const trace::Mask dropped = trace::cut_out(disc(300), gesture);
    EXPECT_FALSE(dropped.at(180, 150));
    EXPECT_TRUE(dropped.at(150, 150));
    gesture.drop.clear();
    gesture.frame = trace::PhotoFrame{{0.0, 0.0}, {side, 160.0}};
    EXPECT_FALSE(trace::cut_out(disc(300), gesture).at(120, 170));
}

RC_GTEST_PROP(Cut, OfNoiseHangsTogetherWithTheAxisOrIsRefused, ()) {
    Picture photo{*rc::gen::inRange(2, 60), *rc::gen::inRange(2, 60), {}};
    photo.rgb.resize(3 * static_cast<std::size_t>(photo.width * photo.height));
    const std::uint8_t grain = *rc::gen::inRange<std::uint8_t>(1, 255);
    for (std::uint8_t& value : photo.rgb)
        value = static_cast<std::uint8_t>(*rc::gen::inRange(0, 256) / grain * grain);
    const auto stroke = [&] {
        trace::Stroke points;
        for (int i = *rc::gen::inRange(2, 5); i > 0; --i)
            points.emplace_back(*rc::gen::inRange(0, photo.width + 1),
                                *rc::gen::inRange(0, photo.height + 1));
        return points;
    };
    trace::Gesture gesture{stroke(), stroke(), {stroke()}, {stroke()}, {}};
    if (*rc::gen::arbitrary<bool>()) gesture.frame = trace::PhotoFrame{stroke()[0], stroke()[1]};
    trace::Mask mask;
    try {
        mask = trace::cut_out(photo, gesture);
    } catch (const InvalidInput& refused) {
        const std::string& path = refused.problems().front().path;
        RC_ASSERT(path.starts_with("/gesture/axis") || path == "/gesture/frame");
        return;
    }
    RC_ASSERT(mask.width == photo.width && mask.height == photo.height);
    RC_ASSERT(trace::without_holes(mask) == mask || mask.area() == 0);
    RC_ASSERT(trace::cut_out(photo, gesture) == mask);
}

TEST(Cut, RefusesAnAxisThatIsNotOnThePhotograph) {
    const auto refused = [](trace::Stroke axis) {
        return refusal([&] {
            static_cast<void>(trace::cut_out(disc(100), {std::move(axis), {}, {}, {}, {}}));
        });
    };
    EXPECT_TRUE(names(refused({{50.0, 60.0}}), "/gesture/axis", "two points"));
    EXPECT_TRUE(names(refused({{50.0, 60.0}, {50.0, -1.0}}), "/gesture/axis/1", "100 x 100"));
}

TEST(Cut, RefusesEveryStrokeThatIsNotOnThePhotograph) {
    const auto refused = [](const auto& change) {
        trace::Gesture gesture{{{50.0, 60.0}, {50.0, 40.0}}, {}, {}, {}, {}};
        change(gesture);
        return refusal([&] { static_cast<void>(trace::cut_out(disc(100), gesture)); });
    };
    using Drawn = trace::Gesture;
    EXPECT_TRUE(names(refused([](Drawn& one) {
                          one.cap = {{5.0, 5.0}, {101.0, 5.0}};
                      }),
                      "/gesture/cap/1", "is not on the photograph of 100 x 100 pixels"));
    EXPECT_TRUE(names(refused([](Drawn& one) {
                          one.keep = {{{5.0, 5.0}}, {{5.0, 300.0}}};
                      }),
                      "/gesture/keep/1/0", "100 x 100"));
    EXPECT_TRUE(names(refused([](Drawn& one) {
                          one.drop = {{{200.0, 5.0}}};
                      }),
                      "/gesture/drop/0/0", "100 x 100"));
    EXPECT_TRUE(names(refused([](Drawn& one) {
                          one.frame = trace::PhotoFrame{{120.0, 10.0}, {150.0, 50.0}};
                      }),
                      "/gesture/frame", "100 x 100"));
    EXPECT_TRUE(refused([](Drawn& one) {
                    one.frame = trace::PhotoFrame{{2.0, 2.0}, {150.0, 99.0}};
                }).empty());
}

}  // namespace
}  // namespace sporeprint::trace_cut_test
