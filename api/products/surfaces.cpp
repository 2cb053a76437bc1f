#include "api/products/surfaces.h"

#include <cmath>
#include <utility>

#include "api/products/images.h"
#include "api/products/mix.h"
#include "api/products/mushrooms.h"
#include "api/products/resource.h"
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
    address.seeds = params.seeds;
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
    spec.params.seeds = address.seeds;
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
    MushroomParams params;
    params.seed = request.address.seed;
    params.seeds = request.address.seeds;
    params.drop_equal_seeds();
    request.address.seeds = params.seeds;
    request.address.age = quantised_age(request.address.age);
    request.address.variation += 0.0;  // -0 is 0
    return request;
}

std::string canonical_address(const char* product, const Mix& mix, ImageKind kind,
                              ImageFormat format, const SurfaceAddress& address) {
    return with_query(folder_of(product) + mix_text(mix) + '/' + file_of(kind, format),
                      query_text(address));
}

ImageUrls mushroom_image_urls(const char* product, const MushroomSpec& surface,
                              const SurfaceAddress& address, const Atlas& atlas) {
    const std::string version = version_token(surface.mix, atlas);
    return image_urls_of([&](ImageKind kind, ImageFormat format) {
        return with_version(canonical_address(product, surface.mix, kind, format, address),
                            version);
    });
}

namespace {

std::uint64_t texels_held(const PaintSpec& paint_spec) {
    const auto side = static_cast<std::uint64_t>(side_of(paint_spec));
    return 3 * side * side * static_cast<std::uint64_t>(atlases_held(paint_spec));
}

/// Returns the painting of a URL; adds what is impossible to `errors`.
PaintSpec painted(Context& context, const SurfaceRequest& requested, ValidationErrors& errors) {
    try {
        PaintSpec paint_spec =
            painted_at(requested.address, requested.mix, *context.atlas, context.caches);
        refuse_texels(context.options, texels_held(paint_spec), paint_spec.size() > 1, errors);
        return paint_spec;
    } catch (const Impossible& impossible) {
        errors.add(422, named(impossible, false));
    } catch (const InvalidInput& invalid) {
        errors.add(400, named(invalid, false));
    } catch (CacheMiss& missing) {
        // Painting a mix also needs each of its species alone.
        missing.cost = cost_of_search(requested.mix, *context.atlas);
        if (requested.mix.size() > 1) missing.cost.outlines *= 2;
        throw;
    }
    return {};
}

}  // namespace

Plan plan_mushroom_image(RouteCall& call, const char* product, ImageFormat format, Query query) {
    Context& context = call.context;
    ValidationErrors& errors = call.errors;
    const Request& request = call.request;
    const SurfaceRequest requested =
        read_surface(call.captured[0], call.captured[1], query, *context.atlas, errors);
    if (!errors.empty()) return context.responses.problem(request, errors);
    const auto decide = [&](ValidationErrors& found) {
        const auto paint_spec =
            std::make_shared<const PaintSpec>(painted(context, requested, found));
        if (paint_spec->empty()) return PaintWork{};
        Cost cost{.base = 300,
                  .atlases = static_cast<std::uint64_t>(atlases_held(*paint_spec)),
                  .texels = texels_held(*paint_spec)};
        if (format == ImageFormat::webp) {
            const auto side = static_cast<std::uint64_t>(side_of(*paint_spec));
            cost.webp_texels = 3 * side * side;
        }
        return PaintWork{image_key(*paint_spec, format), cost,
                         [paint_spec, format](const ExecutionContext& execution) {
                             return painted_images(*paint_spec, execution, format);
                         }};
    };
    const ImageResource image{
        *requested.kind,
        format,
        version_token(requested.mix, *context.atlas),
        canonical_address(product, requested.mix, *requested.kind, format, requested.address),
        requested.mix.front().id + '-' + std::to_string(requested.address.seed),
        requested.version};
    return plan_image(context, request, image, decide, errors);
}

}  // namespace sporeprint::api
