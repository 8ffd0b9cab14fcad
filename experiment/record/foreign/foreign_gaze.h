/// The gaze of another program's tables, sample by sample in the order of time.
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiment/gaze.h"
#include "experiment/record/foreign/gaze_columns.h"
#include "experiment/screen_geometry.h"

namespace overt {

/// A text that somebody sent to the tracker, or the value of a column that changed.
struct GazeMark {
    TrackerTime at;
    std::string text;
    bool is_trial = false; ///< of the column that names what was shown; empty text: nothing
};

struct ForeignItem {
    TrackerTime at;
    std::optional<GazeSample> sample; ///< nothing: a mark
    GazeMark mark;
};

/// Told each row that could not be read: "FILE:LINE: why".
using RowReport = std::function<void(const std::string&)>;

/// Reads one file. Rows that cannot be read are reported and left out.
class GazeFileReader {
  public:
    /// Throws InputError as ForeignTable, or if a column is not there.
    GazeFileReader(const std::filesystem::path& file, const GazeColumns& columns,
                   const ScreenGeometry& screen, double us_per_unit, RowReport report);
    /// The next sample or mark; false after the last. Samples of two eyes of one row come left eye first.
    bool next(ForeignItem& item);
    const ForeignTable& table() const { return table_; }
    /// How finely its times are written: a whole unit, or that of the last decimal of any so far.
    TrackerClock::duration tick() const;

  private:
    struct EyeAt {
        std::size_t x, y;
        std::optional<std::size_t> pupil, validity;
    };
    std::optional<EyeAt> eye_at(const GazeColumns::OfEye& eye, const char* which) const;
    bool read_row();
    /// Of the row's sample: `at`, or the finer clock's time where there is one.
    TrackerTime sample_time(TrackerTime at);
    bool is_of_sample() const;
    void add_sample(TrackerTime at, Eye eye, const EyeAt& columns);
    void add_marks(TrackerTime at);
    bool is_valid(std::string_view cell) const;
    ScreenPoint on_screen(double x, double y) const;
    void left_out(const std::string& why);

    ForeignTable table_;
    GazeColumns columns_;
    ScreenGeometry screen_;
    double us_per_unit_;
    RowReport report_;
    std::size_t time_;
    std::optional<EyeAt> left_, right_, single_;
    std::optional<std::size_t> eye_, mark_, mark_value_, trial_, kind_, fine_time_;
    double fine_shift_us_ = 0.0; ///< of the finer clock to `time`, in the mean of the samples before
    int samples_in_shift_ = 0;
    std::string last_mark_, last_trial_;
    std::size_t decimals_ = 0; ///< of times, the most so far
    std::deque<ForeignItem> ready_;
};

/// What the files hold, found by reading them once.
struct GazeSurvey {
    GazeColumns columns; ///< of the first file, with its unit of time
    std::int64_t samples = 0, without_gaze = 0, rows_left_out = 0;
    bool has_left = false, has_right = false;
    TrackerTime first, last;        ///< of samples
    double rate_hz = 0.0;           ///< by the median of the samples' spacing
    TrackerClock::duration tick{1}; ///< how finely the times are written
    std::vector<GazeMark> marks;
    std::vector<std::string> remarks;
};

/// How files of gaze are to be read.
struct GazeReading {
    bool takes_any_gaze = false; ///< also of places that may not lie on the screen
    /// Of an EyeLink's recording: what stands in place of lost values (nothing: it is found), and the least
    /// share of its lines that must be readable.
    std::optional<std::string> missing = {};
    double least_read = 0.9;
};

class AscGaze;

/// One recording in one file or more: of both eyes, or of gaze and of marks.
class ForeignGaze {
  public:
    /// `given`: the columns of the first file; nothing: known_gaze_columns(). Finds the unit of time, and
    /// files that belong to the first (BIDS). Recordings of an EyeLink (is_asc_file()) have no columns.
    /// Throws InputError.
    ForeignGaze(std::vector<std::filesystem::path> files, const std::optional<GazeColumns>& given,
                const ScreenGeometry& screen, const GazeReading& reading = {});
    ~ForeignGaze();

    /// Its messages say which trials there were (trials_in_messages()).
    bool has_messages() const { return asc_ != nullptr; }

    /// Reads all of it. Throws InputError if times go back, if there is no sample, or if fewer than half of
    /// the rows can be read.
    GazeSurvey survey(const RowReport& report) const;
    /// Each sample and mark in the order of time.
    void read(const std::function<void(const ForeignItem&)>& take) const;

    std::vector<std::filesystem::path> files() const;

  private:
    struct Source {
        std::filesystem::path file;
        GazeColumns columns;
    };
    std::vector<Source> sources_;
    std::unique_ptr<AscGaze> asc_; ///< then `sources_` have their files alone
    ScreenGeometry screen_;
    double us_per_unit_ = 1.0; ///< of the first file
};

} // namespace overt
