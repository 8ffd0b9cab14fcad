/// What simulated observers and their trackers do with a seed stays what it is: planned studies and simulated
/// sessions of earlier versions can be made again. Sums over whole trials, to a millionth.
#include <catch2/catch.hpp>

#include <cmath>

#include <fmt/format.h>

#include "devices/simulated/simulated_display.h"
#include "tests/devices/simulated/sitting.h"
#include "tests/support/still_setup_screen.h"

using namespace overt;
using namespace std::chrono_literals;
using test::SimulatedSitting;

namespace {

using Numbers = std::vector<double>;

void check_known(const Numbers& found, const Numbers& known) {
    std::string all;
    for (const double number : found)
        all += fmt::format("{:.9g}, ", number);
    INFO(all);
    CHECK(found.size() == known.size());
    for (std::size_t i = 0; i < std::min(found.size(), known.size()); ++i) {
        CAPTURE(i);
        CHECK(found[i] == Approx(known[i]).epsilon(1e-6).margin(1e-7));
    }
}

/// Sums over samples, each with a weight of its own, so that their order counts.
Numbers sums_of(const std::vector<GazeSample>& samples) {
    double x = 0.0, y = 0.0, pupil = 0.0, lost = 0.0, times = 0.0, left = 0.0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const double weight = 1.0 + 0.001 * static_cast<double>(i);
        const GazeSample& sample = samples[i];
        times +=
            weight * 1e-6 * static_cast<double>((sample.sampled_at - samples.front().sampled_at).count());
        left += sample.eye == Eye::left ? weight : 0.0;
        if (!sample.gaze) {
            lost += weight;
            continue;
        }
        x += weight * sample.gaze->x_px;
        y += weight * sample.gaze->y_px;
        pupil += weight * static_cast<double>(sample.pupil_area);
    }
    return {static_cast<double>(samples.size()), x, y, pupil, lost, times, left};
}

void add(Numbers& to, const Numbers& more) { to.insert(to.end(), more.begin(), more.end()); }

std::vector<GazeSample> polled(EyeTracker& tracker) {
    std::vector<GazeSample> all;
    std::array<TrackerItem, 64> some;
    while (const std::size_t count = tracker.poll(some))
        for (std::size_t i = 0; i < count; ++i)
            all.push_back(std::get<GazeSample>(some[i]));
    return all;
}

/// Two slots beside each other, in which busts turn, rock, or are turned by the observer; effects with areas
/// and spots.
ObservedScene rich_scene(const Mesh& mesh) {
    ObservedScene scene = test::scene_with(mesh);
    scene.screen.image_px = {512, 512};
    for (const int left : {300, 1100}) {
        scene.slots.push_back(scene.screen);
        scene.slots.back().image_origin_px = {left, 284};
    }
    scene.animations.resize(3);
    scene.animations[0].duration_s = 2.0;
    scene.animations[1].duration_s = 1.5;
    scene.animations[1].playback = Playback::ping_pong;
    scene.animations[2].kind = MotionKind::observer;
    scene.animations[2].duration_s = 2.0;
    const View view{fit_camera(mesh, {11.9}, {512, 512}, {25.0}, 0.06), {512, 512}};
    scene.objects = {{&mesh, SceneView{view, mesh.bounds()}}, {nullptr, SceneView{view, mesh.bounds()}}};
    scene.areas = {"head",
                   mesh.part_names.front() == "head" ? mesh.part_names.back() : mesh.part_names.front()};
    scene.tasks = {{"free", {0.4, 0.1}}, {"clothes", {0.15, 0.3}}};
    scene.effects.resize(2);
    scene.effects[0].spot_share = 0.3;
    scene.effects[0].spread = -0.2;
    scene.effects[1].task = 1;
    scene.effects[1].area = 1;
    scene.effects[1].odds = 3.0;
    scene.effects[1].spot_share = 0.1;
    scene.share_sd = 0.4;
    return scene;
}

/// Shows two of them beside each other for a second and a half, with a refresh missed, and asks for the
/// truth.
Numbers truth_of(SimulatedObserver& observer, const Trial& trial, SessionTime onset, int show) {
    observer.presentation_begins(trial, show);
    const double hz = observer.scene().refresh_hz;
    const auto shown_at = [](const Animation& motion, int refresh) {
        return motion.has_plan() ? motion.frame_at_step(refresh / 4) : AnimationFrameIndex{refresh / 7 % 3};
    };
    int refresh = 0;
    for (; refresh < 180; ++refresh) {
        if (refresh == 60)
            continue; // missed
        FlipRecord flip;
        flip.refresh_in_trial = refresh;
        flip.shown = shown_at(observer.scene().animation_of(trial.stimulus.motion), refresh);
        flip.report.vertical_blank = onset + from_seconds(refresh / hz);
        observer.flipped(flip);
        for (std::size_t i = 0; i < trial.beside.size(); ++i)
            observer.slot_flipped(
                {0,
                 refresh,
                 static_cast<int>(i) + 1,
                 {},
                 shown_at(observer.scene().animation_of(trial.beside[i].stimulus.motion), refresh),
                 {}});
    }
    observer.screen_shown({}, onset + from_seconds(refresh / hz));
    Numbers sums(12, 0.0);
    for (int i = -20; i < 600; ++i) {
        const GazeTruth truth = observer.truth_at(onset + i * 3ms);
        const double weight = 1.0 + 0.01 * i;
        sums[0] += weight * truth.gaze.place.x_px;
        sums[1] += weight * truth.gaze.place.y_px;
        sums[2] += weight * static_cast<double>(truth.gaze.state);
        sums[3] += truth.frame ? weight * (truth.frame->value + 2) : 0.0;
        sums[4] += truth.shown ? weight * static_cast<double>(*truth.shown + 1) : 0.0;
        sums[5] += truth.slot ? weight * (*truth.slot + 1) : 0.0;
        for (const auto& [at, point] : {std::pair{6, truth.target}, {9, truth.surface}})
            if (point)
                for (int axis = 0; axis < 3; ++axis)
                    sums[static_cast<std::size_t>(at + axis)] += weight * point->position[axis];
    }
    return sums;
}

} // namespace

TEST_CASE("a simulated observer and tracker give with a seed what they gave before", "[unit]") {
    SimulatedSitting sitting(5);
    SimulatedTrackerSettings settings;
    settings.rate_hz = 500.0;
    settings.both_eyes = true;
    SimulatedEyeTracker tracker(sitting.clock, sitting.observer, 11, settings);
    Numbers found{1e-9 * static_cast<double>(tracker.tracker_time_at({}).time_since_epoch().count()),
                  tracker.offset_deg().x, tracker.offset_deg().y};
    test::StillSetupScreen screen;
    const SetupOutcome set_up = tracker.set_up(screen);
    add(found, {set_up.validation->mean_error.value, set_up.validation->max_error.value,
                set_up.validation->targets[5].target.x_px, set_up.validation->targets[5].gaze->y_px});
    add(found, {tracker.drift_check({960.0, 540.0}).error.value, to_seconds(sitting.clock.now())});
    const auto pair = tracker.read_clocks();
    add(found, {1e3 * to_seconds(pair->after - pair->before),
                static_cast<double>((pair->other - tracker.tracker_time_at(pair->before)).count())});
    for (const int task : {0, 1}) {
        tracker.start_recording();
        sitting.present({task, task, {}});
        tracker.stop_recording();
        add(found, sums_of(polled(tracker)));
    }
    check_known(found,
                {2.87166557,  0.407998697, -0.619621822, 0.330296118, 0.58487161, 1728,       560.081001,
                 0.197039742, 0.1,         0.137284,     39,          10402,      62136735.8, 30083218.4,
                 69415544.5,  1653.267,    429180.279,   32246.2,     10400,      59240206.9, 33015469.9,
                 70606165.3,  1861.739,    428943.148,   32234.8});
}

TEST_CASE("a simulated tracker that is not calibrated gives with a seed what it gave before", "[unit]") {
    SimulatedSitting sitting(6);
    SimulatedTrackerSettings settings;
    settings.uncalibrated = true;
    settings.eye = Eye::left;
    settings.rate_hz = 250.0;
    SimulatedEyeTracker tracker(sitting.clock, sitting.observer, 12, settings);
    tracker.start_recording();
    sitting.present({3, 0, {}}, {5, 6, 90});
    tracker.stop_recording();
    check_known(sums_of(polled(tracker)),
                {2600, 5947843.2, 3082739.39, 6505410.26, 117.742, 36935.9484, 5978.7});
}

TEST_CASE("what a simulated observer sees of two slots stays what it was", "[unit]") {
    const Mesh mesh = test::bust();
    SimulatedObserver observer(rich_scene(mesh), 7);
    observer.let_answers_guide([](const Trial& trial) {
        return trial.index == 1 ? GazeFavour{1, 0.8, 0, 2.0} : GazeFavour{};
    });
    Trial trial;
    trial.stimulus = {0, 0, 0, 0};
    trial.beside = {{{0, 0, 0, 1}, 1}};
    check_known(truth_of(observer, trial, SessionTime(10s), 0),
                {3158665.2, 1626582.57, 201, 51603.27, 3372.46, 3372.46, 22317.621, -81149.4264, 74730.4228,
                 41447.6218, -70013.8526, 72082.7958});
    check_known(truth_of(observer, trial, SessionTime(14s), 1),
                {2184590.23, 1483466.11, 272.28, 51626.26, 2575.28, 2575.28, -16387.9297, -88732.339,
                 161849.494, 6330.52524, -79131.105, 165004.099});
    trial.index = 1;
    trial.task = 1;
    trial.stimulus.motion = 2;
    check_known(truth_of(observer, trial, SessionTime(20s), 0),
                {2247625.79, 1322161.43, 253.26, 26921.27, 2485.66, 2485.66, 23527.8392, -82969.3589,
                 249189.963, 6206.9539, -73967.1769, 236001.91});
    trial.index = 2;
    trial.stimulus = {1, 0, 0, 1}; // of which only pictures exist
    trial.beside[0].stimulus.motion = 2;
    check_known(truth_of(observer, trial, SessionTime(30s), 0),
                {1867458.57, 1432023.5, 701.87, 47539.01, 1689.95, 1689.95, 1839.94536, -11759.85, 30739.6136,
                 229.738165, -10771.65, 25249.3944});
}

TEST_CASE("a simulated display and photometer give with a seed what they gave before", "[unit]") {
    const DisplayTruth truth = DisplayTruth::drawn(3);
    Numbers found;
    for (const double level : {0.0, 0.25, 0.5, 1.0})
        for (const glm::dvec3& signal : {glm::dvec3(level, 0.5 * level, 1.0 - level), glm::dvec3(level)}) {
            const glm::dvec3 xyz = truth.xyz_of(signal);
            add(found, {xyz.x + 2.0 * xyz.y + 3.0 * xyz.z});
        }
    SimulatedPhotometer photometer(truth, 4);
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3 xyz = photometer.measure_xyz(glm::dvec3(0.3));
        add(found, {xyz.x, xyz.y, xyz.z});
    }
    check_known(found, {298.123201, 0.903682223, 155.558663, 27.0434448, 88.5446247, 125.643126, 147.679214,
                        583.227945, 7.24798646, 8.08837275, 5.64248203, 7.23869875, 8.10208419, 5.63331944,
                        7.23672358, 8.10023094, 5.63460874});
}

TEST_CASE("a display's light is that of its curves, less what channels take from each other", "[unit]") {
    DisplayTruth truth;
    truth.black_xyz = {1.0, 2.0, 3.0};
    truth.primaries_xyz = {glm::dvec3(40.0, 20.0, 2.0), glm::dvec3(30.0, 70.0, 10.0),
                           glm::dvec3(20.0, 8.0, 90.0)};
    truth.exponents = {2.0, 2.5, 3.0};
    truth.offsets = {0.3, -0.2, 0.25};
    truth.shoulders = {0.4, -0.3, 0.2};
    truth.crosstalk = 0.3;
    const auto lit = [&](std::size_t i, double s) {
        const auto curve = [&](double at) {
            return std::pow(std::max(0.0, truth.offsets[i] + at - truth.offsets[i] * at), truth.exponents[i]);
        };
        return (curve(s) - curve(0.0)) / (1.0 - curve(0.0)) * (1.0 + truth.shoulders[i] * (s - s * s));
    };
    for (const glm::dvec3& signal : {glm::dvec3(0.0), glm::dvec3(1.0), glm::dvec3(0.9, 0.5, 0.7),
                                     glm::dvec3(0.4, 0.8, 0.0), glm::dvec3(0.1, 0.0, 0.6)}) {
        const double r = lit(0, signal.x), g = lit(1, signal.y), b = lit(2, signal.z);
        const glm::dvec3 known = truth.black_xyz + r * (1.0 - 0.15 * (g + b)) * truth.primaries_xyz[0] +
                                 g * (1.0 - 0.15 * (r + b)) * truth.primaries_xyz[1] +
                                 b * (1.0 - 0.15 * (r + g)) * truth.primaries_xyz[2];
        const glm::dvec3 found = truth.xyz_of(signal);
        for (int axis = 0; axis < 3; ++axis)
            CHECK(found[axis] == Approx(known[axis]).epsilon(1e-9));
    }
    CHECK(truth.xyz_of({-1.0, 2.0, 0.0}) == truth.xyz_of({0.0, 1.0, 0.0}));
    truth.reading_noise = 0.0;
    truth.dark_noise_cd_m2 = 0.0;
    CHECK(SimulatedPhotometer(truth, 1).measure_xyz({0.5, 0.5, 0.5}) == truth.xyz_of({0.5, 0.5, 0.5}));
}

TEST_CASE("each target of a validation is missed as it was before", "[unit]") {
    SimulatedSitting sitting(5);
    SimulatedEyeTracker tracker(sitting.clock, sitting.observer, 11);
    test::StillSetupScreen screen;
    Numbers found;
    const SetupOutcome set_up = tracker.set_up(screen);
    REQUIRE(set_up.validation);
    for (const ValidatedTarget& target : set_up.validation->targets)
        add(found, {target.gaze->x_px - target.target.x_px, target.gaze->y_px - target.target.y_px});
    check_known(found, {-10.2949124, 4.24911468, -40.4252919, 27.8910966, 29.3351007, -5.39373012, -1.2669629,
                        8.16669393, -9.89802093, -3.22020246, 26.7962589, 20.0810008, -9.41947683,
                        -31.0027712, 6.80030013, 29.124262, 44.3523053, 8.03781825});
}
