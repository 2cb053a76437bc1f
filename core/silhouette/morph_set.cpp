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
constexpr int bud_steps = 4096, coarse_steps = 32;  // of the way from a mix to the bud

std::vector<double> between(std::span<const double> from, std::span<const double> to, double t) {
    std::vector<double> weights(from.size());
    for (std::size_t s = 0; s < weights.size(); ++s) weights[s] = (1.0 - t) * from[s] + t * to[s];
    return weights;
}

/// Adds a shape with its weight to a sum of shapes.
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

MorphSet::MorphSet(const std::vector<ControlShape>& shapes, std::span<const Arc> arcs,
                   double arcs_age)
    : MorphSet(shapes, aligned(shapes, arcs, arcs_age)) {}

MorphSet::MorphSet(const std::vector<ControlShape>& shapes, AlignedShapes common)
    : kins_(std::move(common.kins)),
      detours_(kins_),
      ages_(std::move(common.ages)),
      nodes_(std::move(common.nodes)) {
    const Lines own = lines();
    for (std::size_t s = 0; s < shapes.size(); ++s) {
        const Outline outline(nodes_[s]);
        for (int lod = 0; lod < static_cast<int>(details.size()); ++lod) {
            auto contact = contact_at_rest(own[static_cast<std::size_t>(lod)][s]);
            if (!contact) contact = contact_at_rest(sporeprint::polyline(outline, lod));
            if (contact) {
                (void)Outline(shapes[s].silhouette);  // names the control points if it can
                const std::string curve = name(curve_of(*contact, lod));
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
    const std::vector<double> moved = detours_.moved(weights);
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
        for (std::size_t s = 0; s < nodes_.size() + (bud_.cap.empty() ? 0 : 1); ++s)
            lines[lod].push_back(polyline(shape(s), static_cast<int>(lod)));
    return lines;
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

void MorphSet::certify(const Lines& lines) {
    for_any_weights_ = std::none_of(lines.rbegin(), lines.rend(), first_doubt);
    for (std::size_t i = 0; i < kins_.size() && !for_any_weights_; ++i)
        for (std::size_t j = i + 1; j < kins_.size(); ++j) choose_detours(lines, i, j);
}

/// The stages of two kin whose straight way folds. Coarse levels of detail are cheap and come first: what folds there needs no second
/// look.
std::vector<MorphSet::Way> MorphSet::folding(const Lines& lines, const Kin& i, const Kin& j) const {
    std::vector<Way> folding;
    for (auto lod = lines.rbegin(); lod != lines.rend(); ++lod)
        for (std::size_t a = i.first; a < i.first + i.count; ++a)
            for (std::size_t b = j.first; b < j.first + j.count; ++b)
                if (std::find(folding.begin(), folding.end(), Way{a, b}) == folding.end() &&
                    contact_on_the_way((*lod)[a], (*lod)[b]))
                    folding.push_back({a, b});
    return folding;
}

/// Finds the straight ways between stages of two kin that fold, and gives them a detour.
void MorphSet::choose_detours(const Lines& lines, std::size_t i, std::size_t j) {
    const std::vector<Way> folding = this->folding(lines, kins_[i], kins_[j]);
    if (folding.empty()) return;
    const auto lead = [&](Via by) {
        for (const auto& [a, b] : folding) detours_.lead(a, b, by);
    };
    // One kind of way for the whole pair: a mix of stages takes a mix of their ways.
    lead(Via::mature);
    const Way mature = {kins_[i].mature, kins_[j].mature};
    if (std::find(folding.begin(), folding.end(), mature) == folding.end() &&
        curved_ways_are_simple(lines, folding))
        return;
    if (bud_.cap.empty()) bud_ = bud_of(nodes_);
    lead(Via::bud);
}

/// Whether the ways between some stages stay simple. A look at each half way comes first: where a way folds it mostly shows there, and
/// proofs would be made in vain of all that is before it.
bool MorphSet::curved_ways_are_simple(const Lines& lines, std::span<const Way> ways) const {
    std::vector<double> from(nodes_.size()), to(nodes_.size());
    const auto all = [&](const auto& is_simple) {
        for (auto lod = lines.rbegin(); lod != lines.rend(); ++lod)
            for (const auto& [a, b] : ways) {
                from[a] = to[b] = 1.0;
                const bool simple = is_simple(*lod);
                from[a] = to[b] = 0.0;
                if (!simple) return false;
            }
        return true;
    };
    return all([&](const auto& shapes) {
               return !curved_way_touches_half_way(shapes, from, to);
           }) &&
           all([&](const auto& shapes) { return curved_way_is_simple(shapes, from, to); });
}

OutlineNodes MorphSet::nodes(std::span<const double> weights) const {
    OutlineNodes mix = unchecked(weights);
    if ((for_any_weights_ || moves_simply(mix)) && is_swept_simply(mix)) return mix;
    const auto is_simple = [this](const OutlineNodes& nodes) {
        return moves_simply(nodes) && is_swept_simply(nodes);
    };
    // The least that is simple: nothing where the mix begins to touch itself, so that no drag of the weights jumps there.
    const OutlineNodes bud = bud_.cap.empty() ? bud_of(nodes_) : bud_;
    const auto towards = [&](int steps) {
        return blended(mix, bud, static_cast<double>(steps) / bud_steps);
    };
    int above = bud_steps / coarse_steps;
    while (above < bud_steps && !is_simple(towards(above))) above += bud_steps / coarse_steps;
    int below = above - bud_steps / coarse_steps;
    while (above - below > 1) {
        const int middle = (above + below) / 2;
        (is_simple(towards(middle)) ? above : below) = middle;
    }
    return towards(above);
}

bool MorphSet::moves_simply(const OutlineNodes& nodes) const {
    for (int lod = 0; lod < static_cast<int>(details.size()); ++lod)
        if (contact_at_rest(polyline(nodes, lod))) return false;
    return true;
}

bool MorphSet::is_swept_simply(const OutlineNodes& nodes) const {
    const Outline outline(nodes);
    for (int lod = 0; lod < static_cast<int>(details.size()); ++lod)
        if (contact_at_rest(sporeprint::polyline(outline, lod))) return false;
    return true;
}

CurveName MorphSet::curve_of(const Contact& contact, int lod) const {
    const auto rings = [&](CurveName curve) {
        return nodes_.front().of(curve).empty() ? 0
                                                : static_cast<std::size_t>(ring_count(curve, lod));
    };
    return sporeprint::curve_of(contact, rings(CurveName::stem), rings(CurveName::hymenium));
}

Certificate MorphSet::certificate() const {
    Certificate known;
    known.method = for_any_weights_ ? ProofMethod::certificate : ProofMethod::checked;
    if (!detours_.none()) known.detour = 1.0;
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
            if (taken(i) && taken(j) && detours_.via(i, j) != Via::none) known.detour = 1.0;
    const OutlineNodes a = unchecked(from), b = unchecked(to);
    if (known.detour == 0.0) {
        for (int lod = 0; lod < static_cast<int>(details.size()) && known.simple; ++lod)
            known.simple = !first_contact(polyline(a, lod), polyline(b, lod));
        return known;
    }
    known.method = ProofMethod::certificate;
    const Lines own = lines();
    known.simple = std::all_of(own.rbegin(), own.rend(), [&](const std::vector<Polyline>& shapes) {
        return curved_way_is_simple(shapes, from, to);
    });
    return known;
}

/// Whether the way touches itself half way; shapes as in curved_way_is_simple().
bool MorphSet::curved_way_touches_half_way(const std::vector<Polyline>& shapes,
                                           std::span<const double> from,
                                           std::span<const double> to) const {
    const std::vector<double> weights = detours_.moved(between(from, to, 0.5));
    Polyline line(shapes.front().size(), glm::dvec2(0.0));
    for (std::size_t s = 0; s < shapes.size(); ++s) add(line, weights[s], shapes[s]);
    return contact_at_rest(line).has_value();
}

/// Detours make the way from one mix to another a curve; each piece of it lies among the means of the piece's Bezier polygons. Those
/// of a part of a piece are means of the piece's own, so that only its doubts are looked at again.
///
/// shapes  the polylines of all shapes at one level of detail; the bud's may be left out where no way leads by it
bool MorphSet::curved_way_is_simple(const std::vector<Polyline>& shapes,
                                    std::span<const double> from,
                                    std::span<const double> to) const {
    std::vector<Polyline> bezier(Detours::way_degree + 1);
    const auto take_piece = [&](double t0, double t1) {
        const auto way = detours_.moved(between(from, to, t0), between(from, to, t1));
        for (std::size_t i = 0; i < bezier.size(); ++i) {
            bezier[i].assign(shapes.front().size(), glm::dvec2(0.0));
            for (std::size_t s = 0; s < shapes.size(); ++s) add(bezier[i], way[s][i], shapes[s]);
        }
    };
    // A detour is too long a way to be certified at once: its halves come first.
    const auto parts_are_simple = [&](const auto& self, double t0, double t1, int depth,
                                      const std::vector<Doubt>& known) -> bool {
        if (depth == deepest_piece) return false;
        const double middle = 0.5 * (t0 + t1);
        for (const auto& [start, end] : {std::pair{t0, middle}, std::pair{middle, t1}}) {
            take_piece(start, end);
            const std::vector<Doubt> left = depth == 0 ? doubts(bezier) : doubts(bezier, known);
            if (!left.empty() && !self(self, start, end, depth + 1, left)) return false;
        }
        return true;
    };
    return parts_are_simple(parts_are_simple, 0.0, 1.0, 0, {});
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
    std::size_t bytes = sizeof(MorphSet) + detours_.bytes();
    for (std::size_t s = 0; s <= nodes_.size(); ++s)
        for (const CurveName curve : curve_names)
            bytes += shape(s).of(curve).size() * sizeof(OutlineNode);
    return bytes + ages_.size() * (sizeof(double) + sizeof(OutlineNodes)) +
           kins_.size() * sizeof(Kin);
}

}  // namespace sporeprint
