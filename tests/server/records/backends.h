// Every kind of database that stores documents, each empty for one test.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <string>

#include "tests/server/records/contract.h"
#include "tests/server/records/postgres_cluster.h"

namespace sporeprint::server::test {

class SqliteBackend final : public Backend {
  public:
    [[nodiscard]] std::string library() const override { return (folder_ / "test.db").string(); }
    bool contains(const std::string& bytes) override {
        return folder_.bytes().find(bytes) != std::string::npos;
    }

  private:
    TemporaryFolder folder_;
};

class PostgresBackend final : public Backend {
  public:
    [[nodiscard]] std::string library() const override { return cluster_.address(database_); }
    /// PostgreSQL overwrites deleted bytes when it needs their space, so that no test can tell by its files.
    bool contains(const std::string& bytes) override {
        const std::string dump = cluster_.dump(database_);
        std::string digits;
        for (const char byte : bytes) {
            constexpr const char* hexadecimal = "0123456789abcdef";
            digits += hexadecimal[static_cast<unsigned char>(byte) >> 4U];
            digits += hexadecimal[static_cast<unsigned char>(byte) & 15U];
        }
        return dump.find(bytes) != std::string::npos || dump.find(digits) != std::string::npos;
    }

  private:
    PostgresCluster& cluster_ = PostgresCluster::instance();
    std::string database_ = cluster_.new_database();
};

/// All of them, for INSTANTIATE_TEST_SUITE_P.
inline constexpr std::array backends = {
    NamedBackend{"Sqlite", [] { return true; },
                 []() -> std::unique_ptr<Backend> { return std::make_unique<SqliteBackend>(); }},
    NamedBackend{"Postgres", PostgresCluster::is_installed,
                 []() -> std::unique_ptr<Backend> { return std::make_unique<PostgresBackend>(); }},
};

/// Returns the name of a backend for the names of tests.
inline std::string name_of_backend(const testing::TestParamInfo<NamedBackend>& one) {
    return one.param.name;
}

}  // namespace sporeprint::server::test
