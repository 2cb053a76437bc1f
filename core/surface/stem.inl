// Paints the texels of the stem (fibres, stain, bands, net) and of the veil's strip (threads,
// grain).
#if defined(SPOREPRINT_CORE_SURFACE_STEM_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SPOREPRINT_CORE_SURFACE_STEM_INL
#undef SPOREPRINT_CORE_SURFACE_STEM_INL
#else
#define SPOREPRINT_CORE_SURFACE_STEM_INL
#endif

#include "core/surface/gill_layout.inl"
#include "core/surface/skin.inl"

HWY_BEFORE_NAMESPACE();
namespace sporeprint {
namespace HWY_NAMESPACE {

/// Returns how far a fibre of a stem strays to its side, in turns: fibres sway together.
HWY_INLINE VF stem_sway(const VF* fields) {
    return fields[stem_broad] * set(0.030F) + fields[stem_middle] * set(0.006F);
}

/// Returns the factor on the strength of the fibres of a stem: here they are drawn out and plain, there
/// the skin is almost smooth.
HWY_INLINE VF stem_fibrous(const VF* fields) {
    return clamped(set(0.95F) + fields[stem_broad] * set(0.9F) + fields[stem_middle] * set(0.5F),
                   0.15F, 1.8F);
}

/// Computes the fields of a stem that vary slowly along it: broad and medium clouds, the first
/// bumps, fibres and their furrows.
HWY_INLINE void stem_fields(const StemPlan& plan, VF along, VF turn, VF* fields) {
    const VF length = along * set(plan.aspect);
    const VF broad = periodic_noise2(turn * set(4.0F), length * set(3.0F), 4, plan.seed[0]);
    fields[stem_broad] = broad;
    fields[stem_middle] =
        periodic_noise2(turn * set(11.0F), length * set(8.0F * plan.stretch), 11, plan.seed[1]);
    if ((plan.fields & (1U << stem_bump)) != 0) {
        const float n = static_cast<float>(stem_bump_cells[0]);
        fields[stem_bump] = periodic_noise2(turn * set(n), length * set(n * plan.stretch),
                                            stem_bump_cells[0], plan.seed[2]) *
                            set(plan.bumps[0]);
    }
    if ((plan.fields & (1U << stem_fibre)) != 0) {
        // Coarse wrinkles appear only with strong fibres.
        VF fibre = set(0.0F);
        VF furrow = set(0.0F);
        const VF sway = stem_sway(fields);
        const VF fibrous = stem_fibrous(fields);
        for (std::size_t octave = 0; octave < 3; ++octave) {
            if (plan.fibres[octave] <= 0.0F) continue;
            const int cells_round = stem_fibre_cells[octave];
            const float n = static_cast<float>(cells_round);
            const VF v = periodic_noise2((turn + sway) * set(n),
                                         length * set(n * stem_fibre_slender[octave]), cells_round,
                                         plan.seed[5 + octave]) *
                         set(plan.fibres[octave]) * fibrous;
            fibre = fibre + v;
            furrow = furrow + v * set(0.20F / n);
        }
        fields[stem_fibre] = fibre;
        fields[stem_furrow] = furrow;
    }
}

/// Adds a snakeskin pattern: the felt has torn into zigzag belts, whose edges are frayed. Their
/// teeth differ in width and length.
HWY_INLINE void add_stem_bands(const StemPlan& plan, VF along, VF turn, const VF* fields, VF fine,
                               VF grain, Layers& texel) {
    const VF broad = fields[stem_broad];
    const VF middle = fields[stem_middle];
    const VF tooth = turn * set(13.0F) + broad * set(0.5F) + middle * set(0.25F);
    const VF zigzag = hn::Abs(tooth - hn::Floor(tooth) - set(0.5F)) * set(2.0F) - set(0.5F);
    const VF phase = along * set(11.0F) + zigzag * (set(0.36F) + middle * set(0.30F)) +
                     broad * set(0.45F) + middle * set(0.30F);
    const VF belt = smooth(wave(phase) + fine * set(0.3F) + middle * set(0.45F) + grain * set(0.5F),
                           -0.20F, 1.5F) *
                    unit(set(0.9F) + broad * set(0.4F) + grain * set(0.2F));
    texel.colour = mix(texel.colour, rgb(plan.band_colour), belt * set(plan.bands));
    texel.height = texel.height + belt * set(0.003F * plan.bands);
}

/// Adds the net of a bolete, which fades out downwards.
HWY_INLINE void add_stem_net(const StemPlan& plan, VF along, VF turn, const VF* fields,
                             Layers& texel) {
    const VF one = set(1.0F);
    const VF zero = set(0.0F);
    const VF middle = fields[stem_middle];
    const VF strength =
        set(plan.net) *
        smooth(along + fields[stem_broad] * set(0.10F) + middle * set(0.05F), 0.16F, 1.5F);
    const VF length = along * set(plan.aspect);
    const VF y = length * set(net_columns / net_stretch) + middle * set(0.30F);
    VF thread = zero;
    if (plan.net_shown > 0.0F && !hn::AllTrue(Floats(), strength <= zero)) {
        // Threads are bent, thicker where they meet, and of unlike strength.
        constexpr int bends = 2 * static_cast<int>(net_columns);
        const VF bend = periodic_noise2(turn * set(static_cast<float>(bends)), y * set(2.4F), bends,
                                        plan.seed[8] + 1U);
        const VF other = periodic_noise2(turn * set(static_cast<float>(bends / 2)),
                                         y * set(1.3F) + set(17.0F), bends / 2, plan.seed[8] + 2U);
        const Cells mesh = ring_cells(turn + bend * set(0.20F / net_columns),
                                      hn::Max(y + other * set(0.22F), zero), net_columns, 0.0F,
                                      net_stretch, 0.38F, plan.seed[8]);
        const VF wide = set(0.06F) + (other + bend) * set(0.035F);
        thread = (one - smooth(mesh.border - wide, 0.0F, 4.6F)) *
                 unit(set(0.82F) + bend * set(0.35F) + fields[stem_broad] * set(0.3F));
    }
    // Where texels are too coarse for its threads, the net is their mean.
    thread = mix(set(0.35F), thread, set(plan.net_shown));
    const VF up = thread * strength;
    texel.colour = mix(texel.colour, rgb(plan.net_colour), up * set(0.9F));
    texel.height = texel.height + up * set(0.15F / net_columns);
    texel.occlusion = texel.occlusion * (one - set(0.22F) * strength * (one - thread));
    texel.shade = texel.shade * (one - set(0.08F) * strength * (one - thread));
}

/// Length of the shortest decurrent gill, in that of the longest.
constexpr float shortest_stem_gill = 0.3F;

/// Adds decurrent gills, whose height decreases downwards, like that of solid gills: each ends at its
/// own place.
HWY_INLINE void add_stem_gills(const StemPlan& plan, VF along, VF turn, Layers& texel) {
    const VF one = set(1.0F);
    const float n = static_cast<float>(plan.layout.blades);
    const VF x = blades_at(plan.layout, turn, wander_at(plan.layout, turn, set(0.0F))).x;
    const VF blade = hn::Floor(x);
    const auto length_of = [&](VF number) {
        const VF draw = set(0.5F) + set(0.5F) * signed_hash(wrapped(number, n), plan.seed[0]);
        return set(shortest_stem_gill) + set(1.0F - shortest_stem_gill) * draw;
    };
    const VF between = x - blade, eased = between * between * (set(3.0F) - set(2.0F) * between);
    const VF reach = set(plan.gills) * mix(length_of(blade), length_of(blade + one), eased);
    const VF risen = unit((along - one + reach) / reach);
    const VF up = risen * risen * (set(3.0F) - set(2.0F) * risen);
    const VF far = hn::Abs(x - hn::Floor(x + set(0.5F)));
    const VF deep =
        mix(set(0.45F), unit((far - set(plan.gill_half)) * set(1.0F / (0.5F - plan.gill_half))),
            set(plan.gill_shown));
    const VF bottom = deep * deep;
    Rgb gill = mix(rgb(plan.gill_colour), rgb(plan.gill_depth), bottom);
    gill = mix(gill, rgb(plan.gill_edge), one - smooth(deep, 0.0F, 4.0F));
    texel.colour = mix(texel.colour, gill, up);
    texel.height = texel.height + (one - bottom) * up * set(plan.gill_relief * plan.gill_shown);
    texel.occlusion = texel.occlusion * (one - (one - set(plan.gill_occlusion)) * bottom * up);
}

/// Adds the stain of the base.
HWY_INLINE void add_stem_stain(const StemPlan& plan, VF along, const VF* fields, VF fine,
                               Layers& texel) {
    const VF one = set(1.0F);
    const VF middle = fields[stem_middle];
    const VF ragged =
        along + (fields[stem_broad] + middle * set(0.6F) + fine * set(0.3F)) * set(plan.ragged);
    const VF stain = (one - smooth(ragged, plan.base_stain * 0.55F - 0.06F,
                                   1.0F / (0.45F * plan.base_stain + 0.12F))) *
                     set(plan.base_stain < 0.1F ? plan.base_stain * 10.0F : 1.0F);
    texel.colour =
        mix(texel.colour, rgb(plan.stain), stain * unit(set(0.86F) + middle * set(0.5F)));
    texel.occlusion = texel.occlusion * (one - stain * set(0.12F));
}

/// Adds grains of soil of one size: each cell has one or none.
///
/// density  0..1: share of cells that have one
HWY_INLINE void add_grains(const StemPlan& plan, std::size_t size, VF turn, VF length, VF density,
                           Layers& texel) {
    const VF one = set(1.0F), zero = set(0.0F);
    const float n = plan.grains[size];
    // Where texels are too coarse for grains, their mean.
    const float seen = plan.grains_shown[size];
    VF cover = density * set(0.30F), dome = zero, tone = zero;
    if (seen > 0.0F && !hn::AllTrue(Floats(), density <= zero)) {
        const Cells cell = ring_cells(turn, hn::Max(length * set(n), zero), n, 0.0F, 1.0F, 0.38F,
                                      plan.seed[9 + size]);
        const VU lot = hash(cell.id);
        const VF chance = upper_part(lot) * set(0.5F) + set(0.5F);
        // Most grains are small.
        const VF large = lower_part(lot) * lower_part(lot);
        const VF radius = (set(0.16F) + large * set(0.46F)) *
                          smooth(density - chance, 0.0F, 1.0F / 0.3F);
        // Grains are angular, and neighbours press against each other.
        const int cells = static_cast<int>(n) * 3;
        const VF uneven = periodic_noise2(turn * set(n * 3.0F), length * set(n * 3.0F), cells,
                                          plan.seed[9 + size] + 1U);
        const VF far = cell.centre / hn::Max(radius, set(1e-3F)) + uneven * set(0.42F);
        const VF inside = hn::Min(hn::Min(one - far, cell.border * set(6.0F)), radius * set(40.0F));
        const VF whole = smooth(inside, 0.0F, 4.5F);
        cover = mix(cover, whole, set(seen));
        dome = hn::Sqrt(hn::Max(one - far * far, zero)) * (radius + uneven * set(0.08F)) * whole *
               set(seen);
        tone = upper_part(hash(lot)) * set(seen);
    }
    // Humus is dark, sand is pale.
    const VF pale = smooth(tone, 0.55F, 2.2F) * set(0.5F);
    const Rgb soil = mix(shaded(rgb(plan.soil_colour), set(1.5F) + tone * set(0.8F)),
                         Rgb{set(0.30F), set(0.24F), set(0.16F)}, pale);
    texel.colour = mix(texel.colour, soil, cover);
    texel.height = texel.height + dome * set(0.7F / n);
    texel.roughness = mix(texel.roughness, set(0.97F), cover);
    texel.occlusion = texel.occlusion * (one - cover * set(0.10F));
}

/// Adds the felt of the mycelium at the foot, and soil: rubbed into the skin at the ground, whole
/// below it, and grains that become fewer with height.
HWY_INLINE void add_stem_ground(const StemPlan& plan, VF along, VF turn, const VF* fields,
                                Layers& texel) {
    const VF one = set(1.0F);
    const VF height = (along - set(plan.foot)) * set(1.0F / plan.soil_reach);
    // Beyond this height no noise can bring soil.
    if (hn::AllTrue(Floats(), height >= set(7.0F))) return;
    const VF length = along * set(plan.aspect);
    const VF broad = fields[stem_broad];
    const VF middle = fields[stem_middle];
    const VF thread = periodic_noise2(turn * set(34.0F) + broad * set(0.8F), length * set(8.0F), 34,
                                      plan.seed[11]);
    if (plan.mycelium > 0.0F) {
        const VF near =
            one - smooth(height + middle * set(0.6F) + broad * set(0.5F), 0.2F, 1.0F / 2.6F);
        // Its threads are finer than any furrow of the skin, and lie over each other.
        const VF strand = periodic_noise2(turn * set(117.0F) + thread * set(0.9F),
                                          length * set(46.0F), 117, plan.seed[11] + 1U);
        const VF felt =
            smooth(strand * set(0.35F) + thread * set(0.2F) + near * set(1.2F), 0.45F, 1.1F) *
            near * set(plan.mycelium);
        texel.colour = mix(texel.colour, Rgb{set(0.90F), set(0.88F), set(0.82F)}, felt);
        texel.height = texel.height + felt * (set(0.0015F) + thread * set(0.0015F));
        texel.roughness = mix(texel.roughness, set(0.95F), felt);
    }
    if (plan.soil <= 0.0F) return;
    const VF amount = set(plan.soil);
    // It clings in lumps: here it reaches high, there the skin is bare into the ground. At the pole
    // there is one lump.
    const VF lump = (periodic_noise2(turn * set(5.0F) + middle * set(0.2F), length * set(4.0F), 5,
                                     plan.seed[11] + 2U) +
                     set(0.5F) * periodic_noise2(turn * set(13.0F), length * set(11.0F), 13,
                                                 plan.seed[11] + 3U)) *
                    smooth(along, 0.0F, 1.0F / std::max(0.6F * plan.foot, 1e-3F));
    const VF level = height * set(1.25F) + broad * set(0.6F) + middle * set(0.55F) +
                     lump * set(2.6F) - set(0.8F);
    const VF left = one - smooth(lump, 0.0F, 1.0F / 0.45F) * set(0.75F);
    // Fine soil is rubbed into the skin; it stays in the furrows between fibres. A thin film lets the
    // skin through, and tints it.
    const VF uneven = level + thread * set(0.3F);
    const VF rubbed = (set(0.70F) * (one - smooth(uneven, -0.9F, 1.0F / 1.9F)) +
                       set(0.30F) * (one - smooth(uneven, -0.1F, 1.0F / 2.4F))) *
                      left * amount;
    texel.colour = mix(texel.colour,
                       Rgb{texel.colour.r * set(plan.film.r), texel.colour.g * set(plan.film.g),
                           texel.colour.b * set(plan.film.b)},
                       rubbed);
    texel.colour = mix(texel.colour, rgb(plan.soil_colour), rubbed * rubbed * set(0.8F));
    texel.roughness = mix(texel.roughness, set(0.95F), rubbed);
    const VF whole = (one - smooth(level, -0.8F, 1.0F / 0.8F)) * left * amount;
    texel.colour = mix(texel.colour, rgb(plan.soil_colour), whole);
    const VF fine = one - smooth(level, -0.9F, 1.0F / 3.2F);
    const VF coarse = one - smooth(level + thread * set(0.2F), -1.0F, 1.0F / 2.6F);
    add_grains(plan, 1, turn, length, fine * fine * amount, texel);
    add_grains(plan, 0, turn, length, coarse * coarse * set(0.8F) * amount, texel);
    texel.occlusion = texel.occlusion * (one - whole * set(0.2F));
    texel.height = texel.height + whole * set(0.003F);
}

/// Share of a stem from which its grain fades where it passes into the upper face.
constexpr float stem_joined_from = 0.9F;

/// Returns a texel of the stem. along: 0 at its base, which may be in the ground, 1 at the top; turn:
/// 0..1. Heights are in circumferences.
HWY_INLINE Texel stem_texel(const StemPlan& plan, VF along, VF turn, const VF* fields) {
    const VF one = set(1.0F);
    const VF zero = set(0.0F);
    const VF length = along * set(plan.aspect);
    const VF middle = fields[stem_middle];
    Grain grain;
    grain.begin();
    if (plan.skin.shows) grain = stem_grain(plan.skin, turn + stem_sway(fields), length);
    VF fine = zero;
    Layers texel;
    texel.height = zero;
    if ((plan.fields & (1U << stem_bump)) != 0) {
        fine = fields[stem_bump];
        texel.height = fine * set(0.16F / static_cast<float>(stem_bump_cells[0]));
    }
    for (std::size_t octave = 1; octave < 3; ++octave) {
        if (plan.bumps[octave] <= 0.0F) continue;
        const float n = static_cast<float>(stem_bump_cells[octave]);
        const VF v = periodic_noise2(turn * set(n), length * set(n * plan.stretch),
                                     stem_bump_cells[octave], plan.seed[2 + octave]) *
                     set(plan.bumps[octave]);
        fine = fine + v;
        texel.height = texel.height + v * set(0.16F / n);
    }
    texel.colour = mix(rgb(plan.base), rgb(plan.top),
                       smooth(along + fields[stem_broad] * set(0.07F), 0.0F, 1.0F));
    texel.colour.r = texel.colour.r * set(plan.tint.r);
    texel.colour.g = texel.colour.g * set(plan.tint.g);
    texel.colour.b = texel.colour.b * set(plan.tint.b);
    texel.shade = one + middle * set(0.05F) + fine * set(0.06F);
    texel.occlusion = one + hn::Min(fine, zero) * set(0.25F);
    texel.roughness = set(plan.roughness) + fine * set(0.04F) + middle * set(0.03F);
    if (plan.fibrils > 0.0F) {
        const VF fibre = fields[stem_fibre];
        texel.height = texel.height + fields[stem_furrow] * set(plan.fibrils);
        texel.shade = texel.shade * (one + fibre * set(0.30F * plan.fibrils));
        texel.occlusion = texel.occlusion + hn::Min(fibre, zero) * set(0.25F * plan.fibrils);
    }
    if (plan.bands > 0.0F) add_stem_bands(plan, along, turn, fields, fine, grain.tone, texel);
    if (plan.net > 0.0F) add_stem_net(plan, along, turn, fields, texel);
    if (plan.gills > 0.0F) add_stem_gills(plan, along, turn, texel);
    if (plan.base_stain > 0.0F) add_stem_stain(plan, along, fields, fine, texel);
    if (plan.skin.shows)
        add_skin(plan.skin, grain, fields[stem_broad],
                 mix(one, stem_fibrous(fields), set(plan.skin.fibres ? 0.6F : 0.3F)), texel);
    if (plan.soil > 0.0F || plan.mycelium > 0.0F) add_stem_ground(plan, along, turn, fields, texel);
    if (plan.joined > 0.0F) {
        const VF grain_left = fade_grain(texel, along, stem_joined_from);
        texel.roughness = mix(set(plan.roughness), texel.roughness, grain_left);
    }
    Texel out;
    out.colour = shaded(texel.colour, hn::Max(texel.shade, set(0.05F)));
    out.height = texel.height;
    out.roughness = texel.roughness;
    out.occlusion = texel.occlusion;
    return out;
}

/// How fibrils of a membrane split: how many there are of the coarse and of the fine ones round it.
constexpr int coarse_fibrils = 53, fine_fibrils = 149;

HWY_INLINE void veil_fields(const VeilPlan& plan, VF turn, VF across, VF* fields) {
    const auto fibrils = [&](int number, float rows, std::uint32_t seed) {
        const VF count = set(static_cast<float>(number));
        return periodic_noise2(turn * count, across * set(rows), number, seed) *
               shown(set(1.0F / (static_cast<float>(number) * plan.texel)), 4.0F);
    };
    // Bundles of fibrils come and go, so that they nowhere stand in a row.
    const VF coarse = fibrils(coarse_fibrils, 1.3F, plan.seed[0]),
             fine = fibrils(fine_fibrils, 2.7F, plan.seed[0] + 1U);
    fields[veil_cloud] = periodic_noise2(turn * set(19.0F), across * set(2.0F), 19, plan.seed[1]);
    const VF bundled = unit(set(0.5F) + fields[veil_cloud]);
    fields[veil_thread] =
        coarse * (set(0.35F) + set(0.4F) * bundled) + fine * (set(0.75F) - set(0.4F) * bundled);
}

/// Pits of a sponge: chambers of two sizes with thin walls between them. They replace threads and
/// the fold of a ring, which a sponge has not.
HWY_INLINE void add_pits(const VeilPlan& plan, VF turn, VF across, Texel& texel) {
    const VF one = set(1.0F), depth = set(plan.pits);
    const auto pits = [&](int columns, std::uint32_t seed) {
        const VF number = set(static_cast<float>(columns));
        const VF place = across * number * set(pit_rows * plan.across);
        return periodic_noise2(turn * number, place, columns, seed) *
               shown(set(1.0F / (static_cast<float>(columns) * plan.texel)), 4.0F);
    };
    const VF wide = pits(chamber_columns, plan.seed[1]), fine = pits(pit_columns, plan.seed[3]);
    const VF broad = pits(lump_columns, plan.seed[0]);
    // Walls are where the noise is about nought.
    const VF chamber = smooth(hn::Abs(wide), 0.04F, 3.0F), pit = smooth(fine, 0.02F, 2.6F);
    const VF deep = hn::Min(chamber * set(0.55F) + pit * set(0.6F), one) * depth;
    texel.colour = mix(rgb(plan.colour), rgb(plan.tip),
                       smooth(across + broad * set(0.16F) + wide * set(0.1F), 0.35F, 2.2F));
    texel.colour = shaded(texel.colour,
                          one + broad * set(0.16F) * depth + set(0.1F) * depth - deep * set(0.42F));
    texel.height = (broad * set(0.5F / lump_columns) - chamber * set(0.3F / chamber_columns) -
                    pit * set(0.34F / pit_columns)) *
                   depth;
    texel.occlusion = one - deep * set(0.5F);
    texel.roughness = set(plan.roughness) + deep * set(0.15F);
}

/// Returns a texel of the veil. turn: 0..1 along the strip; across: from the attachment of its outer
/// side by its edge to that of its inner side. Heights are in lengths of the strip.
HWY_INLINE Texel veil_texel(const VeilPlan& plan, VF turn, VF strip, const VF* fields) {
    constexpr float outer_to = static_cast<float>(veil_outer_to),
                    inner_from = static_cast<float>(veil_inner_from);
    const VF one = set(1.0F);
    Texel out;
    const VF thread = fields[veil_thread];
    const VF cloud = fields[veil_cloud];
    const VF grain =
        periodic_noise2(turn * set(160.0F), strip * set(160.0F * plan.across), 160, plan.seed[2]) *
        shown(set(1.0F / (160.0F * plan.texel)), 4.0F);
    // Both sides are 0 at the attachment and 1 at the edge.
    const VF across = hn::Min(strip * set(1.0F / outer_to), one);
    const VF within = hn::Min((one - strip) * set(1.0F / (1.0F - inner_from)), one);
    const VF inner = smooth(strip, 0.5F * (outer_to + inner_from) - 0.004F, 125.0F);
    const VF to_edge = across + inner * (within - across);
    const Rgb outside = mix(rgb(plan.colour), rgb(plan.tip),
                            smooth(across + cloud * set(0.18F) + thread * set(0.10F), 0.35F, 1.5F));
    // The inner side is pale and woolly, and takes the colour of the edge only near it.
    const Rgb inside = mix(rgb(plan.inner), rgb(plan.tip),
                           smooth(within + cloud * set(0.12F) + thread * set(0.16F), 0.8F, 4.0F));
    const VF fade_out = one - set(0.5F) * to_edge;
    const VF woolly = set(0.09F) + set(0.05F) * inner;
    out.colour = shaded(mix(outside, inside, inner),
                        one + thread * woolly * fade_out + cloud * set(0.05F) + grain * set(0.03F));
    out.height = thread * set(0.14F / 92.0F) * fade_out + grain * set(0.03F / 160.0F);
    out.roughness = set(plan.roughness) + grain * set(0.04F);
    // The fold at the attachment is in shade, on the outer side above all.
    const VF shade = (set(0.28F) - set(0.18F) * inner) * (one - smooth(to_edge, 0.0F, 3.0F));
    out.occlusion = one - shade + hn::Min(thread, set(0.0F)) * set(0.12F);
    if (plan.pits > 0.0F) add_pits(plan, turn, across, out);
    return out;
}

}  // namespace HWY_NAMESPACE
}  // namespace sporeprint
HWY_AFTER_NAMESPACE();

#endif
