// Pipeline of a tile of 3D Tiles: from a square of a world and one of its layers to a GLB file.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "core/atlas/atlas.h"
#include "core/grow/execution_context.h"
#include "core/grow/product.h"
#include "core/grow/world/plot.h"
#include "core/grow/world/tiling.h"
#include "core/grow/world/world_materials.h"
#include "core/plant/tree_spec.h"
#include "core/world/world.h"

namespace sporeprint {

/// How tiles have shapes that occur in many of them: as files of their own with instances of EXT_mesh_gpu_instancing,
/// or as meshes and nodes of each tile, which every reader of glTF can show.
enum class TileProfile { web, core };

constexpr const char* name(TileProfile profile) {
    switch (profile) {
        case TileProfile::web:
            return "web";
        case TileProfile::core:
            return "core";
    }
    return nullptr;
}

/// Returns the addresses of what tiles of the profile web share, relative to those of the tiles.
struct TileLinks : MaterialUrls {
    std::function<std::string(const TreeSpec&)> tree = {};          ///< geometry of a tree
    std::function<std::string(const MushroomSpec&)> mushroom = {};  ///< geometry of a mushroom
};

/// A layer of a tile at a moment.
struct TileRequest {
    Tiling tiling;
    TileIndex tile;
    PlotLayer layer = PlotLayer::ground;
    TileProfile profile = TileProfile::web;
    WorldTime time = 0;
};

/// Fruit bodies whose longest side is shorter than this are on the two finest levels alone, metres.
inline constexpr double least_body_from_afar = 0.05;

/// Builds a tile. Its root node has the middle of the tile as translation, east of the centre of the world, up from the
/// zero of its heights, and south; nodes of trees, trunks and bodies have their ids as extras.
///
/// returns  the GLB; without meshes where nothing is or where tiles of this size have no such content
/// throws   InvalidInput (path "/tile") for a tile that the world does not have, Cancelled
[[nodiscard]] Grown grow_tile(const std::shared_ptr<const World>& world, const TileRequest& request,
                              const Atlas& atlas, const TileLinks& links, const Extras& extras = {},
                              const ExecutionContext& execution = {});

}  // namespace sporeprint
