// Lays what weather, slugs and hands have left over painted texels: cracks, furrows, pits, bites, tears, peeled skin, stains, drops,
// ink and spore dust.
#if defined(SPOREPRINT_CORE_SURFACE_SCARS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SPOREPRINT_CORE_SURFACE_SCARS_INL
#undef SPOREPRINT_CORE_SURFACE_SCARS_INL
#else
#define SPOREPRINT_CORE_SURFACE_SCARS_INL
#endif

#include "core/surface/texel.inl"

HWY_BEFORE_NAMESPACE();
namespace sporeprint {
namespace HWY_NAMESPACE {

HWY_INLINE Rgb rgb(const std::array<float, 3>& light) {
    return {set(light[0]), set(light[1]), set(light[2])};
}

/// What the scars that cross a row have done to its texels, before any colour is changed: the deepest counts, not their sum. Where all
/// are 0 a texel stays as it is, to the bit: whole vectors of such are passed over.
enum ScarPlane {
    scar_open,    ///< how much of the skin is gone, down to the flesh
    scar_sunk,    ///< height to take away, in lengths of the chart
    scar_raised,  ///< height to add
    scar_lumpy,   ///< height of lumps, below zero in hollows: their sum
    scar_shade,   ///< shade of walls and rims
    scar_stain,   ///< bruised
    scar_water,   ///< under a drop
    scar_near,  ///< crack_window less the distance from the nearest crack's middle, in its half widths
    scar_wide  ///< half width of the cracks near by, in lengths of the chart
};
inline constexpr std::size_t scar_planes = 9;
inline constexpr float crack_window = 2.5F;

struct ScarTexel {
    VF plane[scar_planes];
};

HWY_INLINE void lay_line(const Scar& scar, VF x, VF y, ScarTexel& texel) {
    const VF zero = set(0.0F), one = set(1.0F);
    const VF dx = x - set(scar.x), dy = y - set(scar.y);
    const VF ax = set(scar.along_x), ay = set(scar.along_y);
    const VF along = clamped(dx * ax + dy * ay, 0.0F, scar.length);
    const VF ex = dx - along * ax, ey = dy - along * ay;
    const VF width = set(scar.width) + set((scar.width_end - scar.width) / scar.length) * along;
    const VF far = hn::Sqrt(ex * ex + ey * ey) / width;
    // Nothing of it reaches further, so that no texel changes by whether its neighbours are passed over too.
    if (hn::AllTrue(Floats(), far >= set(crack_window + 0.5F))) return;
    const VF shown = set(scar.strength);
    if (scar.kind == ScarKind::furrow) {
        const VF valley = hn::Max(one - far * set(0.42F), zero);
        texel.plane[scar_sunk] =
            hn::Max(texel.plane[scar_sunk], valley * valley * shown * set(1.5F * scar.height));
        texel.plane[scar_shade] =
            hn::Max(texel.plane[scar_shade], valley * valley * valley * shown * set(0.8F));
        return;
    }
    const VF ragged = noise2(x * set(37.0F), y * set(37.0F), scar.seed);
    // Pieces of one crack overlap: what it looks like is worked out once, from the nearest of them.
    const VF near = hn::Max(set(crack_window) - far - ragged * set(0.30F), zero) * shown;
    texel.plane[scar_near] = hn::Max(texel.plane[scar_near], near);
    texel.plane[scar_wide] =
        hn::Max(texel.plane[scar_wide], hn::IfThenElseZero(near > zero, set(scar.height)));
}

/// Opens the skin where cracks run; elsewhere nothing changes, for a vector may hold both.
HWY_INLINE void open_cracks(ScarTexel& texel) {
    const VF zero = set(0.0F), one = set(1.0F);
    const VF far = set(crack_window) - texel.plane[scar_near];
    const VF open = one - smooth(far, 0.78F, 3.2F);
    texel.plane[scar_open] = hn::Max(texel.plane[scar_open], open);
    texel.plane[scar_sunk] =
        hn::Max(texel.plane[scar_sunk],
                (one - smooth(far, 0.25F, 1.1F)) * texel.plane[scar_wide] * set(1.5F));
    // The edges dry first and lift.
    const VF lip = hn::Max(one - hn::Abs(far - set(1.5F)) * set(1.1F), zero);
    texel.plane[scar_raised] =
        hn::Max(texel.plane[scar_raised], lip * texel.plane[scar_wide] * set(0.45F));
    const VF wall = hn::Max(one - hn::Abs(far - set(0.80F)) * set(2.3F), zero);
    texel.plane[scar_shade] =
        hn::Max(texel.plane[scar_shade], hn::Max(wall * set(0.75F), open * set(0.22F)));
}

HWY_INLINE void lay_oval(const Scar& scar, VF x, VF y, ScarTexel& texel) {
    const VF zero = set(0.0F), one = set(1.0F);
    const VF dx = x - set(scar.x), dy = y - set(scar.y);
    const VF a = (dx * set(scar.along_x) + dy * set(scar.along_y)) * set(scar.per_length);
    const VF b = (dy * set(scar.along_x) - dx * set(scar.along_y)) * set(scar.per_width);
    const VF square = a * a + b * b;
    // Beyond these nothing of an oval is left; a stain's cloud reaches furthest.
    const float end = scar.kind == ScarKind::bruise ? 2.3F : 1.6F;
    if (hn::AllTrue(Floats(), square >= set(end))) return;
    const VF shown = set(scar.strength);
    switch (scar.kind) {
        case ScarKind::pit: {
            const VF ragged = noise2(a * set(2.7F), b * set(2.7F), scar.seed);
            const VF far = hn::Sqrt(square) + ragged * set(0.10F);
            const VF open = (one - smooth(far, 0.90F, 9.0F)) * shown;
            texel.plane[scar_open] = hn::Max(texel.plane[scar_open], open);
            // Flat at the bottom, steep at the sides, with the rasp's fine scallops across it.
            const VF rasp =
                wave(a * set(4.5F) + hn::Abs(wave(b * set(1.6F))) * set(0.5F)) * set(0.11F);
            const VF floor = one - smooth(far, 0.55F, 2.6F);
            texel.plane[scar_sunk] =
                hn::Max(texel.plane[scar_sunk],
                        hn::Max(floor + rasp * open, zero) * set(scar.height) * shown);
            const VF wall = hn::Max(one - hn::Abs(far - set(0.86F)) * set(5.0F), zero);
            texel.plane[scar_shade] =
                hn::Max(texel.plane[scar_shade],
                        (wall * set(0.42F) + hn::Max(rasp, zero) * set(1.5F) * open) * shown);
            return;
        }
        case ScarKind::bruise: {
            const VF cloud = noise2(a * set(1.7F), b * set(1.7F), scar.seed) +
                             noise2(a * set(4.9F), b * set(4.9F), scar.seed + 1U) * set(0.5F);
            const VF far = hn::Sqrt(square) + cloud * set(0.42F);
            const VF stain =
                (one - smooth(far, 0.35F, 1.5F)) * shown * (one - smooth(square, 1.6F, 1.6F));
            texel.plane[scar_stain] = hn::Max(texel.plane[scar_stain], stain);
            return;
        }
        case ScarKind::drop: {
            const VF inside = hn::Max(one - square, zero);
            const VF dome = hn::Sqrt(inside);
            texel.plane[scar_raised] =
                hn::Max(texel.plane[scar_raised], dome * set(scar.height) * shown);
            texel.plane[scar_water] =
                hn::Max(texel.plane[scar_water], smooth(inside, 0.0F, 7.0F) * shown);
            const VF foot = hn::Max(one - hn::Abs(hn::Sqrt(square) - set(1.04F)) * set(5.5F), zero);
            texel.plane[scar_shade] = hn::Max(texel.plane[scar_shade], foot * shown * set(0.45F));
            return;
        }
        default: {
            const VF inside = hn::Max(one - square, zero);
            const VF dome = inside * inside * set(scar.height);
            texel.plane[scar_lumpy] = texel.plane[scar_lumpy] + dome;
            return;
        }
    }
}

// cosine, sine: of the texel's angle round the pole; inward: distance from the margin in disc radii.
HWY_INLINE void lay_margin(const Scar& scar, VF cosine, VF sine, VF inward, ScarTexel& texel) {
    const VF zero = set(0.0F), one = set(1.0F);
    const VF c = set(scar.along_x), s = set(scar.along_y);
    const VF round = sine * c - cosine * s;
    const VF ahead = cosine * c + sine * s;
    // Arc sine to third order: within half a percent over the widest scar.
    const VF angle = round * (one + round * round * set(1.0F / 6.0F));
    const VF across = hn::IfThenElse(ahead > zero, angle * set(scar.per_width), set(9.0F));
    const VF deep = inward * set(scar.per_length);
    const VF shown = set(scar.strength);
    const VF ragged =
        noise2(across * set(4.0F), deep * set(4.0F), scar.seed) * set(0.5F * scar.rim);
    if (scar.kind == ScarKind::split) {
        const VF far = hn::Abs(across) + hn::Max(deep, zero) + ragged;
        const VF open = one - smooth(far, 1.0F, 1.0F / scar.rim);
        texel.plane[scar_open] = hn::Max(texel.plane[scar_open], open * shown);
        return;
    }
    const VF inner = hn::Max(deep, zero);
    const VF round_far = hn::Sqrt(across * across + inner * inner);
    VF far = round_far + ragged;
    if (scar.kind == ScarKind::bite) {
        // Teeth scallop the edge.
        const VF teeth = wave((across - inner) * set(4.5F)) * set(0.35F * scar.rim);
        const VF open = one - smooth(far + teeth, 1.0F + 0.6F * scar.rim, 2.2F / scar.rim);
        texel.plane[scar_open] = hn::Max(texel.plane[scar_open], open * shown);
        texel.plane[scar_sunk] =
            hn::Max(texel.plane[scar_sunk], open * set(0.35F * scar.height) * shown);
        return;
    }
    // The border that tongue_ragged() tells.
    const VF inverse = one / hn::Max(round_far, set(1e-6F));
    const VF turn = turn_of(across * inverse, inner * inverse);
    far = round_far + ragged * set(0.4F) + wave(turn * set(3.0F) + set(scar.x)) * set(0.08F) +
          wave(turn * set(7.0F) + set(scar.y)) * set(0.06F) +
          wave(turn * set(15.0F) + set(scar.length)) * set(0.035F);
    const VF bare = one - smooth(far, 0.985F, 32.0F);
    texel.plane[scar_open] = hn::Max(texel.plane[scar_open], bare * shown);
    texel.plane[scar_sunk] = hn::Max(texel.plane[scar_sunk], bare * shown * set(0.012F));
    // The border is rolled back onto the skin; it shades the flesh before it.
    const VF roll = (far - set(1.0F)) * set(1.0F / scar.rim) - set(0.55F);
    const VF curl = hn::Max(one - roll * roll * set(3.0F), zero);
    texel.plane[scar_raised] =
        hn::Max(texel.plane[scar_raised], hn::Sqrt(curl) * set(0.45F * scar.height) * shown);
    const VF before = hn::Max(one - hn::Abs(roll + set(0.72F)) * set(2.4F), zero);
    const VF behind = hn::Max(one - hn::Abs(roll - set(0.75F)) * set(3.0F), zero);
    texel.plane[scar_shade] =
        hn::Max(texel.plane[scar_shade], hn::Max(before, behind * set(0.6F)) * shown);
}

/// Changes a texel by all that has been laid on it.
HWY_INLINE void show_scars(const ScarsPlan& plan, const ScarTexel& scars, VF x, VF y,
                           Texel& texel) {
    const VF one = set(1.0F);
    const VF stain = scars.plane[scar_stain];
    // A stain lets the pattern below show.
    const VF light =
        texel.colour.r * set(0.3F) + texel.colour.g * set(0.6F) + texel.colour.b * set(0.1F);
    const Rgb bruise = shaded(rgb(plan.bruise), set(0.72F) + set(0.45F) * hn::Sqrt(light));
    texel.colour = mix(texel.colour, bruise, stain * set(0.88F));
    const VF open = scars.plane[scar_open];
    const VF fibre = noise2(x * set(61.0F), y * set(61.0F), plan.seed);
    const VF cloud = noise2(x * set(13.0F), y * set(13.0F), plan.seed + 1U);
    const Rgb flesh =
        shaded(rgb(plan.flesh), one + fibre * set(0.14F) + cloud * set(0.10F) - set(0.04F));
    texel.colour = mix(texel.colour, flesh, open);
    texel.roughness = mix(texel.roughness, set(0.88F), open);
    texel.height = texel.height + scars.plane[scar_lumpy] + scars.plane[scar_raised] -
                   scars.plane[scar_sunk] + fibre * open * set(0.0016F);
    const VF shade = unit(scars.plane[scar_shade]);
    texel.occlusion = texel.occlusion * (one - set(0.55F) * shade);
    texel.colour = shaded(texel.colour, one - set(0.42F) * shade);
    const VF water = scars.plane[scar_water];
    // A drop darkens what it wets and shines.
    texel.colour = shaded(texel.colour, one - set(0.22F) * water);
    texel.roughness = mix(texel.roughness, set(0.04F), water);
    texel.occlusion = mix(texel.occlusion, one, water);
}

/// Ink and dust, which lie on whole faces. exposure: how much falls on this texel from above.
HWY_INLINE void show_dust(const ScarsPlan& plan, VF x, VF y, VF exposure, Texel& texel) {
    const VF one = set(1.0F);
    const VF coarse = noise2(x * set(9.0F), y * set(9.0F), plan.seed + 2U);
    const VF fine = noise2(x * set(74.0F), y * set(74.0F), plan.seed + 3U);
    const VF amount = set(plan.dust) * exposure;
    const VF cover = unit(amount * set(1.25F) + (fine * set(0.55F) + coarse * set(0.45F)) *
                                                    (amount * (set(1.3F) - amount) * set(1.6F)));
    texel.colour =
        mix(texel.colour, shaded(rgb(plan.dusty), one + fine * set(0.12F)), cover * set(0.92F));
    texel.roughness = mix(texel.roughness, set(0.95F), cover * set(0.8F));
    texel.height = texel.height + cover * fine * set(0.0006F);
}

/// Ink where a cap has melted; share: of the meridian, front: where it has begun to turn.
HWY_INLINE void show_ink(const ScarsPlan& plan, float front, VF share, VF uneven, Texel& texel) {
    const float amount = plan.melted;
    const VF along = share + uneven * set(0.05F);
    const float band = 0.10F + 0.22F * amount;
    const VF brown = smooth(along, front - 2.0F * band, 0.7F / band) *
                     set(amount < 0.1F ? 10.0F * amount : 1.0F);
    const VF black = smooth(along, front - 0.95F * band, 1.35F / band) *
                     set(amount < 0.1F ? 10.0F * amount : 1.0F);
    texel.colour = mix(texel.colour, {set(0.090F), set(0.062F), set(0.052F)}, brown * set(0.62F));
    texel.colour = mix(texel.colour, {set(0.0052F), set(0.0043F), set(0.0050F)}, black);
    texel.roughness = mix(texel.roughness, set(0.22F), black * set(0.85F));
}

}  // namespace HWY_NAMESPACE
}  // namespace sporeprint
HWY_AFTER_NAMESPACE();

#endif
