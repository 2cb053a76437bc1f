#include <utility>

#include "api/conditions.h"
#include "api/encoding.h"
#include "api/endpoints.h"
#include "api/mix.h"
#include "core/params/messages.h"

namespace sporeprint::api {

namespace {

/// What only delivered_surface() reads of a job's shared answer: the digest of an image set. Never sent.
constexpr const char* digest_header = ":digest";

/// What every answer about an image carries; the tag is that of what is painted.
Answer image_head(const Answers& answers, const ImageResource& image, std::string_view digest) {
    Answer head;
    head.headers = {{"Content-Type", "image/jpeg"},
                    {"ETag", '"' + std::string(digest) + '-' + name(image.kind) + '"'},
                    {"Cache-Control", cache_control(image.asked_version.has_value())},
                    {"Content-Location", answers.link(with_version(image.address, image.version))},
                    {"Content-Disposition",
                     "inline; filename=\"" + image.of + '-' + name(image.kind) + ".jpg\""}};
    return head;
}

std::uint64_t texels_held(const PaintRecipe& recipe) {
    const auto side = static_cast<std::uint64_t>(side_of(recipe));
    return 3 * side * side * static_cast<std::uint64_t>(atlases_held(recipe));
}

/// What is painted at an address; adds to `faults` what of it is impossible.
PaintRecipe painted(Context& context, const SurfaceRequest& asked, Faults& faults) {
    try {
        PaintRecipe recipe = painted_at(asked.address, asked.mix, *context.atlas, context.memo);
        refuse_texels(context.options, texels_held(recipe), recipe.size() > 1, faults);
        return recipe;
    } catch (const Impossible& impossible) {
        faults.add(422, named(impossible, false));
    } catch (const InvalidInput& invalid) {
        faults.add(400, named(invalid, false));
    } catch (NotKept& missing) {
        // Its images are those of each species alone, too.
        missing.cost = cost_of_search(asked.mix, *context.atlas);
        if (asked.mix.size() > 1) missing.cost.outlines *= 2;
        throw;
    }
    return {};
}

}  // namespace

Plan plan_image(Context& context, const Request& request, const ImageResource& image,
                const std::function<PaintWork(Faults&)>& decide, Faults& faults) {
    const Answers& answers = context.answers;
    Store& store = context.store;
    PaintWork work = decide(faults);
    if (image.asked_version && *image.asked_version != image.version) {
        faults.add(410, "v",
                   in_quotes(*image.asked_version) + " is no longer made; today's version is " +
                       in_quotes(image.version));
        Value::Object more;
        if (faults.status() == 410)
            more.emplace_back("canonical",
                              answers.link(with_version(image.address, image.version)));
        return answers.problem(request, faults.status(), {}, faults.problems(), more);
    }
    if (!faults.empty()) return answers.problem(request, faults);

    const std::string digest = digest_of(work.key);
    Answer head = image_head(answers, image, digest);
    const Conditions conditions(request);
    const std::vector<std::string> etags{std::string(header_of(head, "ETag"))};
    if (conditions.match_fails(etags))
        return answers.precondition_failed(request, "If-Match", etags);
    if (conditions.none_match_any() || conditions.unchanged(etags)) {
        set_header(head, "Cache-Status", "sporeprint-images; hit; detail=not-modified");
        return answers.not_modified(request, std::move(head), etags.front());
    }
    if (const std::optional<Painted> kept = store.images.cache().find(work.key)) {
        ++store.counters.image_hits;
        head.body = {std::get<Images>(*kept)->files[static_cast<std::size_t>(image.kind)]};
        set_header(head, "Cache-Status", "sporeprint-images; hit");
        head.repeatable = true;
        answers.represent(request, head);
        answers.select_range(request, head);
        return head;
    }
    if (request.method == "HEAD") {
        head.has_body = false;
        set_header(head, "Cache-Status", "sporeprint-images; fwd=miss");
        set_header(head, "Accept-Ranges", "bytes");
        answers.add_common_headers(request, head);
        return head;
    }
    // One flight for the three images of an atlas: its answer holds them all, delivered_image() hands out the one asked for.
    auto run = [&store, paint = std::move(work.paint), digest](
                   std::stop_token stop, const Observer& observer, const Parallel& parallel) {
        observer(Step::paint);
        Loan loan(store, std::move(stop), observer, parallel);
        const Images set = paint(loan.workshop());
        Answer answer;
        answer.headers = {{digest_header, digest}, {"Cache-Status", loan.cache_status()}};
        answer.body.assign(set->files.begin(), set->files.end());
        return answer;
    };
    return Job{std::move(work.key), work.cost, std::move(run)};
}

ImageResource image_of(const Context& context, const SurfaceRequest& asked) {
    return {*asked.kind, version_token(asked.mix, *context.atlas),
            canonical_address(asked.mix, *asked.kind, asked.address),
            asked.mix.front().id + '-' + std::to_string(asked.address.seed), asked.version};
}

Plan plan_surface(Context& context, const Request& request, const SurfaceRequest& asked,
                  Faults& faults) {
    if (!faults.empty()) return context.answers.problem(request, faults);
    const auto decide = [&](Faults& found) {
        const auto recipe = std::make_shared<const PaintRecipe>(painted(context, asked, found));
        if (recipe->empty()) return PaintWork{};
        const Cost cost{.base = 300,
                        .atlases = static_cast<std::uint64_t>(atlases_held(*recipe)),
                        .texels = texels_held(*recipe)};
        return PaintWork{image_key(*recipe), cost, [recipe](const Workshop& workshop) {
                             return painted_images(*recipe, workshop);
                         }};
    };
    return plan_image(context, request, image_of(context, asked), decide, faults);
}

Answer delivered_image(const Answers& answers, const ImageResource& image, Answer shared) {
    Answer answer = image_head(answers, image, take_header(shared, digest_header));
    answer.body = {shared.body[static_cast<std::size_t>(image.kind)]};
    return answer;
}

}  // namespace sporeprint::api
