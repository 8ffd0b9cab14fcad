/// The command that runs a session.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/chosen_command.h"
#include "app/cli/context_choice.h"
#include "app/inputs/protocol_inputs.h"
#include "app/rig/rig.h"
#include "experiment/ports/session_history.h"
#include "experiment/protocol/protocol.h"
#include "experiment/record/resumption.h"

namespace overt {

void add_session_commands(CLI::App& app, ChosenCommand& chosen);

/// Where the observer's form is filled in as far as the command line does not.
enum class AskAt { window, terminal, nobody };

struct RunOptions {
    std::filesystem::path protocol;
    std::string observer;
    std::optional<int> session_number;
    bool is_another_person = false;     ///< see SessionPlace
    std::optional<ResumePolicy> resume; ///< take up an interrupted session: this one, or the last there is
    std::optional<std::uint64_t> seed;
    std::optional<std::uint64_t> simulate_observer;
    std::vector<std::string> observer_fields; ///< ID=VALUE
    AskAt ask_at = AskAt::window;
    std::vector<std::string> operator_keys; ///< of a simulated operator, see read_operator_key()
    std::string tracker;                    ///< kind, instead of the protocol's; empty: that
    std::string tracker_address;            ///< the same
    ContextChoice context;
    bool virtual_time = false;
    bool draws_stimuli = true;
    bool windowed = false;
    std::filesystem::path sessions = "sessions";
    std::optional<int> trials; ///< only the first so many
    MapTime maps = MapTime::automatic;
    bool verify_output = false;   ///< decode every page before the first trial
    std::filesystem::path faults; ///< of a display that only keeps time; empty: none
    bool realtime = false;        ///< ask for priority and locked memory
    std::optional<int> processor; ///< the only one for the session's thread
    std::filesystem::path print_session_to;
    std::optional<std::filesystem::path>
        operator_socket;          ///< for `overt watch`; empty: in the session's folder
    std::string monitor;          ///< see MonitorWish; empty: the protocol's
    double refresh_check_s = 5.0; ///< measure a real screen's refresh for so long; 0: not at all
    std::optional<BakeQuality>
        quality; ///< that the frames have at least; nothing: the protocol's for this observer
};
int run_session(const RunOptions& options);

/// A sitting that is presented again from its record.
struct PresentingAgain {
    std::vector<RecordedOption> options; ///< go into the new record as they are in the old
    std::filesystem::path cache;         ///< of frames and maps
    /// After each attempt; what it throws ends the sitting, and what was recorded by then is kept.
    std::function<void()> trial_done = {};
};

/// The same with what its protocol holds already read: `options.protocol` is not looked at. Throws as
/// run_session() does.
int run_session_again(const Experiment& experiment, const RunOptions& options, const PresentingAgain& again);

} // namespace overt
