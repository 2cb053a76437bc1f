// Mixes of species as whole mushrooms, with the correspondence of each set found once.
#pragma once

#include <algorithm>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "core/math/random.h"
#include "tests/support/orders.h"

namespace sporeprint {

/// Keeps every correspondence for the rest of the program.
inline Remember<MorphSet> kept_morphs() {
    struct Shelf {
        std::mutex mutex;
        std::map<std::string, std::shared_ptr<const MorphSet>> sets;
    };
    static const auto shelf = std::make_shared<Shelf>();
    return
        [](const std::string& key, const std::function<std::shared_ptr<const MorphSet>()>& make) {
            const std::lock_guard lock(shelf->mutex);
            auto& set = shelf->sets[key];
            if (!set) set = make();
            return set;
        };
}

/// The mesh of an order, its correspondence from kept_morphs().
inline Mesh morphed(const MushroomOrder& order) {
    return mushroom_mesh(order, resolve(order, atlas(), kept_morphs()));
}

/// The species of a mix that have a weight.
inline Mix present(Mix mix) {
    std::erase_if(mix, [](const MixPart& part) { return part.weight == 0; });
    return mix;
}

/// Every pair of species of the atlas, by id.
inline std::vector<std::pair<std::string, std::string>> species_pairs() {
    const auto ids = species_ids();
    std::vector<std::pair<std::string, std::string>> pairs;
    for (std::size_t i = 0; i < ids.size(); ++i)
        for (std::size_t j = i + 1; j < ids.size(); ++j) pairs.emplace_back(ids[i], ids[j]);
    return pairs;
}

/// Two to eight different species with random weights that sum to 1000; every other draw stays near a corner or an edge.
inline Mix random_mix(Random& random) {
    auto ids = species_ids();
    const std::size_t count =
        2 + random.bits() % static_cast<std::uint32_t>(std::min<std::size_t>(ids.size(), 8) - 1);
    for (std::size_t i = 0; i < count; ++i)
        std::swap(ids[i], ids[i + random.bits() % static_cast<std::uint32_t>(ids.size() - i)]);
    ids.resize(count);
    std::sort(ids.begin(), ids.end());
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

inline std::string text_of(const Mix& mix) {
    std::string text;
    for (const MixPart& part : mix)
        text += (text.empty() ? "" : ",") + part.id + ":" + std::to_string(part.weight);
    return text;
}

}  // namespace sporeprint
