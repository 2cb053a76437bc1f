#include "server/operations/machine.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <thread>

#include "server/http/transport.h"
#include "server/operations/health.h"

namespace sporeprint::server::operations_machine_test {
namespace {

TEST(Machine, ReadsQuotas) {
    EXPECT_EQ(quota_in("150000 100000\n"), 1.5);
    EXPECT_EQ(quota_in("50000 100000"), 0.5);
    for (const char* none : {"max 100000", "", "max", "5", "x y", "0 100000", "100000 0", "-1 100"})
        EXPECT_FALSE(quota_in(none)) << none;
}

TEST(Machine, GrantsAtLeastOneProcessor) {
    EXPECT_GE(granted_processors(), 1u);
    EXPECT_LE(granted_processors(), 4096u);
}

TEST(Machine, ReportsTheUsageOfThisProcess) {
    const Usage used = usage();
    EXPECT_GT(used.resident_bytes, 1u << 20);
    EXPECT_GT(used.open_files, 2u);
    EXPECT_GT(used.started, 1.6e9);
    EXPECT_FALSE(program_folder().empty());
}

TEST(Machine, LowersThePriorityOfOneThreadOnly) {
    const auto niceness = [] { return getpriority(PRIO_PROCESS, static_cast<id_t>(gettid())); };
    const int own = niceness();
    int lowered = own;
    std::thread([&] {
        lower_thread_priority();
        lowered = niceness();
    }).join();
    EXPECT_EQ(lowered, std::max(own, 10));
    EXPECT_EQ(niceness(), own);
}

TEST(Health, IsTheStatusOfTheResponse) {
    TransportOptions options;
    options.port = 0;
    Handlers handlers;
    handlers.respond = [](const std::shared_ptr<PendingRequest>& pending) {
        api::Response response;
        response.status = pending->request().target == "/livez" ? 200 : 503;
        response.body = {slice_of("x")};
        pending->reply(std::move(response));
    };
    handlers.route = [](const api::Request&) {
        return std::make_shared<const api::RoutedRequest>();
    };
    handlers.served = [](const Served&) {};
    Transport transport(options, handlers);
    transport.start();
    const std::string base = "http://127.0.0.1:" + std::to_string(transport.port());
    std::string why;
    EXPECT_TRUE(is_healthy(base + "/livez", why)) << why;
    EXPECT_FALSE(is_healthy(base + "/readyz", why));
    EXPECT_NE(why.find("503"), std::string::npos);
    EXPECT_FALSE(is_healthy("http://127.0.0.1:1/", why));
    EXPECT_FALSE(is_healthy("https://127.0.0.1/", why));
    EXPECT_FALSE(is_healthy("http://no.such.host.invalid/", why));
    EXPECT_FALSE(is_healthy("http://[::1/", why));
    EXPECT_FALSE(is_healthy("", why));
}

}  // namespace
}  // namespace sporeprint::server::operations_machine_test
