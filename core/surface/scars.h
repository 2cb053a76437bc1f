// What weather, slugs and hands have left on the charts, as the kernels read it. Private to core/surface.
#pragma once

#include <array>
#include <cstdint>
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
    float x = 0.0F, y = 0.0F;  ///< centre, or where a line begins; tongue: phases of its border
    float along_x = 1.0F,
          along_y = 0.0F;  ///< unit: away from the apex, along the stem, or along the line
    float per_length = 1.0F, per_width = 1.0F;  ///< of the half axes; margin: of depth and angle
    float length = 0.0F;                        ///< of a line; tongue: the third phase
    float width = 0.0F, width_end = 0.0F;       ///< half widths of a line
    float height = 0.0F;                        ///< of its relief
    float strength = 1.0F;                      ///< 0..1
    float rim = 0.0F;                           ///< margin: width of what is gnawed or rolled
    float middle_x = 0.0F, middle_y = 0.0F, reach = 0.0F;  ///< circle round all it touches
    std::uint32_t seed = 0;
};

/// All scars of a painting, by part: cap, hymenium, stem.
struct ScarsPlan {
    std::array<std::vector<Scar>, 3> scars;
    std::array<std::vector<std::vector<int>>, 3> by_row;
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

/// Beyond this many half sizes an oval leaves no trace.
inline constexpr float scar_window = 1.5F;

/// Fills plan.scars. pre: frames and discs of the plan are set
void plan_scars(const PaintParams& params, PaintPlan& plan);

}  // namespace sporeprint
