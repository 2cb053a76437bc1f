#include "api/products/product.h"

#include "api/http/encoding.h"
#include "core/impostor/frames.h"
#include "core/params/messages.h"
#include "core/params/reader.h"
#include "core/version.h"

namespace sporeprint::api {

const char* ending_of(Product product) {
    switch (product) {
        case Product::glb:
            return ".glb";
        case Product::json:
            return ".json";
        case Product::png:
            return ".png";
        case Product::bin:
            return ".bin";
    }
    return "";
}

const char* type_of(Product product) {
    switch (product) {
        case Product::glb:
            return "model/gltf-binary";
        case Product::json:
            return "application/json";
        case Product::png:
            return "image/png";
        case Product::bin:
            return "application/octet-stream";
    }
    return "";
}

std::optional<std::string> take_version(Query query,
                                        std::vector<std::pair<std::string, std::string>>& rest,
                                        ValidationErrors& errors) {
    std::optional<std::string> version;
    for (const auto& pair : query) {
        if (pair.first != "v")
            rest.push_back(pair);
        else if (version)
            errors.add(400, "v", "given more than once");
        else
            version = pair.second;
    }
    return version;
}

std::optional<std::string> take_version(Value& body, std::vector<Problem>& problems) {
    std::optional<std::string> version;
    if (const Value* given = body.find("v")) {
        if (given->is_string())
            version = given->as_string();
        else
            report(problems, "/v", "expected text, got " + shown(*given));
    }
    body.erase("v");
    return version;
}

namespace {

Profile profile_named(std::string_view text) {
    for (int i = 0; const char* one = name(static_cast<Profile>(i)); ++i)
        if (text == one) return static_cast<Profile>(i);
    return Profile::core;
}

}  // namespace

Profile requested_profile(Query query) {
    for (const auto& [key, value] : query)
        if (key == "profile") return profile_named(value);
    return Profile::core;
}

Profile requested_profile(const Value& body) {
    const Value* const given = body.find("profile");
    return given && given->is_string() ? profile_named(given->as_string()) : Profile::core;
}

NamedOptions named_options(Query query) {
    const auto names = [&](std::string_view option) {
        return std::any_of(query.begin(), query.end(),
                           [&](const auto& pair) { return pair.first == option; });
    };
    return {.collision = names("collision"), .wind = names("wind")};
}

NamedOptions named_options(const Value& body) {
    return {.collision = body.find("collision") != nullptr, .wind = body.find("wind") != nullptr};
}

std::optional<Value> read_body(std::string_view body, ValidationErrors& errors) {
    std::vector<Problem> problems;
    Value json = parse(body, problems);
    if (problems.empty() && !json.is_object())
        report(problems, "", "expected an object, got " + shown(json));
    errors.add(400, problems);
    if (!problems.empty()) return std::nullopt;
    return json;
}

std::string token_of(std::string_view templates) {
    return std::to_string(generator_version) + '-' + digest_of(templates).substr(0, 8);
}

std::string with_query(std::string path, const std::string& query) {
    return query.empty() ? path : std::move(path) + '?' + query;
}

std::string folder_of(std::string_view product) { return "/v1/" + std::string(product) + '/'; }

std::string with_version(std::string address, std::string_view version) {
    address += address.find('?') == std::string::npos ? '?' : '&';
    return (address += "v=") += version;
}

Response superseded(const ResponseBuilder& responses, const Request& request, const char* parameter,
                    const std::string& requested, const std::string& version,
                    const std::string& address, ValidationErrors& errors) {
    errors.add(
        410, parameter,
        in_quotes(requested) + " is no longer made; today's version is " + in_quotes(version));
    Value::Object more;
    if (errors.status() == 410 && !address.empty())
        more.emplace_back("canonical", responses.link(address));
    return responses.problem(request, errors.status(), {}, errors.problems(), more);
}

std::string reference_from(int depth, std::string_view address) {
    address.remove_prefix(std::string_view("/v1/").size());
    std::string reference;
    if (depth == 1) {
        address.remove_prefix(address.find('/') + 1);
        // RFC 3986, section 4.2: what precedes a colon in the first segment would be a scheme.
        if (address.substr(0, address.find('/')).find(':') != std::string_view::npos)
            reference = "./";
        return reference += address;
    }
    for (int i = 0; i < depth; ++i) reference += "../";
    return reference += address;
}

ImageUrls references_from(int depth, ImageUrls urls) {
    for (auto* of_format : {&urls.jpg, &urls.webp})
        for (std::string& url : *of_format) url = reference_from(depth, url);
    return urls;
}

std::string file_of(ImageKind kind, ImageFormat format) {
    return std::string(name(kind)) + '.' + name(format);
}

ImageUrls image_urls_of(const std::function<std::string(ImageKind, ImageFormat)>& url) {
    ImageUrls urls;
    for (std::size_t i = 0; i < urls.jpg.size(); ++i) {
        urls.jpg[i] = url(static_cast<ImageKind>(i), ImageFormat::jpg);
        urls.webp[i] = url(static_cast<ImageKind>(i), ImageFormat::webp);
    }
    return urls;
}

Cost cost_of_images(const FileOptions& file, const Cost& painting, std::uint64_t texels) {
    if (file.image_format == ImageFormats::jpg) return painting;
    Cost cost = painting + Cost{.webp_texels = texels};
    return file.image_format == ImageFormats::webp_jpg ? cost + painting : cost;
}

Cost cost_of_impostor(const FileOptions& file, const Estimate& estimated, std::uint64_t triangles) {
    constexpr std::uint64_t most = 1'000'000;
    if (triangles > most)
        throw Impossible(file.impostor ? "/impostor" : "/lod",
                         "each picture of the impostor would show about " +
                             std::to_string(triangles) + " triangles; at most " +
                             std::to_string(most) + " are drawn");
    const std::uint64_t texels = estimated.impostor_texels;
    Cost cost{.impostor_triangles = frame_count * triangles, .impostor_texels = texels / 3};
    if (file.image_format != ImageFormats::jpg) cost.webp_texels = texels;
    return cost;
}

std::optional<ImageKind> read_image(std::string_view image, ValidationErrors& errors) {
    std::vector<std::string> kinds;
    for (int i = 0; const char* one = name(static_cast<ImageKind>(i)); ++i) {
        kinds.emplace_back(one);
        if (image == one) return static_cast<ImageKind>(i);
    }
    const std::string_view meant = closest(image, kinds);
    errors.add(404, "image",
               in_quotes(image) + " is not one of " + enum_names<ImageKind>() +
                   (meant.empty() ? "" : "; did you mean " + in_quotes(meant) + "?"));
    return std::nullopt;
}

Value description(const Estimate& estimate) {
    return Value::object()
        .set("vertices", estimate.vertices)
        .set("triangles", estimate.triangles)
        .set("bytes", estimate.bytes);
}

Value description(const Bounds& bounds) {
    const auto corner = [](const glm::vec3& at) {
        return Value(Value::Array{write(at.x), write(at.y), write(at.z)});
    };
    return Value::object().set("min", corner(bounds.min)).set("max", corner(bounds.max));
}

}  // namespace sporeprint::api
