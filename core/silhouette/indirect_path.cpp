#include "core/silhouette/indirect_path.h"

#include <utility>

namespace sporeprint {

namespace {

/// A polynomial on [0, 1] by its degree + 1 Bernstein coefficients.
struct Polynomial {
    std::size_t degree = 0;
    IndirectPaths::Weight at{};
};

/// Binomial coefficients: n over k at [n][k].
constexpr auto binomial = [] {
    std::array<IndirectPaths::Weight, IndirectPaths::path_degree + 1> table{};
    for (std::size_t n = 0; n < table.size(); ++n) {
        table[n][0] = 1.0;
        for (std::size_t k = 1; k <= n; ++k) table[n][k] = table[n - 1][k - 1] + table[n - 1][k];
    }
    return table;
}();

Polynomial product(const Polynomial& a, const Polynomial& b) {
    Polynomial out{a.degree + b.degree};
    const IndirectPaths::Weight &of_a = binomial[a.degree], &of_b = binomial[b.degree];
    for (std::size_t i = 0; i <= a.degree; ++i)
        for (std::size_t j = 0; j <= b.degree; ++j)
            out.at[i + j] += of_a[i] * of_b[j] / binomial[out.degree][i + j] * a.at[i] * b.at[j];
    return out;
}

/// Returns the same polynomial, degree-elevated to the highest degree.
Polynomial raised(const Polynomial& p) {
    Polynomial one{IndirectPaths::path_degree - p.degree};
    for (std::size_t i = 0; i <= one.degree; ++i) one.at[i] = 1.0;
    return product(p, one);
}

}  // namespace

IndirectPaths::IndirectPaths(std::span<const SpeciesRange> species) {
    for (const SpeciesRange& range : species)
        mature_.insert(mature_.end(), range.count, range.mature);
}

void IndirectPaths::route(std::size_t i, std::size_t j, Via via) {
    const std::size_t count = mature_.size();
    if (none()) vias_.assign(count * count, Via::none);
    vias_[i * count + j] = vias_[j * count + i] = via;
}

std::vector<double> IndirectPaths::effective_weights(std::span<const double> weights) const {
    std::vector<double> effective_weights(weights.begin(), weights.end());
    effective_weights.push_back(0.0);
    if (none()) return effective_weights;
    for (std::size_t s = 0; s < weights.size(); ++s) {
        if (weights[s] == 0.0) continue;
        double via_mature = 0.0, via_intermediate = 0.0;
        for (std::size_t other = 0; other < weights.size(); ++other) {
            if (via(s, other) == Via::mature) via_mature += weights[other];
            if (via(s, other) == Via::intermediate) via_intermediate += weights[other];
        }
        const double x = 1.0 - via_mature - via_intermediate;
        double rate = 1.0 - 7.0 * x;
        for (int i = 0; i < 6; ++i) rate = 1.0 + x * rate;
        rate *= weights[s];
        effective_weights[s] -= (via_mature + via_intermediate) * rate;
        effective_weights[mature_[s]] += via_mature * rate;
        effective_weights.back() += via_intermediate * rate;
    }
    return effective_weights;
}

std::vector<IndirectPaths::Weight> IndirectPaths::effective_weights(
    std::span<const double> from, std::span<const double> to) const {
    std::vector<Weight> effective_weights(from.size() + 1, Weight{});
    const auto add = [&](std::size_t s, const Polynomial& what, double factor) {
        for (std::size_t i = 0; i <= what.degree; ++i)
            effective_weights[s][i] += factor * what.at[i];
    };
    const auto taken = [&](std::size_t s) { return from[s] != 0.0 || to[s] != 0.0; };
    for (std::size_t s = 0; s < from.size(); ++s)
        if (taken(s)) effective_weights[s] = raised({1, {from[s], to[s]}}).at;
    for (std::size_t s = 0; s < from.size(); ++s) {
        if (!taken(s)) continue;
        Polynomial via_mature{1, {}}, via_intermediate{1, {}};
        for (std::size_t other = 0; other < from.size(); ++other) {
            const Via kind = via(s, other);
            if (kind == Via::none) continue;
            Polynomial& transfer = kind == Via::mature ? via_mature : via_intermediate;
            transfer.at[0] += from[other];
            transfer.at[1] += to[other];
        }
        const Polynomial x{1,
                           {1.0 - via_mature.at[0] - via_intermediate.at[0],
                            1.0 - via_mature.at[1] - via_intermediate.at[1]}};
        Polynomial rate{1, {1.0 - 7.0 * x.at[0], 1.0 - 7.0 * x.at[1]}};
        for (int i = 0; i < 6; ++i) {
            rate = product(x, rate);
            for (std::size_t k = 0; k <= rate.degree; ++k) rate.at[k] += 1.0;
        }
        rate = product(rate, {1, {from[s], to[s]}});
        for (const auto& [transfer, target] :
             {std::pair{via_mature, mature_[s]}, std::pair{via_intermediate, from.size()}}) {
            const Polynomial over = product(rate, transfer);
            add(s, over, -1.0);
            add(target, over, 1.0);
        }
    }
    return effective_weights;
}

}  // namespace sporeprint
