#include "core/render/shading.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/math/elementary.h"
#include "core/render/daylight.h"

namespace sporeprint::render {

namespace {

constexpr float pi_f = static_cast<float>(pi);
constexpr float reflectance = 0.04F;  ///< at normal incidence, of everything that is not metal
constexpr float emission = 4.0F;      ///< as KHR_materials_emissive_strength in our files

float saturated(float x) { return std::clamp(x, 0.0F, 1.0F); }

float fifth_power(float x) {
    const float square = x * x;
    return square * square * x;
}

/// Returns the highlight of a lamp, relative to the light of a white matt surface that faces it.
///
/// lit, seen  cosines of the angles of lamp and camera with the normal
float highlight(float lit, float seen, float half, float lamp_half, float roughness) {
    const float alpha = std::max(roughness * roughness, 0.01F), square = alpha * alpha;
    const float spread = half * half * (square - 1.0F) + 1.0F;
    const float distribution = square / (pi_f * spread * spread);
    const float k = alpha * 0.5F;
    const float visibility = 0.25F / ((lit * (1.0F - k) + k) * (seen * (1.0F - k) + k));
    const float fresnel = reflectance + (1.0F - reflectance) * fifth_power(1.0F - lamp_half);
    return pi_f * distribution * visibility * fresnel;
}

/// Returns the share of the surroundings that a surface reflects like a mirror.
float mirrored(float seen, float roughness) {
    const float grazing = std::max(1.0F - roughness, reflectance);
    return reflectance + (grazing - reflectance) * fifth_power(1.0F - seen);
}

/// Cosine beyond the terminator up to which light that enters on the lit side of thin flesh still leaves.
constexpr float scattered = 0.25F;

/// Part of the light of the surroundings reflected by neighbouring skin that leaves a hollow; the rest
/// meets skin again. Of the light of lamps, a part arrives after one reflection: what stops it is
/// often far away.
constexpr float leaves_hollow = 0.45F, returned_lamps = 0.2F;

/// Part of the light of the sky and of the sun that crowns of trees scatter down to what they shade, and its colour, as
/// light that passes leaves is greener.
constexpr float passes_crowns = 0.10F, passes_crowns_of_sun = 0.03F;
constexpr glm::vec3 below_crowns_tint(0.94F, 1.0F, 0.86F);

/// Returns the part of the light of the surroundings stopped by neighbouring skin of the same colour
/// that arrives after all: the sum over one, two and more reflections. Hollows in white flesh are
/// bright, and those in coloured flesh are richer in their colour than its outside.
glm::vec3 returned_sky(const glm::vec3& color) {
    return color * leaves_hollow / (glm::vec3(1.0F) - color * (1.0F - leaves_hollow));
}

/// Part of the light that enters thin flesh which leaves it again where it entered, as its scattering
/// lets it: it shines no less in front than thick flesh of the same colour by all that passes.
constexpr float scattered_back = 0.5F;

/// Returns what arrives of light that neighbouring flesh stops: some is reflected, and some passes,
/// because neighbouring flesh is about as thin as that of the point.
glm::vec3 through_neighbours(const SurfacePoint& point, const glm::vec3& of_sky,
                             const glm::vec3& of_lamps) {
    const glm::vec3 passing = point.tint * point.transmission;
    return of_sky * (point.base_color * passing + returned_sky(point.base_color)) +
           point.base_color * of_lamps * (passing + glm::vec3(returned_lamps));
}

/// Returns the light that arrives behind a surface: of a group of lamps, and of the surroundings.
///
/// weight  of each lamp
glm::vec3 arriving_behind(const SurfacePoint& point, const Lamps& lamps, std::size_t group,
                          float weight) {
    glm::vec3 sum(0.0F), stopped(0.0F);
    for (std::size_t i = group; i < lamps.lights.size(); i += lamps.groups) {
        const Light& light = lamps.lights[i];
        const float behind =
            (scattered - glm::dot(point.normal, light.direction)) / (1.0F + scattered);
        if (behind <= 0.0F) continue;
        // A surface that faces away from the lamp is the far side of its own flesh: it is reached
        // unless other flesh is nearer to the lamp.
        const float visible = lamps.shadows[i].light_at(point.at, -point.smooth_normal);
        const glm::vec3 all = light.strength * (behind * weight);
        sum += all * visible;
        stopped += all * (1.0F - visible);
    }
    const Ambient& around = point.ambient;
    return sum + around.behind * point.occlusion +
           through_neighbours(point, around.stopped_behind * point.occlusion, stopped);
}

/// Share of the smooth normal in that of matt light of flesh that scatters: light leaves it about a
/// millimetre from where it entered, so that fine relief is seen in highlights more than in shades.
constexpr float blurred = 0.55F;

/// Returns the normal of matt light.
glm::vec3 matt_normal(const SurfacePoint& point) {
    if (!point.scatters) return point.normal;
    const glm::vec3 between = point.normal + (point.smooth_normal - point.normal) * blurred;
    return between * (1.0F / std::sqrt(std::max(glm::dot(between, between), 1e-6F)));
}

/// Returns how much light of open surroundings falls on a surface, relative to one that faces up.
float brightness(const glm::vec3& normal) { return 0.65F + 0.35F * normal.y; }

}  // namespace

glm::vec3 reflected(const SurfacePoint& point, const MaterialLook& look, const Lamps& lamps,
                    std::size_t group) {
    const glm::vec3& normal = point.normal;
    const float seen = std::max(glm::dot(normal, point.to_camera), 0.02F);
    const float grazing = fifth_power(1.0F - seen);
    const auto coat = static_cast<float>(look.coat);
    const float coat_share = coat * (reflectance + (1.0F - reflectance) * grazing);
    const float coat_roughness = std::max(0.6F * point.roughness, 0.12F);
    // Narrow slots, which are painted as occlusion, shade the lamps too, but less.
    const float slots = 0.4F + 0.6F * point.occlusion;

    const glm::vec3 soft = matt_normal(point);
    glm::vec3 matt(0.0F), shine(0.0F), stopped(0.0F);
    const auto weight = static_cast<float>(lamps.groups) * slots;
    for (std::size_t i = group; i < lamps.lights.size(); i += lamps.groups) {
        const Light& light = lamps.lights[i];
        const float lit = glm::dot(normal, light.direction),
                    lit_matt = glm::dot(soft, light.direction);
        if (lit <= 0.0F && lit_matt <= 0.0F) continue;
        const float visible = lamps.shadows[i].light_at(point.at, point.smooth_normal);
        const glm::vec3 all = light.strength * (std::max(lit_matt, 0.0F) * weight);
        stopped += all * (1.0F - visible);
        if (visible <= 0.0F) continue;
        matt += all * visible;
        if (lit <= 0.0F) continue;
        const glm::vec3 arriving = light.strength * (lit * weight) * visible;
        const glm::vec3 sum = light.direction + point.to_camera;
        const float length = std::sqrt(glm::dot(sum, sum));
        if (length < 1e-3F) continue;
        const glm::vec3 between = sum * (1.0F / length);
        const float half = saturated(glm::dot(normal, between));
        const float lamp_half = saturated(glm::dot(light.direction, between));
        float highlights = highlight(lit, seen, half, lamp_half, point.roughness);
        if (coat > 0.0F) highlights += coat * highlight(lit, seen, half, lamp_half, coat_roughness);
        shine += arriving * highlights;
    }
    // The surroundings were summed for the smooth normal; the sky is brighter than the ground.
    const float bump = brightness(soft) / brightness(point.smooth_normal);
    const glm::vec3 around = point.ambient.arriving * (bump * point.occlusion);
    const glm::vec3 in_hollows =
        (point.ambient.stopped + point.ambient.arriving * (1.0F - point.occlusion)) * bump;
    // Not skin beside it alone keeps light from ground and bark in a wood: crowns do, which let some pass.
    if (lamps.sky && !point.scatters)
        matt +=
            below_crowns_tint * (point.ambient.stopped * (bump * point.occlusion * passes_crowns) +
                                 stopped * passes_crowns_of_sun);
    const glm::vec3 bounced =
        in_hollows * returned_sky(point.base_color) + point.base_color * stopped * returned_lamps;
    matt += around + bounced;
    if (point.transmission > 0.0F) {
        matt += through_neighbours(point, in_hollows, stopped) - bounced;
        matt *= 1.0F - (1.0F - scattered_back) * point.transmission;
        matt += point.tint * point.transmission * arriving_behind(point, lamps, group, weight);
    }
    const float arriving_share =
        saturated(around.y / std::max(point.ambient.arriving.y + point.ambient.stopped.y, 1e-3F));
    const glm::vec3 mirrored_ray =
        normal * (2.0F * glm::dot(normal, point.to_camera)) - point.to_camera;
    const glm::vec3 mirror_image =
        lamps.sky ? lamps.sky->mirrored(mirrored_ray, point.roughness, arriving_share)
                  : mirrored_surroundings(mirrored_ray, point.roughness) * arriving_share;
    const float mirror = mirrored(seen, point.roughness) + coat_share;
    const glm::vec3 light = point.base_color * matt * (1.0F - coat_share) + shine +
                            mirror_image * mirror + glm::vec3(look.sheen) * matt * (2.0F * grazing);
    return light + point.base_color * glm::vec3(look.glow) * emission;
}

glm::vec3 tone_mapped(glm::vec3 light) {
    constexpr float start = 0.8F - 0.04F, rest = 1.0F - start, fading = 0.15F;
    const float least = std::min({light.x, light.y, light.z});
    const float offset = least < 0.08F ? least - 6.25F * least * least : 0.04F;
    light -= glm::vec3(offset);
    const float peak = std::max({light.x, light.y, light.z});
    if (peak < start) return glm::max(light, glm::vec3(0.0F));
    const float shown = 1.0F - rest * rest / (peak + rest - start);
    light *= shown / peak;
    const float colourful = 1.0F / (fading * (peak - shown) + 1.0F);
    return light * colourful + glm::vec3(shown * (1.0F - colourful));
}

}  // namespace sporeprint::render
