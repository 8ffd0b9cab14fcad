#include "experiment/record/session_store.h"

#include <atomic>
#include <cerrno>
#include <chrono>
#include <ctime>
#include <exception>
#include <future>
#include <mutex>
#include <thread>
#include <utility>
#include <variant>

#include <fmt/chrono.h>
#include <semaphore.h>

#include "experiment/error.h"
#include "experiment/record/row_writer.h"
#include "experiment/record/spsc_ring.h"
#include "experiment/record/sql.h"

namespace overt {
namespace {

/// How long rows wait at most before they are committed; the promise to the outside is 250 ms.
constexpr std::chrono::milliseconds drain_interval{100};

/// Rings from the session's thread without ever blocking it.
class Bell {
  public:
    Bell() { OVERT_EXPECTS(::sem_init(&semaphore_, 0, 0) == 0); }
    ~Bell() { ::sem_destroy(&semaphore_); }
    Bell(const Bell&) = delete;
    Bell& operator=(const Bell&) = delete;

    void ring() noexcept {
        if (!ringing_.exchange(true, std::memory_order_acq_rel))
            ::sem_post(&semaphore_);
    }
    /// Returns when it rings, or after the time.
    void wait_for(std::chrono::milliseconds time) noexcept {
        timespec until{};
        ::clock_gettime(CLOCK_MONOTONIC, &until);
        const auto nanoseconds = until.tv_nsec + std::chrono::nanoseconds(time).count();
        until.tv_sec += nanoseconds / 1'000'000'000;
        until.tv_nsec = nanoseconds % 1'000'000'000;
        while (::sem_clockwait(&semaphore_, CLOCK_MONOTONIC, &until) != 0 && errno == EINTR) {
        }
        ringing_.store(false, std::memory_order_release);
    }

  private:
    ::sem_t semaphore_;
    std::atomic<bool> ringing_{false};
};

struct SampleRow {
    int trial = -1;
    GazeSample sample;
};
struct Event {
    SessionTime at;
    int trial;
    std::string kind, detail;
};
struct TrialStart {
    Trial trial;
    SessionTime at;
};
struct TrialFinish {
    Trial trial;
    TrialOutcome outcome;
    LostRows lost;
};

/// What is too large or too rare for the ring itself: it carries the pointer, so that the order holds.
struct Message {
    std::variant<Event, TrialStart, TrialFinish, RecordedMap, RecordedBox, std::vector<BoxClockReading>,
                 std::vector<RecordedObserverField>, RecordedConsent, RecordedAnswer>
        content;
    std::promise<void> written;
};

using Row = std::variant<FlipRecord, MissedRefresh, SampleRow, ClockPair, Message*>;

} // namespace

class SessionStore::Writer {
  public:
    Writer(const std::filesystem::path& file, const Options& options)
        : file_(file), wait_when_full_(options.wait_when_full),
          rows_(file,
                {options.started_utc, options.program_version, options.program_sha256, options.resumption}),
          ring_(options.ring_capacity), thread_([this] { run(); }) {}
    ~Writer() { stop(); }

    void push(const Row& row) noexcept;
    /// Throws the failure, if there is one. Gives a future that is ready when the message is written.
    std::future<void> send(decltype(Message::content) content);
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
    void write_message(const Message& message);
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

void SessionStore::Writer::push(const Row& row) noexcept {
    while (!ring_.try_push(row)) {
        bell_.ring();
        if (!wait_when_full_ && !std::holds_alternative<Message*>(row))
            return count_lost(row);
        ring_.wait_for_room();
    }
    if (ring_.size() > ring_.capacity() / 2)
        bell_.ring();
}

std::future<void> SessionStore::Writer::send(decltype(Message::content) content) {
    throw_failure();
    auto message = std::make_unique<Message>(Message{std::move(content), {}});
    auto written = message->written.get_future();
    push(Row(message.release()));
    return written;
}

void SessionStore::Writer::throw_failure() {
    if (!failed_.load(std::memory_order_acquire))
        return;
    const std::lock_guard lock(failure_mutex_);
    std::rethrow_exception(failure_);
}

void SessionStore::Writer::run() {
    for (bool last = false; !last;) {
        bell_.wait_for(drain_interval);
        last = stopping_.load(std::memory_order_acquire); // read first: what was pushed before it is drained
        drain();
    }
}

void SessionStore::Writer::drain() {
    constexpr std::size_t rows_between_announcements = 4096;
    // Only what is there now: a busy session must not keep the transaction open.
    const std::size_t waiting = ring_.size();
    Row row;
    for (std::size_t i = 0; i < waiting && ring_.try_pop(row); ++i) {
        handle(row);
        if (i % rows_between_announcements == 0)
            ring_.announce_room();
    }
    ring_.announce_room();
    try {
        rows_.commit();
        uncommitted_ = {};
    } catch (const SQLite::Exception& reason) {
        fail(reason);
    }
}

void SessionStore::Writer::handle(const Row& row) {
    Message* const* const carried = std::get_if<Message*>(&row);
    const std::unique_ptr<Message> message(carried ? *carried : nullptr);
    if (!failed_.load(std::memory_order_relaxed)) {
        try {
            write(row);
        } catch (const SQLite::Exception& reason) {
            fail(reason);
        }
    }
    if (failed_.load(std::memory_order_relaxed)) {
        count_lost(row);
        if (message)
            message->written.set_exception(failure_);
    } else if (message) {
        message->written.set_value();
        if (std::holds_alternative<TrialFinish>(message->content))
            rows_.checkpoint();
    }
}

void SessionStore::Writer::write(const Row& row) {
    if (const auto* sample = std::get_if<SampleRow>(&row)) {
        rows_.sample(sample->trial, sample->sample);
        ++uncommitted_.samples;
    } else if (const auto* flip = std::get_if<FlipRecord>(&row)) {
        rows_.flip(*flip);
        ++uncommitted_.flips;
    } else if (const auto* missed = std::get_if<MissedRefresh>(&row)) {
        rows_.missed(*missed);
        ++uncommitted_.flips;
    } else if (const auto* pair = std::get_if<ClockPair>(&row)) {
        rows_.clock_pair(*pair);
    } else {
        write_message(*std::get<Message*>(row));
    }
}

void SessionStore::Writer::write_message(const Message& message) {
    if (const auto* event = std::get_if<Event>(&message.content)) {
        rows_.event(event->at, event->trial, event->kind, event->detail);
    } else if (const auto* start = std::get_if<TrialStart>(&message.content)) {
        rows_.start_trial(start->trial, start->at);
    } else if (const auto* map = std::get_if<RecordedMap>(&message.content)) {
        rows_.map(*map);
    } else if (const auto* box = std::get_if<RecordedBox>(&message.content)) {
        rows_.display_box(*box);
    } else if (const auto* readings = std::get_if<std::vector<BoxClockReading>>(&message.content)) {
        rows_.box_clock(*readings);
    } else if (const auto* fields = std::get_if<std::vector<RecordedObserverField>>(&message.content)) {
        rows_.observer_fields(*fields);
    } else if (const auto* consent = std::get_if<RecordedConsent>(&message.content)) {
        rows_.consent(*consent);
    } else if (const auto* answer = std::get_if<RecordedAnswer>(&message.content)) {
        rows_.answer(*answer);
    } else {
        const auto& finish = std::get<TrialFinish>(message.content);
        rows_.finish_trial(finish.trial, finish.outcome, finish.lost.flips, finish.lost.samples);
        uncommitted_ = {};
    }
}

void SessionStore::Writer::fail(const SQLite::Exception& reason) {
    rows_.roll_back();
    lost_flips_ += std::exchange(uncommitted_.flips, 0);
    lost_samples_ += std::exchange(uncommitted_.samples, 0);
    const std::lock_guard lock(failure_mutex_);
    try {
        throw_record_error(file_, "writing the session", reason);
    } catch (const RecordError&) {
        failure_ = std::current_exception();
    }
    failed_.store(true, std::memory_order_release);
}

void SessionStore::Writer::count_lost(const Row& row) noexcept {
    if (std::holds_alternative<FlipRecord>(row) || std::holds_alternative<MissedRefresh>(row))
        ++lost_flips_;
    else if (std::holds_alternative<SampleRow>(row))
        ++lost_samples_;
}

void SessionStore::Writer::stop() noexcept {
    if (!thread_.joinable())
        return;
    stopping_.store(true, std::memory_order_release);
    bell_.ring();
    thread_.join();
}

void SessionStore::Writer::close() {
    throw_failure();
    try {
        rows_.close();
    } catch (const SQLite::Exception& reason) {
        throw_record_error(file_, "closing the session", reason);
    }
}

SessionStore::SessionStore(const std::filesystem::path& session_file, const Options& options)
    : writer_(std::make_unique<Writer>(session_file, options)) {}

SessionStore::~SessionStore() {
    try {
        close();
    } catch (const Error&) {
        // Whoever wants to know calls close().
    }
}

void SessionStore::flip(const FlipRecord& flip) noexcept { writer_->push(Row(flip)); }

void SessionStore::missed(const MissedRefresh& refresh) noexcept { writer_->push(Row(refresh)); }

void SessionStore::sample(int trial, const GazeSample& sample) noexcept {
    writer_->push(Row(SampleRow{trial, sample}));
}

void SessionStore::clock_pair(const ClockPair& pair) noexcept { writer_->push(Row(pair)); }

void SessionStore::event(const SessionEvent& event) {
    writer_->send(Event{event.at, event.trial, std::string(event.kind), event.detail});
}

void SessionStore::trial_started(const Trial& trial, SessionTime at) {
    writer_->lost_before_trial = writer_->lost();
    writer_->send(TrialStart{trial, at});
}

void SessionStore::trial_finished(const Trial& trial, const TrialOutcome& outcome) {
    const LostRows now = writer_->lost();
    const LostRows before = writer_->lost_before_trial;
    auto written =
        writer_->send(TrialFinish{trial, outcome, {now.flips - before.flips, now.samples - before.samples}});
    writer_->wake();
    written.get();
}

void SessionStore::consent(const RecordedConsent& consent) {
    RecordedConsent dated = consent;
    if (dated.utc.empty())
        dated.utc = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
    writer_->send(std::move(dated));
}

void SessionStore::answer_recorded(const RecordedAnswer& answer) { writer_->send(answer); }

void SessionStore::observer_fields(const std::vector<RecordedObserverField>& fields) {
    writer_->send(fields);
}

void SessionStore::map_made(const RecordedMap& map) { writer_->send(map); }

void SessionStore::display_box(const RecordedBox& box) { writer_->send(box); }

void SessionStore::box_clock(const std::vector<BoxClockReading>& readings) { writer_->send(readings); }

LostRows SessionStore::lost() const noexcept { return writer_ ? writer_->lost() : lost_in_all_; }

void SessionStore::close() {
    const std::unique_ptr<Writer> writer = std::move(writer_);
    if (!writer)
        return;
    writer->stop();
    lost_in_all_ = writer->lost();
    writer->close();
}

} // namespace overt
