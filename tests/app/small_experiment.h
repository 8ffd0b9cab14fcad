/// An experiment like the paper's, small enough to run in a second: two busts in two materials, three tasks,
/// 128 x 128 pixels, animations of a second.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "experiment/scene/files/ply_writer.h"
#include "tests/support/figures.h"
#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

namespace overt::test {

inline constexpr std::string_view small_protocol = R"([protocol]
name = "small"
title = "A small experiment"

[display]
width_px = 544
height_px = 192
refresh_hz = 120
width_mm = 272
height_mm = 96
viewing_distance_mm = 573
output = "color++"
latency_ms = 3.5
background = 0.1

[bake]
quality = "live"

[tracker]
rate_hz = 1000

[view]
width_px = 128
height_px = 128

[animation]
frame_count = 31
frame_rate_hz = 30
amplitude_deg = 25
duration_s = 1

[schedule]
observers = 2
max_object_run = 0

[screens]
task_min_s = 0.2
drift_target_s = 0.3
response_min_s = 0.2

[[object]]
id = "bust"
title = "Bust"
mesh = "meshes/bust.ply"

[[object]]
id = "tall"
title = "Tall bust"
mesh = "meshes/tall.ply"

[[material]]
id = "smooth"
kind = "smooth-conductor"

[[material]]
id = "matt"
kind = "diffuse"

[[task]]
id = "face"
question = "Look at the face."
simulated_head_share = 1

[[task]]
id = "clothes"
question = "Look at the clothes."
simulated_head_share = 0

[[task]]
id = "free"
question = "Look as you like."
stimuli = "once-per-object"
simulated_head_share = 0.5
)";
inline constexpr int small_trials = 10; ///< two tasks for four stimuli, one for each object

/// The text with one of its lines, or a part of it, replaced. It must occur exactly once.
inline std::string with(std::string_view text, std::string_view part, std::string_view instead) {
    std::string changed(text);
    const std::size_t at = changed.find(part);
    if (at == std::string::npos || changed.find(part, at + 1) != std::string::npos)
        throw std::runtime_error("the text does not hold this once: " + std::string(part));
    return changed.replace(at, part.size(), instead);
}

inline Mesh tall_bust() {
    Mesh mesh;
    add_part(mesh, box({-45.0, -40.0, 40.0}, {45.0, 40.0, 260.0}), "body");
    add_part(mesh, ball({0.0, -15.0, 310.0}, 48.0), "head");
    add_part(mesh, box({-60.0, -60.0, 0.0}, {60.0, 60.0, 38.0}), "plinth");
    return mesh;
}

/// A folder that stays from one run of the tests to the next.
inline std::filesystem::path lasting_folder() {
    return std::filesystem::path(OVERT_PROGRAM).parent_path().parent_path() / "tests/cache";
}

/// A cache that stays, for tests of what the shipped sculptures are needed for: making one takes seven
/// seconds of a processor. What is in it is named by what made it.
inline std::filesystem::path lasting_cache() { return lasting_folder(); }

/// A cache that stays until the program is built again: the stimuli of small experiments, made by this
/// program and looked at by the tests of many things. Those that test how stimuli are made take a cache of
/// their own.
inline std::filesystem::path shared_cache() {
    static const std::filesystem::path folder = [] {
        namespace fs = std::filesystem;
        const std::string begin = "made_by_";
        fs::path ours =
            lasting_folder() /
            (begin + fmt::format("{:x}", fs::last_write_time(OVERT_PROGRAM).time_since_epoch().count()));
        if (!fs::exists(ours) && fs::exists(lasting_folder())) {
            std::error_code error; // another test may be removing the same
            for (const fs::directory_entry& entry : fs::directory_iterator(lasting_folder()))
                if (entry.path().filename().string().starts_with(begin))
                    fs::remove_all(entry.path(), error);
        }
        fs::create_directories(ours);
        return ours;
    }();
    return folder;
}

/// Whether a small experiment begins with an empty cache, which goes with it.
enum class Cache { shared, own };

/// Its protocol and meshes in a folder of their own, with a place for sessions.
class SmallExperiment {
  public:
    explicit SmallExperiment(std::string_view protocol = small_protocol, Cache cache = Cache::shared)
        : SmallExperiment(protocol, cache == Cache::shared ? shared_cache() : std::filesystem::path()) {}
    explicit SmallExperiment(Cache cache) : SmallExperiment(small_protocol, cache) {}
    /// `cache`: where it is; empty: its own.
    SmallExperiment(std::string_view protocol, std::filesystem::path cache)
        : cache_(cache.empty() ? folder_.path() / "cache" : std::move(cache)) {
        folder_.file("small.toml", protocol);
        std::filesystem::create_directories(folder_.path() / "meshes");
        write_ply(folder_.path() / "meshes/bust.ply", bust());
        write_ply(folder_.path() / "meshes/tall.ply", tall_bust());
    }

    const TemporaryFolder& folder() const { return folder_; }
    std::filesystem::path protocol() const { return folder_.path() / "small.toml"; }
    const std::filesystem::path& cache() const { return cache_; }
    std::filesystem::path sessions() const { return folder_.path() / "sessions"; }

    /// `overt ARGUMENTS` with this experiment's cache.
    ProgramRun overt(const std::vector<std::string>& arguments,
                     std::vector<std::string> environment = {}) const {
        environment.push_back("OVERT_CACHE=" + cache().string());
        return run_overt(arguments, environment);
    }

    /// `overt run` for a simulated observer in virtual time, headless on OSMesa unless `more` says otherwise.
    ProgramRun run(const std::vector<std::string>& more = {},
                   std::vector<std::string> environment = {}) const {
        std::vector<std::string> arguments{
            "run",        protocol().string(), "--simulate-observer", "5", "--virtual-time",
            "--sessions", sessions().string()};
        const auto has = [&](std::string_view option) {
            return std::find(more.begin(), more.end(), option) != more.end();
        };
        if (!has("--observer"))
            arguments.insert(arguments.end(), {"--observer", "P01"});
        if (!has("--context"))
            arguments.insert(arguments.end(), {"--context", "osmesa"});
        if (!has("--seed"))
            arguments.insert(arguments.end(), {"--seed", "7"});
        arguments.insert(arguments.end(), more.begin(), more.end());
        return overt(arguments, std::move(environment));
    }

    /// Where the n-th session of an observer is.
    std::filesystem::path session(int number = 1, const std::string& observer = "P01") const {
        return sessions() / "small" / ("sub-" + observer + "_ses-0" + std::to_string(number));
    }

  private:
    TemporaryFolder folder_;
    std::filesystem::path cache_;
};

} // namespace overt::test
