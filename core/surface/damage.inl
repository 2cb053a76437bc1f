// Draws damage over painted texels: cracks, furrows, pits, bites, tears, peeled cuticle, bruises,
// drops, ink and spore dust.
#if defined(SPOREPRINT_CORE_SURFACE_DAMAGE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SPOREPRINT_CORE_SURFACE_DAMAGE_INL
#undef SPOREPRINT_CORE_SURFACE_DAMAGE_INL
#else
#define SPOREPRINT_CORE_SURFACE_DAMAGE_INL
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

/// Planes that collect the damage of a row before colours are changed. Overlapping marks combine by
/// maximum, not sum. Where all planes are 0 a texel keeps its exact value, so vectors of such
/// texels are skipped.
enum DamagePlane {
    damage_open,        ///< how much of the cuticle is removed, down to the flesh
    damage_sunk,        ///< height to subtract, relative to the chart
    damage_raised,      ///< height to add
    damage_lumps,       ///< sum of heights of lumps, negative in hollows
    damage_shade,       ///< shade of walls and rims
    damage_stain,       ///< bruised
    damage_water,       ///< under a drop
    damage_near_crack,  ///< crack_window minus the distance to the nearest crack, in half widths
    damage_crack_width  ///< half width of nearby cracks, relative to the chart
};
inline constexpr std::size_t damage_planes = 9;
inline constexpr float crack_window = 2.5F;

struct DamageRow {
    HWY_ALIGN float plane[damage_planes][padded];
    HWY_ALIGN float ragged[padded];  ///< noise of the edges of cracks, once computed; otherwise 0
    HWY_ALIGN float place[padded];   ///< position along the row, relative to the chart
};

/// The planes of one vector of texels, loaded into registers.
struct DamageTexel {
    VF plane[damage_planes];
};

/// The planes of one vector of texels in memory, because a mark changes only a few of them.
struct DamageTarget {
    DamageRow& row;
    std::size_t x;

    [[nodiscard]] HWY_INLINE VF of(DamagePlane plane) const {
        return hn::Load(Floats(), row.plane[plane] + x);
    }
    HWY_INLINE void raise(DamagePlane plane, VF value) const {
        hn::Store(hn::Max(of(plane), value), Floats(), row.plane[plane] + x);
    }
    HWY_INLINE void add(DamagePlane plane, VF value) const {
        hn::Store(of(plane) + value, Floats(), row.plane[plane] + x);
    }
    // All cracks of a chart share one seed, and their pieces overlap, so the noise is computed
    // once.
    [[nodiscard]] HWY_INLINE VF ragged(VF across, VF down, std::uint32_t seed) const {
        const Floats f;
        const VF known = hn::Load(f, row.ragged + x);
        if (hn::AllTrue(f, known != set(0.0F))) return known;
        const VF found = noise2(across * set(37.0F), down * set(37.0F), seed);
        hn::Store(found, f, row.ragged + x);
        return found;
    }
};

/// Upper bound of |noise2|.
inline constexpr float most_noise = 1.61F;

HWY_INLINE bool all_at_least(VF value, VF least) { return hn::AllTrue(Floats(), value >= least); }

/// An interval of a row, relative to the chart.
struct RowSpan {
    float from, to;
};

/// Returns the interval of a row that a mark may change; `to` <= `from` if none. Outside it the
/// mark changes no texel, so that the result does not depend on how texels are grouped into
/// vectors.
///
/// whole  interval that the chart represents; texels beyond it repeat the nearest place, within the
///        bounding circle
HWY_INLINE RowSpan damage_span(const SpotPlan& spot, float down, const RowSpan& whole) {
    const RowSpan circle{spot.middle_x - spot.reach, spot.middle_x + spot.reach};
    RowSpan span = circle;
    const auto narrow = [&](float middle, float half) {
        span.from = std::max(span.from, middle - half);
        span.to = std::min(span.to, middle + half);
    };
    const float dy = down - spot.y;
    if (spot.shape == DamageShape::oval) {
        const Chord chord = chord_of(spot, dy, 1.02F * oval_window(spot.kind));
        if (chord.half <= 0.0F) return {0.0F, 0.0F};
        narrow(spot.x + chord.middle, chord.half);
    } else if (spot.shape == DamageShape::line) {
        const float half = 0.5F * spot.length;
        // Distance from the row to the nearest point of the line; the remainder of the radius is
        // its extent along the row.
        const float apart =
            std::max(std::abs(down - spot.middle_y) - half * std::abs(spot.along_y), 0.0F);
        const float rest = spot.cover * spot.cover - apart * apart;
        if (rest <= 0.0F) return {0.0F, 0.0F};
        narrow(spot.middle_x, half * std::abs(spot.along_x) + std::sqrt(rest));
        narrow(spot.x + dy * spot.lean, spot.breadth);
    }
    if (span.to <= span.from) return {0.0F, 0.0F};
    if (span.to < whole.from || span.from > whole.to) return {0.0F, 0.0F};
    return {span.from <= whole.from ? circle.from : span.from,
            span.to >= whole.to ? circle.to : span.to};
}

/// Squared distance of texels from the middle of a line, and half its width there.
struct LinePlace {
    VF square, width;
};

HWY_INLINE LinePlace line_place(const SpotPlan& spot, VF x, VF y) {
    const VF dx = x - set(spot.x), dy = y - set(spot.y);
    const VF ax = set(spot.along_x), ay = set(spot.along_y);
    const VF along = clamped(dx * ax + dy * ay, 0.0F, spot.length);
    const VF ex = dx - along * ax, ey = dy - along * ay;
    return {ex * ex + ey * ey, set(spot.width) + set(spot.width_grow) * along};
}

/// Returns true when a line changes none of these texels.
HWY_INLINE bool beyond(const LinePlace& line, DamageKind kind) {
    const VF reach = line.width * set(1.01F * line_window(kind));
    return all_at_least(line.square, reach * reach);
}

HWY_INLINE void add_furrow(const SpotPlan& spot, VF x, VF y, const DamageTarget& at) {
    const LinePlace line = line_place(spot, x, y);
    if (beyond(line, DamageKind::furrow)) return;
    const VF far = hn::Sqrt(line.square) / line.width;
    const VF shown = set(spot.strength);
    const VF valley = hn::Max(set(1.0F) - far * set(0.42F), set(0.0F));
    at.raise(damage_sunk, valley * valley * shown * set(1.5F * spot.height));
    at.raise(damage_shade, valley * valley * valley * shown * set(0.8F));
}

HWY_INLINE void add_crack(const SpotPlan& spot, VF x, VF y, const DamageTarget& at) {
    const LinePlace line = line_place(spot, x, y);
    if (beyond(line, DamageKind::crack)) return;
    const VF far = hn::Sqrt(line.square) / line.width;
    const VF zero = set(0.0F);
    // Pieces of one crack overlap, so its appearance is computed once, from the nearest piece.
    const VF ragged = at.ragged(x, y, spot.seed);
    const VF near =
        hn::Max(set(crack_window) - far - ragged * set(0.52F), zero) * set(spot.strength);
    at.raise(damage_near_crack, near);
    at.raise(damage_crack_width, hn::IfThenElseZero(near > zero, set(spot.height)));
}

/// Opens the cuticle along cracks. Texels without cracks are unchanged, because a vector may hold
/// both.
HWY_INLINE void open_cracks(DamageTexel& texel) {
    const VF zero = set(0.0F), one = set(1.0F);
    const VF far = set(crack_window) - texel.plane[damage_near_crack];
    const VF open = one - smooth(far, 0.78F, 3.2F);
    texel.plane[damage_open] = hn::Max(texel.plane[damage_open], open);
    texel.plane[damage_sunk] =
        hn::Max(texel.plane[damage_sunk],
                (one - smooth(far, 0.25F, 1.1F)) * texel.plane[damage_crack_width] * set(1.5F));
    // Edges of cracks dry first and lift.
    const VF lip = hn::Max(one - hn::Abs(far - set(1.5F)) * set(1.1F), zero);
    texel.plane[damage_raised] =
        hn::Max(texel.plane[damage_raised], lip * texel.plane[damage_crack_width] * set(0.16F));
    const VF wall = hn::Max(one - hn::Abs(far - set(0.80F)) * set(2.3F), zero);
    texel.plane[damage_shade] =
        hn::Max(texel.plane[damage_shade], hn::Max(wall * set(0.35F), open * set(0.30F)));
}

/// Position of texels relative to an oval, in its half axes.
struct OvalPlace {
    VF a, b, square;
};

HWY_INLINE OvalPlace oval_place(const SpotPlan& spot, VF x, VF y) {
    const VF dx = x - set(spot.x), dy = y - set(spot.y);
    const VF a = (dx * set(spot.along_x) + dy * set(spot.along_y)) * set(spot.per_length);
    const VF b = (dy * set(spot.along_x) - dx * set(spot.along_y)) * set(spot.per_width);
    return {a, b, a * a + b * b};
}

HWY_INLINE void add_pit(const SpotPlan& spot, VF x, VF y, const DamageTarget& at) {
    const OvalPlace oval = oval_place(spot, x, y);
    if (all_at_least(oval.square, set(oval_window(DamageKind::pit)))) return;
    const VF one = set(1.0F), zero = set(0.0F), shown = set(spot.strength);
    // A patch is scraped in several strokes, so that its outline has lobes and bays.
    const VF ragged = noise2(oval.a * set(1.9F), oval.b * set(1.9F), spot.seed);
    const VF lobes = noise2(oval.a * set(5.3F), oval.b * set(5.3F), spot.seed + 3U);
    const VF window = one - smooth(oval.square, 1.55F, 1.0F / 0.7F);
    const VF far =
        mix(set(1.5F),
            hn::Sqrt(oval.square) + ragged * set(0.42F) + lobes * set(0.20F) + set(0.12F), window);
    const VF open = (one - smooth(far, 0.86F, 4.5F)) * shown;
    at.raise(damage_open, open);
    // The pit is flat at the bottom and steep at the sides, with shallow marks of the radula, which
    // scrapes along its short axis.
    const VF gnawed = noise2(oval.a * set(9.0F), oval.b * set(3.5F), spot.seed + 1U);
    const VF crumbs = noise2(oval.a * set(17.0F), oval.b * set(13.0F), spot.seed + 2U);
    const VF rasp = gnawed * set(0.11F) + crumbs * set(0.07F);
    const VF floor = one - smooth(far, 0.55F, 2.6F);
    at.raise(damage_sunk, hn::Max(floor + rasp * open, zero) * set(spot.height) * shown);
    // The rim is steep on one side and runs out on the other.
    const VF steep = unit(set(0.45F) + lobes * set(0.9F));
    const VF wall = hn::Max(one - hn::Abs(far - set(0.82F)) * set(4.0F), zero) * steep;
    at.raise(damage_shade, (wall * set(0.20F) + hn::Max(rasp, zero) * set(1.5F) * open) * shown);
    // Flesh that has been open for some hours is discoloured in clouds, and here and there at its rim.
    const VF rim = hn::Max(one - hn::Abs(far - set(0.82F)) * set(2.6F), zero) *
                   unit(ragged * set(1.4F) + set(0.1F));
    at.raise(damage_stain,
             unit(hn::Max(rim * set(0.6F), open * (set(0.3F) + ragged * set(0.45F)))) * shown);
}

/// Two octaves of noise with cached lattice cells, evaluated texel after texel of a row.
struct NoisePair {
    NoiseCells coarse, fine;
    HWY_INLINE void begin() {
        coarse.begin();
        fine.begin();
    }
};

HWY_INLINE void add_bruise(const SpotPlan& spot, VF x, VF y, const DamageTarget& at,
                           NoisePair& noise) {
    const OvalPlace oval = oval_place(spot, x, y);
    if (all_at_least(oval.square, set(oval_window(DamageKind::bruise)))) return;
    const VF one = set(1.0F), shown = set(spot.strength);
    const VF window = one - smooth(oval.square, 1.6F, 1.6F);
    // Bruises overlap: where another is already as dark as this one could be, its noise need not be
    // computed.
    if (all_at_least(at.of(damage_stain), shown * window)) return;
    const VF coarse = noise2(oval.a * set(1.7F), oval.b * set(1.7F), spot.seed, noise.coarse);
    const VF round_far = hn::Sqrt(oval.square);
    constexpr float beyond = 0.35F + 1.0F / 1.5F + 0.01F + 0.42F * 0.5F * most_noise;
    if (all_at_least(round_far + coarse * set(0.42F), set(beyond))) return;
    const VF cloud =
        coarse +
        noise2(oval.a * set(4.9F), oval.b * set(4.9F), spot.seed + 1U, noise.fine) * set(0.5F);
    const VF far = round_far + cloud * set(0.42F);
    at.raise(damage_stain, (one - smooth(far, 0.35F, 1.5F)) * shown * window);
}

HWY_INLINE void add_drop(const SpotPlan& spot, VF x, VF y, const DamageTarget& at) {
    const OvalPlace oval = oval_place(spot, x, y);
    if (all_at_least(oval.square, set(oval_window(DamageKind::drop)))) return;
    const VF one = set(1.0F), zero = set(0.0F), shown = set(spot.strength);
    const VF inside = hn::Max(one - oval.square, zero);
    const VF dome = hn::Sqrt(inside);
    at.raise(damage_raised, dome * set(spot.height) * shown);
    at.raise(damage_water, smooth(inside, 0.0F, 7.0F) * shown);
    const VF foot = hn::Max(one - hn::Abs(hn::Sqrt(oval.square) - set(1.04F)) * set(5.5F), zero);
    at.raise(damage_shade, foot * shown * set(0.45F));
}

HWY_INLINE void add_lump(const SpotPlan& spot, VF x, VF y, const DamageTarget& at) {
    const OvalPlace oval = oval_place(spot, x, y);
    const VF inside = hn::Max(set(1.0F) - oval.square, set(0.0F));
    at.add(damage_lumps, inside * inside * set(spot.height));
}

/// Interval of distances from the centre of a margin mark in which its border lies: everything is
/// open before it, and nothing changes beyond.
struct MarginBorder {
    float from, until;
};

HWY_INLINE MarginBorder margin_border(const SpotPlan& spot) {
    constexpr float slack = 0.002F;
    const float stray = 0.5F * most_noise * spot.rim + slack;
    switch (spot.kind) {
        case DamageKind::split:
            return {1.0F - stray, 1.0F + spot.rim + stray};
        case DamageKind::bite:
            // The flesh is discoloured at both sides of the border.
            return {1.0F - 0.21F * spot.rim - stray, 1.0F + 1.41F * spot.rim + stray};
        default: {
            // Waves of the border, and the roll of cuticle and its shade on both sides.
            const float waves = 0.08F + 0.06F + 0.035F + 0.4F * stray + slack;
            return {std::min(0.985F, 1.0F - 0.59F * spot.rim) - waves,
                    std::max(1.017F, 1.0F + 1.64F * spot.rim) + waves};
        }
    }
}

/// Returns how much less deep than its tip a split is at a distance from the tip in widths of its lip:
/// the inverse of lip_power in core/individual/damage.h.
HWY_INLINE VF lip_depth(VF across) {
    const VF root = hn::Sqrt(hn::Abs(across));
    return root * hn::Sqrt(root);
}

// cosine, sine: of the texel's angle about the pole; inward: distance from the margin in disc
// radii.
HWY_INLINE void add_margin(const SpotPlan& spot, VF cosine, VF sine, VF inward,
                           const DamageTarget& at) {
    const VF zero = set(0.0F), one = set(1.0F);
    const VF c = set(spot.along_x), s = set(spot.along_y);
    const VF round = sine * c - cosine * s;
    const VF ahead = cosine * c + sine * s;
    // Arc sine to third order: within 0.5 % over the widest mark.
    const VF angle = round * (one + round * round * set(1.0F / 6.0F));
    const bool split = spot.kind == DamageKind::split;
    const VF per_width = split ? hn::IfThenElse(angle < zero, set(spot.x), set(spot.per_width))
                               : set(spot.per_width);
    const VF across = hn::IfThenElse(ahead > zero, angle * per_width, set(9.0F));
    const VF deep = inward * set(spot.per_length);
    const VF shown = set(spot.strength);
    const VF inner = hn::Max(deep, zero);
    const VF round_far =
        split ? lip_depth(across) + inner : hn::Sqrt(across * across + inner * inner);
    // The noise of the border is needed only near the border.
    const MarginBorder border = margin_border(spot);
    if (all_at_least(round_far, set(border.until))) return;
    if (all_at_least(set(border.from), round_far)) {
        at.raise(damage_open, shown);
        if (!split)
            at.raise(damage_sunk, spot.kind == DamageKind::bite ? set(0.35F * spot.height) * shown
                                                                : shown * set(0.012F));
        return;
    }
    const VF ragged =
        noise2(across * set(4.0F), deep * set(4.0F), spot.seed) * set(0.5F * spot.rim);
    VF far = round_far + ragged;
    if (split) {
        const VF open = one - smooth(far, 1.0F, 1.0F / spot.rim);
        at.raise(damage_open, open * shown);
        return;
    }
    if (spot.kind == DamageKind::bite) {
        // A slug scallops the edge, here deep and wide, there hardly at all.
        const VF place = across - inner;
        const VF warp = noise2(place * set(2.1F), set(0.5F), spot.seed + 1U);
        const VF bold = noise2(place * set(2.9F), set(3.5F), spot.seed + 2U);
        const VF teeth = wave(place * set(2.6F) + warp * set(0.8F)) *
                         unit(set(0.45F) + bold * set(0.9F)) * set(0.35F * spot.rim);
        const VF open = one - smooth(far + teeth, 1.0F + 0.6F * spot.rim, 2.2F / spot.rim);
        at.raise(damage_open, open * shown);
        at.raise(damage_sunk, open * set(0.35F * spot.height) * shown);
        const VF rim = hn::Max(
            one - hn::Abs(far + teeth - set(1.0F + 0.6F * spot.rim)) * set(2.2F / spot.rim), zero);
        at.raise(damage_stain, rim * unit(set(0.25F) + bold * set(0.6F)) * shown);
        return;
    }
    // Same border as tongue_ragged() in core/individual/damage.h.
    const VF inverse = one / hn::Max(round_far, set(1e-6F));
    const VF turn = turn_of(across * inverse, inner * inverse);
    far = round_far + ragged * set(0.4F) + wave(turn * set(3.0F) + set(spot.x)) * set(0.08F) +
          wave(turn * set(7.0F) + set(spot.y)) * set(0.06F) +
          wave(turn * set(15.0F) + set(spot.length)) * set(0.035F);
    const VF bare = one - smooth(far, 0.985F, 32.0F);
    at.raise(damage_open, bare * shown);
    at.raise(damage_sunk, bare * shown * set(0.012F));
    // The border is rolled back onto the cuticle, and shades the flesh in front of it.
    const VF roll = (far - set(1.0F)) * set(1.0F / spot.rim) - set(0.55F);
    const VF curl = hn::Max(one - roll * roll * set(3.0F), zero);
    at.raise(damage_raised, hn::Sqrt(curl) * set(0.45F * spot.height) * shown);
    const VF before = hn::Max(one - hn::Abs(roll + set(0.72F)) * set(2.4F), zero);
    const VF behind = hn::Max(one - hn::Abs(roll - set(0.75F)) * set(3.0F), zero);
    at.raise(damage_shade, hn::Max(before * set(0.65F), behind * set(0.35F)) * shown);
}

/// Applies the collected damage to a texel.
HWY_INLINE void show_damage(const DamagePlan& plan, const DamageTexel& damage, VF x, VF y,
                            NoisePair& noise, Texel& texel) {
    const VF one = set(1.0F), zero = set(0.0F);
    const VF stain = damage.plane[damage_stain];
    const VF open = damage.plane[damage_open];
    const VF shade = unit(damage.plane[damage_shade]);
    const VF water = damage.plane[damage_water];
    // Each effect is skipped when it is 0 in the whole vector, which keeps texels bit-identical.
    const bool stained = !all_at_least(zero, stain);
    if (stained) {
        // A bruise lets the pattern below show through.
        const VF light =
            texel.colour.r * set(0.3F) + texel.colour.g * set(0.6F) + texel.colour.b * set(0.1F);
        const Rgb bruise = shaded(rgb(plan.bruise), set(0.72F) + set(0.45F) * hn::Sqrt(light));
        texel.colour = mix(texel.colour, bruise, stain * set(0.88F));
    }
    texel.height = texel.height + damage.plane[damage_lumps] + damage.plane[damage_raised] -
                   damage.plane[damage_sunk];
    if (!all_at_least(zero, open)) {
        const VF fibre = noise2(x * set(61.0F), y * set(61.0F), plan.seed, noise.fine);
        const VF cloud = noise2(x * set(13.0F), y * set(13.0F), plan.seed + 1U, noise.coarse);
        // Open flesh dries, and takes on the colour of the skin in cloudy patches.
        const VF dry = unit(set(0.50F) + cloud * set(0.26F));
        Rgb flesh =
            shaded(rgb(plan.flesh), one + fibre * set(0.14F) + cloud * set(0.06F) - set(0.04F));
        flesh = dried(flesh, dry);
        flesh = mix(flesh, texel.colour, set(0.30F));
        if (stained) flesh = mix(flesh, rgb(plan.bruise), stain * set(0.75F));
        texel.colour = mix(texel.colour, flesh, open);
        texel.roughness = mix(texel.roughness, set(0.88F), open);
        texel.height = texel.height + fibre * open * set(0.0016F);
    }
    if (!all_at_least(zero, shade)) {
        texel.occlusion = texel.occlusion * (one - set(0.55F) * shade);
        texel.colour = shaded(texel.colour, one - set(0.42F) * shade);
    }
    if (!all_at_least(zero, water)) {
        // A drop darkens the surface under it, and shines.
        texel.colour = shaded(texel.colour, one - set(0.22F) * water);
        texel.roughness = mix(texel.roughness, set(0.04F), water);
        texel.occlusion = mix(texel.occlusion, one, water);
    }
}

/// Adds spore dust. exposure: amount that falls on this texel from above
HWY_INLINE void show_dust(const DamagePlan& plan, VF x, VF y, VF exposure, NoisePair& noise,
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

/// Adds ink where a cap has deliquesced. share: of the meridian; front: share where blackening
/// begins
HWY_INLINE void show_ink(const DamagePlan& plan, float front, VF share, VF uneven, Texel& texel) {
    const float amount = plan.melted;
    const VF along = share + uneven * set(0.05F);
    const float band = 0.10F + 0.22F * amount;
    const VF brown = smooth(along, front - 2.0F * band, 0.7F / band) *
                     set(amount < 0.1F ? 10.0F * amount : 1.0F);
    const VF black = smooth(along, front - 0.95F * band, 1.35F / band) *
                     set(amount < 0.1F ? 10.0F * amount : 1.0F);
    texel.colour = mix(texel.colour, {set(0.090F), set(0.062F), set(0.052F)}, brown * set(0.62F));
    texel.colour = mix(texel.colour, {set(0.0190F), set(0.0160F), set(0.0165F)}, black);
    texel.roughness = mix(texel.roughness, set(0.22F), black * set(0.85F));
}

}  // namespace HWY_NAMESPACE
}  // namespace sporeprint
HWY_AFTER_NAMESPACE();

#endif
