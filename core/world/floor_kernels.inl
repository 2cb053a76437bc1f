// The kernels that paint a floor, compiled once per instruction set: a row of soil, a stroke, a leaf, and the bytes of
// a row. As in noise.inl every operation is exact or correctly rounded, and a texel depends on no other lane.
#if defined(SPOREPRINT_CORE_WORLD_FLOOR_KERNELS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SPOREPRINT_CORE_WORLD_FLOOR_KERNELS_INL
#undef SPOREPRINT_CORE_WORLD_FLOOR_KERNELS_INL
#else
#define SPOREPRINT_CORE_WORLD_FLOOR_KERNELS_INL
#endif

#include "core/math/noise.inl"
#include "core/world/floor_texels.h"

HWY_BEFORE_NAMESPACE();
namespace sporeprint {
namespace HWY_NAMESPACE {

using Shade = std::array<float, 3>;

inline constexpr Shade soil_dark{0.20F, 0.155F, 0.12F}, soil_pale{0.37F, 0.29F, 0.215F},
    soil_sand{0.50F, 0.43F, 0.34F}, mould_dark{0.215F, 0.155F, 0.11F},
    mould_pale{0.40F, 0.285F, 0.19F}, duff_dark{0.24F, 0.165F, 0.11F},
    duff_pale{0.44F, 0.30F, 0.19F}, moss_dark{0.165F, 0.205F, 0.085F},
    moss_pale{0.42F, 0.475F, 0.20F}, moss_warm{0.05F, 0.02F, -0.01F},
    sod_dark{0.19F, 0.235F, 0.10F}, sod_pale{0.36F, 0.415F, 0.17F}, rock_dark{0.33F, 0.33F, 0.31F},
    rock_pale{0.58F, 0.57F, 0.54F}, water_shade{0.13F, 0.125F, 0.10F};

struct FloorRgb {
    VF r, g, b;
};

HWY_INLINE FloorRgb ramp(const Shade& dark, const Shade& pale, VF t) {
    return {set(dark[0]) + set(pale[0] - dark[0]) * t, set(dark[1]) + set(pale[1] - dark[1]) * t,
            set(dark[2]) + set(pale[2] - dark[2]) * t};
}

HWY_INLINE FloorRgb mix(const FloorRgb& a, const FloorRgb& b, VF t) {
    return {mix(a.r, b.r, t), mix(a.g, b.g, t), mix(a.b, b.b, t)};
}

HWY_INLINE FloorRgb mix(const FloorRgb& a, const Shade& b, VF t) {
    return {mix(a.r, set(b[0]), t), mix(a.g, set(b[1]), t), mix(a.b, set(b[2]), t)};
}

/// The gradients at the corners of the cells of a lattice that points lie in. Neighbours along a row mostly lie in one
/// cell of a broad lattice.
struct FloorCells {
    VI column, line;
    VF slope_x[4], slope_y[4];

    HWY_INLINE void find(VI u, VI v, std::uint32_t seed) {
        column = u;
        line = v;
        const VU hx0 = hn::BitCast(Words(), u) * word(prime_x);
        const VU hy0 = hn::BitCast(Words(), v) * word(prime_y) + word(seed);
        const VU hx1 = hx0 + word(prime_x);
        const VU hy1 = hy0 + word(prime_y);
        const VU corners[4] = {hn::Xor(hx0, hy0), hn::Xor(hx1, hy0), hn::Xor(hx0, hy1),
                               hn::Xor(hx1, hy1)};
        for (std::size_t i = 0; i < 4; ++i) {
            const VU h = hash(corners[i]);
            slope_x[i] = hn::ConvertTo(Floats(), hn::BitCast(Ints(), h));
            slope_y[i] = hn::ConvertTo(Floats(), hn::BitCast(Ints(), hn::ShiftLeft<16>(h)));
        }
    }
};

/// Returns gradient noise at coordinates of noise_bits bits below the cell.
///
/// is_broad  whether `cells` has those of the points before, which are those of many
HWY_INLINE VF floor_noise(VI u, VI v, std::uint32_t seed, FloorCells& cells, bool is_broad) {
    const Ints ints;
    const VI column = hn::ShiftRight<noise_bits>(u), line = hn::ShiftRight<noise_bits>(v);
    if (!is_broad ||
        !hn::AllTrue(ints, hn::And(hn::Eq(column, cells.column), hn::Eq(line, cells.line))))
        cells.find(column, line, seed);
    const VI below = hn::Set(ints, (1 << noise_bits) - 1);
    const VF per_cell = set(1.0F / static_cast<float>(1 << noise_bits));
    const VF fx = hn::ConvertTo(Floats(), hn::And(u, below)) * per_cell;
    const VF fy = hn::ConvertTo(Floats(), hn::And(v, below)) * per_cell;
    const VF gx = fx - set(1.0F);
    const VF gy = fy - set(1.0F);
    const auto at = [&](std::size_t corner, VF dx, VF dy) {
        return cells.slope_x[corner] * dx + cells.slope_y[corner] * dy;
    };
    const VF along = fade(fx);
    const VF near = mix(at(0, fx, fy), at(1, gx, fy), along);
    const VF far = mix(at(2, fx, gy), at(3, gx, gy), along);
    return mix(near, far, fade(fy)) * set(1.6F / 2147483648.0F);
}

/// Spreads a share from the nodes of the field to the columns of a row; returns whether it is above `least` anywhere.
HWY_INLINE bool spread_share(const SoilRow& soil, std::size_t share, float least, int columns) {
    const Floats f;
    const int lanes = static_cast<int>(hn::Lanes(f));
    const float* const nodes = soil.shares[share];
    float* const to = soil.between[share];
    bool is_anywhere = false;
    for (std::size_t node = 0; node < soil.nodes; ++node)
        is_anywhere = is_anywhere || nodes[node] > least;
    if (!is_anywhere) return false;
    int from = 0;
    for (std::size_t node = 0; node + 1 < soil.nodes && from < columns; ++node) {
        const int until = node + 2 < soil.nodes ? soil.columns[node] : columns;
        const VF first = set(nodes[node]), step = set(nodes[node + 1] - nodes[node]);
        // What is written beyond the last column is overwritten by that of the next node.
        for (int i = from; i < until; i += lanes)
            hn::StoreU(first + hn::LoadU(f, soil.part + i) * step, f, to + i);
        from = until > from ? until : from;
    }
    return true;
}

void paint_soil(FloorCanvas& canvas, int row, const SoilRow& soil) {
    const Floats f;
    const Ints ints;
    constexpr float least = 0.005F;
    const int columns = canvas.columns, lanes = static_cast<int>(hn::Lanes(f));
    const bool has_leaves = spread_share(soil, share_leaves, 0.0F, columns);
    const bool has_needles = spread_share(soil, share_needles, 0.0F, columns);
    const bool has_moss = spread_share(soil, share_moss, least, columns);
    const bool has_grass = spread_share(soil, share_grass, least, columns);
    const bool has_rock = spread_share(soil, share_rock, least, columns);
    const bool has_water = spread_share(soil, share_water, least, columns);
    FloorCells cells[2];
    for (std::size_t which = 0; which < 2; ++which)
        cells[which].find(hn::Zero(ints), hn::Zero(ints), soil.seeds[which]);
    for (int i = 0; i < columns; i += lanes) {
        const auto noise = [&](std::size_t which) {
            FloorCells own;
            const bool is_broad = which < 2;
            return floor_noise(hn::LoadU(ints, soil.u[which] + i) + hn::Set(ints, soil.u0[which]),
                               hn::Set(ints, soil.v0[which]) - hn::LoadU(ints, soil.v[which] + i),
                               soil.seeds[which], is_broad ? cells[which] : own, is_broad);
        };
        const auto share = [&](std::size_t which) { return hn::LoadU(f, soil.between[which] + i); };
        // Patches whose shares of the ground are about those of the cover.
        const auto patch = [&](VF of, VF waves, float edge) {
            const VF inside = set(1.25F) * of - set(0.62F) + waves;
            return hn::IfThenElseZero(of > set(least), unit(set(0.5F) + inside * set(1.0F / edge)));
        };
        const VF b = noise(noise_broad), m = noise(noise_middle), c = noise(noise_clods),
                 grain = noise(noise_crumbs), t = noise(noise_tufts);
        const VF tone = unit(set(0.5F) + set(0.55F) * c + set(0.5F) * grain + set(0.35F) * m);
        FloorRgb colour = ramp(soil_dark, soil_pale, tone);
        colour = mix(colour, soil_sand,
                     unit(set(3.0F) * (grain + set(0.4F) * c - set(0.42F))) * set(0.7F));
        VF height = set(0.004F) * c + set(0.0022F) * grain + set(0.006F) * m;
        VF roughness = set(0.93F), moss = set(0.0F), water = set(0.0F);
        {
            const VF leaves = has_leaves ? share(share_leaves) : set(0.0F);
            const VF mould = unit(set(1.4F) * leaves + set(0.25F) * b);
            colour =
                mix(colour,
                    ramp(mould_dark, mould_pale, unit(set(0.42F) + set(0.7F) * t + set(0.5F) * c)),
                    mould);
        }
        if (has_needles) {
            const VF needles = share(share_needles);
            const VF duff =
                hn::IfThenElseZero(needles > set(0.0F), unit(set(1.3F) * needles + set(0.15F) * b));
            colour = mix(
                colour,
                ramp(duff_dark, duff_pale, unit(set(0.45F) + set(0.8F) * grain + set(0.5F) * t)),
                duff);
            height = height + duff * (set(0.003F) * grain + set(0.003F) * t);
        }
        if (has_grass) {
            const VF sod = patch(share(share_grass), set(0.5F) * b + set(0.5F) * m, 0.5F);
            if (!hn::AllFalse(f, sod > set(0.0F))) {
                colour = mix(
                    colour,
                    ramp(sod_dark, sod_pale, unit(set(0.45F) + set(0.6F) * grain + set(0.6F) * c)),
                    set(0.85F) * sod);
                height = height + sod * (set(0.006F) + set(0.006F) * t);
            }
        }
        if (has_rock) {
            const VF rock = patch(share(share_rock), set(0.5F) * b + set(0.4F) * m, 0.12F);
            colour = mix(colour,
                         ramp(rock_dark, rock_pale,
                              unit(set(0.5F) + set(0.5F) * m + set(0.4F) * c + set(0.3F) * grain)),
                         rock);
            height = height + rock * (set(0.02F) + set(0.015F) * m);
        }
        if (has_moss) {
            // Moss grows as cushions: domes, with the tips of its shoots as fine grain.
            const VF of = share(share_moss);
            const VF inside =
                set(1.25F) * of - set(0.62F) + set(0.75F) * m + set(0.45F) * b + set(0.12F) * c +
                set(0.16F) * grain;
            moss =
                hn::IfThenElseZero(of > set(least), unit(set(0.5F) + inside * set(1.0F / 0.22F)));
            if (!hn::AllFalse(f, moss > set(0.0F))) {
                const VF dome = moss * hn::Sqrt(unit(set(1.4F) * inside + set(0.12F)));
                const VF shoots = unit(set(0.42F) + set(0.85F) * grain + set(0.55F) * t);
                FloorRgb green =
                    ramp(moss_dark, moss_pale, shoots * (set(0.72F) + set(0.28F) * dome));
                green.r = green.r + set(moss_warm[0]) * b;
                green.g = green.g + set(moss_warm[1]) * b;
                green.b = green.b + set(moss_warm[2]) * b;
                colour = mix(colour, green, moss);
                height = height + moss * (set(0.003F) + set(0.037F) * dome + set(0.0035F) * grain +
                                          set(0.003F) * t);
                roughness = mix(roughness, set(0.97F), moss);
            }
        }
        if (has_water) {
            water = patch(share(share_water), set(0.3F) * b, 0.15F);
            colour = mix(colour, water_shade, set(0.92F) * water);
            height = mix(height, set(-0.012F), water);
            roughness = mix(roughness, set(0.06F), water);
        }
        const VF bright = set(1.0F) + set(0.12F) * b;
        hn::StoreU(colour.r * bright, f, canvas.at(row, floor_red) + i);
        hn::StoreU(colour.g * bright, f, canvas.at(row, floor_green) + i);
        hn::StoreU(colour.b * bright, f, canvas.at(row, floor_blue) + i);
        hn::StoreU(height, f, canvas.at(row, floor_height) + i);
        hn::StoreU(roughness, f, canvas.at(row, floor_roughness) + i);
        hn::StoreU(moss, f, canvas.at(row, floor_moss) + i);
        hn::StoreU(water, f, canvas.at(row, floor_water) + i);
    }
}

/// Mixes a value into a plane.
HWY_INLINE void mix_into(float* at, VF value, VF alpha) {
    const Floats f;
    hn::StoreU(mix(hn::LoadU(f, at), value, alpha), f, at);
}

/// Returns columns less a coordinate, metres.
HWY_INLINE VF metres_from(const std::int32_t* columns, std::int32_t from) {
    const Ints ints;
    return hn::ConvertTo(Floats(), hn::LoadU(ints, columns) - hn::Set(ints, from)) *
           set(1.0F / static_cast<float>(floor_units));
}

inline float metres_between(std::int32_t from, std::int32_t to) {
    const auto units = static_cast<std::int32_t>(static_cast<std::uint32_t>(to) -
                                                 static_cast<std::uint32_t>(from));
    return static_cast<float>(units) * (1.0F / static_cast<float>(floor_units));
}

void paint_stroke(FloorCanvas& canvas, const FloorStroke& stroke) {
    const Floats f;
    const int lanes = static_cast<int>(hn::Lanes(f));
    const VF per_half = set(1.0F / stroke.half);
    // Texels beyond this squared distance are not covered.
    const float reach = stroke.half + 0.501F / stroke.per_texel, farthest = reach * reach;
    const std::size_t stride = canvas.stride;
    for (int row = stroke.range.north; row <= stroke.range.south; ++row) {
        const float dy = metres_between(stroke.y, canvas.y[row]);
        const VF t_of_row = set(dy * stroke.along_y);
        float* const first = canvas.at(row, 0);
        for (int i = stroke.range.west; i <= stroke.range.east; i += lanes) {
            const VF dx = metres_from(canvas.x + i, stroke.x);
            const VF t = unit(dx * set(stroke.along_x) + t_of_row);
            const VF px = dx - t * set(stroke.way_x);
            const VF py = set(dy) - t * set(stroke.way_y);
            const VF apart = px * px + py * py;
            if (hn::AllTrue(f, apart > set(farthest))) continue;
            const VF distance = hn::Sqrt(apart);
            const VF cover =
                unit((set(stroke.half) - distance) * set(stroke.per_texel) + set(0.5F));
            float* const at = first + i;
            const VF alpha = set(stroke.strength) * cover *
                             (set(1.0F) - set(0.85F) * hn::LoadU(f, at + floor_water * stride));
            const VF round = distance * per_half;
            const VF square = round * round;
            const VF light = set(1.05F) - set(0.3F) * square;
            mix_into(at, set(stroke.colour[0]) * light, alpha);
            mix_into(at + stride, set(stroke.colour[1]) * light, alpha);
            mix_into(at + 2 * stride, set(stroke.colour[2]) * light, alpha);
            float* const height = at + floor_height * stride;
            const VF below = hn::LoadU(f, height);
            const VF high = hn::Max(below, set(stroke.height)) +
                            set(stroke.half) * (set(0.6F) - set(0.6F) * hn::Min(set(1.0F), square));
            hn::StoreU(mix(below, high, alpha), f, height);
            mix_into(at + floor_roughness * stride, set(stroke.roughness), alpha);
        }
    }
}

void paint_leaf(FloorCanvas& canvas, const FloorLeaf& leaf) {
    const Floats f;
    const Ints ints;
    const int lanes = static_cast<int>(hn::Lanes(f));
    const std::size_t stride = canvas.stride;
    const auto columns = static_cast<float>(leaf.columns);
    const auto byte = [&](VU bits) {
        return hn::ConvertTo(Floats(), hn::BitCast(ints, hn::And(bits, word(255U))));
    };
    const VF red = set(leaf.tint[0] / 255.0F), green = set(leaf.tint[1] / 255.0F),
             blue = set(leaf.tint[2] / 255.0F);
    for (int row = leaf.range.north; row <= leaf.range.south; ++row) {
        const float dy = metres_between(leaf.y, canvas.y[row]);
        const VF along_of_row = set(dy * leaf.sine), across_of_row = set(dy * leaf.cosine);
        const VF height_of_row = set(leaf.height + leaf.slope_y * dy);
        float* const first = canvas.at(row, 0);
        for (int i = leaf.range.west; i <= leaf.range.east; i += lanes) {
            const VF dx = metres_from(canvas.x + i, leaf.x);
            const VF along = dx * set(leaf.cosine) + along_of_row;
            const VF across = across_of_row - dx * set(leaf.sine);
            const auto inside =
                hn::And(hn::Abs(along) <= set(0.5F), hn::Abs(across) <= set(leaf.half));
            if (hn::AllFalse(f, inside)) continue;
            const VI column = hn::ConvertTo(
                ints, clamped((along + set(0.5F)) * set(columns), 0.0F, columns - 1.0F));
            const VI line = hn::ConvertTo(ints, clamped((across + set(leaf.half)) * set(columns),
                                                        0.0F, static_cast<float>(leaf.rows - 1)));
            const VI index = line * hn::Set(ints, leaf.columns) + column;
            const VU texel = hn::GatherIndex(Words(), leaf.colours, index);
            const VF cover =
                hn::IfThenElseZero(inside, byte(hn::ShiftRight<24>(texel)) * set(1.0F / 255.0F));
            if (hn::AllFalse(f, cover > set(0.0F))) continue;
            float* const at = first + i;
            const VF alpha =
                cover * (set(1.0F) - set(leaf.hidden) * hn::LoadU(f, at + floor_moss * stride)) *
                (set(1.0F) - set(0.9F) * hn::LoadU(f, at + floor_water * stride));
            mix_into(at, byte(texel) * red, alpha);
            mix_into(at + stride, byte(hn::ShiftRight<8>(texel)) * green, alpha);
            mix_into(at + 2 * stride, byte(hn::ShiftRight<16>(texel)) * blue, alpha);
            float* const height = at + floor_height * stride;
            const VF below = hn::LoadU(f, height);
            const VF rise = hn::GatherIndex(f, leaf.rises, index);
            const VF high = height_of_row + set(leaf.slope_x) * dx +
                            set(leaf.length) * (rise + set(leaf.curl) * across * across);
            hn::StoreU(mix(below, hn::Max(high, below + set(0.0008F)), alpha), f, height);
            mix_into(at + floor_roughness * stride, set(0.86F), alpha);
        }
    }
}

/// Stores 0..1 as 0..255, rounded.
HWY_INLINE void store_byte(VF value, std::uint8_t* to) {
    const hn::Rebind<std::uint8_t, Floats> bytes;
    const VU whole = hn::And(whole_bits(unit(value) * set(255.0F)), word(255U));
    hn::StoreU(hn::DemoteTo(bytes, hn::BitCast(Ints(), whole)), bytes, to);
}

/// Writes three channels of a row into an image.
inline void interleave(const std::uint8_t* r, const std::uint8_t* g, const std::uint8_t* b,
                       std::size_t count, std::uint8_t* to) {
    const hn::ScalableTag<std::uint8_t> bytes;
    const std::size_t lanes = hn::Lanes(bytes);
    std::size_t i = 0;
    for (; i + lanes <= count; i += lanes)
        hn::StoreInterleaved3(hn::LoadU(bytes, r + i), hn::LoadU(bytes, g + i),
                              hn::LoadU(bytes, b + i), bytes, to + 3 * i);
    for (; i < count; ++i) {
        to[3 * i] = r[i];
        to[3 * i + 1] = g[i];
        to[3 * i + 2] = b[i];
    }
}

void finish_row(const FloorCanvas& canvas, int row, const FloorFinish& finish,
                const std::array<std::uint8_t*, 3>& images) {
    const Floats f;
    const auto lanes = hn::Lanes(f);
    const std::size_t stride = canvas.stride;
    const auto columns = static_cast<std::size_t>(canvas.columns),
               side = static_cast<std::size_t>(finish.side),
               margin = static_cast<std::size_t>(finish.margin),
               radius = static_cast<std::size_t>(finish.radius);
    const std::size_t next_row = floor_planes * stride;
    const float* const height = canvas.at(row, floor_height);
    // The sum of heights in a square, from sums along columns: each in one order at every place.
    const float* const top = height - radius * next_row;
    for (std::size_t i = 0; i < columns; i += lanes) {
        VF sum = hn::LoadU(f, top + i);
        for (std::size_t k = 1; k <= 2 * radius; ++k)
            sum = sum + hn::LoadU(f, top + k * next_row + i);
        hn::StoreU(sum, f, finish.sums + i);
    }
    const auto across = static_cast<float>(2 * finish.radius + 1);
    const VF per_place = set(1.0F / (across * across)), per_slope = set(finish.per_slope);
    const std::size_t channel = side + channel_padding;
    for (std::size_t i = 0; i < side; i += lanes) {
        const float* const here = height + margin + i;
        const VF own = hn::LoadU(f, here);
        VF mean = hn::LoadU(f, finish.sums + margin - radius + i);
        for (std::size_t k = 1; k <= 2 * radius; ++k)
            mean = mean + hn::LoadU(f, finish.sums + margin - radius + i + k);
        const VF below = mean * per_place - own;
        const VF deep = hn::Max(below, set(0.0F)), proud = hn::Max(set(0.0F) - below, set(0.0F));
        const VF open = hn::Max(set(1.0F) - set(55.0F) * deep, set(0.25F));
        const VF light = set(finish.bright) * (set(0.62F) + set(0.38F) * open) *
                         hn::Min(set(1.0F) + set(6.0F) * proud, set(1.1F));
        VF nx = (hn::LoadU(f, here - 1) - hn::LoadU(f, here + 1)) * per_slope;
        VF ny = (hn::LoadU(f, here + next_row) - hn::LoadU(f, here - next_row)) * per_slope;
        // Steeper slopes than these are the sides of pieces, which no texel resolves.
        const VF gentle = set(0.8F) / hn::Sqrt(set(1.0F) + set(0.45F) * (nx * nx + ny * ny));
        nx = nx * gentle;
        ny = ny * gentle;
        const VF length = set(0.5F) / hn::Sqrt(set(1.0F) + nx * nx + ny * ny);
        const auto plane = [&](std::size_t which) {
            return hn::LoadU(f, canvas.at(row, which) + margin + i);
        };
        std::uint8_t* const to = finish.channels + i;
        store_byte(plane(floor_red) * light, to);
        store_byte(plane(floor_green) * light, to + channel);
        store_byte(plane(floor_blue) * light, to + 2 * channel);
        store_byte(set(0.5F) + nx * length, to + 3 * channel);
        store_byte(set(0.5F) + ny * length, to + 4 * channel);
        store_byte(set(0.5F) + length, to + 5 * channel);
        store_byte(open, to + 6 * channel);
        store_byte(plane(floor_roughness) - set(finish.smoothness), to + 7 * channel);
    }
    // The ninth channel, metalness, stays zero.
    for (std::size_t image = 0; image < 3; ++image) {
        const std::uint8_t* const from = finish.channels + 3 * image * channel;
        interleave(from, from + channel, from + 2 * channel, side, images[image]);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace sporeprint
HWY_AFTER_NAMESPACE();

#endif
