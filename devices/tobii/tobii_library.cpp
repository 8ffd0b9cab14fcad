#include "devices/tobii/tobii_library.h"

#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {
namespace {

struct StatusText {
    TobiiStatus status;
    const char* text;
};

/// Those that an operator can do something about.
constexpr StatusText status_texts[] = {
    {2, "the library could not be initialized"},
    {14, "the tracker's display area is not set: do so in Tobii's Eye Tracker Manager"},
    {18, "the licence that the tracker holds could not be applied; it may have expired"},
    {201, "it needs a licence that this tracker has not"},
    {202, "this tracker cannot do it"},
    {203, "the tracker is not available"},
    {204, "the connection failed"},
    {205, "the tracker did not answer in time"},
    {210, "a calibration is under way already, perhaps by another program"},
    {215, "another program uses the library in a way that does not go together with this one"},
    {216, "the tracker is busy with a calibration"},
    {218, "too many programs take this tracker's gaze"},
    {220, "the tracker's firmware does not answer"},
};

} // namespace

TobiiLibrary::TobiiLibrary(const SharedLibrary& library) : file_(library.file()) {
    std::vector<std::string> missing;
    const auto require = [&](auto*& function, const char* name) {
        library.require(function, fmt::format("tobii_research_{}", name).c_str(), missing);
    };
    require(get_sdk_version, "get_sdk_version");
    require(get_system_time_stamp, "get_system_time_stamp");
    require(find_all_eyetrackers, "find_all_eyetrackers");
    require(free_eyetrackers, "free_eyetrackers");
    require(get_eyetracker, "get_eyetracker");
    require(free_string, "free_string");
    require(get_address, "get_address");
    require(get_serial_number, "get_serial_number");
    require(get_model, "get_model");
    require(get_firmware_version, "get_firmware_version");
    require(get_capabilities, "get_capabilities");
    require(get_display_area, "get_display_area");
    require(get_all_gaze_output_frequencies, "get_all_gaze_output_frequencies");
    require(free_gaze_output_frequencies, "free_gaze_output_frequencies");
    require(get_gaze_output_frequency, "get_gaze_output_frequency");
    require(set_gaze_output_frequency, "set_gaze_output_frequency");
    require(subscribe_to_gaze, "subscribe_to_gaze_data");
    require(unsubscribe_from_gaze, "unsubscribe_from_gaze_data");
    require(subscribe_to_time_sync, "subscribe_to_time_synchronization_data");
    require(unsubscribe_from_time_sync, "unsubscribe_from_time_synchronization_data");
    require(subscribe_to_signals, "subscribe_to_external_signal_data");
    require(unsubscribe_from_signals, "unsubscribe_from_external_signal_data");
    require(subscribe_to_stream_errors, "subscribe_to_stream_errors");
    require(unsubscribe_from_stream_errors, "unsubscribe_from_stream_errors");
    require(subscribe_to_notifications, "subscribe_to_notifications");
    require(unsubscribe_from_notifications, "unsubscribe_from_notifications");
    require(enter_calibration, "screen_based_calibration_enter_calibration_mode");
    require(leave_calibration, "screen_based_calibration_leave_calibration_mode");
    require(collect_data, "screen_based_calibration_collect_data");
    require(discard_data, "screen_based_calibration_discard_data");
    require(compute_and_apply, "screen_based_calibration_compute_and_apply");
    require(free_calibration_result, "free_screen_based_calibration_result");
    if (!missing.empty())
        throw DeviceError(fmt::format("{} is no library of Tobii's that can be used: it lacks {}; install "
                                      "the Tobii Pro SDK, version 1.11 or later.",
                                      file_, fmt::join(missing, ", ")));
    if (const TobiiStatus status = get_sdk_version(&version_); status != tobii_ok)
        throw DeviceError(
            fmt::format("{} does not tell its version ({}).", file_, describe_tobii_status(status)));
    if (version_.major != 1 && version_.major != 2)
        throw DeviceError(fmt::format("{} is version {}.{} of the Tobii Pro SDK: overt knows the data of "
                                      "versions 1 and 2; install one of them.",
                                      file_, version_.major, version_.minor));
}

std::shared_ptr<const TobiiLibrary> load_tobii(const std::string& file) {
    const SharedLibrary library(
        library_candidates(file, vendor_library("tobii")), "Tobii's library (Tobii Pro SDK)",
        "Install it (Tobii gives the SDK for C at developer.tobiipro.com), or name the file "
        "libtobii_research.so with --library tobii=FILE or in the environment variable OVERT_TOBII_LIBRARY.");
    return std::make_shared<const TobiiLibrary>(library);
}

std::string describe_tobii_status(TobiiStatus status) {
    for (const StatusText& known : status_texts)
        if (known.status == status)
            return fmt::format("error {}: {}", status, known.text);
    return fmt::format("error {}", status);
}

std::string tobii_text(const TobiiLibrary& library, TobiiLibrary::GetText get, TobiiEyeTracker* tracker) {
    char* text = nullptr;
    if (get(tracker, &text) != tobii_ok || !text)
        return {};
    std::string copy = text;
    library.free_string(text);
    return copy;
}

} // namespace overt
