// What an uploaded scene offers to fungi: its surfels, their light and water, and what they are made of.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/images.h"
#include "core/scene/exposure.h"
#include "core/scene/run_off.h"
#include "core/scene/scene.h"
#include "core/scene/scene_substrates.h"
#include "core/scene/surface_water.h"
#include "core/scene/surfel_graph.h"
#include "core/scene/surfels.h"
#include "core/scene/triangle_tree.h"
#include "core/world/site.h"
#include "core/world/weather.h"
#include "core/world/world_params.h"

namespace sporeprint {

/// The shape of a scene, which neither climate nor species change.
struct SceneShape {
    std::shared_ptr<const Scene> scene;
    TriangleTree tree;
    Surfels surfels;
    SurfelGraph graph;
    std::vector<float> sky;            ///< sky_of() the surfels
    std::vector<std::uint8_t> buried;  ///< buried_of() them: nothing fruits there

    /// Returns the memory that it takes, the scene among it.
    [[nodiscard]] std::size_t bytes() const;
};

/// Computes the shape of a scene.
///
/// scene     not null
/// parallel  looks at stripes of surfels
/// cost      10 s for 100,000 surfels among 200,000 triangles
[[nodiscard]] SceneShape shape_of_scene(std::shared_ptr<const Scene> scene,
                                        const Parallel& parallel = in_turn);

/// What decides on the fungi of a scene besides its shape.
struct SceneConditions {
    std::uint32_t seed = 1;
    ClimateParams climate;
    double acidity = 0.5;  ///< of the soil
    double decay = 0.3;    ///< share of its mass that wood has lost
    double abundance = 1.0;
    std::vector<MaterialSoil> soils;  ///< of each material of the scene
};

/// What the surfels of a scene offer to fungi in a climate.
struct SceneHabitat {
    std::shared_ptr<const SceneShape> shape;
    SceneConditions conditions;
    SurfelSubstrates substrates;
    std::vector<float> rain;  ///< rain_on() the surfels
    RunOff run_off;
    std::vector<float>
        water;  ///< of the run-off, of which wood conducts a part from where it is wet to where it is not
    std::vector<Site> sites;  ///< light in midsummer, wetness in autumn

    [[nodiscard]] const Surfels& surfels() const { return shape->surfels; }
    /// Returns what makes a surfel wet and dry.
    [[nodiscard]] WaterSupply supply(std::size_t surfel) const;
    /// Returns how well a species could live at a surfel, 0..1: 0 where it is not on what it lives on.
    [[nodiscard]] double suitability(const FungusSpecies& species, std::size_t surfel) const;
    /// Returns the memory that it takes, the shape not counted.
    [[nodiscard]] std::size_t bytes() const;
};

/// Computes what the surfels of a scene offer to fungi in a climate.
///
/// conditions  with one soil for each material
/// cost        3 s for 100,000 surfels among 200,000 triangles
[[nodiscard]] SceneHabitat habitat_of(std::shared_ptr<const SceneShape> shape,
                                      SceneConditions conditions,
                                      const Parallel& parallel = in_turn);

/// Returns the water of the surfaces of a scene in a year; that of year 0 also begins with year 0.
[[nodiscard]] SurfaceWater water_of(const SceneConditions& conditions, int year);

}  // namespace sporeprint
