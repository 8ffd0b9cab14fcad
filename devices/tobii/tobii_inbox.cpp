#include "devices/tobii/tobii_inbox.h"

#include <algorithm>
#include <cstring>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {
namespace {

constexpr std::size_t kept_syncs = 64;
constexpr std::size_t most_complaints = 20;

template <class Origin> TobiiEyeValues values_of(const TobiiEye<Origin>& eye) noexcept {
    TobiiEyeValues values;
    if (eye.gaze.validity == tobii_valid)
        values.on_display = eye.gaze.on_display;
    if (eye.pupil.validity == tobii_valid)
        values.pupil_mm = eye.pupil.diameter_mm;
    if (eye.origin.validity == tobii_valid)
        values.eye_mm = eye.origin.in_user_mm;
    return values;
}

} // namespace

TobiiInbox::TobiiInbox(std::int32_t major_version, std::size_t capacity)
    : kinds_(major_version == 1 ? tobii_notifications_1 : tobii_notifications_2),
      gaze_callback_(major_version == 1 ? &on_gaze<TobiiOrigin1> : &on_gaze<TobiiOrigin2>), news_(capacity),
      syncs_(kept_syncs) {}

void TobiiInbox::open(const TobiiLibrary& library, TobiiEyeTracker* tracker, bool has_port) {
    is_connection_lost_ = false;
    const auto require = [&](TobiiStatus status, const char* what) {
        if (status == tobii_ok)
            return;
        close(library, tracker);
        throw DeviceError(
            fmt::format("The eye tracker does not tell {} ({}).", what, describe_tobii_status(status)));
    };
    require(library.subscribe_to_stream_errors(tracker, &on_stream_error, this), "errors of its streams");
    require(library.subscribe_to_notifications(tracker, &on_notification, this), "what happens to it");
    require(library.subscribe_to_time_sync(tracker, &on_time_sync, this), "the time");
    if (has_port)
        require(library.subscribe_to_signals(tracker, &on_signal, this), "its input port");
}

void TobiiInbox::close(const TobiiLibrary& library, TobiiEyeTracker* tracker) noexcept {
    end_gaze(library, tracker);
    library.unsubscribe_from_signals(tracker, &on_signal);
    library.unsubscribe_from_time_sync(tracker, &on_time_sync);
    library.unsubscribe_from_notifications(tracker, &on_notification);
    library.unsubscribe_from_stream_errors(tracker, &on_stream_error);
    for (TobiiTimeSync sync; next(sync);) {
    }
}

TobiiStatus TobiiInbox::begin_gaze(const TobiiLibrary& library, TobiiEyeTracker* tracker) noexcept {
    return library.subscribe_to_gaze(tracker, gaze_callback_, this);
}

void TobiiInbox::end_gaze(const TobiiLibrary& library, TobiiEyeTracker* tracker) noexcept {
    library.unsubscribe_from_gaze(tracker, gaze_callback_);
}

void TobiiInbox::forget_news() noexcept {
    for (TobiiNews news; next(news);) {
    }
    take_overflow();
}

std::vector<std::string> TobiiInbox::take_complaints() {
    const std::scoped_lock lock(pushing_);
    return std::exchange(complaints_, {});
}

void TobiiInbox::push(const TobiiNews& news) noexcept {
    const std::scoped_lock lock(pushing_);
    if (!news_.try_push(news))
        overflow_.fetch_add(std::holds_alternative<TobiiMeasurement>(news), std::memory_order_relaxed);
}

void TobiiInbox::complain(std::string text) noexcept {
    const std::scoped_lock lock(pushing_);
    if (complaints_.size() < most_complaints && std::ranges::find(complaints_, text) == complaints_.end())
        complaints_.push_back(std::move(text));
}

template <class Origin> void TobiiInbox::on_gaze(const void* gaze, void* user) noexcept {
    TobiiGaze<Origin> told;
    std::memcpy(&told, gaze, sizeof told);
    static_cast<TobiiInbox*>(user)->push(
        TobiiMeasurement{told.device_us, {values_of(told.left), values_of(told.right)}});
}

void TobiiInbox::on_time_sync(const TobiiTimeSync* sync, void* user) noexcept {
    TobiiInbox& inbox = *static_cast<TobiiInbox*>(user);
    const std::scoped_lock lock(inbox.pushing_);
    inbox.syncs_.try_push(*sync); // when nobody asked for long, the older ones do
}

void TobiiInbox::on_signal(const TobiiSignal* signal, void* user) noexcept {
    static_cast<TobiiInbox*>(user)->push(
        TobiiPort{signal->device_us, signal->value, signal->change == tobii_signal_initial});
}

void TobiiInbox::on_stream_error(const TobiiStreamError* error, void* user) noexcept {
    TobiiInbox& inbox = *static_cast<TobiiInbox*>(user);
    if (error->error == tobii_stream_connection_lost)
        inbox.is_connection_lost_.store(true, std::memory_order_release);
    inbox.complain(fmt::format("the tracker's stream had an error: {}",
                               error->message ? error->message : "it does not say which"));
}

void TobiiInbox::on_notification(const TobiiNotification* notification, void* user) noexcept {
    TobiiInbox& inbox = *static_cast<TobiiInbox*>(user);
    const std::int32_t kind = notification->kind;
    if (kind == inbox.kinds_.connection_lost)
        inbox.is_connection_lost_.store(true, std::memory_order_release);
    else if (kind == inbox.kinds_.buffer_overflow)
        inbox.push(TobiiDropped{});
    else if (kind == inbox.kinds_.faults || kind == inbox.kinds_.warnings) {
        const std::string_view whole(notification->value, sizeof notification->value);
        inbox.complain(fmt::format("the tracker tells of a {}: {}",
                                   kind == inbox.kinds_.faults ? "fault" : "warning",
                                   whole.substr(0, whole.find('\0'))));
    }
}

} // namespace overt
