#include "core/params/corners.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "tests/core/params/sample.h"

namespace sporeprint::params_corners_test {
namespace {

using sample::Request;

TEST(Corners, VisitEveryLeafAtItsExtremesAndRestoreIt) {
    Request request;
    std::map<std::string, int> visits;
    double widest = 0.0;
    corners(request, [&](const std::string& path) {
        ++visits[path];
        for (const Problem& problem : problems_in(request))
            EXPECT_EQ(problem.message, "must be smaller than /cap/radius") << path;
        if (path == "/span") widest = std::max(widest, request.span.to - request.span.from);
    });
    EXPECT_EQ(request, Request{});
    EXPECT_EQ(visits["/seed"], 2);
    EXPECT_EQ(visits["/has_ring"], 2);
    EXPECT_EQ(visits["/animation"], 2);
    EXPECT_EQ(visits["/texture_size"], 4);
    EXPECT_EQ(visits["/cap/colour"], 2);
    EXPECT_EQ(visits["/r"], 2) << "inlined";
    EXPECT_EQ(visits["/deformation/low/bend_deg"], 3) << "unset and both ends";
    EXPECT_EQ(visits["/spare/radius"], 2) << "inside an optional struct";
    EXPECT_EQ(visits["/model/form"], 2);
    EXPECT_EQ(visits["/model/outline/1/y"], 2);
    EXPECT_EQ(visits["/model/forks"], 2);
    EXPECT_EQ(visits["/wind/2"], 2);
    EXPECT_EQ(visits["/profile/0"], 2);
    EXPECT_EQ(visits["/span"], 3);
    EXPECT_EQ(widest, 1.0);
}

}  // namespace
}  // namespace sporeprint::params_corners_test
