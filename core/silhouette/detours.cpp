#include "core/silhouette/detours.h"

#include <utility>

namespace sporeprint {

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

std::vector<std::vector<double>> Detours::moved(std::span<const double> from,
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
             {std::pair{by_mature, mature_[s]}, std::pair{by_bud, from.size()}}) {
            const Polynomial over = product(rate, met);
            add(s, over, -1.0);
            add(target, over, 1.0);
        }
    }
    return moved;
}

}  // namespace sporeprint
