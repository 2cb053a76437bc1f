// URLs of images: all parameters on which painting depends, quantised, so that any server can paint
// a linked image again.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "api/products/context.h"
#include "api/products/product.h"
#include "core/atlas/atlas.h"
#include "core/grow/painting.h"
#include "core/surface/paint.h"

namespace sporeprint::api {

/// Amounts of painted ornaments.
struct PaintedAmounts {
    std::optional<double> warts, scales;

    static constexpr void fields(auto visit) {
        using P = PaintedAmounts;
        visit(&P::warts, info_of<OrnamentsOf<Maybe>>("warts"));
        visit(&P::scales, info_of<OrnamentsOf<Maybe>>("scales"));
    }
    bool operator==(const PaintedAmounts&) const = default;
};

/// Query parameters of images of mushrooms and colonies: those on which painting depends. Names that
/// are also parameters of the model have the same values there, because some loaders append the
/// query of a model to the URLs of its images.
struct SurfaceAddress {
    std::uint32_t seed = 1;
    double age = 38.0 / 64.0;
    int size = 0;
    double variation = 0.5;
    ImageSide texture_size{1024};
    int lod = 0;
    PaintedAmounts ornaments;
    HymeniumOf<Maybe> hymenium;
    PaintedWeathering<Maybe> weathering;
    std::optional<SplitSeeds> seeds;

    static constexpr void fields(auto visit) {
        using S = SurfaceAddress;
        using P = MushroomParams;
        visit(&S::seed, info_of<P>("seed"));
        visit(
            &S::age,
            Info{.name = "age",
                 .min = 0,
                 .max = 1,
                 .doc = "From button (0) through maturity (0.6) to decay (1), in steps of 1/64."});
        visit(&S::size, Info{.name = "size_steps",
                             .min = -70,
                             .max = 70,
                             .doc = "Scale of the whole in steps of 2 %: step n is 1.02^n times."});
        visit(&S::variation, info_of<P>("variation"));
        visit(&S::texture_size,
              Info{.name = "side", .unit = "texels", .doc = "Side of this image."});
        visit(&S::lod,
              Info{.name = "lod",
                   .min = 0,
                   .max = 3,
                   .doc = "Level of detail of the mesh that wears it: what relief the mesh "
                          "cannot carry is painted."});
        visit(&S::ornaments, info_of<P>("ornaments"));
        visit(&S::hymenium, info_of<P>("hymenium"));
        visit(&S::weathering, info_of<P>("weathering"));
        visit(&S::seeds, info_of<P>("seeds"));
    }
    bool operator==(const SurfaceAddress&) const = default;
};

/// Returns an age rounded to the steps of image URLs, 1/64.
[[nodiscard]] double quantised_age(double age);

/// Returns the query parameters of the images of a mushroom.
///
/// spec  as surface_spec() returns it
[[nodiscard]] SurfaceAddress surface_address(const MushroomSpec& spec);

/// Returns the painting of a URL, which is equal to paint_spec_of() of the specification from which
/// the URL was made.
///
/// mix     as surface_mix() returns it
/// throws  Impossible if no species of the mix can have a parameter
[[nodiscard]] PaintSpec painted_at(const SurfaceAddress& address, const Mix& mix,
                                   const Atlas& atlas, const Caches& caches = {});

/// A request for one image of a mushroom.
struct SurfaceRequest {
    Mix mix;  ///< as surface_mix() returns it
    std::optional<ImageKind> kind;
    SurfaceAddress address;
    std::optional<std::string> version;
};

/// Reads {mix}, {image} and query of the URL of an image; weights and age are quantised.
[[nodiscard]] SurfaceRequest read_surface(std::string_view mix, std::string_view image, Query query,
                                          const Atlas& atlas, ValidationErrors& errors);

/// Returns the canonical URL of an image without version.
///
/// product  "mushrooms" or "colonies", which have the same images
[[nodiscard]] std::string canonical_address(const char* product, const Mix& mix, ImageKind kind,
                                            ImageFormat format, const SurfaceAddress& address);

/// Returns the URLs of the images of a mushroom or colony, with their version tokens.
///
/// surface  as surface_spec() returns it
[[nodiscard]] ImageUrls mushroom_image_urls(const char* product, const MushroomSpec& surface,
                                            const SurfaceAddress& address, const Atlas& atlas);

/// Plans the response to a request for an image of a mushroom or colony.
///
/// query  without parameters of the model
[[nodiscard]] Plan plan_mushroom_image(RouteCall& call, const char* product, ImageFormat format,
                                       Query query);

}  // namespace sporeprint::api
