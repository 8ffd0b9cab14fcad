/// What Tobii's library tells on threads of its own, until the driver takes it.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "devices/tobii/tobii_library.h"
#include "experiment/base/spsc_ring.h"

namespace overt {

/// Of one eye. Nothing: not measured.
struct TobiiEyeValues {
    std::optional<TobiiPoint2> on_display;
    std::optional<float> pupil_mm;
    std::optional<TobiiPoint3> eye_mm;
};
struct TobiiMeasurement {
    std::int64_t device_us = 0;
    std::array<TobiiEyeValues, 2> eyes; ///< by Eye
};
struct TobiiPort {
    std::int64_t device_us = 0;
    std::uint32_t value = 0;
    bool is_initial = false;
};
/// The library dropped data, it says.
struct TobiiDropped {};
using TobiiNews = std::variant<TobiiMeasurement, TobiiPort, TobiiDropped>;

/// Callbacks on any threads; the other functions on one at a time. What does not fit is counted.
class TobiiInbox {
  public:
    /// `capacity`: of news; the default holds 6 s at 1200 Hz.
    explicit TobiiInbox(std::int32_t major_version, std::size_t capacity = 8192);

    /// Subscribes to all but gaze; signals of the input port where the tracker has one. Throws DeviceError.
    void open(const TobiiLibrary& library, TobiiEyeTracker* tracker, bool has_port);
    /// Ends all subscriptions. What had come is forgotten.
    void close(const TobiiLibrary& library, TobiiEyeTracker* tracker) noexcept;

    TobiiStatus begin_gaze(const TobiiLibrary& library, TobiiEyeTracker* tracker) noexcept;
    void end_gaze(const TobiiLibrary& library, TobiiEyeTracker* tracker) noexcept;

    bool next(TobiiNews& news) noexcept { return news_.try_pop(news); }
    bool next(TobiiTimeSync& sync) noexcept { return syncs_.try_pop(sync); }
    /// Measurements that did not fit since this was asked last.
    std::int64_t take_overflow() noexcept { return overflow_.exchange(0, std::memory_order_relaxed); }
    void forget_news() noexcept;

    bool is_connection_lost() const noexcept { return is_connection_lost_.load(std::memory_order_acquire); }
    /// Faults and warnings that the tracker told of, each text once.
    std::vector<std::string> take_complaints();

  private:
    template <class Origin> static void on_gaze(const void* gaze, void* user) noexcept;
    static void on_time_sync(const TobiiTimeSync* sync, void* user) noexcept;
    static void on_signal(const TobiiSignal* signal, void* user) noexcept;
    static void on_stream_error(const TobiiStreamError* error, void* user) noexcept;
    static void on_notification(const TobiiNotification* notification, void* user) noexcept;
    void push(const TobiiNews& news) noexcept;
    void complain(std::string text) noexcept;

    const TobiiNotificationKinds& kinds_;
    const TobiiLibrary::GazeCallback gaze_callback_;
    std::mutex pushing_; ///< nobody promises that callbacks come one after another
    SpscRing<TobiiNews> news_;
    SpscRing<TobiiTimeSync> syncs_;
    std::atomic<std::int64_t> overflow_{0};
    std::atomic<bool> is_connection_lost_{false};
    std::vector<std::string> complaints_; ///< under pushing_
};

} // namespace overt
