#include "server/bake/aside_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "core/params/types.h"
#include "tests/server/bake/folder.h"

namespace sporeprint::server::aside_file_test {
namespace {

namespace fs = std::filesystem;
using baking::files_in;
using baking::text_of;

class AsideFiles : public baking::InFolder {};

TEST_F(AsideFiles, AreInTheirPlaceWhenTheyAreComplete) {
    std::ofstream(folder / "a") << "old";
    AsideFile file(folder / "a");
    file.write("new ");
    file.write("text");
    EXPECT_EQ(text_of(folder / "a"), "old");
    EXPECT_EQ(file.bytes(), 8U);
    EXPECT_EQ(file.commit(), sha256_hex("new text", 8));
    EXPECT_EQ(text_of(folder / "a"), "new text");
    EXPECT_TRUE(fs::is_empty(folder / "aside"));
    const FileDigest digest = digest_of_file(folder / "a");
    EXPECT_EQ(digest.sha256, sha256_hex("new text", 8));
    EXPECT_EQ(digest.bytes, 8U);
}

TEST_F(AsideFiles, AreGoneIfTheyAreNotCompleted) {
    { AsideFile(folder / "a").write("half"); }
    EXPECT_TRUE(files_in(folder).empty());
}

TEST_F(AsideFiles, LetTheFirstOneWin) {
    {
        AsideFile first(folder / "a"), second(folder / "a");
        first.write("first");
        second.write("second");
        EXPECT_TRUE(first.commit_first());
        EXPECT_FALSE(second.commit_first());
    }
    EXPECT_EQ(files_in(folder), (std::map<std::string, std::string>{{"a", "first"}}));
}

TEST_F(AsideFiles, OfOthersAreRemovedOnceTheyHaveEnded) {
    AsideFile used(folder / "a");
    used.write("used");
    std::ofstream(folder / "aside" / "left") << "by a process that was killed";
    remove_left_aside(folder / "aside");
    EXPECT_EQ(files_in(folder).size(), 1U);
    used.commit();
    EXPECT_EQ(text_of(folder / "a"), "used");
}

TEST_F(AsideFiles, SayWhatCannotBeWritten) {
    const auto message_of = [](const std::function<void()>& call) {
        try {
            call();
        } catch (const std::runtime_error& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_NE(message_of([&] { AsideFile(folder / "no" / "a"); }).find("No such file"),
              std::string::npos);
    fs::create_directories(folder / "taken" / "inside");
    AsideFile file(folder / "taken");
    EXPECT_NE(message_of([&] { file.commit(); }).find("taken cannot be put into its place"),
              std::string::npos);
    EXPECT_NE(message_of([&] {
                  static_cast<void>(digest_of_file(folder / "none"));
              }).find("none cannot be read"),
              std::string::npos);
}

}  // namespace
}  // namespace sporeprint::server::aside_file_test
