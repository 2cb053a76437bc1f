// How far the spores of one fruit body travel.
#pragma once

#include <optional>

#include "core/math/random.h"
#include "core/world/wind.h"

namespace sporeprint {

/// The Wald (inverse Gaussian) distribution of the distance at which particles that the wind carries reach the ground.
struct WaldLaw {
    double mean = 0.0;   ///< metres; 0 if there is no wind
    double shape = 1.0;  ///< lambda, metres

    /// Returns the density at a distance r > 0, per metre.
    [[nodiscard]] double density(double r) const;
    /// Returns the share that lands within a distance r > 0; error below 1e-6.
    [[nodiscard]] double within(double r) const;
    /// Draws a distance. The mean of many is exact, whatever the normal deviate is.
    ///
    /// source  [Michael1976]
    [[nodiscard]] double sample(Random& random) const;
};

/// How spores leave one fruit body.
struct SporeRelease {
    double height = 0.06;      ///< above the ground, metres, greater than 0
    double settling = 0.0015;  ///< speed of their fall in still air, m/s, greater than 0
    double wind = 0.1;         ///< at that height, m/s
    double cover = 0.15;       ///< height of the plants among which they leave it, metres
};

/// Returns the distances to which a steady wind carries spores.
///
/// source  [Katul2005] eq. 9: mean u h / v, shape (h / sigma)^2, sigma^2 = 0.4 cover 2 (sigma_w / u); the deviation of
///         the vertical wind is taken as a quarter of the wind
[[nodiscard]] WaldLaw wald_law(const SporeRelease& release);

/// Scale of the share of spores that falls right below and beside the cap, metres: 95 % within 0.58 m [Galante2011].
inline constexpr double near_scale = 0.122;

/// The share of spores that the wind takes along of which all come down in sight; the others are gone with the wind.
inline constexpr double carried_share = 0.2;

/// Where the spores of one fruit body come down: a mixture of those that fall beside it, those that the wind carries
/// and those that rise above the plants and are gone.
struct DispersalKernel {
    double beside =
        1.0;  ///< share that falls beside it, by the density e^(-r / a) / (2 pi a^2) per m^2
    double carried = 0.0;  ///< share that lands as `wald` says
    double gone = 0.0;     ///< share that lands nowhere near
    WaldLaw wald;

    /// Returns the share of all spores that lands within a distance r > 0, metres.
    [[nodiscard]] double within(double r) const;
    /// Returns the density at a place relative to the body, per m^2. Between the sectors of the rose the wind is linear
    /// in its direction.
    [[nodiscard]] double density(const WindRose& rose, double east, double north) const;
};

/// Returns the kernel of a fruit body.
///
/// source  shares chosen so that 95 % fall within 0.58 m in still air [Galante2011], while a cloud of spores loses
///         13 to 24 % within 10 m of open grass
[[nodiscard]] DispersalKernel dispersal_kernel(const SporeRelease& release);

/// Where a spore lands, metres from its body.
struct Landing {
    double east = 0.0, north = 0.0;
};

/// Draws where a spore lands; nothing if it is gone.
[[nodiscard]] std::optional<Landing> sample(const DispersalKernel& kernel, const WindRose& rose,
                                            Random& random);

}  // namespace sporeprint
