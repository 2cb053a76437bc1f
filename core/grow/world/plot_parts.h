// The parts of a plot as meshes: trees, dead wood and leaves. Coordinates are those of the file.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/grow/tree.h"
#include "core/grow/world/mesh_copies.h"
#include "core/grow/world/plot.h"
#include "core/grow/world/plot_places.h"
#include "core/plant/wood_image.h"

namespace sporeprint {

/// The meshes of the individuals of trees on a plot, at most four of each kind.
struct PlotTrees {
    struct Shape {
        std::size_t kind = 0;
        std::string name;
        TreeSpec spec;
        std::shared_ptr<const TreeMeshes> meshes;
        TreeSize size;
    };
    struct Placed {
        std::size_t shape = 0;
        std::uint64_t id = 0;
        GlbTransform place;
    };
    std::vector<Shape> shapes;
    std::vector<Placed> trees;
};

/// How many individuals show all trees of a kind, and which of them shows a tree.
inline constexpr std::uint64_t tree_shapes_of_kind = 4;
[[nodiscard]] inline std::uint64_t shape_number(const StandTree& tree) {
    return (tree.id >> 32U) % tree_shapes_of_kind;
}

/// Returns which individual of a kind of trees it is, with the leaves of the day of a plot.
[[nodiscard]] TreeSpec tree_spec(const PlotContent& content, std::size_t kind, std::uint64_t number,
                                 int lod, const Atlas& atlas);

/// Returns the size of an individual, which does not depend on the colour of its leaves, so that it is known through the
/// seasons.
[[nodiscard]] TreeSize tree_size(const TreeSpec& spec, const Atlas& atlas,
                                 const ExecutionContext& execution);

/// Returns an individual of a kind of trees, with the leaves of the day of a plot.
[[nodiscard]] PlotTrees::Shape tree_shape(const PlotContent& content, std::size_t kind,
                                          std::uint64_t number, int lod, const Atlas& atlas,
                                          const ExecutionContext& execution);

/// Returns the trees that stand on a plot.
///
/// most  number of triangles that they may have; fewer ones than at the level of detail of the options
[[nodiscard]] PlotTrees trees_of(const PlotContent& content, const PlotOptions& options,
                                 const PlotFrame& frame, std::uint64_t most, const Atlas& atlas,
                                 const ExecutionContext& execution);

/// Returns the leaves of a tree without those near an eye, which somebody would push aside.
///
/// place   of the tree
/// eye     in the space in which it is placed
/// within  distance of the middle of a triangle, metres
[[nodiscard]] Mesh leaves_beyond(const Mesh& leaves, const GlbTransform& place,
                                 const glm::dvec3& eye, double within);

/// A log or a snag.
struct PlotLog {
    std::uint64_t id = 0;
    Substrate wood = Substrate::beech;
    bool lies = true;
    Mesh mesh;
    Mesh snow;  ///< on a log, with tints; empty without
};

/// Returns the wood of a kind of tree.
[[nodiscard]] Substrate wood_of(const TreePreset& tree);

/// How finely trunks are divided: sides of the thickest ones, and rings; and the snow on them: metres along a trunk, and
/// columns across.
struct TrunkDetail {
    int sides = 16, rings = 160;
    double snow_step = 0.12;
    int snow_columns = 6;
    bool stubs = true;  ///< of branches
};

/// Returns the dead trunks on a plot: logs are cut where they leave it.
[[nodiscard]] std::vector<PlotLog> logs_of(const PlotContent& content, const PlotFrame& frame,
                                           const CoverField& cover, const Atlas& atlas,
                                           const TrunkDetail& detail = {});

/// Leaves of one kind that lie on the floor.
struct PlotLeaves : MeshCopies {
    LeafParams leaf;
    std::string preset;  ///< id of that of the leaf
};

/// Distance from the border of a slab within which no leaf lies, so that none reaches beyond it, metres.
inline constexpr double rim_of_leaves = 0.06;

/// Returns the leaves that lie on a plot, by kind of tree.
///
/// per_m2  where leaves cover the ground
/// rim     distance from the border within which none lies, metres
[[nodiscard]] std::vector<PlotLeaves> leaves_of(const PlotContent& content, const PlotFrame& frame,
                                                const CoverField& cover, double per_m2,
                                                const Atlas& atlas, double rim = rim_of_leaves);

}  // namespace sporeprint
