// The request for a leaf: a preset, and every parameter of its shape and colours.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/params/profile.h"
#include "core/params/shared_params.h"
#include "core/plant/leaf.h"

namespace sporeprint {

/// The parameters of a leaf. In a request, parameters of shape and palette that are omitted have
/// the values of the preset; see params_of().
struct LeafParams {
    std::uint32_t seed = 1;
    double size = 1.0;
    double variation = 0.5;
    double spring = 0.0;
    double autumn = 0.0;
    double snow = 0.0;
    int lod = 0;
    std::optional<int> triangles;
    TextureSize texture_size{1024};
    Textures textures = Textures::embedded;
    FileOptions file;
    LeafShape shape;
    LeafPalette palette;

    static constexpr ProfileFit profile_fit = {.solids = false, .wind = false};

    static constexpr void fields(auto visit) {
        using P = LeafParams;
        visit(&P::seed, Info{.name = "seed",
                             .min = 0,
                             .max = 4294967295.0,
                             .doc = "The individual: same seed and parameters, same leaf, bit for "
                                    "bit."});
        visit(&P::size, size_info);
        visit(&P::variation, Info{.name = "variation",
                                  .min = 0,
                                  .max = 1,
                                  .doc = "How far an individual departs from the shape that is "
                                         "described."});
        visit(&P::spring, Info{.name = "spring",
                               .min = 0,
                               .max = 1,
                               .doc = "From summer (0) back to leaves that unfold (1), which are "
                                      "paler and yellower."});
        visit(&P::autumn, Info{.name = "autumn",
                               .min = 0,
                               .max = 1,
                               .doc = "From summer (0) through full autumn colour (0.5) to what "
                                      "lies on the ground (1)."});
        visit(&P::snow, Info{.name = "snow",
                             .min = 0,
                             .max = 1,
                             .doc = "From none (0) to snow on all of the upper face (1); on "
                                    "shoots of needles it lies in lumps between these too."});
        visit(&P::lod, mesh_lod_info);
        visit(&P::triangles, triangles_info);
        visit(&P::texture_size, texture_size_info);
        visit(&P::textures, textures_info);
        visit(&P::file, file_info);
        visit(&P::shape, Info{.name = ""});
        visit(&P::palette, Info{.name = ""});
    }
    /// Refuses two parameters that choose the level of detail.
    void check(const std::string& path, std::vector<Problem>& problems) const {
        refuse_two_levels(*this, path, problems);
    }
    bool operator==(const LeafParams&) const = default;
};
static_assert(well_described<LeafParams>());

/// Everything that the images of a leaf depend on.
struct LeafPaint {
    std::uint32_t seed = 1;
    double variation = 0.5;
    double spring = 0.0;
    double autumn = 0.0;
    double snow = 0.0;
    ImageSide texture_size{1024};
    double relief = 0.6;
    double eaten = 0.03;
    bool sprays = false;
    Venation venation;
    LeafPalette palette;

    static constexpr void fields(auto visit) {
        using P = LeafPaint;
        using L = LeafParams;
        visit(&P::seed, info_of<L>("seed"));
        visit(&P::variation, info_of<L>("variation"));
        visit(&P::spring, info_of<L>("spring"));
        visit(&P::autumn, info_of<L>("autumn"));
        visit(&P::snow, info_of<L>("snow"));
        visit(&P::texture_size,
              Info{.name = "side", .unit = "texels", .doc = "Side of this image."});
        visit(&P::relief, info_of<LeafShape>("relief"));
        visit(&P::eaten, info_of<LeafShape>("eaten"));
        visit(&P::sprays,
              Info{.name = "sprays",
                   .doc = "Whether the leaf is smaller and has a twig and a branch of such leaves "
                          "beside it, cut out by alpha, as trees have; without effect for "
                          "needles, which have shoots in any case."});
        visit(&P::venation, info_of<LeafShape>("venation"));
        visit(&P::palette, Info{.name = ""});
    }
    bool operator==(const LeafPaint&) const = default;
};
static_assert(well_described<LeafPaint>());

struct LeafSpec {
    std::string preset;  ///< names the file; its values are in the parameters
    LeafParams params;
};

/// Returns the parameters of a preset without overrides.
[[nodiscard]] LeafParams params_of(const LeafPreset& preset);

/// Returns the part of the parameters that the images depend on.
[[nodiscard]] LeafPaint paint_of(const LeafParams& params);

/// Returns the same for leaves of a tree, whose image shows sprays too.
[[nodiscard]] LeafPaint paint_on_tree(const LeafParams& params);

/// Returns the shape of the individual leaf: params.shape with the random deviations that seed and
/// variation determine.
[[nodiscard]] LeafShape shape_of(const LeafParams& params);

}  // namespace sporeprint
