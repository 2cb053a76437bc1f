// The compute slots: as many threads as the machine grants, a bounded queue before them, and idle
// ones lent to whoever is already running.
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

class ThreadPool {
  public:
    using Ticket = std::uint64_t;

    /// count          threads, at least 1
    /// longest_queue  tasks that may wait when no thread is idle
    ThreadPool(std::size_t count, std::size_t longest_queue);

    /// Drops what waits and returns when what runs has ended.
    ~ThreadPool();
    ThreadPool(const ThreadPool&) = delete;
    ThreadPool& operator=(const ThreadPool&) = delete;

    /// Puts a task at the end of the queue. It must not throw.
    ///
    /// returns  its ticket; nothing when the queue is full
    std::optional<Ticket> submit(std::function<void()> task);

    /// Takes a task back. Returns whether it had not begun; then it never will.
    bool withdraw(Ticket ticket);

    /// Runs pieces of one task, on idle slots too when there are any; the caller does its part, so
    /// this never waits for a slot to become free.
    ///
    /// throws  what the first failing piece threw, when all have ended
    void share(std::span<const std::function<void()>> pieces);

    [[nodiscard]] std::size_t count() const { return threads_.size(); }
    [[nodiscard]] std::size_t waiting() const;  ///< tasks in the queue
    [[nodiscard]] std::size_t busy() const;     ///< threads at work
    [[nodiscard]] std::size_t longest_queue() const { return longest_queue_; }

  private:
    struct Batch;
    struct Task {
        Ticket ticket = 0;
        std::function<void()> run;
    };

    void work();

    std::size_t longest_queue_;
    mutable std::mutex mutex_;
    std::condition_variable wake_;
    std::list<Task> queue_;
    std::deque<std::shared_ptr<Batch>> offers_;
    std::size_t idle_ = 0;
    Ticket last_ticket_ = 0;
    bool stopping_ = false;
    std::vector<std::jthread> threads_;
};

}  // namespace sporeprint::server
