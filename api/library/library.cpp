#include "api/library/library.h"

#include <algorithm>
#include <utility>

#include "api/library/species_text.h"
#include "core/params/messages.h"

namespace sporeprint::api {

namespace {

/// Memory for species that requests use.
constexpr std::size_t cache_bytes = std::size_t{64} << 20U;

/// How long the owner of a token is known without asking, and of how many tokens.
constexpr Seconds noted_for = 60;
constexpr std::size_t most_noted = 4096;

/// Returns the bytes of an entry: its text, and the structs and images that this describes.
std::size_t size_of_entry(const std::shared_ptr<const AtlasEntry>& entry) {
    return 3 * entry->json.size() + sizeof(AtlasEntry);
}

}  // namespace

std::shared_ptr<const AtlasEntry> entry_of(Species species, const std::string& id) {
    species.id = Text<48>(id);
    return std::make_shared<const AtlasEntry>(atlas_entry(std::move(species)));
}

Library::Library(std::shared_ptr<Records> records, Clock clock)
    : records_(std::move(records)), clock_(std::move(clock)), entries_(cache_bytes, size_of_entry) {
    refresh();
}

bool Library::refresh() {
    const std::lock_guard in_turn(refresh_mutex_);
    std::vector<Change> changes = records_->changes(serial_);
    if (changes.empty()) return false;
    const std::unique_lock lock(mutex_);
    for (Change& change : changes) {
        published_[text_of(LibraryName{change.owner, change.name})] = {change.state,
                                                                       std::move(change.versions)};
        serial_ = std::max(serial_, change.serial);
    }
    return true;
}

void Library::note_owner(const Digest& secret, const std::string& owner) {
    const Seconds time = now();
    const std::lock_guard lock(noted_mutex_);
    if (noted_.size() >= most_noted)
        std::erase_if(noted_, [&](const auto& one) { return one.second.at + noted_for < time; });
    if (noted_.size() < most_noted) noted_.insert_or_assign(secret, Noted{owner, time});
}

std::string Library::noted_owner(const Digest& secret) {
    const Seconds time = now();
    const std::lock_guard lock(noted_mutex_);
    const auto found = noted_.find(secret);
    return found != noted_.end() && found->second.at + noted_for >= time ? found->second.owner : "";
}

Library::Found Library::find(std::string_view id) {
    Found found;
    const std::optional<LibraryName> name = read_library_name(id);
    if (!name) {
        found.status = 404;
        found.message = in_quotes(id) +
                        " is not the name of a species in the library; allowed is ~owner.name or "
                        "~owner.name@3, an owner of " +
                        owner_grammar + ", a name of " + name_grammar + ", a version of 1 to " +
                        std::to_string(most_versions);
        return found;
    }
    found.name = *name;
    if (name->is_draft) {
        found.status = 404;
        found.message = in_quotes(id) + " is a draft; only what is published can be named here";
        return found;
    }
    const std::string document = text_of({name->owner, name->name});
    {
        const std::shared_lock lock(mutex_);
        const auto known = published_.find(document);
        const bool is_published =
            known != published_.end() &&
            (known->second.state == DocumentState::purged || !known->second.versions.empty());
        if (!is_published) {
            found.status = 404;
            found.message = "nothing of the name " + in_quotes(document) + " is published";
            return found;
        }
        if (known->second.state == DocumentState::purged) {
            found.status = 410;
            found.message = withdrawn_message({name->owner, name->name});
            return found;
        }
        const int newest = known->second.versions.back().first;
        if (name->number > newest) {
            found.status = 404;
            found.message = in_quotes(document) + " has no version " +
                            std::to_string(name->number) + "; the newest is " +
                            std::to_string(newest);
            return found;
        }
        if (found.name.number == 0) found.name.number = newest;
    }
    if (auto entry = entries_.cache().find(text_of(found.name))) found.entry = *std::move(entry);
    return found;
}

std::shared_ptr<const AtlasEntry> Library::load(const LibraryName& name) {
    const std::string id = text_of(name);
    bool hit = false;
    return entries_.get_or_compute(
        id,
        [&] {
            const std::optional<Version> version =
                records_->version(name.owner, name.name, name.number);
            if (!version) throw InvalidInput("mix", withdrawn_message(name));
            return entry_of(species_of(version->content), id);
        },
        {}, hit);
}

}  // namespace sporeprint::api
