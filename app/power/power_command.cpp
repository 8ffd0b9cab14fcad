#include "app/power/power_command.h"

#include <memory>
#include <optional>
#include <thread>

#include <fmt/format.h>

#include "app/analyze/kernel_width.h"
#include "app/cli/command_options.h"
#include "app/cli/interruption.h"
#include "app/cli/own_folders.h"
#include "app/cli/progress_bar.h"
#include "app/power/power_simulation.h"
#include "experiment/base/counted.h"
#include "experiment/base/export_folder.h"
#include "experiment/power/power_tables.h"
#include "render/figures/power_figure.h"

namespace overt {

namespace {

struct PowerOptions {
    std::filesystem::path protocol, out = "power";
    std::vector<std::string> effects;
    std::string observers = "6:24", sigma = "1deg", format = "csv";
    std::optional<double> head_share_sd, accuracy_deg;
    PowerSettings settings;
    std::string sequential = "none";
    bool overwrite = false, json = false;
};

void print_answers(const PowerResults& results, const std::filesystem::path& out) {
    for (const PowerCurve& curve : results.curves) {
        fmt::print("{}\n  planted: {}\n  tested as: {}\n", answer_of(curve, results), curve.planted,
                   curve.analysis);
        for (const PowerPoint& point : curve.points)
            fmt::print("  {:>4} observers {:6.1f} %   ({:.1f} … {:.1f} %)\n", point.observers,
                       100.0 * point.share(), 100.0 * point.interval.low, 100.0 * point.interval.high);
        if (curve.sequential)
            for (std::size_t look = 0; look < curve.points.size(); ++look)
                fmt::print(
                    "  look with {:>4}: ended where p is at most {:.5f}; up to it {:.1f} % had found it\n",
                    curve.points[look].observers, curve.sequential->levels[look],
                    100.0 * curve.sequential->found[look] /
                        static_cast<double>(curve.points[look].studies.size()));
    }
    for (const std::string& remark : results.remarks)
        fmt::print("note: {}\n", remark);
    fmt::print("assumed of observers:");
    for (const StudyParameter& parameter : results.parameters) {
        if (parameter.name == "head-share-sd" || parameter.name == "accuracy" ||
            parameter.name == "area-shares")
            fmt::print(" {} {}{};", parameter.name, parameter.value,
                       parameter.unit.empty() ? "" : fmt::format(" {}", parameter.unit));
    }
    fmt::print(" {}, {} each\npower: {}\n", results.protocol, counted(results.trials, "trial"), out.string());
}

int run_power(PowerOptions options) {
    const Experiment experiment =
        read_experiment_or_report(options.protocol, cache_folder(), InputDepth::objects);
    const std::vector<PowerEffect> effects =
        power_effects(options.effects, experiment.protocol, areas_of(experiment.objects));
    PowerSettings& settings = options.settings;
    settings.observers = observer_counts(options.observers);
    for (const AlphaSpending spending : {AlphaSpending::obrien_fleming, AlphaSpending::pocock})
        if (options.sequential == name_of(spending))
            settings.sequential = spending;
    settings.gaze = gaze_study_settings(experiment.protocol);
    settings.gaze.sigma = kernel_width(options.sigma);
    if (options.head_share_sd)
        settings.gaze.head_share_sd = *options.head_share_sd;
    if (options.accuracy_deg)
        settings.gaze.accuracy_deg = *options.accuracy_deg;
    const TableFormat format = options.format == "tsv"     ? TableFormat::tsv
                               : options.format == "jsonl" ? TableFormat::jsonl
                                                           : TableFormat::csv;
    const Interruption interruption;
    ExportFolder folder(options.out, options.overwrite, [](const std::string& file) {
        return is_power_table(file) || file == "power_curve.svg" || file == "power_curve.pdf";
    });
    ProgressBar bar;
    const PowerResults results =
        simulate_power(experiment, effects, settings, [&](std::string_view what, int done, int total) {
            bar.update(what, done, total);
            Interruption::check("The simulation");
        });
    bar.finish();
    write_power_tables(results, folder.path(), format);
    write_power_figure(results, folder.path());
    folder.publish();
    if (options.json)
        fmt::print("{}", power_json(results));
    else
        print_answers(results, options.out);
    return 0;
}

} // namespace

void add_power_command(CLI::App& app, ChosenCommand& chosen) {
    const auto [command, options] = add_command(
        app, chosen, run_power, "power",
        "The chance that a planned study finds an effect, by simulated studies",
        "overt power protocols/overt_2019.toml --effect head:material=rough:odds=1.5 --observers 6:24\n"
        "  overt power protocols/overt_2019.toml --effect wss:material=rough:ratio=1.2:sd=0.1 "
        "--head-share-sd 0.4\n"
        "  overt power protocols/overt_2019.toml --effect cc:material=rough:against=coated:share=0.2\n"
        "  overt power protocols/overt_2019.toml --effect none --observers 12\n"
        "  overt power PROTOCOL --effect threshold:object=bust:shift=0.05 --effect "
        "rating:material=rough:shift=0.5\n"
        "An effect is a measure (head, area=NAME, wss, cc; of answers threshold, slope, correct, dprime,\n"
        "choice, rating), the level of a factor in which it is, and its size: odds of the area or of a\n"
        "correct answer, ratio of WSS or slopes, share of fixations that go to one spot, shift of a "
        "threshold\n"
        "or a mean. It may name :against=LEVEL, :sd=… over\n"
        "observers, and :task=ID or :object=ID for trials of these only. :test=factor, interaction or "
        "cluster\n"
        "name other tests of gaze. none tests everything without "
        "an\n"
        "effect. docs/power.md says what is simulated, and what is not.\n"
        "Exit codes: 0 done, 1 failed, 2 bad input.");
    PowerSettings& settings = options.settings;
    settings.jobs = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    command.add_option("PROTOCOL", options.protocol, "Protocol file")->required()->type_name("FILE");
    option(command, "--effect", options.effects, "EFFECT", "An effect, several times for several, or none",
           must_be_given, one_each_time)
        ->take_all();
    option(command, "--observers", options.observers, "N",
           "Numbers of observers: 12, 6:24, 6:24:3 or 6,12,18", shown_default);
    option(command, "--studies", settings.studies, "N", "Studies to simulate", CLI::Range(10, 100000),
           shown_default);
    option(command, "--alpha", settings.alpha, "", "A study has found the effect if p is at most this",
           CLI::Range(0.0001, 0.5), shown_default);
    option(command, "--power", settings.target, "", "Share of studies that is asked for",
           CLI::Range(0.05, 0.999), shown_default);
    option(command, "--equivalence", settings.equivalence, "D",
           "Of studies that are to show that an effect is smaller than D standard deviations of observers' "
           "differences: the chance that they do",
           CLI::Range(0.05, 5.0));
    option(command, "--sequential", options.sequential, "",
           "Studies are looked at with each number of observers, and end as soon as they have found the "
           "effect: how "
           "alpha is spent over the looks",
           one_of({"none", std::string(name_of(AlphaSpending::obrien_fleming)),
                   std::string(name_of(AlphaSpending::pocock))}),
           shown_default);
    option(command, "--head-share-sd", options.head_share_sd, "",
           "Standard deviation over observers of the logit of their shares on the head, and on other areas "
           "with a "
           "share",
           CLI::Range(0.0, 5.0))
        ->default_str("the protocol's");
    option(command, "--accuracy", options.accuracy_deg, "DEG",
           "Standard deviation along each axis of the tracker's constant error in a trial",
           CLI::Range(0.0, 5.0))
        ->default_str("the protocol's");
    option(command, "--sigma", options.sigma, "WIDTH",
           "Standard deviation of the maps' kernel, such as 1deg or 30mm", shown_default);
    option(command, "--permutations", settings.permutations, "",
           "Random ones, where there are too many for all", CLI::Range(100, 1000000), shown_default);
    option(command, "--seed", settings.seed, "SEED", "Of all that is drawn at random", seed_number(),
           shown_default);
    option(command, "--jobs", settings.jobs, "N", "Threads; the result is the same with any number",
           above_zero(), shown_default);
    option(command, "--out", options.out, "DIR", "Folder to write to", shown_default);
    option(command, "--format", options.format, "", "Of the tables", one_of({"csv", "tsv", "jsonl"}),
           shown_default);
    command.add_flag("--overwrite", options.overwrite, "Replace results that are there");
    add_json_flag(command, options.json);
}

} // namespace overt
