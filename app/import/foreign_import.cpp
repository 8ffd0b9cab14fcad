#include <cctype>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "app/cli/interruption.h"
#include "app/cli/own_folders.h"
#include "app/cli/this_program.h"
#include "app/import/import_commands.h"
#include "app/inputs/prepared_stimuli.h"
#include "app/inputs/protocol_file.h"
#include "app/inputs/protocol_inputs.h"
#include "app/session/session_recording.h"
#include "experiment/answers/answer_kinds.h"
#include "experiment/base/content_hash.h"
#include "experiment/base/counted.h"
#include "experiment/base/error.h"
#include "experiment/base/json_text.h"
#include "experiment/base/whole_file.h"
#include "experiment/design/schedule.h"
#include "experiment/record/foreign/foreign_asc.h"
#include "experiment/record/foreign/foreign_session.h"
#include "experiment/record/read/import_source.h"
#include "experiment/record/session_schema.h"
#include "render/gl/headless_context.h"

namespace overt {
namespace {

/// So many of the rows that were left out are shown.
constexpr int shown_rows = 20;

/// Nothing is shown: the stimuli are there for their maps alone.
SessionHeader header_of_protocol(const Experiment& experiment, StimulusLibrary& library,
                                 const GlContext& context, const Observer& observer) {
    Schedule schedule;
    schedule.observer = observer;
    SessionHeader header = make_session_header(experiment.protocol, schedule, experiment.objects, library,
                                               context.description(), {}, ClockKind::steady, true, false);
    header.display.timing = "unproven"; // nobody knows when pictures were lit
    return header;
}

/// Columns that are taken without being named. What another program calls "background" or "view" is the
/// protocol's where that has a choice of them.
std::vector<std::string> factor_names(const SessionHeader& header) {
    std::vector<std::string> names{"task"};
    if (header.slots.size() > 1)
        names.emplace_back("slot");
    for (std::size_t list = 0; list < stimulus_lists.size(); ++list) {
        const std::string name(stimulus_lists[list].name);
        if (name == "object" || name == "material" || entries_of(header, list).size() > 1)
            names.push_back(name);
    }
    return names;
}

/// Which answer the log's answer is: the first that each task asks for.
std::vector<AskedAnswer> asked_answers(const Protocol& protocol) {
    std::vector<AskedAnswer> asked;
    for (const Task& task : protocol.tasks)
        asked.push_back(
            task.answers.empty()
                ? AskedAnswer()
                : AskedAnswer{task.answers.front().id, std::string(row_of(task.answers.front().kind).name)});
    return asked;
}

std::string source_text(const ForeignImportOptions& options, const ForeignGaze& gaze,
                        const GazeSurvey& survey, const TrialLog& log) {
    const auto named = [](const std::filesystem::path& file) {
        return fmt::format("; {} (SHA-256 {})", file.filename().string(), hash_of_file(file));
    };
    std::string of_gaze, of_trials;
    for (const auto& file : gaze.files())
        of_gaze += named(file);
    if (!options.trials.empty())
        of_trials += named(options.trials);
    if (!options.frames.empty())
        (options.trials.empty() ? of_gaze : of_trials) += named(options.frames);
    // A recording's messages were sent by a program that they do not name.
    const bool are_messages = options.trials.empty() && gaze.has_messages();
    if (are_messages)
        of_trials = " by its messages";
    return import_source_text({survey.columns.program, log.program, {}}, of_gaze, of_trials,
                              are_messages || !options.trials.empty());
}

struct Imported {
    std::filesystem::path session;
    GazeSurvey survey;
    ForeignPlan plan;
    ForeignCounts counts;
};

void print(const Imported& imported) {
    for (const std::string& remark : imported.survey.remarks)
        fmt::print("{}\n", remark);
    for (const std::string& remark : imported.plan.remarks)
        fmt::print("{}\n", remark);
    const GazeSurvey& survey = imported.survey;
    fmt::print("{} of {} at {:.6g} Hz, {} of them without gaze; {} between trials left out; {}; {} that "
               "could not be read and left out\n"
               "session: {}\n",
               counted(survey.samples, "sample"), survey.columns.program, survey.rate_hz, survey.without_gaze,
               imported.counts.outside,
               counted(static_cast<std::int64_t>(imported.plan.trials.size()), "trial"),
               counted(survey.rows_left_out, "row"), imported.session.string());
}

nlohmann::ordered_json to_json(const Imported& imported) {
    const GazeSurvey& survey = imported.survey;
    std::vector<std::string> remarks = survey.remarks;
    remarks.insert(remarks.end(), imported.plan.remarks.begin(), imported.plan.remarks.end());
    return {{"session", imported.session.string()},
            {"program", survey.columns.program},
            {"trials", imported.plan.trials.size()},
            {"samples", survey.samples},
            {"samples_without_gaze", survey.without_gaze},
            {"samples_between_trials", imported.counts.outside},
            {"rows_left_out", survey.rows_left_out},
            {"rate_hz", survey.rate_hz},
            {"clock_error_bound_ms", 1e-6 * static_cast<double>(imported.plan.clocks.bound.count())},
            {"remarks", remarks}};
}

std::string label_of(const std::filesystem::path& file) {
    std::string label;
    for (const char c : file.stem().string())
        if (std::isalnum(static_cast<unsigned char>(c)))
            label += c;
    return label;
}

void require_no_asc_options(const ForeignImportOptions& options) {
    const ImportOptions& of = options.of_gaze;
    if (!of.into.empty() || !of.out.empty() || !of.screen_mm.empty() || of.distance_mm)
        throw InputError("--into, --out, --screen-mm and --distance-mm are for EyeLink recordings "
                         "without --protocol: the "
                         "protocol's [display] says how large and how far the screen was, and --sessions "
                         "where the session goes");
}

Imported import_foreign(const ForeignImportOptions& options) {
    require_no_asc_options(options);
    const ImportOptions& of = options.of_gaze;
    const Experiment experiment =
        read_experiment_or_report(options.protocol, cache_folder(), InputDepth::objects);
    const Protocol& protocol = experiment.protocol;
    // Its number decides nothing here: the log says what was shown.
    const std::string label = of.observer.empty() ? label_of(of.files.front()) : of.observer;
    check_observer_label(label);
    const Observer observer{label, observer_number(label).value_or(0)};
    const SessionPlace place{of.sessions, protocol.name, observer.label, of.is_another_person};
    check_session_place(place, of.session_number);

    Imported imported;
    const std::optional<GazeColumns> given =
        options.columns.empty() ? std::nullopt : std::optional(gaze_columns_of(options.columns));
    const ForeignGaze gaze(of.files, given, screen_geometry_of(protocol),
                           {of.as_gaze, of.missing, of.least_read});
    int reported = 0;
    imported.survey = gaze.survey([&](const std::string& line) {
        if (reported++ < shown_rows)
            fmt::print(stderr, "{}\n", line);
    });
    if (reported > shown_rows)
        fmt::print(stderr, "… and {} more\n", counted(reported - shown_rows, "row"));

    const std::unique_ptr<GlContext> context = make_headless_context(options.context);
    StimulusLibrary library(*context, protocol, experiment.objects, cache_folder());
    const Interruption interruption;
    prepare_maps_alone(library, MapsNow::made, protocol);
    SessionHeader header = header_of_protocol(experiment, library, *context, observer);
    const TrialLog log =
        options.trials.empty() && gaze.has_messages()
            ? trials_in_messages(imported.survey, trial_columns_of(options.trial_columns),
                                 factor_names(header), of.files.front())
        : options.trials.empty()
            ? trials_in_gaze(imported.survey, of.files.front())
            : read_trial_log(options.trials,
                             known_trial_columns(options.trials, trial_columns_of(options.trial_columns)),
                             factor_names(header), imported.survey);
    const std::optional<std::vector<LoggedFrame>> frames =
        options.frames.empty() ? std::nullopt
                               : std::optional(read_frame_log(options.frames, options.frame_columns));
    imported.plan = plan_foreign_trials(header, log,
                                        (options.trials.empty() ? of.files.front() : options.trials).string(),
                                        imported.survey, frames, options.trials.empty());
    for (const ForeignTrial& trial : imported.plan.trials)
        header.schedule.trials.push_back(trial.trial);
    const GazeSurvey& survey = imported.survey;
    header.tracker = {.name = survey.columns.program,
                      .sample_rate_hz = survey.rate_hz,
                      .eye = survey.has_right ? Eye::right : Eye::left,
                      .both_eyes = survey.has_left && survey.has_right};
    SessionDirectory directory(place, of.session_number);
    header.session_number = directory.session_number();
    put_files(directory, header, experiment.objects, library, false);
    const Sitting sitting{header.started_utc,
                          this_program().version,
                          this_program().sha256,
                          std::nullopt,
                          SittingDetection{protocol.events, screen_geometry_of(protocol)},
                          {}};
    // The folder is locked while it is made, and so is that of rows while they are written.
    const std::filesystem::path aside = directory.path() / ".rows" / session_file_name;
    std::filesystem::create_directory(aside.parent_path());
    std::filesystem::rename(directory.session_file(), aside);
    imported.counts = write_foreign_rows(aside, sitting, imported.plan, gaze, asked_answers(protocol),
                                         source_text(options, gaze, survey, log));
    std::filesystem::rename(aside, directory.session_file());
    std::filesystem::remove_all(aside.parent_path());
    static_cast<void>(close_manifest(directory.path()));
    directory.publish();
    imported.session = directory.path();
    return imported;
}

/// BIDS has the log of trials beside the gaze.
ForeignImportOptions with_found_trials(ForeignImportOptions options) {
    if (options.trials.empty() && options.columns.empty() && !is_asc_file(options.of_gaze.files.front()))
        options.trials = known_gaze_columns(options.of_gaze.files.front(), options.of_gaze.as_gaze).trials;
    return options;
}

} // namespace

int run_foreign_import(const ForeignImportOptions& options) {
    const Imported imported = import_foreign(with_found_trials(options));
    if (!options.of_gaze.print_session_to.empty())
        write_to(options.of_gaze.print_session_to, imported.session.string() + "\n");
    if (options.of_gaze.json)
        fmt::print("{}", json_text(to_json(imported)));
    else
        print(imported);
    return 0;
}

} // namespace overt
