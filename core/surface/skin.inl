// Texture of a skin on vectors of texels: fibres, hairs, granules or a film, a few texels in size.
#if defined(SPOREPRINT_CORE_SURFACE_SKIN_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SPOREPRINT_CORE_SURFACE_SKIN_INL
#undef SPOREPRINT_CORE_SURFACE_SKIN_INL
#else
#define SPOREPRINT_CORE_SURFACE_SKIN_INL
#endif

#include "core/surface/texel.inl"

HWY_BEFORE_NAMESPACE();
namespace sporeprint {
namespace HWY_NAMESPACE {

/// Independent noises of one place, all octaves: brightness, height, roughness and hue.
struct Grain {
    VF tone, rise, gloss, hue;

    // Not a constructor, because the compiler would build that without the instruction set.
    HWY_INLINE void begin() { tone = rise = gloss = hue = set(0.0F); }
};

/// Three gradient noises of one lattice: each multiplies the hash of a corner by its own constant.
struct GrainNoise {
    VF tone, rise, gloss;
};

/// hx0, hx1  hashes of the columns on both sides
/// fx        position between them, 0..1
/// y         position across rows
/// seed      of the lattice
HWY_INLINE GrainNoise grain_noise(VU hx0, VU hx1, VF fx, VF y, VU seed) {
    const VF y0 = hn::Floor(y);
    const VF fy = y - y0;
    const VF gx = fx - set(1.0F);
    const VF gy = fy - set(1.0F);
    const VF u = fade(fx);
    const VF v = fade(fy);
    const VU hy0 = whole_bits(y0) * word(prime_y) + seed;
    const VU hy1 = hy0 + word(prime_y);
    const VU h00 = hash(hn::Xor(hx0, hy0));
    const VU h10 = hash(hn::Xor(hx1, hy0));
    const VU h01 = hash(hn::Xor(hx0, hy1));
    const VU h11 = hash(hn::Xor(hx1, hy1));
    const auto slope = [](VU h, std::uint32_t factor, VF dx, VF dy) HWY_ATTR {
        h = h * word(factor);
        h = hn::Xor(h, hn::ShiftRight<15>(h));
        const VF sx = hn::ConvertTo(Floats(), hn::BitCast(Ints(), h));
        const VF sy = hn::ConvertTo(Floats(), hn::BitCast(Ints(), hn::ShiftLeft<16>(h)));
        return sx * dx + sy * dy;
    };
    const auto noise = [&](std::uint32_t factor) HWY_ATTR {
        const VF near = mix(slope(h00, factor, fx, fy), slope(h10, factor, gx, fy), u);
        const VF far = mix(slope(h01, factor, fx, gy), slope(h11, factor, gx, gy), u);
        return mix(near, far, v) * set(1.6F / 2147483648.0F);
    };
    return {noise(prime_x), noise(prime_z), noise(0x165667B1U)};
}

/// Returns the isotropic grain at a place of the plane, in the lengths of the chart. The lattice is
/// rotated, so that its axes are not those of the texels.
HWY_INLINE Grain plane_grain(const SkinPlan& plan, VF x, VF y) {
    Grain grain;
    grain.begin();
    for (std::size_t octave = 0; octave < 3; ++octave) {
        if (plan.weight[octave] <= 0.0F) continue;
        const VF cells = set(plan.cells[octave]);
        const VF a = (x * set(0.8290376F) + y * set(0.5591929F)) * cells;
        const VF b = (y * set(0.8290376F) - x * set(0.5591929F)) * cells;
        const VF a0 = hn::Floor(a);
        const VU ha = whole_bits(a0) * word(prime_x);
        const GrainNoise n =
            grain_noise(ha, ha + word(prime_x), a - a0, b, word(plan.seed[octave]));
        const VF weight = set(plan.weight[octave]);
        grain.tone = grain.tone + n.tone * weight;
        grain.rise = grain.rise + n.rise * set(plan.rise[octave]);
        if (octave < 2)
            grain.gloss = grain.gloss + n.gloss * weight;
        else
            grain.hue = n.gloss * weight;
    }
    return grain;
}

/// Returns the grain of fibres along the meridians of a disc. Their number round the axis is a
/// power of two that doubles outwards, so that they have about one width everywhere; where it
/// doubles, the fibres of one level fade into those of the next.
HWY_INLINE Grain meridian_grain(const SkinPlan& plan, VF rho, VF turn) {
    const VF one = set(1.0F);
    const VF round = hn::Max(rho * set(6.2831853F * plan.cells[0]), set(4.0F));
    const VF level = hn::BitCast(Floats(), hn::And(hn::BitCast(Words(), round), word(0x7F800000U)));
    const VF part = round / level - one;  // 0..1 from this level to the next
    // The bits of a number as a whole number are its logarithm, piecewise linear. On the logarithm
    // of the radius cells have one shape everywhere.
    const VI bits = hn::BitCast(Ints(), hn::BitCast(Words(), hn::Max(rho, set(1e-3F)))) -
                    hn::Set(Ints(), 0x3F800000);
    const VF outwards =
        hn::ConvertTo(Floats(), bits) * set(0.11031780F / 8388608.0F / plan.elongation);
    Grain grain;
    grain.begin();
    const VF fine = set(plan.weight[0]);
    const VF coarse = set(plan.weight[1]);
    const VF weights[3] = {fine * part, fine * (one - part) + coarse * part, coarse * (one - part)};
    const VF fine_rise = set(plan.rise[0]);
    const VF coarse_rise = set(plan.rise[1]);
    const VF rises[3] = {fine_rise * part, fine_rise * (one - part) + coarse_rise * part,
                         coarse_rise * (one - part)};
    VF count = level * set(2.0F);
    for (std::size_t i = 0; i < 3; ++i) {
        const VU mask =
            hn::BitCast(Words(), hn::ConvertTo(Ints(), count)) - word(1U);  // count: power of two
        const VF x = turn * count;
        const VF x0 = hn::Floor(x);
        const VU i0 = hn::And(whole_bits(x0), mask);
        const VU i1 = hn::And(i0 + word(1U), mask);
        const GrainNoise n =
            grain_noise(i0 * word(prime_x), i1 * word(prime_x), x - x0, outwards * count,
                        word(plan.fibre_seed) + mask * word(prime_z));
        grain.tone = grain.tone + n.tone * weights[i];
        grain.rise = grain.rise + n.rise * rises[i];
        grain.gloss = grain.gloss + n.gloss * weights[i];
        count = count * set(0.5F);
    }
    return grain;
}

/// Returns the grain round a stem. turn: 0..1 and slightly beyond; length: in circumferences
HWY_INLINE Grain stem_grain(const SkinPlan& plan, VF turn, VF length) {
    Grain grain;
    grain.begin();
    for (std::size_t octave = 0; octave < 3; ++octave) {
        if (plan.weight[octave] <= 0.0F) continue;
        const VF round = set(plan.cells[octave]);
        const VF x = turn * round;
        const VF x0 = hn::Floor(x);
        VF i0 = x0;
        i0 = i0 + hn::IfThenElseZero(i0 < set(0.0F), round);
        i0 = i0 - hn::IfThenElseZero(i0 >= round, round);
        VF i1 = i0 + set(1.0F);
        i1 = hn::IfThenZeroElse(i1 == round, i1);
        const GrainNoise n =
            grain_noise(whole_bits(i0) * word(prime_x), whole_bits(i1) * word(prime_x), x - x0,
                        length * set(plan.cells_along[octave]), word(plan.seed[octave]));
        const VF weight = set(plan.weight[octave]);
        grain.tone = grain.tone + n.tone * weight;
        grain.rise = grain.rise + n.rise * set(plan.rise[octave]);
        if (octave < 2)
            grain.gloss = grain.gloss + n.gloss * weight;
        else
            grain.hue = n.gloss * weight;
    }
    return grain;
}

/// Adds the texture of a skin to a texel; the mean colour does not change.
///
/// cloud  noise of larger scale, by which a film and powder are uneven
/// cover  factor on its strength
HWY_INLINE void add_skin(const SkinPlan& plan, const Grain& grain, VF cloud, VF cover,
                         Layers& texel) {
    const VF one = set(1.0F);
    const VF tone =
        (grain.tone + set(plan.skew) * (grain.tone * grain.tone - set(plan.tone_variance))) * cover;
    texel.shade = texel.shade * hn::Max(one + tone * set(plan.tone), set(0.2F));
    const VF hue = grain.hue * set(plan.hue);
    texel.colour.r = texel.colour.r * (one + hue);
    texel.colour.b = texel.colour.b * (one - hue);
    texel.height = texel.height + grain.rise * cover;
    texel.roughness = texel.roughness + grain.gloss * set(plan.gloss) + cloud * set(plan.film);
    if (plan.bloom <= 0.0F) return;
    constexpr float mean_powder = 0.42F;
    const VF powder = smooth(grain.tone + cloud * set(0.6F), -0.5F, 1.0F);
    const VF more = (powder - set(mean_powder)) * set(plan.bloom);
    const VF grey = texel.colour.r * set(0.2126F) + texel.colour.g * set(0.7152F) +
                    texel.colour.b * set(0.0722F);
    texel.colour = mix(texel.colour, {grey, grey, grey}, more * set(0.35F));
    texel.colour.r = hn::Max(texel.colour.r, set(0.0F));
    texel.colour.g = hn::Max(texel.colour.g, set(0.0F));
    texel.colour.b = hn::Max(texel.colour.b, set(0.0F));
    texel.shade = texel.shade * (one + more * set(0.30F));
    texel.roughness = texel.roughness + powder * set(0.15F * plan.bloom);
}

}  // namespace HWY_NAMESPACE
}  // namespace sporeprint
HWY_AFTER_NAMESPACE();

#endif
