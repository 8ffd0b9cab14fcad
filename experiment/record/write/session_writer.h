/// The thread that writes a session down, and the ring that leads to it.
#pragma once

#include <atomic>
#include <exception>
#include <filesystem>
#include <mutex>
#include <thread>

#include "experiment/base/bell.h"
#include "experiment/base/spsc_ring.h"
#include "experiment/record/write/row_writer.h"
#include "experiment/record/write/session_store.h"

namespace overt {

/// Empties the ring on a thread of its own, one transaction each time. The public functions are one other
/// thread's, the session's.
class SessionStore::Writer {
  public:
    /// Opens the file and begins a sitting. Throws RecordError.
    Writer(const std::filesystem::path& file, const Options& options);
    ~Writer() { stop(); }

    void push(const Row& row) noexcept;
    /// Throws the failure, if there is one. Gives a future that is ready when the message is written.
    std::future<void> send(decltype(RowMessage::content) content);
    void throw_failure();
    void wake() noexcept { bell_.ring(); }
    /// Ends the thread when it has written all that was pushed.
    void stop() noexcept;
    /// After stop().
    void close();

    LostRows lost() const noexcept { return {lost_flips_, lost_samples_}; }
    LostRows lost_before_trial;

  private:
    void run();
    void drain();
    void handle(const Row& row);
    void write(const Row& row);
    void write_message(const RowMessage& message);
    void fail(const SQLite::Exception& reason);
    void count_lost(const Row& row) noexcept;

    const std::filesystem::path file_;
    const bool wait_when_full_;
    RowWriter rows_;       ///< the writer's thread's, until it has ended
    LostRows uncommitted_; ///< rows of the open transaction
    SpscRing<Row> ring_;
    Bell bell_;
    std::atomic<std::int64_t> lost_flips_{0}, lost_samples_{0};
    std::atomic<bool> stopping_{false}, failed_{false};
    std::mutex failure_mutex_;
    std::exception_ptr failure_;
    std::thread thread_; ///< last: it uses all of the above
};

} // namespace overt
