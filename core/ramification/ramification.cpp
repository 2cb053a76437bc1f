#include "core/ramification/ramification.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/params/messages.h"

namespace sporeprint {

namespace {

constexpr std::uint32_t none = Ramification::none;

// Side branches per fork by the number of orders between, measured on trees of 400,000 nodes;
// beyond the last a third each.
constexpr std::array<double, 5> increasing_sides = {0.842, 0.582, 0.268, 0.102, 0.034};

RamificationMatrix self_similar(int order, const auto& sides) {
    RamificationMatrix matrix;
    for (int k = 2; k <= order; ++k) {
        std::vector<double> row(static_cast<std::size_t>(k));
        double sum = 1.0;
        for (int j = 1; j < k; ++j) sum += sides(j);
        for (int j = 1; j < k; ++j) row[static_cast<std::size_t>(k - j - 1)] = sides(j) / sum;
        row.back() = 1.0 / sum;
        matrix.rows.push_back(std::move(row));
    }
    return matrix;
}

void throw_if_invalid(const RamificationMatrix& matrix, int order) {
    std::vector<Problem> problems = validation_errors(matrix);
    if (!problems.empty()) throw InvalidInput(std::move(problems));
    if (order < 1 || order > matrix.order())
        throw InvalidInput("/order", std::to_string(order) + " is outside 1.." +
                                         std::to_string(matrix.order()) +
                                         ", the orders of the matrix");
}

[[noreturn]] void refuse_size(double expected, std::size_t most) {
    throw Impossible("/order", "the tree would have about " +
                                   number_text(std::floor(expected + 0.5)) + " leaves; at most " +
                                   std::to_string(most) + " are grown");
}

std::uint32_t appended(Ramification& tree, std::uint32_t parent, int order) {
    const auto node = static_cast<std::uint32_t>(tree.nodes.size());
    tree.nodes.push_back({parent, {none, none}, order});
    return node;
}

// Numbers for one order: segments, each of which ends in a fork, and the side branches to
// distribute over them.
struct OrderCounts {
    double segments = 0.0;
    std::vector<double> sides;  ///< by order - 1
};

// Returns the numbers for orders 1..order, as index. They are integers, but may exceed the range of
// an integer type.
std::vector<OrderCounts> counts_by_order(const RamificationMatrix& matrix, int order) {
    std::vector<OrderCounts> counts(static_cast<std::size_t>(order) + 1);
    counts[static_cast<std::size_t>(order)].segments = 1.0;
    for (int k = order; k >= 2; --k) {
        OrderCounts& count_of_order = counts[static_cast<std::size_t>(k)];
        const double nodes = count_of_order.segments / matrix.fork(k);
        counts[static_cast<std::size_t>(k - 1)].segments += 2.0 * count_of_order.segments;
        for (int i = 1; i < k; ++i) {
            const double side = std::floor(matrix.at(k, i) * nodes + 0.5);
            count_of_order.sides.push_back(side);
            counts[static_cast<std::size_t>(i)].segments += side;
        }
    }
    return counts;
}

// Grows one tree below `root`; returns false as soon as there are more than `most` leaves and
// unfinished nodes.
bool grow(Ramification& tree, std::uint32_t root, const RamificationMatrix& matrix, Random& random,
          std::size_t most) {
    std::vector<std::uint32_t> open = {root};
    while (!open.empty()) {
        const std::uint32_t node = open.back();
        open.pop_back();
        const int k = tree.nodes[node].order;
        if (k == 1) continue;
        if (tree.leaves() >= most) return false;
        const double drawn = random.uniform();
        double sum = 0.0;
        int biorder = k;
        for (int i = 1; i < k && biorder == k; ++i) {
            sum += matrix.at(k, i);
            if (drawn < sum) biorder = i;
        }
        const int greater = biorder == k ? k - 1 : k;
        const std::uint32_t first = appended(tree, node, greater);
        const std::uint32_t second = appended(tree, node, biorder == k ? k - 1 : biorder);
        tree.nodes[node].children = {first, second};
        open.push_back(second);
        open.push_back(first);
    }
    return true;
}

// Returns the orders of the side branches of all segments of an order, in random order.
std::vector<int> shuffled_sides(const OrderCounts& counts, Random& random) {
    std::vector<int> orders;
    for (std::size_t i = 0; i < counts.sides.size(); ++i)
        orders.insert(orders.end(), static_cast<std::size_t>(counts.sides[i]),
                      static_cast<int>(i) + 1);
    for (std::size_t i = orders.size(); i > 1; --i) {
        const double drawn = random.uniform();
        std::swap(orders[i - 1], orders[static_cast<std::size_t>(drawn * static_cast<double>(i))]);
    }
    return orders;
}

// Returns the same orders mixed evenly: each is spread over the whole list in equal steps, which
// begin at a random share of a step.
std::vector<int> spaced_sides(const OrderCounts& counts, Random& random) {
    struct Side {
        double at;
        int order;
    };
    std::vector<Side> sides;
    for (std::size_t i = 0; i < counts.sides.size(); ++i)
        for (double k = 0.0; k < counts.sides[i]; k += 1.0) {
            const double drawn = random.uniform();
            sides.push_back({(k + drawn) / counts.sides[i], static_cast<int>(i) + 1});
        }
    std::stable_sort(sides.begin(), sides.end(),
                     [](const Side& a, const Side& b) { return a.at < b.at; });
    std::vector<int> orders;
    orders.reserve(sides.size());
    for (const Side& side : sides) orders.push_back(side.order);
    return orders;
}

}  // namespace

std::vector<Problem> validation_errors(const RamificationMatrix& matrix, const std::string& path) {
    std::vector<Problem> problems;
    if (matrix.rows.empty() || matrix.order() > most_order)
        report(problems, path,
               std::to_string(matrix.rows.size()) + " rows; allowed are 1 to " +
                   std::to_string(most_order - 1) + ", for the orders 2 to " +
                   std::to_string(most_order));
    for (std::size_t row = 0; row < matrix.rows.size(); ++row) {
        const std::vector<double>& entries = matrix.rows[row];
        const std::string here = path + '/' + std::to_string(row);
        if (entries.size() != row + 2) {
            report(problems, here,
                   std::to_string(entries.size()) + " entries; the row of order " +
                       std::to_string(row + 2) + " has " + std::to_string(row + 2));
            continue;
        }
        double sum = 0.0;
        for (std::size_t i = 0; i < entries.size(); ++i) {
            if (!(entries[i] >= 0.0 && entries[i] <= 1.0))
                report(problems, here + '/' + std::to_string(i),
                       number_text(entries[i]) + " is outside 0..1");
            sum += entries[i];
        }
        if (!(std::abs(sum - 1.0) <= 1e-6))
            report(problems, here, "the entries sum to " + number_text(sum) + ", not to 1");
        if (!(entries.back() >= least_fork))
            report(problems, here + '/' + std::to_string(row + 1),
                   number_text(entries.back()) + " is less than " + number_text(least_fork) +
                       ": axes of order " + std::to_string(row + 2) + " would hardly ever end");
    }
    return problems;
}

RamificationMatrix perfect_matrix(int order) {
    return self_similar(order, [](int) { return 0.0; });
}

RamificationMatrix random_binary_matrix(int order) { return tokunaga_matrix(order, 1.0, 2.0); }

RamificationMatrix random_increasing_matrix(int order) {
    return self_similar(order, [](int below) {
        const auto last = static_cast<int>(increasing_sides.size());
        double side = increasing_sides[static_cast<std::size_t>(std::min(below, last) - 1)];
        for (int j = last; j < below; ++j) side /= 3.0;
        return side;
    });
}

RamificationMatrix fishbone_matrix(int order, double forks) {
    RamificationMatrix matrix;
    for (int k = 2; k <= order; ++k) {
        std::vector<double> row(static_cast<std::size_t>(k));
        row.front() = 1.0 - forks;
        row.back() = forks;
        matrix.rows.push_back(std::move(row));
    }
    return matrix;
}

RamificationMatrix tokunaga_matrix(int order, double a, double c) {
    return self_similar(order, [&](int below) {
        double side = a;
        for (int j = 1; j < below; ++j) side *= c;
        return side;
    });
}

RamificationMatrix blended(const RamificationMatrix& first, const RamificationMatrix& second,
                           double weight) {
    RamificationMatrix matrix;
    for (int k = 2; k <= std::min(first.order(), second.order()); ++k) {
        std::vector<double> row;
        for (int i = 1; i <= k; ++i)
            row.push_back((1.0 - weight) * first.at(k, i) + weight * second.at(k, i));
        matrix.rows.push_back(std::move(row));
    }
    return matrix;
}

double expected_leaves(const RamificationMatrix& matrix, int order) {
    std::vector<double> leaves = {0.0, 1.0};
    for (int k = 2; k <= order; ++k) {
        double side = 0.0;
        for (int i = 1; i < k; ++i) side += matrix.at(k, i) * leaves[static_cast<std::size_t>(i)];
        leaves.push_back(2.0 * leaves.back() + side / matrix.fork(k));
    }
    return leaves.back();
}

Ramification sampled_ramification(const RamificationMatrix& matrix, int order, std::uint32_t seed,
                                  std::size_t most) {
    throw_if_invalid(matrix, order);
    Random random(seed, purposes::grown_ramification);
    Ramification tree;
    const std::uint32_t root = appended(tree, none, order);
    if (!grow(tree, root, matrix, random, most)) refuse_size(expected_leaves(matrix, order), most);
    return tree;
}

double exact_leaves(const RamificationMatrix& matrix, int order) {
    return counts_by_order(matrix, order)[1].segments;
}

Ramification exact_ramification(const RamificationMatrix& matrix, int order, std::uint32_t seed,
                                std::size_t most, bool spaced) {
    throw_if_invalid(matrix, order);
    const std::vector<OrderCounts> counts = counts_by_order(matrix, order);
    if (counts[1].segments > static_cast<double>(most)) refuse_size(counts[1].segments, most);
    Ramification tree;
    // Root nodes of the segments of each order that are still to be grown.
    std::vector<std::vector<std::uint32_t>> roots(static_cast<std::size_t>(order) + 1);
    roots[static_cast<std::size_t>(order)].push_back(appended(tree, none, order));
    for (int k = order; k >= 2; --k) {
        std::vector<std::uint32_t>& segments = roots[static_cast<std::size_t>(k)];
        const OrderCounts& counted = counts[static_cast<std::size_t>(k)];
        Random random(seed, purposes::exact_ramification, static_cast<std::uint32_t>(k));
        const std::vector<int> side_orders =
            spaced ? spaced_sides(counted, random) : shuffled_sides(counted, random);
        // Every arrangement of side branches between the ends of the segments is equally likely.
        // Ends are distributed among them: a place is an end with the probability of the remaining
        // ends among the remaining places, and the last place is one. Spaced segments end where their
        // share of all side branches is used up.
        std::size_t segment = 0, next_side = 0;
        std::uint32_t tip = segments.empty() ? none : segments.front();
        while (segment < segments.size()) {
            const std::size_t sides_left = side_orders.size() - next_side;
            const std::size_t ends_left = segments.size() - segment - 1;
            bool is_end = sides_left == 0;
            if (!is_end && spaced) {
                is_end = next_side * segments.size() >= (segment + 1) * side_orders.size();
            } else if (!is_end && ends_left > 0) {
                const double drawn = random.uniform();
                is_end = drawn * static_cast<double>(sides_left + ends_left) <
                         static_cast<double>(ends_left);
            }
            const int greater = is_end ? k - 1 : k;
            const int lesser = is_end ? k - 1 : side_orders[next_side];
            const std::uint32_t first = appended(tree, tip, greater);
            const std::uint32_t second = appended(tree, tip, lesser);
            tree.nodes[tip].children = {first, second};
            roots[static_cast<std::size_t>(lesser)].push_back(second);
            if (is_end) {
                roots[static_cast<std::size_t>(k - 1)].push_back(first);
                if (++segment < segments.size()) tip = segments[segment];
            } else {
                tip = first;
                ++next_side;
            }
        }
    }
    return tree;
}

Ramification with_tips(const Ramification& tree, const RamificationMatrix& tips, int tip_order,
                       std::uint32_t seed, std::size_t most) {
    throw_if_invalid(tips, tip_order);
    Ramification grown = tree;
    const std::size_t before = tree.nodes.size();
    for (std::uint32_t node = 0; node < before; ++node) {
        if (!tree.leaf(node)) continue;
        Random random(seed, purposes::ramification_tips, node);
        const double drawn = random.uniform();
        grown.nodes[node].order = 1 + static_cast<int>(drawn * tip_order);
        if (!grow(grown, node, tips, random, most)) {
            double mean = 0.0;
            for (int k = 1; k <= tip_order; ++k) mean += expected_leaves(tips, k) / tip_order;
            refuse_size(static_cast<double>(tree.leaves()) * mean, most);
        }
    }
    // Orders above the tips follow from those of the tips; children come after their parents.
    for (std::size_t i = before; i > 0; --i) {
        Ramification::Node& node = grown.nodes[i - 1];
        if (tree.leaf(static_cast<std::uint32_t>(i - 1))) continue;
        if (grown.nodes[node.children[0]].order < grown.nodes[node.children[1]].order)
            std::swap(node.children[0], node.children[1]);
        const int first = grown.nodes[node.children[0]].order;
        const int second = grown.nodes[node.children[1]].order;
        node.order = first == second ? first + 1 : first;
    }
    return grown;
}

RamificationMatrix BiorderCounts::matrix() const {
    RamificationMatrix found;
    for (const std::vector<std::size_t>& row : rows) {
        const std::size_t sum = std::accumulate(row.begin(), row.end(), std::size_t{0});
        std::vector<double> shares;
        shares.reserve(row.size());
        for (const std::size_t count : row)
            shares.push_back(sum == 0 ? 0.0
                                      : static_cast<double>(count) / static_cast<double>(sum));
        if (sum == 0) shares.back() = 1.0;
        found.rows.push_back(std::move(shares));
    }
    return found;
}

BiorderCounts measured_biorders(const Ramification& tree) {
    std::vector<int> orders(tree.nodes.size(), 1);
    BiorderCounts counts;
    for (std::size_t i = tree.nodes.size(); i > 0; --i) {
        const auto node = static_cast<std::uint32_t>(i - 1);
        if (tree.leaf(node)) continue;
        const int first = orders[tree.nodes[node].children[0]];
        const int second = orders[tree.nodes[node].children[1]];
        const int k = first == second ? first + 1 : std::max(first, second);
        orders[node] = k;
        while (counts.rows.size() + 1 < static_cast<std::size_t>(k))
            counts.rows.emplace_back(counts.rows.size() + 2);
        const int i_of = first == second ? k : std::min(first, second);
        ++counts.rows[static_cast<std::size_t>(k - 2)][static_cast<std::size_t>(i_of - 1)];
    }
    return counts;
}

}  // namespace sporeprint
