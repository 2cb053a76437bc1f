// Closed solids that stand on a worn body: rolls of peeled skin, drips of ink and drops of water.
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "core/geometry/damage_cuts.h"
#include "core/geometry/weathering.h"
#include "core/individual/individual.h"
#include "core/mesh/detail.h"
#include "core/mesh/mesh.h"

namespace sporeprint {

/// How many of them a level of detail carries.
struct SolidNumbers {
    int rolls, roll_pieces, drops, drips;
};

/// What they come to when all of them are there; no amount changes it.
[[nodiscard]] MeshCount worn_solids_count(const Individual& individual, int lod);

/// Appends them to the mesh of a swept body, each kind where the individual can have it and the level of detail carries it.
class WornSolids {
  public:
    /// What is referred to must outlive this.
    ///
    /// cap          of the mesh; its columns are those of the cuts
    /// keep_absent  whether triangles of what is absent stay, without area
    WornSolids(Mesh& mesh, const FaceGrid& cap, const Individual& individual, const Cuts& cuts,
               int lod, bool keep_absent);

    /// Skin rolled back along the border of what has peeled off. pre: the cap stands where it was swept
    void rolls();

    /// Drops of water on the cap. pre: the cap stands where it was swept
    void drops();

    /// Ink that gathers at the melted margin and falls. pre: the cap stands where the cuts leave it
    void drips();

  private:
    /// The place of the cap between its vertices.
    struct Spot {
        glm::dvec3 position, normal, meridian;
        glm::vec2 texture;
    };
    [[nodiscard]] Spot spot(double share, double turn) const;

    /// A closed solid of rings round a line: [row][column], the first column repeated, a point at each end.
    void solid(const std::vector<glm::dvec3>& corners, const glm::dvec3& start,
               const glm::dvec3& end, std::size_t sides, const std::vector<glm::vec2>& textures,
               const glm::dvec3& fallback, bool drawn);

    Mesh& mesh_;
    const FaceGrid& cap_;
    const Individual& individual_;
    const SolidNumbers& carries_;
    const WeatheringOf<Plain>& amounts_;
    const Cuts& cuts_;
    bool keep_absent_, textured_;
    std::size_t columns_;
};

}  // namespace sporeprint
