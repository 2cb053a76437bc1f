// The parts of a plot as meshes: trees, dead wood, leaves and grass. Coordinates are those of the file.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/grow/plot.h"
#include "core/grow/tree.h"
#include "core/plant/trunk_piece.h"
#include "core/plant/wood_image.h"

namespace sporeprint {

/// The frame of a plot: places of a world, metres, as places of a file.
class PlotFrame {
  public:
    PlotFrame(const PlotContent& content, const FloorHeights& floor);
    [[nodiscard]] glm::dvec3 at(double x, double y, double height) const {
        return {x - x_, height - height_, y_ - y};
    }
    /// Returns the place on the floor.
    [[nodiscard]] glm::dvec3 on_floor(double x, double y) const {
        return at(x, y, floor_->at(x, y));
    }
    /// Returns the height of what is at y = 0, metres.
    [[nodiscard]] double height() const { return height_; }
    [[nodiscard]] const WorldBox& box() const { return box_; }
    [[nodiscard]] const FloorHeights& floor() const { return *floor_; }
    /// Returns true if a place is on the half-open square of the plot.
    [[nodiscard]] bool has(const WorldPoint& at) const;

  private:
    const FloorHeights* floor_;
    WorldBox box_;
    double x_, y_, height_;
};

/// The meshes of the individuals of trees on a plot, at most four of each kind.
struct PlotTrees {
    struct Shape {
        std::size_t kind = 0;
        std::string name;
        TreeSpec spec;
        std::shared_ptr<const TreeMeshes> meshes;
        double height = 1.0, radius = 0.3;  ///< of the tree and of its crown, metres
    };
    struct Placed {
        std::size_t shape = 0;
        std::uint64_t id = 0;
        GlbTransform place;
    };
    std::vector<Shape> shapes;
    std::vector<Placed> trees;
};

/// Returns the trees that stand on a plot.
///
/// most  number of triangles that they may have; fewer ones than at the level of detail of the options
[[nodiscard]] PlotTrees trees_of(const PlotContent& content, const PlotOptions& options,
                                 const PlotFrame& frame, std::uint64_t most, const Atlas& atlas,
                                 const ExecutionContext& execution);

/// A log or a snag.
struct PlotLog {
    std::uint64_t id = 0;
    Substrate wood = Substrate::beech;
    bool lies = true;
    Mesh mesh;
};

/// Returns the wood of a kind of tree.
[[nodiscard]] Substrate wood_of(const TreePreset& tree);

/// The part of a dead trunk that is on a plot.
struct TrunkLine {
    double from = 0.0, to = 0.0;  ///< distances from its foot, metres
    /// Returns the section at a distance from the foot, also beyond the part; lives as long as the frame.
    std::function<TrunkSection(double)> section;
};

/// Returns how a dead trunk lies or stands on a plot; nothing for one that is not there.
[[nodiscard]] std::optional<TrunkLine> trunk_line(const DeadWood& wood, const PlotContent& content,
                                                  const PlotFrame& frame);

/// Returns the dead trunks on a plot: logs are cut where they leave it.
[[nodiscard]] std::vector<PlotLog> logs_of(const PlotContent& content, const PlotFrame& frame,
                                           const CoverField& cover, const Atlas& atlas);

/// Leaves of one kind that lie on the floor.
struct PlotLeaves {
    LeafParams leaf;
    Mesh one;  ///< of which all are copies
    std::vector<GlbTransform> places;

    /// Returns all of them as one mesh.
    [[nodiscard]] Mesh merged() const;
};

/// Returns the leaves that lie on a plot, by kind of tree.
///
/// per_m2  where leaves cover the ground
[[nodiscard]] std::vector<PlotLeaves> leaves_of(const PlotContent& content, const PlotFrame& frame,
                                                const CoverField& cover, double per_m2,
                                                const Atlas& atlas);

/// Returns the blades of grass of a plot as one mesh with tints; empty where none grows.
///
/// most  number of triangles
[[nodiscard]] Mesh grass_of(const PlotContent& content, const PlotFrame& frame,
                            const CoverField& cover, std::uint64_t most);

}  // namespace sporeprint
