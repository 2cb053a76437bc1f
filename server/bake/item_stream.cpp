#include "server/bake/item_stream.h"

#include <utility>

namespace sporeprint::server {

namespace {

/// Items that wait to be written, for each thread.
constexpr std::uint64_t ahead_of_each = 4;

}  // namespace

ItemStream::ItemStream(std::vector<ItemRange> ranges, ItemSource source, std::size_t threads)
    : ranges_(std::move(ranges)), source_(std::move(source)), ahead_(ahead_of_each * threads) {
    for (std::size_t i = 0; i < threads; ++i) threads_.emplace_back([this] { work(); });
}

ItemStream::~ItemStream() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
    }
    room_.notify_all();
    threads_.clear();
}

BakedItem ItemStream::next() {
    std::unique_lock lock(mutex_);
    made_.wait(lock, [this] { return waiting_.contains(taken_); });
    Made made = std::move(waiting_.extract(taken_++).mapped());
    lock.unlock();
    room_.notify_one();
    if (made.error) std::rethrow_exception(made.error);
    return std::move(made.item);
}

void ItemStream::work() {
    std::unique_lock lock(mutex_);
    while (true) {
        room_.wait(lock, [this] {
            return stopping_ || range_ == ranges_.size() || begun_ < taken_ + ahead_;
        });
        if (stopping_ || range_ == ranges_.size()) return;
        const std::uint64_t place = begun_++, number = ranges_[range_].begin + in_range_;
        if (++in_range_ == ranges_[range_].end - ranges_[range_].begin) {
            ++range_;
            in_range_ = 0;
            if (range_ == ranges_.size()) room_.notify_all();
        }
        lock.unlock();
        Made made;
        try {
            made.item = source_(number);
        } catch (...) {
            made.error = std::current_exception();
        }
        lock.lock();
        waiting_.emplace(place, std::move(made));
        made_.notify_one();
    }
}

}  // namespace sporeprint::server
