// The materials of a set in one file: one for each different images, or one for an atlas of them.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/atlas/atlas.h"
#include "core/gltf/glb.h"
#include "core/grow/execution_context.h"
#include "core/grow/product.h"
#include "core/grow/set.h"
#include "core/grow/translucency.h"

namespace sporeprint {

/// Where the images of an individual are.
struct SetTile {
    std::size_t material = 0;  ///< index into the scene's
    std::size_t tile = 0;      ///< of its atlas, from 0
};

/// Collects the different images of the individuals of a set, and makes materials of them.
class SetMaterials {
  public:
    explicit SetMaterials(const SetSpec& spec) : spec_(spec) {}

    /// Returns where the images of an individual are; those of equal images are the same.
    ///
    /// one    individual of the plan
    /// look   of its skin
    /// flesh  returns its flesh; called for materials=rich and images that are new
    SetTile add(const SetIndividual& one, const MaterialLook& look,
                const std::function<Flesh()>& flesh);

    /// Returns the grid of a material, for the individuals added so far; 1 x 1 without an atlas.
    [[nodiscard]] TileGrid grid_of(std::size_t material) const;

    /// Moves texture coordinates into a tile. Tangents stay, because both axes keep their
    /// directions.
    void move_to_tile(Mesh& mesh, const SetTile& place) const;

    /// Adds the materials of all individuals to a scene, which this object must outlive: it owns
    /// their images, painted now or found in the caches. Of an atlas, coat and sheen that differ
    /// between tiles are images with a texel for each.
    ///
    /// links   if has_addresses(textures)
    /// throws  Impossible (path "/atlas") for an atlas in which only some tiles glow, or in another
    ///         colour: there is no image for that; Cancelled
    void add_to(GlbScene& scene, const Atlas& atlas, const ImageLinks& links,
                const ExecutionContext& execution);

    /// Returns the atlases for asset.extras: [{"material":0,"columns":4,"rows":2,"tiles":7}].
    [[nodiscard]] Value atlases_value() const;

  private:
    struct Tile {
        std::string name;      ///< of the skin that it would have alone
        MushroomSpec painted;  ///< whose images it has
        MaterialLook look;
        Flesh flesh;
    };
    struct Material {
        std::size_t species = 0;  ///< index into those of the set
        std::vector<Tile> tiles;
    };

    [[nodiscard]] std::string name_of(const Material& material) const;
    [[nodiscard]] GlbMaterial atlas_material(const Material& material) const;

    const SetSpec& spec_;
    std::vector<Material> materials_;
    std::map<std::string, std::size_t> material_of_;  ///< by what its individuals share
    std::vector<EmbeddedImages> images_;              ///< of each material
};

}  // namespace sporeprint
