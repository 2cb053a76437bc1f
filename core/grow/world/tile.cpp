#include "core/grow/world/tile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <deque>
#include <functional>
#include <glm/common.hpp>
#include <map>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "core/grow/names.h"
#include "core/grow/painting.h"
#include "core/grow/tree.h"
#include "core/grow/wood.h"
#include "core/grow/world/ferns.h"
#include "core/grow/world/flowers.h"
#include "core/grow/world/parts.h"
#include "core/grow/world/plot_bodies.h"
#include "core/grow/world/plot_of_world.h"
#include "core/grow/world/plot_parts.h"
#include "core/grow/world/plot_places.h"
#include "core/grow/world/tile_grass.h"
#include "core/grow/world/tile_ground.h"
#include "core/math/direction.h"
#include "core/world/canopy_light.h"
#include "core/world/floor_image.h"
#include "core/world/season.h"
#include "core/world/tree_growth.h"

namespace sporeprint {

namespace {

/// Individuals that show the fruit bodies of a species: the middles of so many parts of a life, and seeds.
constexpr int parts_of_life = 8;
constexpr std::uint64_t seeds_of_body = 2;

/// Side of the images of wood at LOD 0, texels.
constexpr int wood_texture_side = 512;

/// Positions of trunks in files are multiples of this, metres: the bark is rougher, and 64 m fit into 16 bits.
constexpr float trunk_step = 1.0F / 512.0F;

/// Leaves that are meshes where leaves cover the ground, per m².
constexpr double leaves_per_m2 = 20.0;

/// Heights of origins are multiples of this, metres, which have short decimals, so that readers of single and of double
/// precision find neighbours at equal heights.
constexpr double origin_step = 1.0 / 16.0;

/// Radius from which on dead trunks are thick, metres.
constexpr double least_thick = 0.07;

/// How far beyond a tile the feet of trees raise ground on which something of it stands, metres: a trunk may lie
/// half beyond its tile.
constexpr double beside_trunks = 24.0;

/// Returns the level of detail of trees on tiles of a size: two common ones, then those that are for worlds.
int lod_of_trees(double side) {
    if (side <= finest_tile) return 2;
    if (side <= 2.0 * finest_tile) return 3;
    int lod = first_far_lod;
    for (double far = 4.0 * finest_tile; far < side; far *= 2.0) ++lod;
    return lod;
}

/// Returns the level of detail of mushrooms on tiles of a size.
int lod_of_bodies(double side) {
    return side <= finest_tile ? 1 : side <= 2.0 * finest_tile ? 2 : 3;
}

/// Returns the middle of a dead trunk: of a log along it, of a snag its foot.
WorldPoint middle_of(const DeadWood& wood, WorldTime time) {
    if (wood.stands_at(time)) return wood.at;
    const SineCosine way = sine_cosine(wood.direction);
    return point_at(metres(wood.at.x) + 0.5 * wood.length * way.cosine,
                    metres(wood.at.y) + 0.5 * wood.length * way.sine);
}

/// Tiles from this size on have so many crowns for each node of their cover that it is faster to draw each crown on the
/// nodes than to look for the crowns of each node, metres. The bits of both are equal.
constexpr double least_drawn_crowns = 64.0;

/// Returns light_below() the crowns at the nodes of a field of cover.
std::function<double(double, double)> light_on(const World& world, std::span<const Crown> crowns,
                                               const CoverField& nodes) {
    const PlaceLattice places{nodes.west * nodes.step, nodes.south * nodes.step, nodes.step,
                              nodes.columns, nodes.rows};
    std::vector<double> heights;
    heights.reserve(static_cast<std::size_t>(nodes.columns) * static_cast<std::size_t>(nodes.rows));
    for (int row = 0; row < nodes.rows; ++row)
        for (int column = 0; column < nodes.columns; ++column)
            heights.push_back(world
                                  .place_at(point_at(places.west + column * places.step,
                                                     places.south + row * places.step))
                                  .height);
    return [&world, places, light = canopy_light_on(places, heights, crowns, 1.0)](double x,
                                                                                   double y) {
        const auto column = static_cast<std::size_t>((x - places.west) / places.step + 0.5),
                   row = static_cast<std::size_t>((y - places.south) / places.step + 0.5);
        return world.site_at(point_at(x, y)).light *
               light[row * static_cast<std::size_t>(places.columns) + column];
    };
}

/// The scene of a tile with everything that it refers to.
class TileScene {
  public:
    TileScene(const std::shared_ptr<const World>& world, const TileRequest& request,
              const Atlas& atlas, const TileLinks& links, const Extras& extras,
              const ExecutionContext& execution)
        : world_(*world),
          request_(request),
          box_(request.tiling.box(request.tile)),
          atlas_(atlas),
          links_(links),
          extras_(extras),
          execution_(execution),
          materials_(scene_, textures(), file_, links, atlas, execution) {
        const double side = request.tiling.side(request.tile.level);
        const PlotPlace place{0.5 * (box_.west + box_.east), 0.5 * (box_.south + box_.north), side};
        content_ = content_of(world_, place, request.time);
        wide_ = content_;
        wide_.size = side + 2.0 * beside_trunks;
        scene_.stands_on_ground = false;
        scene_.nodes.push_back({.name = "tile"});
    }

    Grown grow() {
        const bool shows_layer = has_content(request_.layer, content_.size);
        if (shows_layer) {
            execution_.observer(Step::build);
            read_surroundings();
        }
        const std::vector<TreeFoot> feet =
            raises_ground() ? feet_of(wide_) : std::vector<TreeFoot>();
        const FloorHeights floor(*content_.ground, content_.seed, content_.micro, feet);
        const PlotFrame frame(content_, floor, origin_step);
        scene_.nodes[0].translation = frame.origin();
        if (shows_layer) add_layer(frame, floor);
        execution_.observer(Step::pack);
        throw_if_cancelled(execution_);
        const Bounds box = is_empty_ ? Bounds{} : bounds_;
        scene_.extras_json = dump(extras_value(extras_, Value::object(), box, triangles_, {}, {}));
        Grown grown;
        grown.vertices = vertices_;
        grown.triangles = triangles_;
        grown.glb = extras_.write(scene_, execution_.parallel);
        return grown;
    }

  private:
    const World& world_;
    const TileRequest& request_;
    WorldBox box_;
    const Atlas& atlas_;
    const TileLinks& links_;
    const Extras& extras_;
    const ExecutionContext& execution_;
    Block around_;
    std::vector<FruitBody> bodies_;
    std::optional<CanopyLight> canopy_;
    PlotContent content_, wide_;  ///< the tile, and the same with what its trunks lie on
    GlbScene scene_;
    std::deque<Mesh> meshes_;
    std::deque<std::shared_ptr<const TreeMeshes>> trees_;
    std::vector<std::shared_ptr<const BodyShape>> shapes_;  ///< of fruit bodies
    FileOptions file_;
    WorldMaterials materials_;
    std::uint64_t vertices_ = 0, triangles_ = 0;
    Bounds bounds_{glm::vec3(1e9F), glm::vec3(-1e9F)};
    bool is_empty_ = true;

    [[nodiscard]] bool is_linked() const { return request_.profile == TileProfile::web; }
    [[nodiscard]] Textures textures() const {
        return is_linked() ? Textures::linked : Textures::embedded;
    }
    [[nodiscard]] bool shows_cover() const {
        return request_.layer == PlotLayer::ground || request_.layer == PlotLayer::floor;
    }
    /// Returns whether the vertices of the ground are near enough to each other for the feet of trees.
    [[nodiscard]] bool raises_ground() const {
        return request_.layer != PlotLayer::ground || content_.size <= 4.0 * finest_tile;
    }

    /// Reads what stands and lies on the tile and round it.
    void read_surroundings() {
        if (content_.size > coarsest_of_trees) return;
        const WorldTime time = request_.time;
        around_ = present_round(world_, box_, time, execution_);
        for (PlotContent* content : {&content_, &wide_}) {
            content->trees = around_.trees;
            content->dead_wood = around_.dead;
        }
        if (!shows_cover()) return;
        const std::vector<Crown> crowns =
            crowns_in(world_, around_.trees, grown(box_, plot_margin + shade_reach), time);
        if (content_.size >= least_drawn_crowns) {
            content_.light =
                light_on(world_, crowns,
                         cover_lattice(box_, floor_margin, cover_step_of_tile(content_.size)));
        } else {
            canopy_.emplace(crowns);
            content_.light = light_below(world_, *canopy_);
        }
    }

    void add_layer(const PlotFrame& frame, const FloorHeights& floor) {
        switch (request_.layer) {
            case PlotLayer::ground:
                add_ground(floor, frame);
                break;
            case PlotLayer::trees:
                add_trees(frame);
                break;
            case PlotLayer::floor:
                add_floor(frame, floor);
                break;
            case PlotLayer::fungi:
                add_fungi(frame, floor);
                break;
        }
    }

    void include(const Bounds& box, const GlbTransform& place) {
        is_empty_ = false;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec3 at(corner & 1 ? box.max.x : box.min.x,
                                corner & 2 ? box.max.y : box.min.y,
                                corner & 4 ? box.max.z : box.min.z);
            const glm::vec3 in_tile(place.translation + rotated(place.rotation, place.scale * at));
            bounds_.min = glm::min(bounds_.min, in_tile);
            bounds_.max = glm::max(bounds_.max, in_tile);
        }
    }

    std::size_t add_node(GlbNode node) {
        scene_.nodes[0].children.push_back(scene_.nodes.size());
        scene_.nodes.push_back(std::move(node));
        return scene_.nodes.size() - 1;
    }

    /// Adds a mesh at several places: as instances, or as nodes.
    ///
    /// address  of its geometry, for one that is a file of its own
    /// ids      of what stands at the places; empty for what has none
    void add_places(const std::string& name, std::vector<GlbPrimitive> primitives,
                    const std::string& address, const std::vector<GlbTransform>& places,
                    const std::vector<std::uint64_t>& ids, GlbRole role) {
        std::uint64_t vertices = 0, triangles = 0;
        for (const GlbPrimitive& primitive : primitives) {
            vertices += primitive.mesh->positions.size();
            triangles += primitive.mesh->triangles();
            const Bounds box = bounds(*primitive.mesh);
            for (const GlbTransform& place : places) include(box, place);
        }
        vertices_ += vertices;
        triangles_ += triangles * places.size();
        const std::size_t mesh = scene_.meshes.size();
        scene_.meshes.push_back(
            {name, std::move(primitives), role, is_linked() ? address : std::string()});
        if (is_linked()) {
            GlbNode node{.name = name, .mesh = mesh, .instances = places};
            if (!ids.empty()) {
                Value list = Value::array();
                for (const std::uint64_t id : ids) list.push(id_text(id));
                node.extras_json = dump(Value::object().set("ids", std::move(list)));
            }
            add_node(std::move(node));
            return;
        }
        for (std::size_t i = 0; i < places.size(); ++i) {
            GlbNode node{.name = name + '_' + std::to_string(i + 1),
                         .mesh = mesh,
                         .translation = places[i].translation,
                         .rotation = places[i].rotation,
                         .scale = places[i].scale};
            if (!ids.empty()) node.extras_json = dump(Value::object().set("id", id_text(ids[i])));
            add_node(std::move(node));
        }
    }

    /// Adds a mesh that is at its place.
    void add_single(Mesh mesh, const std::string& name, std::size_t material, GlbRole role,
                    std::optional<std::uint64_t> id = {}) {
        meshes_.push_back(std::move(mesh));
        const Mesh& own = meshes_.back();
        include(bounds(own), {});
        vertices_ += own.positions.size();
        triangles_ += own.triangles();
        GlbNode node{.name = name, .mesh = scene_.meshes.size()};
        if (id) node.extras_json = dump(Value::object().set("id", id_text(*id)));
        add_node(std::move(node));
        scene_.meshes.push_back({name, {{&own, material, {}}}, role});
    }

    /// Lets the positions of the last mesh be integers of a step in files of the profile web. One that is too large for
    /// that keeps its floats, as the whole file does.
    void set_step(float step) {
        if (!is_linked()) return;
        constexpr float most = 32767.0F;
        const Bounds box = bounds(meshes_.back());
        const glm::vec3 reach = glm::max(glm::abs(box.min), glm::abs(box.max));
        if (std::max({reach.x, reach.y, reach.z}) > most * step) return;
        scene_.geometry = GlbGeometry::quantized;
        scene_.meshes.back().step = step;
    }

    void add_ground(const FloorHeights& floor, const PlotFrame& frame) {
        TileGround ground(world_, content_);
        const std::size_t material = materials_.ground(
            "ground", [&](ImageFormat) { return ground.files(atlas_, execution_.parallel); });
        const auto step = static_cast<float>(step_of_tile(content_.size));
        add_single(ground.slab(floor, frame.height()), "ground", material, GlbRole::body);
        set_step(step);
    }

    void add_trees(const PlotFrame& frame) {
        const int lod = lod_of_trees(content_.size);
        using Key = std::pair<std::size_t, std::uint64_t>;
        std::map<Key, std::vector<const StandTree*>> groups;
        for (const StandTree& tree : around_.trees)
            if (contains(box_, tree.at)) groups[{tree.kind, shape_number(tree)}].push_back(&tree);
        for (const auto& [key, group] : groups) {
            throw_if_cancelled(execution_);
            PlotTrees::Shape shape =
                tree_shape(content_, key.first, key.second, lod, atlas_, execution_);
            shape.spec.params.textures = textures();
            trees_.push_back(shape.meshes);
            std::vector<GlbTransform> places;
            std::vector<std::uint64_t> ids;
            for (const StandTree* tree : group) {
                places.push_back(place_of(*tree, request_.time, shape.size, frame));
                ids.push_back(tree->id);
            }
            add_places(level_name(shape.name, lod),
                       materials_.tree(shape.spec, shape.meshes->bark, shape.meshes->leaves),
                       is_linked() ? links_.tree(shape.spec) : std::string(), places, ids,
                       GlbRole::body);
        }
    }

    void add_floor(const PlotFrame& frame, const FloorHeights& floor) {
        // Leaves need the finest cover; grass and the moss on trunks change less from place to place.
        const CoverField cover = cover_of(content_, atlas_, cover_step_of_tile(content_.size));
        throw_if_cancelled(execution_);
        if (content_.size > finest_tile) add_trunks(cover, floor);
        if (content_.size > 2.0 * finest_tile) return;
        if (content_.size > finest_tile)
            add_grass(frame, cover);
        else
            add_litter(frame, cover);
    }

    /// Adds trunks whose middle lies on the tile, whole: thick ones to large tiles, thin ones to those below.
    void add_trunks(const CoverField& cover, const FloorHeights& floor) {
        const bool are_thick = content_.size > 2.0 * finest_tile;
        std::vector<DeadWood> own;
        for (const DeadWood& wood : around_.dead)
            if ((radius_at(wood, request_.time) >= least_thick) == are_thick &&
                contains(box_, middle_of(wood, request_.time)))
                own.push_back(wood);
        PlotContent content = wide_;
        content.dead_wood = own;
        const PlotFrame frame(content, floor, origin_step);
        const TrunkDetail detail =
            are_thick ? TrunkDetail{10, 28, 0.6, 5, false} : TrunkDetail{6, 12, 0.8, 3, false};
        Mesh snow;
        for (PlotLog& log : logs_of(content, frame, cover, atlas_, detail)) {
            const std::size_t wood = materials_.wood({log.wood, wood_side({wood_texture_side}, 0)});
            add_single(std::move(log.mesh), log.lies ? "log" : "snag", wood, GlbRole::body, log.id);
            set_step(trunk_step);
            append(snow, log.snow);
        }
        if (snow.positions.empty()) return;
        add_single(std::move(snow), "snow", materials_.plain("snow"), GlbRole::body);
        set_step(trunk_step);
    }

    /// Adds grass and ferns.
    void add_grass(const PlotFrame& frame, const CoverField& cover) {
        const std::vector<std::vector<GlbTransform>> places = tufts_on(content_, frame, cover);
        for (std::size_t shape = 0; shape < places.size(); ++shape) {
            if (places[shape].empty()) continue;
            const std::size_t blades = materials_.plain("grass");
            meshes_.push_back(tuft_mesh(shape, grass_on(content_.northern_day())));
            add_repeated("grass_" + std::to_string(shape + 1), meshes_.back(), blades,
                         places[shape]);
        }
        for (PlotLeaves& own : ferns_of(content_, frame, cover, last_lod, atlas_)) {
            const std::size_t fronds = materials_.leaves("fern", own.preset, paint_of(own.leaf));
            meshes_.push_back(std::move(own.one));
            add_repeated("fern", meshes_.back(), fronds, own.places);
        }
    }

    void add_litter(const PlotFrame& frame, const CoverField& cover) {
        for (PlotLeaves& own : leaves_of(content_, frame, cover, leaves_per_m2, atlas_, 0.0)) {
            const std::size_t leaves = materials_.leaves("fallen", own.preset, paint_of(own.leaf));
            meshes_.push_back(std::move(own.one));
            add_repeated("litter_" + own.preset, meshes_.back(), leaves, own.places);
        }
        for (PlotFlowers& own : flowers_on(content_, frame, cover)) {
            const std::size_t flowers = materials_.plain("flowers");
            meshes_.push_back(std::move(own.one));
            add_repeated(own.name, meshes_.back(), flowers, own.places);
        }
    }

    /// Adds a small mesh that occurs often: as instances, or as one mesh of all.
    void add_repeated(const std::string& name, const Mesh& one, std::size_t material,
                      const std::vector<GlbTransform>& places) {
        if (is_linked()) {
            add_places(name, {{&one, material, {}}}, {}, places, {}, GlbRole::foliage);
            return;
        }
        add_single(MeshCopies{one, places}.merged(), name, material, GlbRole::foliage);
    }

    void add_fungi(const PlotFrame& frame, const FloorHeights& floor) {
        const PlotFrame of_trunks(wide_, floor, origin_step);
        BearingTrunks trunks(wide_, of_trunks);
        using Key = std::tuple<std::size_t, int, std::uint64_t>;
        std::map<Key, std::vector<const FruitBody*>> groups;
        bodies_ = bodies_on_tile();
        for (const FruitBody& body : bodies_) {
            const int part = part_of_life(age_at(body, request_.time), parts_of_life);
            groups[{body.species, part, (body.id >> 32U) % seeds_of_body}].push_back(&body);
        }
        for (const auto& [key, group] : groups) {
            throw_if_cancelled(execution_);
            add_bodies(key, group, frame, trunks);
        }
    }

    /// Returns the fruit bodies that stand on the tile, by their ids.
    std::vector<FruitBody> bodies_on_tile() {
        // A tile with fungi lies within one block, whose season all of its tiles share.
        const CellIndex block = block_at(content_.centre);
        const int year = static_cast<int>(request_.time / ticks_of_year);
        const auto season = season_of_world(world_, block, year, execution_);
        std::vector<FruitBody> out;
        for (const FruitBody& body : season->bodies)
            if (body.stands_at(request_.time) && contains(box_, body.at)) out.push_back(body);
        return out;
    }

    void add_bodies(const std::tuple<std::size_t, int, std::uint64_t>& key,
                    const std::vector<const FruitBody*>& group, const PlotFrame& frame,
                    BearingTrunks& trunks) {
        const auto& [species, part, seed] = key;
        auto [spec, is_lateral] = look_of_body(content_, species, (part + 0.5) / parts_of_life,
                                               static_cast<std::uint32_t>(1 + seed), atlas_);
        spec.params.lod = lod_of_bodies(content_.size);
        shapes_.push_back(body_shape(spec, atlas_, execution_));
        const BodyShape& shape = *shapes_.back();
        const Bounds box = bounds(shape.mesh);
        const glm::vec3 size = box.max - box.min;
        if (content_.size > 2.0 * finest_tile &&
            static_cast<double>(std::max({size.x, size.y, size.z})) < least_body_from_afar)
            return;
        spec.params.textures = textures();
        const std::size_t skin = materials_.skin(spec, shape.individual);
        std::vector<GlbTransform> places;
        std::vector<std::uint64_t> ids;
        for (const FruitBody* body : group) {
            places.push_back(place_of(*body, frame, is_lateral, trunks));
            ids.push_back(body->id);
        }
        add_places(level_name(product_name(spec), spec.params.lod), {{&shape.mesh, skin, {}}},
                   is_linked() ? links_.mushroom(spec) : std::string(), places, ids, GlbRole::body);
    }
};

}  // namespace

Grown grow_tile(const std::shared_ptr<const World>& world, const TileRequest& request,
                const Atlas& atlas, const TileLinks& links, const Extras& extras,
                const ExecutionContext& execution) {
    if (!request.tiling.has(request.tile))
        throw InvalidInput("/tile", "the world has no such tile");
    return TileScene(world, request, atlas, links, extras, execution).grow();
}

}  // namespace sporeprint
