#include "devices/tracker/threaded_tracker.h"

#include <algorithm>
#include <cstring>

#include "experiment/base/error.h"
#include "experiment/calibration/drift_from_samples.h"

namespace overt {

namespace {

/// How long a driver may wait for data at a time: marks are sent and a stop is seen within this.
constexpr SessionDuration reading_slice = std::chrono::milliseconds(2);

constexpr SessionDuration between_clock_readings = std::chrono::seconds(1);

/// After the stop, what a tracker still has under way.
constexpr int last_readings = 3;

} // namespace

/// Puts items into the ring and tells of those that had no room.
class ThreadedTracker::RingSink final : public TrackerItemSink {
  public:
    RingSink(SpscRing<TrackerItem>& ring, SampleListener* listener, SampleRateWatch& rate)
        : ring_(ring), listener_(listener), rate_(rate) {}

    void put(const TrackerItem& item) noexcept override {
        if (const auto* sample = std::get_if<GazeSample>(&item)) {
            rate_.take(*sample);
            if (listener_)
                listener_->measured(*sample);
        }
        if (lost_ > 0) {
            if (!ring_.try_push(TrackerGap{TrackerGap::Reason::overflow, last_, lost_})) {
                count_loss(item);
                return;
            }
            lost_ = 0;
        }
        if (!ring_.try_push(item)) {
            count_loss(item);
            return;
        }
        if (const auto* sample = std::get_if<GazeSample>(&item))
            last_ = sample->sampled_at;
    }

  private:
    void count_loss(const TrackerItem& item) noexcept {
        lost_ += std::holds_alternative<GazeSample>(item) ? 1 : 0;
    }

    SpscRing<TrackerItem>& ring_;
    SampleListener* listener_;
    SampleRateWatch& rate_;
    TrackerTime last_{};
    std::int64_t lost_ = 0;
};

ThreadedTracker::ThreadedTracker(std::unique_ptr<TrackerDriver> driver, Clock& clock, const TrackerWish& wish,
                                 std::size_t ring_capacity)
    : driver_(std::move(driver)), clock_(&clock), wish_(wish), description_(driver_->connect(wish)),
      items_(ring_capacity), marks_(1024) {}

ThreadedTracker::~ThreadedTracker() {
    if (thread_.joinable()) {
        thread_ = {};
        driver_->stop();
    }
}

SetupOutcome ThreadedTracker::set_up(SetupScreen& setup_screen) { return driver_->set_up(setup_screen); }

std::optional<ClockPair> ThreadedTracker::read_clocks() noexcept {
    // Of the recording under way, the thread reads them.
    return thread_.joinable() ? std::nullopt : driver_->read_clocks();
}

bool ThreadedTracker::tell_samples_to(SampleListener* listener) {
    OVERT_EXPECTS(!thread_.joinable());
    listener_ = listener;
    return true;
}

void ThreadedTracker::start_recording() {
    OVERT_EXPECTS(!thread_.joinable());
    for (TrackerItem item; items_.try_pop(item);) {
    }
    driver_->start();
    state_ = RecordingState::running;
    thread_ = std::jthread([this](const std::stop_token& stop) { record(stop); });
}

void ThreadedTracker::stop_recording() {
    if (!thread_.joinable())
        return;
    thread_ = {};
    driver_->stop();
}

void ThreadedTracker::record(const std::stop_token& stop) noexcept {
    rate_.begin();
    RingSink sink(items_, listener_, rate_);
    SessionTime clocks_due = clock_->now() + between_clock_readings;
    int readings_left = last_readings;
    while (readings_left > 0) {
        if (stop.stop_requested())
            --readings_left;
        const SessionTime now = clock_->now();
        const RecordingState state =
            driver_->read(sink, readings_left < last_readings ? now : now + reading_slice);
        if (state != RecordingState::running)
            state_.store(state, std::memory_order_release);
        if (state == RecordingState::lost)
            return;
        send_marks();
        if (now >= clocks_due) {
            if (const std::optional<ClockPair> pair = driver_->read_clocks())
                sink.put(*pair);
            clocks_due = now + between_clock_readings;
        }
    }
}

void ThreadedTracker::send_marks() noexcept {
    for (HeldMark mark; marks_.try_pop(mark);)
        driver_->send({mark.at, {mark.text.data(), mark.length}});
}

std::size_t ThreadedTracker::poll(std::span<TrackerItem> into) noexcept {
    std::size_t taken = 0;
    while (taken < into.size() && items_.try_pop(into[taken]))
        ++taken;
    return taken;
}

void ThreadedTracker::mark(const TrackerMark& mark) noexcept {
    HeldMark held{};
    held.at = mark.at;
    held.length = static_cast<std::uint8_t>(std::min(mark.text.size(), longest_mark));
    std::memcpy(held.text.data(), mark.text.data(), held.length);
    if (!thread_.joinable())
        driver_->send({held.at, {held.text.data(), held.length}});
    else if (!marks_.try_push(held))
        ++lost_marks_;
}

DriftOutcome ThreadedTracker::drift_check(ScreenPoint target) {
    if (std::optional<DriftOutcome> own = driver_->drift_check(target))
        return *own;
    return drift_from_samples(*this, *clock_, wish_.screen, target);
}

void ThreadedTracker::reconnect() {
    stop_recording();
    description_ = driver_->connect(wish_);
    state_ = RecordingState::running;
}

std::vector<std::string> ThreadedTracker::finish(const std::string& folder, const FileProgress& progress) {
    stop_recording();
    std::vector<std::string> said = driver_->finish(folder, progress);
    if (std::optional<std::string> rate = rate_.warning(description_))
        said.push_back(std::move(*rate));
    if (const std::int64_t lost = lost_marks_)
        said.push_back(std::to_string(lost) + " messages for the tracker's file were lost: too many at once");
    return said;
}

} // namespace overt
