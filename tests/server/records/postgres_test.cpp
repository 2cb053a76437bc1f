// What is particular to PostgreSQL; what all databases have in common is in records_test.cpp.
#include "server/records/postgres.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "api/http/errors.h"
#include "api/library/tokens.h"
#include "core/problems.h"
#include "server/records/administration.h"
#include "tests/server/records/backends.h"

namespace sporeprint::server::records_postgres_test {
namespace {

using namespace api;
using namespace test;

class Postgres : public testing::Test {
  protected:
    void SetUp() override {
        ASSERT_TRUE(PostgresCluster::is_installed()) << "server/install test installs it";
        cluster_ = &PostgresCluster::instance();
        database_ = cluster_->new_database();
    }
    [[nodiscard]] std::unique_ptr<Records> open() const {
        return open_postgres_records(cluster_->address(database_));
    }

    PostgresCluster* cluster_ = nullptr;
    std::string database_;
};

std::string reason_of(const std::string& address) {
    try {
        static_cast<void>(open_postgres_records(address));
    } catch (const Unavailable& error) {
        return error.what();
    }
    return {};
}

TEST_F(Postgres, ANewerSchemaIsRefusedAndLeftAlone) {
    open()->add_owner("kaja", 1);
    cluster_->execute(database_, "UPDATE sporeprint.schema_version SET number = 99");
    EXPECT_NE(reason_of(cluster_->address(database_)).find("schema 99; this server knows up to 1"),
              std::string::npos);
    EXPECT_EQ(cluster_->execute(database_, "SELECT count(*) FROM sporeprint.owner"), "1");
    EXPECT_EQ(cluster_->execute(database_, "SELECT number FROM sporeprint.schema_version"), "99");
}

TEST_F(Postgres, SeveralReplicasMayBeTheFirstAtOnce) {
    std::vector<std::unique_ptr<Records>> opened(6);
    {
        std::vector<std::jthread> replicas;
        for (std::unique_ptr<Records>& one : opened) replicas.emplace_back([&] { one = open(); });
    }
    for (const std::unique_ptr<Records>& one : opened) ASSERT_TRUE(one);
    EXPECT_TRUE(opened.front()->add_owner("kaja", 1));
    EXPECT_EQ(opened.back()->owners().size(), 1U);
    std::atomic<int> tokens{0};
    const std::string fresh = cluster_->new_database();
    const std::unique_ptr<Records> empty = open_postgres_records(cluster_->address(fresh));
    {
        std::vector<std::jthread> replicas;
        for (int i = 0; i < 6; ++i)
            replicas.emplace_back([&] { tokens += first_token(*empty, 1) ? 1 : 0; });
    }
    EXPECT_EQ(tokens, 1);
}

TEST_F(Postgres, AUserThatMayOnlyReadAndWriteRowsIsEnough) {
    open()->add_owner("kaja", 1);
    cluster_->execute(database_,
                      "CREATE ROLE little LOGIN; GRANT USAGE ON SCHEMA sporeprint TO little; "
                      "GRANT SELECT, INSERT, UPDATE, DELETE ON ALL TABLES IN SCHEMA sporeprint TO "
                      "little");
    std::string address = cluster_->address(database_);
    address.replace(address.find("sporeprint@"), 11, "little@");
    const std::unique_ptr<Records> records = open_postgres_records(address);
    EXPECT_EQ(records->create("kaja", "bolete", content("first"), "", "", 1).result,
              WriteResult::done);
    EXPECT_EQ(records->publish("kaja", "bolete", std::nullopt, {}, 1).number, 1);
    const std::string fresh = cluster_->new_database();
    address = cluster_->address(fresh);
    address.replace(address.find("sporeprint@"), 11, "little@");
    EXPECT_NE(reason_of(address).find("permission denied"), std::string::npos);
    cluster_->execute(database_, "DROP OWNED BY little; DROP ROLE little");
}

TEST_F(Postgres, WhatCannotBeUsedIsNamedWithoutItsPassword) {
    const std::string reason = reason_of("postgres://kaja:topsecret@127.0.0.1:1/library");
    EXPECT_NE(reason.find("postgres://127.0.0.1:1/library"), std::string::npos) << reason;
    EXPECT_EQ(reason.find("topsecret"), std::string::npos) << reason;
    EXPECT_NE(reason_of(cluster_->address("no_such_database")).find("does not exist"),
              std::string::npos);
    EXPECT_THROW(static_cast<void>(open_records("postgres://kaja@[::1/x")), InvalidInput);
    EXPECT_THROW(static_cast<void>(open_records("mysql://host/x")), InvalidInput);
    const std::string latin =
        cluster_->new_database("TEMPLATE template0 ENCODING 'LATIN1' LC_COLLATE 'C' LC_CTYPE 'C'");
    EXPECT_NE(reason_of(cluster_->address(latin)).find("encoding of the database is LATIN1"),
              std::string::npos);
    LibraryCommand backup;
    backup.verb = "backup";
    EXPECT_THROW(administer(backup, cluster_->address(database_), 1), InvalidInput);
}

TEST_F(Postgres, ThePublishedIsProtectedByTheDatabaseItself) {
    const std::unique_ptr<Records> records = open();
    records->add_owner("kaja", 1);
    records->create("kaja", "bolete", content("first"), "", "", 1);
    records->publish("kaja", "bolete", std::nullopt, {}, 1);
    cluster_->execute(database_, "UPDATE sporeprint.version SET note = 'x' WHERE number = 0");
    EXPECT_THROW(
        cluster_->execute(database_, "UPDATE sporeprint.version SET note = 'x' WHERE number = 1"),
        std::runtime_error);
}

TEST_F(Postgres, ARestartIsSurvivedAndWhatWasAcknowledgedIsThere) {
    const std::unique_ptr<Records> records = open();
    records->add_owner("kaja", 1);
    for (const int signal : {SIGINT, SIGQUIT}) {
        const std::string name = "document" + std::to_string(signal);
        ASSERT_EQ(records->create("kaja", name, content("first"), "", "", 1).result,
                  WriteResult::done);
        cluster_->stop(signal);
        EXPECT_THROW(static_cast<void>(records->owners()), Unavailable);
        EXPECT_THROW(static_cast<void>(records->add_owner("sami", 1)), Unavailable);
        cluster_->start();
        EXPECT_EQ(records->version("kaja", name, 0)->content.text, "first");
        EXPECT_EQ(records->replace("kaja", name, sha256_of("first"), content("second"), 2).result,
                  WriteResult::done);
    }
}

TEST_F(Postgres, OnlyOneWaitsForADatabaseThatHangs) {
    const std::unique_ptr<Records> records = open();
    records->add_owner("kaja", 1);
    using Clock = std::chrono::steady_clock;
    const auto is_refused = [&] {
        try {
            static_cast<void>(records->owners());
        } catch (const Unavailable& error) {
            EXPECT_NE(std::string(error.what()).find("respond"), std::string::npos) << error.what();
            return true;
        }
        return false;
    };
    cluster_->pause();
    EXPECT_TRUE(is_refused()) << "who finds out waits for a second and for one connection";
    const Clock::time_point begin = Clock::now();
    int refused = 0;
    for (; Clock::now() - begin < std::chrono::milliseconds(500); ++refused)
        EXPECT_TRUE(is_refused());
    EXPECT_GT(refused, 100) << "the others do not wait";
    cluster_->resume();
    while (is_refused() && Clock::now() - begin < std::chrono::seconds(60))
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    EXPECT_EQ(records->owners().size(), 1U) << "it is used again by itself";
    EXPECT_TRUE(records->add_owner("sami", 2));
}

TEST_F(Postgres, OwnersThatShareImagesDoNotBlockEachOther) {
    // Two owners who write the same blobs in opposite orders would each wait for the other, which the database ends
    // by refusing one of them.
    const std::unique_ptr<Records> records = open();
    std::vector<Blob> blobs;
    for (int i = 0; i < 12; ++i)
        blobs.push_back(blob("/" + std::to_string(i), "pixels " + std::to_string(i)));
    std::vector<Blob> backwards = blobs;
    std::reverse(backwards.begin(), backwards.end());
    std::atomic<int> done{0};
    {
        std::vector<std::jthread> writers;
        for (int i = 0; i < 8; ++i) {
            const std::string owner = "owner" + std::to_string(i);
            ASSERT_TRUE(records->add_owner(owner, 1));
            writers.emplace_back([&, owner, i] {
                const std::vector<Blob>& own = i % 2 == 0 ? blobs : backwards;
                for (int round = 0; round < 6; ++round) {
                    const std::string name = "document" + std::to_string(round);
                    done += records->create(owner, name, content(name, own), "", "", 1).result ==
                                    WriteResult::done
                                ? 1
                                : 0;
                    done += records->withdraw(owner, name, std::nullopt, true, 2).result ==
                                    WriteResult::done
                                ? 1
                                : 0;
                }
            });
        }
    }
    EXPECT_EQ(done, 8 * 6 * 2);
    EXPECT_EQ(cluster_->execute(database_, "SELECT count(*) FROM sporeprint.blob"), "0");
}

TEST_F(Postgres, OtherReplicasLearnOfChangesAtOnce) {
    const std::unique_ptr<Records> records = open(), replica = open();
    records->add_owner("kaja", 1);
    records->create("kaja", "bolete", content("first"), "", "", 1);
    std::stop_source stop;
    constexpr std::int64_t forever_ms = 600'000;
    replica->wait_for_change(stop.get_token(), forever_ms);  // begins to listen, and returns
    EXPECT_TRUE(replica->changes(0).empty());
    std::jthread publisher([&] { records->publish("kaja", "bolete", std::nullopt, {}, 2); });
    replica->wait_for_change(stop.get_token(), forever_ms);
    EXPECT_EQ(replica->changes(0).size(), 1U) << "the notice comes with the commit, not before";
    publisher.join();
    const std::jthread stopper([&] { stop.request_stop(); });
    replica->wait_for_change(stop.get_token(), forever_ms);
}

}  // namespace
}  // namespace sporeprint::server::records_postgres_test
