#include "core/gltf/materials.h"

#include <algorithm>
#include <optional>

#include "core/gltf/json_text.h"

namespace sporeprint::gltf {

namespace {

constexpr const char* texture_webp = "EXT_texture_webp";

/// Returns the number of images: three, or that of the base colour.
std::size_t count_of(const ImageSet* files) { return files && files->files[1].size == 0 ? 1 : 3; }

}  // namespace

bool has_base_colour_alone(const GlbMaterial& material) {
    return material.images && count_of(material.images) == 1;
}

std::size_t TextureTables::add_images(const std::string& name, const ImageSet* files,
                                      const std::array<std::string, 3>& urls, Tables& tables) {
    const std::size_t count = count_of(files);
    for (std::size_t i = 0; i < count; ++i) {
        append_quoted((images += separator(images)) += "{\"name\":",
                      name + '_' + sporeprint::name(static_cast<ImageKind>(i)));
        if (files) {
            add_file(files->files[i], media_type(files->format_of(static_cast<ImageKind>(i))),
                     tables);
        } else {
            append_quoted(images += ",\"uri\":", urls[i]);
        }
        images += '}';
    }
    image_count_ += count;
    return image_count_ - count;
}

void TextureTables::add_file(const Slice& file, const char* type, Tables& tables) {
    ((images += ",\"mimeType\":\"") += type) += "\",\"bufferView\":";
    append(images, tables.view(file.size));
    image_files.push_back(file);
}

std::size_t TextureTables::textures_of(const GlbMaterial& material, Tables& tables,
                                       Extensions& used) {
    for (const Source& source : sources_)
        if (source.material->images == material.images &&
            source.material->image_urls == material.image_urls &&
            source.material->repeats_u == material.repeats_u)
            return source.first;
    const std::size_t sampler =
        sampler_of(material.repeats_u ? Sampling::repeated : Sampling::clamped);
    const std::size_t first = texture_count_;
    sources_.push_back({&material, first});
    const std::size_t count = count_of(material.images);
    texture_count_ += count;
    const bool is_webp = (material.images ? material.images->format : material.url_format) ==
                         ImageFormat::webp,
               falls_back = material.fallback || !material.fallback_urls[0].empty();
    const std::size_t source =
        add_images(material.name, material.images, material.image_urls, tables);
    const std::size_t fallback =
        falls_back ? add_images(material.name, material.fallback, material.fallback_urls, tables)
                   : source;
    if (is_webp && falls_back) used.use(texture_webp);
    if (is_webp && !falls_back) used.require(texture_webp);
    for (std::size_t i = 0; i < count; ++i) {
        append((textures += separator(textures)) += "{\"sampler\":", sampler);
        if (falls_back || !is_webp) append(textures += ",\"source\":", fallback + i);
        if (is_webp) {
            ((textures += ",\"extensions\":{\"") += texture_webp) += "\":{\"source\":";
            append(textures, source + i);
            textures += "}}";
        }
        textures += '}';
    }
    return first;
}

std::size_t TextureTables::texture_of_png(const std::string& name, const Slice& png,
                                          Sampling sampling, Tables& tables) {
    for (const PngTexture& earlier : pngs_)
        if (earlier.file.data() == png.data()) return earlier.texture;
    append_quoted((images += separator(images)) += "{\"name\":", name);
    add_file(png, "image/png", tables);
    images += '}';
    append((textures += separator(textures)) += "{\"sampler\":", sampler_of(sampling));
    append(textures += ",\"source\":", image_count_++);
    textures += '}';
    pngs_.push_back({png, texture_count_});
    return texture_count_++;
}

std::size_t TextureTables::sampler_of(Sampling sampling) {
    const auto found = std::find(sampling_.begin(), sampling_.end(), sampling);
    if (found != sampling_.end()) return static_cast<std::size_t>(found - sampling_.begin());
    sampling_.push_back(sampling);
    (samplers += separator(samplers)) += sampling == Sampling::nearest
                                             ? "{\"magFilter\":9728,\"minFilter\":9728"
                                             : "{\"magFilter\":9729,\"minFilter\":9987";
    ((samplers += ",\"wrapS\":") += sampling == Sampling::repeated ? "10497" : "33071") +=
        ",\"wrapT\":33071}";
    return sampling_.size() - 1;
}

void Extensions::use(const std::string& name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
}

void Extensions::require(const std::string& name) {
    if (std::find(required.begin(), required.end(), name) == required.end())
        required.push_back(name);
    use(name);
}

namespace {

std::string list_of(const char* member, const std::vector<std::string>& names) {
    if (names.empty()) return {};
    std::string list;
    for (const std::string& name : names) append_quoted(list += separator(list), name);
    return member + list + "]";
}

}  // namespace

std::string Extensions::json() const {
    return list_of(",\"extensionsUsed\":[", names) + list_of(",\"extensionsRequired\":[", required);
}

namespace {

/// Returns the material members of optional extensions, with a leading comma.
///
/// textures  index of the first of its own; none for a material without images
/// extended  with extensions; otherwise only the emission of core glTF
std::string material_extensions_json(const GlbMaterial& material,
                                     std::optional<std::size_t> textures, bool extended,
                                     TextureTables& texture_tables, Tables& tables,
                                     Extensions& used) {
    const MaterialLook& look = material.look;
    const auto is_visible = [](const glm::dvec3& light) {
        return light.x > 0.0 || light.y > 0.0 || light.z > 0.0;
    };
    std::string extensions, emission;
    const auto extension = [&](const std::string& name, const std::string& members) {
        if (!extended) return;
        extensions += (extensions.empty() ? "\"" : ",\"") + name + "\":{" + members + "}";
        used.use(name);
    };
    const auto texture = [&](std::string& out, std::size_t which) {
        append(out += "{\"index\":", *textures + which);
        out += '}';
    };
    const auto texture_of_png = [&](std::string& out, const char* kind, const Slice& png,
                                    Sampling sampling) {
        const std::string name = material.name + '_' + kind;
        append(out += "{\"index\":", texture_tables.texture_of_png(name, png, sampling, tables));
        out += '}';
    };
    if (look.coat > 0.0) {
        std::string coat = "\"clearcoatFactor\":";
        append(coat, static_cast<float>(look.coat));
        // The coat's roughness is that of the skin, so that one material coats the cap alone:
        // smooth skin is glossy, and on matt skin the coat is invisible.
        if (textures)
            texture(coat += ",\"clearcoatRoughnessFactor\":1,\"clearcoatRoughnessTexture\":", 2);
        else
            coat += ",\"clearcoatRoughnessFactor\":0.25";
        if (extended && material.tile_looks.coat.size > 0)
            texture_of_png(coat += ",\"clearcoatTexture\":", "coat", material.tile_looks.coat,
                           Sampling::nearest);
        extension("KHR_materials_clearcoat", coat);
    }
    if (is_visible(look.glow)) {
        append_triple(emission += ",\"emissiveFactor\":", glm::vec3(look.glow));
        if (textures) texture(emission += ",\"emissiveTexture\":", 0);
        extension("KHR_materials_emissive_strength", "\"emissiveStrength\":4");
    }
    if (is_visible(look.sheen)) {
        std::string sheen = "\"sheenColorFactor\":";
        append_triple(sheen, glm::vec3(look.sheen));
        if (extended && material.tile_looks.sheen.size > 0)
            texture_of_png(sheen += ",\"sheenColorTexture\":", "sheen", material.tile_looks.sheen,
                           Sampling::nearest);
        extension("KHR_materials_sheen", sheen + ",\"sheenRoughnessFactor\":0.45");
    }
    const GlbTransmission& through = material.transmission;
    if (extended && through.factor > 0.0) {
        const double mean = textures ? 1.0 : through.mean;
        std::string members = "\"diffuseTransmissionFactor\":";
        append(members, static_cast<float>(through.factor * mean));
        if (textures && through.thinness.size > 0)
            texture_of_png(members += ",\"diffuseTransmissionTexture\":", "thinness",
                           through.thinness, Sampling::clamped);
        append_triple(members += ",\"diffuseTransmissionColorFactor\":", glm::vec3(through.tint));
        // Light that passes has crossed the skin too.
        if (textures) texture(members += ",\"diffuseTransmissionColorTexture\":", 0);
        extension("KHR_materials_diffuse_transmission", members);
    }
    if (extensions.empty()) return emission;
    return emission + ",\"extensions\":{" + extensions + "}";
}

/// Returns the extras with the addresses of images that readers do not load, with a leading comma;
/// empty for a material without them.
std::string external_images_json(const GlbMaterial& material) {
    if (!material.is_external) return {};
    std::string images;
    for (std::size_t i = 0; i < material.image_urls.size(); ++i) {
        append_quoted(images += separator(images), name(static_cast<ImageKind>(i)));
        append_quoted(images += ':', material.image_urls[i]);
    }
    return ",\"extras\":{\"images\":{" + images + "}}";
}

}  // namespace

bool is_textured(const GlbMaterial& material) {
    return material.images != nullptr || !material.image_urls[0].empty();
}

namespace {

/// Appends what says which texels are not drawn.
void append_cutoff(std::string& json, const GlbMaterial& material) {
    if (material.alpha_cutoff > 0.0)
        append(json += ",\"alphaMode\":\"MASK\",\"alphaCutoff\":",
               static_cast<float>(material.alpha_cutoff));
}

}  // namespace

std::string material_json(const GlbMaterial& material, bool extended, TextureTables& texture_tables,
                          Tables& tables, Extensions& used) {
    std::string json = "{\"name\":";
    append_quoted(json, material.name);
    if (!is_textured(material) || material.is_external) {
        json += ",\"pbrMetallicRoughness\":{\"metallicFactor\":0}";
        if (material.is_external) append_cutoff(json, material);
        return json +
               material_extensions_json(material, std::nullopt, extended, texture_tables, tables,
                                        used) +
               external_images_json(material) + "}";
    }
    const std::size_t first = texture_tables.textures_of(material, tables, used);
    append(json += ",\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":", first);
    if (has_base_colour_alone(material)) return json + "},\"metallicFactor\":0}}";
    append(json += "},\"metallicFactor\":0,\"metallicRoughnessTexture\":{\"index\":", first + 2);
    append(json += "}},\"normalTexture\":{\"index\":", first + 1);
    append(json += "},\"occlusionTexture\":{\"index\":", first + 2);
    // What an impostor has in place of occlusion is for shaders alone.
    json += material.has_occlusion ? "}" : ",\"strength\":0}";
    append_cutoff(json, material);
    if (!material.extras_json.empty()) (json += ",\"extras\":") += material.extras_json;
    return json +
           material_extensions_json(material, first, extended, texture_tables, tables, used) + "}";
}

}  // namespace sporeprint::gltf
