// Paints the texels of the ground that a mushroom brings along: soil, litter, strands of mycelium.
#if defined(SPOREPRINT_CORE_SURFACE_GROUND_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SPOREPRINT_CORE_SURFACE_GROUND_INL
#undef SPOREPRINT_CORE_SURFACE_GROUND_INL
#else
#define SPOREPRINT_CORE_SURFACE_GROUND_INL
#endif

#include "core/surface/texel.inl"

HWY_BEFORE_NAMESPACE();
namespace sporeprint {
namespace HWY_NAMESPACE {

HWY_INLINE void ground_fields(const GroundPlan& plan, VF round, VF up, VF* fields) {
    // A clod shows the whole strip round it.
    fields[ground_cloud] = periodic_noise2(round * set(24.0F), up * set(20.0F), 24, plan.seed[0]);
    // Litter has aged by whole pieces, each of which shows a narrow part of the strip.
    fields[ground_age] = noise2(round * set(5.0F), up * set(0.7F), plan.seed[1]);
}

/// Returns a texel of the ground. round: 0..1 round a solid; up: 0..1 across the strip's bands.
/// Heights are in lengths of the strip.
HWY_INLINE Texel ground_texel(const GroundPlan& plan, VF round, VF up, const VF* fields) {
    const VF one = set(1.0F), zero = set(0.0F);
    const VF cloud = fields[ground_cloud], age = fields[ground_age];
    const VF fibre =
        noise2(round * set(static_cast<float>(ground_cells[0])), up * set(7.0F), plan.seed[2]) *
        set(plan.shown[0]);
    const float n = static_cast<float>(ground_cells[1]);
    const VF grain = periodic_noise2(round * set(n), up * set(n), ground_cells[1], plan.seed[3]) *
                     set(plan.shown[1]);
    const float m = static_cast<float>(ground_cells[2]);
    const VF fine = periodic_noise2(round * set(m), up * set(m), ground_cells[2], plan.seed[2]) *
                    set(plan.shown[2]);
    Texel out;
    // Soil: crumbs of humus, dark between them, paler grains of sand, and thin roots.
    const VF sand = smooth(fine + grain * set(0.3F), 0.40F, 1.0F / 0.2F) * set(0.42F);
    const VF thread = noise2(round * set(17.0F), up * set(9.0F), plan.seed[1]);
    const VF root =
        smooth(one - hn::Abs(thread + grain * set(0.10F) + cloud * set(0.25F)) * set(9.0F), 0.35F,
               1.0F / 0.5F) *
        smooth(cloud, 0.0F, 1.0F / 0.2F) * set(0.5F);
    const VF gap = smooth(zero - grain - fine * set(0.4F), 0.12F, 1.0F / 0.4F);
    const VF tone = set(1.30F) + cloud * set(0.45F) + grain * set(0.55F) + fine * set(0.55F);
    // Humus is greyer than the clay between it, and each clod has its own share of both.
    const VF light = set(0.3F * plan.soil.r + 0.6F * plan.soil.g + 0.1F * plan.soil.b);
    const VF humus = unit(set(0.50F) + age * set(0.55F) + grain * set(0.30F) - fine * set(0.20F));
    const Rgb ground =
        mix(rgb(plan.soil), Rgb{light * set(1.02F), light * set(0.92F), light * set(0.80F)}, humus);
    const Rgb crumbs = mix(
        shaded(ground, hn::Max(tone - humus * set(0.25F), set(0.2F)) * (one - gap * set(0.62F))),
        Rgb{set(0.36F), set(0.31F), set(0.24F)}, sand);
    const Rgb soil = mix(crumbs, Rgb{set(0.30F), set(0.23F), set(0.15F)}, root);
    // Litter: fibres along it, and dark spots of decay.
    const VF old = smooth(age + cloud * set(0.12F), -0.25F, 1.0F / 0.5F);
    const VF rot = smooth(cloud + grain * set(0.4F), 0.38F, 1.0F / 0.35F) * set(0.6F);
    const Rgb litter = shaded(mix(mix(rgb(plan.litter), rgb(plan.aged), old), rgb(plan.soil), rot),
                              one + fibre * set(0.30F) + grain * set(0.12F));
    // Strands: felted, with soil between their hyphae.
    const VF soiled = smooth(grain * set(0.6F) + cloud * set(0.5F), 0.22F, 1.0F / 0.4F) * set(0.6F);
    const Rgb strand =
        mix(shaded(rgb(plan.strands), one + fibre * set(0.10F)), rgb(plan.soil), soiled);
    const float first = static_cast<float>(0.5 * (ground_bands[0].to + ground_bands[1].from));
    const float second = static_cast<float>(0.5 * (ground_bands[1].to + ground_bands[2].from));
    const VF above_soil = smooth(up, first - 0.01F, 1.0F / 0.02F);
    const VF above_litter = smooth(up, second - 0.01F, 1.0F / 0.02F);
    out.colour = mix(mix(soil, litter, above_soil), strand, above_litter);
    const VF rough = grain * (one - above_soil * set(0.7F));
    const VF crumbled = fine * (one - above_soil);
    out.height = rough * set(0.34F / n) + crumbled * set(0.26F / m) +
                 root * (one - above_soil) * set(0.10F / n) + fibre * above_soil * set(0.10F / n);
    out.roughness = set(0.95F) - above_soil * set(0.08F) + grain * set(0.03F);
    out.occlusion = one + hn::Min(rough + crumbled * set(0.5F), zero) * set(0.6F);
    return out;
}

}  // namespace HWY_NAMESPACE
}  // namespace sporeprint
HWY_AFTER_NAMESPACE();

#endif
