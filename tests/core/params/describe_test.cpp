#include "core/params/describe.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "tests/core/params/sample.h"

namespace sporeprint::params_describe_test {
namespace {

using sample::Request;

TEST(Describe, CountsMembersOfEveryKind) {
    static_assert(member_count<sample::Cap>() == 4);
    static_assert(member_count<sample::Bare>() == 0);
    static_assert(member_count<sample::Branched>() == 1);
    static_assert(member_count<Request>() == 22);
}

struct Forgets {
    double a = 0.0, b = 0.0;
    static constexpr void fields(auto visit) {
        visit(&Forgets::a, Info{.name = "a", .max = 1, .doc = "A."});
    }
};
struct Doubles {
    double a = 0.0, b = 0.0;
    static constexpr void fields(auto visit) {
        visit(&Doubles::a, Info{.name = "a", .max = 1, .doc = "A."});
        visit(&Doubles::a, Info{.name = "b", .max = 1, .doc = "B."});
    }
};
struct DoublesBesideForms {
    std::variant<sample::Swept> shape;
    double a = 0.0, b = 0.0;
    static constexpr void fields(auto visit) {
        visit(&DoublesBesideForms::shape, Info{.name = ""});
        visit(&DoublesBesideForms::a, Info{.name = "a", .max = 1, .doc = "A."});
        visit(&DoublesBesideForms::a, Info{.name = "b", .max = 1, .doc = "B."});
    }
};
struct SameName {
    double a = 0.0, b = 0.0;
    static constexpr void fields(auto visit) {
        visit(&SameName::a, Info{.name = "a", .max = 1, .doc = "A."});
        visit(&SameName::b, Info{.name = "a", .max = 1, .doc = "B."});
    }
};
struct InlinedSameName {
    sample::Knot knot;
    double r = 0.0;
    static constexpr void fields(auto visit) {
        visit(&InlinedSameName::knot, Info{.name = ""});
        visit(&InlinedSameName::r, Info{.name = "r", .max = 1, .doc = "Also in the knot."});
    }
};
template <int Case>
struct OneNumber {
    double angle = 2.0;
    static constexpr void fields(auto visit) {
        constexpr Info infos[] = {
            {.name = "angle", .min = 0, .max = 3, .doc = "Fine."},
            {.name = "angle", .min = 0, .max = 3},                                // no doc
            {.name = "angle", .min = 3, .max = 3, .doc = "No width."},            //
            {.name = "angle", .min = 0, .max = 1, .doc = "Default outside."},     //
            {.name = "Angle", .min = 0, .max = 3, .doc = "Capital."},             //
            {.name = "angle_deg", .min = 0, .max = 3, .doc = "Unit missing."},    //
            {.name = "angle", .unit = "deg", .min = 0, .max = 3, .doc = "Bare."}  //
        };
        visit(&OneNumber::angle, infos[Case]);
    }
};
struct ListWithoutMost {
    std::vector<double> list;
    static constexpr void fields(auto visit) {
        visit(&ListWithoutMost::list, Info{.name = "list", .max = 1, .doc = "A list."});
    }
};
struct ListDefaultOutside {
    std::vector<double> list = {0.5, 7.0};
    static constexpr void fields(auto visit) {
        visit(&ListDefaultOutside::list, Info{.name = "list", .max = 1, .most = 3, .doc = "A."});
    }
};
struct SmallInteger {
    std::uint8_t small = 0;
    static constexpr void fields(auto visit) {
        visit(&SmallInteger::small, Info{.name = "small", .max = 256, .doc = "Cannot hold 256."});
    }
};
struct RangeBackwards {
    Range range{0.5, 0.25};
    static constexpr void fields(auto visit) {
        visit(&RangeBackwards::range, Info{.name = "range", .max = 1, .doc = "From above to."});
    }
};

TEST(Describe, ProofFindsEveryError) {
    static_assert(!well_described<Forgets>());
    static_assert(!well_described<Doubles>());
    static_assert(!well_described<DoublesBesideForms>());
    static_assert(!well_described<SameName>());
    static_assert(!well_described<InlinedSameName>());
    static_assert(well_described<OneNumber<0>>());
    static_assert(!description_of<OneNumber<1>>.documented);
    static_assert(!description_of<OneNumber<2>>.bounded);
    static_assert(!description_of<OneNumber<3>>.in_bounds);
    static_assert(!description_of<OneNumber<4>>.named);
    static_assert(!description_of<OneNumber<5>>.named);
    static_assert(!description_of<OneNumber<6>>.named);
    static_assert(!description_of<ListWithoutMost>.bounded);
    static_assert(!description_of<ListDefaultOutside>.in_bounds);
    static_assert(!description_of<SmallInteger>.bounded);
    static_assert(!description_of<RangeBackwards>.in_bounds);
}

TEST(Describe, DefaultsHaveNoProblems) { EXPECT_TRUE(problems_in(Request{}).empty()); }

TEST(Describe, CheckFindsEveryKindOfErrorWithItsPath) {
    Request request;
    request.age = 1.7;
    request.cap.gill_count = -1;
    request.origin.r = 2.0;  // inlined: no name of its own in the path
    request.animation = static_cast<sample::Animation>(7);
    request.texture_size.value = 300;
    request.rough = 0.31f;
    request.deformation.low.bend_deg = 91.0;
    request.season = Range{9.0, 3.0};
    request.model.shape = sample::Swept{.outline = std::vector<sample::Knot>(9)};
    request.wind[1] = 10.0;
    request.profile = {1.0, 5.0};
    request.tags = {Text<8>("a\nb")};
    request.image = uploaded(std::vector<std::uint8_t>(1001));
    const std::vector<Problem> expected = {
        {"/age", "1.7 is outside 0..1"},
        {"/animation", "no name for value 7; one of none, growth"},
        {"/texture_size", "300 is not one of 128, 256, 512, 1024"},
        {"/rough", "0.31 is outside 0.1..0.3"},
        {"/cap/gill_count", "-1 is outside 0..400"},
        {"/r", "2 is outside 0..1"},
        {"/deformation/low/bend_deg", "91 is outside 0..90"},
        {"/season", "a range begins with its smaller end, got [9, 3]"},
        {"/model/outline", "a list of 9 items; at most 8 are allowed"},
        {"/wind/1", "10 is outside -9..9"},
        {"/profile/1", "5 is outside 0.1..4"},
        {"/tags/0", "'a?b' holds control characters or is not UTF-8"},
        {"/image", "1001 bytes; at most 1000 are allowed"},
    };
    const std::vector<Problem> found = problems_in(request);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_EQ(found[i].path, expected[i].path);
        EXPECT_EQ(found[i].message, expected[i].message);
    }
}

TEST(Describe, NotANumberIsOutsideEveryRange) {
    Request request;
    request.age = std::numeric_limits<double>::quiet_NaN();
    request.cap.radius = std::numeric_limits<double>::infinity();
    const std::vector<Problem> expected = {{"/age", "nan is outside 0..1"},
                                           {"/cap/radius", "inf is outside 0.002..0.5"}};
    EXPECT_EQ(problems_in(request), expected);
}

TEST(Describe, CrossFieldRuleIsCalledWhenItsFieldsAreValid) {
    Request request;
    request.stem_radius = 0.1;
    const std::vector<Problem> expected = {{"/stem_radius", "must be smaller than /cap/radius"}};
    EXPECT_EQ(problems_in(request), expected);
    request.age = 2.0;
    EXPECT_EQ(problems_in(request).size(), 1u) << "only the age is told";
}

TEST(Describe, RequireValidThrowsAllProblems) {
    Request request;
    EXPECT_NO_THROW(require_valid(request));
    request.age = 2.0;
    request.cap.tilt_deg = -1.0;
    try {
        require_valid(request);
        FAIL() << "must throw";
    } catch (const InvalidInput& error) {
        EXPECT_EQ(error.problems().size(), 2u);
        EXPECT_STREQ(error.what(), "/age: 2 is outside 0..1; /cap/tilt_deg: -1 is outside 0..60");
    }
}

TEST(Describe, ProblemsAreBounded) {
    std::vector<Problem> problems;
    for (int i = 0; i < 1000; ++i) report(problems, "/x", "wrong");
    EXPECT_EQ(problems.size(), most_problems);
}

TEST(Describe, FormsAreSelectedByNameAndKeepTheirValues) {
    std::variant<sample::Swept, sample::Branched> shape = sample::Branched{.forks = 7};
    EXPECT_TRUE(FormsOf<decltype(shape)>::select(shape, "branched"));
    EXPECT_EQ(std::get<sample::Branched>(shape).forks, 7u);
    EXPECT_FALSE(FormsOf<decltype(shape)>::select(shape, "bare"));
    EXPECT_STREQ(form_of(shape), "branched");
    EXPECT_TRUE(FormsOf<decltype(shape)>::select(shape, "swept"));
    EXPECT_STREQ(form_of(shape), "swept");
}

}  // namespace
}  // namespace sporeprint::params_describe_test
