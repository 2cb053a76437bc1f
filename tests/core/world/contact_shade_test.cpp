#include "core/world/contact_shade.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sporeprint::world_contact_shade_test {
namespace {

constexpr int side = 101;
constexpr WorldBox square{10.0, 20.0, 12.0, 22.0};

RawImages grey(int of_side = side) {
    RawImages images;
    images.side = of_side;
    for (Bytes& rgb : images.rgb)
        rgb.assign(3 * static_cast<std::size_t>(of_side) * static_cast<std::size_t>(of_side), 200);
    return images;
}

std::uint8_t occlusion(const RawImages& images, int column, int row) {
    return images
        .rgb[2][3 * (static_cast<std::size_t>(row) * side + static_cast<std::size_t>(column))];
}

TEST(ContactShade, WithoutContactsChangesNothing) {
    RawImages images = grey();
    add_contact_shade(images, square, {});
    const std::vector<Contact> beyond{{{13.0, 21.0}, {13.0, 21.0}, 0.2}};
    add_contact_shade(images, square, beyond);
    EXPECT_EQ(images.rgb, grey().rgb);
}

TEST(ContactShade, OfAFootIsRoundDarkestAtTheTrunkAndEndsAtItsReach) {
    RawImages images = grey();
    const double radius = 0.2;
    add_contact_shade(images, square, std::vector<Contact>{{{11.0, 21.0}, {11.0, 21.0}, radius}});
    std::uint8_t last = 0;
    for (int column = 50; column < side; ++column) {
        const double away = 0.02 * (column - 50);
        const std::uint8_t here = occlusion(images, column, 50);
        EXPECT_GE(here, last);
        EXPECT_EQ(here, occlusion(images, 100 - column, 50));
        EXPECT_EQ(here, occlusion(images, 50, column));
        if (away < contact_reach * radius - 0.03) {
            EXPECT_LT(here, 200) << away;
        } else if (away > contact_reach * radius) {
            EXPECT_EQ(here, 200) << away;
        }
        last = here;
    }
    EXPECT_LT(occlusion(images, 50, 50), 90);
    // Normals and roughness stay.
    EXPECT_EQ(images.rgb[1], grey().rgb[1]);
    for (std::size_t i = 1; i < images.rgb[2].size(); i += 3) EXPECT_EQ(images.rgb[2][i], 200);
}

TEST(ContactShade, OfALogRunsAlongIt) {
    RawImages images = grey();
    add_contact_shade(images, square, std::vector<Contact>{{{10.4, 21.5}, {13.0, 21.5}, 0.1}});
    // The first row is the northern one.
    for (int column = 25; column < side; ++column) {
        EXPECT_EQ(occlusion(images, column, 25), occlusion(images, 25, 25));
        EXPECT_EQ(occlusion(images, column, 75), 200);
    }
    EXPECT_LT(occlusion(images, 25, 25), 90);
    EXPECT_EQ(occlusion(images, 2, 25), 200);
}

TEST(ContactShade, OfSeveralTrunksIsThatOfTheNearestInAnyOrder) {
    const Contact one{{10.8, 21.0}, {10.8, 21.0}, 0.2}, other{{11.2, 21.1}, {11.2, 21.9}, 0.15};
    RawImages both = grey(), turned = grey(), first = grey(), second = grey();
    add_contact_shade(both, square, std::vector<Contact>{one, other});
    add_contact_shade(turned, square, std::vector<Contact>{other, one});
    add_contact_shade(first, square, std::vector<Contact>{one});
    add_contact_shade(second, square, std::vector<Contact>{other});
    EXPECT_EQ(both.rgb, turned.rgb);
    for (std::size_t i = 0; i < both.rgb[2].size(); ++i)
        EXPECT_EQ(both.rgb[2][i], std::min(first.rgb[2][i], second.rgb[2][i]));
}

}  // namespace
}  // namespace sporeprint::world_contact_shade_test
