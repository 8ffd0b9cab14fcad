#include "experiment/record/asc/asc_export.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <set>
#include <span>
#include <string>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/export_folder.h"
#include "experiment/base/utf8_text.h"
#include "experiment/record/asc/asc_trial.h"
#include "experiment/record/asc/asc_words.h"
#include "experiment/record/asc/recording_date.h"
#include "experiment/record/read/recorded_validation.h"
#include "experiment/record/read/tracker_facts.h"
#include "experiment/record/tables/sample_rows.h"

namespace fs = std::filesystem;

namespace overt {
namespace {

std::string file_name(const SessionHeader& header, int sitting) {
    return fmt::format("sub-{}_ses-{:02}_run-{:02}.asc", header.schedule.observer.label,
                       header.session_number, sitting);
}

AscLayout layout_of(const SessionRecord& record, int sitting, SessionRecord::Eyes eyes) {
    const SessionHeader& header = record.header();
    const ScreenGeometry& screen = header.display.screen;
    AscLayout layout;
    layout.has_left = eyes.left;
    layout.has_right = eyes.right;
    layout.rate_hz = header.tracker.sample_rate_hz;
    if (screen.viewing_distance_mm > 0.0 && screen.screen_mm.x > 0.0 && screen.screen_mm.y > 0.0) {
        const double mm_per_deg = 2.0 * screen.viewing_distance_mm * std::tan(0.5 * to_radians({1.0}).value);
        layout.px_per_deg_x = mm_per_deg * screen.screen_px.x / screen.screen_mm.x;
        layout.px_per_deg_y = mm_per_deg * screen.screen_px.y / screen.screen_mm.y;
    }
    if (const std::optional<GazeSource> source = record.gaze_source(sitting)) {
        layout.rate_hz = source->rate_hz > 0.0 ? source->rate_hz : layout.rate_hz;
        layout.pupil_is_diameter = source->pupil_is_diameter;
        layout.has_left |= source->has_left;
        layout.has_right |= source->has_right;
        if (source->px_per_deg_x && source->px_per_deg_y) {
            layout.px_per_deg_x = source->px_per_deg_x;
            layout.px_per_deg_y = source->px_per_deg_y;
        }
    }
    constexpr double usual_rate_hz = 1000.0;
    if (!(layout.rate_hz >= 1.0))
        layout.rate_hz = usual_rate_hz;
    return layout;
}

/// Readers look for the version of a tracker's program in these lines; the remark says whose file it is.
void write_header(AscWriter& writer, const SessionRecord& record, int sitting) {
    const SessionHeader& header = record.header();
    if (const auto source = record.gaze_source(sitting); source && !source->header.empty()) {
        for (std::string_view rest = source->header; !rest.empty();) {
            const std::size_t end = std::min(rest.find('\n'), rest.size());
            writer.note(rest.substr(0, end));
            rest.remove_prefix(std::min(end + 1, rest.size()));
        }
    } else {
        writer.line(fmt::format("** CONVERTED FROM sub-{}_ses-{:02} by overt {}",
                                header.schedule.observer.label, header.session_number,
                                ascii_of(header.program.version)));
        writer.line("** DATE: " + ascii_of(asc_date(record.started_utc(sitting))));
        writer.line("** TYPE: EDF_FILE BINARY EVENT SAMPLE TAGGED");
        writer.line("** VERSION: EYELINK II 1");
        writer.line("** SOURCE: EYELINK CL");
        writer.line("** EYELINK II CL v4.56 Aug 18 2010");
        writer.line(std::string(own_tracker_remark) + ascii_of(header.tracker.name));
        writer.line("** REMARK: VERSION and the line that begins with EYELINK are there for readers of "
                    "EyeLink files");
        if (const std::string origin = record.event_origins(); !origin.empty())
            writer.line("** REMARK: " + ascii_of(origin));
        writer.line("**");
    }
    if (header.is_timing_unproven())
        writer.line("** REMARK: the timing of the display is unproven: no real vertical blank tells when "
                    "pictures were lit, nor which refreshes were missed");
    if (const std::int64_t base = writer.layout().base_ms; base != 0)
        writer.line(fmt::format("** REMARK: {} ms were taken from the tracker's times", base));
    writer.line("");
}

/// Of one sitting.
class SittingExport {
  public:
    SittingExport(const SessionRecord& record, int sitting, AscWriter& writer, AscTrial::Messages messages)
        : record_(record), sitting_(sitting), messages_(messages), clock_map_(record.clock_map(sitting)),
          is_imported_(record.gaze_source(sitting).has_value()), writer_(writer),
          recordings_(writer, record.header().display.screen.screen_px) {}

    /// What stands before the first trial: the screen, and what the tracker said.
    void write_beginning(std::int64_t ms);
    void write_trial(const TrialRecord& trial, AscExportCounts& counts);
    void finish() { recordings_.finish(); }

  private:
    using ReadSamples =
        std::function<void(std::size_t most, const std::function<void(std::span<const GazeSample>)>&)>;
    void write_screen(TrackerTime at, const std::vector<GazeEvent>& said);
    void write_validations();
    void write_validation(const RecordedCalibration& calibration, Eye eye);
    void write(AscTrial& lines, const ReadSamples& read, AscExportCounts& counts);

    const SessionRecord& record_;
    int sitting_;
    AscTrial::Messages messages_;
    std::optional<ClockMap> clock_map_;
    bool is_imported_;
    AscWriter& writer_;
    AscRecordings recordings_;
    std::optional<TrackerTime> last_; ///< line of the attempt before, of a session recorded here
};

void SittingExport::write_beginning(std::int64_t ms) {
    std::vector<GazeEvent> said;
    if (is_imported_)
        record_.read_gaze_events_before([&](const GazeEvent& event) { said.push_back(event); });
    const TrackerTime at{std::chrono::milliseconds(ms)};
    AscTrial lines(said, {}, writer_.layout());
    lines.finish(recordings_);
    write_screen(at, said);
    if (!is_imported_)
        write_validations();
}

void SittingExport::write_screen(TrackerTime at, const std::vector<GazeEvent>& said) {
    const auto has = [&](std::string_view word) {
        return std::any_of(said.begin(), said.end(), [&](const GazeEvent& event) {
            return event.kind == GazeEvent::Kind::message && Words(event.text).next() == word;
        });
    };
    const ScreenGeometry& screen = record_.header().display.screen;
    if (!has("DISPLAY_COORDS"))
        writer_.message(
            at, fmt::format("DISPLAY_COORDS 0 0 {} {}", screen.screen_px.x - 1, screen.screen_px.y - 1));
    if (screen.viewing_distance_mm <= 0.0 || screen.screen_mm.x <= 0.0)
        return;
    if (!has("SCREEN_PHYS_COORDS"))
        writer_.message(at, fmt::format("SCREEN_PHYS_COORDS {} {} {} {}", -0.5 * screen.screen_mm.x,
                                        0.5 * screen.screen_mm.y, 0.5 * screen.screen_mm.x,
                                        -0.5 * screen.screen_mm.y));
    if (!has("SCREEN_DISTANCE"))
        writer_.message(at, fmt::format("SCREEN_DISTANCE {0} {0}", screen.viewing_distance_mm));
}

/// All of a sitting stand at its begin, with their own times: in the form in which readers look for
/// calibrations and validations. Of validations whose targets the session does not know, their number is
/// given as 0, for MNE reads as many lines of targets as it says.
void SittingExport::write_validations() {
    if (!clock_map_)
        return;
    std::vector<RecordedCalibration> all = record_.calibrations(sitting_);
    if (all.empty())
        record_.read_events([&](const RecordedEvent& event) {
            if (const auto validation = event.sitting == sitting_ ? validation_of(event) : std::nullopt)
                all.push_back({event.at, -1, {}, *validation});
        });
    const AscLayout& layout = writer_.layout();
    for (const RecordedCalibration& calibration : all)
        for (const Eye eye : {Eye::left, Eye::right})
            if (eye == Eye::left ? layout.has_left : layout.has_right)
                write_validation(calibration, eye);
}

void SittingExport::write_validation(const RecordedCalibration& calibration, Eye eye) {
    const TrackerTime at = clock_map_->to_other(calibration.at);
    const ValidationOfEye found = validation_of_eye(calibration.validation, eye);
    const char letter = eye == Eye::left ? 'L' : 'R';
    const char* const word = eye == Eye::left ? "LEFT" : "RIGHT";
    const std::size_t count = found.targets.size();
    writer_.message(at, "!CAL ");
    // 0: how many targets the calibration had is not known. It may have had others than the validation.
    writer_.line(fmt::format(">>>>>>> CALIBRATION (HV{},{}) FOR {}: <<<<<<<<<",
                             calibration_points(calibration.method).value_or(0),
                             ascii_of(record_.header().tracker.name), word));
    writer_.message(at, fmt::format("!CAL VALIDATION HV{} {} {}  ERROR {:.2f} avg. {:.2f} max", count, letter,
                                    word, found.mean_error.value, found.max_error.value));
    for (std::size_t i = 0; i < count; ++i) {
        const ValidatedTarget& target = found.targets[i];
        const std::string place = fmt::format("VALIDATE {} {}POINT {} {}  at {:.0f},{:.0f}", letter, count, i,
                                              word, target.target.x_px, target.target.y_px);
        writer_.message(at, target.gaze
                                ? fmt::format("{}  OFFSET {:.2f} deg.  {:.1f},{:.1f} pix.", place,
                                              target.error.value, target.gaze->x_px - target.target.x_px,
                                              target.gaze->y_px - target.target.y_px)
                                : place + "  MISSING");
    }
}

void SittingExport::write(AscTrial& lines, const ReadSamples& read, AscExportCounts& counts) {
    std::array<GazeSample, 2> instant;
    std::size_t count = 0;
    const auto write_instant = [&] {
        if (count == 0)
            return;
        lines.write_until(recordings_, std::span(instant).first(count));
        recordings_.samples(std::span(instant).first(count));
        count = 0;
    };
    read(samples_at_a_time, [&](std::span<const GazeSample> samples) {
        for (const GazeSample& sample : samples) {
            const bool is_other_eye =
                count == 1 && sample.sampled_at == instant[0].sampled_at && sample.eye != instant[0].eye;
            if (!is_other_eye)
                write_instant();
            instant[count++] = sample;
            if (count == 2)
                write_instant();
            ++counts.samples;
        }
    });
    write_instant();
    lines.finish(recordings_);
}

void SittingExport::write_trial(const TrialRecord& trial, AscExportCounts& counts) {
    AscTrial lines(record_, trial, clock_map_, writer_.layout(), messages_, last_);
    last_ = lines.last();
    write(
        lines, [&](std::size_t most, const auto& take) { record_.read_samples(trial, most, take); }, counts);
    ++counts.trials;
    if (!is_imported_)
        return;
    std::vector<GazeEvent> said;
    record_.read_gaze_events_after(trial, [&](const GazeEvent& event) { said.push_back(event); });
    AscTrial after(std::move(said), record_.event_origin(trial.sitting), writer_.layout());
    write(
        after, [&](std::size_t most, const auto& take) { record_.read_samples_after(trial, most, take); },
        counts);
}

/// Milliseconds of the sitting's first line.
std::int64_t first_time(const SessionRecord& record, int sitting) {
    const std::optional<ClockMap> clock_map = record.clock_map(sitting);
    for (const TrialRecord& trial : record.trials()) {
        if (trial.sitting != sitting)
            continue;
        const auto span = record.sample_span(trial);
        if (clock_map && !record.header().stimuli.empty()) {
            const std::int64_t begun = asc_milliseconds(clock_map->to_other(trial.started));
            return span ? std::min(begun, asc_milliseconds(span->first)) : begun;
        }
        if (span)
            return asc_milliseconds(span->first);
        std::optional<std::int64_t> of_events;
        record.read_gaze_events(trial, [&](const GazeEvent& event) {
            of_events = of_events.value_or(asc_milliseconds(event.start));
        });
        if (of_events)
            return *of_events;
    }
    return 0;
}

/// What to take from all times: nothing, as long as they fit into the 31 bits that R has for whole numbers.
std::int64_t time_base(const SessionRecord& record, int sitting) {
    const std::int64_t first = first_time(record, sitting);
    std::int64_t last = first;
    for (const TrialRecord& trial : record.trials())
        if (const auto span = record.sample_span(trial); span && trial.sitting == sitting)
            last = std::max(last, asc_milliseconds(span->second));
    constexpr std::int64_t room_s = 100'000; // for messages before the first trial, and after the last
    if (first >= 0 && last + 1000 * room_s <= std::numeric_limits<std::int32_t>::max())
        return 0;
    return 1000 * ((first >= 0 ? first : first - 999) / 1000 - room_s);
}

bool is_export_of(const std::string& name) { return name.starts_with("sub-") && name.ends_with(".asc"); }

} // namespace

AscExportCounts export_asc(const SessionRecord& record, const fs::path& directory,
                           const AscExportOptions& options) {
    ExportFolder folder(directory, options.overwrite, is_export_of);
    std::set<int> sittings;
    for (const TrialRecord& trial : record.trials())
        sittings.insert(trial.sitting);
    AscExportCounts counts;
    const int all = static_cast<int>(record.trials().size());
    int done = 0;
    for (const int sitting : sittings) {
        const SessionRecord::Eyes eyes = record.eyes(sitting);
        std::optional<AscWriter> writer;
        std::optional<SittingExport> lines;
        const bool has_events = record.gaze_source(sitting).has_value();
        counts.sittings_without_samples += eyes.none();
        if (!eyes.none() || has_events) {
            AscLayout layout = layout_of(record, sitting, eyes);
            layout.base_ms = time_base(record, sitting);
            layout.fractional_times = options.fractional_times;
            writer.emplace(folder.path() / file_name(record.header(), sitting), layout);
            write_header(*writer, record, sitting);
            lines.emplace(record, sitting, *writer, AscTrial::Messages{options.opensesame_messages});
            lines->write_beginning(first_time(record, sitting));
        }
        for (const TrialRecord& trial : record.trials()) {
            if (trial.sitting != sitting)
                continue;
            if (lines)
                lines->write_trial(trial, counts);
            if (options.progress)
                options.progress(++done, all);
        }
        if (!writer)
            continue;
        lines->finish();
        ++counts.files;
        counts.lines += writer->lines();
        counts.bytes += writer->bytes();
        writer->close();
    }
    if (counts.files == 0)
        throw InputError(fmt::format("{}: has neither gaze samples nor a tracker's own events: there is "
                                     "nothing to write as ASC. Export its "
                                     "tables with --format tsv.",
                                     record.directory().string()));
    folder.publish();
    return counts;
}

} // namespace overt
