// Writer of meshes and their images as a GLB of shared slices; no data is copied twice.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/bytes.h"
#include "core/images.h"
#include "core/mesh/mesh.h"
#include "core/surface/paint.h"

namespace sporeprint {

/// A morph target: the offsets of each vertex at weight 1.
struct MorphTarget {
    std::string name;
    std::vector<glm::vec3> positions, normals;  ///< offsets; normals of all targets or none
};

/// An animation of the weights of all targets, linear between keys.
struct WeightClip {
    std::string name;
    std::vector<float> times;    ///< seconds, ascending
    std::vector<float> weights;  ///< [key][target]
};

/// Values of optional material extensions; those with default values are omitted, and loaders may
/// ignore each.
struct MaterialLook {
    double coat = 0.0;      ///< KHR_materials_clearcoat, 0..1; roughness from the image
    glm::dvec3 sheen{0.0};  ///< KHR_materials_sheen, linear
    glm::dvec3 glow{0.0};   ///< emission, linear, 0..1; scaled by KHR_materials_emissive_strength
};

/// The matt light that passes through a surface instead of being reflected:
/// KHR_materials_diffuse_transmission.
struct GlbTransmission {
    double factor = 0.0;   ///< share of light that passes through the thinnest places; 0: opaque
    glm::dvec3 tint{1.0};  ///< of that light, linear; the base colour filters it too
    /// A PNG image whose alpha is multiplied with the factor: 1 for a film, 0 for what is too thick.
    /// Empty for the same everywhere.
    Slice thinness = {};
    double mean = 1.0;  ///< of that alpha, for a material without images
};

/// What differs between the tiles of an atlas in the look of its material: PNG images with a texel
/// for each tile, sampled without interpolation; empty where all tiles are alike.
struct TileLooks {
    Slice coat;   ///< factor of the coat in red
    Slice sheen;  ///< factors of the sheen, sRGB
};

/// A material with its images.
struct GlbMaterial {
    std::string name;                  ///< also of its images, with their kinds: "oak_base_color"
    const ImageSet* images = nullptr;  ///< embedded when given; the base colour may be alone
    std::array<std::string, 3> image_urls = {};  ///< linked when not empty
    bool is_external = false;  ///< the addresses stand in its extras, and readers load no images
    MaterialLook look = {};
    bool repeats_u = false;  ///< wrap mode of the samplers in u: REPEAT, otherwise CLAMP_TO_EDGE
    ImageFormat url_format = ImageFormat::jpg;  ///< of the linked images
    /// JPEG images for loaders without EXT_texture_webp, which WebP images otherwise require.
    const ImageSet* fallback = nullptr;
    std::array<std::string, 3> fallback_urls = {};
    TileLooks tile_looks = {};  ///< of a material with embedded images
    GlbTransmission transmission = {};
    /// Texels of the base colour with less alpha are not drawn; 0 for images without alpha.
    double alpha_cutoff = 0.0;
    /// Whether the red channel of the third image is occlusion; in that of impostors it is not.
    bool has_occlusion = true;
    std::string extras_json = {};  ///< a JSON object; empty for none. Embedded images only.
};

/// A part of a mesh with one material: one draw call.
struct GlbPrimitive {
    /// The material of what is not meant to be seen: a file states none.
    static constexpr std::size_t no_material = ~std::size_t{0};

    const Mesh* mesh = nullptr;
    std::size_t material = 0;                   ///< index into the scene's, or no_material
    std::span<const MorphTarget> targets = {};  ///< weights are 0 until a viewer sets them
    /// The material for each of GlbScene::variants, if the primitive has any.
    std::vector<std::size_t> variant_materials = {};
};

/// What a mesh is of its product: close-ups look at foliage or bodies, and not at what carries them.
enum class GlbRole {
    body,     ///< a fruit body, a trunk, a leaf of its own
    foliage,  ///< leaves and cards of a plant
    carrier   ///< wood, or roots and stems of a colony
};

struct GlbMesh {
    std::string name;
    std::vector<GlbPrimitive> primitives;  ///< all with the same number of targets
    GlbRole role = GlbRole::body;          ///< for pictures, not part of the file
    /// Address of its geometry, relative to that of the file: what geometry_bytes() returns for a scene of this mesh
    /// alone. Empty for geometry in the file. Readers must resolve it.
    std::string geometry_uri = {};
    /// Of its positions where they are quantised, metres: a power of two that all of them are multiples of keeps them
    /// exact, so that meshes of several files meet. 0 for the finest step that the mesh allows.
    float step = 0.0F;
};

/// The transform of an instance.
struct GlbTransform {
    glm::dvec3 translation{0.0};
    glm::dvec4 rotation{0.0, 0.0, 0.0, 1.0};  ///< unit quaternion x, y, z, w
    glm::dvec3 scale{1.0};
    glm::vec3 tint{1.0F};  ///< factor of the base colour, linear, 0..1
};

/// An extension of an object of the file.
struct GlbExtension {
    std::string name;
    std::string json;  ///< its JSON object
};

/// A transform with a mesh, with children, or with neither; several nodes may use the same mesh.
struct GlbNode {
    std::string name;
    std::optional<std::size_t> mesh = {};  ///< index into the scene's
    glm::dvec3 translation{0.0};
    glm::dvec4 rotation{0.0, 0.0, 0.0, 1.0};  ///< unit quaternion x, y, z, w
    glm::dvec3 scale{1.0};
    /// EXT_mesh_gpu_instancing: the mesh is drawn once for each of these transforms, relative to
    /// the node; readers must support the extension. Tints are its attribute _COLOR_0, which some read.
    std::vector<GlbTransform> instances = {};
    /// Indices into the scene's nodes; a node with children has no mesh, because the scale of
    /// quantised positions would also scale them.
    std::vector<std::size_t> children = {};
    std::vector<GlbExtension> extensions = {};  ///< which readers may ignore
    std::string extras_json = {};               ///< a JSON object; empty for none
    /// Whether the node is shown. Others are in the file for extensions that refer to them.
    bool in_scene = true;
};

/// How geometry is stored.
enum class GlbGeometry {
    floats,     ///< core glTF, which every loader reads
    quantized,  ///< KHR_mesh_quantization, which loaders must support
    compressed  ///< quantised, and compressed by EXT_meshopt_compression, which they must support
};

/// Where the sway of vertices is stored; each as normalised integers.
enum class GlbSway {
    texture_coordinates,  ///< TEXCOORD_1: bend, phase; TEXCOORD_2: flutter, branch; u16
    attribute,            ///< _WIND: bend, flutter, phase, branch; u8
    color                 ///< COLOR_0: the same; viewers multiply the base colour by it
};

/// The content of a file.
struct GlbScene {
    std::vector<GlbMaterial> materials;
    std::vector<GlbMesh> meshes;
    std::vector<GlbNode> nodes;  ///< those in the scene that are no children are its roots
    std::vector<std::string> variants = {};  ///< names of KHR_materials_variants
    std::vector<GlbExtension> extensions;    ///< of the file itself, which readers may ignore
    std::string extras_json;                 ///< a JSON object for asset.extras; empty for none
    const WeightClip* clip = nullptr;        ///< animates the targets of the first node
    GlbGeometry geometry = GlbGeometry::floats;
    GlbSway sway = GlbSway::attribute;  ///< of the meshes that have it
    bool material_extensions = true;    ///< whether materials have their optional extensions
    bool stands_on_ground = true;       ///< at y = 0; for pictures, not part of the file
};

/// Writes core glTF 2.0 with optional material extensions; positions and normals as floats, texture
/// coordinates as normalised u16, u16 indices where they fit. Texture coordinates are written if and
/// only if the material has images, tangents unless these are external or the base colour is alone,
/// tints as COLOR_0 unless that holds the sway; materials with the same images share their textures, nodes with the same instances their accessors. Identity transforms
/// of nodes are omitted. Targets are dense: positions and normals move nearly everywhere, so sparse
/// accessors would be larger.
///
/// Quantised positions and their targets are i16 in steps by which the nodes of the mesh are
/// scaled, so that the origin stays the pivot. Normals are normalised i16, tangents normalised i8;
/// normals of targets stay floats, for their differences exceed 1.
///
/// parallel  compresses independent streams
/// returns   slices: head (GLB header, JSON, BIN header), the geometry of each primitive with its
///           targets, the instances of each node that has some, the clip, then each image with its
///           padding
/// throws    GenerationError for a scene without nodes, an empty mesh, a mesh that lacks what its
///           material needs, an index of no mesh, material or node, a node with a mesh and children,
///           a node with two parents, a rotation that is no unit quaternion, a zero scale,
///           targets, variants or a clip that do not fit, a step that is too fine for its mesh, sway
///           as texture coordinates of a mesh without others, geometry with an address that is
///           quantised or has targets, or beside no data in the file, or a file of more than 2^32 - 1
///           bytes
[[nodiscard]] Body glb(const GlbScene& scene, const Parallel& parallel = in_turn);

/// Returns the geometry of all meshes of a scene as it lies in its file, and nothing else: what other files name as
/// GlbMesh::geometry_uri.
///
/// throws    GenerationError for quantised geometry and for targets, and as glb() does
[[nodiscard]] Body geometry_bytes(const GlbScene& scene, const Parallel& parallel = in_turn);

}  // namespace sporeprint
