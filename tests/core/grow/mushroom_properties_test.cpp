// Properties of whole mushrooms: no species, age, seed or mix shows an artefact.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <ostream>
#include <string>
#include <vector>

#include "core/grow/mushroom.h"
#include "core/mesh/measure.h"
#include "core/render/render.h"
#include "core/surface/charts.h"
#include "tests/support/effort.h"
#include "tests/support/intrusion.h"
#include "tests/support/meshes.h"
#include "tests/support/orders.h"
#include "tests/support/triangle_grid.h"

namespace sporeprint::grow_mushroom_properties_test {
namespace {

/// The parts of a mushroom that hold its flesh, and the solids that stand out of its lower face.
struct Anatomy {
    Mesh body;      ///< the closed solid of cap, lower face and stem, with its torn flesh
    Mesh above;     ///< the triangles of the cap's skin
    Mesh below;     ///< all others of the body
    Mesh lamellae;  ///< gills, ridges, spines and tubes
};

Part part_of(const Mesh& mesh, std::size_t triangle) {
    glm::vec2 middle(0.0F);
    for (std::size_t k = 0; k < 3; ++k)
        middle += mesh.texture_coordinates[mesh.indices[3 * triangle + k]] / 3.0F;
    return part_at(middle.x, middle.y);
}

Anatomy anatomy_of(const Mesh& whole) {
    Anatomy found;
    for (const Mesh& piece : pieces(whole)) {
        if (part_of(piece, 0) == Part::blade)
            append(found.lamellae, piece);
        else if (piece.triangles() > found.body.triangles())
            found.body = piece;
    }
    found.above = found.below = found.body;
    found.above.indices.clear();
    found.below.indices.clear();
    for (std::size_t t = 0; t < found.body.triangles(); ++t) {
        Mesh& side = part_of(found.body, t) == Part::cap ? found.above : found.below;
        const auto from = found.body.indices.begin() + static_cast<std::ptrdiff_t>(3 * t);
        side.indices.insert(side.indices.end(), from, from + 3);
    }
    return found;
}

/// A vertex that stands out of the skin of the cap.
struct Escape {
    double distance = 0.0;  ///< from the skin, metres
    glm::vec3 place{0.0F};
};

std::ostream& operator<<(std::ostream& out, const Escape& escape) {
    return out << "at (" << escape.place.x << ", " << escape.place.y << ", " << escape.place.z
               << ") m";
}

/// Returns how far the solids of the lower face stand out of the skin of the cap: the
/// vertex outside the body that is farthest from the skin, of those that are nearer to it than
/// to the lower face by more than `slack`. What stands out farther than `reach` is not looked at:
/// on its way there it has passed the skin.
Escape escape(const Anatomy& anatomy, double slack, double reach) {
    if (anatomy.lamellae.indices.empty() || anatomy.above.indices.empty() ||
        anatomy.below.indices.empty())
        return {};
    const Solid solid(anatomy.body);
    TriangleGrid above(anatomy.above), below(anatomy.below);
    Escape worst;
    for (const glm::vec3& vertex : anatomy.lamellae.positions) {
        const glm::dvec3 p(vertex);
        const double over = std::sqrt(above.squared_distance(p, 0.0, reach));
        if (over <= worst.distance || over > reach || solid.contains(p)) continue;
        const double within = over + slack;
        if (below.squared_distance(p, within * within, within) > within * within)
            worst = {over, vertex};
    }
    return worst;
}

/// Returns true for species whose spines grow on the skin of the cap as well.
bool has_spines(const std::string& id) {
    return atlas().find(id)->species.stages.front().model.spines.count > 0;
}

class Lamellae : public ::testing::TestWithParam<std::string> {};

/// Returns the species of swept outlines that have no such spines.
std::vector<std::string> without_spines() {
    std::vector<std::string> ids = swept_ids();
    ids.erase(std::remove_if(ids.begin(), ids.end(), has_spines), ids.end());
    return ids;
}

INSTANTIATE_TEST_SUITE_P(Atlas, Lamellae, ::testing::ValuesIn(without_spines()),
                         [](const auto& one) { return one.param; });

TEST_P(Lamellae, NeverStandOutOfTheSkinOfTheCap) {
    constexpr std::array ages = {0.05, 0.3, 0.6, 0.8, 1.0};
    const std::size_t draws = effort(20, 2, 8 * ages.size());
    for (std::size_t i = 0; i < draws; ++i) {
        const double age = ages[i % ages.size()];
        const auto seed = static_cast<std::uint32_t>(1 + i / ages.size() + i % ages.size());
        const Mesh whole = mesh_of(textured(order_of(GetParam(), age, seed)));
        const double size = diagonal(bounds(whole));
        const Escape worst = escape(anatomy_of(whole), 0.002 * size, 0.02 * size);
        EXPECT_LT(worst.distance, 0.001 * size)
            << worst << " of a size of " << size << " m, age " << age << ", seed " << seed;
    }
}

TEST(LamellaeOfMixes, NeverStandOutOfTheSkinOfTheCap) {
    const std::vector<std::string> ids = without_spines();
    const std::size_t draws = effort(100, 4);
    for (std::size_t i = 0; i < draws; ++i) {
        const std::string& one = ids[(7 * i) % ids.size()];
        const std::string& other = ids[(11 * i + 5) % ids.size()];
        if (one == other) continue;
        const int weight = static_cast<int>(100 + 97 * i % 800);
        const double age = 0.1 + 0.9 * static_cast<double>(37 * i % 100) / 100.0;
        const MushroomSpec spec =
            mix_of({{one, weight}, {other, 1000 - weight}}, age, static_cast<std::uint32_t>(i % 8));
        Mesh whole;
        try {
            whole = mesh_of(textured(spec));
        } catch (const Impossible&) {
            continue;  // two families
        }
        const double size = diagonal(bounds(whole));
        const Escape worst = escape(anatomy_of(whole), 0.002 * size, 0.02 * size);
        EXPECT_LT(worst.distance, 0.001 * size)
            << worst << " of a size of " << size << " m, " << one << ' ' << weight << " with "
            << other << ", age " << age << ", seed " << i % 8;
    }
}

/// Returns the luminance of a pixel over mid-grey, 0..255.
double luminance(const RgbaImage& image, int x, int y) {
    const std::uint8_t* p = &image.rgba.at(static_cast<std::size_t>(y * image.width + x) * 4);
    const double light = 0.299 * p[0] + 0.587 * p[1] + 0.114 * p[2];
    return 128.0 + (light - 128.0) * p[3] / 255.0;
}

/// Returns true if a picture of a multiple of the size shows a luminance at the place of a pixel or
/// beside it.
bool shown(const RgbaImage& larger, int times, int x, int y, double light, double tolerance) {
    for (int v = times * y - 1; v <= times * (y + 1); ++v)
        for (int u = times * x - 1; u <= times * (x + 1); ++u)
            if (std::abs(luminance(larger, u, v) - light) < tolerance) return true;
    return false;
}

/// Returns the pixels that are brighter or darker than all eight neighbours by a quarter of the
/// range, and that no picture of two and four times the size shows there: light through cracks
/// between triangles and normals gone astray, not the tip of a spine.
std::vector<std::array<int, 2>> specks(const std::array<RgbaImage, 3>& images) {
    constexpr double stark = 64.0;
    const RgbaImage& image = images[0];
    std::vector<std::array<int, 2>> found;
    for (int y = 1; y + 1 < image.height; ++y)
        for (int x = 1; x + 1 < image.width; ++x) {
            const double here = luminance(image, x, y);
            double least = 255.0, most = -255.0;
            for (int k = 0; k < 9; ++k) {
                if (k == 4) continue;
                const double apart = here - luminance(image, x + k % 3 - 1, y + k / 3 - 1);
                least = std::min(least, apart);
                most = std::max(most, apart);
            }
            if (least < stark && most > -stark) continue;
            if (!shown(images[1], 2, x, y, here, stark / 2.0) &&
                !shown(images[2], 4, x, y, here, stark / 2.0))
                found.push_back({x, y});
        }
    return found;
}

TEST(Pictures, HaveNoSpecks) {
    const std::vector<std::string> ids = species_ids();
    constexpr std::array views = {View::three_quarter, View::front, View::top, View::below};
    const std::size_t draws = effort(40, 2);
    for (std::size_t i = 0; i < draws; ++i) {
        MushroomSpec spec = painted(order_of(ids[(7 * i + i / ids.size()) % ids.size()]), 512);
        spec.params.age = 0.1 + 0.9 * static_cast<double>(37 * i % 100) / 100.0;
        spec.params.seed = static_cast<std::uint32_t>(i);
        PictureParams params;
        params.view = views[i % views.size()];
        params.turn_deg = static_cast<double>(73 * i % 360) - 180.0;
        std::array<RgbaImage, 3> images;
        Extras extras;
        extras.write = [&](const GlbScene& scene, const Parallel&) -> Body {
            for (std::size_t k = 0; k < images.size(); ++k) {
                params.width = params.height = 256 << k;
                images[k] = rendered(scene, params);
            }
            return {};
        };
        (void)grow_mushroom(spec, *built_in_atlas(), extras);
        for (const auto& [x, y] : specks(images))
            ADD_FAILURE() << spec.mix[0].id << ", age " << spec.params.age << ", seed " << i << ", "
                          << name(params.view) << " turned by " << params.turn_deg
                          << " deg: a speck at (" << x << ", " << y << ") of 256 pixels";
    }
}

}  // namespace
}  // namespace sporeprint::grow_mushroom_properties_test
