// Placements of worlds over HTTP: three files with the same rows, and requests that name none.

#include "api/products/worlds/placements.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <string>
#include <vector>

#include "core/params/value.h"
#include "tests/api/support.h"

namespace sporeprint::api::products_world_placements_test {
namespace {

using test::header;
using test::json_of;
using test::names;
using test::text_of;

const std::string place = "/v1/worlds/beech,seed=7,extent=256/y80d270/placements";

class WorldPlacementsTest : public test::RequestedService {};

std::vector<std::vector<std::string>> rows_of(const std::string& csv) {
    std::vector<std::vector<std::string>> rows;
    std::istringstream lines(csv);
    for (std::string line; std::getline(lines, line);) {
        EXPECT_TRUE(line.ends_with('\r'));
        line.pop_back();
        std::vector<std::string>& row = rows.emplace_back();
        std::istringstream cells(line + ',');
        for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
    }
    return rows;
}

template <class T>
T at(const std::string& bytes, std::size_t offset) {
    T value{};
    std::memcpy(&value, bytes.data() + offset, sizeof(T));
    return value;
}

TEST_F(WorldPlacementsTest, HaveTheSameRowsInAllFiles) {
    const std::string query = "?bbox=-10,-10,10,10";
    const Response csv = ask(place + ".csv" + query);
    ASSERT_EQ(csv.status, 200) << text_of(csv);
    EXPECT_EQ(header(csv, "Content-Type"), "text/csv");
    EXPECT_NE(header(csv, "Content-Disposition").find("beech_placements_y80d270.csv"),
              std::string::npos);
    const auto rows = rows_of(text_of(csv));
    const Value json = json_of(ask(place + ".json" + query));
    const Value::Array& listed = json.find("placements")->items();
    const std::string bin = text_of(ask(place + ".bin" + query));
    ASSERT_GT(rows.size(), 20U);
    ASSERT_EQ(listed.size() + 1, rows.size());
    EXPECT_EQ(json.find("count")->as_number(), static_cast<double>(listed.size()));
    EXPECT_EQ(bin.substr(0, 4), "SPPL");
    EXPECT_EQ(at<std::uint32_t>(bin, 4), 1U);
    ASSERT_EQ(at<std::uint32_t>(bin, 8), listed.size());
    ASSERT_EQ(at<std::uint32_t>(bin, 12), 88U);
    const auto words = at<std::uint32_t>(bin, 16), length = at<std::uint32_t>(bin, 20);
    ASSERT_EQ(words, 24 + 88 * listed.size());
    ASSERT_EQ(words + length, bin.size());
    std::vector<Problem> problems;
    const Value texts = parse(bin.substr(words), problems);
    ASSERT_TRUE(problems.empty());
    for (std::size_t i = 0; i < listed.size(); ++i) {
        const auto& row = rows[i + 1];
        ASSERT_EQ(row.size(), rows[0].size());
        const Value& one = listed[i];
        EXPECT_EQ(row[0], one.find("id")->as_string());
        EXPECT_EQ(row[1], one.find("kind")->as_string());
        EXPECT_EQ(row[2], one.find("species")->as_string());
        EXPECT_EQ(row.back(), one.find("model") ? one.find("model")->as_string() : "");
        const std::size_t from = 24 + 88 * i;
        EXPECT_EQ(at<std::uint64_t>(bin, from), std::stoull(row[0], nullptr, 16));
        for (std::size_t k = 0; k < 3; ++k) {
            const double coordinate = one.find("translation")->items()[k].as_number();
            EXPECT_NEAR(std::stod(row[3 + k]), coordinate, 1e-9);
            EXPECT_NEAR(static_cast<double>(at<float>(bin, from + 24 + 4 * k)), coordinate, 1e-3);
        }
        EXPECT_LE(std::abs(std::stod(row[3])), 10.0 + 0.001);
        const auto kind = at<std::uint8_t>(bin, from + 84),
                   species = at<std::uint8_t>(bin, from + 85);
        const Value* list = texts.find(kind == 3 ? "species" : "kinds");
        EXPECT_EQ(list->items()[species].as_string(), row[2]);
    }
}

TEST_F(WorldPlacementsTest, LinkModelsThatExist) {
    const Value json = json_of(ask(place + ".json?bbox=-10,-10,10,10"));
    bool has_tree = false, has_fungus = false;
    for (const Value& one : json.find("placements")->items()) {
        bool& has = one.find("kind")->as_string() == "tree" ? has_tree : has_fungus;
        if (!one.find("model") || has) continue;
        has = true;
        const std::string& model = one.find("model")->as_string();
        const char* joint = model.find('?') == std::string::npos ? "?lod=3" : "&lod=3";
        EXPECT_EQ(ask(model + joint).status, 200) << model;
    }
    EXPECT_TRUE(has_tree);
    EXPECT_TRUE(has_fungus);
}

TEST_F(WorldPlacementsTest, AreThoseOfThePlot) {
    const Value plot = json_of(ask("/v1/worlds/beech,seed=7,extent=256/y80d270/plot.json?size=20"));
    const Value json = json_of(ask(place + ".json?bbox=-10,-10,10,10"));
    std::vector<std::string> of_plot, placed;
    for (const char* list : {"trees", "fruit_bodies"})
        for (const Value& one : plot.find(list)->items())
            of_plot.push_back(one.find("id")->as_string());
    for (const Value& one : json.find("placements")->items()) {
        const std::string& kind = one.find("kind")->as_string();
        if (kind == "tree" || kind == "fungus") placed.push_back(one.find("id")->as_string());
    }
    std::ranges::sort(of_plot);
    EXPECT_EQ(of_plot, placed);
}

TEST_F(WorldPlacementsTest, HaveOneAddressForOneMeaning) {
    const std::string all = header(ask(place + ".csv"), "ETag");
    EXPECT_EQ(header(ask(place + ".csv?bbox=-32,-32,32,32"), "ETag"), all);
    EXPECT_EQ(header(ask(place + ".csv?kinds=fungus+log+tree+snag"), "ETag"), all);
    const Response few = ask(place + ".csv?kinds=log+tree");
    EXPECT_NE(header(few, "Content-Location").find("kinds=tree%2Blog"), std::string::npos)
        << header(few, "Content-Location");
    for (const auto& row : rows_of(text_of(few)))
        EXPECT_TRUE(row[1] == "kind" || row[1] == "tree" || row[1] == "log");
    for (const auto& row :
         rows_of(text_of(ask(place + ".csv?kinds=fungus&species=fomes_fomentarius"))))
        EXPECT_TRUE(row[2] == "species" || row[2] == "fomes_fomentarius");
}

TEST_F(WorldPlacementsTest, RefuseOtherKindsSpeciesAndAreas) {
    EXPECT_TRUE(names(ask(place + ".csv?kinds=tree+stone"), "kinds", "none of tree"));
    EXPECT_TRUE(names(ask(place + ".csv?kinds=tree+tree"), "kinds", "named twice"));
    EXPECT_TRUE(names(ask(place + ".csv?kinds=tree+"), "kinds", "''"));
    EXPECT_TRUE(names(ask(place + ".csv?species=amanita_muscaria"), "species",
                      "does not live in this world"));
    EXPECT_TRUE(names(ask("/v1/worlds/beech/y80d270/placements.csv?bbox=-300,-300,300,300"), "bbox",
                      "without fungi"));
    EXPECT_EQ(ask("/v1/worlds/beech/y80d270/placements.csv?bbox=-300,-300,300,300").status, 422);
    EXPECT_TRUE(names(ask("/v1/worlds/beech,extent=4096/y80d270/placements.csv?kinds=tree&"
                          "bbox=-600,-600,600,600"),
                      "bbox", "at most 1000000"));
    EXPECT_TRUE(
        names(ask("/v1/worlds/beech,seed=7,extent=256/y80/placements.csv"), "time", "d270"));
}

}  // namespace
}  // namespace sporeprint::api::products_world_placements_test
