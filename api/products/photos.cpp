#include "api/products/photos.h"

#include <memory>
#include <mutex>
#include <utility>

#include "api/http/schemas.h"
#include "api/products/context.h"
#include "core/params/messages.h"
#include "core/surface/codecs.h"
#include "core/trace/photo_file.h"

namespace sporeprint::api {

namespace {

/// JPEG quality of stored photographs: what is lost is less than the noise of a sensor.
constexpr int quality = 92;

/// Returns the cost of decoding a file and of encoding what is stored: of a JPEG file of 12 million pixels 85 ms,
/// of a PNG file of 25 million with alpha 900 ms.
Cost cost_of_photo(std::span<const std::uint8_t> file) {
    const std::uint64_t pixels = std::min(declared_photo_pixels(file), most_photo_pixels);
    const bool is_jpeg = file.size() > 1 && file[0] == 0xFF && file[1] == 0xD8;
    return {.base = 15'000 + (is_jpeg ? pixels / 150 : pixels / 28)};
}

Plan plan_upload(RouteCall& call) {
    refuse_query(call.target, call.errors);
    Context& context = call.context;
    if (!call.errors.empty()) return context.responses.problem(call.request, call.errors);
    const std::string& body = call.request.body;
    if (body.empty())
        return context.responses.problem(call.request, 400,
                                         "the body is empty; send a JPEG, PNG or WebP file");
    const std::uint64_t number = context.store.photographs++;
    const Cost cost =
        cost_of_photo({reinterpret_cast<const std::uint8_t*>(body.data()), body.size()});
    auto run = [number, file = std::make_shared<const Bytes>(body.begin(), body.end()),
                &store = context.store, &responses = context.responses](
                   const std::stop_token& stop, const Observer& observer, const Parallel&) {
        observer(Step::resolve);
        trace::PhotoFile photo;
        {
            const std::unique_lock turn(store.decoders[number % store.decoders.size()]);
            photo = trace::decoded_photo(*file, "");
        }
        if (stop.stop_requested()) throw Cancelled();
        observer(Step::pack);
        StoredPhoto stored{
            Slice(std::make_shared<const Bytes>(jpeg(photo.picture.rgb, photo.picture.width,
                                                     photo.picture.height, quality, Chroma::full))),
            photo.picture.width, photo.picture.height, std::nullopt};
        if (photo.cut_out) {
            const trace::PictureSize size =
                trace::reduced_size(photo.picture.width, photo.picture.height, trace::large_side);
            stored.cut_out = trace::resized(*photo.cut_out, size.width, size.height);
        }
        const bool has_alpha = stored.cut_out.has_value();
        const std::string name =
            store.photos.insert(std::move(stored), std::chrono::steady_clock::now());
        Value about = Value::object();
        about.set("photo", name);
        about.set("width", photo.picture.width).set("height", photo.picture.height);
        about.set("alpha", has_alpha);
        about.set("expires_s", Photos::lifetime.count());
        Response response = private_json(about, 201);
        set_header(response, "Location", responses.link("/v1/photos/" + name + ".jpg"));
        return response;
    };
    // Each upload is a piece of work of its own: two clients never share the name of a photograph.
    return Job{"photo " + std::to_string(number), cost, std::move(run)};
}

Response gone(const RouteCall& call) {
    return call.context.responses.problem(call.request, 404, photo_is_gone);
}

Plan plan_download(RouteCall& call) {
    refuse_query(call.target, call.errors);
    const ResponseBuilder& responses = call.context.responses;
    if (!call.errors.empty()) return responses.problem(call.request, call.errors);
    const auto photo =
        call.context.store.photos.find(call.captured[0], std::chrono::steady_clock::now());
    if (!photo) return gone(call);
    Response response;
    response.headers = {{"Content-Type", "image/jpeg"}, {"Cache-Control", private_to_client}};
    response.body = {photo->jpeg};
    responses.add_common_headers(call.request, response);
    return response;
}

Plan plan_removal(RouteCall& call) {
    refuse_query(call.target, call.errors);
    const ResponseBuilder& responses = call.context.responses;
    if (!call.errors.empty()) return responses.problem(call.request, call.errors);
    if (!call.context.store.photos.erase(call.captured[0], std::chrono::steady_clock::now()))
        return gone(call);
    Response response = no_content();
    responses.add_common_headers(call.request, response);
    return response;
}

constexpr Route routes[] = {
    {.kind = RouteKind::upload,
     .method = "POST",
     .pattern = "/v1/photos",
     .id = "post_photo",
     .summary = "Stores a photograph in memory for half an hour, upright, without metadata and at "
                "most 2048 pixels long, so that it can be traced.",
     .media_type = "application/json",
     .body_type = "image/jpeg, image/png, image/webp",
     .success = 201,
     .most_body = most_photo_bytes,
     .response_schema = "photo",
     .plan = plan_upload},
    {.kind = RouteKind::upload,
     .method = "GET",
     .pattern = photo_pattern,
     .id = "get_photo",
     .summary = "A stored photograph. Whoever knows its name may see it.",
     .media_type = "image/jpeg",
     .plan = plan_download},
    {.kind = RouteKind::upload,
     .method = "DELETE",
     .pattern = photo_pattern,
     .id = "delete_photo",
     .summary = "Forgets a photograph.",
     .media_type = "",
     .success = 204,
     .plan = plan_removal},
};

void add_schemas(Value& schemas, const Atlas&) {
    const auto described = [](const char* type, const char* description) {
        return object({{"type", type}, {"description", description}});
    };
    schemas.set("photo",
                objects({{"photo", described("string", "The secret name of the photograph.")},
                         {"width", described("integer", "Of the stored photograph, pixels.")},
                         {"height", described("integer", "Of the stored photograph, pixels.")},
                         {"alpha", described("boolean",
                                             "Whether the picture is cut out already: between 2 "
                                             "and 98 % of it are transparent.")},
                         {"expires_s", described("integer", "Seconds until it is forgotten.")}}));
}

}  // namespace

const RouteGroup photo_routes = {
    .tag = "photos",
    .description = "Photographs to be traced: in memory, for half an hour.",
    .routes = routes,
    .add_links = nullptr,
    .add_schemas = add_schemas,
    .add_bodies = nullptr};

}  // namespace sporeprint::api
