/// Tobii's own library (Tobii Pro SDK), loaded when a session asks for it and never part of overt. Declared
/// here is what is used of its C interface, by its public names and layouts: headers of versions 1.11 and
/// 2.1. Times are in microseconds, lengths in mm, places on the display area from 0 to 1, from its top left.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "devices/link/shared_library.h"

namespace overt {

struct TobiiEyeTracker; ///< the library's own object

/// What each function gives; see describe_tobii_status().
using TobiiStatus = std::int32_t;
inline constexpr TobiiStatus tobii_ok = 0;

struct TobiiVersion {
    std::int32_t major, minor, revision, build;
};

struct TobiiPoint2 {
    float x, y;
};
struct TobiiPoint3 {
    float x, y, z;
};

/// Of the screen, in the tracker's coordinates.
struct TobiiDisplayArea {
    TobiiPoint3 bottom_left, bottom_right;
    float height_mm;
    TobiiPoint3 top_left, top_right;
    float width_mm;
};
static_assert(sizeof(TobiiDisplayArea) == 56 && offsetof(TobiiDisplayArea, width_mm) == 52);

struct TobiiEyeTrackers {
    TobiiEyeTracker** trackers;
    std::size_t count;
};

struct TobiiFrequencies {
    float* hz;
    std::size_t count;
};

/// Bits of tobii_research_get_capabilities.
inline constexpr std::int32_t tobii_has_external_signal = 1 << 1, tobii_has_gaze = 1 << 3,
                              tobii_calibrates_on_screen = 1 << 5;

inline constexpr std::int32_t tobii_valid = 1; ///< of each `validity`

struct TobiiGazePoint {
    TobiiPoint2 on_display;
    TobiiPoint3 in_user_mm;
    std::int32_t validity;
};
struct TobiiPupil {
    float diameter_mm;
    std::int32_t validity;
};
struct TobiiOrigin1 { ///< of version 1
    TobiiPoint3 in_user_mm, in_track_box;
    std::int32_t validity;
};
struct TobiiOrigin2 { ///< of version 2
    TobiiPoint3 in_user_mm;
    std::int32_t validity;
};
template <class Origin> struct TobiiEye {
    TobiiGazePoint gaze;
    TobiiPupil pupil;
    Origin origin;
};
template <class Origin> struct TobiiGaze {
    TobiiEye<Origin> left, right;
    std::int64_t device_us, system_us;
};
static_assert(sizeof(TobiiGaze<TobiiOrigin1>) == 136 && sizeof(TobiiGaze<TobiiOrigin2>) == 112);

/// A question to the tracker for its time, as the library asks it now and then.
struct TobiiTimeSync {
    std::int64_t request_system_us, device_us, response_system_us;
};

struct TobiiSignal {
    std::int64_t device_us, system_us;
    std::uint32_t value;
    std::int32_t change;
};
inline constexpr std::int32_t tobii_signal_initial = 1; ///< `change`: where the port stands, not a change
static_assert(sizeof(TobiiSignal) == 24);

struct TobiiStreamError {
    std::int64_t system_us;
    std::int32_t error, source;
    const char* message;
};
inline constexpr std::int32_t tobii_stream_connection_lost = 0; ///< `error`
static_assert(sizeof(TobiiStreamError) == 24);

struct TobiiNotification {
    std::int64_t system_us;
    std::int32_t kind;
    char value[512]; ///< a text, a float or an area, by its kind
};
static_assert(sizeof(TobiiNotification) == 528 && offsetof(TobiiNotification, value) == 12);

/// `kind`, whose numbers are not those of the other version.
struct TobiiNotificationKinds {
    std::int32_t connection_lost, faults, warnings, buffer_overflow;
};
inline constexpr TobiiNotificationKinds tobii_notifications_1{0, 9, 10, -1};
inline constexpr TobiiNotificationKinds tobii_notifications_2{0, 8, 9, 10};

struct TobiiCalibrationEye {
    TobiiPoint2 on_display;
    std::int32_t validity; ///< 1: valid and used
};
struct TobiiCalibrationSample {
    TobiiCalibrationEye left, right;
};
struct TobiiCalibrationPoint {
    TobiiPoint2 on_display;
    TobiiCalibrationSample* samples;
    std::size_t sample_count;
};
struct TobiiCalibrationResult {
    TobiiCalibrationPoint* points;
    std::size_t point_count;
    std::int32_t status;
};
inline constexpr std::int32_t tobii_calibration_failed = 0, tobii_calibrated_left = 2,
                              tobii_calibrated_right = 3; ///< 1: both eyes
static_assert(sizeof(TobiiCalibrationSample) == 24 && sizeof(TobiiCalibrationPoint) == 24 &&
              sizeof(TobiiCalibrationResult) == 24);

/// The library, loaded. Callbacks come on threads of its own, with the last argument of their subscription.
class TobiiLibrary {
  public:
    /// Throws DeviceError if it lacks functions, which are named, or is of another version than 1 or 2.
    explicit TobiiLibrary(const SharedLibrary& library);

    const std::string& file() const noexcept { return file_; }
    const TobiiVersion& version() const noexcept { return version_; }

    TobiiStatus (*get_sdk_version)(TobiiVersion* version) = nullptr;
    TobiiStatus (*get_system_time_stamp)(std::int64_t* us) = nullptr;
    TobiiStatus (*find_all_eyetrackers)(TobiiEyeTrackers** trackers) = nullptr;
    void (*free_eyetrackers)(TobiiEyeTrackers* trackers) = nullptr;
    TobiiStatus (*get_eyetracker)(const char* address, TobiiEyeTracker** tracker) = nullptr;
    void (*free_string)(char* text) = nullptr;

    using GetText = TobiiStatus (*)(TobiiEyeTracker* tracker, char** text);
    GetText get_address = nullptr, get_serial_number = nullptr, get_model = nullptr,
            get_firmware_version = nullptr;
    TobiiStatus (*get_capabilities)(TobiiEyeTracker* tracker, std::int32_t* bits) = nullptr;
    TobiiStatus (*get_display_area)(TobiiEyeTracker* tracker, TobiiDisplayArea* area) = nullptr;
    TobiiStatus (*get_all_gaze_output_frequencies)(TobiiEyeTracker* tracker,
                                                   TobiiFrequencies** frequencies) = nullptr;
    void (*free_gaze_output_frequencies)(TobiiFrequencies* frequencies) = nullptr;
    TobiiStatus (*get_gaze_output_frequency)(TobiiEyeTracker* tracker, float* hz) = nullptr;
    TobiiStatus (*set_gaze_output_frequency)(TobiiEyeTracker* tracker, float hz) = nullptr;

    /// Of version 1 `gaze` is a TobiiGaze<TobiiOrigin1>, of version 2 a TobiiGaze<TobiiOrigin2>.
    using GazeCallback = void (*)(const void* gaze, void* user);
    using TimeSyncCallback = void (*)(const TobiiTimeSync* sync, void* user);
    using SignalCallback = void (*)(const TobiiSignal* signal, void* user);
    using StreamErrorCallback = void (*)(const TobiiStreamError* error, void* user);
    using NotificationCallback = void (*)(const TobiiNotification* notification, void* user);
    template <class Callback>
    using Subscribe = TobiiStatus (*)(TobiiEyeTracker* tracker, Callback callback, void* user);
    template <class Callback>
    using Unsubscribe = TobiiStatus (*)(TobiiEyeTracker* tracker, Callback callback);
    Subscribe<GazeCallback> subscribe_to_gaze = nullptr;
    Unsubscribe<GazeCallback> unsubscribe_from_gaze = nullptr;
    Subscribe<TimeSyncCallback> subscribe_to_time_sync = nullptr;
    Unsubscribe<TimeSyncCallback> unsubscribe_from_time_sync = nullptr;
    Subscribe<SignalCallback> subscribe_to_signals = nullptr;
    Unsubscribe<SignalCallback> unsubscribe_from_signals = nullptr;
    Subscribe<StreamErrorCallback> subscribe_to_stream_errors = nullptr;
    Unsubscribe<StreamErrorCallback> unsubscribe_from_stream_errors = nullptr;
    Subscribe<NotificationCallback> subscribe_to_notifications = nullptr;
    Unsubscribe<NotificationCallback> unsubscribe_from_notifications = nullptr;

    TobiiStatus (*enter_calibration)(TobiiEyeTracker* tracker) = nullptr;
    TobiiStatus (*leave_calibration)(TobiiEyeTracker* tracker) = nullptr;
    /// Returns when enough was measured, after 10 s at the latest.
    TobiiStatus (*collect_data)(TobiiEyeTracker* tracker, float x, float y) = nullptr;
    TobiiStatus (*discard_data)(TobiiEyeTracker* tracker, float x, float y) = nullptr;
    TobiiStatus (*compute_and_apply)(TobiiEyeTracker* tracker, TobiiCalibrationResult** result) = nullptr;
    void (*free_calibration_result)(TobiiCalibrationResult* result) = nullptr;

  private:
    std::string file_;
    TobiiVersion version_{};
};

/// From `file`; if that is empty, from OVERT_TOBII_LIBRARY, or the system's. Throws DeviceError.
std::shared_ptr<const TobiiLibrary> load_tobii(const std::string& file);

/// Such as "error 204: the connection failed".
std::string describe_tobii_status(TobiiStatus status);

/// A text that `get` tells of the tracker; empty if it does not.
std::string tobii_text(const TobiiLibrary& library, TobiiLibrary::GetText get, TobiiEyeTracker* tracker);

} // namespace overt
