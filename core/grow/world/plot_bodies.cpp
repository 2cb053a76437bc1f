#include "core/grow/world/plot_bodies.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <optional>
#include <tuple>

#include "core/grow/mushroom.h"
#include "core/grow/names.h"
#include "core/individual/resolve.h"
#include "core/math/direction.h"
#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/params/canonical.h"
#include "core/world/season.h"

namespace sporeprint {

namespace {

/// Ages of individuals are the middles of so many equal parts of a life.
constexpr int finest_ages = 16;

/// Individuals of one species and age, at most.
constexpr std::size_t most_seeds = 4;

/// Side of the images of mushrooms at LOD 0, texels; it halves with every level.
constexpr int body_texture_side = 512;

/// Which individual shows a body: its species, the part of its life, and its seed.
using ShapeKey = std::tuple<std::size_t, int, std::uint32_t>;

struct ShapeChoice {
    int parts = finest_ages;  ///< of a life
    std::uint32_t seeds = 1;
};

ShapeKey key_of(const FruitBody& body, WorldTime time, const ShapeChoice& choice) {
    return {body.species, part_of_life(age_at(body, time), choice.parts),
            static_cast<std::uint32_t>(body.id >> 32U) % choice.seeds};
}

/// Returns the finest choice with few enough individuals.
ShapeChoice chosen(const std::vector<const FruitBody*>& bodies, WorldTime time) {
    const auto count = [&](const ShapeChoice& choice) {
        std::map<ShapeKey, int> different;
        for (const FruitBody* body : bodies) different[key_of(*body, time, choice)] = 1;
        return different.size();
    };
    ShapeChoice choice;
    while (choice.parts > 1 && count(choice) > most_plot_mushrooms) choice.parts /= 2;
    while (choice.seeds < most_seeds &&
           count({choice.parts, choice.seeds + 1}) <= most_plot_mushrooms)
        ++choice.seeds;
    return choice;
}

}  // namespace

int part_of_life(double age, int parts) {
    return std::min(static_cast<int>(age * parts), parts - 1);
}

BodyLook look_of_body(const PlotContent& content, std::size_t species, double age,
                      std::uint32_t seed, const Atlas& atlas) {
    return look_of_body(content.species, species, age, seed, atlas);
}

BodyLook look_of_body(const std::vector<std::string>& ids, std::size_t species, double age,
                      std::uint32_t seed, const Atlas& atlas) {
    const std::string path = "/species/" + std::to_string(species);
    if (species >= ids.size())
        throw InvalidInput(path, "a body is of a species that the world does not have");
    const std::string& id = ids[species];
    const AtlasEntry* const entry = atlas.find(id);
    if (entry == nullptr) throw InvalidInput(path, "there is no species '" + id + "'");
    BodyLook look;
    look.is_lateral = entry->species.is_lateral();
    look.spec.mix = {{id, 1000}};
    look.spec.params.seed = seed;
    look.spec.params.age = age;
    look.spec.params.texture_size.value = body_texture_side;
    look.spec.params.share = ImageShare::species;
    if (look.is_lateral) look.spec.params.substrate = Substrate::none;
    return look;
}

std::size_t BodyShape::bytes() const {
    // Position, normal, tangent and texture coordinates of each vertex, and about what is in the lists of an individual.
    constexpr std::size_t of_vertex = 48, of_lists = 8'192;
    return sizeof(BodyShape) + individual.parts.size() * sizeof(SpeciesShare) + of_lists +
           mesh.positions.size() * of_vertex + mesh.indices.size() * sizeof(std::uint32_t);
}

std::shared_ptr<const BodyShape> body_shape(const MushroomSpec& spec, const Atlas& atlas,
                                            const ExecutionContext& execution) {
    // A draft of a library changes under its name.
    std::string key = "tile body ";
    for (const MixPart& part : spec.mix)
        if (const AtlasEntry* const entry = atlas.find(part.id))
            (key += part.id) += ' ' + std::to_string(entry->hash) + ' ';
    return execution.caches.bodies(key + canonical_text(spec.params), [&] {
        Individual individual = resolve(spec, atlas, execution.caches.morphs);
        Mesh mesh = mushroom_mesh(spec, individual);
        return std::make_shared<const BodyShape>(BodyShape{std::move(individual), std::move(mesh)});
    });
}

PlotBodies shown_bodies(const std::vector<const FruitBody*>& bodies, WorldTime time,
                        const std::vector<std::string>& species, const BodyPlace& place,
                        const BodyDetail& detail, const Atlas& atlas,
                        const ExecutionContext& execution) {
    PlotBodies made;
    const ShapeChoice choice = chosen(bodies, time);
    std::map<ShapeKey, std::size_t> shape_of;
    std::vector<bool> is_lateral;
    made.bodies.reserve(bodies.size());
    for (std::size_t number = 0; number < bodies.size(); ++number) {
        const FruitBody* const body = bodies[number];
        const ShapeKey key = key_of(*body, time, choice);
        const auto [found, is_new] = shape_of.try_emplace(key, made.shapes.size());
        if (is_new) {
            throw_if_cancelled(execution);
            auto [spec, lateral] =
                look_of_body(species, body->species, (std::get<1>(key) + 0.5) / choice.parts,
                             1 + std::get<2>(key), atlas);
            spec.params.lod = detail.lod;
            spec.params.textures = detail.textures;
            spec.params.file = detail.file;
            is_lateral.push_back(lateral);
            Individual individual = resolve(spec, atlas, execution.caches.morphs);
            made.shapes.push_back({std::move(spec), std::move(individual), {}, {}});
        }
        made.bodies.push_back({found->second, body->id, body->species, age_at(*body, time),
                               place(number, is_lateral[found->second])});
    }
    for (int lod = detail.lod; lod <= last_lod; ++lod) {
        std::vector<std::uint64_t> triangles;
        triangles.reserve(made.shapes.size());
        for (PlotBodies::Shape& shape : made.shapes) {
            shape.spec.params.lod = lod;
            triangles.push_back(estimate(shape.spec, shape.individual).triangles);
        }
        std::uint64_t all = 0;
        for (const PlotBodies::Placed& body : made.bodies) all += triangles[body.shape];
        if (all <= detail.most) break;
    }
    for (PlotBodies::Shape& shape : made.shapes) {
        throw_if_cancelled(execution);
        shape.mesh = mushroom_mesh(shape.spec, shape.individual);
        shape.name = level_name(product_name(shape.spec), shape.spec.params.lod);
    }
    return made;
}

PlotBodies bodies_of(const PlotContent& content, const PlotOptions& options, const PlotFrame& frame,
                     std::uint64_t most, const Atlas& atlas, const ExecutionContext& execution) {
    std::vector<const FruitBody*> standing;
    for (const FruitBody& body : content.bodies)
        if (body.stands_at(content.time) && frame.has(body.at)) standing.push_back(&body);
    BearingTrunks trunks(content, frame);
    const auto place = [&](std::size_t number, bool is_lateral) {
        return place_of(*standing[number], frame, is_lateral, trunks);
    };
    return shown_bodies(standing, content.time, content.species, place,
                        {options.lod, options.textures, options.file, most}, atlas, execution);
}

}  // namespace sporeprint
