// Requests to core for tests, and the species that they use.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "core/grow/mushroom.h"
#include "core/problems.h"
#include "tests/core/params/arbitrary.h"
#include "tests/support/atlas.h"
#include "tests/support/refusals.h"

namespace sporeprint {

inline std::vector<std::string> species_ids() {
    std::vector<std::string> ids;
    for (const AtlasEntry& entry : atlas().entries()) ids.push_back(entry.species.id.string());
    return ids;
}

[[nodiscard]] inline bool is_branched(const Species& species) {
    return std::holds_alternative<Branched>(species.stages.front().model.shape);
}

/// Returns an atlas of the swept species only.
inline const Atlas& swept_atlas() {
    static const Atlas swept = [] {
        std::vector<std::string> texts;
        for (const AtlasEntry& entry : atlas().entries())
            if (!is_branched(entry.species)) texts.push_back(entry.json);
        return Atlas({.species = texts});
    }();
    return swept;
}

inline std::vector<std::string> swept_ids() {
    std::vector<std::string> ids;
    for (const AtlasEntry& entry : swept_atlas().entries())
        ids.push_back(entry.species.id.string());
    return ids;
}

/// Returns the ids of the branched species.
inline std::vector<std::string> branched_ids() {
    std::vector<std::string> ids;
    for (const AtlasEntry& entry : atlas().entries())
        if (is_branched(entry.species)) ids.push_back(entry.species.id.string());
    return ids;
}

/// Returns a request for one species, without images, without wood behind brackets and without
/// ground at its foot.
inline MushroomSpec order_of(const std::string& id, double age = 0.6, std::uint32_t seed = 1,
                             int lod = 0) {
    MushroomSpec order;
    order.mix = {{id, 1000}};
    order.params.age = age;
    order.params.seed = seed;
    order.params.lod = lod;
    order.params.textures = Textures::none;
    order.params.substrate = Substrate::none;
    order.params.base = Base::clean;
    return order;
}

/// Returns the same request with the ground of the species at its foot.
inline MushroomSpec on_ground(MushroomSpec order) {
    order.params.base = Base::natural;
    return order;
}

/// Returns the same request with the wood of the species behind brackets, which are bent round it.
inline MushroomSpec on_wood(MushroomSpec order) {
    order.params.substrate.reset();
    return order;
}

/// Returns the same request with texture coordinates and tangents, still without images.
inline MushroomSpec textured(MushroomSpec order) {
    order.params.textures = Textures::linked;
    return order;
}

/// Returns the same request with an animation of its growth.
inline MushroomSpec growing(MushroomSpec order, int frames = 9) {
    order.params.animation = Animation::growth;
    order.params.frames = frames;
    return order;
}

/// Returns the same request with small images.
inline MushroomSpec painted(MushroomSpec order, int side = 128) {
    order.params.textures = Textures::embedded;
    order.params.texture_size.value = side;
    return order;
}

/// Returns a cache of correspondences that lives as long as the program.
inline GetOrCompute<MorphSet> cached_morphs() {
    struct Cache {
        std::mutex mutex;
        std::map<std::string, std::shared_ptr<const MorphSet>> sets;
    };
    static const auto cache = std::make_shared<Cache>();
    return
        [](const std::string& key, const std::function<std::shared_ptr<const MorphSet>()>& make) {
            const std::lock_guard lock(cache->mutex);
            auto& set = cache->sets[key];
            if (!set) set = make();
            return set;
        };
}

/// Returns the individual of a request, with its correspondence from cached_morphs().
inline Individual resolved(const MushroomSpec& order) {
    return resolve(order, atlas(), cached_morphs());
}

inline Mesh mesh_of(const MushroomSpec& order) { return mushroom_mesh(order, resolved(order)); }

inline const Silhouette& silhouette_of(const Model& model) {
    return std::get<Swept>(model.shape).silhouette;
}

/// Returns the outline in the template of a species for the age nearest to 0.6.
inline const Silhouette& mature_silhouette(const std::string& id) {
    const std::vector<Stage>& stages = atlas().find(id)->species.stages;
    const auto nearest =
        std::min_element(stages.begin(), stages.end(), [](const Stage& a, const Stage& b) {
            return std::abs(a.age - 0.6) < std::abs(b.age - 0.6);
        });
    return silhouette_of(nearest->model);
}

/// Returns the individual of a custom model.
inline Individual individual_of(const Model& model, std::uint32_t seed = 1, int lod = 0) {
    MushroomSpec order;
    order.model = model;
    order.params.seed = seed;
    order.params.lod = lod;
    return resolve(order, Atlas({}));
}

/// Returns a request for a mix, weights in thousandths, without images.
inline MushroomSpec mix_of(const Mix& mix, double age = 0.6, std::uint32_t seed = 1, int lod = 0) {
    MushroomSpec order = order_of("", age, seed, lod);
    order.mix = mix;
    return order;
}

/// Returns the concatenated bytes of a body.
inline Bytes joined(const Body& body) {
    Bytes bytes;
    bytes.reserve(size_of(body));
    for (const Slice& slice : body)
        bytes.insert(bytes.end(), slice.data(), slice.data() + slice.size);
    return bytes;
}

/// Returns random parameters inside their ranges, for RapidCheck, that obey the cross-field rules.
inline MushroomParams arbitrary_params() {
    MushroomParams params;
    arbitrary(params, Info{.name = ""});
    if (params.animation == Animation::none) {
        params.frames = MushroomParams{}.frames;
        params.targets = MushroomParams{}.targets;
    } else {
        params.file.lods = Lods::single;
    }
    if (params.triangles) params.lod = lod_of(params.file.profile);
    if (params.file.lods == Lods::single) params.file.impostor = false;
    auto& deformation = params.deformation;
    if (deformation.zone_from && deformation.zone_to &&
        *deformation.zone_to < *deformation.zone_from + 0.1)
        deformation.zone_to.reset();
    return params;
}

}  // namespace sporeprint
