// What an operator does with a library on the command line: owners, tokens, backup.
#pragma once

#include <optional>
#include <string>

#include "api/library/records.h"

namespace sporeprint::server {

/// The values of `sporeprint library ...`.
struct LibraryCommand {
    /// owner-add, owner-list, owner-limit, owner-disable, owner-enable, token, backup or copy; empty for none.
    std::string verb;
    std::string owner;
    std::optional<std::int64_t> max_documents, max_bytes;
    std::string file;  ///< of a backup
    std::string to;    ///< database of a copy, as --library names one
};

/// The first owner of an empty library, who works on the machine itself.
inline constexpr const char* first_owner = "me";

/// Makes a token with which an owner may do everything.
///
/// returns  its text, which is stored nowhere
/// throws   InvalidInput (path "NAME") if there is no such owner or there are too many tokens; Unavailable
[[nodiscard]] std::string new_admin_token(api::Records& records, const std::string& owner,
                                          const std::string& label, api::Seconds now);

/// Makes an owner and a token if there is no owner yet.
///
/// returns  the token; nothing if there are owners
[[nodiscard]] std::optional<std::string> first_token(api::Records& records, api::Seconds now);

/// Does what the command says.
///
/// library  that of --library
/// returns  what is to be printed, whole lines
/// throws   InvalidInput (path "NAME" or "TO"); Unavailable
[[nodiscard]] std::string administer(const LibraryCommand& command, const std::string& library,
                                     api::Seconds now);

}  // namespace sporeprint::server
