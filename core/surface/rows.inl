// Paints rows of a chart into the three images: first texels, then normals from their heights, then
// bytes.
#if defined(SPOREPRINT_CORE_SURFACE_ROWS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SPOREPRINT_CORE_SURFACE_ROWS_INL
#undef SPOREPRINT_CORE_SURFACE_ROWS_INL
#else
#define SPOREPRINT_CORE_SURFACE_ROWS_INL
#endif

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>

#include "core/surface/cap.inl"
#include "core/surface/damage.inl"
#include "core/surface/ground.inl"
#include "core/surface/hymenium.inl"
#include "core/surface/stem.inl"
#include "core/surface/tissue.inl"

HWY_BEFORE_NAMESPACE();
namespace sporeprint {
namespace HWY_NAMESPACE {

inline constexpr int margin = 8;  // padding of each row of heights, for neighbours of its ends

/// One row of painted texels.
struct Row {
    HWY_ALIGN float height[padded];
    HWY_ALIGN float red[padded], green[padded], blue[padded];
    HWY_ALIGN float roughness[padded], occlusion[padded], uneven[padded];
    HWY_ALIGN float cosine[padded], sine[padded], widening[padded];
};

/// One row of sparse samples of slowly varying fields.
struct SparseRow {
    int y = -1000;
    HWY_ALIGN float field[most_fields][widest / 2 + 32];
};

/// Buffers of a worker: three rows of texels, the sparse rows above and below, and one row of bytes
/// per channel.
struct RowBuffers {
    Row rows[3];
    SparseRow sparse[2];
    HWY_ALIGN float field[most_fields][padded];
    HWY_ALIGN float spare[padded];
    HWY_ALIGN DamageRow damage;
    HWY_ALIGN std::uint8_t bytes[9][padded];
};

HWY_INLINE void store_texel(const Texel& texel, Row& row, std::size_t x) {
    const Floats f;
    hn::Store(texel.height, f, row.height + margin + x);
    hn::Store(texel.colour.r, f, row.red + x);
    hn::Store(texel.colour.g, f, row.green + x);
    hn::Store(texel.colour.b, f, row.blue + x);
    hn::Store(texel.roughness, f, row.roughness + x);
    hn::Store(texel.occlusion, f, row.occlusion + x);
}

HWY_INLINE Texel load_texel(const Row& row, std::size_t x) {
    const Floats f;
    Texel texel;
    texel.height = hn::Load(f, row.height + margin + x);
    texel.colour = {hn::Load(f, row.red + x), hn::Load(f, row.green + x),
                    hn::Load(f, row.blue + x)};
    texel.roughness = hn::Load(f, row.roughness + x);
    texel.occlusion = hn::Load(f, row.occlusion + x);
    return texel;
}

/// Returns the lane numbers 0, 1, 2, ...
HWY_INLINE VF lane_numbers() {
    HWY_ALIGN constexpr float numbers[8] = {0, 1, 2, 3, 4, 5, 6, 7};
    return hn::Load(Floats(), numbers);
}

// Interpolates one row of a coarse field at every `step`-th texel, the first at texel 0,
// bilinearly.
void expand(const CoarseField& field, int cells, const Frame& frame, int y, int step, int count,
            float* out) {
    const float per_texel = static_cast<float>(cells) / static_cast<float>(frame.width);
    const float at = (static_cast<float>(y) + 0.5F) * per_texel;
    const int j = at < 0.0F ? 0 : static_cast<int>(at) >= cells ? cells - 1 : static_cast<int>(at);
    const float weight = at - static_cast<float>(j);
    const float* upper =
        field.values.data() + static_cast<std::size_t>(j) * static_cast<std::size_t>(cells + 1);
    const float* lower = upper + cells + 1;
    for (int k = 0; k < count; ++k) {
        const float across = (static_cast<float>(k * step) + 0.5F) * per_texel;
        const int i = static_cast<int>(across) >= cells ? cells - 1 : static_cast<int>(across);
        const float left = upper[i] + (lower[i] - upper[i]) * weight;
        const float right = upper[i + 1] + (lower[i + 1] - upper[i + 1]) * weight;
        out[k] = left + (right - left) * (across - static_cast<float>(i));
    }
}

// Doubles the number of samples: each is followed by its mean with the next. `from` holds one more
// sample than is doubled.
HWY_INLINE void doubled(const float* from, std::size_t count, float* to) {
    const Floats f;
    for (std::size_t i = 0; i < count; i += hn::Lanes(f)) {
        const VF here = hn::LoadU(f, from + i);
        const VF next = hn::LoadU(f, from + i + 1);
        hn::StoreInterleaved2(here, (here + next) * set(0.5F), f, to + 2 * i);
    }
}

// Returns the colour of an uploaded image, bilinearly interpolated; (u, v) are 0..1 in the image.
HWY_INLINE Rgb sampled(const UploadedImage& image, VF u, VF v) {
    HWY_ALIGN float us[8], vs[8], rs[8], gs[8], bs[8];
    const Floats f;
    hn::Store(unit(u), f, us);
    hn::Store(unit(v), f, vs);
    for (std::size_t lane = 0; lane < hn::Lanes(f); ++lane) {
        const float x = us[lane] * static_cast<float>(image.width) - 0.5F;
        const float y = vs[lane] * static_cast<float>(image.height) - 0.5F;
        const float cx = x < 0.0F ? 0.0F : x;
        const float cy = y < 0.0F ? 0.0F : y;
        int x0 = static_cast<int>(cx);
        int y0 = static_cast<int>(cy);
        if (x0 > image.width - 1) x0 = image.width - 1;
        if (y0 > image.height - 1) y0 = image.height - 1;
        const int x1 = x0 + 1 < image.width ? x0 + 1 : x0;
        const int y1 = y0 + 1 < image.height ? y0 + 1 : y0;
        const float wx = cx - static_cast<float>(x0);
        const float wy = cy - static_cast<float>(y0);
        const auto at = [&](int column, int row) {
            return image.light.data() +
                   3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) +
                        static_cast<std::size_t>(column));
        };
        const float* p00 = at(x0, y0);
        const float* p10 = at(x1, y0);
        const float* p01 = at(x0, y1);
        const float* p11 = at(x1, y1);
        float* const outs[3] = {rs, gs, bs};
        for (int c = 0; c < 3; ++c) {
            const float above = p00[c] + (p10[c] - p00[c]) * wx;
            const float below = p01[c] + (p11[c] - p01[c]) * wx;
            outs[c][lane] = above + (below - above) * wy;
        }
    }
    return {hn::Load(f, rs), hn::Load(f, gs), hn::Load(f, bs)};
}

/// Applies bleaching and wetness to a painted colour.
HWY_INLINE void weather(const PaintPlan& plan, float exposure, VF uneven, Rgb& colour,
                        VF& roughness) {
    const VF one = set(1.0F);
    if (plan.fade > 0.0F) {
        // The strongest channel increases a little and the others follow it: red turns orange, then
        // straw.
        const VF w = unit(set(plan.fade * exposure) * (one + uneven * set(0.5F)));
        const VF most = hn::Max(hn::Max(colour.r, colour.g), colour.b);
        const VF bright = most + (set(0.82F) - most) * w * set(0.35F);
        Rgb pale;
        pale.r = mix(colour.r, bright, set(0.95F));
        pale.g = mix(colour.g, bright, set(0.50F));
        pale.b = mix(colour.b, bright, set(0.11F));
        // Parts exposed to the sky continue to the species' own faded colour, with a little of the
        // pattern left.
        const VF bleached = w * w * set(exposure * exposure * 0.75F);
        const VF light = set(0.72F) + set(0.42F) * hn::Sqrt(most);
        pale = mix(pale, shaded(rgb(plan.damage.faded), light), bleached);
        colour = mix(colour, pale, w * set(0.85F));
        roughness = roughness + w * set(0.10F);
    }
    if (plan.wetness > 0.0F) {
        const VF w = set(plan.wetness) * unit(set(0.85F) + uneven * set(0.4F));
        const VF dark = w * set(0.42F);
        colour.r = colour.r * (one - dark * (one - colour.r));
        colour.g = colour.g * (one - dark * (one - colour.g));
        colour.b = colour.b * (one - dark * (one - colour.b));
        roughness = mix(roughness, set(0.10F), w * set(0.85F));
    }
}

/// Applies weathering to a colour and a roughness, without spatial variation.
void weathered_light(const PaintPlan& plan, Light& light, float& roughness) {
    Rgb colour = rgb(light);
    VF rough = set(roughness);
    weather(plan, 1.0F, set(0.0F), colour, rough);
    HWY_ALIGN float lanes[4][8];
    const Floats f;
    hn::Store(colour.r, f, lanes[0]);
    hn::Store(colour.g, f, lanes[1]);
    hn::Store(colour.b, f, lanes[2]);
    hn::Store(rough, f, lanes[3]);
    light = {lanes[0][0], lanes[1][0], lanes[2][0]};
    roughness = lanes[3][0];
}

/// Returns the position of texels x, x + 1, ... on a disc, in its radii from the pole.
HWY_INLINE VF disc_place(const Frame& frame, VF texel) {
    return ((texel + set(0.5F)) * set(1.0F / static_cast<float>(frame.width)) - set(0.5F)) *
           set(1.0F / (0.5F - frame.inset));
}

/// Texels `from` to `until` of a row are painted, those outside repeat the nearest. Both are
/// multiples of eight, or the whole row.
struct TexelRange {
    std::size_t from, until;
};

// Texels far beyond the rim of a disc are not sampled, except by the smallest mipmaps.
TexelRange painted_range(const PaintPlan& plan, Part part, int y) {
    const Frame& frame = plan.frames[index_of(part)];
    const std::size_t width = static_cast<std::size_t>(frame.width);
    if (!is_disc(part) || width < 64) return {0, width};
    const float radius = (0.5F - frame.inset) * static_cast<float>(frame.width) * 1.03F + 3.0F;
    const float dy = static_cast<float>(y) + 0.5F - 0.5F * static_cast<float>(frame.height);
    const float square = radius * radius - dy * dy;
    HWY_ALIGN float half[8] = {};
    hn::Store(hn::Sqrt(set(square > 0.0F ? square : 0.0F)), Floats(), half);
    const float from = 0.5F * static_cast<float>(frame.width) - half[0] - 8.0F;
    const std::size_t first = from < 0.0F ? 0 : static_cast<std::size_t>(from) / 8 * 8;
    return {first, width - first};
}

HWY_INLINE void clear(DamageRow& row, std::size_t width) {
    for (float* const plane : row.plane) std::memset(plane, 0, width * sizeof(float));
    std::memset(row.ragged, 0, width * sizeof(float));
}

HWY_INLINE void clear(VF* fields) {
    for (std::size_t k = 0; k < most_fields; ++k) fields[k] = set(0.0F);
}

// A kernel says how one part is painted: its plan, which fields it uses, and its texels. Kernels of
// discs also name the fields that come from coarse grids.
struct CapKernel {
    static constexpr Part part = Part::cap;
    static const CapPlan& plan(const PaintPlan& all) { return all.cap; }
    static std::span<const CoarseField> grids(const PaintPlan& all) { return all.cap_fields; }
    static HWY_INLINE void fields(const PaintPlan& all, const DiscPoint& p, VF* fields) {
        cap_fields(all.cap, p, fields);
    }
    static HWY_INLINE Texel texel(const PaintPlan& all, const DiscPoint& p, const VF* fields) {
        return cap_texel(all.cap, p, fields);
    }
};
struct HymeniumKernel {
    static constexpr Part part = Part::hymenium;
    static const HymeniumPlan& plan(const PaintPlan& all) { return all.hymenium; }
    static std::span<const CoarseField> grids(const PaintPlan& all) { return all.hymenium_fields; }
    static HWY_INLINE void fields(const PaintPlan& all, const DiscPoint& p, VF* fields) {
        hymenium_fields(all.hymenium, p, fields);
    }
    static HWY_INLINE Texel texel(const PaintPlan& all, const DiscPoint& p, const VF* fields) {
        return hymenium_texel(all.hymenium, p, fields);
    }
};

// Kernels of strips also say at which distance, in texels, their fields are sampled, and whether v
// runs once round the part.
struct StemKernel {
    static constexpr Part part = Part::stem;
    static constexpr bool is_round = true;
    static unsigned used(const PaintPlan& all) { return all.stem.fields; }
    static int step(const PaintPlan& all) { return all.strip_step; }
    static HWY_INLINE void fields(const PaintPlan& all, VF along, VF across, VF* fields) {
        stem_fields(all.stem, unit(along), across, fields);
    }
    static HWY_INLINE Texel texel(const PaintPlan& all, VF along, VF across, const VF* fields) {
        return stem_texel(all.stem, unit(along), across, fields);
    }
};
struct FlatStrip {
    static constexpr bool is_round = false;
    static unsigned used(const PaintPlan&) { return 3U; }  // both fields
    static int step(const PaintPlan& all) { return all.strip_step > 1 ? 2 : 1; }
};
struct VeilKernel : FlatStrip {
    static constexpr Part part = Part::veil;
    static HWY_INLINE void fields(const PaintPlan& all, VF along, VF across, VF* fields) {
        veil_fields(all.veil, along, across, fields);
    }
    static HWY_INLINE Texel texel(const PaintPlan& all, VF along, VF across, const VF* fields) {
        return veil_texel(all.veil, along, across, fields);
    }
};
struct BladeKernel : FlatStrip {
    static constexpr Part part = Part::blade;
    static HWY_INLINE void fields(const PaintPlan& all, VF along, VF across, VF* fields) {
        blade_fields(all.blade, along, across, fields);
    }
    static HWY_INLINE Texel texel(const PaintPlan& all, VF along, VF across, const VF* fields) {
        return blade_texel(all.blade, along, across, fields);
    }
};
struct FleshKernel : FlatStrip {
    static constexpr Part part = Part::flesh;
    static HWY_INLINE void fields(const PaintPlan& all, VF along, VF across, VF* fields) {
        flesh_fields(all.flesh, along, across, fields);
    }
    static HWY_INLINE Texel texel(const PaintPlan& all, VF along, VF across, const VF* fields) {
        return flesh_texel(all.flesh, along, across, fields);
    }
};
struct GroundKernel : FlatStrip {
    static constexpr Part part = Part::ground;
    static HWY_INLINE void fields(const PaintPlan& all, VF along, VF across, VF* fields) {
        ground_fields(all.ground, along, across, fields);
    }
    static HWY_INLINE Texel texel(const PaintPlan& all, VF along, VF across, const VF* fields) {
        return ground_texel(all.ground, along, across, fields);
    }
};

// Samples the fields of a disc along one row, at every disc_step-th texel.
template <class Kernel>
const SparseRow& sparse_row(const PaintPlan& plan, int y, RowBuffers& buffers) {
    SparseRow& row = buffers.sparse[y & 1];
    if (row.y == y) return row;
    row.y = y;
    const Floats f;
    const Frame& frame = plan.frames[index_of(Kernel::part)];
    const int step = plan.disc_step;
    const int count = frame.width / step + 1;
    const unsigned used = Kernel::plan(plan).fields;
    const std::span<const CoarseField> coarse = Kernel::grids(plan);
    const std::size_t grids = coarse.size();
    for (std::size_t i = 0; i < grids; ++i)
        expand(coarse[i], plan.coarse_cells, frame, y * step, step, count, row.field[i]);
    if (used >> grids == 0) return row;
    const DiscPlan& disc = Kernel::plan(plan).disc;
    const VF down = disc_place(frame, set(static_cast<float>(y * step)));
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); i += hn::Lanes(f)) {
        VF fields[most_fields];
        clear(fields);
        for (std::size_t k = 0; k < grids; ++k) fields[k] = hn::Load(f, row.field[k] + i);
        const VF texel =
            (lane_numbers() + set(static_cast<float>(i))) * set(static_cast<float>(step));
        Kernel::fields(plan, disc_point_of(disc, disc_place(frame, texel), down), fields);
        for (std::size_t k = grids; k < most_fields; ++k)
            if ((used >> k & 1U) != 0) hn::Store(fields[k], f, row.field[k] + i);
    }
    return row;
}

// Interpolates the fields of a disc at every texel of a row, into buffers.field.
template <class Kernel>
void disc_fields(const PaintPlan& plan, int y, RowBuffers& buffers) {
    const Floats f;
    const std::size_t width = static_cast<std::size_t>(plan.frames[index_of(Kernel::part)].width);
    const unsigned used = Kernel::plan(plan).fields;
    const int half = (y + 2) / 2 - 1;  // floor, for y >= -2
    const bool between = plan.disc_step == 2 && y != 2 * half;
    const SparseRow& above = sparse_row<Kernel>(plan, plan.disc_step == 2 ? half : y, buffers);
    const SparseRow& below = between ? sparse_row<Kernel>(plan, half + 1, buffers) : above;
    for (std::size_t k = 0; k < most_fields; ++k) {
        if ((used >> k & 1U) == 0) continue;
        const float* from = above.field[k];
        if (between) {
            for (std::size_t i = 0; i < width / 2 + 1; i += hn::Lanes(f))
                hn::Store(
                    (hn::Load(f, above.field[k] + i) + hn::Load(f, below.field[k] + i)) * set(0.5F),
                    f, buffers.spare + i);
            from = buffers.spare;
        }
        if (plan.disc_step == 2) {
            doubled(from, width / 2, buffers.field[k]);
        } else {
            for (std::size_t i = 0; i < width; i += hn::Lanes(f))
                hn::Store(hn::Load(f, from + i), f, buffers.field[k] + i);
        }
    }
}

// Computes the fields of a strip at every texel of a row, into buffers.field: sampled at every
// step-th texel of the kernel, then doubled.
template <class Kernel>
void strip_fields(const PaintPlan& plan, VF across, RowBuffers& buffers) {
    const Floats f;
    const Frame& frame = plan.frames[index_of(Kernel::part)];
    const int step = Kernel::step(plan);
    const unsigned used = Kernel::used(plan);
    const std::size_t count = static_cast<std::size_t>(frame.width / step) + 1;
    const float inner = 1.0F / (1.0F - 2.0F * frame.inset);
    for (std::size_t i = 0; i < count; i += hn::Lanes(f)) {
        VF fields[most_fields];
        clear(fields);
        const VF texel =
            (lane_numbers() + set(static_cast<float>(i))) * set(static_cast<float>(step)) +
            set(0.5F);
        const VF along =
            (texel * set(1.0F / static_cast<float>(frame.width)) - set(frame.inset)) * set(inner);
        Kernel::fields(plan, along, across, fields);
        for (std::size_t k = 0; k < most_fields; ++k)
            if ((used >> k & 1U) != 0) hn::Store(fields[k], f, buffers.field[k] + i);
    }
    for (int left = step; left > 1; left /= 2) {
        const std::size_t samples = static_cast<std::size_t>(frame.width / left);
        for (std::size_t k = 0; k < most_fields; ++k) {
            if ((used >> k & 1U) == 0) continue;
            doubled(buffers.field[k], samples, buffers.spare);
            // The sample after the last one stays the last of the doubled row.
            const float last = buffers.field[k][samples];
            for (std::size_t i = 0; i < 2 * samples; i += hn::Lanes(f))
                hn::Store(hn::Load(f, buffers.spare + i), f, buffers.field[k] + i);
            buffers.field[k][2 * samples] = last;
        }
    }
}

// Draws the warts and scales that cross one row.
void add_patches_to_row(const PaintPlan& plan, int y, VF down_places, float down, Row& row) {
    const Frame& frame = plan.frames[0];
    const float reach = (0.5F - frame.inset) * static_cast<float>(frame.width);
    for (const int index : plan.patches_by_row[static_cast<std::size_t>(y)]) {
        const PatchPlan& patch = plan.patches[static_cast<std::size_t>(index)];
        const float dy = down - patch.y;
        const Chord chord = chord_of(patch, dy, patch_window * patch_window);
        if (chord.half <= 0.0F) continue;
        const float middle =
            (patch.x + chord.middle) * reach + 0.5F * static_cast<float>(frame.width);
        const float half = chord.half * reach + 1.0F;
        const float begin = middle - half < 0.0F ? 0.0F : middle - half;
        const float end = middle + half > static_cast<float>(frame.width)
                              ? static_cast<float>(frame.width)
                              : middle + half;
        for (std::size_t x = static_cast<std::size_t>(begin) / 8 * 8; static_cast<float>(x) < end;
             x += hn::Lanes(Floats())) {
            Texel texel = load_texel(row, x);
            add_patch(patch, plan.veil,
                      disc_place(frame, lane_numbers() + set(static_cast<float>(x))), down_places,
                      texel);
            store_texel(texel, row, x);
        }
    }
}

// Returns the position of a row on its chart, relative to the chart.
float damage_row_place(const Frame& frame, Part part, int y) {
    const float v = (static_cast<float>(y) + 0.5F) / static_cast<float>(frame.height);
    return part == Part::stem ? (v - frame.inset) / (1.0F - 2.0F * frame.inset)
                              : (v - 0.5F) / (0.5F - frame.inset);
}

/// Coordinates of a chart along its rows, for drawing damage.
struct DamageChart {
    const Frame& frame;
    bool is_disc;
    float inner, aspect;  ///< strip: 1 / share inside its insets, and its length

    [[nodiscard]] HWY_INLINE VF across(std::size_t x) const {
        const VF texel = lane_numbers() + set(static_cast<float>(x));
        if (is_disc) return disc_place(frame, texel);
        const VF along =
            ((texel + set(0.5F)) * set(1.0F / static_cast<float>(frame.width)) - set(frame.inset)) *
            set(inner);
        return unit(along) * set(aspect);
    }
    [[nodiscard]] RowSpan whole() const {
        return is_disc ? RowSpan{-1e9F, 1e9F} : RowSpan{0.0F, aspect};
    }
    // Texels per length of the chart, and texels from the first to position 0.
    [[nodiscard]] float per_unit() const {
        return is_disc ? (0.5F - frame.inset) * static_cast<float>(frame.width)
                       : static_cast<float>(frame.width) / (inner * aspect);
    }
    [[nodiscard]] float first() const {
        return (is_disc ? 0.5F : frame.inset) * static_cast<float>(frame.width);
    }
};

DamageChart damage_chart(const PaintPlan& plan, Part part) {
    const Frame& frame = plan.frames[index_of(part)];
    const float inner = 1.0F / (1.0F - 2.0F * frame.inset);
    const float aspect = part == Part::stem
                             ? plan.stem.aspect
                             : 1.0F / plan.veil.texel / static_cast<float>(frame.width) * inner;
    return {frame, is_disc(part), inner, aspect};
}

// Draws a mark over texels `from` to `until` of a row. There is one loop per kind, because most
// marks cross few texels. The mark is passed by value, so that stores to texels cannot alias it and
// it stays in registers.
HWY_INLINE void add_spot(SpotPlan spot, VF down, const Row& row, const TexelRange& range,
                         DamageRow& planes) {
    const Floats f;
    NoisePair noise;
    const auto each = [&](auto add) {
        for (std::size_t x = range.from; x < range.until; x += hn::Lanes(f))
            add(hn::Load(f, planes.place + x), DamageTarget{planes, x});
    };
    switch (spot.kind) {
        case DamageKind::crack:
            each([&](VF across, const DamageTarget& at) { add_crack(spot, across, down, at); });
            return;
        case DamageKind::furrow:
            each([&](VF across, const DamageTarget& at) { add_furrow(spot, across, down, at); });
            return;
        case DamageKind::pit:
            each([&](VF across, const DamageTarget& at) { add_pit(spot, across, down, at); });
            return;
        case DamageKind::bruise:
            noise.begin();
            each([&](VF across, const DamageTarget& at) {
                add_bruise(spot, across, down, at, noise);
            });
            return;
        case DamageKind::drop:
            each([&](VF across, const DamageTarget& at) { add_drop(spot, across, down, at); });
            return;
        case DamageKind::lump:
            each([&](VF across, const DamageTarget& at) { add_lump(spot, across, down, at); });
            return;
        case DamageKind::bite:
        case DamageKind::split:
        case DamageKind::tongue:
            each([&](VF across, const DamageTarget& at) {
                add_margin(spot, hn::Load(f, row.cosine + at.x), hn::Load(f, row.sine + at.x),
                           set(1.0F) - hn::Sqrt(across * across + down * down), at);
            });
            return;
    }
}

// Collects the damage of one row in the planes; returns false when there is none.
bool collect_damage(const PaintPlan& plan, Part part, int y, const Row& row, DamageRow& planes) {
    const DamagePlan& damage = plan.damage;
    const std::size_t place = index_of(part);
    if (!has_damage(part) || damage.damage_spots[place].empty()) return false;
    const std::span<const std::uint32_t> crossing = damage.by_row[place].of(y);
    if (crossing.empty()) return false;
    const Floats f;
    const std::size_t lanes = hn::Lanes(f);
    const DamageChart chart = damage_chart(plan, part);
    const TexelRange painted = painted_range(plan, part, y);
    const float down_place = damage_row_place(chart.frame, part, y);
    const VF down = set(down_place);
    clear(planes, static_cast<std::size_t>(chart.frame.width));
    for (std::size_t x = painted.from; x < painted.until; x += lanes)
        hn::Store(chart.across(x), f, planes.place + x);
    const RowSpan whole = chart.whole();
    const float per_unit = chart.per_unit();
    const float first = chart.first();
    for (const std::uint32_t index : crossing) {
        const SpotPlan& spot = damage.damage_spots[place][index];
        const RowSpan span = damage_span(spot, down_place, whole);
        if (span.to <= span.from) continue;
        const float begin = first + span.from * per_unit - 1.0F;
        const float end = first + span.to * per_unit + 1.0F;
        // Multiples of eight texels, whatever the vector length, because the rim of a bruise may
        // reach slightly beyond.
        const std::size_t from = std::max(
            begin < 0.0F ? std::size_t{0} : static_cast<std::size_t>(begin) / 8 * 8, painted.from);
        const float rest = std::max(end - static_cast<float>(from), 0.0F);
        const std::size_t until =
            std::min(painted.until, from + (static_cast<std::size_t>(std::ceil(rest)) + 7) / 8 * 8);
        add_spot(spot, down, row, {from, until}, planes);
    }
    return true;
}

// Applies the collected planes to the texels of a row.
void show_collected(const PaintPlan& plan, Part part, int y, const DamageRow& planes, Row& row) {
    const Floats f;
    const std::size_t lanes = hn::Lanes(f);
    const VF down = set(damage_row_place(plan.frames[index_of(part)], part, y));
    const TexelRange painted = painted_range(plan, part, y);
    NoisePair noise;
    noise.begin();
    for (std::size_t x = painted.from; x < painted.until; x += lanes) {
        DamageTexel texels;
        VF most = set(0.0F);
        for (std::size_t k = 0; k < damage_planes; ++k) {
            texels.plane[k] = hn::Load(f, planes.plane[k] + x);
            most = hn::Max(most, hn::Abs(texels.plane[k]));
        }
        if (hn::AllTrue(f, most <= set(0.0F))) continue;
        if (!hn::AllTrue(f, texels.plane[damage_near_crack] <= set(0.0F))) open_cracks(texels);
        Texel texel = load_texel(row, x);
        show_damage(plan.damage, texels, hn::Load(f, planes.place + x), down, noise, texel);
        store_texel(texel, row, x);
    }
}

// Adds ink and dust to the texels of a row.
void add_ink_and_dust(const PaintPlan& plan, Part part, int y, Row& row) {
    const DamagePlan& damage = plan.damage;
    const bool inked =
        part != Part::stem && part != Part::veil && part != Part::ground && damage.melted > 0.0F;
    const bool dusted =
        (part == Part::cap || part == Part::stem || part == Part::veil) && damage.dust > 0.0F;
    if (!inked && !dusted) return;
    const Floats f;
    const std::size_t lanes = hn::Lanes(f);
    const DamageChart chart = damage_chart(plan, part);
    const VF down = set(damage_row_place(chart.frame, part, y));
    const DiscPlan& shape = part == Part::cap ? plan.cap.disc : plan.hymenium.disc;
    const TexelRange painted = painted_range(plan, part, y);
    NoisePair noise;
    noise.begin();
    for (std::size_t x = painted.from; x < painted.until; x += lanes) {
        Texel texel = load_texel(row, x);
        const VF u = chart.across(x);
        if (inked) {
            // Where the margin has deliquesced, exposed flesh is covered by ink entirely.
            VF share = part == Part::flesh ? set(1.0F) : u * set(1.0F / chart.aspect);
            if (chart.is_disc)
                share = (hn::Sqrt(u * u + down * down) - set(shape.inner)) *
                        set(1.0F / (1.0F - shape.inner));
            show_ink(damage, part == Part::cap ? damage.ink_front : damage.ink_lower, share,
                     hn::Load(f, row.uneven + x), texel);
        }
        if (dusted) {
            // Most dust falls from the mushroom's own gills onto the stem and the ring; the cap
            // receives spores of neighbours.
            const VF exposure =
                part == Part::stem   ? smooth(u * set(1.0F / chart.aspect), 0.12F, 1.3F)
                : part == Part::veil ? set(0.8F)
                                     : set(0.30F) + hn::Load(f, row.uneven + x) * set(0.3F);
            show_dust(damage, u, down, hn::Max(exposure, set(0.0F)), noise, texel);
        }
        store_texel(texel, row, x);
    }
}

// Applies the damage that crosses one row, then ink and dust.
void apply_damage(const PaintPlan& plan, Part part, int y, Row& row, RowBuffers& buffers) {
    if (collect_damage(plan, part, y, row, buffers.damage))
        show_collected(plan, part, y, buffers.damage, row);
    add_ink_and_dust(plan, part, y, row);
}

// Paints the texels of one row of a disc, without damage.
template <class Kernel>
void paint_disc_row(const PaintPlan& plan, int y, Row& row, RowBuffers& buffers) {
    const Floats f;
    const Frame& frame = plan.frames[index_of(Kernel::part)];
    const DiscPlan& disc = Kernel::plan(plan).disc;
    const unsigned used = Kernel::plan(plan).fields;
    const VF down = disc_place(frame, set(static_cast<float>(y)));
    disc_fields<Kernel>(plan, y, buffers);
    VF fields[most_fields];
    clear(fields);
    const UploadedImage& upload = plan.uploads[index_of(Kernel::part)];
    const TexelRange range = painted_range(plan, Kernel::part, y);
    for (std::size_t x = range.from; x < range.until; x += hn::Lanes(f)) {
        const DiscPoint p = disc_point_of(
            disc, disc_place(frame, lane_numbers() + set(static_cast<float>(x))), down);
        for (std::size_t k = 0; k < most_fields; ++k)
            if ((used >> k & 1U) != 0) fields[k] = hn::Load(f, buffers.field[k] + x);
        Texel texel = Kernel::texel(plan, p, fields);
        if (!upload.empty()) {
            const VF reach = set(0.5F) * p.rho;
            const VF c = set(upload.cosine), s = set(upload.sine);
            texel.colour = sampled(upload, set(0.5F) + reach * (p.cosine * c - p.sine * s),
                                   set(0.5F) + reach * (p.sine * c + p.cosine * s));
        }
        store_texel(texel, row, x);
        hn::Store(p.cosine, f, row.cosine + x);
        hn::Store(p.sine, f, row.sine + x);
        hn::Store(p.widening, f, row.widening + x);
        // Broad, because light and rain reach whole sides of a cap.
        hn::Store(fields[0] * set(0.7F) + fields[1] * set(0.2F), f, row.uneven + x);
    }
    if (Kernel::part == Part::cap && y >= 0 && y < frame.height) {
        HWY_ALIGN float place[8];
        hn::Store(down, f, place);
        add_patches_to_row(plan, y, down, place[0], row);
    }
}

// Paints the texels of one row of a strip, without damage. Rows outside of a round part continue
// on its other side; other parts repeat their first or last row.
template <class Kernel>
void paint_strip_row(const PaintPlan& plan, int y, Row& row, RowBuffers& buffers) {
    const Floats f;
    const Frame& frame = plan.frames[index_of(Kernel::part)];
    const std::size_t width = static_cast<std::size_t>(frame.width);
    const float inner = 1.0F / (1.0F - 2.0F * frame.inset);
    const float v = (static_cast<float>(y) + 0.5F) / static_cast<float>(frame.height);
    const float down = (v - frame.inset) * inner;
    const float turned = down < 0.0F ? down + 1.0F : down >= 1.0F ? down - 1.0F : down;
    const float edge = down < 0.0F ? 0.0F : down > 1.0F ? 1.0F : down;
    const VF across = set(Kernel::is_round ? turned : edge);
    strip_fields<Kernel>(plan, across, buffers);
    VF fields[most_fields];
    clear(fields);
    const unsigned used = Kernel::used(plan);
    const float per_x = 1.0F / static_cast<float>(frame.width);
    for (std::size_t x = 0; x < width; x += hn::Lanes(f)) {
        const VF along =
            ((lane_numbers() + set(static_cast<float>(x) + 0.5F)) * set(per_x) - set(frame.inset)) *
            set(inner);
        for (std::size_t k = 0; k < most_fields; ++k)
            if ((used >> k & 1U) != 0) fields[k] = hn::Load(f, buffers.field[k] + x);
        Texel texel = Kernel::texel(plan, along, across, fields);
        if constexpr (Kernel::part == Part::stem) {
            const UploadedImage& upload = plan.uploads[index_of(Part::stem)];
            const float shown_turn = turned + upload.turn;
            if (!upload.empty())
                texel.colour = sampled(upload, along,
                                       set(shown_turn >= 1.0F ? shown_turn - 1.0F : shown_turn));
        }
        store_texel(texel, row, x);
        hn::Store(fields[1], f, row.uneven + x);
    }
}

/// Returns true if kernels are in the order of their parts and none is missing.
template <class... Kernels>
constexpr bool are_all_parts() {
    std::size_t place = 0;
    return (... && (index_of(Kernels::part) == place++)) && place == part_count;
}
static_assert(are_all_parts<CapKernel, HymeniumKernel, StemKernel, VeilKernel, BladeKernel,
                            FleshKernel, GroundKernel>());

/// Painters of one row, by part.
using RowPainter = void (*)(const PaintPlan&, int, Row&, RowBuffers&);
inline constexpr RowPainter row_painters[part_count] = {
    paint_disc_row<CapKernel>,    paint_disc_row<HymeniumKernel>, paint_strip_row<StemKernel>,
    paint_strip_row<VeilKernel>,  paint_strip_row<BladeKernel>,   paint_strip_row<FleshKernel>,
    paint_strip_row<GroundKernel>};

// Paints the texels of one row; y may lie one row outside of the chart.
void paint_row(const PaintPlan& plan, Part part, int y, Row& row, RowBuffers& buffers) {
    row_painters[index_of(part)](plan, y, row, buffers);
    apply_damage(plan, part, y, row, buffers);
    // Slopes at the ends of the painted range use one more texel.
    const TexelRange painted = painted_range(plan, part, y);
    row.height[margin + painted.from - 1] = row.height[margin + painted.from];
    row.height[margin + painted.until] = row.height[margin + painted.until - 1];
}

/// Stores 0..1 as 0..255, rounded.
HWY_INLINE void store_byte(VF value, std::uint8_t* to) {
    const hn::Rebind<std::uint8_t, Floats> bytes;
    const VU whole = hn::And(whole_bits(unit(value) * set(255.0F)), word(255U));
    hn::StoreU(hn::DemoteTo(bytes, hn::BitCast(Ints(), whole)), bytes, to);
}

/// Returns the sRGB transfer function as a polynomial of the square root, within 0.0004 of the
/// standard.
HWY_INLINE VF srgb(VF light) {
    const VF x = unit(light);
    const VF s = hn::Sqrt(x);
    VF curve = set(srgb_curve[0]) * s + set(srgb_curve[1]);
    curve = curve * s + set(srgb_curve[2]);
    curve = curve * s + set(srgb_curve[3]);
    curve = curve * s + set(srgb_curve[4]);
    curve = curve * s + set(srgb_curve[5]);
    curve = curve * s + set(srgb_curve[6]);
    return hn::IfThenElse(x < set(0.0031308F), x * set(12.92F), curve);
}

// Writes the eight channels of a row into the three images; the ninth, metalness, is zero.
void interleave(const std::uint8_t (*channels)[padded], std::size_t width, std::size_t at,
                const PaintTarget& target) {
    const hn::ScalableTag<std::uint8_t> bytes;
    const std::size_t byte_lanes = hn::Lanes(bytes);
    std::uint8_t* const images[3] = {target.base_color + at, target.normal + at, target.orm + at};
    const auto zero = hn::Zero(bytes);
    for (std::size_t image = 0; image < 3; ++image) {
        if (width < byte_lanes) {
            for (std::size_t x = 0; x < width; ++x)
                for (std::size_t c = 0; c < 3; ++c)
                    images[image][3 * x + c] =
                        image == 2 && c == 2 ? std::uint8_t{0} : channels[3 * image + c][x];
            continue;
        }
        for (std::size_t x = 0; x < width; x += byte_lanes) {
            const auto a = hn::LoadU(bytes, channels[3 * image] + x);
            const auto b = hn::LoadU(bytes, channels[3 * image + 1] + x);
            const auto c = image == 2 ? zero : hn::LoadU(bytes, channels[3 * image + 2] + x);
            hn::StoreInterleaved3(a, b, c, bytes, images[image] + 3 * x);
        }
    }
}

// Return slopes along the tangent dP/du of a disc and across it, from slopes along its rows and
// columns, in true lengths along the meridian and round the axis. `widening` is relative to the
// meridian's own unit.
HWY_INLINE VF disc_slope_x(VF cosine, VF sine, VF widening, VF right, VF down) {
    const VF k = hn::Max(widening, set(0.02F));
    const VF meridian = right * cosine + down * sine;
    const VF round = down * cosine - right * sine;  // still to be divided by k
    const VF ks = k * sine;
    const VF inverse = set(1.0F) / (k * hn::Sqrt(cosine * cosine + ks * ks));
    return (sine * round - cosine * meridian) * k * inverse;
}
HWY_INLINE VF disc_slope_y(VF cosine, VF sine, VF widening, VF right, VF down) {
    const VF k = hn::Max(widening, set(0.02F));
    const VF meridian = right * cosine + down * sine;
    const VF round = down * cosine - right * sine;
    const VF ks = k * sine;
    const VF inverse = set(1.0F) / (k * hn::Sqrt(cosine * cosine + ks * ks));
    return (ks * k * meridian + cosine * round) * inverse;
}

/// Stores a colour in linear light as three bytes.
HWY_INLINE void store_colour(const Rgb& colour, std::uint8_t (*bytes)[padded], std::size_t x) {
    store_byte(srgb(colour.r), bytes[0] + x);
    store_byte(srgb(colour.g), bytes[1] + x);
    store_byte(srgb(colour.b), bytes[2] + x);
}

/// Stores the normal with the slopes nx and ny as the bytes after those of the colour.
HWY_INLINE void store_normal(VF nx, VF ny, std::uint8_t (*bytes)[padded], std::size_t x) {
    const VF half = set(0.5F);
    const VF length = half / hn::Sqrt(set(1.0F) + nx * nx + ny * ny);
    store_byte(half + nx * length, bytes[3] + x);
    store_byte(half + ny * length, bytes[4] + x);
    store_byte(half + length, bytes[5] + x);
}

/// Returns the factor on heights of a wet surface: a film of water flattens the relief.
inline float film_factor(const PaintPlan& plan) { return 1.0F - 0.25F * plan.wetness; }

/// Factors from differences of heights over two texels to slopes.
struct SlopeScale {
    VF x, y;
};

HWY_INLINE SlopeScale slope_scale(const PaintPlan& plan, Part part) {
    const float film = film_factor(plan);
    if (is_disc(part)) {
        // Lengths on a disc are relative to its meridian, which begins at `inner`.
        const DiscPlan& disc = part == Part::cap ? plan.cap.disc : plan.hymenium.disc;
        const VF both = set(film * (0.5F * (1.0F - disc.inner) / disc.per_texel));
        return {both, both};
    }
    const float steps_x[part_count] = {0.0F,
                                       0.0F,
                                       plan.stem.texel_along,
                                       plan.veil.texel,
                                       plan.blade.texel_along,
                                       plan.flesh.texel_along,
                                       plan.ground.texel_along};
    const float steps_y[part_count] = {0.0F,
                                       0.0F,
                                       plan.stem.texel_round,
                                       plan.veil.texel,
                                       plan.blade.texel_across,
                                       plan.flesh.texel_across,
                                       plan.ground.texel_across};
    return {set(film * (0.5F / steps_x[index_of(part)])),
            set(film * (0.5F / steps_y[index_of(part)]))};
}

// Returns the texels of a row whose neighbours above and below are painted too: their rows may have
// a shorter painted range.
TexelRange resolved_range(const PaintPlan& plan, Part part, int y) {
    const TexelRange here = painted_range(plan, part, y);
    const TexelRange over = painted_range(plan, part, y - 1);
    const TexelRange under = painted_range(plan, part, y + 1);
    const std::size_t first = std::max(here.from, std::max(over.from, under.from));
    const std::size_t width = static_cast<std::size_t>(plan.frames[index_of(part)].width);
    return {first, is_disc(part) ? width - first : width};
}

// Converts a row of texels, and the heights above and below it, to bytes.
void resolve_row(const PaintPlan& plan, Part part, int y, const Row& above, const Row& row,
                 const Row& below, RowBuffers& buffers, const PaintTarget& target) {
    const Floats f;
    const Frame& frame = plan.frames[index_of(part)];
    const std::size_t width = static_cast<std::size_t>(frame.width);
    const float exposure[part_count] = {1.0F, 0.35F, 0.45F, 0.6F, 0.35F, 0.35F, 0.7F};
    const bool on_disc = is_disc(part);
    const DiscPlan& disc = part == Part::cap ? plan.cap.disc : plan.hymenium.disc;
    const SlopeScale scale = slope_scale(plan, part);
    const TexelRange range = resolved_range(plan, part, y);
    for (std::size_t x = range.from; x < range.until; x += hn::Lanes(f)) {
        const float* at = row.height + margin + x;
        const VF right = (hn::LoadU(f, at + 1) - hn::LoadU(f, at - 1)) * scale.x;
        const VF down =
            (hn::Load(f, below.height + margin + x) - hn::Load(f, above.height + margin + x)) *
            scale.y;
        VF nx, ny;
        if (on_disc) {
            const VF cosine = hn::Load(f, row.cosine + x);
            const VF sine = hn::Load(f, row.sine + x);
            const VF widening = hn::Load(f, row.widening + x) * set(1.0F - disc.inner);
            nx = disc_slope_x(cosine, sine, widening, right, down);
            ny = disc_slope_y(cosine, sine, widening, right, down);
        } else {
            nx = set(0.0F) - right;
            ny = down;
        }
        Rgb colour = {hn::Load(f, row.red + x), hn::Load(f, row.green + x),
                      hn::Load(f, row.blue + x)};
        VF roughness = hn::Load(f, row.roughness + x);
        weather(plan, exposure[index_of(part)], hn::Load(f, row.uneven + x), colour, roughness);
        store_colour(colour, buffers.bytes, x);
        store_normal(nx, ny, buffers.bytes, x);
        store_byte(hn::Load(f, row.occlusion + x), buffers.bytes[6] + x);
        store_byte(hn::Max(roughness, set(0.04F)), buffers.bytes[7] + x);
    }
    for (std::size_t channel = 0; channel < 8; ++channel) {
        std::uint8_t* const line = buffers.bytes[channel];
        std::memset(line, line[range.from], range.from);
        std::memset(line + range.until, line[range.until - 1], width - range.until);
    }
    const std::size_t at =
        3 * (static_cast<std::size_t>(frame.y + y) * static_cast<std::size_t>(plan.side) +
             static_cast<std::size_t>(frame.x));
    interleave(buffers.bytes, width, at, target);
}

/// Paints rows `from` to `to` (exclusive) of a part's chart.
void paint_rows(const PaintPlan& plan, Part part, int from, int to, void* memory,
                const PaintTarget& target) {
    RowBuffers& buffers = *static_cast<RowBuffers*>(memory);
    for (SparseRow& row : buffers.sparse) row.y = -1000;
    Row* above = &buffers.rows[0];
    Row* row = &buffers.rows[1];
    Row* below = &buffers.rows[2];
    paint_row(plan, part, from - 1, *above, buffers);
    paint_row(plan, part, from, *row, buffers);
    for (int y = from; y < to; ++y) {
        paint_row(plan, part, y + 1, *below, buffers);
        resolve_row(plan, part, y, *above, *row, *below, buffers, target);
        Row* const free = above;
        above = row;
        row = below;
        below = free;
    }
}

std::size_t row_buffers_size() { return sizeof(RowBuffers); }

/// Samples two octaves of noise over a chart's disc at (cells + 1)^2 points.
void fill_coarse(const DiscPlan& disc, float inset, int cells, float frequency, std::uint32_t seed,
                 float* out) {
    const Floats f;
    const std::size_t lanes = hn::Lanes(f);
    const float reach = 0.5F - inset;
    HWY_ALIGN float some[8];
    for (int j = 0; j <= cells; ++j) {
        const VF y = set((static_cast<float>(j) / static_cast<float>(cells) - 0.5F) / reach);
        for (int i = 0; i <= cells; i += static_cast<int>(lanes)) {
            const VF x = ((lane_numbers() + set(static_cast<float>(i))) *
                              set(1.0F / static_cast<float>(cells)) -
                          set(0.5F)) *
                         set(1.0F / reach);
            const DiscPoint p = disc_point_of(disc, x, y);
            const VF px = p.radius * p.cosine * set(frequency);
            const VF pz = p.radius * p.sine * set(frequency);
            const VF py = p.height * set(frequency);
            const VF n =
                noise3(px, py, pz, seed) +
                noise3(px * set(2.03F), py * set(2.03F), pz * set(2.03F), seed + 7U) * set(0.5F);
            hn::Store(n, f, some);
            for (int k = 0; k < static_cast<int>(lanes) && i + k <= cells; ++k)
                out[j * (cells + 1) + i + k] = some[k];
        }
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace sporeprint
HWY_AFTER_NAMESPACE();

#endif
