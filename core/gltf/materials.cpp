#include "core/gltf/materials.h"

#include <algorithm>
#include <optional>

#include "core/gltf/json_text.h"

namespace sporeprint::gltf {

namespace {

constexpr const char* texture_webp = "EXT_texture_webp";

}  // namespace

std::size_t TextureTables::add_images(const std::string& name, const ImageSet* files,
                                      const std::array<std::string, 3>& urls, Tables& tables) {
    for (std::size_t i = 0; i < urls.size(); ++i) {
        append_quoted((images += separator(images)) += "{\"name\":",
                      name + '_' + sporeprint::name(static_cast<ImageKind>(i)));
        if (files) {
            ((images += ",\"mimeType\":\"") += media_type(files->format)) += "\",\"bufferView\":";
            append(images, tables.view(files->files[i].size));
        } else {
            append_quoted(images += ",\"uri\":", urls[i]);
        }
        images += '}';
    }
    image_count_ += urls.size();
    return image_count_ - urls.size();
}

std::size_t TextureTables::textures_of(const GlbMaterial& material, Tables& tables,
                                       Extensions& used) {
    for (std::size_t k = 0; k < sources.size(); ++k)
        if (sources[k]->images == material.images &&
            sources[k]->image_urls == material.image_urls &&
            sources[k]->repeats_u == material.repeats_u)
            return 3 * k;
    const std::size_t sampler = sampler_of(material.repeats_u);
    const std::size_t first = 3 * sources.size();
    sources.push_back(&material);
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
    for (std::size_t i = 0; i < 3; ++i) {
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

std::size_t TextureTables::sampler_of(bool repeats_u) {
    const auto found = std::find(sampler_repeats.begin(), sampler_repeats.end(), repeats_u);
    if (found != sampler_repeats.end())
        return static_cast<std::size_t>(found - sampler_repeats.begin());
    sampler_repeats.push_back(repeats_u);
    (samplers += separator(samplers)) += "{\"magFilter\":9729,\"minFilter\":9987,\"wrapS\":";
    (samplers += repeats_u ? "10497" : "33071") += ",\"wrapT\":33071}";
    return sampler_repeats.size() - 1;
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
std::string material_extensions_json(const MaterialLook& look, std::optional<std::size_t> textures,
                                     bool extended, Extensions& used) {
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
    if (look.coat > 0.0) {
        std::string coat = "\"clearcoatFactor\":";
        append(coat, static_cast<float>(look.coat));
        // The coat's roughness is that of the skin, so that one material coats the cap alone:
        // smooth skin is glossy, and on matt skin the coat is invisible.
        if (textures)
            texture(coat += ",\"clearcoatRoughnessFactor\":1,\"clearcoatRoughnessTexture\":", 2);
        else
            coat += ",\"clearcoatRoughnessFactor\":0.25";
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
        extension("KHR_materials_sheen", sheen + ",\"sheenRoughnessFactor\":0.45");
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

std::string material_json(const GlbMaterial& material, bool extended, TextureTables& texture_tables,
                          Tables& tables, Extensions& used) {
    std::string json = "{\"name\":";
    append_quoted(json, material.name);
    if (!is_textured(material) || material.is_external)
        return json + ",\"pbrMetallicRoughness\":{\"metallicFactor\":0}" +
               material_extensions_json(material.look, std::nullopt, extended, used) +
               external_images_json(material) + "}";
    const std::size_t first = texture_tables.textures_of(material, tables, used);
    append(json += ",\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":", first);
    append(json += "},\"metallicFactor\":0,\"metallicRoughnessTexture\":{\"index\":", first + 2);
    append(json += "}},\"normalTexture\":{\"index\":", first + 1);
    append(json += "},\"occlusionTexture\":{\"index\":", first + 2);
    return json + "}" + material_extensions_json(material.look, first, extended, used) + "}";
}

}  // namespace sporeprint::gltf
