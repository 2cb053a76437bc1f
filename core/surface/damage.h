// What weather, slugs and hands have left on the charts, as the kernels read it. Private to core/surface.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace sporeprint {

struct PaintParams;
struct PaintPlan;

/// How a scar is laid over texels.
enum class ScarShape : std::uint8_t {
    line,    ///< a piece of a crack or furrow: from a point along a direction
    oval,    ///< a pit, a bruise, a drop or a lump: round a point
    margin,  ///< a bite, a split or a tongue: in angle and distance from the margin of a disc
};
enum class ScarKind : std::uint8_t { crack, furrow, pit, bruise, drop, lump, bite, split, tongue };

/// One scar on one chart. Lengths are those of the chart: a disc's radius, or a stem's circumference.
struct Scar {
    ScarShape shape = ScarShape::oval;
    ScarKind kind = ScarKind::pit;
    // What tells where a row meets it comes first: it is looked at most.
    float middle_x = 0.0F, reach = 0.0F;  ///< circle round all it touches
    float x = 0.0F, y = 0.0F;  ///< centre, or where a line begins; tongue: phases of its border
    /// Of a line: steps along a row from one row to the next, and half of what it covers of a row.
    float lean = 0.0F, breadth = 0.0F;
    float cover = 0.0F;  ///< of a line: how far it reaches to its sides and beyond its ends
    float along_x = 1.0F,
          along_y = 0.0F;  ///< unit: away from the apex, along the stem, or along the line
    float per_length = 1.0F, per_width = 1.0F;  ///< of the half axes; margin: of depth and angle
    float length = 0.0F;                        ///< of a line; tongue: the third phase
    float width = 0.0F,
          width_grow = 0.0F;  ///< half width where a line begins, its growth with length
    float height = 0.0F;      ///< of its relief
    float strength = 1.0F;    ///< 0..1
    float rim = 0.0F;         ///< margin: width of what is gnawed or rolled
    std::uint32_t seed = 0;
    float middle_y = 0.0F, rows = 0.0F;  ///< of that circle, and how far it reaches across rows
};

/// Which scars cross each row of a chart: those of row y, in the order in which they are laid, from first[y + 1] on to first[y + 2].
/// There is one row more at each side, whose heights give the slopes of the first and the last.
struct ScarRows {
    std::vector<std::uint32_t> first;  ///< one more than rows
    std::vector<std::uint32_t> scar;   ///< indices
    [[nodiscard]] std::span<const std::uint32_t> of(int y) const {
        const std::uint32_t* const row = first.data() + y + 1;
        return {scar.data() + row[0], scar.data() + row[1]};
    }
};

/// All scars of a painting, by part: cap, hymenium, stem.
struct ScarsPlan {
    std::array<std::vector<Scar>, 3> scars;
    std::array<ScarRows, 3> by_row;
    std::array<float, 3> flesh{};   ///< linear light
    std::array<float, 3> bruise{};  ///< linear light
    std::array<float, 3> faded{};   ///< linear light
    std::array<float, 3> dusty{};   ///< linear light
    float dust = 0.0F;
    float melted = 0.0F;     ///< amount of deliquescence
    float ink_front = 1.0F;  ///< share of the cap's meridian where it has begun to turn black
    float ink_lower = 1.0F;  ///< the same on the lower face
    std::uint32_t seed = 0;
};

/// Beyond this an oval leaves no trace: square of the distance from its middle, in half sizes. A stain's cloud reaches furthest.
constexpr float oval_window(ScarKind kind) {
    return kind == ScarKind::lump ? 1.0F : kind == ScarKind::bruise ? 2.25F : 1.6F;
}

/// Beyond this a line leaves no trace: distance from its middle, in its half widths. The edges of cracks are ragged.
constexpr float line_window(ScarKind kind) { return kind == ScarKind::furrow ? 2.4F : 3.0F; }

/// Fills plan.scars. pre: frames and discs of the plan are set
void plan_scars(const PaintParams& params, PaintPlan& plan);

}  // namespace sporeprint
