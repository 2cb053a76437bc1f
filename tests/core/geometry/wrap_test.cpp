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

TEST(BracketBase, MovesNothingInFrontOfItsReach) {
    Mesh mesh = plane(0.05, 0.9);
    const Mesh before = mesh;
    BracketBase(0.1, 0.05, 2.0, 3.0, 7).apply(mesh);
    EXPECT_TRUE(same_bits(before, mesh));
    BracketBase(0.1, 0.5, 2.0, 0.0, 7).apply(mesh);
    EXPECT_TRUE(same_bits(before, mesh)) << "of no amount";
}

TEST(BracketBase, IsThickestAtTheWallAndUnderTheMiddle) {
    // Two points at equal distances over and under the middle, at several distances from the wall.
    constexpr double middle = 0.2, apart = 0.01;
    double last_down = 1e9, last_up = 1e9;
    for (const double z : {-0.02, 0.0, 0.01, 0.03, 0.06, 0.0999}) {
        Mesh mesh;
        for (const double y : {middle - apart, middle, middle + apart}) {
            mesh.positions.emplace_back(0.03, y, z);
            mesh.normals.emplace_back(0.0F, 0.0F, 1.0F);
        }
        BracketBase(middle, 0.1, 0.3, 2.0, 3).apply(mesh);
        const double down = middle - static_cast<double>(mesh.positions[0].y);
        const double up = static_cast<double>(mesh.positions[2].y) - middle;
        EXPECT_NEAR(static_cast<double>(mesh.positions[1].y), middle, 1e-7);
        EXPECT_LE(down, last_down + 1e-7) << z;
        EXPECT_LE(up, last_up + 1e-7) << z;
        EXPECT_GT(down, z < 0.09 ? up + 1e-5 : up - 1e-7) << z;
        EXPECT_GE(up, apart - 1e-7) << z;
        last_down = down;
        last_up = up;
        const auto [low, high] =
            BracketBase(middle, 0.1, 0.3, 2.0, 3).range(middle - apart, middle);
        EXPECT_LE(low, static_cast<double>(mesh.positions[0].y));
        EXPECT_EQ(high, middle);
    }
    EXPECT_NEAR(last_down, apart, 1e-5);
}

TEST(BracketBase, NormalsAreThoseOfTheMovedSurface) {
    // A slanting plane y = m + 0.3 x - 0.4 z + d: neighbours give its tangents after the move.
    constexpr double step = 1e-4;
    const BracketBase base(0.0, 0.1, 0.25, 2.5, 11);
    for (const double x : {-0.2, 0.0, 0.13})
        for (const double z : {0.002, 0.03, 0.08})
            for (const double d : {-0.3, 0.3}) {
                Mesh mesh;
                for (const auto& [dx, dz] : {std::pair{0.0, 0.0}, {0.0, step}, {step, 0.0}}) {
                    mesh.positions.emplace_back(x + dx, 0.3 * (x + dx) - 0.4 * (z + dz) + d,
                                                z + dz);
                    mesh.normals.emplace_back(glm::normalize(glm::vec3(-0.3F, 1.0F, 0.4F)));
                    mesh.tangents.emplace_back(
                        glm::vec4(glm::normalize(glm::vec3(1.0F, 0.3F, 0.0F)), 1.0F));
                }
                base.apply(mesh);
                const glm::dvec3 at(mesh.positions[0]);
                const glm::dvec3 along = glm::dvec3(mesh.positions[2]) - at;
                const glm::dvec3 normal =
                    glm::normalize(glm::cross(glm::dvec3(mesh.positions[1]) - at, along));
                EXPECT_GT(glm::dot(normal, glm::dvec3(mesh.normals[0])), 0.999)
                    << x << ' ' << z << ' ' << d;
                EXPECT_GT(glm::dot(glm::normalize(along),
                                   glm::normalize(glm::dvec3(glm::vec3(mesh.tangents[0])))),
                          0.999)
                    << x << ' ' << z << ' ' << d;
            }
}

TEST(BracketBase, BelongsToBracketsWithOneOnly) {
    const auto with_base = [](const char* id, double amount) {
        Individual individual = resolved(order_of(id));
        individual.trunk_radius = 0.0;
        individual.azimuth.base = amount;
        return mushroom_mesh(order_of(id), individual);
    };
    EXPECT_FALSE(
        same_bits(with_base("trametes_versicolor", 0.0), with_base("trametes_versicolor", 2.0)));
    EXPECT_TRUE(same_bits(with_base("boletus_edulis", 0.0), with_base("boletus_edulis", 2.0)));
}

}  // namespace
}  // namespace sporeprint::geometry_wrap_test
