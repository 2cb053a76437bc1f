// Materials, textures, images and the list of extensions of a file.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/gltf/glb.h"
#include "core/gltf/tables.h"

namespace sporeprint::gltf {

/// The names of the extensions in use, each once.
struct Extensions {
    std::vector<std::string> names, required;

    /// Adds an extension without which the file cannot be read.
    void require(const std::string& name);
    /// Adds an extension that readers may ignore.
    void use(const std::string& name);
    /// Returns the JSON members, with a leading comma. Required extensions are in both lists.
    [[nodiscard]] std::string json() const;
};

/// How a texture is sampled.
enum class Sampling {
    clamped,   ///< trilinear, clamped to the edge
    repeated,  ///< trilinear, repeated in u
    nearest    ///< the nearest texel, clamped to the edge
};

/// The tables of textures, images and samplers.
struct TextureTables {
    std::string textures, images, samplers;
    std::vector<Slice> image_files;  ///< embedded images, in the order of their views

    /// Returns the index of the first texture of a material; adds its textures unless an earlier
    /// material has the same images.
    std::size_t textures_of(const GlbMaterial& material, Tables& tables, Extensions& used);

    /// Returns the index of the texture of a PNG image; adds it unless an earlier material has it.
    std::size_t texture_of_png(const std::string& name, const Slice& png, Sampling sampling,
                               Tables& tables);

  private:
    /// A material that added textures, and the index of the first.
    struct Source {
        const GlbMaterial* material;
        std::size_t first;
    };

    /// A PNG image and its texture.
    struct PngTexture {
        Slice file;
        std::size_t texture;
    };

    std::vector<Source> sources_;
    std::vector<PngTexture> pngs_;
    std::vector<Sampling> sampling_;  ///< by sampler
    std::size_t texture_count_ = 0, image_count_ = 0;

    /// Adds the view of an embedded image.
    void add_file(const Slice& file, const char* type, Tables& tables);

    /// Adds the images of a material, embedded or linked, with names that begin with `name`; returns the index of
    /// the first.
    std::size_t add_images(const std::string& name, const ImageSet* files,
                           const std::array<std::string, 3>& urls, Tables& tables);
    std::size_t sampler_of(Sampling sampling);
};

/// Returns true if a material has images, embedded, linked or external.
[[nodiscard]] bool is_textured(const GlbMaterial& material);

/// Returns true for a material whose embedded base colour has no other images beside it.
[[nodiscard]] bool has_base_colour_alone(const GlbMaterial& material);

/// Returns the JSON object of a material; adds its textures to the tables.
///
/// extended  it has its optional extensions
[[nodiscard]] std::string material_json(const GlbMaterial& material, bool extended,
                                        TextureTables& texture_tables, Tables& tables,
                                        Extensions& used);

}  // namespace sporeprint::gltf
