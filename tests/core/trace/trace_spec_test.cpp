#include "core/trace/trace_spec.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

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

TEST(TraceSpec, MayHaveAnOutlineWithMarks) {
    const std::string text =
        R"({"views":{"side":{"photo":"abc"}},"outline":{"left":[[1,2],[3,4]],"right":[[5,6]],"axis":[[7,8]]},)"
        R"("marks":{"junctions":[[1,2],[3,4]],"margins":[[5,6],[7,8.25]],"cap_turn_deg":-4.5},)"
        R"("template":"auto","id":"mine","form":"cup","images":false})";
    std::vector<Problem> problems;
    const auto spec = read_json<trace::TraceSpec>(text, problems);
    ASSERT_TRUE(problems.empty());
    EXPECT_EQ(dump(write(spec)), text);
    const std::optional<trace::MarkedOutline> outline = trace::marked_outline_of(spec);
    ASSERT_TRUE(outline.has_value());
    EXPECT_EQ(outline->left[1], glm::dvec2(3.0, 4.0));
    EXPECT_EQ(outline->axis[0], glm::dvec2(7.0, 8.0));
    EXPECT_EQ(outline->margins[1], glm::dvec2(7.0, 8.25));
    EXPECT_EQ(outline->cap_turn_deg, -4.5);
    EXPECT_FALSE(trace::marked_outline_of({}).has_value());
}

TEST(TraceSpec, NamesWhatIsWrongWithAnOutlineAndItsMarks) {
    const std::string lines = R"("outline":{"left":[[1,2]],"right":[[1,2]],"axis":[[1,2]]})",
                      marks = R"("marks":{"junctions":[[1,2],[3,4]],"margins":[[5,6],[7,8]]})",
                      form = R"(,"form":"capped")";
    const auto first = [](const std::string& members) {
        const auto problems = problems_of(R"({"views":{"side":{"photo":"abc"}},)" + members + "}");
        return problems.empty() ? std::string() : problems[0].path + ": " + problems[0].message;
    };
    EXPECT_EQ(first(lines + "," + marks + form), "");
    EXPECT_TRUE(first(lines + form).starts_with("/marks: is missing"));
    EXPECT_TRUE(first(marks + form).starts_with("/outline: is missing"));
    EXPECT_TRUE(first(lines + "," + marks).starts_with("/form: auto is for photographs"));
    EXPECT_TRUE(first(lines + R"(,"marks":{"junctions":[[1,2]],"margins":[[5,6],[7,8]]})" + form)
                    .starts_with("/marks/junctions: 1 places; two are needed"));
    EXPECT_TRUE(first(lines + R"(,"marks":{"junctions":[[1,2],[3,4]]})" + form)
                    .starts_with("/marks/margins: 0 places"));
    EXPECT_TRUE(
        first(lines +
              R"(,"marks":{"junctions":[[1,2],[3,4]],"margins":[[5,6],[7,8]],"cap_turn_deg":99})")
            .starts_with("/marks/cap_turn_deg: "));
    std::string points;
    for (int i = 0; i < 257; ++i) points += i == 0 ? "[1,1]" : ",[1,1]";
    EXPECT_TRUE(first(R"("outline":{"left":[)" + points + "]}")
                    .starts_with("/outline/left: a list of 257 items; at most 256"));
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
