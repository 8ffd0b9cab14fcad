/// What the operator's view shows of a running session, and the lines in which it travels over a socket:
/// JSON, one object a line, no line longer than longest_view_line bytes, but for a camera's image.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiment/units.h"

namespace overt {

/// Of the language. Both sides say theirs first; neither goes on with another.
inline constexpr int view_version = 3;
inline constexpr std::size_t longest_view_line = 131072;
/// Of a line with a camera's image.
inline constexpr std::size_t longest_camera_line = 131072;

/// A place on the display at which stimuli are shown.
struct ViewedSlot {
    std::string id;
    int left_px = 0, top_px = 0, width_px = 0, height_px = 0; ///< of its image
    bool holds(ScreenPoint place) const {
        return place.x_px >= left_px && place.y_px >= top_px && place.x_px < left_px + width_px &&
               place.y_px < top_px + height_px;
    }
};

/// What does not change while a session runs.
struct SessionFacts {
    std::string protocol, observer;
    std::string folder;              ///< of the session, absolute
    int trials = 0;                  ///< of the whole session
    double refresh_hz = 0.0;         ///< of the display
    int width_px = 0, height_px = 0; ///< of the display
    std::vector<ViewedSlot> slots;   ///< of the session, in its order
    int poses = 0;                   ///< of a stimulus
    bool has_tracker = false;
    bool is_timing_unproven = false; ///< missed refreshes are counted by times that nothing proves
    double drift_limit_deg = 0.0, mean_limit_deg = 0.0, max_limit_deg = 0.0; ///< of the protocol
    std::vector<std::string> skip_reasons;                                   ///< that `skip` may give, from 1
    /// What the machine's steady clock shows at session time 0, in seconds; nothing where time is virtual.
    std::optional<double> clock_zero_s;
};

/// Where gaze was: a sample of one eye, told as soon as it came.
struct ViewedGaze {
    bool is_right = true;
    std::optional<ScreenPoint> place; ///< nothing: the eye was lost
    int trial = -1;                   ///< -1: outside of trials
    int shown = -1;    ///< in whose slot it lay, an index into SessionView::shown; -1: in none that was lit
    int pose = -1;     ///< of that, lit when the sample came, as far as that was known then; -1: none was
    double at_s = 0.0; ///< session time at which it came
    std::int64_t sampled_us = 0; ///< by the tracker's clock
};
/// Of one line.
inline constexpr std::size_t longest_gaze = 32;

/// What the tracker's camera sees while it is set up, made small.
struct ViewedCamera {
    int width_px = 0, height_px = 0;
    std::vector<std::byte> rgb; ///< top row first, three bytes a pixel
    std::string title;
    static constexpr int most_width_px = 192, most_height_px = 144;
};

/// What the trial under way, or the last, shows in a slot.
struct ViewedStimulus {
    int slot = 0; ///< index into SessionFacts::slots
    std::string object, material;
    std::string light_file; ///< pictures of it (light_pictures.h), relative to the folder; may be empty
    int seen_in = 0;        ///< index of the view that it is seen in
    int pictures = 0;       ///< that `light_file` has
    int pose = -1;          ///< that is shown; -1: nothing is
    int picture = -1;       ///< of those in `light_file`; -1: not known
};

/// Everything that changes. Each line of it is complete, so that one that is left out does no harm.
struct SessionView {
    double time_s = 0.0;                 ///< session time of what is newest here
    std::string phase;                   ///< see name_of(SessionPhase)
    int trial = -1;                      ///< from 0; -1: none is under way
    std::string task, question;          ///< of the trial under way, or the last
    std::vector<ViewedStimulus> shown;   ///< likewise
    int done = 0;                        ///< trials that are completed
    int failed = 0;                      ///< attempts that did not count
    std::optional<double> first_trial_s; ///< session time at which the first trial of this sitting began
    int done_before = 0;                 ///< completed when that began
    int refresh = 0;                     ///< of the presentation under way
    std::int64_t missed = 0, missed_in_trial = 0; ///< refreshes
    std::int64_t samples = 0, lost = 0;           ///< of the session's trials; lost: without gaze
    std::int64_t samples_in_trial = 0, lost_in_trial = 0;
    std::optional<double> validation_mean_deg, validation_max_deg, drift_deg; ///< the last
    bool tracker_is_lost = false;
    std::string asks; ///< the question that the operator is to answer now; empty: none
    std::optional<double> level_rms,
        level_peak; ///< of the microphone, shares of full scale; while it records
    bool is_clipping = false;
    std::string answer;       ///< the last
    std::int64_t dropped = 0; ///< pieces of news that found no room on their way here
    bool is_over = false;     ///< nothing comes after this

    /// Whether any stimulus is lit.
    bool is_lit() const;
};

/// "vase, gold", or of several slots "left: vase, gold; right: bowl, gold".
std::string words_of_shown(const SessionFacts& facts, const SessionView& view);

/// Something that the record has, or that the session answers to a command.
struct ViewedEvent {
    double at_s = 0.0;
    int trial = -1; ///< -1: outside of trials
    std::string kind, detail;
};

/// Lines with their newlines; always valid UTF-8. A text that is too long is cut.
std::string line_of(const SessionFacts& facts);
std::string line_of(const SessionView& view);
std::string line_of(const ViewedEvent& event);
/// At most longest_gaze of them, oldest first.
std::string line_of(std::span<const ViewedGaze> gaze);
std::string line_of(const ViewedCamera& camera);

/// What a line of a session says; nothing in any of them for a line that is not understood.
struct ViewLine {
    std::optional<SessionFacts> facts;
    std::optional<SessionView> view;
    std::optional<ViewedEvent> event;
    std::vector<ViewedGaze> gaze;
    std::optional<ViewedCamera> camera;
    int version = 0; ///< of facts: what the session speaks, also if it is another language
};
ViewLine read_view_line(std::string_view line);

/// Seconds until all trials are done at the pace of those that are; nothing before the first of this sitting.
std::optional<double> time_left_s(const SessionFacts& facts, const SessionView& view);

/// Share of samples without gaze, 0 … 1; nothing without samples.
std::optional<double> lost_share(std::int64_t samples, std::int64_t lost);

} // namespace overt
