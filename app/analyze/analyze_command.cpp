#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/analyze/analyze_commands.h"
#include "app/analyze/kernel_width.h"
#include "app/analyze/study_folder.h"
#include "app/cli/command_options.h"
#include "app/cli/interruption.h"
#include "experiment/base/counted.h"
#include "experiment/base/error.h"
#include "experiment/study/tables/study_tables.h"

namespace overt {

namespace {

struct AnalyzeOptions {
    std::vector<std::filesystem::path> sessions;
    std::filesystem::path out; ///< empty: "analysis", of shards "shards"
    StudyOptions study;
    std::optional<std::string> compare; ///< nothing: the usual one, where it makes groups
    std::string by, sigma = "1deg", kernel = "geodesic", format = "csv", shard;
    bool overwrite = false;
    StudyExtras extras;
    bool json = false;
};

std::vector<std::string> listed(const std::string& text) {
    std::vector<std::string> items;
    std::size_t begin = 0;
    while (begin <= text.size()) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        if (end > begin)
            items.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return items;
}

void print_summary(const StudyResults& results, const std::filesystem::path& out, TableFormat format) {
    const StudyGlance& glance = results.glance;
    fmt::print("{}\n{}, {}, {} ({} excluded), {} samples\n", glance.title,
               counted(glance.observers, "observer"), counted(glance.sessions, "session"),
               counted(glance.trials, "trial"), glance.excluded_trials, glance.samples);
    std::vector<std::string> reasons;
    for (const auto& [why, count] : glance.not_counted)
        reasons.push_back(fmt::format("{} {}", count, name_of(why)));
    fmt::print("fixations: {} of {} counted{}{}\n", glance.counted, glance.fixations,
               reasons.empty() ? "" : "; ", fmt::join(reasons, ", "));
    for (const std::string& remark : results.remarks)
        fmt::print("note: {}\n", remark);
    for (const HeadFractionRow& row : results.head_fractions) {
        // The levels of single columns; the groups are in the tables.
        if (row.keys.size() > 1 || !row.by_count.value)
            continue;
        fmt::print("on the head, {}: {:.3f}",
                   row.keys.empty() ? "all" : row.keys[0].column + " " + row.keys[0].value,
                   *row.by_count.value);
        if (row.by_count.interval)
            fmt::print(" ({:.3f} … {:.3f})", row.by_count.interval->low, row.by_count.interval->high);
        if (row.corrected.value)
            fmt::print("; with the tracker's error taken out {:.3f}", *row.corrected.value);
        if (row.corrected.interval)
            fmt::print(" ({:.3f} … {:.3f})", row.corrected.interval->low, row.corrected.interval->high);
        fmt::print("\n");
    }
    fmt::print("analysis: {0}\n"
               "open next: {0}/report.html in a browser; all tables are explained in {0}/dictionary.json;\n"
               "           Rscript {0}/mixed_models.R fits mixed models, {0}/reporting.{1} lists what an "
               "article has to "
               "report\n",
               out.string(), ending_of(format));
}

/// Whether shards were given, and not sessions.
bool are_shards(const AnalyzeOptions& options) {
    const auto is_one = [](const std::filesystem::path& folder) { return is_shard(folder); };
    const auto first = std::ranges::find_if(options.sessions, is_one);
    if (first == options.sessions.end())
        return false;
    const auto other = std::ranges::find_if_not(options.sessions, is_one);
    if (other != options.sessions.end())
        throw InputError(
            fmt::format("{} is a shard and {} is none: give the shards of a study, or its sessions.",
                        first->string(), other->string()));
    return true;
}

int run_shard(const AnalyzeOptions& options) {
    if (are_shards(options))
        throw InputError("--shard reads sessions, and shards were given: leave it out to join them.");
    const Shard which = shard_called(options.shard);
    const std::filesystem::path out = (options.out.empty() ? "shards" : options.out) /
                                      fmt::format("shard_{}_of_{}", which.number, which.count);
    const Interruption interruption;
    std::filesystem::create_directories(out.parent_path());
    ExportFolder folder(out, options.overwrite,
                        [](const std::string& file) { return file == shard_file_name; });
    StudyShard shard = shard_of(options.sessions, which, options.study);
    int trials = 0;
    std::int64_t samples = 0;
    for (const ReadSession& session : shard.read) {
        for (const ReadTrial& trial : session.trials) {
            trials += trial.samples > 0;
            samples += trial.samples;
        }
    }
    const std::string what = fmt::format("shard {} of {}: {} of {}, {}, {} samples", which.number,
                                         which.count, counted(static_cast<int>(shard.read.size()), "session"),
                                         shard.sessions.size(), counted(trials, "trial"), samples);
    write_shard(folder.path(), std::move(shard));
    folder.publish();
    fmt::print("{}\n{}\nwhen all are there: overt analyze {}/shard_*_of_{} --out analysis\n", what,
               out.string(), out.parent_path().string(), which.count);
    return 0;
}

int run_analyze(AnalyzeOptions options) {
    options.study.by = listed(options.by);
    if (options.compare) {
        if (std::ranges::find(options.study.by, *options.compare) == options.study.by.end())
            throw InputError(fmt::format("--compare {}: takes one of the columns of --by, which are {}",
                                         *options.compare, fmt::join(options.study.by, ", ")));
        options.study.compare = *options.compare;
    }
    options.study.sigma = kernel_width(options.sigma);
    for (std::size_t i = 0; i < names_of<MapKernel>.size(); ++i) {
        if (names_of<MapKernel>[i] == options.kernel)
            options.study.kernel = static_cast<MapKernel>(i);
    }
    if (!options.shard.empty())
        return run_shard(options);
    if (options.out.empty())
        options.out = "analysis";
    TableFormat format = TableFormat::csv;
    for (const TableFormat one : {TableFormat::tsv, TableFormat::csv, TableFormat::jsonl}) {
        if (options.format == ending_of(one))
            format = one;
    }
    const Interruption interruption;
    const bool joins = are_shards(options);
    StudyFolder folder(options.out, options.overwrite);
    const StudyResults results =
        joins ? analyzed_shards(options.sessions, options.study) : analyzed(options.sessions, options.study);
    folder.publish(results, format, options.extras);
    if (options.json)
        fmt::print("{}", study_json(results));
    else
        print_summary(results, options.out, format);
    return 0;
}

void add_study_options(CLI::App& command, AnalyzeOptions& options) {
    StudyOptions& study = options.study;
    command
        .add_option(
            "--by", options.by,
            "Columns that make groups, with commas: any of the table of trials, observer, session, or "
            "a field of the observer's form")
        ->default_str("task,sculpture,material")
        ->type_name("COLUMNS");
    command
        .add_option("--compare", options.compare, "Column of --by whose levels are compared within observers")
        ->type_name("COLUMN")
        ->default_str(study.compare);
    command
        .add_option("--sigma", options.sigma,
                    "Standard deviation of the maps' kernel, such as 1deg (converted at the depth of each "
                    "fixation) or 30mm")
        ->type_name("WIDTH")
        ->capture_default_str();
    command
        .add_option(
            "--kernel", options.kernel,
            "How maps are blurred: geodesic along the surface, euclidean in space, voxel as in the paper")
        ->check(CLI::IsMember({"geodesic", "euclidean", "voxel"}))
        ->capture_default_str();
    command.add_option("--seed", study.seed, "Of the bootstrap, the permutations and the halves")
        ->check(seed_number())
        ->type_name("N")
        ->capture_default_str();
    command.add_option("--shortest-fixation", study.shortest_fixation_s, "Fixations below are not counted")
        ->check(not_negative())
        ->type_name("S")
        ->capture_default_str();
    command
        .add_option("--least-on-surface", study.least_on_surface,
                    "Share of a fixation's samples that must meet the sculpture, or miss it within the reach")
        ->check(CLI::Range(0.0, 1.0))
        ->capture_default_str();
    command
        .add_option(
            "--reach", study.reach_deg,
            "A sample that misses the sculpture by no more counts at the nearest place of its outline; "
            "0: only what meets it")
        ->check(not_negative())
        ->default_str("the accuracy of the validation")
        ->type_name("DEG");
    command
        .add_option("--most-lost", study.exclude.most_lost_share,
                    "Exclude trials that lost a larger share of samples, blinks apart")
        ->check(CLI::Range(0.0, 1.0))
        ->type_name("SHARE");
    command
        .add_option("--most-accuracy", study.exclude.most_accuracy_deg,
                    "Exclude trials after a validation with a larger mean error")
        ->check(not_negative())
        ->type_name("DEG");
    command
        .add_option("--most-drift", study.exclude.most_drift_deg,
                    "Exclude trials with a larger error at the drift check")
        ->check(not_negative())
        ->type_name("DEG");
    command
        .add_option("--most-missed", study.exclude.most_missed_refreshes,
                    "Exclude trials with more missed refreshes")
        ->check(CLI::NonNegativeNumber)
        ->type_name("N");
    command.add_option("--time-step", study.time_step_s, "Stretches of the time course")
        ->check(above_zero())
        ->type_name("S")
        ->capture_default_str();
    command.add_option("--confidence", study.confidence, "Level of intervals")
        ->check(CLI::Range(0.5, 0.999))
        ->capture_default_str();
    command.add_option("--resamples", study.resamples, "Draws of the bootstrap over observers")
        ->check(CLI::Range(100, 1000000))
        ->capture_default_str();
    command.add_option("--permutations", study.permutations, "Random permutations of tests")
        ->check(CLI::Range(100, 1000000))
        ->capture_default_str();
}

} // namespace

void add_analyze_command(CLI::App& app, ChosenCommand& chosen) {
    const auto given = std::make_shared<AnalyzeOptions>();
    AnalyzeOptions& options = *given;
    options.by = fmt::format("{}", fmt::join(options.study.by, ","));
    CLI::App& command = add_command(
        app, "analyze", "Fixations on the surface, maps, and the statistics of a study",
        "overt analyze sessions/overt_2019/* --out analysis\n"
        "  overt analyze sessions/overt_2019/* --by task,handedness --sigma 30mm --out by_hand\n"
        "  overt analyze sessions/overt_2019/sub-07_ses-01 --most-lost 0.2 --json --out one_observer\n"
        "  overt analyze sessions/overt_2019/* --shard 3/16     on the third of 16 machines, then\n"
        "  overt analyze shards/* --out analysis\n"
        "Exit codes: 0 done, 1 failed, 2 bad input.");
    command.add_option("SESSION", options.sessions, "Folders of sessions, or of all shards of a study")
        ->required();
    command.add_option("--out", options.out, "Folder to write to; with --shard, the folder of all shards")
        ->type_name("DIR")
        ->default_str("analysis; with --shard: shards");
    command
        .add_option("--shard", options.shard,
                    "Only read the part of machine I of N, I from 1, of these sessions; giving all shards in "
                    "place of the sessions joins them")
        ->type_name("I/N");
    add_study_options(command, options);
    command.add_option("--format", options.format, "Of the tables")
        ->check(CLI::IsMember({"csv", "tsv", "jsonl"}))
        ->capture_default_str();
    command.add_flag("--meshes", options.extras.meshes,
                     "Write each map as a coloured mesh, too (GLB and PLY)");
    command.add_flag("--volumes", options.extras.volumes,
                     "Write each map in space, too, as voxels (NRRD) and as a table of coordinates (.cube)");
    command.add_flag("--overwrite", options.overwrite, "Replace an analysis that is there");
    command.add_flag("--json", options.json, "Print the study as JSON");
    run_when_chosen(command, chosen, [given] { return run_analyze(*given); });
}

} // namespace overt
