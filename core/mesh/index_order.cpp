#include "core/mesh/index_order.h"

#include <meshoptimizer.h>

namespace sporeprint {

void order_for_vertex_cache(Mesh& mesh) {
    constexpr unsigned int cache_size = 16;  // the smallest vertex cache of current processors
    meshopt_optimizeVertexCacheFifo(mesh.indices.data(), mesh.indices.data(), mesh.indices.size(),
                                    mesh.positions.size(), cache_size);
}

}  // namespace sporeprint
