#include "server/operations/text_files.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

namespace sporeprint::server::operations_text_files_test {
namespace {

namespace fs = std::filesystem;

TEST(TextFiles, SkipEmptyLinesAndComments) {
    const auto lines = lines_of("# a\n\n  /a?b=c \t\r\n/d\n #e\n\r\n/f");
    ASSERT_EQ(lines.size(), 3u);
    EXPECT_EQ(lines[0].text, "/a?b=c");
    EXPECT_EQ(lines[0].number, 3u);
    EXPECT_EQ(lines[1].text, "/d");
    EXPECT_EQ(lines[2].text, "/f");
    EXPECT_EQ(lines[2].number, 7u);
    EXPECT_TRUE(lines_of("").empty());
    EXPECT_TRUE(lines_of("\n\n").empty());
}

TEST(TextFiles, AreReadWholeOrNotAtAll) {
    const fs::path folder =
        fs::temp_directory_path() / ("text_files." + std::to_string(::getpid()));
    fs::create_directories(folder);
    const std::string bytes("a\r\n\0b", 5);
    std::ofstream(folder / "some", std::ios::binary) << bytes;
    std::ofstream(folder / "empty", std::ios::binary) << std::string();
    EXPECT_EQ(read_text(folder / "some"), std::optional(bytes));
    EXPECT_EQ(read_text(folder / "empty"), std::optional(std::string()));
    EXPECT_EQ(read_text(folder / "none"), std::nullopt);
    EXPECT_EQ(read_text(folder), std::nullopt) << "a folder";
    fs::remove_all(folder);
}

}  // namespace
}  // namespace sporeprint::server::operations_text_files_test
