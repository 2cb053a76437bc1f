#include "core/grow/colony_wind.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <vector>

namespace sporeprint {

namespace {

/// Returns the length of a member's stem, metres at size 1.
double stem_length(const ColonyMember& member) { return glm::length(member.rise + member.swing); }

}  // namespace

std::vector<Sway> sway_of_models(const std::vector<ColonyMember>& members,
                                 const ColonyTraits& traits, std::span<const SwayingStem> stems) {
    std::vector<double> heights(stems.size(), 0.0);
    for (std::size_t i = 0; i < stems.size(); ++i) {
        if (!traits.capped) {
            heights[i] = stems[i].top;
            continue;
        }
        double sum = 0.0, count = 0.0;
        for (const ColonyMember& member : members) {
            if (member.model != i) continue;
            sum += stem_length(member);
            count += 1.0;
        }
        heights[i] = count > 0.0 ? sum / count : 0.0;
    }
    const double most = *std::max_element(heights.begin(), heights.end());
    std::vector<Sway> sway;
    for (std::size_t i = 0; i < stems.size(); ++i) {
        sway.push_back({.bend = static_cast<float>(most > 0.0 ? heights[i] / most : 0.0),
                        .phase = phase_of(i),
                        .branch = static_cast<float>(i % 255 + 1) / 255.0F});
        if (traits.lateral) sway.back().bend = 0.0F;
    }
    return sway;
}

void add_sway(Colony& colony, const ColonyTraits& traits, std::span<const SwayingStem> stems,
              std::span<const Sway> tops) {
    const auto add = [&](std::vector<Mesh>& models) {
        for (std::size_t i = 0; i < models.size(); ++i) {
            Mesh& mesh = models[i];
            if (traits.capped) {
                mesh.sway.assign(mesh.positions.size(), tops[i]);
                continue;
            }
            mesh.sway = sway_of(mesh, stems[i]);
            for (Sway& sway : mesh.sway) {
                sway.bend *= tops[i].bend;
                sway.phase = tops[i].phase;
                sway.branch = tops[i].branch;
            }
        }
    };
    add(colony.models);
    for (ColonyLevel& level : colony.farther) add(level.models);
}

std::vector<Sway> sway_of(const ColonySkin& skin, const ColonySite& site,
                          const std::vector<ColonyMember>& members, std::span<const Sway> tops) {
    std::vector<Sway> sway(skin.stems.size());
    for (std::size_t i = 0; i < sway.size(); ++i) {
        if (skin.stems[i] == 0) continue;
        const ColonyMember& member = members[skin.stems[i] - 1];
        const ColonyPlace& place = site.places[member.place];
        const double length = stem_length(member);
        // What is within two radii of the foot belongs to the root, and what is in the ground; no
        // stem slants there by more than 60 degrees.
        const double rigid =
            std::min(2.0 * (place.radius + std::max(-place.foot.y, 0.0)), 0.5 * length);
        const double along =
            glm::dot(glm::dvec3(skin.mesh.positions[i]) - place.foot, member.rise + member.swing) /
            length;
        sway[i] = tops[member.model];
        sway[i].bend *= static_cast<float>(
            deflection(std::clamp((along - rigid) / (length - rigid), 0.0, 1.0)));
    }
    return sway;
}

Wind wind_of(const ColonySite& site, const std::vector<ColonyMember>& members,
             const ColonyTraits& traits, SwayingStem typical, const ColonyParams& params) {
    if (traits.lateral) return {params.file.wind, 0.0, 0.0};
    if (traits.capped) {
        const double cap = typical.top - typical.length;
        typical.length = 0.0;
        for (const ColonyMember& member : members)
            if (const double length = stem_length(member); length > typical.length) {
                typical.length = length;
                typical.radius = site.places[member.place].radius;
            }
        typical.top = typical.length + cap;
        typical.cap_radius *= params.cap_scale;
    }
    return {params.file.wind, params.size * displacement_of_top(typical), 0.0};
}

}  // namespace sporeprint
