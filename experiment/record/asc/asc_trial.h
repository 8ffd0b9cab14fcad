/// What stands besides samples in the ASC lines of one trial, in the order of its lines.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "experiment/ports/trial_mark.h"
#include "experiment/record/asc/asc_recordings.h"
#include "experiment/record/read/session_record.h"

namespace overt {

/// The messages that say of which trial the samples are, what it showed and when, the begin and the end of
/// its recording, and what the tracker itself said. Where a trial's gaze was imported, the file's own lines
/// stand in their own order, and only messages that it lacks are added.
class AscTrial {
  public:
    struct Messages {
        bool of_opensesame = false; ///< start_trial, end_trial, phases and variables, too
    };
    /// `clock_map`: of the trial's sitting; without one its screens have no times. `after`: the last line of
    /// the attempt before it, than which its TRIALID is later, so that no order by times mixes them. Throws
    /// RecordError.
    AscTrial(const SessionRecord& record, const TrialRecord& trial, const std::optional<ClockMap>& clock_map,
             const AscLayout& layout, Messages messages, std::optional<TrackerTime> after);

    /// The tracker's own lines outside of trials, in their order; `origin`: of the fixations, saccades and
    /// blinks among them.
    AscTrial(std::vector<GazeEvent> events, const SessionRecord::EventOrigin& origin,
             const AscLayout& layout);

    /// Writes what stands before the samples of this instant.
    void write_until(AscRecordings& to, std::span<const GazeSample> instant);
    /// Writes the rest.
    void finish(AscRecordings& to);
    /// The latest time of its lines, as it is written; nothing without any.
    std::optional<TrackerTime> last() const;

  private:
    /// Where a line stands among samples.
    struct Place {
        TrackerTime at;             ///< in whole milliseconds, if the file has such
        bool after_samples = false; ///< of the same time
        bool begins_an_event = false;
        auto operator<=>(const Place&) const = default;
    };
    struct Line {
        Place place;
        TrackerTime at;
        bool begins_an_event = false; ///< SFIX, SSACC or SBLINK
        GazeEvent event;
    };
    Line line_of(GazeEvent event, bool begins_an_event = false) const;
    Line message_at(TrackerTime at, std::string text) const;
    TrackerTime rounded(TrackerTime at) const;
    void keep(std::vector<GazeEvent> events);
    void keep(std::vector<GazeEvent> events, const SessionRecord::EventOrigin& origin);
    void insert(Line line);
    void insert_detected(std::vector<GazeEvent> events);
    void add_missing(const SessionRecord& record, const TrialRecord& trial,
                     const std::optional<ClockMap>& clock_map);
    void write_down(const SessionRecord& record, const TrialRecord& trial,
                    const std::optional<ClockMap>& clock_map, std::optional<TrackerTime> after);
    void insert_told(std::vector<GazeEvent> events);
    void frame_for_opensesame(const SessionRecord& record, const TrialRecord& trial);
    bool has(std::string_view word) const;
    /// The latest time of the lines, or this if they are earlier.
    TrackerTime latest(TrackerTime at) const;
    void settle_places();

    AscLayout layout_;
    std::vector<Line> lines_;
    std::size_t written_ = 0;
};

/// Messages by which a session's own exports name a trial's screens, and its imports know them again.
inline constexpr std::string_view task_screen_message = "TASK_SCREEN_ONSET",
                                  onset_message = "PRESENTATION_ONSET", end_message = presentation_end_mark,
                                  response_screen_message = "RESPONSE_SCREEN_ONSET",
                                  response_message = "RESPONSE";
/// In the header of a session's own export, before the name of the tracker that was there.
inline constexpr std::string_view own_tracker_remark = "** REMARK: overt recorded this with the tracker: ";
/// In exports and recordings of earlier programs.
inline constexpr std::string_view earlier_end_message = "PRESENTATION_END";

/// The screens that an attempt got to, by their messages.
std::vector<std::pair<std::string_view, SessionTime>> screens_of(const TrialRecord& attempt);

} // namespace overt
