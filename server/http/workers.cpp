#include "server/http/workers.h"

#include <algorithm>
#include <utility>

namespace sporeprint::server {

Workers::Workers(std::size_t count, std::size_t longest) : longest_(longest) {
    count = std::max<std::size_t>(count, 1);
    threads_.reserve(count);
    for (std::size_t i = 0; i < count; ++i) threads_.emplace_back([this] { work(); });
}

Workers::~Workers() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
    }
    wake_.notify_all();
    threads_.clear();  // joins
}

bool Workers::offer(std::function<void()> task) {
    {
        const std::lock_guard lock(mutex_);
        if (queue_.size() >= longest_) return false;
        queue_.push_back(std::move(task));
    }
    wake_.notify_one();
    return true;
}

void Workers::post(std::function<void()> task) {
    {
        const std::lock_guard lock(mutex_);
        queue_.push_back(std::move(task));
    }
    wake_.notify_one();
}

std::size_t Workers::waiting() const {
    const std::lock_guard lock(mutex_);
    return queue_.size();
}

void Workers::work() {
    std::unique_lock lock(mutex_);
    for (;;) {
        wake_.wait(lock, [&] { return stopping_ || !queue_.empty(); });
        if (queue_.empty()) return;
        std::function<void()> task = std::move(queue_.front());
        queue_.pop_front();
        lock.unlock();
        task();
        task = nullptr;  // its captures are destroyed outside the lock
        lock.lock();
    }
}

}  // namespace sporeprint::server
