// The fruit bodies on a plot: each is shown by the nearest of a few individuals.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/gltf/glb.h"
#include "core/grow/world/plot.h"
#include "core/grow/world/plot_places.h"
#include "core/individual/individual.h"

namespace sporeprint {

struct PlotBodies {
    /// An individual that stands for others of its species and of about its age.
    struct Shape {
        MushroomSpec spec;
        Individual individual;
        Mesh mesh;
        std::string name;
    };
    struct Placed {
        std::size_t shape = 0;
        std::uint64_t id = 0;
        std::size_t species = 0;
        double age = 0.6;
        GlbTransform place;
    };
    std::vector<Shape> shapes;   ///< at most most_plot_mushrooms
    std::vector<Placed> bodies;  ///< in the order of the content
};

/// Returns which of so many equal parts of its life a body is in, from 0 on.
[[nodiscard]] int part_of_life(double age, int parts);

/// What shows bodies of a species: an individual, and whether it grows from its side.
struct BodyLook {
    MushroomSpec spec;  ///< at LOD 0, without the options of a file
    bool is_lateral = false;
};

/// Returns the individual that shows bodies of a species of a plot.
///
/// species  number of it in the content
/// throws   InvalidInput (path "/species") for an unknown species
[[nodiscard]] BodyLook look_of_body(const PlotContent& content, std::size_t species, double age,
                                    std::uint32_t seed, const Atlas& atlas);

/// Returns the individual that shows bodies of a species of a list.
[[nodiscard]] BodyLook look_of_body(const std::vector<std::string>& ids, std::size_t species,
                                    double age, std::uint32_t seed, const Atlas& atlas);

/// An individual and its mesh at one level of detail, which all tiles share that show it.
struct BodyShape {
    Individual individual;
    Mesh mesh;

    /// Returns about the size of all of it.
    [[nodiscard]] std::size_t bytes() const;
};

/// Returns what shows bodies on tiles, cached in execution.caches or grown now.
///
/// spec  of a species of the atlas, by look_of_body()
[[nodiscard]] std::shared_ptr<const BodyShape> body_shape(const MushroomSpec& spec,
                                                          const Atlas& atlas,
                                                          const ExecutionContext& execution);

/// How bodies are shown.
struct BodyDetail {
    int lod = 1;
    Textures textures = Textures::embedded;
    FileOptions file;
    std::uint64_t most =
        0;  ///< number of triangles that they may have; fewer ones than at that level of detail
};

/// Returns the place of a body, by its number among those that are shown.
///
/// is_lateral  its model grows from its side
using BodyPlace = std::function<GlbTransform(std::size_t number, bool is_lateral)>;

/// Returns the individuals that show bodies at a moment, and where each stands.
///
/// species  ids of the species
/// throws   InvalidInput (path "/species") for an unknown species
[[nodiscard]] PlotBodies shown_bodies(const std::vector<const FruitBody*>& bodies, WorldTime time,
                                      const std::vector<std::string>& species,
                                      const BodyPlace& place, const BodyDetail& detail,
                                      const Atlas& atlas, const ExecutionContext& execution);

/// Returns the bodies that stand on a plot.
///
/// most    number of triangles that they may have; fewer ones than at the level of detail of the options
/// throws  InvalidInput (path "/species") for an unknown species
[[nodiscard]] PlotBodies bodies_of(const PlotContent& content, const PlotOptions& options,
                                   const PlotFrame& frame, std::uint64_t most, const Atlas& atlas,
                                   const ExecutionContext& execution);

}  // namespace sporeprint
