#include "core/grow/product.h"

#include <utility>

#include "core/problems.h"

namespace sporeprint {

namespace {

Value corner(const glm::vec3& p) {
    // The value is the float widened to double, so that its text is that of the float's exact
    // value.
    Value list = Value::array();
    for (const float x : {p.x, p.y, p.z}) list.push(Value(static_cast<double>(x)));
    return list;
}

GlbSway place_of(WindFormat wind) {
    switch (wind) {
        case WindFormat::uv:
            return GlbSway::texture_coordinates;
        case WindFormat::color:
            return GlbSway::color;
        case WindFormat::none:
        case WindFormat::attribute:
            break;
    }
    return GlbSway::attribute;
}

GlbGeometry storage_of(Compression compress) {
    switch (compress) {
        case Compression::none:
            return GlbGeometry::floats;
        case Compression::quantize:
            return GlbGeometry::quantized;
        case Compression::meshopt:
            return GlbGeometry::compressed;
    }
    return GlbGeometry::floats;
}

}  // namespace

void set_options(GlbScene& scene, const FileOptions& file) {
    scene.geometry = storage_of(file.compress);
    scene.material_extensions = file.materials != MaterialSet::core;
    scene.sway = place_of(file.wind);
}

void refuse_impossible(const FileOptions& file, Textures textures) {
    if (file.collision == CollisionFormat::omi && file.compress != Compression::none)
        throw Impossible("/collision",
                         "'omi' needs geometry as floats, because a physics shape has no scale; "
                         "ask for compress=none, or for collision=nodes");
    if (file.wind == WindFormat::uv && textures == Textures::none)
        throw Impossible("/wind",
                         "'uv' needs a file with texture coordinates of its images; ask for "
                         "textures other than none, or for wind=attribute");
}

namespace {

/// Returns the approximate size of images.
///
/// jpg  the size of the same images as JPEG
std::uint64_t bytes_of_images(std::uint64_t jpg, ImageFormats formats) {
    const std::uint64_t webp = jpg / 3;
    switch (formats) {
        case ImageFormats::jpg:
            break;
        case ImageFormats::webp:
            return webp;
        case ImageFormats::webp_jpg:
            return webp + jpg;
    }
    return jpg;
}

/// Returns the size of the sway of a vertex.
std::uint64_t bytes_of_sway(WindFormat wind) {
    switch (wind) {
        case WindFormat::none:
            return 0;
        case WindFormat::uv:
            return 8;
        case WindFormat::attribute:
        case WindFormat::color:
            break;
    }
    return 4;
}

/// Returns the approximate size of a file with a mesh and no images.
std::uint64_t bytes_of_mesh(std::uint64_t vertices, std::uint64_t triangles, bool textured,
                            const FileOptions& file) {
    const std::uint64_t index_size = vertices > 65535 ? 4 : 2;
    const std::uint64_t sway = bytes_of_sway(file.wind);
    switch (file.compress) {
        case Compression::none:
            break;
        case Compression::quantize:
            return 2700 + vertices * ((textured ? 24 : 16) + sway) + triangles * 3 * index_size;
        case Compression::meshopt:
            // Measured: up to 15 bytes of a vertex and 1.5 of a triangle.
            return 3500 + vertices * ((textured ? 15 : 11) + sway) + triangles * 3 / 2;
    }
    return 2500 + vertices * ((textured ? 44 : 24) + sway) + triangles * 3 * index_size;
}

}  // namespace

void add_image_bytes(Estimate& sum, std::uint64_t jpg, Textures textures, const FileOptions& file) {
    if (textures == Textures::embedded) sum.bytes += bytes_of_images(jpg, file.image_format);
}

void add_solid_bytes(Estimate& sum, std::uint64_t individuals, std::uint64_t capsules,
                     const FileOptions& file) {
    switch (file.collision) {
        case CollisionFormat::none:
            return;
        case CollisionFormat::nodes:
            sum.bytes += 11'000 * individuals + 3'000 * capsules;
            return;
        case CollisionFormat::omi:
            sum.bytes += 11'000 * individuals + 450 * capsules;
            return;
    }
}

void add_level(Estimate& sum, std::uint64_t vertices, std::uint64_t triangles, Textures textures,
               const FileOptions& file) {
    sum.vertices += vertices;
    sum.triangles += triangles;
    sum.bytes += bytes_of_mesh(vertices, triangles, textures != Textures::none, file);
}

std::uint64_t bytes_of_instance(const FileOptions& file) {
    return file.compress == Compression::meshopt ? 18 : 40;
}

Value bounds_value(const Bounds& box) {
    return Value::object().set("min", corner(box.min)).set("max", corner(box.max));
}

Value extras_value(const Extras& extras, Value effective, const Bounds& box, std::size_t triangles,
                   const FileLevels& levels, const Wind& wind) {
    Value json = Value::object();
    json.set("canonical", Value(extras.canonical));
    json.set("effective", std::move(effective));
    json.set("bounds_m", bounds_value(box));
    json.set("triangles", Value(triangles));
    if (levels.lods != Lods::single) json.set("levels", level_list(levels.list));
    if (wind.format != WindFormat::none) json.set("wind", wind_value(wind));
    return json;
}

std::string key_of_format(ImageFormat format) {
    return format == ImageFormat::jpg ? std::string() : std::string(name(format)) + ' ';
}

EmbeddedImages attach_images(
    GlbMaterial& material, Textures textures, const FileOptions& file, const ImageUrls& urls,
    const ExecutionContext& execution,
    const std::function<std::shared_ptr<const ImageSet>(ImageFormat)>& paint) {
    const bool is_webp = file.image_format != ImageFormats::jpg,
               falls_back = file.image_format == ImageFormats::webp_jpg;
    EmbeddedImages images;
    if (textures == Textures::embedded) {
        execution.observer(Step::paint);
        images.files = paint(is_webp ? ImageFormat::webp : ImageFormat::jpg);
        if (falls_back) images.fallback = paint(ImageFormat::jpg);
        material.images = images.files.get();
        material.fallback = images.fallback.get();
        throw_if_cancelled(execution);
    } else if (has_addresses(textures)) {
        if (urls.jpg[0].empty())
            throw Impossible("/textures", in_quotes(name(textures)) +
                                              " needs the images to have addresses; a model of "
                                              "one's own has none");
        material.is_external = textures == Textures::external;
        material.image_urls = is_webp ? urls.webp : urls.jpg;
        material.url_format = is_webp ? ImageFormat::webp : ImageFormat::jpg;
        if (falls_back) material.fallback_urls = urls.jpg;
    }
    return images;
}

}  // namespace sporeprint
