#include "core/params/blend.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <vector>

#include "tests/core/params/arbitrary.h"
#include "tests/core/params/sample.h"

namespace sporeprint {
namespace {

using sample::Request;

/// Two requests whose lists have equal lengths.
std::pair<Request, Request> arbitrary_pair() {
    Request a = arbitrary_of<Request>(), b = arbitrary_of<Request>();
    b.profile = a.profile;
    b.tags = a.tags;
    auto* x = std::get_if<sample::Swept>(&a.model.shape);
    auto* y = std::get_if<sample::Swept>(&b.model.shape);
    if (x && y) y->outline = x->outline;
    return {a, b};
}

TEST(Blend, EndsAreExact) {
    EXPECT_TRUE(rc::check([] {
        const auto [a, b] = arbitrary_pair();
        RC_ASSERT(blend(a, b, 0.0) == a);
        RC_ASSERT(blend(a, b, 1.0) == b);
        RC_ASSERT(blend(a, a, arbitrary_fraction()) == a);
    }));
}

TEST(Blend, StaysInsideTheRanges) {
    EXPECT_TRUE(rc::check([] {
        auto [a, b] = arbitrary_pair();
        a.cap.radius = b.cap.radius = 0.5;  // the cross-field rule
        RC_ASSERT(problems_in(blend(a, b, arbitrary_fraction())).empty());
    }));
}

TEST(Blend, NumbersGoLinearlyAndIntegersRoundHalfUp) {
    EXPECT_EQ(blend(1.0, 3.0, 0.25), 1.5);
    EXPECT_EQ(blend(0, 1, 0.5), 1);
    EXPECT_EQ(blend(1, 0, 0.5), 1);
    EXPECT_EQ(blend(-1, 0, 0.5), 0);
    EXPECT_EQ(blend(0, 10, 0.24), 2);
    EXPECT_EQ(blend(0u, 4294967295u, 0.5), 2147483648u);
    EXPECT_EQ(blend(Range{0, 2}, Range{1, 4}, 0.5), (Range{0.5, 3}));
    EXPECT_EQ(blend(std::vector<double>{0, 1}, std::vector<double>{1, 3}, 0.5),
              (std::vector<double>{0.5, 2}));
}

TEST(Blend, ColoursMixAsLight) {
    // Half the light of white is sRGB 188 (IEC 61966-2-1: 1.055 * 0.5^(1/2.4) - 0.055 = 0.7354).
    EXPECT_EQ(blend(Colour{0, 0, 0}, Colour{255, 255, 255}, 0.5), (Colour{188, 188, 188}));
    EXPECT_EQ(blend(Colour{255, 0, 7}, Colour{0, 255, 7}, 0.5), (Colour{188, 188, 7}));
}

TEST(Blend, TheRestComesFromTheNearer) {
    EXPECT_EQ(blend(false, true, 0.49), false);
    EXPECT_EQ(blend(false, true, 0.5), true);
    EXPECT_EQ(blend(sample::Animation::none, sample::Animation::growth, 0.75),
              sample::Animation::growth);
    EXPECT_EQ(blend(std::optional<double>(1.0), std::optional<double>(), 0.25), 1.0);
    EXPECT_EQ(blend(Choice<1, 2>{1}, Choice<1, 2>{2}, 0.75).value, 2);
    using Shape = std::variant<sample::Swept, sample::Branched>;
    EXPECT_EQ(blend(Shape(sample::Branched{2}), Shape(sample::Branched{6}), 0.5),
              Shape(sample::Branched{4}));
    EXPECT_EQ(blend(Shape(sample::Branched{2}), Shape(sample::Swept{}), 0.25),
              Shape(sample::Branched{2}));
}

TEST(Blend, ListsOfDifferentLengthsAreRefusedByName) {
    Request a, b;
    b.profile.pop_back();
    try {
        blend(a, b, 0.5);
        FAIL() << "must throw";
    } catch (const GenerationError& fault) {
        EXPECT_STREQ(fault.what(), "lists of 3 and 2 items cannot be blended: /profile");
    }
}

TEST(Overlay, CopiesWhatIsSetAlsoInNestedStructs) {
    sample::DeformationOf<Plain> values;
    values.low.bend_deg = 10.0;
    values.high.bend_deg = 20.0;
    values.taper = 0.5;
    sample::DeformationOf<Maybe> overrides;
    sample::DeformationOf<Plain> copy = values;
    overlay(overrides, copy);
    EXPECT_EQ(copy, values);
    overrides.high.bend_deg = 0.0;
    overrides.low.mode = sample::Animation::growth;
    overlay(overrides, copy);
    EXPECT_EQ(copy.low.bend_deg, 10.0);
    EXPECT_EQ(copy.high.bend_deg, 0.0);
    EXPECT_EQ(copy.low.mode, sample::Animation::growth);
    EXPECT_EQ(copy.high.mode, sample::Animation::none);
    EXPECT_EQ(copy.taper, 0.5);
}

TEST(Overlay, ProofRefusesDifferentStructs) {
    static_assert(same_fields<sample::DeformationOf<Maybe>, sample::DeformationOf<Plain>>());
    static_assert(!same_fields<sample::DeformationOf<Plain>, sample::DeformationOf<Plain>>());
    static_assert(!same_fields<sample::BendOf<Maybe>, sample::Knot>());
}

}  // namespace
}  // namespace sporeprint
