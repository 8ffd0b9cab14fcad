/// The kinds of events that a session's record has, by the words that stand in the record and in its exports.
/// What is written under a name here is read by that name: a word that changes makes older sessions say
/// something else.
#pragma once

#include <string_view>

namespace overt {

// Steps of a session that have no rows of their own; each change of phase is a phase_event (session_phase.h).
/// Which session of this observer begins, and what became of those before. Not in one that is run again.
inline constexpr std::string_view earlier_sessions_event = "earlier sessions";
inline constexpr std::string_view text_shown_event = "text shown"; ///< to the observer; which
inline constexpr std::string_view practice_event = "practice";     ///< begins: number and condition
inline constexpr std::string_view practice_answered_event = "practice answered";
inline constexpr std::string_view practice_skipped_event = "practice skipped";
inline constexpr std::string_view break_begins_event = "break begins";
inline constexpr std::string_view break_ends_event = "break ends";
inline constexpr std::string_view session_completed_event = "session completed";
inline constexpr std::string_view session_aborted_event = "session aborted"; ///< and why
/// The program came to a sudden end in this sitting: at what, and in which library.
inline constexpr std::string_view program_crashed_event = "program crashed";

// What happened in a trial, or to it.
inline constexpr std::string_view trial_failed_event = "trial failed"; ///< and what becomes of it
inline constexpr std::string_view level_chosen_event =
    "level chosen"; ///< by a procedure, and where it stands
inline constexpr std::string_view drift_check_failed_event = "drift check failed";
inline constexpr std::string_view drift_checked_event = "drift checked"; ///< for the operator: what was found
inline constexpr std::string_view presentation_broken_off_event = "presentation broken off";
inline constexpr std::string_view response_timed_out_event = "response timed out";
inline constexpr std::string_view answer_recording_event = "answer recording"; ///< what is to be known of it
inline constexpr std::string_view machine_slept_event = "machine slept";
inline constexpr std::string_view wall_clock_set_event = "wall clock was set";

// What the operator did.
inline constexpr std::string_view operator_event = "operator";
inline constexpr std::string_view operator_pressed_event = "operator pressed";
inline constexpr std::string_view operator_asked_event = "operator asked"; ///< was asked
inline constexpr std::string_view operator_answered_event = "operator answered";
inline constexpr std::string_view operator_view_event = "operator's view"; ///< a command that came from there
inline constexpr std::string_view operator_note_event =
    "operator's note"; ///< a remark, in the operator's words

// Of the equipment.
inline constexpr std::string_view validation_event =
    "validation"; ///< of a calibration: mean and largest error
inline constexpr std::string_view calibrated_event = "calibrated"; ///< by the tracker, which tells no errors
inline constexpr std::string_view calibration_failed_event = "calibration failed"; ///< or was cancelled
inline constexpr std::string_view tracker_event = "eye tracker"; ///< what it is, and what it told at its end
inline constexpr std::string_view tracker_lost_event = "eye tracker lost";
inline constexpr std::string_view tracker_regained_event = "eye tracker regained"; ///< connected again
/// What befell one, in the record of the session's own: its id, and the event as its own record has it.
inline constexpr std::string_view further_tracker_event = "further eye tracker";
inline constexpr std::string_view keyboard_event = "keyboard"; ///< another window took it, or gave it back
inline constexpr std::string_view response_box_event = "response box"; ///< what it is
inline constexpr std::string_view response_box_lost_event = "response box lost";
inline constexpr std::string_view response_box_regained_event = "response box regained";
inline constexpr std::string_view marker_output_event = "marker output"; ///< what it is, or what it failed at
inline constexpr std::string_view tracker_clock_jumped_event =
    "eye tracker's clock jumped";                                            ///< and by how much
inline constexpr std::string_view tracker_fault_event = "eye tracker fault"; ///< a simulated one that struck
/// What was proved on this rig when it was set up (overt doctor --first-day), and by which page.
inline constexpr std::string_view rig_page_event = "rig page";
inline constexpr std::string_view screen_event = "screen"; ///< a finding about it
/// What of it is not what it was when the session began: its mode, a compositor, the gamma table, the window.
inline constexpr std::string_view screen_changed_event = "screen changed";
/// What a check of the presentation found before the first trial: misses, and the distribution of times.
inline constexpr std::string_view presentation_check_event = "presentation check";
inline constexpr std::string_view thread_event = "thread"; ///< how the program's threads are scheduled
inline constexpr std::string_view output_verified_event = "output verified";
inline constexpr std::string_view display_box_event = "display box";
inline constexpr std::string_view display_box_lost_event = "display box lost";
inline constexpr std::string_view display_box_left_event = "display box left";
inline constexpr std::string_view display_fault_event = "display fault"; ///< a simulated one that struck
/// The text of the faults that a display was made to have, and an eye tracker.
inline constexpr std::string_view simulated_faults_event = "simulated display faults";
inline constexpr std::string_view simulated_tracker_faults_event = "simulated eye tracker faults";

} // namespace overt
