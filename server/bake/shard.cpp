#include "server/bake/shard.h"

#include <fstream>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/params/types.h"
#include "core/params/value.h"

namespace sporeprint::server {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t digits_of_shards = 6;

std::uint64_t number_in(const Value& object, const char* key) {
    const Value* const found = object.find(key);
    return found != nullptr && found->is_number() ? static_cast<std::uint64_t>(found->as_number())
                                                  : 0;
}

std::string text_in(const Value& object, const char* key) {
    const Value* const found = object.find(key);
    return found != nullptr && found->is_string() ? found->as_string() : std::string();
}

/// Returns the value of a line of an index.
std::optional<Value> value_of(const std::string& line) {
    std::vector<Problem> problems;
    Value value = parse(line, problems);
    return problems.empty() ? std::optional(std::move(value)) : std::nullopt;
}

}  // namespace

std::string BakeSet::name_of(std::uint64_t shard, const char* extension) {
    return padded(shard, digits_of_shards) + "." + extension;
}

std::optional<ShardHead> head_of(const BakeSet& set, std::uint64_t shard) {
    std::ifstream stream(set.index_of(shard), std::ios::binary);
    std::string line;
    if (!std::getline(stream, line)) return std::nullopt;
    const std::optional<Value> head = value_of(line);
    if (!head || text_in(*head, "manifest_sha256") != set.manifest ||
        text_in(*head, "version") != set.version || number_in(*head, "shard") != shard ||
        number_in(*head, "items") != set.end_of(shard) - set.first_of(shard))
        return std::nullopt;
    ShardHead out{number_in(*head, "items"), number_in(*head, "failed"), number_in(*head, "bytes"),
                  text_in(*head, "sha256"), text_in(*head, "index_sha256")};
    if (set.layout == BakeLayout::tar) {
        std::error_code error;
        if (fs::file_size(set.archive_of(shard), error) != out.bytes || error) return std::nullopt;
    }
    return out;
}

ShardWriter::ShardWriter(const BakeSet& set, std::uint64_t shard) : set_(set), shard_(shard) {
    if (set.layout != BakeLayout::tar) return;
    file_.emplace(set.archive_of(shard));
    tar_.emplace([this](const void* data, std::size_t size) { file_->write(data, size); });
}

std::uint64_t ShardWriter::write(const std::string& name, const Body& body) {
    if (tar_) return tar_->add(name, body);
    AsideFile file(set_.folder / name);
    for (const Slice& slice : body) file.write(slice.data(), slice.size);
    head_.bytes += file.bytes();
    file.commit();
    return 0;
}

void ShardWriter::add(const BakedItem& item) {
    ++head_.items;
    if (item.failed()) {
        ++head_.failed;
        lines_ += index_line(item, {"offset", Value()}) + "\n";
        return;
    }
    const bool in_tar = tar_.has_value();
    const std::string key = key_of(item.number);
    const std::string name = in_tar ? key + "." + extension_of(item) : item.file;
    const std::uint64_t offset = write(name, item.body);
    if (set_.labels && in_tar)
        if (const std::string labels = labels_text(item); !labels.empty())
            write(key + ".json", {slice_of(labels)});
    lines_ += index_line(item, in_tar ? Value::Member{"offset", Value(offset)}
                                      : Value::Member{"file", Value(item.file)}) +
              "\n";
}

ShardHead ShardWriter::commit() {
    if (tar_) {
        tar_->finish();
        head_.bytes = file_->bytes();
        head_.sha256 = file_->commit();
    }
    Value head = Value::object();
    head.set("manifest_sha256", Value(set_.manifest))
        .set("version", Value(set_.version))
        .set("shard", Value(shard_))
        .set("items", Value(head_.items))
        .set("failed", Value(head_.failed))
        .set("bytes", Value(head_.bytes));
    if (tar_) head.set("sha256", Value(head_.sha256));
    head_.index_sha256 = sha256_hex(lines_.data(), lines_.size());
    head.set("index_sha256", Value(head_.index_sha256));
    AsideFile index(set_.index_of(shard_));
    index.write(dump(head) + "\n");
    index.write(lines_);
    index.commit();
    return head_;
}

void for_each_line(const BakeSet& set, std::uint64_t shard,
                   const std::function<void(const Value&)>& use) {
    const fs::path path = set.index_of(shard);
    std::ifstream stream(path, std::ios::binary);
    std::string line;
    if (!std::getline(stream, line)) throw std::runtime_error(path.string() + " cannot be read");
    while (std::getline(stream, line)) {
        const std::optional<Value> value = value_of(line);
        if (!value) throw std::runtime_error(path.string() + " is damaged");
        use(*value);
    }
}

std::string damage_of(const BakeSet& set, std::uint64_t shard) {
    const std::optional<ShardHead> head = head_of(set, shard);
    if (!head) return "missing";
    try {
        Sha256 index;
        std::ifstream stream(set.index_of(shard), std::ios::binary);
        std::string line;
        std::getline(stream, line);
        while (std::getline(stream, line)) {
            line += '\n';
            index.add(line.data(), line.size());
        }
        if (index.hex() != head->index_sha256) return "its index is damaged";
        if (set.layout == BakeLayout::tar)
            return digest_of_file(set.archive_of(shard)).sha256 == head->sha256
                       ? ""
                       : "its archive is damaged";
        std::string damage;
        for_each_line(set, shard, [&](const Value& item) {
            const std::string file = text_in(item, "file");
            if (file.empty() || !damage.empty()) return;
            if (digest_of_file(set.folder / file).sha256 != text_in(item, "sha256"))
                damage = file + " is damaged";
        });
        return damage;
    } catch (const std::runtime_error& error) {
        return error.what();
    }
}

}  // namespace sporeprint::server
