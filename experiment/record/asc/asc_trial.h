/// What stands besides samples in the ASC lines of one trial, in the order of its lines.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

#include "experiment/record/asc/asc_writer.h"
#include "experiment/record/read/session_record.h"

namespace overt {

/// The messages that say of which trial the samples are, what it showed and when, the begin and the end of
/// its recording, and what the tracker itself said. Where a trial's gaze was imported, the file's own lines
/// stand as they were, and only what it lacks is added.
class AscTrial {
  public:
    /// `clock_map`: of the trial's sitting; without one its screens have no times. Throws RecordError.
    AscTrial(const SessionRecord& record, const TrialRecord& trial, const std::optional<ClockMap>& clock_map,
             const AscLayout& layout);

    /// No line at all.
    bool is_empty() const { return lines_.empty(); }

    /// Writes what stands before the samples of this instant.
    void write_until(AscWriter& writer, std::span<const GazeSample> instant);
    /// Writes the rest.
    void finish(AscWriter& writer);

  private:
    struct Line {
        std::int64_t ms = 0;
        int recording = 0;            ///< how many recordings had begun before it
        bool after_samples = false;   ///< of the same millisecond
        bool begins_an_event = false; ///< SFIX, SSACC or SBLINK
        GazeEvent event;
    };
    void add_kept(const SessionRecord& record, const TrialRecord& trial);
    void add_missing(const SessionRecord& record, const TrialRecord& trial,
                     const std::optional<ClockMap>& clock_map, const AscLayout& layout);
    void add_message(std::int64_t ms, int recording, std::string text);
    bool has(std::string_view word) const;
    int count(GazeEvent::Kind kind) const;
    void add_setup(std::int64_t first, glm::ivec2 screen_px, const AscLayout& layout);
    void begin_recording(std::int64_t first, const AscLayout& layout);
    void end_recordings(std::int64_t after_last);
    void add_condition(const SessionRecord& record, const TrialRecord& trial, std::int64_t ms, int recording);
    static void write(AscWriter& writer, const Line& line);

    std::vector<Line> lines_;
    std::size_t written_ = 0;
};

/// Messages by which a session's own exports name a trial's screens, and its imports know them again.
inline constexpr std::string_view task_screen_message = "TASK_SCREEN_ONSET",
                                  onset_message = "PRESENTATION_ONSET", end_message = "PRESENTATION_END",
                                  response_screen_message = "RESPONSE_SCREEN_ONSET",
                                  response_message = "RESPONSE";

/// The screens that an attempt got to, by their messages.
std::vector<std::pair<std::string_view, SessionTime>> screens_of(const TrialRecord& attempt);

} // namespace overt
