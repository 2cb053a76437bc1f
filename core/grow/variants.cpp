#include "core/grow/variants.h"

#include <algorithm>
#include <utility>

#include "core/grow/mushroom.h"
#include "core/problems.h"

namespace sporeprint {

namespace {

// Amounts of weathering, 0..1, and the colour of rime: estimates, no measurement is recorded.
constexpr double wet_film = 0.9, dry_fade = 0.2, aged_fade = 0.6, aged_bruise = 0.5,
                 aged_dust = 0.5;
constexpr glm::dvec3 rime(0.8, 0.87, 0.95);

}  // namespace

void refuse_impossible_variants(Variants variants, Textures textures, const FileOptions& file) {
    if (variants == Variants::none) return;
    const std::string value = std::string("'") + name(variants) + "' ";
    if (textures == Textures::none)
        throw Impossible("/variants",
                         value + "needs images; ask for textures other than none, or for none");
    if (file.materials == MaterialSet::core)
        throw Impossible(
            "/variants",
            value + "is an extension of materials; ask for materials=full or rich, or for none");
}

std::vector<Variant> variants_of(const MushroomSpec& spec, const Individual& individual) {
    if (spec.params.variants == Variants::none) return {};
    const WeatheringOf<Plain>& now = individual.model.weathering;
    std::vector<Variant> variants;
    const auto add = [&](std::string name, const WeatheringOf<Plain>& then) {
        Variant variant{std::move(name), spec, {}};
        variant.painted.params.variants = Variants::none;
        WeatheringOf<Maybe>& own = variant.painted.params.weathering;
        own.wetness = then.wetness;
        own.fade = then.fade;
        own.bruise = then.bruise;
        own.dust = then.dust;
        Model model = individual.model;
        model.weathering = then;
        variant.look = look_of(model);
        variants.push_back(std::move(variant));
    };
    WeatheringOf<Plain> dry = now, wet = now, aged = now;
    dry.wetness = aged.wetness = 0.0;
    dry.fade = std::max(now.fade, dry_fade);
    wet.wetness = wet_film;
    aged.fade = std::max(now.fade, aged_fade);
    aged.bruise = std::max(now.bruise, aged_bruise);
    aged.dust = std::max(now.dust, aged_dust);
    add("dry", dry);
    add("wet", wet);
    add("aged", aged);
    variants.push_back({"frosted", spec, look_of(individual.model), false});
    variants.back().look.sheen = rime;
    variants.back().look.coat = 0.0;
    return variants;
}

int image_sets(Variants variants) { return variants == Variants::none ? 1 : 4; }

std::vector<EmbeddedImages> add_variants(
    GlbScene& scene, const std::vector<Variant>& variants, Textures textures,
    const FileOptions& file, const Extras& extras, const ExecutionContext& execution,
    const std::function<PaintSpec(const MushroomSpec&)>& paint_spec_of) {
    std::vector<EmbeddedImages> images;
    for (const Variant& variant : variants) {
        GlbMaterial material = scene.materials.front();
        material.name += '_' + variant.name;
        material.look = variant.look;
        if (variant.has_own_images) {
            const bool linked = has_addresses(textures) && extras.variant_urls;
            images.push_back(attach_images(
                material, textures, file,
                linked ? extras.variant_urls(variant.painted) : ImageUrls{}, execution,
                [&](ImageFormat format) {
                    return painted_images(paint_spec_of(variant.painted), execution, format);
                }));
        }
        scene.variants.push_back(variant.name);
        scene.materials.push_back(std::move(material));
    }
    return images;
}

std::vector<std::size_t> variant_materials(const GlbScene& scene) {
    std::vector<std::size_t> materials;
    for (std::size_t i = 0; i < scene.variants.size(); ++i) materials.push_back(i + 1);
    return materials;
}

}  // namespace sporeprint
