#include <utility>

#include "api/http/conditions.h"
#include "api/http/encoding.h"
#include "api/products/endpoints.h"
#include "api/products/mix.h"
#include "core/params/messages.h"

namespace sporeprint::api {

namespace {

/// What only delivered_surface() reads of a job's shared answer: the digest of an image set. Never sent.
constexpr const char* digest_header = ":digest";

/// What every answer about an image carries; the tag is that of what is painted.
Response image_head(const ResponseBuilder& responses, const ImageResource& image,
                    std::string_view digest) {
    Response head;
    head.headers = {
        {"Content-Type", "image/jpeg"},
        {"ETag", '"' + std::string(digest) + '-' + name(image.kind) + '"'},
        {"Cache-Control", cache_control(image.requested_version.has_value())},
        {"Content-Location", responses.link(with_version(image.address, image.version))},
        {"Content-Disposition",
         "inline; filename=\"" + image.of + '-' + name(image.kind) + ".jpg\""}};
    return head;
}

std::uint64_t texels_held(const PaintSpec& paint_spec) {
    const auto side = static_cast<std::uint64_t>(side_of(paint_spec));
    return 3 * side * side * static_cast<std::uint64_t>(atlases_held(paint_spec));
}

/// What is painted at an address; adds to `faults` what of it is impossible.
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
        // Its images are those of each species alone, too.
        missing.cost = cost_of_search(requested.mix, *context.atlas);
        if (requested.mix.size() > 1) missing.cost.outlines *= 2;
        throw;
    }
    return {};
}

}  // namespace

Plan plan_image(Context& context, const Request& request, const ImageResource& image,
                const std::function<PaintWork(ValidationErrors&)>& decide,
                ValidationErrors& errors) {
    const ResponseBuilder& responses = context.responses;
    Store& store = context.store;
    PaintWork work = decide(errors);
    if (image.requested_version && *image.requested_version != image.version) {
        errors.add(410, "v",
                   in_quotes(*image.requested_version) + " is no longer made; today's version is " +
                       in_quotes(image.version));
        Value::Object more;
        if (errors.status() == 410)
            more.emplace_back("canonical",
                              responses.link(with_version(image.address, image.version)));
        return responses.problem(request, errors.status(), {}, errors.problems(), more);
    }
    if (!errors.empty()) return responses.problem(request, errors);

    const std::string digest = digest_of(work.key);
    Response head = image_head(responses, image, digest);
    const Conditions conditions(request);
    const std::vector<std::string> etags{std::string(header_of(head, "ETag"))};
    if (conditions.match_fails(etags))
        return responses.precondition_failed(request, "If-Match", etags);
    if (conditions.none_match_any() || conditions.unchanged(etags)) {
        set_header(head, "Cache-Status", "sporeprint-images; hit; detail=not-modified");
        return responses.not_modified(request, std::move(head), etags.front());
    }
    if (const std::optional<Painted> cached = store.images.cache().find(work.key)) {
        ++store.counters.image_hits;
        head.body = {std::get<Images>(*cached)->files[static_cast<std::size_t>(image.kind)]};
        set_header(head, "Cache-Status", "sporeprint-images; hit");
        head.cacheable = true;
        responses.represent(request, head);
        responses.select_range(request, head);
        return head;
    }
    if (request.method == "HEAD") {
        head.has_body = false;
        set_header(head, "Cache-Status", "sporeprint-images; fwd=miss");
        set_header(head, "Accept-Ranges", "bytes");
        responses.add_common_headers(request, head);
        return head;
    }
    // One flight for the three images of an atlas: its answer holds them all, delivered_image() hands out the one asked for.
    auto run = [&store, paint = std::move(work.paint), digest](
                   std::stop_token stop, const Observer& observer, const Parallel& parallel) {
        observer(Step::paint);
        JobContext job_context(store, std::move(stop), observer, parallel);
        const Images set = paint(job_context.execution());
        Response response;
        response.headers = {{digest_header, digest}, {"Cache-Status", job_context.cache_status()}};
        response.body.assign(set->files.begin(), set->files.end());
        return response;
    };
    return Job{std::move(work.key), work.cost, std::move(run)};
}

ImageResource image_of(const Context& context, const SurfaceRequest& requested) {
    return {*requested.kind, version_token(requested.mix, *context.atlas),
            canonical_address(requested.mix, *requested.kind, requested.address),
            requested.mix.front().id + '-' + std::to_string(requested.address.seed),
            requested.version};
}

Plan plan_surface(Context& context, const Request& request, const SurfaceRequest& requested,
                  ValidationErrors& errors) {
    if (!errors.empty()) return context.responses.problem(request, errors);
    const auto decide = [&](ValidationErrors& found) {
        const auto paint_spec =
            std::make_shared<const PaintSpec>(painted(context, requested, found));
        if (paint_spec->empty()) return PaintWork{};
        const Cost cost{.base = 300,
                        .atlases = static_cast<std::uint64_t>(atlases_held(*paint_spec)),
                        .texels = texels_held(*paint_spec)};
        return PaintWork{image_key(*paint_spec), cost,
                         [paint_spec](const ExecutionContext& execution) {
                             return painted_images(*paint_spec, execution);
                         }};
    };
    return plan_image(context, request, image_of(context, requested), decide, errors);
}

Response delivered_image(const ResponseBuilder& responses, const ImageResource& image,
                         Response shared) {
    Response response = image_head(responses, image, take_header(shared, digest_header));
    response.body = {shared.body[static_cast<std::size_t>(image.kind)]};
    return response;
}

}  // namespace sporeprint::api
