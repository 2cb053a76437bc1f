#include "core/silhouette/morph_set.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <string>

#include "core/build/detail.h"
#include "core/math/elementary.h"
#include "core/params/problems.h"

namespace sporeprint {

namespace {

constexpr std::array<std::size_t, 3> node_counts = {45, 41, 49};
constexpr int measure_steps = 128, need_smoothings = 4;
constexpr double mature_age = 0.6;
constexpr double least_foot = 1e-3;    // of the stem's length; less is no base to speak of
constexpr std::size_t way_degree = 9;  // of the weights of a mix along a way with detours
constexpr int deepest_piece = 9;
// The bud: half its width over its height; the lower face's middle and half its breadth, as shares of a quarter turn.
constexpr double bud_width = 0.175, bud_middle = -0.1, bud_band = 0.1;
// Stems bend with their axis, wherever their outline is straight.
constexpr double stem_evenness = 3.0;

using Curves = std::array<SubCurve, 3>;

std::size_t index(CurveName curve) { return static_cast<std::size_t>(curve); }

/// Growth weights of the stages of one kin: linear between neighbours, the first and last stage beyond.
std::vector<double> stage_weights(std::span<const double> ages, double age) {
    std::vector<double> weights(ages.size(), 0.0);
    std::size_t above = 0;
    while (above < ages.size() && ages[above] < age) ++above;
    if (above == 0) {
        weights.front() = 1.0;
    } else if (above == ages.size()) {
        weights.back() = 1.0;
    } else {
        const double t = (age - ages[above - 1]) / (ages[above] - ages[above - 1]);
        weights[above - 1] = 1.0 - t;
        weights[above] = t;
    }
    return weights;
}

std::vector<double> between(std::span<const double> from, std::span<const double> to, double t) {
    std::vector<double> weights(from.size());
    for (std::size_t s = 0; s < weights.size(); ++s) weights[s] = (1.0 - t) * from[s] + t * to[s];
    return weights;
}

/// Arc lengths of the blend of several stages along the mature stage's own shares, to read shares off in both directions.
class BlendedLength {
  public:
    /// stages  curves with their maps from the mature stage's shares, weights and scales
    struct Stage {
        const SubCurve* curve;
        const ShareMap* from_mature;
        double weight;
    };
    explicit BlendedLength(std::span<const Stage> stages) {
        glm::dvec2 last(0.0);
        for (int i = 0; i <= measure_steps; ++i) {
            glm::dvec2 here(0.0);
            for (const Stage& stage : stages) {
                if (stage.weight == 0.0) continue;
                const auto s = stage.curve->at(
                    (*stage.from_mature)(static_cast<double>(i) / measure_steps).at);
                here += stage.weight * glm::dvec2(s.r, s.y);
            }
            const glm::dvec2 step = here - last;
            lengths_.push_back(i == 0 ? 0.0 : lengths_.back() + std::sqrt(glm::dot(step, step)));
            last = here;
        }
    }

    /// The mature stage's share at a share of the blend's length.
    [[nodiscard]] double mature_share(double share) const {
        const double wanted = share * lengths_.back();
        const auto above = std::upper_bound(lengths_.begin() + 1, lengths_.end() - 1, wanted);
        const double from = *(above - 1), to = *above;
        const double t = to > from ? std::clamp((wanted - from) / (to - from), 0.0, 1.0) : 0.0;
        return (static_cast<double>(above - 1 - lengths_.begin()) + t) / measure_steps;
    }

    /// The share of the blend's length at a mature share.
    [[nodiscard]] double share(double mature) const {
        const double place = std::clamp(mature, 0.0, 1.0) * measure_steps;
        const auto i = std::min(static_cast<std::size_t>(place), lengths_.size() - 2);
        const double t = place - static_cast<double>(i);
        return (lengths_[i] + t * (lengths_[i + 1] - lengths_[i])) / lengths_.back();
    }

  private:
    std::vector<double> lengths_;
};

/// Refuses arcs that leave their curve or cross one another.
void check_arcs(std::span<const Arc> arcs, std::size_t kins, const std::array<bool, 3>& in_both) {
    std::vector<Problem> problems;
    const auto path = [](std::size_t i) { return "/arcs/" + std::to_string(i); };
    for (std::size_t i = 0; i < arcs.size(); ++i) {
        const Arc& arc = arcs[i];
        if (kins != 2) {
            report(problems, path(i), "arcs link exactly two species");
            continue;
        }
        if (!in_both[index(arc.curve)]) {
            report(problems, path(i),
                   std::string("one of the two species has no ") + name(arc.curve));
            continue;
        }
        if (!(arc.a > 0.0 && arc.a < 1.0 && arc.b > 0.0 && arc.b < 1.0)) {
            report(problems, path(i),
                   "ends on a landmark of the " + std::string(name(arc.curve)) +
                       "; both shares must lie between 0 and 1");
            continue;
        }
        for (std::size_t j = 0; j < i; ++j) {
            const Arc& other = arcs[j];
            if (other.curve != arc.curve || other == arc) continue;
            if ((arc.a - other.a) * (arc.b - other.b) <= 0.0)
                report(problems, path(i), "crosses arc " + std::to_string(j));
        }
    }
    if (!problems.empty()) throw Impossible(std::move(problems));
}

/// Share of a stem's length at which it has turned from its base half way up: where it comes out of the ground.
std::optional<double> foot(const SubCurve& stem) {
    const auto up = [&](double share) {
        const OutlineSample s = stem.at(share);
        return s.tangent_y >= s.tangent_r;
    };
    for (int i = 1; i < measure_steps; ++i) {
        if (!up(static_cast<double>(i) / measure_steps)) continue;
        double below = static_cast<double>(i - 1) / measure_steps, above = below;
        above += 1.0 / measure_steps;
        for (int halving = 0; halving < 20; ++halving) {
            const double middle = 0.5 * (below + above);
            (up(middle) ? above : below) = middle;
        }
        return above;
    }
    return std::nullopt;
}

/// The feet of two stems belong together, however wide or thin these are, unless the designer's arcs say otherwise.
std::vector<Landmark> with_feet(std::vector<Landmark> landmarks, const SubCurve& a,
                                const SubCurve& b) {
    const auto foot_a = foot(a), foot_b = foot(b);
    if (!foot_a || !foot_b || *foot_a < least_foot || *foot_b < least_foot) return landmarks;
    for (const Landmark& landmark : landmarks)
        if (landmark.a <= *foot_a || landmark.b <= *foot_b) return landmarks;
    landmarks.insert(landmarks.begin(), {*foot_a, *foot_b});
    return landmarks;
}

/// measure_steps + 1 shares of the hub, 0 to 1, at even steps of the mean of what they are mapped to: no curve is stepped over.
std::vector<double> even_for_all(const std::vector<const ShareMap*>& from_hub) {
    std::vector<double> knots;
    for (const ShareMap* map : from_hub)
        knots.insert(knots.end(), map->from().begin(), map->from().end());
    std::sort(knots.begin(), knots.end());
    knots.erase(std::unique(knots.begin(), knots.end()), knots.end());
    std::vector<double> means;
    for (const double knot : knots) {
        double sum = 0.0;
        for (const ShareMap* map : from_hub) sum += (*map)(knot).at;
        means.push_back(sum / static_cast<double>(from_hub.size()));
    }
    std::vector<double> places{0.0};
    std::size_t k = 1;
    for (int i = 1; i < measure_steps; ++i) {
        const double mean = static_cast<double>(i) / measure_steps;
        while (means[k] < mean) ++k;
        const double t = (mean - means[k - 1]) / (means[k] - means[k - 1]);
        places.push_back(knots[k - 1] + t * (knots[k] - knots[k - 1]));
    }
    places.push_back(1.0);
    return places;
}

/// From the lowest control point to the highest.
double height(const Silhouette& silhouette) {
    double low = silhouette.stem.front().y, high = low;
    for (const auto* part : {&silhouette.stem, &silhouette.hymenium, &silhouette.cap})
        for (const OutlinePoint& p : *part) {
            low = std::min(low, p.y);
            high = std::max(high, p.y);
        }
    return std::max(high - low, 1e-9);
}

/// Makes both sides of every smooth join run in one direction in every mix: the ratio of their speeds becomes the same in all shapes.
void align_joins(std::vector<OutlineNodes>& all, const std::vector<ControlShape>& shapes) {
    const auto align = [&](CurveName before, CurveName after, auto joined) {
        double sum = 0.0;
        int count = 0;
        const auto speed = [](const OutlineNode& node) {
            return std::sqrt(glm::dot(node.velocity, node.velocity));
        };
        for (std::size_t s = 0; s < all.size(); ++s)
            if (joined(shapes[s].silhouette)) {
                const double in = speed(all[s].of(before).back());
                const double out = speed(all[s].of(after).front());
                if (in <= 0.0 || out <= 0.0) continue;
                sum += logarithm(out / in);
                ++count;
            }
        if (count == 0) return;
        const double ratio = exponential(sum / count);
        for (std::size_t s = 0; s < all.size(); ++s)
            if (joined(shapes[s].silhouette)) {
                OutlineNode& in = all[s].of(before).back();
                OutlineNode& out = all[s].of(after).front();
                const double in_speed = speed(in), out_speed = speed(out);
                if (in_speed <= 0.0 || out_speed <= 0.0) continue;
                const double by = std::sqrt(out_speed / in_speed / ratio);
                in.velocity *= by;
                out.velocity *= ratio * by * in_speed / out_speed;
            }
    };
    const bool hymenium = !all.front().hymenium.empty();
    if (hymenium) {
        align(CurveName::stem, CurveName::hymenium, [](const Silhouette& s) {
            return !s.hymenium.empty() && s.junction == Join::smooth;
        });
        align(CurveName::hymenium, CurveName::cap,
              [](const Silhouette& s) { return !s.hymenium.empty() && s.margin == Join::smooth; });
    } else {
        align(CurveName::stem, CurveName::cap,
              [](const Silhouette& s) { return s.junction == Join::smooth; });
    }
}

/// A smooth bud, as high as the shapes are on average, that their sub-curves run along from pole to pole, the lower face as a narrow band.
/// Nothing of it hides anything else, so nearly every shape opens out of it straight.
OutlineNodes bud_of(const std::vector<OutlineNodes>& shapes) {
    const auto count_of_shapes = static_cast<double>(shapes.size());
    double low = 0.0, high = 0.0;
    for (const OutlineNodes& shape : shapes) {
        low += shape.stem.front().position.y / count_of_shapes;
        high += shape.cap.back().position.y / count_of_shapes;
    }
    const glm::dvec2 centre(0.0, 0.5 * (low + high));
    const glm::dvec2 half(bud_width * (high - low), 0.5 * (high - low));
    const double junction = (bud_middle - bud_band) * 0.5 * pi;
    const double margin =
        shapes.front().hymenium.empty() ? junction : (bud_middle + bud_band) * 0.5 * pi;
    OutlineNodes bud;
    for (const CurveName curve : curve_names) {
        const std::size_t count = shapes.front().of(curve).size();
        if (count == 0) continue;
        // As the shapes run through their own lengths on average.
        const auto even = [&](std::size_t i) {
            return static_cast<double>(i) / static_cast<double>(count - 1);
        };
        std::vector<double> shares(count, 0.0);
        for (const OutlineNodes& shape : shapes) {
            std::vector<double> lengths{0.0};
            const std::vector<OutlineNode>& own = shape.of(curve);
            for (std::size_t i = 1; i < count; ++i)
                lengths.push_back(lengths.back() +
                                  glm::distance(own[i].position, own[i - 1].position));
            for (std::size_t i = 0; i < count; ++i)
                shares[i] += (lengths.back() > 0.0 ? lengths[i] / lengths.back() : even(i)) /
                             count_of_shapes;
        }
        const double from = curve == CurveName::stem       ? -0.5 * pi
                            : curve == CurveName::hymenium ? junction
                                                           : margin;
        const double to = curve == CurveName::stem       ? junction
                          : curve == CurveName::hymenium ? margin
                                                         : 0.5 * pi;
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t before = i == 0 ? 0 : i - 1, after = std::min(i + 1, count - 1);
            const double rate = (shares[after] - shares[before]) / (even(after) - even(before));
            const double share = i + 1 == count ? 1.0 : shares[i];  // without rounding: ends meet
            const auto [s, c] = sine_cosine(from + (to - from) * share);
            bud.of(curve).push_back(
                {centre + half * glm::dvec2(c, s), (to - from) * rate * half * glm::dvec2(-s, c)});
        }
    }
    bud.stem.front().position.x = bud.cap.back().position.x = 0.0;
    if (!bud.hymenium.empty()) bud.hymenium.front().position = bud.stem.back().position;
    bud.cap.front().position =
        bud.hymenium.empty() ? bud.stem.back().position : bud.hymenium.back().position;
    return bud;
}

std::shared_ptr<const RingPlaces> even_places(bool hymenium) {
    auto places = std::make_shared<RingPlaces>();
    for (std::size_t lod = 0; lod < details.size(); ++lod) {
        const std::array<int, 3> rings = {details[lod].stem_rings,
                                          hymenium ? details[lod].hymenium_rings : 0,
                                          details[lod].cap_rings};
        for (std::size_t c = 0; c < 3; ++c)
            for (int i = 0; i < rings[c]; ++i)
                places->by_lod[lod][c].push_back(static_cast<double>(i) / (rings[c] - 1));
    }
    return places;
}

}  // namespace

Polyline polyline(const Outline& outline, int lod) {
    Polyline line;
    for (const CurveName curve : curve_names) {
        const auto rings = outline.rings(curve, lod);
        for (std::size_t i = line.empty() ? 0 : 1; i < rings.size(); ++i)
            line.emplace_back(rings[i].r, rings[i].y);
    }
    return line;
}

CurveName curve_of(const Contact& contact, std::size_t stem_rings, std::size_t hymenium_rings) {
    std::size_t vertex = contact.j == contact.i ? contact.i : contact.j + 1;
    if (vertex < stem_rings) return CurveName::stem;
    if (stem_rings > 0) vertex -= stem_rings - 1;  // joins count once
    return vertex < hymenium_rings ? CurveName::hymenium : CurveName::cap;
}

MorphSet::MorphSet(std::vector<ControlShape> shapes, std::span<const Arc> arcs, double arcs_age) {
    assert(!shapes.empty());
    std::vector<Curves> curves;
    for (const ControlShape& shape : shapes) {
        Outline outline = Outline::unproven(shape.silhouette);
        curves.push_back(
            {std::move(outline.stem), std::move(outline.hymenium), std::move(outline.cap)});
        if (shape.kin == kins_.size()) kins_.push_back({ages_.size(), 0, ages_.size()});
        Kin& kin = kins_.back();
        assert(shape.kin + 1 == kins_.size());
        if (std::abs(shape.age - mature_age) < std::abs(shapes[kin.mature].age - mature_age))
            kin.mature = ages_.size();
        ++kin.count;
        ages_.push_back(shape.age);
    }
    if (!arcs.empty()) {
        std::array<bool, 3> in_both{};
        for (std::size_t c = 0; c < 3; ++c)
            in_both[c] = kins_.size() == 2 && !curves[kins_[0].mature][c].empty() &&
                         !curves[kins_[1].mature][c].empty();
        check_arcs(arcs, kins_.size(), in_both);
    }

    std::vector<double> heights;
    heights.reserve(shapes.size());
    for (const ControlShape& shape : shapes) heights.push_back(height(shape.silhouette));

    nodes_.resize(shapes.size());
    bool hymenium = false;
    for (const CurveName curve : curve_names) {
        const std::size_t c = index(curve);
        const auto at = [&](std::size_t s) -> const SubCurve& { return curves[s][c]; };
        // Every stage against the mature one of its kin: control points are the author's own arcs.
        std::vector<ShareMap> from_mature(shapes.size());
        for (const Kin& kin : kins_) {
            const auto mature = at(kin.mature).segment_shares();
            for (std::size_t s = kin.first; s < kin.first + kin.count; ++s) {
                if (at(s).empty() != at(kin.mature).empty() ||
                    at(s).segment_shares().size() != mature.size())
                    throw InvalidInput("/stages",
                                       "stages of one species differ in the number of "
                                       "control points of the " +
                                           std::string(name(curve)));
                if (s != kin.mature && !mature.empty())
                    from_mature[s] = ShareMap(mature, at(s).segment_shares());
            }
        }
        // Every kin against the hub.
        const auto hub = std::find_if(kins_.begin(), kins_.end(),
                                      [&](const Kin& kin) { return !at(kin.mature).empty(); });
        if (hub == kins_.end()) continue;
        if (curve == CurveName::hymenium) hymenium = true;
        std::vector<Landmark> landmarks;
        const auto own_length = [&](const Kin& kin, double age) {
            const auto weights = stage_weights({ages_.data() + kin.first, kin.count}, age);
            std::vector<BlendedLength::Stage> stages;
            for (std::size_t k = 0; k < kin.count; ++k)
                stages.push_back({&at(kin.first + k), &from_mature[kin.first + k], weights[k]});
            return BlendedLength(stages);
        };
        for (const Arc& arc : arcs)
            if (arc.curve == curve)
                landmarks.push_back({own_length(kins_[0], arcs_age).mature_share(arc.a),
                                     own_length(kins_[1], arcs_age).mature_share(arc.b)});
        std::sort(landmarks.begin(), landmarks.end(),
                  [](const Landmark& x, const Landmark& y) { return x.a < y.a; });
        landmarks.erase(  // an arc given twice
            std::unique(landmarks.begin(), landmarks.end(),
                        [](const Landmark& x, const Landmark& y) { return x.a == y.a; }),
            landmarks.end());
        std::vector<ShareMap> from_hub(kins_.size());
        for (std::size_t k = 0; k < kins_.size(); ++k)
            if (&kins_[k] != &*hub && !at(kins_[k].mature).empty())
                from_hub[k] =
                    correspondence(at(hub->mature), at(kins_[k].mature),
                                   curve == CurveName::stem
                                       ? with_feet(landmarks, at(hub->mature), at(kins_[k].mature))
                                       : landmarks);

        // The common parameter u runs evenly through what the shapes need: by length and turning, so that thin margins stay round, and
        // by the root of their product, which a chord's error goes with; that one measured by each shape's own height, so that wide
        // flat ones get more. Fourth powers let the neediest shape speak.
        std::vector<const ShareMap*> present;
        for (std::size_t k = 0; k < kins_.size(); ++k)
            if (!at(kins_[k].mature).empty()) present.push_back(&from_hub[k]);
        const std::vector<double> places = even_for_all(present);
        std::vector<std::vector<double>> roots(shapes.size()), plain(shapes.size());
        std::vector<double> needs(measure_steps, 0.0);
        const double evenness = curve == CurveName::stem ? stem_evenness : 1.0;
        double most_roots = 1e-9;
        for (std::size_t s = 0; s < shapes.size(); ++s) {
            if (at(s).empty()) continue;
            double share = 0.0, turning = 0.0, sum = 0.0;
            const double whole = std::max(at(s).turning(1.0), 1e-9);
            const double scale = std::sqrt(at(s).length() / heights[s]);
            for (int i = 1; i <= measure_steps; ++i) {
                const double place = places[static_cast<std::size_t>(i)];
                const double next = from_mature[s](from_hub[shapes[s].kin](place).at).at;
                const double next_turning = at(s).turning(next);
                const double length = next - share, turn = next_turning - turning;
                plain[s].push_back(evenness * length + turn / whole);
                roots[s].push_back(scale * std::sqrt(length * turn));
                sum += roots[s].back();
                share = next;
                turning = next_turning;
            }
            most_roots = std::max(most_roots, sum);
        }
        for (std::size_t s = 0; s < shapes.size(); ++s)
            for (std::size_t i = 0; i < roots[s].size(); ++i) {
                const double need = plain[s][i] + 4.0 * roots[s][i] / most_roots;
                needs[i] += need * need * need * need;
            }
        for (double& need : needs) need = std::sqrt(std::sqrt(need));
        // Smoothed, so that u runs evenly: between two nodes the speed hardly changes.
        for (int pass = 0; pass < need_smoothings; ++pass) {
            double before = needs.front();
            for (std::size_t i = 0; i + 1 < needs.size(); ++i) {
                const double here = needs[i];
                needs[i] = 0.25 * before + 0.5 * here + 0.25 * needs[i + 1];
                before = here;
            }
        }
        std::vector<double> measures{0.0};
        for (const double need : needs) measures.push_back(measures.back() + need);
        for (double& measure : measures) measure /= measures.back();
        measures.back() = 1.0;
        const std::size_t count = node_counts[c];
        std::vector<double> u, node_shares;
        std::size_t k = 1;
        for (std::size_t i = 0; i < count; ++i) {
            u.push_back(static_cast<double>(i) / static_cast<double>(count - 1));
            while (k + 1 < measures.size() && measures[k] < u.back()) ++k;
            const double t = (u.back() - measures[k - 1]) / (measures[k] - measures[k - 1]);
            node_shares.push_back(places[k - 1] + t * (places[k] - places[k - 1]));
        }
        node_shares.front() = 0.0;
        node_shares.back() = 1.0;
        // As steep as it comes: a bound would give short steps a speed that they do not have.
        const ShareMap hub_from_u(u, node_shares, std::numeric_limits<double>::infinity());
        for (std::size_t s = 0; s < shapes.size(); ++s) {
            std::vector<OutlineNode>& nodes = nodes_[s].of(curve);
            if (at(s).empty()) {
                const OutlinePoint& p = shapes[s].silhouette.stem.back();
                nodes.assign(count, {glm::dvec2(p.r, p.y) / shapes[s].size, {0.0, 0.0}});
                continue;
            }
            for (std::size_t i = 0; i < count; ++i) {
                const auto on_hub = hub_from_u(u[i]);
                const auto on_mature = from_hub[shapes[s].kin](on_hub.at);
                const auto on_shape = from_mature[s](on_mature.at);
                const OutlineSample sample = at(s).at(on_shape.at);
                const double speed =
                    at(s).length() * on_shape.slope * on_mature.slope * on_hub.slope;
                nodes.push_back(
                    {glm::dvec2(sample.r, sample.y) / shapes[s].size,
                     glm::dvec2(sample.tangent_r, sample.tangent_y) * (speed / shapes[s].size)});
            }
            const auto pin = [&](OutlineNode& node, const OutlinePoint& p) {
                node.position = glm::dvec2(p.r, p.y) / shapes[s].size;
            };
            const Silhouette& silhouette = shapes[s].silhouette;
            const auto& points = curve == CurveName::stem       ? silhouette.stem
                                 : curve == CurveName::hymenium ? silhouette.hymenium
                                                                : silhouette.cap;
            pin(nodes.front(), points.front());
            pin(nodes.back(), points.back());
        }
    }
    align_joins(nodes_, shapes);
    places_ = even_places(hymenium);
    for (std::size_t s = 0; s < shapes.size(); ++s)
        for (int lod = 0; lod < static_cast<int>(details.size()); ++lod)
            if (const auto contact = contact_at_rest(polyline(nodes_[s], lod))) {
                (void)Outline(shapes[s].silhouette);  // names the control points if it can
                const std::string curve = name(curve_of(*contact, lod));
                throw Impossible("/model/silhouette/" + curve,
                                 "too fine for the rings of level of detail " +
                                     std::to_string(lod) + ": there the " + curve +
                                     " touches itself, its neighbour or the axis");
            }
    certify();
}

/// The weights after the detours, the bud's last: of what stage s gives, 1 - (1 - w)^7 (1 + 7 w) goes over to the mature stage of its
/// kin or to the bud, where w is the weight of what it folds with. That is 28 w^2 at first, so that nothing happens near its own
/// corner, and nearly all from a half on: a stage of little weight folds no mix of others, whoever they are. With x = 1 - w it is
/// w (1 + x + ... + x^6 - 7 x^7), so that each of those it folds with moves its part by the way of their own.
std::vector<double> MorphSet::detoured(std::span<const double> weights) const {
    std::vector<double> moved(weights.begin(), weights.end());
    moved.push_back(0.0);
    if (vias_.empty()) return moved;
    for (std::size_t s = 0; s < weights.size(); ++s) {
        if (weights[s] == 0.0) continue;
        double by_mature = 0.0, by_bud = 0.0;
        for (std::size_t other = 0; other < weights.size(); ++other) {
            if (via(s, other) == Via::mature) by_mature += weights[other];
            if (via(s, other) == Via::bud) by_bud += weights[other];
        }
        const double x = 1.0 - by_mature - by_bud;
        double rate = 1.0 - 7.0 * x;
        for (int i = 0; i < 6; ++i) rate = 1.0 + x * rate;
        rate *= weights[s];
        moved[s] -= (by_mature + by_bud) * rate;
        moved[kins_[kin_of(s)].mature] += by_mature * rate;
        moved.back() += by_bud * rate;
    }
    return moved;
}

OutlineNodes MorphSet::unchecked(std::span<const double> weights) const {
    assert(weights.size() == nodes_.size());
    const std::vector<double> moved = detoured(weights);
    OutlineNodes mix;
    for (const CurveName curve : curve_names) {
        std::vector<OutlineNode>& nodes = mix.of(curve);
        nodes.resize(nodes_.front().of(curve).size());
        for (std::size_t s = 0; s < moved.size(); ++s) {
            if (moved[s] == 0.0) continue;
            const std::vector<OutlineNode>& own = shape(s).of(curve);
            for (std::size_t i = 0; i < nodes.size(); ++i) {
                nodes[i].position += moved[s] * own[i].position;
                nodes[i].velocity += moved[s] * own[i].velocity;
            }
        }
    }
    return mix;
}

Polyline MorphSet::polyline(const OutlineNodes& nodes, int lod) const {
    Polyline line;
    for (const CurveName curve : curve_names) {
        const std::vector<OutlineNode>& own = nodes.of(curve);
        if (own.empty()) continue;
        if (line.empty()) line.push_back(own.front().position);
        const auto last = static_cast<double>(own.size() - 1);
        const double step = 1.0 / last;
        const std::vector<double>& places = places_->of(curve, lod);
        for (std::size_t i = 1; i + 1 < places.size(); ++i) {
            const double place = places[i] * last;
            const auto k = std::min(static_cast<std::size_t>(place), own.size() - 2);
            line.push_back(SplineSegment<glm::dvec2>{own[k].position, own[k + 1].position,
                                                     own[k].velocity * step,
                                                     own[k + 1].velocity * step}
                               .at(place - static_cast<double>(k))
                               .position);
        }
        line.push_back(own.back().position);
    }
    return line;
}

/// Whether a certificate covers all mixes of some shapes, at every level of detail.
bool MorphSet::certified(std::span<const std::size_t> shapes) const {
    for (int lod = static_cast<int>(details.size()) - 1; lod >= 0; --lod) {  // the cheap ones first
        std::vector<Polyline> lines;
        for (const std::size_t s : shapes) lines.push_back(polyline(nodes_[s], lod));
        if (first_doubt(lines)) return false;
    }
    return true;
}

std::size_t MorphSet::kin_of(std::size_t shape) const {
    std::size_t k = 0;
    while (shape >= kins_[k].first + kins_[k].count) ++k;
    return k;
}

void MorphSet::certify() {
    std::vector<std::size_t> all;
    for (std::size_t s = 0; s < nodes_.size(); ++s) all.push_back(s);
    for_any_weights_ = certified(all);
    for (std::size_t i = 0; i < kins_.size() && !for_any_weights_; ++i)
        for (std::size_t j = i + 1; j < kins_.size(); ++j) choose_detours(i, j);
}

/// Finds the straight ways between stages of two kin that fold, and gives them a detour. Coarse levels of detail are cheap and come
/// first: what folds there needs no second look.
void MorphSet::choose_detours(std::size_t i, std::size_t j) {
    const std::size_t count = nodes_.size();
    std::vector<std::array<std::size_t, 2>> folding;
    const auto folds = [&](std::size_t a, std::size_t b) {
        return std::find(folding.begin(), folding.end(), std::array{a, b}) != folding.end();
    };
    for (int lod = static_cast<int>(details.size()) - 1; lod >= 0; --lod) {
        std::vector<Polyline> lines(count);
        for (const std::size_t k : {i, j})
            for (std::size_t s = kins_[k].first; s < kins_[k].first + kins_[k].count; ++s)
                lines[s] = polyline(nodes_[s], lod);
        for (std::size_t a = kins_[i].first; a < kins_[i].first + kins_[i].count; ++a)
            for (std::size_t b = kins_[j].first; b < kins_[j].first + kins_[j].count; ++b)
                if (!folds(a, b) && contact_on_the_way(lines[a], lines[b]))
                    folding.push_back({a, b});
    }
    if (folding.empty()) return;
    if (vias_.empty()) vias_.assign(count * count, Via::none);
    const auto lead = [&](Via by) {
        for (const auto& [a, b] : folding) vias_[a * count + b] = vias_[b * count + a] = by;
    };
    lead(Via::mature);
    const auto is_simple = [&](const auto& pair) {
        std::vector<double> from(count, 0.0), to(count, 0.0);
        from[pair[0]] = to[pair[1]] = 1.0;
        return curved_way_is_simple(from, to);
    };
    // One kind of way for the whole pair: a mix of stages takes a mix of their ways.
    if (!folds(kins_[i].mature, kins_[j].mature) &&
        std::all_of(folding.begin(), folding.end(), is_simple))
        return;
    if (bud_.cap.empty()) bud_ = bud_of(nodes_);
    lead(Via::bud);
}

OutlineNodes MorphSet::nodes(std::span<const double> weights) const {
    OutlineNodes mix = unchecked(weights);
    if (for_any_weights_) return mix;
    for (int lod = 0; lod < static_cast<int>(details.size()); ++lod)
        if (const auto contact = contact_at_rest(polyline(mix, lod)))
            throw Impossible("mix", std::string("at these weights the outlines have no mean that "
                                                "does not touch itself, near the ") +
                                        name(curve_of(*contact, lod)));
    return mix;
}

CurveName MorphSet::curve_of(const Contact& contact, int lod) const {
    return sporeprint::curve_of(contact, places_->of(CurveName::stem, lod).size(),
                                places_->of(CurveName::hymenium, lod).size());
}

Certificate MorphSet::certificate() const {
    Certificate known;
    known.method = for_any_weights_ ? ProofMethod::certificate : ProofMethod::checked;
    if (!vias_.empty()) known.detour = 1.0;
    if (for_any_weights_ || known.detour > 0.0) return known;
    // Mixes of one age take only the two stages of each kin that are nearest to it.
    std::vector<double> ages = ages_;
    ages.insert(ages.end(), {0.0, 1.0});
    std::sort(ages.begin(), ages.end());
    for (std::size_t i = 0; i + 1 < ages.size(); ++i) {
        if (ages[i] == ages[i + 1]) continue;
        const auto growth = growth_weights(0.5 * (ages[i] + ages[i + 1]));
        std::vector<std::size_t> active;
        for (std::size_t s = 0; s < growth.size(); ++s)
            if (growth[s] > 0.0) active.push_back(s);
        if (!certified(active)) return known;
    }
    known.method = ProofMethod::certificate;
    return known;
}

Certificate MorphSet::certificate(std::span<const double> from, std::span<const double> to) const {
    Certificate known;
    const auto taken = [&](std::size_t s) { return from[s] > 0.0 || to[s] > 0.0; };
    for (std::size_t i = 0; i < from.size(); ++i)
        for (std::size_t j = 0; j < from.size(); ++j)
            if (taken(i) && taken(j) && via(i, j) != Via::none) known.detour = 1.0;
    const OutlineNodes a = unchecked(from), b = unchecked(to);
    if (known.detour == 0.0) {
        for (int lod = 0; lod < static_cast<int>(details.size()) && known.simple; ++lod)
            known.simple = !first_contact(polyline(a, lod), polyline(b, lod));
        return known;
    }
    known.method = ProofMethod::certificate;
    known.simple = curved_way_is_simple(from, to);
    return known;
}

/// The detoured weights of the mixes from one to another, each as a polynomial by its Bernstein coefficients.
std::vector<std::vector<double>> MorphSet::detoured_way(std::span<const double> from,
                                                        std::span<const double> to) const {
    using Polynomial = std::vector<double>;
    const auto product = [](const Polynomial& a, const Polynomial& b) {
        const auto choose = [](std::size_t n, std::size_t k) {
            double ways = 1.0;
            for (std::size_t i = 0; i < k; ++i)
                ways = ways * static_cast<double>(n - i) / static_cast<double>(i + 1);
            return ways;
        };
        const std::size_t m = a.size() - 1, n = b.size() - 1;
        Polynomial out(m + n + 1, 0.0);
        for (std::size_t i = 0; i <= m; ++i)
            for (std::size_t j = 0; j <= n; ++j)
                out[i + j] += choose(m, i) * choose(n, j) / choose(m + n, i + j) * a[i] * b[j];
        return out;
    };
    const auto raised = [&](const Polynomial& p, std::size_t degree) {
        return product(p, Polynomial(degree - p.size() + 2, 1.0));
    };
    std::vector<Polynomial> moved(from.size() + 1, Polynomial(way_degree + 1, 0.0));
    for (std::size_t s = 0; s < from.size(); ++s) moved[s] = raised({from[s], to[s]}, way_degree);
    const auto add = [&](std::size_t s, const Polynomial& what, double factor) {
        for (std::size_t i = 0; i < what.size(); ++i) moved[s][i] += factor * what[i];
    };
    for (std::size_t s = 0; s < from.size(); ++s) {
        if (from[s] == 0.0 && to[s] == 0.0) continue;
        Polynomial by_mature{0.0, 0.0}, by_bud{0.0, 0.0};
        for (std::size_t other = 0; other < from.size(); ++other) {
            const Via by = via(s, other);
            if (by == Via::none) continue;
            Polynomial& met = by == Via::mature ? by_mature : by_bud;
            met[0] += from[other];
            met[1] += to[other];
        }
        const Polynomial x{1.0 - by_mature[0] - by_bud[0], 1.0 - by_mature[1] - by_bud[1]};
        Polynomial rate{1.0 - 7.0 * x[0], 1.0 - 7.0 * x[1]};
        for (int i = 0; i < 6; ++i) {
            rate = product(x, rate);
            for (double& coefficient : rate) coefficient += 1.0;
        }
        rate = product(rate, {from[s], to[s]});
        for (const auto& [met, target] :
             {std::pair{by_mature, kins_[kin_of(s)].mature}, std::pair{by_bud, from.size()}}) {
            const Polynomial over = product(rate, met);
            add(s, over, -1.0);
            add(target, over, 1.0);
        }
    }
    return moved;
}

/// Detours make the way from one mix to another a curve; each piece of it lies among the means of the piece's Bezier polygons.
bool MorphSet::curved_way_is_simple(std::span<const double> from,
                                    std::span<const double> to) const {
    std::vector<Polyline> shapes(nodes_.size() + (bud_.cap.empty() ? 0 : 1));
    std::vector<Polyline> bezier(way_degree + 1);
    const auto is_simple = [&](const auto& self, double t0, double t1, int depth) -> bool {
        const auto way = detoured_way(between(from, to, t0), between(from, to, t1));
        for (std::size_t i = 0; i < bezier.size(); ++i) {
            bezier[i].assign(shapes.front().size(), glm::dvec2(0.0));
            for (std::size_t s = 0; s < shapes.size(); ++s)
                if (way[s][i] != 0.0)
                    for (std::size_t p = 0; p < bezier[i].size(); ++p)
                        bezier[i][p] += way[s][i] * shapes[s][p];
        }
        if (!first_doubt(bezier)) return true;
        if (depth == deepest_piece || contact_at_rest(bezier.front()) ||
            contact_at_rest(bezier.back()))
            return false;
        const double middle = 0.5 * (t0 + t1);
        return self(self, t0, middle, depth + 1) && self(self, middle, t1, depth + 1);
    };
    for (int lod = 0; lod < static_cast<int>(details.size()); ++lod) {
        for (std::size_t s = 0; s < shapes.size(); ++s) shapes[s] = polyline(shape(s), lod);
        if (!is_simple(is_simple, 0.0, 1.0, 0)) return false;
    }
    return true;
}

std::vector<double> MorphSet::growth_weights(double age) const {
    std::vector<double> weights;
    for (const Kin& kin : kins_) {
        const auto own = stage_weights({ages_.data() + kin.first, kin.count}, age);
        weights.insert(weights.end(), own.begin(), own.end());
    }
    return weights;
}

std::vector<Arc> MorphSet::arcs(double age, int count) const {
    std::vector<Arc> arcs;
    if (kins_.size() != 2) return arcs;
    const std::vector<double> growth = growth_weights(age);
    std::array<OutlineNodes, 2> own;
    for (std::size_t k = 0; k < 2; ++k) {
        std::vector<double> weights(growth.size(), 0.0);
        std::copy_n(growth.begin() + static_cast<std::ptrdiff_t>(kins_[k].first), kins_[k].count,
                    weights.begin() + static_cast<std::ptrdiff_t>(kins_[k].first));
        own[k] = nodes(weights);
    }
    std::vector<double> u;
    for (int i = 0; i <= count + 1; ++i) u.push_back(static_cast<double>(i) / (count + 1));
    const Outline a(own[0], places_), b(own[1], places_);
    for (const CurveName curve : curve_names) {
        if (a.of(curve).empty() || a.of(curve).length() == 0.0 || b.of(curve).length() == 0.0)
            continue;
        const auto on_a = a.of(curve).placed(u), on_b = b.of(curve).placed(u);
        for (std::size_t i = 1; i + 1 < u.size(); ++i)
            arcs.push_back({curve, on_a[i].share, on_b[i].share});
    }
    return arcs;
}

std::size_t MorphSet::bytes() const {
    std::size_t bytes = sizeof(MorphSet) + sizeof(RingPlaces) + vias_.size() * sizeof(Via);
    for (std::size_t s = 0; s <= nodes_.size(); ++s)
        for (const CurveName curve : curve_names)
            bytes += shape(s).of(curve).size() * sizeof(OutlineNode);
    for (const auto& lod : places_->by_lod)
        for (const auto& u : lod) bytes += u.size() * sizeof(double);
    return bytes + ages_.size() * (sizeof(double) + sizeof(OutlineNodes)) +
           kins_.size() * sizeof(Kin);
}

}  // namespace sporeprint
