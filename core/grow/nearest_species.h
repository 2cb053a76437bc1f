// The species of an atlas that a mushroom on a picture looks like. For pictures, never for identifying
// mushrooms to eat.
#pragma once

#include <cstddef>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/atlas/atlas.h"
#include "core/images.h"
#include "core/individual/mushroom_spec.h"
#include "core/render/render.h"
#include "core/trace/likeness.h"

namespace sporeprint {

/// Returns a picture of a mushroom before nothing: without a ground and its shadow.
///
/// throws  as grow_mushroom() and rendered()
[[nodiscard]] RgbaImage cut_out_picture(const MushroomSpec& spec, const Atlas& atlas,
                                        const PictureParams& params);

/// A species that a mushroom looks like.
struct NearSpecies {
    std::string id;
    double age = 0.0;  ///< of the stage that it is nearest to
    trace::Unlikeness apart;
};

/// Returns how near a species is, at the stage that it is nearest to, by pictures that are drawn for this.
///
/// id    of a species of the atlas
/// cost  about 9 ms for each of its stages
[[nodiscard]] NearSpecies near_species(const trace::Likeness& likeness, const std::string& id,
                                       const Atlas& atlas);

/// Pictures of all species of an atlas at each of their stages, as they are compared.
class NearestSpecies {
  public:
    /// Draws all species from the front.
    ///
    /// atlas     read here alone
    /// parallel  a task for each species
    /// cost      about 9 ms for each stage of a species
    explicit NearestSpecies(const Atlas& atlas, const Parallel& parallel = in_turn);

    /// Returns the nearest species, each once, the nearest first.
    [[nodiscard]] std::vector<NearSpecies> find(const trace::Likeness& likeness,
                                                std::size_t count) const;

  private:
    struct Drawn {
        std::string id;
        double age = 0.0;
        trace::Likeness likeness;
    };
    std::vector<Drawn> drawn_;
};

/// The same, made when it is first needed. Thread-safe.
class LazyNearestSpecies {
  public:
    /// atlas  the same one in every call
    /// cost   of the first call see NearestSpecies; others wait for it
    [[nodiscard]] const NearestSpecies& get(const Atlas& atlas, const Parallel& parallel);

  private:
    std::once_flag once_;
    std::optional<NearestSpecies> made_;
};

}  // namespace sporeprint
