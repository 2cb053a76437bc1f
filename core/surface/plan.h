// What the paint kernels read: every parameter turned into the few numbers that a texel needs.
// Private to core/surface.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/surface/charts.h"
#include "core/surface/damage.h"

namespace sporeprint {

/// Fields of slowly varying noise that are sampled sparsely and stretched over the texels between.
enum CapField {
    cap_uneven,
    cap_mottle,
    cap_middle,
    cap_bump,
    cap_streak,
    cap_fibre,
    cap_patch,
    cap_vein
};
enum HymeniumField { hymenium_uneven, hymenium_middle, hymenium_bump };
enum StemField { stem_broad, stem_middle, stem_bump, stem_fibre, stem_furrow };
enum VeilField { veil_thread, veil_cloud };
enum BladeField { blade_cloud, blade_uneven };
enum FleshField { flesh_fibre, flesh_cloud };
inline constexpr int most_fields = 8;

/// A colour in linear light.
struct Light {
    float r = 0.0F, g = 0.0F, b = 0.0F;
};

/// A chart's rectangle in texels and where its inset begins, as shares of the rectangle.
struct Frame {
    int x = 0, y = 0, width = 0, height = 0;
    float inset = 0.0F;
};

/// A disc's surface of revolution: a young cap is a piece of a sphere that goes over into a
/// cylinder, a lower face is a cone.
struct DiscPlan {
    float per_texel = 0.0F;  ///< disc radii per texel
    float bend = 0.0F;       ///< angle of the sphere's piece; 0 for a cone
    float sphere = 0.0F;     ///< radius of the sphere in arcs
    float inner = 0.0F;      ///< disc radius where the part begins
    float cone_from = 0.0F;  ///< radius at the inner edge, in lengths of one disc radius
    float cone_grow = 0.0F;  ///< its growth to the rim
};

/// Smooth noise sampled on a grid over a chart and stretched over its texels.
struct CoarseField {
    std::vector<float> values;  ///< (cells + 1)^2
};

/// A given image in linear light, prefiltered to about the chart's resolution; empty when it is
/// painted.
struct GivenImage {
    int width = 0, height = 0;
    std::vector<float> light;          ///< rgb
    float turn = 0.0F;                 ///< of what is shown, 0..1 turns
    float cosine = 1.0F, sine = 0.0F;  ///< of that turn
    [[nodiscard]] bool empty() const { return light.empty(); }
};

inline constexpr int most_ramp_steps = 5;

/// 1.055 x^(1/2.4) - 0.055 as a polynomial of the square root of x, highest power first, for x in
/// 0.0031308..1: Chebyshev nodes.
inline constexpr std::array<float, 7> srgb_curve = {
    -0.58427069F, 2.24849906F, -3.55274765F, 3.03261645F, -1.64561153F, 1.54233637F, -0.04086402F};

/// Relief of a cap. Depths tell how dark hollows are, slopes what painting adds to the mesh: both in arcs.
struct ReliefPlan {
    std::array<std::uint32_t, 3> seed{};
    float folds = 0.0F, fold_slope = 0.0F;
    float fold_size = 1.0F;  ///< cells of noise in the radius of the young hemisphere
    float pits = 0.0F, pit_slope = 0.0F;
    float pit_columns = 3.0F, pit_rows = 2.0F;
    float rib = 0.0F;  ///< half width, in cells
    float tiers = 0.0F, tier_slope = 0.0F;
    float tier_count = 1.0F;
    Light hollow;
    float tint = 0.0F;
    [[nodiscard]] bool any() const { return folds > 0.0F || pits > 0.0F || tiers > 0.0F; }
};

struct CapPlan {
    ReliefPlan relief;
    DiscPlan disc;
    std::array<std::uint32_t, 12> seed{};
    Light first;
    std::array<Light, most_ramp_steps> step{};
    int steps = 0;
    float lightness = 1.0F;
    float ramp_noise = 0.0F;
    float fibrils = 0.0F;
    int fibril_count = 8;
    float zones = 0.0F;
    float zone_count = 1.0F;
    float patches = 0.0F;
    float patch_frequency = 1.0F;  ///< per arc
    float patch_threshold = 0.0F;
    float patch_weight = 0.0F;
    Light patch_colour;
    float streaks = 0.0F;
    float veins = 0.0F;
    float vein_rows = 8.0F;  ///< cells of the net from pole to rim
    float striae = 0.0F;
    int striae_count = 60;
    std::array<float, 3> bumps{};  ///< by octave, already limited to what the texels can show
    float roughness = 0.6F;
    unsigned fields = 0;  ///< bit of each CapField that is used
};

/// A wave of straying blades.
struct WavePlan {
    float count = 1.0F, lean = 0.0F, size = 0.0F, phase = 0.0F;
};

/// Blades round the axis.
struct CombPlan {
    int blades = 60;  ///< that reach the stem
    // Blades on the slots of a comb with more: `slots` slots for `stands` blades, of which each `stride`-th reaches the stem.
    // No slots: the blades stand where they like.
    float slots = 0.0F, stands = 0.0F, stride = 1.0F;
    std::array<WavePlan, 4> wander{};
    float bend = 0.0F;  ///< how far `wander` moves them, in turns
};

struct HymeniumPlan {
    DiscPlan disc;
    std::array<std::uint32_t, 8> seed{};
    int pattern = 0;
    Light colour, edge, depth;
    float mottle = 0.0F;
    float roughness = 0.8F;
    float relief = 0.0F;
    float slot_occlusion = 1.0F;  ///< of the bottom of a slot, with `relief`
    CombPlan comb;
    int tiers = 0;
    float last_tier = 1.0F;  ///< share of the last tier's blades that is there
    float blade = 0.0F;      ///< half thickness, in lengths of one disc radius
    float forking = 0.0F;
    int vein_rows = 0;         ///< of cross veins between ridges
    float veins_there = 0.0F;  ///< see comb.h
    float inner_gap = 0.0F;    ///< share of the face without blades round the stem
    float bare_slope = 1.0F;   ///< over one: how fast the bare ring round the stem ends
    float spine = 0.13F;       ///< half thickness of a spine, in cells
    float pore_tall = 1.0F;    ///< length of a cell over its width
    float pore_rows = 1.0F;    ///< from the inner edge to the rim
    float pore_from = 6.0F;    ///< pores round the inner edge
    float pore_grow = 0.0F;    ///< more of them in each row
    float pore_shown = 0.0F;   ///< 0 when pores are smaller than texels
    std::array<float, 2> bumps{};
    unsigned fields = 0;
};

struct StemPlan {
    std::array<std::uint32_t, 12> seed{};
    float aspect = 2.0F;       ///< length over circumference
    float ragged = 0.1F;       ///< how far the border of the stain strays, in lengths
    float texel_along = 0.0F;  ///< in circumferences
    float texel_round = 0.0F;
    float stretch =
        1.0F;  ///< cells of fine noise are this much rarer along a thin stem, whose texels are long
    Light top, base, stain, band_colour, net_colour;
    float base_stain = 0.0F;
    float fibrils = 0.0F;
    float bands = 0.0F;
    float net = 0.0F;
    std::array<float, 3> bumps{};
    std::array<float, 3> fibres{};  ///< by octave, already limited
    float net_shown = 1.0F;
    // Gills and ridges that run down from its top.
    CombPlan comb;
    float gills = 0.0F;           ///< share of its length that they reach; 0: none do
    float gill_half = 0.0F;       ///< half their thickness, in gaps
    float gill_relief = 0.0F;     ///< height in circumferences
    float gill_occlusion = 1.0F;  ///< between two
    float gill_shown = 0.0F;      ///< 0 when gaps are smaller than texels
    Light gill_colour, gill_edge, gill_depth;
    float roughness = 0.75F;
    unsigned fields = 0;
};

inline constexpr std::array<int, 3> stem_bump_cells = {26, 83, 190};
inline constexpr std::array<int, 3> stem_fibre_cells = {17, 46, 109};
inline constexpr std::array<float, 3> stem_fibre_slender = {0.16F, 0.10F, 0.08F};
inline constexpr std::array<float, 3> cap_bump_frequency = {21.0F, 52.0F, 118.0F};
inline constexpr std::array<float, 2> hymenium_bump_frequency = {30.0F, 62.0F};
inline constexpr float net_columns = 46.0F;
inline constexpr float net_stretch = 1.8F;

struct VeilPlan {
    std::array<std::uint32_t, 4> seed{};
    float texel = 0.0F;   ///< in lengths of the strip
    float across = 0.1F;  ///< width of the strip over its length
    Light colour, tip;
    float roughness = 0.85F;
};

/// The face of a blade, root to edge; lengths in those of the blade.
struct BladePlan {
    std::array<std::uint32_t, 4> seed{};
    float texel_along = 0.0F, texel_across = 0.0F;
    Light colour, edge, depth;
    float mottle = 0.0F;
    float steep = 1.0F;  ///< depth of the slot between two blades over its width
    float pale = 0.0F;   ///< share of light that its walls give back to each other
    float grain = 0.0F;  ///< 0..1: whether the finest lines across it show
    float roughness = 0.8F;
};

/// Torn flesh; lengths in those of its strip.
struct FleshPlan {
    std::array<std::uint32_t, 4> seed{};
    float texel_along = 0.0F, texel_across = 0.0F;
    Light colour;
    std::array<float, 3> bumps{};
    float roughness = 0.85F;
};

/// Width of a tear as its chart stands for it, over its length.
inline constexpr double flesh_width = 0.4;
inline constexpr float blade_grain = 72.0F;  ///< lines across a blade
inline constexpr std::array<float, 3> flesh_bump_frequency = {11.0F, 26.0F, 58.0F};

/// A painted wart or scale on the cap's disc.
struct PatchPlan {
    float x = 0.0F, y = 0.0F;              ///< centre, in disc radii
    float along_x = 0.0F, along_y = 0.0F;  ///< unit vector away from the apex
    float per_length = 0.0F, per_width = 0.0F;
    float relief = 0.0F;  ///< height in arcs
    float lift = 1.0F;   ///< which end is the tip: 1 the outer, -1 the inner, between neither quite
    float shown = 0.0F;  ///< 0..1
    float reach = 0.0F;  ///< in disc radii, along the rows
    std::array<float, 6> side_x{}, side_y{};
    std::uint32_t seed = 0;
    int kind = 0;  ///< 0 wart, 1 scale
};

/// Beyond this distance, in half lengths and widths, a patch leaves no trace.
inline constexpr float patch_window = 1.45F;

struct PaintPlan {
    int side = 0;
    std::array<Frame, part_count> frames{};
    CapPlan cap;
    HymeniumPlan hymenium;
    StemPlan stem;
    VeilPlan veil;
    BladePlan blade;
    FleshPlan flesh;
    float fade = 0.0F;
    float wetness = 0.0F;
    int disc_step = 1;   ///< texels between the samples of a disc's fields: 1 or 2
    int strip_step = 1;  ///< along a strip: 1, 2, 4 or 8
    int coarse_cells = 64;
    std::array<CoarseField, 3> cap_fields;
    std::array<CoarseField, 2> hymenium_fields;
    std::vector<PatchPlan> patches;
    std::vector<std::vector<int>> patches_by_row;  ///< of the cap's chart
    std::array<GivenImage, 3> given;
    ScarsPlan scars;
};

struct PaintParams;

/// Where a piece of work paints: three RGB images of the whole atlas.
struct PaintTarget {
    std::uint8_t* base_color = nullptr;
    std::uint8_t* normal = nullptr;
    std::uint8_t* orm = nullptr;
};

/// Most paintings that dissolve into one: those of eight species, one of them twice.
inline constexpr std::size_t most_paintings = 9;

/// What is dissolved of a texel: colour in linear light, slopes of the normal, occlusion, roughness.
inline constexpr std::size_t dissolved_channels = 7;

/// How the paintings of one chart dissolve.
struct ChartDissolve {
    int columns = 0, rows = 0;  ///< cells of dissolve_cell() texels, at least one each way
    /// Mean of the dissolved over each cell and those round it: rows * columns * dissolved_channels.
    std::vector<float> means;
    std::array<float, dissolved_channels> surplus{};  ///< gain of the contrast, less one
};

struct DissolvePlan {
    int side = 0;
    std::array<Frame, part_count> frames{};
    std::size_t paintings = 0;
    std::array<std::array<const std::uint8_t*, 3>, most_paintings> images{};
    std::array<float, most_paintings> weights{};
    std::array<ChartDissolve, part_count> charts{};
    const float* linear = nullptr;    ///< light of each sRGB byte
    const PaintPlan* laid = nullptr;  ///< warts and scales on the dissolved cap; none of them: null
};

/// A plan that knows the cap's disc, the veil, the weather and the patches of several paintings, and nothing else. Patches with
/// equal places are one patch; each is as large as its paintings weigh, and of the veil that they have together.
[[nodiscard]] PaintPlan laid_plan(std::span<const PaintParams* const> paintings,
                                  std::span<const double> weights);

/// Side in texels of the cells whose mean is what detail stands out from. Twice eight, so that a vector of texels never
/// crosses the middle of one.
[[nodiscard]] constexpr int dissolve_cell(int side) { return side > 512 ? side / 32 : 16; }

/// Dissolves rows `from` to `to` (exclusive) of a part's chart, with the instruction set in force.
void dissolve_piece(const DissolvePlan& plan, int part, int from, int to,
                    const PaintTarget& target);

/// Slopes are steep at most this much: normals are bytes, and a slope is the quotient of two.
inline constexpr float flattest_normal = 1.0F / 16.0F;

}  // namespace sporeprint
