#include "api/service.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <zlib.h>

#include <atomic>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <thread>

#include "api/http/encoding.h"
#include "api/http/errors.h"
#include "api/http/query.h"
#include "api/products/mushrooms.h"
#include "core/gltf/inspect.h"
#include "core/grow/mushroom.h"
#include "core/params/query.h"
#include "core/params/reader.h"
#include "tests/api/support.h"

namespace sporeprint::api::service_test {
namespace {

using test::errors_of;
using test::expect_linked_images;
using test::expect_problem;
using test::first_species;
using test::get;
using test::header;
using test::json_of;
using test::names;
using test::post;
using test::request;
using test::small;
using test::text_of;

class ServiceTest : public test::RequestedService {};

// --- Errors -----------------------------------------------------------------------------

TEST_F(ServiceTest, ErrorsOfAUrlAreNamed) {
    const struct {
        std::string query;
        int status;
        const char* parameter;
        const char* words;
    } cases[] = {
        {"age=1.7", 400, "age", "1.7 is outside 0..1"},
        {"sed=3", 400, "sed", "did you mean 'seed'?"},
        {"age=", 400, "age", "expected a number"},
        {"age=.5", 400, "age", "expected a number"},
        {"age=+1", 400, "age", "expected a number"},
        {"age=0x1", 400, "age", "expected a number"},
        {"age=1e999", 400, "age", ""},
        {"age=nan", 400, "age", "expected a number"},
        {"age= 1", 400, "age", ""},
        {"age=0.1&age=0.1", 400, "age", "more than once"},
        {"v=1&v=1", 400, "v", "more than once"},
        {"seed=-1", 400, "seed", "outside"},
        {"seed=4294967296", 400, "seed", "outside"},
        {"seed=1.5", 400, "seed", "whole number"},
        {"lod=5", 400, "lod", "5 is outside 0..4"},
        {"texture_size=300", 400, "texture_size", "128, 256"},
        {"animation=dance", 400, "animation", "none, growth"},
        {"frames=5", 422, "frames", "animation=growth"},
        {"frames=17&animation=growth", 400, "frames", "2..16"},
        {"textures=fast", 400, "textures", "embedded, linked, external, none"},
        {"weathering.fade=2", 400, "weathering.fade", "outside"},
        {"weathering=1", 400, "weathering", "unknown"},
        {"fade=1", 400, "fade", "unknown"},
        {"deformation.zone_from=0.9&deformation.zone_to=0.5", 422, "deformation.zone_to", ""},
        {"age", 400, "age", "no value"},
        {"age=%zz", 400, "age", "hexadecimal"},
        {"age=0.1&&seed=2", 400, "query", "empty"},
    };
    for (const auto& [query, status, parameter, words] : cases) {
        for (const char* ending : {".glb?", ".json?"}) {
            const Response response = ask("/v1/mushrooms/" + first_species() + ending + query);
            expect_problem(response, status);
            EXPECT_TRUE(names(response, parameter, words)) << query << '\n' << text_of(response);
        }
    }
}

TEST_F(ServiceTest, AllProblemsComeInOneResponseAndTheStrongestStatusWins) {
    const Response response = ask("/v1/mushrooms/xyzzy.glb?age=1.7&sed=3&v=old");
    expect_problem(response, 404);
    EXPECT_EQ(errors_of(response).size(), 3u) << text_of(response);
    EXPECT_TRUE(names(response, "mix", "unknown species"));
    EXPECT_TRUE(names(response, "age"));
    EXPECT_TRUE(names(response, "sed"));

    const Response two = ask("/v1/mushrooms/" + first_species() + ".glb?age=1.7&sed=3");
    expect_problem(two, 400);
    EXPECT_EQ(json_of(two).find("detail")->as_string(), "2 parameters are invalid");
}

TEST_F(ServiceTest, UnknownSpeciesAndRoutesSuggestTheClosest) {
    const std::string id = first_species();
    const Response species = ask("/v1/mushrooms/" + id.substr(0, id.size() - 2) + ".glb");
    expect_problem(species, 404);
    EXPECT_TRUE(names(species, "mix", "did you mean '" + id + "'?")) << text_of(species);
    const Response route = ask("/v1/specis");
    expect_problem(route, 404);
    EXPECT_NE(text_of(route).find("did you mean '/v1/species'?"), std::string::npos);
    expect_problem(ask("/v1/species/xyzzy"), 404);
    expect_problem(ask("/v1/moulds/" + id + ".glb"), 404);
    expect_problem(ask("/nothing?a=1"), 404);
    expect_problem(ask("/assets/none.js"), 404);
}

TEST_F(ServiceTest, MethodsAre405WithAllow) {
    const std::pair<Request, const char*> cases[] = {
        {request("POST", "/v1/species"), "GET, HEAD, OPTIONS"},
        {request("DELETE", small()), "GET, HEAD, OPTIONS"},
        {request("GET", "/v1/mushrooms.glb"), "POST, OPTIONS"},
        {request("HEAD", "/v1/inspect"), "POST, OPTIONS"},
        {request("BREW", "/"), "GET, HEAD, OPTIONS"},
    };
    for (const auto& [one, allow] : cases) {
        const Response response = ask(one);
        expect_problem(response, 405);
        EXPECT_EQ(header(response, "Allow"), allow);
    }
}

TEST_F(ServiceTest, PreflightRequestsSucceed) {
    const Response response = ask(
        request("OPTIONS", "/v1/mushrooms.glb",
                {{"Origin", "https://example.org"}, {"Access-Control-Request-Method", "POST"}}));
    EXPECT_EQ(response.status, 204);
    EXPECT_FALSE(response.has_body);
    EXPECT_EQ(header(response, "Access-Control-Allow-Methods"), "POST, OPTIONS");
    EXPECT_EQ(header(response, "Access-Control-Allow-Origin"), "*");
    EXPECT_NE(header(response, "Access-Control-Allow-Headers").find("Content-Type"),
              std::string::npos);
    EXPECT_EQ(header(response, "Access-Control-Max-Age"), "86400");
    EXPECT_EQ(ask(request("OPTIONS", "*")).status, 204);
    EXPECT_EQ(ask(request("OPTIONS", small("&age=9"))).status, 204);
}

TEST_F(ServiceTest, ALongAddressIs414) {
    expect_problem(ask("/v1/species?x=" + std::string(4096, 'a')), 414);
    EXPECT_NE(ask("/v1/species?x=" + std::string(4096 - 14, 'a')).status, 414);
}

TEST_F(ServiceTest, TheRouteOfARequestIsKnownBeforeItsBody) {
    const RoutedRequest fitting = service_.route(post("", "/v1/mushrooms.glb"));
    EXPECT_EQ(fitting.label(), "/v1/mushrooms.glb");
    EXPECT_EQ(fitting.most_body, 4u << 20);
    EXPECT_FALSE(fitting.response);
    const RoutedRequest untyped = service_.route(request("POST", "/v1/inspect"));
    EXPECT_EQ(untyped.label(), "/v1/inspect");
    EXPECT_EQ(untyped.response->status, 415);
    const RoutedRequest other_method = service_.route(get("/v1/inspect"));
    EXPECT_EQ(other_method.label(), "/v1/inspect");
    EXPECT_EQ(other_method.response->status, 405);
    const RoutedRequest nowhere = service_.route(get("/nowhere?a=b"));
    EXPECT_EQ(nowhere.label(), "UNKNOWN");
    EXPECT_EQ(nowhere.response->status, 404);
    const RoutedRequest endless =
        service_.route(get("/v1/species?x=" + std::string(longest_target, 'x')));
    EXPECT_EQ(endless.label(), "/v1/species");
    EXPECT_EQ(endless.response->status, 414);
}

TEST_F(ServiceTest, BodiesOfAnotherTypeOrEncodingAre415AndLargeOnes413) {
    expect_problem(ask(post("{}", "/v1/mushrooms.glb", "text/plain")), 415);
    expect_problem(ask(post("{}", "/v1/mushrooms.glb", "")), 415);
    expect_problem(ask(post("x", "/v1/inspect", "application/json")), 415);
    Request encoded = post("{}");
    encoded.headers.emplace_back("content-encoding", "gzip");
    expect_problem(ask(encoded), 415);
    expect_problem(ask(post(std::string((4u << 20) + 1, ' '))), 413);
    EXPECT_EQ(test::most_body(service_, "POST", "/v1/mushrooms.glb"), 4u << 20);
    EXPECT_EQ(test::most_body(service_, "POST", "/v1/inspect?x=1"), 64u << 20);
    EXPECT_EQ(test::most_body(service_, "POST", "/nothing"), 256u << 10);
}

TEST_F(ServiceTest, ErrorsOfABodyArePointersIntoIt) {
    const std::string mix = "\"mix\":{\"" + first_species() + "\":1}";
    const struct {
        std::string body;
        int status;
        const char* parameter;
        const char* words;
    } cases[] = {
        {"", 400, "", ""},
        {"[]", 400, "", "expected an object"},
        {"{" + mix, 400, "", ""},
        {"{" + mix + ",\"age\":1e999}", 400, "/age", "too large"},
        {std::string(100'000, '['), 400, "/0/0/0", "deeper than 32"},
        {"{" + mix + "," + mix + "}", 400, "/mix", ""},
        {"{}", 400, "mix", "is missing"},
        {"{" + mix + ",\"model\":{}}", 400, "mix", "not both"},
        {"{\"mix\":{\"xyzzy\":1}}", 404, "mix", "unknown species"},
        {"{\"mix\":{\"" + first_species() + "\":0}}", 400, "mix", "greater than 0"},
        {"{\"mix\":{\"" + first_species() + "\":\"1\"}}", 400, "mix", "not a number"},
        {"{" + mix + ",\"age\":1.7}", 400, "/age", "1.7 is outside 0..1"},
        {"{" + mix + ",\"age\":\"old\"}", 400, "/age", "expected a number"},
        {"{" + mix + ",\"age\":null}", 400, "/age", ""},
        {"{" + mix + ",\"sed\":1}", 400, "/sed", "did you mean 'seed'?"},
        {"{" + mix + ",\"weathering\":{\"fade\":2}}", 400, "/weathering/fade", "outside"},
        {"{" + mix + ",\"weathering\":{\"fade\":null}}", 400, "/weathering/fade", ""},
        {"{" + mix + ",\"v\":1}", 400, "/v", "expected text"},
        {"{\"model\":{\"silhouette\":{\"cap\":[{\"r\":-1}]}}}", 400, "/model/silhouette/cap/0/r",
         "outside"},
        {"{\"model\":{\"surface\":{\"cap\":{\"image\":\"?\"}}}}", 400, "/model/surface/cap/image",
         "base64"},
        {"{\"model\":{\"form\":\"spun\"}}", 400, "/model/form", "branched"},
        {"{\"model\":{}}", 422, "/model/silhouette/stem", "at least 2"},
        {"{" + mix + ",\"frames\":5}", 422, "/frames", "animation=growth"},
        {"{" + mix + ",\"deformation\":{\"zone_from\":0.9,\"zone_to\":0.5}}", 422,
         "/deformation/zone_to", "exceed"},
        {"{" + mix + ",\"deformation\":{\"zone_from\":0.95,\"zone_to\":0.5}}", 400,
         "/deformation/zone_from", "outside"},
        {"{" + mix + ",\"frames\":5,\"age\":2}", 400, "/age", "outside"},
        {"{\"model\":{\"deformation\":{\"zone_from\":0.9,\"zone_to\":0.5}}}", 422,
         "/model/deformation/zone_to", "exceed"},
        {"{\"model\":{\"form\":\"branched\",\"ramification\":{\"order\":12}}}", 422,
         "/model/ramification/order", "at most 600"},
        {"{\"model\":{\"form\":\"branched\",\"ramification\":{\"matrix\":\"own\"}}}", 422,
         "/model/ramification/rows", "no rows are given"},
    };
    for (const auto& [body, status, parameter, words] : cases) {
        const Response response = ask(post(body));
        expect_problem(response, status);
        EXPECT_TRUE(names(response, parameter, words)) << body.substr(0, 200) << '\n'
                                                       << text_of(response);
    }
    expect_problem(ask(post("{" + mix + "}", "/v1/mushrooms.glb?age=0.5")), 400);
}

TEST_F(ServiceTest, WhatIsImpossibleIs422) {
    const Value model = write(built_in_atlas()->entries()[0].species.stages[0].model);
    const Response linked = ask(post("{\"textures\":\"linked\",\"model\":" + dump(model) + "}"));
    expect_problem(linked, 422);
    EXPECT_TRUE(names(linked, "/textures"));

    // Pores requested of a species without pores, or gills of one without gills: one of the two each species lacks.
    const Response anatomy = ask(small("&hymenium.pores_per_mm=2&hymenium.blades=20"));
    expect_problem(anatomy, 422);
    EXPECT_TRUE(names(anatomy, "hymenium.pores_per_mm") || names(anatomy, "hymenium.blades"))
        << text_of(anatomy);
    EXPECT_EQ(generated(), 0u);
}

TEST_F(ServiceTest, ACrossingOutlineIs422AndPointsIntoTheModel) {
    Value model = write(built_in_atlas()->entries()[0].species.stages[0].model);
    Value* cap = model.find("silhouette")->find("cap");
    const double r = cap->items()[1].find("r")->as_number();
    cap->items()[1].set("r", cap->items()[cap->items().size() - 2].find("r")->as_number());
    cap->items()[cap->items().size() - 2].set("r", r);
    const Response response = ask(post("{\"model\":" + dump(model) + "}"));
    EXPECT_EQ(response.status, 422) << text_of(response);
    bool points = false;
    for (const std::string& error : errors_of(response))
        points = points || error.starts_with("/model/silhouette");
    EXPECT_TRUE(points) << text_of(response);
}

TEST(ServiceBudget, WhatCostsTooMuchIs422BeforeAnyWork) {
    ServiceOptions options;
    options.most_vertices = 100;
    options.most_texels = 3 * 256 * 256;
    Service service(built_in_atlas(), options);
    const std::string address = "/v1/mushrooms/" + first_species() + ".glb";
    const Response response = handle(service, get(address));
    expect_problem(response, 422);
    EXPECT_TRUE(names(response, "lod"));
    EXPECT_TRUE(names(response, "texture_size"));
    const Response posted = handle(service, post("{\"mix\":{\"" + first_species() + "\":1}}"));
    EXPECT_TRUE(names(posted, "/lod"));
    EXPECT_FALSE(names(response, "frames"));
    const Response clip = handle(service, get(address + "?animation=growth&texture_size=128"));
    expect_problem(clip, 422);
    EXPECT_TRUE(names(clip, "lod"));
    EXPECT_TRUE(names(clip, "frames"));
    const Response image = handle(service, get("/v1/mushrooms/" + first_species() + "/normal.jpg"));
    expect_problem(image, 422);
    EXPECT_TRUE(names(image, "side"));
    EXPECT_EQ(service.counters().generated, 0u);
}

// --- Documents --------------------------------------------------------------------------

TEST_F(ServiceTest, TheRootTellsWhoItIs) {
    const Value root = json_of(ask("/v1"));
    EXPECT_EQ(root.find("name")->as_string(), "sporeprint");
    EXPECT_EQ(root.find("generator_version")->as_number(), generator_version);
    for (const auto& [name, link] : root.find("links")->members())
        EXPECT_EQ(ask(link.as_string()).status, name == "docs" ? 404 : 200) << link.as_string();
}

TEST_F(ServiceTest, SpeciesAreListedWithLinksThatWork) {
    const Value body = json_of(ask("/v1/species"));
    const auto& list = body.find("species")->items();
    ASSERT_EQ(list.size(), built_in_atlas()->entries().size());
    for (const Value& row : list) {
        for (const char* member :
             {"id", "scientific_name", "common_name", "family", "form", "cap_diameter_m",
              "height_m", "substrate", "habit", "season", "links"})
            EXPECT_NE(row.find(member), nullptr) << member;
        const Response self = ask(row.find("links")->find("self")->as_string());
        EXPECT_EQ(self.status, 200);
        std::vector<Problem> problems;
        static_cast<void>(read_json<Species>(text_of(self), problems));
        EXPECT_TRUE(problems.empty())
            << (problems.empty() ? "" : problems[0].path + problems[0].message);
        EXPECT_EQ(ask(request("HEAD", row.find("links")->find("model")->as_string())).status, 200);
    }
}

TEST_F(ServiceTest, MushroomsAndColoniesAreListedWithLinksThatWork) {
    for (const std::string product : {"mushrooms", "colonies"}) {
        const Response response = ask("/v1/" + product);
        ASSERT_EQ(response.status, 200) << text_of(response);
        const Value body = json_of(response);
        const auto& list = body.find(product)->items();
        ASSERT_EQ(list.size(), built_in_atlas()->entries().size());
        for (const Value& item : list) {
            EXPECT_FALSE(item.find("name")->as_string().empty());
            const Value& links = *item.find("links");
            for (const char* link : {"self", "model", "schema", "species"})
                EXPECT_EQ(ask(request("HEAD", links.find(link)->as_string())).status, 200)
                    << links.find(link)->as_string();
            EXPECT_EQ(links.find("model")->as_string(),
                      "/v1/" + product + '/' + item.find("id")->as_string() + ".glb");
        }
        expect_problem(ask("/v1/" + product + "?lod=1"), 400);
        EXPECT_EQ(json_of(ask("/v1")).at_pointer("/links/" + product)->as_string(),
                  "/v1/" + product);
    }
}

TEST_F(ServiceTest, EveryTypeOfProblemLeadsToAPageThatTellsOfIt) {
    for (const ProblemType& type : problem_types()) {
        const Response page = ask(std::string("/problems/") + type.slug);
        ASSERT_EQ(page.status, 200) << type.slug;
        EXPECT_EQ(header(page, "Content-Type"), "text/html; charset=utf-8");
        EXPECT_FALSE(header(page, "ETag").empty());
        for (const std::string& words :
             {std::to_string(type.status) + ' ' + type.title, std::string(type.remedy)})
            EXPECT_NE(text_of(page).find(words), std::string::npos) << type.slug << words;
    }
    const Value problem = json_of(ask(small("&age=2")));
    EXPECT_EQ(ask(problem.find("type")->as_string()).status, 200);
    const Response unknown = ask("/problems/imposible");
    expect_problem(unknown, 404);
    EXPECT_TRUE(names(unknown, "type", "did you mean 'impossible'?"));
    expect_problem(ask("/problems/impossible?lod=1"), 400);
}

TEST_F(ServiceTest, SpeciesAreFiltered) {
    const auto ids = [&](const std::string& query) {
        std::vector<std::string> out;
        const Response response = ask("/v1/species?" + query);
        EXPECT_EQ(response.status, 200) << query;
        const Value body = json_of(response);
        for (const Value& row : body.find("species")->items())
            out.push_back(row.find("id")->as_string());
        return out;
    };
    const auto atlas = built_in_atlas();
    const auto matching = [&](auto predicate) {
        std::vector<std::string> out;
        for (const AtlasEntry& entry : atlas->entries())
            if (predicate(entry.species.facts)) out.push_back(entry.species.id.string());
        return out;
    };
    EXPECT_EQ(ids("form=agaric"),
              matching([](const Facts& facts) { return facts.form == GrowthForm::agaric; }));
    EXPECT_EQ(ids("family=swept"), test::swept_species(*atlas));
    EXPECT_EQ(
        ids("family=branched"),
        (std::vector<std::string>{"artomyces_pyxidatus", "ramaria_formosa", "xylaria_hypoxylon"}));
    EXPECT_EQ(ids("form=antler"), std::vector<std::string>{"xylaria_hypoxylon"});
    EXPECT_EQ(ids("month=9"), matching([](const Facts& facts) {
                  return std::count(facts.season.begin(), facts.season.end(), 9) > 0;
              }));
    EXPECT_EQ(ids("min_diameter_m=0.1"), matching([](const Facts& facts) {
                  return facts.cap_diameter_m && facts.cap_diameter_m->to >= 0.1;
              }));
    EXPECT_EQ(ids("max_diameter_m=0.1"), matching([](const Facts& facts) {
                  return facts.cap_diameter_m && facts.cap_diameter_m->to <= 0.1;
              }));
    const std::string colour = atlas->entries()[0].species.facts.colour.string();
    EXPECT_FALSE(ids("colour=" + colour).empty());
    EXPECT_TRUE(ids("substrate=marble").empty());
    EXPECT_EQ(ids("habit=Rings"), matching([](const Facts& facts) {
                  return facts.habit.string().find("rings") != std::string::npos;
              }));
    for (const char* query : {"form=tree", "month=13", "month=1.5", "min_diameter_m=x",
                              "colour=red&colour=red", "colr=red"})
        expect_problem(ask(std::string("/v1/species?") + query), 400);
    expect_problem(ask("/v1/species?min_diameter_m=0.2&max_diameter_m=0.1"), 422);
}

TEST_F(ServiceTest, DocumentsAreConditionalAndCompressed) {
    for (const std::string& target : std::vector<std::string>{
             "/v1", "/v1/species", "/v1/species?form=agaric", "/v1/mushrooms/schema",
             "/openapi.json", "/v1/species/" + first_species(),
             "/v1/mushrooms/" + first_species() + ".json"}) {
        const Response plain = ask(target);
        ASSERT_EQ(plain.status, 200) << target;
        EXPECT_EQ(header(plain, "Vary"), "Accept-Encoding") << target;
        EXPECT_EQ(header(plain, "Content-Encoding"), "");
        EXPECT_EQ(header(plain, "Cache-Control"),
                  "public, max-age=3600, stale-while-revalidate=86400");
        const std::string etag = header(plain, "ETag");

        const Response zipped = ask(target, {{"Accept-Encoding", "br, gzip"}});
        EXPECT_EQ(header(zipped, "Content-Encoding"), "gzip") << target;
        EXPECT_EQ(header(zipped, "ETag"), etag.substr(0, etag.size() - 1) + "-gz\"") << target;
        EXPECT_EQ(text_of(zipped).substr(0, 2), "\x1f\x8b");
        EXPECT_LT(size_of(zipped.body), size_of(plain.body));

        const Response unchanged = ask(target, {{"If-None-Match", "\"x\", W/" + etag}});
        EXPECT_EQ(unchanged.status, 304) << target;
        EXPECT_FALSE(unchanged.has_body);
        EXPECT_EQ(header(unchanged, "ETag"), etag);
        EXPECT_EQ(header(unchanged, "Vary"), "Accept-Encoding");
        const Response unchanged_zipped =
            ask(target, {{"If-None-Match", header(zipped, "ETag")}, {"Accept-Encoding", "gzip"}});
        EXPECT_EQ(unchanged_zipped.status, 304);
        EXPECT_EQ(header(unchanged_zipped, "ETag"), header(zipped, "ETag"));
        EXPECT_EQ(ask(target, {{"If-None-Match", header(zipped, "ETag")}}).status, 200)
            << "another variant";
        EXPECT_EQ(ask(target, {{"If-None-Match", "*"}}).status, 304);
        if (target.find('?') == std::string::npos && target.find(".json") == std::string::npos)
            expect_problem(ask(target + "?nonsense=1"), 400);
    }
}

TEST(ServiceAssets, ThePageAndItsFilesAreServed) {
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() /
        ("sporeprint-assets-" + std::to_string(reinterpret_cast<std::uintptr_t>(&folder)));
    std::filesystem::create_directories(folder);
    const auto write_file = [&](const char* name, std::string_view text) {
        std::ofstream(folder / name) << text;
    };
    write_file("index.html", "<!doctype html><title>page</title>");
    write_file("docs.html", "<!doctype html><title>docs</title>");
    write_file("editor.html", "<!doctype html><title>editor</title>");
    write_file("breed.html", "<!doctype html><title>breed</title>");
    write_file("world.html", "<!doctype html><title>world</title>");
    write_file("app-3F9A1C02.js", "let answer = 42;");
    write_file("favicon.svg", "<svg xmlns='http://www.w3.org/2000/svg'/>");
    write_file(".hidden", "secret");
    ServiceOptions options;
    options.assets = folder;
    Service service(built_in_atlas(), options);
    std::filesystem::remove_all(folder);  // read once, at start

    const Response page = handle(service, get("/?species=x&age=0.5"));
    EXPECT_EQ(page.status, 200);
    EXPECT_EQ(header(page, "Content-Type"), "text/html; charset=utf-8");
    const std::string policy = header(page, "Content-Security-Policy");
    EXPECT_TRUE(policy.starts_with("default-src 'self';")) << policy;
    EXPECT_TRUE(policy.ends_with("frame-ancestors 'none'")) << policy;
    EXPECT_EQ(policy.find("'unsafe"), std::string::npos) << "WebAssembly alone is allowed";
    EXPECT_EQ(header(page, "Referrer-Policy"), "same-origin");
    EXPECT_EQ(header(page, "Cache-Control"), "no-cache");
    EXPECT_EQ(header(page, "Cross-Origin-Opener-Policy"), "same-origin");
    EXPECT_EQ(header(handle(service, get("/assets/favicon.svg")), "Content-Security-Policy"), "");
    EXPECT_NE(text_of(page).find("page"), std::string::npos);
    EXPECT_NE(text_of(handle(service, get("/docs"))).find("docs"), std::string::npos);
    EXPECT_NE(text_of(handle(service, get("/editor"))).find("editor"), std::string::npos);
    EXPECT_NE(text_of(handle(service, get("/breed"))).find("breed"), std::string::npos);
    EXPECT_NE(text_of(handle(service, get("/world"))).find("world"), std::string::npos);
    const Response script = handle(service, get("/assets/app-3F9A1C02.js"));
    EXPECT_EQ(header(script, "Content-Type"), "text/javascript; charset=utf-8");
    EXPECT_EQ(header(script, "Cache-Control"), "public, max-age=31536000, immutable");
    EXPECT_EQ(header(handle(service, get("/assets/favicon.svg")), "Content-Type"), "image/svg+xml");
    for (const char* target :
         {"/assets/.hidden", "/assets/..%2Findex.html", "/assets/../index.html", "/assets/"})
        EXPECT_EQ(handle(service, get(target)).status, 404) << target;
    const Response head = handle(service, request("HEAD", "/"));
    EXPECT_TRUE(head.has_body);
    EXPECT_EQ(size_of(head.body), size_of(page.body));
}

TEST(ServiceAssets, AFolderThatIsNotThereIsNamed) {
    ServiceOptions options;
    options.assets = "/there/is/no/such/page";
    try {
        Service service(built_in_atlas(), options);
        FAIL() << "started without its page";
    } catch (const InvalidInput& error) {
        EXPECT_EQ(error.problems().front().path, "/there/is/no/such/page");
    }
}

TEST_F(ServiceTest, WithoutAPageTheRootGivesAHint) {
    const Response response = ask("/");
    EXPECT_EQ(response.status, 200);
    EXPECT_NE(text_of(response).find("/v1/species"), std::string::npos);
    expect_problem(ask("/docs"), 404);
    expect_problem(ask("/editor"), 404);
    expect_problem(ask("/breed"), 404);
    expect_problem(ask("/world"), 404);
}

// --- Mushrooms --------------------------------------------------------------------------

TEST_F(ServiceTest, AMushroomComesWithAllItsHeaders) {
    const Response response = ask(small("&seed=7"));
    ASSERT_EQ(response.status, 200) << text_of(response);
    EXPECT_EQ(text_of(response).substr(0, 4), "glTF");
    EXPECT_EQ(header(response, "Content-Type"), "model/gltf-binary");
    EXPECT_TRUE(header(response, "Content-Disposition")
                    .starts_with("inline; filename=\"" + first_species() + "_s7_a60_"));
    EXPECT_TRUE(header(response, "Content-Disposition").ends_with("_LOD3.glb\""));
    EXPECT_EQ(header(response, "Cache-Control"),
              "public, max-age=3600, stale-while-revalidate=86400");
    EXPECT_EQ(header(response, "Cache-Status"),
              "sporeprint-morph; fwd=miss; stored, sporeprint-images; fwd=miss; stored, "
              "sporeprint; fwd=miss; stored");
    EXPECT_EQ(header(response, "Cross-Origin-Resource-Policy"), "cross-origin");
    EXPECT_EQ(header(response, "Timing-Allow-Origin"), "*");
    EXPECT_EQ(header(response, "X-Request-Id"), "test-1");
    EXPECT_NE(header(response, "Access-Control-Expose-Headers").find("Content-Location"),
              std::string::npos);
    EXPECT_EQ(header(response, "Vary"), "");
    const std::string timing = header(response, "Server-Timing");
    for (const char* step : {"resolve;dur=", "build;dur=", "paint;dur=", "pack;dur="})
        EXPECT_NE(timing.find(step), std::string::npos) << timing;
    EXPECT_EQ(timing.find("queue"), std::string::npos);
    const std::string where = header(response, "Content-Location");
    EXPECT_TRUE(where.starts_with("/v1/mushrooms/" + first_species() +
                                  ".glb?seed=7&lod=3&texture_size=128&v="))
        << where;
    EXPECT_EQ(header(ask(where), "Cache-Control"), "public, max-age=31536000, immutable");
    EXPECT_EQ(header(ask(small("&seed=7"), {{"Accept-Encoding", "gzip"}}), "Content-Encoding"), "");
}

TEST_F(ServiceTest, ASecondRequestIsAHitThatSharesTheBytes) {
    const Response first = ask(small()), second = ask(small());
    EXPECT_EQ(header(second, "Cache-Status"), "sporeprint; hit");
    EXPECT_EQ(header(second, "Server-Timing"), "");
    ASSERT_EQ(first.body.size(), second.body.size());
    for (std::size_t i = 0; i < first.body.size(); ++i)
        EXPECT_EQ(first.body[i].owner, second.body[i].owner);
    EXPECT_EQ(generated(), 1u);
    EXPECT_EQ(service_.counters().glb_hits, 1u);
    EXPECT_EQ(service_.counters().glb_misses, 1u);
    EXPECT_EQ(service_.counters().glb_cache_entries, 1u);
    EXPECT_GE(service_.counters().glb_cache_bytes, size_of(first.body));
}

TEST_F(ServiceTest, AChangeOfShapeFindsItsImages) {
    static_cast<void>(ask(small()));
    const Response bent = ask(small("&deformation.lean_deg=20"));
    ASSERT_EQ(bent.status, 200) << text_of(bent);
    EXPECT_EQ(header(bent, "Cache-Status"),
              "sporeprint-morph; hit, sporeprint-images; hit, sporeprint; fwd=miss; stored");
    EXPECT_EQ(service_.counters().painted, 1u);
    EXPECT_EQ(service_.counters().image_hits, 1u);
}

TEST_F(ServiceTest, AConditionalRequestGeneratesNothing) {
    const MushroomSpec spec = [&] {
        MushroomSpec one;
        one.mix = {{first_species(), 1000}};
        one.params.lod = 3;
        one.params.texture_size = {128};
        one.params.seed = 77;
        return one;
    }();
    const std::string version = version_token(spec.mix, *built_in_atlas());
    const std::string etag = etag_of(key_of(spec, Product::glb, version));
    for (const Request& one : {get(small("&seed=77"), {{"If-None-Match", etag}}),
                               get(small("&seed=77"), {{"if-none-match", "W/" + etag}}),
                               get(small("&seed=77"), {{"If-None-Match", "*"}}),
                               request("HEAD", small("&seed=77"), {{"If-None-Match", etag}})}) {
        const Response response = ask(one);
        EXPECT_EQ(response.status, 304);
        EXPECT_FALSE(response.has_body);
        EXPECT_TRUE(response.body.empty());
        EXPECT_EQ(header(response, "ETag"), etag);
        EXPECT_EQ(header(response, "Cache-Status"), "sporeprint; hit; detail=not-modified");
        EXPECT_EQ(header(response, "Content-Type"), "");
        EXPECT_EQ(header(response, "Content-Location"),
                  with_version(canonical_address(spec), version));
        EXPECT_NE(header(response, "Cache-Control"), "");
    }
    EXPECT_EQ(generated(), 0u);
    EXPECT_EQ(service_.counters().glb_not_modified, 4u);
    EXPECT_EQ(header(ask(small("&seed=77")), "ETag"), etag);
    EXPECT_EQ(ask(small("&seed=78"), {{"If-None-Match", etag}}).status, 200);
    // Even '*' does not make the impossible exist.
    EXPECT_EQ(
        ask(small("&hymenium.pores_per_mm=2&hymenium.blades=20"), {{"If-None-Match", "*"}}).status,
        422);
}

TEST_F(ServiceTest, HeadAgreesWithGetAndNeverGenerates) {
    const Response cold = ask(request("HEAD", small()));
    EXPECT_EQ(cold.status, 200);
    EXPECT_FALSE(cold.has_body);
    EXPECT_EQ(generated(), 0u);
    const Response got = ask(small());
    const Response warm = ask(request("HEAD", small()));
    EXPECT_TRUE(warm.has_body);
    EXPECT_EQ(size_of(warm.body), size_of(got.body));
    for (const char* same :
         {"ETag", "Content-Type", "Content-Location", "Content-Disposition", "Cache-Control"}) {
        EXPECT_EQ(header(cold, same), header(got, same)) << same;
        EXPECT_EQ(header(warm, same), header(got, same)) << same;
    }
    EXPECT_EQ(ask(request("HEAD", small("&age=9"))).status, 400);
    EXPECT_EQ(ask(request("HEAD", small("&hymenium.pores_per_mm=2&hymenium.blades=20"))).status,
              422);
    const Response described = ask(request("HEAD", "/v1/mushrooms/" + first_species() + ".json",
                                           {{"Accept-Encoding", "gzip"}}));
    EXPECT_FALSE(described.has_body);
    EXPECT_EQ(header(described, "Content-Encoding"), "gzip");
    EXPECT_EQ(header(described, "ETag"), header(ask("/v1/mushrooms/" + first_species() + ".json",
                                                    {{"Accept-Encoding", "gzip"}}),
                                                "ETag"));
    EXPECT_EQ(generated(), 2u);
}

TEST_F(ServiceTest, APostEqualToAGetIsTheSameResource) {
    const Response got = ask(small("&age=0.25&weathering.fade=0.5&seed=9"));
    const Response posted =
        ask(post("{\"weathering\":{\"fade\":5e-1},\"seed\":9,\"mix\":{\"" + first_species() +
                 "\":17},\"lod\":3,\"texture_size\":128,\"age\":0.250}"));
    ASSERT_EQ(posted.status, 200) << text_of(posted);
    for (const char* same : {"ETag", "Content-Location", "Content-Disposition"})
        EXPECT_EQ(header(posted, same), header(got, same));
    EXPECT_EQ(header(posted, "Cache-Status"), "sporeprint; hit");
    EXPECT_EQ(text_of(posted), text_of(got));

    Service fresh(built_in_atlas(), ServiceOptions{});
    const Response elsewhere =
        handle(fresh, post("{\"mix\":{\"" + first_species() +
                           "\":1},\"lod\":3,\"texture_size\":128,\"age\":0.25,"
                           "\"seed\":9,\"weathering\":{\"fade\":0.5}}"));
    EXPECT_EQ(text_of(elsewhere), text_of(got));
}

TEST_F(ServiceTest, AModelOfOnesOwnIsGrown) {
    const Value model = write(built_in_atlas()->entries()[0].species.stages.back().model);
    const std::string body =
        "{\"lod\":3,\"texture_size\":128,\"seed\":3,\"model\":" + dump(model) + "}";
    const Response response = ask(post(body));
    ASSERT_EQ(response.status, 200) << text_of(response);
    EXPECT_EQ(header(response, "Content-Location"), "");
    EXPECT_TRUE(
        header(response, "Content-Disposition").starts_with("inline; filename=\"model_s3_a60_"));
    const Response inspected = ask(post(text_of(response), "/v1/inspect", "model/gltf-binary"));
    ASSERT_EQ(inspected.status, 200) << text_of(inspected);
    EXPECT_TRUE(json_of(inspected).find("canonical")->is_null());
    EXPECT_EQ(header(ask(post(body)), "Cache-Status"), "sporeprint; hit");
    Request conditional = post(body);
    conditional.headers.emplace_back("If-None-Match", header(response, "ETag"));
    expect_problem(ask(conditional), 412);
}

TEST_F(ServiceTest, ImagesOfOnesOwnArePaintedAndWhatIsNoImageIsNamed) {
    Value model = write(built_in_atlas()->entries()[0].species.stages.back().model);
    const auto with_image = [&](const std::string& base64) {
        model.find("surface")->find("cap")->set("image", base64);
        return post("{\"lod\":3,\"texture_size\":128,\"model\":" + dump(model) + "}");
    };
    const Response plain =
        ask(post("{\"lod\":3,\"texture_size\":128,\"model\":" + dump(model) + "}"));
    // A red PNG of one pixel.
    const Response red =
        ask(with_image("iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mP8z8DwHwAFBQIAX8j"
                       "x0gAAAABJRU5ErkJggg=="));
    ASSERT_EQ(red.status, 200) << text_of(red);
    EXPECT_NE(header(red, "ETag"), header(plain, "ETag"));
    EXPECT_NE(text_of(red), text_of(plain));
    const Response noise = ask(with_image("AAAABBBBCCCC"));
    expect_problem(noise, 400);
    EXPECT_TRUE(names(noise, "/model/surface/cap/image")) << text_of(noise);
}

TEST_F(ServiceTest, VersionsOfYesterdayAre410WithTheAddressOfToday) {
    const std::string canonical = header(ask(request("HEAD", small())), "Content-Location");
    for (const char* version : {"0-00000000", "", "x", "%3Cscript%3E"}) {
        const Response response = ask(small(std::string("&v=") + version));
        expect_problem(response, 410);
        EXPECT_EQ(json_of(response).find("canonical")->as_string(), canonical);
    }
    EXPECT_EQ(ask(canonical).status, 200);
    EXPECT_EQ(header(ask(canonical), "ETag"), header(ask(small()), "ETag"))
        << "v is no part of the request";
    const Response stronger = ask(small("&v=x&hymenium.pores_per_mm=2&hymenium.blades=20"));
    expect_problem(stronger, 422);
    EXPECT_TRUE(names(stronger, "v"));
    const Response posted = ask(post("{\"v\":\"x\",\"mix\":{\"" + first_species() + "\":1}}"));
    expect_problem(posted, 410);
    EXPECT_TRUE(names(posted, "/v"));
}

TEST_F(ServiceTest, TheDescriptionTellsWhatWouldBeMade) {
    const std::string address =
        "/v1/mushrooms/" + first_species() + ":3.json?lod=2&age=0.9&texture_size=256";
    const Response response = ask(address);
    ASSERT_EQ(response.status, 200) << text_of(response);
    const Value body = json_of(response);
    const Response glb =
        ask(body.find("canonical")->as_string() + "&v=" + body.find("v")->as_string());
    EXPECT_EQ(glb.status, 200);
    EXPECT_EQ(header(glb, "Cache-Control"), "public, max-age=31536000, immutable");
    EXPECT_EQ(body.at_pointer("/mix/0/id")->as_string(), first_species());
    EXPECT_EQ(body.at_pointer("/mix/0/weight")->as_number(), 1.0);
    EXPECT_EQ(body.at_pointer("/effective/age")->as_number(), 0.9);
    EXPECT_NE(body.at_pointer("/effective/deformation/bend_deg"), nullptr);
    EXPECT_EQ(body.at_pointer("/certificate/simple")->as_bool(), true);
    EXPECT_EQ(body.at_pointer("/certificate/method")->as_string(), "exact");
    for (int axis = 0; axis < 3; ++axis) {
        const std::string at = "/" + std::to_string(axis);
        EXPECT_LT(body.at_pointer("/bounds_m/min" + at)->as_number(),
                  body.at_pointer("/bounds_m/max" + at)->as_number());
    }
    const Response inspected = ask(post(text_of(glb), "/v1/inspect", "model/gltf-binary"));
    ASSERT_EQ(inspected.status, 200) << text_of(inspected);
    const Value found = json_of(inspected);
    EXPECT_EQ(body.at_pointer("/estimate/vertices")->as_number(),
              found.at_pointer("/counts/vertices")->as_number());
    EXPECT_NEAR(body.at_pointer("/estimate/triangles")->as_number(),
                found.at_pointer("/counts/triangles")->as_number(),
                0.1 * found.at_pointer("/counts/triangles")->as_number());
    EXPECT_NEAR(body.at_pointer("/estimate/bytes")->as_number(),
                static_cast<double>(size_of(glb.body)),
                0.5 * static_cast<double>(size_of(glb.body)));
}

TEST_F(ServiceTest, CollapsedRequestsSaySoAndKeepTheirOwnHeaders) {
    const Request plain = get(small());
    const Request versioned = get(header(ask(request("HEAD", small())), "Content-Location"));
    auto first = test::plan(service_, plain), second = test::plan(service_, versioned);
    ASSERT_TRUE(std::holds_alternative<Job>(first));
    ASSERT_TRUE(std::holds_alternative<Job>(second));
    EXPECT_EQ(std::get<Job>(first).key, std::get<Job>(second).key);
    EXPECT_GT(std::get<Job>(first).cost.vertices, 0u);
    EXPECT_GT(std::get<Job>(first).cost.texels, 0u);
    const Response shared = std::get<Job>(first).run(
        {}, [](Step) {}, in_turn);
    service_.finish(std::get<Job>(first).key, shared);
    const Response generated = service_.deliver(plain, std::get<Job>(first).delivery, shared,
                                                Outcome::generated, {.queue = 1.25});
    const Response collapsed = service_.deliver(versioned, std::get<Job>(second).delivery, shared,
                                                Outcome::collapsed, {.queue = 0.5});
    EXPECT_EQ(header(generated, "Cache-Control"),
              "public, max-age=3600, stale-while-revalidate=86400");
    EXPECT_EQ(header(collapsed, "Cache-Control"), "public, max-age=31536000, immutable");
    EXPECT_EQ(header(generated, "Server-Timing"), "queue;dur=1.25");
    EXPECT_TRUE(header(generated, "Cache-Status").ends_with("sporeprint; fwd=miss; stored"));
    EXPECT_TRUE(header(collapsed, "Cache-Status").ends_with("sporeprint; fwd=miss; collapsed"));
}

TEST(ServiceCache, AResponseTooLargeToCacheIsNotReportedAsStored) {
    ServiceOptions options;
    options.cache_bytes = 8'000;
    Service service(built_in_atlas(), options);
    const Response response = handle(service, get(small("&textures=none")));
    EXPECT_EQ(header(response, "Cache-Status"),
              "sporeprint-morph; fwd=miss; stored, sporeprint; fwd=miss");
    EXPECT_EQ(service.counters().glb_cache_entries, 0u);
}

TEST_F(ServiceTest, AStoppedJobIs503AndLeavesNothingBehind) {
    auto planned = test::plan(service_, get(small()));
    ASSERT_TRUE(std::holds_alternative<Job>(planned));
    std::stop_source stop;
    stop.request_stop();
    try {
        static_cast<void>(std::get<Job>(planned).run(
            stop.get_token(), [](Step) {}, in_turn));
        FAIL() << "not cancelled";
    } catch (...) {
        const Response response = service_.problem(get(small()), std::current_exception());
        expect_problem(response, 503);
        EXPECT_EQ(header(response, "Retry-After"), "1");
    }
    EXPECT_EQ(ask(small()).status, 200);
}

TEST_F(ServiceTest, UnknownExceptionsAre500WithoutDetails) {
    const Response response =
        service_.problem(get("/"), std::make_exception_ptr(std::runtime_error("secret path")));
    expect_problem(response, 500);
    EXPECT_EQ(text_of(response).find("secret"), std::string::npos);
    expect_problem(service_.problem(get("/"), std::make_exception_ptr(GenerationError("secret"))),
                   500);
    const Response saturated =
        service_.problem(get("/"), 503, "the queue is full", {{"Retry-After", "2"}});
    expect_problem(saturated, 503);
    EXPECT_EQ(header(saturated, "Retry-After"), "2");
    EXPECT_EQ(
        header(service_.problem(
                   {.method = "GET", .target = "/", .headers = {}, .body = {}, .id = "bad id\r\n"},
                   408, ""),
               "X-Request-Id"),
        "");
}

TEST_F(ServiceTest, TheSelfTestGrowsAMushroom) { EXPECT_TRUE(service_.self_test()); }

// --- One meaning, one address -----------------------------------------------------------

/// A random order as query pairs in random order, spelt in random ways.
struct Spelling {
    std::string target, other;
};

Spelling random_spelling() {
    std::vector<std::pair<std::string, double>> values;
    const auto maybe = [&](const char* name, double value) {
        if (*rc::gen::arbitrary<bool>()) values.emplace_back(name, value);
    };
    maybe("seed", *rc::gen::inRange(0, 100000));
    maybe("age", *rc::gen::inRange(0, 1001) / 1000.0);
    maybe("size", 0.25 + *rc::gen::inRange(0, 100) / 40.0);
    maybe("variation", *rc::gen::inRange(0, 11) / 10.0);
    maybe("lod", *rc::gen::inRange(0, 4));
    maybe("weathering.fade", *rc::gen::inRange(0, 101) / 100.0);
    maybe("deformation.lean_deg", *rc::gen::inRange(0, 30) + 0.5);
    maybe("deformation.twist_deg", -*rc::gen::inRange(0, 30) / 4.0);
    const auto spelt = [](double value, int how) {
        const std::string plain = number_text(value);
        if (how == 0) return plain;
        if (how == 1)
            return plain.find_first_of(".e") == std::string::npos ? plain + ".000"
                   : plain.find('e') == std::string::npos         ? plain + "00"
                                                                  : plain;
        return plain.find('e') == std::string::npos
                   ? plain + (*rc::gen::arbitrary<bool>() ? "e0" : "E+00")
                   : plain;
    };
    const std::string path = "/v1/mushrooms/" + first_species() + ".glb";
    Spelling out{path, path + ":"};
    out.other = "/v1/mushrooms/" + first_species() + ":" +
                std::to_string(*rc::gen::inRange(1, 1000)) + ".glb";
    const auto append = [](std::string& target, const std::string& pair) {
        target += (target.find('?') == std::string::npos ? '?' : '&') + pair;
    };
    for (const auto& [name, value] : values) append(out.target, name + '=' + number_text(value));
    std::reverse(values.begin(), values.end());
    for (const auto& [name, value] : values) {
        std::string encoded = name;
        if (*rc::gen::arbitrary<bool>())
            encoded = percent_encoded(name.substr(0, 1)) == name.substr(0, 1)
                          ? "%" + std::string(1, "0123456789ABCDEF"[name[0] >> 4]) +
                                "0123456789ABCDEF"[name[0] & 15] + name.substr(1)
                          : name;
        append(out.other, encoded + '=' + spelt(value, *rc::gen::inRange(0, 3)));
    }
    return out;
}

RC_GTEST_PROP(CanonicalAddressProperty, EqualMeaningHasOneKeyOneTagAndOneAddressThatIsItsOwn, ()) {
    static Service service(built_in_atlas(), ServiceOptions{});
    const auto [target, other] = random_spelling();
    auto one = test::plan(service, get(target)), two = test::plan(service, get(other));
    RC_ASSERT(one.index() == two.index());
    if (std::holds_alternative<Job>(one))
        RC_ASSERT(std::get<Job>(one).key == std::get<Job>(two).key);
    const Response first = handle(service, request("HEAD", target)),
                   second = handle(service, request("HEAD", other));
    RC_ASSERT(first.status == second.status);
    if (first.status != 200) return;
    RC_ASSERT(header(first, "ETag") == header(second, "ETag"));
    const std::string canonical = header(first, "Content-Location");
    RC_ASSERT(canonical == header(second, "Content-Location"));
    const Response again = handle(service, request("HEAD", canonical));
    RC_ASSERT(header(again, "Content-Location") == canonical);
    RC_ASSERT(header(again, "ETag") == header(first, "ETag"));
    // Another meaning, another tag.
    const Response changed = handle(
        service, request("HEAD", canonical.substr(0, canonical.rfind("v=")) + "textures=none"));
    RC_ASSERT(header(changed, "ETag") != header(first, "ETag"));
}

TEST_F(ServiceTest, ANegativeZeroIsZero) {
    const Response plus = ask(request("HEAD", small("&deformation.twist_deg=0"))),
                   minus = ask(request("HEAD", small("&deformation.twist_deg=-0.0")));
    EXPECT_EQ(header(plus, "ETag"), header(minus, "ETag"));
    EXPECT_EQ(header(plus, "Content-Location"), header(minus, "Content-Location"));
    Service other(built_in_atlas(), ServiceOptions{});
    EXPECT_EQ(text_of(ask(small("&textures=none&deformation.twist_deg=0"))),
              text_of(handle(other, get(small("&textures=none&deformation.twist_deg=-0.0")))));
}

// --- Surfaces and inspection ------------------------------------------------------------

TEST_F(ServiceTest, LinkedTexturesAreWhereTheFileSays) {
    const Response embedded = ask(small());
    const Response linked = ask(small("&textures=linked"));
    EXPECT_EQ(header(linked, "Cache-Status"),
              "sporeprint-morph; hit, sporeprint; fwd=miss; stored");
    expect_linked_images(service_, linked, embedded);
}

TEST_F(ServiceTest, TheThreeImagesOfAnAtlasAreOneJob) {
    const std::string path = "/v1/mushrooms/" + first_species() + "/";
    const std::string query = ".jpg?side=128";
    auto colour = plan_here(service_, get(path + "base_color" + query)),
         normal = plan_here(service_, get(path + "normal" + query));
    ASSERT_TRUE(std::holds_alternative<Job>(colour));
    EXPECT_EQ(std::get<Job>(colour).key, std::get<Job>(normal).key);
    const Response shared = std::get<Job>(colour).run(
        {}, [](Step) {}, in_turn);
    const Response one =
        service_.deliver(get(path + "base_color" + query), std::get<Job>(colour).delivery, shared,
                         Outcome::generated, {});
    const Response two =
        service_.deliver(get(path + "normal" + query), std::get<Job>(normal).delivery, shared,
                         Outcome::collapsed, {});
    EXPECT_NE(text_of(one), text_of(two));
    EXPECT_NE(header(one, "ETag"), header(two, "ETag"));
    EXPECT_EQ(header(one, ":digest"), "");
    EXPECT_EQ(header(two, "Cache-Status"), "sporeprint-images; fwd=miss; collapsed");
    EXPECT_EQ(text_of(ask(path + "normal" + query)), text_of(two));
    const Response head = ask(request("HEAD", path + "orm" + query));
    EXPECT_EQ(size_of(head.body), size_of(ask(path + "orm" + query).body));
}

TEST_F(ServiceTest, ErrorsOfImageUrlsAreNamed) {
    const std::string path = "/v1/mushrooms/" + first_species() + "/";
    expect_problem(ask(path + "colour.jpg"), 404);
    expect_problem(ask("/v1/mushrooms/xyzzy/normal.jpg"), 404);
    for (const char* query :
         {"age=2", "side=100", "size_steps=1.5", "size_steps=71", "metrics.cap=1", "seed=1&seed=1"})
        expect_problem(ask(path + "normal.jpg?" + query), 400);
    const Response old = ask(path + "normal.jpg?age=0.6&v=x");
    expect_problem(old, 410);
    EXPECT_TRUE(json_of(old).find("canonical")->as_string().starts_with(path + "normal.jpg?v="));
}

TEST_F(ServiceTest, InspectionGivesTheRequestBack) {
    const std::string requested = small("&seed=5&age=0.3&weathering.fade=0.25");
    const Response glb = ask(requested);
    ASSERT_EQ(glb.status, 200);
    const Response response = ask(post(text_of(glb), "/v1/inspect", "model/gltf-binary"));
    ASSERT_EQ(response.status, 200) << text_of(response);
    EXPECT_EQ(header(response, "Cache-Control"), "no-store");
    EXPECT_EQ(header(response, "ETag"), "");
    const Value body = json_of(response);
    const std::string canonical = body.find("canonical")->as_string();
    EXPECT_EQ(canonical.find("v="), std::string::npos);
    EXPECT_EQ(text_of(ask(canonical)), text_of(glb));
    EXPECT_EQ(body.at_pointer("/effective/seed")->as_number(), 5);
    EXPECT_EQ(body.at_pointer("/effective/weathering/fade")->as_number(), 0.25);
    EXPECT_EQ(body.at_pointer("/counts/bytes")->as_number(),
              static_cast<double>(size_of(glb.body)));
    EXPECT_GT(body.at_pointer("/counts/triangles")->as_number(), 0);
    EXPECT_EQ(body.at_pointer("/counts/images")->as_number(), 3);
}

TEST_F(ServiceTest, WhatIsNoGlbOfOursIs400) {
    const std::string glb = text_of(ask(small()));
    std::string another = glb;
    const std::size_t at = another.find("/v1/mushrooms/");
    ASSERT_NE(at, std::string::npos);
    another.replace(at, 4, "evil");
    for (const std::string& file :
         {std::string(), std::string("glTF"), glb.substr(0, 100), glb.substr(0, glb.size() - 1),
          std::string(1000, '\0'), another})
        expect_problem(ask(post(file, "/v1/inspect", "model/gltf-binary")), 400);
}

/// A GLB of a JSON chunk, and of a binary one of that many zeros.
std::string glb_of(std::string json, std::size_t binary) {
    while (json.size() % 4) json += ' ';
    const auto word = [](std::size_t number) {
        std::string out;
        for (int shift = 0; shift < 32; shift += 8) out += static_cast<char>(number >> shift);
        return out;
    };
    return "glTF" + word(2) + word(28 + json.size() + binary) + word(json.size()) + "JSON" + json +
           word(binary) + std::string("BIN\0", 4) + std::string(binary, '\0');
}

std::string json_of_ours(const std::string& effective, const std::string& more = "") {
    return R"({"asset":{"version":"2.0","generator":"Sporeprint 1","extras":{"canonical":"",)"
           R"("effective":)" +
           effective + "}}" + more + "}";
}

Request inspection_of(std::string file) {
    return post(std::move(file), "/v1/inspect", "model/gltf-binary");
}

TEST_F(ServiceTest, AJsonChunkThatIsTooLongToInspectIs413BeforeItIsRead) {
    const std::string space(most_inspected_json - json_of_ours("{}").size(), ' ');
    EXPECT_EQ(ask(inspection_of(glb_of(json_of_ours("{}") + space, 8))).status, 200);
    const Request longer = inspection_of(glb_of(json_of_ours("{}") + space + "    ", 8));
    const auto planned = test::plan(service_, longer);
    ASSERT_TRUE(std::holds_alternative<Response>(planned)) << "no job is made of it";
    expect_problem(std::get<Response>(planned), 413);
    const std::string detail = json_of(std::get<Response>(planned)).find("detail")->as_string();
    EXPECT_NE(detail.find("the JSON chunk"), std::string::npos) << detail;
    EXPECT_NE(detail.find(std::to_string(most_inspected_json + 4)), std::string::npos) << detail;
    EXPECT_NE(detail.find(std::to_string(most_inspected_json)), std::string::npos) << detail;
}

TEST_F(ServiceTest, AnInspectionHoldsTheJsonChunkAndNotTheUpload) {
    auto planned = test::plan(service_, inspection_of(glb_of(json_of_ours("{}"), 60u << 20)));
    ASSERT_TRUE(std::holds_alternative<Job>(planned));
    const Job& job = std::get<Job>(planned);  // the upload is gone
    EXPECT_LT(job.cost.work(), 200u) << "nor is it charged by the length of what is not read";
    const Response response = job.run(
        {}, [](Step) {}, in_turn);
    EXPECT_EQ(json_of(response).at_pointer("/counts/bytes")->as_number(),
              static_cast<double>(glb_of(json_of_ours("{}"), 60u << 20).size()));
    std::stop_source stop;
    stop.request_stop();
    EXPECT_THROW((void)job.run(
                     stop.get_token(), [](Step) {}, in_turn),
                 Cancelled);
}

TEST_F(ServiceTest, AnInspectionGivesNoMoreBackThanFilesOfOursHold) {
    const std::string text(most_effective_json, 'x');
    const Response large = ask(inspection_of(glb_of(json_of_ours("{\"a\":\"" + text + "\"}"), 0)));
    expect_problem(large, 400);
    EXPECT_LT(text_of(large).size(), 1000u);
    std::string named = json_of_ours("{}");
    named.replace(named.find("Sporeprint 1"), 12, "Sporeprint 1 " + text);
    const Response response = ask(inspection_of(glb_of(named, 0)));
    ASSERT_EQ(response.status, 200);
    EXPECT_LT(text_of(response).size(), 1000u);
    std::string addressed = json_of_ours("{}");
    addressed.replace(addressed.find("canonical\":\"") + 12, 0, "/v1/species?form=" + text);
    expect_problem(ask(inspection_of(glb_of(addressed, 0))), 400);
}

TEST_F(ServiceTest, TheLargestJsonChunksOfOursAreFarFromTheLimit) {
    for (const char* target :
         {"/v1/colonies/marasmius_oreades.glb?count=256&distinct=16&lod=3&texture_size=128",
          "/v1/colonies/marasmius_oreades.glb?count=256&lod=3&textures=none&instancing=gpu",
          "/v1/mushrooms/amanita_muscaria.glb?animation=growth&frames=16&lod=3&texture_size=128",
          "/v1/trees/birch.glb?lod=3&texture_size=128", "/v1/leaves/maple.glb?textures=none"}) {
        const std::string file = text_of(ask(target));
        std::uint32_t length = 0;
        std::memcpy(&length, file.data() + 12, 4);
        EXPECT_LT(length, most_inspected_json / 8) << target;
        const Response response = ask(inspection_of(file));
        ASSERT_EQ(response.status, 200) << target << text_of(response);
        EXPECT_LT(dump(*json_of(response).find("effective")).size(), most_effective_json / 8)
            << target;
        EXPECT_GT(json_of(response).at_pointer("/counts/triangles")->as_number(), 0) << target;
    }
}

TEST_F(ServiceTest, AnyThreadMayAskAtAnyTime) {
    std::atomic<int> wrong{0};
    std::vector<std::jthread> threads;
    for (int t = 0; t < 8; ++t)
        threads.emplace_back([&, t] {
            for (int i = 0; i < 12; ++i) {
                const Response response = handle(
                    service_, get(small("&textures=none&seed=" + std::to_string((t + i) % 4))));
                if (response.status != 200 || text_of(response).substr(0, 4) != "glTF") ++wrong;
                static_cast<void>(service_.counters().glb_cache_bytes.load());
            }
        });
    threads.clear();
    EXPECT_EQ(wrong, 0);
    EXPECT_EQ(service_.counters().glb_cache_entries, 4u);
}

}  // namespace
}  // namespace sporeprint::api::service_test
