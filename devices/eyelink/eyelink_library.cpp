#include "devices/eyelink/eyelink_library.h"

#include <vector>

#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {
namespace {

constexpr const char* where_to_get_it =
    "Install the EyeLink Developers Kit, which SR Research gives to "
    "owners of a tracker after they register at "
    "www.sr-research.com/support, or name the file libeyelink_core.so with "
    "--library eyelink=FILE or in the environment "
    "variable OVERT_EYELINK_LIBRARY.";

/// Gives the names that the library lacks.
std::vector<std::string> find_required(const SharedLibrary& library, EyelinkFunctions& of) {
    std::vector<std::string> missing;
    const auto find = [&](auto*& function, const char* name) { library.require(function, name, missing); };
    find(of.set_eyelink_address, "set_eyelink_address");
    find(of.open_eyelink_connection, "open_eyelink_connection");
    find(of.close_eyelink_connection, "close_eyelink_connection");
    find(of.eyelink_is_connected, "eyelink_is_connected");
    find(of.eyelink_get_tracker_version, "eyelink_get_tracker_version");
    find(of.eyecmd_printf, "eyecmd_printf");
    find(of.eyemsg_printf, "eyemsg_printf");
    find(of.eyelink_read_request, "eyelink_read_request");
    find(of.eyelink_read_reply, "eyelink_read_reply");
    find(of.eyelink_last_message, "eyelink_last_message");
    find(of.open_data_file, "open_data_file");
    find(of.close_data_file, "close_data_file");
    find(of.set_offline_mode, "set_offline_mode");
    find(of.do_tracker_setup, "do_tracker_setup");
    find(of.do_drift_correct, "do_drift_correct");
    find(of.exit_calibration, "exit_calibration");
    find(of.eyelink_cal_result, "eyelink_cal_result");
    find(of.eyelink_cal_message, "eyelink_cal_message");
    find(of.start_recording, "start_recording");
    find(of.check_recording, "check_recording");
    find(of.stop_recording, "stop_recording");
    find(of.check_record_exit, "check_record_exit");
    find(of.eyelink_wait_for_block_start, "eyelink_wait_for_block_start");
    find(of.eyelink_eye_available, "eyelink_eye_available");
    find(of.eyelink_get_next_data, "eyelink_get_next_data");
    find(of.eyelink_get_float_data, "eyelink_get_float_data");
    find(of.eyelink_reset_data, "eyelink_reset_data");
    find(of.eyelink_request_time, "eyelink_request_time");
    find(of.eyelink_read_time, "eyelink_read_time");
    find(of.setup_graphic_hook_functions, "setup_graphic_hook_functions");
    find(of.receive_data_file, "receive_data_file");
    return missing;
}

void find_optional(const SharedLibrary& library, EyelinkFunctions& of) {
    const auto find = [&](auto*& function, const char* name) { library.find(function, name); };
    find(of.setup_graphic_hook_functions_V2, "setup_graphic_hook_functions_V2");
    find(of.receive_data_file_feedback, "receive_data_file_feedback");
    find(of.eyelink_tracker_double_usec, "eyelink_tracker_double_usec");
    find(of.eyelink_mode_data, "eyelink_mode_data");
}

} // namespace

EyelinkLibrary::EyelinkLibrary(const std::string& path)
    : library_(library_candidates(path, vendor_library("eyelink")), "The EyeLink's library",
               where_to_get_it) {
    const std::vector<std::string> missing = find_required(library_, functions_);
    if (!missing.empty())
        throw DeviceError(fmt::format("{} is no EyeLink library that overt can use: it lacks {}. {}",
                                      library_.file(), fmt::join(missing, ", "), where_to_get_it));
    find_optional(library_, functions_);
}

} // namespace overt
