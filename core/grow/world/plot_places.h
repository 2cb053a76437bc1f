// Where trees, dead trunks and fruit bodies of a world stand on a plot, and how they are turned and scaled. Coordinates
// are those of the file.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/gltf/glb.h"
#include "core/grow/world/plot.h"
#include "core/plant/trunk_piece.h"
#include "core/world/contact_shade.h"

namespace sporeprint {

/// The frame of a plot: places of a world, metres, as places of a file.
class PlotFrame {
  public:
    /// step  of the height of the origin, metres: a multiple of slab_step
    PlotFrame(const PlotContent& content, const FloorHeights& floor, double step = slab_step);
    [[nodiscard]] glm::dvec3 at(double x, double y, double height) const {
        return {x - x_, height - height_, y_ - y};
    }
    /// Returns the place on the floor.
    [[nodiscard]] glm::dvec3 on_floor(double x, double y) const {
        return at(x, y, floor_->at(x, y));
    }
    /// Returns the place of the world below a place of a file, metres to the east and to the north.
    [[nodiscard]] glm::dvec2 below(const glm::dvec3& place) const {
        return {x_ + place.x, y_ - place.z};
    }
    /// Returns the height of what is at y = 0, metres.
    [[nodiscard]] double height() const { return height_; }
    /// Returns the origin of the file in the world: metres to the east, up, and to the south.
    [[nodiscard]] glm::dvec3 origin() const { return {x_, height_, -y_}; }
    [[nodiscard]] const WorldBox& box() const { return box_; }
    [[nodiscard]] const FloorHeights& floor() const { return *floor_; }
    /// Returns true if a place is on the half-open square of the plot.
    [[nodiscard]] bool has(const WorldPoint& at) const;

  private:
    const FloorHeights* floor_;
    WorldBox box_;
    double x_, y_, height_;
};

/// Returns the id of a record as 16 hexadecimal digits, since numbers of JSON have 53 bits.
[[nodiscard]] std::string id_text(std::uint64_t id);

/// Returns true if the foot of a tree is on the plot as a whole, with its roots: one that is cut would hang in the air
/// before the wall of a slab.
[[nodiscard]] bool stands_within(const StandTree& tree, WorldTime time, const PlotFrame& frame);

/// The size of the model that shows a tree: height, and radius of its crown, metres.
struct TreeSize {
    double height = 1.0, radius = 0.3;
};

/// Returns the place of the model of a tree, scaled to its height and its crown.
[[nodiscard]] GlbTransform place_of(const StandTree& tree, WorldTime time, const TreeSize& model,
                                    const PlotFrame& frame);

/// A piece of a dead trunk between two distances from its foot, metres.
struct TrunkPart {
    double from = 0.0, to = 0.0;
};

/// The part of a dead trunk that is on a plot.
struct TrunkLine {
    double from = 0.0, to = 0.0;  ///< distances from its foot, metres
    double whole = 0.0;           ///< length of what is left of it, metres
    std::vector<TrunkPart>
        parts;  ///< its pieces from the foot on; rotten ones are apart, and short ones are left out
    /// Returns the section at a distance from the foot, also beyond the part; lives as long as the frame. Between two
    /// pieces it is that of the nearer end of the later one.
    std::function<TrunkSection(double)> section;
};

/// Returns how a dead trunk lies or stands on a plot; nothing for one that is not there.
[[nodiscard]] std::optional<TrunkLine> trunk_line(const DeadWood& wood, const PlotContent& content,
                                                  const PlotFrame& frame);

/// Returns where trunks touch the floor: the feet of trees and snags, and logs where they do not span a hollow.
///
/// is_slab  trees that are not stands_within() the plot are not shown, and touch nothing
[[nodiscard]] std::vector<Contact> contacts_on(const PlotContent& content, const PlotFrame& frame,
                                               bool is_slab);

/// The dead trunks of a plot on which bodies grow. Refers to the content and the frame.
class BearingTrunks {
  public:
    BearingTrunks(const PlotContent& content, const PlotFrame& frame)
        : content_(content), frame_(frame) {}

    /// Returns the place on the bark in a direction from the axis, nearest to a body; nothing if its trunk is not
    /// there.
    [[nodiscard]] std::optional<glm::dvec3> place(const FruitBody& body, const glm::dvec3& out);

  private:
    const PlotContent& content_;
    const PlotFrame& frame_;
    std::map<std::uint64_t, std::optional<TrunkLine>> lines_;
};

/// Returns the place of a fruit body.
///
/// is_lateral  its model grows from its side, on the bark of a trunk
[[nodiscard]] GlbTransform place_of(const FruitBody& body, const PlotFrame& frame, bool is_lateral,
                                    BearingTrunks& trunks);

}  // namespace sporeprint
