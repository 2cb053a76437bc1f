// Paints the texels of the lower face: gills with their shorter tiers, forking ridges, pores,
// spines, or a smooth surface.
#if defined(SPOREPRINT_CORE_SURFACE_HYMENIUM_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SPOREPRINT_CORE_SURFACE_HYMENIUM_INL
#undef SPOREPRINT_CORE_SURFACE_HYMENIUM_INL
#else
#define SPOREPRINT_CORE_SURFACE_HYMENIUM_INL
#endif

#include "core/individual/gill_layout.h"
#include "core/surface/gill_layout.inl"

HWY_BEFORE_NAMESPACE();
namespace sporeprint {
namespace HWY_NAMESPACE {

/// Position of a texel in the slot between two blades.
struct Slot {
    VF depth;    ///< 0 on the edge of the nearest blade, 1 in the middle of the slot
    VF visible;  ///< 0 where slots are smaller than texels
};

/// Returns the slot among gills: `blades` that reach the stem, and tiers of shorter ones, each of
/// which halves the gaps from its own radius outwards.
HWY_INLINE Slot gills(const HymeniumPlan& plan, const DiscPoint& p, VF share, VF turn, VF wander) {
    const VF one = set(1.0F);
    const float n = static_cast<float>(plan.layout.blades);
    const auto [x, wide] = blades_at(plan.layout, turn, wander);
    const VF gap = p.radius * set(6.2831853F / n) * wide;
    const VF gap_texels = p.rho * set(6.2831853F / (n * plan.disc.per_texel)) * wide;
    VF distance = hn::Abs(x - hn::Floor(x + set(0.5F)));  // in gaps, to the nearest blade
    VF clear_width = one;  // width between two blades, as a share of the gap
    float scale = 1.0F;
    for (int tier = 0; tier < plan.tiers; ++tier, scale *= 2.0F) {
        const VF fine = x * set(scale);
        const VF place = hn::Floor(fine);
        const VF chance =
            signed_hash(wrapped(place, n * scale), plan.seed[2] + static_cast<std::uint32_t>(tier));
        const VF begin = set(static_cast<float>(tier_begin(tier))) +
                         chance * set(static_cast<float>(tier_strays));
        VF grown = unit((share - begin) * set(static_cast<float>(tier_rise)));
        if (tier + 1 == plan.tiers && plan.last_tier < 1.0F) {
            // Golden-section steps distribute the present blades as evenly as possible, for any
            // share.
            const VF rank = wrapped(place, n * scale) * set(static_cast<float>(golden_step));
            grown = hn::IfThenElseZero(rank - hn::Floor(rank) < set(plan.last_tier), grown);
        }
        const VF here = hn::Abs(fine - place - set(0.5F)) * set(1.0F / scale);
        // A blade that has not yet begun counts as far away.
        distance = hn::Min(distance, here + (one - grown) * set(0.5F / scale));
        clear_width = clear_width * (one - set(0.5F) * grown);
    }
    const VF half = gap * clear_width * set(0.5F);
    const VF edge = hn::Min(set(plan.blade), half * set(0.36F));
    const VF soft = gap * set(0.75F) / hn::Max(gap_texels, set(0.5F));
    Slot slot;
    slot.depth = unit((distance * gap - edge) / hn::Max(half - edge, soft));
    slot.visible = shown(gap_texels * clear_width, 4.0F);
    return slot;
}

/// Returns the height of cross veins, low and thin folds between two ridges, 0..1; those of the
/// rows above and below may overlap. x: position round the axis in gaps
HWY_INLINE VF cross_veins(const HymeniumPlan& plan, VF x, VF share) {
    const VF ridge = hn::Floor(x);
    const VF within = x - ridge - set(0.5F);
    const VF along = share * set(static_cast<float>(plan.vein_rows));
    VF cross = set(0.0F);
    for (int j = -1; j <= 1; ++j) {
        const VF row = hn::Floor(along) + set(static_cast<float>(j));
        const VF whole = wrapped(ridge, static_cast<float>(plan.layout.blades)) +
                         row * set(static_cast<float>(vein_rows_apart));
        const VF middle = row + set(0.5F) +
                          signed_hash(whole, plan.seed[4]) * set(static_cast<float>(vein_stray));
        const VF tilt = signed_hash(whole, plan.seed[4] + 1U) * set(static_cast<float>(vein_tilt));
        const VF there =
            unit((set(plan.veins_there) - signed_hash(whole, plan.seed[4] + 2U) * set(0.5F)) *
                 set(static_cast<float>(vein_steepness)));
        const VF far = hn::Abs(along - middle - tilt * within);
        const VF vein = set(1.0F) - smooth(far, 0.3F * static_cast<float>(vein_width),
                                           0.6F / static_cast<float>(vein_width));
        const auto inside =
            hn::And(row >= set(0.0F), row < set(static_cast<float>(plan.vein_rows)));
        cross = hn::Max(cross, hn::IfThenElseZero(inside, vein * there));
    }
    return cross;
}

/// Returns the slot among ridges: blunt folds. From each a fork swings out to the middle of the
/// gap, and another from each half.
HWY_INLINE Slot ridges(const HymeniumPlan& plan, const DiscPoint& p, VF share, VF turn, VF wander) {
    const VF one = set(1.0F);
    const float n = static_cast<float>(plan.layout.blades);
    const auto [x, wide] = blades_at(plan.layout, turn, wander);
    const VF gap = p.radius * set(6.2831853F / n) * wide;
    const VF gap_texels = p.rho * set(6.2831853F / (n * plan.disc.per_texel)) * wide;
    VF distance = hn::Abs(x - hn::Floor(x + set(0.5F)));
    VF clear_width = one;
    const double hidden = 1.0 - static_cast<double>(plan.forking);
    float scale = 1.0F;
    for (int level = 0; level < 2; ++level, scale *= 2.0F) {
        const VF fine = x * set(scale);
        const VF place = hn::Floor(fine);
        const VF within = fine - place;
        const VF chance = signed_hash(wrapped(place, n * scale),
                                      plan.seed[2] + static_cast<std::uint32_t>(level));
        const VF side = signed_hash(wrapped(place, n * scale),
                                    plan.seed[3] + static_cast<std::uint32_t>(level));
        const std::size_t i = static_cast<std::size_t>(level);
        const VF begin = set(static_cast<float>(fork_begins[i] + fork_missing * hidden)) +
                         chance * set(static_cast<float>(fork_strays[i]));
        const VF swing = set(0.5F) * smooth(share - begin, 0.0F, static_cast<float>(fork_swing));
        const VF fork = hn::IfThenElse(side < set(0.0F), swing, one - swing);
        // A fork that has not yet begun counts as far away: there may be no ridge where it will
        // start.
        const VF begun = unit((share - begin) * set(40.0F));
        distance = hn::Min(distance, (hn::Abs(within - fork) + (one - begun)) * set(1.0F / scale));
        clear_width = clear_width * (one - swing);
    }
    const VF half = gap * clear_width * set(0.5F);
    Slot slot;
    slot.depth = smooth(distance * gap / hn::Max(half, set(1e-4F)), 0.12F, 1.15F);
    if (plan.vein_rows > 0)
        slot.depth = slot.depth * (one - set(0.45F) * cross_veins(plan, x, share));
    slot.visible = shown(gap_texels * clear_width, 4.0F);
    return slot;
}

HWY_INLINE Slot pores(const HymeniumPlan& plan, VF share, VF turn) {
    const Cells cell = ring_cells(turn, share * set(plan.pore_rows), plan.pore_from, plan.pore_grow,
                                  plan.pore_tall, cell_jitter, plan.seed[5]);
    // Each tube has its own width, and is more or less filled.
    const VU drawn = hash(cell.id);
    const VF width = set(0.17F) + set(0.10F) * lower_part(drawn);
    const VF open = set(0.86F) + set(0.14F) * lower_part(hash(drawn));
    Slot slot;
    slot.depth = unit((cell.border - width * set(0.6F)) * set(3.4F));
    slot.depth = slot.depth * slot.depth * (set(3.0F) - set(2.0F) * slot.depth) * open;
    slot.visible = set(plan.pore_shown);
    return slot;
}

/// Returns the slot among spines seen from their tips: a cone on each cell's point, with deep flesh
/// between them.
HWY_INLINE Slot teeth(const HymeniumPlan& plan, VF share, VF turn) {
    const Cells cell = ring_cells(turn, share * set(plan.pore_rows), plan.pore_from, plan.pore_grow,
                                  1.0F, cell_jitter, plan.seed[5]);
    Slot slot;
    slot.depth = unit((cell.centre - set(0.4F * plan.spine)) * set(1.0F / (1.1F * plan.spine)));
    slot.visible = set(plan.pore_shown);
    return slot;
}

/// Computes the field of a lower face that is sampled at every other texel; the first two come from
/// the coarse grid.
HWY_INLINE void hymenium_fields(const HymeniumPlan& plan, const DiscPoint& p, VF* fields) {
    if ((plan.fields & (1U << hymenium_bump)) == 0) return;
    const VF f = set(hymenium_bump_frequency[0]);
    fields[hymenium_bump] = noise2(p.x * f, p.y * f, plan.seed[0]) * set(plan.bumps[0]);
}

/// Adds gills, ridges, pores or spines to a texel. share: 0 at the inner edge, 1 at the rim
HWY_INLINE void add_slots(const HymeniumPlan& plan, const DiscPoint& p, VF share, Layers& texel) {
    const VF one = set(1.0F);
    const VF turn = turn_of(p.cosine, p.sine);
    const Slot slot =
        plan.pattern == 1   ? gills(plan, p, share, turn, wander_at(plan.layout, turn, share))
        : plan.pattern == 2 ? ridges(plan, p, share, turn, wander_at(plan.layout, turn, share))
        : plan.pattern == 3 ? pores(plan, share, turn)
                            : teeth(plan, share, turn);
    const float mean_depth = plan.pattern >= 3 ? 0.5F : 0.45F;
    VF depth = mix(set(mean_depth), slot.depth, slot.visible);
    // Ridges fade out towards the stem.
    if (plan.pattern == 2) depth = depth * smooth(share, 0.0F, 4.5F);
    // Free gills leave a bare ring of flesh round the stem.
    const VF carried = one - (one - smooth(share, 0.55F * plan.inner_gap, plan.bare_slope)) *
                                 set(plan.inner_gap > 0.0F ? 1.0F : 0.0F);
    depth = depth * carried;
    // Before the margin they end, and leave a narrow smooth rim.
    if (plan.pattern <= 2) depth = depth * (one - smooth(share, 0.96F, 25.0F));
    VF deep = depth * depth;
    // Towards the rim gills and ridges are low, and light reaches the bottom between them.
    if (plan.pattern <= 2) deep = deep * (one - smooth(share, 0.72F, 4.0F) * set(0.75F));
    // Edge, face and bottom of the slot; the bottom is darkened by the relief.
    const VF on_edge =
        (one - smooth(slot.depth, 0.0F, plan.pattern == 1 ? 6.5F : 2.6F)) * slot.visible +
        (one - slot.visible) * set(0.2F) - (one - carried);
    // Light reaches the flesh between spines, which stand apart.
    const float between = plan.pattern == 4 ? 0.5F : 1.0F;
    texel.colour =
        mix(texel.colour, rgb(plan.depth), deep * set(between * (0.35F + 0.65F * plan.relief)));
    texel.colour = mix(texel.colour, rgb(plan.edge), unit(on_edge));
    texel.occlusion = texel.occlusion * mix(one, set(plan.slot_occlusion),
                                            deep * (set(0.5F) + set(0.5F) * depth) * set(between));
    const VF period = plan.pattern >= 3
                          ? set(1.0F / plan.pore_rows)
                          : p.radius * set(6.2831853F / static_cast<float>(plan.layout.blades));
    const VF rise = (one - deep) * slot.visible * period * carried;
    texel.height =
        texel.height * set(0.5F) + rise * set((plan.pattern == 2 ? 0.27F : 0.22F) * plan.relief);
}

/// Adds matted hairs along the meridians of a smooth face: strands, and finer hairs across them.
HWY_INLINE void add_felt(const HymeniumPlan& plan, const DiscPoint& p, VF share, const VF* fields,
                         Layers& texel) {
    const VF felt = set(plan.felt);
    const VF turn = turn_of(p.cosine, p.sine);
    const VF round = p.rho * set(6.2831853F / plan.disc.per_texel);
    const float strands = static_cast<float>(felt_hairs[0]);
    const float hairs = static_cast<float>(felt_hairs[1]);
    const VF strand =
        periodic_noise2(turn * set(strands) + fields[hymenium_middle] * set(1.6F),
                        share * set(7.0F) + fields[hymenium_uneven], felt_hairs[0], plan.seed[3]) *
        shown(round * set(1.0F / strands), 4.0F);
    const VF hair = periodic_noise2(turn * set(hairs) + strand * set(2.4F), share * set(24.0F),
                                    felt_hairs[1], plan.seed[4]) *
                    shown(round * set(1.0F / hairs), 4.0F);
    const VF up = strand + hair * set(0.6F);
    texel.colour = mix(texel.colour, rgb(plan.edge), unit(up * set(1.2F)) * felt);
    texel.colour = mix(texel.colour, rgb(plan.depth), unit(up * set(-1.3F)) * felt);
    texel.shade = texel.shade * (set(1.0F) + up * set(0.35F) * felt);
    texel.height = texel.height + (strand * set(0.8F / strands) + hair * set(0.6F / hairs)) * felt *
                                      set(6.2831853F) * p.radius;
    texel.occlusion = texel.occlusion + hn::Min(up, set(0.0F)) * set(0.5F) * felt;
}

/// Adds one set of cracks to a smooth face: plates that lie across the meridians, bulge between the
/// cracks, and are torn unevenly.
///
/// scale  plates per length and per turn, over those of the plan
/// size   of cracks: 1 gaping ones, less hair cracks, which are also paler and shallower
HWY_INLINE void add_cracks(const HymeniumPlan& plan, const DiscPoint& p, VF share, const VF* fields,
                           float scale, float size, std::uint32_t seed, Layers& texel) {
    const VF one = set(1.0F), zero = set(0.0F);
    const VF middle = fields[hymenium_middle], uneven = fields[hymenium_uneven];
    const float rows = scale * plan.crack_rows;
    const VF turn = turn_of(p.cosine, p.sine) + middle * set(0.012F);
    const VF y = hn::Max(share * set(rows) + middle * set(0.6F) + uneven * set(0.5F), zero);
    const Cells plate = ring_cells(turn, y, scale * plan.crack_from, plan.crack_grow, crack_tall,
                                   cell_jitter, seed);
    // Some cracks gape, others have hardly opened, and their edges are torn.
    const VF torn = noise2(p.x * set(5.0F * rows), p.y * set(5.0F * rows), seed + 1U);
    const VF half =
        hn::Max(set(0.03F + 0.03F * size) * (one + uneven * set(2.2F) + torn * set(0.8F)), zero);
    const VF open = (one - smooth(plate.border - half, -0.02F, 18.0F)) *
                    set(plan.cracks * (0.3F + 0.7F * size)) * unit(half * set(40.0F));
    const VF lip = (one - smooth(plate.border - half, 0.0F, 4.0F)) * (one - open);
    const VF tone = lower_part(hash(plate.id)) * set(plan.cracks);
    texel.shade = texel.shade * (one + tone * set(0.06F));
    texel.colour = mix(texel.colour, rgb(plan.depth), open * set(0.8F));
    texel.colour = mix(texel.colour, rgb(plan.edge), lip * set(0.35F * plan.cracks));
    texel.shade = texel.shade * (one - open * set(0.38F));
    texel.height = texel.height + (smooth(plate.border, 0.0F, 2.2F) * set(0.05F * plan.cracks) -
                                   open * set(0.14F)) *
                                      set(1.0F / rows);
    texel.occlusion = texel.occlusion * (one - open * set(0.55F));
}

/// Returns a texel of the lower face. fields: values of hymenium_fields() at this texel
HWY_INLINE Texel hymenium_texel(const HymeniumPlan& plan, const DiscPoint& p, const VF* fields) {
    const VF one = set(1.0F);
    const VF middle = fields[hymenium_middle];
    const VF share =
        hn::Max(p.rho - set(plan.disc.inner), set(0.0F)) * set(1.0F / (1.0F - plan.disc.inner));
    VF fine = set(0.0F);
    Layers texel;
    texel.height = set(0.0F);
    texel.shade = one;
    if ((plan.fields & (1U << hymenium_bump)) != 0) {
        fine = fields[hymenium_bump];
        texel.height = fine * set(0.14F / hymenium_bump_frequency[0]);
    }
    // Gills and pores have their own fine detail.
    if (plan.pattern == 0 && plan.bumps[1] > 0.0F) {
        const VF f = set(hymenium_bump_frequency[1]);
        const VF n = noise2(p.x * f, p.y * f, plan.seed[6]) * set(plan.bumps[1]);
        fine = fine + n;
        texel.height = texel.height + n * set(0.14F / hymenium_bump_frequency[1]);
    }
    const VF cloud = fields[hymenium_uneven] * set(0.7F) + middle * set(0.5F) + fine * set(0.35F);
    texel.occlusion = one + hn::Min(fine, set(0.0F)) * set(0.2F);
    texel.colour = rgb(plan.colour);
    if (plan.pattern == 0) {
        // A smooth face has clouds between its colours, and the finest grain.
        texel.colour = mix(texel.colour, rgb(plan.depth),
                           unit(cloud * set(0.55F * plan.mottle) + set(0.08F * plan.mottle)));
        texel.colour =
            mix(texel.colour, rgb(plan.edge), unit(set(0.0F) - cloud * set(0.45F * plan.mottle)));
        texel.height = texel.height * set(0.35F + plan.relief);
        if (plan.felt > 0.0F) add_felt(plan, p, share, fields, texel);
        if (plan.cracks > 0.0F) {
            add_cracks(plan, p, share, fields, 1.0F, 1.0F, plan.seed[5], texel);
            add_cracks(plan, p, share, fields, 2.3F, 0.45F, plan.seed[2], texel);
        }
    } else {
        // Pores are darker in patches, where they are more open or bruised.
        if (plan.pattern == 3)
            texel.colour =
                mix(texel.colour, rgb(plan.depth), unit(cloud * set(0.7F * plan.mottle)));
        add_slots(plan, p, share, texel);
    }
    // Where the face bends into the stem, it is the flesh of the stem, whose skin runs out in it
    // unevenly.
    if (plan.joined > 0.0F) {
        const VF stem = (one - smooth(share + fields[hymenium_uneven] * set(0.02F) +
                                          middle * set(0.02F),
                                      0.035F, 1.0F / 0.075F)) *
                        set(plan.joined);
        texel.colour = mix(texel.colour, rgb(plan.stem), stem);
        texel.occlusion = mix(texel.occlusion, one, stem * set(0.25F));
    }
    const VF shade = one + cloud * set(0.20F * plan.mottle) + fine * set(0.05F);
    Texel out;
    out.colour = shaded(texel.colour, hn::Max(shade * texel.shade, set(0.05F)));
    out.height = texel.height;
    out.roughness = set(plan.roughness) + fine * set(0.03F) + middle * set(0.03F * plan.mottle);
    out.occlusion = texel.occlusion;
    return out;
}

}  // namespace HWY_NAMESPACE
}  // namespace sporeprint
HWY_AFTER_NAMESPACE();

#endif
