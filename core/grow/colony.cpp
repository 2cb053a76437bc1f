#include "core/grow/colony.h"

#include <glm/common.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "core/colony/colony_skin.h"
#include "core/grow/colony_collision.h"
#include "core/grow/colony_estimate.h"
#include "core/grow/colony_individuals.h"
#include "core/grow/colony_scene.h"
#include "core/grow/colony_wind.h"
#include "core/grow/colony_wood.h"
#include "core/grow/impostor.h"
#include "core/grow/mushroom.h"
#include "core/grow/names.h"
#include "core/grow/translucency.h"
#include "core/grow/variants.h"
#include "core/grow/wood.h"
#include "core/params/reader.h"

namespace sporeprint {

namespace {

/// Returns the parameters with every default resolved.
ColonyParams effective_params(ColonyParams params, const ColonyTraits& traits,
                              const ColonyRoots& growth, const StemFit& fit) {
    params.habit = traits.habit;
    params.roots = traits.roots;
    if (traits.habit == Habit::tier) {
        params.trunk_radius = trunk_radius(params, fit);
        params.substrate = traits.substrate;
    }
    // Only those that the habit has.
    const bool rooted = traits.habit == Habit::rooted, stems = traits.capped;
    if (rooted) {
        params.growth.field = growth.field;
        params.growth.field_scale = growth.field_scale;
        params.growth.heading_deg = growth.heading_deg;
        params.growth.arms = growth.arms;
        params.growth.segment_length = growth.segment_length;
        params.growth.decay = growth.decay;
        params.growth.depth = growth.depth;
        params.growth.branch_distance = growth.branch_distance;
        params.growth.branch_jitter_deg = growth.branch_jitter_deg;
        params.growth.area_decay = growth.area_decay;
        params.growth.stem_probability = growth.stem_probability;
        if (stems) params.growth.stem_decay = growth.stem_decay;
    }
    params.growth.root_radius = growth.root_radius;
    if (stems) {
        params.growth.stem_height = growth.stem_height;
        params.growth.stem_displacement = growth.stem_displacement;
        params.growth.stem_segments = growth.stem_segments;
    }
    return params;
}

}  // namespace

Colony colony_parts(const ColonySpec& spec, const Individual& typical, const Atlas& atlas,
                    const ExecutionContext& execution) {
    const ColonyParams& params = spec.params;
    if (params.lod == impostor_lod) {
        ColonySpec shown = spec;
        shown.params.lod = impostor_source_lod;
        shown.params.file.lods = Lods::single;
        shown.params.file.impostor = false;
        Colony colony = colony_parts(shown, typical, atlas, execution);
        colony.effective.lod = params.lod;
        colony.effective.file = params.file;
        return colony;
    }
    const ColonyTraits traits = colony_traits(spec, atlas);
    StemFit fit = fit_of(typical, traits);
    const double painted_length = fit.length;
    const double painted_from = typical.is_branched() ? 0.0 : buried_share(typical.outline.stem);

    execution.observer(Step::build);
    Colony colony;
    colony.farther.resize(levels_in_file(params.lod, params.file).size() - 1);
    const ModelSet models = add_models(spec, traits, atlas, execution, colony, fit);
    throw_if_cancelled(execution);

    const ColonyRoots growth = growth_of(params, traits, fit);
    ColonyFits fits{fit, fit};
    // Whole individuals have the size of their age by themselves, and roots decide on the others.
    if (traits.capped && traits.habit != Habit::rooted)
        fits.youngest =
            fit_of(average_individual(spec, params.distinct - 1, atlas, execution.caches), traits);
    const ColonySite site = colony_site(params, traits, growth, fits);
    colony.members = placed_members(site, models.models, params, traits);
    std::vector<Sway> sway;  // of each model at its top
    if (params.file.wind != WindFormat::none) {
        sway = sway_of_models(colony.members, traits, models.stems);
        add_sway(colony, traits, models.stems, sway);
        colony.wind = wind_of(site, colony.members, traits, swaying_stem(typical), params);
    }
    const std::vector<ColonyFoot> feet = feet_of(site, colony.members, models.feet);
    const auto skin = [&](int lod) {
        throw_if_cancelled(execution);
        ColonyParams at = params;
        at.lod = lod;
        const Skeleton skeleton =
            colony_skeleton(site, colony.members, at, traits, segments_of(growth, lod));
        ColonySkin made = colony_skin(skeleton, {lod, painted_length, textured(spec), painted_from,
                                                 !typical.grounds.empty()});
        if (!sway.empty()) made.mesh.sway = sway_of(made, site, colony.members, sway);
        append(made.mesh,
               colony_ground(typical.grounds, feet, traits, params.count, lod, textured(spec)));
        if (!sway.empty()) made.mesh.sway.resize(made.mesh.positions.size());
        for (glm::vec3& place : made.mesh.positions) place *= static_cast<float>(params.size);
        return std::move(made.mesh);
    };
    colony.skin = skin(params.lod);
    for (std::size_t i = 0; i < colony.farther.size(); ++i)
        colony.farther[i].skin = skin(params.lod + 1 + static_cast<int>(i));
    std::optional<WoodPiece> piece;
    if (traits.substrate != Substrate::none)
        piece = wood_below(colony.members, params, traits, fit);
    const auto wood = [&](int lod, bool with_texture) {
        Mesh made = wood_mesh(*piece, lod, with_texture);
        if (params.file.wind != WindFormat::none) made.sway.resize(made.positions.size());
        for (glm::vec3& place : made.positions) place *= static_cast<float>(params.size);
        return made;
    };
    if (piece) {
        colony.wood = wood(params.lod, textured(spec));
        for (std::size_t i = 0; i < colony.farther.size(); ++i)
            colony.farther[i].wood = wood(params.lod + 1 + static_cast<int>(i), textured(spec));
    }
    colony.has_stems = traits.capped || traits.roots == RootsShown::shown;
    colony.effective = effective_params(params, traits, growth, fit);
    colony.junction = fit.radius;

    std::vector<bool> shown(colony.models.size(), false);
    for (ColonyMember& member : colony.members) {
        member.pose.at *= params.size;
        member.pose.scale *= params.size;
        shown[member.model] = true;
    }
    if (params.file.collision != CollisionFormat::none)
        colony.collision = colony_collision(site, colony.members, models.shapes, params, traits);
    if (piece && params.file.collision != CollisionFormat::none) {
        const Mesh solid = wood(last_lod, false);
        for (CollisionShape& shape : fitted_shapes("wood", solid.positions, solid.indices))
            colony.collision.add(std::move(shape));
    }
    for (std::size_t i = 0; i < shown.size(); ++i) {
        if (shown[i]) continue;
        colony.models[i] = {};
        for (ColonyLevel& level : colony.farther) level.models[i] = {};
    }
    if (colony.members.empty() && colony.skin.positions.empty())
        throw Impossible("/stem_probability", "no root node of this seed bears anything");
    return colony;
}

Bounds bounds(const Colony& colony) {
    constexpr float far = 1e9F;
    Bounds box{glm::vec3(far), glm::vec3(-far)};
    const auto add = [&](const glm::vec3& at) {
        box.min = glm::min(box.min, at);
        box.max = glm::max(box.max, at);
    };
    for (const Mesh* mesh : {&colony.skin, &colony.wood})
        for (const glm::vec3& at : mesh->positions) add(at);
    for (const ColonyMember& member : colony.members)
        for (const glm::vec3& at : colony.models[member.model].positions)
            add(glm::vec3(member.pose.world(glm::dvec3(at))));
    return box;
}

std::uint64_t instanced_triangles(const Colony& colony) {
    std::uint64_t triangles = colony.skin.triangles() + colony.wood.triangles();
    for (const ColonyMember& member : colony.members)
        triangles += colony.models[member.model].triangles();
    return triangles;
}

MushroomSpec paint_mushroom_spec(const ColonySpec& spec) {
    MushroomSpec own;
    own.mix = spec.mix;
    own.params.seed = spec.params.seed;
    own.params.share = spec.params.share;
    own.params.age = spec.params.age;
    own.params.lod = cap_lod(spec.params.lod);
    own.params.texture_size = spec.params.texture_size;
    own.params.textures = spec.params.textures;
    own.params.variants = spec.params.variants;
    own.params.base = spec.params.base;
    return own;
}

PaintSpec paint_spec_of(const ColonySpec& spec, const MushroomSpec& painted, const Atlas& atlas,
                        const Caches& caches) {
    PaintSpec paint_spec = paint_spec_of(painted, atlas, caches);
    // The resolution is that of the colony's level of detail, the painted detail that of its caps'.
    for (PaintShare& share : paint_spec)
        share.painting.side = spec.params.texture_size >> spec.params.lod;
    return paint_spec;
}

Grown grow_colony(const ColonySpec& spec, const Atlas& atlas, const Extras& extras,
                  const ExecutionContext& execution) {
    execution.observer(Step::resolve);
    return grow_colony(spec, typical_individual(spec, atlas, execution.caches), atlas, extras,
                       execution);
}

Grown grow_colony(const ColonySpec& spec, const Individual& typical, const Atlas& atlas,
                  const Extras& extras, const ExecutionContext& execution) {
    if (spec.params.triangles)
        return grow_colony(at_level(spec, typical, atlas), typical, atlas, extras, execution);
    const ColonyParams& params = spec.params;
    refuse_impossible(params.file, params.textures);
    refuse_impossible_variants(params.variants, params.textures, params.file);
    refuse_impossible_impostor(params.lod, params.file, params.textures, params.variants);
    Colony colony = colony_parts(spec, typical, atlas, execution);
    std::optional<Impostor> impostor;
    if (has_impostor(params.lod, params.file)) {
        impostor = impostor_of(
            [&](const Extras& drawing) {
                (void)grow_colony(impostor_source(spec), typical, atlas, drawing, execution);
            },
            frame_side_of(params.texture_size), params.file, execution);
        if (colony.wind.format != WindFormat::none) add_sway(*impostor, colony.wind);
    }
    const bool has_meshes = params.lod != impostor_lod;
    const Bounds box = bounds(colony);
    GlbScene scene;
    set_options(scene, params.file);
    scene.stands_on_ground = colony_traits(spec, atlas).habit != Habit::tier;
    const MushroomSpec painted = paint_mushroom_spec(spec);
    const auto painting_of = [&](const MushroomSpec& one) {
        return paint_spec_of(spec, one, atlas, execution.caches);
    };
    EmbeddedImages images;
    std::vector<EmbeddedImages> variant_images;
    if (has_meshes) {
        scene.materials.push_back(
            {.name = skin_name(spec),
             .look = look_of(typical.model),
             .transmission = transmission_of(typical, params.file, execution)});
        images = attach_images(scene.materials.front(), params.textures, params.file,
                               extras.image_urls, execution, [&](ImageFormat format) {
                                   return painted_images(painting_of(painted), execution, format);
                               });
        variant_images = add_variants(scene, variants_of(painted, typical), params.textures,
                                      params.file, extras, execution, painting_of);
    }
    const std::size_t wood_material = scene.materials.size();
    EmbeddedImages images_of_wood;
    if (has_meshes && !colony.wood.positions.empty()) {
        const WoodPaint paint{*colony.effective.substrate,
                              wood_side(params.texture_size, params.lod)};
        images_of_wood =
            add_wood_material(scene, paint, params.textures, params.file, extras, execution);
    }
    execution.observer(Step::pack);
    std::vector<Level> levels{{params.lod}};
    if (params.file.lods != Lods::single) {
        levels = levels_of(spec, typical, atlas, box);
        const std::size_t meshes = levels.size() - (impostor ? 1 : 0);
        for (std::size_t i = 0; i < meshes; ++i) {
            const MeshCount count =
                i == 0 ? count_of(colony.skin, colony.wood, colony.models)
                       : count_of(colony.farther[i - 1].skin, colony.farther[i - 1].wood,
                                  colony.farther[i - 1].models);
            levels[i].vertices = count.vertices;
            levels[i].triangles = count.triangles;
        }
    }
    scene.extras_json =
        dump(extras_value(extras, write(colony.effective), box,
                          has_meshes ? instanced_triangles(colony) : impostor->cards.triangles(),
                          {levels, params.file.lods}, colony.wind));
    add_grouped_levels(scene, product_name(spec), levels, params.file.lods,
                       [&](std::size_t i, const std::string& name) {
                           if (impostor && i + 1 == levels.size())
                               add_cards(scene, *impostor, product_name(spec), name);
                           else if (i == 0)
                               add_colony(scene, colony, colony.skin, colony.wood, colony.models,
                                          wood_material, name);
                           else
                               add_colony(scene, colony, colony.farther[i - 1].skin,
                                          colony.farther[i - 1].wood, colony.farther[i - 1].models,
                                          wood_material, name);
                       });
    add_collision(scene, colony.collision, level_name(product_name(spec), params.lod),
                  params.file.collision);
    const Estimate e = measured(spec, colony);
    return {extras.write(scene, execution.parallel), e.vertices, e.triangles};
}

}  // namespace sporeprint
