/// What is said to an EyeLink in words, and what it answers: commands, modes, messages, names of files. Pure
/// functions.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "devices/tracker/tracker_driver.h"

namespace overt {

/// How an EyeLink is reached and set.
struct EyelinkSettings {
    std::string library;               ///< file; empty: see EyelinkLibrary
    std::string address = "100.1.1.1"; ///< of the host computer, as it is delivered
    bool is_dummy = false;             ///< the library without a tracker: to try an experiment out
    int calibration_points = 9;        ///< 3, 5, 9 or 13
    double target_deg = 0.6;           ///< diameter of the targets
    SessionDuration drift_patience = std::chrono::seconds(30); ///< for one check
    /// Where it is noted which files stay on the host, see left_on_host.h; empty: nowhere.
    std::filesystem::path notes = {};
};

/// A rate that the tracker offers as it is mounted now.
struct EyelinkMode {
    int rate_hz = 0;
    bool can_both_eyes = false;
};

/// Of the tracker's variable read_mode_list, such as "250B 500B 1000B 2000": rates with letters, of which B
/// says that both eyes can be recorded. What is no rate is passed over.
std::vector<EyelinkMode> eyelink_modes(std::string_view list);

/// The mode nearest to what is wished: the highest rate that is not above it, with both eyes if they are
/// wished and any mode has them; if all are above, the lowest. With an empty list (a host that tells none)
/// the rate as wished, but of both eyes 1000 Hz at most.
struct EyelinkGrant {
    int rate_hz = 0;
    bool both_eyes = false;
};
EyelinkGrant eyelink_grant(std::span<const EyelinkMode> modes, const TrackerWish& wish);

struct EyelinkCommand {
    std::string text;
    bool is_needed = false; ///< without it what is recorded means something else
    /// Its variable is read back: a host takes what it does not understand without a word.
    bool is_read_back = false;
};

/// The version of the host's software, 5.12 of "EYELINK CL 5.12"; nothing if none is told.
std::optional<double> eyelink_software_version(std::string_view model);

/// What sets a tracker up for a session, in the order in which it is sent. `software`: from version 4 on
/// samples in the file have the place of the target that observers without a head rest wear.
std::vector<EyelinkCommand> eyelink_commands(const TrackerWish& wish, const EyelinkSettings& settings,
                                             const EyelinkGrant& grant, std::optional<double> software);

/// The variable that a command sets, and to what: "sample_rate" and "1000" of "sample_rate = 1000".
struct EyelinkVariable {
    std::string_view name, value;
};
EyelinkVariable eyelink_variable(std::string_view command);

/// Whether the host's word for a value is ours: numbers however they are written, lists in any order, YES and
/// ON and 1.
bool eyelink_means_same(std::string_view asked, std::string_view told);

/// "DISPLAY_COORDS 0 0 1919 1079", for those who read the file.
std::string eyelink_display_coords(const ScreenGeometry& screen);

/// The name of a data file on the host, without ".edf", for one that is opened at `at`: the last two letters
/// or digits of whom it is for, in capitals (or 0 where there are fewer), and the seconds since the beginning
/// of 2020 (UTC) in six digits of base 36, which last until 2088. The host replaces a file of the same name
/// without a word, so that no two may have the same: not of two observers, sessions or sittings, nor of two
/// experiments that share a host, nor before and after a connection was lost.
std::string eyelink_file_name(std::string_view whom, std::chrono::sys_seconds at);

/// A message as it goes into the data file: a leading number says how many milliseconds ago it happened. Not
/// before the messages that viewers look for at the beginning (TRIALID, TRIAL_RESULT, !V …), whose time has
/// no meaning. Writes into `into` and gives what was written, cut where it does not fit. Allocates nothing.
std::string_view eyelink_message(std::string_view text, SessionDuration age, std::span<char> into) noexcept;

/// From the tracker's sentence on a validation, such as "… ERROR 0.45 avg. 0.76 max OFFSET 0.02 deg. …".
std::optional<ValidationResult> eyelink_validation(std::string_view sentence);

/// How many targets its calibration had, from the same: 9 of "VALIDATION HV9 …".
std::optional<int> eyelink_targets(std::string_view sentence);

/// Degrees from the tracker's sentence on a check of drift, "… OFFSET 0.35 deg. 11.4,-4.5 pix.".
std::optional<Degrees> eyelink_drift(std::string_view sentence);

/// A sentence for what opening the connection gave; nothing for 0.
std::optional<std::string> eyelink_connection_problem(std::int16_t result, const std::string& address);

/// A sentence for what fetching the file gave; nothing for a number of bytes.
std::optional<std::string> eyelink_transfer_problem(std::int32_t result);

} // namespace overt
