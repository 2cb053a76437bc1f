#include "core/trace/trace_spec.h"

#include <gtest/gtest.h>

#include <string>

#include "core/params/reader.h"

namespace sporeprint::trace_trace_spec_test {
namespace {

std::vector<Problem> problems_of(const std::string& text) {
    std::vector<Problem> problems;
    static_cast<void>(read_json<trace::TraceSpec>(text, problems));
    return problems;
}

TEST(TraceSpec, IsReadAsItIsWritten) {
    const std::string text =
        R"({"views":{"side":{"photo":"abc","gesture":{"axis":[[1,2],[3,4.5]],"cap":[],)"
        R"("keep":[[[5,6]],[[7,8],[9,10]]],"drop":[],"frame":[10,20,30,40]}}},)"
        R"("template":"boletus_edulis","id":"mine","form":"cup","hollow":0.5,"height_m":0.1,"images":true})";
    std::vector<Problem> problems;
    const auto spec = read_json<trace::TraceSpec>(text, problems);
    ASSERT_TRUE(problems.empty());
    EXPECT_EQ(dump(write(spec)), text);
    const trace::Gesture gesture = trace::gesture_of(*spec.views.side.gesture);
    EXPECT_EQ(gesture.axis[1], glm::dvec2(3.0, 4.5));
    EXPECT_EQ(gesture.keep[1][1], glm::dvec2(9.0, 10.0));
    EXPECT_EQ(gesture.frame->from, glm::dvec2(10.0, 20.0));
    EXPECT_EQ(gesture.frame->to, glm::dvec2(40.0, 60.0));
    EXPECT_TRUE(gesture.cap.empty());
}

TEST(TraceSpec, NamesWhatIsWrong) {
    const std::string photo = R"("photo":"abc")";
    EXPECT_EQ(problems_of(R"({"views":{"side":{}}})"),
              (std::vector<Problem>{{"/views/side/photo", "is missing"}}));
    EXPECT_EQ(problems_of("{}").size(), 1U);
    const auto first = [&](const std::string& gesture) {
        const auto problems =
            problems_of(R"({"views":{"side":{)" + photo + R"(,"gesture":)" + gesture + "}}}");
        return problems.empty() ? std::string() : problems[0].path;
    };
    EXPECT_EQ(first(R"({"axis":[[1,2],[3]]})"), "/views/side/gesture/axis/1");
    EXPECT_EQ(first(R"({"axis":[[1,-2]]})"), "/views/side/gesture/axis/0/1");
    EXPECT_EQ(first(R"({"axes":[]})"), "/views/side/gesture/axes");
    EXPECT_EQ(first(R"({"frame":[10,10,0,20]})"), "/views/side/gesture/frame");
    std::string strokes;
    for (int i = 0; i < 17; ++i) strokes += i == 0 ? "[[1,1]]" : ",[[1,1]]";
    EXPECT_EQ(first(R"({"keep":[)" + strokes + "]}"), "/views/side/gesture");
    std::string points;
    for (int i = 0; i < 65; ++i) points += i == 0 ? "[1,1]" : ",[1,1]";
    EXPECT_EQ(first(R"({"axis":[)" + points + "]}"), "/views/side/gesture/axis");
    for (const char* id : {"", "Red bolete", "a-b"})
        EXPECT_EQ(
            problems_of(R"({"views":{"side":{)" + photo + R"(}},"id":")" + id + R"("})")[0].path,
            "/id")
            << id;
}

}  // namespace
}  // namespace sporeprint::trace_trace_spec_test
