#include "core/grow/product.h"

#include <utility>

#include "core/params/problems.h"

namespace sporeprint {

namespace {

Value corner(const glm::vec3& p) {
    // As the float's own shortest text would read: widened, then cut to what a float holds.
    Value list = Value::array();
    for (const float x : {p.x, p.y, p.z}) list.push(Value(static_cast<double>(x)));
    return list;
}

}  // namespace

std::uint64_t estimated_bytes(std::uint64_t vertices, std::uint64_t triangles, Textures textures,
                              std::uint64_t image_bytes) {
    return 2500 + vertices * (textures != Textures::none ? 44 : 24) +
           triangles * 3 * (vertices > 65535 ? 4 : 2) +
           (textures == Textures::embedded ? image_bytes : 0);
}

std::string extras_json(const Extras& extras, Value effective, const Mesh& mesh) {
    Value json = Value::object();
    json.set("canonical", Value(extras.canonical));
    json.set("effective", std::move(effective));
    const Bounds box = bounds(mesh);
    Value limits = Value::object();
    limits.set("min", corner(box.min));
    limits.set("max", corner(box.max));
    json.set("bounds_m", std::move(limits));
    json.set("triangles", Value(mesh.triangles()));
    return dump(json);
}

std::shared_ptr<const ImageSet> wear_images(
    GlbParts& parts, Textures textures, const Extras& extras, const Workshop& workshop,
    const std::function<std::shared_ptr<const ImageSet>()>& paint) {
    std::shared_ptr<const ImageSet> images;
    if (textures == Textures::embedded) {
        workshop.observer(Step::paint);
        images = paint();
        parts.images = images.get();
        stop_if_asked(workshop);
    } else if (textures == Textures::linked) {
        if (extras.image_addresses[0].empty())
            throw Impossible(
                "/textures",
                "'linked' needs the images to have addresses; a model of one's own has none");
        parts.image_addresses = extras.image_addresses;
    }
    return images;
}

}  // namespace sporeprint
