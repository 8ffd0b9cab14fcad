#include "experiment/checks/design_report.h"

#include <cmath>
#include <numbers>
#include <sstream>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "experiment/design/schedule.h"
#include "tests/experiment/protocol/protocol_fixtures.h"

using namespace overt;
using namespace overt::test;
using Catch::Contains;

TEST_CASE("the paper's design is 54 maps, and 30 trials of 240 frames and 960 refreshes", "[unit]") {
    const DesignReport report = make_design_report(paper_protocol(), {});
    CHECK(report.incidence.size() == 54);
    CHECK(report.trials_per_observer == 30);
    CHECK(report.motions[0].frames == 61);
    CHECK(report.motions[0].distinct_poses == 31);
    CHECK(report.motions[0].shown_frames == 240);
    CHECK(report.motions[0].refreshes_per_frame == 4);
    CHECK(report.motions[0].refreshes == 960);
    CHECK(report.motions[0].duration_s == 8.0);
    CHECK(report.motions[0].periods == 4.0);
    CHECK(report.warnings.empty());
}

TEST_CASE("visual angles are those of the screen's trigonometry", "[unit]") {
    const DesignReport report = make_design_report(paper_protocol(), {});
    const auto deg = [](double size_mm) {
        return 2.0 * std::atan(size_mm / 2.0 / 1750.0) * 180.0 / std::numbers::pi;
    };
    CHECK(report.angles.screen_width_deg == Approx(deg(698.4)));
    CHECK(report.angles.screen_height_deg == Approx(deg(392.9)));
    CHECK(report.angles.image_width_deg == Approx(deg(698.4 * 1024 / 1920)));
    CHECK(report.angles.image_height_deg == Approx(deg(392.9 * 1024 / 1080)));
    CHECK(report.angles.camera_fov_deg == report.angles.image_height_deg);
    CHECK(report.angles.px_per_deg == Approx(1920 / 698.4 * 1750.0 * std::tan(std::numbers::pi / 180.0)));
}

TEST_CASE("the visual angles of a stimulus are those of the place where it is shown", "[unit]") {
    Protocol protocol = paper_protocol();
    protocol.views.front().centre_right_deg = 8.0;
    protocol.views.front().centre_up_deg = -4.0;
    protocol.views.front().width_px = protocol.views.front().height_px = 200;
    const VisualAngles angles = make_design_report(protocol, {}).angles;
    const glm::dvec2 mm_per_px(698.4 / 1920, 392.9 / 1080);
    CHECK(angles.image_right_deg == Approx(8.0).margin(0.02)); // to the pixel
    CHECK(angles.image_up_deg == Approx(-4.0).margin(0.02));
    // The directions from the eye to the ends of the middle row and column.
    const double x = 1750.0 * std::tan(angles.image_right_deg * std::numbers::pi / 180.0),
                 y = 1750.0 * std::tan(angles.image_up_deg * std::numbers::pi / 180.0);
    const auto between = [](glm::dvec3 a, glm::dvec3 b) {
        return std::acos(glm::dot(glm::normalize(a), glm::normalize(b))) * 180.0 / std::numbers::pi;
    };
    const glm::dvec2 half_mm = 100.0 * mm_per_px;
    CHECK(angles.image_width_deg ==
          Approx(between({x - half_mm.x, y, 1750.0}, {x + half_mm.x, y, 1750.0})).epsilon(1e-7));
    CHECK(angles.image_height_deg ==
          Approx(between({x, y - half_mm.y, 1750.0}, {x, y + half_mm.y, 1750.0})).epsilon(1e-7));
    CHECK(angles.camera_fov_deg > 1.005 * angles.image_height_deg);
}

TEST_CASE("a session is as long as its parts, each as the protocol and the assumptions have it", "[unit]") {
    Protocol protocol = paper_protocol();
    DesignAssumptions assumptions{.calibration_s = 100.0, .question_s = 0.5, .answer_s = 90.0};
    const SessionLength session = make_design_report(protocol, {}, 1, assumptions).session;
    CHECK(session.questions_s == Approx(30 * 1.0)); // at least task_min_s
    CHECK(session.drift_checks_s == Approx(30 * 1.0));
    CHECK(session.animations_s == Approx(30 * (8.0 + 2 * 0.1)));
    CHECK(session.answers_s == Approx(30 * 60.0)); // at most response_max_s
    CHECK(session.total_s() == Approx(100.0 + 30.0 + 30.0 + 246.0 + 1800.0));
}

TEST_CASE("trials by steps are as long as their steps", "[unit]") {
    Protocol protocol = paper_protocol();
    const auto step = [](StepKind kind, std::optional<double> for_s) {
        StepSettings settings;
        settings.kind = kind;
        settings.slots = {"centre"};
        if (for_s)
            settings.duration = StepDuration{StepDuration::Law::fixed, {*for_s}, 0.0, 0.0, 0.0};
        return settings;
    };
    for (Task& task : protocol.tasks)
        task.steps = {step(StepKind::fixation, 0.5), step(StepKind::show, 1.0),
                      step(StepKind::blank, 0.25),   step(StepKind::show, 2.0),
                      step(StepKind::answer, 3.0),   step(StepKind::feedback, 0.5)};
    DesignAssumptions assumptions{.calibration_s = 100.0, .question_s = 0.5, .answer_s = 90.0};
    const SessionLength session = make_design_report(protocol, {}, 1, assumptions).session;
    CHECK(session.questions_s == 0.0);
    CHECK(session.drift_checks_s == 0.0);
    CHECK(session.animations_s == Approx(30 * (0.5 + 1.0 + 0.25 + 2.0 + 0.5 + 2 * 0.1)));
    CHECK(session.answers_s == Approx(30 * 3.0));
}

TEST_CASE("consent and each page of instructions are read in the session's length", "[unit]") {
    Protocol protocol = paper_protocol();
    DesignAssumptions assumptions;
    assumptions.text_s = 15.0;
    const SessionLength before = make_design_report(protocol, {}, 1, assumptions).session;
    protocol.consent.text = "May we?";
    protocol.instructions.pages = {"Look.", "Answer."};
    const SessionLength with_texts = make_design_report(protocol, {}, 1, assumptions).session;
    CHECK(with_texts.instructions_s == Approx(before.instructions_s + 45.0));
    CHECK(with_texts.total_s() == Approx(before.total_s() + 45.0));
}

TEST_CASE("frames and maps need a page for each distinct pose", "[unit]") {
    const DesignReport report = make_design_report(paper_protocol(), {});
    CHECK(report.memory.pages_per_stimulus_bytes == 31.0 * 1024 * 1024 * 4);
    CHECK(report.memory.maps_per_object_bytes == 31.0 * 1024 * 1024 * 4);
    CHECK(report.memory.pages_at_once_bytes() == 2 * 31.0 * 1024 * 1024 * 4);
}

TEST_CASE("ready-made frames need a page each, and a small frame store holds one stimulus at a time",
          "[unit]") {
    Protocol protocol = paper_protocol();
    protocol.frames.emplace_back();
    protocol.frames.back().object = protocol.objects[1].id;
    protocol.frames.back().material = protocol.materials[2].id;
    protocol.display.frame_store_mb = 500;
    const DesignReport report = make_design_report(protocol, {});
    CHECK(report.memory.pages_per_stimulus_bytes == 61.0 * 1024 * 1024 * 4);
    CHECK_FALSE(report.memory.next_fits);
    CHECK(report.memory.pages_at_once_bytes() == 61.0 * 1024 * 1024 * 4);
    CHECK_THAT(to_text(report), Contains("256 MB of frames for a stimulus; those of the next do not fit"));
}

TEST_CASE("a self-paced break lasts as long as no key may end it", "[unit]") {
    Protocol protocol = paper_protocol();
    protocol.breaks.every_trials = 10;
    protocol.breaks.pace = BreakPace::self;
    protocol.breaks.duration_s = 30.0;
    protocol.breaks.min_s = 50.0;
    CHECK(make_design_report(protocol, {}).session.breaks_s == Approx(2 * 50.0));
    protocol.breaks.pace = BreakPace::timed;
    CHECK(make_design_report(protocol, {}).session.breaks_s == Approx(2 * 30.0));
}

TEST_CASE("a frame rate that the display only comes near to is said as it is shown", "[unit]") {
    Protocol protocol = paper_protocol();
    protocol.display.refresh_hz = 119.88;
    CHECK_THAT(to_text(make_design_report(protocol, {})), Contains("240 frames at 29.97 Hz = 8.008 s"));
    protocol.display.refresh_hz = 59.94;
    const std::string text = to_text(make_design_report(protocol, {}));
    CHECK_THAT(text, Contains("240 frames at 29.97 Hz = 8.008 s"));
    CHECK_THAT(text,
               Contains("2 refreshes at 59.94 Hz: 480 refreshes (0.1 % slower than the protocol's 30 Hz)"));
    protocol.display.refresh_hz = 60.0;
    CHECK_THAT(to_text(make_design_report(protocol, {})), Contains("2 refreshes at 60 Hz: 480 refreshes\n"));
}

TEST_CASE("weights and groups that show some stimuli more often are no imbalance, lost rotations are",
          "[unit]") {
    Protocol protocol = paper_protocol();
    BlockSettings block;
    block.id = "weighted";
    block.order = OrderMethod::weighted;
    block.by = "material";
    block.weights = {2.0, 1.0, 1.0};
    protocol.blocks = {block};
    CHECK(make_design_report(protocol, {}).warnings.empty());

    protocol.blocks.clear();
    GroupSettings gold, coating;
    gold.id = "gold";
    gold.chosen[1] = {protocol.materials[0].id, protocol.materials[1].id};
    coating.id = "coating";
    coating.chosen[1] = {protocol.materials[2].id};
    coating.cap = 2;
    protocol.groups = {gold, coating};
    protocol.schedule.observers = 12;
    CHECK(make_design_report(protocol, {}).warnings.empty());

    protocol.schedule.observers = 11; // nine of gold, whose two materials go round
    const DesignReport report = make_design_report(protocol, {});
    REQUIRE(report.warnings.size() == 4);
    CHECK_THAT(report.warnings[0],
               Contains("some stimuli are shown 4 times and others 5 times to group \"gold\""));
}

TEST_CASE("the incidence table adds up to all trials of all observers", "[unit]") {
    for (int observers = 1; observers <= 13; ++observers) {
        Protocol protocol = paper_protocol();
        protocol.schedule.observers = observers;
        const DesignReport report = make_design_report(protocol, {});
        int presentations = 0;
        for (const IncidenceCell& cell : report.incidence)
            presentations += cell.presentations;
        CHECK(presentations == 30 * observers);
        // Four tasks rotate their materials.
        CHECK(report.warnings.size() == (observers % 3 == 0 ? 0 : 4));
    }
}

TEST_CASE("the orders shown are those of the sessions with the same seed", "[unit]") {
    Protocol protocol = paper_protocol();
    const std::vector<Observer> observers = planned_observers(protocol);
    REQUIRE(observers.size() == 12);
    CHECK(observers.front().label == "01");
    CHECK(observers.back().number == 12);
    const DesignReport example = make_design_report(protocol, observers, 5);
    CHECK_FALSE(example.is_seed_fixed);
    CHECK(example.schedules[6].trials == make_schedule(protocol, {"P07", 7}, 5).trials);
    protocol.schedule.seed = 77;
    const DesignReport fixed = make_design_report(protocol, {{"P07", 7}}, 5);
    CHECK(fixed.is_seed_fixed);
    CHECK(fixed.schedules[0].trials == make_schedule(protocol, {"P07", 7}, 77).trials);
}

TEST_CASE("the report reads in sentences, tables and codes", "[unit]") {
    const Protocol protocol = paper_protocol();
    const std::string one = to_text(make_design_report(protocol, {{"P01", 1}}));
    CHECK_THAT(one, Contains("3 objects x 3 materials = 9 stimuli; 6 tasks: 54 maps"));
    CHECK_THAT(one, Contains("240 frames at 30 Hz = 8.000 s = 4 swings"));
    CHECK_THAT(one, Contains("lit for 4 refreshes at 120 Hz: 960 refreshes"));
    CHECK_THAT(one, Contains("61 frames (cycle), 31 distinct poses"));
    CHECK_THAT(one, Contains("Order of trials for observer P01"));
    const std::string all = to_text(make_design_report(protocol, planned_observers(protocol)));
    CHECK_THAT(all, Contains("task: 1 free, 2 material, 3 age"));
    CHECK_THAT(all, Contains("12: "));
    std::istringstream lines(one + all);
    for (std::string line; std::getline(lines, line);) {
        CAPTURE(line);
        CHECK(line.size() <= 110);
        CHECK((line.empty() || line.back() != ' '));
    }
}

TEST_CASE("the JSON form of the report holds every cell and every trial", "[unit]") {
    const Protocol protocol = paper_protocol();
    const auto json = to_json(make_design_report(protocol, planned_observers(protocol)));
    CHECK(json["incidence"].size() == 54);
    CHECK(json["orders"].size() == 12);
    CHECK(json["orders"][3]["trials"].size() == 30);
    CHECK(json["animation"]["refreshes"] == 960);
    CHECK(json["tasks"][5] == "pose");
}
