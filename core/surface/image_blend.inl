// Blends rows of several paintings: weighted means of linear colours, of slopes and of plain
// numbers, with the lost contrast restored.
#if defined(SPOREPRINT_CORE_SURFACE_IMAGE_BLEND_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SPOREPRINT_CORE_SURFACE_IMAGE_BLEND_INL
#undef SPOREPRINT_CORE_SURFACE_IMAGE_BLEND_INL
#else
#define SPOREPRINT_CORE_SURFACE_IMAGE_BLEND_INL
#endif

#include "core/surface/rows.inl"

HWY_BEFORE_NAMESPACE();
namespace sporeprint {
namespace HWY_NAMESPACE {

/// Buffers of one row: bytes per channel, of each painting and of the result.
struct BlendBuffers {
    HWY_ALIGN std::uint8_t from[most_paintings][9][padded];
    HWY_ALIGN std::uint8_t to[9][padded];
    // For a row of the cap with patches: texels, and the slopes before patches are added.
    Row rows[3];
    HWY_ALIGN float slope[2][padded];
    float mean[blended_channels][widest / 16 + 2];  // of one row, with first and last repeated
};

/// Splits a row of RGB texels into its channels.
HWY_INLINE void split(const std::uint8_t* rgb, std::size_t width,
                      std::uint8_t (*channels)[padded]) {
    const hn::ScalableTag<std::uint8_t> bytes;
    const std::size_t lanes = hn::Lanes(bytes);
    if (width < lanes) {
        for (std::size_t x = 0; x < width; ++x)
            for (std::size_t c = 0; c < 3; ++c) channels[c][x] = rgb[3 * x + c];
        return;
    }
    for (std::size_t x = 0; x < width; x += lanes) {
        hn::Vec<decltype(bytes)> r, g, b;
        hn::LoadInterleaved3(bytes, rgb + 3 * x, r, g, b);
        hn::StoreU(r, bytes, channels[0] + x);
        hn::StoreU(g, bytes, channels[1] + x);
        hn::StoreU(b, bytes, channels[2] + x);
    }
}

HWY_INLINE VI whole(const std::uint8_t* at) {
    const hn::Rebind<std::uint8_t, Floats> bytes;
    return hn::PromoteTo(Ints(), hn::LoadU(bytes, at));
}
HWY_INLINE VF number(const std::uint8_t* at) { return hn::ConvertTo(Floats(), whole(at)); }

/// A channel of a texel: the weighted mean of the paintings, and their least and largest value.
struct BlendedChannel {
    VF mean, least, most;
    HWY_INLINE void begin() {
        mean = set(0.0F);
        least = set(1e9F);
        most = set(-1e9F);
    }
    HWY_INLINE void add(VF value, VF weight) {
        mean = mean + value * weight;
        least = hn::Min(least, value);
        most = hn::Max(most, value);
    }
    /// Returns the mean plus `surplus` times its difference from the local mean, limited smoothly
    /// to the range of the paintings: a cubic that is flat at the limit.
    HWY_INLINE VF restored(VF around, float surplus) const {
        const VF missing = (mean - around) * set(surplus);
        const auto lower = missing < set(0.0F);
        const VF headroom = hn::Max(hn::IfThenElse(lower, mean - least, most - mean), set(1e-6F));
        const VF q = hn::Min(hn::Abs(missing) / headroom, set(1.5F));
        const VF step = headroom * q * (set(1.0F) - q * q * set(4.0F / 27.0F));
        return hn::IfThenElse(lower, mean - step, mean + step);
    }
};

// Interpolates the means of cells at one row of texels.
void mean_row(const ChartBlend& chart, int cell, int y, BlendBuffers& buffers) {
    const float at = (static_cast<float>(y) + 0.5F) / static_cast<float>(cell) - 0.5F;
    const int above = at < 0.0F ? 0 : static_cast<int>(at);
    const int upper = std::min(above, chart.rows - 1);
    const int lower = std::min(above + 1, chart.rows - 1);
    const float weight = at < 0.0F ? 0.0F : at - static_cast<float>(above);
    const auto row = [&](int j) {
        return chart.means.data() + static_cast<std::size_t>(j) *
                                        static_cast<std::size_t>(chart.columns) * blended_channels;
    };
    const float* const high = row(upper);
    const float* const low = row(lower);
    const std::size_t columns = static_cast<std::size_t>(chart.columns);
    for (std::size_t c = 0; c < blended_channels; ++c) {
        for (std::size_t i = 0; i < columns; ++i) {
            const std::size_t k = i * blended_channels + c;
            buffers.mean[c][i + 1] = high[k] + (low[k] - high[k]) * weight;
        }
        buffers.mean[c][0] = buffers.mean[c][1];
        buffers.mean[c][columns + 1] = buffers.mean[c][columns];
    }
}

// Computes the heights of the patches that cross one row of the cap; the row may lie outside of it.
void patch_heights(const PaintPlan& patches, int y, Row& row) {
    const Frame& frame = patches.frames[0];
    std::fill_n(row.height, frame.width + 2 * margin, 0.0F);
    if (y < 0 || y >= frame.height) return;
    const VF down = disc_place(frame, set(static_cast<float>(y)));
    HWY_ALIGN float place[8];
    hn::Store(down, Floats(), place);
    add_patches_to_row(patches, y, down, place[0], row);
}

bool crossed(const PaintPlan& patches, int y) {
    return y >= 0 && y < patches.frames[0].height &&
           !patches.patches_by_row[static_cast<std::size_t>(y)].empty();
}

// Adds patches to a row of blended texels. `rows` hold the heights of patches above, here and
// below, the middle one also colours, roughness and occlusion; buffers.slope holds the slopes.
// Writes all channels.
void add_patches_to_blend(const PaintPlan& patches, int y, Row* const* rows,
                          BlendBuffers& buffers) {
    const Floats f;
    const Frame& frame = patches.frames[0];
    const std::size_t width = static_cast<std::size_t>(frame.width);
    patch_heights(patches, y, *rows[1]);
    const VF per_step = set(film_factor(patches) * 0.5F / patches.cap.disc.per_texel);
    const VF down_place = disc_place(frame, set(static_cast<float>(y)));
    for (std::size_t x = 0; x < width; x += hn::Lanes(f)) {
        const Texel texel = load_texel(*rows[1], x);
        const float* at = rows[1]->height + margin + x;
        const VF right = (hn::LoadU(f, at + 1) - hn::LoadU(f, at - 1)) * per_step;
        const VF down = (hn::Load(f, rows[2]->height + margin + x) -
                         hn::Load(f, rows[0]->height + margin + x)) *
                        per_step;
        const DiscPoint p = disc_point_of(
            patches.cap.disc, disc_place(frame, lane_numbers() + set(static_cast<float>(x))),
            down_place);
        const VF nx = hn::Load(f, buffers.slope[0] + x) +
                      disc_slope_x(p.cosine, p.sine, p.widening, right, down);
        const VF ny = hn::Load(f, buffers.slope[1] + x) +
                      disc_slope_y(p.cosine, p.sine, p.widening, right, down);
        store_colour(texel.colour, buffers.to, x);
        store_normal(nx, ny, buffers.to, x);
        store_byte(texel.occlusion, buffers.to[6] + x);
        store_byte(hn::Max(texel.roughness, set(0.04F)), buffers.to[7] + x);
    }
}

/// Blends a vector of texels of a row, which begins at x, into `out`: weighted means with the lost
/// contrast restored.
///
/// cell  side of the cells of local means, texels
HWY_INLINE void blend_texels(const BlendPlan& plan, const ChartBlend& chart, std::size_t cell,
                             std::size_t x, const BlendBuffers& buffers, VF* out) {
    const Floats f;
    const VF one = set(1.0F);
    BlendedChannel texel[blended_channels];
    for (BlendedChannel& channel : texel) channel.begin();
    for (std::size_t i = 0; i < plan.paintings; ++i) {
        const std::uint8_t(*const bytes)[padded] = buffers.from[i];
        const VF weight = set(plan.weights[i]);
        for (std::size_t c = 0; c < 3; ++c)
            texel[c].add(hn::GatherIndex(f, plan.linear, whole(bytes[c] + x)), weight);
        const VF nz = number(bytes[5] + x) * set(1.0F / 127.5F) - one;
        const VF per_z = one / hn::Max(nz, set(flattest_normal));
        for (std::size_t c = 3; c < 5; ++c)
            texel[c].add((number(bytes[c] + x) * set(1.0F / 127.5F) - one) * per_z, weight);
        for (std::size_t c = 5; c < 7; ++c)
            texel[c].add(number(bytes[c + 1] + x) * set(1.0F / 255.0F), weight);
    }
    // Between the centres of two cells; all lanes lie between the same two.
    const std::size_t left = (x + cell / 2) / cell;
    const VF share = (lane_numbers() + set(static_cast<float>(x + cell / 2 - left * cell) + 0.5F)) *
                     set(1.0F / static_cast<float>(cell));
    for (std::size_t c = 0; c < blended_channels; ++c) {
        const float a = buffers.mean[c][left];
        const float b = buffers.mean[c][left + 1];
        out[c] = texel[c].restored(set(a) + set(b - a) * share, chart.surplus[c]);
    }
}

/// Blends rows `from` to `to` (exclusive) of a part's chart.
void blend_rows(const BlendPlan& plan, Part part, int from, int to, void* memory,
                const PaintTarget& target) {
    BlendBuffers& buffers = *static_cast<BlendBuffers*>(memory);
    const Floats f;
    const Frame& frame = plan.frames[index_of(part)];
    const ChartBlend& chart = plan.charts[index_of(part)];
    const std::size_t width = static_cast<std::size_t>(frame.width);
    const std::size_t cell = static_cast<std::size_t>(blend_cell(plan.side));
    Row* rows[3] = {&buffers.rows[0], &buffers.rows[1], &buffers.rows[2]};
    const PaintPlan* const patches = part == Part::cap ? plan.patches : nullptr;
    if (patches) {
        std::memset(buffers.rows, 0, sizeof buffers.rows);  // not all heights are written
        patch_heights(*patches, from - 1, *rows[0]);
        patch_heights(*patches, from, *rows[1]);
    }
    for (int y = from; y < to; ++y) {
        const bool has_patches = patches && (crossed(*patches, y - 1) || crossed(*patches, y) ||
                                             crossed(*patches, y + 1));
        const std::size_t at =
            3 * (static_cast<std::size_t>(frame.y + y) * static_cast<std::size_t>(plan.side) +
                 static_cast<std::size_t>(frame.x));
        for (std::size_t i = 0; i < plan.paintings; ++i)
            for (std::size_t image = 0; image < 3; ++image)
                split(plan.images[i][image] + at, width, buffers.from[i] + 3 * image);
        mean_row(chart, static_cast<int>(cell), y, buffers);
        for (std::size_t x = 0; x < width; x += hn::Lanes(f)) {
            VF out[blended_channels];
            blend_texels(plan, chart, cell, x, buffers, out);
            const Rgb colour = {out[0], out[1], out[2]};
            if (has_patches) {
                store_texel({colour, set(0.0F), out[6], out[5]}, *rows[1], x);
                hn::Store(out[3], f, buffers.slope[0] + x);
                hn::Store(out[4], f, buffers.slope[1] + x);
                continue;
            }
            store_colour(colour, buffers.to, x);
            store_normal(out[3], out[4], buffers.to, x);
            store_byte(out[5], buffers.to[6] + x);
            store_byte(out[6], buffers.to[7] + x);
        }
        if (patches) {
            patch_heights(*patches, y + 1, *rows[2]);
            if (has_patches) add_patches_to_blend(*patches, y, rows, buffers);
            std::swap(rows[0], rows[1]);
            std::swap(rows[1], rows[2]);
        }
        interleave(buffers.to, width, at, target);
    }
}

std::size_t blend_buffers_size() { return sizeof(BlendBuffers); }

}  // namespace HWY_NAMESPACE
}  // namespace sporeprint
HWY_AFTER_NAMESPACE();

#endif
