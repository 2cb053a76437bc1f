#include "api/openapi.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "api/errors.h"
#include "api/morphs.h"
#include "api/presets.h"
#include "api/routes.h"
#include "api/surfaces.h"
#include "core/model/request.h"
#include "tests/api/support.h"

namespace sporeprint::api {
namespace {

Value document() { return openapi(*built_in_atlas(), "0.0.0"); }

/// Every leaf of a described struct by its query name, found without the schema.
template <class T>
void leaf_names(const std::string& prefix, std::set<std::string>& out) {
    T::fields([&](auto member, const Info& info) {
        using Member = std::remove_cvref_t<decltype(std::declval<T&>().*member)>;
        if constexpr (Described<Member>)
            leaf_names<Member>(info.name[0] ? prefix + info.name + '.' : prefix, out);
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

TEST(OpenApi, holds_every_route_of_the_table) {
    const Value api = document();
    std::set<std::string> ids;
    for (const Route& route : routes()) {
        const Value* path = api.find("paths")->find(route.pattern);
        ASSERT_NE(path, nullptr) << route.pattern;
        const Value* operation =
            path->find(std::string_view(route.method) == "GET" ? "get" : "post");
        ASSERT_NE(operation, nullptr) << route.pattern;
        EXPECT_EQ(operation->find("operationId")->as_string(), route.id);
        EXPECT_NE(operation->at_pointer("/responses/200/content"), nullptr) << route.pattern;
        EXPECT_EQ(operation->find("requestBody") != nullptr, *route.takes != '\0');
        ids.insert(route.id);
    }
    EXPECT_EQ(api.find("paths")->members().size(), ids.size());
}

TEST(OpenApi, names_each_path_parameter_of_a_pattern) {
    const Value api = document();
    for (const Route& route : routes()) {
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

TEST(OpenApi, names_every_query_parameter) {
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
    EXPECT_EQ(query_names(get("/v1/surfaces/mushrooms/{mix}/{image}.jpg")), surface);
    EXPECT_EQ(query_names(get("/v1/leaves/{preset}.glb")), leaf);
    EXPECT_EQ(query_names(get("/v1/leaves/{preset}.json")), leaf);
    EXPECT_EQ(query_names(get("/v1/surfaces/leaves/{preset}/{image}.jpg")), leaf_surface);
    EXPECT_EQ(query_names(get("/v1/trees/{preset}.glb")), tree);
    EXPECT_EQ(query_names(get("/v1/trees/{preset}.json")), tree);
    EXPECT_EQ(query_names(get("/v1/surfaces/trees/{preset}/{image}.jpg")), tree_surface);
    EXPECT_EQ(query_names(get("/v1/morphs/{a}/{b}")), (std::set<std::string>{"age", "v"}));
    EXPECT_EQ(query_names(get("/v1/species")),
              (std::set<std::string>{"form", "family", "substrate", "habit", "month", "colour",
                                     "min_diameter_m", "max_diameter_m"}));
}

TEST(OpenApi, names_every_member_of_a_body) {
    const Value api = document();
    const auto properties = [&](const char* schema) {
        std::set<std::string> out;
        const std::string at = std::string("/components/schemas/") + schema + "/properties";
        for (const auto& [key, ignored] : api.at_pointer(at)->members()) out.insert(key);
        return out;
    };
    std::set<std::string> params, morph = {"t", "arcs", "v"}, mushroom = {"mix", "model", "v"};
    MushroomParams::fields([&](auto, const Info& info) { params.insert(info.name); });
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
    const auto& arc =
        *api.at_pointer("/components/schemas/morph_order/properties/arcs/items/properties");
    EXPECT_EQ(arc.at_pointer("/curve/enum/1")->as_string(), "hymenium");
    EXPECT_EQ(arc.at_pointer("/a/maximum")->as_number(), 1.0);
    EXPECT_EQ(
        api.at_pointer("/components/schemas/morph_order/properties/arcs/maxItems")->as_number(),
        static_cast<double>(most_arcs));
}

TEST(OpenApi, tells_ranges_units_and_whose_default_it_is) {
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

TEST(OpenApi, every_reference_leads_somewhere) {
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

TEST(OpenApi, every_kind_of_problem_has_a_response) {
    const Value api = document();
    for (const ProblemType& type : problem_types()) {
        const Value* response = api.find("components")->find("responses")->find(type.slug);
        ASSERT_NE(response, nullptr) << type.slug;
        EXPECT_EQ(response->find("content")
                      ->find("application/problem+json")
                      ->find("example")
                      ->find("status")
                      ->as_number(),
                  type.status);
    }
}

TEST(MushroomSchema, has_every_parameter_and_no_version) {
    const Value schema = mushroom_schema();
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
}  // namespace sporeprint::api
