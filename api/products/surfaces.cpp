#include "api/products/surfaces.h"

#include <cmath>

#include "api/products/mix.h"
#include "core/params/messages.h"
#include "core/params/query.h"

namespace sporeprint::api {

static_assert(well_described<PaintedWeathering<Maybe>>());
static_assert(well_described<PaintedAmounts>());
static_assert(well_described<SurfaceAddress>());

double quantised_age(double age) { return std::floor(age * 64.0 + 0.5) / 64.0; }

SurfaceAddress surface_address(const MushroomSpec& spec) {
    const MushroomParams& params = spec.params;
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

PaintSpec painted_at(const SurfaceAddress& address, const Mix& mix, const Atlas& atlas,
                     const Caches& caches) {
    MushroomSpec spec;
    spec.mix = mix;
    spec.params.seed = address.seed;
    spec.params.age = address.age;
    spec.params.size = length_of_step(address.size);
    spec.params.variation = address.variation;
    spec.params.lod = address.lod;
    spec.params.ornaments.warts = address.ornaments.warts;
    spec.params.ornaments.scales = address.ornaments.scales;
    spec.params.hymenium = address.hymenium;
    spec.params.weathering = as_weathering(address.weathering);
    PaintSpec paint_spec = paint_spec_of(spec, atlas, caches);
    for (PaintShare& share : paint_spec) share.painting.side = address.texture_size;
    return paint_spec;
}

SurfaceRequest read_surface(std::string_view mix, std::string_view image, Query query,
                            const Atlas& atlas, ValidationErrors& errors) {
    SurfaceRequest request;
    request.mix = surface_mix(read_mix(mix, atlas, errors));
    request.kind = read_image(image, errors);
    std::vector<std::pair<std::string, std::string>> rest;
    request.version = take_version(query, rest, errors);
    std::vector<Problem> problems;
    read_query(rest, request.address, problems);
    errors.add(400, problems);
    request.address.age = quantised_age(request.address.age);
    request.address.variation += 0.0;  // -0 is 0
    return request;
}

std::string canonical_address(const Mix& mix, ImageKind kind, const SurfaceAddress& address) {
    return with_query("/v1/surfaces/mushrooms/" + mix_text(mix) + '/' + name(kind) + ".jpg",
                      query_text(address));
}

}  // namespace sporeprint::api
