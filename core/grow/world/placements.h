// Placements: where the trees, dead trunks and fruit bodies of a world stand on a day, for programs that place models of
// their own.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/grow/execution_context.h"
#include "core/grow/world/plot_places.h"
#include "core/plant/tree_spec.h"
#include "core/world/world.h"

namespace sporeprint {

enum class PlacementKind { tree, snag, log, fungus };
inline constexpr std::size_t placement_kind_count = 4;

constexpr const char* name(PlacementKind kind) {
    switch (kind) {
        case PlacementKind::tree:
            return "tree";
        case PlacementKind::snag:
            return "snag";
        case PlacementKind::log:
            return "log";
        case PlacementKind::fungus:
            return "fungus";
    }
    return nullptr;
}

/// One thing of a world at a moment.
struct Placement {
    std::uint64_t id = 0;
    PlacementKind kind = PlacementKind::tree;
    std::uint8_t species =
        0;  ///< of a fungus: which of the world's; otherwise which kind of the stand
    /// Of its model, whose y is up: metres from the centre of the world, x to the east, y up, z to the south. The y of
    /// a dead trunk runs along it from its foot.
    GlbTransform place;
    double length = 0.0;  ///< height of a tree, length of a trunk, metres; 0 for a fungus
    double diameter =
        0.0;  ///< of a trunk: of a tree at breast height, of a dead one at its foot, metres
    WorldTime began = 0;     ///< when the tree was born, the trunk died, or the body emerged
    double age = 0.0;        ///< of a fungus, 0..1 (age_at())
    std::uint32_t seed = 0;  ///< of a fungus; of a tree that of the individual that shows it
    std::uint64_t host =
        0;  ///< of a fungus: id of the tree or trunk on which its mycelium lives, or 0
    std::uint64_t trunk = 0;  ///< of a fungus: id of the trunk on whose bark it stands, or 0
    std::uint8_t wood = 0;    ///< the kind of that trunk
};

/// What to place.
struct PlacementChoice {
    std::array<bool, placement_kind_count> kinds{true, true, true, true};
    std::vector<bool> species;  ///< of the fungi of the world; empty for all
    [[nodiscard]] bool has(PlacementKind kind) const {
        return kinds[static_cast<std::size_t>(kind)];
    }
};

/// All that a rectangle has at a moment.
struct Placements {
    std::vector<Placement> rows;  ///< by ascending ids
    /// The individuals that show the trees, by kind and seed: [kind * tree_shapes_of_kind + seed - 1]; empty if no trees
    /// are placed.
    std::vector<TreeSpec> trees;
};

/// Returns what a rectangle of a world has at a moment. A plot of the same moment shows the same things at the same
/// places; of a log that leaves the plot it shows a part.
///
/// time    from year 0 to last_year
/// cost    80 ms for each block of 64 m where nothing is known, 3 ms where its records are cached; blocks are computed
///         in parallel
[[nodiscard]] Placements placements_in(const World& world, const WorldBox& box, WorldTime time,
                                       const PlacementChoice& choice, const Atlas& atlas,
                                       const ExecutionContext& execution);

}  // namespace sporeprint
