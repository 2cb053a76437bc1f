#include "api/openapi.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "api/http/errors.h"
#include "api/http/text.h"
#include "api/products/leaves.h"
#include "api/products/morphs.h"
#include "api/products/presets.h"
#include "api/products/surfaces.h"
#include "api/products/trees.h"
#include "api/routes.h"
#include "core/individual/mushroom_spec.h"
#include "tests/api/support.h"

namespace sporeprint::api::openapi_test {
namespace {

Value document(bool signed_urls = false) {
    return openapi({*built_in_atlas(), route_table(), signed_urls, {}}, "0.0.0");
}

/// Every leaf of a described struct by its query name, found without the schema.
template <class T>
void leaf_names(const std::string& prefix, std::set<std::string>& out) {
    T::fields([&](auto member, const Info& info) {
        using Member = std::remove_cvref_t<decltype(std::declval<T&>().*member)>;
        if constexpr (Described<Member>)
            leaf_names<Member>(info.name[0] ? prefix + info.name + '.' : prefix, out);
        else if constexpr (has_query_members<Member>)
            leaf_names<typename Member::value_type>(prefix + info.name + '.', out);
        else
            out.insert(prefix + info.name);
    });
}

std::set<std::string> query_names(const Value& operation) {
    std::set<std::string> out;
    for (const Value& parameter : operation.find("parameters")->items())
        if (parameter.find("in")->as_string() == "query") {
            EXPECT_TRUE(out.insert(parameter.find("name")->as_string()).second);
            EXPECT_NE(parameter.find("description"), nullptr)
                << parameter.find("name")->as_string();
        }
    return out;
}

TEST(OpenApi, HoldsEveryRouteOfTheTable) {
    const Value api = document();
    std::set<std::string> ids;
    for (const Route* const each : route_table().routes()) {
        const Route& route = *each;
        const Value* path = api.find("paths")->find(route.pattern);
        ASSERT_NE(path, nullptr) << route.pattern;
        const Value* operation = path->find(lower(route.method));
        ASSERT_NE(operation, nullptr) << route.pattern;
        EXPECT_EQ(operation->find("operationId")->as_string(), route.id);
        const std::string success = "/responses/" + std::to_string(route.success);
        ASSERT_NE(operation->at_pointer(success), nullptr) << route.pattern;
        EXPECT_EQ(operation->at_pointer(success + "/content") != nullptr, route.success != 204)
            << route.pattern;
        EXPECT_EQ(operation->find("requestBody") != nullptr, *route.body_type != '\0');
        if (std::string_view(route.method) == "GET") {
            EXPECT_NE(path->find("head"), nullptr);
        }
        for (const auto& [method, one] : path->members()) {
            EXPECT_GE(one.find("description")->as_string().size(), 10u) << route.pattern;
            EXPECT_EQ(one.find("tags")->items().size(), 1u) << route.pattern;
        }
        EXPECT_TRUE(ids.insert(route.id).second);
    }
    std::size_t operations = 0;
    for (const auto& [path, item] : api.find("paths")->members())
        for (const auto& [method, one] : item.members()) operations += method == "head" ? 0 : 1;
    EXPECT_EQ(operations, ids.size());
}

TEST(OpenApi, NamesEachPathParameterOfAPattern) {
    const Value api = document();
    for (const Route* const each : route_table().routes()) {
        const Route& route = *each;
        const std::string pattern = route.pattern;
        for (std::size_t open = pattern.find('{'); open != std::string::npos;
             open = pattern.find('{', open + 1)) {
            const std::string name = pattern.substr(open + 1, pattern.find('}', open) - open - 1);
            bool found = false;
            for (const Value& parameter :
                 api.find("paths")->find(pattern)->members()[0].second.find("parameters")->items())
                found = found || (parameter.find("name")->as_string() == name &&
                                  parameter.find("in")->as_string() == "path");
            EXPECT_TRUE(found) << pattern << ' ' << name;
        }
    }
}

TEST(OpenApi, NamesEveryQueryParameter) {
    const Value api = document();
    std::set<std::string> mushroom = {"v"}, surface = {"v"};
    leaf_names<MushroomParams>("", mushroom);
    leaf_names<SurfaceAddress>("", surface);
    std::set<std::string> leaf = {"v"}, leaf_surface = {"v"};
    leaf_names<LeafParams>("", leaf);
    leaf_names<LeafPaint>("", leaf_surface);
    std::set<std::string> tree = {"v"}, tree_surface = {"v"};
    leaf_names<TreeParams>("", tree);
    tree.erase("rows");  // a list comes in a body
    leaf_names<TreePaint>("", tree_surface);
    const auto get = [&](const char* path) -> const Value& {
        return *api.find("paths")->find(path)->find("get");
    };
    EXPECT_EQ(query_names(get("/v1/mushrooms/{mix}.glb")), mushroom);
    EXPECT_EQ(query_names(get("/v1/mushrooms/{mix}.json")), mushroom);
    EXPECT_EQ(query_names(get("/v1/mushrooms/{mix}/{image}.jpg")), surface);
    EXPECT_EQ(query_names(get("/v1/leaves/{preset}.glb")), leaf);
    EXPECT_EQ(query_names(get("/v1/leaves/{preset}.json")), leaf);
    EXPECT_EQ(query_names(get("/v1/leaves/{preset}/{image}.jpg")), leaf_surface);
    EXPECT_EQ(query_names(get("/v1/trees/{preset}.glb")), tree);
    EXPECT_EQ(query_names(get("/v1/trees/{preset}.json")), tree);
    EXPECT_EQ(query_names(get("/v1/trees/{preset}/{image}.jpg")), tree_surface);
    EXPECT_EQ(query_names(get("/v1/worlds/{world}.json")), (std::set<std::string>{}));
    EXPECT_EQ(query_names(get("/v1/worlds/{world}/weather.json")), (std::set<std::string>{"year"}));
    EXPECT_EQ(query_names(get("/v1/morphs/{a}/{b}")), (std::set<std::string>{"age", "v"}));
    EXPECT_EQ(query_names(get("/v1/species")),
              (std::set<std::string>{"form", "family", "substrate", "habit", "month", "colour",
                                     "min_diameter_m", "max_diameter_m"}));
}

TEST(OpenApi, NamesEveryMemberOfABody) {
    const Value api = document();
    const auto properties = [&](const char* schema) {
        std::set<std::string> out;
        const std::string at = std::string("/components/requestBodies/") + schema +
                               "/content/application~1json/schema/properties";
        for (const auto& [key, ignored] : api.at_pointer(at)->members()) out.insert(key);
        return out;
    };
    std::set<std::string> params, morph = {"t", "arcs", "v"}, mushroom = {"mix", "model", "v"};
    std::set<std::string> params_of_mushroom;
    leaf_names<MushroomParams>("", params_of_mushroom);
    for (const std::string& name : params_of_mushroom)
        params.insert(name.substr(0, name.find('.')));
    morph.insert(params.begin(), params.end());
    mushroom.insert(params.begin(), params.end());
    std::set<std::string> leaf = {"preset", "v"}, params_of_leaf;
    leaf_names<LeafParams>("", params_of_leaf);
    for (const std::string& name : params_of_leaf) leaf.insert(name.substr(0, name.find('.')));
    EXPECT_EQ(properties("leaf_order"), leaf);
    std::set<std::string> tree = {"preset", "v"}, params_of_tree;
    leaf_names<TreeParams>("", params_of_tree);
    for (const std::string& name : params_of_tree) tree.insert(name.substr(0, name.find('.')));
    EXPECT_EQ(properties("tree_order"), tree);
    EXPECT_EQ(properties("morph_order"), morph);
    EXPECT_EQ(properties("mushroom_order"), mushroom);
    const std::string arcs =
        "/components/requestBodies/morph_order/content/application~1json/schema/properties/arcs";
    const auto& arc = *api.at_pointer(arcs + "/items/properties");
    EXPECT_EQ(arc.at_pointer("/curve/enum/1")->as_string(), "hymenium");
    EXPECT_EQ(arc.at_pointer("/a/maximum")->as_number(), 1.0);
    EXPECT_EQ(api.at_pointer(arcs + "/maxItems")->as_number(), static_cast<double>(most_arcs));
}

TEST(OpenApi, TellsRangesUnitsAndWhoseDefaultItIs) {
    const Value api = document();
    for (const Value& parameter : api.find("paths")
                                      ->find("/v1/mushrooms/{mix}.glb")
                                      ->at_pointer("/get/parameters")
                                      ->items()) {
        const std::string name = parameter.find("name")->as_string();
        const Value& schema = *parameter.find("schema");
        if (name == "age") {
            EXPECT_EQ(schema.find("minimum")->as_number(), 0.0);
            EXPECT_EQ(schema.find("maximum")->as_number(), 1.0);
            EXPECT_EQ(schema.find("default")->as_number(), 0.6);
        }
        if (name == "deformation.bend_deg") {
            EXPECT_EQ(schema.find("x-unit")->as_string(), "deg");
            EXPECT_EQ(schema.find("x-default-from")->as_string(), "species");
            EXPECT_EQ(schema.find("default"), nullptr);
        }
    }
}

TEST(OpenApi, EveryReferenceLeadsSomewhere) {
    const Value api = document();
    int references = 0;
    const std::function<void(const Value&)> walk = [&](const Value& value) {
        if (value.is_array())
            for (const Value& item : value.items()) walk(item);
        if (!value.is_object()) return;
        for (const auto& [key, member] : value.members()) {
            if (key == "$ref") {
                ++references;
                EXPECT_NE(api.at_pointer(member.as_string().substr(1)), nullptr)
                    << member.as_string();
            }
            walk(member);
        }
    };
    walk(api);
    EXPECT_GT(references, 50);
}

TEST(OpenApi, EveryKindOfProblemHasAResponse) {
    const Value api = document(true);
    for (const ProblemType& type : problem_types()) {
        if (type.status == 501) continue;  // no operation has such a method
        const Value* response = api.find("components")->find("responses")->find(type.slug);
        ASSERT_NE(response, nullptr) << type.slug;
        EXPECT_EQ(response->find("content")
                      ->find("application/problem+json")
                      ->find("example")
                      ->find("status")
                      ->as_number(),
                  type.status);
        EXPECT_NE(response->find("headers")->find("Cache-Control"), nullptr);
    }
    const auto header = [&](const char* slug, const char* name) {
        return api.at_pointer(std::string("/components/responses/") + slug + "/headers/" + name);
    };
    EXPECT_NE(header("method-not-allowed", "Allow"), nullptr);
    EXPECT_NE(header("unavailable", "Retry-After"), nullptr);
    EXPECT_NE(header("too-many-requests", "RateLimit"), nullptr);
    EXPECT_NE(header("range-not-satisfiable", "Content-Range"), nullptr);
}

const Value& responses(const Value& api, const char* path, const char* method) {
    return *api.find("paths")->find(path)->find(method)->find("responses");
}

TEST(OpenApi, DescribesConditionsAndRangesWhereTheyAreSupported) {
    const Value api = document();
    for (const Route* const each : route_table().routes()) {
        const Route& route = *each;
        const bool is_upload = route.kind == RouteKind::upload;
        if (route.kind == RouteKind::record) {
            const Value& own = responses(api, route.pattern, lower(route.method).c_str());
            const bool is_get = std::string_view(route.method) == "GET";
            EXPECT_EQ(own.find("304") != nullptr, is_get && route.has_etag) << route.id;
            EXPECT_EQ(own.find("412") != nullptr,
                      route.has_condition || (is_get && route.has_etag));
            const bool is_glb = std::string_view(route.media_type) == "model/gltf-binary";
            for (const char* status : {"206", "416"})
                EXPECT_EQ(own.find(status) != nullptr, is_get && is_glb) << route.id << status;
            continue;
        }
        const bool is_get = std::string_view(route.method) == "GET";
        const Value& all = responses(api, route.pattern, lower(route.method).c_str());
        if (!is_get || is_upload) {
            EXPECT_EQ(all.find("304"), nullptr) << route.pattern;
            EXPECT_EQ(all.find("412") != nullptr, !is_upload);
        }
        const bool is_file = is_get && !is_upload &&
                             (std::string_view(route.media_type) == "model/gltf-binary" ||
                              std::string_view(route.media_type).starts_with("image/") ||
                              std::string_view(route.media_type) == "application/octet-stream" ||
                              std::string_view(route.pattern) == "/assets/{name}");
        for (const char* status : {"206", "416"})
            EXPECT_EQ(all.find(status) != nullptr, is_file) << route.pattern << status;
    }
    const Value& generated = responses(api, "/v1/mushrooms/{mix}.glb", "get");
    for (const char* name : {"ETag", "Cache-Control", "Cache-Status", "Content-Location",
                             "Accept-Ranges", "RateLimit", "RateLimit-Policy", "X-Request-Id"})
        EXPECT_NE(generated.find("200")->find("headers")->find(name), nullptr) << name;
}

TEST(OpenApi, RequiresSignaturesOnlyWhereTheServerDoes) {
    const Value plain = document();
    const Value protected_api = document(true);
    EXPECT_EQ(plain.at_pointer("/components/securitySchemes/signature"), nullptr);
    EXPECT_EQ(protected_api.at_pointer("/components/securitySchemes/signature/in")->as_string(),
              "query");
    for (const Route* const each : route_table().routes()) {
        const Route& route = *each;
        const std::string method = lower(route.method);
        const Value& operation = *protected_api.find("paths")->find(route.pattern)->find(method);
        if (route.access != Access::open) continue;  // these routes need a token
        EXPECT_EQ(operation.find("security") != nullptr, is_generated(route)) << route.pattern;
        EXPECT_EQ(operation.at_pointer("/responses/403") != nullptr, is_generated(route));
        std::set<std::string> names;
        if (operation.find("parameters")) names = query_names(operation);
        for (const char* name : {"key", "expires", "sig"})
            EXPECT_EQ(names.contains(name), is_generated(route)) << route.pattern << name;
        EXPECT_EQ(responses(plain, route.pattern, method.c_str()).find("403"), nullptr);
    }
}

TEST(OpenApi, RequiresTokensWhereTheServerDoes) {
    const Value api = document();
    EXPECT_EQ(api.at_pointer("/components/securitySchemes/token/scheme")->as_string(), "bearer");
    for (const Route* const route : route_table().routes()) {
        if (route->access == Access::open) continue;
        const std::string method = lower(route->method);
        const Value& operation = *api.find("paths")->find(route->pattern)->find(method);
        const Value& security = *operation.find("security");
        EXPECT_NE(security.items().back().find("token"), nullptr) << route->id;
        EXPECT_EQ(security.items().size(), route->access == Access::required ? 1U : 2U)
            << route->id;
        for (const char* const status : {"401", "403"})
            EXPECT_NE(operation.find("responses")->find(status), nullptr) << route->id;
        const Value* const parameters = operation.find("parameters");
        const bool has_condition =
            parameters && dump(*parameters).find("\"If-Match\"") != std::string::npos;
        EXPECT_EQ(has_condition, route->has_condition) << route->id;
        EXPECT_EQ(operation.find("responses")->find("428") != nullptr, route->has_condition);
    }
}

TEST(OpenApi, HasTheMediaTypesOfResponses) {
    const Value api = document();
    EXPECT_NE(api.at_pointer("/paths/~1readyz/get/responses/200/content/text~1plain"), nullptr);
    EXPECT_EQ(api.at_pointer("/paths/~1readyz/get/responses/503/$ref")->as_string(),
              "#/components/responses/unavailable");
    EXPECT_EQ(dump(*api.at_pointer("/components/schemas/inspection/properties/canonical/type")),
              R"(["string","null"])");
}

TEST(OpenApi, ABodyRequiresOnlyWhatHasNoDefaultAndAResponseHasAll) {
    const Value api = document();
    const std::function<void(const Value&)> none_in_responses = [&](const Value& value) {
        if (value.is_array())
            for (const Value& item : value.items()) none_in_responses(item);
        if (!value.is_object()) return;
        EXPECT_EQ(value.find("default"), nullptr) << dump(value);
        for (const auto& [key, member] : value.members()) none_in_responses(member);
    };
    none_in_responses(*api.at_pointer("/components/schemas"));
    const std::string body = "/content/application~1json/schema";
    EXPECT_EQ(api.at_pointer("/components/requestBodies/mushroom_order" + body +
                             "/properties/age/default")
                  ->as_number(),
              0.6);
    EXPECT_EQ(dump(*api.at_pointer("/components/requestBodies/leaf_order" + body + "/required")),
              R"(["preset"])");
    const std::string required =
        dump(*api.at_pointer("/components/schemas/mushroom_params/required"));
    for (const char* name : {"\"seed\"", "\"age\"", "\"deformation\""})
        EXPECT_NE(required.find(name), std::string::npos) << required;
}

/// The orders that the document allows a branched model are those that are grown.
TEST(OpenApi, AllowsABushTheOrdersThatItCanHave) {
    const Value api = document();
    const Value* model = api.at_pointer(
        "/components/requestBodies/mushroom_order/content/application~1json/schema/properties/"
        "model");
    ASSERT_NE(model, nullptr);
    int least = 0;
    for (const Value& form : model->find("oneOf")->items())
        if (const Value* found = form.at_pointer("/properties/ramification/properties/order"))
            least = static_cast<int>(found->find("minimum")->as_number());
    ASSERT_GT(least, 1);
    Service service(built_in_atlas(), ServiceOptions{});
    const auto grown = [&](int spec) {
        return handle(service, test::post(R"({"lod":3,"texture_size":128,"model":{"form":)"
                                          R"("branched","ramification":{"order":)" +
                                          std::to_string(spec) + "}}}"));
    };
    EXPECT_EQ(grown(least).status, 200) << test::text_of(grown(least));
    EXPECT_EQ(grown(least - 1).status, 422);
}

TEST(MushroomSchema, HasEveryParameterAndNoVersion) {
    const Value schema = test::document_at("/v1/mushrooms/schema");
    std::set<std::string> names, found;
    leaf_names<MushroomParams>("", names);
    const std::function<void(const Value&, const std::string&)> walk =
        [&](const Value& object, const std::string& prefix) {
            for (const auto& [key, property] : object.find("properties")->members()) {
                if (property.find("properties"))
                    walk(property, prefix + key + '.');
                else
                    found.insert(prefix + key);
            }
        };
    walk(schema, "");
    EXPECT_EQ(found, names);
    EXPECT_EQ(schema.find("$schema")->as_string(), "https://json-schema.org/draft/2020-12/schema");
}

}  // namespace
}  // namespace sporeprint::api::openapi_test
