#include "core/geometry/weathering.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/geometry/budget.h"
#include "core/geometry/damage_cuts.h"
#include "core/geometry/hymenium.h"
#include "core/geometry/sweep.h"
#include "core/grow/mushroom.h"
#include "core/individual/damage.h"
#include "core/individual/proportion.h"
#include "core/math/elementary.h"
#include "core/math/random.h"
#include "core/mesh/detail.h"
#include "tests/support/meshes.h"
#include "tests/support/orders.h"
#include "tests/support/surfaces.h"

namespace sporeprint::geometry_weathering_test {
namespace {

using Amount = std::optional<double> WeatheringOf<Maybe>::*;
struct Effect {
    const char* name;
    Amount amount;
};
using W = WeatheringOf<Maybe>;
constexpr std::array<Effect, 8> shaping = {{{"bites", &W::bites},
                                            {"splits", &W::splits},
                                            {"peel", &W::peel},
                                            {"creases", &W::creases},
                                            {"bumps", &W::bumps},
                                            {"deliquescence", &W::deliquescence},
                                            {"dew", &W::dew},
                                            {"cracks", &W::cracks}}};

/// Species and levels of detail to iterate over: every species at one level, the first few at all
/// levels.
struct Stop {
    std::string id;
    int lod;
};
std::vector<Stop> walk(std::size_t thorough) {
    std::vector<Stop> stops;
    const std::vector<std::string> ids = swept_ids();
    for (std::size_t i = 0; i < ids.size(); ++i)
        for (int lod = 0; lod < 4; ++lod)
            if (i < thorough || static_cast<int>(i % 4) == lod) stops.push_back({ids[i], lod});
    return stops;
}

bool can(const std::string& id, const Effect& effect) {
    MushroomSpec order = order_of(id);
    order.params.weathering.*effect.amount = 1.0;
    return refusal([&] { static_cast<void>(resolve(order, atlas())); }).empty();
}

bool same(const Mesh& a, const Mesh& b) {
    return a.positions == b.positions && a.normals == b.normals && a.indices == b.indices &&
           a.texture_coordinates == b.texture_coordinates && a.tangents == b.tangents;
}

TEST(Weathering, AmountZeroIsTheUndamagedMeshBitForBit) {
    for (const auto& [id, lod] : walk(4)) {
        const MushroomSpec clean = textured(order_of(id, 0.5, 3, lod));
        const Mesh expected = mesh_of(clean);
        const Individual individual = resolve(clean, atlas());
        for (const Effect& effect : shaping) {
            if (!can(id, effect) || individual.effective.weathering.*effect.amount != 0.0) continue;
            MushroomSpec none = clean;
            none.params.weathering.*effect.amount = 0.0;
            EXPECT_TRUE(same(mesh_of(none), expected)) << id << ' ' << effect.name;
        }
    }
}

TEST(Weathering, EachEffectAloneIsClosedAndAtMostDoublesTheTriangles) {
    for (const auto& [id, lod] : walk(3)) {
        const MushroomSpec clean = textured(order_of(id, 0.6, 5, lod));
        const std::size_t triangles = mesh_of(clean).triangles();
        for (const Effect& effect : shaping) {
            if (!can(id, effect)) continue;
            for (const double amount : {0.002, 1.0}) {
                MushroomSpec worn = clean;
                worn.params.weathering.*effect.amount = amount;
                const Mesh mesh = mesh_of(worn);
                SCOPED_TRACE(id + ' ' + effect.name + ' ' + std::to_string(amount) + " lod " +
                             std::to_string(lod));
                expect_valid(mesh);
                EXPECT_LE(mesh.triangles(), 2 * triangles);
                EXPECT_GT(volume(mesh), 0.0);
                const Estimate estimated = estimate(worn, resolve(worn, atlas()));
                EXPECT_EQ(mesh.positions.size(), estimated.vertices);
                EXPECT_LE(mesh.triangles(), estimated.triangles);
            }
        }
    }
}

TEST(Weathering, AmountZeroOfAnyKindHasTheUndamagedGeometryAndImages) {
    // The names in a file tell requests apart, so the chunk of JSON before the rest may differ.
    const auto file_of = [](const MushroomSpec& order) {
        const Body body = grow_mushroom(order, atlas()).glb;
        Bytes file;
        for (const Slice& slice : std::span(body).subspan(1))
            file.insert(file.end(), slice.data(), slice.data() + slice.size);
        return file;
    };
    for (const std::string id : {"amanita_muscaria", "coprinus_comatus", "russula_vinosa"}) {
        const MushroomSpec clean = painted(order_of(id, 0.5, 3, 1));
        const Bytes expected = file_of(clean);
        W::fields([&](auto amount, const Info& info) {
            if (resolve(clean, atlas()).effective.weathering.*amount != 0.0) return;
            MushroomSpec none = clean;
            none.params.weathering.*amount = 0.0;
            EXPECT_EQ(file_of(none), expected) << id << ' ' << info.name;
            none.params.weathering.*amount = 1.0;
            const bool is_look = std::string(info.name) == "wetness";  // of the material alone
            EXPECT_TRUE(is_look || file_of(none) != expected) << id << ' ' << info.name;
        });
    }
}

RC_GTEST_PROP(WeatheringProperty, AnyCombinationOfAnyMixIsAClosedMesh, ()) {
    const std::vector<std::string> ids = swept_ids();
    const auto pick = [&] {
        return ids[static_cast<std::size_t>(
            *rc::gen::inRange<int>(0, static_cast<int>(ids.size())))];
    };
    const std::string first = pick(), second = pick();
    Mix mix = {{first, 1000}};
    if (first != second) {
        const int weight = *rc::gen::inRange(1, 1000);
        mix = {{first, weight}, {second, 1000 - weight}};
        std::sort(mix.begin(), mix.end(),
                  [](const MixPart& a, const MixPart& b) { return a.id < b.id; });
    }
    MushroomSpec order =
        textured(mix_of(mix, *rc::gen::inRange(0, 65) / 64.0, *rc::gen::arbitrary<std::uint32_t>(),
                        *rc::gen::inRange(0, 4)));
    const Individual bare = resolve(order, atlas());
    for (const Effect& effect : shaping)
        if (bare.effective.weathering.*effect.amount && *rc::gen::inRange(0, 3) > 0)
            order.params.weathering.*effect.amount = *rc::gen::inRange(0, 101) / 100.0;
    if (bare.effective.weathering.waves && *rc::gen::arbitrary<bool>())
        order.params.weathering.waves = 1.0;
    const Individual individual = resolve(order, atlas());
    const Mesh mesh = mushroom_mesh(order, individual);
    const std::vector<std::string> found = defects(mesh);
    if (!found.empty()) RC_FAIL(found.front());
    RC_ASSERT(volume(mesh) > 0.0);
    RC_ASSERT(mesh.positions.size() == estimate(order, individual).vertices);
}

TEST(Weathering, AmountsMoveVerticesContinuously) {
    for (const std::string id : {"amanita_muscaria", "boletus_edulis", "coprinus_comatus"})
        for (const Effect& effect : shaping) {
            if (!can(id, effect)) continue;
            std::optional<Mesh> before;
            double most = 0.0, size = 0.0;
            for (int i = 1; i <= 256; i += i % 64 == 1 ? 1 : 63) {
                MushroomSpec order = order_of(id, 0.6, 11);
                order.params.weathering.*effect.amount = i / 256.0;
                order.params.animation = Animation::growth;  // keeps triangles of absent parts
                const Mesh mesh = mesh_of(order);
                if (before && i % 64 == 2) {
                    ASSERT_EQ(mesh.positions.size(), before->positions.size());
                    EXPECT_EQ(mesh.indices, before->indices) << id << ' ' << effect.name;
                    for (std::size_t k = 0; k < mesh.positions.size(); ++k)
                        most = std::max<double>(
                            most, glm::distance(mesh.positions[k], before->positions[k]));
                    const Bounds box = bounds(mesh);
                    size = glm::distance(box.min, box.max);
                }
                before = mesh;
            }
            EXPECT_LT(most, 0.01 * size) << id << ' ' << effect.name;
        }
}

TEST(Weathering, ABiteRemovesItsDepthFromCapAndLowerFace) {
    MushroomSpec order = order_of("amanita_muscaria", 0.6, 4);
    order.params.weathering.bites = 1.0;
    order.params.weathering.splits = 0.0;
    const Individual individual = resolve(order, atlas());
    const MarginCuts cuts(individual, 0);
    const double radius = greatest_radius(individual.outline.cap);
    for (const Notch& bite : bites(damage_seed(4, stream_of("amanita_muscaria")))) {
        EXPECT_NEAR(cuts.depth(bite.theta), bite.depth * radius, 1e-9 + 0.2 * radius * bite.depth);
        EXPECT_LT(cuts.cap(1.0, bite.theta), 1.0);
        EXPECT_LT(cuts.lower(1.0, bite.theta), 1.0);
        const double lower = 1.0 - cuts.lower_end(bite.theta), cap = 1.0 - cuts.cap_end(bite.theta);
        EXPECT_NEAR(
            lower * individual.outline.hymenium.length() / (cap * individual.outline.cap.length()),
            1.0 + bite.undercut, 1e-6)
            << "gills and flesh are not eaten alike";
        EXPECT_EQ(cuts.cap(0.1, bite.theta), 0.1) << "the middle stays";
        // Places keep their order along the meridian.
        double last = -1.0;
        for (double share = 0.0; share <= 1.0; share += 0.01) {
            EXPECT_GT(cuts.lower(share, bite.theta), last);
            last = cuts.lower(share, bite.theta);
        }
    }
}

// The species of a mix share the vertices that one alone has, and each is bitten and torn where it is
// alone.
TEST(Weathering, CutsOfAMixAreThoseOfEachOfItsSpeciesAlone) {
    MushroomSpec order = order_of("amanita_muscaria", 0.8, 3);
    order.params.weathering.splits = 1.0;
    order.params.weathering.bites = 1.0;
    const auto cuts_of = [&](const Mix& mix) {
        order.mix = mix;
        return MarginCuts(resolve(order, atlas()), 0);
    };
    const auto seed_of = [](const char* id) { return damage_seed(3, stream_of(id)); };
    const MarginCuts one = cuts_of({{"amanita_muscaria"}}), other = cuts_of({{"russula_emetica"}}),
                     both = cuts_of({{"amanita_muscaria", 500}, {"russula_emetica", 500}});
    const Notch here = splits(seed_of("amanita_muscaria")).front(),
                there = splits(seed_of("russula_emetica")).front();
    EXPECT_GT(std::abs(turn_between(here.theta, there.theta)), here.half_width + there.half_width)
        << "the same seed tears another species elsewhere";
    EXPECT_GT(one.depth(here.theta), 0.0);
    EXPECT_GT(other.depth(there.theta), 0.0);
    EXPECT_GT(both.depth(here.theta), 0.0);
    EXPECT_GT(both.depth(there.theta), 0.0);
    EXPECT_LE(both.inserted_columns().size(), one.inserted_columns().size() + 8);
}

TEST(Weathering, SpeciesOfAMixShareTheCutsOfALevel) {
    std::vector<MarginDamage> all(3);
    all[0].can_split = all[2].can_split = true;
    std::vector<std::size_t> counts;
    for (std::size_t k = 0; k < all.size(); ++k)
        counts.push_back(own_share(7, all, k, &MarginDamage::can_split));
    EXPECT_EQ(counts, (std::vector<std::size_t>{4, 0, 3}));
    EXPECT_EQ(own_share(1, all, 2, &MarginDamage::can_split), 0U);
}

TEST(Weathering, AllEvenColumnsExistAndMoreWhereACutNeedsThem) {
    // Positions are in turns. A tear beside a bite keeps all of its columns, however close,
    // otherwise it would not show.
    constexpr double apart = 0.0002;
    for (std::uint32_t seed = 0; seed < 30; ++seed)
        for (int lod = 0; lod < 4; ++lod) {
            MushroomSpec order = order_of("boletus_edulis", 0.6, seed, lod);
            order.params.weathering.bites = 0.5;
            order.params.weathering.splits = 0.5;
            const MarginCuts cuts(resolve(order, atlas()), lod);
            const std::vector<double>& turns = cuts.turns();
            EXPECT_EQ(turns.front(), 0.0);
            for (std::size_t i = 1; i < turns.size(); ++i)
                EXPECT_GT(turns[i] - turns[i - 1], apart);
            EXPECT_LT(turns.back(), 1.0 - apart);
            const int even = detail_of(lod).columns;
            for (int j = 0; j < even; ++j)
                EXPECT_TRUE(
                    std::binary_search(turns.begin(), turns.end(), static_cast<double>(j) / even))
                    << j;
            EXPECT_EQ(turns.size(),
                      static_cast<std::size_t>(even) + cuts.inserted_columns().size());
            EXPECT_LE(turns.size(), static_cast<std::size_t>(even) * 2);
            if (lod == 3) {
                EXPECT_TRUE(cuts.inserted_columns().empty());
            }
            for (const MarginCuts::InsertedColumn& column : cuts.inserted_columns()) {
                double sum = 0.0;
                for (const MarginCuts::Chord& chord : cuts.chords(column)) {
                    const double left = turns[chord.left],
                                 right = chord.right == turns.size() ? 1.0 : turns[chord.right];
                    EXPECT_NEAR(turns[column.column], left + chord.share * (right - left), 1e-12);
                    EXPECT_LE(right - left, 1.0 / even + 1e-12);
                    sum += chord.weight;
                }
                EXPECT_NEAR(sum, 1.0, 1e-12);
            }
        }
}

TEST(Weathering, ColumnsOfClosedCutsLieOnTheSurfaceWithoutThem) {
    for (const auto& [id, lod] : walk(3)) {
        if (lod == 3) continue;
        MushroomSpec order = textured(order_of(id, 0.8, 7, lod));
        // Open cuts keep their columns; the surface between them is that of the even ones.
        order.params.weathering.bites = 0.0;
        if (can(id, shaping[1])) order.params.weathering.splits = 0.0;
        Individual individual = resolve(order, atlas());
        if (individual.outline.hymenium.empty()) continue;
        individual.azimuth.base = 0.0;  // it would bend the chords
        const auto allow = [&individual](bool cut) {
            individual.damage.bites = individual.damage.splits = cut;
            for (MarginDamage& species : individual.damage.margins)
                species.can_bite = species.can_split = cut;
        };
        allow(false);
        const Mesh clean = mushroom_mesh(order, individual);
        const Budget offered = budget_of(individual, lod);
        allow(true);
        const Mesh worn = mushroom_mesh(order, individual);
        SCOPED_TRACE(id + " lod " + std::to_string(lod));
        expect_valid(worn);
        EXPECT_GT(worn.positions.size(), clean.positions.size());
        const Bounds box = bounds(clean);
        const MarginCuts cuts(individual, lod);
        const Detail& detail = detail_of(lod);
        const std::size_t row = cuts.turns().size() + 1;
        const auto rings =
            static_cast<std::size_t>(detail.stem_rings + detail.hymenium_rings +
                                     flesh_rings(individual, lod) + detail.cap_rings);
        for (std::size_t i = 0; i < rings; ++i)
            for (const MarginCuts::InsertedColumn& column : cuts.inserted_columns()) {
                ASSERT_EQ(column.open, 0.0);
                ASSERT_EQ(cuts.chords(column).size(), 1U);
                const MarginCuts::Chord& chord = cuts.chords(column).front();
                const glm::dvec3 left(worn.positions[i * row + chord.left]),
                    right(worn.positions[i * row + chord.right]);
                EXPECT_LT(glm::distance(
                              glm::dvec3(worn.positions[i * row + column.column]),
                              left + MarginCuts::collapsed_width * chord.share * (right - left)),
                          1e-6 * glm::distance(box.min, box.max));
            }
        // Between rings a twisted quad is two triangles in one mesh and more in the other, which
        // matters more at coarse levels.
        // Rings and gills have fewer columns where those of cuts leave fewer triangles to them.
        const Budget left = budget_of(individual, lod);
        if (lod == 0 && left.ornaments.surplus == offered.ornaments.surplus &&
            left.blades.segments == offered.blades.segments) {
            EXPECT_LT(hausdorff(clean, worn), 0.001 * glm::distance(box.min, box.max));
        }
        EXPECT_NEAR(area(worn) / area(clean), 1.0, 0.005);
        EXPECT_NEAR(volume(worn) / volume(clean), 1.0, 0.005);
    }
}

TEST(Weathering, AnyDamageKeepsTheTriangleLimitOfItsLevel) {
    constexpr std::array<std::size_t, 4> most = {60000, 6000, 1200, 256};
    for (const std::string& id : swept_ids())
        for (int lod = 0; lod < 4; ++lod) {
            MushroomSpec order = order_of(id, 0.8, 2, lod);
            for (const Effect& effect : shaping)
                if (can(id, effect)) order.params.weathering.*effect.amount = 1.0;
            EXPECT_LE(mesh_of(order).triangles(), most[static_cast<std::size_t>(lod)])
                << id << " lod " << lod;
        }
}

TEST(Weathering, AClipHasOneTopologyAtEveryAge) {
    for (const std::string& id : swept_ids()) {
        const auto mesh_at = [&](double age) { return mesh_of(growing(order_of(id, age, 2))); };
        const Mesh young = mesh_at(0.0), old = mesh_at(1.0);
        EXPECT_EQ(young.indices, old.indices) << id;
        EXPECT_EQ(young.positions.size(), old.positions.size()) << id;
    }
}

TEST(Weathering, ImpossibleDamageIsRefusedByName) {
    const auto refused = [](const std::string& id, Amount amount) {
        MushroomSpec order = order_of(id);
        order.params.weathering.*amount = 0.5;
        return refusal([&] { static_cast<void>(resolve(order, atlas())); });
    };
    EXPECT_TRUE(names(refused("boletus_edulis", &W::deliquescence), "/weathering/deliquescence",
                      "no inkcap"));
    EXPECT_TRUE(names(refused("clavariadelphus_pistillaris", &W::splits), "/weathering/splits",
                      "no margin"));
    EXPECT_TRUE(
        names(refused("clavariadelphus_pistillaris", &W::peel), "/weathering/peel", "no margin"));
    EXPECT_TRUE(refused("coprinus_comatus", &W::deliquescence).empty());
    EXPECT_TRUE(refused("russula_vinosa", &W::peel).empty());
}

}  // namespace
}  // namespace sporeprint::geometry_weathering_test
