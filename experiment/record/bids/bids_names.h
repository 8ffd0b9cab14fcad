/// Names of the files of a session in a BIDS dataset.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "experiment/record/session_header.h"

namespace overt {

inline constexpr std::string_view bids_version = "1.11.1";

/// Whether a session is nothing but a recording made elsewhere: the program showed nothing in it.
bool was_recorded_elsewhere(const SessionHeader& header);

/// What was done, in words: the protocol's title. Of an imported recording, whose title says which file it
/// was, the task that it was imported as.
std::string bids_task_name(const SessionHeader& header);

/// One sitting of a session: a run, for the tracker's clock may have begun anew with it.
struct BidsNames {
    std::string subject; ///< "07" of sub-07
    std::string session; ///< "01" of ses-01
    std::string task;    ///< letters and digits of the protocol's name

    explicit BidsNames(const SessionHeader& header);

    /// sub-07/ses-01/beh
    std::filesystem::path folder() const;
    /// sub-07_ses-01_task-name_
    std::string task_stem() const;
    /// sub-07_ses-01_task-name_run-01
    std::string run_stem(int run) const;
    /// The same with _recording-eye1; eyes count from 1.
    std::string eye_stem(int run, int eye) const;
    /// Of the derivative, whose files have other names than the raw ones:
    /// sub-07_ses-01_task-name_acq-surface_run-01_recording-eye1. BIDS 1.11 allows no desc- for beh.
    std::string surface_stem(int run, int eye) const;
    std::string surface_run_stem(int run) const;
};

} // namespace overt
