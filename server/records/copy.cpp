#include "server/records/copy.h"

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "api/http/errors.h"
#include "core/problems.h"

namespace sporeprint::server {

namespace {

using namespace api;

void expect_done(WriteResult result, const std::string& what) {
    if (result != WriteResult::done)
        throw Unavailable(what + " could not be copied; the copy is not complete");
}

void copy_document(Records& from, Records& to, const StoredDocument& document, Seconds now,
                   Copied& copied) {
    const std::string name = document.owner + '.' + document.name;
    std::vector<Version> versions;
    if (document.state != DocumentState::purged)
        for (int number = 0; number <= document.newest; ++number) {
            std::optional<Version> version = from.version(document.owner, document.name, number);
            if (!version) throw Unavailable(name + " has changed while it was copied");
            for (const Blob& named : from.files(document.owner, document.name, number)) {
                std::optional<Blob> file =
                    from.file(document.owner, document.name, number, named.place);
                if (!file) throw Unavailable(name + " has changed while it was copied");
                version->content.blobs.push_back(*std::move(file));
            }
            versions.push_back(*std::move(version));
        }
    expect_done(to.restore(document, versions).result, name);
    for (const Share& share : from.shares(document.owner, document.name))
        if (!share.is_revoked && share.expires > now)
            expect_done(to.add_share(document.owner, document.name, share), "a key of " + name);
    ++copied.documents;
    copied.versions += static_cast<std::int64_t>(versions.size());
}

void copy_documents(Records& from, Records& to, const std::string& owner, Seconds now,
                    Copied& copied) {
    Listing listing;
    listing.owner = listing.reader = owner;
    listing.has_purged = true;
    for (;;) {
        const std::vector<StoredDocument> page = from.list(listing);
        if (page.empty()) return;
        for (const StoredDocument& document : page) copy_document(from, to, document, now, copied);
        listing.after_owner = page.back().owner;
        listing.after_name = page.back().name;
    }
}

}  // namespace

Copied copy_records(Records& from, Records& to, Seconds now) {
    if (!to.owners().empty())
        throw InvalidInput("TO", "it has owners already; allowed is an empty database");
    Copied copied;
    for (const Owner& owner : from.owners()) {
        to.add_owner(owner.name, owner.created);
        // An owner may have more than is allowed by now.
        constexpr std::int64_t no_limit = std::numeric_limits<std::int64_t>::max();
        to.set_limits(owner.name, no_limit, no_limit);
        copy_documents(from, to, owner.name, now, copied);
        to.set_limits(owner.name, owner.max_documents, owner.max_bytes);
        for (const Token& token : from.tokens(owner.name))
            if (!token.revoked && (!token.expires || *token.expires > now))
                expect_done(to.add_token(token), "a token of " + owner.name);
        if (owner.is_disabled) to.set_disabled(owner.name, true, now);
        ++copied.owners;
    }
    return copied;
}

}  // namespace sporeprint::server
