#include "experiment/record/asc/asc_export.h"

#include <algorithm>
#include <array>
#include <cmath>
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
#include "experiment/record/asc/recording_date.h"
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
        writer.line("** DATE: " + ascii_of(asc_date(header.started_utc)));
        writer.line("** TYPE: EDF_FILE BINARY EVENT SAMPLE TAGGED");
        writer.line("** VERSION: EYELINK II 1");
        writer.line("** SOURCE: EYELINK CL");
        writer.line("** EYELINK II CL v4.56 Aug 18 2010");
        writer.line("** REMARK: overt recorded this with the tracker: " + ascii_of(header.tracker.name));
        writer.line("** REMARK: VERSION and the line that begins with EYELINK are there for readers of "
                    "EyeLink files");
        if (const std::string origin = record.event_origins(); !origin.empty())
            writer.line("** REMARK: " + ascii_of(origin));
        writer.line("**");
    }
    if (const std::int64_t base = writer.layout().base_ms; base != 0)
        writer.line(fmt::format("** REMARK: {} ms were taken from the tracker's times", base));
    writer.line("");
}

/// Of one sitting.
class SittingExport {
  public:
    SittingExport(const SessionRecord& record, int sitting, AscWriter& writer)
        : record_(record), writer_(writer), clock_map_(record.clock_map(sitting)) {}

    void write_screen(std::int64_t ms);
    void write_trial(const TrialRecord& trial, AscExportCounts& counts);

  private:
    const SessionRecord& record_;
    AscWriter& writer_;
    std::optional<ClockMap> clock_map_;
};

void SittingExport::write_screen(std::int64_t ms) {
    std::set<std::string, std::less<>> words;
    record_.read_gaze_events_outside([&](const GazeEvent& event) {
        switch (event.kind) {
        case GazeEvent::Kind::message:
            writer_.message(asc_milliseconds(event.start), event.text);
            words.emplace(event.text.substr(0, event.text.find(' ')));
            break;
        case GazeEvent::Kind::button:
        case GazeEvent::Kind::input:
            writer_.port(event);
            break;
        default:
            writer_.note(event.text);
        }
    });
    const ScreenGeometry& screen = record_.header().display.screen;
    if (!words.contains("DISPLAY_COORDS"))
        writer_.message(
            ms, fmt::format("DISPLAY_COORDS 0 0 {} {}", screen.screen_px.x - 1, screen.screen_px.y - 1));
    if (screen.viewing_distance_mm <= 0.0 || screen.screen_mm.x <= 0.0)
        return;
    if (!words.contains("SCREEN_PHYS_COORDS"))
        writer_.message(ms, fmt::format("SCREEN_PHYS_COORDS {} {} {} {}", -0.5 * screen.screen_mm.x,
                                        0.5 * screen.screen_mm.y, 0.5 * screen.screen_mm.x,
                                        -0.5 * screen.screen_mm.y));
    if (!words.contains("SCREEN_DISTANCE"))
        writer_.message(ms, fmt::format("SCREEN_DISTANCE {0} {0}", screen.viewing_distance_mm));
}

void SittingExport::write_trial(const TrialRecord& trial, AscExportCounts& counts) {
    AscTrial lines(record_, trial, clock_map_, writer_.layout());
    std::array<GazeSample, 2> instant;
    std::size_t count = 0;
    const auto write_instant = [&] {
        if (count == 0)
            return;
        lines.write_until(writer_, std::span(instant).first(count));
        writer_.samples(std::span(instant).first(count));
        count = 0;
    };
    record_.read_samples(trial, samples_at_a_time, [&](std::span<const GazeSample> samples) {
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
    lines.finish(writer_);
    ++counts.trials;
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
        if (eyes.none()) {
            ++counts.sittings_without_samples;
        } else {
            AscLayout layout = layout_of(record, sitting, eyes);
            layout.base_ms = time_base(record, sitting);
            layout.fractional_times = options.fractional_times;
            writer.emplace(folder.path() / file_name(record.header(), sitting), layout);
            write_header(*writer, record, sitting);
            lines.emplace(record, sitting, *writer);
            lines->write_screen(first_time(record, sitting));
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
        ++counts.files;
        counts.lines += writer->lines();
        counts.bytes += writer->bytes();
        writer->close();
    }
    if (counts.files == 0)
        throw InputError(fmt::format("{}: has no gaze samples: there is nothing to write as ASC. Export its "
                                     "tables with --format tsv.",
                                     record.directory().string()));
    folder.publish();
    return counts;
}

} // namespace overt
