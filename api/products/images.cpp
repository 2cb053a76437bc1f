#include "api/products/images.h"

#include <utility>

#include "api/http/conditions.h"
#include "api/http/encoding.h"
#include "api/products/product.h"
#include "core/params/messages.h"

namespace sporeprint::api {

namespace {

/// A header of a job's shared response that is never sent: the digest of the image set.
constexpr const char* digest_header = ":digest";

/// Returns the headers of every response about an image. Its ETag is computed from `digest`.
Response image_head(const ResponseBuilder& responses, const ImageResource& image,
                    std::string_view digest) {
    Response head;
    head.headers = {
        {"Content-Type", media_type(image.format)},
        {"ETag", '"' + std::string(digest) + '-' + name(image.kind) + '"'},
        {"Cache-Control", cache_control(image.requested_version.has_value())},
        {"Content-Location", responses.link(with_version(image.address, image.version))},
        {"Content-Disposition", "inline; filename=\"" + image.of + '-' +
                                    std::string(digest.substr(0, 8)) + '-' +
                                    file_of(image.kind, image.format) + '"'}};
    return head;
}

}  // namespace

Plan plan_image(Context& context, const Request& request, const ImageResource& image,
                const std::function<PaintWork(ValidationErrors&)>& decide,
                ValidationErrors& errors) {
    const ResponseBuilder& responses = context.responses;
    Store& store = context.store;
    PaintWork work = decide(errors);
    if (image.requested_version && *image.requested_version != image.version)
        return superseded(responses, request, "v", *image.requested_version, image.version,
                          with_version(image.address, image.version), errors);
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
    // One job makes the three images of a set; each client is sent the one that it requested.
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
    auto deliver = [&responses, image](Response& shared) {
        Response response = image_head(responses, image, take_header(shared, digest_header));
        response.body = {shared.body[static_cast<std::size_t>(image.kind)]};
        shared = std::move(response);
    };
    return Job{.key = std::move(work.key),
               .cost = work.cost,
               .run = std::move(run),
               .delivery = std::move(deliver)};
}

}  // namespace sporeprint::api
