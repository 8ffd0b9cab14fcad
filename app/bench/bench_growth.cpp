#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>

#include "app/bench/bench_command.h"
#include "app/cli/own_command.h"
#include "app/cli/progress_bar.h"
#include "experiment/base/error.h"
#include "experiment/base/scratch_folder.h"
#include "experiment/base/whole_file.h"
#include "experiment/record/seal_chain.h"
#include "experiment/record/session_file.h"
#include "experiment/record/session_schema.h"
#include "experiment/scene/files/ply_writer.h"

namespace overt {

namespace {

namespace fs = std::filesystem;

/// Runs `overt arguments…` to its end. Throws Error with what it said if it fails.
CommandCost run_command(const std::vector<std::string>& arguments, const fs::path& folder) {
    const fs::path said = folder / "said.txt";
    fs::remove(said);
    OwnCommand command(arguments, said);
    const CommandCost cost = command.wait();
    if (command.exit_code() != 0)
        throw Error(fmt::format("overt {} failed:\n{}", arguments.front(), read_whole_file(said)));
    return cost;
}

/// A sphere of a few hundred triangles, 100 mm in radius.
Mesh ball() {
    constexpr int rings = 12, sectors = 16;
    constexpr double pi = 3.14159265358979323846;
    Mesh mesh;
    for (int ring = 0; ring <= rings; ++ring)
        for (int sector = 0; sector < sectors; ++sector) {
            const double up = pi * ring / rings, round = 2.0 * pi * sector / sectors;
            mesh.positions.emplace_back(100.0 * std::sin(up) * std::cos(round),
                                        100.0 * std::sin(up) * std::sin(round), 100.0 * std::cos(up));
        }
    const auto at = [](int ring, int sector) {
        return static_cast<unsigned>(ring * sectors + sector % sectors);
    };
    for (int ring = 0; ring < rings; ++ring)
        for (int sector = 0; sector < sectors; ++sector) {
            mesh.triangles.emplace_back(at(ring, sector), at(ring + 1, sector), at(ring + 1, sector + 1));
            mesh.triangles.emplace_back(at(ring, sector), at(ring + 1, sector + 1), at(ring, sector + 1));
        }
    mesh.triangle_parts.assign(mesh.triangles.size(), 0);
    mesh.part_names = {"body"};
    return mesh;
}

/// An experiment of so many short trials of one object in two materials.
fs::path write_experiment(const fs::path& folder, int trials) {
    fs::create_directories(folder);
    write_ply(folder / "ball.ply", ball());
    std::string table = "material\n";
    for (int trial = 0; trial < trials; ++trial)
        table += trial % 2 == 0 ? "dark\n" : "light\n";
    write_whole_file(folder / "trials.csv", table);
    write_whole_file(folder / "growth.toml", R"([protocol]
name = "growth"
[display]
width_px = 640
height_px = 480
refresh_hz = 60
width_mm = 400
height_mm = 300
viewing_distance_mm = 900
output = "native-8bit"
gamma = 2.2
[bake]
quality = "live"
[tracker]
rate_hz = 250
[view]
width_px = 64
height_px = 64
[animation]
frame_count = 6
frame_rate_hz = 30
amplitude_deg = 10
duration_s = 0.2
[schedule]
observers = 1
max_object_run = 0
[screens]
task_min_s = 0.1
drift_target_s = 0.1
response_min_s = 0.1
[[object]]
id = "ball"
mesh = "ball.ply"
[[material]]
id = "dark"
kind = "diffuse"
reflectance = [0.2, 0.2, 0.2]
[[material]]
id = "light"
kind = "diffuse"
[[task]]
id = "look"
question = "Look."
trials = "trials.csv"
)");
    return folder / "growth.toml";
}

/// The same session as if of another observer, with seals of its own.
void copy_as_observer(const fs::path& session, const fs::path& copy, const std::string& label) {
    fs::copy(session, copy, fs::copy_options::recursive);
    SQLite::Database database = open_session_file(copy / session_file_name, SessionFileUse::write);
    SQLite::Transaction transaction(database);
    SQLite::Statement rename(database, "UPDATE session SET observer_label = ?");
    rename.bind(1, label);
    rename.exec();
    seal_all_anew(database);
    transaction.commit();
}

/// Time and memory of one command over sizes of its input.
struct Growth {
    std::string command;
    std::string of; ///< "trials" or "sessions"
    std::vector<int> sizes;
    std::vector<CommandCost> taken;
};

/// By how much the logarithm grows from the last size but one to the last, for each of that of the size: 1 is
/// in proportion. What a command takes with nothing to do, as far as the first size shows, is taken out
/// first. What lies below `least` is not told from chance, and counts as that much.
double exponent(const Growth& growth, double CommandCost::*what, double least) {
    const std::size_t last = growth.sizes.size() - 1;
    const auto value = [&](std::size_t i) { return growth.taken[i].*what; };
    const double per_piece = (value(1) - value(0)) / (growth.sizes[1] - growth.sizes[0]);
    const double at_nothing = std::max(0.0, value(0) - per_piece * growth.sizes[0]);
    const double before = std::max(value(last - 1) - at_nothing, least),
                 after = std::max(value(last) - at_nothing, least);
    return std::log(after / before) /
           std::log(static_cast<double>(growth.sizes[last]) / static_cast<double>(growth.sizes[last - 1]));
}

class GrowthBench {
  public:
    GrowthBench(bool is_quick, const fs::path& folder)
        : trials_(is_quick ? std::vector<int>{2, 4, 6} : std::vector<int>{30, 300, 3000}),
          sessions_(is_quick ? std::vector<int>{2, 3, 4} : std::vector<int>{10, 100, 1000}), folder_(folder) {
    }

    std::vector<Growth> measure() {
        const int steps = 5 * static_cast<int>(trials_.size()) + 2 * static_cast<int>(sessions_.size());
        ProgressBar bar;
        const auto tell = [&](const std::string& what) { bar.update(what, done_++, steps); };
        Growth run{"run", "trials", trials_, {}}, exported{"export", "trials", trials_, {}},
            analyzed{"analyze", "trials", trials_, {}}, verified{"verify", "trials", trials_, {}},
            replayed{"replay", "trials", trials_, {}};
        for (const int trials : trials_) {
            const std::string name = fmt::format("trials_{}", trials);
            const fs::path protocol = write_experiment(folder_ / name, trials),
                           sessions = folder_ / name / "sessions";
            // The stimuli are made before.
            run_command({"run", protocol.string(), "--observer", "09", "--simulate-observer", "1",
                         "--virtual-time", "--context", "osmesa", "--trials", "1", "--sessions",
                         (folder_ / name / "first").string()},
                        folder_);
            tell(fmt::format("run, {} trials", trials));
            run.taken.push_back(run_command({"run", protocol.string(), "--observer", "01",
                                             "--simulate-observer", "1", "--virtual-time", "--context",
                                             "osmesa", "--seed", "1", "--sessions", sessions.string()},
                                            folder_));
            const std::string session = (sessions / "growth" / "sub-01_ses-01").string();
            tell(fmt::format("export, {} trials", trials));
            exported.taken.push_back(
                run_command({"export", session, "--out", (folder_ / name / "tables").string()}, folder_));
            tell(fmt::format("analyze, {} trials", trials));
            analyzed.taken.push_back(
                run_command({"analyze", session, "--out", (folder_ / name / "analysis").string()}, folder_));
            tell(fmt::format("verify, {} trials", trials));
            verified.taken.push_back(run_command({"verify", session}, folder_));
            tell(fmt::format("replay, {} trials", trials));
            replayed.taken.push_back(run_command({"replay", session}, folder_));
        }
        Growth all_exported{"export", "sessions", sessions_, {}},
            all_analyzed{"analyze", "sessions", sessions_, {}};
        const fs::path session =
            folder_ / fmt::format("trials_{}", trials_.front()) / "sessions/growth/sub-01_ses-01";
        const fs::path study = folder_ / "study";
        fs::create_directories(study);
        int made = 0;
        for (const int count : sessions_) {
            for (; made < count; ++made)
                copy_as_observer(session, study / fmt::format("sub-{:04}_ses-01", made + 1),
                                 fmt::format("{:04}", made + 1));
            tell(fmt::format("export, {} sessions", count));
            all_exported.taken.push_back(run_command(
                {"export", study.string(), "--out", (folder_ / fmt::format("tables_{}", count)).string()},
                folder_));
            tell(fmt::format("analyze, {} sessions", count));
            all_analyzed.taken.push_back(run_command(
                {"analyze", study.string(), "--out", (folder_ / fmt::format("analysis_{}", count)).string()},
                folder_));
        }
        bar.finish();
        return {run, exported, analyzed, verified, replayed, all_exported, all_analyzed};
    }

  private:
    std::vector<int> trials_, sessions_;
    fs::path folder_;
    int done_ = 0;
};

} // namespace

BenchFigures bench_growth(const BenchOptions& options) {
    constexpr double most = 1.1;
    const ScratchFolder scratch("overt-growth");
    BenchFigures figures;
    for (const Growth& growth : GrowthBench(options.is_quick, scratch.path()).measure()) {
        const std::string name = fmt::format("{} over {}", growth.command, growth.of);
        for (std::size_t i = 0; i < growth.sizes.size(); ++i) {
            figures.push_back(
                {fmt::format("{}, {}: processor", name, growth.sizes[i]), growth.taken[i].processor_s, "s"});
            figures.push_back(
                {fmt::format("{}, {}: memory", name, growth.sizes[i]), growth.taken[i].peak_mb, "MB"});
        }
        const double time = exponent(growth, &CommandCost::processor_s, 0.02),
                     memory = exponent(growth, &CommandCost::peak_mb, 4.0);
        const std::string of_time = name + ": exponent of processor time",
                          of_memory = name + ": exponent of memory";
        // A few trials say nothing of growth: the quick ones show that it can be measured.
        figures.push_back(options.is_quick ? BenchFigure{of_time, time, ""}
                                           : at_most(of_time, time, "", most));
        figures.push_back(options.is_quick ? BenchFigure{of_memory, memory, ""}
                                           : at_most(of_memory, memory, "", most));
    }
    return figures;
}

} // namespace overt
