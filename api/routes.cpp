#include "api/routes.h"

#include "api/products/colonies.h"
#include "api/products/inspection.h"
#include "api/products/leaves.h"
#include "api/products/library.h"
#include "api/products/morphs.h"
#include "api/products/mushrooms.h"
#include "api/products/offspring.h"
#include "api/products/photos.h"
#include "api/products/scenes/routes.h"
#include "api/products/sets.h"
#include "api/products/terrains.h"
#include "api/products/traces.h"
#include "api/products/trees.h"
#include "api/products/worlds/routes.h"
#include "api/static_documents.h"

namespace sporeprint::api {

const RouteTable& route_table() {
    static const RouteTable table({
        page_routes,   species_routes,    mushroom_routes,  morph_routes,  offspring_routes,
        colony_routes, leaf_routes,       tree_routes,      world_routes,  terrain_routes,
        scene_routes,  set_routes,        photo_routes,     trace_routes,  library_routes,
        token_routes,  inspection_routes, reference_routes, health_routes,
    });
    return table;
}

}  // namespace sporeprint::api
