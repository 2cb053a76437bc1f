// Outlines and axes of offspring: between those of two parents, and mutated.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "core/breed/breeding.h"
#include "core/get_or_compute.h"
#include "core/model/species.h"
#include "core/silhouette/morph_set.h"

namespace sporeprint {

/// Returns an outline for each of some ages between those of two swept species, with as many
/// control points on each sub-curve at all ages: those of both, unless two are close.
///
/// share   of the second species, 0..1; at the ends it still has these control points
/// size    size_of() what they are to have, metres
/// throws  Impossible, InvalidInput if an outline of a parent crosses itself
/// cost    that of the correspondence, and 0.2 ms
[[nodiscard]] std::vector<Silhouette> outlines_between(const Species& a, const Species& b,
                                                       double share,
                                                       const std::vector<double>& ages, double size,
                                                       const GetOrCompute<MorphSet>& morphs);

/// Returns an axis for each of some ages between those of two swept species: empty if all stages of
/// both are straight.
[[nodiscard]] std::vector<std::vector<AxisPoint>> axes_between(const Species& a, const Species& b,
                                                               double share,
                                                               const std::vector<double>& ages);

/// A smooth wave along a curve whose ends do not move: three sines with normal coefficients.
class CurveMutation {
  public:
    /// Draws the coefficients of the curve of a path.
    CurveMutation(const Genes& genes, std::string_view path);

    /// Returns how far a curve of length 1 moves at a share of its length.
    [[nodiscard]] double at(double share) const;

  private:
    double amount_;
    std::array<double, 3> coefficients_{};
};

/// Moves the control points of the outlines of all stages along their normals, alike in all stages
/// in shares of their heights, by a part of the whole mutation.
///
/// part  0..1
/// pre   every outline is one of Outline::unproven()
void mutate_outlines(Species& species, const CurveMutation& mutation, double part);

/// Moves the control points of axes to two sides, alike in all stages. A straight axis stays
/// straight; how far a stem bends is a number.
void mutate_axes(Species& species, const Genes& genes);

/// Returns the overall size of a species at maturity, metres: that by which sizes of a mix blend.
[[nodiscard]] double size_of(const Species& species);

}  // namespace sporeprint
