// Paints the texels of inner tissue: the faces of gills, ridges and spines, and torn flesh.
#if defined(SPOREPRINT_CORE_SURFACE_TISSUE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SPOREPRINT_CORE_SURFACE_TISSUE_INL
#undef SPOREPRINT_CORE_SURFACE_TISSUE_INL
#else
#define SPOREPRINT_CORE_SURFACE_TISSUE_INL
#endif

#include "core/surface/texel.inl"

HWY_BEFORE_NAMESPACE();
namespace sporeprint {
namespace HWY_NAMESPACE {

HWY_INLINE void blade_fields(const BladePlan& plan, VF along, VF across, VF* fields) {
    fields[blade_cloud] = noise2(along * set(14.0F), across * set(2.6F), plan.seed[0]);
    fields[blade_uneven] = noise2(along * set(5.0F), across * set(1.2F), plan.seed[1]);
}

/// Returns a texel of a blade. along: 0 at the stem, 1 at the margin; across: 0 at the base, 1 at
/// the edge. Heights are in lengths of the blade.
HWY_INLINE Texel blade_texel(const BladePlan& plan, VF along, VF across, const VF* fields) {
    const VF one = set(1.0F);
    Texel out;
    const VF down = unit(across);
    const VF cloud = fields[blade_uneven] * set(0.7F) + fields[blade_cloud] * set(0.5F);
    // Blades show different windows of the strip, so slow changes along it tell one from another.
    const VF tone = noise2(along * set(4.0F), across * set(0.35F), plan.seed[3]);
    // Faint lines run from the base towards the edge, and fade out before they reach it.
    const VF line = noise2(along * set(blade_grain) + fields[blade_cloud] * set(0.8F),
                           across * set(2.2F), plan.seed[2]) *
                    set(plan.grain) * (one - down * set(0.6F));
    const VF on_edge = smooth(down + fields[blade_cloud] * set(0.03F), 0.87F, 11.0F);
    // Share of the sky that a point of the wall sees, and light reflected between pale walls. Thin
    // pale walls also transmit light, which is modelled as a shallower slot.
    const VF d = (one - down) * set(plan.steep * (1.0F - 0.7F * plan.pale));
    const VF open = one - d / hn::Sqrt(d * d + one);
    const VF seen = open / (one - set(plan.pale) * (one - open));
    Rgb colour = mix(rgb(plan.colour), rgb(plan.depth),
                     (one - seen) * set(0.75F * (1.0F - 0.3F * plan.pale)));
    colour = mix(colour, rgb(plan.depth), unit(tone * set(-0.5F)) * set(0.6F));
    colour = mix(colour, rgb(plan.edge), on_edge);
    out.colour = shaded(colour, hn::Max(one + cloud * set(0.20F * plan.mottle) + tone * set(0.09F) +
                                            line * set(0.12F),
                                        set(0.05F)));
    out.height = line * set(0.16F / blade_grain) + fields[blade_cloud] * set(0.0015F);
    out.roughness = set(plan.roughness) + line * set(0.04F);
    out.occlusion = set(0.12F + 0.45F * plan.pale) + set(0.88F - 0.45F * plan.pale) * seen;
    return out;
}

HWY_INLINE void flesh_fields(const FleshPlan& plan, VF along, VF across, VF* fields) {
    // Torn fibres run inwards from the cuticle.
    fields[flesh_fibre] =
        noise2(along * set(34.0F), across * set(5.0F), plan.seed[0]) * set(plan.bumps[1]);
    fields[flesh_cloud] = noise2(along * set(7.0F), across * set(4.0F), plan.seed[1]);
}

/// Returns a texel of torn flesh. along: along the tear; across: 0 under the cuticle, 1 where it is
/// deepest. Heights are in lengths of the strip.
HWY_INLINE Texel flesh_texel(const FleshPlan& plan, VF along, VF across, const VF* fields) {
    const VF one = set(1.0F);
    Texel out;
    const VF fibre = fields[flesh_fibre];
    const VF cloud = fields[flesh_cloud];
    const float wide = static_cast<float>(flesh_width);
    VF grain = set(0.0F);
    VF height = fibre * set(0.004F);
    for (std::size_t octave = 0; octave < 3; ++octave) {
        if (plan.bumps[octave] <= 0.0F) continue;
        const float f = flesh_bump_frequency[octave];
        const VF n = noise2(along * set(f), across * set(f * wide),
                            plan.seed[2] + static_cast<std::uint32_t>(octave)) *
                     set(plan.bumps[octave]);
        grain = grain + n;
        height = height + n * set(0.16F / f);
    }
    const VF shade = one + fibre * set(0.05F) + grain * set(0.07F) + cloud * set(0.04F);
    // It dries in clouds, first along both edges.
    const VF edge = one - smooth(across, 0.02F, 9.0F) * (one - smooth(across, 0.80F, 7.0F));
    const VF dry = unit(set(0.34F) + cloud * set(0.22F) + grain * set(0.14F) + edge * set(0.45F));
    out.colour = shaded(dried(rgb(plan.colour), dry), shade);
    out.height = height;
    out.roughness = set(plan.roughness) + grain * set(0.04F);
    out.occlusion = one + hn::Min(grain + fibre * set(0.6F), set(0.0F)) * set(0.3F) -
                    set(0.25F) * smooth(across, 0.35F, 1.5F);
    return out;
}

}  // namespace HWY_NAMESPACE
}  // namespace sporeprint
HWY_AFTER_NAMESPACE();

#endif
