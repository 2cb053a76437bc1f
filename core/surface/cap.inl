// Paints the texels of the upper face: ramp, fibres, zones, patches, streaks, veins, striae, and
// the warts and scales on it.
#if defined(SPOREPRINT_CORE_SURFACE_CAP_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SPOREPRINT_CORE_SURFACE_CAP_INL
#undef SPOREPRINT_CORE_SURFACE_CAP_INL
#else
#define SPOREPRINT_CORE_SURFACE_CAP_INL
#endif

#include "core/surface/gill_layout.inl"
#include "core/surface/relief.inl"
#include "core/surface/skin.inl"

HWY_BEFORE_NAMESPACE();
namespace sporeprint {
namespace HWY_NAMESPACE {

HWY_INLINE Rgb ramp_colour(const CapPlan& plan, VF along) {
    Rgb colour = rgb(plan.first);
    for (int i = 0; i < plan.steps; ++i) {
        const VF t = unit(along * set(static_cast<float>(plan.steps)) - set(static_cast<float>(i)));
        const Light& step = plan.step[static_cast<std::size_t>(i)];
        colour.r = colour.r + set(step.r) * t;
        colour.g = colour.g + set(step.g) * t;
        colour.b = colour.b + set(step.b) * t;
    }
    return colour;
}

// Inverse size of cells, which grow from the pole outwards.
HWY_INLINE VF one_over_stretch(VF rho) { return set(1.25F) - set(0.45F) * rho; }

/// Returns how far a fibre of a cap strays to its side, in turns: fibres sway together.
HWY_INLINE VF cap_sway(const VF* fields) {
    return fields[cap_uneven] * set(0.010F) + fields[cap_middle] * set(0.003F);
}

/// Returns the factor on the strength of the fibres of a cap: they are plain in some places, and hardly
/// seen in others.
HWY_INLINE VF cap_fibrous(const VF* fields) {
    return clamped(set(0.95F) + fields[cap_mottle] * set(0.7F) + fields[cap_middle] * set(0.6F),
                   0.15F, 1.8F);
}

/// Computes the slowly varying fields of a cap, which are sampled at every other texel; the first
/// three come from the coarse grid.
HWY_INLINE void cap_fields(const CapPlan& plan, const DiscPoint& p, VF* fields) {
    const VF px = p.radius * p.cosine;
    const VF pz = p.radius * p.sine;
    if ((plan.fields & (1U << cap_bump)) != 0) {
        const VF f = set(cap_bump_frequency[0]);
        fields[cap_bump] = noise3(px * f, p.height * f, pz * f, plan.seed[0]) * set(plan.bumps[0]);
    }
    if ((plan.fields & (1U << cap_patch)) != 0) {
        const VF f = set(plan.patch_frequency);
        fields[cap_patch] = noise3(px * f, p.height * f, pz * f, plan.seed[4]);
    }
    constexpr unsigned round_fields =
        (1U << cap_streak) | (1U << cap_fibre) | (1U << cap_vein) | (1U << cap_zone);
    if ((plan.fields & round_fields) == 0) return;
    const VF turn = turn_of(p.cosine, p.sine);
    const VF round_texels = p.rho * set(6.2831853F / plan.disc.per_texel);
    const VF sway = cap_sway(fields);
    if ((plan.fields & (1U << cap_streak)) != 0) {
        const VF coarse =
            periodic_noise2((turn + sway) * set(46.0F),
                            p.rho * set(2.6F) + fields[cap_middle] * set(0.12F), 46, plan.seed[5]);
        const VF thin =
            periodic_noise2((turn + sway) * set(131.0F), p.rho * set(4.6F), 131, plan.seed[6]);
        const VF streak =
            coarse + thin * set(0.7F) * shown(round_texels * set(1.0F / 131.0F), 5.0F);
        fields[cap_streak] =
            smooth(streak, -0.05F, 1.9F) * smooth(p.rho, 0.02F, 6.0F) * cap_fibrous(fields);
    }
    if ((plan.fields & (1U << cap_fibre)) != 0) {
        const float n = static_cast<float>(plan.fibril_count);
        const VF a = periodic_noise2((turn + sway) * set(n), p.rho * set(6.5F), plan.fibril_count,
                                     plan.seed[7]);
        fields[cap_fibre] =
            a * shown(round_texels * set(1.0F / n), 5.0F) * set(0.75F) * cap_fibrous(fields);
    }
    if ((plan.fields & (1U << cap_zone)) != 0) {
        // Zones differ in width, and each is wider on one side than on the other.
        const VF even =
            (p.rho + fields[cap_uneven] * set(0.035F) + fields[cap_mottle] * set(0.012F)) *
            set(plan.zone_count);
        const VF broad = periodic_noise2(turn * set(5.0F), even * set(0.45F), 5, plan.zone_seed[0]);
        const VF fine = periodic_noise2(turn * set(17.0F), even * set(0.8F), 17, plan.zone_seed[1]);
        // Near the pole a turn is short, so the first zones stay nearly round.
        const VF apart = unit(even * set(0.4F));
        fields[cap_zone] = even + (broad * set(0.75F) + fine * set(0.2F)) * apart;
    }
    if ((plan.fields & (1U << cap_vein)) != 0) {
        // A net in the plane of the disc, elongated along the meridians by a warp, so that most
        // veins run outwards.
        const VF rows = set(plan.vein_rows);
        const VF draw = one_over_stretch(p.rho);
        const VF x = p.x * rows * draw + fields[cap_uneven] * set(0.50F);
        const VF y =
            p.y * rows * draw + fields[cap_middle] * set(0.30F) + fields[cap_mottle] * set(0.35F);
        const Cells net = plane_cells(x, y, 0.45F, plan.seed[9]);
        fields[cap_vein] = smooth(net.border, 0.02F, 3.2F);
    }
}

/// Returns the fine bumps of the cuticle and sets `height` to theirs.
HWY_INLINE VF cap_bumps(const CapPlan& plan, const DiscPoint& p, const VF* fields, VF& height) {
    VF fine = set(0.0F);
    if ((plan.fields & (1U << cap_bump)) != 0) {
        fine = fields[cap_bump];
        height = fine * set(0.16F / cap_bump_frequency[0]);
    }
    for (std::size_t octave = 1; octave < 3; ++octave) {
        if (plan.bumps[octave] <= 0.0F) continue;
        const VF f = set(cap_bump_frequency[octave]);
        const VF g = f * p.radius;
        const VF n = noise3(g * p.cosine, p.height * f, g * p.sine, plan.seed[octave]) *
                     set(plan.bumps[octave]);
        fine = fine + n;
        height = height + n * set(0.16F / cap_bump_frequency[octave]);
    }
    return fine;
}

/// Position of a texel among the zones of a cap.
struct CapZone {
    VF band;   ///< 1 in the middle of a dark zone, 0 between two
    VF shift;  ///< change of the place on the ramp: no zone has quite the colour of the next
};

HWY_INLINE CapZone cap_zone_of(const CapPlan& plan, const VF* fields) {
    const VF t = fields[cap_zone];
    const VF number = hn::Floor(t);
    const VF chance = signed_hash(number, plan.zone_seed[2]);
    const VF even = set(0.5F) - set(0.5F) * wave(t);
    const VF narrow = even * even;
    CapZone zone;
    zone.band = mix(even, narrow, set(0.5F) + set(0.5F) * chance) *
                (set(0.8F) + set(0.2F) * signed_hash(number, plan.zone_seed[2] + 1U)) *
                shown(set(1.0F / (plan.zone_count * plan.disc.per_texel)), 4.0F);
    zone.shift = even * chance * set(0.20F * plan.zones);
    return zone;
}

HWY_INLINE void add_cap_zones(const CapPlan& plan, const CapZone& zone, const VF* fields,
                              Layers& texel) {
    // A zone breaks up into blotches.
    const VF band = zone.band * unit(set(0.92F) + set(0.8F) * fields[cap_middle]);
    texel.shade = texel.shade * (set(1.0F) - set(0.66F * plan.zones) * band);
    texel.height = texel.height - zone.band * set(0.02F * plan.zones / plan.zone_count);
}

/// Adds fibres along the meridians. round_texels: circumference in texels
HWY_INLINE void add_cap_fibrils(const CapPlan& plan, const DiscPoint& p, const VF* fields, VF turn,
                                VF round_texels, Layers& texel) {
    const float n = 2.0F * static_cast<float>(plan.fibril_count);
    const VF b = periodic_noise2((turn + cap_sway(fields)) * set(n), p.rho * set(11.0F),
                                 2 * plan.fibril_count, plan.seed[8]);
    const VF fibre = fields[cap_fibre] + b * shown(round_texels * set(1.0F / n), 4.5F) *
                                             set(0.55F) * cap_fibrous(fields);
    texel.shade = texel.shade * (set(1.0F) + set(0.42F * plan.fibrils) * fibre);
    texel.height = texel.height + fibre * p.radius * set(0.44F * 6.2831853F * plan.fibrils / n);
    texel.occlusion = texel.occlusion + hn::Min(fibre, set(0.0F)) * set(0.3F * plan.fibrils);
    texel.roughness = texel.roughness + fibre * set(0.04F * plan.fibrils);
}

/// Adds the lines at the margin where gills show through a thin cap. They are soft, because light
/// spreads in the flesh, and each ends at its own radius.
HWY_INLINE void add_cap_striae(const CapPlan& plan, const DiscPoint& p, VF middle, VF turn,
                               VF round_texels, Layers& texel) {
    const VF one = set(1.0F);
    const VF x =
        blades_at(plan.layout, turn, wander_at(plan.layout, turn, one)).x * set(plan.striae_scale);
    const float lines = static_cast<float>(plan.layout.blades) * plan.striae_scale;
    const VF nearest = hn::Floor(x + set(0.5F));
    const VF chance = signed_hash(wrapped(nearest, lines), plan.seed[10]);
    const VF reach = (p.rho - set(1.0F - plan.striae)) *
                         set(1.0F / (plan.striae > 0.01F ? plan.striae : 0.01F)) +
                     middle * set(0.10F) + chance * set(0.16F);
    const VF strength =
        smooth(reach, 0.0F, 1.1F) * shown(round_texels * set(1.0F / lines), 4.0F) *
        (set(0.8F) + set(0.2F) * signed_hash(wrapped(nearest, lines), plan.seed[11]));
    const VF line = set(0.5F) + set(0.5F) * wave(x);
    texel.height = texel.height - (line - set(0.5F)) * strength * p.radius *
                                      set(plan.striae_relief * 6.2831853F / lines);
    texel.shade =
        texel.shade * (one + set(plan.striae_shade) * strength * (set(0.35F) - line * line));
    texel.occlusion = texel.occlusion * (one - set(plan.striae_relief) * line * strength);
}

HWY_INLINE void add_cap_veins(const CapPlan& plan, const DiscPoint& p, const VF* fields,
                              Layers& texel) {
    const VF one = set(1.0F);
    const VF strength =
        set(plan.veins) * (one - smooth(p.rho + fields[cap_mottle] * set(0.12F), 0.30F, 1.55F));
    const VF cup = fields[cap_vein] * strength;
    texel.height = texel.height - cup * set(0.30F / plan.vein_rows);
    texel.occlusion = texel.occlusion * (one - set(0.45F) * cup);
    texel.shade = texel.shade * (one + set(0.10F) * strength - set(0.40F) * cup);
}

HWY_INLINE bool uses_turn(const CapPlan& plan) {
    return plan.fibrils > 0.0F || plan.striae > 0.0F || plan.skin.fibres;
}

/// Shares of the meridian from which a cap that passes into the stem takes on its colours, and from
/// which its grain fades.
constexpr float joined_from = 0.7F, joined_grain_from = 0.88F;

/// Returns a texel of the cap. fields: values of cap_fields() at this texel
HWY_INLINE Texel cap_texel(const CapPlan& plan, const DiscPoint& p, const VF* fields) {
    const VF one = set(1.0F);
    const VF uneven = fields[cap_uneven];
    const VF mottle = fields[cap_mottle];
    const VF middle = fields[cap_middle];
    const VF turn = uses_turn(plan) ? turn_of(p.cosine, p.sine) : set(0.0F);
    Grain grain;
    grain.begin();
    if (plan.skin.fibres)
        grain = meridian_grain(plan.skin, p.rho, turn + cap_sway(fields) + one);
    else if (plan.skin.shows)
        grain = plane_grain(plan.skin, p.x, p.y);
    // The lattices lie in the plane of the disc, which is wider than the cap.
    grain.rise = grain.rise * hn::Min(p.widening, one);
    Layers texel;
    texel.height = set(0.0F);
    const VF fine = cap_bumps(plan, p, fields, texel.height);
    // One side of a cap stands in more sun and rain than the other.
    const VF side = p.x * set(plan.drift_x) + p.y * set(plan.drift_y) + uneven * set(0.3F);
    VF shift = set(plan.ramp_noise) * (uneven * set(0.20F) + mottle * set(0.06F)) +
               side * set(plan.ramp_drift);
    VF lightness = set(plan.lightness);
    // How far a joined cap is still one of its own: 0 at the stem.
    const VF own =
        plan.joined > 0.0F ? one - smooth(p.rho, joined_from, 1.0F / (1.0F - joined_from)) : one;
    if (plan.joined > 0.0F) {
        shift = shift * own;
        lightness = one + (lightness - one) * own;
    }
    VF along = p.rho + shift;
    CapZone zone{set(0.0F), set(0.0F)};
    if (plan.zones > 0.0F) {
        zone = cap_zone_of(plan, fields);
        along = along + zone.shift;
    }
    texel.colour = ramp_colour(plan, unit(along));
    if (plan.joined > 0.0F) texel.colour = mix(rgb(plan.joined_colour), texel.colour, own);
    Rgb tint{set(plan.tint.r) + side * set(plan.drift.r),
             set(plan.tint.g) + side * set(plan.drift.g),
             set(plan.tint.b) + side * set(plan.drift.b)};
    if (plan.joined > 0.0F) tint = mix(rgb(plan.joined_tint), tint, own);
    texel.colour.r = texel.colour.r * tint.r;
    texel.colour.g = texel.colour.g * tint.g;
    texel.colour.b = texel.colour.b * tint.b;
    texel.shade = one + set(0.10F * plan.ramp_noise + 0.02F) * (mottle + middle * set(0.6F)) +
                  set(0.10F) * fine;
    texel.occlusion = one + hn::Min(fine, set(0.0F)) * set(0.25F);
    texel.roughness = set(plan.roughness) + fine * set(0.05F) + mottle * set(0.03F);
    if (plan.patches > 0.0F) {
        // The border breaks up into points, and the patch is thinner in places.
        const VF patch =
            smooth(fields[cap_patch] + set(0.14F) * middle + set(0.05F) * fine +
                       set(plan.patch_grain) * grain.tone,
                   plan.patch_threshold - 0.5F / plan.patch_slope, plan.patch_slope) *
            unit(set(0.94F) + set(0.25F) * mottle + set(plan.patch_grain) * grain.tone) *
            set(plan.patch_weight) * own;
        texel.colour = mix(texel.colour, rgb(plan.patch_colour), patch);
        texel.roughness = texel.roughness + patch * set(0.05F);
        texel.height = texel.height + patch * set(0.0012F);
    }
    if (plan.zones > 0.0F) add_cap_zones(plan, zone, fields, texel);
    if (plan.streaks > 0.0F) {
        texel.shade = texel.shade * (one - set(0.55F * plan.streaks) * fields[cap_streak] * own);
        texel.height = texel.height - fields[cap_streak] * set(0.0015F * plan.streaks);
    }
    if (plan.fibrils > 0.0F || plan.striae > 0.0F) {
        const VF round_texels = p.rho * set(6.2831853F / plan.disc.per_texel);
        if (plan.fibrils > 0.0F) add_cap_fibrils(plan, p, fields, turn, round_texels, texel);
        if (plan.striae > 0.0F) add_cap_striae(plan, p, middle, turn, round_texels, texel);
    }
    if (plan.skin.shows) {
        // Dark zones are velvety, pale ones nearly smooth.
        const VF cover = mix(one, set(0.55F) + set(0.75F) * zone.band, set(plan.zones));
        add_skin(plan.skin, grain, uneven, cover, texel);
    }
    if (plan.veins > 0.0F) add_cap_veins(plan, p, fields, texel);
    if (plan.joined > 0.0F) {
        fade_grain(texel, p.rho, joined_grain_from);
        texel.roughness = mix(set(plan.joined_roughness), texel.roughness, own);
    }
    Texel out;
    out.colour = shaded(texel.colour, hn::Max(texel.shade, set(0.05F)) * lightness);
    out.height = texel.height;
    out.roughness = texel.roughness;
    out.occlusion = texel.occlusion;
    if (plan.relief.any()) add_relief(plan.relief, p, out);
    return out;
}

/// Draws a scale that is frayed into a tuft: dark hairs that leave the cap together and part towards
/// the margin.
///
/// a, b  place in half lengths and widths, a towards the margin
/// flap  how far a whole scale would cover it
HWY_INLINE void add_tuft(const PatchPlan& patch, const VeilPlan& veil, VF a, VF b, VF flap,
                         VF window, Texel& texel) {
    const VF one = set(1.0F);
    const VF across = b / (set(0.72F) + set(0.30F) * a);
    const VF hairs = across * set(0.9F * static_cast<float>(tuft_hairs));
    const VF thread = noise2(a * set(0.8F) + set(0.37F) * hairs, hairs, patch.seed);
    const VF length = noise2(set(2.7F) + set(0.4F) * across, hairs, patch.seed ^ 0x51U);
    const VF end = set(0.62F) + set(0.75F) * length;
    const VF along = (a + set(0.85F)) / hn::Max(end + set(0.85F), set(0.2F));
    const VF gaps = mix(set(0.72F), smooth(thread, -0.22F, 2.6F), set(patch.hairs));
    const VF bundle = (one - smooth(hn::Abs(across) + set(0.35F) * thread, 0.45F, 2.0F)) *
                      (one - smooth(along, 0.62F, 2.6F)) * smooth(a, -0.95F, 3.0F);
    const VF cover = mix(flap, bundle * gaps, set(patch.fray)) * window * set(patch.shown);
    const VF dark = one + thread * set(0.35F) - set(0.25F) * bundle;
    texel.colour = mix(texel.colour, shaded(rgb(veil.colour), dark), cover);
    texel.roughness = mix(texel.roughness, set(veil.roughness), cover);
    texel.height = texel.height + (set(0.4F) + set(0.6F) * unit(along)) * set(patch.relief) * cover;
    texel.occlusion = texel.occlusion * (one - set(0.25F) * bundle * (one - gaps));
}

/// Draws the footprint of a spine: a ring of small grains, and within it, where the spine has
/// fallen, a smooth mark with a rim.
///
/// a, b  place in half lengths and widths
HWY_INLINE void add_footprint(const PatchPlan& patch, const VeilPlan& veil, VF a, VF b, VF window,
                              Texel& texel) {
    constexpr float grains = static_cast<float>(footprint_grains), ring = 1.12F;
    const VF one = set(1.0F), zero = set(0.0F);
    const VF wander = noise2(a * set(2.3F), b * set(2.3F), patch.seed);
    const VF far = hn::Sqrt(a * a + b * b) + wander * set(0.16F);
    const VF inverse = one / hn::Max(hn::Sqrt(a * a + b * b), set(1e-6F));
    const VF place = turn_of(a * inverse, b * inverse) * set(grains);
    const VF grain = hn::Floor(place);
    const VF size = set(0.19F) + set(0.07F) * signed_hash(grain, patch.seed);
    const VF along = (place - grain - set(0.5F)) * set(6.2831853F / grains * ring);
    const VF across = far - set(ring) - set(0.10F) * signed_hash(grain, patch.seed + 1U);
    const VF dome = hn::Max(one - (along * along + across * across) / (size * size), zero) * window;
    const VF shown = set(patch.shown);
    const VF between = (one - smooth(hn::Abs(far - set(ring)), 0.1F, 4.0F)) * (one - dome) * window;
    const VF inside = (one - smooth(far, 0.78F, 6.0F)) * set(patch.fallen) * window;
    const VF rim =
        (one - smooth(hn::Abs(far - set(0.86F)), 0.0F, 6.0F)) * set(patch.fallen) * window;
    texel.colour = mix(texel.colour, rgb(veil.colour), dome * shown * set(0.75F));
    texel.colour = mix(texel.colour, rgb(veil.tip), inside * shown * set(0.30F));
    texel.colour = shaded(texel.colour, one - (set(0.05F) * between + set(0.12F) * rim) * shown);
    texel.height = texel.height +
                   (hn::Sqrt(dome) * set(0.75F) - inside * set(0.5F)) * shown * set(patch.relief);
    texel.occlusion = texel.occlusion * (one - set(0.12F) * between * shown);
    texel.roughness = texel.roughness - set(0.08F) * inside * shown;
}

/// Draws one wart or scale over a texel: colour, roughness, a little relief, and shade round its
/// base.
HWY_INLINE void add_patch(const PatchPlan& patch, const VeilPlan& veil, VF x, VF y, Texel& texel) {
    const VF one = set(1.0F);
    const VF dx = x - set(patch.x);
    const VF dy = y - set(patch.y);
    const VF a = (dx * set(patch.along_x) + dy * set(patch.along_y)) * set(patch.per_length);
    const VF b = (dy * set(patch.along_x) - dx * set(patch.along_y)) * set(patch.per_width);
    const VF window = one - smooth(a * a + b * b, patch_window * patch_window - 0.6F, 1.0F / 0.6F);
    if (patch.kind == 2) return add_footprint(patch, veil, a, b, window, texel);
    if (patch.kind == 0) {
        const VF grain = noise2(a * set(2.5F), b * set(2.5F), patch.seed) * set(0.85F) +
                         noise2(a * set(7.3F), b * set(7.3F), patch.seed + 1U) * set(0.35F);
        VF far = set(0.0F);
        for (std::size_t side = 0; side < 6; ++side)
            far = hn::Max(far, a * set(patch.side_x[side]) + b * set(patch.side_y[side]));
        far = far + grain * set(0.16F + 0.35F * patch.fray);
        const VF cover = (one - smooth(far, 0.86F, 5.0F)) * window * set(patch.shown);
        const VF foot =
            (one - smooth(far, 0.75F, 1.4F)) * (one - cover) * window * set(patch.shown);
        const VF up = hn::Max(one - far, set(0.0F));
        Rgb colour = mix(rgb(veil.colour), rgb(veil.tip), smooth(up, 0.35F, 1.8F));
        colour = shaded(colour, one + grain * set(0.12F) - set(0.10F) * far);
        texel.colour = mix(texel.colour, colour, cover);
        texel.roughness = mix(texel.roughness, set(veil.roughness), cover);
        // A leaning wart is higher on one side.
        texel.height = texel.height + (up + grain * set(0.15F) + a * set(0.3F * patch.lift)) *
                                          set(patch.relief) * cover;
        texel.occlusion = texel.occlusion * (one - set(0.38F) * foot);
        texel.colour = shaded(texel.colour, one - set(0.16F) * foot);
    } else {
        // A scale is a tongue of cuticle: broad at the base, ragged and pointed at the tip, which
        // stands off.
        const VF thread = noise2(a * set(1.5F), b * set(5.3F), patch.seed);
        const VF tipwards = a * set(patch.lift);
        const VF taper = one - set(0.62F) * smooth(tipwards, -0.35F, 0.8F);
        const VF side = hn::Abs(b) / hn::Max(taper, set(0.1F));
        const VF far = hn::Max(side, hn::Abs(a)) + thread * set(0.24F);
        VF cover = (one - smooth(far, 0.80F, 4.0F)) * smooth(tipwards, -1.0F, 1.2F);
        if (patch.fray > 0.0F) return add_tuft(patch, veil, a, b, cover, window, texel);
        cover = cover * window * set(patch.shown);
        const VF foot = (one - smooth(far, 0.80F, 1.7F)) * (one - cover) * window *
                        set(patch.shown) * smooth(tipwards, -0.2F, 1.0F);
        const VF tip = smooth(tipwards + thread * set(0.45F), -0.05F, 1.1F);
        Rgb colour = mix(rgb(veil.colour), rgb(veil.tip), tip);
        colour = shaded(colour, one + thread * set(0.22F));
        texel.colour = mix(texel.colour, colour, cover);
        texel.roughness = mix(texel.roughness, set(veil.roughness), cover);
        texel.height =
            texel.height + (unit(tipwards * set(0.5F) + set(0.5F)) + thread * set(0.2F)) *
                               set(patch.relief) * cover;
        texel.occlusion = texel.occlusion * (one - set(0.45F) * foot);
        texel.colour = shaded(texel.colour, one - set(0.30F) * foot);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace sporeprint
HWY_AFTER_NAMESPACE();

#endif
