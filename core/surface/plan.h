// Precomputed values that the paint kernels read per texel. Private to core/surface.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/surface/charts.h"
#include "core/surface/damage.h"
#include "core/surface/veil_bands.h"

namespace sporeprint {

/// Slowly varying noise fields, sampled sparsely and interpolated between samples.
enum CapField {
    cap_uneven,
    cap_mottle,
    cap_middle,
    cap_bump,
    cap_streak,
    cap_fibre,
    cap_patch,
    cap_vein,
    cap_zone
};
enum HymeniumField { hymenium_uneven, hymenium_middle, hymenium_bump };
enum StemField { stem_broad, stem_middle, stem_bump, stem_fibre, stem_furrow };
enum VeilField { veil_thread, veil_cloud };
enum BladeField { blade_cloud, blade_uneven };
enum FleshField { flesh_fibre, flesh_cloud };
enum GroundField { ground_cloud, ground_age };
inline constexpr int most_fields = 9;

/// A colour in linear light.
struct Light {
    float r = 0.0F, g = 0.0F, b = 0.0F;
};

/// Rectangle of a chart in texels, and its inset as a share of the rectangle.
struct Frame {
    int x = 0, y = 0, width = 0, height = 0;
    float inset = 0.0F;
};

/// The surface of revolution that a disc chart represents: a young cap is a spherical cap extended
/// by a cylinder, a lower face is a cone.
struct DiscPlan {
    float per_texel = 0.0F;  ///< disc radii per texel
    float bend = 0.0F;       ///< angle of the spherical cap; 0 for a cone
    float sphere = 0.0F;     ///< radius of the sphere in arcs
    float inner = 0.0F;      ///< disc radius where the part begins
    float cone_from = 0.0F;  ///< radius at the inner edge, in disc radii
    float cone_grow = 0.0F;  ///< increase of the radius up to the rim
};

/// Smooth noise sampled on a grid over a chart, interpolated over its texels.
struct CoarseField {
    std::vector<float> values;  ///< (cells + 1)^2
};

/// An uploaded image in linear light, prefiltered to about the chart's resolution; empty when the
/// part is painted.
struct UploadedImage {
    int width = 0, height = 0;
    std::vector<float> light;          ///< rgb
    float turn = 0.0F;                 ///< rotation, 0..1 turns
    float cosine = 1.0F, sine = 0.0F;  ///< of that rotation
    [[nodiscard]] bool empty() const { return light.empty(); }
};

inline constexpr int most_ramp_steps = 5;

/// 1.055 x^(1/2.4) - 0.055 as a polynomial of the square root of x, highest power first, for x in
/// 0.0031308..1; interpolated at Chebyshev nodes.
inline constexpr std::array<float, 7> srgb_curve = {
    -0.58427069F, 2.24849906F, -3.55274765F, 3.03261645F, -1.64561153F, 1.54233637F, -0.04086402F};

/// Relief of a cap: depths determine the shade of hollows, slopes what painting adds to the mesh;
/// both in arcs.
struct ReliefPlan {
    std::array<std::uint32_t, 3> seed{};
    float folds = 0.0F, fold_slope = 0.0F;
    float crests = 0.0F;
    float fold_size = 1.0F;  ///< cells of noise per radius of the young hemisphere
    float pits = 0.0F, pit_slope = 0.0F;
    float pit_columns = 3.0F, pit_rows = 2.0F;
    float rib = 0.0F;  ///< half width, in cells
    float tiers = 0.0F, tier_slope = 0.0F;
    float tier_count = 1.0F;
    Light hollow;
    float tint = 0.0F;
    [[nodiscard]] bool any() const { return folds > 0.0F || pits > 0.0F || tiers > 0.0F; }
};

/// Texture of a skin in three octaves of noise at fixed lengths, of which the finest is 1.5 to 3
/// texels. An octave is seeded by its length, so that images of all sizes show the same skin.
struct SkinPlan {
    std::array<std::uint32_t, 3> seed{};
    std::uint32_t fibre_seed = 0;  ///< of fibres on a disc, whose levels have their own lattices
    bool shows = false;
    bool fibres = false;  ///< elongated along the part, instead of isotropic
    float elongation = 1.0F;
    /// Cells per disc radius, or round the stem; finest octave first.
    std::array<float, 3> cells{};
    std::array<float, 3> cells_along{};  ///< per circumference of the stem
    std::array<float, 3> weight{};       ///< 0 where an octave is finer than texels
    std::array<float, 3> rise{};         ///< weight in the height, in the lengths of the chart
    float tone = 0.0F, hue = 0.0F, gloss = 0.0F;
    float skew = 0.0F;  ///< 1: pale points stand out, -1: dark hollows
    float tone_variance = 0.0F;
    float film = 0.0F;   ///< unevenness of a viscid film at larger scale
    float bloom = 0.0F;  ///< pale powder
};

/// One wave of the lateral displacement of blades.
struct WavePlan {
    float count = 1.0F, lean = 0.0F, size = 0.0F, phase = 0.0F;
};

/// Layout of blades round the axis.
struct GillLayoutPlan {
    int blades = 60;  ///< number of blades that reach the stem
    // On the gill layout of a set with more blades there are `slots` slots for `stands` blades, and
    // every `stride`-th blade reaches the stem. 0 slots: the blades are evenly spaced.
    float slots = 0.0F, occupied = 0.0F, stride = 1.0F;
    std::array<WavePlan, 6> wander{};
    float bend = 0.0F;  ///< amplitude of the displacement, in turns
};

struct CapPlan {
    ReliefPlan relief;
    DiscPlan disc;
    std::array<std::uint32_t, 12> seed{};
    Light first;
    std::array<Light, most_ramp_steps> step{};
    int steps = 0;
    float lightness = 1.0F;
    /// 1 where the cap passes into the stem without an edge, as on clubs and corals: towards the rim
    /// it takes the tint of the stem and loses what ends at the border of its chart.
    float joined = 0.0F;
    Light joined_tint = {1.0F, 1.0F, 1.0F};
    Light joined_colour;  ///< of the top of the stem
    float joined_roughness = 0.75F;
    float ramp_noise = 0.0F;
    float fibrils = 0.0F;
    int fibril_count = 8;
    float zones = 0.0F;
    float zone_count = 1.0F;
    std::array<std::uint32_t, 3> zone_seed{};
    float patches = 0.0F;
    float patch_frequency = 1.0F;  ///< per arc
    float patch_threshold = 0.0F;
    float patch_weight = 0.0F;
    float patch_slope = 5.5F;   ///< 1 / width of a border, in the noise
    float patch_grain = 0.05F;  ///< how much the skin's grain frays the border
    Light patch_colour;
    float streaks = 0.0F;
    float veins = 0.0F;
    float vein_rows = 8.0F;  ///< cells of the net from pole to rim
    float striae = 0.0F;
    GillLayoutPlan layout;      ///< of the gills below, which the striae follow
    float striae_scale = 1.0F;  ///< lines per gill
    float striae_relief = 0.0F, striae_shade = 0.0F;
    SkinPlan skin;
    Light tint = {1.0F, 1.0F, 1.0F};       ///< the individual's own hue
    Light drift;                           ///< change of the hue across the disc, per radius
    float drift_x = 0.0F, drift_y = 0.0F;  ///< direction of that change, unit
    float ramp_drift = 0.0F;               ///< shift of the ramp in that direction
    std::array<float, 3> bumps{};          ///< by octave, already limited to the texel resolution
    float roughness = 0.6F;
    unsigned fields = 0;  ///< bit of each CapField that is used
};

struct HymeniumPlan {
    DiscPlan disc;
    std::array<std::uint32_t, 8> seed{};
    int pattern = 0;
    Light colour, edge, depth;
    Light stem;           ///< colour of the stem's top
    float joined = 0.0F;  ///< 1: the face takes on that colour where it meets the stem
    float mottle = 0.0F;
    float roughness = 0.8F;
    float relief = 0.0F;
    float slot_occlusion = 1.0F;  ///< at the bottom of a slot, with `relief`
    GillLayoutPlan layout;
    int tiers = 0;
    float last_tier = 1.0F;  ///< share of the last tier's blades that is present
    float blade = 0.0F;      ///< half thickness, in disc radii
    float forking = 0.0F;
    int vein_rows = 0;         ///< rows of cross veins between ridges
    float veins_there = 0.0F;  ///< see core/individual/gill_layout.h
    float inner_gap = 0.0F;    ///< share of the face without blades round the stem
    float bare_slope = 1.0F;   ///< 1 / width over which the bare ring round the stem ends
    float spine = 0.13F;       ///< half thickness of a spine, in cells
    float pore_tall = 1.0F;    ///< length of a cell over its width
    float pore_rows = 1.0F;    ///< from the inner edge to the rim
    float pore_from = 6.0F;    ///< pores round the inner edge
    float pore_grow = 0.0F;    ///< additional pores per row
    float pore_shown = 0.0F;   ///< 0 when pores are smaller than texels
    float felt = 0.0F;         ///< matted hairs, 0..1
    float cracks = 0.0F;       ///< as of dry mud, 0..1
    float crack_rows = 1.0F;   ///< plates between cracks from the inner edge to the rim
    float crack_from = 6.0F;   ///< plates round the inner edge
    float crack_grow = 0.0F;   ///< additional plates per row
    std::array<float, 2> bumps{};
    unsigned fields = 0;
};

struct StemPlan {
    std::array<std::uint32_t, 12> seed{};
    float aspect = 2.0F;       ///< length over circumference
    float ragged = 0.1F;       ///< displacement of the border of the stain, in lengths
    float texel_along = 0.0F;  ///< in circumferences
    float texel_round = 0.0F;
    /// Frequency factor of fine noise along a thin stem, whose texels are long.
    float stretch = 1.0F;
    Light top, base, stain, band_colour, net_colour, soil_colour;
    Light film;  ///< factor on the colour of skin under a thin film of soil
    float base_stain = 0.0F;
    float soil = 0.0F;
    float mycelium = 0.0F;
    float foot = 0.0F;        ///< share of the stem below the ground
    float soil_reach = 1.0F;  ///< share of the stem that soil reaches above the ground
    std::array<float, 2> grains = {44.0F, 127.0F};  ///< of soil round the stem: coarse and fine
    std::array<float, 2> grains_shown{};            ///< 0 where they are smaller than texels
    float fibrils = 0.0F;
    float bands = 0.0F;
    float net = 0.0F;
    std::array<float, 3> bumps{};
    std::array<float, 3> fibres{};  ///< by octave, already limited to the texel resolution
    float net_shown = 1.0F;
    // Decurrent gills and ridges, which continue down the stem from its top.
    GillLayoutPlan layout;
    float gills = 0.0F;           ///< share of the stem's length that they cover; 0: none
    float gill_half = 0.0F;       ///< half their thickness, in gaps
    float gill_relief = 0.0F;     ///< height in circumferences
    float gill_occlusion = 1.0F;  ///< between two gills
    float gill_shown = 0.0F;      ///< 0 when gaps are smaller than texels
    Light gill_colour, gill_edge, gill_depth;
    float roughness = 0.75F;
    SkinPlan skin;
    Light tint = {1.0F, 1.0F, 1.0F};  ///< the individual's own hue
    float joined = 0.0F;              ///< 1 where it passes into the upper face without an edge
    unsigned fields = 0;
};

inline constexpr std::array<int, 3> stem_bump_cells = {26, 83, 190};
/// Distances of grains of soil on a stem, metres, and the most of them round it.
inline constexpr std::array<double, 2> grain_distance = {0.0013, 0.0005};
inline constexpr double most_grains = 420.0;
inline constexpr std::array<int, 3> stem_fibre_cells = {17, 46, 109};
inline constexpr std::array<float, 3> stem_fibre_slender = {0.22F, 0.15F, 0.12F};
inline constexpr std::array<float, 3> cap_bump_frequency = {21.0F, 52.0F, 118.0F};
inline constexpr std::array<float, 2> hymenium_bump_frequency = {30.0F, 62.0F};
/// Strands and hairs of felt round a lower face.
inline constexpr std::array<int, 2> felt_hairs = {230, 640};
/// Length of a plate between cracks over its width.
inline constexpr float crack_tall = 0.52F;
/// Plates between cracks from the inner edge of a lower face to its rim.
inline constexpr double crack_plates = 8.0;
inline constexpr float net_columns = 46.0F;
inline constexpr float net_stretch = 2.3F;

/// Lumps, chambers and pits of a sponge along the strip of the veil, and how much smaller they are
/// across it than the strip's own proportions say.
inline constexpr int lump_columns = 14, chamber_columns = 44, pit_columns = 110;
inline constexpr float pit_rows = 1.0F;

struct VeilPlan {
    std::array<std::uint32_t, 4> seed{};
    float texel = 0.0F;   ///< in lengths of the strip
    float across = 0.1F;  ///< width of the strip over its length
    Light colour, tip;
    Light inner;  ///< colour of the side that was torn off the flesh
    float roughness = 0.85F;
    float pits = 0.0F;  ///< depth of the pits of a sponge, 0..1
};

/// The face of a blade, base to edge; lengths are relative to that of the blade.
struct BladePlan {
    std::array<std::uint32_t, 4> seed{};
    float texel_along = 0.0F, texel_across = 0.0F;
    Light colour, edge, depth;
    float mottle = 0.0F;
    float steep = 1.0F;  ///< depth of the slot between two blades over its width
    float pale = 0.0F;   ///< share of light that its walls reflect to each other
    float grain = 0.0F;  ///< 0..1: visibility of the finest lines across it
    float roughness = 0.8F;
};

/// Torn flesh; lengths are relative to that of its strip.
struct FleshPlan {
    std::array<std::uint32_t, 4> seed{};
    float texel_along = 0.0F, texel_across = 0.0F;
    Light colour;
    std::array<float, 3> bumps{};
    float roughness = 0.85F;
};

/// Soil, litter and strands; lengths are relative to that of its strip.
struct GroundPlan {
    std::array<std::uint32_t, 4> seed{};
    float texel_along = 0.0F, texel_across = 0.0F;
    std::array<float, 3> shown{};  ///< of fibres and grains, 0 where they are smaller than texels
    Light soil, litter, aged, strands;
};

/// Width of a tear over its length, as its chart assumes.
inline constexpr double flesh_width = 0.4;
/// Fibres of litter, grains of soil and fine grains round a strip.
inline constexpr std::array<int, 3> ground_cells = {40, 84, 190};
inline constexpr float blade_grain = 72.0F;  ///< lines across a blade
inline constexpr std::array<float, 3> flesh_bump_frequency = {11.0F, 26.0F, 58.0F};

/// A painted wart or scale on the cap's disc, or the footprint of a spine.
struct PatchPlan {
    float x = 0.0F, y = 0.0F;              ///< centre, in disc radii
    float along_x = 0.0F, along_y = 0.0F;  ///< unit vector away from the apex
    float per_length = 0.0F, per_width = 0.0F;
    float relief = 0.0F;  ///< height in arcs
    float lift = 1.0F;    ///< position of the tip: 1 the outer end, -1 the inner, between: flat
    float shown = 0.0F;   ///< opacity, 0..1
    float fray =
        0.0F;  ///< of a wart: how ragged its rim is; of a scale: 0 a flap, 1 a tuft of hairs
    float hairs = 0.0F;  ///< how far its single hairs are as large as texels, 0..1
    float reach = 0.0F;  ///< extent along the rows, in disc radii
    std::array<float, 6> side_x{}, side_y{};
    std::uint32_t seed = 0;
    float fallen = 0.0F;  ///< of a footprint: how far its spine has fallen, 0..1
    int kind = 0;         ///< 0 wart, 1 scale, 2 footprint
};

/// Distance, in half lengths and widths, beyond which a patch changes nothing.
inline constexpr float patch_window = 1.45F;
/// Grains round the footprint of a spine.
inline constexpr double footprint_grains = 13.0;
/// Hairs side by side in a tuft, about.
inline constexpr double tuft_hairs = 5.0;

struct PaintPlan {
    int side = 0;
    std::array<Frame, part_count> frames{};
    CapPlan cap;
    HymeniumPlan hymenium;
    StemPlan stem;
    VeilPlan veil;
    BladePlan blade;
    FleshPlan flesh;
    GroundPlan ground;
    float fade = 0.0F;
    float wetness = 0.0F;
    int disc_step = 1;   ///< texels between the samples of a disc's fields: 1 or 2
    int strip_step = 1;  ///< the same along a strip: 1, 2, 4 or 8
    int coarse_cells = 64;
    std::array<CoarseField, 3> cap_fields;
    std::array<CoarseField, 2> hymenium_fields;
    std::vector<PatchPlan> patches;
    std::vector<std::vector<int>> patches_by_row;  ///< of the cap's chart
    std::array<UploadedImage, 3> uploads;
    DamagePlan damage;
};

struct PaintParams;

/// Output of a task: three RGB images of the whole atlas.
struct PaintTarget {
    std::uint8_t* base_color = nullptr;
    std::uint8_t* normal = nullptr;
    std::uint8_t* orm = nullptr;
};

/// Largest number of blended paintings: those of eight species, one of them twice.
inline constexpr std::size_t most_paintings = 9;

/// Number of blended channels per texel: colour in linear light, slopes of the normal, occlusion,
/// roughness.
inline constexpr std::size_t blended_channels = 7;

/// Blend parameters of one chart.
struct ChartBlend {
    int columns = 0, rows = 0;  ///< cells of blend_cell() texels, at least one each way
    /// Mean over each cell and its neighbours: rows * columns * blended_channels.
    std::vector<float> means;
    std::array<float, blended_channels> surplus{};  ///< contrast gain minus one
};

struct BlendPlan {
    int side = 0;
    std::array<Frame, part_count> frames{};
    std::size_t paintings = 0;
    std::array<std::array<const std::uint8_t*, 3>, most_paintings> images{};
    std::array<float, most_paintings> weights{};
    std::array<ChartBlend, part_count> charts{};
    const float* linear = nullptr;       ///< light of each sRGB byte
    const PaintPlan* patches = nullptr;  ///< warts and scales on the blended cap; or null
};

/// Returns a plan with the cap's disc, the veil, the weathering and the patches of several
/// paintings, and nothing else. Patches with equal places are merged; each is scaled by the weights
/// of its paintings, and has the mean amount of veil.
[[nodiscard]] PaintPlan patch_blend_plan(std::span<const PaintParams* const> paintings,
                                         std::span<const double> weights);

/// Returns the side in texels of the cells over which local means are taken. It is a multiple of
/// 16, so that a vector of texels never crosses the centre of a cell.
[[nodiscard]] constexpr int blend_cell(int side) { return side > 512 ? side / 32 : 16; }

/// Blends rows `from` to `to` (exclusive) of a part's chart, with the best available instruction
/// set.
void blend_piece(const BlendPlan& plan, Part part, int from, int to, const PaintTarget& target);

/// Least z component of a normal. It bounds slopes, because normals are stored as bytes and a slope
/// is a quotient of two.
inline constexpr float flattest_normal = 1.0F / 16.0F;

}  // namespace sporeprint
