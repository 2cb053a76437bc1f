// Relief of the upper face on vectors of texels: the same folds, pits and tiers that
// core/geometry/relief.cpp raises in the mesh.
#if defined(SPOREPRINT_CORE_SURFACE_RELIEF_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SPOREPRINT_CORE_SURFACE_RELIEF_INL
#undef SPOREPRINT_CORE_SURFACE_RELIEF_INL
#else
#define SPOREPRINT_CORE_SURFACE_RELIEF_INL
#endif

#include "core/individual/relief.h"
#include "core/surface/texel.inl"

HWY_BEFORE_NAMESPACE();
namespace sporeprint {
namespace HWY_NAMESPACE {

/// Returns the cell of a texel in a honeycomb with rows across y.
HWY_INLINE Cells pit_cells(const ReliefPlan& plan, VF turn_at, VF y_at) {
    VF turn = turn_at, y = y_at;
    const auto waves = static_cast<float>(pit_bend_waves(static_cast<int>(plan.pit_columns)));
    for (std::uint32_t i = 0; i < 2; ++i) {
        const PitBend& across = pit_bends_across[i];
        y = y + wave(turn_at * set(static_cast<float>(across.round) * waves) +
                     y_at * set(static_cast<float>(across.down)) +
                     set(static_cast<float>(pit_bend_phase(plan.seed[2], i)))) *
                    set(static_cast<float>(across.height));
        const PitBend& along = pit_bends_along[i];
        turn = turn + wave(turn_at * set(static_cast<float>(along.round)) +
                           y_at * set(static_cast<float>(along.down)) +
                           set(static_cast<float>(pit_bend_phase(plan.seed[2], 2 + i)))) *
                          set(static_cast<float>(along.height) / plan.pit_columns);
    }
    const VF row = hn::Floor(y);
    Neighbours<9> all;
    all.begin();
    for (int j = 0; j < 3; ++j) {
        const VF this_row = row + set(static_cast<float>(j - 1));
        const VF rise = set(static_cast<float>(pit_first)) +
                        (this_row + set(0.5F)) * set(static_cast<float>(pit_rise) / plan.pit_rows);
        const VF columns =
            hn::Max(hn::Floor(set(plan.pit_columns) * unit(rise) + set(0.5F)), set(3.0F));
        const VF half_row = this_row * set(0.5F);
        const VF x = turn * columns - (half_row - hn::Floor(half_row));
        const VF column = hn::Floor(x);
        const VU row_bits = whole_bits(this_row) * word(prime_y) + word(plan.seed[2]);
        for (int i = 0; i < 3; ++i) {
            const VF this_column = column + set(static_cast<float>(i - 1));
            VF wrapped = this_column;
            wrapped = wrapped + hn::IfThenElseZero(wrapped < set(0.0F), columns);
            wrapped = wrapped - hn::IfThenElseZero(wrapped >= columns, columns);
            const VU h = hash(hn::Xor(whole_bits(wrapped) * word(prime_x), row_bits));
            const float jitter = static_cast<float>(pit_jitter);
            all.add(this_column + set(0.5F) + upper_part(h) * set(jitter) - x,
                    this_row + set(0.5F) + lower_part(h) * set(jitter) - y, h);
        }
    }
    return all.found();
}

/// Returns the relative depth of folds at a value of noise, 0..1.
HWY_INLINE VF crease_of(VF noise, VF crests) {
    const VF one = set(1.0F);
    const VF bottom = set(static_cast<float>(crease_round));
    const VF root = hn::Sqrt(noise * noise + bottom * bottom);
    const VF near =
        one - hn::Min((root - bottom) * set(static_cast<float>(1.0 / crease_half)), one);
    const VF swollen = near * near;
    return swollen + crests * (one - swollen - swollen);
}

/// Adds the relief to a texel of the cap: height, colour of hollows and their shade.
HWY_INLINE void add_relief(const ReliefPlan& plan, const DiscPoint& p, Texel& texel) {
    const VF one = set(1.0F);
    VF height = set(0.0F);
    VF hollow = set(0.0F);
    VF dark = set(0.0F);
    if (plan.folds > 0.0F) {
        const VF angle = p.rho * set(1.5707963F);
        const VF q = angle * angle;
        const VF sine =
            angle * (one + q * (set(-1.0F / 6.0F) +
                                q * (set(1.0F / 120.0F) +
                                     q * (set(-1.0F / 5040.0F) + q * set(1.0F / 362880.0F)))));
        const VF fall =
            q * (set(0.5F) +
                 q * (set(-1.0F / 24.0F) + q * (set(1.0F / 720.0F) + q * set(-1.0F / 40320.0F))));
        const auto noise = [&](std::size_t octave, float size) {
            const VF f = set(size);
            return noise3(f * sine * p.cosine, f * fall, f * sine * p.sine, plan.seed[octave]);
        };
        const VF fine = noise(1, plan.fold_size * static_cast<float>(finer_creases));
        const VF coarse = noise(0, plan.fold_size) + fine * set(static_cast<float>(crease_winding));
        const VF crests = set(plan.crests);
        const VF depth = crease_of(coarse, crests) * set(static_cast<float>(1.0 - fine_creases)) +
                         crease_of(fine, crests) * set(static_cast<float>(fine_creases));
        height = height - depth * set(plan.fold_slope);
        hollow = hn::Max(hollow, depth);
        dark = dark + depth * set(plan.folds * 30.0F);
    }
    if (plan.pits > 0.0F) {
        const Cells cells = pit_cells(plan, turn_of(p.cosine, p.sine), p.rho * set(plan.pit_rows));
        const VF floor = smooth(cells.border, plan.rib, 1.0F / static_cast<float>(pit_slope)) *
                         (set(0.85F) + set(0.15F) * upper_part(hash(cells.id)));
        height = height - floor * set(plan.pit_slope);
        hollow = hn::Max(hollow, floor);
        dark = dark + floor * set(plan.pits * 16.0F);
    }
    if (plan.tiers > 0.0F) {
        const VF groove = set(0.5F) + set(0.5F) * wave(p.rho * set(plan.tier_count));
        height = height - groove * groove * set(plan.tier_slope);
        hollow = hn::Max(hollow, groove * groove);
        dark = dark + groove * groove * set(plan.tiers * 16.0F);
    }
    const VF window = smooth(p.rho, static_cast<float>(relief_apex),
                             static_cast<float>(1.0 / (relief_apex_end - relief_apex))) *
                      (one - smooth(p.rho, static_cast<float>(relief_margin),
                                    static_cast<float>(1.0 / (1.0 - relief_margin))));
    texel.height = texel.height + height * window;
    texel.colour = mix(texel.colour, rgb(plan.hollow), hollow * window * set(plan.tint));
    texel.occlusion = texel.occlusion * (one - set(0.62F) * unit(dark) * window);
}

}  // namespace HWY_NAMESPACE
}  // namespace sporeprint
HWY_AFTER_NAMESPACE();

#endif
