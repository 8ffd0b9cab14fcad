#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/analyze/analyze_commands.h"
#include "app/analyze/kernel_width.h"
#include "app/analyze/study_folder.h"
#include "app/cli/command_options.h"
#include "app/cli/event_options.h"
#include "app/cli/interruption.h"
#include "app/inputs/protocol_file.h"
#include "app/inputs/session_folders.h"
#include "app/record/sound_sessions.h"
#include "experiment/base/counted.h"
#include "experiment/base/error.h"
#include "experiment/protocol/files/old_words.h"
#include "experiment/scene/files/vertex_values.h"
#include "experiment/study/methods/study_facts.h"
#include "experiment/study/tables/study_tables.h"

namespace overt {

namespace {

struct AnalyzeOptions {
    std::vector<std::filesystem::path> sessions;
    std::filesystem::path out; ///< empty: "analysis", of shards "shards"
    StudyOptions study;
    std::optional<std::string> compare;     ///< nothing: the usual one, where it makes groups
    std::vector<std::string> same_observer; ///< LABEL=LABEL
    std::vector<std::string> models;        ///< FILE, or OBJECT=FILE
    std::filesystem::path areas;            ///< empty: none
    std::string landmarks;                  ///< ids of lists with commas, or a table
    std::string by, surface_areas, sigma = "1deg", kernel = "geodesic", format = "csv", shard;
    bool overwrite = false;
    EventOptions events;
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

/// Read once here, so that a fault is told before minutes of reading sessions.
std::vector<ModelFile> model_files(const std::vector<std::string>& given) {
    std::vector<ModelFile> files;
    for (const std::string& text : given) {
        const std::size_t equals = text.find('=');
        if (equals == std::string::npos || std::filesystem::exists(text))
            files.push_back({"", text});
        else
            files.push_back({text.substr(0, equals), text.substr(equals + 1)});
        read_vertex_values(files.back().file);
    }
    return files;
}

std::vector<std::pair<std::string, std::string>> same_observers(const std::vector<std::string>& given) {
    std::vector<std::pair<std::string, std::string>> pairs;
    for (const std::string& text : given) {
        const std::size_t equals = text.find('=');
        if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
            throw InputError(fmt::format("--same-observer {}: write LABEL=LABEL, as 01=1", text));
        pairs.emplace_back(text.substr(0, equals), text.substr(equals + 1));
    }
    return pairs;
}

/// Says what is wrong with the file, if anything is.
std::vector<ChosenScreenArea> screen_areas_in(const std::filesystem::path& file) {
    Diagnostics diagnostics;
    std::vector<ChosenScreenArea> areas = read_screen_areas(file, diagnostics);
    print_findings(diagnostics);
    if (diagnostics.has_errors())
        throw FindingsPrinted(fmt::format("{}: cannot be used", file.string()));
    return areas;
}

/// Which object is the template, and its landmarks. Says what is wrong with their file, if anything is.
void read_template(const AnalyzeOptions& options, TemplateChoice& choice) {
    if (options.landmarks.empty())
        return;
    if (choice.object.empty())
        throw InputError(
            fmt::format("--landmarks {}: says by what to bring gaze to a template, and --template "
                        "OBJECT, which says to which, is missing",
                        options.landmarks));
    if (!options.landmarks.ends_with(".csv")) {
        choice.lists = listed(options.landmarks);
        return;
    }
    Diagnostics diagnostics;
    choice.file = std::filesystem::path(options.landmarks).filename().string();
    choice.landmarks = read_landmarks(options.landmarks, diagnostics);
    print_findings(diagnostics);
    if (diagnostics.has_errors())
        throw FindingsPrinted(fmt::format("{}: cannot be used", options.landmarks));
}

void print_screen_areas(const StudyResults& results) {
    for (const ScreenAreaRow& row : results.screen_area_groups) {
        if (!row.keys.empty() || !row.dwell_share.value)
            continue;
        fmt::print("in area {}: {:.1f} % of the time of fixation", row.area, 100.0 * *row.dwell_share.value);
        if (row.share_by_chance)
            fmt::print(" ({:.1f} % by chance)", 100.0 * *row.share_by_chance);
        if (row.first_arrival_s.value)
            fmt::print(", first arrival {:.3f} s, in {}", *row.first_arrival_s.value,
                       counted(row.trials, "trial"));
        fmt::print("\n");
    }
}

void print_summary(const StudyResults& results, const std::filesystem::path& out, TableFormat format) {
    const StudyGlance& glance = results.glance;
    fmt::print("{}\n{}, {}, {} ({} excluded), {} samples\n", glance.title,
               counted(glance.observers, "observer"), counted(glance.sessions, "session"),
               counted(glance.trials, unit_of_gaze(results)), glance.excluded_trials, glance.samples);
    std::vector<std::string> reasons;
    for (const auto& [why, count] : glance.not_counted)
        reasons.push_back(fmt::format("{} {}", count, name_of(why)));
    fmt::print("fixations: {} of {} counted{}{}\n", glance.counted, glance.fixations,
               reasons.empty() ? "" : "; ", fmt::join(reasons, ", "));
    for (const std::string& remark : results.remarks)
        fmt::print("note: {}\n", remark);
    std::map<std::string, std::set<std::string>> levels;
    for (const AreaRow& row : results.area_rows)
        for (const StudyKey& key : row.keys)
            levels[key.column].insert(key.value);
    const bool by_duration = rate_too_low_for_counts(results).has_value();
    for (const AreaRow& row : results.area_rows) {
        // The levels of single columns of the area of figure 4; of others all trials. The groups are in the
        // tables.
        if (row.keys.size() > (row.area == results.area ? 1 : 0) || !row.by_count.value)
            continue;
        // A column's only level is all trials once more.
        if (!row.keys.empty() && levels[row.keys[0].column].size() < 2)
            continue;
        const Estimate& share = by_duration ? row.by_duration : row.by_count;
        fmt::print("on {}, {}: {:.3f}{}", row.area == head_area ? "the head" : row.area,
                   row.keys.empty() ? "all" : row.keys[0].column + " " + row.keys[0].value,
                   share.value.value_or(*row.by_count.value), by_duration ? " of the time" : "");
        if (share.interval)
            fmt::print(" ({:.3f} … {:.3f})", share.interval->low, share.interval->high);
        if (row.corrected.value)
            fmt::print("; with the tracker's error taken out {:.3f}", *row.corrected.value);
        if (row.corrected.interval)
            fmt::print(" ({:.3f} … {:.3f})", row.corrected.interval->low, row.corrected.interval->high);
        fmt::print("\n");
    }
    print_screen_areas(results);
    if (!knows_stimuli(results)) {
        fmt::print(
            "analysis: {0}\n"
            "open next: {0}/report.html in a browser; all tables are explained in {0}/dictionary.json\n",
            out.string());
        return;
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
    std::vector<std::filesystem::path> own;
    for (std::size_t i = 0; i < options.sessions.size(); ++i)
        if (static_cast<int>(i % static_cast<std::size_t>(which.count)) == which.number - 1)
            own.push_back(options.sessions[i]);
    say_broken_seals(own);
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
    options.study.is_by_asked = options.by != fmt::format("{}", fmt::join(StudyOptions().by, ","));
    options.study.by = listed(options.by);
    for (std::string& column : options.study.by)
        column = todays_factor(std::move(column));
    options.study.areas = listed(options.surface_areas);
    options.study.detect_events = options.events.detection();
    if (options.compare) {
        options.compare = todays_factor(*std::move(options.compare));
        if (std::ranges::find(options.study.by, *options.compare) == options.study.by.end())
            throw InputError(fmt::format("--compare {}: takes one of the columns of --by, which are {}",
                                         *options.compare, fmt::join(options.study.by, ", ")));
        options.study.compare = *options.compare;
    }
    options.study.sigma = kernel_width(options.sigma);
    options.study.same_observer = same_observers(options.same_observer);
    options.study.models = model_files(options.models);
    read_template(options, options.study.onto);
    for (std::size_t i = 0; i < names_of<MapKernel>.size(); ++i) {
        if (names_of<MapKernel>[i] == options.kernel)
            options.study.kernel = static_cast<MapKernel>(i);
    }
    if (!options.areas.empty()) {
        options.study.screen_areas = screen_areas_in(options.areas);
        options.study.screen_areas_file = options.areas.filename().string();
    }
    options.sessions = sessions_in(options.sessions, is_shard);
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
    const std::vector<std::string> broken =
        joins ? std::vector<std::string>() : say_broken_seals(options.sessions);
    StudyResults results =
        joins ? analyzed_shards(options.sessions, options.study) : analyzed(options.sessions, options.study);
    // Also in the report, and whatever else is made of the results.
    results.remarks.insert(results.remarks.begin(), broken.begin(), broken.end());
    folder.publish(results, format, options.extras);
    if (options.json)
        fmt::print("{}", study_json(results));
    else
        print_summary(results, options.out, format);
    return 0;
}

void add_study_options(CLI::App& command, AnalyzeOptions& options) {
    StudyOptions& study = options.study;
    option(command, "--by", options.by, "COLUMNS",
           "Columns that make groups, with commas: any of the table of trials, observer, session, or a field "
           "of the observer's form")
        ->default_str("task,object,material");
    option(command, "--compare", options.compare, "COLUMN",
           "Column of --by whose levels are compared within observers")
        ->default_str(study.compare);
    option(command, "--area", options.surface_areas, "NAMES",
           "Areas of the objects, with commas: the first is that of figure 4 and the time course, and p of "
           "differences are corrected over them")
        ->default_str("all, the head first");
    option(command, "--sigma", options.sigma, "WIDTH",
           "Standard deviation of the maps' kernel, such as 1deg (converted at the depth of each fixation) "
           "or 30mm",
           shown_default);
    option(command, "--kernel", options.kernel, "",
           "How maps are blurred: geodesic along the surface, euclidean in space, voxel as in the paper",
           one_of({"geodesic", "euclidean", "voxel"}), shown_default);
    option(command, "--seed", study.seed, "SEED", "Of the bootstrap, the permutations and the halves",
           seed_number(), shown_default);
    option(command, "--smallest-effect", study.smallest_effect, "D",
           "Smallest effect of interest, in standard deviations of observers' differences: whether an effect "
           "is smaller is tested beside each p of two levels",
           CLI::PositiveNumber, shown_default);
    option(command, "--shortest-fixation", study.shortest_fixation_s, "S", "Fixations below are not counted",
           not_negative(), shown_default);
    option(command, "--least-on-surface", study.least_on_surface, "",
           "Share of a fixation's samples that must meet the object, or miss it within the reach",
           CLI::Range(0.0, 1.0), shown_default);
    option(command, "--reach", study.reach_deg, "DEG",
           "A sample that misses the object by no more counts at the nearest place of its outline; 0: "
           "only what meets it",
           not_negative())
        ->default_str("the accuracy of the validation");
    option(command, "--most-lost", study.exclude.most_lost_share, "SHARE",
           "Exclude trials that lost a larger share of samples, blinks apart", CLI::Range(0.0, 1.0));
    option(command, "--most-accuracy", study.exclude.most_accuracy_deg, "DEG",
           "Exclude trials after a validation with a larger mean error", not_negative());
    option(command, "--most-drift", study.exclude.most_drift_deg, "DEG",
           "Exclude trials with a larger error at the drift check", not_negative());
    option(command, "--most-missed", study.exclude.most_missed_refreshes, "N",
           "Exclude trials with more missed refreshes", CLI::NonNegativeNumber);
    add_event_options(command, options.events,
                      "Find fixations, saccades and blinks anew in the samples, in place of those on record; "
                      "imported recordings without any have them found anyway");
    option(command, "--same-observer", options.same_observer, "LABEL=LABEL",
           "Sessions of the first observer are those of the second, as 01=1; once for each", one_each_time);
    option(
        command, "--areas", options.areas, "FILE",
        "Areas of the screen to ask gaze for, besides those that recordings tell: an EyeLink file (.ias), or "
        "a table (.csv) with area, shape, left_px, top_px, right_px, bottom_px");
    option(command, "--model", options.models, "FILE",
           "A PLY mesh with a number at each vertex (saliency, density, value, quality …): where a model "
           "says that "
           "gaze goes, to be held against observers; OBJECT=FILE for one object; once for each",
           one_each_time);
    option(command, "--template", study.onto.object, "OBJECT",
           "Brings gaze on all objects to the surface of this one, so that maps are of all of them together "
           "and objects can be compared")
        ->default_str("each object is its own");
    option(command, "--landmarks", options.landmarks, "LISTS",
           "Of --template: by which places that correspond, lists of [[points]] of the protocol with commas, "
           "or a table (.csv) with object, landmark, x_mm, y_mm, z_mm")
        ->default_str("the middles of areas");
    option(command, "--time-step", study.time_step_s, "S", "Stretches of the time course", above_zero(),
           shown_default);
    option(command, "--confidence", study.confidence, "", "Level of intervals", CLI::Range(0.5, 0.999),
           shown_default);
    option(command, "--resamples", study.resamples, "", "Draws of the bootstrap over observers",
           CLI::Range(100, 1000000), shown_default);
    option(command, "--permutations", study.permutations, "", "Random permutations of tests",
           CLI::Range(100, 1000000), shown_default);
    command.add_flag(
        "--tfce", study.threshold_free,
        "Tests maps of differences without a threshold, too (threshold-free cluster enhancement), which "
        "takes some times as long as clusters");
}

} // namespace

void add_analyze_command(CLI::App& app, ChosenCommand& chosen) {
    const auto [command, options] = add_command(
        app, chosen, run_analyze, "analyze", "Fixations on the surface, maps, and the statistics of a study",
        "overt analyze sessions/overt_2019/* --out analysis\n"
        "  overt analyze sessions/overt_2019/* --by task,handedness --sigma 30mm --out by_hand\n"
        "  overt analyze sessions/overt_2019/sub-07_ses-01 --most-lost 0.2 --json --out one_observer\n"
        "  overt analyze sessions/heads/* --template average --landmarks face --compare object --by object\n"
        "  overt analyze sessions/overt_2019/* --shard 3/16     on the third of 16 machines, then\n"
        "  overt analyze shards/* --out analysis\n"
        "Exit codes: 0 done, 1 failed, 2 bad input.");
    options.by = fmt::format("{}", fmt::join(options.study.by, ","));
    command
        .add_option("SESSION", options.sessions, fmt::format("{}; or all shards of a study", sessions_help))
        ->required();
    option(command, "--out", options.out, "DIR", "Folder to write to; with --shard, the folder of all shards")
        ->default_str("analysis; with --shard: shards");
    option(command, "--shard", options.shard, "I/N",
           "Only read the part of machine I of N, I from 1, of these sessions; giving all shards in place of "
           "the sessions joins them");
    add_study_options(command, options);
    option(command, "--format", options.format, "", "Of the tables", one_of({"csv", "tsv", "jsonl"}),
           shown_default);
    command.add_flag("--meshes", options.extras.meshes,
                     "Write each map as a coloured mesh, too (GLB and PLY)");
    command.add_flag("--volumes", options.extras.volumes,
                     "Write each map in space, too, as voxels (NRRD) and as a table of coordinates (.cube)");
    command.add_flag("--overwrite", options.overwrite, "Replace an analysis that is there");
    add_json_flag(command, options.json);
}

} // namespace overt
