#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <thread>

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include "app/bench/bench_clock.h"
#include "app/bench/bench_command.h"
#include "app/bench/metronome.h"
#include "app/watch/watched_session.h"
#include "devices/host/clocks.h"
#include "devices/operator/gaze_tap.h"
#include "devices/tracker/threaded_tracker.h"
#include "experiment/base/error.h"
#include "experiment/base/scratch_folder.h"
#include "experiment/record/header_rows.h"
#include "experiment/record/session_schema.h"
#include "experiment/scene/files/ply_writer.h"

namespace overt {

namespace {

constexpr double target_ms = 5.0;

/// Gaze that goes round on the object, once in two seconds.
ScreenPoint round_the_middle(std::int64_t number) {
    const double turn = 2.0 * 3.14159265358979 * static_cast<double>(number) / (2.0 * Metronome::rate_hz);
    return {960.0 + 40.0 * std::cos(turn), 540.0 + 150.0 * std::sin(turn)};
}

/// A session as a view finds it while it runs: its header and a mesh.
SessionHeader lay_out_session(const std::filesystem::path& folder, const Object& object) {
    SessionHeader header;
    header.protocol = {"bench", "Benchmark", "", hash_of_text(""), {}};
    header.schedule.observer = {"1", 1};
    header.schedule.trials.push_back({0, 0, {0, 0}, 0});
    header.started_utc = "2026-01-01T00:00:00Z";
    header.program.version = "bench";
    header.tracker = {"metronome", Metronome::rate_hz, Eye::right};
    header.poses = distinct_poses(header.animations.front());
    header.tasks = {{"free", "Look around"}};
    header.objects = {{object.id,
                       object.id,
                       object.mesh_hash,
                       "mesh.ply",
                       object.mesh->part_names,
                       {object.scene().view.camera},
                       object.scene().bounds.centre(),
                       object.scene().bounds}};
    header.materials = {{"gold", "Gold"}};
    header.stimuli = {{{0, 0}, "made up", ""}};
    header.display.screen.image_px = object.scene().view.image_px;
    header.display.screen.image_origin_px =
        centred_origin_px(header.display.screen.screen_px, header.display.screen.image_px);
    std::filesystem::create_directories(folder);
    write_ply(folder / "mesh.ply", object.mesh);
    create_session_file(folder / session_file_name, header);
    return header;
}

/// The session's side: a trial with an animation whose frames change 30 times a second, a tracker on its
/// thread, and the operator's socket.
class RunningSession {
  public:
    RunningSession(const std::filesystem::path& folder, const SessionHeader& header)
        : server_(options_of(folder, header, clock_)), gaze_(server_, clock_),
          tracker_(std::make_unique<Metronome>(clock_, processor_s_, round_the_middle), clock_,
                   TrackerWish{}),
          poses_(static_cast<int>(header.poses.angles.size())) {
        ViewNews news;
        news.kind = ViewNews::Kind::phase;
        news.phase = SessionPhase::stimulus;
        news.trial = 0;
        server_.push(news);
        news.kind = ViewNews::Kind::trial_started;
        server_.push(news);
        tracker_.tell_samples_to(&gaze_);
        tracker_.start_recording();
        frames_ = std::jthread([this](const std::stop_token& stop) { show(stop); });
    }
    ~RunningSession() {
        frames_ = {};
        tracker_.stop_recording();
    }

    const SteadyClock& clock() const { return clock_; }
    const std::filesystem::path& socket() const { return server_.socket(); }

  private:
    static OperatorServer::Options options_of(const std::filesystem::path& folder,
                                              const SessionHeader& header, const SteadyClock& clock) {
        OperatorServer::Options options;
        options.socket = folder / operator_socket_name;
        options.facts.folder = folder;
        options.facts.protocol = "bench";
        options.facts.trials = 1;
        options.facts.has_tracker = true;
        options.facts.width_px = header.display.screen.screen_px.x;
        options.facts.height_px = header.display.screen.screen_px.y;
        const ImageBox image = header.display.screen.image_box();
        options.facts.slots = {
            {"centre", image.origin_px.x, image.origin_px.y, image.size_px.x, image.size_px.y}};
        options.facts.poses = static_cast<int>(header.poses.angles.size());
        options.facts.clock_zero_s = seconds_of(CLOCK_MONOTONIC) - to_seconds(clock.now() - SessionTime{});
        ViewedStimulus shown;
        shown.object = header.objects.front().id;
        shown.material = "gold";
        options.trials = {{"free", "Look around", {shown}}};
        return options;
    }
    void show(const std::stop_token& stop) {
        for (int frame = 0; !stop.stop_requested(); ++frame) {
            ViewNews news;
            news.kind = ViewNews::Kind::flip;
            news.at = clock_.now();
            news.trial = 0;
            news.pose = frame % poses_;
            server_.push(news);
            std::array<TrackerItem, 256> items;
            while (tracker_.poll(items) == items.size()) {
            }
            clock_.wait_until(news.at + from_seconds(1.0 / 30.0));
        }
    }

    SteadyClock clock_;
    std::atomic<double> processor_s_{0.0};
    OperatorServer server_;
    GazeTap gaze_;
    ThreadedTracker tracker_;
    int poses_;
    std::jthread frames_;
};

/// Delays in milliseconds.
struct Delays {
    std::vector<double> ms;
    std::size_t on_surface = 0;

    double quantile(double share) {
        if (ms.empty())
            throw RecordError("bench watch: no point of gaze came");
        const auto at = ms.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(ms.size() - 1));
        std::nth_element(ms.begin(), at, ms.end());
        return *at;
    }
    void report(BenchFigures& figures, const std::string& what) {
        figures.push_back({what + ", points", static_cast<double>(ms.size()), ""});
        figures.push_back(
            {"the same, share of them on the object",
             static_cast<double>(on_surface) / static_cast<double>(std::max<std::size_t>(1, ms.size())), ""});
        figures.push_back(at_most("the same, median", quantile(0.5), "ms", target_ms));
        figures.push_back(at_most("the same, 99 % of points", quantile(0.99), "ms", target_ms));
        figures.push_back({"the same, largest", quantile(1.0), "ms"});
    }
};

/// A view without a window, in this process: from the time at which a sample was due to its surface point.
Delays to_surface_point(const RunningSession& session, double seconds) {
    OperatorClient client(session.socket());
    WatchedSession watched(client);
    Delays delays;
    SessionTime end = SessionTime::max();
    while (session.clock().now() < end) {
        watched.read(std::chrono::milliseconds(5));
        if (!watched.object())
            continue;
        if (end == SessionTime::max())
            end = session.clock().now() + from_seconds(seconds);
        const double now_s = to_seconds(session.clock().now() - SessionTime{});
        for (const GazeOnSurface& one : watched.new_gaze()) {
            delays.ms.push_back(1e3 * (now_s - 1e-6 * static_cast<double>(one.gaze.sampled_us)));
            delays.on_surface += one.hit ? 1 : 0;
        }
    }
    return delays;
}

/// The window, a program of its own: to the end of the frame in which the point stands.
Delays to_window(const RunningSession& session, double seconds, const std::filesystem::path& times) {
    const std::filesystem::path program =
        std::filesystem::read_symlink("/proc/self/exe").parent_path() / "overt-watch-window";
    const std::string socket = session.socket();
    const double zero_s = seconds_of(CLOCK_MONOTONIC) - to_seconds(session.clock().now() - SessionTime{});
    const pid_t window = ::fork();
    if (window == 0) {
        ::execl(program.c_str(), program.c_str(), socket.c_str(), times.c_str(), static_cast<char*>(nullptr));
        ::_exit(127);
    }
    // The first seconds go to the window, the mesh and its surface.
    constexpr double begins_s = 4.0;
    std::this_thread::sleep_for(std::chrono::duration<double>(begins_s + seconds));
    const double end_s = seconds_of(CLOCK_MONOTONIC);
    ::kill(window, SIGTERM);
    int status = 0;
    ::waitpid(window, &status, 0);
    if (status != 0)
        throw DeviceError("bench watch: the window did not end in order");
    std::ifstream file(times);
    std::string heading;
    std::getline(file, heading);
    Delays delays;
    double sampled_us = 0.0, shown_s = 0.0;
    for (int on_surface = 0; file >> sampled_us >> shown_s >> on_surface;)
        if (shown_s > end_s - seconds) {
            delays.ms.push_back(1e3 * (shown_s - zero_s - 1e-6 * sampled_us));
            delays.on_surface += on_surface != 0 ? 1 : 0;
        }
    return delays;
}

} // namespace

BenchFigures bench_watch(const BenchOptions& options) {
    BenchFigures figures;
    const BenchScene scene = bench_scene(options);
    const ScratchFolder scratch("overt-watch");
    const RunningSession session(scratch.path(), lay_out_session(scratch.path(), scene.objects.front()));
    to_surface_point(session, options.seconds)
        .report(figures, "from a sample at 2000 Hz to its surface point in another process's view");
    const char* const display = std::getenv("DISPLAY");
    if (display && *display)
        to_window(session, options.seconds, scratch.path() / "times.tsv")
            .report(figures, "from a sample at 2000 Hz to its mark in the operator's window");
    else
        fmt::print(stderr,
                   "bench watch: there is no display, so the window is left out: xvfb-run lends one\n");
    return figures;
}

} // namespace overt
