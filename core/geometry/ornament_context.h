// What every builder of ornaments reads.
#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry/curl.h"
#include "core/geometry/damage_cuts.h"
#include "core/geometry/damage_dents.h"
#include "core/geometry/ornament_detail.h"
#include "core/geometry/sweep.h"
#include "core/individual/individual.h"

namespace sporeprint {

/// Everything that ornaments need to know about the body they stand on.
struct OrnamentContext {
    const Outline& outline;
    const Deformer& deformer;
    const RestSurface& rest_surface;
    const OrnamentDetail& detail;
    DetailLevel level;
    std::uint32_t seed;
    bool textured;
    bool keep_absent;        ///< whether ornaments of size 0 keep their triangles
    const MarginCuts& cuts;  ///< of the margin
    const Curl& curl;        ///< of the remaining margin
    const Dents& dents;
    const std::vector<OutlineSample>& flesh;  ///< rings of the lower face, as it is built
    const Individual& individual;
};

}  // namespace sporeprint
