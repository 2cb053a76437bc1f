#include "core/individual/ornaments.h"

#include <cstdint>

#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/params/blend.h"

namespace sporeprint {

namespace {

// A ring or sac of this width, relative to its species' size, has half of its weight in the shape
// of the mix.
constexpr double half_influence = 0.01;

// Weights by extent alone would let a thousandth of a wide ring pull a narrow one up the stem.
template <class Style>
Style blended_shell(const std::vector<Source>& sources, Style Model::*shell, double Style::*extent,
                    double OrnamentsOf<Plain>::*amount, double size) {
    std::vector<Style> styles;
    std::vector<double> influences;
    double total = 0.0, influence_sum = 0.0;
    for (const Source& source : sources) {
        Style style = source.now.*shell;
        style.thickness /= source.size;
        const double extent_share = source.now.ornaments.*amount * style.*extent / source.size;
        total += source.weight * extent_share;
        influences.push_back(source.weight * extent_share / (extent_share + half_influence));
        influence_sum += influences.back();
        styles.push_back(style);
    }
    Shares<Style> shares;
    for (std::size_t i = 0; i < styles.size(); ++i)
        shares.add(styles[i],
                   influence_sum > 0.0 ? influences[i] / influence_sum : sources[i].weight);
    Style one = blend(shares);
    one.*extent = total * size;
    one.thickness *= size;
    return one;
}

}  // namespace

std::vector<PatchLayer> layers_of(const std::vector<Source>& sources, const MorphSet& set) {
    std::vector<PatchLayer> layers;
    const auto segments_of = [&](std::size_t species) {
        std::vector<double> weights;
        for (std::size_t i = 0; i < sources.size(); ++i)
            for (const double mature : sources[i].mature)
                weights.push_back(i == species ? mature : 0.0);
        return Outline(set.nodes(weights)).stem.segment_shares();
    };
    const auto lay = [&](std::uint32_t purpose, PatchStyle Model::*style, auto amount) {
        std::vector<bool> merged(sources.size(), false);
        for (std::size_t i = 0; i < sources.size(); ++i) {
            const PatchStyle& one = sources[i].now.*style;
            if (one.count == 0 || merged[i]) continue;
            const auto alike = [&](const Source& other) {
                const PatchStyle& two = other.now.*style;
                return two.has_places_of(one);
            };
            double weight = 0.0;
            for (std::size_t j = i; j < sources.size(); ++j)
                if (alike(sources[j])) {
                    merged[j] = true;
                    weight += sources[j].weight;
                }
            layers.push_back(
                {purpose,
                 blend_among(sources, alike,
                             [&](const Source& s) -> const PatchStyle& { return s.now.*style; }),
                 blend_among(sources, alike, amount), weight,
                 purpose == purposes::bulb_scales ? segments_of(i) : std::vector<double>{}});
        }
    };
    lay(purposes::warts, &Model::warts,
        [](const Source& s) -> const double& { return s.now.ornaments.warts; });
    lay(purposes::scales, &Model::scales,
        [](const Source& s) -> const double& { return s.now.ornaments.scales; });
    lay(purposes::bulb_scales, &Model::volva,
        [](const Source& s) -> const double& { return s.now.ornaments.volva; });
    return layers;
}

RingStyle ring_of(const std::vector<Source>& sources, double size) {
    return blended_shell(sources, &Model::ring, &RingStyle::width, &OrnamentsOf<Plain>::ring, size);
}

SacStyle sac_of(const std::vector<Source>& sources, double size) {
    return blended_shell(sources, &Model::sac, &SacStyle::height, &OrnamentsOf<Plain>::volva, size);
}

std::vector<SpineLayer> spines_of(const std::vector<Source>& sources, double size) {
    std::vector<SpineLayer> layers;
    for (const Source& source : sources) {
        if (!source.has_spines()) continue;
        SpineStyle style = source.now.spines;
        const double scale = source.is_branched() ? size : size / source.size;
        style.length *= scale;
        style.width *= scale;
        layers.push_back({style, source.weight});
    }
    return layers;
}

std::vector<PeridioleLayer> peridioles_of(const std::vector<Source>& sources, double size) {
    std::vector<PeridioleLayer> layers;
    for (const Source& source : sources) {
        if (!source.has_peridioles()) continue;
        PeridioleStyle style = source.now.peridioles;
        style.size *= size / source.size;
        layers.push_back({style, source.now.ornaments.peridioles, source.weight});
    }
    return layers;
}

std::vector<ReceptacleLayer> receptacles_of(const std::vector<Source>& sources, double size) {
    std::vector<ReceptacleLayer> layers;
    for (const Source& source : sources) {
        if (!source.has_receptacle()) continue;
        ReceptacleStyle style = source.now.receptacle;
        for (double ReceptacleStyle::*const length :
             {&ReceptacleStyle::height, &ReceptacleStyle::width, &ReceptacleStyle::base,
              &ReceptacleStyle::arm})
            style.*length *= size / source.size;
        layers.push_back({style, source.now.ornaments.receptacle, source.weight});
    }
    return layers;
}

std::vector<GroundLayer> grounds_of(const std::vector<Source>& sources, double size) {
    std::vector<GroundLayer> layers;
    for (const Source& source : sources) {
        GroundStyle style = source.ground;
        if (style.empty()) continue;
        const double scale = source.is_branched() ? size : size / source.size;
        for (double* const length : {&style.soil.reach, &style.soil.rise, &style.soil.size,
                                     &style.litter.length, &style.strands.length})
            *length *= scale;
        layers.push_back({style, stream_of(source.id), source.weight});
    }
    return layers;
}

}  // namespace sporeprint
