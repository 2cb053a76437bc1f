// Flowers on a plot: a few common herbs of woods and meadows, each in its months.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/gltf/glb.h"
#include "core/grow/world/mesh_copies.h"
#include "core/grow/world/plot.h"
#include "core/grow/world/plot_places.h"
#include "core/mesh/mesh.h"
#include "core/world/cover.h"

namespace sporeprint {

/// A herb in flower. Sizes are means, metres.
struct FlowerKind {
    std::string_view name;
    int first = 1, last = 365;  ///< days of the northern year on which some are open
    double per_m2 = 0.0;        ///< in its best places, in the middle of its time
    bool in_woods = false;  ///< between fallen leaves below broad-leaved trees; otherwise in grass
    int petals = 5;
    double width = 0.02, height = 0.1;
    glm::vec3 petal{1.0F}, middle{1.0F};  ///< linear colours
};

/// Returns all kinds.
///
/// source  months, heights and widths as the floras of Central Europe give them, rounded
[[nodiscard]] std::span<const FlowerKind> flower_kinds();

/// Returns a flower on its stalk, closed, with tints, rooted at the origin.
[[nodiscard]] Mesh flower_mesh(const FlowerKind& kind);

/// Returns the share of the flowers of a kind that are open on a day, 0..1.
[[nodiscard]] double open_on(const FlowerKind& kind, int day);

/// Returns the places of the flowers of a kind, in the order of the cells of the world; on a plot that is part of
/// another one are those of the other.
///
/// rim  distance from the border within which none stands, metres
[[nodiscard]] std::vector<GlbTransform> places_of(const FlowerKind& kind,
                                                  const PlotContent& content,
                                                  const PlotFrame& frame, const CoverField& cover,
                                                  double rim = 0.0);

/// The flowers of one kind on a plot.
struct PlotFlowers : MeshCopies {
    std::string name;
};

/// Returns those of the kinds of which some stand there, with places_of() each.
[[nodiscard]] std::vector<PlotFlowers> flowers_on(const PlotContent& content,
                                                  const PlotFrame& frame, const CoverField& cover,
                                                  double rim = 0.0);

}  // namespace sporeprint
