#include "api/library/names.h"

#include <gtest/gtest.h>

namespace sporeprint::api::library_names_test {
namespace {

TEST(LibraryNames, AreReadAndWritten) {
    EXPECT_EQ(read_library_name("~kaja.red_bolete@3"),
              (LibraryName{"kaja", "red_bolete", 3, false}));
    EXPECT_EQ(read_library_name("~kaja.red_bolete"), (LibraryName{"kaja", "red_bolete", 0, false}));
    EXPECT_EQ(read_library_name("~a.b@64"), (LibraryName{"a", "b", 64, false}));
    EXPECT_TRUE(read_library_name("~kaja.red_bolete@draft").value().is_draft);
    for (const char* const text : {"~kaja.red_bolete@3", "~a1_.b2_", "~a.b@64", "~a.b@draft"})
        EXPECT_EQ(text_of(read_library_name(text).value()), text);
}

TEST(LibraryNames, EverythingElseIsNoName) {
    for (const char* const text : {"",
                                   "~",
                                   "kaja.red_bolete",
                                   "~kaja",
                                   "~kaja.",
                                   "~.bolete",
                                   "~Kaja.bolete",
                                   "~kaja.Bolete",
                                   "~1kaja.bolete",
                                   "~kaja.1bolete",
                                   "~kaja._b",
                                   "~kaja.bolete@",
                                   "~kaja.bolete@0",
                                   "~kaja.bolete@01",
                                   "~kaja.bolete@-1",
                                   "~kaja.bolete@+1",
                                   "~kaja.bolete@65",
                                   "~kaja.bolete@3x",
                                   "~kaja.bolete@99999999999",
                                   "~kaja.bolete@Draft",
                                   "~kaja.bolete@draft3",
                                   "~kaja.bo.lete",
                                   "~kaja.bolete ",
                                   "~kaja.bol\xC3\xA9te",
                                   "~seventeenletters_.bolete",
                                   "~kaja.twenty_five_characters_xx"})
        EXPECT_FALSE(read_library_name(text)) << text;
}

TEST(LibraryNames, TheLongestNamesFitIntoAnId) {
    const std::string owner(longest_owner, 'a'), name(longest_name, 'b');
    const std::optional<LibraryName> read = read_library_name('~' + owner + '.' + name + "@64");
    ASSERT_TRUE(read);
    EXPECT_LE(text_of(*read).size(), 48U);
    EXPECT_FALSE(is_owner_name(owner + 'a'));
    EXPECT_FALSE(is_species_name(name + 'b'));
}

}  // namespace
}  // namespace sporeprint::api::library_names_test
