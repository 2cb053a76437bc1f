// The routes that answer with something made: what each means, up to the Job that makes it.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "api/cache/store.h"
#include "api/http/response_builder.h"
#include "api/http/service_options.h"
#include "api/products/colonies.h"
#include "api/products/morphs.h"
#include "api/products/mushrooms.h"
#include "api/products/presets.h"
#include "api/products/surfaces.h"

namespace sporeprint::api {

using Plan = std::variant<Response, Job>;

/// What endpoints work with; lives as long as the Service.
struct Context {
    std::shared_ptr<const Atlas> atlas;
    ServiceOptions options;
    ResponseBuilder responses;
    Store& store;
    Caches caches;  ///< what plan() asks: `cached_only`, or `computed_inline` when it is prepared
};

/// Depth of links that are resolved against the address of most files, /v1/mushrooms/x.glb.
inline constexpr int usual_depth = 1;

/// Depth, as reference_from() takes it, of the file that a request asks for.
[[nodiscard]] int link_depth(const Context& context, const Request& request);

/// What is made once and kept, as HTTP sees it. What the address and the body mean is decided; nothing is made.
struct Resource {
    Key key;              ///< full canonical text
    std::string type;     ///< media type
    std::string version;  ///< today's token of what it is made with
    std::string address;  ///< canonical address without version; empty if no GET has it
    std::string file_name;
    std::optional<std::string> requested_version;
    bool is_linked = false;  ///< names addresses of its images

    /// What making it costs. Throws InvalidInput or Impossible, with paths of core, for all of it that can be told without
    /// making it; asks only `morphs` of the Memo.
    std::function<Cost(const Caches&)> estimate_cost;

    /// What finding its correspondence costs; nothing where it needs none.
    Cost search;

    /// About what making it costs beside that, where its correspondence is not kept: then the job
    /// weighs it. Where there is no guess, a job that `prepares` comes before.
    std::optional<Cost> guess;

    /// Makes the body. Called on any thread, at most once at a time.
    std::function<Body(JobContext&)> make;
};

/// Version, ETag, 304, caches, HEAD and the job: all that resources have in common.
///
/// faults  found so far; any of them is the answer
[[nodiscard]] Plan plan_resource(Context& context, const Request& request, Resource resource,
                                 ValidationErrors& errors);

/// A mushroom as GLB or JSON, by address or by body.
[[nodiscard]] Plan plan_mushroom(Context& context, const Request& request,
                                 MushroomRequest requested, ValidationErrors& errors);

/// A colony as GLB or JSON, by address or by body.
[[nodiscard]] Plan plan_colony(Context& context, const Request& request, ColonyRequest requested,
                               ValidationErrors& errors);

/// The correspondence of two species.
[[nodiscard]] Plan plan_morph(Context& context, const Request& request,
                              const MorphRequest& requested, ValidationErrors& errors);

/// A leaf as GLB or JSON, by address or by body.
[[nodiscard]] Plan plan_leaf(Context& context, const Request& request,
                             PresetRequest<Leaves> requested, ValidationErrors& errors);

/// A tree as GLB or JSON, by address or by body.
[[nodiscard]] Plan plan_tree(Context& context, const Request& request,
                             PresetRequest<Trees> requested, ValidationErrors& errors);

/// One image of an atlas as HTTP sees it.
struct ImageResource {
    ImageKind kind = ImageKind::base_color;
    std::string version;  ///< today's token of what it is painted with
    std::string address;  ///< canonical address without version
    std::string of;       ///< begins the file's name: "amanita_muscaria-7"
    std::optional<std::string> requested_version;
};

/// What painting an atlas takes.
struct PaintWork {
    Key key;  ///< equal keys, equal images
    Cost cost;
    std::function<Images(const ExecutionContext&)> paint;
};

/// Version, ETag, 304, cache, HEAD and the job: all that images have in common.
///
/// decide  what is painted; adds to the faults what of it is impossible
[[nodiscard]] Plan plan_image(Context& context, const Request& request, const ImageResource& image,
                              const std::function<PaintWork(ValidationErrors&)>& decide,
                              ValidationErrors& errors);

/// One image of a mushroom's atlas, of a leaf's, of a tree's bark.
[[nodiscard]] Plan plan_surface(Context& context, const Request& request,
                                const SurfaceRequest& requested, ValidationErrors& errors);
[[nodiscard]] Plan plan_surface(Context& context, const Request& request,
                                const PresetSurface<Leaves>& requested, ValidationErrors& errors);
[[nodiscard]] Plan plan_surface(Context& context, const Request& request,
                                const PresetSurface<Trees>& requested, ValidationErrors& errors);

/// The image that a well-formed address asks for.
[[nodiscard]] ImageResource image_of(const Context& context, const SurfaceRequest& requested);
[[nodiscard]] ImageResource image_of(const Context& context,
                                     const PresetSurface<Leaves>& requested);
[[nodiscard]] ImageResource image_of(const Context& context, const PresetSurface<Trees>& requested);

/// The image that was asked for, out of the shared answer of an atlas.
[[nodiscard]] Response delivered_image(const ResponseBuilder& responses, const ImageResource& image,
                                       Response shared);

/// 422 for an estimate that is over the budget of one request: /lod, /frames of a clip, /texture_size.
void refuse_over_budget(const ServiceOptions& options, const Estimate& cost,
                        bool of_every_species = false, bool is_clip = false);

/// The same for the texels of images alone.
void refuse_texels(const ServiceOptions& options, std::uint64_t texels, bool of_every_species,
                   ValidationErrors& errors);

/// What finding the correspondence of a mix, or of a model of one's own, costs; branched species
/// need none.
[[nodiscard]] Cost cost_of_search(const Mix& mix, const Atlas& atlas);

/// What deciding that many individuals of a mix, or of a model of one's own, costs.
///
/// branches  of which family they are
[[nodiscard]] Cost cost_of_individuals(const Mix& mix, bool branches, std::uint64_t count);

/// Whether the species of a mix branch.
[[nodiscard]] bool is_branched(const Mix& mix, const Atlas& atlas);

/// What painting the images of a leaf, or of bark, costs, where they are embedded.
[[nodiscard]] Cost cost_of_paint(const LeafPaint& paint);
[[nodiscard]] Cost cost_of_paint(const TreePaint& paint);

/// What a GLB tells about itself.
[[nodiscard]] Plan plan_inspection(Context& context, const Request& request,
                                   ValidationErrors& errors);

/// Paths of core as the client wrote them.
[[nodiscard]] std::vector<Problem> named(const InvalidInput& input, bool posted);

}  // namespace sporeprint::api
