// What fungi of an uploaded scene live on: by the names of its materials.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/problems.h"
#include "core/scene/surfel_graph.h"
#include "core/scene/surfels.h"
#include "core/world/mycelia.h"

namespace sporeprint {

/// What a material is to fungi.
enum class Soil {
    none,    ///< rock, metal, water: nothing lives on it
    ground,  ///< soil, with roots and litter of trees that are named or stand near
    litter,  ///< the floor of a wood
    grass,   ///< turf
    wood     ///< wood or bark
};

constexpr const char* name(Soil soil) {
    switch (soil) {
        case Soil::none:
            return "none";
        case Soil::ground:
            return "ground";
        case Soil::litter:
            return "litter";
        case Soil::grass:
            return "grass";
        case Soil::wood:
            return "wood";
    }
    return nullptr;
}

/// All kinds of trees.
inline constexpr std::uint32_t all_trees = 0xFFFFFFFFU;

/// What a material is, and of which trees.
struct MaterialSoil {
    Soil soil = Soil::none;
    /// Kinds of trees, one bit for each: of wood those that it may be of; of ground and litter those whose roots and
    /// leaves are in it besides those of trees that stand near.
    std::uint32_t trees = 0;
    bool operator==(const MaterialSoil&) const = default;
};

/// What somebody says of a material by its name.
struct NamedSoil {
    std::string material;
    MaterialSoil soil;
    bool operator==(const NamedSoil&) const = default;
};

/// Reads what materials are: "Bark:beech,Soil:ground+spruce,Rock:none". Words are none, ground, litter, grass, wood (of
/// any tree), kinds of trees, and other names of these, as beech, oak and pine. A tree alone is its wood; behind ground
/// or litter it is one whose roots and leaves are in it.
///
/// kinds     ids of the kinds of trees, at most 32
/// path      of the problems
/// returns   nothing if there is a problem
[[nodiscard]] std::vector<NamedSoil> soils_in(std::string_view text,
                                              std::span<const std::string> kinds,
                                              const std::string& path,
                                              std::vector<Problem>& problems);

/// Returns what a material seems to be by the words in its name, none if there is no word that is known.
[[nodiscard]] MaterialSoil guessed_soil(std::string_view material,
                                        std::span<const std::string> kinds);

/// Returns what each material of a scene is: as named, otherwise as guessed. Names are compared without regard to
/// capital letters.
///
/// path  of the problems: a name that no material of the scene has
[[nodiscard]] std::vector<MaterialSoil> soils_of(std::span<const std::string> materials,
                                                 std::span<const NamedSoil> named,
                                                 std::span<const std::string> kinds,
                                                 const std::string& path,
                                                 std::vector<Problem>& problems);

/// A connected piece of wood of a scene.
struct SceneWood {
    glm::dvec3 low{0.0}, high{0.0};  ///< its box
    double area = 0.0;               ///< of its bark, m²
    std::uint32_t trees = 0;         ///< that it may be of
    bool stands = false;             ///< it is higher than wide
    /// Returns its height, metres.
    [[nodiscard]] double height() const { return high.y - low.y; }
};

/// What surfels offer to fungi.
struct SurfelSubstrates {
    static constexpr std::uint32_t no_piece = 0xFFFFFFFFU;

    std::vector<Soil> soils;
    std::vector<std::uint32_t>
        trees;  ///< kinds that a surfel is of, or that it has roots and litter of
    std::vector<std::uint32_t>
        pieces;  ///< of wood, or the nearest standing one whose roots reach the ground here
    std::vector<SceneWood> wood;

    /// Returns whether a species lives on what is at a surfel.
    ///
    /// decay  share of its mass that wood has lost, 0..1
    [[nodiscard]] bool suits(const FungusSpecies& species, std::size_t surfel, double decay) const;
    /// Returns the memory that they take.
    [[nodiscard]] std::size_t bytes() const;
    bool operator==(const SurfelSubstrates& other) const {
        return soils == other.soils && trees == other.trees && pieces == other.pieces;
    }
};

/// Returns what surfels offer to fungi.
///
/// soils  of the materials of the scene
/// cost   0.1 s for 100,000 surfels
[[nodiscard]] SurfelSubstrates substrates_of(const Surfels& surfels, const SurfelGraph& graph,
                                             std::span<const MaterialSoil> soils);

/// Returns how far from the axis of a standing tree its roots reach, metres.
[[nodiscard]] double root_reach_of(const SceneWood& tree);

}  // namespace sporeprint
