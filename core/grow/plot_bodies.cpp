#include "core/grow/plot_bodies.h"

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
#include "core/world/season.h"

namespace sporeprint {

namespace {

/// Ages of individuals are the middles of so many equal parts of a life.
constexpr int finest_ages = 16;

/// Individuals of one species and age, at most.
constexpr std::size_t most_seeds = 4;

/// Side of the images of mushrooms at LOD 0, texels; it halves with every level.
constexpr int body_texture_side = 512;

int part_of_life(double age, int parts) {
    return std::min(static_cast<int>(age * parts), parts - 1);
}

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

/// The dead trunks of a plot on which bodies grow.
class BearingTrunks {
  public:
    BearingTrunks(const PlotContent& content, const PlotFrame& frame)
        : content_(content), frame_(frame) {}

    /// Returns the place on the bark in a direction from the axis, nearest to a body; nothing if its trunk is not
    /// there.
    [[nodiscard]] std::optional<glm::dvec3> place(const FruitBody& body, const glm::dvec3& out) {
        const auto wood = std::find_if(content_.dead_wood.begin(), content_.dead_wood.end(),
                                       [&](const DeadWood& one) { return one.id == body.trunk; });
        if (wood == content_.dead_wood.end()) return std::nullopt;
        const auto [found, is_new] = lines_.try_emplace(body.trunk);
        if (is_new) found->second = trunk_line(*wood, content_, frame_);
        if (!found->second) return std::nullopt;
        const SineCosine turn = sine_cosine(wood->direction);
        const double along = wood->lies_at(content_.time)
                                 ? metres(body.at.x - wood->at.x) * turn.cosine +
                                       metres(body.at.y - wood->at.y) * turn.sine
                                 : body.height;
        // Slightly below the bark, which is uneven.
        constexpr double depth = 0.96;
        const TrunkSection section =
            found->second->section(std::clamp(along, found->second->from, found->second->to));
        return section.middle + depth * section.radius * out;
    }

  private:
    const PlotContent& content_;
    const PlotFrame& frame_;
    std::map<std::uint64_t, std::optional<TrunkLine>> lines_;
};

GlbTransform place_of(const FruitBody& body, const PlotFrame& frame, bool is_lateral,
                      BearingTrunks& trunks) {
    const double x = metres(body.at.x), y = metres(body.at.y);
    glm::dvec3 foot = frame.at(x, y, frame.floor().at(x, y) + body.height);
    if (body.trunk != 0) {
        const SineCosine facing = sine_cosine(body.facing), pitch = sine_cosine(body.pitch);
        const glm::dvec3 out(facing.cosine * pitch.cosine, pitch.sine, -facing.sine * pitch.cosine);
        foot = trunks.place(body, out).value_or(foot);
        if (is_lateral) {
            const glm::dvec3 up = square_to(out, {0.0, 1.0, 0.0});
            return {foot, quaternion_of({glm::cross(up, out), up, out})};
        }
    }
    Random random(body.seed(), purposes::plot_pieces, 2);
    const SineCosine half = sine_cosine(pi * random.uniform());
    return {foot, {0.0, half.sine, 0.0, half.cosine}};
}

}  // namespace

PlotBodies bodies_of(const PlotContent& content, const PlotOptions& options, const PlotFrame& frame,
                     std::uint64_t most, const Atlas& atlas, const ExecutionContext& execution) {
    std::vector<const FruitBody*> standing;
    for (const FruitBody& body : content.bodies)
        if (body.stands_at(content.time) && frame.has(body.at)) standing.push_back(&body);
    PlotBodies made;
    const ShapeChoice choice = chosen(standing, content.time);
    BearingTrunks trunks(content, frame);
    std::map<ShapeKey, std::size_t> shape_of;
    std::vector<bool> is_lateral;
    made.bodies.reserve(standing.size());
    for (const FruitBody* body : standing) {
        const ShapeKey key = key_of(*body, content.time, choice);
        const auto [found, is_new] = shape_of.try_emplace(key, made.shapes.size());
        if (is_new) {
            throw_if_cancelled(execution);
            const std::string path = "/species/" + std::to_string(body->species);
            if (body->species >= content.species.size())
                throw InvalidInput(path, "a body is of a species that the world does not have");
            const std::string& id = content.species[body->species];
            const AtlasEntry* const entry = atlas.find(id);
            if (entry == nullptr) throw InvalidInput(path, "there is no species '" + id + "'");
            MushroomSpec spec;
            spec.mix = {{id, 1000}};
            spec.params.seed = 1 + std::get<2>(key);
            spec.params.age = (std::get<1>(key) + 0.5) / choice.parts;
            spec.params.lod = options.lod;
            spec.params.texture_size.value = body_texture_side;
            spec.params.textures = options.textures;
            spec.params.share = ImageShare::species;
            spec.params.substrate = Substrate::none;
            spec.params.file = options.file;
            is_lateral.push_back(entry->species.is_lateral());
            if (!is_lateral.back()) spec.params.substrate.reset();
            Individual individual = resolve(spec, atlas, execution.caches.morphs);
            made.shapes.push_back({std::move(spec), std::move(individual), {}, {}});
        }
        made.bodies.push_back({found->second, body->id, body->species, age_at(*body, content.time),
                               place_of(*body, frame, is_lateral[found->second], trunks)});
    }
    for (int lod = options.lod; lod <= last_lod; ++lod) {
        std::vector<std::uint64_t> triangles;
        triangles.reserve(made.shapes.size());
        for (PlotBodies::Shape& shape : made.shapes) {
            shape.spec.params.lod = lod;
            triangles.push_back(estimate(shape.spec, shape.individual).triangles);
        }
        std::uint64_t all = 0;
        for (const PlotBodies::Placed& body : made.bodies) all += triangles[body.shape];
        if (all <= most) break;
    }
    for (PlotBodies::Shape& shape : made.shapes) {
        throw_if_cancelled(execution);
        shape.mesh = mushroom_mesh(shape.spec, shape.individual);
        shape.name = level_name(product_name(shape.spec), shape.spec.params.lod);
    }
    return made;
}

}  // namespace sporeprint
