#include "core/grow/world/plot_parts.h"

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
#include "core/plant/snow_cap.h"
#include "core/plant/trunk_piece.h"
#include "core/world/leaf_stamp.h"
#include "core/world/tree_growth.h"

namespace sporeprint {

namespace {

/// Side of the images of bark and leaves at LOD 0; it halves with every level.
constexpr int tree_texture_side = 2048;

/// The side of cells in which leaves lie, metres.
constexpr double leaf_cell = 1.0;

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

std::shared_ptr<const TreeMeshes> cached_meshes(const TreeSpec& spec, const Atlas& atlas,
                                                const ExecutionContext& execution) {
    return execution.caches.trees("plot tree " + canonical_text(spec.params), [&] {
        return std::make_shared<const TreeMeshes>(tree_meshes(spec, atlas));
    });
}

TreeSize size_of(const TreeMeshes& meshes) {
    const Bounds box = bounds(meshes);
    TreeSize size;
    size.height = std::max(0.1, static_cast<double>(box.max.y));
    size.radius =
        std::max(0.02, 0.25 * static_cast<double>(box.max.x - box.min.x + box.max.z - box.min.z));
    return size;
}

int sides_of(double radius) { return radius > 0.18 ? 16 : radius > 0.08 ? 12 : 8; }

/// Appends what is left of the branches of a trunk: short, broken, turned to its top.
///
/// from, to  part of the trunk, metres from its foot
/// lies      a log has none below
void add_stubs(Mesh& mesh, const TrunkLine& line, double from, double to, bool lies,
               const TrunkPieceParams& trunk, Random& random) {
    constexpr double between = 0.9, thinnest = 0.035;
    const double first = std::max(from, 0.12 * line.whole) + between * random.uniform();
    for (double s = first; s < to - 0.1; s += between * (0.4 + 1.2 * random.uniform())) {
        const double turn = (lies ? 0.62 : 1.0) * pi * random.symmetric(),
                     lean = 0.25 + 0.5 * random.uniform(), thickness = random.uniform(),
                     length = random.uniform(), stays = random.uniform();
        const std::uint32_t seed = random.bits();
        const TrunkSection section = line.section(s);
        // The more has decayed, the fewer are left.
        if (section.radius < thinnest || stays < 1.6 * trunk.lost) continue;
        const glm::dvec3 along = unit_or(
            line.section(std::min(s + 0.05, to - 1e-6)).middle - section.middle, {0.0, 1.0, 0.0});
        const glm::dvec3 up = square_to(along, {0.0, 1.0, 0.0}), side = glm::cross(along, up);
        const SineCosine round = sine_cosine(turn);
        const glm::dvec3 way = glm::normalize(round.cosine * up + round.sine * side + lean * along);
        TrunkPieceParams stub = trunk;
        const double radius = section.radius * (0.14 + 0.16 * thickness);
        stub.length = section.radius + radius * (1.5 + 9.0 * length * length);
        stub.start = 0.0;
        stub.seed = seed;
        stub.sides = 6;
        stub.rings = 4;
        stub.foot = TrunkEnd::cut;
        stub.top = TrunkEnd::broken;
        append(mesh, trunk_piece(stub, [&](double out) {
                   return TrunkSection{section.middle + out * way,
                                       radius * (1.0 - 0.4 * out / stub.length)};
               }));
    }
}

PlotLog log_of(const DeadWood& wood, const TrunkLine& line, const PlotContent& content,
               const CoverField& cover, Substrate kind, const TrunkDetail& detail) {
    const bool lies = wood.lies_at(content.time);
    const double lost = mass_lost(wood, content.time);
    TrunkPieceParams params;
    params.seed = static_cast<std::uint32_t>(wood.id);
    params.sides = std::min(sides_of(radius_at(wood, content.time)), detail.sides);
    params.rings = detail.rings;
    params.lost = lies ? lost : 0.6 * lost;
    Random of_stubs(params.seed, purposes::plot_pieces, 4);
    PlotLog log{wood.id, kind, lies, {}, {}};
    if (!lies) {
        // A snag goes on below the ground.
        constexpr double below = 0.25;
        params.length = line.to - line.from + below;
        params.foot = TrunkEnd::cut;
        log.mesh = trunk_piece(params, [&](double s) { return line.section(s - below); });
        if (detail.stubs) add_stubs(log.mesh, line, line.from, line.to, lies, params, of_stubs);
        return log;
    }
    const SineCosine turn = sine_cosine(wood.direction);
    const double middle = 0.5 * (line.from + line.to);
    const double damp =
        cover.at(metres(wood.at.x) + middle * turn.cosine, metres(wood.at.y) + middle * turn.sine)
            .moss;
    params.moss = std::clamp(1.4 * damp + 1.2 * lost - 0.15, 0.0, 1.0);
    SnowCapParams snow;
    snow.seed = params.seed;
    snow.depth = content.snow_depth;
    snow.cover = content.snow;
    snow.step = detail.snow_step;
    snow.columns = detail.snow_columns;
    for (const TrunkPart& part : line.parts) {
        constexpr double within = 1e-6;
        const auto section = [&](double s) {
            return line.section(std::min(part.from + s, part.to - within));
        };
        params.length = snow.length = part.to - part.from;
        params.start = part.from;
        params.foot = part.from > line.from || part.from <= 0.0 ? TrunkEnd::broken : TrunkEnd::cut;
        params.top = part.to < line.to || part.to >= line.whole ? TrunkEnd::broken : TrunkEnd::cut;
        append(log.mesh, trunk_piece(params, section));
        if (detail.stubs) add_stubs(log.mesh, line, part.from, part.to, lies, params, of_stubs);
        append(log.snow, snow_cap(snow, section));
        params.seed = ++snow.seed;
    }
    return log;
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

/// Returns how much snow lies on needles where it covers a share of the ground, both 0..1.
double snow_on_needles(double cover) {
    // Branches shed a part of it; in steps, so that trees of many days share their images.
    constexpr double of_ground = 0.6, steps = 4.0;
    return of_ground * std::floor(steps * cover + 0.5) / steps;
}

/// Returns a rotation that turns the vertical axis to a unit vector, after a turn about it.
glm::dvec4 standing_on(const glm::dvec3& up, double angle) {
    const SineCosine turn = sine_cosine(angle);
    const glm::dvec3 along = square_to(up, {turn.sine, 0.0, turn.cosine});
    return quaternion_of({glm::cross(up, along), up, along});
}

}  // namespace

TreeSpec tree_spec(const PlotContent& content, std::size_t kind, std::uint64_t number, int lod,
                   const Atlas& atlas) {
    const TreePreset& preset = preset_of(content, kind, atlas);
    const LeafPreset& leaf = leaf_of_preset(preset, atlas);
    TreeSpec spec{preset.id.string(), params_of(preset)};
    spec.params.seed = static_cast<std::uint32_t>(1 + number);
    spec.params.lod = lod;
    spec.params.texture_size.value = tree_texture_side;
    spec.params.foot_soil = false;
    // The leaves of a tree that is shown several times as large as it grows would be as much too large.
    spec.params.look.leaves.leaf_group = LeafGroup::branch;
    if (has_needles({leaf.shape, leaf.palette})) {
        spec.params.snow = snow_on_needles(content.snow);
        return spec;
    }
    const LeafState state = leaves_on(content.northern_day());
    spec.params.spring = state.spring;
    spec.params.autumn = state.autumn;
    if (state.bare) spec.params.look.leaves.per_tip = 0;
    return spec;
}

TreeSize tree_size(const TreeSpec& spec, const Atlas& atlas, const ExecutionContext& execution) {
    TreeSpec green = spec;
    green.params.spring = green.params.autumn = green.params.snow = 0.0;
    return size_of(*cached_meshes(green, atlas, execution));
}

PlotTrees::Shape tree_shape(const PlotContent& content, std::size_t kind, std::uint64_t number,
                            int lod, const Atlas& atlas, const ExecutionContext& execution) {
    PlotTrees::Shape shape;
    shape.kind = kind;
    shape.spec = tree_spec(content, kind, number, lod, atlas);
    shape.name = product_name(shape.spec, atlas);
    shape.meshes = cached_meshes(shape.spec, atlas, execution);
    shape.size = size_of(*shape.meshes);
    return shape;
}

PlotTrees trees_of(const PlotContent& content, const PlotOptions& options, const PlotFrame& frame,
                   std::uint64_t most, const Atlas& atlas, const ExecutionContext& execution) {
    std::vector<const StandTree*> standing;
    for (const StandTree& tree : content.trees)
        if (tree.lives_at(content.time) && stands_within(tree, content.time, frame))
            standing.push_back(&tree);
    PlotTrees made;
    for (int lod = options.lod + (options.for_picture ? 0 : 1);; ++lod) {
        made = {};
        std::map<std::pair<std::size_t, std::uint64_t>, std::size_t> shape_of;
        std::uint64_t triangles = 0;
        for (const StandTree* tree : standing) {
            throw_if_cancelled(execution);
            const std::uint64_t number = shape_number(*tree);
            const auto [found, is_new] =
                shape_of.try_emplace({tree->kind, number}, made.shapes.size());
            if (is_new)
                made.shapes.push_back(
                    tree_shape(content, tree->kind, number, lod, atlas, execution));
            const PlotTrees::Shape& own = made.shapes[found->second];
            triangles += own.meshes->triangles();
            made.trees.push_back(
                {found->second, tree->id, place_of(*tree, content.time, own.size, frame)});
        }
        if (triangles <= most || lod == last_far_lod) break;
        // Impostors are for the distance; after the common levels come the far ones.
        if (lod == last_lod) lod = impostor_lod;
    }
    return made;
}

Mesh leaves_beyond(const Mesh& leaves, const GlbTransform& place, const glm::dvec3& eye,
                   double within) {
    Mesh out = leaves;
    out.indices.clear();
    for (std::size_t i = 0; i + 2 < leaves.indices.size(); i += 3) {
        const auto corner = [&](std::size_t k) {
            return glm::dvec3(leaves.positions[leaves.indices[i + k]]);
        };
        const glm::dvec3 middle = (corner(0) + corner(1) + corner(2)) / 3.0;
        const glm::dvec3 at = place.translation + rotated(place.rotation, place.scale * middle);
        if (glm::distance(at, eye) < within) continue;
        for (std::size_t k = 0; k < 3; ++k) out.indices.push_back(leaves.indices[i + k]);
    }
    return out;
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

std::vector<PlotLog> logs_of(const PlotContent& content, const PlotFrame& frame,
                             const CoverField& cover, const Atlas& atlas,
                             const TrunkDetail& detail) {
    std::vector<PlotLog> logs;
    for (const DeadWood& wood : content.dead_wood) {
        if (const auto line = trunk_line(wood, content, frame); line && !line->parts.empty())
            logs.push_back(log_of(wood, *line, content, cover,
                                  wood_of(preset_of(content, wood.kind, atlas)), detail));
    }
    return logs;
}

std::vector<PlotLeaves> leaves_of(const PlotContent& content, const PlotFrame& frame,
                                  const CoverField& cover, double per_m2, const Atlas& atlas,
                                  double rim) {
    constexpr std::size_t triangles = 12;
    constexpr int leaf_texture_side = 256;
    std::vector<PlotLeaves> leaves(content.kinds.size());
    std::vector<bool> falls(content.kinds.size(), false);
    for (std::size_t kind = 0; kind < content.kinds.size(); ++kind) {
        const LeafPreset& preset = leaf_of_preset(preset_of(content, kind, atlas), atlas);
        PlotLeaves& own = leaves[kind];
        own.leaf = params_of(preset);
        own.preset = preset.id.string();
        own.leaf.autumn = 1.0;
        own.leaf.texture_size.value = leaf_texture_side;
        falls[kind] =
            !has_needles({preset.shape, preset.palette}) && preset.shape.leaflets == Leaflets{};
        if (falls[kind]) own.one = foliage_leaf(shape_of(own.leaf), triangles);
    }
    const FallenLeaves fallen = fallen_leaves(content.northern_day());
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
                if (x < box.west + rim || x >= box.east - rim || y < box.south + rim ||
                    y >= box.north - rim)
                    continue;
                const Cover here = cover.at(x, y);
                const double all = here.all_leaves();
                if (chance >= all * (1.0 - content.snow) * per_m2 / most) continue;
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
                const double bright = 0.7 + 0.3 * hue,
                             old = std::min(1.0, 0.45 * age * age + 0.75 * fallen.faded_at(age));
                // Lower faces are paler, and duller on the ground than on the tree.
                const glm::dvec3 tint =
                    (sign < 0.0 ? 0.62 : 1.0) * bright *
                    glm::mix(glm::dvec3(1.0), glm::dvec3(0.33, 0.37, 0.43), old);
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

}  // namespace sporeprint
