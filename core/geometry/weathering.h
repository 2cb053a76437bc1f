// Weathering as geometry: a swept body is dented, cut back and closed by walls of flesh; then solids stand on it. All of it reads the places of core/individual/damage.h; paint reads the same.
#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry/curl.h"
#include "core/geometry/damage_cuts.h"
#include "core/individual/individual.h"
#include "core/mesh/mesh.h"
#include "core/surface/charts.h"

namespace sporeprint {

/// A face of a swept mesh: `shares.size()` rings of `columns + 1` vertices.
struct FaceGrid {
    Part part = Part::cap;
    std::uint32_t first = 0;
    std::vector<double> shares;  ///< of the part's own sub-curve, base to apex
};

/// The body of a swept mesh.
struct SweptBody {
    FaceGrid stem, hymenium, cap;  ///< no rings where a form has no lower face
};

/// What weathering adds to a mesh; no amount changes it.
struct WeatheringCount {
    std::uint64_t columns = 0;  ///< of the body
    std::uint64_t vertices = 0;
    std::uint64_t triangles = 0;  ///< when all is there
};
[[nodiscard]] WeatheringCount weathering_count(const Individual& individual, int lod);

/// Moves the vertices of a body that has just been swept: dents it, cuts it back and closes the cuts; then adds what stands on it.
/// An individual that nothing can wear is left as it is, to the bit.
///
/// body, cuts   the columns of the body are those of the cuts
/// keep_absent  whether triangles of what is absent stay, without area
Curl weather(Mesh& mesh, const SweptBody& body, const Individual& individual, const Cuts& cuts,
             int lod, bool keep_absent);

}  // namespace sporeprint
