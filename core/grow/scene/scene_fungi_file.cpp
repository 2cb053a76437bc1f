#include "core/grow/scene/scene_fungi_file.h"

#include <cmath>
#include <cstdint>
#include <deque>
#include <utility>

#include "core/grow/scene/scene_placements.h"
#include "core/grow/world/body_nodes.h"
#include "core/grow/world/plot_bodies.h"
#include "core/grow/world/plot_parts.h"
#include "core/grow/world/plot_places.h"
#include "core/grow/world/world_materials.h"
#include "core/problems.h"

namespace sporeprint {

namespace {

void check(const SceneFungiOptions& options) {
    if (options.lod < 0 || options.lod > 2) throw InvalidInput("/lod", "is 0..2");
    if (has_addresses(options.textures))
        throw Impossible("/textures",
                         "the fungi of a scene have their images in the file; ask for embedded, or "
                         "for none");
}

/// The scene of the file with everything that it refers to.
class FungiFile {
  public:
    FungiFile(const std::vector<std::string>& species, const SceneFungiOptions& options,
              const Atlas& atlas, const Extras& extras, const ExecutionContext& execution)
        : species_(species),
          options_(options),
          extras_(extras),
          execution_(execution),
          materials_(scene_, options.textures, options.file, no_urls_, atlas, execution) {
        set_options(scene_, options.file);
        scene_.stands_on_ground = false;
    }

    Grown grow(PlotBodies bodies) {
        bodies_ = std::move(bodies);
        if (options_.textures == Textures::none)
            for (PlotBodies::Shape& shape : bodies_.shapes) {
                shape.mesh.texture_coordinates.clear();
                shape.mesh.tangents.clear();
            }
        const bool is_crowded = bodies_.bodies.size() > most_scene_nodes;
        BodyNodes added = add_bodies(scene_, materials_, bodies_,
                                     grouping_of(options_.instancing, is_crowded), merged_);
        nodes_ = std::move(added.nodes);
        box_ = added.box;
        Grown grown;
        grown.vertices = added.vertices;
        grown.triangles = added.triangles;
        if (scene_.nodes.empty()) scene_.nodes.push_back({.name = "fungi"});
        throw_if_cancelled(execution_);
        execution_.observer(Step::pack);
        scene_.extras_json = dump(extras_value(grown.triangles));
        grown.glb = extras_.write(scene_, execution_.parallel);
        return grown;
    }

  private:
    [[nodiscard]] Value extras_value(std::uint64_t triangles) const {
        const Bounds box = bodies_.bodies.empty() ? Bounds{} : box_;
        Value extras = sporeprint::extras_value(extras_, Value::object(), box, triangles, {}, {});
        Value list = Value::array();
        for (std::size_t i = 0; i < bodies_.bodies.size(); ++i) {
            const PlotBodies::Placed& body = bodies_.bodies[i];
            list.push(Value::object()
                          .set("id", id_text(body.id))
                          .set("species", species_[body.species])
                          .set("seed", static_cast<std::uint32_t>(body.id))
                          .set("age", std::floor(body.age * 1000.0 + 0.5) / 1000.0)
                          .set("node", nodes_[i]));
        }
        return extras.set("bodies", std::move(list));
    }

    const std::vector<std::string>& species_;
    const SceneFungiOptions& options_;
    const Extras& extras_;
    const ExecutionContext& execution_;
    GlbScene scene_;
    MaterialUrls no_urls_;
    WorldMaterials materials_;
    PlotBodies bodies_;
    std::deque<Mesh> merged_;
    std::vector<std::size_t> nodes_;
    Bounds box_;
};

}  // namespace

Grown grow_scene_fungi(const std::vector<SceneBody>& bodies, WorldTime time,
                       const std::vector<std::string>& species, const SceneFungiOptions& options,
                       const Atlas& atlas, const Extras& extras,
                       const ExecutionContext& execution) {
    check(options);
    execution.observer(Step::build);
    std::vector<const FruitBody*> standing;
    std::vector<const SceneBody*> of_scene;
    for (const SceneBody& body : bodies) {
        if (!body.record.stands_at(time)) continue;
        standing.push_back(&body.record);
        of_scene.push_back(&body);
    }
    PlotBodies shown = shown_bodies(
        standing, time, species,
        [&](std::size_t number, bool is_lateral) {
            return place_of(*of_scene[number], is_lateral);
        },
        {options.lod, options.textures, options.file, most_scene_body_triangles}, atlas, execution);
    return FungiFile(species, options, atlas, extras, execution).grow(std::move(shown));
}

}  // namespace sporeprint
