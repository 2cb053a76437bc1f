#include "core/grow/world/plot.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <memory>
#include <utility>

#include "core/grow/leaf.h"
#include "core/grow/mushroom.h"
#include "core/grow/names.h"
#include "core/grow/painting.h"
#include "core/grow/translucency.h"
#include "core/grow/wood.h"
#include "core/grow/world/body_nodes.h"
#include "core/grow/world/ferns.h"
#include "core/grow/world/flowers.h"
#include "core/grow/world/plot_bodies.h"
#include "core/grow/world/plot_parts.h"
#include "core/grow/world/tile_grass.h"
#include "core/grow/world/world_materials.h"
#include "core/math/elementary.h"
#include "core/world/floor_image.h"
#include "core/world/snow.h"
#include "core/world/tree_growth.h"
#include "core/world/world.h"

namespace sporeprint {

namespace {

/// Distance of the vertices of a slab, about, metres, and bounds of their number along a side.
constexpr double slab_spacing = 0.078;
constexpr int fewest_slab_nodes = 33, most_slab_nodes = 193;

/// Shares of the triangles of a plot.
constexpr std::uint64_t most_of_trees_in_pictures = 1'500'000, most_of_trees = 200'000,
                        most_of_bodies = 130'000, most_of_leaves = 60'000, most_of_grass = 110'000;

/// Side of the images of wood at LOD 0, texels.
constexpr int wood_texture_side = 1024;

void check(const PlotContent& content, const PlotOptions& options) {
    std::vector<Problem> problems;
    if (content.ground == nullptr)
        report(problems, "/ground", "a plot needs the ground of its world");
    if (!(content.size >= 2.0 && content.size <= 32.0)) report(problems, "/size", "is 2..32 m");
    if (options.lod < 0 || options.lod > 2) report(problems, "/lod", "is 0..2");
    if (!(options.litter >= 0.0 && options.litter <= 100.0))
        report(problems, "/litter", "is 0..100 per m²");
    if (std::ranges::find(options.layers, true) == options.layers.end())
        report(problems, "/layers", "names no part of a plot");
    if (options.texture_size < 128 || options.texture_size > 2048)
        report(problems, "/texture_size", "is 128..2048 texels");
    if (!problems.empty()) throw InvalidInput(std::move(problems));
    if (has_addresses(options.textures))
        throw Impossible("/textures",
                         "a plot has its images in the file; ask for embedded, or for none");
}

/// The scene of a plot with everything that it refers to.
class PlotScene {
  public:
    PlotScene(const PlotContent& content, const PlotOptions& options, const Atlas& atlas,
              const Extras& extras, const ExecutionContext& execution)
        : content_(content),
          options_(options),
          atlas_(atlas),
          extras_(extras),
          execution_(execution),
          materials_(scene_, options.textures, options.file, no_urls_, atlas, execution) {
        set_options(scene_, options.file);
        scene_.stands_on_ground = false;
    }

    Grown grow() {
        const std::vector<TreeFoot> feet = feet_of(content_);
        const FloorHeights floor(*content_.ground, content_.seed, content_.micro, feet);
        const PlotFrame frame(content_, floor);
        execution_.observer(Step::build);
        const bool shows_cover = options_.has(PlotLayer::ground) || options_.has(PlotLayer::floor);
        const CoverField cover = shows_cover ? cover_of(content_, atlas_) : CoverField();
        throw_if_cancelled(execution_);
        if (options_.has(PlotLayer::ground)) add_slab(frame, cover);
        if (options_.has(PlotLayer::trees))
            trees_ = trees_of(content_, options_, frame,
                              options_.for_picture ? most_of_trees_in_pictures : most_of_trees,
                              atlas_, execution_);
        if (options_.has(PlotLayer::fungi))
            bodies_ = bodies_of(content_, options_, frame, most_of_bodies, atlas_, execution_);
        add_trees();
        if (options_.has(PlotLayer::floor)) add_logs(logs_of(content_, frame, cover, atlas_));
        throw_if_cancelled(execution_);
        add_bodies();
        if (options_.has(PlotLayer::floor)) add_floor(frame, cover);
        // A layer of which nothing is on this plot is a file that shows nothing.
        is_empty_ = scene_.nodes.empty();
        if (is_empty_) scene_.nodes.push_back({.name = "plot"});
        execution_.observer(Step::pack);
        Grown grown;
        grown.vertices = vertices_;
        grown.triangles = triangles_;
        scene_.extras_json = dump(extras_value());
        throw_if_cancelled(execution_);
        grown.glb = extras_.write(scene_, execution_.parallel);
        return grown;
    }

  private:
    const PlotContent& content_;
    const PlotOptions& options_;
    const Atlas& atlas_;
    const Extras& extras_;
    const ExecutionContext& execution_;
    GlbScene scene_;
    std::deque<Mesh> meshes_;
    MaterialUrls no_urls_;
    WorldMaterials materials_;
    PlotTrees trees_;
    PlotBodies bodies_;
    std::vector<PlotLeaves> leaves_, ferns_;
    std::uint64_t vertices_ = 0, triangles_ = 0;
    std::vector<std::size_t> tree_nodes_, body_nodes_;
    std::vector<std::pair<std::uint64_t, std::size_t>> log_nodes_;
    Bounds box_{glm::vec3(1e9F), glm::vec3(-1e9F)};
    bool is_empty_ = false;  ///< nothing is shown

    /// Adds leaves, flowers, ferns and grass.
    void add_floor(const PlotFrame& frame, const CoverField& cover) {
        // Of a large plot, fewer leaves per m².
        constexpr double of_leaf = 12.0;
        const double most_per_m2 =
            static_cast<double>(most_of_leaves) / (of_leaf * content_.size * content_.size);
        if (const double per_m2 = std::min(options_.litter, most_per_m2); per_m2 > 0.0)
            leaves_ = leaves_of(content_, frame, cover, per_m2, atlas_);
        add_copies(leaves_, "fallen", "litter");
        add_flowers(frame, cover);
        ferns_ = ferns_of(content_, frame, cover, std::max(options_.lod, least_fern_lod), atlas_,
                          rim_of_ferns);
        add_copies(ferns_, "fern", "fern");
        const std::uint64_t most =
            options_.for_picture ? most_picture_triangles : most_plot_triangles;
        const std::uint64_t left = most - std::min(most, triangles_);
        add_grass(grass_of(content_, frame, cover, std::min(most_of_grass, left)));
    }

    /// Removes what a mesh needs for images only, if there are none.
    void without_images(Mesh& mesh) const {
        if (options_.textures != Textures::none) return;
        mesh.texture_coordinates.clear();
        mesh.tangents.clear();
    }

    /// Adds a mesh that is at its place.
    std::size_t add_single(Mesh mesh, const std::string& name, std::size_t material, GlbRole role) {
        meshes_.push_back(std::move(mesh));
        const Mesh& own = meshes_.back();
        include(box_, own, {});
        vertices_ += own.positions.size();
        triangles_ += own.triangles();
        scene_.nodes.push_back({.name = name, .mesh = scene_.meshes.size()});
        scene_.meshes.push_back({name, {{&own, material, {}}}, role});
        return scene_.nodes.size() - 1;
    }

    void add_slab(const PlotFrame& frame, const CoverField& cover) {
        const auto around = static_cast<int>(std::ceil(content_.size / slab_spacing));
        SlabParams params;
        params.box = frame.box();
        params.nodes = std::clamp(around, fewest_slab_nodes - 1, most_slab_nodes - 1) + 1;
        params.texture_side = options_.texture_size;
        params.height = frame.height();
        Mesh slab = slab_mesh(params, frame.floor());
        Mesh soil = soil_round(slab, params);
        without_images(slab);
        const std::size_t ground = materials_.ground("plot_ground", [&](ImageFormat format) {
            RawImages painted =
                floor_of(content_, cover, options_.texture_size, true, atlas_, execution_.parallel);
            add_contact_shade(painted, params.box, contacts_on(content_, frame, true));
            throw_if_cancelled(execution_);
            return encoded(painted, format, execution_.parallel);
        });
        add_single(std::move(slab), "plot_ground", ground, GlbRole::body);
        add_single(std::move(soil), "plot_soil", materials_.plain("soil"), GlbRole::body);
    }

    void add_trees() {
        std::vector<std::size_t> mesh_of;
        for (const PlotTrees::Shape& shape : trees_.shapes) {
            mesh_of.push_back(scene_.meshes.size());
            scene_.meshes.push_back(
                {level_name(shape.name, shape.spec.params.lod),
                 materials_.tree(shape.spec, *primitive_mesh(shape.meshes->bark),
                                 *primitive_mesh(shape.meshes->leaves))});
            vertices_ += shape.meshes->vertices();
        }
        std::size_t number = 0;
        for (const PlotTrees::Placed& tree : trees_.trees) {
            const PlotTrees::Shape& shape = trees_.shapes[tree.shape];
            tree_nodes_.push_back(scene_.nodes.size());
            scene_.nodes.push_back(
                {.name = scene_.meshes[mesh_of[tree.shape]].name + '_' + std::to_string(++number),
                 .mesh = mesh_of[tree.shape],
                 .translation = tree.place.translation,
                 .rotation = tree.place.rotation,
                 .scale = tree.place.scale});
            triangles_ += shape.meshes->triangles();
            include(box_, shape.meshes->bark, tree.place);
            include(box_, shape.meshes->leaves, tree.place);
        }
    }

    /// Returns a mesh of the cache, or a copy without what only images need.
    const Mesh* primitive_mesh(const Mesh& mesh) {
        if (options_.textures != Textures::none) return &mesh;
        meshes_.push_back(mesh);
        without_images(meshes_.back());
        return &meshes_.back();
    }

    void add_logs(std::vector<PlotLog> logs) {
        std::size_t number = 0;
        Mesh snow;
        for (PlotLog& log : logs) {
            const std::size_t wood = materials_.wood({log.wood, wood_side({wood_texture_side}, 0)});
            without_images(log.mesh);
            const std::string name =
                std::string(log.lies ? "log_" : "snag_") + std::to_string(++number);
            log_nodes_.emplace_back(log.id,
                                    add_single(std::move(log.mesh), name, wood, GlbRole::body));
            append(snow, log.snow);
        }
        if (!snow.positions.empty())
            add_single(std::move(snow), "snow", materials_.plain("snow"), GlbRole::body);
    }

    /// Adds leaves or fronds.
    ///
    /// material  before the hash of their images
    /// name      of their nodes, before a number
    void add_copies(std::vector<PlotLeaves>& copies, const std::string& material,
                    const std::string& name) {
        for (PlotLeaves& own : copies) {
            const std::size_t leaves = materials_.leaves(material, own.preset, paint_of(own.leaf));
            without_images(own.one);
            const std::string numbered = name + '_' + std::to_string(&own - copies.data() + 1);
            if (options_.instancing == LeafInstancing::gpu) {
                vertices_ += own.one.positions.size();
                triangles_ += own.one.triangles() * own.places.size();
                scene_.nodes.push_back(
                    {.name = numbered, .mesh = scene_.meshes.size(), .instances = own.places});
                scene_.meshes.push_back({numbered, {{&own.one, leaves, {}}}, GlbRole::foliage});
            } else {
                add_single(own.merged(), numbered, leaves, GlbRole::foliage);
            }
        }
    }

    void add_flowers(const PlotFrame& frame, const CoverField& cover) {
        for (const PlotFlowers& own : flowers_on(content_, frame, cover, rim_of_leaves))
            add_single(own.merged(), own.name, materials_.plain("flowers"), GlbRole::foliage);
    }

    void add_grass(Mesh grass) {
        if (grass.positions.empty()) return;
        const std::size_t blades = materials_.plain("plot_grass");
        add_single(std::move(grass), "grass", blades, GlbRole::foliage);
    }

    void add_bodies() {
        const bool is_crowded = scene_.nodes.size() + bodies_.bodies.size() > most_plot_nodes;
        BodyNodes added = sporeprint::add_bodies(
            scene_, materials_, bodies_, grouping_of(options_.instancing, is_crowded), meshes_);
        body_nodes_ = std::move(added.nodes);
        vertices_ += added.vertices;
        triangles_ += added.triangles;
        box_ = united(box_, added.box);
    }

    Value extras_value() const {
        const Bounds box = is_empty_ ? Bounds{} : box_;
        Value extras = sporeprint::extras_value(extras_, Value::object(), box, triangles_, {}, {});
        Value trees = Value::array(), logs = Value::array(), bodies = Value::array();
        for (std::size_t i = 0; i < trees_.trees.size(); ++i) {
            const PlotTrees::Placed& tree = trees_.trees[i];
            trees.push(Value::object()
                           .set("id", id_text(tree.id))
                           .set("kind", content_.kinds[trees_.shapes[tree.shape].kind])
                           .set("node", tree_nodes_[i]));
        }
        for (const auto& [id, node] : log_nodes_)
            logs.push(Value::object().set("id", id_text(id)).set("node", node));
        for (std::size_t i = 0; i < bodies_.bodies.size(); ++i) {
            const PlotBodies::Placed& body = bodies_.bodies[i];
            bodies.push(Value::object()
                            .set("id", id_text(body.id))
                            .set("species", content_.species[body.species])
                            .set("seed", static_cast<std::uint32_t>(body.id))
                            .set("age", std::floor(body.age * 1000.0 + 0.5) / 1000.0)
                            .set("node", body_nodes_[i]));
        }
        extras.set("trees", std::move(trees));
        extras.set("dead_wood", std::move(logs));
        extras.set("bodies", std::move(bodies));
        return extras;
    }
};

}  // namespace

int PlotContent::northern_day() const {
    constexpr int half_a_year = 182, days = 365;
    const int day = day_of_year(time);
    return is_southern ? (day - 1 + half_a_year) % days + 1 : day;
}

int day_of_year(WorldTime time) {
    const WorldTime of_year = time % ticks_of_year;
    return 1 + (of_year < 0 ? of_year + ticks_of_year : of_year) / ticks_of_day;
}

WorldBox box_of(const PlotContent& content) {
    const double x = metres(content.centre.x), y = metres(content.centre.y),
                 half = 0.5 * content.size;
    return {x - half, y - half, x + half, y + half};
}

std::vector<TreeFoot> feet_of(const PlotContent& content) {
    const WorldBox box = box_of(content);
    std::vector<TreeFoot> feet;
    for (const StandTree& tree : content.trees) {
        const double x = metres(tree.at.x), y = metres(tree.at.y);
        // Slopes at the border depend on places that are a step beyond it.
        constexpr double reach = most_flare_reach + 1.0;
        if (!tree.lives_at(content.time) || x < box.west - reach || x > box.east + reach ||
            y < box.south - reach || y > box.north + reach)
            continue;
        feet.push_back({x, y, std::max(0.01, trunk_diameter(height_at(tree, content.time)))});
    }
    return feet;
}

std::vector<LeafLitter> litter_of(const PlotContent& content, const Atlas& atlas) {
    if (content.kinds.size() > most_kinds)
        throw InvalidInput("/kinds",
                           "a stand has at most " + std::to_string(most_kinds) + " kinds of trees");
    std::vector<LeafLitter> litter;
    litter.reserve(content.kinds.size());
    for (std::size_t i = 0; i < content.kinds.size(); ++i) {
        const std::string path = "/kinds/" + std::to_string(i);
        const TreePreset* const tree = atlas.find_tree(content.kinds[i]);
        if (tree == nullptr)
            throw InvalidInput(path, "there is no tree '" + content.kinds[i] + "'");
        const LeafPreset* const leaf = atlas.find_leaf(params_of(*tree).look.leaf.id.string());
        if (leaf == nullptr) throw InvalidInput(path, "its leaf does not exist");
        litter.push_back({leaf->shape, leaf->palette});
    }
    return litter;
}

CoverField cover_of(const PlotContent& content, const Atlas& atlas, double step) {
    const std::vector<LeafLitter> litter = litter_of(content, atlas);
    CoverConditions at;
    at.acidity = content.acidity;
    at.day = content.northern_day();
    for (std::size_t kind = 0; kind < litter.size(); ++kind)
        at.has_needles[kind] = has_needles(litter[kind]);
    std::vector<LitterSource> sources;
    sources.reserve(content.trees.size());
    const WorldBox field = grown(box_of(content), floor_margin + step);
    for (const StandTree& tree : content.trees) {
        if (!tree.lives_at(content.time) || tree.kind >= litter.size()) continue;
        const double radius = crown_radius(height_at(tree, content.time));
        // Leaves of farther trees would add nothing anywhere.
        if (!contains(grown(field, crown_filling * radius + most_litter_drift), tree.at)) continue;
        sources.push_back({metres(tree.at.x), metres(tree.at.y), radius, tree.kind});
    }
    const SineCosine wind = sine_cosine(content.wind_to);
    const auto at_place = [&](double x, double y) {
        at.light = content.light ? content.light(x, y) : 1.0;
        set_ground(at, *content.ground, x, y, content.lasting_water);
        at.fall =
            content.fall ? content.fall(x, y) : litterfall(sources, x, y, wind.cosine, wind.sine);
        return cover_of(at);
    };
    return cover_field(box_of(content), floor_margin, at_place, step);
}

RawImages floor_of(const PlotContent& content, const CoverField& cover, int side, bool pieces,
                   const Atlas& atlas, const Parallel& parallel) {
    const std::vector<LeafLitter> litter = litter_of(content, atlas);
    FloorPaint paint;
    paint.seed = content.seed;
    paint.box = box_of(content);
    paint.side = side;
    paint.wetness = std::clamp(content.soil_water / 100.0, 0.0, 1.0);
    paint.day = content.northern_day();
    paint.kinds = litter;
    paint.cover = &cover;
    paint.pieces = pieces;
    RawImages images = floor_images(paint, parallel);
    if (content.snow > 0.0)
        add_snow(images, paint.box, content.snow, content.seed, feet_of(content), parallel);
    return images;
}

LeafState leaves_on(int day) {
    // Of beeches in Central Europe: leaves unfold at the end of April, half of them have turned in mid-October.
    constexpr int first_leaves = 112, last_leaves = 316;
    LeafState state;
    state.bare = day < first_leaves || day > last_leaves;
    // Full green comes about eight weeks after the leaves.
    const double young = 1.0 - smooth_step(first_leaves + 10.0, first_leaves + 56.0, day);
    state.spring = state.bare ? 0.0 : std::floor(young * 8.0 + 0.5) / 8.0;
    const double turned = 0.9 * smooth_step(246.0, 312.0, day);
    state.autumn = state.bare ? 0.0 : std::floor(turned * 16.0 + 0.5) / 16.0;
    return state;
}

Grown grow_plot(const PlotContent& content, const PlotOptions& options, const Atlas& atlas,
                const Extras& extras, const ExecutionContext& execution) {
    check(content, options);
    static_cast<void>(litter_of(content, atlas));
    return PlotScene(content, options, atlas, extras, execution).grow();
}

}  // namespace sporeprint
