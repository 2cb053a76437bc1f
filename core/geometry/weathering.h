// Weathering as geometry: a swept body is dented, cut back and closed by walls of flesh; then
// solids are added. Geometry and painting read the same damage list, core/individual/damage.h.
#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry/curl.h"
#include "core/geometry/damage_cuts.h"
#include "core/individual/individual.h"
#include "core/mesh/detail.h"
#include "core/mesh/mesh.h"
#include "core/surface/charts.h"

namespace sporeprint {

/// Grid of a face of a swept mesh: `shares.size()` rings of `columns + 1` vertices.
struct FaceGrid {
    Part part = Part::cap;
    std::uint32_t first = 0;
    std::vector<double> shares;  ///< of the part's own sub-curve, base to apex
};

/// Grids of the body of a swept mesh.
struct SweptBody {
    FaceGrid stem, hymenium, cap;  ///< no rings where a form has no lower face
};

/// Counts that weathering adds to a mesh; no amount changes them.
struct WeatheringCount {
    std::uint64_t columns = 0;  ///< of the body, inserted ones included
    std::uint64_t vertices = 0;
    std::uint64_t triangles = 0;  ///< when everything is present
};
[[nodiscard]] WeatheringCount weathering_count(const Individual& individual, DetailLevel level);

/// Applies weathering to a body that has just been swept: dents it, cuts it back, closes the cuts
/// and adds solids. An individual that cannot be damaged keeps its mesh bit for bit.
///
/// body, cuts   the columns of the body are those of the cuts
/// keep_absent  whether triangles of absent parts are emitted, with zero area
/// returns      the curl of the margin, for solids added later
Curl weather(Mesh& mesh, const SweptBody& body, const Individual& individual,
             const MarginCuts& cuts, DetailLevel level, bool keep_absent);

}  // namespace sporeprint
