#include "core/grow/scene/scene_fungi_file.h"

#include <cmath>
#include <cstdint>
#include <deque>
#include <glm/common.hpp>
#include <utility>

#include "core/grow/scene/scene_placements.h"
#include "core/grow/world/plot_bodies.h"
#include "core/grow/world/plot_parts.h"
#include "core/grow/world/plot_places.h"
#include "core/grow/world/world_materials.h"
#include "core/math/direction.h"
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
        std::vector<std::size_t> skins;
        for (const PlotBodies::Shape& shape : bodies_.shapes)
            skins.push_back(materials_.skin(shape.spec, shape.individual));
        if (options_.instancing == LeafInstancing::gpu || bodies_.bodies.size() > most_scene_nodes)
            add_groups(skins);
        else
            add_nodes(skins);
        if (scene_.nodes.empty()) scene_.nodes.push_back({.name = "fungi"});
        throw_if_cancelled(execution_);
        execution_.observer(Step::pack);
        scene_.extras_json = dump(extras_value());
        grown_.glb = extras_.write(scene_, execution_.parallel);
        return std::move(grown_);
    }

  private:
    void include(const Mesh& mesh, const GlbTransform& place) {
        for (const glm::vec3& at : mesh.positions) {
            const glm::vec3 in_scene(place.translation +
                                     rotated(place.rotation, place.scale * glm::dvec3(at)));
            box_.min = glm::min(box_.min, in_scene);
            box_.max = glm::max(box_.max, in_scene);
        }
    }

    void add_nodes(const std::vector<std::size_t>& skins) {
        std::vector<std::size_t> mesh_of;
        for (std::size_t i = 0; i < bodies_.shapes.size(); ++i) {
            const PlotBodies::Shape& shape = bodies_.shapes[i];
            mesh_of.push_back(scene_.meshes.size());
            scene_.meshes.push_back({shape.name, {{&shape.mesh, skins[i], {}}}});
            grown_.vertices += shape.mesh.positions.size();
        }
        std::size_t number = 0;
        for (const PlotBodies::Placed& body : bodies_.bodies) {
            const PlotBodies::Shape& shape = bodies_.shapes[body.shape];
            nodes_.push_back(scene_.nodes.size());
            scene_.nodes.push_back({.name = shape.name + '_' + std::to_string(++number),
                                    .mesh = mesh_of[body.shape],
                                    .translation = body.place.translation,
                                    .rotation = body.place.rotation});
            grown_.triangles += shape.mesh.triangles();
            include(shape.mesh, body.place);
        }
    }

    /// Adds one node for all bodies that look alike.
    void add_groups(const std::vector<std::size_t>& skins) {
        std::vector<PlotLeaves> groups(bodies_.shapes.size());
        for (const PlotBodies::Placed& body : bodies_.bodies) {
            groups[body.shape].places.push_back(body.place);
            nodes_.push_back(scene_.nodes.size() + body.shape);
            include(bodies_.shapes[body.shape].mesh, body.place);
        }
        for (std::size_t i = 0; i < groups.size(); ++i) {
            const PlotBodies::Shape& shape = bodies_.shapes[i];
            const Mesh* mesh = &shape.mesh;
            GlbNode node{.name = shape.name, .mesh = scene_.meshes.size()};
            if (options_.instancing == LeafInstancing::gpu) {
                node.instances = groups[i].places;
            } else {
                groups[i].one = shape.mesh;
                merged_.push_back(groups[i].merged());
                merged_.back().tints.clear();
                mesh = &merged_.back();
            }
            grown_.vertices += mesh->positions.size();
            grown_.triangles += shape.mesh.triangles() * groups[i].places.size();
            scene_.nodes.push_back(std::move(node));
            scene_.meshes.push_back({shape.name, {{mesh, skins[i], {}}}});
        }
    }

    [[nodiscard]] Value extras_value() const {
        const Bounds box = bodies_.bodies.empty() ? Bounds{} : box_;
        Value extras =
            sporeprint::extras_value(extras_, Value::object(), box, grown_.triangles, {}, {});
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
    Bounds box_{glm::vec3(1e9F), glm::vec3(-1e9F)};
    Grown grown_;
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
