#include "server/jobs/thread_pool.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <iterator>
#include <utility>

#include "server/operations/machine.h"

namespace sporeprint::server {

/// The subtasks of one task; each helping thread takes the next one. The span belongs to the caller
/// and is not read after the last subtask has ended.
struct ThreadPool::Batch {
    explicit Batch(std::span<const std::function<void()>> the_subtasks)
        : subtasks(the_subtasks), count(the_subtasks.size()), unfinished(the_subtasks.size()) {}

    /// Runs subtasks until none is left to begin.
    void help() {
        for (;;) {
            const std::size_t index = next.fetch_add(1);
            if (index >= count) return;
            std::exception_ptr failure;
            try {
                subtasks[index]();
            } catch (...) {
                failure = std::current_exception();
            }
            const std::lock_guard lock(mutex);
            if (failure && !error) error = failure;
            if (--unfinished == 0) done.notify_all();
        }
    }

    /// Returns when all subtasks have ended.
    ///
    /// throws  the exception of the first that failed
    void wait() {
        std::unique_lock lock(mutex);
        done.wait(lock, [&] { return unfinished == 0; });
        if (error) std::rethrow_exception(error);
    }

    const std::span<const std::function<void()>> subtasks;
    const std::size_t count;
    std::atomic<std::size_t> next{0};
    std::mutex mutex;
    std::condition_variable done;
    std::size_t unfinished;
    std::exception_ptr error;
};

ThreadPool::ThreadPool(std::size_t count, std::size_t longest_queue)
    : longest_queue_(longest_queue) {
    count = std::max<std::size_t>(count, 1);
    idle_ = count;  // threads about to start count as idle: they take the first tasks
    threads_.reserve(count);
    for (std::size_t i = 0; i < count; ++i) threads_.emplace_back([this] { work(); });
}

ThreadPool::~ThreadPool() {
    std::list<Task> dropped;
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
        dropped.swap(queue_);
    }
    wake_.notify_all();
    threads_.clear();  // joins
}

std::optional<ThreadPool::Ticket> ThreadPool::submit(std::function<void()> task,
                                                     TaskLength length) {
    Ticket ticket = 0;
    {
        const std::lock_guard lock(mutex_);
        if (stopping_ || queue_.size() >= longest_queue_ + idle_) return std::nullopt;
        ticket = ++last_ticket_;
        auto place = queue_.end();
        while (length == TaskLength::brief && place != queue_.begin()) {
            Task& before = *std::prev(place);
            if (before.length == TaskLength::brief || before.overtaken == most_overtaking) break;
            ++before.overtaken;
            --place;
        }
        queue_.insert(place, Task{ticket, std::move(task), length});
    }
    wake_.notify_one();
    return ticket;
}

bool ThreadPool::withdraw(Ticket ticket) {
    std::list<Task> taken;  // destroyed after the lock is released
    const std::lock_guard lock(mutex_);
    const auto found = std::find_if(queue_.begin(), queue_.end(),
                                    [&](const Task& task) { return task.ticket == ticket; });
    if (found == queue_.end()) return false;
    taken.splice(taken.begin(), queue_, found);
    return true;
}

void ThreadPool::share(std::span<const std::function<void()>> subtasks) {
    if (subtasks.empty()) return;
    const auto batch = std::make_shared<Batch>(subtasks);
    std::size_t helpers = 0;
    if (subtasks.size() > 1) {
        const std::lock_guard lock(mutex_);
        const std::size_t claimed = queue_.size() + batches_.size();
        helpers = std::min(subtasks.size() - 1, idle_ > claimed ? idle_ - claimed : 0);
        batches_.insert(batches_.end(), helpers, batch);
    }
    for (std::size_t i = 0; i < helpers; ++i) wake_.notify_one();
    batch->help();
    batch->wait();
}

std::size_t ThreadPool::waiting() const {
    const std::lock_guard lock(mutex_);
    return queue_.size();
}

std::size_t ThreadPool::busy() const {
    const std::lock_guard lock(mutex_);
    return threads_.size() - std::min(idle_, threads_.size());
}

void ThreadPool::work() {
    lower_thread_priority();
    std::unique_lock lock(mutex_);
    for (;;) {
        wake_.wait(lock, [&] { return stopping_ || !batches_.empty() || !queue_.empty(); });
        if (!batches_.empty()) {  // subtasks of begun tasks precede new tasks
            const std::shared_ptr<Batch> batch = std::move(batches_.front());
            batches_.pop_front();
            --idle_;
            lock.unlock();
            batch->help();
        } else if (!queue_.empty()) {
            std::function<void()> run = std::move(queue_.front().run);
            queue_.pop_front();
            --idle_;
            lock.unlock();
            run();
            run = nullptr;  // its captures are destroyed outside the lock
        } else {
            return;
        }
        lock.lock();
        ++idle_;
    }
}

}  // namespace sporeprint::server
