#include "api/products/worlds/parts.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <memory>
#include <utility>

#include "core/grow/world/parts.h"
#include "core/params/messages.h"
#include "core/params/value.h"
#include "core/world/weather.h"

namespace sporeprint::api {

namespace {

/// Returns the cost of computing the ground of a world.
Cost cost_of_ground(const WorldParams& params) {
    if (!params.terrain.id.empty()) return {.base = 80'000};
    return {.base = 40'000 + static_cast<std::uint64_t>(170'000.0 * params.terrain.erosion)};
}

/// Returns the cost of what is computed of a world over its ground: its light, and the spread of its species.
Cost cost_of_world(const WorldParams& params) {
    const auto species =
        1 + std::count(params.fungi.species.view().begin(), params.fungi.species.view().end(), '+');
    return {.base = 30'000 + 14'000 * static_cast<std::uint64_t>(species)};
}

/// Reads a whole number with a letter before it, such as y80, and removes it from a text.
std::optional<int> take_number(std::string_view& text, char letter, int least, int most) {
    if (!text.starts_with(letter)) return std::nullopt;
    int number = 0;
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data() + 1, end, number);
    if (error != std::errc() || number < least || number > most || text[1] == '-' ||
        (text[1] == '0' && rest > text.data() + 2))
        return std::nullopt;
    text = {rest, static_cast<std::size_t>(end - rest)};
    return number;
}

/// Returns the four numbers of a bbox, or nothing if it is not of that form.
std::optional<WorldBox> numbers_of(std::string_view text) {
    std::array<double, 4> numbers{};
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const std::size_t comma = i < 3 ? text.find(',') : text.size();
        if (comma == std::string_view::npos ||
            !read_number(std::string(text.substr(0, comma)), numbers[i]))
            return std::nullopt;
        numbers[i] += 0.0;  // -0 is 0
        text.remove_prefix(std::min(text.size(), comma + 1));
    }
    return WorldBox{numbers[0], numbers[1], numbers[2], numbers[3]};
}

}  // namespace

WorldTimeRead read_world_time(std::string_view text, ValidationErrors& errors) {
    std::string_view rest = text;
    const std::optional<int> year = take_number(rest, 'y', 0, last_year);
    const std::optional<int> day =
        rest.empty() ? std::optional(0) : take_number(rest, 'd', 1, days_of_year);
    if (year && day && rest.empty()) return {*year, *day, true};
    errors.add(400, "time",
               in_quotes(text) + " is no time; allowed are years from y0 to y" +
                   std::to_string(last_year) + ", and their days from y0d1 to y" +
                   std::to_string(last_year) + 'd' + std::to_string(days_of_year));
    return {};
}

std::string WorldTimeRead::text() const {
    return 'y' + std::to_string(year) + (day == 0 ? "" : 'd' + std::to_string(day));
}

WorldTimeRead read_world_day(std::string_view text, const char* why, ValidationErrors& errors) {
    const WorldTimeRead time = read_world_time(text, errors);
    if (time.is_valid && time.day == 0)
        errors.add(400, "time", std::string(why) + ", as in " + std::string(text) + "d270");
    return time;
}

std::string text_of(const WorldBox& box) {
    return number_text(box.west) + ',' + number_text(box.south) + ',' + number_text(box.east) +
           ',' + number_text(box.north);
}

WorldBox read_box(std::string_view text, const WorldBox& extent, const WorldBox& otherwise,
                  ValidationErrors& errors) {
    if (text.empty()) return otherwise;
    const std::optional<WorldBox> box = numbers_of(text);
    if (!box) {
        errors.add(400, "bbox",
                   in_quotes(text) +
                       " is not four numbers: west, south, east and north in metres "
                       "from the centre, as in -100,-50,100,50");
        return otherwise;
    }
    if (box->east - box->west < 1.0 || box->north - box->south < 1.0)
        errors.add(400, "bbox",
                   in_quotes(text) +
                       " is empty or less than a metre wide; the order is west, "
                       "south, east, north");
    else if (box->west < extent.west || box->south < extent.south || box->east > extent.east ||
             box->north > extent.north)
        errors.add(400, "bbox",
                   in_quotes(text) + " is partly outside the world, which is " + text_of(extent));
    else
        return *box;
    return otherwise;
}

/// Returns the ground of a world, from its cache or computed.
SharedGround ground_of_world(const WorldParams& params, const Caches& caches) {
    return caches.grounds(ground_key(params), [&] {
        const SharedTerrain terrain =
            params.terrain.id.empty() ? nullptr : caches.terrain(params.terrain.id.view());
        return std::make_shared<const Ground>(ground_of(params, terrain.get()));
    });
}

/// Returns the job that computes the ground of a world, if it is not cached.
std::optional<Job> ground_job(Store& store, const WorldParams& params) {
    const std::string key = ground_key(params);
    if (store.grounds.cache().find(key)) return std::nullopt;
    auto run = [&store, params](const std::stop_token& stop, const Observer& observer,
                                const Parallel& parallel) {
        observer(Step::resolve);
        JobContext job(store, stop, observer, parallel);
        static_cast<void>(ground_of_world(params, job.execution().caches));
        return Response();
    };
    return Job{key, cost_of_ground(params), std::move(run), true};
}

SharedWorld world_of_request(const WorldParams& params, const Atlas& atlas,
                             const ExecutionContext& execution, const SharedEdits& edits) {
    return execution.caches.worlds(world_key(params, edits), [&] {
        return std::make_shared<const World>(world_of(params, lookup_in(atlas),
                                                      ground_of_world(params, execution.caches),
                                                      execution.parallel, edits));
    });
}

std::optional<Job> world_job(Store& store, const WorldParams& params,
                             std::shared_ptr<const Atlas> atlas, const SharedEdits& edits) {
    std::string key = world_key(params, edits);
    if (store.worlds.cache().find(key)) return std::nullopt;
    Cost cost = cost_of_world(params);
    if (!store.grounds.cache().find(ground_key(params))) cost += cost_of_ground(params);
    auto run = [&store, params, edits, atlas = std::move(atlas)](const std::stop_token& stop,
                                                                 const Observer& observer,
                                                                 const Parallel& parallel) {
        observer(Step::resolve);
        JobContext job(store, stop, observer, parallel);
        static_cast<void>(world_of_request(params, *atlas, job.execution(), edits));
        return Response();
    };
    return Job{std::move(key), cost, std::move(run), true};
}

void make_of_world(Resource& resource, const WorldParams& params,
                   const std::shared_ptr<const Atlas>& atlas,
                   std::function<Body(const SharedWorld&, const ExecutionContext&)> make,
                   const SharedEdits& edits) {
    resource.prerequisite = [params, atlas, edits](Store& store) {
        return world_job(store, params, atlas, edits);
    };
    resource.make = [params, atlas, edits, make = std::move(make)](JobContext& job) {
        const ExecutionContext& execution = job.execution();
        execution.observer(Step::resolve);
        return make(world_of_request(params, *atlas, execution, edits), execution);
    };
}

}  // namespace sporeprint::api
