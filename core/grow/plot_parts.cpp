#include "core/grow/plot_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <map>
#include <optional>
#include <utility>

#include "core/grow/names.h"
#include "core/math/direction.h"
#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/params/canonical.h"
#include "core/plant/trunk_piece.h"
#include "core/world/leaf_stamp.h"
#include "core/world/tree_growth.h"

namespace sporeprint {

namespace {

constexpr std::uint64_t shapes_of_kind = 4;

/// Side of the images of bark and leaves at LOD 0; it halves with every level.
constexpr int tree_texture_side = 2048;

/// The sides of cells in which leaves and tufts of grass lie, metres.
constexpr double leaf_cell = 1.0, tuft_cell = 0.5;

/// Tufts of grass in a cell where grass covers it, blades of a tuft, and triangles of a blade.
constexpr int tufts_of_cell = 12, blades_of_tuft = 6;
constexpr std::uint64_t triangles_of_blade = 10;

const TreePreset& preset_of(const PlotContent& content, std::size_t kind, const Atlas& atlas) {
    if (kind >= content.kinds.size())
        throw InvalidInput("/kinds", "a tree is of a kind that the stand does not have");
    const TreePreset* const found = atlas.find_tree(content.kinds[kind]);
    if (found == nullptr)
        throw InvalidInput("/kinds/" + std::to_string(kind),
                           "there is no tree '" + content.kinds[kind] + "'");
    return *found;
}

const LeafPreset& leaf_of_preset(const TreePreset& tree, const Atlas& atlas) {
    const LeafPreset* const found = atlas.find_leaf(params_of(tree).look.leaf.id.string());
    if (found == nullptr) throw InvalidInput("/kinds", "a tree has a leaf that does not exist");
    return *found;
}

/// Returns a rotation about the vertical axis.
glm::dvec4 turned(double angle) {
    const SineCosine half = sine_cosine(0.5 * angle);
    return {0.0, half.sine, 0.0, half.cosine};
}

TreeSpec tree_spec(const TreePreset& preset, std::uint64_t shape, int lod, const LeafState& state,
                   bool evergreen) {
    TreeSpec spec{preset.id.string(), params_of(preset)};
    spec.params.seed = static_cast<std::uint32_t>(1 + shape);
    spec.params.lod = lod;
    spec.params.texture_size.value = tree_texture_side;
    // The ground is raised round the trunk, and the clod of a tree of its own would lie on it.
    spec.params.look.shape.root_flare = 0.0;
    if (!evergreen) {
        spec.params.autumn = state.autumn;
        if (state.bare) spec.params.look.leaves.per_tip = 0;
    }
    return spec;
}

std::shared_ptr<const TreeMeshes> cached_meshes(const TreeSpec& spec, const Atlas& atlas,
                                                const ExecutionContext& execution) {
    return execution.caches.trees("plot tree " + canonical_text(spec.params), [&] {
        return std::make_shared<const TreeMeshes>(tree_meshes(spec, atlas));
    });
}

/// Returns the parts of a line, from 0 to 1, between which it is in a rectangle; nothing if it misses it.
std::optional<std::pair<double, double>> part_within(const WorldBox& box, const glm::dvec2& from,
                                                     const glm::dvec2& to) {
    double first = 0.0, last = 1.0;
    const auto clip = [&](double start, double way, double low, double high) {
        if (std::abs(way) < 1e-9) {
            if (start < low || start > high) last = -1.0;
            return;
        }
        const double a = (low - start) / way, b = (high - start) / way;
        first = std::max(first, std::min(a, b));
        last = std::min(last, std::max(a, b));
    };
    clip(from.x, to.x - from.x, box.west, box.east);
    clip(from.y, to.y - from.y, box.south, box.north);
    if (first >= last) return std::nullopt;
    return std::pair{first, last};
}

/// How far a log bends with the ground: over half of this length its height is the mean of the ground's, metres.
constexpr double stiffness = 2.4;

/// Heights of the ground along a line, which a stiff trunk follows.
class LogProfile {
  public:
    LogProfile(const FloorHeights& floor, const glm::dvec2& from, const glm::dvec2& way,
               double length) {
        const auto count = static_cast<std::size_t>(std::ceil(length / step)) + 1;
        std::vector<double> own;
        own.reserve(count);
        for (std::size_t i = 0; i < count; ++i) {
            const double s = std::min(static_cast<double>(i) * step, length);
            own.push_back(floor.at(from.x + s * way.x, from.y + s * way.y));
        }
        const auto reach = static_cast<std::size_t>(stiffness / step);
        heights_.reserve(count);
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t side = std::min({reach, i, count - 1 - i});
            double sum = 0.0;
            for (std::size_t k = i - side; k <= i + side; ++k) sum += own[k];
            heights_.push_back(sum / static_cast<double>(2 * side + 1));
        }
    }
    [[nodiscard]] double at(double s) const {
        const double number = std::clamp(s / step, 0.0, static_cast<double>(heights_.size() - 1));
        const auto i = std::min(static_cast<std::size_t>(number), heights_.size() - 1);
        const std::size_t next = std::min(i + 1, heights_.size() - 1);
        return heights_[i] + (number - static_cast<double>(i)) * (heights_[next] - heights_[i]);
    }

  private:
    static constexpr double step = 0.2;  // metres
    std::vector<double> heights_;
};

int sides_of(double radius) { return radius > 0.18 ? 16 : radius > 0.08 ? 12 : 8; }

TrunkLine line_of_snag(const DeadWood& wood, const PlotContent& content, const PlotFrame& frame) {
    const double x = metres(wood.at.x), y = metres(wood.at.y);
    const double radius = radius_at(wood, content.time), lost = mass_lost(wood, content.time);
    // Tops break off first, piece by piece.
    Random random(static_cast<std::uint32_t>(wood.id), purposes::plot_pieces, 1);
    const double share_left = 1.0 - (0.15 + 0.55 * random.uniform()) * std::min(1.0, 2.5 * lost);
    const double height = std::max(1.0, wood.length * share_left);
    const double ground = frame.floor().at(x, y) - 0.2 * radius;
    const double whole = std::max(wood.length, height);
    return {0.0, height, [=, &frame](double up) {
                const double flare = 0.55 * exponential(-std::max(up, 0.0) / (1.6 * radius));
                const double taper = 1.0 - 0.8 * std::clamp(up / whole, 0.0, 1.0);
                return TrunkSection{frame.at(x, y, ground + up), radius * (taper + flare)};
            }};
}

std::optional<TrunkLine> line_of_log(const DeadWood& wood, const PlotContent& content,
                                     const PlotFrame& frame) {
    constexpr double least_length = 0.25;
    const SineCosine turn = sine_cosine(wood.direction);
    const glm::dvec2 foot(metres(wood.at.x), metres(wood.at.y)), way(turn.cosine, turn.sine);
    const double radius = radius_at(wood, content.time), lost = mass_lost(wood, content.time);
    // A cut end stays within the slab.
    WorldBox box = frame.box();
    const double inset = 1.1 * radius;
    box.west += inset;
    box.south += inset;
    box.east -= inset;
    box.north -= inset;
    const auto part = part_within(box, foot, foot + wood.length * way);
    if (!part) return std::nullopt;
    const double from = part->first * wood.length, to = part->second * wood.length;
    if (to - from < least_length) return std::nullopt;
    const LogProfile profile(frame.floor(), foot + from * way, way, to - from);
    // Rotten wood sinks into the ground.
    const double raised = 0.72 - 0.55 * lost, whole = wood.length;
    return TrunkLine{
        from, to, [=, &frame](double s) {
            const double here = radius * (1.0 - 0.8 * std::clamp(s / whole, 0.0, 1.0));
            const glm::dvec2 at = foot + s * way;
            return TrunkSection{frame.at(at.x, at.y, profile.at(s - from) + raised * here), here};
        }};
}

PlotLog log_of(const DeadWood& wood, const TrunkLine& line, const PlotContent& content,
               const CoverField& cover, Substrate kind) {
    const bool lies = wood.lies_at(content.time);
    const double lost = mass_lost(wood, content.time);
    // A snag goes on below the ground.
    const double below = lies ? 0.0 : 0.25;
    TrunkPieceParams params;
    params.length = line.to - line.from + below;
    params.seed = static_cast<std::uint32_t>(wood.id);
    params.sides = sides_of(radius_at(wood, content.time));
    params.foot = TrunkEnd::cut;
    params.lost = 0.6 * lost;
    if (lies) {
        params.start = line.from;
        params.lost = lost;
        if (line.from <= 0.0) params.foot = TrunkEnd::broken;
        if (line.to < wood.length) params.top = TrunkEnd::cut;
        const SineCosine turn = sine_cosine(wood.direction);
        const double middle = 0.5 * (line.from + line.to);
        const double damp = cover
                                .at(metres(wood.at.x) + middle * turn.cosine,
                                    metres(wood.at.y) + middle * turn.sine)
                                .moss;
        params.moss = std::clamp(1.4 * damp + 1.2 * lost - 0.15, 0.0, 1.0);
    }
    Mesh mesh = trunk_piece(params, [&](double s) { return line.section(line.from + s - below); });
    return {wood.id, kind, lies, std::move(mesh)};
}

/// Returns the columns or rows of cells that a range of metres meets.
std::pair<int, int> cells_of(double from, double to, double cell) {
    return {static_cast<int>(std::floor(from / cell)), static_cast<int>(std::floor(to / cell))};
}

/// Returns the seed of what lies in a cell.
std::uint32_t seed_of_cell(std::uint32_t seed, std::uint32_t which, int x, int y) {
    return philox({which, 0, static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)},
                  {seed, purposes::plot_pieces})[0];
}

/// Returns a rotation that turns the vertical axis to a unit vector, after a turn about it.
glm::dvec4 standing_on(const glm::dvec3& up, double angle) {
    const SineCosine turn = sine_cosine(angle);
    const glm::dvec3 along = square_to(up, {turn.sine, 0.0, turn.cosine});
    return quaternion_of({glm::cross(up, along), up, along});
}

}  // namespace

PlotFrame::PlotFrame(const PlotContent& content, const FloorHeights& floor)
    : floor_(&floor),
      box_(box_of(content)),
      x_(metres(content.centre.x)),
      y_(metres(content.centre.y)),
      height_(slab_height(place_at(*content.ground, coordinate_at(content.ground->grid, x_),
                                   coordinate_at(content.ground->grid, y_))
                              .height)) {}

bool PlotFrame::has(const WorldPoint& at) const {
    const double x = metres(at.x), y = metres(at.y);
    return x >= box_.west && x < box_.east && y >= box_.south && y < box_.north;
}

PlotTrees trees_of(const PlotContent& content, const PlotOptions& options, const PlotFrame& frame,
                   std::uint64_t most, const Atlas& atlas, const ExecutionContext& execution) {
    const LeafState state = leaves_on(day_of_year(content.time));
    std::vector<const StandTree*> standing;
    for (const StandTree& tree : content.trees)
        if (tree.lives_at(content.time) && frame.has(tree.at)) standing.push_back(&tree);
    PlotTrees made;
    for (int lod = options.lod + 1;; ++lod) {
        made = {};
        std::map<std::pair<std::size_t, std::uint64_t>, std::size_t> shape_of;
        std::uint64_t triangles = 0;
        for (const StandTree* tree : standing) {
            throw_if_cancelled(execution);
            const std::uint64_t shape = (tree->id >> 32U) % shapes_of_kind;
            const auto [found, is_new] =
                shape_of.try_emplace({tree->kind, shape}, made.shapes.size());
            if (is_new) {
                const TreePreset& preset = preset_of(content, tree->kind, atlas);
                const LeafPreset& leaf = leaf_of_preset(preset, atlas);
                PlotTrees::Shape& own = made.shapes.emplace_back();
                own.kind = tree->kind;
                own.spec =
                    tree_spec(preset, shape, lod, state, has_needles({leaf.shape, leaf.palette}));
                own.name = product_name(own.spec, atlas);
                own.meshes = cached_meshes(own.spec, atlas, execution);
                const Bounds box = bounds(*own.meshes);
                own.height = std::max(0.1, static_cast<double>(box.max.y));
                own.radius = std::max(0.02, 0.25 * static_cast<double>(box.max.x - box.min.x +
                                                                       box.max.z - box.min.z));
            }
            const PlotTrees::Shape& own = made.shapes[found->second];
            triangles += own.meshes->triangles();
            const double x = metres(tree->at.x), y = metres(tree->at.y);
            const double height = height_at(*tree, content.time);
            const double scale = std::max(height / own.height, 1e-3);
            // Trees of a wood are slenderer than those that stand alone, as the presets do.
            const double breadth =
                std::clamp(crown_radius(height) / own.radius, 0.5 * scale, 1.2 * scale);
            Random random(static_cast<std::uint32_t>(tree->id), purposes::plot_pieces);
            const double angle = 2.0 * pi * random.uniform();
            // The foot of the mesh reaches into the ground that is raised round it.
            const double sunk = 0.12 * trunk_diameter(height);
            made.trees.push_back({found->second,
                                  tree->id,
                                  {frame.at(x, y, frame.floor().at(x, y) - sunk), turned(angle),
                                   glm::dvec3(breadth, scale, breadth)}});
        }
        if (triangles <= most || lod == last_far_lod) break;
        // Impostors are for the distance; after the common levels come the far ones.
        if (lod == last_lod) lod = impostor_lod;
    }
    return made;
}

Substrate wood_of(const TreePreset& tree) {
    for (const Substrate wood : all_woods)
        if (tree.id.string() == name(wood)) return wood;
    const std::string leaf = params_of(tree).look.leaf.id.string();
    if (leaf == "oak") return Substrate::oak;
    if (leaf == "birch") return Substrate::birch;
    if (leaf == "shoot" || leaf == "needle") return Substrate::spruce;
    return Substrate::beech;
}

std::optional<TrunkLine> trunk_line(const DeadWood& wood, const PlotContent& content,
                                    const PlotFrame& frame) {
    if (!(wood.length > 0.0) || !(wood.radius > 0.0)) return std::nullopt;
    if (wood.lies_at(content.time)) return line_of_log(wood, content, frame);
    if (wood.stands_at(content.time) && frame.has(wood.at))
        return line_of_snag(wood, content, frame);
    return std::nullopt;
}

std::vector<PlotLog> logs_of(const PlotContent& content, const PlotFrame& frame,
                             const CoverField& cover, const Atlas& atlas) {
    std::vector<PlotLog> logs;
    for (const DeadWood& wood : content.dead_wood) {
        if (const auto line = trunk_line(wood, content, frame))
            logs.push_back(
                log_of(wood, *line, content, cover, wood_of(preset_of(content, wood.kind, atlas))));
    }
    return logs;
}

Mesh PlotLeaves::merged() const {
    Mesh all;
    const std::size_t vertices = places.size() * one.positions.size();
    all.positions.reserve(vertices);
    all.normals.reserve(vertices);
    all.tangents.reserve(one.tangents.empty() ? 0 : vertices);
    all.texture_coordinates.reserve(one.texture_coordinates.empty() ? 0 : vertices);
    all.tints.reserve(vertices);
    all.indices.reserve(places.size() * one.indices.size());
    for (const GlbTransform& place : places) {
        const auto first = static_cast<std::uint32_t>(all.positions.size());
        for (std::size_t i = 0; i < one.positions.size(); ++i) {
            all.positions.emplace_back(
                place.translation +
                rotated(place.rotation, place.scale * glm::dvec3(one.positions[i])));
            all.normals.emplace_back(
                glm::normalize(rotated(place.rotation, glm::dvec3(one.normals[i]))));
            if (!one.tangents.empty())
                all.tangents.emplace_back(
                    glm::vec3(glm::normalize(rotated(place.rotation, glm::dvec3(one.tangents[i])))),
                    one.tangents[i].w);
            if (!one.texture_coordinates.empty())
                all.texture_coordinates.push_back(one.texture_coordinates[i]);
            all.tints.push_back(place.tint);
        }
        for (const std::uint32_t index : one.indices) all.indices.push_back(first + index);
    }
    return all;
}

std::vector<PlotLeaves> leaves_of(const PlotContent& content, const PlotFrame& frame,
                                  const CoverField& cover, double per_m2, const Atlas& atlas) {
    constexpr std::size_t triangles = 12;
    constexpr int leaf_texture_side = 256;
    std::vector<PlotLeaves> leaves(content.kinds.size());
    std::vector<bool> falls(content.kinds.size(), false);
    for (std::size_t kind = 0; kind < content.kinds.size(); ++kind) {
        const LeafPreset& preset = leaf_of_preset(preset_of(content, kind, atlas), atlas);
        PlotLeaves& own = leaves[kind];
        own.leaf = params_of(preset);
        own.leaf.autumn = 1.0;
        own.leaf.texture_size.value = leaf_texture_side;
        falls[kind] =
            !has_needles({preset.shape, preset.palette}) && preset.shape.leaflets == Leaflets{};
        if (falls[kind]) own.one = foliage_leaf(shape_of(own.leaf), triangles);
    }
    const WorldBox& box = frame.box();
    const auto [west, east] = cells_of(box.west, box.east, leaf_cell);
    const auto [south, north] = cells_of(box.south, box.north, leaf_cell);
    const int most = static_cast<int>(std::ceil(per_m2));
    for (int row = south; row <= north; ++row)
        for (int column = west; column <= east; ++column)
            for (int k = 0; k < most; ++k) {
                Random random(seed_of_cell(content.seed, 0, column, row), purposes::plot_pieces,
                              static_cast<std::uint32_t>(k));
                const double along = random.uniform(), up = random.uniform(),
                             chance = random.uniform(), which = random.uniform(),
                             angle = random.uniform(), size = random.uniform(),
                             lean = random.uniform(), lean_to = random.uniform(),
                             face = random.uniform(), hue = random.uniform(),
                             age = random.uniform(), lift = random.uniform();
                const double x = (column + along) * leaf_cell, y = (row + up) * leaf_cell;
                // Leaves do not reach beyond the slab.
                constexpr double rim = 0.06;
                if (x < box.west + rim || x >= box.east - rim || y < box.south + rim ||
                    y >= box.north - rim)
                    continue;
                const Cover here = cover.at(x, y);
                const double all = here.all_leaves();
                if (chance >= all * per_m2 / most) continue;
                double rest = which * all;
                std::size_t kind = 0;
                while (kind + 1 < leaves.size() && rest >= here.leaves[kind])
                    rest -= here.leaves[kind++];
                if (kind >= leaves.size() || !falls[kind]) continue;
                const SineCosine to = sine_cosine(2.0 * pi * lean_to);
                const double tilt = 0.08 + 0.5 * lean * lean;
                const double sign = face < 0.36 ? -1.0 : 1.0;
                const glm::dvec3 normal =
                    sign * glm::normalize(glm::dvec3(tilt * to.cosine, 1.0, tilt * to.sine));
                const double scale = 0.7 + 0.5 * size;
                // A leaf that leans has one side on the ground.
                const double reach = 0.3 * scale * leaves[kind].leaf.shape.length;
                const double bright = 0.7 + 0.3 * hue, old = 0.55 * age * age;
                // Lower faces are paler, and duller on the ground than on the tree.
                const glm::dvec3 tint =
                    (sign < 0.0 ? 0.62 : 1.0) * bright *
                    glm::mix(glm::dvec3(1.0), glm::dvec3(0.38, 0.34, 0.34), old);
                const glm::dvec4 turn = standing_on(normal, 2.0 * pi * angle);
                // The root of the leaf is beside its place, so that its middle is there.
                const glm::dvec3 root = rotated(
                    turn, glm::dvec3(0.0, 0.0, -0.5 * scale * leaves[kind].leaf.shape.length));
                leaves[kind].places.push_back(
                    {frame.on_floor(x, y) +
                         glm::dvec3(root.x, root.y + 0.012 + 0.5 * tilt * reach + 0.006 * lift,
                                    root.z),
                     turn, glm::dvec3(scale), glm::vec3(tint)});
            }
    leaves.erase(std::remove_if(leaves.begin(), leaves.end(),
                                [](const PlotLeaves& own) { return own.places.empty(); }),
                 leaves.end());
    return leaves;
}

Mesh grass_of(const PlotContent& content, const PlotFrame& frame, const CoverField& cover,
              std::uint64_t most) {
    struct Tuft {
        double x, y, share;
        std::uint32_t seed;
    };
    std::vector<Tuft> tufts;
    const WorldBox& box = frame.box();
    const auto [west, east] = cells_of(box.west, box.east, tuft_cell);
    const auto [south, north] = cells_of(box.south, box.north, tuft_cell);
    for (int row = south; row <= north; ++row)
        for (int column = west; column <= east; ++column)
            for (int k = 0; k < tufts_of_cell; ++k) {
                Random random(seed_of_cell(content.seed, 1, column, row), purposes::plot_pieces,
                              static_cast<std::uint32_t>(k));
                const double along = random.uniform(), up = random.uniform(),
                             chance = random.uniform();
                const std::uint32_t seed = random.bits();
                const double x = (column + along) * tuft_cell, y = (row + up) * tuft_cell;
                constexpr double rim = 0.05;
                if (x < box.west + rim || x >= box.east - rim || y < box.south + rim ||
                    y >= box.north - rim)
                    continue;
                const double grass = cover.at(x, y).grass;
                if (chance < grass * grass) tufts.push_back({x, y, grass, seed});
            }
    const std::uint64_t of_tuft = blades_of_tuft * triangles_of_blade;
    // Too many of them are thinned out evenly.
    const std::size_t stride =
        1 + static_cast<std::size_t>(tufts.size() * of_tuft / std::max<std::uint64_t>(most, 1));
    Mesh mesh;
    for (std::size_t i = 0; i < tufts.size(); i += stride) {
        const Tuft& tuft = tufts[i];
        const glm::dvec3 foot = frame.on_floor(tuft.x, tuft.y);
        Random random(tuft.seed, purposes::plot_pieces);
        const double height = (0.05 + 0.16 * random.uniform()) * (0.4 + 0.6 * tuft.share);
        for (int blade = 0; blade < blades_of_tuft; ++blade) {
            const double angle = 2.0 * pi * random.uniform(), out = random.uniform(),
                         size = random.uniform(), hue = random.uniform(), bend = random.uniform();
            const SineCosine to = sine_cosine(angle);
            const glm::dvec3 outwards(to.cosine, 0.0, to.sine), across(-to.sine, 0.0, to.cosine);
            const double length = height * (0.6 + 0.6 * size), width = 0.003 + 0.0025 * size;
            const glm::dvec3 root = foot + 0.025 * out * outwards - glm::dvec3(0.0, 0.012, 0.0);
            const glm::dvec3 middle =
                root + length * (0.12 + 0.2 * out) * outwards + glm::dvec3(0.0, 0.55 * length, 0.0);
            const glm::dvec3 tip = middle + length * (0.15 + 0.45 * bend) * outwards +
                                   glm::dvec3(0.0, 0.45 * length * (1.0 - bend), 0.0);
            const auto first = static_cast<std::uint32_t>(mesh.positions.size());
            const double dry = hue > 0.88 ? 1.0 : 0.0;
            const glm::dvec3 green =
                glm::mix(glm::dvec3(0.035, 0.075, 0.012), glm::dvec3(0.15, 0.22, 0.04), hue);
            const glm::dvec3 tint = glm::mix(green, glm::dvec3(0.32, 0.26, 0.12), dry);
            const auto add = [&](const glm::dvec3& at, const glm::dvec3& normal, double light) {
                mesh.positions.emplace_back(at);
                mesh.normals.emplace_back(glm::normalize(normal));
                mesh.tints.emplace_back(light * tint);
            };
            for (const auto& [at, breadth, light] :
                 {std::tuple{root, width, 0.55}, std::tuple{middle, 0.8 * width, 0.85}}) {
                add(at + breadth * across, across + 0.4 * glm::dvec3(0.0, 1.0, 0.0), light);
                add(at - breadth * across, -across + 0.4 * glm::dvec3(0.0, 1.0, 0.0), light);
                add(at + 0.4 * breadth * outwards, outwards, light);
            }
            add(tip, outwards + glm::dvec3(0.0, 1.0, 0.0), 1.0);
            // Corners of a section: on both sides, and on the lower face.
            for (const auto& [a, b] : {std::pair{0U, 1U}, std::pair{1U, 2U}, std::pair{2U, 0U}}) {
                const std::uint32_t low = first + a, next = first + b, high = low + 3,
                                    next_high = next + 3;
                mesh.indices.insert(mesh.indices.end(), {low, next_high, next, low, high, next_high,
                                                         high, first + 6, next_high});
            }
            mesh.indices.insert(mesh.indices.end(), {first, first + 1, first + 2});
        }
    }
    return mesh;
}

}  // namespace sporeprint
