// POST /v1/traces and POST /v1/outlines/check.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>

#include "core/surface/codecs.h"
#include "tests/api/support.h"
#include "tests/support/drawn_mushroom.h"
#include "tests/support/small_atlas.h"

namespace sporeprint::api::products_traces_test {
namespace {

using namespace test;

/// One service for all tests, which draws the species of the atlas once.
class TraceRoutes : public testing::Test {
  protected:
    static Service& service() {
        static Service one(small_atlas(), ServiceOptions{});
        return one;
    }
    static Response ask(const Request& one) { return handle(service(), one); }

    /// Returns the name of a picture of a drawn mushroom: red cap, white stem, on grey or on nothing.
    static std::string uploaded(bool is_cut_out) {
        const DrawnMushroom drawn = mushroom();
        const trace::Mask mask = drawn.mask();
        Bytes rgba;
        rgba.reserve(4 * mask.inside.size());
        const double margin = drawn.foot().y - 0.7 * drawn.pixels;
        for (int y = 0; y < drawn.side; ++y)
            for (int x = 0; x < drawn.side; ++x) {
                if (!mask.at(x, y))
                    rgba.insert(rgba.end(),
                                {120, 125, 120, static_cast<std::uint8_t>(is_cut_out ? 0 : 255)});
                else if (y < margin)
                    rgba.insert(rgba.end(), {200, 40, 30, 255});
                else
                    rgba.insert(rgba.end(), {235, 230, 220, 255});
            }
        const Bytes file = png(rgba, drawn.side, drawn.side);
        const Response response =
            ask(post(std::string(file.begin(), file.end()), "/v1/photos", "image/png"));
        EXPECT_EQ(response.status, 201) << text_of(response);
        return json_of(response).find("photo")->as_string();
    }
    static DrawnMushroom mushroom() {
        DrawnMushroom drawn;
        drawn.side = 400;
        drawn.pixels = 280.0;
        return drawn;
    }
    static std::string order(const std::string& photo, bool has_gesture = true,
                             const std::string& more = "") {
        const DrawnMushroom drawn = mushroom();
        const auto point = [](const glm::dvec2& at) {
            return '[' + std::to_string(at.x) + ',' + std::to_string(at.y) + ']';
        };
        const glm::dvec2 across(0.3 * drawn.pixels, -0.1 * drawn.pixels);
        const std::string gesture = R"(,"gesture":{"axis":[)" + point(drawn.axis(0.03)) + ',' +
                                    point(drawn.axis(0.92)) + R"(],"cap":[)" +
                                    point(drawn.axis(0.7) + glm::dvec2(-across.x, across.y)) + ',' +
                                    point(drawn.axis(0.7) + across) + "]}";
        return R"({"views":{"side":{"photo":")" + photo + '"' + (has_gesture ? gesture : "") +
               "}}" + more + '}';
    }
    static Response trace(const std::string& body) { return ask(post(body, "/v1/traces")); }
};

TEST_F(TraceRoutes, GiveASpeciesThatGrows) {
    const Response response =
        trace(order(uploaded(false), true, R"(,"height_m":0.1,"id":"red_one")"));
    ASSERT_EQ(response.status, 200) << text_of(response);
    EXPECT_EQ(header(response, "Cache-Control"), "private, no-store");
    EXPECT_EQ(header(response, "ETag"), "");
    const Value found = json_of(response);
    const DrawnMushroom drawn = mushroom();
    // The marks are those of the drawing, in pixels of the photograph.
    const Value& margins = *found.at_pointer("/marks/margins");
    EXPECT_NEAR(
        margins.items()[1].items()[0].as_number() - margins.items()[0].items()[0].as_number(),
        2.0 * drawn.cap_radius * drawn.pixels, 8.0);
    EXPECT_NEAR(found.at_pointer("/outline/left/0/1")->as_number(), drawn.foot().y, 8.0);
    EXPECT_EQ(found.find("nearest")->items().size(), 5U);
    EXPECT_TRUE(found.at_pointer("/certificate/simple")->as_bool());
    EXPECT_TRUE(found.find("ring")->is_null());
    EXPECT_LT(found.find("error_pct")->as_number(), 2.0);
    EXPECT_EQ(found.at_pointer("/species/id")->as_string(), "red_one");

    // Its stage is a model like any other.
    const auto stage = static_cast<std::size_t>(found.find("stage")->as_number());
    const Value& model = *found.at_pointer("/species/stages")->items()[stage].find("model");
    Value body = Value::object();
    body.set("model", model).set("lod", 2);
    const Response glb = ask(post(dump(body)));
    EXPECT_EQ(glb.status, 200) << text_of(glb).substr(0, 300);
    EXPECT_EQ(text_of(glb).substr(0, 4), "glTF");
}

TEST_F(TraceRoutes, OfOnePhotographAndGestureAreEqual) {
    const std::string body = order(uploaded(false));
    const std::string first = text_of(trace(body));
    EXPECT_EQ(text_of(trace(body)), first);
    // Another upload of the same picture, cut anew.
    EXPECT_EQ(text_of(trace(order(uploaded(false)))), first);
}

TEST_F(TraceRoutes, OfAPictureThatIsCutOutNeedNoGesture) {
    const std::string photo = uploaded(true);
    const Response response = trace(order(photo, false));
    ASSERT_EQ(response.status, 200) << text_of(response);
    const Response with_cap = trace(order(photo));
    expect_problem(with_cap, 422);
    EXPECT_TRUE(names(with_cap, "/views/side/gesture/cap", "cut out already"));
    const Response missing = trace(order(uploaded(false), false));
    expect_problem(missing, 422);
    EXPECT_TRUE(names(missing, "/views/side/gesture", "is missing"));
}

/// Returns an order with the outline, the marks and the form of a response, without a gesture.
std::string marked_order(const std::string& photo, const Value& found, const Value& marks) {
    Value side = Value::object(), views = Value::object(), body = Value::object();
    side.set("photo", photo);
    views.set("side", std::move(side));
    body.set("views", std::move(views));
    for (const char* member : {"outline", "form", "template"})
        body.set(member, *found.find(member));
    body.set("marks", marks);
    return dump(body);
}

TEST_F(TraceRoutes, OfTheOutlineAndMarksOfAResponseHaveItsShape) {
    for (const bool is_cut_out : {false, true}) {
        const std::string photo = uploaded(is_cut_out);
        const Response first = trace(order(photo, !is_cut_out));
        ASSERT_EQ(first.status, 200) << text_of(first);
        const Value found = json_of(first), marks = *found.find("marks");
        const Response again = trace(marked_order(photo, found, marks));
        ASSERT_EQ(again.status, 200) << text_of(again);
        const Value same = json_of(again);
        for (const char* member : {"outline", "marks", "angles", "error_pct", "method", "stage"})
            EXPECT_EQ(dump(*same.find(member)), dump(*found.find(member))) << member;
        const std::string shape =
            "/species/stages/" + dump(*found.find("stage")) + "/model/silhouette";
        EXPECT_EQ(dump(*same.at_pointer(shape)), dump(*found.at_pointer(shape)));
        // A photograph that was not cut yet gives the same.
        const std::string other = uploaded(is_cut_out);
        EXPECT_EQ(text_of(trace(marked_order(other, found, marks))), text_of(again));
    }
}

TEST_F(TraceRoutes, FollowMarksThatAreMovedAndNameThoseThatCannotBe) {
    const std::string photo = uploaded(false);
    const Value found = json_of(trace(order(photo)));
    const auto with_margin = [&](double x, double y) {
        Value margins = Value::array();
        margins.push(Value(Value::Array{x, y}));
        margins.push(found.at_pointer("/marks/margins")->items()[1]);
        Value marks = Value::object();
        marks.set("junctions", *found.at_pointer("/marks/junctions"));
        marks.set("margins", std::move(margins));
        return trace(marked_order(photo, found, marks));
    };
    // The left margin a good way up the cap.
    const Value& left = *found.at_pointer("/outline/left");
    const Value& place = left.items()[left.items().size() - 12];
    const Response moved = with_margin(place.items()[0].as_number(), place.items()[1].as_number());
    ASSERT_EQ(moved.status, 200) << text_of(moved);
    EXPECT_EQ(dump(*json_of(moved).at_pointer("/marks/margins/0")), dump(place));
    const std::string shape = "/species/stages/" + dump(*found.find("stage")) + "/model/silhouette";
    EXPECT_NE(dump(*json_of(moved).at_pointer(shape)), dump(*found.at_pointer(shape)));

    const Value& apex = left.items().back();
    const Response above = with_margin(apex.items()[0].as_number(), 2.0);
    expect_problem(above, 422);
    EXPECT_TRUE(names(above, "/marks/margins/0", "above the apex"));
    const Response outside = with_margin(10.0, 900.0);
    expect_problem(outside, 422);
    EXPECT_TRUE(names(outside, "/marks/margins/0", "400 x 400"));
    const Response without = trace(order(photo, true, R"(,"marks":{"junctions":[],"margins":[]})"));
    expect_problem(without, 400);
    EXPECT_TRUE(names(without, "/marks/junctions", "two are needed"));
}

TEST_F(TraceRoutes, NameWhatIsWrong) {
    const std::string photo = uploaded(false);
    const Response gone = trace(order("AAAAAAAAAAAAAAAAAAAAAA"));
    expect_problem(gone, 404);
    EXPECT_TRUE(names(gone, "/views/side/photo", "upload it again"));
    const Response unknown = trace(order(photo, true, R"(,"template":"boletus")"));
    expect_problem(unknown, 404);
    EXPECT_TRUE(names(unknown, "/template", "boletus_edulis"));
    const Response coral = trace(order(photo, true, R"(,"template":"artomyces_pyxidatus")"));
    expect_problem(coral, 422);
    EXPECT_TRUE(names(coral, "/template", "no outline"));
    const Response high = trace(order(photo, true, R"(,"height_m":3)"));
    expect_problem(high, 400);
    EXPECT_TRUE(names(high, "/height_m", "0.002..1"));
    const Response outside = trace(R"({"views":{"side":{"photo":")" + photo +
                                   R"(","gesture":{"axis":[[10,10],[900,20]]}}}})");
    expect_problem(outside, 422);
    EXPECT_TRUE(names(outside, "/views/side/gesture/axis/1", "400 x 400"));
    const Response null =
        trace(R"({"views":{"side":{"photo":")" + photo + R"(","gesture":null}}})");
    expect_problem(null, 400);
    EXPECT_TRUE(names(null, "/views/side/gesture", "expected an object with the line axis"));
    expect_problem(trace("[]"), 400);
    expect_problem(trace("{}"), 400);
}

/// Returns the name of a picture of a round cap that is cut out, of one colour.
std::string uploaded_cap(Service& service, std::array<std::uint8_t, 3> colour) {
    constexpr int side = 300;
    Bytes rgba;
    rgba.reserve(std::size_t{4} * side * side);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const bool is_cap = (x - 150) * (x - 150) + (y - 150) * (y - 150) < 130 * 130;
            rgba.insert(rgba.end(), {colour[0], colour[1], colour[2],
                                     static_cast<std::uint8_t>(is_cap ? 255 : 0)});
        }
    const Bytes file = png(rgba, side, side);
    const Response response =
        handle(service, post(std::string(file.begin(), file.end()), "/v1/photos", "image/png"));
    EXPECT_EQ(response.status, 201) << text_of(response);
    return json_of(response).find("photo")->as_string();
}

TEST_F(TraceRoutes, TakeColoursAndImagesFromAboveAndBelow) {
    const std::string side = uploaded(false), above = uploaded_cap(service(), {90, 60, 160}),
                      below = uploaded_cap(service(), {200, 170, 60});
    const std::string one = order(side, true, R"(,"images":true)");
    const std::string views = R"(,"above":{"photo":")" + above + R"("},"below":{"photo":")" +
                              below + R"(","centre":[150,150],"stem_end":[150,160]})";
    std::string with_views = one;
    with_views.insert(with_views.find(R"(},"images")"), views);
    const auto surface = [](const Response& response) {
        const Value found = json_of(response);
        const auto stage = static_cast<std::size_t>(found.find("stage")->as_number());
        return *found.at_pointer("/species/stages")->items()[stage].at_pointer("/model/surface");
    };
    const Response alone = trace(one), seen = trace(with_views);
    ASSERT_EQ(seen.status, 200) << text_of(seen);
    EXPECT_NE(surface(seen).at_pointer("/cap/ramp/0")->as_string(),
              surface(alone).at_pointer("/cap/ramp/0")->as_string());
    EXPECT_EQ(surface(alone).at_pointer("/hymenium/image"), nullptr);
    ASSERT_NE(surface(seen).at_pointer("/hymenium/image"), nullptr);
    // Both were cut out once, and give the same again.
    EXPECT_EQ(text_of(trace(with_views)), text_of(seen));
}

TEST_F(TraceRoutes, NameWhatIsWrongWithOtherViews) {
    const std::string side = uploaded(false);
    const auto with = [&](const std::string& views) {
        std::string body = order(side);
        return trace(body.insert(body.size() - 2, ',' + views));
    };
    const Response gone = with(R"("above":{"photo":"AAAAAAAAAAAAAAAAAAAAAA"})");
    expect_problem(gone, 404);
    EXPECT_TRUE(names(gone, "/views/above/photo", "upload it again"));
    const Response missing = with(R"("below":{})");
    expect_problem(missing, 400);
    EXPECT_TRUE(names(missing, "/views/below/photo", "is missing"));
    const Response uncut = with(R"("below":{"photo":")" + side + R"("})");
    expect_problem(uncut, 422);
    EXPECT_TRUE(names(uncut, "/views/below/gesture", "is missing"));
    const Response null = with(R"("below":{"photo":")" + side + R"(","gesture":null})");
    expect_problem(null, 400);
    EXPECT_TRUE(names(null, "/views/below/gesture", "got null"));
    const std::string cap = uploaded_cap(service(), {90, 60, 160});
    const Response outside = with(R"("above":{"photo":")" + cap + R"(","centre":[350,20]})");
    expect_problem(outside, 422);
    EXPECT_TRUE(names(outside, "/views/above/centre", "300 x 300"));
    const Response stem = with(R"("above":{"photo":")" + cap + R"(","stem_end":[35,20]})");
    expect_problem(stem, 400);
    EXPECT_TRUE(names(stem, "/views/above/stem_end", "from above the cap hides its stem"));
}

TEST_F(TraceRoutes, CheckOutlines) {
    const auto check = [&](const std::string& cap) {
        return ask(post(R"({"silhouette":{"stem":[{"r":0,"y":-0.005},{"r":0.01,"y":0},)"
                        R"({"r":0.01,"y":0.07}],"hymenium":[{"r":0.01,"y":0.07},)"
                        R"({"r":0.04,"y":0.065}],"cap":[{"r":0.04,"y":0.065},)" +
                            cap + R"({"r":0,"y":0.1}]}})",
                        "/v1/outlines/check"));
    };
    const Response simple = check(R"({"r":0.03,"y":0.09},)");
    ASSERT_EQ(simple.status, 200) << text_of(simple);
    EXPECT_TRUE(json_of(simple).find("simple")->as_bool());
    EXPECT_TRUE(json_of(simple).find("problem")->is_null());
    const Value crossing = json_of(check(R"({"r":0.005,"y":0.03},)"));
    EXPECT_FALSE(crossing.find("simple")->as_bool());
    EXPECT_FALSE(crossing.at_pointer("/problem/curve")->as_string().empty());
    const Response open = ask(post(R"({"silhouette":{"stem":[],"cap":[]}})", "/v1/outlines/check"));
    expect_problem(open, 422);
    EXPECT_TRUE(names(open, "/silhouette"));
    expect_problem(ask(post(R"({"outline":{}})", "/v1/outlines/check")), 400);
    for (const char* body : {"{}", R"({"axis":[]})"}) {
        const Response missing = ask(post(body, "/v1/outlines/check"));
        expect_problem(missing, 400);
        EXPECT_TRUE(names(missing, "/silhouette", "is missing")) << body;
    }
    expect_problem(ask(post(R"({"silhouette":{}})", "/v1/outlines/check")), 422);
}

}  // namespace
}  // namespace sporeprint::api::products_traces_test
