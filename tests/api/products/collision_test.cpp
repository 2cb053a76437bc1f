// The solids that a request asks for, in files and descriptions of all products.

#include <gtest/gtest.h>

#include <string>

#include "tests/api/support.h"

namespace sporeprint::api::products_collision_test {
namespace {

using test::get;
using test::text_of;

TEST(CollisionRoutes, DescriptionsListTheSolidsThatTheFileHas) {
    Service service(built_in_atlas(), ServiceOptions{});
    for (const std::string file : {"/v1/mushrooms/boletus_edulis",
                                   "/v1/colonies/hypholoma_fasciculare", "/v1/trees/birch"}) {
        const std::string query = "?lod=2&texture_size=128";
        EXPECT_FALSE(test::json_of(handle(service, get(file + ".json" + query))).find("collision"));
        for (const char* format : {"nodes", "omi"}) {
            const std::string wanted = query + "&collision=" + format;
            const Value described = test::json_of(handle(service, get(file + ".json" + wanted)));
            const Value* solids = described.find("collision");
            ASSERT_TRUE(solids) << file;
            EXPECT_GE(solids->find("shapes")->items().size(), 1U);
            EXPECT_GE(solids->find("colliders")->items().size(),
                      solids->find("shapes")->items().size());
            EXPECT_EQ(described.find("effective")->find("collision")->as_string(), format);
            const Response model = handle(service, get(file + ".glb" + wanted));
            ASSERT_EQ(model.status, 200) << text_of(model);
            EXPECT_NE(test::header(model, "Content-Disposition")
                          .find(std::string("_collision_") + format),
                      std::string::npos);
        }
    }
}

TEST(CollisionRoutes, WhatIsImpossibleIsNamed) {
    Service service(built_in_atlas(), ServiceOptions{});
    for (const char* target :
         {"/v1/leaves/maple.glb?collision=nodes", "/v1/leaves/maple.json?collision=omi",
          "/v1/trees/birch.glb?collision=omi&compress=quantize",
          "/v1/colonies/boletus_edulis.glb?collision=omi&profile=web",
          "/v1/mushrooms/boletus_edulis.json?collision=omi&compress=meshopt"}) {
        const Response refused = handle(service, get(target));
        EXPECT_EQ(refused.status, 422) << target;
        EXPECT_NE(text_of(refused).find(R"("parameter":"collision")"), std::string::npos) << target;
    }
    EXPECT_EQ(handle(service, get("/v1/mushrooms/boletus_edulis.glb?collision=convex")).status,
              400);
}

}  // namespace
}  // namespace sporeprint::api::products_collision_test
