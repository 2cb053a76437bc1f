#include "core/geometry/wrap.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "core/mesh/measure.h"
#include "tests/support/meshes.h"
#include "tests/support/orders.h"

namespace sporeprint::geometry_wrap_test {
namespace {

/// Returns a mesh without triangles of points in the plane z = `front`, whose normals look along +z
/// and whose tangents along +x.
Mesh plane(double front, double half_width) {
    Mesh mesh;
    for (int i = -20; i <= 20; ++i)
        for (const double y : {-0.3, 0.0, 0.7}) {
            mesh.positions.emplace_back(half_width * i / 20.0, y, front);
            mesh.normals.emplace_back(0.0F, 0.0F, 1.0F);
            mesh.tangents.emplace_back(1.0F, 0.0F, 0.0F, 1.0F);
        }
    return mesh;
}

TEST(Wrap, AFlatWallStaysAsItIs) {
    const Mesh before = mesh_of(textured(order_of("fomes_fomentarius", 0.6, 1, 2)));
    Mesh after = before;
    wrap_round_trunk(after, 0.0);
    EXPECT_TRUE(same_bits(before, after));
}

TEST(Wrap, TheWallBecomesTheTrunk) {
    for (const double radius : {0.02, 1.0}) {
        Mesh mesh = plane(0.0, 0.8 * radius);
        wrap_round_trunk(mesh, radius);
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            const glm::dvec3 from_axis =
                glm::dvec3(mesh.positions[i]) + glm::dvec3(0.0, 0.0, radius);
            const glm::dvec3 outwards(from_axis.x, 0.0, from_axis.z);
            EXPECT_NEAR(glm::length(outwards), radius, 1e-6 * radius);
            EXPECT_GT(glm::dot(glm::dvec3(mesh.normals[i]), outwards) / radius, 0.99999);
            const glm::dvec3 tangent(mesh.tangents[i]);
            EXPECT_NEAR(glm::dot(tangent, glm::dvec3(mesh.normals[i])), 0.0, 1e-6);
            EXPECT_NEAR(glm::length(tangent), 1.0, 1e-6);
            EXPECT_GT(tangent.x, 0.5) << "still along increasing u";
        }
    }
}

TEST(Wrap, WhatIsATrunksRadiusInFrontIsNotMoved) {
    Mesh mesh = plane(0.5, 0.9);
    const Mesh before = mesh;
    wrap_round_trunk(mesh, 0.5);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        EXPECT_EQ(mesh.positions[i], before.positions[i]);
        EXPECT_EQ(mesh.normals[i], before.normals[i]);
    }
}

TEST(Wrap, PointsBehindOneAnotherKeepTheirOrder) {
    EXPECT_TRUE(rc::check("any two points of a line along z", [] {
        const double x = *rc::gen::inRange(-3000, 3001) / 1000.0;
        const double back = *rc::gen::inRange(-2000, 2000) / 1000.0;
        const double apart = *rc::gen::inRange(1, 1000) / 1000.0;
        Mesh mesh;
        for (const double z : {back, back + apart}) {
            mesh.positions.emplace_back(x, 0.0, z);
            mesh.normals.emplace_back(0.6F, 0.0F, 0.8F);
        }
        wrap_round_trunk(mesh, 1.0);
        RC_ASSERT(static_cast<double>(mesh.positions[1].z - mesh.positions[0].z) > 0.999 * apart);
    }));
}

TEST(Wrap, NormalsAreThoseOfTheMovedSurface) {
    // A slanting plane z = 0.3 x + 0.2 y: neighbours give its tangents after the move.
    constexpr double radius = 0.7, step = 1e-3;
    for (const double x : {-1.0, -0.4, 0.0, 0.2, 0.5})
        for (const double y : {0.0, 0.8}) {
            Mesh mesh;
            for (const auto& [dx, dy] : {std::pair{0.0, 0.0}, {step, 0.0}, {0.0, step}}) {
                mesh.positions.emplace_back(x + dx, y + dy, 0.3 * (x + dx) + 0.2 * (y + dy));
                mesh.normals.emplace_back(glm::normalize(glm::vec3(-0.3F, -0.2F, 1.0F)));
            }
            wrap_round_trunk(mesh, radius);
            const glm::dvec3 at(mesh.positions[0]);
            const glm::dvec3 normal = glm::normalize(
                glm::cross(glm::dvec3(mesh.positions[1]) - at, glm::dvec3(mesh.positions[2]) - at));
            EXPECT_GT(glm::dot(normal, glm::dvec3(mesh.normals[0])), 0.9999) << x << ' ' << y;
        }
}

TEST(Wrap, BracketsHaveNoGapToTheirTrunk) {
    // What of a bracket is at the wall before is inside the wood after, out to its sides.
    for (const char* id : {"fomes_fomentarius", "trametes_versicolor", "pleurotus_ostreatus"}) {
        const MushroomSpec spec = on_wood(order_of(id));
        Individual individual = resolved(spec);
        const double radius = individual.trunk_radius;
        ASSERT_GT(radius, 0.0);
        const Mesh after = mushroom_mesh(spec, individual);
        individual.trunk_radius = 0.0;
        const Mesh flat = mushroom_mesh(spec, individual);
        ASSERT_EQ(flat.positions.size(), after.positions.size());
        int at_wall = 0;
        for (std::size_t i = 0; i < flat.positions.size(); ++i) {
            if (flat.positions[i].z > 0.0F) continue;
            ++at_wall;
            const glm::dvec3 at(after.positions[i]);
            EXPECT_LE(std::hypot(at.x, at.z + radius), 1.01 * radius) << id;
        }
        EXPECT_GT(at_wall, 10) << id;
    }
}

}  // namespace
}  // namespace sporeprint::geometry_wrap_test
