#include "core/silhouette/indirect_path.h"

#include <utility>

namespace sporeprint {

namespace {

/// A polynomial on [0, 1] by its degree + 1 Bernstein coefficients.
struct Polynomial {
    std::size_t degree = 0;
    Detours::Weight at{};
};

/// n over k at [n][k]
constexpr auto ways_to_choose = [] {
    std::array<Detours::Weight, Detours::way_degree + 1> ways{};
    for (std::size_t n = 0; n < ways.size(); ++n) {
        ways[n][0] = 1.0;
        for (std::size_t k = 1; k <= n; ++k) ways[n][k] = ways[n - 1][k - 1] + ways[n - 1][k];
    }
    return ways;
}();

Polynomial product(const Polynomial& a, const Polynomial& b) {
    Polynomial out{a.degree + b.degree};
    const Detours::Weight &of_a = ways_to_choose[a.degree], &of_b = ways_to_choose[b.degree];
    for (std::size_t i = 0; i <= a.degree; ++i)
        for (std::size_t j = 0; j <= b.degree; ++j)
            out.at[i + j] +=
                of_a[i] * of_b[j] / ways_to_choose[out.degree][i + j] * a.at[i] * b.at[j];
    return out;
}

/// The same polynomial as one of the highest degree.
Polynomial raised(const Polynomial& p) {
    Polynomial one{Detours::way_degree - p.degree};
    for (std::size_t i = 0; i <= one.degree; ++i) one.at[i] = 1.0;
    return product(p, one);
}

}  // namespace

Detours::Detours(std::span<const Kin> kins) {
    for (const Kin& kin : kins) mature_.insert(mature_.end(), kin.count, kin.mature);
}

void Detours::lead(std::size_t i, std::size_t j, Via by) {
    const std::size_t count = mature_.size();
    if (none()) vias_.assign(count * count, Via::none);
    vias_[i * count + j] = vias_[j * count + i] = by;
}

std::vector<double> Detours::moved(std::span<const double> weights) const {
    std::vector<double> moved(weights.begin(), weights.end());
    moved.push_back(0.0);
    if (none()) return moved;
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
        moved[mature_[s]] += by_mature * rate;
        moved.back() += by_bud * rate;
    }
    return moved;
}

std::vector<Detours::Weight> Detours::moved(std::span<const double> from,
                                            std::span<const double> to) const {
    std::vector<Weight> moved(from.size() + 1, Weight{});
    const auto add = [&](std::size_t s, const Polynomial& what, double factor) {
        for (std::size_t i = 0; i <= what.degree; ++i) moved[s][i] += factor * what.at[i];
    };
    const auto taken = [&](std::size_t s) { return from[s] != 0.0 || to[s] != 0.0; };
    for (std::size_t s = 0; s < from.size(); ++s)
        if (taken(s)) moved[s] = raised({1, {from[s], to[s]}}).at;
    for (std::size_t s = 0; s < from.size(); ++s) {
        if (!taken(s)) continue;
        Polynomial by_mature{1, {}}, by_bud{1, {}};
        for (std::size_t other = 0; other < from.size(); ++other) {
            const Via by = via(s, other);
            if (by == Via::none) continue;
            Polynomial& met = by == Via::mature ? by_mature : by_bud;
            met.at[0] += from[other];
            met.at[1] += to[other];
        }
        const Polynomial x{
            1, {1.0 - by_mature.at[0] - by_bud.at[0], 1.0 - by_mature.at[1] - by_bud.at[1]}};
        Polynomial rate{1, {1.0 - 7.0 * x.at[0], 1.0 - 7.0 * x.at[1]}};
        for (int i = 0; i < 6; ++i) {
            rate = product(x, rate);
            for (std::size_t k = 0; k <= rate.degree; ++k) rate.at[k] += 1.0;
        }
        rate = product(rate, {1, {from[s], to[s]}});
        for (const auto& [met, target] :
             {std::pair{by_mature, mature_[s]}, std::pair{by_bud, from.size()}}) {
            const Polynomial over = product(rate, met);
            add(s, over, -1.0);
            add(target, over, 1.0);
        }
    }
    return moved;
}

}  // namespace sporeprint
