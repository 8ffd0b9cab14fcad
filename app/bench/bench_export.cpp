#include <chrono>

#include <fmt/format.h>

#include "app/bench/bench_clock.h"
#include "app/bench/bench_command.h"
#include "app/cli/resident_memory.h"
#include "experiment/base/scratch_folder.h"
#include "experiment/record/asc/asc_export.h"
#include "experiment/record/asc/asc_import.h"
#include "experiment/record/bids/bids_export.h"
#include "experiment/record/header_rows.h"
#include "experiment/record/session_schema.h"
#include "experiment/record/write/session_store.h"

namespace overt {

namespace {

constexpr int recorded_trials = 8;
constexpr double trial_s = 8.0;
constexpr double recorded_rate_hz = 2000.0;

/// A session like those of the default experiment, with gaze that wanders; without maps, for it is the
/// writing of files that is measured.
std::filesystem::path record_session(const std::filesystem::path& folder, int trial_count) {
    SessionHeader header;
    header.protocol = {"bench", "Benchmark", "", hash_of_text(""), {}};
    header.schedule.observer = {"1", 1};
    for (int trial = 0; trial < trial_count; ++trial)
        header.schedule.trials.push_back({trial, 0, {0, 0}, 0});
    header.started_utc = "2026-01-01T00:00:00Z";
    header.program.version = "bench";
    header.tracker = {"made up", recorded_rate_hz, Eye::left};
    header.poses = distinct_poses(header.animations.front());
    header.tasks = {{"free", "Look around"}};
    header.objects = {{"bust", "A bust", "", "", {}, {Camera{}}, {}, {}}};
    header.materials = {{"gold", "Gold"}};
    header.stimuli = {{{0, 0}, "made up", ""}};
    std::filesystem::create_directories(folder);
    create_session_file(folder / session_file_name, header);
    SessionStore::Options options;
    options.wait_when_full = true;
    SessionStore store(folder / session_file_name, options);
    const PageCycle plan = header.page_cycle_of({});
    for (const Trial& trial : header.schedule.trials) {
        const SessionTime start{from_seconds(20.0 * trial.index)};
        store.clock_pair({start, TrackerTime(std::chrono::seconds(20 * trial.index)), start});
        store.trial_started(trial, start);
        for (int refresh = 0; refresh < plan.total_refreshes; ++refresh) {
            const PageCycleEntry& entry = plan.entry_at(refresh);
            FlipRecord flip{trial.index, refresh, entry.frame, entry.frame, entry.pose, {}};
            flip.report.refresh = {refresh};
            flip.report.vertical_blank = start + from_seconds(1.0 + refresh / header.display.refresh_hz);
            store.flip(flip);
        }
        for (int n = 0; n < static_cast<int>(trial_s * recorded_rate_hz); ++n) {
            GazeSample sample;
            sample.eye = Eye::left;
            sample.sampled_at =
                TrackerTime(std::chrono::seconds(20 * trial.index + 1) + std::chrono::microseconds(500 * n));
            if (n % 1000 > 40) {
                sample.gaze = ScreenPoint{960.0 + 0.0371 * (n % 7001), 540.0 - 0.0193 * (n % 5003)};
                sample.pupil_area = static_cast<float>(900 + n % 97);
            }
            store.sample(trial.index, sample);
        }
        TrialOutcome outcome;
        outcome.task_screen_onset = start + from_seconds(0.5);
        outcome.presentation_onset = start + from_seconds(1.0);
        outcome.presentation_end = outcome.response_screen_onset = start + from_seconds(9.0);
        outcome.responded_at = start + from_seconds(12.0);
        store.trial_finished(trial, outcome);
    }
    store.close();
    return folder;
}

struct Work {
    double megabytes = 0.0, rows = 0.0;
};

class ExportBench {
  public:
    explicit ExportBench(const ScratchFolder& scratch) : scratch_(scratch) {}

    /// Each in turn, on a session and on one four times as long.
    BenchFigures measure() {
        const auto no_surface = [](const ViewedObject&) -> const SurfaceLookup* { return nullptr; };
        for (const int times : {1, 4})
            sessions_.push_back(
                record_session(scratch_.path() / fmt::format("session_{}", times), recorded_trials * times));
        for (const TableFormat format : {TableFormat::tsv, TableFormat::jsonl}) {
            TableExportOptions tables;
            tables.format = format;
            run(fmt::format("{} export", ending_of(format)),
                [&](const std::filesystem::path& session, const std::filesystem::path& out) {
                    const auto counts = export_tables(SessionRecord(session), no_surface, out, tables);
                    return Work{1e-6 * static_cast<double>(counts.bytes), static_cast<double>(counts.rows)};
                });
        }
        run("bids export", [&](const std::filesystem::path& session, const std::filesystem::path& out) {
            const auto counts = export_bids(SessionRecord(session), no_surface, out);
            return Work{1e-6 * static_cast<double>(counts.bytes), static_cast<double>(counts.rows)};
        });
        run("asc export", [&](const std::filesystem::path& session, const std::filesystem::path& out) {
            const auto counts = export_asc(SessionRecord(session), out);
            return Work{1e-6 * static_cast<double>(counts.bytes), static_cast<double>(counts.lines)};
        });
        run("asc import", [&](const std::filesystem::path& session, const std::filesystem::path& out) {
            const std::string name = session.filename().string();
            const auto exported = scratch_.path() / ("asc export " + name) / "sub-1_ses-01_run-01.asc";
            AscImportOptions options;
            options.place = {scratch_.path(), "bench", "1"};
            options.out = out;
            const AscImportSummary summary = import_asc(exported, options);
            return Work{1e-6 * static_cast<double>(std::filesystem::file_size(exported)),
                        static_cast<double>(summary.survey.lines)};
        });
        return figures_;
    }

  private:
    template <class Do> void run(const std::string& what, const Do& work) {
        double memory_mb[2] = {}, seconds[2] = {};
        Work done[2];
        for (std::size_t i = 0; i < sessions_.size(); ++i) {
            const double before_mb = resident_memory_mb();
            reset_peak_memory();
            const auto start = std::chrono::steady_clock::now();
            done[i] = work(sessions_[i], scratch_.path() / (what + " " + sessions_[i].filename().string()));
            seconds[i] = seconds_since(start);
            memory_mb[i] = peak_memory_mb() - before_mb;
        }
        figures_.push_back({what + ": text", done[1].megabytes / seconds[1], "MB/s", {}, {}});
        figures_.push_back({what + ": rows", done[1].rows / seconds[1], "1/s", {}, {}});
        figures_.push_back({what + ": peak memory above the program's own", memory_mb[0], "MB", {}, {}});
        constexpr double most_growth_mb = 4.0;
        figures_.push_back(at_most(what + ": growth of it in a session 4 times as long",
                                   memory_mb[1] - memory_mb[0], "MB", most_growth_mb));
    }

    const ScratchFolder& scratch_;
    std::vector<std::filesystem::path> sessions_;
    BenchFigures figures_;
};

} // namespace

BenchFigures bench_export(const BenchOptions&) {
    const ScratchFolder scratch("overt-bench");
    return ExportBench(scratch).measure();
}

} // namespace overt
