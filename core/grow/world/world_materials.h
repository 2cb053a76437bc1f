// The materials of what stands and lies on a piece of a world, each made once for a file.
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/atlas/atlas.h"
#include "core/grow/execution_context.h"
#include "core/grow/product.h"
#include "core/individual/individual.h"
#include "core/mesh/mesh.h"
#include "core/plant/leaf_spec.h"
#include "core/plant/tree_spec.h"
#include "core/plant/wood_image.h"

namespace sporeprint {

/// Returns the addresses of the images of materials, for files that link them.
struct MaterialUrls {
    std::function<ImageUrls(const TreeSpec&)> bark = {};
    std::function<ImageUrls(const std::string& leaf, const LeafPaint&)> leaves = {};
    ImageLinks skin = {};  ///< of a mushroom
    std::function<ImageUrls(const WoodPaint&)> wood = {};
};

/// Adds materials to a scene. Functions return the index of one, which is made if there is none of its name yet; they
/// throw as attach_images() and as painting does.
class WorldMaterials {
  public:
    /// All arguments must outlive the materials, and these the scene.
    ///
    /// urls  used if the textures are linked
    WorldMaterials(GlbScene& scene, Textures textures, const FileOptions& file,
                   const MaterialUrls& urls, const Atlas& atlas, const ExecutionContext& execution)
        : scene_(scene),
          textures_(textures),
          file_(file),
          urls_(urls),
          atlas_(atlas),
          execution_(execution) {}

    /// A colour of each vertex alone.
    std::size_t plain(const std::string& name);
    /// The ground, whose images are in the file wherever those of the others are.
    ///
    /// paint  returns its images in a format
    std::size_t ground(const std::string& name, const std::function<ImageSet(ImageFormat)>& paint);
    std::size_t bark(const TreeSpec& tree);
    /// Leaves on a tree or below it.
    ///
    /// name  before the hash of the images
    /// leaf  id of its preset
    std::size_t leaves(const std::string& name, const std::string& leaf, const LeafPaint& paint);
    /// The bark of a tree, and its leaves if it has some, as primitives with their materials.
    ///
    /// bark_mesh, leaf_mesh  of the same individual, maybe at different levels of detail
    std::vector<GlbPrimitive> tree(const TreeSpec& spec, const Mesh& bark_mesh,
                                   const Mesh& leaf_mesh);
    std::size_t wood(const WoodPaint& paint);
    std::size_t skin(const MushroomSpec& spec, const Individual& individual);

  private:
    using Paint = std::function<std::shared_ptr<const ImageSet>(ImageFormat)>;

    std::size_t named(const std::string& name, const std::function<void(GlbMaterial&)>& set);
    void attach(GlbMaterial& material, Textures textures, const std::function<ImageUrls()>& urls,
                const Paint& paint);

    GlbScene& scene_;
    Textures textures_;
    const FileOptions& file_;
    const MaterialUrls& urls_;
    const Atlas& atlas_;
    const ExecutionContext& execution_;
    std::deque<EmbeddedImages> images_;
    std::map<std::string, std::size_t> known_;
};

}  // namespace sporeprint
