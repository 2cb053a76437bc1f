#include "core/breed/outlines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <utility>
#include <variant>

#include "core/breed/traits.h"
#include "core/individual/axis_curve.h"
#include "core/math/elementary.h"
#include "core/params/canonical.h"
#include "core/problems.h"
#include "core/silhouette/outline.h"
#include "core/version.h"

namespace sporeprint {

namespace {

/// The age of the shape by which control points of two species are matched.
constexpr double mature_age = 0.6;

/// Steps at which the place of a control point on a curve of a set is looked for.
constexpr int place_steps = 512;

/// Control points of the second species are left out where one of the first is so near, in lengths
/// of the common parameter: two of them would make a dent, and 32 points are the most.
constexpr double least_distance = 0.045;

/// The greatest distance that outlines mutate at mutation 1, in heights and deviations.
constexpr double outline_deviation = 0.04;

const Swept& swept_of(const Stage& stage) { return std::get<Swept>(stage.model.shape); }

std::vector<OutlinePoint>& points_of(Silhouette& silhouette, CurveName curve) {
    return curve == CurveName::stem       ? silhouette.stem
           : curve == CurveName::hymenium ? silhouette.hymenium
                                          : silhouette.cap;
}

const std::vector<OutlinePoint>& points_of(const Silhouette& silhouette, CurveName curve) {
    return curve == CurveName::stem       ? silhouette.stem
           : curve == CurveName::hymenium ? silhouette.hymenium
                                          : silhouette.cap;
}

std::size_t mature_stage(const Species& species) {
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < species.stages.size(); ++i)
        if (std::abs(species.stages[i].age - mature_age) <
            std::abs(species.stages[nearest].age - mature_age))
            nearest = i;
    return nearest;
}

/// Returns the places of the control points between the ends of a sub-curve, as values of the
/// common parameter u.
std::vector<double> places_of(const std::vector<OutlinePoint>& points,
                              const std::vector<OutlineNode>& nodes, double size) {
    std::vector<double> u;
    u.reserve(place_steps + 1);
    for (int i = 0; i <= place_steps; ++i) u.push_back(static_cast<double>(i) / place_steps);
    const std::vector<OutlineSample> samples = SubCurve(nodes, {0.0, 1.0}).placed(u);
    std::vector<double> places;
    std::size_t last = 0;
    for (std::size_t k = 1; k + 1 < points.size(); ++k) {
        std::size_t best = last;
        double least = 1e300;
        for (std::size_t i = last + 1; i + 1 < samples.size(); ++i) {
            const double r = samples[i].r - points[k].r / size,
                         y = samples[i].y - points[k].y / size;
            if (r * r + y * y >= least) continue;
            least = r * r + y * y;
            best = i;
        }
        if (best == last) break;
        places.push_back(u[best]);
        last = best;
    }
    return places;
}

/// Returns the places of two species in ascending order, without those of the second that are near
/// one of the first or an end.
std::vector<double> united_places(std::vector<double> first, const std::vector<double>& second) {
    const std::vector<double> of_first = first;
    for (const double u : second) {
        const bool is_near = std::any_of(of_first.begin(), of_first.end(), [&](double other) {
            return std::abs(other - u) < least_distance;
        });
        if (!is_near && u > least_distance && u < 1.0 - least_distance && first.size() < 30)
            first.push_back(u);
    }
    std::sort(first.begin(), first.end());
    first.insert(first.begin(), 0.0);
    first.push_back(1.0);
    return first;
}

/// The correspondence of two species, and where the stages of each are in it.
struct Pair {
    std::shared_ptr<const MorphSet> set;
    std::array<const Species*, 2> species;
    std::array<double, 2> sizes;
    std::array<std::size_t, 2> first;

    /// Returns the weights of the stages at an age.
    [[nodiscard]] std::vector<double> weights(double age, double share) const {
        std::vector<double> weights = set->growth_weights(age);
        for (std::size_t i = 0; i < weights.size(); ++i)
            weights[i] *= i < first[1] ? 1.0 - share : share;
        return weights;
    }
    [[nodiscard]] OutlineNodes mature(std::size_t side) const {
        std::vector<double> weights(set->size(), 0.0);
        weights[first[side] + mature_stage(*species[side])] = 1.0;
        return set->nodes(weights);
    }
};

Pair pair_of(const Species& a, const Species& b, const GetOrCompute<MorphSet>& morphs) {
    Pair pair{nullptr, {&a, &b}, {size_of(a), size_of(b)}, {0, a.stages.size()}};
    std::string key = "offspring morph " + std::to_string(generator_version);
    std::vector<ControlShape> shapes;
    shapes.reserve(a.stages.size() + b.stages.size());
    for (std::size_t side = 0; side < 2; ++side)
        for (const Stage& stage : pair.species[side]->stages) {
            const Silhouette& silhouette = swept_of(stage).silhouette;
            (key += ' ') += number_text(stage.age);
            canonical(silhouette, key);
            shapes.push_back({silhouette, pair.sizes[side], side, stage.age});
        }
    pair.set = morphs(key, [&] { return std::make_shared<const MorphSet>(shapes); });
    return pair;
}

/// Makes an outline begin and end on the axis, and its sub-curves where the one before ends.
void join(Silhouette& silhouette) {
    silhouette.stem.front().r = silhouette.cap.back().r = 0.0;
    if (!silhouette.hymenium.empty()) silhouette.hymenium.front() = silhouette.stem.back();
    silhouette.cap.front() =
        silhouette.hymenium.empty() ? silhouette.stem.back() : silhouette.hymenium.back();
}

double height_of(const Silhouette& silhouette) {
    double low = silhouette.stem.front().y, high = low;
    for (const CurveName curve : curve_names)
        for (const OutlinePoint& point : points_of(silhouette, curve)) {
            low = std::min(low, point.y);
            high = std::max(high, point.y);
        }
    return high - low;
}

double size_of(const Model& model) {
    if (const auto* branched = std::get_if<Branched>(&model.shape))
        return branched->segments.height;
    const Silhouette& silhouette = std::get<Swept>(model.shape).silhouette;
    double radius = 0.0;
    for (const CurveName curve : curve_names)
        for (const OutlinePoint& point : points_of(silhouette, curve))
            radius = std::max(radius, point.r);
    const double height = height_of(silhouette);
    return std::sqrt(radius * radius + 0.25 * height * height);
}

/// Returns the weights of the stages of a species at an age.
std::vector<double> growth_of(const Species& species, double age) {
    std::vector<double> ages;
    ages.reserve(species.stages.size());
    for (const Stage& stage : species.stages) ages.push_back(stage.age);
    return stage_weights(ages, age);
}

/// Returns `count` points of a curve at even steps of its length, which is 1.
std::vector<AxisPoint> axis_points(const AxisCurve& curve, std::size_t count) {
    const std::vector<glm::dvec3> tangents = curve.tangents();
    std::vector<glm::dvec3> places = {glm::dvec3(0.0)};
    places.reserve(tangents.size());
    for (std::size_t i = 1; i < tangents.size(); ++i)
        places.push_back(places.back() + 0.5 * (tangents[i - 1] + tangents[i]) /
                                             static_cast<double>(AxisCurve::stations));
    std::vector<AxisPoint> points;
    points.reserve(count);
    for (std::size_t k = 0; k < count; ++k) {
        const glm::dvec3& at = places[k * (places.size() - 1) / (count - 1)];
        points.push_back({at.x, at.y, at.z});
    }
    return points;
}

}  // namespace

double size_of(const Species& species) {
    const std::vector<double> growth = growth_of(species, mature_age);
    double size = 0.0;
    for (std::size_t i = 0; i < growth.size(); ++i)
        size += growth[i] * size_of(species.stages[i].model);
    return size;
}

std::vector<Silhouette> outlines_between(const Species& a, const Species& b, double share,
                                         const std::vector<double>& ages, double size,
                                         const GetOrCompute<MorphSet>& morphs) {
    const Pair pair = pair_of(a, b, morphs);
    const std::array<const Silhouette*, 2> mature = {
        &swept_of(a.stages[mature_stage(a)]).silhouette,
        &swept_of(b.stages[mature_stage(b)]).silhouette};
    const std::array<OutlineNodes, 2> nodes = {pair.mature(0), pair.mature(1)};
    std::array<std::vector<double>, 3> places;
    for (const CurveName curve : curve_names) {
        std::array<std::vector<double>, 2> own;
        for (std::size_t side = 0; side < 2; ++side)
            own[side] =
                places_of(points_of(*mature[side], curve), nodes[side].of(curve), pair.sizes[side]);
        if (points_of(*mature[0], curve).empty() && points_of(*mature[1], curve).empty()) continue;
        places[static_cast<std::size_t>(curve)] = united_places(std::move(own[0]), own[1]);
    }
    const Species& nearer = share <= 0.5 ? a : b;
    std::vector<Silhouette> outlines;
    outlines.reserve(ages.size());
    for (const double age : ages) {
        const OutlineNodes mixed = pair.set->nodes(pair.weights(age, share));
        const std::vector<double> growth = growth_of(nearer, age);
        const auto heaviest = static_cast<std::size_t>(
            std::max_element(growth.begin(), growth.end()) - growth.begin());
        Silhouette outline;
        outline.junction = swept_of(nearer.stages[heaviest]).silhouette.junction;
        outline.margin = swept_of(nearer.stages[heaviest]).silhouette.margin;
        for (const CurveName curve : curve_names) {
            const std::vector<double>& at = places[static_cast<std::size_t>(curve)];
            if (at.empty()) continue;
            for (const OutlineSample& sample : SubCurve(mixed.of(curve), {0.0, 1.0}).placed(at))
                points_of(outline, curve).push_back({sample.r * size, sample.y * size});
        }
        join(outline);
        outlines.push_back(std::move(outline));
    }
    return outlines;
}

std::vector<std::vector<AxisPoint>> axes_between(const Species& a, const Species& b, double share,
                                                 const std::vector<double>& ages) {
    std::size_t count = 0;
    for (const Species* species : {&a, &b})
        for (const Stage& stage : species->stages)
            count = std::max(count, swept_of(stage).axis.size());
    std::vector<std::vector<AxisPoint>> axes(ages.size());
    if (count == 0) return axes;
    for (std::size_t i = 0; i < ages.size(); ++i) {
        AxisCurve mixed;
        for (const Species* species : {&a, &b}) {
            const std::vector<double> growth = growth_of(*species, ages[i]);
            for (std::size_t k = 0; k < growth.size(); ++k)
                if (growth[k] > 0.0 && !swept_of(species->stages[k]).axis.empty())
                    mixed.add(AxisCurve(swept_of(species->stages[k]).axis),
                              growth[k] * (species == &a ? 1.0 - share : share));
        }
        axes[i] = axis_points(mixed, std::max<std::size_t>(count, 4));
    }
    return axes;
}

CurveMutation::CurveMutation(const Genes& genes, std::string_view path)
    : amount_(outline_deviation * genes.mutation()) {
    Random random = genes.mutating(path);
    for (double& coefficient : coefficients_) coefficient = random.normal();
}

double CurveMutation::at(double share) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < coefficients_.size(); ++k) {
        const double turns = static_cast<double>(k + 1);
        sum += coefficients_[k] * sine(turns * pi * share) / turns;
    }
    return amount_ * sum;
}

void mutate_outlines(Species& species, const CurveMutation& mutation, double part) {
    // The shares of the mature outline are those of the same flesh in all stages.
    const Outline mature =
        Outline::unproven(swept_of(species.stages[mature_stage(species)]).silhouette);
    double whole = 0.0;
    for (const CurveName curve : curve_names)
        if (!mature.of(curve).empty()) whole += mature.of(curve).length();
    std::array<std::vector<double>, 3> moves;
    double before = 0.0;
    for (const CurveName curve : curve_names) {
        if (mature.of(curve).empty()) continue;
        for (const double share : mature.of(curve).segment_shares())
            moves[static_cast<std::size_t>(curve)].push_back(
                part * mutation.at((before + share * mature.of(curve).length()) / whole));
        before += mature.of(curve).length();
    }
    for (Stage& stage : species.stages) {
        Silhouette& silhouette = std::get<Swept>(stage.model.shape).silhouette;
        const Outline outline = Outline::unproven(silhouette);
        const double height = height_of(silhouette);
        const auto normal_at = [&](CurveName curve, double share) {
            const OutlineSample sample = outline.of(curve).at(share);
            return glm::dvec2(sample.tangent_y, -sample.tangent_r);
        };
        for (const CurveName curve : curve_names) {
            std::vector<OutlinePoint>& points = points_of(silhouette, curve);
            if (points.empty()) continue;
            const std::vector<double> shares = outline.of(curve).segment_shares();
            const std::vector<double>& own = moves[static_cast<std::size_t>(curve)];
            if (shares.size() != points.size() || own.size() != points.size())
                throw GenerationError("a spline has a segment between two control points");
            for (std::size_t k = 0; k < points.size(); ++k) {
                glm::dvec2 normal = normal_at(curve, shares[k]);
                // A join moves along the mean of the normals of both sub-curves.
                if (k + 1 == points.size() && curve != CurveName::cap) {
                    const CurveName next = curve == CurveName::stem && !outline.hymenium.empty()
                                               ? CurveName::hymenium
                                               : CurveName::cap;
                    const glm::dvec2 sum = normal + normal_at(next, 0.0);
                    const double length = std::sqrt(glm::dot(sum, sum));
                    if (length > 0.1) normal = sum / length;
                }
                points[k].r += height * own[k] * normal.x;
                points[k].y += height * own[k] * normal.y;
            }
        }
        join(silhouette);
    }
}

void mutate_axes(Species& species, const Genes& genes) {
    const CurveMutation sideways(genes, "axis.x"), forwards(genes, "axis.z");
    for (Stage& stage : species.stages) {
        std::vector<AxisPoint>& axis = std::get<Swept>(stage.model.shape).axis;
        for (std::size_t k = 1; k + 1 < axis.size(); ++k) {
            const double share = static_cast<double>(k) / static_cast<double>(axis.size() - 1);
            axis[k].x = std::clamp(axis[k].x + sideways.at(share), -2.0, 2.0);
            axis[k].z = std::clamp(axis[k].z + forwards.at(share), -2.0, 2.0);
        }
    }
}

}  // namespace sporeprint
