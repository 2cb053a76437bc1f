// How wind moves mushrooms and stems, and what a file states about it.
#pragma once

#include <vector>

#include "core/individual/individual.h"
#include "core/mesh/mesh.h"
#include "core/params/shared_params.h"
#include "core/params/value.h"

namespace sporeprint {

/// What a file states about wind: where its weights are, and the displacements for weights of 1 in
/// a breeze of 3 m/s, metres.
struct Wind {
    WindFormat format = WindFormat::none;
    double sway = 0.0, flutter = 0.0;
};

/// Displacements of the tip of a leaf, in its lengths, and of the top of a tree, in the distance of
/// its farthest twig from its foot, in a breeze of 3 m/s. No measurement is recorded.
inline constexpr double leaf_sway = 0.1, leaf_flutter = 0.12, tree_sway = 0.04;

/// Returns {"channels":{"bend","flutter","phase","branch"},"sway_m","flutter_m"}; the channels are
/// names of vertex attributes with a component.
///
/// pre  a format other than none
[[nodiscard]] Value wind_value(const Wind& wind);

/// Returns the displacement of a cantilever that is loaded at its end, as a share of the
/// displacement of the end; beyond the end it goes on straight.
///
/// along   position / length
/// source  Euler-Bernoulli beam: (3 x^2 - x^3) / 2
[[nodiscard]] double deflection(double along);

/// A stem with what it carries, metres.
struct SwayingStem {
    double length = 0.0;      ///< from the ground to the cap; 0 for what does not bend
    double radius = 0.0;      ///< at the cap
    double top = 0.0;         ///< height of the whole
    double cap_radius = 0.0;  ///< greatest
};

/// Returns the stem of an individual; one of length 0 if it grows from a wall.
[[nodiscard]] SwayingStem swaying_stem(const Individual& individual);

/// Returns the displacement of the top in a breeze of 3 m/s: that of a cantilever of fungal tissue,
/// loaded by the drag of the cap, at most 0.3 of the height.
///
/// source  F L^3 / (3 E I); modulus and drag are estimates, no measurement is recorded
[[nodiscard]] double displacement_of_top(const SwayingStem& stem);

/// Returns the sway of a mesh that stands on the ground: zero there, 1 at the top.
[[nodiscard]] std::vector<Sway> sway_of(const Mesh& mesh, const SwayingStem& stem);

}  // namespace sporeprint
