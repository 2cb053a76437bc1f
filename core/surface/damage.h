// Damage on the charts (cracks, furrows, pits, bruises, bites, ...) in the form that the paint
// kernels read. Private to core/surface.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace sporeprint {

struct PaintParams;
struct PaintPlan;

/// Geometric primitive that a damage mark is rasterised as.
enum class DamageShape : std::uint8_t {
    line,    ///< a piece of a crack or furrow: from a point along a direction
    oval,    ///< a pit, bruise, drop or lump: round a point
    margin,  ///< a bite, split or tongue: in angle and distance from the margin of a disc
};
enum class DamageKind : std::uint8_t {
    crack,
    furrow,
    pit,
    bruise,
    drop,
    lump,
    bite,
    split,
    tongue
};

/// One damage mark on one chart. Lengths are relative to the chart: a disc's radius, or a stem's
/// circumference.
struct SpotPlan {
    DamageShape shape = DamageShape::oval;
    DamageKind kind = DamageKind::pit;
    // Members needed to intersect a row come first, because they are read most often.
    float middle_x = 0.0F, reach = 0.0F;  ///< bounding circle
    /// Centre, or where a line begins; tongue: phases of its border; split: x is per_width on the side
    /// of smaller angles.
    float x = 0.0F, y = 0.0F;
    /// Line: step along a row from one row to the next, and half of its extent within a row.
    float lean = 0.0F, breadth = 0.0F;
    float cover = 0.0F;  ///< line: extent to its sides and beyond its ends
    float along_x = 1.0F,
          along_y = 0.0F;  ///< unit: away from the apex, along the stem, or along the line
    float per_length = 1.0F, per_width = 1.0F;  ///< 1 / half axes; margin: 1 / depth, 1 / angle
    float length = 0.0F;                        ///< line: its length; tongue: the third phase
    float width = 0.0F,
          width_grow = 0.0F;  ///< half width at the start of a line, and its growth with length
    float height = 0.0F;      ///< height of its relief
    float strength = 1.0F;    ///< opacity, 0..1
    float rim = 0.0F;         ///< margin: width of the gnawed or rolled border
    std::uint32_t seed = 0;
    float middle_y = 0.0F, rows = 0.0F;  ///< of the bounding circle; extent across rows
};

/// Index from rows of a chart to the damage marks that cross them: marks of row y, in drawing
/// order, are those from first[y + 1] to first[y + 2]. There is one extra row at each side, whose
/// heights give the slopes of the first and the last row.
struct DamageRows {
    std::vector<std::uint32_t> first;       ///< offsets, one more than rows
    std::vector<std::uint32_t> spot_index;  ///< indices of marks, row after row
    [[nodiscard]] std::span<const std::uint32_t> of(int y) const {
        const std::uint32_t* const row = first.data() + y + 1;
        return {spot_index.data() + row[0], spot_index.data() + row[1]};
    }
};

/// All damage of a painting, by part: cap, hymenium, stem.
struct DamagePlan {
    std::array<std::vector<SpotPlan>, 3> damage_spots;
    std::array<DamageRows, 3> by_row;
    std::array<float, 3> flesh{};   ///< linear light
    std::array<float, 3> bruise{};  ///< linear light
    std::array<float, 3> faded{};   ///< linear light
    std::array<float, 3> dusty{};   ///< linear light
    float dust = 0.0F;
    float melted = 0.0F;     ///< amount of deliquescence
    float ink_front = 1.0F;  ///< share of the cap's meridian where blackening begins
    float ink_lower = 1.0F;  ///< the same on the lower face
    std::uint32_t seed = 0;
};

/// Returns the squared distance from the centre of an oval, in half axes, beyond which it changes
/// nothing. Clouds of bruises and ragged pits reach furthest.
constexpr float oval_window(DamageKind kind) {
    if (kind == DamageKind::lump) return 1.0F;
    return kind == DamageKind::bruise || kind == DamageKind::pit ? 2.25F : 1.6F;
}

/// Returns the distance from the middle of a line, in half widths, beyond which it changes nothing.
/// Cracks have ragged edges.
constexpr float line_window(DamageKind kind) { return kind == DamageKind::furrow ? 2.4F : 3.0F; }

/// Fills plan.damage. pre: frames and discs of the plan are set
void plan_damage(const PaintParams& params, PaintPlan& plan);

}  // namespace sporeprint
