// The mycelia of a scene: where and when they begin on its surface, and which of them has a place.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "core/scene/scene_habitat.h"
#include "core/scene/scene_spores.h"
#include "core/world/mycelia.h"

namespace sporeprint {

/// A mycelium on the surface of a scene.
struct SceneGenet {
    Genet genet;               ///< its host is piece_id() of the wood that it lives on or with
    std::uint32_t surfel = 0;  ///< its centre, or that of the rim where it enters the scene first
    bool is_from_outside = false;  ///< its centre lies beside the scene
    bool operator==(const SceneGenet&) const = default;
};

/// Returns the id of a piece of wood of a scene, by its number.
[[nodiscard]] std::uint64_t piece_id(std::uint32_t piece);

/// Returns all mycelia of a species that begin before the end of a year, by their births. Those of an earlier year are
/// the first ones of a later year.
///
/// They begin at random places of what the species lives on, at random times, on each square metre as often as in
/// worlds, and on the ground beside the scene, which is taken to be like its own; and grow up where spores have arrived, the place is suitable, and no older mycelium of the species has it.
///
/// index   of the species, noted in its mycelia
/// throws  Impossible (path "/scene") if there are too many
[[nodiscard]] std::vector<SceneGenet> scene_genets(const SceneHabitat& habitat,
                                                   const FungusSpecies& species, std::uint8_t index,
                                                   const SceneEstablishment& establishment,
                                                   int year);

/// Which mycelium of a species has each surfel at a moment.
struct Territory {
    static constexpr std::uint32_t nobody = std::numeric_limits<std::uint32_t>::max();

    std::vector<std::uint32_t> owner;  ///< number of the mycelium, or nobody
    std::vector<float> distance;       ///< from its centre over the surface, metres
};

/// Returns which mycelium of a species has each surfel: of those that live, the one that has arrived first. Mycelia grow
/// over the surface, as fast in all directions, and only over what the species lives on. None grows through another.
///
/// genets  of the species
/// cost    0.1 s for 100,000 surfels
[[nodiscard]] Territory territory_of(const SceneHabitat& habitat, const FungusSpecies& species,
                                     std::span<const SceneGenet> genets, WorldTime time);

/// Finds whether a mycelium has a place, one place at a time.
class MyceliumRivals {
  public:
    MyceliumRivals(const SceneHabitat& habitat, const FungusSpecies& species);
    ~MyceliumRivals();
    MyceliumRivals(const MyceliumRivals&) = delete;
    MyceliumRivals& operator=(const MyceliumRivals&) = delete;

    /// Adds a mycelium, which the finder refers to by its number from 0 on.
    void add(const SceneGenet& genet);
    /// Returns whether one that lives at a moment has a surfel then, and arrived before another moment.
    ///
    /// own       id of a mycelium that is no rival, 0 for none
    /// before    years
    /// founding  mycelia also have all within this distance, metres
    [[nodiscard]] bool has_owner(std::uint32_t surfel, std::uint64_t own, WorldTime time,
                                 double before, double founding) const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace sporeprint
