#include "core/grow/names.h"

#include <xxhash.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <utility>

#include "core/params/canonical.h"
#include "core/params/messages.h"

namespace sporeprint {

namespace {

/// Species that a name lists; larger mixes are named after the one with the largest weight.
constexpr std::size_t most_listed = 2;

/// Returns '_' and eight hexadecimal digits of the hash of a text.
std::string hash_of(std::string_view text) {
    const std::uint64_t hash = XXH3_64bits(text.data(), text.size());
    std::array<char, 8> digits{};
    for (std::size_t i = 0; i < digits.size(); ++i)
        digits[i] = "0123456789abcdef"[(hash >> (4 * (15 - i))) & 0xF];
    return '_' + std::string(digits.data(), digits.size());
}

std::string with_seed(std::string name, std::uint32_t seed) {
    return std::move(name) + "_s" + std::to_string(seed);
}

std::string with_triangles(std::string name, int triangles) {
    return std::move(name) + "_t" + std::to_string(triangles);
}

double percent_of(double age) { return std::floor(100.0 * age + 0.5); }

std::string with_age(std::string name, double age) {
    return std::move(name) + "_a" + std::to_string(static_cast<int>(percent_of(age)));
}

/// Returns the species of a mix by weight. The order of the mix does not matter.
std::string named(Mix mix) {
    std::sort(mix.begin(), mix.end(), [](const MixPart& a, const MixPart& b) {
        return a.weight != b.weight ? a.weight > b.weight : a.id < b.id;
    });
    if (mix.size() == 1) return name_of_species(mix.front().id);
    std::string name;
    for (std::size_t i = 0; i < std::min(mix.size(), most_listed); ++i)
        name +=
            (i > 0 ? "_" : "") + name_of_species(mix[i].id) + '_' + std::to_string(mix[i].weight);
    return mix.size() > most_listed
               ? name + "_and_" + std::to_string(mix.size() - most_listed) + "_more"
               : name;
}

/// Returns the text of species that named() does not list.
std::string unlisted(Mix mix) {
    if (mix.size() <= most_listed) return {};
    std::sort(mix.begin(), mix.end(),
              [](const MixPart& a, const MixPart& b) { return a.id < b.id; });
    std::string text;
    for (const MixPart& part : mix) text += part.id + ' ' + std::to_string(part.weight) + ' ';
    return text;
}

/// Returns the text of the parameters that no name states; empty if all have their defaults.
///
/// own  the defaults
template <class Params>
std::string unnamed(Params params, const Params& own) {
    params.seed = own.seed;
    params.lod = own.lod;
    params.triangles.reset();
    params.file = own.file;
    if constexpr (requires { params.age; }) {
        // An age that is not a whole percentage is named by its nearest one.
        if (params.age == percent_of(params.age) / 100.0) params.age = own.age;
    }
    std::string text = canonical_text(params);
    return text == canonical_text(own) ? std::string() : text;
}

std::string shared_name(std::string preset, const char* part, std::string paint,
                        Textures textures) {
    ((paint += ' ') += name(textures));
    return (std::move(preset) += part) + hash_of(paint);
}

std::string with_hash(std::string name, const std::string& text) {
    return text.empty() ? name : std::move(name) + hash_of(text);
}

}  // namespace

std::string name_of_species(const std::string& id) {
    const auto belongs = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
    };
    if (std::all_of(id.begin(), id.end(), belongs)) return id;
    std::string word;
    for (const char c : id)
        if (belongs(c) || !word.empty()) word += belongs(c) ? c : '_';
    return word + hash_of(id);
}

std::string mix_text(const Mix& mix) {
    if (mix.size() == 1) return mix.front().id;
    std::string text;
    for (const MixPart& part : mix) {
        if (!text.empty()) text += ',';
        ((text += part.id) += ':') += number_text(part.weight / 1000.0);
    }
    return text;
}

std::string product_name(const MushroomSpec& spec) {
    std::string text = unnamed(spec.params, MushroomParams{}) + unlisted(spec.mix);
    if (spec.model) canonical(*spec.model, text);
    for (const Arc& arc : spec.arcs) canonical(arc, text);
    const std::string subject = spec.model || spec.mix.empty() ? "model" : named(spec.mix);
    return with_hash(with_age(with_seed(subject, spec.params.seed), spec.params.age), text);
}

std::string product_name(const ColonySpec& spec) {
    const std::string text = unnamed(spec.params, ColonyParams{}) + unlisted(spec.mix);
    return with_hash(
        with_age(with_seed(named(spec.mix) + "_colony", spec.params.seed), spec.params.age), text);
}

std::string product_name(const LeafSpec& spec, const Atlas& atlas) {
    const LeafPreset* const preset = atlas.find_leaf(spec.preset);
    return with_hash(with_seed(preset ? spec.preset + "_leaf" : "leaf", spec.params.seed),
                     unnamed(spec.params, preset ? params_of(*preset) : LeafParams{}));
}

std::string product_name(const TreeSpec& spec, const Atlas& atlas) {
    const TreePreset* const preset = atlas.find_tree(spec.preset);
    return with_hash(with_seed(preset ? spec.preset + "_tree" : "tree", spec.params.seed),
                     unnamed(spec.params, preset ? params_of(*preset) : TreeParams{}));
}

std::string level_name(const std::string& name, int lod) {
    return name + "_LOD" + std::to_string(lod);
}

std::string level_name(const MushroomSpec& spec, std::size_t index) {
    const MushroomParams& params = spec.params;
    const std::string name = product_name(spec);
    if (params.triangles)
        return level_name(with_triangles(name, *params.triangles), static_cast<int>(index));
    if (params.file.lods == Lods::single) return level_name(name, params.lod);
    return level_name(name + "_from" + std::to_string(params.lod), static_cast<int>(index));
}

std::string file_name(const std::string& name, int lod, const std::optional<int>& triangles,
                      const FileOptions& file) {
    std::string out =
        triangles ? level_name(with_triangles(name, *triangles), 0) : level_name(name, lod);
    FileOptions::fields([&](auto option, const Info& info) {
        using Option = std::remove_cvref_t<decltype(file.*option)>;
        if (file.*option == FileOptions{}.*option) return;
        // Other options have values of the same names.
        if constexpr (std::is_same_v<Option, CollisionFormat>) out += "_collision";
        if constexpr (std::is_same_v<Option, WindFormat>) out += "_wind";
        if constexpr (std::is_same_v<Option, bool>)
            (out += '_') += info.name;
        else
            (out += '_') += sporeprint::name(static_cast<Option>(file.*option));
    });
    return out;
}

std::string skin_name(const MushroomSpec& spec) {
    MushroomSpec painted = spec;
    painted.params.seed = painted_seed(spec.params.seed, spec.params.share);
    if (painted.params.seeds && spec.params.share == ImageShare::species)
        painted.params.seeds->shape.reset();
    painted.params.drop_equal_seeds();
    painted.params.substrate.reset();
    return level_name(product_name(painted) + "_skin", spec.params.lod);
}

std::string skin_name(const ColonySpec& spec) {
    MushroomSpec painted;
    painted.mix = spec.mix;
    painted.params.seed = painted_seed(spec.params.seed, spec.params.share);
    painted.params.share = spec.params.share;
    painted.params.age = spec.params.age;
    painted.params.texture_size = spec.params.texture_size;
    painted.params.textures = spec.params.textures;
    painted.params.base = spec.params.base;
    return level_name(product_name(painted) + "_colony_skin", spec.params.lod);
}

std::string atlas_name(const Mix& mix, const std::vector<std::string>& tiles) {
    std::string text;
    for (const std::string& tile : tiles) (text += tile) += ' ';
    return (mix.empty() ? "mushrooms" : named(mix)) + "_atlas" + hash_of(text);
}

std::string bark_name(const std::string& preset, const TreePaint& paint, Textures textures) {
    return shared_name(preset.empty() ? "tree" : preset, "_bark", canonical_text(paint), textures);
}

std::string wood_name(const WoodPaint& paint, Textures textures) {
    return std::string(name(paint.substrate)) + "_wood_" +
           std::to_string(paint.texture_size.value) + '_' + name(textures);
}

std::string leaf_material_name(const std::string& preset, const LeafPaint& paint,
                               Textures textures) {
    return shared_name(preset.empty() ? "own" : preset, "_leaf", canonical_text(paint), textures);
}

}  // namespace sporeprint
