/// Matches and turned objects in whole trials, on ports that do what they are told.
#include <deque>

#include "experiment/design/match_levels.h"
#include "experiment/protocol/all_stimuli.h"
#include "tests/experiment/record/plain_session.h"

using namespace overt;
using namespace overt::test;

namespace {

/// What was flipped of all that was loaded, and what of it the observer had moved.
class MovesLog final : public SessionLog {
  public:
    void flip(const FlipRecord& flip) noexcept override { flips.push_back(flip); }
    void slot_flip(const SlotFlip& flip) noexcept override { further.push_back(flip); }
    void steered_flip(const SteeredFlip& flip) noexcept override { moved.push_back(flip); }
    void missed(const MissedRefresh&) noexcept override {}
    void sample(int, const GazeSample&) noexcept override {}
    void clock_pair(const ClockPair&) noexcept override {}
    void event(const SessionEvent&) override {}
    void trial_started(const Trial& trial, SessionTime) override { trials.push_back(trial); }
    void trial_finished(const Trial&, const TrialOutcome& outcome) override { outcomes.push_back(outcome); }

    std::vector<FlipRecord> flips;
    std::vector<SlotFlip> further;
    std::vector<SteeredFlip> moved;
    std::vector<Trial> trials;
    std::vector<TrialOutcome> outcomes;
};

/// Keys so many seconds after inputs are first told in a trial, or after the window opened.
struct DueKey {
    double s;
    std::string_view key;
    ObserverInput::Kind kind = ObserverInput::Kind::key_down;
};

auto doing_keys(std::vector<DueKey> keys) {
    return [keys, done = std::size_t{0}, trial = -2, since = SessionTime()](
               ScriptedPanel& panel, SessionTime now) mutable -> std::optional<ObserverInput> {
        if (panel.phase() != SessionPhase::stimulus)
            return std::nullopt;
        if (std::exchange(trial, panel.trial) != panel.trial) {
            done = 0;
            since = now;
        }
        if (done >= keys.size() || now < since + from_seconds(keys[done].s))
            return std::nullopt;
        ObserverInput input{.kind = keys[done].kind, .at = since + from_seconds(keys[done].s)};
        input.key = ShortName(keys[done++].key);
        return input;
    };
}

MovesLog run_moves(std::string_view text, std::vector<DueKey> keys, Protocol* read_as = nullptr) {
    const ReadText read(text);
    INFO(read.diagnostics.print());
    REQUIRE(read.protocol);
    if (read_as)
        *read_as = *read.protocol;
    Sitting sitting(*read.protocol);
    sitting.panel.does = doing_keys(std::move(keys));
    MovesLog log;
    const Schedule schedule = make_schedule(sitting.protocol, {"P", 1}, 1);
    Session(sitting.protocol, schedule, {960.0, 540.0},
            {.clock = sitting.clock,
             .presenter = sitting.presenter,
             .tracker = sitting.tracker,
             .panel = sitting.panel,
             .log = log,
             .listeners = {},
             .observer = "P1",
             .can_type = true,
             .recorder = nullptr,
             .has_proven_times = true},
            {})
        .run({});
    return log;
}

constexpr std::string_view matching_text = R"([protocol]
name = "match"
[animation]
kind = "still"
duration_s = 1
[[slot]]
id = "test"
right_deg = -8
size_deg = 6
[[slot]]
id = "reference"
right_deg = 8
size_deg = 6
[[object]]
id = "a"
shipped = "muse"
[[material]]
id = "gold"
kind = "rough-conductor"
series = { roughness = [0.1, 0.2, 0.4, 0.8] }
[[task]]
id = "t"
question = "Match."
slots = ["test", "reference"]
trials = { rule = "every", of = "material", in = "test" }
steps = [ { show = ["test", "reference"], until = "answer" } ]
[[task.answer]]
id = "gloss"
kind = "match"
slot = "reference"
along = "roughness"
start = 0.2
)";

} // namespace

TEST_CASE("a match shows the level that is set, refresh by refresh, until it is accepted", "[unit]") {
    Protocol protocol;
    const MovesLog log = run_moves(
        matching_text,
        {{0.5, "right"}, {0.6, "right", ObserverInput::Kind::key_up}, {0.8, "left"}, {1.0, "enter"}},
        &protocol);
    REQUIRE(log.outcomes.size() == 4);
    for (std::size_t i = 0; i < log.outcomes.size(); ++i) {
        const TrialOutcome& outcome = log.outcomes[i];
        REQUIRE(outcome.given.size() == 1);
        const GivenAnswer& given = outcome.given.front();
        CHECK(given.number == 0.2);
        CHECK_FALSE(given.is_missed);
        REQUIRE(given.settings.size() == 1);
        CHECK(given.settings.front().start == 0.2);
        CHECK(given.settings.front().final == 0.2);
        CHECK(given.settings.front().changes == 2);
        CHECK(given.settings.front().reversals == 1);
        const Trial& trial = log.trials[i];
        const std::string& id = protocol.material_of(trial.stimulus).id;
        CHECK(given.settings.front().reference ==
              protocol.material_of(trial.stimulus).columns.front().number);
        CAPTURE(id);
        CHECK(outcome.steps.front().ended_by == StepEnd::answer);
        // The picture that the press is in is lit at the second refresh after it at the latest.
        std::vector<SteeredFlip> own;
        std::vector<SessionTime> lit;
        for (std::size_t k = 0; k < log.flips.size(); ++k)
            if (log.flips[k].trial == trial.index) {
                own.push_back(log.moved[k]);
                lit.push_back(log.flips[k].report.vertical_blank);
                CHECK(log.moved[k].refresh_in_trial == log.flips[k].refresh_in_trial);
                CHECK(log.moved[k].trial == trial.index);
                CHECK(log.moved[k].place == 1);
            }
        REQUIRE(own.size() > 100);
        CHECK(own.front().level == 1);
        CHECK_FALSE(own.front().input_at);
        int rises = 0, falls = 0;
        for (std::size_t k = 1; k < own.size(); ++k) {
            rises += own[k].level > own[k - 1].level;
            falls += own[k].level < own[k - 1].level;
            if (own[k].level == own[k - 1].level)
                continue;
            REQUIRE(own[k].input_at);
            const double delay_s = to_seconds(lit[k] - *own[k].input_at);
            CHECK(delay_s >= 0.0);
            CHECK(delay_s <= 2.01 / 120.0);
        }
        CHECK(rises == 1);
        CHECK(falls == 1);
    }
    CHECK(log.moved.size() == log.flips.size());
}

TEST_CASE("what the observer turns stands in the ledger as it was turned, without an answer, too", "[unit]") {
    Protocol protocol;
    const MovesLog log = run_moves(R"([protocol]
name = "explore"
[[motion]]
id = "explore"
kind = "observer"
with = "keys"
step_deg = 3
from_deg = -30
to_deg = 30
angle_deg = -12
speed_deg_s = 60
duration_s = 1
[[object]]
id = "a"
shipped = "muse"
[[material]]
id = "gold"
kind = "smooth-conductor"
[[task]]
id = "t"
question = "Explore."
steps = [ { show = "centre", for_s = 1 } ]
)",
                                   {{0.2, "right"}, {0.5, "right", ObserverInput::Kind::key_up}}, &protocol);
    REQUIRE(log.outcomes.size() == 1);
    REQUIRE(log.flips.size() == 120);
    REQUIRE(log.moved.size() == 120);
    const PoseTable poses = poses_of(protocol);
    CHECK(poses.count() == 21);
    CHECK(log.flips.front().shown.value == 6);
    CHECK_FALSE(log.moved.front().input_at);
    CHECK(log.flips.back().shown.value == 12); // 0.3 s at 60 deg/s from -12 deg
    REQUIRE(log.outcomes.front().inputs.size() == 2);
    const SessionTime pressed = log.outcomes.front().inputs.front().input.at;
    for (std::size_t i = 0; i < log.flips.size(); ++i) {
        CHECK(poses.object_of(log.flips[i].pose).angle.value ==
              Approx(-30.0 + 3.0 * log.flips[i].shown.value));
        CHECK(log.flips[i].planned == log.flips[i].shown);
        CHECK(log.moved[i].level == -1);
    }
    // Of the picture of each refresh: where the key had turned it when it was drawn, one refresh before.
    for (std::size_t i = 30; i < 55; ++i) {
        const double turned_s = to_seconds(log.flips[i - 1].report.vertical_blank - pressed);
        const double wanted = -12.0 + 60.0 * std::clamp(turned_s, 0.0, 0.3);
        CHECK(std::abs(-30.0 + 3.0 * log.flips[i].shown.value - wanted) <= 1.5 + 1e-6);
    }
    const std::vector<AnswerInput>& inputs = log.outcomes.front().inputs;
    REQUIRE(inputs.size() == 2);
    CHECK(inputs.front().id == "explore");
    CHECK(inputs.front().item == "centre");
    CHECK(log.outcomes.front().given.empty());
}

TEST_CASE("what was recorded stands at each refresh as it was turned, in each show of a trial", "[unit]") {
    constexpr std::string_view text = R"([protocol]
name = "again"
[[motion]]
id = "again"
kind = "recorded"
recorded = ["way.tsv"]
[[object]]
id = "a"
shipped = "muse"
[[material]]
id = "gold"
kind = "smooth-conductor"
[[task]]
id = "t"
question = "Look."
steps = [ { show = "centre", for_s = 0.5 }, { blank = 0.1 }, { show = "centre", frame = 1, for_s = 0.1 }, { show = "centre", for_s = 0.25 } ]
)";
    // At 0.1 s it goes on to 4 deg, at 0.3 s back; the second show begins at 8 deg, and ends after 0.125 s.
    constexpr std::string_view table = "observer\tsession\ttrial\tslot\tt_s\tangle_deg\n"
                                       "P7\t1\t1\tcentre\t0.000000\t0\n"
                                       "P7\t1\t1\tcentre\t0.100000\t4\n"
                                       "P7\t1\t1\tcentre\t0.300000\t-2\n"
                                       "P7\t1\t1\tcentre\t0.500000\t-2\n"
                                       "P7\t1\t1\tcentre\t0.000000\t8\n"
                                       "P7\t1\t1\tcentre\t0.125000\t0\n"
                                       "P7\t1\t1\tcentre\t0.133333\t0\n";
    Diagnostics diagnostics;
    const std::optional<Protocol> protocol =
        read_protocol_text(text, "p.toml", shipped_names, diagnostics, {{"way.tsv", std::string(table)}});
    INFO(diagnostics.print());
    REQUIRE(protocol);
    Sitting sitting(*protocol);
    MovesLog log;
    const Schedule schedule = make_schedule(sitting.protocol, {"P", 1}, 1);
    Session(sitting.protocol, schedule, {960.0, 540.0},
            {.clock = sitting.clock,
             .presenter = sitting.presenter,
             .tracker = sitting.tracker,
             .panel = sitting.panel,
             .log = log,
             .listeners = {},
             .observer = "P1",
             .can_type = true,
             .recorder = nullptr,
             .has_proven_times = true},
            {})
        .run({});
    REQUIRE(log.trials.size() == 1);
    CHECK(own_level(log.trials.front(), "yoked_to") == "P7 session 1 trial 1");
    REQUIRE(log.flips.size() == 60 + 12 + 30);
    CHECK(log.moved.empty()); // nobody moves it now
    const PoseTable poses = poses_of(*protocol);
    for (std::size_t i = 0; i < log.flips.size(); ++i) {
        CAPTURE(i);
        const double angle_deg = poses.object_of(log.flips[i].pose).angle.value;
        CHECK(log.flips[i].planned == log.flips[i].shown);
        CHECK(angle_deg == (i < 12   ? 0.0
                            : i < 36 ? 4.0
                            : i < 60 ? -2.0
                            : i < 72 ? 4.0 // the frame that the protocol names
                            : i < 87 ? 8.0
                                     : 0.0)); // and in its last pose on
    }
}

TEST_CASE("objects in two slots are turned together, and who does not see them is told how", "[unit]") {
    constexpr std::string_view text = R"([protocol]
name = "explore"
[[motion]]
id = "explore"
kind = "observer"
with = "WITH"
step_deg = 3
angle_deg = 0
speed_deg_s = 60
duration_s = 1
[[slot]]
id = "left"
right_deg = -6
size_deg = 5
[[slot]]
id = "right"
right_deg = 6
size_deg = 5
[[object]]
id = "a"
shipped = "muse"
[[material]]
id = "gold"
kind = "smooth-conductor"
[[material]]
id = "clay"
kind = "diffuse"
[[task]]
id = "t"
question = "Explore."
slots = ["left", "right"]
trials = { rule = "pairs", of = "material" }
steps = [ { show = ["left", "right"], for_s = 1 } ]
)";
    const auto turned_with = [&](std::string_view with) {
        std::string own(text);
        own.replace(own.find("WITH"), 4, with);
        return own;
    };
    const MovesLog log =
        run_moves(turned_with("keys"), {{0.2, "right"}, {0.5, "right", ObserverInput::Kind::key_up}});
    REQUIRE(log.flips.size() == 120);
    REQUIRE(log.further.size() == 120);
    REQUIRE(log.moved.size() == 240);
    for (std::size_t i = 0; i < 120; ++i) {
        CHECK(log.further[i].shown == log.flips[i].shown);
        CHECK(log.further[i].place == 1);
        CHECK(log.moved[2 * i].place == 0);
        CHECK(log.moved[2 * i + 1].place == 1);
        CHECK(log.moved[2 * i].input_at == log.moved[2 * i + 1].input_at);
    }
    CHECK(log.flips.back().shown.value == 6); // 18 deg
    const std::vector<AnswerInput>& inputs = log.outcomes.at(0).inputs;
    CHECK(inputs.size() == 4); // each of the press and the release turned both

    for (const std::string_view with : {"keys", "mouse"}) {
        const ReadText read(turned_with(with));
        REQUIRE(read.protocol);
        Sitting sitting(*read.protocol);
        CHECK_FALSE(sitting.run().aborted);
        REQUIRE(sitting.panel.turnings.size() == 2);
        for (int place : {0, 1}) {
            const TurningOffer& offer = sitting.panel.turnings[static_cast<std::size_t>(place)];
            CHECK(offer.place == place);
            CHECK(offer.show == 0);
            CHECK(offer.lasts_s == 1.0);
            CHECK(offer.since <= sitting.log.outcomes.at(0).presentation_onset);
            CHECK(offer.less.empty() == (with == "mouse"));
        }
        // The mouse's pointer is seen, alone, as long as something can be turned with it.
        REQUIRE(sitting.presenter.beside.size() == (with == "mouse" ? 2u : 0u));
        if (with == "mouse") {
            REQUIRE(sitting.presenter.beside[0]);
            CHECK(sitting.presenter.beside[0]->shows_pointer);
            CHECK(sitting.presenter.beside[0]->items.empty());
            CHECK_FALSE(sitting.presenter.beside[1]);
        }
    }
}
