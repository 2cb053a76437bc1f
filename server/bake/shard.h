// A shard: so many items in the order of their numbers, which is there completely or not at all.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "server/bake/aside_file.h"
#include "server/bake/item.h"
#include "server/bake/tar_writer.h"

namespace sporeprint::server {

/// What all shards of a folder have in common.
struct BakeSet {
    std::filesystem::path folder;
    std::string manifest;  ///< SHA-256 of its text
    std::string version;   ///< of the generator and its templates
    BakeLayout layout = BakeLayout::tar;
    bool labels = true;
    std::uint64_t count = 0, per_shard = 1;

    [[nodiscard]] std::uint64_t shards() const { return (count + per_shard - 1) / per_shard; }
    [[nodiscard]] std::uint64_t first_of(std::uint64_t shard) const { return shard * per_shard; }
    [[nodiscard]] std::uint64_t end_of(std::uint64_t shard) const {
        return std::min(count, first_of(shard) + per_shard);
    }
    /// Returns "000012.tar" or "000012.jsonl".
    [[nodiscard]] static std::string name_of(std::uint64_t shard, const char* extension);
    [[nodiscard]] std::filesystem::path index_of(std::uint64_t shard) const {
        return folder / name_of(shard, "jsonl");
    }
    [[nodiscard]] std::filesystem::path archive_of(std::uint64_t shard) const {
        return folder / name_of(shard, "tar");
    }
};

/// The first line of an index.
struct ShardHead {
    std::uint64_t items = 0, failed = 0, bytes = 0;
    std::string sha256;        ///< of the archive; empty in the layout of files
    std::string index_sha256;  ///< of all further lines
};

/// Returns the head of a shard that is there; nothing if it is not, or if it is of another set.
[[nodiscard]] std::optional<ShardHead> head_of(const BakeSet& set, std::uint64_t shard);

/// Writes a shard. Its index comes last: that it is there says that the shard is.
class ShardWriter {
  public:
    ShardWriter(const BakeSet& set, std::uint64_t shard);

    /// Adds the next item.
    ///
    /// throws  std::runtime_error if the disk cannot hold it
    void add(const BakedItem& item);

    /// Puts the shard into its place.
    ShardHead commit();

  private:
    std::uint64_t write(const std::string& name, const Body& body);

    const BakeSet& set_;
    std::uint64_t shard_;
    std::optional<AsideFile> file_;
    std::optional<TarWriter> tar_;
    std::string lines_;  ///< of the index
    ShardHead head_;
};

/// Reads a shard completely.
///
/// returns  what is wrong with it; empty if nothing is
[[nodiscard]] std::string damage_of(const BakeSet& set, std::uint64_t shard);

/// Calls a function with each line of an index but its head.
///
/// throws  std::runtime_error if it cannot be read
void for_each_line(const BakeSet& set, std::uint64_t shard,
                   const std::function<void(const Value&)>& use);

}  // namespace sporeprint::server
