// Levels of detail show the same individual: replacing one by the next is not visible.
#include "core/mesh/detail.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/grow/painting.h"
#include "tests/support/drawing.h"
#include "tests/support/effort.h"
#include "tests/support/orders.h"

namespace sporeprint::grow_detail_test {
namespace {

// Size on screen that each level of detail is made for, in pixels of its larger side.
constexpr std::array<int, 4> made_for = {512, 256, 96, 32};

constexpr std::array<ViewDirection, 4> views = {{{20, 0}, {110, 15}, {200, 40}, {290, -25}}};

struct Level {
    Mesh mesh;
    RawImages images;
};

std::vector<Level> levels_of(const std::string& id, double age, std::uint32_t seed) {
    std::vector<Level> levels;
    for (int lod = 0; lod < 4; ++lod) {
        MushroomSpec spec = textured(order_of(id, age, seed, lod));
        spec.params.texture_size.value = 512;
        const PaintSpec paint_spec = paint_spec_of(spec, atlas());
        levels.push_back({mesh_of(spec), paint_raw(paint_spec.front().painting)});
    }
    return levels;
}

ImagePlane canvas_of(const Mesh& mesh, int pixels) {
    const Bounds box = bounds(mesh);
    const glm::vec3 size = box.max - box.min;
    const double larger = std::max({size.x, size.y, size.z});
    // The canvas is larger than the mushroom, so that nothing is clipped and pixels keep their
    // size.
    const int whole = pixels + 3 * pixels / 4;
    return {0.5F * (box.min + box.max), larger * whole / pixels, whole};
}

class Detail : public ::testing::TestWithParam<std::string> {};

INSTANTIATE_TEST_SUITE_P(Atlas, Detail, ::testing::ValuesIn(species_ids()),
                         [](const auto& one) { return one.param; });

constexpr std::array<double, 4> ages = {0.6, 0.3, 0.85, 0.1};

// At the size where the coarser of two levels takes over, its silhouette differs by less than a
// pixel along its outline.
TEST_P(Detail, SilhouettesOfNeighboursAgreeWithinAPixel) {
    const double allowed =
        silhouette_tolerance(atlas().find(GetParam())->species.stages.front().model.spines);
    for (const double age : std::span(ages).first(effort(4, 1, 4))) {
        const std::vector<Level> levels = levels_of(GetParam(), age, 3);
        for (std::size_t k = 0; k + 1 < levels.size(); ++k)
            for (const ViewDirection& view : views) {
                const ImagePlane canvas = canvas_of(levels[0].mesh, made_for[k + 1]);
                const Drawing fine = drawn(levels[k].mesh, view, canvas);
                const Drawing coarse = drawn(levels[k + 1].mesh, view, canvas);
                EXPECT_LT(symmetric_difference(fine, coarse), allowed * outline_length(fine))
                    << "age " << age << ", level " << k << " and the next, from " << view.azimuth
                    << ", " << view.elevation;
            }
    }
}

// Warts and scales count as the part that they lie on, because solids at one level of detail are
// painted at the next.
TEST_P(Detail, MeanColoursOfCapAndStemAgree) {
    constexpr std::array<Part, 2> parts = {Part::cap, Part::stem};
    constexpr std::uint32_t body = 1U << static_cast<unsigned>(Part::cap) |
                                   1U << static_cast<unsigned>(Part::hymenium) |
                                   1U << static_cast<unsigned>(Part::stem);
    for (const double age : std::span(ages).first(effort(4, 1, 4))) {
        const std::vector<Level> levels = levels_of(GetParam(), age, 3);
        std::vector<std::array<MeanColour, 2>> means(levels.size());
        const bool is_netted =
            atlas().find(GetParam())->species.stages.front().model.receptacle.meshes > 0;
        for (std::size_t k = 0; k < levels.size(); ++k)
            for (const ViewDirection& view : views) {
                const ImagePlane canvas = canvas_of(levels[0].mesh, 160);
                const Drawing all = drawn(levels[k].mesh, view, canvas);
                const Drawing bare = drawn(levels[k].mesh, view, canvas, body);
                for (std::size_t i = 0; i < all.seen.size(); ++i) {
                    if (!all.seen[i] || !bare.seen[i]) continue;
                    for (std::size_t p = 0; p < parts.size(); ++p)
                        if (part_at(bare.seen[i]->place.x, bare.seen[i]->place.y) == parts[p])
                            means[k][p].add(levels[k].images, all.seen[i]->place);
                }
            }
        for (std::size_t k = 0; k + 1 < levels.size(); ++k)
            for (std::size_t p = 0; p < parts.size(); ++p) {
                // A part that is hardly visible, such as the stem of a cup, has no colour to
                // compare; of the cup under a net another part is seen through other meshes.
                if (is_netted) continue;
                if (std::min(means[k][p].count(), means[k + 1][p].count()) < 400) continue;
                EXPECT_LT(difference(means[k][p].mean(), means[k + 1][p].mean()), 3.0)
                    << "age " << age << ", level " << k << " and the next, "
                    << (p == 0 ? "cap" : "stem");
            }
    }
}

// Tests the measure itself: a disc has the outline of a circle, and a mushroom moved by three
// pixels is detected.
TEST(Drawing, MeasuresOutlinesAndSeesSteps) {
    const Mesh mesh = mesh_of(textured(order_of(species_ids().front())));
    const ImagePlane canvas = canvas_of(mesh, 96);
    Mesh moved = mesh;
    const auto step = static_cast<float>(3.0 * canvas.side / canvas.pixels);
    for (glm::vec3& position : moved.positions) position += glm::vec3(step, step, 0.0F);
    const Drawing still = drawn(mesh, views[0], canvas);
    EXPECT_EQ(symmetric_difference(still, still), 0);
    EXPECT_GT(symmetric_difference(still, drawn(moved, views[0], canvas)), outline_length(still));

    Drawing disc{101, std::vector<std::optional<Pixel>>(101UL * 101UL)};
    for (int y = 0; y < 101; ++y)
        for (int x = 0; x < 101; ++x)
            if ((x - 50) * (x - 50) + (y - 50) * (y - 50) <= 40 * 40)
                disc.seen[static_cast<std::size_t>(y * 101 + x)] = Pixel{};
    EXPECT_NEAR(outline_length(disc), 2.0 * 3.14159 * 40.0, 0.07 * 2.0 * 3.14159 * 40.0);
}

TEST(MeanColour, IsThatOfItsLight) {
    RawImages grey{1, {Bytes{119, 119, 119}, Bytes(3), Bytes(3)}, {}};
    MeanColour mean;
    mean.add(grey, {0.5F, 0.5F});
    EXPECT_NEAR(mean.mean().l, 50.0, 0.2);
    EXPECT_NEAR(mean.mean().a, 0.0, 0.1);
    EXPECT_NEAR(mean.mean().b, 0.0, 0.1);
    const RawImages red{1, {Bytes{255, 0, 0}, Bytes(3), Bytes(3)}, {}};
    MeanColour other;
    other.add(red, {0.5F, 0.5F});
    EXPECT_NEAR(other.mean().l, 53.24, 0.1);
    EXPECT_NEAR(difference(mean.mean(), other.mean()), 104.6, 0.5);
}

}  // namespace
}  // namespace sporeprint::grow_detail_test
