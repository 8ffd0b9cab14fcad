#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <thread>

#include <fmt/format.h>

#include "app/analyze/analyze_commands.h"
#include "app/analyze/planted_answers.h"
#include "app/analyze/planted_truth.h"
#include "app/analyze/study_folder.h"
#include "app/cli/command_options.h"
#include "app/cli/interruption.h"
#include "app/cli/own_command.h"
#include "app/cli/own_folders.h"
#include "app/cli/progress_bar.h"
#include "app/inputs/prepared_stimuli.h"
#include "experiment/base/counted.h"
#include "experiment/base/error.h"
#include "experiment/base/whole_file.h"
#include "experiment/record/read/session_record.h"
#include "experiment/record/session_schema.h"
#include "experiment/study/gauge_reliefs.h"
#include "experiment/study/methods/study_facts.h"
#include "experiment/study/tables/study_tables.h"
#include "render/gl/headless_context.h"

namespace overt {

namespace {

namespace fs = std::filesystem;

struct ReplicateOptions {
    fs::path protocol;
    fs::path out = "replication";
    int observers = 12;
    int trials = 0; ///< of each observer; 0: all
    std::uint64_t seed = 1;
    int jobs = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    ContextChoice context;
    bool overwrite = false, json = false;
};

/// One of the simulated observers.
struct Replica {
    std::string label;
    std::uint64_t seed = 0;
    fs::path session, said;
    std::unique_ptr<OwnCommand> command;
    bool is_done = false;
};

/// The sessions of all observers, as many at once as there are jobs.
class ReplicaSessions {
  public:
    ReplicaSessions(const ReplicateOptions& options, const Protocol& protocol)
        : options_(&options), folder_(options.out / "sessions") {
        const int digits = options.observers > 99 ? 3 : 2;
        for (int i = 1; i <= options.observers; ++i) {
            Replica replica;
            replica.label = fmt::format("{:0{}}", i, digits);
            replica.seed = options.seed + static_cast<std::uint64_t>(i) - 1;
            replica.session = folder_ / protocol.name / fmt::format("sub-{}_ses-01", replica.label);
            replica.said = folder_ / fmt::format("observer_{}.txt", replica.label);
            replica.is_done = is_complete(replica, protocol);
            replicas_.push_back(std::move(replica));
        }
    }

    void run() {
        fs::create_directories(folder_);
        ProgressBar bar;
        const int all = static_cast<int>(replicas_.size());
        int reported = -1;
        for (;;) {
            int done = 0, running = 0;
            for (Replica& replica : replicas_) {
                finish(replica);
                done += replica.is_done;
                running += replica.command != nullptr;
            }
            if (done != reported)
                bar.update("observers", reported = done, all);
            if (done == all)
                return;
            for (Replica& replica : replicas_) {
                if (running < options_->jobs && !replica.is_done && !replica.command) {
                    begin(replica);
                    ++running;
                }
            }
            if (Interruption::requested())
                throw Error(
                    fmt::format("interrupted: {} of {} observers are done, and the same command goes on from "
                                "there.",
                                done, all));
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
        }
    }

    std::vector<fs::path> sessions() const {
        std::vector<fs::path> paths;
        for (const Replica& replica : replicas_)
            paths.push_back(replica.session);
        return paths;
    }

    ObserverSeeds seeds() const {
        ObserverSeeds seeds;
        for (const Replica& replica : replicas_)
            seeds[replica.label] = replica.seed;
        return seeds;
    }

  private:
    /// Of an earlier call of the same protocol. Throws InputError where another one's session lies.
    static bool is_complete(const Replica& replica, const Protocol& protocol) {
        if (!fs::exists(replica.session / session_file_name))
            return false;
        const SessionRecord record(replica.session);
        if (record.header().protocol.text != protocol.text)
            throw InputError(
                fmt::format("{}: this session is of another protocol, or of an earlier text of this one: "
                            "give another folder with --out, or remove this one.",
                            replica.session.string()));
        return record.is_complete();
    }

    void begin(Replica& replica) {
        std::vector<std::string> arguments{"run",
                                           options_->protocol.string(),
                                           "--observer",
                                           replica.label,
                                           "--simulate-observer",
                                           fmt::format("{}", replica.seed),
                                           "--seed",
                                           fmt::format("{}", replica.seed),
                                           "--virtual-time",
                                           "--no-pictures",
                                           "--sessions",
                                           folder_.string()};
        if (options_->context) {
            arguments.emplace_back("--context");
            arguments.emplace_back(*options_->context == ContextKind::egl ? "egl" : "osmesa");
        }
        if (options_->trials > 0) {
            arguments.emplace_back("--trials");
            arguments.push_back(fmt::format("{}", options_->trials));
        }
        if (fs::exists(replica.session))
            arguments.emplace_back("--resume");
        replica.command = std::make_unique<OwnCommand>(arguments, replica.said);
    }

    static void finish(Replica& replica) {
        const auto code = replica.command ? replica.command->exit_code() : std::nullopt;
        if (!code)
            return;
        replica.command.reset();
        if (*code != 0)
            throw Error(fmt::format("the session of observer {} failed with exit code {}: {} tells why.",
                                    replica.label, *code, replica.said.string()));
        replica.is_done = true;
    }

    const ReplicateOptions* options_;
    fs::path folder_;
    std::vector<Replica> replicas_;
};

void make_maps_of_stimuli(const Experiment& experiment, const ReplicateOptions& options) {
    const auto context = make_headless_context(options.context);
    StimulusLibrary library(*context, experiment.protocol, experiment.objects, cache_folder());
    prepare_maps_alone(library, MapsNow::made, experiment.protocol);
}

/// How many intervals hold the planted fraction, of those that there are.
struct Agreement {
    int intervals = 0, holding = 0;
};

Agreement agreement_of(const StudyResults& results) {
    Agreement agreement;
    for (const AreaRow& row : results.area_rows) {
        if (!row.planted || !row.corrected.interval)
            continue;
        ++agreement.intervals;
        agreement.holding += row.corrected.interval->contains(*row.planted);
    }
    return agreement;
}

/// How large WSS came out beside what was planted, over the groups' objects.
void print_spreads(const StudyResults& results) {
    Agreement agreement;
    double log_ratios = 0.0;
    for (const DistributionRow& row : results.distributions) {
        if (!row.planted_wss_mm2 || !row.wss_mm2.value || !row.wss_mm2.interval ||
            *row.planted_wss_mm2 <= 0.0 || *row.wss_mm2.value <= 0.0)
            continue;
        ++agreement.intervals;
        agreement.holding += row.wss_mm2.interval->contains(*row.planted_wss_mm2);
        log_ratios += std::log(*row.wss_mm2.value / *row.planted_wss_mm2);
    }
    if (agreement.intervals > 0)
        fmt::print("WSS of fixations: {:.3f} times what was planted (geometric mean); {} of {} intervals of "
                   "{:g} % hold it\n",
                   std::exp(log_ratios / agreement.intervals), agreement.holding, agreement.intervals,
                   100.0 * results.confidence);
}

/// A number of answers beside what was planted.
void print_answer(const std::string& what, const Estimate& found, const std::optional<double>& planted,
                  Agreement& agreement) {
    if (!planted || !found.value)
        return;
    fmt::print("{:44} {:8.3g} {:8.3g}", what, *planted, *found.value);
    if (found.interval) {
        fmt::print("   {:.3g} … {:.3g}", found.interval->low, found.interval->high);
        ++agreement.intervals;
        agreement.holding += found.interval->contains(*planted);
    }
    fmt::print("\n");
}

void print_answers(const StudyResults& results) {
    const StudyAnswers& answers = results.answers;
    if (answers.given.empty())
        return;
    fmt::print("answers, over observers\n{:44} {:>8} {:>8}   interval\n", "", "planted", "found");
    Agreement agreement;
    const auto named = [](const AnswerOf& of) {
        return of.item.empty() ? of.answer : fmt::format("{} {}", of.answer, of.item);
    };
    for (const AnswerCurveRow& row : answers.curves) {
        if (!row.of.observer.empty())
            continue;
        const std::string within =
            row.column.empty() ? std::string() : fmt::format(", {} {}", row.column, row.level);
        print_answer(fmt::format("{}: threshold of {}{}", named(row.of), row.factor, within), row.threshold,
                     row.planted_threshold, agreement);
        if (row.slope)
            print_answer(fmt::format("{}: slope over {}{}", named(row.of), row.factor, within),
                         Estimate::of(*row.slope), row.planted_slope, agreement);
    }
    for (const AnswerScaleRow& row : answers.scales)
        if (row.of.observer.empty())
            print_answer(fmt::format("{}: scale at {} {}", named(row.of), row.factor, row.level), row.value,
                         row.planted, agreement);
    for (const AnswerRatingRow& row : answers.ratings)
        if (row.of.observer.empty())
            print_answer(fmt::format("{}: mean{}", named(row.of),
                                     row.factor.empty() ? "" : fmt::format(", {} {}", row.factor, row.level)),
                         row.mean, row.planted, agreement);
    for (const AnswerSummaryRow& row : answers.summaries)
        if (row.of.observer.empty())
            print_answer(fmt::format("{}: share correct", named(row.of)), row.correct, row.planted_correct,
                         agreement);
    for (const AnswerTrendRow& row : answers.trends)
        if (row.of.observer.empty())
            print_answer(fmt::format("{}: {} by {}{}", named(row.of), row.measure, row.along,
                                     row.column.empty() ? std::string()
                                                        : fmt::format(", {} {}", row.column, row.level)),
                         row.slope, row.planted, agreement);
    for (const AnswerLikenessRow& row : answers.likenesses)
        if (row.of.observer.empty())
            print_answer(fmt::format("{}: together, {} {} and {}", named(row.of), row.factor, row.a, row.b),
                         row.share, row.planted, agreement);
    for (const AnswerDifferenceRow& row : answers.differences)
        print_answer(
            fmt::format("{}: {}, {} {} less {}", named(row.of), row.measure, row.column, row.a, row.b),
            row.difference, row.planted, agreement);
    for (const GazeChoiceRow& row : answers.gaze_choices)
        if (row.of.observer.empty())
            print_answer(fmt::format("{}: {} of the chosen", named(row.of), row.measure), row.value,
                         row.planted, agreement);
    for (const ReliefRow& row : results.reliefs.reliefs)
        if (row.of.observer.empty() || results.observers.size() == 1)
            print_answer(fmt::format("{}: gain of attitudes, {}", row.of.answer,
                                     picture_in_words(row.of, results.reliefs.reliefs)),
                         row.attitude_gain, row.planted, agreement);
    if (agreement.intervals > 0)
        fmt::print("{} of {} intervals of {:g} % hold what was planted\n", agreement.holding,
                   agreement.intervals, 100.0 * results.confidence);
}

void print(const StudyResults& results, const fs::path& analysis) {
    fmt::print("{}, {}, {} samples, {} of {} fixations counted\n",
               counted(results.glance.observers, "simulated observer"),
               counted(results.glance.trials, unit_of_gaze(results)), results.glance.samples,
               results.glance.counted, results.glance.fixations);
    for (const std::string& remark : results.remarks)
        fmt::print("note: {}\n", remark);
    fmt::print(
        "share of fixations on areas; drawn: what chance made of the planted one in these very trials; "
        "corrected: with the tracker's error taken out\n"
        "{:28} {:>8} {:>8} {:>8} {:>10}   interval\n",
        "", "planted", "drawn", "found", "corrected");
    for (const AreaRow& row : results.area_rows) {
        // The levels of single columns; the groups are in the tables.
        if (row.keys.size() > 1 || !row.by_count.value || !row.planted)
            continue;
        fmt::print("{:28} {:8.3f} {:>8} {:8.3f}",
                   fmt::format("{}, {}", row.area,
                               row.keys.empty() ? "all" : row.keys[0].column + " " + row.keys[0].value),
                   *row.planted, row.drawn ? fmt::format("{:.3f}", *row.drawn) : "", *row.by_count.value);
        if (row.corrected.value)
            fmt::print(" {:10.3f}", *row.corrected.value);
        if (row.corrected.interval)
            fmt::print("   {:.3f} … {:.3f}", row.corrected.interval->low, row.corrected.interval->high);
        fmt::print("\n");
    }
    const Agreement agreement = agreement_of(results);
    if (agreement.intervals > 0)
        fmt::print("{} of {} corrected intervals of {:g} % hold what was planted\n", agreement.holding,
                   agreement.intervals, 100.0 * results.confidence);
    print_spreads(results);
    print_answers(results);
    fmt::print("analysis: {}\n", analysis.string());
}

int run_replicate(const ReplicateOptions& options) {
    const Experiment experiment =
        read_experiment_or_report(options.protocol, cache_folder(), InputDepth::everything);
    ReplicaSessions replicas(options, experiment.protocol);
    const fs::path analysis = options.out / "analysis";
    fs::create_directories(options.out);
    StudyFolder folder(analysis, options.overwrite);
    const Interruption interruption;
    make_maps_of_stimuli(experiment, options);
    replicas.run();
    StudyOptions study;
    study.seed = options.seed;
    StudyResults results = analyzed(replicas.sessions(), study);
    add_planted_truth(results, experiment, replicas.seeds());
    add_planted_answers(results, experiment.protocol, replicas.seeds(), replicas.sessions());
    folder.publish(results, TableFormat::csv, {});
    if (options.json)
        fmt::print("{}", study_json(results));
    else
        print(results, analysis);
    return 0;
}

} // namespace

void add_replicate_command(CLI::App& app, ChosenCommand& chosen) {
    const auto [command, options] = add_command(
        app, chosen, run_replicate, "replicate",
        "Simulates a whole study through the real pipeline and analyses it beside the truth that was planted",
        "overt replicate protocols/overt_2019.toml --observers 12 --out replication\n"
        "What observers look at is planted by simulated_head_share, simulated_area_shares and\n"
        "[[simulated_effect]] in the protocol. An\n"
        "interrupted call goes on where it ended.\n"
        "Exit codes: 0 done, 1 failed, 2 bad input.");
    command.add_option("PROTOCOL", options.protocol, "Protocol file")->required()->type_name("FILE");
    option(command, "--observers", options.observers, "N", "How many observers", CLI::Range(1, 999),
           shown_default);
    option(command, "--out", options.out, "DIR", "Folder for sessions and analysis", shown_default);
    option(command, "--seed", options.seed, "SEED",
           "Of the first observer, and of the analysis; the others' follow", seed_number(), shown_default);
    option(command, "--trials", options.trials, "N",
           "Only the first N trials of each observer, to try a protocol", above_zero());
    option(command, "--jobs", options.jobs, "N", "Sessions at once", above_zero(), shown_default);
    add_context_option(command, options.context);
    command.add_flag("--overwrite", options.overwrite, "Replace an analysis that is there");
    add_json_flag(command, options.json);
}

} // namespace overt
