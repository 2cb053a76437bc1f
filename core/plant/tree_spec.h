// The request for a tree: a preset, and every parameter of its branching, its leaves and its bark.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/params/profile.h"
#include "core/params/shared_params.h"
#include "core/plant/far_tree.h"
#include "core/plant/leaf_spec.h"
#include "core/plant/tree.h"

namespace sporeprint {

/// The parameters that a preset sets.
struct TreeLook {
    TreeShape shape;
    IdChoice leaf{"oak"};
    LeafStyle leaves;
    BarkStyle bark;

    static constexpr void fields(auto visit) {
        using L = TreeLook;
        visit(&L::shape, Info{.name = ""});
        visit(&L::leaf, Info{.name = "leaf", .doc = "Kind of leaf, as under /v1/leaves."});
        visit(&L::leaves, Info{.name = "leaves", .doc = "How leaves stand on their twigs."});
        visit(&L::bark, Info{.name = "bark", .doc = "What is painted on trunk and branches."});
    }
    bool operator==(const TreeLook&) const = default;
};
static_assert(well_described<TreeLook>());

/// How a file repeats a leaf. none: one mesh of all leaves, core glTF. gpu: one leaf, by
/// EXT_mesh_gpu_instancing.
enum class LeafInstancing { none, gpu };

constexpr const char* name(LeafInstancing instancing) {
    switch (instancing) {
        case LeafInstancing::none:
            return "none";
        case LeafInstancing::gpu:
            return "gpu";
    }
    return nullptr;
}

/// The levels of detail after the impostor, which are meshes again.
inline constexpr int first_far_lod = impostor_lod + 1, last_far_lod = impostor_lod + far_lods;

/// The parameters of a tree. Those of its look default to those of the preset.
struct TreeParams {
    std::uint32_t seed = 1;
    double size = 1.0;
    double spring = 0.0;
    double autumn = 0.0;
    double snow = 0.0;
    int lod = 0;
    std::optional<int> triangles;
    TextureSize texture_size{1024};
    Textures textures = Textures::embedded;
    FileOptions file;
    LeafInstancing instancing = LeafInstancing::none;
    bool foot_soil = true;
    TreeLook look;

    static constexpr ProfileFit profile_fit = {.solids = true, .wind = true};

    /// Returns whether one leaf is repeated, which excludes weights of wind.
    [[nodiscard]] constexpr bool has_instanced_leaves() const {
        return instancing == LeafInstancing::gpu;
    }

    static constexpr void fields(auto visit) {
        using P = TreeParams;
        using L = LeafParams;
        visit(&P::seed, Info{.name = "seed",
                             .min = 0,
                             .max = 4294967295.0,
                             .doc = "The individual: same seed and parameters, same tree, bit for "
                                    "bit."});
        visit(&P::size, info_of<L>("size"));
        visit(&P::spring, info_of<L>("spring"));
        visit(&P::autumn, info_of<L>("autumn"));
        visit(&P::snow, info_of<L>("snow"));
        visit(&P::lod, Info{.name = "lod",
                            .min = 0,
                            .max = last_far_lod,
                            .doc = "Level of detail: the same individual with fewer branches and "
                                   "fewer, larger leaves, and smaller images. 4 is an impostor: "
                                   "cards with pictures from all sides, for the distance. 5, 6 and "
                                   "7 are meshes for worlds with many trees far away, of about "
                                   "400, 96 and 24 triangles; levels of a file that begins with "
                                   "one of them go on to 7.",
                            .default_from = "profile"});
        visit(&P::triangles, triangles_info);
        visit(&P::texture_size, Info{.name = "texture_size",
                                     .unit = "texels",
                                     .doc = "Side of the images of bark and of those of leaves at "
                                            "LOD 0; it halves with every level."});
        visit(&P::textures, info_of<L>("textures"));
        visit(&P::file, file_info);
        visit(&P::instancing,
              Info{.name = "instancing",
                   .doc = "How leaves are repeated: in one mesh of all of them, or by "
                          "EXT_mesh_gpu_instancing, a tenth of the bytes and of the memory. "
                          "Without wind."});
        visit(&P::foot_soil,
              Info{.name = "foot_soil",
                   .doc = "Whether soil lies round its foot; without it, it is planted on ground "
                          "that is there."});
        visit(&P::look, Info{.name = ""});
    }
    /// Refuses two parameters that choose the level of detail.
    void check(const std::string& path, std::vector<Problem>& problems) const {
        refuse_two_levels(*this, path, problems);
    }
    bool operator==(const TreeParams&) const = default;
};
static_assert(well_described<TreeParams>());

/// Everything that the images of bark depend on: all individuals of a kind use the same images.
struct TreePaint {
    ImageSide texture_size{1024};
    BarkStyle bark;

    static constexpr void fields(auto visit) {
        using P = TreePaint;
        visit(&P::texture_size,
              Info{.name = "side", .unit = "texels", .doc = "Side of this image."});
        visit(&P::bark, info_of<TreeLook>("bark"));
    }
    bool operator==(const TreePaint&) const = default;
};
static_assert(well_described<TreePaint>());

struct TreeSpec {
    std::string preset;  ///< names the file; its values are in the parameters
    TreeParams params;
};

/// Returns the parameters of a preset without overrides; other leaves are allowed as in the preset.
[[nodiscard]] TreeParams params_of(const TreePreset& preset);

/// Removes rows that no matrix of the spec uses, so that equal trees have equal canonical texts.
void without_unused_rows(TreeParams& params);

/// Returns the part of the parameters that the images of bark depend on.
[[nodiscard]] TreePaint paint_of(const TreeParams& params);

/// Returns the leaf of which a tree has many copies: a preset without overrides, at the tree's
/// moment of the year and with images of the tree's size. Its images are those of that leaf as a
/// product of its own that nothing has eaten or marked, since all copies show them.
///
/// preset  that of params.look.leaf
[[nodiscard]] LeafParams leaf_of(const TreeParams& params, const LeafPreset& preset);

}  // namespace sporeprint
