// Items that several threads make, in the order of their numbers.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <map>
#include <mutex>
#include <thread>
#include <vector>

#include "server/bake/item.h"

namespace sporeprint::server {

/// Makes the item of a number; called on several threads.
using ItemSource = std::function<BakedItem(std::uint64_t number)>;

/// Numbers from the first on, without the last.
struct ItemRange {
    std::uint64_t begin = 0, end = 0;
};

/// The items of some ranges. Threads work ahead by a few items each, so that memory is bounded and none waits at the end
/// of a range.
class ItemStream {
  public:
    /// ranges  none of them empty
    ItemStream(std::vector<ItemRange> ranges, ItemSource source, std::size_t threads);
    ~ItemStream();
    ItemStream(const ItemStream&) = delete;
    ItemStream& operator=(const ItemStream&) = delete;

    /// Waits for the next item.
    ///
    /// pre      there is one
    /// throws   what its source threw
    [[nodiscard]] BakedItem next();

  private:
    struct Made {
        BakedItem item;
        std::exception_ptr error;
    };

    void work();

    std::vector<ItemRange> ranges_;
    ItemSource source_;
    std::uint64_t ahead_;
    std::mutex mutex_;
    std::condition_variable room_, made_;
    std::map<std::uint64_t, Made> waiting_;  ///< by their places in the order
    std::uint64_t begun_ = 0, taken_ = 0;
    std::size_t range_ = 0;       ///< of the item that is begun next
    std::uint64_t in_range_ = 0;  ///< its place there
    bool stopping_ = false;
    std::vector<std::jthread> threads_;  ///< the last member: they use all others
};

}  // namespace sporeprint::server
