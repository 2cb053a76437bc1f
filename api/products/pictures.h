// Pictures of products: from the URL of a picture to the product and the view, and back. `Kind` is
// that of the product (plan_product.h).
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "api/products/context.h"
#include "api/products/plan_product.h"
#include "core/params/canonical.h"
#include "core/render/render.h"

namespace sporeprint::api {

/// The query of a picture: the parameters of the product and those of the picture.
struct PictureQuery {
    std::vector<std::pair<std::string, std::string>> product, picture;
};

/// Separates both; adds 400 for parameters of a file, which change no picture.
[[nodiscard]] PictureQuery read_picture_query(Query query, ValidationErrors& errors);

/// Reads the parameters of a picture; adds all problems to `errors`.
[[nodiscard]] PictureParams read_picture(const PictureQuery& query, ValidationErrors& errors);

/// Returns the schema of the query of a picture: that of the product without what belongs to files,
/// and the parameters of the picture.
[[nodiscard]] Value picture_schema(Value product);

/// Returns the cost of drawing, beside that of generating what is shown.
///
/// triangles  that are drawn, each instance counted
[[nodiscard]] Cost cost_of_drawing(const PictureParams& picture, std::uint64_t triangles);

/// Throws Impossible (422) if more triangles would be drawn than a picture may show.
void refuse_over_triangles(std::uint64_t triangles);

/// The specification of a product with that of its picture.
template <class Spec>
struct PictureSpec : Spec {
    PictureParams picture;
};

template <class Spec>
struct PictureRequest {
    PictureSpec<Spec> spec;
    Product product = Product::png;
    std::optional<std::string> version;
};

/// The Kind of plan_product.h for pictures of another Kind.
template <class Kind>
struct Pictures {
    using Resolved = typename Kind::Resolved;

    template <class Spec>
    static std::string version(const Spec& spec, const Atlas& atlas) {
        return Kind::version(spec, atlas);
    }

    template <class Spec>
    static std::string url(const Spec& spec, Product product, const Atlas& atlas) {
        std::string url = Kind::url(spec, product, atlas);
        const std::string view = query_text(spec.picture);
        if (url.empty() || view.empty()) return url;
        return url + (url.find('?') == std::string::npos ? '?' : '&') + view;
    }

    template <class Spec>
    static std::string key(const Spec& spec, Product product, const std::string& version) {
        return Kind::key(spec, product, version) + '\n' + canonical_text(spec.picture);
    }

    template <class Spec>
    static std::string file_name(const Spec& spec, Product product, const Atlas& atlas) {
        return Kind::file_name(spec, product, atlas);
    }

    template <class Spec>
    static Cost cost(const Context& context, const Spec& spec, Product, const Caches& caches,
                     Resolved& resolved) {
        const Cost cost = Kind::cost(context, spec, Product::glb, caches, resolved);
        refuse_over_triangles(drawn_triangles(spec, cost));
        return with_drawing(spec, cost);
    }

    template <class Spec>
    requires requires(const Spec& spec, const Atlas& atlas) { Kind::search(spec, atlas); }
    static Cost search(const Spec& spec, const Atlas& atlas) { return Kind::search(spec, atlas); }

    template <class Spec>
    requires requires(const Spec& spec, const Atlas& atlas) {
        Kind::guess(spec, Product::glb, atlas);
    }
    static std::optional<Cost> guess(const Spec& spec, Product, const Atlas& atlas) {
        const std::optional<Cost> cost = Kind::guess(spec, Product::glb, atlas);
        if (!cost) return std::nullopt;
        return with_drawing(spec, *cost);
    }

    template <class Spec>
    static ImageUrls image_urls(const Context&, const Spec&, const std::string&,
                                const ExecutionContext&) {
        return {};
    }

    template <class Spec>
    static Body grow(const Context& context, const Spec& spec, Resolved& resolved, Extras extras,
                     int depth, const ExecutionContext& execution) {
        extras.write = [&](const GlbScene& scene, const Parallel& parallel) -> Body {
            execution.observer(Step::draw);
            throw_if_cancelled(execution);
            return {
                Slice(std::make_shared<const Bytes>(rendered_png(scene, spec.picture, parallel)))};
        };
        return Kind::grow(context, spec, resolved, extras, depth, execution);
    }

    template <class Spec>
    static Value describe(const Context& context, const Spec& spec, Resolved& resolved,
                          const std::string& version, const ExecutionContext& execution) {
        return Kind::describe(context, spec, resolved, version, execution);
    }

  private:
    template <class Spec>
    static std::uint64_t drawn_triangles(const Spec& spec, const Cost& cost) {
        if constexpr (requires { Kind::instances_of_each(spec); })
            return 2 * cost.placed_vertices * Kind::instances_of_each(spec);
        else  // A leaf has about as many triangles as vertices.
            return 2 * cost.vertices + cost.placed_vertices;
    }

    template <class Spec>
    static Cost with_drawing(const Spec& spec, Cost cost) {
        // Images are decoded once they are painted; no file is written.
        cost.pixels += cost.texels + cost.leaf_texels + cost.bark_texels;
        cost.bytes = 0;
        return cost + cost_of_drawing(spec.picture, drawn_triangles(spec, cost));
    }
};

/// Returns the response to a request for a picture, or the job that draws it.
///
/// query      of the picture
/// requested  the product, read from query.product
template <class Kind, class Requested>
Plan plan_picture(RouteCall& call, const PictureQuery& query, Requested requested) {
    using Spec = decltype(requested.spec);
    if (has_addresses(requested.spec.params.textures))
        call.errors.add(422, "textures", "a picture links to no images; ask for embedded or none");
    if (requested.spec.params.lod > last_lod)
        call.errors.add(400, "lod",
                        std::to_string(requested.spec.params.lod) + " is outside 0.." +
                            std::to_string(last_lod) +
                            " of a picture, which shows meshes; ask for one of these");
    PictureRequest<Spec> picture{{std::move(requested.spec), read_picture(query, call.errors)},
                                 Product::png,
                                 std::move(requested.version)};
    return plan_product<Pictures<Kind>>(call.context, call.request, std::move(picture),
                                        call.errors);
}

}  // namespace sporeprint::api
