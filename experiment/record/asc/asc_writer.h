/// Lines of EyeLink's text form (ASC), in the layout that edf2asc gives them and that readers count on.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "experiment/base/output_file.h"
#include "experiment/gaze_event.h"

namespace overt {

/// What is the same in all of a file; eyes and rate may change from one recording to the next.
struct AscLayout {
    bool has_left = false, has_right = true;
    double rate_hz = 1000.0;
    bool pupil_is_diameter = false;
    std::optional<double> px_per_deg_x, px_per_deg_y; ///< at the middle of the screen
    std::int64_t base_ms = 0;                         ///< taken from every time
    bool fractional_times = false; ///< times with their microseconds instead of whole milliseconds
    bool has_status = true;        ///< of each sample, as SAMPLES says with TRACKING

    std::string_view eyes() const { return has_left ? (has_right ? "LR" : "L") : "R"; }
    std::string_view eye_names() const { return has_left ? (has_right ? "LEFT\tRIGHT" : "LEFT") : "RIGHT"; }
};

/// What a START says, besides its time.
struct AscStart {
    bool left = false, right = false;
    bool pupil_is_diameter = false;
    std::string tracking; ///< at the end of the layout's lines, such as " TRACKING CR FILTER 2"; may be empty
};

/// As EyeLinks have it.
inline constexpr std::string_view usual_tracking = " TRACKING CR FILTER 2";

/// From GazeEvent::Kind::started's text; of one that names no eye the layout's.
AscStart asc_start(std::string_view text, const AscLayout& layout);

/// Whole milliseconds of the tracker's clock, as ASC has times: fractions are left out, so that at 2000 Hz
/// each number stands twice.
std::int64_t asc_milliseconds(TrackerTime time);

/// Everything is ASCII: other characters become \uXXXX. Times are given in the tracker's clock and written
/// less the layout's base.
class AscWriter {
  public:
    /// Makes the file. Throws RecordError.
    AscWriter(const std::filesystem::path& file, const AscLayout& layout) : file_(file), layout_(layout) {}

    const AscLayout& layout() const { return layout_; }

    /// A line as it is.
    void line(std::string_view text);
    /// A line without a time, such as of a calibration's table.
    void note(std::string_view text);
    void message(TrackerTime at, std::string_view text);
    /// The eyes of the recording that is to begin.
    void set_eyes(const AscStart& start);
    /// START with what is recorded, at the rate that the last message RECCFG named.
    void start(TrackerTime at, const AscStart& start);
    /// END; `resolution` as in GazeEvent::Kind::ended, or empty: the layout's.
    void end(TrackerTime at, std::string_view resolution);
    /// Samples of one instant: one of each recorded eye, at most; an eye without one has no gaze.
    void samples(std::span<const GazeSample> samples);
    /// SFIX, SSACC or SBLINK.
    void event_begin(const GazeEvent& event);
    /// EFIX, ESACC or EBLINK.
    void event_end(const GazeEvent& event);
    /// BUTTON or INPUT.
    void port(const GazeEvent& event);

    std::int64_t lines() const { return lines_; }
    std::int64_t bytes() const { return file_.size(); }
    void close() { file_.close(); }

  private:
    void eye(const GazeSample* sample);
    /// In milliseconds: whole ones, or with what is left of a fraction.
    std::string written(TrackerTime time) const;
    std::string written(TrackerClock::duration duration) const;
    void end_line();

    OutputFile file_;
    AscLayout layout_;
    std::int64_t lines_ = 0;
};

} // namespace overt
