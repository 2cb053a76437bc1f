#include "core/grow/scene/scene_placements.h"

#include <cstdint>
#include <glm/geometric.hpp>

#include "core/math/direction.h"
#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"

namespace sporeprint {

GlbTransform place_of(const SceneBody& body, bool is_lateral) {
    if (is_lateral && body.record.trunk != 0) {
        const glm::dvec3 up = square_to(body.out, {0.0, 1.0, 0.0});
        return {body.at, quaternion_of({glm::cross(up, body.out), up, body.out})};
    }
    Random random(body.record.seed(), purposes::plot_pieces, 2);
    const SineCosine half = sine_cosine(pi * random.uniform());
    return {body.at, {0.0, half.sine, 0.0, half.cosine}};
}

std::vector<bool> lateral_species(const std::vector<std::string>& ids, const Atlas& atlas) {
    std::vector<bool> lateral;
    for (const std::string& id : ids) {
        const AtlasEntry* const entry = atlas.find(id);
        lateral.push_back(entry != nullptr && entry->species.is_lateral());
    }
    return lateral;
}

std::vector<ScenePlacement> placements_on(const SceneFungi& fungi,
                                          const std::vector<SceneBody>& bodies, WorldTime time,
                                          const std::vector<bool>& lateral,
                                          const std::vector<bool>& chosen) {
    const SceneHabitat& habitat = *fungi.habitat;
    std::vector<ScenePlacement> out;
    for (const SceneBody& body : bodies) {
        const FruitBody& record = body.record;
        if (!record.stands_at(time) || (!chosen.empty() && !chosen[record.species])) continue;
        ScenePlacement one;
        one.row.id = record.id;
        one.row.kind = PlacementKind::fungus;
        one.row.species = record.species;
        one.row.place = place_of(body, lateral[record.species]);
        one.row.began = record.emerged;
        one.row.age = age_at(record, time);
        one.row.seed = record.seed();
        one.row.host = record.host;
        one.row.trunk = record.trunk;
        one.soil = habitat.substrates.soils[body.surfel];
        one.material = habitat.surfels()[body.surfel].material;
        out.push_back(one);
    }
    return out;
}

}  // namespace sporeprint
