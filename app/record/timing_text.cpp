#include "app/record/timing_text.h"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "experiment/base/counted.h"

namespace overt {

namespace {

constexpr MissCause causes[] = {MissCause::asked_late, MissCause::drawn_late, MissCause::shown_late};

/// Bars as long as the logarithm of the count: one late flip among thousands is seen.
void print_histogram(const TimingReport& report) {
    constexpr int per_decade = 8;
    fmt::print("\nfrom flip to flip, by the time stamps (bars are logarithmic):\n");
    int gap = 0;
    for (const IntervalBin& bin : interval_histogram(report)) {
        gap = bin.count == 0 ? gap + 1 : 0;
        if (gap == 1)
            fmt::print("{:>17}\n", "…");
        if (gap > 0)
            continue;
        const int length = 1 + static_cast<int>(per_decade * std::log10(bin.count));
        std::string bar;
        for (int i = 0; i < length; ++i)
            bar += "█";
        fmt::print("{:>7.2f}–{:<7.2f} ms {:>8}  {}\n", bin.from_ms, bin.to_ms, bin.count, bar);
    }
}

void print_trials_to_look_at(const TimingReport& report) {
    for (const TrialTiming& trial : report.trials) {
        const int number = trial.trial.index + 1;
        for (const MissedRun& run : trial.missed_runs)
            fmt::print("  trial {}: refresh {}: {} missed, {}\n", number, run.refresh_in_trial, run.count,
                       name_of(run.cause));
        if (!trial.wrong_stamps.empty())
            fmt::print("  trial {}: {} time stamps contradict the others\n", number,
                       trial.wrong_stamps.size());
        if (trial.unaccounted > 0)
            fmt::print("  trial {} ({}): {} without a row\n", number, name_of(trial.status),
                       counted(trial.unaccounted, "refresh", "refreshes"));
        for (const std::string& disturbance : trial.disturbances)
            fmt::print("  trial {}: {}\n", number, disturbance);
    }
}

double share(int part, int whole) { return whole > 0 ? 100.0 * part / whole : 0.0; }

} // namespace

void print_timing(const TimingReport& report) {
    if (report.trials.empty()) {
        fmt::print("\ntiming: nothing was presented\n");
        return;
    }
    if (report.planned_refreshes == 0) {
        fmt::print("\ntiming: no trial was completed\n");
        print_trials_to_look_at(report);
        return;
    }
    fmt::print("\ntiming of the completed trials\n");
    if (report.has_simulated_faults)
        fmt::print("  THE DISPLAY'S FAULTS WERE SIMULATED: a trial run, no measurement\n");
    else if (report.is_virtual)
        fmt::print("  in virtual time: nothing could come late\n");
    if (report.is_unproven)
        fmt::print("  UNPROVEN: no real vertical blank tells when pictures were lit, nor what was missed\n");
    std::string sources;
    for (const std::string& source : report.sources)
        sources += (sources.empty() ? "" : ", ") + source;
    fmt::print("  time stamps       {}\n", sources);
    fmt::print("  refreshes         {} planned, {} flipped, {}, {} unaccounted for\n",
               report.planned_refreshes, report.flipped_refreshes,
               report.is_unproven ? "missed: unproven" : fmt::format("{} missed", report.missed_refreshes),
               report.unaccounted);
    for (const MissCause cause : causes)
        if (const int count = report.missed_by_cause[static_cast<int>(cause)]; count > 0)
            fmt::print("                    {} {}\n", count, name_of(cause));
    fmt::print("  refresh interval  {:.6f} ± {:.6f} ms ({:.4f} Hz; nominal {:.4f} Hz)\n", report.interval_ms,
               report.interval_uncertainty_ms, 1e3 / report.interval_ms, 1e3 / report.nominal_interval_ms);
    fmt::print(
        "  time stamps off   {:.4f} ms (standard deviation), onsets {:.4f} ms, {} contradict the others\n",
        report.stamp_sd_ms, report.onset_jitter_ms, report.wrong_stamps);
    fmt::print("  longest gap       {:.3f} ms between flips\n", report.longest_gap_ms);
    fmt::print("  gaze samples      {}, {:.2f} % on a lit frame, {:.3f} % where the plan has another\n",
               report.samples, share(report.samples_on_frame, report.samples),
               share(report.samples_off_plan, report.samples));
    print_trials_to_look_at(report);
    print_histogram(report);
}

void print_input_delays(const std::optional<InputDelays>& delays) {
    if (delays)
        fmt::print(
            "\nfrom an input to the refresh that shows it, without the display's latency: {:.1f} ms in "
            "the median, 95 % within {:.1f} ms, at the longest {:.1f} ms, of {} that moved what was "
            "shown\n",
            1e3 * delays->median_s, 1e3 * delays->most_s, 1e3 * delays->longest_s,
            counted(delays->count, "input"));
}

nlohmann::ordered_json to_json(const std::optional<InputDelays>& delays) {
    if (!delays)
        return {};
    return {{"inputs", delays->count},
            {"median_ms", 1e3 * delays->median_s},
            {"within_95_percent_ms", 1e3 * delays->most_s},
            {"longest_ms", 1e3 * delays->longest_s}};
}

namespace {

/// Of times that nothing proves no number is claimed.
nlohmann::ordered_json missed_count(int missed, bool is_unproven) {
    return is_unproven ? nlohmann::ordered_json("unproven") : nlohmann::ordered_json(missed);
}

nlohmann::ordered_json to_json(const TrialTiming& trial, bool is_unproven) {
    auto runs = nlohmann::ordered_json::array();
    for (const MissedRun& run : trial.missed_runs)
        runs.push_back({{"refresh", run.refresh_in_trial},
                        {"count", run.count},
                        {"cause", name_of(run.cause)},
                        {"margin_ms", 1e3 * to_seconds(run.margin)}});
    return {{"trial", trial.trial.index + 1},
            {"attempt", trial.attempt},
            {"status", name_of(trial.status)},
            {"planned_refreshes", trial.planned_refreshes},
            {"flipped_refreshes", trial.flipped_refreshes},
            {"missed_refreshes", missed_count(trial.missed_refreshes, is_unproven)},
            {"unaccounted_refreshes", trial.unaccounted},
            {"missed", runs},
            {"wrong_stamps", trial.wrong_stamps},
            {"longest_gap_ms", trial.longest_gap_ms},
            {"onset_deviation_ms", trial.onset_deviation_ms},
            {"onset_uncertainty_ms", trial.onset_uncertainty_ms},
            {"stamp_sd_ms", trial.stamp_sd_ms},
            {"interval_ms", trial.interval_ms},
            {"interval_uncertainty_ms", trial.interval_uncertainty_ms},
            {"samples", trial.samples},
            {"samples_on_frame", trial.samples_on_frame},
            {"samples_off_plan", trial.samples_off_plan},
            {"disturbances", trial.disturbances}};
}

} // namespace

nlohmann::ordered_json to_json(const TimingReport& report) {
    auto trials = nlohmann::ordered_json::array();
    for (const TrialTiming& trial : report.trials)
        trials.push_back(to_json(trial, report.is_unproven));
    auto bins = nlohmann::ordered_json::array();
    for (const IntervalBin& bin : interval_histogram(report))
        if (bin.count > 0)
            bins.push_back({{"from_ms", bin.from_ms}, {"to_ms", bin.to_ms}, {"count", bin.count}});
    nlohmann::ordered_json by_cause;
    for (const MissCause cause : causes)
        by_cause[std::string(name_of(cause))] = report.missed_by_cause[static_cast<int>(cause)];
    return {{"simulated_faults", report.has_simulated_faults},
            {"virtual_time", report.is_virtual},
            {"time_stamps", report.sources},
            {"planned_refreshes", report.planned_refreshes},
            {"flipped_refreshes", report.flipped_refreshes},
            {"unproven", report.is_unproven},
            {"missed_refreshes", missed_count(report.missed_refreshes, report.is_unproven)},
            {"missed_by_cause", by_cause},
            {"unaccounted_refreshes", report.unaccounted},
            {"nominal_interval_ms", report.nominal_interval_ms},
            {"interval_ms", report.interval_ms},
            {"interval_uncertainty_ms", report.interval_uncertainty_ms},
            {"stamp_sd_ms", report.stamp_sd_ms},
            {"onset_jitter_ms", report.onset_jitter_ms},
            {"wrong_stamps", report.wrong_stamps},
            {"longest_gap_ms", report.longest_gap_ms},
            {"samples", report.samples},
            {"samples_on_frame", report.samples_on_frame},
            {"samples_off_plan", report.samples_off_plan},
            {"intervals", bins},
            {"trials", trials}};
}

} // namespace overt
