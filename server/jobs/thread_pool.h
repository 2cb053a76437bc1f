// A thread pool for CPU-bound work: a fixed number of threads, a bounded queue, and subtasks of
// running tasks on idle threads.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <thread>
#include <vector>

namespace sporeprint::server {

/// Whether others may be run before a task that waits, since it takes long compared with them.
enum class TaskLength { brief, lengthy };

/// Runs tasks in the order of submission, except that brief ones overtake lengthy ones: a request of milliseconds does
/// not wait behind tens of others that take a third of a second each. Thread-safe.
class ThreadPool {
  public:
    using Ticket = std::uint64_t;

    /// Most tasks that overtake one lengthy task, so that it is run in the end.
    static constexpr int most_overtaking = 100;

    /// count          threads, at least 1
    /// longest_queue  tasks that may wait while no thread is idle
    ThreadPool(std::size_t count, std::size_t longest_queue);

    /// Drops queued tasks and returns when the running ones have ended.
    ~ThreadPool();
    ThreadPool(const ThreadPool&) = delete;
    ThreadPool& operator=(const ThreadPool&) = delete;

    /// Adds a task to the queue. It must not throw.
    ///
    /// returns  its ticket; nothing if the queue is full
    std::optional<Ticket> submit(std::function<void()> task, TaskLength length = TaskLength::brief);

    /// Removes a task from the queue. Returns false if it is no longer queued, because it has begun
    /// or was removed before.
    bool withdraw(Ticket ticket);

    /// Runs subtasks of one task on the calling thread and on threads that are idle at the call,
    /// and returns when all have ended. Busy threads take no part, so it never waits for another
    /// task.
    ///
    /// throws  the exception of the subtask that failed first, after all have ended
    void share(std::span<const std::function<void()>> subtasks);

    [[nodiscard]] std::size_t count() const { return threads_.size(); }
    [[nodiscard]] std::size_t waiting() const;  ///< number of queued tasks
    [[nodiscard]] std::size_t busy() const;     ///< number of threads that run tasks or subtasks
    [[nodiscard]] std::size_t longest_queue() const { return longest_queue_; }

  private:
    struct Batch;
    struct Task {
        Ticket ticket = 0;
        std::function<void()> run;
        TaskLength length = TaskLength::brief;
        int overtaken = 0;  ///< how often, if it is lengthy
    };

    void work();

    std::size_t longest_queue_;
    mutable std::mutex mutex_;
    std::condition_variable wake_;
    std::list<Task> queue_;
    std::deque<std::shared_ptr<Batch>> batches_;  ///< one entry for each thread called to help
    std::size_t idle_ = 0;
    Ticket last_ticket_ = 0;
    bool stopping_ = false;
    std::vector<std::jthread> threads_;
};

}  // namespace sporeprint::server
