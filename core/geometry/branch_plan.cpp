#include "core/geometry/branch_plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/geometry/branches.h"
#include "core/geometry/budget.h"
#include "core/geometry/ground.h"
#include "core/geometry/spines.h"
#include "core/mesh/detail.h"

namespace sporeprint {

namespace {

constexpr std::uint32_t none = BranchGraph::none;

constexpr std::array<TubeDetail, 13> detail_steps = {
    {{28, 28, 20, 18, 6, 12, 11, 0.3, 0.0, 1, 12, 16, 18},
     {20, 20, 12, 10, 4, 6, 6, 0.3, 0.0},
     {24, 18, 10, 8, 4, 5, 8, 0.3, 0.0, 2, 6, 12, 11, 6},
     {24, 16, 9, 7, 3, 4, 8, 0.3, 0.0, 2, 6, 12, 11, 5},
     {24, 14, 8, 7, 2, 3, 7, 0.3, 0.0, 2, 6, 12, 11, 4},
     {24, 10, 8, 8, 2, 3, 6, 0.3, 0.0, 2, 6, 12, 11},
     {12, 12, 7, 5, 2, 3, 5, 0.3, 0.0},
     {12, 10, 6, 4, 1, 2, 4, 0.3, 0.0},
     {12, 7, 5, 4, 1, 1, 3, 0.3, 0.0},
     {12, 6, 3, 3, 1, 1, 3, 0.3, 0.0},
     {6, 3, 3, 3, 1, 1, 2, 0.4, 0.0},
     {4, 4, 3, 3, 1, 1, 2, 1.0, 0.6},
     {3, 3, 3, 3, 1, 1, 2, 1.0, 0.6}}};
/// Index of the first of the resolutions in which species of few segments are finer than in the one
/// before, and their number: they serve sets and graphs that exceed the limit, and no level begins
/// with them.
constexpr std::size_t step_for_mixes = 2, steps_for_mixes = 4;
/// Index of the finest and of the coarsest resolution by level of detail; if the coarsest exceeds
/// the limit, the smallest tubes are dropped. The resolutions for mixes count as one.
constexpr std::array<std::size_t, 5> first_step = {0, 3, 7, 8, 9};
constexpr std::array<std::size_t, 5> last_step = {6, 6, 7, 8, 9};
/// Share of tubes that must remain at a resolution before a coarser one is tried. A round tube of
/// four sides is more visible than a missing twig.
constexpr std::array<double, 5> sufficient_share = {0.9, 0.5, 0.0, 0.0, 0.0};
/// Largest number of triangles at farthest_lod, which no request can select by itself.
constexpr std::uint64_t most_at_farthest = 150;
/// Number of tips from which on a tube or a segment counts as thick.
constexpr int thick_tube_tips = 12;

/// The resolutions among which a level of detail chooses.
struct Resolutions {
    std::size_t first, last;
    double sufficient_share;
};

/// Returns the resolutions of a level: between two whole ones means of theirs, rounded to the
/// coarser, because the triangle limit is lower than at the finer one.
Resolutions resolutions_at(DetailLevel level) {
    const auto row = static_cast<std::size_t>(level.lod);
    // Returns the index of a resolution when those for mixes count as one, which none begins with.
    const auto index = [](std::size_t step) {
        return step < step_for_mixes ? step
                                     : std::max(step, step_for_mixes + 1) + steps_for_mixes - 1;
    };
    if (level.is_whole())
        return {index(first_step[row]), index(last_step[row]), sufficient_share[row]};
    const double further = static_cast<double>(level.eighths) / DetailLevel::steps;
    const auto mean = [&](const auto& table) {
        const auto from = static_cast<double>(table[row]), to = static_cast<double>(table[row + 1]);
        return from + further * (to - from);
    };
    return {index(static_cast<std::size_t>(std::ceil(mean(first_step)))),
            index(static_cast<std::size_t>(std::ceil(mean(last_step)))), mean(sufficient_share)};
}

std::vector<TubeChain> chains_of(const BranchGraph& graph) {
    std::vector<TubeChain> chains;
    for (std::uint32_t i = 0; i < graph.nodes.size(); ++i) {
        const BranchGraph::Node& node = graph.nodes[i];
        if (node.parent != none && graph.nodes[node.parent].children[0] == i) continue;
        TubeChain chain;
        chain.tips = node.tips;
        chain.root = node.parent == none;
        chain.fork_tips = chain.root ? node.tips : graph.nodes[node.parent].tips;
        for (std::uint32_t at = i; at != none; at = graph.nodes[at].children[0])
            chain.nodes.push_back(at);
        chains.push_back(std::move(chain));
    }
    // Tubes with most tips come first, then isolated ones. Ties are broken by scattered numbers, so
    // that some of them remain on every side.
    const auto scattered = [](const TubeChain& chain) { return chain.nodes.front() * 0x9e3779b1U; };
    std::stable_sort(chains.begin(), chains.end(), [&](const TubeChain& a, const TubeChain& b) {
        if (a.root != b.root) return a.root;
        if (a.tips != b.tips) return a.tips > b.tips;
        return a.fork_tips != b.fork_tips ? a.fork_tips > b.fork_tips : scattered(a) < scattered(b);
    });
    return chains;
}

/// Returns the triangles of a tube, without the trunk below it.
std::uint64_t tube_triangles(const BranchGraph& graph, const TubeChain& chain,
                             const TubeDetail& detail) {
    // One ring is at the fork where it begins, or at the top of the trunk.
    int rings = 1 + segment_rings(graph.nodes[chain.nodes.back()], detail);
    for (const std::size_t fork : chain.forks)
        rings += segment_rings(graph.nodes[chain.nodes[fork]], detail);
    return 2 * static_cast<std::uint64_t>(rings) *
           static_cast<std::uint64_t>(tube_columns(graph, chain, detail));
}

/// Returns the triangles of a trunk from the ground to its lowest fork; it is closed below.
std::uint64_t trunk_triangles(const BranchGraph& graph, const TubeChain& chain,
                              const TubeDetail& detail) {
    return 2 *
           static_cast<std::uint64_t>(trunk_ring_count(graph.nodes[chain.nodes.front()], detail) -
                                      1) *
           static_cast<std::uint64_t>(detail.trunk_sides);
}

/// Returns the counts of a tube on which no other begins.
MeshCount count_of(const BranchGraph& graph, const TubeChain& chain, const TubeDetail& detail) {
    const auto sides = static_cast<std::uint64_t>(tube_columns(graph, chain, detail));
    const auto rings = static_cast<std::uint64_t>(1 + detail.tip_rings);
    // One row at the beginning, one point at the tip.
    MeshCount count{(chain.root ? rings : rings + 1) * sides + 1,
                    tube_triangles(graph, chain, detail)};
    if (chain.root) {
        const auto trunk =
            static_cast<std::uint64_t>(trunk_ring_count(graph.nodes[chain.nodes.front()], detail));
        count.vertices += (trunk + 1) * (sides + 1);
        count.triangles += trunk_triangles(graph, chain, detail);
    }
    return count;
}

/// Returns the counts of the additional rings that a tube has where another one begins on it.
MeshCount fork_count(const BranchGraph& graph, const TubeChain& parent, std::size_t at,
                     const TubeDetail& detail) {
    const auto rings =
        static_cast<std::uint64_t>(segment_rings(graph.nodes[parent.nodes[at]], detail)) *
        static_cast<std::uint64_t>(tube_columns(graph, parent, detail));
    return {rings, 2 * rings};
}

}  // namespace

int tube_sides(const TubeChain& chain, const TubeDetail& detail) {
    if (chain.root) return detail.trunk_sides;
    if (chain.tips >= thick_tube_tips) return detail.thick_sides;
    return chain.tips > 1 ? detail.sides : detail.twig_sides;
}

int tube_columns(const BranchGraph& graph, const TubeChain& chain, const TubeDetail& detail) {
    const bool few = !chain.root && graph.nodes[chain.nodes.front()].few > 0.0;
    return tube_sides(chain, detail) * (few ? detail.few_sides : 1);
}

int own_steps(const BranchGraph::Node& end, const TubeDetail& detail) {
    return end.tips >= thick_tube_tips ? std::max(detail.steps, detail.thick_steps) : detail.steps;
}

int segment_rings(const BranchGraph::Node& end, const TubeDetail& detail) {
    if (end.children[0] == none) return detail.tip_rings;
    const bool few = end.few > 0.0;
    const int own = own_steps(end, detail);
    const int steps = few ? std::max(own, detail.few_steps) : own;
    if (!end.may_end) return steps;
    return std::max({steps, detail.tip_rings, few ? detail.few_tip_rings : 0});
}

int trunk_ring_count(const BranchGraph::Node& top, const TubeDetail& detail) {
    return top.few > 0.0 ? std::max(detail.trunk_rings, detail.few_trunk_rings)
                         : detail.trunk_rings;
}

bool is_present(const BranchGraph& graph, const TubeChain& chain) {
    return graph.nodes[chain.nodes.front()].presence >= least_presence;
}

BranchPlan branch_plan(const Individual& individual, const BranchGraph& graph, DetailLevel level) {
    const Resolutions allowed = resolutions_at(level);
    const std::uint64_t all =
        level.lod < farthest_lod ? triangle_limit(level) : std::uint64_t{most_at_farthest};
    const std::vector<SpineLayer>& spines = individual.spines;
    const std::uint64_t others = spine_count(spines, spine_detail(spines, level)).triangles +
                                 ground_count(individual.grounds, detail_of(level)).triangles;
    const std::uint64_t limit = all - std::min(others, all / 2);
    BranchPlan plan;
    plan.chains = chains_of(graph);
    // For each node its chain, and its index there.
    struct Place {
        std::size_t chain = 0, at = 0;
    };
    std::vector<Place> places(graph.nodes.size());
    for (std::size_t c = 0; c < plan.chains.size(); ++c)
        for (std::size_t k = 0; k < plan.chains[c].nodes.size(); ++k)
            places[plan.chains[c].nodes[k]] = {c, k};
    // Returns the fork at which a chain begins; none for the lowest one, which is the top of a
    // trunk and has its ring.
    const auto fork_of = [&](const TubeChain& chain) -> const Place* {
        if (chain.root) return nullptr;
        const std::uint32_t fork = graph.nodes[chain.nodes.front()].parent;
        return graph.nodes[fork].parent == none ? nullptr : &places[fork];
    };
    std::size_t retained = 0;
    for (std::size_t step = allowed.first; step <= allowed.last; ++step) {
        plan.detail = detail_steps[step];
        plan.count = {};
        for (retained = 0; retained < plan.chains.size(); ++retained) {
            MeshCount one = count_of(graph, plan.chains[retained], plan.detail);
            // A parent has more tips than its branches, so it came before.
            if (const Place* fork = fork_of(plan.chains[retained])) {
                const MeshCount rings =
                    fork_count(graph, plan.chains[fork->chain], fork->at, plan.detail);
                one.vertices += rings.vertices;
                one.triangles += rings.triangles;
            }
            if (plan.count.triangles + one.triangles > limit) break;
            plan.count.vertices += one.vertices;
            plan.count.triangles += one.triangles;
        }
        // The first of the resolutions for mixes are only finer: no twig is dropped for them.
        const bool only_finer =
            step >= step_for_mixes && step + 1 < step_for_mixes + steps_for_mixes;
        const double sufficient = only_finer ? 1.0 : allowed.sufficient_share;
        if (static_cast<double>(retained) >= sufficient * static_cast<double>(plan.chains.size()))
            break;
    }
    plan.chains.resize(retained);
    for (const TubeChain& chain : plan.chains)
        if (const Place* fork = fork_of(chain)) plan.chains[fork->chain].forks.push_back(fork->at);
    for (TubeChain& chain : plan.chains) std::sort(chain.forks.begin(), chain.forks.end());
    return plan;
}

MeshCount branched_mesh_count(const Individual& individual, DetailLevel level, bool keep_absent) {
    const BranchGraph& graph = individual.branch_graph;
    const BranchPlan plan = branch_plan(individual, graph, level);
    MeshCount count = plan.count;
    count += ground_count(individual.grounds, detail_of(level), keep_absent);
    count += spine_count(individual.spines, spine_detail(individual.spines, level), keep_absent);
    if (keep_absent) return count;
    for (const TubeChain& chain : plan.chains)
        if (!is_present(graph, chain)) {
            count.triangles -= tube_triangles(graph, chain, plan.detail);
            if (chain.root) count.triangles -= trunk_triangles(graph, chain, plan.detail);
        }
    return count;
}

}  // namespace sporeprint
