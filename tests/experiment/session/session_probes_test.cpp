/// Probes that follow their places and gauges that are set there, on ports that do what they are told.
#include <deque>

#include "experiment/design/probe_marks.h"
#include "experiment/session/session_screens.h"
#include "experiment/session/shown_probes.h"
#include "tests/experiment/record/plain_session.h"

using namespace overt;
using namespace overt::test;

namespace {

/// A place that goes 10 px to the right in each frame, and is hidden in odd ones. Its normal leans 30 degrees
/// to the right of the line of sight.
class GoingPlace final : public ProbeView {
  public:
    GoingPlace() {
        middle = {960.0, 540.0};
        px_at_unit_depth = 1000.0;
    }
    SeenProbe seen_in(AnimationFrameIndex frame) const noexcept override {
        SeenProbe seen;
        seen.position = {0.05 * frame.value, 0.0, -5.0};
        seen.normal = frame_of_sight(seen.position) * normal_of({{30.0}, {0.0}});
        seen.is_visible = frame.value % 2 == 0;
        return seen;
    }
};

Protocol probed(const std::string& steps, const std::string& more = {}) {
    return short_protocol(
        "[[points]]\nid = \"seen\"\nevenly = 3\n[[task]]\nid = \"t\"\nquestion = \"Which?\"\nsteps "
        "= [" +
        steps + "]\n[[task.probe]]\nid = \"place\"\npoints = \"seen\"\n" + more +
        "[[block]]\nid = \"b\"\ntasks = \"t\"\nmaterials = \"clay\"\n");
}

const std::string a_lean = "[[task.answer]]\nid = \"lean\"\nkind = \"gauge\"\naccept_key = \"space\"\n"
                           "slant_per_px_deg = 0.5\n";

/// The same inputs in each trial, so long after presses count.
auto doing(std::vector<std::pair<double, ObserverInput>> inputs) {
    return [inputs, done = std::size_t{0},
            trial = -2](ScriptedPanel& panel, SessionTime now) mutable -> std::optional<ObserverInput> {
        if (std::exchange(trial, panel.trial) != panel.trial)
            done = 0;
        if (done >= inputs.size() || !panel.opened ||
            now < *panel.opened + from_seconds(1e-3 * inputs[done].first))
            return std::nullopt;
        ObserverInput input = inputs[done].second;
        input.at = *panel.opened + from_seconds(1e-3 * inputs[done++].first);
        return input;
    };
}

ObserverInput mouse_at(ObserverInput::Kind kind, double right_px, double down_px) {
    ObserverInput input{.kind = kind, .device = ShortName("mouse")};
    input.right_px = right_px;
    input.down_px = down_px;
    input.button = 1;
    return input;
}
ObserverInput key_at(std::string_view key, ObserverInput::Kind kind = ObserverInput::Kind::key_down) {
    ObserverInput input{.kind = kind, .device = ShortName("keyboard")};
    input.key = ShortName(key);
    return input;
}

} // namespace

TEST_CASE("a probe is drawn at its place in each frame, and not where that is hidden", "[unit]") {
    Sitting sitting(probed("{ show = \"centre\", for_s = 0.2 }"));
    std::vector<std::string> asked;
    sitting.probe_of = [&](const PlacedStimulus&, const std::string& point) {
        asked.push_back(point);
        return std::make_shared<GoingPlace>();
    };
    CHECK(sitting.run().completed_trials == 3);
    std::ranges::sort(asked);
    CHECK(asked == std::vector<std::string>{"seen.1", "seen.2", "seen.3"});
    for (const TrialOutcome& outcome : sitting.log.outcomes) {
        REQUIRE(outcome.probes.size() == 1);
        const ShownProbe& probe = outcome.probes.front();
        CHECK(probe.step == 1);
        CHECK(probe.id == "place");
        // 24 refreshes at 120 Hz, four to a frame: frames 0 to 5, of which three show it.
        CHECK(probe.shown_refreshes == 24);
        CHECK(probe.visible_refreshes == 12);
        CHECK(probe.was_visible);
        CHECK(probe.at.x_px == Approx(960.0));
        CHECK(probe.truth.slant.value == Approx(30.0));
        CHECK(probe.truth.tilt.value == Approx(0.0).margin(1e-9));
    }
    // The last flip was of frame 5, in which it is hidden.
    CHECK(sitting.presenter.marks.empty());
}

TEST_CASE("where each eye has its picture, a mark and a gauge stand in each where that eye sees the place",
          "[unit]") {
    Protocol protocol =
        probed("{ show = \"centre\", frame = 4, until = \"answer\" }", "mark = \"dot\"\n" + a_lean);
    for (const bool has_two_pictures : {false, true}) {
        CAPTURE(has_two_pictures);
        protocol.stereo.kind = has_two_pictures ? StereoKind::mirrors : StereoKind::none;
        GoingPlace place;
        place.aside = 0.03;
        place.target_depth = 4.0;
        Sitting sitting(protocol);
        sitting.probe_of = [&](const PlacedStimulus&, const std::string&) {
            return std::make_shared<GoingPlace>(place);
        };
        bool has_both = false;
        sitting.panel.tell = [&](ScriptedPanel&) -> std::optional<ResponsePress> {
            const std::vector<StimulusMark>&own = sitting.presenter.marks,
                  &other = sitting.presenter.others_marks;
            if (own.empty())
                return std::nullopt;
            if (!has_two_pictures) {
                CHECK(other.empty());
                return std::nullopt;
            }
            REQUIRE(own.size() == other.size());
            for (std::size_t i = 0; i < own.size(); ++i) {
                CHECK(own[i].light == other[i].light);
                CHECK(own[i].rim_px == other[i].rim_px);
                for (std::size_t line = 0; line < own[i].count; ++line) {
                    REQUIRE(own[i].lines[line].count == other[i].lines[line].count);
                    // 1000 px at a depth of 1: 2 * 1000 * 0.03 * (1 / 5 - 1 / 4) = -3 px at the place itself.
                    const double apart =
                        other[i].lines[line].points[0].x_px - own[i].lines[line].points[0].x_px;
                    if (own[i].count == 1 || line == 1) {
                        CHECK(apart == Approx(-3.0).margin(1e-9));
                        has_both = has_both || own[i].count == 2;
                    }
                    CHECK(other[i].lines[line].points[0].y_px == own[i].lines[line].points[0].y_px);
                }
            }
            return std::nullopt;
        };
        using Kind = ObserverInput::Kind;
        sitting.panel.does = doing({{100, mouse_at(Kind::pointer_down, 0, 0)},
                                    {120, mouse_at(Kind::pointer_moved, 10, -20)},
                                    {140, mouse_at(Kind::pointer_up, 10, -20)},
                                    {300, key_at("space")}});
        CHECK(sitting.run().completed_trials == 3);
        CHECK(has_both == has_two_pictures);
    }
}

TEST_CASE("a mark stands where its place is, and only in the steps that name it", "[unit]") {
    Sitting sitting(probed("{ show = \"centre\", for_s = 0.1, frame = 4 }, "
                           "{ show = \"centre\", for_s = 0.1, frame = 4, probes = [] }"));
    std::vector<StimulusMark> seen;
    sitting.probe_of = [&](const PlacedStimulus&, const std::string&) {
        return std::make_shared<GoingPlace>();
    };
    // What stands there is looked at in each refresh.
    sitting.panel.tell = [&](ScriptedPanel&) -> std::optional<ResponsePress> {
        if (!sitting.presenter.marks.empty() && sitting.presenter.marks.front().count > 0)
            seen.push_back(sitting.presenter.marks.front());
        return std::nullopt;
    };
    CHECK(sitting.run().completed_trials == 3);
    REQUIRE_FALSE(seen.empty());
    for (const StimulusMark& mark : seen) {
        REQUIRE(mark.lines[0].count == 1); // a dot
        CHECK(mark.lines[0].points[0].x_px == Approx(960.0 + 40.0));
        CHECK(mark.lines[0].points[0].y_px == Approx(540.0));
    }
    for (const TrialOutcome& outcome : sitting.log.outcomes)
        CHECK(outcome.probes.size() == 1);
}

TEST_CASE("a gauge is recorded with its start, what was set, and the surface in the frame that was lit",
          "[unit]") {
    Sitting sitting(probed("{ show = \"centre\", frame = 2, until = \"answer\" }", a_lean));
    sitting.probe_of = [](const PlacedStimulus&, const std::string&) {
        return std::make_shared<GoingPlace>();
    };
    using Kind = ObserverInput::Kind;
    // Accepting before anything is moved does nothing.
    sitting.panel.does = doing({{50, key_at("space")},
                                {60, key_at("space", ObserverInput::Kind::key_up)},
                                {100, mouse_at(Kind::pointer_down, 0, 0)},
                                {120, mouse_at(Kind::pointer_moved, 10, -20)},
                                {140, mouse_at(Kind::pointer_up, 10, -20)},
                                {300, key_at("space")}});
    CHECK(sitting.run().completed_trials == 3);
    std::vector<Attitude> starts;
    for (const TrialOutcome& outcome : sitting.log.outcomes) {
        REQUIRE(outcome.given.size() == 1);
        const GivenAnswer& given = outcome.given.front();
        CHECK_FALSE(given.is_missed);
        REQUIRE(given.gauge);
        const GaugeAnswer& gauge = *given.gauge;
        CHECK(gauge.probe == "place");
        CHECK(gauge.frame == 2);
        CHECK(gauge.is_visible == true);
        REQUIRE(gauge.truth);
        CHECK(gauge.truth->slant.value == Approx(30.0));
        const auto lean_of = [](const Attitude& of) {
            return of.slant.value * glm::dvec2(normal_of({{90.0}, of.tilt}));
        };
        const glm::dvec2 by = lean_of(gauge.set) - lean_of(gauge.start);
        CHECK(by.x == Approx(5.0));
        CHECK(by.y == Approx(10.0));
        CHECK(gauge.deviation()->value == Approx(angle_between(gauge.set, {{30.0}, {0.0}}).value));
        CHECK(gauge.start.slant.value <= 60.0);
        starts.push_back(gauge.start);
        CHECK(outcome.steps.front().ended_by == StepEnd::answer);
        CHECK(given.response_time() == from_seconds(0.3));
    }
    CHECK_FALSE(starts[0] == starts[1]);
    CHECK_FALSE(starts[1] == starts[2]);
}

TEST_CASE("a gauge whose normal is the surface's lies on it, and its rod stands up from it", "[unit]") {
    const GoingPlace view;
    const SeenProbe at = view.seen_in({0});
    const StimulusMark mark = gauge_mark(view, at, at.attitude(), 50.0, 3.0);
    REQUIRE(mark.count == 2);
    REQUIRE(mark.lines[0].count == MarkLine::most_points);
    // Leaned 30 degrees to the right: as high as it is, and narrower by the cosine; nearly so in perspective.
    double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
    for (const ScreenPoint& point : mark.lines[0].points) {
        left = std::min(left, point.x_px);
        right = std::max(right, point.x_px);
        top = std::min(top, point.y_px);
        bottom = std::max(bottom, point.y_px);
    }
    CHECK(bottom - top == Approx(100.0).margin(0.2));
    CHECK(right - left == Approx(100.0 * std::cos(to_radians(Degrees{30.0}).value)).margin(0.3));
    // What leans away is farther and smaller: the circle's middle is not that of its picture.
    CHECK(0.5 * (left + right) < 960.0);
    CHECK(mark.lines[1].points[0].x_px == Approx(960.0));
    CHECK(mark.lines[1].points[1].x_px > 960.0 + 25.0);
    CHECK(mark.lines[1].points[1].y_px == Approx(540.0));
    // Seen from the front the rod points to the eye and its picture is a point.
    const StimulusMark front = gauge_mark(view, at, {{0.0}, {0.0}}, 50.0, 3.0);
    CHECK(front.lines[1].points[1].x_px == Approx(960.0).margin(1e-6));
}

TEST_CASE("the screens of a session are those that its steps show", "[unit]") {
    const auto names = [](const Protocol& protocol) {
        std::vector<std::string> all;
        for (const auto& [name, screen] : screens::all_of(protocol))
            if (name.find("_t") != std::string::npos && !name.starts_with("calibration") &&
                !name.starts_with("drift") && !name.starts_with("operator"))
                all.push_back(name);
        return all;
    };
    // A gauge is set on the stimulus alone: no question comes before, and no screen asks for it.
    CHECK(names(probed("{ show = \"centre\", until = \"answer\" }", a_lean)).empty());
    const Protocol asked = probed(
        "{ text = \"{question}\" }, { text = \"Look\" }, { show = \"centre\", until = \"answer\" }, "
        "{ answer = \"lean\" }, { feedback = { answered = \"Thanks\", missed = \"Late\" }, for_s = 1 }",
        a_lean);
    CHECK(names(asked) == std::vector<std::string>{"text_t_1", "text_t_2", "feedback_t_answered",
                                                   "feedback_t_missed", "answers_t"});
    for (const auto& [name, screen] : screens::all_of(asked)) {
        if (name == "text_t_1")
            CHECK(screen.text == "Which?");
        if (name == "feedback_t_missed")
            CHECK(screen.text == "Late");
    }
}

TEST_CASE("a gauge lies where its probe is, in the attitude that is set, with the probe's light, and not "
          "where that is hidden",
          "[unit]") {
    for (const int frame : {2, 3}) {
        CAPTURE(frame);
        Sitting sitting(
            probed(fmt::format("{{ show = \"centre\", frame = {}, until = \"answer\" }}", frame), a_lean));
        sitting.probe_of = [](const PlacedStimulus&, const std::string&) {
            return std::make_shared<GoingPlace>();
        };
        using Kind = ObserverInput::Kind;
        sitting.panel.does = doing({{100, mouse_at(Kind::pointer_down, 0, 0)},
                                    {120, mouse_at(Kind::pointer_moved, 30, 10)},
                                    {140, mouse_at(Kind::pointer_up, 30, 10)},
                                    {300, key_at("space")}});
        CHECK(sitting.run().completed_trials == 3);
        // Before the first flip the lights are made known, and nothing is drawn.
        REQUIRE_FALSE(sitting.presenter.all_marks.empty());
        REQUIRE(sitting.presenter.all_marks[0].size() == 1);
        CHECK(sitting.presenter.all_marks[0][0].count == 0);
        const GivenAnswer& given = sitting.log.outcomes.back().given.at(0);
        REQUIRE(given.gauge);
        CHECK(given.gauge->frame == frame);
        CHECK(given.gauge->is_visible == (frame == 2));
        const std::vector<StimulusMark>& last = sitting.presenter.marks;
        REQUIRE(last.size() == (frame == 2 ? 2 : 0));
        if (frame == 3)
            continue;
        const GoingPlace view;
        const TaskAnswer& answer = sitting.protocol.tasks.back().answers.at(0);
        const ProbeSettings& probe = sitting.protocol.tasks.back().probes.at(0);
        const double px_per_deg = screen_geometry_of(sitting.protocol).px_per_deg_at_centre();
        const StimulusMark wanted = gauge_mark(view, view.seen_in({frame}), given.gauge->set,
                                               answer.size_deg * px_per_deg, probe.line_deg * px_per_deg);
        REQUIRE(last[1].count == wanted.count);
        for (std::size_t line = 0; line < static_cast<std::size_t>(wanted.count); ++line) {
            REQUIRE(last[1].lines[line].count == wanted.lines[line].count);
            for (std::size_t i = 0; i < static_cast<std::size_t>(wanted.lines[line].count); ++i) {
                CHECK(last[1].lines[line].points[i].x_px == Approx(wanted.lines[line].points[i].x_px));
                CHECK(last[1].lines[line].points[i].y_px == Approx(wanted.lines[line].points[i].y_px));
            }
        }
        CHECK(last[1].light == last[0].light);
        CHECK(last[1].rim_px == last[0].rim_px);
    }
}

TEST_CASE("each of two probes has its row and its mark, and only in the steps that name it", "[unit]") {
    Sitting sitting(
        probed("{ show = \"centre\", for_s = 0.1, frame = 2, probes = [\"place\"] }, "
               "{ show = \"centre\", for_s = 0.1, frame = 4, probes = [\"other\"] }, "
               "{ show = \"centre\", for_s = 0.1, frame = 6 }, { show = \"centre\", for_s = 0.1, frame = 5 }",
               "[[task.probe]]\nid = \"other\"\npoints = \"seen\"\n"));
    sitting.probe_of = [](const PlacedStimulus&, const std::string&) {
        return std::make_shared<GoingPlace>();
    };
    CHECK_FALSE(sitting.run().aborted);
    REQUIRE_FALSE(sitting.log.outcomes.empty());
    for (const TrialOutcome& outcome : sitting.log.outcomes) {
        std::string rows;
        for (const ShownProbe& probe : outcome.probes) {
            rows += fmt::format("{} {} {} {}; ", probe.step, probe.id, probe.shown_refreshes,
                                probe.visible_refreshes);
            if (probe.step < 4)
                CHECK(probe.at.x_px == Approx(960.0 + 20.0 * probe.step));
        }
        CHECK(rows ==
              "1 place 12 12; 2 other 12 12; 3 place 12 12; 3 other 12 12; 4 place 12 0; 4 other 12 0; ");
    }
    // Of the first trial: two lights made known, then a mark in each flip; both in the third show, none in
    // the last.
    std::vector<std::size_t> drawn;
    for (std::size_t i = 0; i < 4 * 13; ++i) {
        const std::vector<StimulusMark>& marks = sitting.presenter.all_marks.at(i);
        drawn.push_back(static_cast<std::size_t>(
            std::ranges::count_if(marks, [](const StimulusMark& mark) { return mark.count > 0; })));
        if (i % 13 == 0)
            CHECK(marks.size() == 2);
    }
    std::vector<std::size_t> wanted;
    for (const std::size_t count : {1u, 1u, 2u, 0u}) {
        wanted.push_back(0);
        wanted.insert(wanted.end(), 12, count);
    }
    CHECK(drawn == wanted);
}

TEST_CASE("screens of answers and of feedback have their words, numbered where a task has several",
          "[unit]") {
    const Protocol protocol = short_protocol(R"([[task]]
id = "t"
question = "Rate it."
steps = [ { show = "centre", for_s = 0.1 }, { answer = "gloss" }, { answer = "sure" },
          { feedback = { answered = "Thanks", correct = "Right", wrong = "Wrong", missed = "Late" }, for_s = 1 } ]
[[task.answer]]
id = "gloss"
kind = "choice"
question = "Glossy?"
choices = ["yes", "no"]
keys = ["f", "j"]
correct = "yes"
[[task.answer]]
id = "sure"
kind = "scale"
steps = 7
[[block]]
id = "b"
tasks = "t"
)");
    std::string all;
    for (const auto& [name, screen] : screens::all_of(protocol))
        if (name.starts_with("answers_t") || name.starts_with("feedback_t")) {
            all += name + ": " + screen.text;
            for (const AnswerItem& item : screen.answers.items)
                all += fmt::format(" [{} {}]", item.question, item.options.size());
            all += "; ";
        }
    CHECK(all == "feedback_t_answered: Thanks; feedback_t_correct: Right; feedback_t_wrong: Wrong; "
                 "feedback_t_missed: Late; answers_t_1:  [Glossy? 2]; answers_t_2: Rate it. [ 7]; ");
}

TEST_CASE("who does not see a gauge is told the surface where it stands, in the first frame too", "[unit]") {
    for (const int frame : {0, 4}) {
        Sitting sitting(
            probed(fmt::format("{{ show = \"centre\", frame = {}, until = \"answer\" }}", frame), a_lean));
        sitting.probe_of = [](const PlacedStimulus&, const std::string&) {
            return std::make_shared<GoingPlace>();
        };
        using Kind = ObserverInput::Kind;
        sitting.panel.does = doing({{100, mouse_at(Kind::pointer_down, 0, 0)},
                                    {120, mouse_at(Kind::pointer_moved, 30, 10)},
                                    {140, mouse_at(Kind::pointer_up, 30, 10)},
                                    {300, key_at("space")}});
        CHECK(sitting.run().completed_trials == 3);
        int gauges = 0;
        for (const std::vector<AnswerOffer>& offers : sitting.panel.offered)
            for (const AnswerOffer& offer : offers)
                if (offer.attitude) {
                    ++gauges;
                    REQUIRE(offer.true_attitude);
                    CHECK(offer.true_attitude->slant.value == Approx(30.0));
                }
        CHECK(gauges >= 3);
    }
}
