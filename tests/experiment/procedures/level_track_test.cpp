/// Procedures that choose levels: traces that other programs agree on, laws of where a staircase settles,
/// what a missed answer does, and that a track is a function of its answers alone.
#include "experiment/procedures/constant_stimuli.h"
#include "experiment/procedures/interleaved_tracks.h"
#include "experiment/procedures/quest.h"
#include "experiment/procedures/quest_plus.h"
#include "experiment/procedures/staircase.h"
#include "experiment/proving/known_answers.h"

#include <cmath>
#include <map>

#include <catch2/catch.hpp>

#include "experiment/base/random.h"

using namespace overt;

namespace {

void require_all(const KnownAnswers& answers) {
    REQUIRE_FALSE(answers.empty());
    for (const KnownAnswer& one : answers) {
        INFO(one.what << ": known " << one.known << ", ours " << one.ours);
        CHECK(one.holds());
    }
}

std::vector<std::unique_ptr<LevelTrack>> two_staircases() {
    std::vector<std::unique_ptr<LevelTrack>> tracks;
    for (const double start : {1.0, 9.0}) {
        StaircaseSettings settings;
        settings.start = start;
        settings.trials = 12;
        tracks.push_back(std::make_unique<Staircase>(settings));
    }
    return tracks;
}

} // namespace

TEST_CASE("staircases give the traces that other programs give", "[unit]") {
    require_all(known_staircases());
}

TEST_CASE("QUEST and QUEST+ give the traces that other programs give", "[unit]") {
    require_all(known_quest());
    require_all(known_quest_plus());
}

TEST_CASE("a staircase of equal steps settles where the chain of its levels does", "[unit]") {
    // Stationary means of 1 up m down on psi = 0.5 + 0.5 / (1 + exp(-x)), from the chain's exact
    // distribution.
    const auto [down, step, mean, share] =
        GENERATE(std::tuple(2, 0.5, -0.435239, 0.706001), std::tuple(3, 1.0, 0.409408, 0.791076));
    StaircaseSettings settings;
    settings.start = 0.0;
    settings.down_after = down;
    settings.steps = {step};
    settings.initial_rule = false;
    settings.trials = 200'000;
    Staircase staircase(settings);
    RandomStream random(5, "answers");
    double levels = 0.0, right = 0.0;
    while (const std::optional<double> level = staircase.next()) {
        const bool is_right = random.uniform() < 0.5 + 0.5 / (1.0 + std::exp(-*level));
        levels += *level;
        right += is_right ? 1.0 : 0.0;
        staircase.tell(*level, is_right ? TrackAnswer::yes : TrackAnswer::no);
    }
    // Four standard errors, by the spread of runs of 10^5.
    CHECK(levels / settings.trials == Approx(mean).margin(0.05));
    CHECK(right / settings.trials == Approx(share).margin(0.004));
}

TEST_CASE("a missed answer repeats, counts without saying anything, or is wrong", "[unit]") {
    StaircaseSettings settings;
    settings.start = 5.0;
    settings.trials = 3;
    settings.missed = GENERATE(UnansweredTrial::repeat, UnansweredTrial::ignore, UnansweredTrial::wrong);
    Staircase staircase(settings);
    staircase.tell(5.0, TrackAnswer::missed);
    CHECK(staircase.next() == (settings.missed == UnansweredTrial::wrong ? 6.0 : 5.0));
    CHECK(staircase.state().trials == (settings.missed == UnansweredTrial::repeat ? 0 : 1));
    ConstantStimuli constant({{1.0, 2.0}, 1, settings.missed, 1});
    const double first = constant.next().value();
    constant.tell(first, TrackAnswer::missed);
    constant.tell(constant.next().value(), TrackAnswer::yes);
    CHECK(constant.next() ==
          (settings.missed == UnansweredTrial::repeat ? std::optional(first) : std::nullopt));
}

TEST_CASE("a staircase ends by trials and reversals, or by either", "[unit]") {
    StaircaseSettings settings;
    settings.down_after = 1;
    settings.trials = 6;
    settings.reversals = 2;
    settings.stop = GENERATE(StopRule::both, StopRule::either);
    Staircase staircase(settings);
    int trials = 0;
    for (; staircase.next() && trials < 100; ++trials)
        staircase.tell(*staircase.next(), trials % 2 == 0 ? TrackAnswer::yes : TrackAnswer::no);
    CHECK(trials == (settings.stop == StopRule::both ? 6 : 3));
}

TEST_CASE("steps of places stay on the list of levels", "[unit]") {
    StaircaseSettings settings;
    settings.scale = StepScale::places;
    settings.levels = {0.02, 0.05, 0.1, 0.2, 0.4};
    settings.start = 0.2;
    settings.steps = {2.0, 1.0};
    settings.down_after = 1;
    settings.trials = 10;
    Staircase staircase(settings);
    staircase.tell(0.2, TrackAnswer::yes);
    CHECK(staircase.next() == 0.05);
    staircase.tell(0.05, TrackAnswer::yes);
    CHECK(staircase.next() == 0.02);
    CHECK(staircase.state().was_clipped);
    staircase.tell(0.02, TrackAnswer::no);
    CHECK(staircase.next() == 0.05); // the step after the first reversal
}

TEST_CASE("interleaved tracks follow from their seed and the answers", "[unit]") {
    InterleavedTracks one(two_staircases(), 3), again(two_staircases(), 3);
    RandomStream random(2, "answers");
    std::map<std::size_t, int> trials;
    while (const auto choice = one.next()) {
        REQUIRE(again.next() == choice);
        const TrackAnswer answer = random.uniform() < 0.6 ? TrackAnswer::yes : TrackAnswer::no;
        one.tell(choice->level, answer);
        again.tell(choice->level, answer);
        ++trials[choice->track];
    }
    CHECK(trials == std::map<std::size_t, int>{{0, 12}, {1, 12}});
}

TEST_CASE("QUEST with levels that there are takes the nearest, and ends", "[unit]") {
    QuestSettings settings;
    settings.guess = -1.0;
    settings.levels = {-2.0, -1.0, -0.5, 0.0};
    settings.trials = 2;
    Quest quest(settings);
    CHECK(quest.next() == -0.5);
    quest.tell(-0.5, TrackAnswer::missed); // comes again
    quest.tell(-0.5, TrackAnswer::yes);
    quest.tell(*quest.next(), TrackAnswer::yes);
    CHECK_FALSE(quest.next());
}

TEST_CASE("QUEST+ of two dimensions finds how the threshold moves along the second", "[unit]") {
    QuestPlusSettings settings;
    settings.function = QuestFunction::logistic;
    settings.levels = {-4, -3, -2, -1, 0, 1, 2, 3, 4};
    settings.second_levels = {-1.0, 0.0, 1.0};
    settings.threshold.values = {-2, -1, 0, 1, 2};
    settings.slope.values = {1.0, 2.0};
    settings.tilt.values = {-1.0, 0.0, 1.0};
    settings.entropy_bits = 0.5;
    settings.trials = 400;
    QuestPlus track(settings);
    RandomStream random(1, "answers");
    while (const std::optional<double> level = track.next()) {
        const double second = track.second_next().value();
        const double share = 0.5 + 0.48 / (1.0 + std::exp(-2.0 * (*level - 1.0 - second)));
        track.tell(*level, random.uniform() < share ? TrackAnswer::yes : TrackAnswer::no);
    }
    CHECK(track.entropy_bits() <= 0.5);
    CHECK(track.estimate(QuestPlus::Parameter::tilt).mode == 1.0);
    CHECK(track.estimate(QuestPlus::Parameter::threshold).mode == 1.0);
}
