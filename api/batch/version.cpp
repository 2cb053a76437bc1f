#include "api/batch/version.h"

#include "api/products/product.h"
#include "core/params/canonical.h"

namespace sporeprint::api {

std::string version_of(const Atlas& atlas) {
    std::string templates;
    for (const AtlasEntry& entry : atlas.entries()) templates += entry.json + '\n';
    for (const LeafPreset& leaf : atlas.leaves()) canonical(leaf, templates);
    for (const TreePreset& tree : atlas.trees()) canonical(tree, templates);
    for (const WorldPreset& world : atlas.worlds()) canonical(world, templates);
    return token_of(templates);
}

}  // namespace sporeprint::api
