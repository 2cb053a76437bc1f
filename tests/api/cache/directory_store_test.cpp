#include "api/cache/directory_store.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <fstream>
#include <thread>
#include <vector>

#include "api/service.h"
#include "core/problems.h"

namespace sporeprint::api::cache_directory_store_test {
namespace {

namespace fs = std::filesystem;

/// A new folder, gone with all that is in it at the end.
class Folder {
  public:
    Folder() {
        std::string name = (fs::temp_directory_path() / "sporeprint-store-XXXXXX").string();
        path_ = mkdtemp(name.data());
    }
    ~Folder() { fs::remove_all(path_); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    [[nodiscard]] const fs::path& path() const { return path_; }
    [[nodiscard]] std::vector<fs::path> files() const {
        std::vector<fs::path> found;
        for (const auto& entry : fs::recursive_directory_iterator(path_))
            if (entry.is_regular_file() && entry.path().filename() != "bound")
                found.push_back(entry.path());
        return found;
    }
    [[nodiscard]] std::uint64_t bytes() const {
        std::uint64_t sum = 0;
        for (const fs::path& file : files()) sum += fs::file_size(file);
        return sum;
    }

  private:
    fs::path path_;
};

std::string text_of(const Slice& slice) {
    return {reinterpret_cast<const char*>(slice.data()), slice.size};
}

std::string found_in(DirectoryStore& store, std::string_view key) {
    const std::optional<Slice> body = store.find(key);
    return body ? text_of(*body) : "(none)";
}

TEST(DirectoryStore, GivesBackWhatWasWrittenAlsoToTheNextProcess) {
    const Folder folder;
    {
        DirectoryStore store(folder.path() / "made" / "by itself", 1 << 20);
        store.insert("a", {slice_of("one "), slice_of("body"), slice_of("")});
        store.insert("empty", {});
        EXPECT_EQ(found_in(store, "a"), "one body");
        EXPECT_EQ(found_in(store, "b"), "(none)");
    }
    DirectoryStore next(folder.path() / "made" / "by itself", 1 << 20);
    EXPECT_EQ(next.stats().entries, 2u);
    EXPECT_EQ(next.stats().bytes, folder.bytes());
    EXPECT_EQ(found_in(next, "a"), "one body");
    EXPECT_EQ(found_in(next, "empty"), "");
    EXPECT_EQ(next.stats().hits, 2u);
    EXPECT_EQ(next.stats().misses, 0u);
}

TEST(DirectoryStore, SharesItsFolderWithOtherProcesses) {
    const Folder folder;
    DirectoryStore one(folder.path(), 1 << 20), other(folder.path(), 1 << 20);
    one.insert("a", {slice_of("body")});
    EXPECT_EQ(found_in(other, "a"), "body");
    EXPECT_EQ(other.stats().entries, 1u);
    for (const fs::path& file : folder.files()) fs::remove(file);
    EXPECT_EQ(found_in(one, "a"), "(none)");
    EXPECT_EQ(one.stats().entries, 0u);
    EXPECT_EQ(one.stats().damaged, 0u);
}

TEST(DirectoryStore, HasTheBoundOfItsFolder) {
    const Folder folder;
    std::vector<StoreEvent> events;
    const auto report = [&](const StoreEvent& event) { events.push_back(event); };
    {
        DirectoryStore first(folder.path(), 1 << 20, report);
        for (int i = 0; i < 8; ++i)
            first.insert(std::to_string(i), {slice_of(std::string(20'000, 'x'))});
        EXPECT_TRUE(events.empty());
        DirectoryStore second(folder.path(), 50'000, report);
        EXPECT_EQ(second.most_bytes(), std::uint64_t{1} << 20);
        ASSERT_EQ(events.size(), 1U);
        EXPECT_EQ(events[0].kind, StoreEvent::Kind::bound);
        EXPECT_NE(events[0].why.find("1048576"), std::string::npos) << events[0].why;
        for (int i = 0; i < 8; ++i) EXPECT_NE(found_in(second, std::to_string(i)), "(none)") << i;
    }
    DirectoryStore alone(folder.path(), 50'000, report);
    EXPECT_EQ(events.size(), 1U);
    EXPECT_EQ(alone.most_bytes(), 50'000U);
    EXPECT_LE(folder.bytes(), 50'000U);
}

TEST(DirectoryStore, EvictsWhatNoProcessHasUsedForLongest) {
    const Folder folder;
    const std::uint64_t most = 40'000;
    DirectoryStore one(folder.path(), most), other(folder.path(), most);
    const auto body = [] { return std::string(2'000, 'x'); };
    for (int i = 0; i < 8; ++i) one.insert("one " + std::to_string(i), {slice_of(body())});
    for (int i = 0; i < 6; ++i) other.insert("other " + std::to_string(i), {slice_of(body())});
    // What one process wrote the other uses.
    EXPECT_NE(found_in(other, "one 0"), "(none)");
    for (int i = 8; i < 30; ++i) {
        (i % 2 ? one : other).insert("more " + std::to_string(i), {slice_of(body())});
        EXPECT_NE(found_in(other, "one 0"), "(none)") << i;
        EXPECT_LE(folder.bytes(), most + most / 16 + 2'200) << i;
    }
    EXPECT_EQ(found_in(one, "one 1"), "(none)");
    EXPECT_EQ(found_in(one, "other 0"), "(none)");
    EXPECT_GT(folder.bytes(), most / 2);
}

TEST(DirectoryStore, LeavesAloneWhatOthersAreWriting) {
    const Folder folder;
    DirectoryStore first(folder.path(), 1 << 20);
    const fs::path fresh = folder.path() / "aside" / "fresh.0",
                   old = folder.path() / "aside" / "old.0";
    std::ofstream(fresh) << "half";
    std::ofstream(old) << "half";
    fs::last_write_time(old, fs::file_time_type::clock::now() - std::chrono::hours(2));
    DirectoryStore second(folder.path(), 1 << 20);
    EXPECT_TRUE(fs::exists(fresh));
    EXPECT_FALSE(fs::exists(old)) << "of a process that died";
}

TEST(DirectoryStore, RemovesWhatIsNotWhatWasWritten) {
    const Folder folder;
    DirectoryStore store(folder.path(), 1 << 20);
    const std::string body(1000, 'x');
    store.insert("key", {slice_of(body)});
    const fs::path file = folder.files().front();
    std::string whole;
    {
        std::ifstream stream(file, std::ios::binary);
        whole.assign(std::istreambuf_iterator<char>(stream), {});
    }
    std::uint64_t damaged = 0;
    const auto gone_after = [&](const std::string& changed) {
        std::ofstream(file, std::ios::binary) << changed;
        EXPECT_EQ(found_in(store, "key"), "(none)");
        EXPECT_FALSE(fs::exists(file));
        EXPECT_EQ(store.stats().damaged, ++damaged);
        EXPECT_EQ(store.stats().entries, 0u);
    };
    // Each byte of the preamble and some of the body, each length.
    for (std::size_t i = 0; i < whole.size(); i += i < 100 ? 1 : 97) {
        std::string changed = whole;
        changed[i] = static_cast<char>(changed[i] ^ 1);
        gone_after(changed);
    }
    for (const std::size_t length :
         {std::size_t{0}, std::size_t{5}, std::size_t{13}, std::size_t{60}, whole.size() - 1})
        gone_after(whole.substr(0, length));
    gone_after(whole + "x");
    store.insert("key", {slice_of(body)});
    EXPECT_EQ(found_in(store, "key"), body);
}

TEST(DirectoryStore, KnowsKeysApartWhoseHashIsOne) {
    const Folder folder;
    DirectoryStore store(folder.path(), 1 << 20);
    store.insert("key", {slice_of("body")});
    // As if "other" had the hash of "key": the file under its name is another's.
    const fs::path file = folder.files().front();
    store.insert("other", {slice_of("another body")});
    for (const fs::path& one : folder.files())
        if (one != file) fs::copy_file(file, one, fs::copy_options::overwrite_existing);
    EXPECT_EQ(found_in(store, "other"), "(none)");
    EXPECT_EQ(found_in(store, "key"), "body");
}

TEST(DirectoryStore, KeepsItsBoundAndDropsWhatWasNotUsedForLongest) {
    const Folder folder;
    const std::uint64_t most = 20'000;
    {
        DirectoryStore store(folder.path(), most);
        for (int i = 0; i < 8; ++i) {
            store.insert(std::to_string(i), {slice_of(std::string(2000, 'x'))});
            EXPECT_NE(found_in(store, "0"), "(none)") << i;
        }
        EXPECT_EQ(store.stats().evictions, 0u);
        for (int i = 8; i < 12; ++i)
            store.insert(std::to_string(i), {slice_of(std::string(2000, 'x'))});
        EXPECT_GT(store.stats().evictions, 0u);
        EXPECT_LE(folder.bytes(), most);
        EXPECT_EQ(store.stats().bytes, folder.bytes());
        EXPECT_EQ(found_in(store, "1"), "(none)");
        EXPECT_NE(found_in(store, "0"), "(none)");
        store.insert("large", {slice_of(std::string(most / 8, 'x'))});
        EXPECT_EQ(found_in(store, "large"), "(none)") << "an eighth of the bound is the most";
    }
    DirectoryStore smaller(folder.path(), 5'000);
    EXPECT_LE(folder.bytes(), 5'000u);
    EXPECT_NE(found_in(smaller, "0"), "(none)") << "the last that was asked for";
}

TEST(DirectoryStore, ClearsWhatAProcessLeftHalfWrittenAndTouchesNothingOfOthers) {
    const Folder folder;
    { DirectoryStore store(folder.path(), 1 << 20); }
    std::ofstream(folder.path() / "aside" / "0123.77.0") << "half";
    fs::create_directories(folder.path() / "ab");
    std::ofstream(folder.path() / "ab" / "notes.txt") << "mine";
    std::ofstream(folder.path() / "stranger.body") << "mine";
    DirectoryStore store(folder.path(), 1);
    EXPECT_EQ(folder.files().size(), 2u);
    EXPECT_EQ(store.stats().entries, 0u);
}

/// A file of a name that the store gives, with other contents.
fs::path named_as_ours(const fs::path& folder, char digit) {
    const std::string name(32, digit);
    fs::create_directories(folder / name.substr(0, 2));
    return folder / name.substr(0, 2) / (name + ".body");
}

TEST(DirectoryStore, CountsNothingThatItCannotHaveWritten) {
    const Folder folder;
    {
        DirectoryStore store(folder.path(), 1 << 20);
        for (int i = 0; i < 4; ++i)
            store.insert(std::to_string(i), {slice_of(std::string(100'000, 'x'))});
    }
    // Two sparse files, one of 20 GB and one that would not be too large; one that is too large; a
    // link; files of other names.
    const fs::path huge = named_as_ours(folder.path(), 'a');
    std::ofstream(huge) << "x";
    fs::resize_file(huge, std::uintmax_t{20} << 30);
    const fs::path sparse = named_as_ours(folder.path(), 'b');
    std::ofstream(sparse) << "x";
    fs::resize_file(sparse, (1 << 20) / 8);
    const fs::path large = named_as_ours(folder.path(), 'c');
    std::ofstream(large) << std::string((1 << 20) / 8 + 1, 'x');
    const fs::path link = named_as_ours(folder.path(), 'd');
    fs::create_symlink(huge, link);
    fs::create_directories(folder.path() / "zz");
    for (const char* other : {"zz/zz.body", "zz/notes.txt"})
        std::ofstream(folder.path() / other) << std::string(900'000, 'x');

    std::vector<StoreEvent> events;
    DirectoryStore store(folder.path(), 1 << 20,
                         [&](const StoreEvent& event) { events.push_back(event); });
    EXPECT_EQ(store.stats().entries, 4u);
    EXPECT_EQ(store.stats().evictions, 0u);
    EXPECT_LT(store.stats().bytes, 500'000u);
    for (int i = 0; i < 4; ++i) EXPECT_NE(found_in(store, std::to_string(i)), "(none)") << i;
    for (const fs::path& foreign : {huge, sparse, large, link, folder.path() / "zz/zz.body"})
        EXPECT_TRUE(fs::exists(fs::symlink_status(foreign))) << foreign;
    ASSERT_EQ(events.size(), 1u) << "all in one";
    EXPECT_EQ(events[0].kind, StoreEvent::Kind::foreign);
    EXPECT_EQ(events[0].files, 6u);
    EXPECT_TRUE(fs::exists(fs::symlink_status(events[0].file)));
}

TEST(DirectoryStore, LeavesAStoreWithinItAlone) {
    const Folder folder;
    {
        DirectoryStore within(folder.path() / "within", 1 << 20);
        EXPECT_TRUE(within.insert("inner", {slice_of("of the inner one")}));
    }
    std::vector<StoreEvent> events;
    DirectoryStore store(folder.path(), 1 << 20,
                         [&](const StoreEvent& event) { events.push_back(event); });
    EXPECT_EQ(store.stats().entries, 0u);
    EXPECT_TRUE(events.empty());
    DirectoryStore within(folder.path() / "within", 1 << 20);
    EXPECT_EQ(found_in(within, "inner"), "of the inner one");
}

TEST(DirectoryStore, TellsWhatItHoldsAndWhatItCouldNotWrite) {
    const Folder folder;
    DirectoryStore store(folder.path(), 1 << 20);
    EXPECT_FALSE(store.holds("one"));
    EXPECT_TRUE(store.insert("one", {slice_of("a body")}));
    EXPECT_TRUE(store.holds("one"));
    EXPECT_FALSE(store.insert("large", {slice_of(std::string((1 << 20) / 8, 'x'))}));
    EXPECT_FALSE(store.holds("large"));
    EXPECT_EQ(store.stats().hits, 0u) << "asking is no use";
}

TEST(DirectoryStore, KeepsWhatItWroteUnderALargerBoundAsFarAsItHasRoom) {
    const Folder folder;
    {
        DirectoryStore store(folder.path(), 8 << 20);
        store.insert("large", {slice_of(std::string(900'000, 'x'))});
        store.insert("small", {slice_of("body")});
    }
    std::vector<StoreEvent> events;
    const auto report = [&](const StoreEvent& event) { events.push_back(event); };
    {
        DirectoryStore store(folder.path(), 1 << 20, report);
        EXPECT_EQ(found_in(store, "large").size(), 900'000u);
        EXPECT_EQ(found_in(store, "small"), "body");
    }
    DirectoryStore store(folder.path(), 500'000, report);
    EXPECT_EQ(store.stats().entries, 1u);
    EXPECT_EQ(store.stats().evictions, 1u);
    EXPECT_EQ(found_in(store, "small"), "body") << "not evicted for what has no room anyway";
    EXPECT_EQ(folder.files().size(), 1u);
    EXPECT_TRUE(events.empty());
}

TEST(DirectoryStore, FindsNothingInItsOwnThatHaveGrownAndReadsNothingThatIsHuge) {
    const Folder folder;
    {
        DirectoryStore store(folder.path(), 1 << 20);
        store.insert("a", {slice_of("body")});
    }
    fs::resize_file(folder.files().front(), 120'000);
    DirectoryStore store(folder.path(), 1 << 20);
    EXPECT_EQ(found_in(store, "a"), "(none)");
    EXPECT_EQ(store.stats().damaged, 1u);
    EXPECT_TRUE(folder.files().empty());

    store.insert("a", {slice_of("body")});
    fs::resize_file(folder.files().front(), std::uintmax_t{20} << 30);
    EXPECT_EQ(found_in(store, "a"), "(none)");
    store.insert("a", {slice_of("body")});
    EXPECT_EQ(found_in(store, "a"), "body") << "written anew";

    fs::resize_file(folder.files().front(), std::uintmax_t{20} << 30);
    DirectoryStore next(folder.path(), 1 << 20);
    EXPECT_TRUE(folder.files().empty());
    EXPECT_EQ(next.stats().evictions, 1u);
    EXPECT_EQ(next.stats().entries, 0u);
}

TEST(DirectoryStore, AFolderThatCannotBeWrittenIsNamed) {
    const Folder folder;
    std::ofstream(folder.path() / "file") << "no folder";
    try {
        DirectoryStore store(folder.path() / "file", 1 << 20);
        FAIL() << "made in a file";
    } catch (const InvalidInput& error) {
        EXPECT_EQ(error.problems().front().path, (folder.path() / "file").string());
    }
}

TEST(DirectoryStore, AFullDiskLosesNothingButWhatWasNotWritten) {
    const Folder folder;
    std::vector<StoreEvent> events;
    DirectoryStore store(folder.path(), 1 << 20,
                         [&](const StoreEvent& event) { events.push_back(event); });
    store.insert("before", {slice_of("body")});
    // A limit on the size of files stands for the end of a disk: writing stops in the middle.
    rlimit limit{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &limit), 0);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{4096, limit.rlim_max};
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
    store.insert("key", {slice_of(std::string(50'000, 'x'))});
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limit), 0);
    std::signal(SIGXFSZ, handler);
    EXPECT_EQ(store.stats().unwritten, 1u);
    ASSERT_EQ(events.size(), 1u);
    EXPECT_EQ(events[0].kind, StoreEvent::Kind::unwritten);
    EXPECT_EQ(events[0].why, "File too large");
    EXPECT_EQ(events[0].file.extension(), ".body");
    EXPECT_EQ(found_in(store, "key"), "(none)");
    EXPECT_EQ(found_in(store, "before"), "body");
    EXPECT_EQ(folder.files().size(), 1u) << "nothing is left aside";
    store.insert("key", {slice_of(std::string(50'000, 'x'))});
    EXPECT_EQ(found_in(store, "key"), std::string(50'000, 'x'));
}

TEST(DirectoryStore, NeverGivesAWrongBodyWhoeverWritesAtOnce) {
    const Folder folder;
    DirectoryStore one(folder.path(), 60'000), other(folder.path(), 60'000);
    const auto body_of = [](std::size_t i) {
        return std::string(100 + 97 * i, static_cast<char>('a' + i));
    };
    std::atomic<std::size_t> wrong{0}, hits{0};
    std::vector<std::jthread> threads;
    for (std::size_t t = 0; t < 8; ++t)
        threads.emplace_back([&, t] {
            for (std::size_t i = 0; i < 200; ++i) {
                DirectoryStore& store = (i + t) % 2 ? one : other;
                const std::size_t which = (i * 7 + t * 3) % 24;
                const std::string key = "key " + std::to_string(which);
                if (const std::optional<Slice> body = store.find(key)) {
                    ++hits;
                    if (text_of(*body) != body_of(which)) ++wrong;
                } else {
                    store.insert(key, {slice_of(body_of(which))});
                }
            }
        });
    threads.clear();
    EXPECT_EQ(wrong, 0u);
    EXPECT_GT(hits, 0u);
    EXPECT_LE(one.stats().bytes, 60'000u);
    EXPECT_LE(other.stats().bytes, 60'000u);
}

TEST(ServiceWithAStore, BeginsWarmWithTheSameBytesAndHeaders) {
    const Folder folder;
    ServiceOptions options;
    options.store = folder.path();
    Request request{.method = "GET",
                    .target = "/v1/mushrooms/russula_vinosa.glb?lod=3&texture_size=128",
                    .headers = {},
                    .body = {},
                    .id = {}};
    const auto requested = [&](Service& service) { return handle(service, request); };
    const auto header = [](const Response& response, std::string_view name) {
        for (const auto& [one, value] : response.headers)
            if (one == name) return value;
        return std::string();
    };
    const auto bytes = [](const Response& response) {
        std::string text;
        for (const Slice& slice : response.body) text += text_of(slice);
        return text;
    };
    Service first(built_in_atlas(), options);
    const Response generated = requested(first);
    ASSERT_EQ(generated.status, 200);
    EXPECT_EQ(first.counters().generated, 1u);
    EXPECT_EQ(first.counters().store_misses, 1u);

    Service second(built_in_atlas(), options);
    const Response cached = requested(second);
    EXPECT_EQ(cached.status, 200);
    EXPECT_EQ(bytes(cached), bytes(generated));
    for (const char* name : {"ETag", "Content-Type", "Content-Location", "Cache-Control"})
        EXPECT_EQ(header(cached, name), header(generated, name)) << name;
    EXPECT_EQ(header(cached, "Cache-Status"),
              "sporeprint-store; hit, sporeprint; fwd=miss; stored");
    EXPECT_EQ(second.counters().generated, 0u);
    EXPECT_EQ(second.counters().store_hits, 1u);
    EXPECT_EQ(header(requested(second), "Cache-Status"), "sporeprint; hit");

    for (const fs::path& file : folder.files()) std::ofstream(file, std::ios::app) << "damage";
    Service third(built_in_atlas(), options);
    EXPECT_EQ(bytes(requested(third)), bytes(generated));
    EXPECT_EQ(third.counters().generated, 1u);
    EXPECT_EQ(third.counters().store_damaged, 1u);
    EXPECT_EQ(Service(built_in_atlas(), options).counters().store_entries, 1u) << "written again";
}

}  // namespace
}  // namespace sporeprint::api::cache_directory_store_test
