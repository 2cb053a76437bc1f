#include "core/grow/world/plot_places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/math/direction.h"
#include "core/math/elementary.h"
#include "core/world/tree_growth.h"
#include "tests/support/plots.h"

namespace sporeprint::grow_plot_places_test {
namespace {

/// A frame with what it refers to.
struct Framed {
    PlotContent content;
    FloorHeights floor;
    PlotFrame frame;

    explicit Framed(const PlotContent& of)
        : content(of), floor(*of.ground, of.seed, of.micro, {}), frame(of, floor) {}
};

TEST(PlotFrame, HasEastToTheRightAndNorthToTheBack) {
    const Framed on(small_wood().content(1.0, -2.0));
    const PlotFrame& frame = on.frame;
    EXPECT_EQ(frame.at(2.0, -2.0, frame.height()), glm::dvec3(1.0, 0.0, 0.0));
    EXPECT_EQ(frame.at(1.0, -1.0, frame.height()), glm::dvec3(0.0, 0.0, -1.0));
    EXPECT_NEAR(frame.height(), 0.12 * 1.0 + 0.06 * 2.0, 0.002);
    EXPECT_TRUE(frame.has(world_point(-1.0, -4.0)));
    EXPECT_FALSE(frame.has(world_point(3.0, -2.0))) << "the east side belongs to the next plot";
}

TEST(PlotFrame, HasItsOriginInTheWorld) {
    const Framed on(small_wood().content(1.0, -2.0));
    EXPECT_EQ(on.frame.at(5.0, 3.0, 9.0) + on.frame.origin(), glm::dvec3(5.0, 9.0, -3.0));
}

TEST(PlotPlaces, OfATreeScaleItsModelToItsSize) {
    const SmallWood& wood = small_wood();
    const Framed on(wood.content());
    const StandTree& tree = wood.trees.front();
    const double height = height_at(tree, on.content.time);
    const GlbTransform place = place_of(tree, on.content.time, {10.0, 2.5}, on.frame);
    EXPECT_DOUBLE_EQ(place.scale.y, height / 10.0);
    EXPECT_EQ(place.scale.x, place.scale.z);
    EXPECT_GE(place.scale.x, 0.5 * place.scale.y);
    EXPECT_LE(place.scale.x, 1.2 * place.scale.y);
    EXPECT_NEAR(glm::length(place.rotation), 1.0, 1e-12);
    const glm::dvec3 foot = on.frame.on_floor(metres(tree.at.x), metres(tree.at.y));
    EXPECT_NEAR(foot.y - place.translation.y, 0.2 * trunk_diameter(height), 1e-12);
}

TEST(PlotPlaces, OfBodiesOnALogDoNotDependOnThePlot) {
    const SmallWood& wood = small_wood();
    const Framed large(wood.content(0.0, 0.0, 32.0));
    const DeadWood& log = wood.dead.front();
    const SineCosine turn = sine_cosine(log.direction);
    FruitBody body;
    body.trunk = log.id;
    // A plot at whose border the log lies, so that only its ends cross it.
    const double beside = 0.6 * radius_at(log, large.content.time);
    const double length = length_at(log, large.content.time);
    for (double along = 0.3; along < 0.9 * length; along += 0.4) {
        const double x = metres(log.at.x) + along * turn.cosine,
                     y = metres(log.at.y) + along * turn.sine;
        body.at = point_at(x, y);
        const Framed small(wood.content(x - 2.0 * turn.cosine, y + 2.0 - beside, 4.0));
        BearingTrunks in_large(large.content, large.frame), in_small(small.content, small.frame);
        const auto whole = in_large.place(body, {0.0, 1.0, 0.0}),
                   part = in_small.place(body, {0.0, 1.0, 0.0});
        ASSERT_TRUE(whole && part) << along;
        EXPECT_LT(glm::distance(*whole + large.frame.origin(), *part + small.frame.origin()), 2e-3)
            << along;
    }
}

/// Returns a log of the small wood that has lost a share of its mass.
DeadWood log_that_lost(double share, const PlotContent& content) {
    DeadWood log = small_wood().dead.front();
    log.decay = -std::log(1.0 - share) / years_between(log.died, content.time);
    return log;
}

TEST(PlotPlaces, OfARottenLogAreOnMoreAndShorterPiecesThatAreStraight) {
    const Framed on(small_wood().content(0.0, 0.0, 32.0));
    std::size_t before = 1;
    for (const double lost : {0.1, 0.45, 0.8}) {
        const auto line = trunk_line(log_that_lost(lost, on.content), on.content, on.frame);
        ASSERT_TRUE(line);
        EXPECT_GE(line->parts.size(), before);
        before = line->parts.size();
        double last = line->from;
        for (const TrunkPart& part : line->parts) {
            EXPECT_GE(part.from, last);
            last = part.to;
            const double from = part.from, to = part.to - 1e-6;
            const glm::dvec3 middle = line->section(0.5 * (from + to)).middle;
            const glm::dvec3 mean = 0.5 * (line->section(from).middle + line->section(to).middle);
            EXPECT_LT(glm::distance(middle, mean), 1e-6) << lost << ", piece from " << from;
        }
        EXPECT_LE(last, line->to);
    }
    EXPECT_GT(before, 2U);
}

TEST(PlotPlaces, OfALogRestOnTheGroundAtTwoPlacesAndAreNowhereBelowIt) {
    const Framed on(small_wood().content(0.0, 0.0, 32.0));
    for (const double lost : {0.05, 0.3, 0.55, 0.85}) {
        const auto line = trunk_line(log_that_lost(lost, on.content), on.content, on.frame);
        ASSERT_TRUE(line);
        for (const TrunkPart& part : line->parts) {
            double left = 1e9, right = 1e9;
            constexpr int places = 400;
            for (int i = 0; i <= places; ++i) {
                const double share = static_cast<double>(i) / places;
                const TrunkSection section =
                    line->section(glm::mix(part.from, part.to - 1e-6, share));
                const glm::dvec3 at = section.middle + on.frame.origin();
                const double above = at.y - on.floor.at(at.x, -at.z);
                EXPECT_GT(above, -0.03) << "between two steps the ground may be a little higher";
                double& side = share < 0.5 ? left : right;
                side = std::min(side, above / section.radius);
            }
            EXPECT_LT(left, 1.0) << "it touches the ground on either side of its middle";
            EXPECT_LT(right, 1.0);
        }
    }
}

TEST(PlotPlaces, OfTreesWithinAPlotHaveTheirRootsOnIt) {
    const Framed on(small_wood().content());
    StandTree tree = small_wood().trees.front();
    tree.at = on.content.centre;
    EXPECT_TRUE(stands_within(tree, on.content.time, on.frame));
    const WorldBox& box = on.frame.box();
    const double radius = 0.5 * trunk_diameter(height_at(tree, on.content.time)),
                 y = 0.5 * (box.south + box.north);
    tree.at = world_point(box.east - 1.1 * radius, y);
    EXPECT_TRUE(on.frame.has(tree.at));
    EXPECT_FALSE(stands_within(tree, on.content.time, on.frame));
    tree.at = world_point(box.east - 2.0 * radius, y);
    EXPECT_TRUE(stands_within(tree, on.content.time, on.frame));
}

TEST(PlotPlaces, OfALogEndAtTheBordersOfThePlot) {
    const SmallWood& wood = small_wood();
    const Framed small(wood.content()), large(wood.content(0.0, 0.0, 32.0));
    const DeadWood& log = wood.dead.front();
    const auto part = trunk_line(log, small.content, small.frame),
               whole = trunk_line(log, large.content, large.frame);
    ASSERT_TRUE(part && whole);
    EXPECT_EQ(whole->from, 0.0);
    EXPECT_DOUBLE_EQ(whole->to, length_at(log, large.content.time));
    EXPECT_GT(part->from, 3.0);
    EXPECT_LT(part->to, 9.0);
    EXPECT_GE(part->section(part->from).middle.x, -2.0);
    EXPECT_LE(part->section(part->to).middle.x, 2.0);
}

TEST(PlotPlaces, ContactsAreFeetOnThePlotAndLogsWhereTheyTouchTheGround) {
    const Framed on(small_wood().content(0.0, 0.0, 32.0));
    const std::vector<Contact> contacts = contacts_on(on.content, on.frame, true);
    std::size_t feet = 0;
    for (const StandTree& tree : on.content.trees) {
        const glm::dvec2 at(metres(tree.at.x), metres(tree.at.y));
        const bool is_shown =
            tree.lives_at(on.content.time) && stands_within(tree, on.content.time, on.frame);
        const auto found = std::find_if(contacts.begin(), contacts.end(), [&](const Contact& one) {
            return one.from == at && one.to == at;
        });
        EXPECT_EQ(found != contacts.end(), is_shown);
        feet += is_shown ? 1 : 0;
    }
    EXPECT_GT(feet, 0U);
    EXPECT_GT(contacts.size(), feet);
    for (const Contact& one : contacts) EXPECT_LT(glm::distance(one.from, one.to), 0.5);
    EXPECT_GE(contacts_on(on.content, on.frame, false).size(), contacts.size());
}

TEST(PlotPlaces, WriteIdsInSixteenDigits) {
    EXPECT_EQ(id_text(0), "0000000000000000");
    EXPECT_EQ(id_text(0x0123456789abcdefULL), "0123456789abcdef");
}

}  // namespace
}  // namespace sporeprint::grow_plot_places_test
