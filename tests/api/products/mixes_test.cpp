// Mixes of species over HTTP: one resource per meaning, whatever its spelling.

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <thread>

#include "api/products/mushrooms.h"
#include "core/params/messages.h"
#include "tests/api/support.h"

namespace sporeprint::api::products_mixes_test {
namespace {

using test::expect_problem;
using test::first_species;
using test::get;
using test::header;
using test::json_of;
using test::linked_images;
using test::names;
using test::post;
using test::request;
using test::second_species;
using test::text_of;

constexpr const char* smallest = "lod=3&texture_size=128";

std::vector<std::string> species() { return test::swept_species(*built_in_atlas()); }

std::string glb(const std::string& mix, const std::string& more = "") {
    return "/v1/mushrooms/" + mix + ".glb?" + smallest + more;
}

class MixesTest : public test::RequestedService {
  protected:
    const std::string a_ = first_species(), b_ = second_species();
};

TEST_F(MixesTest, AMixIsGrownAndCarriesAllItsHeaders) {
    const Response response = ask(glb(b_ + ":3," + a_ + ":7", "&seed=5"));
    ASSERT_EQ(response.status, 200) << text_of(response);
    EXPECT_EQ(text_of(response).substr(0, 4), "glTF");
    EXPECT_TRUE(header(response, "Content-Disposition")
                    .starts_with("inline; filename=\"" + a_ + "_700_" + b_ + "_300_s5_a60_"));
    const std::string where = header(response, "Content-Location");
    EXPECT_TRUE(where.starts_with("/v1/mushrooms/" + a_ + ":0.7," + b_ + ":0.3.glb?seed=5&"))
        << where;
    EXPECT_EQ(header(response, "Cache-Status"),
              "sporeprint-morph; fwd=miss; stored, sporeprint-images; fwd=miss; stored, "
              "sporeprint; fwd=miss; stored");
    const Response again = ask(where);
    EXPECT_EQ(header(again, "Cache-Status"), "sporeprint; hit");
    EXPECT_EQ(header(again, "Cache-Control"), "public, max-age=31536000, immutable");
    EXPECT_EQ(text_of(again), text_of(response));
    EXPECT_EQ(ask(where, {{"If-None-Match", header(response, "ETag")}}).status, 304);
}

TEST_F(MixesTest, ResponsesThatNeedACorrespondenceHaveAWarmUpJob) {
    const std::string mix = a_ + ":0.7," + b_ + ":0.3";
    const Request head = request("HEAD", glb(mix));
    const std::vector<Request> requested = {head, get(glb(mix), {{"If-None-Match", "*"}}),
                                            get(glb(mix, "&v=old")),
                                            get("/v1/mushrooms/" + mix + "/normal.jpg?side=128")};
    std::set<Key> keys;
    for (const Request& one : requested) {
        const auto planned = test::plan(service_, one);
        const Job* const job = std::get_if<Job>(&planned);
        ASSERT_TRUE(job && job->is_warm_up) << one.method << one.target;
        EXPECT_GT(job->cost.work(), 1000u);
        keys.insert(job->key);
    }
    EXPECT_EQ(keys.size(), 1u) << "one flight for all of them";
    const auto whole = test::plan(service_, get(glb(mix)));
    ASSERT_TRUE(std::holds_alternative<Job>(whole));
    EXPECT_FALSE(std::get<Job>(whole).is_warm_up) << "the job that makes the file finds it";

    EXPECT_EQ(service_.counters().morph_misses, 0u) << "plan() has made nothing";
    const Response nobodys = std::get<Job>(test::plan(service_, head))
                                 .run(
                                     {}, [](Step) {}, in_turn);
    service_.finish(*keys.begin(), nobodys);
    EXPECT_EQ(service_.counters().morph_misses, 1u);
    const int statuses[] = {200, 304, 410};
    for (std::size_t i = 0; i < 3; ++i) {
        const auto planned = test::plan(service_, requested[i], i % 2 == 0);
        ASSERT_TRUE(std::holds_alternative<Response>(planned));
        EXPECT_EQ(std::get<Response>(planned).status, statuses[i]);
    }
    EXPECT_EQ(service_.counters().morph_misses, 1u);

    const auto alone =
        test::plan(service_, requested[3]);  // paint needs those of each species alone, too
    EXPECT_TRUE(std::get<Job>(alone).is_warm_up);
    std::get<Job>(alone).run(
        {}, [](Step) {}, in_turn);
    const auto image = test::plan(service_, requested[3]);
    ASSERT_TRUE(std::holds_alternative<Job>(image));
    EXPECT_FALSE(std::get<Job>(image).is_warm_up);
    EXPECT_EQ(service_.counters().morph_misses, 3u);
    EXPECT_EQ(service_.counters().generated, 0u);
}

TEST_F(MixesTest, SpellingsOfOneMixAreOneResource) {
    const struct {
        std::vector<std::string> spellings;
        std::string canonical;
    } cases[] = {
        {{a_, a_ + ":5", a_ + ":9999," + b_ + ":1", b_ + ":1," + a_ + ":9999", a_ + ":1e-3"}, a_},
        {{a_ + ":1," + b_ + ":1", b_ + ":0.5," + a_ + ":5e-1", a_ + ":2," + b_ + ":2.0"},
         a_ + ":0.5," + b_ + ":0.5"},
        {{a_ + ":0.7," + b_ + ":0.3", b_ + ":3," + a_ + ":7"}, a_ + ":0.7," + b_ + ":0.3"},
    };
    for (const auto& [spellings, canonical] : cases) {
        const Response first = ask(glb(spellings.front()));
        ASSERT_EQ(first.status, 200) << text_of(first);
        EXPECT_TRUE(
            header(first, "Content-Location").starts_with("/v1/mushrooms/" + canonical + ".glb?"));
        for (const std::string& spelling : spellings) {
            const Response other = ask(request("HEAD", glb(spelling)));
            EXPECT_EQ(header(other, "ETag"), header(first, "ETag")) << spelling;
            EXPECT_EQ(header(other, "Content-Location"), header(first, "Content-Location"));
            EXPECT_EQ(header(other, "Cache-Status"), "sporeprint; hit") << spelling;
        }
    }
    const Response posted =
        ask(post("{\"mix\":{\"" + b_ + "\":3,\"" + a_ + "\":7},\"lod\":3,\"texture_size\":128}"));
    EXPECT_EQ(header(posted, "Cache-Status"), "sporeprint; hit") << text_of(posted);
    EXPECT_EQ(text_of(posted), text_of(ask(glb(a_ + ":0.7," + b_ + ":0.3"))));
}

TEST_F(MixesTest, TheDescriptionTellsWeightsAndTheCertificate) {
    const Response response = ask("/v1/mushrooms/" + b_ + ":1," + a_ + ":3.json?" + smallest);
    ASSERT_EQ(response.status, 200) << text_of(response);
    const Value body = json_of(response);
    ASSERT_EQ(body.find("mix")->items().size(), 2u);
    EXPECT_EQ(body.at_pointer("/mix/0/id")->as_string(), a_);
    EXPECT_EQ(body.at_pointer("/mix/0/weight")->as_number(), 0.75);
    EXPECT_EQ(body.at_pointer("/mix/1/id")->as_string(), b_);
    EXPECT_EQ(body.at_pointer("/mix/1/weight")->as_number(), 0.25);
    EXPECT_EQ(body.at_pointer("/certificate/simple")->as_bool(), true);
    EXPECT_FALSE(body.at_pointer("/certificate/method")->as_string().empty());
    const Response generated = ask(body.find("canonical")->as_string());
    ASSERT_EQ(generated.status, 200);
    const Value found = json_of(ask(post(text_of(generated), "/v1/inspect", "model/gltf-binary")));
    EXPECT_EQ(found.find("canonical")->as_string(), body.find("canonical")->as_string());
    EXPECT_EQ(body.at_pointer("/estimate/vertices")->as_number(),
              found.at_pointer("/counts/vertices")->as_number());
    EXPECT_NEAR(body.at_pointer("/estimate/bytes")->as_number(),
                static_cast<double>(size_of(generated.body)),
                0.5 * static_cast<double>(size_of(generated.body)));
}

TEST_F(MixesTest, UpToEightSpeciesAreMixed) {
    std::string mix;
    const std::vector<std::string> ids = species();
    for (std::size_t i = 0; i < std::min<std::size_t>(8, ids.size()); ++i)
        mix += (i ? "," : "") + ids[i] + ':' + std::to_string(i + 1);
    const Response response = ask(glb(mix));
    ASSERT_EQ(response.status, 200) << text_of(response);
    EXPECT_EQ(text_of(response).substr(0, 4), "glTF");
    expect_problem(ask(glb(mix + ",xyzzy:1")), ids.size() >= 8 ? 400 : 404);
}

TEST_F(MixesTest, TheVersionIsOfAllTemplates) {
    const auto version = [&](const std::string& mix) {
        const std::string where = header(ask(request("HEAD", glb(mix))), "Content-Location");
        return where.substr(where.rfind("v=") + 2);
    };
    const std::string both = version(a_ + ":1," + b_ + ":1");
    EXPECT_EQ(both, version(b_ + ":3," + a_ + ":1")) << "weights are no templates";
    EXPECT_NE(both, version(a_));
    EXPECT_NE(both, version(b_));
    const Response old = ask(glb(a_ + ":1," + b_ + ":1", "&v=" + version(a_)));
    expect_problem(old, 410);
    EXPECT_TRUE(json_of(old).find("canonical")->as_string().ends_with("v=" + both));
}

TEST_F(MixesTest, LinkedTexturesOfAMixAreWhereTheFileSays) {
    const std::string mix = a_ + ":0.6," + b_ + ":0.4";
    const Response embedded = ask(glb(mix)), linked = ask(glb(mix, "&textures=linked"));
    ASSERT_EQ(linked.status, 200) << text_of(linked);
    int found = 0;
    for (const std::string& address : linked_images(linked, glb(mix))) {
        const Response image = ask(address);
        ASSERT_EQ(image.status, 200) << address << text_of(image);
        EXPECT_EQ(header(image, "Content-Location"), address);
        EXPECT_EQ(header(image, "Cache-Status"), "sporeprint-images; hit")
            << "the embedded file painted it";
        EXPECT_NE(text_of(embedded).find(text_of(image)), std::string::npos);
        Service other(built_in_atlas(), ServiceOptions{});
        EXPECT_EQ(text_of(handle(other, get(address))), text_of(image));
        ++found;
    }
    EXPECT_EQ(found, 3);
}

TEST_F(MixesTest, AChangeOfWeightsFindsTheCorrespondenceAndThePaintings) {
    static_cast<void>(ask(glb(a_ + ":0.6," + b_ + ":0.4")));
    const std::uint64_t generated = service_.counters().morph_misses;
    const std::uint64_t painted = service_.counters().painting_misses;
    EXPECT_GE(generated, 1u);
    EXPECT_EQ(painted, 2u) << "one painting of each species";
    const Response dragged = ask(glb(a_ + ":0.3," + b_ + ":0.7"));
    EXPECT_TRUE(header(dragged, "Cache-Status").starts_with("sporeprint-morph; hit, "))
        << header(dragged, "Cache-Status");
    EXPECT_EQ(service_.counters().morph_misses, generated);
    EXPECT_GT(service_.counters().morph_cache_bytes, 0u);
    EXPECT_GT(service_.counters().morph_cache_entries, 0u);
    EXPECT_GT(service_.counters().image_cache_bytes, 2u * 16 * 16 * 9) << "paintings are counted";
}

TEST_F(MixesTest, ManyWhoWantOneNewSetMakeItOnce) {
    std::vector<std::jthread> threads;
    for (int i = 0; i < 8; ++i)
        threads.emplace_back([&, i] {
            const Response response =
                ask(glb(a_ + ":1," + b_ + ":1", "&textures=none&seed=" + std::to_string(i)));
            EXPECT_EQ(response.status, 200);
        });
    threads.clear();
    EXPECT_EQ(service_.counters().morph_misses, 1u);
    EXPECT_EQ(service_.counters().generated, 8u);
}

TEST(MixesCache, ACacheWithoutRoomMakesEverythingAnewAndSaysSo) {
    ServiceOptions options;
    options.morph_cache_bytes = 0;
    Service service(built_in_atlas(), options);
    const Response response = handle(
        service, get(glb(first_species() + ":1," + second_species() + ":1") + "&textures=none"));
    EXPECT_EQ(header(response, "Cache-Status"),
              "sporeprint-morph; fwd=miss, sporeprint; fwd=miss; stored");
    EXPECT_EQ(service.counters().morph_cache_entries, 0u);
}

TEST_F(MixesTest, WhatNoSpeciesOfAMixCanHaveIs422) {
    const std::string mix = "amanita_muscaria:1,boletus_edulis:1";
    EXPECT_EQ(ask(glb(mix, "&textures=none&ornaments.warts=0.5")).status, 200)
        << "the fly agaric has them";
    const Response none =
        ask(glb("boletus_edulis:1,cantharellus_cibarius:1", "&ornaments.warts=1"));
    expect_problem(none, 422);
    EXPECT_TRUE(names(none, "ornaments.warts")) << text_of(none);
}

// --- Equal meaning, equal keys ------------------------------------------------------------

/// The number in some spelling of JSON that reads back as the same value.
std::string spelt(double value) {
    const std::string shortest = number_text(value);
    switch (*rc::gen::inRange(0, 4)) {
        case 1:
            return shortest + "e0";
        case 2:
            return shortest.find_first_of(".eE") == std::string::npos ? shortest + ".00" : shortest;
        case 3:
            if (value == 0.0) return "0e-1";  // JSON writes no second zero in front
            return shortest.find_first_of(".eE") == std::string::npos ? shortest + "0e-1"
                                                                      : shortest + "E+0";
        default:
            return shortest;
    }
}

RC_GTEST_PROP(MixesProperty, EqualMeaningGivesEqualKeys, ()) {
    const auto atlas = built_in_atlas();
    std::vector<std::string> ids = species();
    const auto count = static_cast<std::size_t>(
        *rc::gen::inRange(1, 1 + static_cast<int>(std::min<std::size_t>(8, ids.size()))));
    std::vector<std::pair<std::string, int>> parts;
    for (std::size_t i = 0; i < count; ++i) {
        const auto pick = static_cast<std::size_t>(
            *rc::gen::inRange<int>(static_cast<int>(i), static_cast<int>(ids.size())));
        std::swap(ids[i], ids[pick]);
        parts.emplace_back(ids[i], *rc::gen::inRange(1, 2000));
    }
    const int seed = *rc::gen::inRange(0, 1000);
    const double age = *rc::gen::inRange(0, 1001) / 1000.0;

    const auto read_address = [&](bool reversed, int scale) {
        std::string mix;
        std::vector<std::pair<std::string, int>> spec = parts;
        if (reversed) std::reverse(spec.begin(), spec.end());
        for (const auto& [id, weight] : spec)
            mix += (mix.empty() ? "" : ",") + id + ':' + spelt(weight * scale);
        std::vector<std::pair<std::string, std::string>> query = {
            {"seed", spelt(seed)}, {"age", spelt(age)}, {"size", spelt(1)}};
        if (reversed) std::reverse(query.begin(), query.end());
        ValidationErrors errors;
        const MushroomRequest read = read_mushroom(mix, query, *atlas, errors);
        RC_ASSERT(errors.empty());
        return read.spec;
    };
    const auto read_body = [&] {
        std::string mix;
        for (const auto& [id, weight] : parts)
            mix += (mix.empty() ? "\"" : ",\"") + id + "\":" + spelt(weight / 8.0);
        ValidationErrors errors;
        const MushroomRequest read = read_mushroom("{\"age\":" + spelt(age) + ",\"mix\":{" + mix +
                                                       "},\"seed\":" + std::to_string(seed) + "}",
                                                   *atlas, errors);
        RC_ASSERT(errors.empty());
        return read.spec;
    };
    const MushroomSpec first = read_address(false, 1);
    const std::string version = version_token(first.mix, *atlas);
    for (const MushroomSpec& other :
         {read_address(false, 3), read_address(true, 1), read_address(true, 7), read_body()}) {
        RC_ASSERT(key_of(other, Product::glb, version_token(other.mix, *atlas)) ==
                  key_of(first, Product::glb, version));
        RC_ASSERT(canonical_address(other) == canonical_address(first));
        RC_ASSERT(Mushrooms::file_name(other, Product::glb, *atlas) ==
                  Mushrooms::file_name(first, Product::glb, *atlas));
    }
    RC_ASSERT(key_of(first, Product::glb, version) != key_of(first, Product::json, version));
    MushroomSpec another = first;
    another.params.seed += 1;
    RC_ASSERT(key_of(another, Product::glb, version) != key_of(first, Product::glb, version));
}

}  // namespace
}  // namespace sporeprint::api::products_mixes_test
