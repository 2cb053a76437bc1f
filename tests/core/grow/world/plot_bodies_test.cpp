#include "core/grow/world/plot_bodies.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <string>

#include "core/grow/mushroom.h"
#include "core/individual/resolve.h"
#include "core/math/direction.h"
#include "core/math/elementary.h"
#include "tests/support/orders.h"
#include "tests/support/plots.h"

namespace sporeprint::grow_plot_bodies_test {
namespace {

PlotBodies made_of(const PlotContent& content, std::uint64_t most = 10'000'000) {
    const FloorHeights floor(*content.ground, content.seed, content.micro, {});
    const PlotFrame frame(content, floor);
    PlotOptions options;
    options.textures = Textures::none;
    ExecutionContext execution;
    execution.caches.morphs = cached_morphs();
    return bodies_of(content, options, frame, most, atlas(), execution);
}

TEST(PlotBodies, AreShownByTheNearestOfAFew) {
    const PlotContent content = small_wood().content();
    const PlotBodies made = made_of(content);
    EXPECT_LE(made.shapes.size(), most_plot_mushrooms);
    std::size_t standing = 0;
    for (const FruitBody& body : content.bodies)
        standing += body.stands_at(content.time) && std::abs(metres(body.at.x)) < 2.0 ? 1 : 0;
    EXPECT_EQ(made.bodies.size(), standing);
    for (const PlotBodies::Placed& body : made.bodies) {
        const MushroomSpec& shown = made.shapes[body.shape].spec;
        EXPECT_EQ(shown.mix.front().id, content.species[body.species]);
        EXPECT_NEAR(shown.params.age, body.age, 0.5 / 4.0 + 1e-9);
    }
}

TEST(PlotBodies, OfTilesAreGrownOnceForEachSpecies) {
    const PlotContent content = small_wood().content();
    ExecutionContext execution;
    std::map<std::string, std::shared_ptr<const BodyShape>> known;
    std::size_t grown = 0;
    execution.caches.bodies = [&](const std::string& key, const auto& make) {
        std::shared_ptr<const BodyShape>& value = known[key];
        if (!value) {
            value = make();
            ++grown;
        }
        return value;
    };
    for (int again = 0; again < 2; ++again)
        for (const std::uint32_t seed : {1U, 2U}) {
            MushroomSpec spec = look_of_body(content, 0, 0.6, seed, atlas()).spec;
            spec.params.lod = 2;
            const auto shape = body_shape(spec, atlas(), execution);
            const Mesh alone = mushroom_mesh(spec, resolve(spec, atlas()));
            EXPECT_EQ(shape->mesh.positions, alone.positions);
            EXPECT_EQ(shape->mesh.indices, alone.indices);
            EXPECT_GT(shape->bytes(), 40 * alone.positions.size());
        }
    EXPECT_EQ(grown, 2U);
    EXPECT_EQ(known.size(), 2U);
}

TEST(PlotBodies, StandOnTheFloor) {
    const PlotContent content = small_wood().content();
    const FloorHeights floor(*content.ground, content.seed, content.micro, {});
    const PlotFrame frame(content, floor);
    for (const PlotBodies::Placed& body : made_of(content).bodies) {
        const auto record = std::find_if(content.bodies.begin(), content.bodies.end(),
                                         [&](const FruitBody& one) { return one.id == body.id; });
        ASSERT_NE(record, content.bodies.end());
        const glm::dvec3 foot = frame.on_floor(metres(record->at.x), metres(record->at.y));
        EXPECT_EQ(body.place.translation, foot);
    }
}

TEST(PlotBodies, OnWoodFaceAwayFromIt) {
    SmallWood wood = small_wood();
    FruitBody bracket = wood.bodies.front();
    bracket.at = world_point(0.5, 0.5);
    bracket.trunk = 902;
    bracket.height = 1.3;
    bracket.facing = radians(90.0);
    wood.bodies = {bracket};
    PlotContent content = wood.content();
    content.species = {"trametes_versicolor"};
    const PlotBodies made = made_of(content);
    ASSERT_EQ(made.bodies.size(), 1U);
    const glm::dvec3 out = rotated(made.bodies[0].place.rotation, {0.0, 0.0, 1.0}),
                     up = rotated(made.bodies[0].place.rotation, {0.0, 1.0, 0.0});
    EXPECT_NEAR(glm::distance(out, glm::dvec3(0.0, 0.0, -1.0)), 0.0, 1e-9) << "north";
    EXPECT_NEAR(glm::distance(up, glm::dvec3(0.0, 1.0, 0.0)), 0.0, 1e-9);
}

TEST(PlotBodies, OnWoodTouchItsBark) {
    SmallWood wood = small_wood();
    const DeadWood& log = wood.dead.front();
    std::vector<FruitBody> bodies;
    for (int i = 0; i < 12; ++i) {
        FruitBody body = wood.bodies.front();
        const double along = 5.0 + 0.2 * i, angle = -1.1 + 0.2 * i;
        body.id += static_cast<std::uint64_t>(i + 1);
        body.at = world_point(metres(log.at.x) + along * cosine(log.direction),
                              metres(log.at.y) + along * sine(log.direction));
        body.trunk = log.id;
        body.height = 0.3;
        body.facing = log.direction + (angle < 0.0 ? -0.5 : 0.5) * pi;
        body.pitch = 0.5 * pi - std::abs(angle);
        bodies.push_back(body);
    }
    wood.bodies = bodies;
    const PlotContent content = wood.content();
    const FloorHeights floor(*content.ground, content.seed, content.micro, {});
    const PlotFrame frame(content, floor);
    const PlotBodies made = made_of(content);
    const auto line = trunk_line(log, content, frame);
    ASSERT_TRUE(line);
    ASSERT_EQ(made.bodies.size(), bodies.size());
    for (const PlotBodies::Placed& body : made.bodies) {
        double nearest = 1e9, radius = 0.0;
        for (double s = line->from; s < line->to; s += 0.01) {
            const TrunkSection section = line->section(s);
            const double distance = glm::distance(section.middle, body.place.translation);
            if (distance >= nearest) continue;
            nearest = distance;
            radius = section.radius;
        }
        EXPECT_NEAR(nearest / radius, 0.96, 0.02);
    }
}

TEST(PlotBodies, HaveFewerTrianglesOnDemand) {
    const PlotContent content = small_wood().content();
    const auto count = [](const PlotBodies& made) {
        std::uint64_t triangles = 0;
        for (const PlotBodies::Placed& body : made.bodies)
            triangles += made.shapes[body.shape].mesh.triangles();
        return triangles;
    };
    EXPECT_LE(count(made_of(content, 30'000)), 30'000U);
    EXPECT_GT(count(made_of(content)), 60'000U);
}

TEST(PlotBodies, RefuseUnknownSpecies) {
    PlotContent content = small_wood().content();
    content.species = {"amanita_muscaria", "boletus_edulis", "no_such_fungus"};
    EXPECT_THROW(static_cast<void>(made_of(content)), InvalidInput);
    content.species.pop_back();
    EXPECT_THROW(static_cast<void>(made_of(content)), InvalidInput);
}

}  // namespace
}  // namespace sporeprint::grow_plot_bodies_test
