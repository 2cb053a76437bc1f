// Pipeline of a colony: from a request to a GLB file.
#pragma once

#include <cstdint>
#include <vector>

#include "core/atlas/atlas.h"
#include "core/colony/colony_spec.h"
#include "core/colony/separation.h"
#include "core/grow/collision.h"
#include "core/grow/painting.h"
#include "core/grow/product.h"

namespace sporeprint {

/// The meshes of a colony at a level of detail below the requested one.
struct ColonyLevel {
    Mesh skin, wood;
    std::vector<Mesh> models;
};

/// The parts of a colony; each mesh is stored once.
struct Colony {
    /// Roots, stems and the ground at their feet, or the ground alone; empty where there is nothing.
    Mesh skin;
    Mesh wood;                          ///< what a tier stands on; empty for none
    std::vector<Mesh> models;           ///< caps or whole individuals; unused ones are empty
    std::vector<ColonyMember> members;  ///< with the poses of the file
    std::vector<ColonyLevel> farther;  ///< further levels of detail of the file, with these members
    ColonyParams effective;  ///< every parameter resolved; requesting it gives the same colony
    Collision collision;     ///< of all members, if the file has it
    Wind wind;
    bool has_stems = true;  ///< or roots; otherwise the skin is ground
    double junction = 0.0;  ///< radius of the stem at size 1 where caps are cut off
};

/// Builds the parts: `distinct` individuals of the mix, from the oldest to those of half its age,
/// placed on stems or as whole mushrooms.
///
/// spec     at_level() of a request
/// typical  typical_individual() of the spec
/// throws   InvalidInput, Impossible, Cancelled
[[nodiscard]] Colony colony_parts(const ColonySpec& spec, const Individual& typical,
                                  const Atlas& atlas, const ExecutionContext& execution = {});

/// Returns the bounding box of all instances of a colony.
[[nodiscard]] Bounds bounds(const Colony& colony);

/// Returns the number of triangles drawn at the requested level of detail, counting every instance.
[[nodiscard]] std::uint64_t instanced_triangles(const Colony& colony);

/// Returns the spec of the mushroom whose images all members of a colony use, with the variants of
/// the colony.
///
/// spec  at_level() of a request
[[nodiscard]] MushroomSpec paint_mushroom_spec(const ColonySpec& spec);

/// Returns everything that painting these images depends on, or those of a variant.
///
/// painted  paint_mushroom_spec() of the colony, or that of one of its variants
[[nodiscard]] PaintSpec paint_spec_of(const ColonySpec& spec, const MushroomSpec& painted,
                                      const Atlas& atlas, const Caches& caches = {});

/// Builds a colony: one skin, a few caps, and a node per individual, or an instanced node per cap.
/// Of several levels of detail each is one node whose children these are.
///
/// returns  the GLB as shared slices: header with JSON, geometry, images
/// throws   InvalidInput, Impossible, GenerationError, Cancelled
[[nodiscard]] Grown grow_colony(const ColonySpec& spec, const Atlas& atlas,
                                const Extras& extras = {}, const ExecutionContext& execution = {});

/// Does the same for a spec whose typical individual is resolved already.
[[nodiscard]] Grown grow_colony(const ColonySpec& spec, const Individual& typical,
                                const Atlas& atlas, const Extras& extras,
                                const ExecutionContext& execution);

}  // namespace sporeprint
