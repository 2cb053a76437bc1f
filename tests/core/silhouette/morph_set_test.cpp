#include "core/silhouette/morph_set.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <string>
#include <string_view>

#include "core/math/random.h"
#include "core/mesh/detail.h"
#include "core/silhouette/weights.h"
#include "tests/support/mixes.h"

namespace sporeprint::silhouette_morph_set_test {
namespace {

double greatest(const Silhouette& s) {
    double most = 0.0;
    for (const auto* part : {&s.stem, &s.hymenium, &s.cap})
        for (const OutlinePoint& p : *part) most = std::max({most, p.r, p.y - s.stem.front().y});
    return most;
}

/// Returns the control shapes of one species, of about unit size when mature.
std::vector<ControlShape> shapes_of(const AtlasEntry& entry, std::size_t species_index) {
    std::vector<ControlShape> shapes;
    double size = 1.0;
    for (const Stage& stage : entry.species.stages)
        if (stage.age == 0.6) size = greatest(silhouette_of(stage.model));
    for (const Stage& stage : entry.species.stages)
        shapes.push_back({silhouette_of(stage.model), size, species_index, stage.age});
    return shapes;
}

/// Returns the index of a species in the atlas.
std::size_t place_of(std::string_view id) {
    std::size_t place = 0;
    while (swept_atlas().entries().at(place).species.id.view() != id) ++place;
    return place;
}

const std::size_t fly_agaric = place_of("amanita_muscaria"), cep = place_of("boletus_edulis"),
                  chanterelle = place_of("cantharellus_cibarius"),
                  club = place_of("clavariadelphus_pistillaris"),
                  ink_cap = place_of("coprinus_comatus"), cup = place_of("disciotis_venosa"),
                  bonnet = place_of("mycena_sanguinolenta"),
                  brittlegill = place_of("russula_vinosa");

/// Returns pairs of indices in the atlas, at most `most`.
std::vector<std::array<std::size_t, 2>> some_pairs(std::size_t most) {
    std::vector<std::array<std::size_t, 2>> pairs;
    for (const auto& [a, b] : some_species_pairs(most)) pairs.push_back({place_of(a), place_of(b)});
    return pairs;
}

MorphSet set_of(std::initializer_list<std::size_t> species, std::span<const Arc> arcs = {},
                double arcs_age = 0.6) {
    std::vector<ControlShape> shapes;
    std::size_t species_index = 0;
    for (const std::size_t s : species) {
        const auto own = shapes_of(swept_atlas().entries()[s], species_index++);
        shapes.insert(shapes.end(), own.begin(), own.end());
    }
    return MorphSet(std::move(shapes), arcs, arcs_age);
}

std::vector<double> only(const MorphSet& set, std::size_t shape) {
    std::vector<double> weights(set.size(), 0.0);
    weights[shape] = 1.0;
    return weights;
}

/// Returns the growth weights at an age times the weight of each species.
std::vector<double> mix_of(const MorphSet& set, const std::vector<std::size_t>& indices,
                           const std::vector<double>& shares, double age) {
    std::vector<double> weights = set.growth_weights(age);
    for (std::size_t s = 0; s < weights.size(); ++s) weights[s] *= shares[indices[s]];
    return weights;
}

std::vector<std::size_t> indices_of(std::initializer_list<std::size_t> species) {
    std::vector<std::size_t> indices;
    std::size_t species_index = 0;
    for (const std::size_t s : species)
        indices.insert(indices.end(), swept_atlas().entries()[s].species.stages.size(),
                       species_index++);
    return indices;
}

double distance(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
    const glm::dvec2 along = b - a;
    const double square = glm::dot(along, along);
    const double t = square > 0.0 ? std::clamp(glm::dot(p - a, along) / square, 0.0, 1.0) : 0.0;
    return glm::distance(p, a + t * along);
}

/// Returns the greatest distance of a point of one polyline from the other.
double deviation(const Polyline& from, const Polyline& to) {
    double worst = 0.0;
    for (std::size_t i = 0; i + 1 < from.size(); ++i)
        for (const double t : {0.0, 0.25, 0.5, 0.75}) {
            const glm::dvec2 p = from[i] + t * (from[i + 1] - from[i]);
            double nearest = 1e9;
            for (std::size_t j = 0; j + 1 < to.size(); ++j)
                nearest = std::min(nearest, distance(p, to[j], to[j + 1]));
            worst = std::max(worst, nearest);
        }
    return worst;
}

double hausdorff(const Polyline& a, const Polyline& b) {
    return std::max(deviation(a, b), deviation(b, a));
}

double diagonal(const Polyline& line) {
    glm::dvec2 low = line.front(), high = line.front();
    for (const glm::dvec2& p : line) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    return std::hypot(2.0 * high.x, high.y - low.y);
}

::testing::AssertionResult is_simple(const Outline& outline) {
    for (int lod = 0; lod < 4; ++lod) {
        const Polyline line = polyline(outline, lod);
        for (std::size_t i = 1; i + 1 < line.size(); ++i)
            if (!(line[i].x > 0.0))
                return ::testing::AssertionFailure() << "r = " << line[i].x << ", LOD " << lod;
        if (line.front().x != 0.0 || line.back().x != 0.0)
            return ::testing::AssertionFailure() << "off the axis";
        Polyline distinct = line;  // a missing hymenium is a point, not a crossing
        distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
        if (const auto pair = first_crossing(distinct))
            return ::testing::AssertionFailure()
                   << "segments " << (*pair)[0] << " and " << (*pair)[1] << ", LOD " << lod;
    }
    return ::testing::AssertionSuccess();
}

TEST(MorphSet, EndpointsAreTheControlShapes) {
    for (const AtlasEntry& entry : swept_atlas().entries()) {
        const auto shapes = shapes_of(entry, 0);
        const MorphSet set(shapes);
        for (std::size_t s = 0; s < shapes.size(); ++s) {
            const Outline outline(set.nodes(only(set, s)));
            const Outline own(shapes[s].silhouette);
            for (const CurveName curve : curve_names) {
                const auto truth = own.of(curve).empty() ? std::vector<OutlineSample>{}
                                                         : own.of(curve).sampled(4000);
                double worst = 0.0;
                for (const OutlineSample& ring : outline.rings(curve, 0)) {
                    double nearest = 1.0;
                    for (const OutlineSample& p : truth)
                        nearest = std::min(nearest, std::hypot(ring.r * shapes[s].size - p.r,
                                                               ring.y * shapes[s].size - p.y));
                    worst = std::max(worst, nearest);
                }
                EXPECT_LT(worst, 5e-4 * greatest(shapes[s].silhouette))
                    << entry.species.id.string() << " stage " << s << ' ' << name(curve);
            }
        }
    }
}

TEST(MorphSet, CountsAndPlacesAreThoseOfTheLevelsOfDetail) {
    const MorphSet set = set_of({fly_agaric, cep});
    const Outline outline(set.nodes(only(set, 0)));
    for (int lod = 0; lod < 4; ++lod) {
        const Detail& detail = detail_of(lod);
        EXPECT_EQ(outline.rings(CurveName::stem, lod).size(),
                  static_cast<std::size_t>(detail.stem_rings));
        EXPECT_EQ(outline.rings(CurveName::hymenium, lod).size(),
                  static_cast<std::size_t>(detail.hymenium_rings));
        EXPECT_EQ(outline.rings(CurveName::cap, lod).size(),
                  static_cast<std::size_t>(detail.cap_rings));
    }
}

TEST(MorphSet, SubCurvesMeetBitForBitAndEndOnTheAxis) {
    const MorphSet set = set_of({fly_agaric, chanterelle, club, cup});
    std::vector<double> weights(set.size(), 1.0 / static_cast<double>(set.size()));
    const Outline outline(set.nodes(weights));
    for (int lod = 0; lod < 4; ++lod) {
        const auto stem = outline.rings(CurveName::stem, lod);
        const auto hymenium = outline.rings(CurveName::hymenium, lod);
        const auto cap = outline.rings(CurveName::cap, lod);
        EXPECT_EQ(stem.front().r, 0.0);
        EXPECT_EQ(cap.back().r, 0.0);
        EXPECT_EQ(stem.back().r, hymenium.front().r);
        EXPECT_EQ(stem.back().y, hymenium.front().y);
        EXPECT_EQ(hymenium.back().r, cap.front().r);
        EXPECT_EQ(hymenium.back().y, cap.front().y);
        for (const auto& rings : {stem, hymenium, cap}) {
            EXPECT_EQ(rings.front().share, 0.0);
            EXPECT_EQ(rings.back().share, 1.0);
            for (std::size_t i = 1; i < rings.size(); ++i)
                EXPECT_GT(rings[i].share, rings[i - 1].share);
            for (const OutlineSample& ring : rings)
                EXPECT_NEAR(std::hypot(ring.tangent_r, ring.tangent_y), 1.0, 1e-12);
        }
    }
}

TEST(MorphSet, AMissingHymeniumIsAPoint) {
    const MorphSet alone = set_of({club});
    EXPECT_TRUE(alone.nodes(only(alone, 0)).hymenium.empty());
    const MorphSet mixed = set_of({fly_agaric, club});
    const Outline outline(mixed.nodes(only(mixed, mixed.size() - 1)));
    EXPECT_EQ(outline.hymenium.length(), 0.0);
    const OutlineSample end = outline.stem.at(1.0);
    for (const OutlineSample& ring : outline.rings(CurveName::hymenium, 0)) {
        EXPECT_EQ(ring.r, end.r);
        EXPECT_EQ(ring.y, end.y);
        EXPECT_EQ(ring.tangent_r, end.tangent_r);
        EXPECT_EQ(ring.tangent_y, end.tangent_y);
    }
}

TEST(MorphSet, SmoothJoinsStaySmoothInEveryMix) {
    // The margins of these are smooth in every stage.
    const MorphSet set = set_of({fly_agaric, cep, ink_cap});
    for (std::size_t other = 1; other < set.size(); ++other)
        for (const double t : {0.0, 0.3, 0.7}) {
            std::vector<double> weights(set.size(), 0.0);
            weights[0] = 1.0 - t;
            weights[other] = t;
            const OutlineNodes nodes = set.nodes(weights);
            const glm::dvec2 in = nodes.hymenium.back().velocity, out = nodes.cap.front().velocity;
            EXPECT_NEAR(glm::dot(in, out), std::sqrt(glm::dot(in, in) * glm::dot(out, out)),
                        1e-9 * glm::dot(in, in));
        }
}

TEST(MorphSet, ArcsAreReproducedAtTheirAge) {
    const std::vector<Arc> arcs{{CurveName::cap, 0.3, 0.5}, {CurveName::stem, 0.7, 0.6}};
    for (const double age : {0.0, 0.45, 0.6, 1.0}) {
        const MorphSet set = set_of({fly_agaric, cep}, arcs, age);
        for (const Arc& arc : arcs) {
            // A dense row of links between the two outlines at this age passes through the arc.
            double nearest = 1.0;
            for (const Arc& link : set.arcs(age, 2000))
                if (link.curve == arc.curve)
                    nearest =
                        std::min(nearest, std::abs(link.a - arc.a) + std::abs(link.b - arc.b));
            EXPECT_LT(nearest, 0.006) << "age " << age;
        }
    }
}

TEST(MorphSet, CrossingArcsAreRefusedAndNamed) {
    const auto refused = [](std::vector<Arc> arcs) {
        return refusal([&] { (void)set_of({fly_agaric, cep}, arcs); });
    };
    const auto crossing = refused(
        {{CurveName::cap, 0.3, 0.5}, {CurveName::stem, 0.1, 0.9}, {CurveName::cap, 0.4, 0.4}});
    ASSERT_EQ(crossing.size(), 1u);
    EXPECT_TRUE(names(crossing, "/arcs/2", "crosses arc 0"));
    EXPECT_TRUE(names(refused({{CurveName::cap, 0.3, 0.5}, {CurveName::cap, 0.3, 0.6}}), "/arcs/1",
                      "crosses arc 0"));
    EXPECT_TRUE(names(refused({{CurveName::cap, 0.0, 0.5}}), "/arcs/0", "between 0 and 1"));
    EXPECT_TRUE(names(refused({{CurveName::cap, 0.5, 1.5}}), "/arcs/0", "between 0 and 1"));
    EXPECT_TRUE(refused({{CurveName::cap, 0.5, 0.6}, {CurveName::cap, 0.5, 0.6}}).empty());
    EXPECT_TRUE(names(refusal([] { (void)set_of({fly_agaric}, std::vector<Arc>{{}}); }), "/arcs/0",
                      "exactly two"));
}

TEST(MorphSet, RingsApproximateTheOutlineWithSmallError) {
    for (const AtlasEntry& entry : swept_atlas().entries()) {
        const auto shapes = shapes_of(entry, 0);
        const MorphSet set(shapes);
        for (std::size_t s = 0; s < shapes.size(); ++s) {
            const Outline own(shapes[s].silhouette);
            Polyline truth;
            for (const CurveName curve : curve_names)
                if (!own.of(curve).empty())
                    for (const OutlineSample& p : own.of(curve).sampled(1500))
                        truth.push_back(glm::dvec2(p.r, p.y) / shapes[s].size);
            const Polyline rings = polyline(Outline(set.nodes(only(set, s))), 0);
            // One row of 72 rings serves all stages; 72 chords round a circle would have an error
            // of 0.05 %.
            EXPECT_LT(deviation(rings, truth), 1.2e-3 * diagonal(truth))
                << entry.species.id.string() << " stage " << s;
        }
    }
}

// This covers growth between any two ages; pairs of species have their own test (PairOutlines).
TEST(MorphSet, EverySpeciesIsSimpleAtEveryMomentBetweenTwoAges) {
    constexpr std::array<double, 5> ages = {0.0, 0.25, 0.5, 0.75, 1.0};
    for (std::size_t a = 0; a < swept_atlas().entries().size(); ++a) {
        const MorphSet set = set_of({a});
        for (const double from : ages)
            for (const double to : ages) {
                const Certificate known =
                    set.certificate(set.growth_weights(from), set.growth_weights(to));
                EXPECT_TRUE(known.simple) << a << " from " << from << " to " << to;
                EXPECT_EQ(known.method, ProofMethod::exact);
            }
    }
}

TEST(MorphSet, FewPairsNeedAnIndirectPathAndAllAreProven) {
    constexpr std::array<double, 3> ages = {0.0, 0.5, 1.0};
    std::size_t exact = 0, certified = 0;
    for (const auto& [a, b] : some_pairs(effort(105))) {
        const MorphSet set = set_of({a, b});
        const auto indices = indices_of({a, b});
        for (const double age_a : ages)
            for (const double age_b : ages) {
                const Certificate known = set.certificate(mix_of(set, indices, {1.0, 0.0}, age_a),
                                                          mix_of(set, indices, {0.0, 1.0}, age_b));
                EXPECT_NE(known.method, ProofMethod::checked) << a << " and " << b;
                (known.method == ProofMethod::exact ? exact : certified)++;
                EXPECT_EQ(known.method == ProofMethod::exact, known.indirect == 0.0);
            }
    }
    EXPECT_GT(exact, 4 * certified) << "detours are for closed cups and the like";
}

/// Returns the height of an outline or, where it lies flat (a cup, a star, a dry jelly, a bracket),
/// the diagonal of its bounding box.
double extent(const Polyline& line) {
    double low = line.front().y, high = low, wide = 0.0;
    for (const glm::dvec2& p : line) {
        low = std::min(low, p.y);
        high = std::max(high, p.y);
        wide = std::max(wide, p.x);
    }
    const double tall = high - low;
    return tall < 2.0 * wide ? std::sqrt(tall * tall + wide * wide) : tall;
}

// Mixed with a thousandth of any other species, a species changes by less than 0.3 % of its extent.
TEST(MorphSet, OutlinesConvergeToTheSingleSpeciesAtWeightOne) {
    for (const auto& [one, two] : some_pairs(effort(1000, 8)))
        for (const auto& [a, b] : {std::array{one, two}, {two, one}}) {
            const MorphSet alone = set_of({a});
            const bool first = a < b;
            const MorphSet set = first ? set_of({a, b}) : set_of({b, a});
            const auto indices = first ? indices_of({a, b}) : indices_of({b, a});
            const auto at = [&](double t, double age) {
                const auto shares = eased_weights(first ? std::vector<double>{1.0 - t, t}
                                                        : std::vector<double>{t, 1.0 - t});
                return polyline(Outline(set.nodes(mix_of(set, indices, shares, age))), 0);
            };
            for (const double age : {0.0, 0.3, 0.6, 1.0}) {
                const Polyline corner =
                    polyline(Outline(alone.nodes(alone.growth_weights(age))), 0);
                EXPECT_LT(hausdorff(corner, at(0.001, age)), 3e-3 * extent(corner))
                    << a << " with " << b << " at " << age;
            }
        }
}

TEST(MorphSet, EasedWeightsHaveZeroSlopeAtZeroAndAreLinearBeyond) {
    const auto of_pair = [](double w) { return eased_weights({1.0 - w, w})[1]; };
    EXPECT_EQ(eased_weights({0.7}), std::vector<double>{1.0});
    EXPECT_EQ(of_pair(0.0), 0.0);
    EXPECT_EQ(of_pair(1.0), 1.0);
    EXPECT_EQ(of_pair(0.5), 0.5);
    EXPECT_LT(of_pair(0.001), 0.0003);
    EXPECT_NEAR(of_pair(0.1), 0.1, 0.003);
    for (int i = 0; i < 100000; ++i) {
        const double from = of_pair(i / 1e5), to = of_pair((i + 1) / 1e5);
        ASSERT_GT(to, from) << i;
        ASSERT_LT(to - from, 1.01e-5) << "no steeper than 1.01, at " << i;
    }
    for (const std::size_t count : {2u, 3u, 5u, 8u})
        for (const double weight : eased_weights(std::vector<double>(count, 125.0)))
            EXPECT_DOUBLE_EQ(weight, 1.0 / static_cast<double>(count));
    const auto one = eased_weights({0.2, 0.001, 0.799}), other = eased_weights({0.799, 0.2, 0.001});
    EXPECT_DOUBLE_EQ(one[0], other[1]);
    EXPECT_DOUBLE_EQ(one[1], other[2]);
    EXPECT_DOUBLE_EQ(one[2], other[0]);
    EXPECT_DOUBLE_EQ(one[0] + one[1] + one[2], 1.0);
}

TEST(MorphSet, TheOrderOfTwoSpeciesHasNoVisibleEffect) {
    for (const auto& [a, b] : {std::array{fly_agaric, cep},
                               {fly_agaric, ink_cap},
                               {chanterelle, club},
                               {cup, brittlegill}}) {
        const MorphSet one = set_of({a, b}), two = set_of({b, a});
        for (const double age : {0.0, 0.6, 1.0})
            for (const double t : {0.25, 0.5, 0.75}) {
                const Polyline p = polyline(
                    Outline(one.nodes(mix_of(one, indices_of({a, b}), {1.0 - t, t}, age))), 0);
                const Polyline q = polyline(
                    Outline(two.nodes(mix_of(two, indices_of({b, a}), {t, 1.0 - t}, age))), 0);
                EXPECT_LT(hausdorff(p, q), 0.01 * diagonal(p)) << a << ' ' << b << " at " << age;
            }
    }
}

// The steps are 1/256 in t.
TEST(MorphSet, MorphsAreContinuous) {
    for (const auto& [a, b] : some_pairs(effort(1000, 8))) {
        const MorphSet set = set_of({a, b});
        const auto indices = indices_of({a, b});
        for (const double age : {0.0, 0.3, 0.6, 1.0}) {
            const auto at = [&](double t) {
                return polyline(Outline(set.nodes(mix_of(set, indices, {1.0 - t, t}, age))), 1);
            };
            // Outlines have unit size: the young egg of a tall species is a third as large as
            // another outline, and both occur at the ends of the path.
            const double larger = std::max(diagonal(at(0.0)), diagonal(at(1.0)));
            Polyline last;
            for (int i = 0; i <= 256; ++i) {
                const double t = i / 256.0;
                const Polyline here = at(t);
                double worst = 0.0;
                for (std::size_t p = 0; p < last.size(); ++p)
                    worst = std::max(worst, glm::distance(last[p], here[p]));
                EXPECT_LT(worst, 0.02 * larger)
                    << a << " and " << b << " at " << age << ", t = " << t;
                last = here;
            }
        }
    }
}

TEST(MorphSet, IndirectPathsReproduceEveryShapeAtWeightOne) {
    const MorphSet set = set_of({fly_agaric, cup}), alone = set_of({fly_agaric});
    EXPECT_GT(set.certificate().indirect, 0.0) << "a closed cup turns its margin over";
    EXPECT_EQ(set_of({fly_agaric, cep}).certificate(),
              (Certificate{true, ProofMethod::certificate, 0.0}));
    for (const double age : {0.0, 0.1, 0.6}) {
        const auto weights = mix_of(set, indices_of({fly_agaric, cup}), {1.0, 0.0}, age);
        const Polyline in_set = polyline(Outline(set.nodes(weights)), 0);
        const Polyline by_itself = polyline(Outline(alone.nodes(alone.growth_weights(age))), 0);
        EXPECT_LT(hausdorff(in_set, by_itself), 2e-3 * diagonal(in_set));
    }
}

TEST(MorphSet, BasesOfStemsCorrespond) {
    const MorphSet set = set_of({cup, bonnet});  // a broad low cup and a thread-like stem
    std::vector<int> flat;
    for (std::size_t species_index = 0; species_index < 2; ++species_index) {
        std::vector<double> shares(2, 0.0);
        shares[species_index] = 1.0;
        const Outline mature(set.nodes(mix_of(set, indices_of({cup, bonnet}), shares, 0.6)));
        flat.push_back(0);
        std::vector<double> even;
        for (int i = 0; i <= 25; ++i) even.push_back(i / 25.0);
        for (const OutlineSample& place : mature.stem.placed(even))
            flat.back() += place.tangent_y < place.tangent_r ? 1 : 0;
    }
    EXPECT_NEAR(flat[0], flat[1], 1) << "what belongs together under ground";
    EXPECT_GE(flat[0], 2);
}

/// Returns forms that have little in common, with random proportions: a ball with hardly a stem, a
/// disc on the ground, a club, an egg, a morel's head, a bowl.
Silhouette form(int kind, Random& random) {
    const auto vary = [&](double x) { return x * random.uniform(0.75, 1.3); };
    const double r = vary(0.5), y = vary(0.2), w = vary(0.12);
    const OutlinePoint top{w, y};
    switch (kind) {
        case 0:  // puffball
            return {.stem = {{0.0, 0.0}, {0.6 * w, 0.02}, {w, 0.05}},
                    .hymenium = {},
                    .cap = {{w, 0.05},
                            {r, 0.05 + 0.7 * r},
                            {0.75 * r, 0.05 + 1.5 * r},
                            {0.0, 0.05 + 1.9 * r}}};
        case 1:  // disc
            return {.stem = {{0.0, 0.0}, {w, 0.03}},
                    .hymenium = {{w, 0.03}, {0.7, 0.05}, {1.2, 0.06}},
                    .cap = {{1.2, 0.06}, {1.1, 0.1}, {0.6, 0.1}, {0.0, 0.09}}};
        case 2:  // club
            return {.stem = {{0.0, 0.0}, {0.5 * w, 0.1}, {0.6 * w, 0.5}},
                    .hymenium = {},
                    .cap = {{0.6 * w, 0.5}, {w, 1.2}, {0.7 * w, 1.5}, {0.0, 1.6}}};
        case 3:  // egg
            return {.stem = {{0.0, 0.0}, {0.3 * r, 0.02}, {0.7 * r, 0.2}},
                    .hymenium = {{0.7 * r, 0.2}, {0.72 * r, 0.22}, {0.74 * r, 0.25}},
                    .cap = {{0.74 * r, 0.25}, {0.8 * r, 0.5}, {0.4 * r, 0.85}, {0.0, 0.95}}};
        case 4:  // morel
            return {.stem = {{0.0, 0.0}, {w, 0.05}, {w, 0.5}},
                    .hymenium = {{w, 0.5}, {1.2 * w, 0.49}, {1.6 * w, 0.5}},
                    .cap = {{1.6 * w, 0.5}, {2.2 * w, 0.7}, {1.4 * w, 1.3}, {0.0, 1.5}}};
        default:  // bowl
            return {.stem = {{0.0, 0.0}, {w, 0.02}, top},
                    .hymenium = {top, {0.6, y + 0.15}, {0.9, y + 0.5}},
                    .cap = {{0.9, y + 0.5}, {0.85, y + 0.52}, {0.5, y + 0.25}, {0.0, y + 0.1}}};
    }
}

TEST(MorphSet, DissimilarFormsMix) {
    Random random(53, 0);
    for (int trial = 0; trial < 120; ++trial) {
        const std::size_t species_count = 2 + random.bits() % 3;
        std::vector<ControlShape> shapes;
        for (std::size_t species_index = 0; species_index < species_count; ++species_index) {
            const int kind = static_cast<int>(random.bits() % 6);
            for (const double age : {0.0, 0.6, 1.0})
                shapes.push_back({form(kind, random), 1.0, species_index, age});
        }
        const MorphSet set(shapes);
        for (int draw = 0; draw < 25; ++draw) {
            std::vector<double> weights = set.growth_weights(random.uniform()), shares;
            double sum = 0.0;
            for (std::size_t k = 0; k < species_count; ++k) {
                shares.push_back(random.uniform());
                sum += shares.back();
            }
            for (std::size_t s = 0; s < weights.size(); ++s)
                weights[s] *= shares[shapes[s].species_index] / sum;
            EXPECT_TRUE(is_simple(Outline(set.nodes(weights)))) << "trial " << trial;
        }
    }
}

TEST(MorphSet, RandomShapesAreRefusedOrNeverCross) {
    Random random(47, 0);
    int made = 0, refused = 0;
    for (int trial = 0; trial < 150; ++trial) {
        std::vector<ControlShape> shapes;
        for (std::size_t species_index = 0; species_index < 3; ++species_index) {
            const auto& entries = swept_atlas().entries();
            ControlShape shape =
                shapes_of(entries[random.bits() % entries.size()], 0)[random.bits() % 4];
            Silhouette& s = shape.silhouette;
            for (auto* part : {&s.stem, &s.hymenium, &s.cap})
                for (OutlinePoint& p : *part)
                    if (p.r > 0.0) {
                        p.r *= random.uniform(0.8, 1.25);
                        p.y += shape.size * random.uniform(-0.025, 0.025);
                    }
            if (!s.hymenium.empty()) s.hymenium.front() = s.stem.back();
            s.cap.front() = s.hymenium.empty() ? s.stem.back() : s.hymenium.back();
            shape.species_index = species_index;
            shapes.push_back(shape);
        }
        try {
            const MorphSet set(shapes);
            ++made;
            for (int draw = 0; draw < 40; ++draw) {
                std::vector<double> weights;
                double sum = 0.0;
                for (std::size_t s = 0; s < 3; ++s) {
                    weights.push_back(random.uniform());
                    sum += weights.back();
                }
                for (double& w : weights) w /= sum;
                ASSERT_TRUE(is_simple(Outline(set.nodes(weights)))) << "trial " << trial;
            }
        } catch (const Impossible&) {
            ++refused;
        }
    }
    EXPECT_GT(made, 15);
    EXPECT_GT(refused, 2);
}

}  // namespace
}  // namespace sporeprint::silhouette_morph_set_test
