#include "server/http/trace.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace sporeprint::server::http_trace_test {
namespace {

const std::string trace = "4bf92f3577b34da6a3ce929d0e0e4736", parent = "00f067aa0ba902b7";
const std::string good = "00-" + trace + '-' + parent + "-01";

TEST(Trace, IsReadFromTheExamplesOfTheStandard) {
    const auto found = trace_of(good);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->trace_id, trace);
    EXPECT_EQ(found->parent_id, parent);
    EXPECT_TRUE(trace_of("cc-" + good.substr(3)));
    EXPECT_TRUE(trace_of("cc-" + good.substr(3) + "-what-the-future-will-be-like"));
}

TEST(Trace, IsOmittedIfMalformed) {
    const std::vector<std::string> bad = {
        "",
        "00",
        good + "-",
        good + "-x",
        good + " ",
        "ff-" + good.substr(3),
        "0-" + good.substr(3),
        "cc-" + good.substr(3) + ".more",
        "00-" + std::string(32, '0') + '-' + parent + "-01",
        "00-" + trace + '-' + std::string(16, '0') + "-01",
        "00-4BF92F3577B34DA6A3CE929D0E0E4736-" + parent + "-01",
        "00-" + trace + '-' + parent + "-0",
        "00-" + trace + '-' + parent + "-0g",
        "00-" + trace + parent + "--01",
        "00-\"},{\"forged\":\"4da6a3ce929d0e0e-" + parent + "-01"};
    for (const std::string& one : bad) EXPECT_FALSE(trace_of(one)) << one;
    EXPECT_FALSE(trace_in(std::vector<api::Header>{}));
    EXPECT_TRUE(trace_in(std::vector<api::Header>{{"TraceParent", good}}));
    EXPECT_FALSE(trace_in(std::vector<api::Header>{{"traceparent", good}, {"traceparent", good}}))
        << "ambiguous";
}

RC_GTEST_PROP(Trace, ContainsOnlyDigits, ()) {
    std::string text = good;
    for (int i = *rc::gen::inRange(0, 4); i > 0; --i)
        text[*rc::gen::inRange<std::size_t>(0, text.size())] =
            *rc::gen::element('0', 'f', 'F', 'g', '-', '"', '\\', '\n', '\xff', ' ');
    const auto found = trace_of(text);
    if (!found) return;
    const auto digits = [](std::string_view part) {
        return part.find_first_not_of("0123456789abcdef") == part.npos;
    };
    RC_ASSERT(digits(found->trace_id) && found->trace_id.size() == 32u);
    RC_ASSERT(digits(found->parent_id) && found->parent_id.size() == 16u);
}

}  // namespace
}  // namespace sporeprint::server::http_trace_test
