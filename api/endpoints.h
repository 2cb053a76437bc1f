// The routes that answer with something made: what each means, up to the Job that makes it.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "api/answers.h"
#include "api/colonies.h"
#include "api/morphs.h"
#include "api/mushrooms.h"
#include "api/presets.h"
#include "api/service.h"
#include "api/store.h"
#include "api/surfaces.h"

namespace sporeprint::api {

using Plan = std::variant<Answer, Job>;

/// What endpoints work with; lives as long as the Service.
struct Context {
    std::shared_ptr<const Atlas> atlas;
    ServiceOptions options;
    Answers answers;
    Store& store;
    Memo memo;  ///< what plan() asks: `kept_only`, or `made_at_once` when it is prepared
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
    std::optional<std::string> asked_version;
    bool is_linked = false;  ///< names addresses of its images

    /// What making it costs. Throws InvalidInput or Impossible, with paths of core, for all of it that can be told without
    /// making it; asks only `morphs` of the Memo.
    std::function<Cost(const Memo&)> weigh;

    /// What finding its correspondence costs; nothing where it needs none.
    Cost search;

    /// About what making it costs beside that, where its correspondence is not kept: then the job
    /// weighs it. Where there is no guess, a job that `prepares` comes before.
    std::optional<Cost> guess;

    /// Makes the body. Called on any thread, at most once at a time.
    std::function<Body(Loan&)> make;
};

/// Version, ETag, 304, caches, HEAD and the job: all that resources have in common.
///
/// faults  found so far; any of them is the answer
[[nodiscard]] Plan plan_resource(Context& context, const Request& request, Resource resource,
                                 Faults& faults);

/// A mushroom as GLB or JSON, by address or by body.
[[nodiscard]] Plan plan_mushroom(Context& context, const Request& request, MushroomRequest asked,
                                 Faults& faults);

/// A colony as GLB or JSON, by address or by body.
[[nodiscard]] Plan plan_colony(Context& context, const Request& request, ColonyRequest asked,
                               Faults& faults);

/// The correspondence of two species.
[[nodiscard]] Plan plan_morph(Context& context, const Request& request, const MorphRequest& asked,
                              Faults& faults);

/// A leaf as GLB or JSON, by address or by body.
[[nodiscard]] Plan plan_leaf(Context& context, const Request& request, PresetRequest<Leaves> asked,
                             Faults& faults);

/// A tree as GLB or JSON, by address or by body.
[[nodiscard]] Plan plan_tree(Context& context, const Request& request, PresetRequest<Trees> asked,
                             Faults& faults);

/// One image of an atlas as HTTP sees it.
struct ImageResource {
    ImageKind kind = ImageKind::base_color;
    std::string version;  ///< today's token of what it is painted with
    std::string address;  ///< canonical address without version
    std::string of;       ///< begins the file's name: "amanita_muscaria-7"
    std::optional<std::string> asked_version;
};

/// What painting an atlas takes.
struct PaintWork {
    Key key;  ///< equal keys, equal images
    Cost cost;
    std::function<Images(const Workshop&)> paint;
};

/// Version, ETag, 304, cache, HEAD and the job: all that images have in common.
///
/// decide  what is painted; adds to the faults what of it is impossible
[[nodiscard]] Plan plan_image(Context& context, const Request& request, const ImageResource& image,
                              const std::function<PaintWork(Faults&)>& decide, Faults& faults);

/// One image of a mushroom's atlas, of a leaf's, of a tree's bark.
[[nodiscard]] Plan plan_surface(Context& context, const Request& request,
                                const SurfaceRequest& asked, Faults& faults);
[[nodiscard]] Plan plan_surface(Context& context, const Request& request,
                                const PresetSurface<Leaves>& asked, Faults& faults);
[[nodiscard]] Plan plan_surface(Context& context, const Request& request,
                                const PresetSurface<Trees>& asked, Faults& faults);

/// The image that a well-formed address asks for.
[[nodiscard]] ImageResource image_of(const Context& context, const SurfaceRequest& asked);
[[nodiscard]] ImageResource image_of(const Context& context, const PresetSurface<Leaves>& asked);
[[nodiscard]] ImageResource image_of(const Context& context, const PresetSurface<Trees>& asked);

/// The image that was asked for, out of the shared answer of an atlas.
[[nodiscard]] Answer delivered_image(const Answers& answers, const ImageResource& image,
                                     Answer shared);

/// 422 for an estimate that is over the budget of one request: /lod, /frames of a clip, /texture_size.
void refuse_over_budget(const ServiceOptions& options, const Estimate& cost,
                        bool of_every_species = false, bool is_clip = false);

/// The same for the texels of images alone.
void refuse_texels(const ServiceOptions& options, std::uint64_t texels, bool of_every_species,
                   Faults& faults);

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
[[nodiscard]] Plan plan_inspection(Context& context, const Request& request, Faults& faults);

/// Paths of core as the client wrote them.
[[nodiscard]] std::vector<Problem> named(const InvalidInput& input, bool posted);

}  // namespace sporeprint::api
