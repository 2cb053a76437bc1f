#include "api/products/library_drafts.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>

#include "api/http/documents.h"
#include "api/library/species_text.h"
#include "api/library/tokens.h"
#include "api/products/library_access.h"
#include "core/params/messages.h"

namespace sporeprint::api {

namespace {

/// What growing a draft costs if not even its kind is known, microseconds.
constexpr std::uint64_t usual_cost = 20'000;

std::optional<LibraryName> draft_name(std::string_view id) {
    const std::optional<LibraryName> name = read_library_name(id);
    return name && name->is_draft ? name : std::nullopt;
}

/// Returns the cost of the same request with a built-in species in the place of each draft.
Cost estimated_cost(const Context& context, const std::vector<std::string>& ids,
                    const PlanAgain& again) {
    const AtlasEntry& any = context.atlas->entries().front();
    std::vector<AtlasGuest> guests;
    guests.reserve(ids.size());
    for (const std::string& id : ids) guests.push_back({id, entry_of(any.species, id)});
    const std::shared_ptr<Context> own = with_guests(context, std::move(guests));
    try {
        const Plan plan = again(*own);
        if (const Job* const job = std::get_if<Job>(&plan)) return job->cost;
    } catch (const CacheMiss& missing) {
        return Cost{.base = usual_cost} + missing.cost;
    } catch (const SpeciesOfLibrary&) {
        // Others are named too; the job finds them.
    }
    return Cost{.base = usual_cost};
}

/// Reads drafts that a caller may see.
class DraftReader {
  public:
    DraftReader(const Context& context, const Request& request)
        : context_(context), request_(request) {}

    /// Returns the response that refuses the caller; nothing if it has a good token, or a key of a share.
    std::optional<Response> refusal() {
        const std::optional<std::string_view> bearer = bearer_of(request_);
        if (bearer && read_secret(share_prefix, *bearer)) {
            key_ = *bearer;
            return std::nullopt;
        }
        auto who = authenticated(*context_.library, context_.responses, request_, Access::required,
                                 Scope::read);
        if (Response* const refused = std::get_if<Response>(&who)) return std::move(*refused);
        caller_ = std::get<Caller>(std::move(who));
        return std::nullopt;
    }

    /// Returns a species, or the response that says why it cannot be read.
    std::variant<std::shared_ptr<const AtlasEntry>, Response> read(const std::string& id) {
        Library& library = *context_.library;
        const std::optional<LibraryName> name = draft_name(id);
        if (!name) {
            Library::Found found = library.find(id);
            if (found.status != 200) return not_found(context_.responses, request_, found);
            return found.entry ? std::move(found.entry) : library.load(found.name);
        }
        const bool may_see =
            key_.empty() ? caller_.is(name->owner) : is_shared(library, *name, key_);
        const std::optional<Version> draft =
            may_see ? library.records().version(name->owner, name->name, 0) : std::nullopt;
        if (!draft)
            return context_.responses.problem(request_, 404, unseen_message(library, *name));
        return entry_of(species_of(draft->content), id);
    }

  private:
    const Context& context_;
    const Request& request_;
    std::string_view key_;
    Caller caller_;
};

/// Takes from a response what others must not learn or store.
void make_private(Response& response) {
    response.cacheable = response.is_stored = false;
    static_cast<void>(take_header(response, "Content-Location"));
    static_cast<void>(take_header(response, "Cache-Status"));
    set_header(response, "Cache-Control", private_to_client);
}

}  // namespace

bool has_draft(const std::vector<std::string>& ids) {
    return std::any_of(ids.begin(), ids.end(),
                       [](const std::string& id) { return draft_name(id).has_value(); });
}

Plan plan_with_drafts(const Context& context, const Request& request,
                      const std::vector<std::string>& ids, const PlanAgain& again) {
    const std::string key = context.library->next_key();
    const Cost cost = Cost{.base = 3000} + estimated_cost(context, ids, again);
    auto run = [&context, request, ids, again](std::stop_token stop, const Observer& observer,
                                               const Parallel& parallel) {
        observer(Step::resolve);
        DraftReader reader(context, request);
        if (std::optional<Response> refused = reader.refusal()) return *std::move(refused);
        std::vector<AtlasGuest> guests;
        std::vector<std::string> wanted = ids;
        for (;;) {
            for (const std::string& id : wanted) {
                auto found = reader.read(id);
                if (Response* const refused = std::get_if<Response>(&found))
                    return std::move(*refused);
                guests.push_back(
                    {id, std::get<std::shared_ptr<const AtlasEntry>>(std::move(found))});
            }
            const std::shared_ptr<Context> own = with_guests(context, guests);
            own->has_drafts = true;
            own->caches = computed_inline(context.store);
            try {
                Plan plan = again(*own);
                Response response;
                if (Job* const job = std::get_if<Job>(&plan)) {
                    response = job->run(stop, observer, parallel);
                    if (job->delivery) job->delivery(response);
                } else {
                    response = std::get<Response>(std::move(plan));
                }
                make_private(response);
                return response;
            } catch (const SpeciesOfLibrary& more) {
                wanted = more.ids();
            }
        }
    };
    return Job{key, cost, std::move(run)};
}

}  // namespace sporeprint::api
