#include "server/bake/bake.h"

#include <algorithm>
#include <atomic>
#include <charconv>
#include <cstdio>
#include <exception>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "api/http/response_text.h"
#include "server/bake/aside_file.h"
#include "server/bake/item_stream.h"
#include "server/bake/shard.h"
#include "server/operations/text_files.h"

namespace sporeprint::server {

namespace fs = std::filesystem;

namespace {

/// Holds what a folder is of.
constexpr const char* set_file = "bake.json";

/// Items that are looked at before anything is made.
constexpr std::uint64_t looked_at = 16;

/// An end with its reason.
struct Ended {
    BakeEnd how;
    std::string why;
};

void say(const std::string& sentence) {
    std::fprintf(stderr, "sporeprint bake: %s\n", sentence.c_str());
}

/// The share of the shards that a process makes.
struct Share {
    std::uint64_t which = 0, of = 1;
};

Share share_of(const std::string& text) {
    Share out;
    const char* const end = text.data() + text.size();
    const auto first = std::from_chars(text.data(), end, out.which);
    const bool has_slash = first.ec == std::errc() && first.ptr != end && *first.ptr == '/';
    const auto second = has_slash ? std::from_chars(first.ptr + 1, end, out.of) : first;
    if (!has_slash || second.ec != std::errc() || second.ptr != end || out.of < 1 ||
        out.which >= out.of)
        throw Ended{BakeEnd::wrong_usage, "--shard: \"" + text +
                                              "\" is not allowed; allowed is i/n with 0 <= i < n, "
                                              "such as 0/4"};
    return out;
}

template <class Choice>
Choice choice_of(const char* flag, const std::string& text,
                 std::initializer_list<std::pair<std::string_view, Choice>> choices) {
    std::string allowed;
    for (const auto& [name, choice] : choices) {
        if (text == name) return choice;
        allowed += (allowed.empty() ? "" : ", ") + std::string(name);
    }
    throw Ended{BakeEnd::wrong_usage,
                std::string(flag) + ": \"" + text + "\" is not allowed; there are " + allowed};
}

std::optional<api::BatchManifest> manifest_in(const std::string& file) {
    const std::optional<std::string> text = read_text(file);
    if (!text) throw Ended{BakeEnd::wrong_usage, file + " cannot be read"};
    try {
        return api::BatchManifest(*text);
    } catch (const InvalidInput& invalid) {
        std::string all;
        for (const Problem& problem : invalid.problems())
            all += (all.empty() ? "" : "\nsporeprint bake: ") + file + ": " +
                   (problem.path.empty() ? "" : problem.path + ": ") + problem.message;
        throw Ended{BakeEnd::wrong_usage, all};
    }
}

/// Ends it if nothing can be made of any of the first items: then it is the manifest that is wrong.
void look_at_first(api::Service& service, const api::BatchManifest& manifest) {
    std::string problem;
    for (std::uint64_t i = 0; i < std::min(manifest.count(), looked_at); ++i) {
        api::Request request;
        request.method = "GET";
        request.target = manifest.item(i).target;
        const api::Plan plan = api::plan_here(service, request);
        const auto* const response = std::get_if<api::Response>(&plan);
        if (response == nullptr || response->status < 400) return;
        if (!problem.empty()) continue;
        problem = "nothing can be made of " + request.target + ": " + api::text_of(response->body);
    }
    throw Ended{BakeEnd::wrong_usage, problem};
}

/// Returns what a folder is of, as it stands in it.
std::string text_of(const BakeSet& set) {
    Value out = Value::object();
    out.set("manifest_sha256", Value(set.manifest))
        .set("version", Value(set.version))
        .set("layout", Value(set.layout == BakeLayout::tar ? "tar" : "files"))
        .set("items", Value(set.count))
        .set("per_shard", Value(set.per_shard))
        .set("shards", Value(set.shards()));
    return dump(out, 2) + "\n";
}

/// Returns the layout of the set in a folder; that of archives if there is none.
std::string layout_in(const fs::path& folder) {
    std::vector<Problem> problems;
    const Value set = parse(read_text(folder / set_file).value_or("{}"), problems);
    const Value* const layout = set.find("layout");
    return layout != nullptr && layout->is_string() ? layout->as_string() : "tar";
}

/// Makes a folder that of a set.
void claim(const BakeSet& set) {
    std::error_code error;
    fs::create_directories(set.folder / "aside", error);
    if (error == std::errc::not_a_directory || error == std::errc::file_exists)
        throw Ended{BakeEnd::wrong_usage,
                    "--out: " + set.folder.string() + " is no folder, or is below a file"};
    if (error)
        throw std::runtime_error(set.folder.string() + " cannot be written: " + error.message());
    const fs::path path = set.folder / set_file;
    const std::string own = text_of(set);
    std::optional<std::string> found = read_text(path);
    if (!found) {
        AsideFile file(path);
        file.write(own);
        if (!file.commit_first()) found = read_text(path);
    }
    if (found && *found != own)
        throw Ended{BakeEnd::other_set, set.folder.string() +
                                            " is of another manifest, generator or layout; " +
                                            path.string() + " says which"};
}

/// Calls a function for all numbers below a count, on several threads.
void for_each_shard(std::uint64_t count, std::size_t threads,
                    const std::function<void(std::uint64_t)>& call) {
    std::atomic<std::uint64_t> next{0};
    std::mutex mutex;
    std::exception_ptr error;
    std::vector<std::jthread> workers;
    for (std::size_t i = 0; i < threads; ++i)
        workers.emplace_back([&] {
            for (std::uint64_t shard = 0; (shard = next++) < count;) try {
                    call(shard);
                } catch (...) {
                    const std::lock_guard lock(mutex);
                    error = std::current_exception();
                    next = count;
                }
        });
    workers.clear();
    if (error) std::rethrow_exception(error);
}

/// Writes the list of all files of the layout of files.
void write_list(const BakeSet& set) {
    AsideFile file(set.folder / "manifest.json");
    file.write("{\"version\":" + json_string(set.version) + ",\"items\":[");
    bool is_first = true;
    for (std::uint64_t shard = 0; shard < set.shards(); ++shard)
        for_each_line(set, shard, [&](const Value& line) {
            file.write((is_first ? "\n" : ",\n") + dump(line));
            is_first = false;
        });
    file.write("\n]}\n");
    file.commit();
}

/// Checks all shards and writes the sums of the folder.
BakeEnd finish(const BakeSet& set, std::size_t threads) {
    std::vector<std::string> damage(set.shards());
    std::vector<ShardHead> heads(set.shards());
    for_each_shard(set.shards(), threads, [&](std::uint64_t shard) {
        damage[shard] = damage_of(set, shard);
        if (damage[shard].empty()) heads[shard] = *head_of(set, shard);
    });
    std::uint64_t wrong = 0, failed = 0;
    for (std::uint64_t shard = 0; shard < set.shards(); ++shard) {
        failed += heads[shard].failed;
        if (damage[shard].empty()) continue;
        ++wrong;
        say("shard " + std::to_string(shard) + ": " + damage[shard]);
        // A damaged shard is made anew by the next run.
        std::error_code gone;
        fs::remove(set.index_of(shard), gone);
    }
    remove_left_aside(set.folder / "aside");
    if (wrong > 0) {
        say(grouped(wrong) + " of " + grouped(set.shards()) +
            " shards are missing or were damaged; the command without --finish makes them");
        return BakeEnd::unfinished;
    }
    AsideFile sums(set.folder / "SHA256SUMS");
    const auto add = [&](const std::string& name, const std::string& sha256) {
        sums.write(sha256 + "  " + name + "\n");
    };
    for (std::uint64_t shard = 0; shard < set.shards(); ++shard) {
        const std::string index = BakeSet::name_of(shard, "jsonl");
        add(index, digest_of_file(set.folder / index).sha256);
        if (set.layout == BakeLayout::tar) {
            add(BakeSet::name_of(shard, "tar"), heads[shard].sha256);
            continue;
        }
        for_each_line(set, shard, [&](const Value& line) {
            if (const Value* const file = line.find("file"))
                add(file->as_string(), line.find("sha256")->as_string());
        });
    }
    if (set.layout == BakeLayout::files) {
        write_list(set);
        add("manifest.json", digest_of_file(set.folder / "manifest.json").sha256);
    }
    add(set_file, digest_of_file(set.folder / set_file).sha256);
    sums.commit();
    say(grouped(set.count) + " items in " + grouped(set.shards()) + " shards are complete" +
        (failed > 0 ? ", " + grouped(failed) + " of them failed, as their indices say" : ""));
    return failed > 0 ? BakeEnd::some_failed : BakeEnd::complete;
}

/// Says so if there are more processes than shards, some of which then have nothing to do.
void warn_of_idle(const BakeSet& set, const Share& share) {
    if (share.of <= set.shards() || share.which != 0) return;
    const std::uint64_t best = std::max<std::uint64_t>(1, set.count / share.of);
    say("there are " + grouped(set.shards()) + " shards, so " + grouped(share.of - set.shards()) +
        " of " + grouped(share.of) + " processes have nothing to do; \"per_shard\": " +
        std::to_string(best) + " in the manifest gives work to all");
}

/// Makes the shards of a share that are not there.
BakeEnd make(const BakeSet& set, const Share& share, const ItemSource& source, std::size_t threads,
             ProgressStyle style, const std::function<bool()>& stop) {
    std::vector<ItemRange> ranges;
    std::vector<std::uint64_t> shards;
    std::uint64_t items = 0, there = 0;
    for (std::uint64_t shard = share.which; shard < set.shards(); shard += share.of) {
        const ItemRange range{set.first_of(shard), set.end_of(shard)};
        if (head_of(set, shard)) {
            there += range.end - range.begin;
            continue;
        }
        shards.push_back(shard);
        ranges.push_back(range);
        items += range.end - range.begin;
    }
    BakeProgress progress(style, items, there);
    ItemStream stream(ranges, source, threads);
    for (std::size_t i = 0; i < shards.size(); ++i) {
        ShardWriter writer(set, shards[i]);
        for (std::uint64_t number = ranges[i].begin; number < ranges[i].end; ++number) {
            if (stop()) {
                progress.finish();
                throw Ended{BakeEnd::impossible,
                            "ended by a signal; the same command goes on where it was"};
            }
            const BakedItem item = stream.next();
            writer.add(item);
            progress.count(item.failed(), size_of(item.body));
        }
        writer.commit();
    }
    progress.finish();
    return BakeEnd::complete;
}

BakeEnd run(const BakeCommand& command, api::Service& service, const std::string& version,
            std::size_t threads, const std::function<bool()>& stop) {
    const Share share = share_of(command.shard);
    const auto layout = choice_of<BakeLayout>(
        "--layout", command.layout.empty() ? layout_in(command.out) : command.layout,
        {{"tar", BakeLayout::tar}, {"files", BakeLayout::files}});
    const auto style = choice_of<ProgressStyle>("--progress", command.progress,
                                                {{"line", ProgressStyle::line},
                                                 {"json", ProgressStyle::json},
                                                 {"none", ProgressStyle::none}});
    const std::optional<api::BatchManifest> manifest = manifest_in(command.manifest);
    const std::string& generator = manifest->generator();
    if (!generator.empty() && version != generator && !version.starts_with(generator + "-"))
        throw Ended{BakeEnd::wrong_usage, command.manifest +
                                              ": /generator: " + json_string(generator) +
                                              " is not this one, which is " + version};
    BakeSet set;
    set.folder = command.out;
    set.manifest = manifest->digest();
    set.version = version;
    set.layout = layout;
    set.labels = manifest->has_labels();
    set.count = manifest->count();
    set.per_shard = manifest->per_shard();
    if (!command.finish) look_at_first(service, *manifest);
    std::error_code error;
    if (command.finish && !fs::is_directory(set.folder, error))
        throw Ended{BakeEnd::wrong_usage,
                    "--out: there is no folder " + set.folder.string() + " to finish"};
    claim(set);
    if (command.finish) return finish(set, threads);
    warn_of_idle(set, share);
    return make(
        set, share, [&](std::uint64_t number) { return baked_item(service, *manifest, number); },
        threads, style, stop);
}

}  // namespace

BakeEnd bake(const BakeCommand& command, api::Service& service, const std::string& version,
             std::size_t threads, const std::function<bool()>& stop) {
    try {
        return run(command, service, version, threads, stop);
    } catch (const Ended& ended) {
        say(ended.why);
        return ended.how;
    } catch (const std::runtime_error& error) {
        say(std::string(error.what()) + "; the same command goes on where it was");
        return BakeEnd::impossible;
    }
}

}  // namespace sporeprint::server
