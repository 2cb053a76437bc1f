#include "core/grow/world/placements.h"

#include <algorithm>
#include <functional>
#include <memory>

#include "core/grow/world/parts.h"
#include "core/grow/world/plot_of_world.h"
#include "core/grow/world/plot_parts.h"
#include "core/math/direction.h"
#include "core/world/season.h"
#include "core/world/tree_growth.h"

namespace sporeprint {

namespace {

/// The level of detail whose size trees have: that of trees on plots.
constexpr int lod_of_trees = 2;

/// How far a trunk reaches beyond the block of its foot, at most, metres.
constexpr double trunk_reach = 44.0;

/// Returns the part of a rectangle that is in a block.
WorldBox part_in(CellIndex block, const WorldBox& box) {
    const WorldBox all = box_of(block);
    return {std::max(box.west, all.west), std::max(box.south, all.south),
            std::min(box.east, all.east), std::min(box.north, all.north)};
}

/// The same for all blocks of a request.
struct Request {
    const World& world;
    WorldBox box;
    WorldTime time;
    const PlacementChoice& choice;
    const Atlas& atlas;
    const ExecutionContext& execution;
    PlotContent content;               ///< of the day, of no place
    std::vector<TreeSize> tree_sizes;  ///< of the individuals of trees
    std::vector<bool> is_lateral;      ///< of each species

    [[nodiscard]] int year() const { return static_cast<int>(time / ticks_of_year); }
    [[nodiscard]] bool has_dead_wood() const {
        return choice.has(PlacementKind::snag) || choice.has(PlacementKind::log);
    }
};

/// Returns the rotation that turns the vertical axis to a direction.
glm::dvec4 turned_to(const glm::dvec3& up) {
    const glm::dvec3 right = square_to(up, {1.0, 0.0, 0.0});
    return quaternion_of({right, up, glm::cross(right, up)});
}

/// The placements of one block.
class BlockPlacements {
  public:
    BlockPlacements(const Request& request, CellIndex block)
        : request_(request),
          block_(block),
          box_(part_in(block, request.box)),
          around_(present_round(request.world, box_of(block), request.time, request.execution)),
          content_(request.content) {
        content_.centre = point_at((block.x + 0.5) * block_side, (block.y + 0.5) * block_side);
        content_.size = block_side + 2.0 * trunk_reach;
        content_.trees = around_.trees;
        content_.dead_wood = around_.dead;
        feet_ = feet_of(content_);
    }

    [[nodiscard]] std::vector<Placement> all() {
        const World& world = request_.world;
        const FloorHeights floor(*world.ground, content_.seed, content_.micro, feet_);
        const PlotFrame frame(content_, floor);
        if (request_.choice.has(PlacementKind::tree)) add_trees(frame);
        if (request_.has_dead_wood()) add_dead_wood(frame);
        if (request_.choice.has(PlacementKind::fungus)) add_fungi(frame);
        const glm::dvec3 origin = frame.origin();
        for (Placement& row : rows_) row.place.translation += origin;
        return std::move(rows_);
    }

  private:
    const Request& request_;
    CellIndex block_;
    WorldBox box_;
    Block around_;
    PlotContent content_;
    std::vector<TreeFoot> feet_;
    std::vector<Placement> rows_;

    void add_trees(const PlotFrame& frame) {
        for (const StandTree& tree : around_.trees) {
            if (!contains(box_, tree.at)) continue;
            const std::uint64_t number = shape_number(tree);
            const TreeSize& size = request_.tree_sizes[tree.kind * tree_shapes_of_kind + number];
            Placement row;
            row.id = tree.id;
            row.species = tree.kind;
            row.place = place_of(tree, request_.time, size, frame);
            row.length = height_at(tree, request_.time);
            row.diameter = trunk_diameter(row.length);
            row.began = tree.born;
            row.seed = static_cast<std::uint32_t>(1 + number);
            rows_.push_back(row);
        }
    }

    void add_dead_wood(const PlotFrame& frame) {
        for (const DeadWood& wood : around_.dead) {
            const PlacementKind kind =
                wood.stands_at(request_.time) ? PlacementKind::snag : PlacementKind::log;
            if (!request_.choice.has(kind) || !contains(box_, wood.at)) continue;
            const std::optional<TrunkLine> line = trunk_line(wood, content_, frame);
            if (!line || line->parts.empty()) continue;
            const glm::dvec3 foot = line->section(line->from).middle,
                             top = line->section(line->to).middle;
            Placement row;
            row.id = wood.id;
            row.kind = kind;
            row.species = wood.kind;
            row.length = line->to - line->from;
            row.place = {foot, turned_to(glm::normalize(top - foot))};
            row.diameter = 2.0 * radius_at(wood, request_.time);
            row.began = wood.died;
            rows_.push_back(row);
        }
    }

    void add_fungi(const PlotFrame& frame) {
        const auto season =
            season_of_world(request_.world, block_, request_.year(), request_.execution);
        BearingTrunks trunks(content_, frame);
        const std::vector<bool>& chosen = request_.choice.species;
        for (const FruitBody& body : season->bodies) {
            if (!body.stands_at(request_.time) || !contains(box_, body.at) ||
                (!chosen.empty() && !chosen[body.species]))
                continue;
            Placement row;
            row.id = body.id;
            row.kind = PlacementKind::fungus;
            row.species = body.species;
            row.place = place_of(body, frame, request_.is_lateral[body.species], trunks);
            row.began = body.emerged;
            row.age = age_at(body, request_.time);
            row.seed = body.seed();
            row.host = body.host;
            row.trunk = body.trunk;
            row.wood = kind_of(body.trunk);
            rows_.push_back(row);
        }
    }

    /// Returns the kind of the stand of a trunk; 0 for none.
    [[nodiscard]] std::uint8_t kind_of(std::uint64_t trunk) const {
        if (trunk == 0) return 0;
        const auto wood = std::ranges::find(around_.dead, trunk, &DeadWood::id);
        return wood == around_.dead.end() ? std::uint8_t{0} : wood->kind;
    }
};

/// Finds the individuals that show the trees of a world, and their sizes.
void find_trees(Request& request, std::vector<TreeSpec>& specs) {
    const PlotContent& content = request.content;
    specs.resize(content.kinds.size() * tree_shapes_of_kind);
    request.tree_sizes.resize(specs.size());
    std::vector<std::function<void()>> tasks;
    for (std::size_t i = 0; i < specs.size(); ++i)
        tasks.emplace_back([&, i] {
            specs[i] = tree_spec(content, i / tree_shapes_of_kind, i % tree_shapes_of_kind,
                                 lod_of_trees, request.atlas);
            request.tree_sizes[i] = tree_size(specs[i], request.atlas, request.execution);
        });
    request.execution.parallel(tasks);
}

}  // namespace

Placements placements_in(const World& world, const WorldBox& box, WorldTime time,
                         const PlacementChoice& choice, const Atlas& atlas,
                         const ExecutionContext& execution) {
    Request request{world, box, time, choice, atlas, execution, content_of(world, {}, time),
                    {},    {}};
    Placements out;
    if (choice.has(PlacementKind::tree)) find_trees(request, out.trees);
    for (const std::string& id : world.species_ids) {
        const AtlasEntry* const entry = atlas.find(id);
        request.is_lateral.push_back(entry != nullptr && entry->species.is_lateral());
    }
    const std::vector<CellIndex> blocks = blocks_of(box);
    const WorldBox first = box_of(blocks.front()), last = box_of(blocks.back());
    const WorldBox whole{first.west, first.south, last.east, last.north};
    if (choice.has(PlacementKind::fungus)) compute_surroundings(world, whole, execution);
    std::vector<std::vector<Placement>> parts(blocks.size());
    std::vector<std::function<void()>> tasks;
    for (std::size_t i = 0; i < blocks.size(); ++i)
        tasks.emplace_back([&, i] {
            throw_if_cancelled(execution);
            parts[i] = BlockPlacements(request, blocks[i]).all();
        });
    execution.parallel(tasks);
    for (std::vector<Placement>& part : parts)
        out.rows.insert(out.rows.end(), part.begin(), part.end());
    std::ranges::sort(out.rows, {}, &Placement::id);
    return out;
}

}  // namespace sporeprint
