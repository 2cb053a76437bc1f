// Mixes of swept species, drawn at random or selected evenly.
#pragma once

#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/math/random.h"
#include "tests/support/effort.h"
#include "tests/support/orders.h"

namespace sporeprint {

/// Returns the species of a mix with a positive weight.
inline Mix present(Mix mix) {
    std::erase_if(mix, [](const MixPart& part) { return part.weight == 0; });
    return mix;
}

using SpeciesPair = std::pair<std::string, std::string>;

/// Returns every pair of swept species of the atlas, by id.
inline std::vector<SpeciesPair> species_pairs() {
    const auto ids = swept_ids();
    std::vector<SpeciesPair> pairs;
    for (std::size_t i = 0; i < ids.size(); ++i)
        for (std::size_t j = i + 1; j < ids.size(); ++j) pairs.emplace_back(ids[i], ids[j]);
    return pairs;
}

/// Returns every pair of branched species.
inline std::vector<SpeciesPair> branched_pairs() {
    const auto ids = branched_ids();
    std::vector<SpeciesPair> pairs;
    for (std::size_t i = 0; i < ids.size(); ++i)
        for (std::size_t j = i + 1; j < ids.size(); ++j) pairs.emplace_back(ids[i], ids[j]);
    return pairs;
}

/// Returns at least `most` pairs in which every species occurs equally often, or all pairs; `most`
/// evenly spread ones if there are more species than that. The sorted ids form a ring, and each is
/// paired with those some steps on: species of the same genus are next to each other.
inline std::vector<SpeciesPair> some_species_pairs(std::size_t most) {
    const auto ids = swept_ids();
    const std::size_t n = ids.size(), all = n / 2, rounds = std::min((most + n - 1) / n, all);
    std::set<SpeciesPair> pairs;
    for (std::size_t round = 0; round < rounds; ++round) {
        const std::size_t steps = rounds == 1 ? all / 2 + 1 : 1 + round * (all - 1) / (rounds - 1);
        for (std::size_t i = 0; i < n; ++i) pairs.insert(std::minmax(ids[i], ids[(i + steps) % n]));
    }
    if (most >= n) return {pairs.begin(), pairs.end()};
    std::vector<SpeciesPair> few;
    for (std::size_t i = 0; i < most; ++i)
        few.push_back(
            *std::next(pairs.begin(), static_cast<std::ptrdiff_t>(i * pairs.size() / most)));
    return few;
}

/// Returns two to eight different species, by id.
inline std::vector<std::string> random_species(Random& random) {
    auto ids = swept_ids();
    const std::size_t count =
        2 + random.bits() % static_cast<std::uint32_t>(std::min<std::size_t>(ids.size(), 8) - 1);
    for (std::size_t i = 0; i < count; ++i)
        std::swap(ids[i], ids[i + random.bits() % static_cast<std::uint32_t>(ids.size() - i)]);
    ids.resize(count);
    std::sort(ids.begin(), ids.end());
    return ids;
}

/// Returns random weights of these species that sum to 1000; every other draw is near a corner or
/// an edge of the simplex.
inline Mix random_mix(const std::vector<std::string>& ids, Random& random) {
    const std::size_t count = ids.size();
    const bool extreme = random.bits() % 2 == 0;
    std::vector<double> shares;
    double sum = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        const double u = random.uniform();
        shares.push_back(extreme ? u * u * u * u * u * u + 1e-3 : u + 1e-3);
        sum += shares.back();
    }
    Mix mix;
    int left = 1000;
    for (std::size_t i = 0; i < count; ++i) {
        const int rest = static_cast<int>(count - i - 1);
        const int weight =
            rest == 0 ? left
                      : std::clamp(static_cast<int>(shares[i] / sum * 1000.0), 1, left - rest);
        mix.push_back({ids[i], weight});
        left -= weight;
    }
    return mix;
}

/// Returns two to eight different species with random weights.
inline Mix random_mix(Random& random) {
    const auto ids = random_species(random);
    return random_mix(ids, random);
}

inline std::string text_of(const Mix& mix) {
    std::string text;
    for (const MixPart& part : mix)
        text += (text.empty() ? "" : ",") + part.id + ":" + std::to_string(part.weight);
    return text;
}

}  // namespace sporeprint
