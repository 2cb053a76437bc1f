#include "api/products/pictures.h"

#include <array>
#include <string_view>
#include <utility>

#include "core/params/query.h"
#include "core/params/schema.h"
#include "core/params/shared_params.h"

namespace sporeprint::api {

static_assert(well_described<PictureParams>());

namespace {

/// The parameter of a file of which one value changes its picture.
constexpr std::string_view materials = "materials";

/// Calls `visit` with the name of each parameter that changes a file, but no picture of it.
template <class Visit>
void each_file_parameter(Visit visit) {
    FileOptions::fields([&](auto, const Info& info) {
        if (info.name != materials) visit(std::string_view(info.name));
    });
    for (const std::string_view name : {"animation", "frames", "targets", "instancing", "variants"})
        visit(name);
}

}  // namespace

PictureQuery read_picture_query(Query query, ValidationErrors& errors) {
    PictureQuery parts;
    for (const auto& pair : query) {
        bool is_of_picture = false, is_of_file = false;
        PictureParams::fields([&](auto, const Info& info) {
            is_of_picture = is_of_picture || pair.first == info.name;
        });
        each_file_parameter(
            [&](std::string_view name) { is_of_file = is_of_file || pair.first == name; });
        if (pair.first == materials && pair.second == name(MaterialSet::core))
            errors.add(400, pair.first,
                       "'core' is of a file and changes no picture; ask for rich or full");
        else if (is_of_file)
            errors.add(400, pair.first, "is of a file and changes no picture; leave it out");
        else
            (is_of_picture ? parts.picture : parts.product).push_back(pair);
    }
    return parts;
}

PictureParams read_picture(const PictureQuery& query, ValidationErrors& errors) {
    PictureParams params;
    std::vector<Problem> problems;
    read_query(query.picture, params, problems);
    add_problems(problems, params, "", false, errors);
    without_negative_zero(params);
    return params;
}

Value picture_schema(Value product) {
    Value& properties = *product.find("properties");
    each_file_parameter([&](std::string_view name) { properties.erase(std::string(name)); });
    if (Value* const set = properties.find(std::string(materials))) {
        Value values = Value::array();
        for (const MaterialSet shown : {MaterialSet::rich, MaterialSet::full})
            values.push(Value(name(shown)));
        set->erase("x-default-from");
        set->set("enum", std::move(values)).set("default", name(MaterialSet::full));
    }
    // Without a profile the default of the level of detail is that of core.
    Value& lod = *properties.find("lod");
    lod.erase("x-default-from");
    lod.set("default", 0).set("maximum", last_lod);
    Value picture = schema<PictureParams>();
    for (auto& [name, property] : picture.find("properties")->members())
        properties.set(name, property);
    return product;
}

Cost cost_of_drawing(const PictureParams& picture, std::uint64_t triangles) {
    constexpr std::uint64_t samples_of_pixel = 4;
    const bool is_sheet = picture.view == View::turntable;
    const std::uint64_t views = is_sheet ? turntable_columns * turntable_rows : 1;
    const std::uint64_t samples = static_cast<std::uint64_t>(picture.width) *
                                  static_cast<std::uint64_t>(picture.height) * samples_of_pixel;
    return {.base = 1700 * views,
            .shadow_triangles = triangles * views * (1 + pictured_lights(picture, triangles)),
            // What is seen from all sides fills less of each view.
            .samples = is_sheet ? samples * views / 2 : samples};
}

void refuse_over_triangles(std::uint64_t triangles) {
    if (triangles > most_pictured_triangles)
        throw Impossible("/lod", "about " + std::to_string(triangles) +
                                     " triangles would be drawn; at most " +
                                     std::to_string(most_pictured_triangles) + " are. Raise lod");
}

}  // namespace sporeprint::api
