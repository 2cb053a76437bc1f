// Building blocks of all kernels, on vectors of texels: coordinates on discs, colours, waves and
// cells.
#if defined(SPOREPRINT_CORE_SURFACE_TEXEL_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SPOREPRINT_CORE_SURFACE_TEXEL_INL
#undef SPOREPRINT_CORE_SURFACE_TEXEL_INL
#else
#define SPOREPRINT_CORE_SURFACE_TEXEL_INL
#endif

#include "core/math/noise.inl"
#include "core/surface/plan.h"

HWY_BEFORE_NAMESPACE();
namespace sporeprint {
namespace HWY_NAMESPACE {

inline constexpr int widest = 2048;
// Padded, so that the planes of a row do not map to the same cache lines.
inline constexpr int padded = widest + 32;

struct Rgb {
    VF r, g, b;
};

HWY_INLINE Rgb rgb(const Light& light) { return {set(light.r), set(light.g), set(light.b)}; }
HWY_INLINE Rgb mix(const Rgb& a, const Rgb& b, VF weight) {
    return {mix(a.r, b.r, weight), mix(a.g, b.g, weight), mix(a.b, b.b, weight)};
}
HWY_INLINE Rgb shaded(const Rgb& colour, VF factor) {
    return {colour.r * factor, colour.g * factor, colour.b * factor};
}

/// Returns the colour of torn flesh that has dried. dry: 0..1
HWY_INLINE Rgb dried(const Rgb& flesh, VF dry) {
    return mix(flesh, {flesh.r * set(0.66F), flesh.g * set(0.50F), flesh.b * set(0.34F)}, dry);
}

/// Result of painting a texel. Height is in disc radii, or in lengths of the strip.
struct Texel {
    Rgb colour;
    VF height, roughness, occlusion;
};

/// A texel to which one feature after the other is added; `shade` multiplies the colour at the end.
struct Layers {
    Rgb colour;
    VF shade, height, roughness, occlusion;
};

/// Grain that is left where two parts pass into each other; a skin without any would be seen as a band.
constexpr float joined_grain = 0.4F;

/// Fades the grain of a part to joined_grain, from a share of the way to the part that it passes into,
/// so that no line is seen between the grains of both. Returns the grain that is left, 1 before it.
HWY_INLINE VF fade_grain(Layers& texel, VF way, float from) {
    const VF one = set(1.0F);
    const VF left = one - set(1.0F - joined_grain) * smooth(way, from, 1.0F / (1.0F - from));
    texel.shade = mix(one, texel.shade, left);
    texel.height = texel.height * left;
    texel.occlusion = mix(one, texel.occlusion, left);
    return left;
}

/// Position of a texel on a disc.
struct DiscPoint {
    VF x, y;          ///< on the disc, in disc radii
    VF rho;           ///< distance from the pole, at most 1
    VF widening;      ///< length of a step round the axis over that on the disc
    VF cosine, sine;  ///< of the angle round the pole
    VF radius;        ///< distance from the axis, in disc radii
    VF height;        ///< along the axis, in disc radii
};

HWY_INLINE DiscPoint disc_point_of(const DiscPlan& plan, VF x, VF y) {
    DiscPoint p;
    p.x = x;
    p.y = y;
    const VF far = hn::Sqrt(x * x + y * y);
    const VF inverse = set(1.0F) / hn::Max(far, set(1e-6F));
    p.cosine = x * inverse;
    p.sine = y * inverse;
    p.rho = hn::Min(far, set(1.0F));
    if (plan.bend > 0.0F) {
        const VF angle = hn::Min(p.rho * set(plan.bend), set(1.5707963F));
        const VF q = angle * angle;
        const VF sine =
            angle * (set(1.0F) + q * (set(-1.0F / 6.0F) +
                                      q * (set(1.0F / 120.0F) + q * (set(-1.0F / 5040.0F) +
                                                                     q * set(1.0F / 362880.0F)))));
        const VF fall =
            q * (set(0.5F) +
                 q * (set(-1.0F / 24.0F) + q * (set(1.0F / 720.0F) + q * set(-1.0F / 40320.0F))));
        p.radius = set(plan.sphere) * sine;
        p.height =
            set(plan.sphere) * fall + hn::Max(p.rho - set(plan.sphere * 1.5707963F), set(0.0F));
    } else {
        const VF share =
            hn::Max(p.rho - set(plan.inner), set(0.0F)) * set(1.0F / (1.0F - plan.inner));
        p.radius = set(plan.cone_from) + set(plan.cone_grow) * share;
        p.height = set(0.0F);
    }
    p.widening = p.radius * hn::Max(inverse, set(1.0F));
    return p;
}

/// Intersection of a row with an ellipse: middle relative to the ellipse's centre, and half length,
/// which is 0 if they do not intersect.
struct Chord {
    float middle = 0.0F, half = 0.0F;
};

/// oval    along_x, along_y, per_length, per_width: direction of one axis, and 1 / half axes
/// dy      offset of the row from the oval's centre
/// window  squared size of the ellipse, in those half axes
template <class Oval>
HWY_INLINE Chord chord_of(const Oval& oval, float dy, float window) {
    const float l = oval.per_length * oval.per_length;
    const float w = oval.per_width * oval.per_width;
    const float ax = oval.along_x;
    const float ay = oval.along_y;
    const float square = ax * ax * l + ay * ay * w;
    const float cross = dy * ax * ay * (l - w);
    const float rest = dy * dy * (ay * ay * l + ax * ax * w) - window;
    const float inside = cross * cross - square * rest;
    if (inside <= 0.0F) return {};
    HWY_ALIGN float root[8] = {};
    hn::Store(hn::Sqrt(set(inside)), Floats(), root);
    return {0.0F - cross / square, root[0] / square};
}

/// Returns the angle of a unit vector in turns, 0..1.
HWY_INLINE VF turn_of(VF cosine, VF sine) {
    const VF x = hn::Abs(cosine);
    const VF y = hn::Abs(sine);
    const VF t = hn::Min(x, y) / hn::Max(hn::Max(x, y), set(1e-9F));
    const VF q = t * t;
    // Minimax polynomial of the arc tangent on 0..1, error 1e-5, scaled to turns.
    VF angle = set(-0.01172120F);
    angle = angle * q + set(0.05265332F);
    angle = angle * q + set(-0.11643287F);
    angle = angle * q + set(0.19354346F);
    angle = angle * q + set(-0.33262347F);
    angle = angle * q + set(0.99997726F);
    angle = angle * t * set(0.15915494F);
    angle = hn::IfThenElse(y > x, set(0.25F) - angle, angle);
    angle = hn::IfThenElse(cosine < set(0.0F), set(0.5F) - angle, angle);
    return hn::IfThenElse(sine < set(0.0F), set(1.0F) - angle, angle);
}

/// Returns a cubic approximation of a cosine of period 1: 1 at whole numbers, -1 half-way between.
HWY_INLINE VF wave(VF t) {
    const VF u = hn::Abs(t - hn::Floor(t) - set(0.5F)) * set(2.0F);
    return u * u * (set(6.0F) - set(4.0F) * u) - set(1.0F);
}

/// Returns the visibility of a pattern whose period is `texels` long: 0 below two, 1 from `full`
/// on.
HWY_INLINE VF shown(VF texels, float full) {
    return unit((texels - set(2.0F)) * set(1.0F / (full - 2.0F)));
}

/// Position of a texel among scattered cells.
struct Cells {
    VF border;  ///< distance to the border with the next cell, in cells
    VF centre;  ///< distance to the cell's own point
    VU id;      ///< hash of the cell
};

// Accumulates the points of nearby cells, relative to a texel.
template <int Most>
struct Neighbours {
    VF dx[Most];
    VF dy[Most];
    VF nearest, near_x, near_y;
    VU id;
    int count;

    // Not a constructor, because the compiler would build that without the instruction set.
    HWY_INLINE void begin() {
        nearest = set(1e9F);
        near_x = set(0.0F);
        near_y = set(0.0F);
        id = word(0);
        count = 0;
    }

    HWY_INLINE void add(VF x, VF y, VU cell) {
        dx[count] = x;
        dy[count] = y;
        ++count;
        const VF far = x * x + y * y;
        const auto closer = far < nearest;
        nearest = hn::IfThenElse(closer, far, nearest);
        near_x = hn::IfThenElse(closer, x, near_x);
        near_y = hn::IfThenElse(closer, y, near_y);
        id = hn::IfThenElse(hn::RebindMask(Words(), closer), cell, id);
    }

    // Returns the distance to the nearest bisector between the nearest point and another.
    HWY_INLINE Cells found() const {
        VF border = set(1e9F);
        for (int k = 0; k < Most; ++k) {
            const VF ex = dx[k] - near_x;
            const VF ey = dy[k] - near_y;
            const VF apart = ex * ex + ey * ey;
            const VF twice = dx[k] * dx[k] + dy[k] * dy[k] - nearest;
            const VF square = twice * twice / hn::Max(apart, set(1e-6F));
            border = hn::IfThenElse(apart > set(1e-6F), hn::Min(border, square), border);
        }
        return {hn::Sqrt(border) * set(0.5F), hn::Sqrt(nearest), id};
    }
};

/// Returns the cell of a texel among cells with one point each, in rows across y; row j has
/// floor(from + grow * (j + 0.5)) of them round the turn, at least 3. So they neither stretch where
/// a surface widens nor break at the seam. Cells are `tall` times as long as wide.
///
/// source  [Worley1996]; the border distance is that to the bisector, exact in the metric of the
///         surface. Of each row only the two nearest points are examined, which is enough for
///         jitter below 0.4 near the borders, where it is used
HWY_INLINE Cells ring_cells(VF turn, VF y, float from, float grow, float tall, float jitter,
                            std::uint32_t seed) {
    const VF row = hn::Floor(y);
    Neighbours<6> all;
    all.begin();
    for (int j = 0; j < 3; ++j) {
        const VF this_row = row + set(static_cast<float>(j - 1));
        const VF count =
            grow == 0.0F
                ? set(from)
                : hn::Max(hn::Floor(set(from) + set(grow) * (this_row + set(0.5F))), set(3.0F));
        // Odd rows are shifted by half a cell: the start of a hexagonal order.
        const VF half_row = this_row * set(0.5F);
        const VF x = turn * count - (half_row - hn::Floor(half_row));
        const VF column = hn::Floor(x - set(0.5F));
        const VU row_bits = whole_bits(this_row) * word(prime_y) + word(seed);
        for (int i = 0; i < 2; ++i) {
            const VF this_column = column + set(static_cast<float>(i));
            VF wrapped = this_column;
            wrapped = wrapped + hn::IfThenElseZero(wrapped < set(0.0F), count);
            wrapped = wrapped - hn::IfThenElseZero(wrapped >= count, count);
            const VU h = hash(hn::Xor(whole_bits(wrapped) * word(prime_x), row_bits));
            all.add(this_column + set(0.5F) + upper_part(h) * set(jitter) - x,
                    (this_row + set(0.5F) + lower_part(h) * set(jitter) - y) * set(tall), h);
        }
    }
    return all.found();
}

/// Returns the cell of a texel among cells of the plane, one unit in size.
HWY_INLINE Cells plane_cells(VF x, VF y, float jitter, std::uint32_t seed) {
    const VF column = hn::Floor(x);
    const VF row = hn::Floor(y);
    Neighbours<9> all;
    all.begin();
    for (int j = 0; j < 3; ++j) {
        const VF this_row = row + set(static_cast<float>(j - 1));
        const VU row_bits = whole_bits(this_row) * word(prime_y) + word(seed);
        for (int i = 0; i < 3; ++i) {
            const VF this_column = column + set(static_cast<float>(i - 1));
            const VU h = hash(hn::Xor(whole_bits(this_column) * word(prime_x), row_bits));
            all.add(this_column + set(0.5F) + upper_part(h) * set(jitter) - x,
                    this_row + set(0.5F) + lower_part(h) * set(jitter) - y, h);
        }
    }
    return all.found();
}

}  // namespace HWY_NAMESPACE
}  // namespace sporeprint
HWY_AFTER_NAMESPACE();

#endif
