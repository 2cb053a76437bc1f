// The levels of detail of a mushroom's file: the requested one or the nearest to a number of triangles, and
// those between whole levels that several levels in one file need.
#pragma once

#include <vector>

#include "core/individual/individual.h"
#include "core/individual/mushroom_spec.h"
#include "core/mesh/detail.h"

namespace sporeprint {

/// Consecutive levels of one file have at most so many times the triangles of the next one, where
/// levels between two whole ones can be inserted, and inserted ones at least so many times.
inline constexpr double largest_step = 4.4, least_step = 1.8;

/// Returns the level of detail with which a file begins: `lod` or, with `triangles`, the level whose
/// count is nearest to it in ratio, of equally near ones the coarsest. Levels between whole ones are left out if the outline crosses
/// itself at them, and in clips, whose outlines are proven at whole levels alone.
///
/// cost  that of at most 25 body_count()
[[nodiscard]] DetailLevel first_level(const MushroomSpec& spec, const Individual& individual);

/// Returns the level and the whole ones below it; nothing for that of an impostor, which has no mesh.
///
/// grows  whether counts include parts that are absent at this age
[[nodiscard]] std::vector<DetailLevel> levels_from(DetailLevel first, const Individual& individual,
                                                   bool grows);

/// Returns the levels of a file, finest first: the first one, and in a file of several levels the
/// whole ones below it. Where two differ by more than `largest_step`, levels are inserted, as coarse as
/// that allows, because bytes and memory are those of the finer levels. An impostor is none of them.
[[nodiscard]] std::vector<DetailLevel> levels_in_file(const MushroomSpec& spec,
                                                      const Individual& individual);

/// Returns the request whose images a file has: that of the whole level nearest to its first one.
[[nodiscard]] MushroomSpec image_spec(const MushroomSpec& spec, const Individual& individual);

}  // namespace sporeprint
