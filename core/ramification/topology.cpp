#include "core/ramification/topology.h"

#include <algorithm>

#include "core/params/messages.h"

namespace sporeprint {

namespace {

RamificationMatrix named_matrix(MatrixKind kind, const TreeTopology& topology, int order) {
    switch (kind) {
        case MatrixKind::perfect:
            return perfect_matrix(order);
        case MatrixKind::random_binary:
            return random_binary_matrix(order);
        case MatrixKind::random_increasing:
            return random_increasing_matrix(order);
        case MatrixKind::fishbone:
            return fishbone_matrix(order, topology.forks);
        case MatrixKind::tokunaga:
            return tokunaga_matrix(order, topology.tokunaga_a, topology.tokunaga_c);
        case MatrixKind::own: {
            RamificationMatrix own{topology.rows};
            own.rows.resize(std::min(own.rows.size(), static_cast<std::size_t>(order) - 1));
            return own;
        }
    }
    return perfect_matrix(order);
}

}  // namespace

RamificationMatrix tip_matrix(const TreeTopology& topology) {
    return named_matrix(topology.tips, topology, std::max(2, topology.tip_order));
}

void TreeTopology::check(const std::string& path, std::vector<Problem>& problems) const {
    if (!rows.empty()) {
        const std::vector<Problem> found =
            validation_errors(RamificationMatrix{rows}, path + "/rows");
        problems.insert(problems.end(), found.begin(), found.end());
    }
    if (!uses_rows()) return;
    const bool of_tips = tips == MatrixKind::own && tip_order > 1;
    const bool of_tree = matrix == MatrixKind::own || (toward == MatrixKind::own && blend > 0.0);
    const auto reached = static_cast<int>(rows.size()) + 1;
    const auto reach = [&](int wanted, const char* name) {
        if (wanted > reached)
            report(problems, path + '/' + name,
                   std::to_string(wanted) + " needs " + std::to_string(wanted - 1) +
                       " rows of an own matrix; there are " + std::to_string(rows.size()));
    };
    if (rows.empty())
        report(problems, path + "/rows", "an own matrix is asked for, and no rows are given");
    else if (of_tree)
        reach(order, "order");
    if (!rows.empty() && of_tips) reach(tip_order, "tip_order");
}

RamificationMatrix matrix_of(const TreeTopology& topology) {
    const int order = std::max(2, topology.order);
    RamificationMatrix matrix = named_matrix(topology.matrix, topology, order);
    if (!(topology.blend > 0.0)) return matrix;
    return blended(matrix, named_matrix(topology.toward, topology, order), topology.blend);
}

double expected_tips(const TreeTopology& topology) {
    const RamificationMatrix matrix = matrix_of(topology);
    const double leaves = topology.growth == TreeGrowth::sampled
                              ? expected_leaves(matrix, topology.order)
                              : exact_leaves(matrix, topology.order);
    double mean = 0.0;
    for (int k = 1; k <= topology.tip_order; ++k)
        mean += expected_leaves(tip_matrix(topology), k) / topology.tip_order;
    return leaves * mean;
}

Ramification ramified(const TreeTopology& topology, std::uint32_t seed, std::size_t most) {
    const RamificationMatrix matrix = matrix_of(topology);
    const bool is_spaced = topology.growth == TreeGrowth::spaced;
    Ramification grown = topology.growth == TreeGrowth::sampled
                             ? sampled_ramification(matrix, topology.order, seed, most)
                             : exact_ramification(matrix, topology.order, seed, most, is_spaced);
    if (topology.tip_order > 1)
        grown = with_tips(grown, tip_matrix(topology), topology.tip_order, seed, most);
    return grown;
}

}  // namespace sporeprint
