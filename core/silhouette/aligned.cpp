#include "core/silhouette/aligned.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "core/math/elementary.h"
#include "core/problems.h"
#include "core/silhouette/correspondence.h"

namespace sporeprint {

namespace {

constexpr std::array<std::size_t, 3> node_counts = {45, 41, 49};
constexpr int measure_steps = 128, need_smoothings = 4;
constexpr double mature_age = 0.6;
constexpr double least_base = 1e-3;  // of the stem's length; a shorter base is ignored
// Stems bend with their axis even where their outline is straight.
constexpr double stem_evenness = 3.0;

using Curves = std::array<SubCurve, 3>;

std::size_t index(CurveName curve) { return static_cast<std::size_t>(curve); }

/// The arc-length table of a blend of several stages over the mature stage's shares; it converts
/// shares in both directions.
class BlendedLength {
  public:
    /// A curve with its map from the mature stage's shares and its weight.
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

    /// Returns the mature stage's share at a share of the blend's length.
    [[nodiscard]] double mature_share(double share) const {
        const double target = share * lengths_.back();
        const auto above = std::upper_bound(lengths_.begin() + 1, lengths_.end() - 1, target);
        const double from = *(above - 1), to = *above;
        const double t = to > from ? std::clamp((target - from) / (to - from), 0.0, 1.0) : 0.0;
        return (static_cast<double>(above - 1 - lengths_.begin()) + t) / measure_steps;
    }

    /// Returns the share of the blend's length at a mature share.
    [[nodiscard]] double share(double mature) const {
        const double place = std::clamp(mature, 0.0, 1.0) * measure_steps;
        const auto i = std::min(static_cast<std::size_t>(place), lengths_.size() - 2);
        const double t = place - static_cast<double>(i);
        return (lengths_[i] + t * (lengths_[i + 1] - lengths_[i])) / lengths_.back();
    }

  private:
    std::vector<double> lengths_;
};

/// Throws Impossible for arcs that leave their curve or cross one another.
void check_arcs(std::span<const Arc> arcs, std::size_t species_count,
                const std::array<bool, 3>& in_both) {
    std::vector<Problem> problems;
    const auto path = [](std::size_t i) { return "/arcs/" + std::to_string(i); };
    for (std::size_t i = 0; i < arcs.size(); ++i) {
        const Arc& arc = arcs[i];
        if (species_count != 2) {
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

/// Returns the share of a stem's length at which its tangent first rises at 45 degrees: where it
/// leaves the ground.
std::optional<double> base_share(const SubCurve& stem) {
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

/// Makes the bases of two stems correspond, however wide or thin they are, unless the designer's
/// arcs contradict.
std::vector<Landmark> with_base_landmarks(std::vector<Landmark> landmarks, const SubCurve& a,
                                          const SubCurve& b) {
    const auto base_a = base_share(a), base_b = base_share(b);
    if (!base_a || !base_b || *base_a < least_base || *base_b < least_base) return landmarks;
    for (const Landmark& landmark : landmarks)
        if (landmark.a <= *base_a || landmark.b <= *base_b) return landmarks;
    landmarks.insert(landmarks.begin(), {*base_a, *base_b});
    return landmarks;
}

/// Returns measure_steps + 1 shares of the hub, 0 to 1, at even steps of the mean of their images
/// under all maps, so that no curve is undersampled.
std::vector<double> evenly_mapped_shares(const std::vector<const ShareMap*>& from_hub) {
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

/// Returns the distance in y from the lowest control point to the highest.
double height(const Silhouette& silhouette) {
    double low = silhouette.stem.front().y, high = low;
    for (const auto* part : {&silhouette.stem, &silhouette.hymenium, &silhouette.cap})
        for (const OutlinePoint& p : *part) {
            low = std::min(low, p.y);
            high = std::max(high, p.y);
        }
    return std::max(high - low, 1e-9);
}

/// Keeps both sides of every smooth join collinear in every mix: the ratio of their speeds is made
/// equal in all shapes.
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

/// Puts the sub-curves of one name of all shapes on the common parameter.
class Aligner {
  public:
    Aligner(const std::vector<ControlShape>& shapes, const std::vector<Curves>& curves,
            const std::vector<double>& heights, CurveName name, AlignedShapes& out)
        : shapes_(shapes), curves_(curves), heights_(heights), name_(name), out_(out) {}

    /// Appends the nodes of this sub-curve to all shapes, or none if no shape has it.
    void align(std::span<const Arc> arcs, double arcs_age) {
        match_stages();
        const auto hub =
            std::find_if(out_.species.begin(), out_.species.end(),
                         [&](const SpeciesRange& range) { return !curve(range.mature).empty(); });
        if (hub == out_.species.end()) return;
        match_species(*hub, landmarks(arcs, arcs_age));
        place_nodes(common_parameter());
    }

  private:
    [[nodiscard]] const SubCurve& curve(std::size_t shape) const {
        return curves_[shape][index(name_)];
    }

    /// Maps every stage to the mature one of its species by the control points of the author.
    void match_stages() {
        from_mature_.resize(shapes_.size());
        for (const SpeciesRange& range : out_.species) {
            const auto mature = curve(range.mature).segment_shares();
            for (std::size_t s = range.first; s < range.first + range.count; ++s) {
                if (curve(s).empty() != curve(range.mature).empty() ||
                    curve(s).segment_shares().size() != mature.size())
                    throw InvalidInput("/stages",
                                       "stages of one species differ in the number of "
                                       "control points of the " +
                                           std::string(sporeprint::name(name_)));
                if (s != range.mature && !mature.empty())
                    from_mature_[s] = ShareMap(mature, curve(s).segment_shares());
            }
        }
    }

    /// Returns the designer's arcs on this sub-curve in shares of the mature stages.
    [[nodiscard]] std::vector<Landmark> landmarks(std::span<const Arc> arcs, double age) const {
        const auto own_length = [&](const SpeciesRange& range) {
            const auto weights = stage_weights({out_.ages.data() + range.first, range.count}, age);
            std::vector<BlendedLength::Stage> stages;
            for (std::size_t k = 0; k < range.count; ++k)
                stages.push_back(
                    {&curve(range.first + k), &from_mature_[range.first + k], weights[k]});
            return BlendedLength(stages);
        };
        std::vector<Landmark> landmarks;
        for (const Arc& arc : arcs)
            if (arc.curve == name_)
                landmarks.push_back({own_length(out_.species[0]).mature_share(arc.a),
                                     own_length(out_.species[1]).mature_share(arc.b)});
        std::sort(landmarks.begin(), landmarks.end(),
                  [](const Landmark& x, const Landmark& y) { return x.a < y.a; });
        landmarks.erase(  // the same arc twice
            std::unique(landmarks.begin(), landmarks.end(),
                        [](const Landmark& x, const Landmark& y) { return x.a == y.a; }),
            landmarks.end());
        return landmarks;
    }

    /// Maps every species to the hub.
    void match_species(const SpeciesRange& hub, const std::vector<Landmark>& landmarks) {
        from_hub_.resize(out_.species.size());
        for (std::size_t k = 0; k < out_.species.size(); ++k) {
            const SpeciesRange& range = out_.species[k];
            if (&range == &hub || curve(range.mature).empty()) continue;
            from_hub_[k] = correspondence(
                curve(hub.mature), curve(range.mature),
                name_ == CurveName::stem
                    ? with_base_landmarks(landmarks, curve(hub.mature), curve(range.mature))
                    : landmarks);
        }
    }

    /// Returns the hub's shares at the nodes. The common parameter u is even in the need of the
    /// shapes: in length and turning, so that thin margins stay round, and in the root of their
    /// product, to which the error of a chord is proportional. That root is relative to the height
    /// of each shape, so that wide flat shapes get more nodes. Fourth powers give the greatest need
    /// the most weight.
    [[nodiscard]] std::vector<double> common_parameter() const {
        std::vector<const ShareMap*> present;
        for (std::size_t k = 0; k < out_.species.size(); ++k)
            if (!curve(out_.species[k].mature).empty()) present.push_back(&from_hub_[k]);
        const std::vector<double> places = evenly_mapped_shares(present);
        std::vector<double> measures{0.0};
        for (const double need : needs(places)) measures.push_back(measures.back() + need);
        for (double& measure : measures) measure /= measures.back();
        measures.back() = 1.0;
        const std::size_t count = node_counts[index(name_)];
        std::vector<double> shares;
        std::size_t k = 1;
        for (std::size_t i = 0; i < count; ++i) {
            const double u = static_cast<double>(i) / static_cast<double>(count - 1);
            while (k + 1 < measures.size() && measures[k] < u) ++k;
            const double t = (u - measures[k - 1]) / (measures[k] - measures[k - 1]);
            shares.push_back(places[k - 1] + t * (places[k] - places[k - 1]));
        }
        shares.front() = 0.0;
        shares.back() = 1.0;
        return shares;
    }

    /// Returns how much of the common parameter each step between two samples of the hub needs.
    [[nodiscard]] std::vector<double> needs(const std::vector<double>& places) const {
        std::vector<std::vector<double>> roots(shapes_.size()), plain(shapes_.size());
        const double evenness = name_ == CurveName::stem ? stem_evenness : 1.0;
        double most_roots = 1e-9;
        for (std::size_t s = 0; s < shapes_.size(); ++s) {
            if (curve(s).empty()) continue;
            double share = 0.0, turning = 0.0, sum = 0.0;
            const double total_turning = std::max(curve(s).turning(1.0), 1e-9);
            const double scale = std::sqrt(curve(s).length() / heights_[s]);
            for (int i = 1; i <= measure_steps; ++i) {
                const double place = places[static_cast<std::size_t>(i)];
                const double next =
                    from_mature_[s](from_hub_[shapes_[s].species_index](place).at).at;
                const double next_turning = curve(s).turning(next);
                const double length = next - share, turn = next_turning - turning;
                plain[s].push_back(evenness * length + turn / total_turning);
                roots[s].push_back(scale * std::sqrt(length * turn));
                sum += roots[s].back();
                share = next;
                turning = next_turning;
            }
            most_roots = std::max(most_roots, sum);
        }
        std::vector<double> needs(measure_steps, 0.0);
        for (std::size_t s = 0; s < shapes_.size(); ++s)
            for (std::size_t i = 0; i < roots[s].size(); ++i) {
                const double need = plain[s][i] + 4.0 * roots[s][i] / most_roots;
                needs[i] += need * need * need * need;
            }
        for (double& need : needs) need = std::sqrt(std::sqrt(need));
        // Smoothing keeps the speed of u nearly constant between two nodes.
        for (int pass = 0; pass < need_smoothings; ++pass) {
            double before = needs.front();
            for (std::size_t i = 0; i + 1 < needs.size(); ++i) {
                const double here = needs[i];
                needs[i] = 0.25 * before + 0.5 * here + 0.25 * needs[i + 1];
                before = here;
            }
        }
        return needs;
    }

    void place_nodes(const std::vector<double>& hub_shares) {
        const std::size_t count = hub_shares.size();
        std::vector<double> u;
        for (std::size_t i = 0; i < count; ++i)
            u.push_back(static_cast<double>(i) / static_cast<double>(count - 1));
        // The slope is unbounded: a bound would give short steps a speed that they do not have.
        const ShareMap hub_from_u(u, hub_shares, std::numeric_limits<double>::infinity());
        for (std::size_t s = 0; s < shapes_.size(); ++s) {
            const ControlShape& shape = shapes_[s];
            std::vector<OutlineNode>& nodes = out_.nodes[s].of(name_);
            if (curve(s).empty()) {
                const OutlinePoint& p = shape.silhouette.stem.back();
                nodes.assign(count, {glm::dvec2(p.r, p.y) / shape.size, {0.0, 0.0}});
                continue;
            }
            for (const double place : u) {
                const auto on_hub = hub_from_u(place);
                const auto on_mature = from_hub_[shape.species_index](on_hub.at);
                const auto on_shape = from_mature_[s](on_mature.at);
                const OutlineSample sample = curve(s).at(on_shape.at);
                const double speed =
                    curve(s).length() * on_shape.slope * on_mature.slope * on_hub.slope;
                nodes.push_back(
                    {glm::dvec2(sample.r, sample.y) / shape.size,
                     glm::dvec2(sample.tangent_r, sample.tangent_y) * (speed / shape.size)});
            }
            const auto snap = [&](OutlineNode& node, const OutlinePoint& p) {
                node.position = glm::dvec2(p.r, p.y) / shape.size;
            };
            const Silhouette& silhouette = shape.silhouette;
            const auto& points = name_ == CurveName::stem       ? silhouette.stem
                                 : name_ == CurveName::hymenium ? silhouette.hymenium
                                                                : silhouette.cap;
            snap(nodes.front(), points.front());
            snap(nodes.back(), points.back());
        }
    }

    const std::vector<ControlShape>& shapes_;
    const std::vector<Curves>& curves_;
    const std::vector<double>& heights_;
    CurveName name_;
    AlignedShapes& out_;
    std::vector<ShareMap> from_mature_, from_hub_;  // per shape, per species
};

}  // namespace

AlignedShapes aligned(const std::vector<ControlShape>& shapes, std::span<const Arc> arcs,
                      double arcs_age) {
    AlignedShapes out;
    std::vector<Curves> curves;
    std::vector<double> heights;
    for (const ControlShape& shape : shapes) {
        Outline outline = Outline::unproven(shape.silhouette);
        curves.push_back(
            {std::move(outline.stem), std::move(outline.hymenium), std::move(outline.cap)});
        heights.push_back(height(shape.silhouette));
        if (shape.species_index == out.species.size())
            out.species.push_back({out.ages.size(), 0, out.ages.size()});
        SpeciesRange& range = out.species.back();
        assert(shape.species_index + 1 == out.species.size());
        if (std::abs(shape.age - mature_age) < std::abs(shapes[range.mature].age - mature_age))
            range.mature = out.ages.size();
        ++range.count;
        out.ages.push_back(shape.age);
    }
    if (!arcs.empty()) {
        std::array<bool, 3> in_both{};
        for (std::size_t c = 0; c < 3; ++c)
            in_both[c] = out.species.size() == 2 && !curves[out.species[0].mature][c].empty() &&
                         !curves[out.species[1].mature][c].empty();
        check_arcs(arcs, out.species.size(), in_both);
    }
    out.nodes.resize(shapes.size());
    for (const CurveName curve : curve_names)
        Aligner(shapes, curves, heights, curve, out).align(arcs, arcs_age);
    align_joins(out.nodes, shapes);
    return out;
}

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

}  // namespace sporeprint
