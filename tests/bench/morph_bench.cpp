// Morphing: the correspondence of a new pair, and outlines of mixes whose correspondence is known.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "core/atlas/atlas.h"
#include "core/silhouette/morph_set.h"

namespace {

using namespace sporeprint;

/// The control shapes of some species, each divided by the height of its mature stage.
std::vector<ControlShape> shapes_of(const std::vector<std::string>& ids, const Atlas& atlas) {
    std::vector<ControlShape> shapes;
    for (std::size_t kin = 0; kin < ids.size(); ++kin) {
        const Species& species = atlas.find(ids[kin])->species;
        double size = 0.0;
        for (const Stage& stage : species.stages)
            if (stage.age <= 0.6) size = std::get<Swept>(stage.model.shape).silhouette.cap.back().y;
        for (const Stage& stage : species.stages)
            shapes.push_back({std::get<Swept>(stage.model.shape).silhouette, size, kin, stage.age});
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

void mixed_outline(benchmark::State& state, const std::vector<std::string>& ids) {
    const auto atlas = built_in_atlas();
    const MorphSet set(shapes_of(ids, *atlas));
    const std::vector<double> weights(set.size(), 1.0 / static_cast<double>(set.size()));
    for (auto _ : state) benchmark::DoNotOptimize(Outline(set.nodes(weights), set.places()));
}

[[maybe_unused]] const bool registered = [] {
    const auto atlas = built_in_atlas();
    std::vector<std::string> ids;
    for (const AtlasEntry& entry : atlas->entries()) ids.push_back(entry.species.id.string());
    const auto add = [](const std::string& name, const std::vector<std::string>& of) {
        benchmark::RegisterBenchmark(("correspondence/" + name).c_str(), [of](benchmark::State& s) {
            corresponding(s, of);
        })->Unit(benchmark::kMillisecond);
    };
    for (std::size_t i = 0; i < ids.size(); ++i)
        for (std::size_t j = i + 1; j < ids.size(); ++j)
            add(ids[i] + "_and_" + ids[j], {ids[i], ids[j]});
    add("all_eight", ids);
    benchmark::RegisterBenchmark("mixed_outline/all_eight", [ids](benchmark::State& s) {
        mixed_outline(s, ids);
    })->Unit(benchmark::kMicrosecond);
    benchmark::RegisterBenchmark("mixed_outline/a_pair", [ids](benchmark::State& s) {
        mixed_outline(s, {ids[0], ids[1]});
    })->Unit(benchmark::kMicrosecond);
    return true;
}();

}  // namespace
