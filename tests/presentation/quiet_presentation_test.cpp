/// Between the first and the last flip of a presentation the session's thread asks the system for nothing
/// that may make it wait.
#include <catch2/catch.hpp>

#include <algorithm>
#include <fstream>
#include <memory>
#include <mutex>
#include <stdexcept>

#include "devices/simulated/simulated_keys.h"
#include "devices/simulated/simulated_response_panel.h"
#include "experiment/answers/answer_kinds.h"
#include "experiment/record/read/session_record.h"
#include "experiment/record/session_schema.h"
#include "experiment/session/session.h"
#include "experiment/timing/virtual_refresh.h"
#include "tests/devices/simulated/sitting.h"
#include "tests/experiment/record/session_fixture.h"
#include "tests/support/counted_calls.h"
#include "tests/support/missed_rows.h"

using namespace overt;

namespace {

/// A display without pictures that notes what was called from each presentation's first flip to what is shown
/// after its last.
class NotingPresenter final : public Presenter {
  public:
    explicit NotingPresenter(VirtualRefresh& refresh) : refresh_(&refresh) {}
    std::vector<test::Calls> presentations;
    int flips = 0;

    DisplayTiming timing() const override { return refresh_->timing(); }
    void load_slots(std::span<const PlacedStimulus>) override {}
    FlipReport show(const Screen&) override {
        if (in_presentation_)
            presentations.push_back(test::calls - at_first_flip_);
        in_presentation_ = false;
        return refresh_->next();
    }
    FlipReport flip_slots(std::span<const AnimationFrameIndex>) noexcept override {
        if (!in_presentation_)
            at_first_flip_ = test::calls;
        in_presentation_ = true;
        ++flips;
        return refresh_->next();
    }
    bool closed() const noexcept override { return false; }

  private:
    VirtualRefresh* refresh_;
    bool in_presentation_ = false;
    test::Calls at_first_flip_;
};

DisplayFaults faults_of_all_kinds() {
    DisplayFaults faults;
    faults.jitter_sd_ms = 0.5;
    faults.counts_refreshes = false;
    faults.by_chance.late_share = faults.by_chance.skip_share = faults.by_chance.stall_share = 0.01;
    return faults;
}

/// An area that gaze never comes to.
class Nowhere final : public AreaView {
  public:
    bool is_at(PoseIndex, ScreenPoint) const noexcept override { return false; }
};

/// The steps of a trial that waits for gaze and for a key while it shows.
std::vector<StepSettings> waiting_steps() {
    std::vector<StepSettings> steps(3);
    steps[0].kind = StepKind::fixation;
    steps[0].duration = StepDuration{StepDuration::Law::uniform, {}, 0.2, 0.4, 0.0};
    steps[1].kind = StepKind::show;
    steps[1].slots = {Protocol().slots.front().id};
    steps[1].id = "a_name_that_is_longer_than_a_short_text";
    steps[1].gaze.emplace();
    steps[1].gaze->area = "head";
    steps[1].gaze->patience_s = 8.0;
    steps[2].kind = StepKind::mask;
    steps[2].duration = StepDuration{StepDuration::Law::fixed, {0.1}, 0.0, 0.0, 0.0};
    return steps;
}

/// Three trials of the paper's animation, 960 refreshes each, with everything that a simulated session has.
void run_quietly(const DisplayFaults& faults, const std::vector<StepSettings>& steps = {},
                 void (*change)(Protocol&) = nullptr) {
    const test::TemporaryFolder root;
    const Mesh mesh = test::bust();
    Protocol protocol;
    protocol.tasks = {{"free", "Look."}, {"clothes", "Which clothes?"}};
    for (Task& task : protocol.tasks)
        task.steps = steps;
    protocol.objects.resize(1);
    protocol.materials.resize(1);
    if (change)
        change(protocol);
    VirtualClock clock;
    ObservedScene scene = test::scene_with(mesh);
    scene.animations[0] = protocol.motions.front();
    SimulatedObserver observer(std::move(scene), 31);
    SimulatedEyeTracker tracker(clock, observer, 31);
    const SimulatedAnswers answers(protocol, 31);
    SimulatedResponsePanel panel(clock, observer, {}, &answers);
    VirtualRefresh refresh(clock, 120.0, faults);
    NotingPresenter presenter(refresh);
    Schedule schedule;
    schedule.trials = {{0, 0, {}}, {1, 1, {}}, {2, 0, {}}};
    SessionHeader header = testing::example_header();
    header.animations[0] = protocol.motions.front();
    header.poses = distinct_poses(protocol.motions.front());
    const auto session = testing::make_session(root.path(), header);
    {
        SessionStore store(session / session_file_name, testing::patient());
        SessionPorts ports{clock, presenter, tracker, panel, store, {&observer, &refresh}};
        ports.area_of = [](const PlacedStimulus&, const std::string&) { return std::make_shared<Nowhere>(); };
        const SessionResult result =
            Session(protocol, schedule, observer.scene().screen.centre(), std::move(ports)).run({});
        REQUIRE(result.completed_trials == 3);
        store.close();
    }
    REQUIRE(presenter.presentations.size() == 3);
    for (const test::Calls& calls : presenter.presentations) {
        CHECK(calls.allocations == 0);
        CHECK(calls.locks == 0);
        CHECK(calls.opened_files == 0);
        CHECK(calls.exceptions == 0);
    }
    // All of it was written down nevertheless.
    const SessionRecord record(session);
    for (const TrialRecord& trial : record.trials()) {
        if (change) { // it is a refresh's, and something was moved
            const std::vector<SteeredFlip> moved = record.steered_flips(trial);
            CHECK(moved.size() == record.flips(trial).size());
            CHECK(std::ranges::any_of(moved,
                                      [](const SteeredFlip& flip) { return flip.input_at.has_value(); }));
        }
        std::vector<int> rows(960);
        for (const FlipRecord& flip : record.flips(trial))
            if (flip.refresh_in_trial < 960)
                ++rows[static_cast<std::size_t>(flip.refresh_in_trial)];
        for (const MissedRefresh& missed : test::missed_rows(session, trial.id))
            ++rows.at(static_cast<std::size_t>(missed.refresh_in_trial));
        CHECK(rows == std::vector<int>(960, 1));
        CHECK(record.samples(trial).size() > 15'000);
    }
    CHECK((faults.is_clean() ? presenter.flips == 3 * 960 : presenter.flips < 3 * 960));
}

/// The stimulus is turned by held keys and set along three levels by others, and stays for its time.
void turned_and_set(Protocol& protocol) {
    MotionSettings& motion = protocol.motions.front();
    motion.id = "explore";
    motion.kind = MotionKind::observer;
    motion.by_observer.with = TurnedWith::keys;
    motion.by_observer.keys = {"a", "d"};
    motion.by_observer.step = Degrees{6.0};
    motion.frame_count = motion.by_observer.pose_count();
    protocol.materials.resize(3);
    for (std::size_t i = 0; i < 3; ++i)
        protocol.materials[i].columns = {{"roughness", std::to_string(i), static_cast<double>(i)}};
    for (Task& task : protocol.tasks) {
        TaskAnswer& match = task.answers.emplace_back();
        match.id = "gloss";
        match.kind = kind_called<AnswerKind>("match");
        match.slot = protocol.slots.front().id;
        match.along = {"roughness"};
        match.start.from = MatchStart::From::low;
        match.ends_stimulus = false;
        match.truth.offset = 2.0;
        StepSettings& show = task.steps.emplace_back();
        show.kind = StepKind::show;
        show.slots = {match.slot};
        show.duration = StepDuration{StepDuration::Law::fixed, {8.0}, 0.0, 0.0, 0.0};
        show.ends_by_answer = true;
    }
}

} // namespace

TEST_CASE("nor do they while the observer turns the object and sets its material", "[unit]") {
    run_quietly({}, {}, turned_and_set);
}

TEST_CASE("960 refreshes with tracker, observer and log allocate, lock, open and throw nothing", "[unit]") {
    run_quietly({});
}

TEST_CASE("nor do they in a step that waits for gaze on the moving object, with steps before and after it",
          "[unit]") {
    run_quietly({}, waiting_steps());
}

TEST_CASE("nor do they when pictures come late, refreshes are skipped and the machine stalls", "[unit]") {
    run_quietly(faults_of_all_kinds());
}

#if OVERT_CALLS_ARE_COUNTED
TEST_CASE("each kind of call is counted", "[unit]") {
    const test::Calls before = test::calls;
    auto* volatile numbers = new std::vector<int>(100); // volatile: not to be left out
    delete numbers;
    CHECK(test::calls.allocations - before.allocations >= 4);
    const long locks = test::calls.locks;
    std::mutex mutex;
    mutex.lock();
    mutex.unlock();
    CHECK(test::calls.locks > locks);
    const long opened = test::calls.opened_files;
    std::ifstream("/dev/null").get();
    CHECK(test::calls.opened_files > opened);
    const long thrown = test::calls.exceptions;
    CHECK_THROWS_AS(throw std::runtime_error("counted"), std::runtime_error);
    CHECK(test::calls.exceptions > thrown);
}
#endif
