#include "server/records/administration.h"

#include <filesystem>
#include <memory>

#include "api/library/names.h"
#include "api/library/tokens.h"
#include "core/params/messages.h"
#include "core/problems.h"
#include "server/records/copy.h"
#include "server/records/open.h"
#include "server/records/sqlite.h"

namespace sporeprint::server {

namespace {

[[noreturn]] void no_owner(const std::string& name) {
    throw InvalidInput("NAME", "there is no owner " + in_quotes(name) +
                                   "; 'sporeprint library owner list' names all");
}

std::string line_of(const api::Owner& owner) {
    return owner.name + ": " + std::to_string(owner.documents) + " of " +
           std::to_string(owner.max_documents) + " documents, " + std::to_string(owner.used_bytes) +
           " of " + std::to_string(owner.max_bytes) + " bytes" +
           (owner.is_disabled ? ", disabled\n" : "\n");
}

/// Requires that a library exists where a command does not begin one: a mistyped path would make an empty one.
void require_existing(const std::string& library) {
    if (!is_postgres_address(library) && !std::filesystem::exists(library))
        throw InvalidInput("--library", "there is no file " + in_quotes(library) +
                                            "; 'sporeprint library owner add' begins one");
}

std::string token_lines(const std::string& owner, const std::string& token) {
    return "A token of " + owner + ", shown once; whoever has it may do everything that " + owner +
           " may:\n" + token + '\n';
}

}  // namespace

std::string new_admin_token(api::Records& records, const std::string& owner,
                            const std::string& label, api::Seconds now) {
    const api::Secret secret = api::new_secret(api::token_prefix);
    const api::WriteResult result =
        records.add_token(api::stored_token(secret, owner, label, api::Scope::admin, now));
    if (result == api::WriteResult::too_many)
        throw InvalidInput("NAME", owner + " has " + std::to_string(api::most_tokens) +
                                       " tokens already; revoke one first");
    if (result != api::WriteResult::done) no_owner(owner);
    return secret.text;
}

std::optional<std::string> first_token(api::Records& records, api::Seconds now) {
    // Of several replicas that start at once, one adds the owner.
    if (!records.owners().empty() || !records.add_owner(first_owner, now)) return std::nullopt;
    return new_admin_token(records, first_owner, "first start", now);
}

std::string administer(const LibraryCommand& command, const std::string& library,
                       api::Seconds now) {
    if (command.verb == "backup") {
        if (is_postgres_address(library))
            throw InvalidInput("--library",
                               "backup copies a file; a database of PostgreSQL is backed up by "
                               "pg_dump --schema=sporeprint");
        back_up_sqlite_records(library, command.file);
        return "Copied to " + command.file + '\n';
    }
    if (command.verb != "owner-add") require_existing(library);
    const std::unique_ptr<api::Records> records = open_records(library);
    if (command.verb == "copy") {
        const Copied copied = copy_records(*records, *open_records(command.to), now);
        return "Copied " + std::to_string(copied.owners) + " owners, " +
               std::to_string(copied.documents) + " documents and " +
               std::to_string(copied.versions) + " versions, drafts included\n";
    }
    const std::string& name = command.owner;
    if (command.verb == "owner-list") {
        std::string lines;
        for (const api::Owner& owner : records->owners()) lines += line_of(owner);
        return lines;
    }
    if (command.verb == "owner-add") {
        if (!api::is_owner_name(name))
            throw InvalidInput(
                "NAME", in_quotes(name) + " cannot be an owner; allowed are " + api::owner_grammar);
        if (!records->add_owner(name, now))
            throw InvalidInput("NAME", "there is an owner " + in_quotes(name) + " already");
        return token_lines(name, new_admin_token(*records, name, "made with the owner", now));
    }
    if (command.verb == "token")
        return token_lines(name, new_admin_token(*records, name, "made by the operator", now));
    if (command.verb == "owner-limit") {
        const std::optional<api::Owner> owner = records->owner(name);
        if (!owner) no_owner(name);
        records->set_limits(name, command.max_documents.value_or(owner->max_documents),
                            command.max_bytes.value_or(owner->max_bytes));
    } else if (!records->set_disabled(name, command.verb == "owner-disable", now)) {
        no_owner(name);
    }
    const std::optional<api::Owner> owner = records->owner(name);
    return owner ? line_of(*owner) : std::string();
}

}  // namespace sporeprint::server
