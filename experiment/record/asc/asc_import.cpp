#include "experiment/record/asc/asc_import.h"

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/record/asc/asc_rows.h"
#include "experiment/record/asc/asc_trial.h"
#include "experiment/record/asc/imported_session.h"
#include "experiment/record/asc/recording_date.h"
#include "experiment/record/header_rows.h"
#include "experiment/record/no_stimulus.h"
#include "experiment/record/session_schema.h"
#include "experiment/record/sql.h"

namespace fs = std::filesystem;

namespace overt {
namespace {

constexpr glm::ivec2 usual_screen_px{1920, 1080};

/// A line of the header, without what it begins with; empty if there is none.
std::string header_line(const AscSurvey& survey, std::string_view beginning) {
    const std::size_t at = survey.header.find(beginning);
    if (at == std::string::npos)
        return {};
    const std::size_t begin = at + beginning.size();
    return survey.header.substr(begin, survey.header.find('\n', begin) - begin);
}

SessionHeader header_of(const AscFiles& files, const AscSurvey& survey, const AscImportOptions& options) {
    SessionHeader header;
    header.protocol.name = options.place.protocol_name;
    header.protocol.title = "Imported from " + files.name();
    header.protocol.sha256 = hash_of_text("");
    header.schedule.observer = {options.place.observer_label, 1};
    for (int trial = 0; trial < survey.trials; ++trial)
        header.schedule.trials.push_back({trial, 0, {0, 0}, 0});
    header.started_utc = iso_date(header_line(survey, "** DATE: ")).value_or(options.now_utc);
    header.program = options.program;
    // An export of a session of ours names the tracker that was there, beside what readers want to find.
    const std::string model = header_line(survey, "** EYELINK II "),
                      own = header_line(survey, own_tracker_remark);
    header.tracker.name = !own.empty() ? own : model.empty() ? "EyeLink" : "EyeLink " + model;
    header.tracker.sample_rate_hz = survey.rate_hz;
    header.tracker.eye = survey.has_left ? Eye::left : Eye::right;
    header.tracker.both_eyes = survey.has_left && survey.has_right;
    ScreenGeometry& screen = header.display.screen;
    screen.screen_px = screen.image_px = survey.screen_px.value_or(usual_screen_px);
    screen.image_origin_px = {0, 0};
    screen.screen_mm = options.screen_mm ? *options.screen_mm : survey.screen_mm.value_or(glm::dvec2(0.0));
    screen.viewing_distance_mm =
        options.viewing_distance_mm ? *options.viewing_distance_mm : survey.viewing_distance_mm.value_or(0.0);
    header.display.refresh_hz = survey.refresh_hz.value_or(0.0);
    header.display.output_mode = "unknown";
    header.animations = {no_animation};
    header.poses = distinct_poses(no_animation);
    header.tasks = {{"imported", ""}};
    RecordedObject nothing;
    nothing.id = "none";
    header.objects = {nothing};
    header.materials = {{"none", ""}};
    return header;
}

/// Session time that runs with the tracker's, from the file's first line on.
class SessionClockOf {
  public:
    explicit SessionClockOf(const AscSurvey& survey) : first_(survey.first) {}
    SessionTime operator()(TrackerTime time) const { return SessionTime(SessionDuration(time - first_)); }

  private:
    TrackerTime first_;
};

void insert_trial(SQLite::Database& database, const AscTrialTimes& times,
                  const SessionClockOf& session_time) {
    // Nothing where no message says when it was.
    const auto screen = [&](std::string_view word) {
        const auto found = times.screens.find(word);
        return found == times.screens.end() ? std::nullopt : std::optional(session_time(found->second));
    };
    insert_values(database,
                  "INTO trial (trial_id, sitting, trial, attempt, task, object, material, status, "
                  "started_ns, task_screen_onset_ns, presentation_onset_ns, presentation_end_ns, "
                  "response_screen_onset_ns, responded_ns, shown_refreshes, missed_refreshes, answer, "
                  "lost_flips, lost_samples)",
                  times.trial + 1, 1, times.trial, 1, 0, 0, 0, times.is_aborted ? "aborted" : "completed",
                  session_time(times.first), screen(task_screen_message), screen(onset_message),
                  screen(end_message), screen(response_screen_message), screen(response_message), 0, 0, "", 0,
                  0);
}

void insert_sitting(SQLite::Database& database, const SessionHeader& header, const AscSurvey& survey,
                    const SessionClockOf& session_time) {
    insert_values(database, "INTO sitting (sitting, started_utc, closed)", 1, header.started_utc, 1);
    for (const TrackerTime time : {survey.first, survey.last})
        insert_values(database, "INTO clock_pair (sitting, before_ns, tracker_us, after_ns)", 1,
                      session_time(time), time, session_time(time));
}

void add_remarks(AscImportSummary& summary, const SessionHeader& header) {
    const AscSurvey& survey = summary.survey;
    const ScreenGeometry& screen = header.display.screen;
    const auto add = [&](std::string remark) { summary.remarks.push_back(std::move(remark)); };
    if (!survey.screen_px)
        add(fmt::format("The file names no DISPLAY_COORDS: the screen is taken to have {} x {} pixels.",
                        screen.screen_px.x, screen.screen_px.y));
    if (screen.viewing_distance_mm <= 0.0 || screen.screen_mm.x <= 0.0)
        add("The file does not say how large and how far away the screen was, so degrees of visual angle are "
            "not known, and there is no export to BIDS: give --screen-mm and --distance-mm.");
    if (!survey.format.eyes_are_known)
        add("The file does not say which eye it is of: it is taken for the right one.");
    if (survey.format.rate_hz <= 0.0)
        add(fmt::format("The file does not say the sampling rate: by its samples it is {:.6g} Hz.",
                        survey.rate_hz));
}

} // namespace

namespace {

/// On what samples' lines did not say themselves.
void add_remarks_on_samples(AscImportSummary& summary) {
    const AscSurvey& survey = summary.survey;
    const AscConventions& conventions = survey.conventions;
    const auto add = [&](std::string remark) { summary.remarks.push_back(std::move(remark)); };
    if (conventions.missing_number || !conventions.missing_word.empty())
        add(fmt::format("Places of {} are lost gaze (edf2asc -miss).",
                        conventions.missing_number ? fmt::format("{:g}", *conventions.missing_number)
                                                   : fmt::format("\"{}\"", conventions.missing_word)));
    if (conventions.least_pupil <= 0.0 && survey.samples > 0)
        add("Pupils are not as EyeLinks have them, or were not recorded: a sample is lost where its place is "
            "missing, however small its pupil.");
    if (survey.decimal_commas > 0)
        add(fmt::format("{} lines of samples have decimal commas, and are read so.", survey.decimal_commas));
    if (survey.restored_stamps > 0)
        add(fmt::format(
            "{} samples have rounded times (edf2asc -ftime has single precision only): the sampling "
            "rate of {:g} Hz tells their true ones.",
            survey.restored_stamps, survey.rate_hz));
    if (survey.lines_of_one_eye > 0)
        add(fmt::format(
            "{} lines of samples have one eye's values in a recording of both: they are taken for the "
            "eye whose event goes on, or whose gaze was nearer before.",
            survey.lines_of_one_eye));
    if (survey.lines_of_both_eyes > 0)
        add(fmt::format(
            "{} lines of samples have both eyes' values in a recording that is said to be of one: "
            "both are kept.",
            survey.lines_of_both_eyes));
    if (survey.raw_samples > 0)
        add(fmt::format(
            "{} samples have pupils of less than 0, EyeLink's sign of raw data: they are kept without "
            "gaze.",
            survey.raw_samples));
    if (survey.format.has_pupil_areas && survey.format.has_pupil_diameters)
        add("Pupils are areas in some recordings and diameters in others: the tables' dictionary says in "
            "which.");
}

} // namespace

void add_asc_remarks(AscImportSummary& summary) {
    const AscSurvey& survey = summary.survey;
    const auto add = [&](std::string remark) { summary.remarks.push_back(std::move(remark)); };
    if (survey.format.has_head_target)
        add("Positions of the head's target (remote mode) are not kept.");
    if (survey.format.lowest_rate_hz < survey.format.highest_rate_hz)
        add(fmt::format(
            "The sampling rate changes between recordings, from {:g} to {:g} Hz: the session names "
            "the highest.",
            survey.format.lowest_rate_hz, survey.format.highest_rate_hz));
    if (survey.format.has_further_numbers)
        add(survey.format.eyes_are_known
                ? "Samples have further numbers (velocity, resolution or input), which are not kept."
                : "Samples have further numbers, perhaps of the other eye, which are not kept: without lines "
                  "START and SAMPLES nobody can tell.");
    if (survey.events_that_are_no_gaze > 0)
        add(fmt::format("{} fixations and saccades are not in gaze coordinates (EVENTS HREF or PUPIL): they "
                        "are kept without their places.",
                        survey.events_that_are_no_gaze));
    if (survey.samples_that_are_no_gaze > 0)
        add(fmt::format("{} samples that were no gaze on a screen (HREF or PUPIL) are left out.",
                        survey.samples_that_are_no_gaze));
    add_remarks_on_samples(summary);
    if (survey.unreadable_event_values > 0)
        add(fmt::format(
            "{} values of fixations and saccades were no numbers: the events are kept without them.",
            survey.unreadable_event_values));
    if (survey.mended_durations > 0)
        add(fmt::format("{} fixations, saccades or blinks had a duration that cannot be (negative, or longer "
                        "than from begin to end): it is taken from their begin and end.",
                        survey.mended_durations));
    if (survey.unfinished_events > 0)
        add(fmt::format("{} fixations, saccades or blinks began and never ended: they are left out.",
                        survey.unfinished_events));
    if (survey.non_ascii_texts > 0)
        add(fmt::format("{} texts were no UTF-8 and are taken for Latin-1.", survey.non_ascii_texts));
}

GazeSource gaze_source_of(const AscFiles& files, const AscSurvey& survey) {
    GazeSource source;
    source.file = files.name();
    source.sha256 = files.hashes();
    source.header = survey.header;
    // Recordings whose pupils are others than most have it in the event of their START.
    source.pupil_is_diameter = survey.format.has_pupil_diameters && !survey.format.has_pupil_areas;
    source.rate_hz = survey.rate_hz;
    source.has_left = survey.has_left;
    source.has_right = survey.has_right;
    if (survey.px_per_deg) {
        source.px_per_deg_x = survey.px_per_deg->x;
        source.px_per_deg_y = survey.px_per_deg->y;
    }
    source.skipped_lines = survey.skipped_lines;
    return source;
}

AscImportSummary import_asc(const AscFiles& files, const AscImportOptions& options) {
    if (options.out.empty())
        check_session_place(options.place, options.session_number);
    else if (fs::exists(options.out))
        throw InputError(fmt::format("{}: exists already and is not overwritten. Name another folder.",
                                     options.out.string()));
    else
        check_observer_label(options.place.observer_label);

    AscImportSummary summary;
    AscSurveyOptions reading = options.reading;
    reading.progress = part_of(options.reading.progress, 0, 2, 3);
    summary.survey = survey_asc(files, reading);
    SessionHeader header = header_of(files, summary.survey, options);
    std::optional<SessionDirectory> by_place;
    std::optional<PartialDirectory> by_name;
    if (options.out.empty()) {
        by_place.emplace(options.place, options.session_number);
        header.session_number = by_place->session_number();
    } else {
        by_name.emplace(options.out);
        header.session_number = options.session_number.value_or(1);
    }
    const fs::path session_file = (by_place ? by_place->path() : by_name->path()) / session_file_name;
    create_session_file(session_file, header);
    write_session_rows(session_file, [&](SQLite::Database& database) {
        const SessionClockOf session_time(summary.survey);
        insert_sitting(database, header, summary.survey, session_time);
        GazeRows rows(database);
        rows.source(1, gaze_source_of(files, summary.survey));
        AscRows sink(
            rows, 1, summary.survey.cut_by, [](int trial) { return std::optional<std::int64_t>(trial + 1); },
            [&](const AscTrialTimes& times) {
                insert_trial(database, times, session_time);
                ++summary.trials;
            });
        AscParser parser(sink, summary.survey.conventions);
        files.parse(parser, part_of(options.reading.progress, 2, 1, 3));
        sink.end();
    });
    note_detection(session_file.parent_path(), 1, files.path(), options, summary);
    finish_imported_session(session_file.parent_path(), options.program);
    if (by_place)
        by_place->publish();
    else
        by_name->publish();
    summary.session = by_place ? by_place->path() : by_name->path();
    add_remarks(summary, header);
    add_asc_remarks(summary);
    return summary;
}

} // namespace overt
