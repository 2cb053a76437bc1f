// Closed solids on a damaged body: rolls of peeled cuticle, drips of ink and drops of water.
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

/// Numbers of solids at a level of detail.
struct SolidCounts {
    int rolls, roll_pieces, drops, drips;
};

/// Returns the vertex and triangle counts when all of them are present; no amount changes them.
[[nodiscard]] MeshCount damage_solid_count(const Individual& individual, DetailLevel level);

/// Appends these solids to the mesh of a swept body, each kind where the individual can have it and
/// the level of detail includes it.
class DamageSolids {
  public:
    /// All references must outlive this object.
    ///
    /// cap          grid of the cap in the mesh; its columns are those of the cuts
    /// keep_absent  whether triangles of absent solids are emitted, with zero area
    DamageSolids(Mesh& mesh, const FaceGrid& cap, const Individual& individual,
                 const MarginCuts& cuts, DetailLevel level, bool keep_absent);

    /// Appends cuticle rolled back along the border of peeled areas. pre: the cap is where it was
    /// swept
    void add_rolls();

    /// Appends drops of water on the cap. pre: the cap is where it was swept
    void add_drops();

    /// Appends ink that gathers at the deliquesced margin and drips. pre: the cap is where the cuts
    /// leave it
    void add_drips();

  private:
    /// Appends the rolls of one species, at most as many as `left`.
    void add_rolls(const MarginDamage& species, std::size_t left);

    /// A point of the cap, interpolated between vertices.
    struct CapPoint {
        glm::dvec3 position, normal, meridian;
        glm::vec2 texture;
    };
    [[nodiscard]] CapPoint cap_point(double share, double turn) const;

    /// Appends a closed solid of rings round a line: corners are [row][column] with the first
    /// column repeated, plus a point at each end.
    void solid(const std::vector<glm::dvec3>& corners, const glm::dvec3& start,
               const glm::dvec3& end, std::size_t sides, const std::vector<glm::vec2>& textures,
               const glm::dvec3& fallback, bool drawn);

    Mesh& mesh_;
    const FaceGrid& cap_;
    const Individual& individual_;
    const SolidCounts& limits_;
    const WeatheringOf<Plain>& amounts_;
    const MarginCuts& cuts_;
    bool keep_absent_, textured_;
    std::size_t columns_;
};

}  // namespace sporeprint
