#include "api/surfaces.h"

#include <cmath>

#include "api/mix.h"
#include "core/params/messages.h"
#include "core/params/query.h"

namespace sporeprint::api {

static_assert(well_described<PaintedWeathering<Maybe>>());
static_assert(well_described<PaintedAmounts>());
static_assert(well_described<SurfaceAddress>());

double quantised_age(double age) { return std::floor(age * 64.0 + 0.5) / 64.0; }

SurfaceAddress surface_address(const MushroomOrder& order) {
    const MushroomParams& params = order.params;
    SurfaceAddress address;
    address.seed = params.seed;
    address.age = params.age;
    address.size = quantised_length(params.size);
    address.variation = params.variation;
    address.texture_size = {params.texture_size >> params.lod};
    address.lod = params.lod;
    address.ornaments = {params.ornaments.warts, params.ornaments.scales};
    address.hymenium = params.hymenium;
    address.weathering = painted_of(params.weathering);
    return address;
}

PaintRecipe painted_at(const SurfaceAddress& address, const Mix& mix, const Atlas& atlas,
                       const Memo& memo) {
    MushroomOrder order;
    order.mix = mix;
    order.params.seed = address.seed;
    order.params.age = address.age;
    order.params.size = length_of_step(address.size);
    order.params.variation = address.variation;
    order.params.lod = address.lod;
    order.params.ornaments.warts = address.ornaments.warts;
    order.params.ornaments.scales = address.ornaments.scales;
    order.params.hymenium = address.hymenium;
    order.params.weathering = as_weathering(address.weathering);
    PaintRecipe recipe = paint_recipe(order, atlas, memo);
    for (PaintShare& share : recipe) share.painting.side = address.texture_size;
    return recipe;
}

SurfaceRequest read_surface(std::string_view mix, std::string_view image, Query query,
                            const Atlas& atlas, Faults& faults) {
    SurfaceRequest request;
    request.mix = surface_mix(read_mix(mix, atlas, faults));
    request.kind = read_image(image, faults);
    std::vector<std::pair<std::string, std::string>> rest;
    request.version = take_version(query, rest, faults);
    std::vector<Problem> problems;
    read_query(rest, request.address, problems);
    faults.add(400, problems);
    request.address.age = quantised_age(request.address.age);
    request.address.variation += 0.0;  // -0 is 0
    return request;
}

std::string canonical_address(const Mix& mix, ImageKind kind, const SurfaceAddress& address) {
    return with_query("/v1/surfaces/mushrooms/" + mix_text(mix) + '/' + name(kind) + ".jpg",
                      query_text(address));
}

}  // namespace sporeprint::api
