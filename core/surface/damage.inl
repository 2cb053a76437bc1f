// Lays what weather, slugs and hands have left over painted texels: cracks, furrows, pits, bites, tears, peeled skin, stains, drops,
// ink and spore dust.
#if defined(SPOREPRINT_CORE_SURFACE_SCARS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SPOREPRINT_CORE_SURFACE_SCARS_INL
#undef SPOREPRINT_CORE_SURFACE_SCARS_INL
#else
#define SPOREPRINT_CORE_SURFACE_SCARS_INL
#endif

#include <algorithm>
#include <cmath>

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

struct ScarRow {
    HWY_ALIGN float plane[scar_planes][padded];
    HWY_ALIGN float
        ragged[padded];             ///< of the edges of cracks, where it has been asked for; else 0
    HWY_ALIGN float place[padded];  ///< along the row, in lengths of the chart
};

/// The planes of one vector of texels, loaded.
struct ScarTexel {
    VF plane[scar_planes];
};

/// The planes of one vector of texels where they lie: a scar changes few of them.
struct ScarPlace {
    ScarRow& row;
    std::size_t x;

    [[nodiscard]] HWY_INLINE VF of(ScarPlane plane) const {
        return hn::Load(Floats(), row.plane[plane] + x);
    }
    HWY_INLINE void raise(ScarPlane plane, VF value) const {
        hn::Store(hn::Max(of(plane), value), Floats(), row.plane[plane] + x);
    }
    HWY_INLINE void add(ScarPlane plane, VF value) const {
        hn::Store(of(plane) + value, Floats(), row.plane[plane] + x);
    }
    // All cracks of a chart have one seed, and their pieces overlap.
    [[nodiscard]] HWY_INLINE VF ragged(VF across, VF down, std::uint32_t seed) const {
        const Floats f;
        const VF known = hn::Load(f, row.ragged + x);
        if (hn::AllTrue(f, known != set(0.0F))) return known;
        const VF found = noise2(across * set(37.0F), down * set(37.0F), seed);
        hn::Store(found, f, row.ragged + x);
        return found;
    }
};

/// More than noise2 ever comes to, either way.
inline constexpr float most_noise = 1.61F;

HWY_INLINE bool all_at_least(VF value, VF least) { return hn::AllTrue(Floats(), value >= least); }

/// A stretch of a row, in lengths of the chart.
struct ScarSpan {
    float from, to;
};

/// Where a row meets all that a scar touches; `to` <= `from` where it does not. Beyond it the scar changes no texel, so that it does
/// not matter which texels share a vector.
///
/// whole  the places that the chart stands for: what lies beyond repeats the nearest of them, within the scar's circle
HWY_INLINE ScarSpan scar_span(const Scar& scar, float down, const ScarSpan& whole) {
    const ScarSpan circle{scar.middle_x - scar.reach, scar.middle_x + scar.reach};
    ScarSpan span = circle;
    const auto narrow = [&](float middle, float half) {
        span.from = std::max(span.from, middle - half);
        span.to = std::min(span.to, middle + half);
    };
    const float dy = down - scar.y;
    if (scar.shape == ScarShape::oval) {
        const Chord chord = chord_of(scar, dy, 1.02F * oval_window(scar.kind));
        if (chord.half <= 0.0F) return {0.0F, 0.0F};
        narrow(scar.x + chord.middle, chord.half);
    } else if (scar.shape == ScarShape::line) {
        const float half = 0.5F * scar.length;
        // From the row to the nearest point of the line's middle; what is left reaches along the row.
        const float apart =
            std::max(std::abs(down - scar.middle_y) - half * std::abs(scar.along_y), 0.0F);
        const float rest = scar.cover * scar.cover - apart * apart;
        if (rest <= 0.0F) return {0.0F, 0.0F};
        narrow(scar.middle_x, half * std::abs(scar.along_x) + std::sqrt(rest));
        narrow(scar.x + dy * scar.lean, scar.breadth);
    }
    if (span.to <= span.from) return {0.0F, 0.0F};
    if (span.to < whole.from || span.from > whole.to) return {0.0F, 0.0F};
    return {span.from <= whole.from ? circle.from : span.from,
            span.to >= whole.to ? circle.to : span.to};
}

/// How far texels are from the middle of a line, squared, and half its width beside them.
struct LinePlace {
    VF square, width;
};

HWY_INLINE LinePlace line_place(const Scar& scar, VF x, VF y) {
    const VF dx = x - set(scar.x), dy = y - set(scar.y);
    const VF ax = set(scar.along_x), ay = set(scar.along_y);
    const VF along = clamped(dx * ax + dy * ay, 0.0F, scar.length);
    const VF ex = dx - along * ax, ey = dy - along * ay;
    return {ex * ex + ey * ey, set(scar.width) + set(scar.width_grow) * along};
}

/// Whether a line leaves no trace on any of these texels.
HWY_INLINE bool beyond(const LinePlace& line, ScarKind kind) {
    const VF reach = line.width * set(1.01F * line_window(kind));
    return all_at_least(line.square, reach * reach);
}

HWY_INLINE void lay_furrow(const Scar& scar, VF x, VF y, const ScarPlace& at) {
    const LinePlace line = line_place(scar, x, y);
    if (beyond(line, ScarKind::furrow)) return;
    const VF far = hn::Sqrt(line.square) / line.width;
    const VF shown = set(scar.strength);
    const VF valley = hn::Max(set(1.0F) - far * set(0.42F), set(0.0F));
    at.raise(scar_sunk, valley * valley * shown * set(1.5F * scar.height));
    at.raise(scar_shade, valley * valley * valley * shown * set(0.8F));
}

HWY_INLINE void lay_crack(const Scar& scar, VF x, VF y, const ScarPlace& at) {
    const LinePlace line = line_place(scar, x, y);
    if (beyond(line, ScarKind::crack)) return;
    const VF far = hn::Sqrt(line.square) / line.width;
    const VF zero = set(0.0F);
    // Pieces of one crack overlap: what it looks like is worked out once, from the nearest of them.
    const VF ragged = at.ragged(x, y, scar.seed);
    const VF near =
        hn::Max(set(crack_window) - far - ragged * set(0.30F), zero) * set(scar.strength);
    at.raise(scar_near, near);
    at.raise(scar_wide, hn::IfThenElseZero(near > zero, set(scar.height)));
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

/// Where texels lie from the middle of an oval, in its half axes.
struct OvalPlace {
    VF a, b, square;
};

HWY_INLINE OvalPlace oval_place(const Scar& scar, VF x, VF y) {
    const VF dx = x - set(scar.x), dy = y - set(scar.y);
    const VF a = (dx * set(scar.along_x) + dy * set(scar.along_y)) * set(scar.per_length);
    const VF b = (dy * set(scar.along_x) - dx * set(scar.along_y)) * set(scar.per_width);
    return {a, b, a * a + b * b};
}

HWY_INLINE void lay_pit(const Scar& scar, VF x, VF y, const ScarPlace& at) {
    const OvalPlace oval = oval_place(scar, x, y);
    if (all_at_least(oval.square, set(oval_window(ScarKind::pit)))) return;
    const VF one = set(1.0F), zero = set(0.0F), shown = set(scar.strength);
    const VF ragged = noise2(oval.a * set(2.7F), oval.b * set(2.7F), scar.seed);
    const VF far = hn::Sqrt(oval.square) + ragged * set(0.10F);
    const VF open = (one - smooth(far, 0.90F, 9.0F)) * shown;
    at.raise(scar_open, open);
    // Flat at the bottom, steep at the sides, with the rasp's fine scallops across it.
    const VF rasp =
        wave(oval.a * set(4.5F) + hn::Abs(wave(oval.b * set(1.6F))) * set(0.5F)) * set(0.11F);
    const VF floor = one - smooth(far, 0.55F, 2.6F);
    at.raise(scar_sunk, hn::Max(floor + rasp * open, zero) * set(scar.height) * shown);
    const VF wall = hn::Max(one - hn::Abs(far - set(0.86F)) * set(5.0F), zero);
    at.raise(scar_shade, (wall * set(0.42F) + hn::Max(rasp, zero) * set(1.5F) * open) * shown);
}

/// Two octaves of noise, asked for texel after texel of a row.
struct NoisePair {
    NoiseCells coarse, fine;
    HWY_INLINE void begin() {
        coarse.begin();
        fine.begin();
    }
};

HWY_INLINE void lay_bruise(const Scar& scar, VF x, VF y, const ScarPlace& at, NoisePair& noise) {
    const OvalPlace oval = oval_place(scar, x, y);
    if (all_at_least(oval.square, set(oval_window(ScarKind::bruise)))) return;
    const VF one = set(1.0F), shown = set(scar.strength);
    const VF window = one - smooth(oval.square, 1.6F, 1.6F);
    // Stains overlap: where another is as dark as this one could be, its cloud need not be known.
    if (all_at_least(at.of(scar_stain), shown * window)) return;
    const VF coarse = noise2(oval.a * set(1.7F), oval.b * set(1.7F), scar.seed, noise.coarse);
    const VF round_far = hn::Sqrt(oval.square);
    constexpr float beyond = 0.35F + 1.0F / 1.5F + 0.01F + 0.42F * 0.5F * most_noise;
    if (all_at_least(round_far + coarse * set(0.42F), set(beyond))) return;
    const VF cloud =
        coarse +
        noise2(oval.a * set(4.9F), oval.b * set(4.9F), scar.seed + 1U, noise.fine) * set(0.5F);
    const VF far = round_far + cloud * set(0.42F);
    at.raise(scar_stain, (one - smooth(far, 0.35F, 1.5F)) * shown * window);
}

HWY_INLINE void lay_drop(const Scar& scar, VF x, VF y, const ScarPlace& at) {
    const OvalPlace oval = oval_place(scar, x, y);
    if (all_at_least(oval.square, set(oval_window(ScarKind::drop)))) return;
    const VF one = set(1.0F), zero = set(0.0F), shown = set(scar.strength);
    const VF inside = hn::Max(one - oval.square, zero);
    const VF dome = hn::Sqrt(inside);
    at.raise(scar_raised, dome * set(scar.height) * shown);
    at.raise(scar_water, smooth(inside, 0.0F, 7.0F) * shown);
    const VF foot = hn::Max(one - hn::Abs(hn::Sqrt(oval.square) - set(1.04F)) * set(5.5F), zero);
    at.raise(scar_shade, foot * shown * set(0.45F));
}

HWY_INLINE void lay_lump(const Scar& scar, VF x, VF y, const ScarPlace& at) {
    const OvalPlace oval = oval_place(scar, x, y);
    const VF inside = hn::Max(set(1.0F) - oval.square, set(0.0F));
    at.add(scar_lumpy, inside * inside * set(scar.height));
}

/// Between which distances from the middle of a scar of the margin its border runs: all is open before, and nothing changes beyond.
struct MarginBorder {
    float from, until;
};

HWY_INLINE MarginBorder margin_border(const Scar& scar) {
    constexpr float slack = 0.002F;
    const float stray = 0.5F * most_noise * scar.rim + slack;
    switch (scar.kind) {
        case ScarKind::split:
            return {1.0F - stray, 1.0F + scar.rim + stray};
        case ScarKind::bite:
            return {1.0F + 0.25F * scar.rim - stray, 1.0F + 1.41F * scar.rim + stray};
        default: {
            // Waves of the border, and the roll of skin and its shade to both sides.
            const float waves = 0.08F + 0.06F + 0.035F + 0.4F * stray + slack;
            return {std::min(0.985F, 1.0F - 0.59F * scar.rim) - waves,
                    std::max(1.017F, 1.0F + 1.64F * scar.rim) + waves};
        }
    }
}

// cosine, sine: of the texel's angle round the pole; inward: distance from the margin in disc radii.
HWY_INLINE void lay_margin(const Scar& scar, VF cosine, VF sine, VF inward, const ScarPlace& at) {
    const VF zero = set(0.0F), one = set(1.0F);
    const VF c = set(scar.along_x), s = set(scar.along_y);
    const VF round = sine * c - cosine * s;
    const VF ahead = cosine * c + sine * s;
    // Arc sine to third order: within half a percent over the widest scar.
    const VF angle = round * (one + round * round * set(1.0F / 6.0F));
    const VF across = hn::IfThenElse(ahead > zero, angle * set(scar.per_width), set(9.0F));
    const VF deep = inward * set(scar.per_length);
    const VF shown = set(scar.strength);
    const VF inner = hn::Max(deep, zero);
    const VF round_far = scar.kind == ScarKind::split ? hn::Abs(across) + inner
                                                      : hn::Sqrt(across * across + inner * inner);
    // Only near the border does it matter how ragged that is.
    const MarginBorder border = margin_border(scar);
    if (all_at_least(round_far, set(border.until))) return;
    if (all_at_least(set(border.from), round_far)) {
        at.raise(scar_open, shown);
        if (scar.kind != ScarKind::split)
            at.raise(scar_sunk, scar.kind == ScarKind::bite ? set(0.35F * scar.height) * shown
                                                            : shown * set(0.012F));
        return;
    }
    const VF ragged =
        noise2(across * set(4.0F), deep * set(4.0F), scar.seed) * set(0.5F * scar.rim);
    VF far = round_far + ragged;
    if (scar.kind == ScarKind::split) {
        const VF open = one - smooth(far, 1.0F, 1.0F / scar.rim);
        at.raise(scar_open, open * shown);
        return;
    }
    if (scar.kind == ScarKind::bite) {
        // Teeth scallop the edge.
        const VF teeth = wave((across - inner) * set(4.5F)) * set(0.35F * scar.rim);
        const VF open = one - smooth(far + teeth, 1.0F + 0.6F * scar.rim, 2.2F / scar.rim);
        at.raise(scar_open, open * shown);
        at.raise(scar_sunk, open * set(0.35F * scar.height) * shown);
        return;
    }
    // The border that tongue_ragged() tells.
    const VF inverse = one / hn::Max(round_far, set(1e-6F));
    const VF turn = turn_of(across * inverse, inner * inverse);
    far = round_far + ragged * set(0.4F) + wave(turn * set(3.0F) + set(scar.x)) * set(0.08F) +
          wave(turn * set(7.0F) + set(scar.y)) * set(0.06F) +
          wave(turn * set(15.0F) + set(scar.length)) * set(0.035F);
    const VF bare = one - smooth(far, 0.985F, 32.0F);
    at.raise(scar_open, bare * shown);
    at.raise(scar_sunk, bare * shown * set(0.012F));
    // The border is rolled back onto the skin; it shades the flesh before it.
    const VF roll = (far - set(1.0F)) * set(1.0F / scar.rim) - set(0.55F);
    const VF curl = hn::Max(one - roll * roll * set(3.0F), zero);
    at.raise(scar_raised, hn::Sqrt(curl) * set(0.45F * scar.height) * shown);
    const VF before = hn::Max(one - hn::Abs(roll + set(0.72F)) * set(2.4F), zero);
    const VF behind = hn::Max(one - hn::Abs(roll - set(0.75F)) * set(3.0F), zero);
    at.raise(scar_shade, hn::Max(before, behind * set(0.6F)) * shown);
}

/// Changes a texel by all that has been laid on it.
HWY_INLINE void show_scars(const ScarsPlan& plan, const ScarTexel& scars, VF x, VF y,
                           NoisePair& noise, Texel& texel) {
    const VF one = set(1.0F), zero = set(0.0F);
    const VF stain = scars.plane[scar_stain];
    const VF open = scars.plane[scar_open];
    const VF shade = unit(scars.plane[scar_shade]);
    const VF water = scars.plane[scar_water];
    // What is nowhere in a vector changes none of its texels, to the bit, and is passed over.
    if (!all_at_least(zero, stain)) {
        // A stain lets the pattern below show.
        const VF light =
            texel.colour.r * set(0.3F) + texel.colour.g * set(0.6F) + texel.colour.b * set(0.1F);
        const Rgb bruise = shaded(rgb(plan.bruise), set(0.72F) + set(0.45F) * hn::Sqrt(light));
        texel.colour = mix(texel.colour, bruise, stain * set(0.88F));
    }
    texel.height =
        texel.height + scars.plane[scar_lumpy] + scars.plane[scar_raised] - scars.plane[scar_sunk];
    if (!all_at_least(zero, open)) {
        const VF fibre = noise2(x * set(61.0F), y * set(61.0F), plan.seed, noise.fine);
        const VF cloud = noise2(x * set(13.0F), y * set(13.0F), plan.seed + 1U, noise.coarse);
        const Rgb flesh =
            shaded(rgb(plan.flesh), one + fibre * set(0.14F) + cloud * set(0.10F) - set(0.04F));
        texel.colour = mix(texel.colour, flesh, open);
        texel.roughness = mix(texel.roughness, set(0.88F), open);
        texel.height = texel.height + fibre * open * set(0.0016F);
    }
    if (!all_at_least(zero, shade)) {
        texel.occlusion = texel.occlusion * (one - set(0.55F) * shade);
        texel.colour = shaded(texel.colour, one - set(0.42F) * shade);
    }
    if (!all_at_least(zero, water)) {
        // A drop darkens what it wets and shines.
        texel.colour = shaded(texel.colour, one - set(0.22F) * water);
        texel.roughness = mix(texel.roughness, set(0.04F), water);
        texel.occlusion = mix(texel.occlusion, one, water);
    }
}

/// Ink and dust, which lie on whole faces. exposure: how much falls on this texel from above.
HWY_INLINE void show_dust(const ScarsPlan& plan, VF x, VF y, VF exposure, NoisePair& noise,
                          Texel& texel) {
    const VF one = set(1.0F);
    const VF coarse = noise2(x * set(9.0F), y * set(9.0F), plan.seed + 2U, noise.coarse);
    const VF fine = noise2(x * set(74.0F), y * set(74.0F), plan.seed + 3U, noise.fine);
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
