// The species of a request at the requested age: the input of resolve().
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "core/atlas/atlas.h"
#include "core/individual/mushroom_spec.h"
#include "core/model/model.h"
#include "core/model/species.h"
#include "core/params/blend.h"

namespace sporeprint {

/// The age of recorded sizes, for every species.
inline constexpr double mature_age = 0.6;

/// One species of the request, or the custom Model as a species of a single stage.
struct Source {
    std::string id, label;
    double weight = 1.0;
    std::uint64_t hash = 0;
    Spread spread{0, 0, 0, 0, 0, 0, 0, 0, 0};
    GroundStyle ground;  ///< a custom Model has none
    std::vector<const Model*> stages;
    std::vector<double> ages;    ///< one per stage
    std::vector<double> growth;  ///< growth weight of each stage at this age; at most two are not 0
    std::vector<double> mature;  ///< growth weight of each stage at maturity
    double size = 1.0;           ///< size of its mature shape, metres
    Substrate wood = Substrate::beech;  ///< on which it would grow as a bracket
    Model now;                          ///< blend of the stages at this age

    [[nodiscard]] const Model& first() const { return *stages.front(); }
    [[nodiscard]] bool is_branched() const {
        return std::holds_alternative<Branched>(first().shape);
    }
    [[nodiscard]] HymeniumPattern pattern() const { return first().surface.hymenium.pattern; }
    [[nodiscard]] bool has_blades() const {
        return pattern() == HymeniumPattern::gills || pattern() == HymeniumPattern::ridges;
    }
    /// Returns true for pores and teeth.
    [[nodiscard]] bool has_cells() const {
        return pattern() == HymeniumPattern::pores || pattern() == HymeniumPattern::teeth;
    }
    [[nodiscard]] bool has_ring() const {
        return std::any_of(stages.begin(), stages.end(),
                           [](const Model* stage) { return stage->ring.width > 0.0; });
    }
    [[nodiscard]] bool has_sac() const {
        return std::any_of(stages.begin(), stages.end(),
                           [](const Model* stage) { return stage->sac.height > 0.0; });
    }
    [[nodiscard]] bool has_volva() const { return has_sac() || first().volva.count > 0; }
    [[nodiscard]] bool has_spines() const { return first().spines.count > 0; }
    [[nodiscard]] bool has_peridioles() const { return first().peridioles.count > 0; }
    [[nodiscard]] bool has_receptacle() const { return first().receptacle.meshes > 0; }
    [[nodiscard]] bool melts() const {
        return std::any_of(stages.begin(), stages.end(), [](const Model* stage) {
            return stage->weathering.deliquescence > 0.0;
        });
    }
    [[nodiscard]] bool peels() const {
        return has_margin() && std::any_of(stages.begin(), stages.end(), [](const Model* stage) {
                   return stage->surface.damage.peel_reach > 0.0;
               });
    }
    [[nodiscard]] bool has_margin() const {
        const auto* swept = std::get_if<Swept>(&first().shape);
        return swept && !swept->silhouette.hymenium.empty();
    }
};

/// Returns the species of a mix by id with eased weights, or the custom Model alone.
///
/// throws  InvalidInput for an unknown species and an invalid mix, Impossible (path "mix") for
///         species of several families
[[nodiscard]] std::vector<Source> sources_of(const MushroomSpec& spec, const Atlas& atlas);

/// Returns the outline of a model.
///
/// pre  the model is swept
[[nodiscard]] const Silhouette& silhouette_of(const Model& model);

/// Returns the blend of a property over the sources for which `counts` is true, or over all if
/// there is none.
template <class Counts, class Of>
auto blend_among(const std::vector<Source>& sources, Counts counts, Of of) {
    Shares<std::remove_cvref_t<decltype(of(sources[0]))>> shares;
    double sum = 0.0;
    for (const Source& source : sources)
        if (counts(source)) sum += source.weight;
    for (const Source& source : sources)
        if (counts(source) || sum == 0.0)
            shares.add(of(source), sum > 0.0 ? source.weight / sum : source.weight);
    return blend(shares);
}

}  // namespace sporeprint
