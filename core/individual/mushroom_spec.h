// The request for a mushroom: query parameters and the mix of species.
#pragma once

#include "core/model/model.h"
#include "core/model/substrate.h"
#include "core/params/mix.h"
#include "core/params/profile.h"
#include "core/params/shared_params.h"
#include "core/silhouette/morph_set.h"

namespace sporeprint {

/// The animation clip in the file.
enum class Animation { none, growth };

constexpr const char* name(Animation animation) {
    switch (animation) {
        case Animation::none:
            return "none";
        case Animation::growth:
            return "growth";
    }
    return nullptr;
}

/// What the morph targets of a clip move.
enum class Targets { position_normal, position };

constexpr const char* name(Targets targets) {
    switch (targets) {
        case Targets::position_normal:
            return "position_normal";
        case Targets::position:
            return "position";
    }
    return nullptr;
}

/// Seeds of three sides of an individual, each that of the individual if it is not set: so one can be
/// drawn anew without the others.
struct SplitSeeds {
    std::optional<std::uint32_t> shape, surface, damage;

    static constexpr void fields(auto visit) {
        using S = SplitSeeds;
        visit(&S::shape, Info{.name = "shape",
                              .min = 0,
                              .max = 4294967295.0,
                              .doc = "Seed of the shape: size, outline and bend, branches, the "
                                     "places of warts, scales, gills and relief, ring, soil and "
                                     "litter; that of the individual if it is not given."});
        visit(&S::surface, Info{.name = "surface",
                                .min = 0,
                                .max = 4294967295.0,
                                .doc = "Seed of what is painted: hue and lightness, patterns, "
                                       "grain and stains; that of the individual if it is not "
                                       "given."});
        visit(&S::damage, Info{.name = "damage",
                               .min = 0,
                               .max = 4294967295.0,
                               .doc = "Seed of what time and weather did: where bites, tears, "
                                      "cracks, bruises and drops are; that of the individual if "
                                      "it is not given."});
    }
    bool operator==(const SplitSeeds&) const = default;
};

/// The query parameters of /v1/mushrooms. Unset optionals take the value of the species.
struct MushroomParams {
    std::uint32_t seed = 1;
    double age = 0.6;
    double size = 1.0;
    double variation = 0.5;
    int lod = 0;
    std::optional<int> triangles;
    TextureSize texture_size{1024};
    Textures textures = Textures::embedded;
    ImageShare share = ImageShare::individual;
    Variants variants = Variants::none;
    Base base = Base::natural;
    std::optional<Substrate> substrate;
    FileOptions file;
    DeformationOf<Maybe> deformation;
    OrnamentsOf<Maybe> ornaments;
    HymeniumOf<Maybe> hymenium;
    WeatheringOf<Maybe> weathering;
    Animation animation = Animation::none;
    int frames = 9;
    Targets targets = Targets::position_normal;
    std::optional<SplitSeeds> seeds;

    static constexpr void fields(auto visit) {
        using P = MushroomParams;
        visit(&P::seed,
              Info{.name = "seed",
                   .min = 0,
                   .max = 4294967295.0,
                   .doc = "The individual: same seed and parameters, same mushroom, bit for bit."});
        visit(&P::age, Info{.name = "age",
                            .min = 0,
                            .max = 1,
                            .doc = "From button (0) through maturity (0.6) to decay (1)."});
        visit(&P::size, size_info);
        visit(&P::variation,
              Info{.name = "variation",
                   .min = 0,
                   .max = 1,
                   .doc = "How far individuals depart from their species' template."});
        visit(&P::lod, lod_info);
        visit(&P::triangles, triangles_info);
        visit(&P::texture_size, texture_size_info);
        visit(&P::textures, textures_info);
        visit(&P::share, share_info);
        visit(&P::variants, variants_info);
        visit(&P::base, base_info);
        visit(&P::substrate,
              Info{.name = "substrate",
                   .doc = "What a bracket grows on: a piece of wood with the bark of this tree, by "
                          "default of one that the species grows on, or nothing."});
        visit(&P::file, file_info);
        visit(&P::deformation,
              Info{.name = "deformation", .doc = "Bend, twist, lean, taper and imperfection."});
        visit(&P::ornaments, Info{.name = "ornaments",
                                  .doc = "What is left of the veils and of what formed under "
                                         "them."});
        visit(&P::hymenium, Info{.name = "hymenium", .doc = "Gills, ridges or pores."});
        visit(&P::weathering, Info{.name = "weathering", .doc = "What time and weather did."});
        visit(
            &P::animation,
            Info{.name = "animation",
                 .doc = "A clip in the file: growth from button to decay as morph targets, images "
                        "of the requested age."});
        visit(&P::frames, Info{.name = "frames",
                               .min = 2,
                               .max = 16,
                               .doc = "Growth stages in the clip, evenly spaced in age; only with "
                                      "animation=growth."});
        visit(&P::targets,
              Info{.name = "targets",
                   .doc = "What a growth stage moves: positions and normals, or positions alone, "
                          "for readers with at most 16 vertex attributes: two of them for each "
                          "stage, or one; only with animation=growth."});
        visit(&P::seeds,
              Info{.name = "seeds", .doc = "Seeds of shape, surface and damage, if they differ."});
    }
    /// Returns the seed of the shape.
    [[nodiscard]] std::uint32_t shape_seed() const {
        return seeds ? seeds->shape.value_or(seed) : seed;
    }
    /// Return the seeds of features that are both in the mesh and in the images, of what is painted
    /// alone, and of what weather did: those of seed 1 if all individuals share their images.
    [[nodiscard]] std::uint32_t painted_shape_seed() const {
        return painted_seed(shape_seed(), share);
    }
    [[nodiscard]] std::uint32_t surface_seed() const {
        const std::uint32_t own = painted_seed(seed, share);
        return seeds ? seeds->surface.value_or(own) : own;
    }
    [[nodiscard]] std::uint32_t weather_seed() const {
        const std::uint32_t own = painted_seed(seed, share);
        return seeds ? seeds->damage.value_or(own) : own;
    }
    /// Removes seeds that have their defaults, which would make a second URL of the same bytes.
    void drop_equal_seeds() {
        if (!seeds) return;
        if (seeds->shape == seed) seeds->shape.reset();
        for (auto* own : {&seeds->surface, &seeds->damage})
            if (*own == painted_seed(seed, share)) own->reset();
        if (*seeds == SplitSeeds{}) seeds.reset();
    }
    /// Refuses `frames` and `targets` without a clip, which would make a second URL of the same
    /// bytes, a clip of several levels of detail, and two parameters that choose the level.
    void check(const std::string& path, std::vector<Problem>& problems) const {
        refuse_two_levels(*this, path, problems);
        if (animation == Animation::none) {
            if (frames != MushroomParams{}.frames)
                report(
                    problems, path + "/frames",
                    std::to_string(frames) + " frames need a clip; ask for animation=growth too");
            if (targets != MushroomParams{}.targets)
                report(problems, path + "/targets",
                       "targets need a clip; ask for animation=growth too");
        } else if (file.lods != Lods::single) {
            report(problems, path + "/lods",
                   "a clip moves one level of detail; ask for lods=single");
        }
    }
    bool operator==(const MushroomParams&) const = default;
};

/// A whole request: a mix of the atlas or a custom model, and the parameters.
struct MushroomSpec {
    Mix mix;
    std::optional<Model> model;
    MushroomParams params;
    /// The designer's correspondences between the two species of a pair: `a` on the outline of
    /// mix[0], `b` on that of mix[1], both at params.age. Empty for any other number of species.
    std::vector<Arc> arcs{};
};

}  // namespace sporeprint
