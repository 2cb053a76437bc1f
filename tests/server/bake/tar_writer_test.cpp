#include "server/bake/tar_writer.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/math/random.h"

namespace sporeprint::server::tar_writer_test {
namespace {

constexpr std::size_t block = 512;

using Files = std::vector<std::pair<std::string, std::string>>;

/// Returns the archive of some files; checks where it says that they are.
std::string archive_of(const Files& files) {
    std::string out;
    TarWriter tar([&](const void* data, std::size_t size) {
        out.append(static_cast<const char*>(data), size);
    });
    std::vector<std::uint64_t> places;
    for (const auto& [name, text] : files) places.push_back(tar.add(name, {slice_of(text)}));
    tar.finish();
    for (std::size_t i = 0; i < files.size(); ++i)
        EXPECT_EQ(out.substr(places[i], files[i].second.size()), files[i].second);
    return out;
}

TEST(TarWriter, WritesHeadersThatDependOnTheFilesAlone) {
    const std::string archive = archive_of({{"000000001.glb", "glTF"}});
    ASSERT_EQ(archive.size(), 4 * block) << "Header, file, and two empty blocks.";
    EXPECT_EQ(archive.substr(0, 14), std::string("000000001.glb\0", 14));
    EXPECT_EQ(archive.substr(257, 5), "ustar");
    EXPECT_EQ(std::strtoul(archive.substr(100, 7).c_str(), nullptr, 8), 0644U);
    EXPECT_EQ(std::strtoul(archive.substr(108, 7).c_str(), nullptr, 8), 0U) << "user";
    EXPECT_EQ(std::strtoul(archive.substr(116, 7).c_str(), nullptr, 8), 0U) << "group";
    EXPECT_EQ(std::strtoul(archive.substr(124, 11).c_str(), nullptr, 8), 4U) << "size";
    EXPECT_EQ(std::strtoul(archive.substr(136, 11).c_str(), nullptr, 8), 0U) << "time";
    EXPECT_EQ(archive.find_first_not_of('\0', block + 4), std::string::npos);
    // The sum of all bytes of a header, its own field counted as spaces.
    unsigned long sum = 0;
    for (std::size_t i = 0; i < block; ++i)
        sum += i >= 148 && i < 156 ? ' ' : static_cast<unsigned char>(archive[i]);
    EXPECT_EQ(std::strtoul(archive.substr(148, 7).c_str(), nullptr, 8), sum);
}

TEST(TarWriter, HasEachFileAtABlockOfItsOwn) {
    Random random(7, 0);
    Files files;
    std::size_t size = 2 * block;
    for (int i = 0; i < 60; ++i) {
        std::string text(random.bits() % 2000, static_cast<char>('a' + i % 26));
        size += block + (text.size() + block - 1) / block * block;
        files.emplace_back("file." + std::to_string(i), std::move(text));
    }
    const std::string archive = archive_of(files);
    EXPECT_EQ(archive.size(), size);
    EXPECT_EQ(archive, archive_of(files));
}

TEST(TarWriter, PassesOnWhatItsSinkThrows) {
    std::size_t room = 3 * block;
    TarWriter tar([&](const void*, std::size_t size) {
        if (size > room) throw std::runtime_error("the disk is full");
        room -= size;
    });
    tar.add("a", {slice_of("short")});
    try {
        tar.add("b", {slice_of(std::string(9 * block, 'x'))});
        FAIL() << "It did not fit.";
    } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "the disk is full");
    }
    EXPECT_THROW(tar.finish(), std::runtime_error);
}

TEST(TarWriter, RefusesNamesThatTheFormatCannotHold) {
    TarWriter tar([](const void*, std::size_t) {});
    EXPECT_THROW(tar.add(std::string(300, 'n'), {slice_of("text")}), std::runtime_error);
}

}  // namespace
}  // namespace sporeprint::server::tar_writer_test
