// Paints rows of a chart into the three images: texels part by part, then normals from their
// heights, then bytes.
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
#include "core/surface/hymenium.inl"
#include "core/surface/damage.inl"
#include "core/surface/stem.inl"
#include "core/surface/tissue.inl"

HWY_BEFORE_NAMESPACE();
namespace sporeprint {
namespace HWY_NAMESPACE {

inline constexpr int margin = 8;  // of each row of heights, for the neighbours of its ends

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

/// What a worker needs besides the plan: three rows, the sparse rows above and below, and one row
/// of bytes per channel.
struct Workbench {
    Row rows[3];
    SparseRow sparse[2];
    HWY_ALIGN float field[most_fields][padded];
    HWY_ALIGN float spare[padded];
    HWY_ALIGN ScarRow scars;
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

/// 0, 1, 2, ... one lane each.
HWY_INLINE VF lane_numbers() {
    HWY_ALIGN constexpr float numbers[8] = {0, 1, 2, 3, 4, 5, 6, 7};
    return hn::Load(Floats(), numbers);
}

// One row of a coarse field at every `step`-th texel, the first at texel 0, by bilinear
// interpolation.
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

// Twice as many samples: each, and the mean of it and the next. `from` holds one more sample than
// is doubled.
HWY_INLINE void doubled(const float* from, std::size_t count, float* to) {
    const Floats f;
    for (std::size_t i = 0; i < count; i += hn::Lanes(f)) {
        const VF here = hn::LoadU(f, from + i);
        const VF next = hn::LoadU(f, from + i + 1);
        hn::StoreInterleaved2(here, (here + next) * set(0.5F), f, to + 2 * i);
    }
}

// The given image instead of the painted colour, bilinear; (u, v) in the image, 0..1.
HWY_INLINE Rgb sampled(const GivenImage& image, VF u, VF v) {
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

/// Bleaching and water, on everything that has been painted.
HWY_INLINE void weather(const PaintPlan& plan, float exposure, VF uneven, Rgb& colour,
                        VF& roughness) {
    const VF one = set(1.0F);
    if (plan.fade > 0.0F) {
        // The strongest channel gains a little, the others follow it: red turns orange, then straw.
        const VF w = unit(set(plan.fade * exposure) * (one + uneven * set(0.5F)));
        const VF most = hn::Max(hn::Max(colour.r, colour.g), colour.b);
        const VF bright = most + (set(0.82F) - most) * w * set(0.35F);
        Rgb pale;
        pale.r = mix(colour.r, bright, set(0.95F));
        pale.g = mix(colour.g, bright, set(0.50F));
        pale.b = mix(colour.b, bright, set(0.11F));
        // What lies open to the sky goes on to the species' own faded colour, a little of its pattern left.
        const VF bleached = w * w * set(exposure * exposure * 0.75F);
        const VF light = set(0.72F) + set(0.42F) * hn::Sqrt(most);
        pale = mix(pale, shaded(rgb(plan.scars.faded), light), bleached);
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

/// A colour and a roughness as they weather where the skin is even.
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

/// Place of texels x, x + 1, ... on a disc, in its radii from the pole.
HWY_INLINE VF disc_place(const Frame& frame, VF texel) {
    return ((texel + set(0.5F)) * set(1.0F / static_cast<float>(frame.width)) - set(0.5F)) *
           set(1.0F / (0.5F - frame.inset));
}

/// Texels `from` to `until` of a row that are painted; those outside repeat the nearest. Multiples
/// of eight, or the whole row.
struct Stretch {
    std::size_t from, until;
};

// On a disc what lies well beyond the rim is never looked at, but for the smallest mips.
Stretch painted_stretch(const PaintPlan& plan, int part, int y) {
    const Frame& frame = plan.frames[static_cast<std::size_t>(part)];
    const std::size_t width = static_cast<std::size_t>(frame.width);
    if (part >= 2 || width < 64) return {0, width};
    const float radius = (0.5F - frame.inset) * static_cast<float>(frame.width) * 1.03F + 3.0F;
    const float dy = static_cast<float>(y) + 0.5F - 0.5F * static_cast<float>(frame.height);
    const float square = radius * radius - dy * dy;
    HWY_ALIGN float half[8] = {};
    hn::Store(hn::Sqrt(set(square > 0.0F ? square : 0.0F)), Floats(), half);
    const float from = 0.5F * static_cast<float>(frame.width) - half[0] - 8.0F;
    const std::size_t first = from < 0.0F ? 0 : static_cast<std::size_t>(from) / 8 * 8;
    return {first, width - first};
}

HWY_INLINE void clear(ScarRow& row, std::size_t width) {
    for (float* const plane : row.plane) std::memset(plane, 0, width * sizeof(float));
    std::memset(row.ragged, 0, width * sizeof(float));
}

HWY_INLINE void clear(VF* fields) {
    for (std::size_t k = 0; k < most_fields; ++k) fields[k] = set(0.0F);
}

// Samples the fields of a disc along one row, at every disc_step-th texel.
const SparseRow& sparse_row(const PaintPlan& plan, int part, int y, Workbench& bench) {
    SparseRow& row = bench.sparse[y & 1];
    if (row.y == y) return row;
    row.y = y;
    const Floats f;
    const Frame& frame = plan.frames[static_cast<std::size_t>(part)];
    const int step = plan.disc_step;
    const int count = frame.width / step + 1;
    const unsigned used = part == 0 ? plan.cap.fields : plan.hymenium.fields;
    const std::size_t grids = part == 0 ? 3 : 2;
    for (std::size_t i = 0; i < grids; ++i)
        expand(part == 0 ? plan.cap_fields[i] : plan.hymenium_fields[i], plan.coarse_cells, frame,
               y * step, step, count, row.field[i]);
    if (used >> grids == 0) return row;
    const DiscPlan& disc = part == 0 ? plan.cap.disc : plan.hymenium.disc;
    const VF down = disc_place(frame, set(static_cast<float>(y * step)));
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); i += hn::Lanes(f)) {
        VF fields[most_fields];
        clear(fields);
        for (std::size_t k = 0; k < grids; ++k) fields[k] = hn::Load(f, row.field[k] + i);
        const VF texel =
            (lane_numbers() + set(static_cast<float>(i))) * set(static_cast<float>(step));
        const DiscPoint p = disc_point_of(disc, disc_place(frame, texel), down);
        if (part == 0)
            cap_fields(plan.cap, p, fields);
        else
            hymenium_fields(plan.hymenium, p, fields);
        for (std::size_t k = grids; k < most_fields; ++k)
            if ((used >> k & 1U) != 0) hn::Store(fields[k], f, row.field[k] + i);
    }
    return row;
}

// The fields of a disc at every texel of a row, into bench.field.
void disc_fields(const PaintPlan& plan, int part, int y, Workbench& bench) {
    const Floats f;
    const std::size_t width =
        static_cast<std::size_t>(plan.frames[static_cast<std::size_t>(part)].width);
    const unsigned used = part == 0 ? plan.cap.fields : plan.hymenium.fields;
    const int half = (y + 2) / 2 - 1;  // floor, for y >= -2
    const bool between = plan.disc_step == 2 && y != 2 * half;
    const SparseRow& above = sparse_row(plan, part, plan.disc_step == 2 ? half : y, bench);
    const SparseRow& below = between ? sparse_row(plan, part, half + 1, bench) : above;
    for (std::size_t k = 0; k < most_fields; ++k) {
        if ((used >> k & 1U) == 0) continue;
        const float* from = above.field[k];
        if (between) {
            for (std::size_t i = 0; i < width / 2 + 1; i += hn::Lanes(f))
                hn::Store(
                    (hn::Load(f, above.field[k] + i) + hn::Load(f, below.field[k] + i)) * set(0.5F),
                    f, bench.spare + i);
            from = bench.spare;
        }
        if (plan.disc_step == 2) {
            doubled(from, width / 2, bench.field[k]);
        } else {
            for (std::size_t i = 0; i < width; i += hn::Lanes(f))
                hn::Store(hn::Load(f, from + i), f, bench.field[k] + i);
        }
    }
}

// The fields of a strip at every texel of a row, into bench.field: sampled at every strip_step-th
// texel, then doubled.
void strip_fields(const PaintPlan& plan, int part, VF across, Workbench& bench) {
    const Floats f;
    const Frame& frame = plan.frames[static_cast<std::size_t>(part)];
    const int step = part == 2 ? plan.strip_step : plan.strip_step > 1 ? 2 : 1;
    const unsigned used = part == 2 ? plan.stem.fields : 3U;
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
        if (part == 2)
            stem_fields(plan.stem, unit(along), across, fields);
        else if (part == 3)
            veil_fields(plan.veil, along, across, fields);
        else if (part == 4)
            blade_fields(plan.blade, along, across, fields);
        else
            flesh_fields(plan.flesh, along, across, fields);
        for (std::size_t k = 0; k < most_fields; ++k)
            if ((used >> k & 1U) != 0) hn::Store(fields[k], f, bench.field[k] + i);
    }
    for (int left = step; left > 1; left /= 2) {
        const std::size_t samples = static_cast<std::size_t>(frame.width / left);
        for (std::size_t k = 0; k < most_fields; ++k) {
            if ((used >> k & 1U) == 0) continue;
            doubled(bench.field[k], samples, bench.spare);
            // The sample after the last stays the last of the doubled row.
            const float last = bench.field[k][samples];
            for (std::size_t i = 0; i < 2 * samples; i += hn::Lanes(f))
                hn::Store(hn::Load(f, bench.spare + i), f, bench.field[k] + i);
            bench.field[k][2 * samples] = last;
        }
    }
}

// Lays the warts and scales that cross one row over its texels.
void lay_patches(const PaintPlan& plan, int y, VF down_places, float down, Row& row) {
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
            lay_patch(patch, plan.veil,
                      disc_place(frame, lane_numbers() + set(static_cast<float>(x))), down_places,
                      texel);
            store_texel(texel, row, x);
        }
    }
}

// Place of a row on its chart, in the chart's lengths.
float scar_row_place(const Frame& frame, int part, int y) {
    const float v = (static_cast<float>(y) + 0.5F) / static_cast<float>(frame.height);
    return part == 2 ? (v - frame.inset) / (1.0F - 2.0F * frame.inset)
                     : (v - 0.5F) / (0.5F - frame.inset);
}

/// How the rows of a chart lie for what is laid on them.
struct ScarSheet {
    const Frame& frame;
    bool is_disc;
    float inner, aspect;  ///< of a strip: one over the share inside its insets, and its length

    [[nodiscard]] HWY_INLINE VF across(std::size_t x) const {
        const VF texel = lane_numbers() + set(static_cast<float>(x));
        if (is_disc) return disc_place(frame, texel);
        const VF along =
            ((texel + set(0.5F)) * set(1.0F / static_cast<float>(frame.width)) - set(frame.inset)) *
            set(inner);
        return unit(along) * set(aspect);
    }
    [[nodiscard]] ScarSpan whole() const {
        return is_disc ? ScarSpan{-1e9F, 1e9F} : ScarSpan{0.0F, aspect};
    }
    // Texels in the chart's length, and from the first to place 0.
    [[nodiscard]] float per_unit() const {
        return is_disc ? (0.5F - frame.inset) * static_cast<float>(frame.width)
                       : static_cast<float>(frame.width) / (inner * aspect);
    }
    [[nodiscard]] float first() const {
        return (is_disc ? 0.5F : frame.inset) * static_cast<float>(frame.width);
    }
};

ScarSheet scar_sheet(const PaintPlan& plan, int part) {
    const Frame& frame = plan.frames[static_cast<std::size_t>(part)];
    const float inner = 1.0F / (1.0F - 2.0F * frame.inset);
    const float aspect = part == 2
                             ? plan.stem.aspect
                             : 1.0F / plan.veil.texel / static_cast<float>(frame.width) * inner;
    return {frame, part < 2, inner, aspect};
}

// Lays a scar over texels `from` to `until` of a row; one loop for each kind, because most scars cross few texels.
// The scar is a copy, which no texel written can change: so its numbers stay in registers.
HWY_INLINE void lay_scar(Scar scar, VF down, const Row& row, const Stretch& stretch,
                         ScarRow& marked) {
    const Floats f;
    NoisePair noise;
    const auto each = [&](auto lay) {
        for (std::size_t x = stretch.from; x < stretch.until; x += hn::Lanes(f))
            lay(hn::Load(f, marked.place + x), ScarPlace{marked, x});
    };
    switch (scar.kind) {
        case ScarKind::crack:
            each([&](VF across, const ScarPlace& at) { lay_crack(scar, across, down, at); });
            return;
        case ScarKind::furrow:
            each([&](VF across, const ScarPlace& at) { lay_furrow(scar, across, down, at); });
            return;
        case ScarKind::pit:
            each([&](VF across, const ScarPlace& at) { lay_pit(scar, across, down, at); });
            return;
        case ScarKind::bruise:
            noise.begin();
            each(
                [&](VF across, const ScarPlace& at) { lay_bruise(scar, across, down, at, noise); });
            return;
        case ScarKind::drop:
            each([&](VF across, const ScarPlace& at) { lay_drop(scar, across, down, at); });
            return;
        case ScarKind::lump:
            each([&](VF across, const ScarPlace& at) { lay_lump(scar, across, down, at); });
            return;
        case ScarKind::bite:
        case ScarKind::split:
        case ScarKind::tongue:
            each([&](VF across, const ScarPlace& at) {
                lay_margin(scar, hn::Load(f, row.cosine + at.x), hn::Load(f, row.sine + at.x),
                           set(1.0F) - hn::Sqrt(across * across + down * down), at);
            });
            return;
    }
}

// Lays the scars that cross one row into the planes; whether there are any.
bool mark_scars(const PaintPlan& plan, int part, int y, const Row& row, ScarRow& marked) {
    const ScarsPlan& scars = plan.scars;
    const std::size_t place = static_cast<std::size_t>(part);
    if (part > 2 || scars.scars[place].empty()) return false;
    const std::span<const std::uint32_t> crossing = scars.by_row[place].of(y);
    if (crossing.empty()) return false;
    const Floats f;
    const std::size_t lanes = hn::Lanes(f);
    const ScarSheet sheet = scar_sheet(plan, part);
    const Stretch painted = painted_stretch(plan, part, y);
    const float down_place = scar_row_place(sheet.frame, part, y);
    const VF down = set(down_place);
    clear(marked, static_cast<std::size_t>(sheet.frame.width));
    for (std::size_t x = painted.from; x < painted.until; x += lanes)
        hn::Store(sheet.across(x), f, marked.place + x);
    const ScarSpan whole = sheet.whole();
    const float per_unit = sheet.per_unit();
    const float first = sheet.first();
    for (const std::uint32_t index : crossing) {
        const Scar& scar = scars.scars[place][index];
        const ScarSpan span = scar_span(scar, down_place, whole);
        if (span.to <= span.from) continue;
        const float begin = first + span.from * per_unit - 1.0F;
        const float end = first + span.to * per_unit + 1.0F;
        // Whole eights, however many texels a vector has: a stain's rim may reach a little beyond.
        const std::size_t from = std::max(
            begin < 0.0F ? std::size_t{0} : static_cast<std::size_t>(begin) / 8 * 8, painted.from);
        const float rest = std::max(end - static_cast<float>(from), 0.0F);
        const std::size_t until =
            std::min(painted.until, from + (static_cast<std::size_t>(std::ceil(rest)) + 7) / 8 * 8);
        lay_scar(scar, down, row, {from, until}, marked);
    }
    return true;
}

// Changes the texels of a row by what has been laid into the planes.
void show_marked(const PaintPlan& plan, int part, int y, const ScarRow& marked, Row& row) {
    const Floats f;
    const std::size_t lanes = hn::Lanes(f);
    const VF down = set(scar_row_place(plan.frames[static_cast<std::size_t>(part)], part, y));
    const Stretch painted = painted_stretch(plan, part, y);
    NoisePair noise;
    noise.begin();
    for (std::size_t x = painted.from; x < painted.until; x += lanes) {
        ScarTexel laid;
        VF most = set(0.0F);
        for (std::size_t k = 0; k < scar_planes; ++k) {
            laid.plane[k] = hn::Load(f, marked.plane[k] + x);
            most = hn::Max(most, hn::Abs(laid.plane[k]));
        }
        if (hn::AllTrue(f, most <= set(0.0F))) continue;
        if (!hn::AllTrue(f, laid.plane[scar_near] <= set(0.0F))) open_cracks(laid);
        Texel texel = load_texel(row, x);
        show_scars(plan.scars, laid, hn::Load(f, marked.place + x), down, noise, texel);
        store_texel(texel, row, x);
    }
}

// Lays ink and dust over the texels of a row.
void lay_ink_and_dust(const PaintPlan& plan, int part, int y, Row& row) {
    const ScarsPlan& scars = plan.scars;
    const bool inked = (part < 2 || part >= 4) && scars.melted > 0.0F;
    const bool dusted = (part == 0 || part == 2 || part == 3) && scars.dust > 0.0F;
    if (!inked && !dusted) return;
    const Floats f;
    const std::size_t lanes = hn::Lanes(f);
    const ScarSheet sheet = scar_sheet(plan, part);
    const VF down = set(scar_row_place(sheet.frame, part, y));
    const DiscPlan& shape = part == 0 ? plan.cap.disc : plan.hymenium.disc;
    const Stretch painted = painted_stretch(plan, part, y);
    NoisePair noise;
    noise.begin();
    for (std::size_t x = painted.from; x < painted.until; x += lanes) {
        Texel texel = load_texel(row, x);
        const VF u = sheet.across(x);
        if (inked) {
            // Flesh lies open where the margin has melted: all of it is ink.
            VF share = part == 5 ? set(1.0F) : u * set(1.0F / sheet.aspect);
            if (sheet.is_disc)
                share = (hn::Sqrt(u * u + down * down) - set(shape.inner)) *
                        set(1.0F / (1.0F - shape.inner));
            show_ink(scars, part == 0 ? scars.ink_front : scars.ink_lower, share,
                     hn::Load(f, row.uneven + x), texel);
        }
        if (dusted) {
            // Most falls from the own gills onto the stem below them and onto the ring; the cap has what a neighbour sheds.
            const VF exposure = part == 2   ? smooth(u * set(1.0F / sheet.aspect), 0.12F, 1.3F)
                                : part == 3 ? set(0.8F)
                                            : set(0.30F) + hn::Load(f, row.uneven + x) * set(0.3F);
            show_dust(scars, u, down, hn::Max(exposure, set(0.0F)), noise, texel);
        }
        store_texel(texel, row, x);
    }
}

// Lays the scars that cross one row over its texels, then ink and dust.
void lay_scars(const PaintPlan& plan, int part, int y, Row& row, Workbench& bench) {
    if (mark_scars(plan, part, y, row, bench.scars)) show_marked(plan, part, y, bench.scars, row);
    lay_ink_and_dust(plan, part, y, row);
}

// Paints the texels of one row; y may lie one row outside of the chart.
void paint_row(const PaintPlan& plan, int part, int y, Row& row, Workbench& bench) {
    const Floats f;
    const std::size_t lanes = hn::Lanes(f);
    const Frame& frame = plan.frames[static_cast<std::size_t>(part)];
    const std::size_t width = static_cast<std::size_t>(frame.width);
    VF fields[most_fields];
    clear(fields);
    if (part < 2) {
        const DiscPlan& disc = part == 0 ? plan.cap.disc : plan.hymenium.disc;
        const unsigned used = part == 0 ? plan.cap.fields : plan.hymenium.fields;
        const VF down = disc_place(frame, set(static_cast<float>(y)));
        disc_fields(plan, part, y, bench);
        const GivenImage& given = plan.given[static_cast<std::size_t>(part)];
        const Stretch stretch = painted_stretch(plan, part, y);
        for (std::size_t x = stretch.from; x < stretch.until; x += lanes) {
            const DiscPoint p = disc_point_of(
                disc, disc_place(frame, lane_numbers() + set(static_cast<float>(x))), down);
            for (std::size_t k = 0; k < most_fields; ++k)
                if ((used >> k & 1U) != 0) fields[k] = hn::Load(f, bench.field[k] + x);
            Texel texel = part == 0 ? cap_texel(plan.cap, p, fields)
                                    : hymenium_texel(plan.hymenium, p, fields);
            if (!given.empty()) {
                const VF reach = set(0.5F) * p.rho;
                const VF c = set(given.cosine), s = set(given.sine);
                texel.colour = sampled(given, set(0.5F) + reach * (p.cosine * c - p.sine * s),
                                       set(0.5F) + reach * (p.sine * c + p.cosine * s));
            }
            store_texel(texel, row, x);
            hn::Store(p.cosine, f, row.cosine + x);
            hn::Store(p.sine, f, row.sine + x);
            hn::Store(p.widening, f, row.widening + x);
            hn::Store(fields[1], f, row.uneven + x);
        }
        if (part == 0 && y >= 0 && y < frame.height) {
            HWY_ALIGN float place[8];
            hn::Store(down, f, place);
            lay_patches(plan, y, down, place[0], row);
        }
    } else {
        const float inner = 1.0F / (1.0F - 2.0F * frame.inset);
        const float v = (static_cast<float>(y) + 0.5F) / static_cast<float>(frame.height);
        const float down = (v - frame.inset) * inner;
        const float turned = down < 0.0F ? down + 1.0F : down >= 1.0F ? down - 1.0F : down;
        const float edge = down < 0.0F ? 0.0F : down > 1.0F ? 1.0F : down;
        const VF across = set(part == 2 ? turned : edge);
        strip_fields(plan, part, across, bench);
        const unsigned used = part == 2 ? plan.stem.fields : 3U;
        const GivenImage& given = plan.given[2];
        const float per_x = 1.0F / static_cast<float>(frame.width);
        const float shown_turn = turned + given.turn;
        const VF given_across = set(shown_turn >= 1.0F ? shown_turn - 1.0F : shown_turn);
        for (std::size_t x = 0; x < width; x += lanes) {
            const VF along = ((lane_numbers() + set(static_cast<float>(x) + 0.5F)) * set(per_x) -
                              set(frame.inset)) *
                             set(inner);
            for (std::size_t k = 0; k < most_fields; ++k)
                if ((used >> k & 1U) != 0) fields[k] = hn::Load(f, bench.field[k] + x);
            Texel texel;
            if (part == 2) {
                texel = stem_texel(plan.stem, unit(along), across, fields);
                if (!given.empty()) texel.colour = sampled(given, along, given_across);
            } else {
                texel = part == 3   ? veil_texel(plan.veil, along, across, fields)
                        : part == 4 ? blade_texel(plan.blade, along, across, fields)
                                    : flesh_texel(plan.flesh, along, across, fields);
            }
            store_texel(texel, row, x);
            hn::Store(fields[1], f, row.uneven + x);
        }
    }
    lay_scars(plan, part, y, row, bench);
    // Slopes at the ends of the painted stretch look one texel further.
    const Stretch painted = painted_stretch(plan, part, y);
    row.height[margin + painted.from - 1] = row.height[margin + painted.from];
    row.height[margin + painted.until] = row.height[margin + painted.until - 1];
}

/// 0..1 to 0..255, rounded.
HWY_INLINE void store_byte(VF value, std::uint8_t* to) {
    const hn::Rebind<std::uint8_t, Floats> bytes;
    const VU whole = hn::And(whole_bits(unit(value) * set(255.0F)), word(255U));
    hn::StoreU(hn::DemoteTo(bytes, hn::BitCast(Ints(), whole)), bytes, to);
}

/// The sRGB transfer function: a polynomial of the square root, within 0.0004 of the standard.
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

// Slopes along the tangent dP/du of a disc and across it, from those along its rows and columns: by the meridian and round the
// axis in true lengths. `widening` is that of the meridian's own unit.
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

// Turns a row of texels, and the heights above and below it, into bytes.
void resolve_row(const PaintPlan& plan, int part, int y, const Row& above, const Row& row,
                 const Row& below, Workbench& bench, const PaintTarget& target) {
    const Floats f;
    const std::size_t lanes = hn::Lanes(f);
    const Frame& frame = plan.frames[static_cast<std::size_t>(part)];
    const std::size_t width = static_cast<std::size_t>(frame.width);
    const VF one = set(1.0F);
    const VF half = set(0.5F);
    const float exposure[part_count] = {1.0F, 0.35F, 0.45F, 0.6F, 0.35F, 0.35F};
    const float film = 1.0F - 0.25F * plan.wetness;  // water levels the relief
    const bool is_disc = part < 2;
    const DiscPlan& disc = part == 0 ? plan.cap.disc : plan.hymenium.disc;
    const float steps_x[part_count] = {0.0F,
                                       0.0F,
                                       plan.stem.texel_along,
                                       plan.veil.texel,
                                       plan.blade.texel_along,
                                       plan.flesh.texel_along};
    const float steps_y[part_count] = {0.0F,
                                       0.0F,
                                       plan.stem.texel_round,
                                       plan.veil.texel,
                                       plan.blade.texel_across,
                                       plan.flesh.texel_across};
    const float step_x = steps_x[part];
    const float step_y = steps_y[part];
    // A disc's lengths are those of its meridian, which begins at `inner`.
    const VF per_x =
        set(film * (is_disc ? 0.5F * (1.0F - disc.inner) / disc.per_texel : 0.5F / step_x));
    const VF per_y =
        set(film * (is_disc ? 0.5F * (1.0F - disc.inner) / disc.per_texel : 0.5F / step_y));
    // The rows above and below may end a little earlier: only painted neighbours count.
    const Stretch here = painted_stretch(plan, part, y);
    const Stretch over = painted_stretch(plan, part, y - 1);
    const Stretch under = painted_stretch(plan, part, y + 1);
    const std::size_t first = std::max(here.from, std::max(over.from, under.from));
    const Stretch stretch = {first, is_disc ? width - first : width};
    for (std::size_t x = stretch.from; x < stretch.until; x += lanes) {
        const float* at = row.height + margin + x;
        const VF right = (hn::LoadU(f, at + 1) - hn::LoadU(f, at - 1)) * per_x;
        const VF down =
            (hn::Load(f, below.height + margin + x) - hn::Load(f, above.height + margin + x)) *
            per_y;
        VF nx, ny;
        if (is_disc) {
            const VF cosine = hn::Load(f, row.cosine + x);
            const VF sine = hn::Load(f, row.sine + x);
            const VF widening = hn::Load(f, row.widening + x) * set(1.0F - disc.inner);
            nx = disc_slope_x(cosine, sine, widening, right, down);
            ny = disc_slope_y(cosine, sine, widening, right, down);
        } else {
            nx = set(0.0F) - right;
            ny = down;
        }
        const VF length = half / hn::Sqrt(one + nx * nx + ny * ny);
        Rgb colour = {hn::Load(f, row.red + x), hn::Load(f, row.green + x),
                      hn::Load(f, row.blue + x)};
        VF roughness = hn::Load(f, row.roughness + x);
        weather(plan, exposure[part], hn::Load(f, row.uneven + x), colour, roughness);
        store_byte(srgb(colour.r), bench.bytes[0] + x);
        store_byte(srgb(colour.g), bench.bytes[1] + x);
        store_byte(srgb(colour.b), bench.bytes[2] + x);
        store_byte(half + nx * length, bench.bytes[3] + x);
        store_byte(half + ny * length, bench.bytes[4] + x);
        store_byte(half + length, bench.bytes[5] + x);
        store_byte(hn::Load(f, row.occlusion + x), bench.bytes[6] + x);
        store_byte(hn::Max(roughness, set(0.04F)), bench.bytes[7] + x);
    }
    for (std::size_t channel = 0; channel < 8; ++channel) {
        std::uint8_t* const line = bench.bytes[channel];
        std::memset(line, line[stretch.from], stretch.from);
        std::memset(line + stretch.until, line[stretch.until - 1], width - stretch.until);
    }
    const std::size_t at =
        3 * (static_cast<std::size_t>(frame.y + y) * static_cast<std::size_t>(plan.side) +
             static_cast<std::size_t>(frame.x));
    interleave(bench.bytes, width, at, target);
}

/// Paints rows `from` to `to` (exclusive) of a part's chart.
void paint_rows(const PaintPlan& plan, int part, int from, int to, void* memory,
                const PaintTarget& target) {
    Workbench& bench = *static_cast<Workbench*>(memory);
    for (SparseRow& row : bench.sparse) row.y = -1000;
    Row* above = &bench.rows[0];
    Row* row = &bench.rows[1];
    Row* below = &bench.rows[2];
    paint_row(plan, part, from - 1, *above, bench);
    paint_row(plan, part, from, *row, bench);
    for (int y = from; y < to; ++y) {
        paint_row(plan, part, y + 1, *below, bench);
        resolve_row(plan, part, y, *above, *row, *below, bench, target);
        Row* const free = above;
        above = row;
        row = below;
        below = free;
    }
}

std::size_t workbench_size() { return sizeof(Workbench); }

/// Samples noise over a chart's disc at (cells + 1)^2 points, two octaves.
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
