// One file that is made in advance, and what is written of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "api/batch/manifest.h"
#include "api/service.h"
#include "core/bytes.h"

namespace sporeprint::server {

/// How the files of a set are laid out in its folder.
enum class BakeLayout {
    tar,   ///< an archive for each shard, as WebDataset reads them
    files  ///< a file for each item, with a name that people understand
};

/// An item that was made, or that nothing can be made of.
struct BakedItem {
    std::uint64_t number = 0;
    std::string target;  ///< as the manifest has it
    Body body;           ///< empty if it failed
    std::string url;     ///< canonical, with the version
    std::string etag, type, encoding, sha256;
    std::string file;  ///< name in the layout of files
    Value drawn, labels;
    int status = 200;
    Value problem;  ///< null if it was made
    [[nodiscard]] bool failed() const { return status != 200; }
};

/// Makes an item on this thread, by the same functions as a request for it.
///
/// throws  std::runtime_error if it is not the request that is to blame
[[nodiscard]] BakedItem baked_item(api::Service& service, const api::BatchManifest& manifest,
                                   std::uint64_t number);

/// Returns a number with leading zeros, of at least so many digits.
[[nodiscard]] std::string padded(std::uint64_t number, std::size_t least);

/// Returns the key of an item: its number with leading zeros.
[[nodiscard]] std::string key_of(std::uint64_t number);

/// Returns its extension, "bin" if its address has none.
[[nodiscard]] std::string extension_of(const BakedItem& item);

/// Returns the file of labels that stands beside an item; empty if the item is a JSON file itself.
[[nodiscard]] std::string labels_text(const BakedItem& item);

/// Returns what the index says of an item: a line of JSON without its end. Where nothing was drawn, as in a list, it has
/// the spelling of the manifest, with the version, where that is not the canonical address.
///
/// place  the member that says where it is: "offset" or "file"
[[nodiscard]] std::string index_line(const BakedItem& item, Value::Member place);

}  // namespace sporeprint::server
