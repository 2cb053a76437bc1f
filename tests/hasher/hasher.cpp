// Prints a hash of the GLB of each of many random requests, from core alone, until `count` of them were grown;
// what a species cannot have is refused, and printed too; then a fifth as many leaves, a tenth as many trees, and a fifth as many
// colonies. Builds by other compilers and runs with other
// instruction sets must print the same text: tests/hasher/four_ways.sh compares them.
//   hasher [count] [simd name]     hasher --simd-names

#include <charconv>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/grow/colony.h"
#include "core/grow/leaf.h"
#include "core/grow/mushroom.h"
#include "core/grow/tree.h"
#include "core/math/noise.h"
#include "core/math/random.h"
#include "core/params/query.h"

namespace {

using namespace sporeprint;

/// FNV-1a, 64 bits: enough to tell that bytes differ, and short enough to be read here.
std::uint64_t hash_of(const Body& body) {
    std::uint64_t hash = 14695981039346656037u;
    for (const Slice& slice : body) {
        for (std::size_t i = 0; i < slice.size; ++i) {
            hash = (hash ^ slice.data()[i]) * 1099511628211u;
        }
    }
    return hash;
}

/// Sets a third of the optional members, anywhere below, to a random allowed value.
template <class T>
void draw_overrides(T& value, const Info& info, Random& random) {
    if constexpr (std::is_same_v<T, std::optional<double>>) {
        const double chance = random.uniform();
        const double drawn = random.uniform(info.min, info.max);
        if (chance < 0.3) value = drawn;
    } else if constexpr (std::is_same_v<T, std::optional<int>>) {
        const double chance = random.uniform();
        const double drawn = random.uniform(info.min, info.max);
        if (chance < 0.3) value = static_cast<int>(drawn);
    } else if constexpr (Described<T>) {
        T::fields(
            [&](auto member, const Info& sub) { draw_overrides(value.*member, sub, random); });
    }
}

MushroomOrder random_order(std::uint32_t number, const Atlas& atlas) {
    Random random(number, 0x68617368);
    const auto& entries = atlas.entries();
    const auto any_species = [&] { return entries[random.bits() % entries.size()].species.id; };

    MushroomOrder order;
    order.mix.push_back({std::string(any_species().view()), 1000});
    order.params.seed = random.bits();
    order.params.age = random.uniform();
    order.params.size = random.uniform(0.25, 4.0);
    order.params.variation = random.uniform();
    order.params.lod = static_cast<int>(random.bits() % 4);
    order.params.texture_size.value = 128;
    const std::uint32_t textures = random.bits() % 8;
    if (textures == 0) order.params.textures = Textures::none;
    if (random.bits() % 2 == 0) draw_overrides(order.params, Info{.name = ""}, random);
    return order;
}

/// Prints the line of one request and returns whether a mushroom was grown.
bool print_line(const MushroomOrder& order, const Atlas& atlas) {
    const std::string request = order.mix.front().id + '?' + query_text(order.params);
    try {
        const Mushroom mushroom = grow_mushroom(order, atlas);
        std::printf("%016llx %8zu  %s\n", static_cast<unsigned long long>(hash_of(mushroom.glb)),
                    size_of(mushroom.glb), request.c_str());
        return true;
    } catch (const InvalidInput& refusal) {
        std::printf("refused  %s  %s\n", request.c_str(), refusal.what());
        return false;
    }
}

/// Prints the line of a leaf of random veins, or that it cannot be.
void print_leaf(std::uint32_t number) {
    Random random(number, 0x6c656166);
    const LeafPreset& preset = leaf_presets()[number % leaf_presets().size()];
    LeafOrder order{preset.id, params_of(preset)};
    LeafParams& params = order.params;
    params.seed = random.bits();
    params.variation = random.uniform();
    params.autumn = random.uniform();
    params.lod = static_cast<int>(random.bits() % leaf_lods);
    params.texture_size.value = 128;
    params.shape.curl_deg = random.uniform(-180.0, 180.0);
    params.shape.venation.rise = random.uniform(0.0, 4.0);
    params.shape.venation.border = random.uniform(1.0, 2.0);
    params.shape.venation.side_deg = random.uniform(15.0, 88.0);
    const std::string request =
        std::string("leaf/") + preset.id + '?' + query_text(params, params_of(preset));
    try {
        const Grown leaf = grow_leaf(order);
        std::printf("%016llx %8zu  %s\n", static_cast<unsigned long long>(hash_of(leaf.glb)),
                    size_of(leaf.glb), request.c_str());
    } catch (const InvalidInput& refusal) {
        std::printf("refused  %s  %s\n", request.c_str(), refusal.what());
    }
}

/// Prints the line of a tree of random angles, laws and leaves, or that it cannot be.
void print_tree(std::uint32_t number) {
    Random random(number, 0x74726565);
    const TreePreset& preset = tree_presets()[number % tree_presets().size()];
    TreeOrder order{preset.id, params_of(preset)};
    TreeParams& params = order.params;
    TreeShape& shape = params.look.shape;
    params.seed = random.bits();
    params.autumn = random.uniform();
    params.lod = static_cast<int>(random.bits() % tree_lods);
    params.texture_size.value = 128;
    params.look.leaf = static_cast<LeafKind>(random.bits() % leaf_presets().size());
    params.look.leaves.droop = random.uniform();
    params.look.bark.furrows = random.uniform();
    shape.width_rise = random.uniform(1.0, 3.0);
    shape.length_rise = random.uniform(0.6, 1.4);
    shape.fork_deg = random.uniform(0.0, 80.0);
    shape.side_deg = random.uniform(0.0, 100.0);
    shape.gravitropism = random.uniform(-0.2, 0.2);
    shape.phototropism = random.uniform(0.0, 0.2);
    shape.plagiotropy = random.uniform();
    shape.variation = random.uniform();
    if (random.bits() % 4 == 0) shape.topology.growth = TreeGrowth::drawn;
    const std::string request =
        std::string("tree/") + preset.id + '?' + query_text(params, params_of(preset));
    try {
        const Grown tree = grow_tree(order);
        std::printf("%016llx %8zu  %s\n", static_cast<unsigned long long>(hash_of(tree.glb)),
                    size_of(tree.glb), request.c_str());
    } catch (const InvalidInput& refusal) {
        std::printf("refused  %s  %s\n", request.c_str(), refusal.what());
    }
}

/// Prints the line of a colony of one species, or that it cannot be.
void print_colony(std::uint32_t number, const Atlas& atlas) {
    Random random(number, 0x636f6c6f);
    const auto& entries = atlas.entries();
    ColonyOrder order;
    order.mix = {{entries[random.bits() % entries.size()].species.id.string(), 1000}};
    ColonyParams& params = order.params;
    params.seed = random.bits();
    params.count = static_cast<int>(random.uniform(1.0, 48.0));
    params.distinct = static_cast<int>(random.uniform(1.0, 6.0));
    params.age = random.uniform();
    params.size = random.uniform(0.25, 4.0);
    params.lod = static_cast<int>(random.bits() % 4);
    params.texture_size.value = 128;
    if (random.bits() % 2 == 0) params.habit = static_cast<Habit>(random.bits() % 5);
    if (random.bits() % 2 == 0) params.instancing = Instancing::gpu;
    const std::string request = "colony/" + order.mix.front().id + '?' + query_text(params);
    try {
        const Grown colony = grow_colony(order, atlas);
        std::printf("%016llx %8zu  %s\n", static_cast<unsigned long long>(hash_of(colony.glb)),
                    size_of(colony.glb), request.c_str());
    } catch (const InvalidInput& refusal) {
        std::printf("refused  %s  %s\n", request.c_str(), refusal.what());
    }
}

}  // namespace

int main(int argc, char** argv) try {
    const std::vector<std::string_view> arguments(argv + 1, argv + argc);
    if (!arguments.empty() && arguments[0] == "--simd-names") {
        for (const std::string& name : simd_names()) std::puts(name.c_str());
        return 0;
    }
    std::uint32_t count = 200;
    if (!arguments.empty()) {
        const std::string_view text = arguments[0];
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
        if (error != std::errc() || end != text.data() + text.size()) {
            std::fputs("usage: hasher [count] [simd name] | hasher --simd-names\n", stderr);
            return 2;
        }
    }
    if (arguments.size() > 1) force_simd(arguments[1]);

    const auto atlas = built_in_atlas();
    for (std::uint32_t number = 0, grown = 0; grown < count; ++number) {
        if (number > 100 * count) throw GenerationError("hardly any random request can be grown");
        if (print_line(random_order(number, *atlas), *atlas)) ++grown;
    }
    for (std::uint32_t number = 0; number < count / 5; ++number) print_leaf(number);
    for (std::uint32_t number = 0; number < count / 10; ++number) print_tree(number);
    for (std::uint32_t number = 0; number < count / 5; ++number) print_colony(number, *atlas);
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "hasher: %s\n", error.what());
    return 1;
}
