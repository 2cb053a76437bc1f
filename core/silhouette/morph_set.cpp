#include "core/silhouette/morph_set.h"

#include <algorithm>
#include <cassert>
#include <string>
#include <utility>

#include "core/problems.h"
#include "core/silhouette/intermediate_shape.h"

namespace sporeprint {

namespace {

constexpr int deepest_piece = 9;
// of the path from a mix to the intermediate shape
constexpr int intermediate_steps = 4096, coarse_steps = 32;

std::vector<double> between(std::span<const double> from, std::span<const double> to, double t) {
    std::vector<double> weights(from.size());
    for (std::size_t s = 0; s < weights.size(); ++s) weights[s] = (1.0 - t) * from[s] + t * to[s];
    return weights;
}

/// Adds a weighted shape to a sum of shapes.
void add(Polyline& sum, double weight, const Polyline& shape) {
    if (weight == 0.0) return;
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += weight * shape[i];
}

OutlineNodes blended(const OutlineNodes& from, const OutlineNodes& to, double t) {
    OutlineNodes out = from;
    for (const CurveName curve : curve_names)
        for (std::size_t i = 0; i < out.of(curve).size(); ++i) {
            OutlineNode& node = out.of(curve)[i];
            const OutlineNode& end = to.of(curve)[i];
            node.position += t * (end.position - node.position);
            node.velocity += t * (end.velocity - node.velocity);
        }
    return out;
}

}  // namespace

Polyline polyline(const Outline& outline, DetailLevel level) {
    Polyline line;
    for (const CurveName curve : curve_names) {
        const auto rings = outline.rings(curve, level);
        for (std::size_t i = line.empty() ? 0 : 1; i < rings.size(); ++i)
            line.emplace_back(rings[i].r, rings[i].y);
    }
    return line;
}

CurveName curve_of(const Intersection& intersection, std::size_t stem_rings,
                   std::size_t hymenium_rings) {
    std::size_t vertex = intersection.j == intersection.i ? intersection.i : intersection.j + 1;
    if (vertex < stem_rings) return CurveName::stem;
    if (stem_rings > 0) vertex -= stem_rings - 1;  // joins are counted once
    return vertex < hymenium_rings ? CurveName::hymenium : CurveName::cap;
}

MorphSet::MorphSet(const std::vector<ControlShape>& shapes, std::span<const Arc> arcs,
                   double arcs_age)
    : MorphSet(shapes, aligned(shapes, arcs, arcs_age)) {}

MorphSet::MorphSet(const std::vector<ControlShape>& shapes, AlignedShapes common)
    : species_(std::move(common.species)),
      indirect_paths_(species_),
      ages_(std::move(common.ages)),
      nodes_(std::move(common.nodes)) {
    const Lines own = lines();
    for (std::size_t s = 0; s < shapes.size(); ++s) {
        const Outline outline(nodes_[s]);
        for (int lod = 0; lod < static_cast<int>(details.size()); ++lod) {
            auto intersection = static_intersection(own[static_cast<std::size_t>(lod)][s]);
            if (!intersection)
                intersection = static_intersection(sporeprint::polyline(outline, lod));
            if (intersection) {
                (void)Outline(shapes[s].silhouette);  // reports the control points if it can
                const std::string curve = name(curve_of(*intersection, lod));
                throw Impossible("/model/silhouette/" + curve,
                                 "too fine for the rings of level of detail " +
                                     std::to_string(lod) + ": there the " + curve +
                                     " touches itself, its neighbour or the axis");
            }
        }
    }
    certify(own);
}

OutlineNodes MorphSet::unchecked(std::span<const double> weights) const {
    assert(weights.size() == nodes_.size());
    const std::vector<double> effective_weights = indirect_paths_.effective_weights(weights);
    OutlineNodes mix;
    for (const CurveName curve : curve_names) {
        std::vector<OutlineNode>& nodes = mix.of(curve);
        nodes.resize(nodes_.front().of(curve).size());
        for (std::size_t s = 0; s < effective_weights.size(); ++s) {
            if (effective_weights[s] == 0.0) continue;
            const std::vector<OutlineNode>& own = shape(s).of(curve);
            for (std::size_t i = 0; i < nodes.size(); ++i) {
                nodes[i].position += effective_weights[s] * own[i].position;
                nodes[i].velocity += effective_weights[s] * own[i].velocity;
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
        const int rings = ring_count(curve, lod);
        for (int i = 1; i + 1 < rings; ++i) {
            const double place = last * i / (rings - 1);
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

MorphSet::Lines MorphSet::lines() const {
    Lines lines;
    for (std::size_t lod = 0; lod < lines.size(); ++lod)
        for (std::size_t s = 0; s < nodes_.size() + (intermediate_.cap.empty() ? 0 : 1); ++s)
            lines[lod].push_back(polyline(shape(s), static_cast<int>(lod)));
    return lines;
}

/// Returns true if a certificate covers all mixes of some shapes at every level of detail.
bool MorphSet::certified(std::span<const std::size_t> shapes) const {
    for (int lod = static_cast<int>(details.size()) - 1; lod >= 0; --lod) {  // cheapest first
        std::vector<Polyline> lines;
        for (const std::size_t s : shapes) lines.push_back(polyline(nodes_[s], lod));
        if (first_unproven_pair(lines)) return false;
    }
    return true;
}

void MorphSet::certify(const Lines& lines) {
    certified_for_all_weights_ = std::none_of(lines.rbegin(), lines.rend(), first_unproven_pair);
    for (std::size_t i = 0; i < species_.size() && !certified_for_all_weights_; ++i)
        for (std::size_t j = i + 1; j < species_.size(); ++j) choose_indirect_paths(lines, i, j);
}

/// Returns the pairs of stages of two species whose linear interpolation self-intersects. Coarse
/// levels of detail are cheap and come first: pairs found there are not tested again.
std::vector<MorphSet::PathEnds> MorphSet::crossing_paths(const Lines& lines, const SpeciesRange& i,
                                                         const SpeciesRange& j) const {
    std::vector<PathEnds> crossing_pairs;
    for (auto lod = lines.rbegin(); lod != lines.rend(); ++lod)
        for (std::size_t a = i.first; a < i.first + i.count; ++a)
            for (std::size_t b = j.first; b < j.first + j.count; ++b)
                if (std::find(crossing_pairs.begin(), crossing_pairs.end(), PathEnds{a, b}) ==
                        crossing_pairs.end() &&
                    intersection_between((*lod)[a], (*lod)[b]))
                    crossing_pairs.push_back({a, b});
    return crossing_pairs;
}

/// Finds the linear interpolations between stages of two species that self-intersect and replaces
/// them via indirect paths.
void MorphSet::choose_indirect_paths(const Lines& lines, std::size_t i, std::size_t j) {
    const std::vector<PathEnds> crossing_pairs = crossing_paths(lines, species_[i], species_[j]);
    if (crossing_pairs.empty()) return;
    const auto route = [&](Via via) {
        for (const auto& [a, b] : crossing_pairs) indirect_paths_.route(a, b, via);
    };
    // One kind of path serves the whole pair, because a mix of stages follows a mix of their paths.
    route(Via::mature);
    const PathEnds mature = {species_[i].mature, species_[j].mature};
    if (std::find(crossing_pairs.begin(), crossing_pairs.end(), mature) == crossing_pairs.end() &&
        curved_paths_are_simple(lines, crossing_pairs))
        return;
    if (intermediate_.cap.empty()) intermediate_ = intermediate_shape(nodes_);
    route(Via::intermediate);
}

/// Returns true if the paths between some stages stay simple. The midpoints are tested first: a
/// path that self-intersects mostly does so there, which saves the proofs of the other pieces.
bool MorphSet::curved_paths_are_simple(const Lines& lines, std::span<const PathEnds> paths) const {
    std::vector<double> from(nodes_.size()), to(nodes_.size());
    const auto all = [&](const auto& is_simple) {
        for (auto lod = lines.rbegin(); lod != lines.rend(); ++lod)
            for (const auto& [a, b] : paths) {
                from[a] = to[b] = 1.0;
                const bool simple = is_simple(*lod);
                from[a] = to[b] = 0.0;
                if (!simple) return false;
            }
        return true;
    };
    return all([&](const auto& shapes) {
               return !curved_path_intersects_at_midpoint(shapes, from, to);
           }) &&
           all([&](const auto& shapes) { return curved_path_is_simple(shapes, from, to); });
}

OutlineNodes MorphSet::nodes(std::span<const double> weights) const {
    OutlineNodes mix = unchecked(weights);
    if ((certified_for_all_weights_ || uniform_polylines_are_simple(mix)) &&
        swept_polylines_are_simple(mix))
        return mix;
    const auto is_simple = [this](const OutlineNodes& nodes) {
        return uniform_polylines_are_simple(nodes) && swept_polylines_are_simple(nodes);
    };
    // The least simple step is used: it is zero where the mix begins to self-intersect, so that the
    // result is continuous in the weights.
    const OutlineNodes intermediate =
        intermediate_.cap.empty() ? intermediate_shape(nodes_) : intermediate_;
    const auto towards = [&](int steps) {
        return blended(mix, intermediate, static_cast<double>(steps) / intermediate_steps);
    };
    int above = intermediate_steps / coarse_steps;
    while (above < intermediate_steps && !is_simple(towards(above)))
        above += intermediate_steps / coarse_steps;
    int below = above - intermediate_steps / coarse_steps;
    while (above - below > 1) {
        const int middle = (above + below) / 2;
        (is_simple(towards(middle)) ? above : below) = middle;
    }
    return towards(above);
}

bool MorphSet::uniform_polylines_are_simple(const OutlineNodes& nodes) const {
    for (int lod = 0; lod < static_cast<int>(details.size()); ++lod)
        if (static_intersection(polyline(nodes, lod))) return false;
    return true;
}

bool MorphSet::swept_polylines_are_simple(const OutlineNodes& nodes) const {
    const Outline outline(nodes);
    for (int lod = 0; lod < static_cast<int>(details.size()); ++lod)
        if (static_intersection(sporeprint::polyline(outline, lod))) return false;
    return true;
}

CurveName MorphSet::curve_of(const Intersection& intersection, int lod) const {
    const auto rings = [&](CurveName curve) {
        return nodes_.front().of(curve).empty() ? 0
                                                : static_cast<std::size_t>(ring_count(curve, lod));
    };
    return sporeprint::curve_of(intersection, rings(CurveName::stem), rings(CurveName::hymenium));
}

Certificate MorphSet::certificate() const {
    Certificate known;
    known.method = certified_for_all_weights_ ? ProofMethod::certificate : ProofMethod::checked;
    if (!indirect_paths_.none()) known.indirect = 1.0;
    if (certified_for_all_weights_ || known.indirect > 0.0) return known;
    // Mixes of one age use only the two stages of each species that are nearest to it.
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
            if (taken(i) && taken(j) && indirect_paths_.via(i, j) != Via::none)
                known.indirect = 1.0;
    const OutlineNodes a = unchecked(from), b = unchecked(to);
    if (known.indirect == 0.0) {
        for (int lod = 0; lod < static_cast<int>(details.size()) && known.simple; ++lod)
            known.simple = !first_intersection(polyline(a, lod), polyline(b, lod));
        return known;
    }
    known.method = ProofMethod::certificate;
    const Lines own = lines();
    known.simple = std::all_of(own.rbegin(), own.rend(), [&](const std::vector<Polyline>& shapes) {
        return curved_path_is_simple(shapes, from, to);
    });
    return known;
}

/// Returns true if the path self-intersects at its midpoint; shapes as in curved_path_is_simple().
bool MorphSet::curved_path_intersects_at_midpoint(const std::vector<Polyline>& shapes,
                                                  std::span<const double> from,
                                                  std::span<const double> to) const {
    const std::vector<double> weights = indirect_paths_.effective_weights(between(from, to, 0.5));
    Polyline line(shapes.front().size(), glm::dvec2(0.0));
    for (std::size_t s = 0; s < shapes.size(); ++s) add(line, weights[s], shapes[s]);
    return static_intersection(line).has_value();
}

/// Returns true if an indirect path from one mix to another stays simple. The path is a polynomial
/// curve; each piece of it lies in the convex hull of the piece's Bezier control polygons. Those of
/// a part of a piece are means of the piece's own, so that only its unproven pairs are tested
/// again.
///
/// shapes  the polylines of all shapes at one level of detail; the intermediate shape's may be left
///         out where no path passes through it
bool MorphSet::curved_path_is_simple(const std::vector<Polyline>& shapes,
                                     std::span<const double> from,
                                     std::span<const double> to) const {
    std::vector<Polyline> bezier(IndirectPaths::path_degree + 1);
    const auto take_piece = [&](double t0, double t1) {
        const auto path =
            indirect_paths_.effective_weights(between(from, to, t0), between(from, to, t1));
        for (std::size_t i = 0; i < bezier.size(); ++i) {
            bezier[i].assign(shapes.front().size(), glm::dvec2(0.0));
            for (std::size_t s = 0; s < shapes.size(); ++s) add(bezier[i], path[s][i], shapes[s]);
        }
    };
    // An indirect path is too long to be certified at once, so it starts with its halves.
    const auto parts_are_simple = [&](const auto& self, double t0, double t1, int depth,
                                      const std::vector<UnprovenPair>& known) -> bool {
        if (depth == deepest_piece) return false;
        const double middle = 0.5 * (t0 + t1);
        for (const auto& [start, end] : {std::pair{t0, middle}, std::pair{middle, t1}}) {
            take_piece(start, end);
            const std::vector<UnprovenPair> left =
                depth == 0 ? unproven_pairs(bezier) : unproven_pairs(bezier, known);
            if (!left.empty() && !self(self, start, end, depth + 1, left)) return false;
        }
        return true;
    };
    return parts_are_simple(parts_are_simple, 0.0, 1.0, 0, {});
}

std::vector<double> MorphSet::growth_weights(double age) const {
    std::vector<double> weights;
    for (const SpeciesRange& range : species_) {
        const auto own = stage_weights({ages_.data() + range.first, range.count}, age);
        weights.insert(weights.end(), own.begin(), own.end());
    }
    return weights;
}

std::vector<Arc> MorphSet::arcs(double age, int count) const {
    std::vector<Arc> arcs;
    if (species_.size() != 2) return arcs;
    const std::vector<double> growth = growth_weights(age);
    std::array<OutlineNodes, 2> own;
    for (std::size_t k = 0; k < 2; ++k) {
        std::vector<double> weights(growth.size(), 0.0);
        std::copy_n(growth.begin() + static_cast<std::ptrdiff_t>(species_[k].first),
                    species_[k].count,
                    weights.begin() + static_cast<std::ptrdiff_t>(species_[k].first));
        own[k] = nodes(weights);
    }
    std::vector<double> u;
    for (int i = 0; i <= count + 1; ++i) u.push_back(static_cast<double>(i) / (count + 1));
    const Outline a(own[0]), b(own[1]);
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
    std::size_t bytes = sizeof(MorphSet) + indirect_paths_.bytes();
    for (std::size_t s = 0; s <= nodes_.size(); ++s)
        for (const CurveName curve : curve_names)
            bytes += shape(s).of(curve).size() * sizeof(OutlineNode);
    return bytes + ages_.size() * (sizeof(double) + sizeof(OutlineNodes)) +
           species_.size() * sizeof(SpeciesRange);
}

}  // namespace sporeprint
