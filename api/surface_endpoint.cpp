#include <utility>

#include "api/encoding.h"
#include "api/endpoints.h"
#include "api/mix.h"
#include "core/params/messages.h"

namespace sporeprint::api {

namespace {

/// What only delivered_surface() reads of a job's shared answer: the digest of an image set. Never sent.
constexpr const char* digest_header = ":digest";

/// What every answer about an image carries; the tag is that of what is painted.
Answer surface_head(const SurfaceRequest& asked, std::string_view digest,
                    const std::string& version) {
    Answer head;
    head.headers = {
        {"Content-Type", "image/jpeg"},
        {"ETag", '"' + std::string(digest) + '-' + name(*asked.kind) + '"'},
        {"Cache-Control", cache_control(asked.version.has_value())},
        {"Content-Location",
         with_version(canonical_address(asked.mix, *asked.kind, asked.address), version)},
        {"Content-Disposition", "inline; filename=\"" + asked.mix.front().id + '-' +
                                    std::to_string(asked.address.seed) + '-' + name(*asked.kind) +
                                    ".jpg\""}};
    return head;
}

std::uint64_t texels_held(const PaintRecipe& recipe) {
    const auto side = static_cast<std::uint64_t>(side_of(recipe));
    return 3 * side * side * static_cast<std::uint64_t>(atlases_held(recipe));
}

/// What is painted at an address; adds to `faults` what of it is impossible.
PaintRecipe painted(Context& context, const SurfaceRequest& asked, Faults& faults) {
    try {
        PaintRecipe recipe =
            painted_at(asked.address, asked.mix, *context.atlas, made_at_once(context.store));
        if (const std::uint64_t texels = texels_held(recipe); texels > context.options.most_texels)
            faults.add(422, "texture_size",
                       std::to_string(texels) + " texels would be held" +
                           (recipe.size() > 1 ? ", those of every species" : "") + "; at most " +
                           std::to_string(context.options.most_texels) +
                           " are. Lower texture_size");
        return recipe;
    } catch (const Impossible& impossible) {
        faults.add(422, named(impossible, false));
    } catch (const InvalidInput& invalid) {
        faults.add(400, named(invalid, false));
    }
    return {};
}

}  // namespace

Plan plan_surface(Context& context, const Request& request, const SurfaceRequest& asked,
                  Faults& faults) {
    const Answers& answers = context.answers;
    Store& store = context.store;
    if (!faults.empty()) return answers.problem(request, faults);
    PaintRecipe recipe = painted(context, asked, faults);
    const std::string version = version_token(asked.mix, *context.atlas);
    if (asked.version && *asked.version != version) {
        faults.add(410, "v",
                   in_quotes(*asked.version) + " is no longer made; today's version is " +
                       in_quotes(version));
        Value::Object more;
        if (faults.status() == 410)
            more.emplace_back(
                "canonical",
                with_version(canonical_address(asked.mix, *asked.kind, asked.address), version));
        return answers.problem(request, faults.status(), {}, faults.problems(), more);
    }
    if (!faults.empty()) return answers.problem(request, faults);

    const Key key = image_key(recipe);
    const std::string digest = digest_of(key);
    Answer head = surface_head(asked, digest, version);
    const std::string_view condition = request.header("If-None-Match");
    if (names_any(condition) || names_etag(condition, header_of(head, "ETag"))) {
        set_header(head, "Cache-Status", "sporeprint-images; hit; detail=not-modified");
        return answers.not_modified(request, std::move(head));
    }
    if (const std::optional<Painted> kept = store.images.cache().find(key)) {
        ++store.counters.image_hits;
        head.body = {std::get<Images>(*kept)->files[static_cast<std::size_t>(*asked.kind)]};
        set_header(head, "Cache-Status", "sporeprint-images; hit");
        answers.represent(request, head);
        return head;
    }
    if (request.method == "HEAD") {
        head.has_body = false;
        set_header(head, "Cache-Status", "sporeprint-images; fwd=miss");
        answers.add_common_headers(request, head);
        return head;
    }
    // One flight for the three images of an atlas: its answer holds them all, delivered_surface() hands out the one asked for.
    const std::uint64_t texels = texels_held(recipe);
    const auto shared = std::make_shared<const PaintRecipe>(std::move(recipe));
    auto run = [&store, shared, digest](std::stop_token stop, const Observer& observer,
                                        const Parallel& parallel) {
        observer(Step::paint);
        Loan loan(store, std::move(stop), observer, parallel);
        const Images set = painted_images(*shared, loan.workshop());
        Answer answer;
        answer.headers = {{digest_header, digest}, {"Cache-Status", loan.cache_status()}};
        answer.body.assign(set->files.begin(), set->files.end());
        return answer;
    };
    return Job{key, Cost{0, texels, texels}, std::move(run)};
}

Answer delivered_surface(const Context& context, const SurfaceRequest& asked, Answer shared) {
    const std::string digest = take_header(shared, digest_header);
    Answer answer = surface_head(asked, digest, version_token(asked.mix, *context.atlas));
    answer.body = {shared.body[static_cast<std::size_t>(*asked.kind)]};
    return answer;
}

}  // namespace sporeprint::api
