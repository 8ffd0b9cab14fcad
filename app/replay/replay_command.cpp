#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/cli/interruption.h"
#include "app/cli/own_folders.h"
#include "app/cli/progress_bar.h"
#include "app/cli/this_program.h"
#include "app/inputs/session_folders.h"
#include "app/replay/recorded_experiment.h"
#include "app/replay/remade_session.h"
#include "app/replay/replay_commands.h"
#include "app/replay/replay_picture.h"
#include "app/replay/replay_report.h"
#include "app/replay/session_copies.h"
#include "app/replay/sitting_replay.h"
#include "app/replay/stimuli_again.h"
#include "experiment/base/bytes_in_words.h"
#include "experiment/base/counted.h"
#include "experiment/base/error.h"
#include "experiment/base/json_text.h"
#include "experiment/base/scratch_folder.h"
#include "experiment/record/session_schema.h"

namespace overt {

namespace {

namespace fs = std::filesystem;

/// By the commit, too, where both are known.
std::string version_of(const ProgramBuild& build) {
    return build.commit.empty() ? build.version
                                : fmt::format("{} ({})", build.version, build.commit.substr(0, 12));
}

std::string why_not_again(const SessionRecord& record) {
    for (int sitting = 1; sitting <= sittings_of(record); ++sitting)
        if (std::string why = why_not_again(record, sitting); !why.empty())
            return why;
    return {};
}

/// Spoken answers to an attempt that was cut off.
std::vector<std::string> answers_beyond(const SittingReplay& replay) {
    std::vector<std::string> files;
    if (!replay.cut)
        return files;
    for (const fs::path& session : {replay.recorded_file, replay.folder}) {
        const SessionRecord record(session);
        for (const TrialRecord& attempt : record.trials())
            if (attempt.id >= replay.cut->cut.attempt)
                if (const auto answer = record.answer_recording(attempt))
                    files.push_back(answer->file);
    }
    return files;
}

void add(const FileComparison& comparison, const char* what, ReplayReport& report) {
    report.compared.push_back(fmt::format("{}: {}, {}", what, counted(comparison.files, "file"),
                                          in_bytes(static_cast<double>(comparison.bytes))));
    report.files.insert(report.files.end(), comparison.differences.begin(), comparison.differences.end());
}

void present_again(const SessionRecord& record, const ReplayOptions& options, const fs::path& work,
                   ReplayReport& report) {
    const fs::path place = place_of_protocol(record, options.files);
    const Experiment experiment = recorded_experiment(record, options.files, cache_folder());
    const int sittings = sittings_of(record);
    ProgressBar bar;
    std::optional<SittingReplay> replay;
    RecordComparison before; // the rows of earlier sittings are in the file of each
    report.is_presented_again = true;
    for (int sitting = 1; sitting <= sittings; ++sitting) {
        replay = replay_sitting(
            {record, sitting, experiment, place, cache_folder(),
             options.context ? options.context : context_of(record.header()),
             work / fmt::format("sitting_{}", sitting), [&](int done, int all) {
                 bar.update(fmt::format("presenting sitting {} of {} again", sitting, sittings), done, all);
             }});
        const RecordComparison& found = replay->comparison;
        report.compared.push_back(fmt::format(
            "sitting {}: {} with {}, {}, {} in all", sitting,
            counted(found.attempts - before.attempts, "attempt"), counted(found.flips - before.flips, "flip"),
            counted(found.samples - before.samples, "sample"), counted(found.rows - before.rows, "row")));
        before = found;
        if (replay->cut)
            report.not_compared.push_back(fmt::format("what follows the end of sitting {}'s record, for {}",
                                                      sitting, replay->cut->why));
        if (found.unknown_frames > 0 && sitting == 1)
            report.not_compared.push_back(pixels_not_known(found.unknown_frames));
        report.differences = found.differences;
        for (const auto& [id, further] : replay->further) {
            report.compared.push_back(
                fmt::format("further eye tracker {}: {}", id, counted(further.samples, "sample")));
            for (RecordDifference difference : further.differences) {
                difference.table = fmt::format("trackers/{}: {}", id, difference.table);
                report.differences.push_back(std::move(difference));
            }
        }
        if (!report.differences.empty())
            return;
    }
    add(compare_session_files(record.directory(), replay->folder, answers_beyond(*replay)),
        "meshes, maps, pictures and answers", report);
    if (!report.is_same())
        return;
    if (record.trials().empty()) {
        report.not_compared.emplace_back("exports: the session has no trials to export");
        return;
    }
    take_map_files(record, replay->folder);
    const std::optional<RecordCut> cut = replay->cut ? std::optional(replay->cut->cut) : std::nullopt;
    take_circumstances(replay->recorded_file, replay->folder / session_file_name, cut);
    add(compare_exports(record.directory(), replay->folder, work / "exports",
                        [&](int done, int all) { bar.update("exporting both", done, all); }),
        "exports in all formats", report);
    bar.finish();
}

void remake(const SessionRecord& record, const ReplayOptions& options, const fs::path& work,
            ReplayReport& report) {
    if (record.header().stimuli.empty())
        throw InputError(fmt::format("{}: this session was imported: the program showed nothing in it that "
                                     "could be shown again. `overt show` and `overt analyze` take it.",
                                     options.session.string()));
    const Experiment experiment = recorded_experiment(record, options.files, cache_folder());
    const Interruption interruption;
    remake_session({record, experiment, cache_folder(),
                    options.context ? options.context : context_of(record.header()), work},
                   report);
}

} // namespace

int run_replay(const ReplayOptions& given) {
    ReplayOptions options = given;
    options.session = session_in(given.session);
    const SessionRecord record(options.session);
    if (!options.picture.empty() || !options.movie.empty())
        return draw_trial(record, options);
    if (options.trial)
        throw InputError("--trial says of which trial --picture or --movie is made: give one of them");
    const SessionHeader& header = record.header();
    if (!header.further_tracker.empty())
        throw InputError(
            fmt::format("{}: this is the record of the further eye tracker {}: it is presented "
                        "again with its session, `overt replay {}`",
                        options.session.string(), header.further_tracker,
                        (fs::absolute(options.session) / ".." / "..").lexically_normal().string()));
    ReplayReport report;
    report.session = options.session.string();
    report.recorded_by = version_of(header.program);
    report.replayed_by = version_of(this_build());
    report.not_compared.push_back(not_compared());
    if (const std::optional<RecordDifference> changed = changed_content(record))
        report.differences.push_back(*changed);
    else {
        const ScratchFolder work("overt-replay");
        report.why_not = why_not_again(record);
        if (report.why_not.empty())
            present_again(record, options, work.path(), report);
        else
            remake(record, options, work.path(), report);
    }
    if (options.json)
        fmt::print("{}", json_text(to_json(report)));
    else
        fmt::print("{}", to_text(report));
    return report.is_same() ? 0 : 1;
}

} // namespace overt
