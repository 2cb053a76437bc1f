#include "server/records/sqlite.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "api/http/errors.h"
#include "tests/server/records/contract.h"

namespace sporeprint::server::records_sqlite_test {
namespace {

using namespace api;

class SqliteFile : public testing::Test {
  protected:
    test::TemporaryFolder folder_;
    std::filesystem::path file_ = folder_ / "library.db";
};

std::string reason_of(const std::filesystem::path& file) {
    try {
        static_cast<void>(open_sqlite_records(file));
    } catch (const Unavailable& error) {
        return error.what();
    }
    return {};
}

TEST_F(SqliteFile, ANewerSchemaIsRefusedAndLeftAlone) {
    open_sqlite_records(file_)->add_owner("kaja", 1);
    SQLite::Database(file_.string(), SQLite::OPEN_READWRITE).exec("PRAGMA user_version = 99");
    EXPECT_NE(reason_of(file_).find("schema 99; this server knows up to 1"), std::string::npos);
    SQLite::Database database(file_.string());
    EXPECT_EQ(database.execAndGet("SELECT count(*) FROM owner").getInt(), 1);
    EXPECT_EQ(database.execAndGet("PRAGMA user_version").getInt(), 99);
}

TEST_F(SqliteFile, OtherFilesAreRefused) {
    std::ofstream(file_)
        << "This is a text, long enough not to be taken for an empty database file.";
    EXPECT_NE(reason_of(file_), "");
    EXPECT_NE(reason_of(folder_ / "none/library.db").find("its folder does not exist"),
              std::string::npos);
}

TEST_F(SqliteFile, ABackupOfAFileInUseHasWhatWasCommitted) {
    const std::unique_ptr<Records> records = open_sqlite_records(file_);
    records->add_owner("kaja", 1);
    back_up_sqlite_records(file_, folder_ / "copy.db");
    records->add_owner("sami", 2);
    EXPECT_EQ(open_sqlite_records(folder_ / "copy.db")->owners().size(), 1U);
    EXPECT_THROW(back_up_sqlite_records(file_, folder_ / "copy.db"), Unavailable)
        << "exists already";
    EXPECT_THROW(back_up_sqlite_records(folder_ / "none.db", folder_ / "other.db"), Unavailable);
}

TEST_F(SqliteFile, ThePublishedIsProtectedByTheDatabaseItself) {
    const std::unique_ptr<Records> records = open_sqlite_records(file_);
    records->add_owner("kaja", 1);
    records->create("kaja", "bolete", {"text", {}, 1, "", "", {}}, "", "", 1);
    records->publish("kaja", "bolete", std::nullopt, {}, 1);
    SQLite::Database database(file_.string(), SQLite::OPEN_READWRITE);
    EXPECT_EQ(database.exec("UPDATE version SET text = 'other' WHERE number = 0"), 1);
    EXPECT_THROW(database.exec("UPDATE version SET text = 'other' WHERE number = 1"),
                 SQLite::Exception);
    EXPECT_EQ(database.execAndGet("PRAGMA integrity_check").getString(), "ok");
}

TEST_F(SqliteFile, APurgeThatAReaderHoldsUpIsFinishedLater) {
    const std::unique_ptr<Records> records = open_sqlite_records(file_);
    records->add_owner("kaja", 1);
    const std::string marker = "a text that must not be found again 51d0";
    records->create("kaja", "bolete", {marker, {}, 1, "", "", {}}, "", "", 1);
    const auto has_marker = [&] { return folder_.bytes().find(marker) != std::string::npos; };
    {
        SQLite::Database reader(file_.string());
        reader.exec("BEGIN");
        EXPECT_EQ(reader.execAndGet("SELECT count(*) FROM version").getInt(), 1);
        EXPECT_EQ(records->withdraw("kaja", "bolete", std::nullopt, true, 2).result,
                  WriteResult::done);
        EXPECT_TRUE(has_marker());
    }
    static_cast<void>(records->changes(0));
    EXPECT_FALSE(has_marker());
}

TEST_F(SqliteFile, OthersOnTheMachineCannotReadIt) {
    open_sqlite_records(file_)->add_owner("kaja", 1);
    EXPECT_EQ(std::filesystem::status(file_).permissions(),
              std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
}

TEST_F(SqliteFile, AFullDiskOrABusyFileIsUnavailable) {
    const std::unique_ptr<Records> records = open_sqlite_records(file_);
    records->add_owner("kaja", 1);
    SQLite::Database other(file_.string(), SQLite::OPEN_READWRITE);
    other.exec("BEGIN EXCLUSIVE");
    EXPECT_THROW(records->add_owner("sami", 1), Unavailable);
    other.exec("ROLLBACK");
    EXPECT_TRUE(records->add_owner("sami", 1));
}

}  // namespace
}  // namespace sporeprint::server::records_sqlite_test
