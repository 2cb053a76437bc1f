#include "core/grow/impostor.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "core/grow/levels.h"
#include "core/impostor/cards.h"
#include "core/impostor/impostor_atlas.h"
#include "core/params/messages.h"
#include "core/problems.h"

namespace sporeprint {

namespace {

/// Sets what every source has in common.
///
/// divisor  of the side of its images at LOD 0
template <class Params>
void set_source(Params& params, int divisor) {
    params.lod = impostor_source_lod;
    params.triangles.reset();
    params.textures = Textures::embedded;
    params.file = {};
    params.texture_size.value = std::max(params.texture_size.value / divisor, 128);
}

/// Returns extras.impostor of the material, from which a shader reads where the frames are.
std::string extras_of(const ImpostorAtlas& atlas) {
    const auto number = [](float value) { return Value(static_cast<double>(value)); };
    Value centre = Value::array();
    for (const float x : {atlas.centre.x, atlas.centre.y, atlas.centre.z}) centre.push(number(x));
    Value impostor = Value::object();
    impostor.set("mapping", Value(std::string("hemi_octahedral")))
        .set("grid", Value(frame_grid))
        .set("frame_texels", Value(atlas.frame_side))
        .set("side_texels", Value(atlas.side()))
        .set("centre_m", std::move(centre))
        .set("radius_m", number(atlas.radius))
        .set("texel_m", number(2.0F * atlas.radius / static_cast<float>(atlas.frame_side)))
        .set("normal_length", number(atlas.normal_length))
        .set("depth", Value(std::string("metallicRoughnessTexture.r")));
    return dump(Value::object().set("impostor", std::move(impostor)));
}

}  // namespace

int frame_side_of(TextureSize texture_size) {
    const int side = texture_size.value / 3 / frame_grid / 8 * 8;
    return std::clamp(side, least_frame_side, largest_frame_side);
}

MushroomSpec impostor_source(const MushroomSpec& spec) {
    MushroomSpec source = spec;
    set_source(source.params, 2);
    return source;
}

ColonySpec impostor_source(const ColonySpec& spec) {
    ColonySpec source = spec;
    set_source(source.params, 2);
    return source;
}

TreeSpec impostor_source(const TreeSpec& spec) {
    TreeSpec source = spec;
    // A leaf is about a texel wide.
    set_source(source.params, 4);
    source.params.instancing = LeafInstancing::none;
    return source;
}

void refuse_impossible_impostor(int lod, const FileOptions& file, Textures textures,
                                Variants variants) {
    if (!has_impostor(lod, file)) return;
    if (variants != Variants::none)
        throw Impossible("/variants", in_quotes(name(variants)) +
                                          " is impossible for an impostor, which shows one "
                                          "weather; ask for none");
    if (textures == Textures::embedded) return;
    throw Impossible(
        "/textures",
        in_quotes(name(textures)) +
            " is impossible for an impostor, which consists of images that have no "
            "addresses; ask for embedded" +
            (lod == impostor_lod ? ", or for a lower lod" : ", or for impostor=false"));
}

Impostor impostor_of(const std::function<void(const Extras&)>& grow, int frame_side,
                     const FileOptions& file, const ExecutionContext& execution) {
    Impostor impostor;
    ImpostorAtlas atlas;
    Extras extras;
    extras.write = [&](const GlbScene& scene, const Parallel& parallel) -> Body {
        throw_if_cancelled(execution);
        execution.observer(Step::draw);
        atlas = impostor_atlas(scene, frame_side, parallel);
        // Highlights of a coat and sheen are smaller than a texel; light of its own is seen from afar.
        impostor.material.look.glow = scene.materials.front().look.glow;
        return {};
    };
    grow(extras);
    throw_if_cancelled(execution);
    impostor.cards = impostor_cards(atlas);
    impostor.box = atlas.box;
    impostor.material.alpha_cutoff = cutoff_of(atlas.base_color, atlas.side());
    impostor.material.has_occlusion = false;
    impostor.material.extras_json = extras_of(atlas);
    const auto images = [&](ImageFormat format) {
        return std::make_shared<const ImageSet>(encoded(atlas, format, execution.parallel));
    };
    impostor.images =
        attach_images(impostor.material, Textures::embedded, file, {}, execution, images);
    return impostor;
}

void add_sway(Impostor& impostor, const Wind& wind) {
    Mesh& cards = impostor.cards;
    cards.sway.assign(cards.positions.size(), {});
    const float top = impostor.box.max.y;
    if (!(wind.sway > 0.0) || !(top > 0.0F)) return;
    for (std::size_t i = 0; i < cards.sway.size(); ++i) {
        const double along = static_cast<double>(cards.positions[i].y / top);
        cards.sway[i].bend = static_cast<float>(std::min(deflection(along), 1.0));
    }
}

std::size_t add_material(GlbScene& scene, const Impostor& impostor, const std::string& name) {
    scene.materials.push_back(impostor.material);
    scene.materials.back().name = name + "_impostor";
    return scene.materials.size() - 1;
}

void add_impostor_level(std::vector<Level>& levels, std::vector<double>& errors, const Bounds& box,
                        TextureSize texture_size) {
    levels.push_back({impostor_lod, card_vertices, card_triangles, 0.0});
    const glm::dvec3 size = glm::dvec3(box.max) - glm::dvec3(box.min);
    const double texel = std::sqrt(glm::dot(size, size)) / frame_side_of(texture_size);
    const double error = card_error() * 0.5 * std::max(size.x, size.z) + texel;
    errors.push_back(errors.empty() ? error : std::max(error, errors.back()));
}

void add_impostor(Estimate& sum, TextureSize texture_size, const FileOptions& file) {
    const auto side = static_cast<std::uint64_t>(atlas_side(frame_side_of(texture_size)));
    sum.impostor_texels += 3 * side * side;
    add_level(sum, card_vertices, card_triangles, Textures::embedded, file);
    const auto used = static_cast<std::uint64_t>(frame_grid * frame_side_of(texture_size));
    const std::uint64_t webp = used * used * 9 / 20, jpg = used * used * 3;
    switch (file.image_format) {
        case ImageFormats::jpg:
            sum.bytes += jpg;
            return;
        case ImageFormats::webp:
            sum.bytes += webp;
            return;
        case ImageFormats::webp_jpg:
            sum.bytes += webp + jpg;
            return;
    }
}

}  // namespace sporeprint
