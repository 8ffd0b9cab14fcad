#include "render/vblank/retrace_clock.h"

#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

namespace overt {
namespace {

/// Shared with the thread, which may be left waiting when the clock is gone.
struct Retraces {
    std::shared_ptr<RetraceWait> wait;
    MonotonicTime time;
    std::mutex mutex;
    std::condition_variable changed;
    bool has_begun = false, has_ended = false, is_to_end = false;
    std::exception_ptr refusal;
    std::optional<VblankStamp> last;

    Retraces(std::shared_ptr<RetraceWait> waits, const Clock& clock) : wait(std::move(waits)), time(clock) {}

    /// Runs on the thread.
    void watch() noexcept {
        try {
            wait->begin();
        } catch (...) {
            const std::lock_guard lock(mutex);
            refusal = std::current_exception();
        }
        tell([this] { has_begun = true; });
        std::optional<std::uint32_t> before;
        std::int64_t count = 0;
        while (!refusal) {
            const std::optional<std::uint32_t> now = wait->next();
            const auto since_boot = std::chrono::steady_clock::now().time_since_epoch();
            if (!now)
                break;
            count += before ? static_cast<std::int64_t>(static_cast<std::uint32_t>(*now - *before)) : *now;
            before = now;
            bool ends = false;
            tell([&] {
                last = VblankStamp{
                    count, time.of_nanoseconds(
                               std::chrono::duration_cast<std::chrono::nanoseconds>(since_boot).count())};
                ends = is_to_end;
            });
            if (ends)
                break;
        }
        tell([this] { has_ended = true; });
    }

    template <class Change> void tell(Change change) noexcept {
        {
            const std::lock_guard lock(mutex);
            change();
        }
        changed.notify_all();
    }
};

class RetraceClock final : public VblankClock {
  public:
    RetraceClock(VblankSource source, std::shared_ptr<RetraceWait> wait, const Clock& clock)
        : source_(source), retraces_(std::make_shared<Retraces>(std::move(wait), clock)),
          thread_([retraces = retraces_] { retraces->watch(); }) {
        std::unique_lock lock(retraces_->mutex);
        retraces_->changed.wait(lock, [this] { return retraces_->has_begun; });
        if (!retraces_->refusal) {
            retraces_->changed.wait_for(lock, patience,
                                        [this] { return retraces_->last || retraces_->has_ended; });
            return;
        }
        lock.unlock();
        thread_.join();
        std::rethrow_exception(retraces_->refusal);
    }
    ~RetraceClock() override {
        std::unique_lock lock(retraces_->mutex);
        retraces_->is_to_end = true;
        const bool ended =
            retraces_->changed.wait_for(lock, patience, [this] { return retraces_->has_ended; });
        lock.unlock();
        if (ended)
            thread_.join();
        else
            thread_.detach();
    }

    VblankSource source() const noexcept override { return source_; }
    std::optional<VblankStamp> last() noexcept override {
        const std::lock_guard lock(retraces_->mutex);
        return retraces_->has_ended ? std::nullopt : retraces_->last;
    }
    std::optional<VblankStamp> await(std::int64_t count) noexcept override {
        std::unique_lock lock(retraces_->mutex);
        const auto is_there = [&] { return retraces_->last && retraces_->last->count >= count; };
        retraces_->changed.wait_for(lock, patience, [&] { return retraces_->has_ended || is_there(); });
        return is_there() ? retraces_->last : std::nullopt;
    }

  private:
    VblankSource source_;
    std::shared_ptr<Retraces> retraces_;
    std::thread thread_;
};

} // namespace

std::unique_ptr<VblankClock> watch_retraces(VblankSource source, std::shared_ptr<RetraceWait> wait,
                                            const Clock& clock) {
    return std::make_unique<RetraceClock>(source, std::move(wait), clock);
}

} // namespace overt
