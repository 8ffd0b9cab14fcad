/// A tracker's samples, its events and its file as rows of a session's tables, there and back.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include <SQLiteCpp/SQLiteCpp.h>

#include "experiment/events/event_settings.h"
#include "experiment/gaze_event.h"
#include "experiment/ports/recorded_calibration.h"
#include "experiment/ports/tracker_items.h"

namespace overt {

/// The trial_id of rows between a trial's result and the next trial, which belong to no trial: they are kept
/// by the trial that they come after. Those before the first trial have 0.
constexpr std::int64_t after_trial(std::int64_t trial_id) { return -trial_id; }

/// Inserts rows of one trial after another, within the caller's transaction. All throw SQLite::Exception.
class GazeRows {
  public:
    /// Makes the tables of events where they are not there: sessions of earlier programs have none. The
    /// database must outlive this.
    explicit GazeRows(SQLite::Database& database);

    /// What follows belongs to this trial, or comes after it (after_trial), and has no rows yet; 0: before
    /// all.
    void begin_trial(std::int64_t trial_id);
    void sample(const GazeSample& sample);
    void event(const GazeEvent& event);
    void detail(const SampleDetail& detail);
    /// Of a sitting; not of the trial that was begun.
    void calibration(int sitting, const RecordedCalibration& calibration);
    /// Notes a line of the sitting's file that could not be read: an event outside of trials, at the
    /// session's begin, for nobody knows when it was.
    void line_left_out(int sitting, const std::string& detail);
    void source(int sitting, const GazeSource& source);
    /// Who tells the events of that sitting, if it is not its tracker.
    void detection(int sitting, const EventDetection& detection);

  private:
    SQLite::Database& database_;
    SQLite::Statement insert_sample_, insert_event_, insert_detail_;
    std::int64_t trial_id_ = 0, samples_ = 0, events_ = 0, outside_events_ = 0, details_ = 0;
};

/// In the order in which they were written. Throws SQLite::Exception.
void read_gaze_events(const SQLite::Database& database, std::int64_t trial_id,
                      const std::function<void(const GazeEvent&)>& take);

/// In the order in which they were recorded; none of a session of earlier programs. Throws SQLite::Exception.
std::vector<RecordedCalibration> read_calibrations(const SQLite::Database& database, int sitting);

/// Nothing if the program did not detect events of the sitting itself. Throws SQLite::Exception.
std::optional<EventDetection> read_event_detection(const SQLite::Database& database, int sitting);

/// Nothing if the sitting's gaze came from no file. Throws SQLite::Exception.
std::optional<GazeSource> read_gaze_source(const SQLite::Database& database, int sitting);

} // namespace overt
