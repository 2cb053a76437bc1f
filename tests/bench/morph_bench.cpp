// Morphing: the correspondence of a new pair, outlines and whole mushrooms of mixes whose correspondence is known.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <ctime>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/grow/mushroom.h"

namespace {

using namespace sporeprint;

/// The control shapes of some species, each divided by the height of its mature stage.
std::vector<ControlShape> shapes_of(const std::vector<std::string>& ids, const Atlas& atlas) {
    std::vector<ControlShape> shapes;
    for (std::size_t species_index = 0; species_index < ids.size(); ++species_index) {
        const Species& species = atlas.find(ids[species_index])->species;
        double size = 0.0;
        for (const Stage& stage : species.stages)
            if (stage.age <= 0.6) size = std::get<Swept>(stage.model.shape).silhouette.cap.back().y;
        for (const Stage& stage : species.stages)
            shapes.push_back(
                {std::get<Swept>(stage.model.shape).silhouette, size, species_index, stage.age});
    }
    return shapes;
}

void corresponding(benchmark::State& state, const std::vector<std::string>& ids) {
    const auto atlas = built_in_atlas();
    const auto shapes = shapes_of(ids, *atlas);
    std::size_t bytes = 0;
    for (auto _ : state) bytes = MorphSet(shapes).bytes();
    state.counters["bytes"] = static_cast<double>(bytes);
}

/// Every pair of species that are swept, each at its best of all rounds; processor time as the counters say.
void corresponding_all(benchmark::State& state) {
    const auto atlas = built_in_atlas();
    std::vector<std::vector<ControlShape>> pairs;
    for (const AtlasEntry& a : atlas->entries())
        for (const AtlasEntry& b : atlas->entries()) {
            const std::string first(a.species.id.view()), second(b.species.id.view());
            const auto sweeps = [](const AtlasEntry& one) {
                return std::holds_alternative<Swept>(one.species.stages.front().model.shape);
            };
            if (first < second && sweeps(a) && sweeps(b))
                pairs.push_back(shapes_of({first, second}, *atlas));
        }
    std::vector<double> best(pairs.size(), std::numeric_limits<double>::infinity());
    for (auto _ : state)
        for (std::size_t i = 0; i < pairs.size(); ++i) {
            const std::clock_t begin = std::clock();
            benchmark::DoNotOptimize(MorphSet(pairs[i]).bytes());
            best[i] =
                std::min(best[i], 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
        }
    std::sort(best.begin(), best.end());
    state.counters["median_ms"] = best[best.size() / 2];
    state.counters["p95_ms"] = best[best.size() * 95 / 100];
    state.counters["worst_ms"] = best.back();
}

void mixed_outline(benchmark::State& state, const std::vector<std::string>& ids) {
    const auto atlas = built_in_atlas();
    const MorphSet set(shapes_of(ids, *atlas));
    const std::vector<double> weights(set.size(), 1.0 / static_cast<double>(set.size()));
    for (auto _ : state) benchmark::DoNotOptimize(Outline(set.nodes(weights)));
}

MushroomSpec pair_of(const std::string& a, const std::string& b, int lod) {
    MushroomSpec spec;
    spec.mix = {{a, 500}, {b, 500}};
    spec.params.lod = lod;
    return spec;
}

/// Everything that a mix of a pair never seen before needs decided, correspondence and proof included.
void new_pair(benchmark::State& state, const std::string& a, const std::string& b) {
    const auto atlas = built_in_atlas();
    const MushroomSpec spec = pair_of(a, b, 0);
    for (auto _ : state) benchmark::DoNotOptimize(resolve(spec, *atlas));
}

/// A drag of the weight: correspondence and images from the cache, everything else anew.
void dragged(benchmark::State& state, const std::string& a, const std::string& b, int lod) {
    const auto atlas = built_in_atlas();
    MushroomSpec spec = pair_of(a, b, lod);
    std::shared_ptr<const ImageSet> images;
    std::map<std::string, std::shared_ptr<const MorphSet>> morphs;
    ExecutionContext execution;
    execution.caches.images = [&](const std::string&, const auto& make) {
        if (!images) images = make();
        return images;
    };
    execution.caches.morphs = [&](const std::string& key, const auto& make) {
        // A mix whose lesser part is not worth a sixty-fourth is painted as a lone species: another set.
        std::shared_ptr<const MorphSet>& cached = morphs[key];
        if (!cached) cached = make();
        return cached;
    };
    (void)grow_mushroom(spec, *atlas, {"/v1/bench", {}}, execution);
    int t = 1;
    for (auto _ : state) {
        spec.mix[0].weight = 1000 - t;
        spec.mix[1].weight = t;
        t = t < 999 ? t + 1 : 1;
        benchmark::DoNotOptimize(grow_mushroom(spec, *atlas, {"/v1/bench", {}}, execution));
    }
}

[[maybe_unused]] const bool registered = [] {
    // The same eight for ever, as many as a mix may have: figures stay comparable while the atlas grows.
    const std::vector<std::string> ids = {"amanita_muscaria",      "boletus_edulis",
                                          "cantharellus_cibarius", "clavariadelphus_pistillaris",
                                          "coprinus_comatus",      "disciotis_venosa",
                                          "mycena_sanguinolenta",  "russula_vinosa"};
    const auto add = [](const std::string& name, const std::vector<std::string>& of) {
        benchmark::RegisterBenchmark(("correspondence/" + name).c_str(), [of](benchmark::State& s) {
            corresponding(s, of);
        })->Unit(benchmark::kMillisecond);
    };
    for (std::size_t i = 0; i < ids.size(); ++i)
        for (std::size_t j = i + 1; j < ids.size(); ++j)
            add(ids[i] + "_and_" + ids[j], {ids[i], ids[j]});
    add("all_eight", ids);
    benchmark::RegisterBenchmark("correspondence/every_pair", corresponding_all)
        ->Unit(benchmark::kMillisecond)
        ->Iterations(5);
    for (std::size_t i = 0; i < ids.size(); ++i)
        for (std::size_t j = i + 1; j < ids.size(); ++j) {
            const std::string a = ids[i], b = ids[j];
            benchmark::RegisterBenchmark(("new_pair/" + a + "_and_" + b).c_str(),
                                         [a, b](benchmark::State& s) { new_pair(s, a, b); })
                ->Unit(benchmark::kMillisecond);
            for (const int lod : {0, 1})
                benchmark::RegisterBenchmark(
                    ("morph/" + a + "_and_" + b + "/lod" + std::to_string(lod)).c_str(),
                    [a, b, lod](benchmark::State& s) { dragged(s, a, b, lod); })
                    ->Unit(benchmark::kMicrosecond);
        }
    benchmark::RegisterBenchmark("mixed_outline/all_eight", [ids](benchmark::State& s) {
        mixed_outline(s, ids);
    })->Unit(benchmark::kMicrosecond);
    benchmark::RegisterBenchmark("mixed_outline/a_pair", [ids](benchmark::State& s) {
        mixed_outline(s, {ids[0], ids[1]});
    })->Unit(benchmark::kMicrosecond);
    return true;
}();

}  // namespace
