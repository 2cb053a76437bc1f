// Levels of detail: at which size on the screen each is needed, and several of them in one file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/gltf/glb.h"
#include "core/mesh/detail.h"
#include "core/mesh/mesh.h"
#include "core/params/shared_params.h"
#include "core/params/value.h"

namespace sporeprint {

/// One level of detail of an individual.
struct Level {
    DetailLevel lod = 0;
    std::uint64_t vertices = 0, triangles = 0;
    /// Longest side of the bounding box over the height of the screen, down to which this level is
    /// drawn; below it the next one looks the same. Below that of the last level there is nothing to see.
    double screen_coverage = 0.0;
    /// Of its node and mesh in the file; empty: level_name() of its LOD.
    std::string name = {};
};

/// The screen for which coverages are computed: its height, and the height below which an individual
/// is not drawn, pixels.
inline constexpr double screen_pixels = 1080.0, least_pixels = 2.0;

/// Returns the distance between a circle and the polygon of so many corners that is inscribed in
/// it, in radii.
[[nodiscard]] double inscribed_error(int corners);

/// Sets the coverages of all levels: a level is drawn until the outline of the next one differs from
/// the true one by less than a pixel. They descend, from 1 at most.
///
/// box     of the individual, metres
/// errors  largest distance of each level's outline from the true one, metres; ascending
void set_coverages(std::vector<Level>& levels, const Bounds& box, std::span<const double> errors);

/// Returns the whole level of detail whose count is nearest to a number of triangles in ratio; of two
/// equally near ones the finer.
///
/// count_at  triangles at an LOD, positive
[[nodiscard]] int nearest_level(int triangles, const std::function<double(int)>& count_at);

/// Returns the list of levels as JSON.
[[nodiscard]] Value level_list(std::span<const Level> levels);

/// Makes nodes the levels of one individual, as the file requests.
///
/// nodes   of each level, finest first; at one place
/// levels  as many
void link_levels(GlbScene& scene, std::span<const std::size_t> nodes, std::span<const Level> levels,
                 Lods lods);

/// Adds the levels of what consists of several nodes: each of several levels is a node with children.
///
/// name  product_name()
/// add   adds the nodes of a level to the scene; called with its index and level_name()
void add_grouped_levels(GlbScene& scene, const std::string& name, std::span<const Level> levels,
                        Lods lods, const std::function<void(std::size_t, const std::string&)>& add);

/// Adds the levels of an individual that is one mesh: a mesh and a node each.
///
/// name        product_name()
/// primitives  of each level
void add_levels(GlbScene& scene, const std::string& name,
                std::span<const std::vector<GlbPrimitive>> primitives,
                std::span<const Level> levels, Lods lods);

}  // namespace sporeprint
