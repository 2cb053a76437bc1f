// Morphs of two species over HTTP: their correspondence, and mushrooms between them with the designer's own arcs.

#include "api/products/morphs.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "core/grow/species_morph.h"
#include "core/params/messages.h"
#include "tests/api/support.h"

namespace sporeprint::api::products_morphs_test {
namespace {

using test::errors_of;
using test::expect_problem;
using test::first_species;
using test::get;
using test::header;
using test::json_of;
using test::names;
using test::post;
using test::request;
using test::second_species;
using test::text_of;

const char* const first = "amanita_muscaria";
const char* const other = "boletus_edulis";

std::string morph(const std::string& a = first, const std::string& b = other) {
    return "/v1/morphs/" + a + '/' + b;
}

Request between(const std::string& body, const std::string& a = first,
                const std::string& b = other) {
    return post(body, morph(a, b) + ".glb");
}

/// A body that costs little.
std::string small(const std::string& more) {
    return "{\"lod\":3,\"textures\":\"none\"" + (more.empty() ? "" : ',' + more) + '}';
}

class MorphsTest : public test::RequestedService {};

// --- The correspondence -------------------------------------------------------------------

TEST_F(MorphsTest, PointKOfOneOutlineBecomesPointKOfTheOther) {
    const Response response = ask(morph() + "?age=0.5");
    ASSERT_EQ(response.status, 200) << text_of(response);
    const Value body = json_of(response);
    EXPECT_EQ(body.find("a")->as_string(), first);
    EXPECT_EQ(body.find("b")->as_string(), other);
    EXPECT_EQ(body.find("age")->as_number(), 0.5);
    EXPECT_EQ(body.at_pointer("/certificate/simple")->as_bool(), true);
    EXPECT_EQ(body.at_pointer("/certificate/method")->as_string(), "exact");
    for (const char* curve : {"stem", "hymenium", "cap"}) {
        const Value& a = *body.at_pointer(std::string("/outlines/a/") + curve);
        const Value& b = *body.at_pointer(std::string("/outlines/b/") + curve);
        EXPECT_GE(a.items().size(), 2u) << curve;
        EXPECT_EQ(a.items().size(), b.items().size()) << curve;
    }
    for (const char* side : {"a", "b"}) {
        const Value& outline = *body.at_pointer(std::string("/outlines/") + side);
        EXPECT_EQ(outline.find("stem")->items().back(), outline.find("hymenium")->items().front());
        EXPECT_EQ(outline.find("hymenium")->items().back(), outline.find("cap")->items().front());
        EXPECT_EQ(outline.find("stem")->items().front().items()[0].as_number(), 0.0);
        EXPECT_EQ(outline.find("cap")->items().back().items()[0].as_number(), 0.0);
        const double height = outline.find("cap")->items().back().items()[1].as_number();
        EXPECT_GT(height, 0.02) << "metres";
        EXPECT_LT(height, 0.4);
    }
}

TEST_F(MorphsTest, ArcsRiseOnBothOutlines) {
    const Value body = json_of(ask(morph()));
    const auto& arcs = body.find("arcs")->items();
    EXPECT_GE(arcs.size(), 9u);
    EXPECT_LE(arcs.size(), most_arcs) << "a picture of them can be read, and a body can bring them";
    for (std::size_t i = 1; i < arcs.size(); ++i) {
        for (const char* side : {"a", "b"}) {
            EXPECT_GT(arcs[i].find(side)->as_number(), 0.0);
            EXPECT_LT(arcs[i].find(side)->as_number(), 1.0);
            if (*arcs[i].find("curve") == *arcs[i - 1].find("curve")) {
                EXPECT_GT(arcs[i].find(side)->as_number(), arcs[i - 1].find(side)->as_number());
            }
        }
    }
    // Arcs of the client's own that agree with the correspondence are no contradiction.
    const Response same = ask(between(small("\"arcs\":" + dump(*body.find("arcs")))));
    EXPECT_EQ(same.status, 200) << text_of(same);
}

TEST_F(MorphsTest, TheOtherWayRoundIsTheMirrorImage) {
    const Value one = json_of(ask(morph())), two = json_of(ask(morph(other, first)));
    EXPECT_EQ(*one.at_pointer("/outlines/a"), *two.at_pointer("/outlines/b"));
    EXPECT_EQ(*one.at_pointer("/outlines/b"), *two.at_pointer("/outlines/a"));
    EXPECT_EQ(*one.at_pointer("/arcs/3/a"), *two.at_pointer("/arcs/3/b"));
    EXPECT_NE(header(ask(morph()), "ETag"), header(ask(morph(other, first)), "ETag"));
}

TEST_F(MorphsTest, APairAndTheMushroomsBetweenShareOneCorrespondence) {
    const Response response = ask(morph());
    EXPECT_EQ(header(response, "Cache-Status"),
              "sporeprint-morph; fwd=miss; stored, sporeprint; fwd=miss; stored");
    const Response mushroom = ask(between(small("\"t\":0.25")));
    EXPECT_EQ(header(mushroom, "Cache-Status"),
              "sporeprint-morph; hit, sporeprint; fwd=miss; stored");
    EXPECT_EQ(header(ask(morph() + "?age=0.2"), "Cache-Status"),
              "sporeprint-morph; hit, sporeprint; fwd=miss; stored");
    EXPECT_EQ(service_.counters().morph_misses, 1u);
}

TEST_F(MorphsTest, ACorrespondenceIsAResourceLikeAnyOther) {
    const Response response = ask(morph() + "?age=0.60");
    ASSERT_EQ(response.status, 200) << text_of(response);
    EXPECT_EQ(header(response, "Content-Type"), "application/json");
    EXPECT_EQ(header(response, "Content-Disposition"),
              "inline; filename=\"amanita_muscaria-boletus_edulis.json\"");
    EXPECT_EQ(header(response, "Cache-Control"),
              "public, max-age=3600, stale-while-revalidate=86400");
    const std::string where = header(response, "Content-Location");
    EXPECT_TRUE(where.starts_with(morph() + "?v=")) << where;
    const Value body = json_of(response);
    EXPECT_EQ(body.find("canonical")->as_string(), morph());
    EXPECT_TRUE(where.ends_with(body.find("v")->as_string()));

    const Response again = ask(where);
    EXPECT_EQ(header(again, "Cache-Status"), "sporeprint; hit");
    EXPECT_EQ(header(again, "ETag"), header(response, "ETag"));
    EXPECT_EQ(header(again, "Cache-Control"), "public, max-age=31536000, immutable");
    EXPECT_EQ(ask(morph(), {{"If-None-Match", header(response, "ETag")}}).status, 304);
    const Response head = ask(request("HEAD", morph()));
    EXPECT_EQ(header(head, "ETag"), header(response, "ETag"));
    EXPECT_EQ(size_of(head.body), size_of(response.body));
    const Response zipped = ask(morph(), {{"Accept-Encoding", "gzip"}});
    EXPECT_EQ(header(zipped, "Content-Encoding"), "gzip");
    EXPECT_TRUE(header(zipped, "ETag").ends_with("-gz\""));

    const Response old = ask(morph() + "?age=0.5&v=0-00000000");
    expect_problem(old, 410);
    EXPECT_TRUE(json_of(old).find("canonical")->as_string().starts_with(morph() + "?age=0.5&v="));
}

TEST_F(MorphsTest, ErrorsOfAPairAreNamed) {
    const Response same = ask(morph(first, first));
    expect_problem(same, 422);
    EXPECT_TRUE(names(same, "b", "cannot be morphed into itself")) << text_of(same);
    const Response unknown = ask(morph("amanita_muscara", "boletus_eduli") + "?age=2&lod=1");
    expect_problem(unknown, 404);
    EXPECT_TRUE(names(unknown, "a", "did you mean 'amanita_muscaria'?")) << text_of(unknown);
    EXPECT_TRUE(names(unknown, "b", "did you mean 'boletus_edulis'?"));
    EXPECT_TRUE(names(unknown, "age", "outside 0..1"));
    EXPECT_TRUE(names(unknown, "lod", "unknown parameter"));
    EXPECT_EQ(errors_of(unknown).size(), 4u);
    for (const char* query : {"age=old", "age=0.5&age=0.5", "v=1&v=1", "ag=0.5"})
        expect_problem(ask(morph() + '?' + query), 400);
    const Response posted = ask(between("{}", first, first));
    expect_problem(posted, 422);
    expect_problem(ask(between("{}", "xyzzy")), 404);
}

TEST_F(MorphsTest, MethodsOfBothUrlsAreListed) {
    const Response deleted = ask(request("DELETE", morph()));
    expect_problem(deleted, 405);
    EXPECT_EQ(header(deleted, "Allow"), "GET, HEAD, OPTIONS");
    const Response got = ask(morph() + ".glb");
    expect_problem(got, 405);
    EXPECT_EQ(header(got, "Allow"), "POST, OPTIONS");
    expect_problem(ask("/v1/morphs/" + std::string(first)), 404);
}

TEST_F(MorphsTest, PairsHaveASimpleCorrespondenceEitherWay) {
    const std::vector<std::string> species = test::swept_species(*built_in_atlas());
    // Each species with two others; core's tests look at every pair.
    for (std::size_t i = 0; i < species.size(); ++i)
        for (const std::size_t steps : {species.size() - 1, species.size() / 3}) {
            const std::string &one = species[i], &two = species[(i + steps) % species.size()];
            const Response response = ask(morph(one, two));
            ASSERT_EQ(response.status, 200) << one << ' ' << two << text_of(response);
            EXPECT_TRUE(json_of(response).at_pointer("/certificate/simple")->as_bool())
                << one << ' ' << two;
        }
}

TEST_F(MorphsTest, SegmentKOfOneGraphBecomesSegmentKOfTheOther) {
    const Response response = ask(morph("xylaria_hypoxylon", "ramaria_formosa"));
    ASSERT_EQ(response.status, 200) << text_of(response);
    const Value body = json_of(response);
    EXPECT_EQ(body.find("family")->as_string(), "branched");
    EXPECT_FALSE(body.find("outlines"));
    EXPECT_TRUE(body.at_pointer("/certificate/matched")->as_bool());
    EXPECT_FALSE(body.at_pointer("/certificate/checked")->as_bool());
    const auto& segments = body.find("limbs")->items();
    ASSERT_GT(segments.size(), 20U);
    int there[2] = {0, 0}, trunks = 0;
    double highest[2] = {0.0, 0.0};
    for (std::size_t i = 0; i < segments.size(); ++i) {
        const double parent = segments[i].find("bearer")->as_number();
        EXPECT_LT(parent, static_cast<double>(i)) << "bearers come first";
        trunks += parent < 0.0 ? 1 : 0;
        for (int side = 0; side < 2; ++side) {
            const Value& one = *segments[i].find(side == 0 ? "a" : "b");
            highest[side] = std::max(highest[side], one.at_pointer("/end/1")->as_number());
            if (one.find("presence")->as_number() > 0.0) {
                ++there[side];
                continue;
            }
            EXPECT_EQ(one.find("radius")->as_number(), 0.0) << i;
        }
    }
    EXPECT_EQ(trunks, 1);
    EXPECT_LT(there[0], 15) << "candlesnuff has few branches";
    EXPECT_GT(there[1], 200) << "a coral has many";
    EXPECT_NEAR(highest[0], 0.055, 0.01);
    EXPECT_NEAR(highest[1], 0.12, 0.03);

    const Value back = json_of(ask(morph("ramaria_formosa", "xylaria_hypoxylon")));
    ASSERT_EQ(back.find("limbs")->items().size(), segments.size());
    for (std::size_t i = 0; i < segments.size(); ++i) {
        EXPECT_EQ(dump(*back.find("limbs")->items()[i].find("a")), dump(*segments[i].find("b")));
        EXPECT_EQ(dump(*back.find("limbs")->items()[i].find("b")), dump(*segments[i].find("a")));
    }
}

TEST_F(MorphsTest, BranchedSpeciesTakeNoArcsButAMoment) {
    const char *a = "ramaria_formosa", *b = "xylaria_hypoxylon";
    const Response linked =
        ask(between(small("\"arcs\":[{\"curve\":\"cap\",\"a\":0.3,\"b\":0.4}]"), a, b));
    expect_problem(linked, 422);
    EXPECT_TRUE(names(linked, "/arcs", "no outlines"));
    EXPECT_EQ(ask(between(small("\"t\":0.3"), a, b)).status, 200);
    const Response strangers = ask(morph("ramaria_formosa", first));
    expect_problem(strangers, 422);
    EXPECT_NE(text_of(strangers).find("only species of one family"), std::string::npos);
}

// --- Mushrooms between two species ---------------------------------------------------------

TEST_F(MorphsTest, WithoutArcsItIsTheMushroomOfTheMix) {
    const struct {
        const char* t;
        const char* mix;
    } cases[] = {
        {"0.4", "amanita_muscaria:0.6,boletus_edulis:0.4"},
        {"0.40004", "amanita_muscaria:0.6,boletus_edulis:0.4"},
        {"0", "amanita_muscaria"},
        {"0.0004", "amanita_muscaria"},
        {"1", "boletus_edulis"},
        {"1.0", "boletus_edulis"},
    };
    for (const auto& [t, mix] : cases) {
        const Response posted = ask(between(small("\"seed\":3,\"t\":" + std::string(t))));
        ASSERT_EQ(posted.status, 200) << text_of(posted);
        const Response got =
            ask(std::string("/v1/mushrooms/") + mix + ".glb?seed=3&lod=3&textures=none");
        EXPECT_EQ(header(got, "Cache-Status"), "sporeprint; hit") << t;
        EXPECT_EQ(text_of(got), text_of(posted));
        EXPECT_EQ(header(got, "ETag"), header(posted, "ETag"));
        EXPECT_EQ(header(got, "Content-Location"), header(posted, "Content-Location"));
        EXPECT_EQ(header(got, "Content-Disposition"), header(posted, "Content-Disposition"));
    }
    EXPECT_EQ(header(ask(between(small(""))), "ETag"),
              header(ask("/v1/mushrooms/amanita_muscaria:1,boletus_edulis:1.glb?lod=3&"
                         "textures=none"),
                     "ETag"))
        << "half way";
}

TEST_F(MorphsTest, OwnArcsMakeAnotherMushroomThatNoAddressHas) {
    const std::string arcs = "\"arcs\":[{\"curve\":\"cap\",\"a\":0.25,\"b\":0.6}]";
    const Response plain = ask(between(small("\"t\":0.5")));
    const Response bent = ask(between(small("\"t\":0.5," + arcs)));
    ASSERT_EQ(bent.status, 200) << text_of(bent);
    EXPECT_NE(text_of(bent), text_of(plain));
    EXPECT_NE(header(bent, "ETag"), header(plain, "ETag"));
    EXPECT_EQ(header(bent, "Content-Location"), "");
    EXPECT_NE(header(plain, "Content-Location"), "");
    EXPECT_EQ(header(ask(between(small("\"t\":0.5," + arcs))), "Cache-Status"), "sporeprint; hit");
    Request conditional = between(small("\"t\":0.5," + arcs));
    conditional.headers.emplace_back("If-None-Match", header(bent, "ETag"));
    expect_problem(ask(conditional), 412);
    const Response inspected = ask(post(text_of(bent), "/v1/inspect", "model/gltf-binary"));
    ASSERT_EQ(inspected.status, 200) << text_of(inspected);
    const Value found = json_of(inspected);
    ASSERT_NE(found.find("canonical"), nullptr) << text_of(inspected);
    EXPECT_TRUE(found.find("canonical")->is_null());

    const Response lone = ask(between(small("\"t\":0," + arcs)));
    EXPECT_NE(header(lone, "Content-Location"), "") << "of a lone species no arc leads anywhere";
}

TEST_F(MorphsTest, ArcsMeanTheSameInAnyOrderAndFromEitherSide) {
    const auto tag = [&](const Request& one) {
        const Response response = ask(one);
        EXPECT_EQ(response.status, 200) << text_of(response);
        return header(response, "ETag");
    };
    const std::string one = "{\"curve\":\"cap\",\"a\":0.25,\"b\":0.4}",
                      two = "{\"curve\":\"cap\",\"a\":0.75,\"b\":0.8}",
                      swapped_one = "{\"curve\":\"cap\",\"a\":0.4,\"b\":0.25}",
                      swapped_two = "{\"curve\":\"cap\",\"a\":0.8,\"b\":0.75}",
                      end = "{\"curve\":\"stem\",\"a\":0,\"b\":0}";
    const std::string known = tag(between(small("\"t\":0.3,\"arcs\":[" + one + ',' + two + "]")));
    EXPECT_EQ(tag(between(small("\"t\":0.3,\"arcs\":[" + two + ',' + one + "]"))), known);
    EXPECT_EQ(tag(between(small("\"t\":0.3,\"arcs\":[" + two + ',' + end + ',' + one + "]"))),
              known)
        << "ends belong together anyway";
    EXPECT_EQ(tag(between(small("\"t\":0.7,\"arcs\":[" + swapped_one + ',' + swapped_two + "]"),
                          other, first)),
              known)
        << "seen from the other side";
    EXPECT_NE(tag(between(small("\"t\":0.3,\"arcs\":[" + one + "]"))), known);
    EXPECT_NE(tag(between(small("\"t\":0.3,\"age\":0.7,\"arcs\":[" + one + ',' + two + "]"))),
              known);
}

TEST_F(MorphsTest, ArcsThatCrossAreRefusedAndNamed) {
    const auto arcs = [](const std::string& list) { return small("\"arcs\":[" + list + "]"); };
    const Response crossing =
        ask(between(arcs("{\"curve\":\"stem\",\"a\":0.5,\"b\":0.5},"
                         "{\"curve\":\"cap\",\"a\":0.2,\"b\":0.3},"
                         "{\"curve\":\"cap\",\"a\":0.6,\"b\":0.1},"
                         "{\"curve\":\"hymenium\",\"a\":0.6,\"b\":0.1}")));
    expect_problem(crossing, 422);
    EXPECT_TRUE(names(crossing, "/arcs/1", "crosses /arcs/2")) << text_of(crossing);
    EXPECT_TRUE(names(crossing, "/arcs/2", "crosses /arcs/1"));
    EXPECT_EQ(errors_of(crossing).size(), 2u) << "the others are fine";

    for (const char* pair : {"{\"a\":0.5,\"b\":0.5},{\"a\":0.5,\"b\":0.5}",
                             "{\"a\":0.5,\"b\":0.4},{\"a\":0.5,\"b\":0.6}",
                             "{\"a\":0.4,\"b\":0.5},{\"a\":0.6,\"b\":0.5}"})
        expect_problem(ask(between(arcs(pair))), 422);
    for (const char* astray :
         {"{\"a\":0,\"b\":0.5}", "{\"a\":0.5,\"b\":1}", "{\"a\":0,\"b\":1}", "{\"a\":1,\"b\":0}"}) {
        const Response response = ask(between(arcs(astray)));
        expect_problem(response, 422);
        EXPECT_TRUE(names(response, "/arcs/0", "ends")) << text_of(response);
    }
    EXPECT_EQ(service_.counters().generated, 0u);
}

TEST_F(MorphsTest, ErrorsOfABodyArePointersIntoIt) {
    std::string many = "[";
    for (std::size_t i = 0; i <= most_arcs; ++i)
        many += (i ? ",{" : "{") + std::string("\"a\":") + number_text(double(i + 1) / 100.0) +
                ",\"b\":" + number_text(double(i + 1) / 100.0) + '}';
    many += ']';
    const struct {
        std::string body;
        int status;
        const char* parameter;
        const char* words;
    } cases[] = {
        {"", 400, "", ""},
        {"[]", 400, "", "expected an object"},
        {"{\"t\":1.5}", 400, "/t", "1.5 is outside 0..1"},
        {"{\"t\":\"half\"}", 400, "/t", "expected a number"},
        {"{\"t\":0.5,\"t\":0.5}", 400, "/t", ""},
        {"{\"age\":2}", 400, "/age", "outside"},
        {"{\"weathering\":{\"fade\":2}}", 400, "/weathering/fade", "outside"},
        {"{\"mix\":{\"amanita_muscaria\":1}}", 400, "/mix", "unknown"},
        {"{\"arc\":[]}", 400, "/arc", "did you mean 'arcs'?"},
        {"{\"arcs\":{}}", 400, "/arcs", "expected a list"},
        {"{\"arcs\":[{\"curve\":\"ring\",\"a\":0.5,\"b\":0.5}]}", 400, "/arcs/0/curve",
         "stem, hymenium, cap"},
        {"{\"arcs\":[{\"curve\":\"cap\",\"a\":-0.5,\"b\":0.5}]}", 400, "/arcs/0/a", "outside"},
        {"{\"arcs\":" + many + "}", 400, "/arcs", "at most 64"},
        {"{\"v\":1}", 400, "/v", "expected text"},
        {"{\"v\":\"0-00000000\"}", 410, "/v", "no longer made"},
    };
    for (const auto& [body, status, parameter, words] : cases) {
        const Response response = ask(between(body));
        expect_problem(response, status);
        EXPECT_TRUE(names(response, parameter, words)) << body.substr(0, 200) << text_of(response);
    }
    Request with_query = between("{}");
    with_query.target += "?age=0.5";
    expect_problem(ask(with_query), 400);
    expect_problem(ask(post("{}", morph() + ".glb", "text/plain")), 415);
    EXPECT_EQ(test::most_body(service_, "POST", morph() + ".glb"), 256u << 10);
}

RC_GTEST_PROP(MorphsProperty, EqualMeaningGivesEqualKeys, ()) {
    const auto atlas = built_in_atlas();
    const SpeciesPair pair = {first, other}, swapped = {other, first};
    const int t = *rc::gen::inRange(0, 1001);
    // Rising on both sides, so that they never cross.
    std::vector<Arc> arcs;
    double a = 0.0, b = 0.0;
    const int count = *rc::gen::inRange(0, 8);
    for (int i = 0; i < count; ++i) {
        a += *rc::gen::inRange(1, 100) / 1000.0;
        b += *rc::gen::inRange(1, 100) / 1000.0;
        arcs.push_back({CurveName::cap, a, b});
    }
    const auto body = [](int thousandths, std::vector<Arc> list, bool reversed) {
        if (reversed) std::reverse(list.begin(), list.end());
        std::string text = "{\"t\":" + number_text(thousandths / 1000.0) + ",\"arcs\":[";
        for (const Arc& arc : list)
            text += (text.back() == '[' ? "{\"b\":" : ",{\"b\":") + number_text(arc.b) +
                    ",\"a\":" + number_text(arc.a) + ",\"curve\":\"cap\"}";
        return text + "]}";
    };
    const auto key = [&](const SpeciesPair& species, const std::string& text) {
        ValidationErrors errors;
        const MushroomRequest read = read_morph(species, text, errors);
        RC_ASSERT(errors.empty());
        return key_of(read.spec, Product::glb, version_token(read.spec.mix, *atlas));
    };
    std::vector<Arc> seen_from_b = arcs;
    for (Arc& arc : seen_from_b) std::swap(arc.a, arc.b);
    const std::string known = key(pair, body(t, arcs, false));
    RC_ASSERT(key(pair, body(t, arcs, true)) == known);
    RC_ASSERT(key(swapped, body(1000 - t, seen_from_b, true)) == known);
    if (!arcs.empty() && t > 0 && t < 1000)
        RC_ASSERT(key(pair, body(t, {}, false)) != known);
    else
        RC_ASSERT(key(pair, body(t, {}, false)) == known);
}

}  // namespace
}  // namespace sporeprint::api::products_morphs_test
