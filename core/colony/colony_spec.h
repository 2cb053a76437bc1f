// The request for a colony: a mix of species, a habit, and every control of the source.
#pragma once

#include <cstdint>
#include <optional>

#include "core/atlas/atlas.h"
#include "core/colony/root_system.h"
#include "core/individual/mushroom_spec.h"
#include "core/model/substrate.h"

namespace sporeprint {

/// The arrangement of the individuals of a colony. rooted: on a root system, as in the source.
/// tuft: fused at the base. troop: scattered with a minimum distance. ring: a fairy ring. tier: on
/// a trunk, one above the other.
enum class Habit { rooted, tuft, troop, ring, tier };

constexpr const char* name(Habit habit) {
    switch (habit) {
        case Habit::rooted:
            return "rooted";
        case Habit::tuft:
            return "tuft";
        case Habit::troop:
            return "troop";
        case Habit::ring:
            return "ring";
        case Habit::tier:
            return "tier";
    }
    return nullptr;
}

/// States whether roots are visible.
enum class RootsShown { shown, buried };

constexpr const char* name(RootsShown roots) {
    switch (roots) {
        case RootsShown::shown:
            return "shown";
        case RootsShown::buried:
            return "buried";
    }
    return nullptr;
}

/// The way a file repeats a mesh. nodes: core glTF, one node for each. gpu:
/// EXT_mesh_gpu_instancing.
enum class Instancing { nodes, gpu };

constexpr const char* name(Instancing instancing) {
    switch (instancing) {
        case Instancing::nodes:
            return "nodes";
        case Instancing::gpu:
            return "gpu";
    }
    return nullptr;
}

/// The query parameters of /v1/colonies. Unset optionals default to values of the species.
struct ColonyParams {
    std::uint32_t seed = 1;
    int count = 24;
    int distinct = 8;
    std::optional<Habit> habit;
    double age = 0.6;
    double age_spread = 0.75;
    double size = 1.0;
    double cap_scale = 1.0;
    std::optional<RootsShown> roots;
    std::optional<double> trunk_radius;
    std::optional<Substrate> substrate;
    ColonyRootsOf<Maybe> growth;
    int lod = 0;
    std::optional<int> triangles;
    TextureSize texture_size{1024};
    Textures textures = Textures::embedded;
    ImageShare share = ImageShare::individual;
    Variants variants = Variants::none;
    Base base = Base::natural;
    FileOptions file;
    Instancing instancing = Instancing::nodes;

    static constexpr void fields(auto visit) {
        using P = ColonyParams;
        using M = MushroomParams;
        visit(&P::seed, Info{.name = "seed",
                             .min = 0,
                             .max = 4294967295.0,
                             .doc = "The colony: same seed and parameters, same bytes."});
        visit(&P::count, Info{.name = "count",
                              .min = 1,
                              .max = 256,
                              .doc = "Individuals, at most: those for which there is no room are "
                                     "left out.",
                              .group = "placement"});
        visit(&P::distinct, Info{.name = "distinct",
                                 .min = 1,
                                 .max = 16,
                                 .doc = "Different individuals that are grown; all others are "
                                        "their likes, turned and scaled.",
                                 .group = "individuals"});
        visit(&P::habit, Info{.name = "habit", .doc = "How they stand.", .group = "placement"});
        visit(&P::age, Info{.name = "age",
                            .min = 0,
                            .max = 1,
                            .doc = "Of the oldest: button (0), maturity (0.6), decay (1).",
                            .group = "individuals"});
        visit(&P::age_spread, Info{.name = "age_spread",
                                   .min = 0,
                                   .max = 1,
                                   .doc = "How much younger the youngest is, for the age of the "
                                          "oldest: all of one age (0), or some that have just "
                                          "appeared (1).",
                                   .group = "individuals"});
        Info size = info_of<M>("size");
        size.group = "individuals";
        visit(&P::size, size);
        visit(&P::cap_scale, Info{.name = "cap_scale",
                                  .min = 0.25,
                                  .max = 3,
                                  .doc = "Size of caps for the thickness of their stems.",
                                  .group = "individuals"});
        visit(&P::roots, Info{.name = "roots",
                              .doc = "Roots above the ground, or none in sight.",
                              .group = "roots"});
        visit(&P::trunk_radius, Info{.name = "trunk_radius",
                                     .unit = "m",
                                     .min = 0.005,
                                     .max = 5,
                                     .doc = "Of the trunk that a tier stands on, before size; its "
                                            "surface touches the origin from behind.",
                                     .group = "placement"});
        visit(&P::substrate, Info{.name = "substrate",
                                  .doc = "What a tier stands on: a piece of wood with the bark of "
                                         "this tree, by default of one that the species grows on, "
                                         "or nothing.",
                                  .group = "placement"});
        visit(&P::growth, Info{.name = ""});
        visit(&P::lod, info_of<M>("lod"));
        visit(&P::triangles, triangles_info);
        visit(&P::texture_size, info_of<M>("texture_size"));
        visit(&P::textures, info_of<M>("textures"));
        visit(&P::share, share_info);
        visit(&P::variants, variants_info);
        visit(&P::base,
              Info{.name = "base",
                   .doc = "natural: every stem stands in a clod of soil with litter, a tuft in one "
                          "clod, and soil and the felt of the mycelium cling to it, as much as is "
                          "usual for the species; clean: as if it were washed. What stands on "
                          "wood or on visible roots has no soil below it."});
        visit(&P::file, file_info);
        visit(&P::instancing,
              Info{.name = "instancing",
                   .doc = "How a mesh is repeated: by nodes, or by EXT_mesh_gpu_instancing."});
    }
    /// Refuses two parameters that choose the level of detail.
    void check(const std::string& path, std::vector<Problem>& problems) const {
        refuse_two_levels(*this, path, problems);
    }
    bool operator==(const ColonyParams&) const = default;
};
static_assert(well_described<ColonyParams>());

struct ColonySpec {
    Mix mix;
    ColonyParams params;
};

/// Returns the habit that a species' facts mention first; a troop if they mention none.
[[nodiscard]] Habit habit_of(const Species& species);

/// The properties of a colony that follow from the species of its mix.
struct ColonyTraits {
    Habit habit = Habit::troop;  ///< requested, or of the species with the largest weight
    bool capped = true;          ///< caps on stems of the colony; otherwise whole individuals
    bool lateral = false;        ///< individuals grow from a vertical surface
    std::uint32_t seed = 1;      ///< of its layout: from that of the request and its set of species
    RootsShown roots = RootsShown::buried;
    Substrate substrate = Substrate::none;  ///< wood behind a tier
    bool operator==(const ColonyTraits&) const = default;
};

/// Checks that the parameters of a request are compatible with its species, before any work.
///
/// throws  InvalidInput for ranges, an empty mix or an unknown species ("mix"); Impossible for a
///         habit that the species cannot have, and for controls of roots, stems or a trunk that the
///         colony does not have
[[nodiscard]] ColonyTraits colony_traits(const ColonySpec& spec, const Atlas& atlas);

}  // namespace sporeprint
