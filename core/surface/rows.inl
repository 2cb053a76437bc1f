// Paints rows of a chart into the three images: texels part by part, then normals from their heights, then bytes.
#if defined(SPOREPRINT_CORE_SURFACE_ROWS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SPOREPRINT_CORE_SURFACE_ROWS_INL
#undef SPOREPRINT_CORE_SURFACE_ROWS_INL
#else
#define SPOREPRINT_CORE_SURFACE_ROWS_INL
#endif

#include "core/surface/cap.inl"
#include "core/surface/hymenium.inl"
#include "core/surface/stem.inl"

HWY_BEFORE_NAMESPACE();
namespace sporeprint {
namespace HWY_NAMESPACE {

inline constexpr int widest = 2048;
inline constexpr int margin = 8;  // of each row of heights, for the neighbours of its ends

/// One row of painted texels.
struct Row {
    HWY_ALIGN float height[widest + 2 * margin];
    HWY_ALIGN float red[widest], green[widest], blue[widest];
    HWY_ALIGN float roughness[widest], occlusion[widest];
    HWY_ALIGN float coarse[3][widest];
};

/// What a worker needs besides the plan: three rows, and one row of bytes per channel.
struct Workbench {
    Row rows[3];
    HWY_ALIGN std::uint8_t bytes[9][widest];
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
    texel.colour = {hn::Load(f, row.red + x), hn::Load(f, row.green + x), hn::Load(f, row.blue + x)};
    texel.roughness = hn::Load(f, row.roughness + x);
    texel.occlusion = hn::Load(f, row.occlusion + x);
    return texel;
}

/// 0, 1, 2, ... one lane each.
HWY_INLINE VF lane_numbers() {
    HWY_ALIGN constexpr float numbers[8] = {0, 1, 2, 3, 4, 5, 6, 7};
    return hn::Load(Floats(), numbers);
}

// Stretches a coarse field over one row of texels by bilinear interpolation.
void expand(const CoarseField& field, int cells, const Frame& frame, int y, float* out) {
    const int step = frame.width / cells;
    const float per_step = 1.0F / static_cast<float>(step);
    const float at = (static_cast<float>(y) + 0.5F) * per_step;
    const int j = at < 0.0F ? 0 : static_cast<int>(at) >= cells ? cells - 1 : static_cast<int>(at);
    const float weight = at - static_cast<float>(j);
    const float* upper = field.values.data() + static_cast<std::size_t>(j) * static_cast<std::size_t>(cells + 1);
    const float* lower = upper + cells + 1;
    for (int i = 0; i < cells; ++i) {
        const float left = upper[i] + (lower[i] - upper[i]) * weight;
        const float right = upper[i + 1] + (lower[i + 1] - upper[i + 1]) * weight;
        const float slope = (right - left) * per_step;
        float* to = out + static_cast<std::size_t>(i) * static_cast<std::size_t>(step);
        for (int k = 0; k < step; ++k) to[k] = left + (static_cast<float>(k) + 0.5F) * slope;
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
            return image.light.data() + 3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(column));
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
HWY_INLINE void weather(const PaintPlan& plan, VF exposure, VF uneven, Texel& texel) {
    const VF one = set(1.0F);
    if (plan.fade > 0.0F) {
        // The strongest channel gains a little, the others follow it: red turns orange, then straw.
        const VF w = unit(set(plan.fade) * exposure * (one + uneven * set(0.5F)));
        const VF most = hn::Max(hn::Max(texel.colour.r, texel.colour.g), texel.colour.b);
        const VF bright = most + (set(0.82F) - most) * w * set(0.35F);
        Rgb pale;
        pale.r = bright;
        pale.g = mix(texel.colour.g, bright, set(0.62F));
        pale.b = mix(texel.colour.b, bright, set(0.26F));
        pale.r = mix(texel.colour.r, bright, set(0.95F));
        texel.colour = mix(texel.colour, pale, w * set(0.85F));
        texel.roughness = texel.roughness + w * set(0.10F);
    }
    if (plan.wetness > 0.0F) {
        const VF w = set(plan.wetness) * unit(set(0.85F) + uneven * set(0.4F));
        const VF dark = w * set(0.42F);
        texel.colour.r = texel.colour.r * (one - dark * (one - texel.colour.r));
        texel.colour.g = texel.colour.g * (one - dark * (one - texel.colour.g));
        texel.colour.b = texel.colour.b * (one - dark * (one - texel.colour.b));
        texel.roughness = mix(texel.roughness, set(0.10F), w * set(0.85F));
        texel.height = texel.height * (one - w * set(0.25F));
    }
}

// Paints the texels of one row; y may lie one row outside of the chart.
void paint_row(const PaintPlan& plan, int part, int y, Row& row) {
    const Floats f;
    const std::size_t lanes = hn::Lanes(f);
    const Frame& frame = plan.frames[static_cast<std::size_t>(part)];
    const std::size_t width = static_cast<std::size_t>(frame.width);
    const float per_x = 1.0F / static_cast<float>(frame.width);
    const float v = (static_cast<float>(y) + 0.5F) / static_cast<float>(frame.height);
    if (part < 2) {
        const DiscPlan& disc = part == 0 ? plan.cap.disc : plan.hymenium.disc;
        const float reach = 0.5F - frame.inset;
        const VF down = set((v - 0.5F) / reach);
        const int fields = part == 0 ? 3 : 2;
        for (int i = 0; i < fields; ++i)
            expand(part == 0 ? plan.cap_fields[static_cast<std::size_t>(i)] : plan.hymenium_fields[static_cast<std::size_t>(i)], plan.coarse_cells, frame, y, row.coarse[i]);
        const GivenImage& given = plan.given[static_cast<std::size_t>(part)];
        for (std::size_t x = 0; x < width; x += lanes) {
            const VF across = ((lane_numbers() + set(static_cast<float>(x) + 0.5F)) * set(per_x) - set(0.5F)) * set(1.0F / reach);
            const DiscPoint p = disc_point_of(disc, across, down);
            const VF c0 = hn::Load(f, row.coarse[0] + x);
            const VF c1 = hn::Load(f, row.coarse[1] + x);
            Texel texel;
            if (part == 0)
                texel = cap_texel(plan.cap, p, c0, c1, hn::Load(f, row.coarse[2] + x));
            else
                texel = hymenium_texel(plan.hymenium, p, c0, c1);
            if (!given.empty()) {
                const VF u = set(0.5F) + set(0.5F) * p.rho * p.cosine;
                const VF w = set(0.5F) + set(0.5F) * p.rho * p.sine;
                texel.colour = sampled(given, u, w);
            }
            store_texel(texel, row, x);
        }
        if (part == 0 && y >= 0 && y < frame.height) {
            for (const int index : plan.patches_by_row[static_cast<std::size_t>(y)]) {
                const PatchPlan& patch = plan.patches[static_cast<std::size_t>(index)];
                const float middle = (patch.x * reach + 0.5F) * static_cast<float>(frame.width);
                const float half = patch.reach * reach * static_cast<float>(frame.width) + 1.0F;
                const float begin = middle - half < 0.0F ? 0.0F : middle - half;
                const float end = middle + half > static_cast<float>(frame.width) ? static_cast<float>(frame.width) : middle + half;
                for (std::size_t x = static_cast<std::size_t>(begin) / 8 * 8; static_cast<float>(x) < end; x += lanes) {
                    const VF across = ((lane_numbers() + set(static_cast<float>(x) + 0.5F)) * set(per_x) - set(0.5F)) * set(1.0F / reach);
                    Texel texel = load_texel(row, x);
                    lay_patch(patch, plan.veil, across, down, texel);
                    store_texel(texel, row, x);
                }
            }
        }
        if (plan.fade > 0.0F || plan.wetness > 0.0F) {
            for (std::size_t x = 0; x < width; x += lanes) {
                Texel texel = load_texel(row, x);
                weather(plan, set(part == 0 ? 1.0F : 0.35F), hn::Load(f, row.coarse[1] + x), texel);
                store_texel(texel, row, x);
            }
        }
    } else {
        const float inner = 1.0F / (1.0F - 2.0F * frame.inset);
        const float down = (v - frame.inset) * inner;
        const float turned = down < 0.0F ? down + 1.0F : down >= 1.0F ? down - 1.0F : down;
        const float across = down < 0.0F ? 0.0F : down > 1.0F ? 1.0F : down;
        const GivenImage& given = plan.given[2];
        for (std::size_t x = 0; x < width; x += lanes) {
            const VF along = ((lane_numbers() + set(static_cast<float>(x) + 0.5F)) * set(per_x) - set(frame.inset)) * set(inner);
            Texel texel;
            if (part == 2) {
                texel = stem_texel(plan.stem, unit(along), set(turned));
                if (!given.empty()) texel.colour = sampled(given, along, set(turned));
            } else {
                texel = veil_texel(plan.veil, along - hn::Floor(along), set(across));
            }
            weather(plan, set(part == 2 ? 0.45F : 0.6F), set(0.0F), texel);
            store_texel(texel, row, x);
        }
    }
    for (int i = 0; i < margin; ++i) {
        row.height[i] = row.height[margin];
        row.height[margin + frame.width + i] = row.height[margin + frame.width - 1];
    }
}

/// 0..1 to 0..255, rounded.
HWY_INLINE void store_byte(VF value, std::uint8_t* to) {
    const hn::Rebind<std::uint8_t, Floats> bytes;
    const VI whole = hn::ConvertTo(Ints(), unit(value) * set(255.0F) + set(0.5F));
    hn::StoreU(hn::DemoteTo(bytes, whole), bytes, to);
}

/// The sRGB transfer function: a polynomial of the square root, within 0.0004 of the standard.
HWY_INLINE VF srgb(VF light) {
    const VF x = unit(light);
    const VF s = hn::Sqrt(x);
    VF curve = set(srgb_curve[0]);
    for (std::size_t i = 1; i < 7; ++i) curve = curve * s + set(srgb_curve[i]);
    return hn::IfThenElse(x < set(0.0031308F), x * set(12.92F), curve);
}

// Turns a row of texels, and the heights above and below it, into bytes.
void resolve_row(const PaintPlan& plan, int part, int y, const Row& above, const Row& row, const Row& below, Workbench& bench, const PaintTarget& target) {
    const Floats f;
    const std::size_t lanes = hn::Lanes(f);
    const Frame& frame = plan.frames[static_cast<std::size_t>(part)];
    const std::size_t width = static_cast<std::size_t>(frame.width);
    const VF one = set(1.0F);
    const VF half = set(0.5F);
    const float reach = 0.5F - frame.inset;
    const float per_x = 1.0F / static_cast<float>(frame.width);
    const float v = (static_cast<float>(y) + 0.5F) / static_cast<float>(frame.height);
    for (std::size_t x = 0; x < width; x += lanes) {
        const float* at = row.height + margin + x;
        const VF right = hn::LoadU(f, at + 1) - hn::LoadU(f, at - 1);
        const VF down = hn::Load(f, below.height + margin + x) - hn::Load(f, above.height + margin + x);
        VF nx, ny;
        if (part < 2) {
            const DiscPlan& disc = part == 0 ? plan.cap.disc : plan.hymenium.disc;
            const VF across = ((lane_numbers() + set(static_cast<float>(x) + 0.5F)) * set(per_x) - half) * set(1.0F / reach);
            const DiscPoint p = disc_point_of(disc, across, set((v - 0.5F) / reach));
            // Slopes along the meridian and round the axis, in true lengths; then along the tangent dP/du and across it.
            const float per_length = 0.5F / disc.per_texel;
            const float radial_unit = 1.0F / (1.0F - disc.inner);
            const VF hx = right * set(per_length);
            const VF hy = down * set(per_length);
            const VF meridian = (hx * p.cosine + hy * p.sine) * set(1.0F / radial_unit);
            const VF k = hn::Max(p.radius, set(1e-4F)) / hn::Max(p.rho, set(1e-4F)) * set(1.0F / radial_unit);
            const VF round = (hy * p.cosine - hx * p.sine) * set(1.0F / radial_unit) / hn::Max(k, set(0.02F));
            const VF ks = k * p.sine;
            const VF length = one / hn::Sqrt(p.cosine * p.cosine + ks * ks + set(1e-9F));
            nx = (ks * round - p.cosine * meridian) * length;
            ny = (ks * meridian + p.cosine * round) * length;
        } else {
            const float step_x = part == 2 ? plan.stem.texel_along : plan.veil.texel;
            const float step_y = part == 2 ? plan.stem.texel_round : plan.veil.texel;
            nx = set(0.0F) - right * set(0.5F / step_x);
            ny = down * set(0.5F / step_y);
        }
        const VF length = half / hn::Sqrt(one + nx * nx + ny * ny);
        store_byte(srgb(hn::Load(f, row.red + x)), bench.bytes[0] + x);
        store_byte(srgb(hn::Load(f, row.green + x)), bench.bytes[1] + x);
        store_byte(srgb(hn::Load(f, row.blue + x)), bench.bytes[2] + x);
        store_byte(half + nx * length, bench.bytes[3] + x);
        store_byte(half + ny * length, bench.bytes[4] + x);
        store_byte(half + length, bench.bytes[5] + x);
        store_byte(clamped(hn::Load(f, row.occlusion + x), 0.0F, 1.0F), bench.bytes[6] + x);
        store_byte(clamped(hn::Load(f, row.roughness + x), 0.04F, 1.0F), bench.bytes[7] + x);
    }
    const hn::ScalableTag<std::uint8_t> bytes;
    const std::size_t byte_lanes = hn::Lanes(bytes);
    const std::size_t at = 3 * (static_cast<std::size_t>(frame.y + y) * static_cast<std::size_t>(plan.side) + static_cast<std::size_t>(frame.x));
    std::uint8_t* const images[3] = {target.base_color + at, target.normal + at, target.orm + at};
    const auto zero = hn::Zero(bytes);
    for (std::size_t image = 0; image < 3; ++image) {
        if (width < byte_lanes) {
            for (std::size_t x = 0; x < width; ++x)
                for (std::size_t c = 0; c < 3; ++c)
                    images[image][3 * x + c] = image == 2 && c == 2 ? std::uint8_t{0} : bench.bytes[3 * image + c][x];
            continue;
        }
        for (std::size_t x = 0; x < width; x += byte_lanes) {
            const auto a = hn::LoadU(bytes, bench.bytes[3 * image] + x);
            const auto b = hn::LoadU(bytes, bench.bytes[3 * image + 1] + x);
            const auto c = image == 2 ? zero : hn::LoadU(bytes, bench.bytes[3 * image + 2] + x);
            hn::StoreInterleaved3(a, b, c, bytes, images[image] + 3 * x);
        }
    }
}

/// Paints rows `from` to `to` (exclusive) of a part's chart.
void paint_rows(const PaintPlan& plan, int part, int from, int to, void* memory, const PaintTarget& target) {
    Workbench& bench = *static_cast<Workbench*>(memory);
    const auto row = [&](int y) -> Row& { return bench.rows[(y + 3) % 3]; };
    paint_row(plan, part, from - 1, row(from - 1));
    paint_row(plan, part, from, row(from));
    for (int y = from; y < to; ++y) {
        paint_row(plan, part, y + 1, row(y + 1));
        resolve_row(plan, part, y, row(y - 1), row(y), row(y + 1), bench, target);
    }
}

std::size_t workbench_size() { return sizeof(Workbench); }

/// Samples noise over a chart's disc at (cells + 1)^2 points, two octaves.
void fill_coarse(const DiscPlan& disc, float inset, int cells, float frequency, std::uint32_t seed, float* out) {
    const Floats f;
    const std::size_t lanes = hn::Lanes(f);
    const float reach = 0.5F - inset;
    HWY_ALIGN float some[8];
    for (int j = 0; j <= cells; ++j) {
        const VF y = set((static_cast<float>(j) / static_cast<float>(cells) - 0.5F) / reach);
        for (int i = 0; i <= cells; i += static_cast<int>(lanes)) {
            const VF x = ((lane_numbers() + set(static_cast<float>(i))) * set(1.0F / static_cast<float>(cells)) - set(0.5F)) * set(1.0F / reach);
            const DiscPoint p = disc_point_of(disc, x, y);
            const VF px = p.radius * p.cosine * set(frequency);
            const VF pz = p.radius * p.sine * set(frequency);
            const VF py = p.height * set(frequency);
            const VF n = noise3(px, py, pz, seed) + noise3(px * set(2.03F), py * set(2.03F), pz * set(2.03F), seed + 7U) * set(0.5F);
            hn::Store(n, f, some);
            for (int k = 0; k < static_cast<int>(lanes) && i + k <= cells; ++k) out[j * (cells + 1) + i + k] = some[k];
        }
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace sporeprint
HWY_AFTER_NAMESPACE();

#endif
