#include "api/http/zip.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/problems.h"

namespace sporeprint::api::http_zip_test {
namespace {

std::string text_of(const Body& body) {
    std::string out;
    for (const Slice& slice : body)
        out.append(reinterpret_cast<const char*>(slice.data()), slice.size);
    return out;
}

/// Returns the little-endian number at an offset.
std::uint64_t number_at(const std::string& bytes, std::size_t at, int size) {
    std::uint64_t value = 0;
    for (int i = size - 1; i >= 0; --i)
        value = value << 8U | static_cast<std::uint8_t>(bytes[at + static_cast<std::size_t>(i)]);
    return value;
}

TEST(Zip, TheDirectoryLeadsToEveryFile) {
    const std::array<ArchiveFile, 3> files = {{{"a.txt", {slice_of("first "), slice_of("file")}},
                                               {"folder/b.txt", {slice_of("second")}},
                                               {"empty", {}}}};
    const std::string archive = text_of(zip_archive(files));
    const std::size_t end = archive.size() - 22;
    ASSERT_EQ(archive.substr(end, 4), "PK\5\6");
    EXPECT_EQ(number_at(archive, end + 10, 2), 3U);
    std::size_t at = number_at(archive, end + 16, 4);
    EXPECT_EQ(at + number_at(archive, end + 12, 4), end);
    for (const ArchiveFile& file : files) {
        ASSERT_EQ(archive.substr(at, 4), "PK\1\2");
        EXPECT_EQ(archive.substr(at + 46, file.name.size()), file.name);
        const std::string content = text_of(file.content);
        const auto checksum = crc32(0, reinterpret_cast<const Bytef*>(content.data()),
                                    static_cast<uInt>(content.size()));
        EXPECT_EQ(number_at(archive, at + 16, 4), checksum);
        EXPECT_EQ(number_at(archive, at + 24, 4), content.size());
        const std::size_t local = number_at(archive, at + 42, 4);
        ASSERT_EQ(archive.substr(local, 4), "PK\3\4");
        EXPECT_EQ(archive.substr(local + 4, 26), archive.substr(at + 6, 26));
        EXPECT_EQ(archive.substr(local + 30 + file.name.size(), content.size()), content);
        at += 46 + file.name.size();
    }
    EXPECT_EQ(at, end);
}

TEST(Zip, EqualFilesGiveEqualArchivesThatShareTheirBytes) {
    const Slice content = slice_of("shared");
    const std::array<ArchiveFile, 1> files = {{{"one", {content}}}};
    const Body archive = zip_archive(files);
    EXPECT_EQ(text_of(archive), text_of(zip_archive(files)));
    ASSERT_EQ(archive.size(), 3U);
    EXPECT_EQ(archive[1].owner, content.owner);
}

TEST(Zip, AnEmptyArchiveIsItsEndAlone) {
    EXPECT_EQ(text_of(zip_archive({})), std::string("PK\5\6") + std::string(18, '\0'));
}

TEST(Zip, TooManyFilesAreRefused) {
    const std::vector<ArchiveFile> files(65536);
    EXPECT_THROW((void)zip_archive(files), GenerationError);
}

}  // namespace
}  // namespace sporeprint::api::http_zip_test
