#include "core/grow/world/plot_scenery.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <deque>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "core/grow/leaf.h"
#include "core/grow/painting.h"
#include "core/grow/tree.h"
#include "core/grow/wood.h"
#include "core/grow/world/ferns.h"
#include "core/grow/world/flowers.h"
#include "core/grow/world/ground_ring.h"
#include "core/grow/world/parts.h"
#include "core/grow/world/plot_bodies.h"
#include "core/grow/world/plot_parts.h"
#include "core/grow/world/plot_places.h"
#include "core/grow/world/tile_grass.h"
#include "core/grow/world/tile_ground.h"
#include "core/grow/world/tiling.h"
#include "core/grow/world/world_materials.h"
#include "core/math/direction.h"
#include "core/math/elementary.h"
#include "core/world/canopy_light.h"
#include "core/world/floor_image.h"
#include "core/world/grass_season.h"
#include "core/world/horizon.h"
#include "core/world/tree_growth.h"
#include "core/world/weather.h"

namespace sporeprint {

namespace {

/// Sides of the squares of ground, metres: before the camera, before one that is close, round the plot at least, farther away, as far as trees
/// are known one by one, and as far as crowns are part of the ground.
constexpr double nearest_ground = 3.2, close_ground = 1.6, least_near_ground = 12.8,
                 middle_ground = 51.2, far_ground = 256.0, farthest_ground = 1024.0;

/// Depth of the walls round the square whose ground has crowns, metres.
constexpr double below_crowns = 40.0;

/// Texels along the sides of the images of the ground: of squares with each leaf and needle but the nearest, and of others.
constexpr int fine_texels = 2048, ground_texels = 1024;

/// A camera that is nearer than this to what it looks at is close to it, metres.
constexpr double close_by = 1.3;

/// Nodes of the cover along the side of a square, but near the camera.
constexpr double most_cover_nodes = 64.0;

/// How far from the camera trees are shown, metres, and the sides of the images of wood, texels.
constexpr double trees_within = 135.0;
constexpr int wood_texture_side = 1024;

/// From so many trees on their levels of detail are those of a wood.
constexpr double many_trees = 2000.0;

/// Triangles of all trees, and of all fruit bodies: of the rest of a scene there are never as many.
constexpr std::uint64_t most_of_trees = 2'500'000, most_of_bodies = 400'000;

/// Tufts of grass on a square of half a metre: before the camera, round the plot, and farther away, where they are shown
/// within a distance, metres.
constexpr int nearest_tufts = 48, near_tufts = 20, middle_tufts = 8;
constexpr double middle_tufts_within = 45.0;

/// How far from the camera ferns are shown, metres.
constexpr double least_to_fern = 1.5, ferns_within = 24.0;

/// The distance from which on there are fewer of them, as the square of the distance grows, metres.
constexpr double all_tufts_within = 9.0;

/// The distance from the camera within which no leaf of a tree hangs, metres.
constexpr double clear_sight = 2.2;

/// Within this distance dead trunks are shown in full detail, metres.
constexpr double near_trunks = 9.0;

WorldBox square_round(double x, double y, double side) {
    return {x - 0.5 * side, y - 0.5 * side, x + 0.5 * side, y + 0.5 * side};
}

/// Returns a square of a side as near to a place as it is within a world.
WorldBox square_within(const WorldBox& world, double x, double y, double side) {
    const double half = 0.5 * std::min(side, world.east - world.west);
    return square_round(std::clamp(x, world.west + half, world.east - half),
                        std::clamp(y, world.south + half, world.north - half), 2.0 * half);
}

bool is_within(const WorldBox& inner, const WorldBox& outer) {
    return inner.west >= outer.west && inner.south >= outer.south && inner.east <= outer.east &&
           inner.north <= outer.north;
}

/// Levels of detail of a tree: of its bark and of its leaves.
struct TreeLevels {
    int bark = 2, leaves = 2;
    bool operator<(const TreeLevels& other) const {
        return bark != other.bark ? bark < other.bark : leaves < other.leaves;
    }
};

/// Returns the levels of detail of a tree that is so far away.
///
/// low   some of its leaves hang as low as the camera sees
/// seen  it is before the camera; others count for their shadows alone
/// near  factor of distances: where few trees stand, all of them are finer
TreeLevels levels_at(double distance, double height, bool low, bool seen, double near) {
    // A sapling is as many pixels high as a tree twice as far away.
    const double apparent = near * distance * std::max(1.0, 6.0 / std::max(height, 1.0));
    if (!seen && distance > 8.0) return {first_far_lod, first_far_lod};
    if (apparent < 5.0) return {0, low ? 0 : 1};
    if (apparent < 16.0) return {1, 1};
    if (apparent < 45.0) return {2, 2};
    if (apparent < 75.0) return {3, 3};
    // Later levels have closed clumps for foliage, which look like pebbles where many trees stand together.
    return {first_far_lod, first_far_lod};
}

/// The scene of a picture with everything that it refers to.
class Scenery {
  public:
    Scenery(const WorldPlot& plot, const PlotOptions& options, const StandingCamera& camera,
            const Atlas& atlas, const ExecutionContext& execution)
        : world_(*plot.world),
          plot_(plot.content),
          options_(options),
          camera_(camera),
          atlas_(atlas),
          execution_(execution),
          materials_(scene_, Textures::embedded, file_, no_urls_, atlas, execution) {
        scene_.stands_on_ground = false;
        scene_.nodes.push_back({.name = "scenery"});
    }
    Scenery(const Scenery&) = delete;
    Scenery& operator=(const Scenery&) = delete;
    ~Scenery() = default;

    const GlbScene& build() {
        place_squares();
        around_.trees = living_round(world_, far_, plot_.time, execution_);
        around_.dead = present_round(world_, middle_, plot_.time, execution_).dead;
        bodies_ = bodies_in(world_, near_, plot_.time, execution_);
        canopy_.emplace(crowns_in(world_, around_.trees, grown(far_, shade_reach), plot_.time));
        const PlotContent middle = content_on(middle_);
        floor_.emplace(*plot_.ground, plot_.seed, plot_.micro, feet_of(middle));
        origin_ = PlotFrame(plot_, *floor_).origin();
        throw_if_cancelled(execution_);
        if (options_.has(PlotLayer::ground)) add_ground();
        if (options_.has(PlotLayer::trees)) add_trees();
        if (options_.has(PlotLayer::floor)) add_floor();
        if (options_.has(PlotLayer::fungi)) add_bodies();
        return scene_;
    }

    /// Returns what casts the shadows of trees beyond.
    [[nodiscard]] const std::map<const Mesh*, const Mesh*>& casters() const { return casters_; }

    /// Returns the part of the scene whose shadows are seen from near.
    [[nodiscard]] Bounds near_box() const {
        const WorldBox box = is_close_ ? grown(nearest_, 0.8) : grown(near_, 2.0);
        const PlotFrame frame(plot_, *floor_);
        const glm::dvec3 low = frame.at(box.west, box.north, frame.height() - 2.0),
                         high = frame.at(box.east, box.south, frame.height() + 2.5);
        return {glm::vec3(low), glm::vec3(high)};
    }

  private:
    const World& world_;
    const PlotContent& plot_;
    const PlotOptions& options_;
    const StandingCamera& camera_;
    const Atlas& atlas_;
    const ExecutionContext& execution_;
    GlbScene scene_;
    FileOptions file_;
    MaterialUrls no_urls_;
    WorldMaterials materials_;
    std::deque<Mesh> meshes_;
    std::map<std::tuple<std::size_t, std::uint64_t, int>, PlotTrees::Shape> shapes_;
    std::map<const Mesh*, const Mesh*> casters_;
    PlotBodies shown_;
    Block around_;
    std::vector<FruitBody> bodies_;
    std::optional<CanopyLight> canopy_;
    std::optional<FloorHeights> floor_;
    glm::dvec3 origin_{0.0};  ///< of the picture in the world
    WorldBox nearest_, near_, middle_, far_, farthest_;
    std::map<const WorldBox*, CoverField>
        covers_;             ///< of these squares, as far as they were needed
    bool is_close_ = false;  ///< the camera is close to what it looks at

    [[nodiscard]] glm::dvec2 eye() const {
        return {metres(plot_.centre.x) + camera_.eye.x, metres(plot_.centre.y) - camera_.eye.z};
    }

    /// Returns where the camera looks, without its height, as a unit vector to the east and north.
    [[nodiscard]] glm::dvec2 gaze() const {
        const glm::dvec2 way(camera_.target.x - camera_.eye.x, camera_.eye.z - camera_.target.z);
        const double length = glm::length(way);
        return length > 1e-9 ? way / length : glm::dvec2(0.0, 1.0);
    }

    void place_squares() {
        const WorldBox extent = extent_of(world_.params);
        const double x = metres(plot_.centre.x), y = metres(plot_.centre.y);
        near_ = square_within(extent, x, y, std::max(least_near_ground, plot_.size));
        middle_ = square_within(extent, x, y, std::max(middle_ground, plot_.size + 16.0));
        far_ = square_within(extent, x, y, far_ground);
        farthest_ = square_within(extent, x, y, farthest_ground);
        const glm::dvec2 target(x + camera_.target.x, y - camera_.target.z);
        const double away = std::min(glm::distance(target, eye()), 2.4);
        const glm::dvec2 before = eye() + away * gaze();
        is_close_ = away < close_by;
        const double side = is_close_ ? close_ground : nearest_ground, half = 0.5 * side;
        nearest_ = square_round(std::clamp(before.x, near_.west + half, near_.east - half),
                                std::clamp(before.y, near_.south + half, near_.north - half), side);
    }

    /// Returns what is on a square.
    [[nodiscard]] PlotContent content_on(const WorldBox& box) const {
        PlotContent content = content_of(
            world_,
            {0.5 * (box.west + box.east), 0.5 * (box.south + box.north), box.east - box.west},
            plot_.time);
        content.trees = around_.trees;
        content.dead_wood = around_.dead;
        content.bodies = bodies_;
        content.light = light_below(world_, *canopy_);
        return content;
    }

    /// Returns the node of what has the coordinates of a square.
    std::size_t node_of(const PlotFrame& frame) {
        scene_.nodes[0].children.push_back(scene_.nodes.size());
        scene_.nodes.push_back({.name = "square", .translation = frame.origin() - origin_});
        return scene_.nodes.size() - 1;
    }

    void add_child(std::size_t parent, GlbNode node) {
        scene_.nodes[parent].children.push_back(scene_.nodes.size());
        scene_.nodes.push_back(std::move(node));
    }

    void add_single(std::size_t parent, Mesh mesh, const std::string& name, std::size_t material,
                    GlbRole role) {
        if (mesh.positions.empty()) return;
        meshes_.push_back(std::move(mesh));
        add_child(parent, {.name = name, .mesh = scene_.meshes.size()});
        scene_.meshes.push_back({name, {{&meshes_.back(), material, {}}}, role});
    }

    /// Returns whether each leaf and needle is painted on a square.
    [[nodiscard]] bool has_pieces(const WorldBox& box) const { return is_within(box, middle_); }

    /// Returns the step of the cover of a square, metres: near the camera that of single leaves.
    [[nodiscard]] double step_of(const WorldBox& box) const {
        double step = CoverField::finest_step;
        if (!has_pieces(box))
            while (step < (box.east - box.west) / most_cover_nodes) step *= 2.0;
        return step;
    }

    /// Returns the cover of one of the squares, which ground, leaves, grass and trunks share.
    ///
    /// content  content_on() the square
    const CoverField& cover_on(const WorldBox& box, const PlotContent& content) {
        const auto [found, is_new] = covers_.try_emplace(&box);
        if (is_new) found->second = cover_of(content, atlas_, step_of(box));
        return found->second;
    }

    /// Adds a square of ground whose crowns are not part of it.
    ///
    /// finest, growth  as of ground_ring()
    void add_square(const std::string& name, const WorldBox& box,
                    const std::optional<WorldBox>& hole, double finest, double growth) {
        throw_if_cancelled(execution_);
        const PlotContent content = content_on(box);
        const PlotFrame frame(content, *floor_);
        const int texels = hole && has_pieces(box) ? fine_texels : ground_texels;
        const std::size_t material = materials_.ground(name, [&](ImageFormat format) {
            const CoverField& cover = cover_on(box, content);
            RawImages painted =
                floor_of(content, cover, texels, has_pieces(box), atlas_, execution_.parallel);
            if (has_pieces(box))
                add_contact_shade(painted, box, contacts_on(content, frame, false));
            return encoded(painted, format, execution_.parallel);
        });
        const GroundRingParams ring{box, hole, finest, growth, texels, frame.height()};
        add_single(
            node_of(frame),
            ground_ring(ring, [this](std::span<const double> x,
                                     std::span<const double> y) { return floor_->at(x, y); }),
            name, material, GlbRole::body);
    }

    void add_ground() {
        add_square("nearest_ground", nearest_, {}, 0.04, 0.0);
        add_square("near_ground", near_, nearest_, 0.09, 0.01);
        add_square("middle_ground", middle_, near_, 0.25, 0.03);
        if (!is_within(middle_, far_)) return;
        add_square("far_ground", far_, middle_, 0.8, 0.04);
        const bool has_more = farthest_.east - farthest_.west > far_.east - far_.west;
        if (!has_more || !is_within(far_, farthest_)) return;
        const PlotContent content = content_on(farthest_);
        const PlotFrame frame(content, *floor_);
        TileGround ground(world_, content);
        const std::size_t material = materials_.ground("farthest_ground", [&](ImageFormat format) {
            return encoded(ground.images(atlas_, execution_.parallel), format, execution_.parallel);
        });
        const GroundRingParams ring{
            farthest_,      far_,        4.0, 0.03, texels_of_tile(content.size).colour,
            frame.height(), below_crowns};
        add_single(node_of(frame),
                   ground_ring(ring,
                               [&](std::span<const double> x, std::span<const double> y) {
                                   return ground.heights(*floor_, x, y);
                               }),
                   "farthest_ground", material, GlbRole::body);
    }

    /// A tree that the camera sees.
    struct SeenTree {
        const StandTree* tree = nullptr;
        double distance = 0.0, height = 0.0;
        bool is_low = false, is_before = false;
    };

    /// Returns the trees that the camera sees, or whose shadows it may see.
    [[nodiscard]] std::vector<SeenTree> seen_trees() const {
        std::vector<SeenTree> seen;
        for (const StandTree& tree : around_.trees) {
            const glm::dvec2 way = glm::dvec2(metres(tree.at.x), metres(tree.at.y)) - eye();
            const double distance = glm::length(way), height = height_at(tree, plot_.time);
            // Of the farthest saplings nothing is seen.
            if (distance > trees_within || height < 0.01 * distance) continue;
            const bool is_before =
                glm::dot(way, gaze()) > 0.77 * distance - 1.5 * crown_radius(height);
            seen.push_back({&tree, distance, height, has_low_leaves(tree, height), is_before});
        }
        return seen;
    }

    using TreeKey = std::tuple<std::size_t, std::uint64_t, TreeLevels>;

    [[nodiscard]] static TreeKey key_of(const SeenTree& seen, double near) {
        return {seen.tree->kind, shape_number(*seen.tree),
                levels_at(seen.distance, seen.height, seen.is_low, seen.is_before, near)};
    }

    /// Returns an individual of a kind of trees; those of a scene are few.
    const PlotTrees::Shape& shape_at(const PlotContent& content, std::size_t kind,
                                     std::uint64_t number, int lod) {
        const auto [found, is_new] = shapes_.try_emplace({kind, number, lod});
        if (is_new) {
            throw_if_cancelled(execution_);
            found->second = tree_shape(content, kind, number, lod, atlas_, execution_);
        }
        return found->second;
    }

    /// Returns the triangles of all trees at their levels of detail.
    [[nodiscard]] std::uint64_t triangles_of(const PlotContent& content,
                                             const std::vector<SeenTree>& seen, double near) {
        std::uint64_t sum = 0;
        for (const SeenTree& one : seen) {
            const auto [kind, number, levels] = key_of(one, near);
            sum += shape_at(content, kind, number, levels.bark).meshes->bark.triangles() +
                   shape_at(content, kind, number, levels.leaves).meshes->leaves.triangles();
        }
        return sum;
    }

    void add_trees() {
        const PlotContent content = content_on(near_);
        const PlotFrame frame(content, *floor_);
        const std::vector<SeenTree> seen = seen_trees();
        double near =
            std::clamp(std::sqrt(static_cast<double>(seen.size()) / many_trees), 0.3, 1.0);
        while (triangles_of(content, seen, near) > most_of_trees) near *= 1.2;
        const std::size_t parent = node_of(frame);
        const glm::dvec3 eye_in_frame = camera_.eye - (frame.origin() - origin_);
        std::map<TreeKey, std::size_t> mesh_of_key;
        for (const SeenTree& one : seen) {
            const TreeKey key = key_of(one, near);
            const auto& [kind, number, levels] = key;
            const GlbTransform place = place_of(
                *one.tree, plot_.time, shape_at(content, kind, number, levels.bark).size, frame);
            std::size_t mesh = 0;
            if (one.distance < clear_sight + 1.5 * crown_radius(one.height)) {
                // Its leaves can hang before the eye.
                const Mesh& whole = shape_at(content, kind, number, levels.leaves).meshes->leaves;
                meshes_.push_back(leaves_beyond(whole, place, eye_in_frame, clear_sight));
                mesh = mesh_of(content, key, meshes_.back());
            } else {
                auto found = mesh_of_key.find(key);
                if (found == mesh_of_key.end())
                    found = mesh_of_key.emplace(key, mesh_of(content, key)).first;
                mesh = found->second;
            }
            add_child(parent, {.name = scene_.meshes[mesh].name,
                               .mesh = mesh,
                               .translation = place.translation,
                               .rotation = place.rotation,
                               .scale = place.scale});
        }
    }

    /// Returns whether leaves of a tree hang as low as somebody on the ground sees.
    [[nodiscard]] bool has_low_leaves(const StandTree& tree, double height) const {
        constexpr double seen = 4.0;
        const StandKind& kind = world_.stand.kinds[tree.kind];
        return kind.ecology.crown_base * height < seen;
    }

    /// Adds the mesh of an individual of a kind of trees at its levels of detail.
    std::size_t mesh_of(const PlotContent& content, const TreeKey& key) {
        const auto& [kind, number, levels] = key;
        return mesh_of(content, key, shape_at(content, kind, number, levels.leaves).meshes->leaves);
    }

    /// Adds the same with some of the leaves of its level.
    std::size_t mesh_of(const PlotContent& content, const TreeKey& key, const Mesh& leaves) {
        const auto& [kind, number, levels] = key;
        const PlotTrees::Shape& bark = shape_at(content, kind, number, levels.bark);
        scene_.meshes.push_back({bark.name, materials_.tree(bark.spec, bark.meshes->bark, leaves)});
        const TreeMeshes& far = *shape_at(content, kind, number, first_far_lod).meshes;
        if (levels.bark < first_far_lod) casters_[&bark.meshes->bark] = &far.bark;
        if (levels.leaves < first_far_lod && far.leaves.triangles() > 0)
            casters_[&leaves] = &far.leaves;
        return scene_.meshes.size() - 1;
    }

    void add_floor() {
        add_trunks();
        const PlotContent content = content_on(near_);
        const PlotFrame frame(content, *floor_);
        const std::size_t parent = node_of(frame);
        const CoverField& cover = cover_on(near_, content);
        if (options_.litter > 0.0)
            for (PlotLeaves& own : leaves_of(content, frame, cover, options_.litter, atlas_, 0.0))
                add_single(parent, own.merged(), "litter",
                           materials_.leaves("fallen", own.preset, paint_of(own.leaf)),
                           GlbRole::foliage);
        for (const PlotFlowers& own : flowers_on(content, frame, cover))
            add_single(parent, own.merged(), own.name, materials_.plain("flowers"),
                       GlbRole::foliage);
        add_ferns();
        add_tufts(nearest_, near_tufts, nearest_tufts, {});
        add_tufts(near_, 0, near_tufts, {});
        add_tufts(middle_, 0, middle_tufts, near_);
    }

    void add_ferns() {
        const PlotContent content = content_on(middle_);
        const PlotFrame frame(content, *floor_);
        const std::size_t parent = node_of(frame);
        for (PlotLeaves& own :
             ferns_of(content, frame, cover_on(middle_, content), least_fern_lod, atlas_)) {
            std::erase_if(own.places, [&](const GlbTransform& place) {
                const glm::dvec2 at = frame.below(place.translation);
                const double away = glm::distance(at, eye());
                // One at the camera would hide everything.
                return away < least_to_fern || away > ferns_within ||
                       glm::dot(at - eye(), gaze()) < 0.5 * away - 1.5;
            });
            if (!own.places.empty())
                add_single(parent, own.merged(), "fern",
                           materials_.leaves("fern", own.preset, paint_of(own.leaf)),
                           GlbRole::foliage);
        }
    }

    /// Adds the tufts of grass of a square.
    ///
    /// from, to  of those on each half metre, which of them
    /// but       where none stands
    void add_tufts(const WorldBox& box, int from, int to, const std::optional<WorldBox>& but) {
        const PlotContent content = content_on(box);
        const PlotFrame frame(content, *floor_);
        const CoverField& cover = cover_on(box, content);
        std::vector<std::vector<GlbTransform>> fewer;
        if (from > 0) fewer = tufts_on(content, frame, cover, from);
        const std::vector<std::vector<GlbTransform>> all = tufts_on(content, frame, cover, to);
        const std::size_t parent = node_of(frame);
        const std::size_t blades = materials_.plain("grass");
        for (std::size_t shape = 0; shape < all.size(); ++shape) {
            std::size_t number = 0;
            MeshCopies tufts;
            tufts.one = tuft_mesh(shape, grass_on(plot_.northern_day()));
            for (const GlbTransform& place : all[shape]) {
                const glm::dvec2 at = frame.below(place.translation);
                if (but && at.x > but->west && at.x < but->east && at.y > but->south &&
                    at.y < but->north)
                    continue;
                const double away = glm::distance(at, eye()) / all_tufts_within;
                if (but && away * all_tufts_within > middle_tufts_within) continue;
                const auto one_of = static_cast<std::size_t>(std::max(1.0, away * away));
                if (but && ++number % one_of != 0) continue;
                tufts.places.push_back(place);
            }
            if (!fewer.empty()) remove(tufts.places, fewer[shape]);
            if (!tufts.places.empty())
                add_single(parent, tufts.merged(), "grass", blades, GlbRole::foliage);
        }
    }

    /// Removes the places of a list from one that has them in the same order.
    static void remove(std::vector<GlbTransform>& from, const std::vector<GlbTransform>& places) {
        std::size_t next = 0;
        std::erase_if(from, [&](const GlbTransform& place) {
            if (next == places.size() || places[next].translation != place.translation)
                return false;
            ++next;
            return true;
        });
    }

    void add_trunks() {
        PlotContent content = content_on(middle_);
        std::vector<DeadWood> near, far;
        for (const DeadWood& wood : around_.dead) {
            const SineCosine turn = sine_cosine(wood.direction);
            const glm::dvec2 foot(metres(wood.at.x), metres(wood.at.y)),
                way(turn.cosine, turn.sine);
            const double along = wood.lies_at(plot_.time)
                                     ? std::clamp(glm::dot(eye() - foot, way), 0.0, wood.length)
                                     : 0.0;
            const bool is_near = glm::distance(foot + along * way, eye()) < near_trunks;
            (is_near ? near : far).push_back(wood);
        }
        const PlotFrame frame(content, *floor_);
        const std::size_t parent = node_of(frame);
        const CoverField& cover = cover_on(middle_, content);
        Mesh snow;
        for (const auto& [list, detail] :
             {std::pair{&near, TrunkDetail{}}, {&far, TrunkDetail{10, 40, 0.25, 5, false}}}) {
            content.dead_wood = *list;
            for (PlotLog& log : logs_of(content, frame, cover, atlas_, detail)) {
                add_single(parent, std::move(log.mesh), log.lies ? "log" : "snag",
                           materials_.wood({log.wood, wood_side({wood_texture_side}, 0)}),
                           GlbRole::body);
                append(snow, log.snow);
            }
        }
        add_single(parent, std::move(snow), "snow", materials_.plain("snow"), GlbRole::body);
    }

    void add_bodies() {
        // On the frame of the trunks, which bodies on wood need.
        const PlotContent content = content_on(middle_);
        const PlotFrame frame(content, *floor_);
        shown_ = bodies_of(content, options_, frame, most_of_bodies, atlas_, execution_);
        const std::size_t parent = node_of(frame);
        std::vector<std::size_t> mesh_of_shape;
        for (const PlotBodies::Shape& shape : shown_.shapes) {
            mesh_of_shape.push_back(scene_.meshes.size());
            scene_.meshes.push_back(
                {shape.name, {{&shape.mesh, materials_.skin(shape.spec, shape.individual), {}}}});
        }
        for (const PlotBodies::Placed& body : shown_.bodies)
            add_child(parent, {.name = scene_.meshes[mesh_of_shape[body.shape]].name,
                               .mesh = mesh_of_shape[body.shape],
                               .translation = body.place.translation,
                               .rotation = body.place.rotation});
    }
};

}  // namespace

Daylight daylight_on(const World& world, WorldTime time) {
    const ClimateParams& climate = world.params.climate;
    const int year = static_cast<int>(time / ticks_of_year), day = day_of_year(time);
    const WeatherYear weather = weather_of(climate, world.params.seed, year);
    const WeatherDay& today = weather[static_cast<std::size_t>(day - 1)];
    const WeatherDay& before = weather[static_cast<std::size_t>(std::max(day - 2, 0))];
    // From the south-east, so that a camera that looks to the north sees lit and shaded sides.
    constexpr std::size_t moment = 3;
    const SunPosition sun = sun_of(radians(climate.latitude_deg), day).positions[moment];
    Daylight light;
    light.to_sun = {sun.east, sun.up, -sun.north};
    constexpr double wet = 0.2;  // mm, from which on a day has rain
    light.cloud = today.rain > wet ? 1.0 : before.rain > wet ? 0.55 : 0.15;
    light.visibility = today.rain > wet ? 500.0 : before.rain > wet ? 1200.0 : 6000.0;
    return light;
}

RgbaImage scenery_of(const WorldPlot& plot, const PlotOptions& options,
                     const StandingCamera& camera, const PictureParams& params, const Atlas& atlas,
                     const ExecutionContext& execution) {
    execution.observer(Step::build);
    Scenery scenery(plot, options, camera, atlas, execution);
    const GlbScene& scene = scenery.build();
    throw_if_cancelled(execution);
    execution.observer(Step::draw);
    return rendered_from(
        camera, scene, params,
        {daylight_on(*plot.world, plot.content.time), scenery.near_box(), true, scenery.casters()},
        execution.parallel);
}

}  // namespace sporeprint
