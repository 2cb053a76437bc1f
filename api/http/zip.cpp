#include "api/http/zip.h"

#include <zlib.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "core/problems.h"

namespace sporeprint::api {

namespace {

constexpr std::uint32_t local_file_signature = 0x04034b50, central_file_signature = 0x02014b50,
                        end_signature = 0x06054b50;
constexpr std::uint16_t version_needed = 20;          // 2.0: folders
constexpr std::uint16_t names_are_utf8 = 1U << 11U;   // general purpose flag
constexpr std::uint16_t first_day = (1U << 5U) | 1U;  // 1980-01-01 as MS-DOS dates are written

/// Little-endian bytes of a record.
struct Record {
    std::shared_ptr<Bytes> bytes = std::make_shared<Bytes>();

    void put16(std::uint64_t value) { put(value, 2); }
    void put32(std::uint64_t value) { put(value, 4); }
    void text(const std::string& text) { bytes->insert(bytes->end(), text.begin(), text.end()); }

  private:
    void put(std::uint64_t value, int size) {
        for (int i = 0; i < size; ++i)
            bytes->push_back(static_cast<std::uint8_t>(value >> (8 * i)));
    }
};

struct Entry {
    std::uint32_t checksum = 0;
    std::uint64_t size = 0, offset = 0;
};

/// Writes what the local header and the central one have in common: from the version to the length
/// of the name.
void put_description(Record& record, const Entry& entry, const std::string& name) {
    record.put16(version_needed);
    record.put16(names_are_utf8);
    record.put16(0);  // stored
    record.put16(0);  // midnight
    record.put16(first_day);
    record.put32(entry.checksum);
    record.put32(entry.size);  // as it is stored
    record.put32(entry.size);
    record.put16(name.size());
    record.put16(0);  // no extra field
}

std::uint32_t checksum_of(const Body& content) {
    uLong sum = crc32(0, nullptr, 0);
    for (const Slice& slice : content) sum = crc32_z(sum, slice.data(), slice.size);
    return static_cast<std::uint32_t>(sum);
}

}  // namespace

Body zip_archive(std::span<const ArchiveFile> files) {
    if (files.size() > 0xFFFF) throw GenerationError("an archive has at most 65,535 files");
    Body archive;
    Record directory;
    std::uint64_t offset = 0;
    for (const ArchiveFile& file : files) {
        const Entry entry{checksum_of(file.content), size_of(file.content), offset};
        Record local;
        local.put32(local_file_signature);
        put_description(local, entry, file.name);
        local.text(file.name);
        directory.put32(central_file_signature);
        directory.put16(version_needed);
        put_description(directory, entry, file.name);
        directory.put16(0);  // no comment
        directory.put16(0);  // first disk
        directory.put16(0);  // internal attributes
        directory.put32(0);  // external attributes
        directory.put32(entry.offset);
        directory.text(file.name);
        offset += local.bytes->size() + entry.size;
        if (offset + directory.bytes->size() > 0xFFFF0000ULL)
            throw GenerationError("the archive would exceed 4 GB");
        archive.emplace_back(std::move(local.bytes));
        archive.insert(archive.end(), file.content.begin(), file.content.end());
    }
    const std::uint64_t length = directory.bytes->size();
    directory.put32(end_signature);
    directory.put16(0);  // this disk
    directory.put16(0);  // disk of the directory
    directory.put16(files.size());
    directory.put16(files.size());
    directory.put32(length);
    directory.put32(offset);
    directory.put16(0);  // no comment
    archive.emplace_back(std::move(directory.bytes));
    return archive;
}

}  // namespace sporeprint::api
