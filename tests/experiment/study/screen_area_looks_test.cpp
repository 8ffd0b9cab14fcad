/// Looks at areas of the screen, by hand.
#include "experiment/study/screen_area_looks.h"

#include <array>

#include <catch2/catch.hpp>

#include "experiment/study/results/study_groups.h"
#include "experiment/study/trial_summary.h"

using namespace overt;

namespace {

struct SeenOnScreen {
    double onset_s, duration_s, x_px, y_px;
    NotCounted why = NotCounted::counted;
};

/// A screen of 100 by 50 pixels.
struct ScreenStudy {
    ScreenStudy() {
        results.objects.emplace_back().screen.screen_px = {100, 50};
        results.sessions.resize(2);
        results.sessions[0].observer = "first";
        results.sessions[1].observer = "second";
    }
    void add(int observer, double presentation_s, const std::vector<ScreenArea>& areas,
             const std::vector<SeenOnScreen>& looks) {
        StudyTrial trial;
        trial.session = observer;
        trial.presentation_s = presentation_s;
        trial.keys = {{"material", presentation_s > 5.0 ? "rough" : "smooth"}};
        trial.first_fixation = results.fixations.size();
        trial.fixations = looks.size();
        for (const SeenOnScreen& look : looks) {
            StudyFixation& fixation = results.fixations.emplace_back();
            fixation.onset_s = look.onset_s;
            fixation.duration_s = look.duration_s;
            fixation.place = {look.x_px, look.y_px};
            fixation.why = look.why;
        }
        results.trials.push_back(std::move(trial));
        results.screen_areas.push_back(areas);
    }
    const ScreenAreaTrialRow& of_trial(int trial, const std::string& area) const {
        const auto found =
            std::ranges::find_if(results.screen_area_trials, [&](const ScreenAreaTrialRow& row) {
                return row.trial == trial && row.area == area;
            });
        REQUIRE(found != results.screen_area_trials.end());
        return *found;
    }
    StudyResults results;
    StudyOptions options;
};

ScreenArea box(const char* name, double left, double right, double bottom, double from_s, double until_s) {
    return {name, ScreenArea::Shape::rectangle, {{left, 0.0}, {right, bottom}}, from_s, until_s};
}

/// "sign" is two boxes that overlap, one until 2 s and one from 1 to 3 s; "dot" overlaps the second.
const std::vector<ScreenArea> sign_and_dot{
    box("sign", 0, 20, 50, 0.0, 2.0), box("dot", 20, 40, 25, 0.0, 99.0), box("sign", 10, 30, 50, 1.0, 3.0)};

ScreenStudy signs() {
    ScreenStudy study;
    study.add(0, 4.0, sign_and_dot,
              {{0.2, 0.4, 5, 10},                              // sign
               {0.8, 0.4, 25, 10},                             // both
               {1.5, 0.2, 35, 10},                             // dot
               {2.0, 0.5, 5, 10},                              // where the sign was
               {2.6, 0.2, 25, 40, NotCounted::not_on_surface}, // sign
               {3.2, 0.3, 25, 40},                             // where it was
               {3.6, 0.1, 35, 10, NotCounted::too_short},      // no look
               {3.8, 0.1, 35, 10, NotCounted::began_before_onset}});
    study.add(1, 4.0, sign_and_dot, {{0.5, 0.5, 35, 40}});
    study.add(1, 4.0, {}, {{0.5, 0.5, 35, 40}});
    study.add(1, 8.0, {box("dot", 20, 40, 25, 0.0, 2.0)}, {{1.0, 1.0, 35, 10}});
    study.add(0, 4.0, sign_and_dot, {{0.5, 0.5, 5, 10}});
    study.results.trials.back().excluded = true;
    return study;
}

} // namespace

TEST_CASE("areas of the screen have the looks of when they were there, and what chance would give",
          "[unit]") {
    ScreenStudy study = signs();
    study.results.groups = make_groups(study.results, {}, {});
    add_screen_area_looks(study.results, {}, study.options);
    CHECK(study.results.screen_area_trials.size() == 3 + 3 + 2);
    const ScreenAreaTrialRow &sign = study.of_trial(0, "sign"), &dot = study.of_trial(0, "dot"),
                             &none = study.of_trial(0, no_screen_area);
    CHECK(sign.there_s == Approx(3.0));
    CHECK(dot.there_s == Approx(4.0));
    CHECK(none.there_s == Approx(4.0));
    // Pixels by second: 1000, 1500 and 1000 of the sign, 500 of the dot, 1500, 1750, 1250 and 500 of both.
    CHECK(*sign.share_by_chance == Approx(3500.0 / 20'000.0));
    CHECK(*dot.share_by_chance == Approx(2000.0 / 20'000.0));
    CHECK(*none.share_by_chance == Approx(1.0 - 5000.0 / 20'000.0));
    CHECK(*sign.dwell_share == Approx(1.0 / 2.0));
    CHECK(*dot.dwell_share == Approx(0.6 / 2.0));
    CHECK(*none.dwell_share == Approx(0.8 / 2.0));
    CHECK(sign.visits.visits == 2);
    CHECK(sign.visits.fixations == 3);
    CHECK(dot.visits.visits == 1);
    CHECK(none.visits.visits == 2);
    CHECK(*sign.visits.first_arrival_s == 0.2);
    CHECK(*dot.visits.first_arrival_s == 0.8);
    CHECK(*none.visits.first_arrival_s == 2.0);
    CHECK(*study.of_trial(3, "dot").share_by_chance == Approx(1000.0 / 40'000.0));
    CHECK(study.of_trial(3, "dot").there_s == 2.0);
    std::string ways;
    for (const AreaTransitionRow& way : study.results.area_transitions)
        ways += std::to_string(way.trial) + way.from + ">" + way.to + std::to_string(way.count) + " ";
    CHECK(ways == "0sign>(none)1 0dot>(none)1 0(none)>sign1 ");
}

TEST_CASE("areas of the screen over a group are means over observers of all their trials", "[unit]") {
    ScreenStudy study = signs();
    study.results.by = {"material"};
    study.results.groups = make_groups(study.results, study.results.by, {});
    add_screen_area_looks(study.results, {}, study.options);
    const auto row = [&](const std::string& level, const std::string& area) {
        const auto found =
            std::ranges::find_if(study.results.screen_area_groups, [&](const ScreenAreaRow& one) {
                return one.area == area &&
                       (level.empty() ? one.keys.empty() : !one.keys.empty() && one.keys[0].value == level);
            });
        REQUIRE(found != study.results.screen_area_groups.end());
        return *found;
    };
    CHECK(study.results.screen_area_groups.size() ==
          3 + 3 + 2); // nothing rough has a sign; no row comes twice
    const ScreenAreaRow sign = row("", "sign"), dot = row("", "dot");
    CHECK(sign.trials == 2);
    CHECK(sign.observers == 2);
    CHECK(sign.fixations == 3);
    CHECK(*sign.share_by_chance == Approx(0.175));
    CHECK(*sign.dwell_share.value == Approx((0.5 + 0.0) / 2.0));
    CHECK(*sign.visits.value == Approx((2.0 + 0.0) / 2.0));
    CHECK(*sign.reached.value == Approx(0.5));
    CHECK(*sign.first_arrival_s.value == Approx(0.2));
    CHECK(dot.trials == 3);
    CHECK(dot.fixations == 3);
    CHECK(*dot.share_by_chance == Approx((0.1 + 0.1 + 0.025) / 3.0));
    CHECK(*dot.dwell_share.value == Approx((0.3 + 1.0 / 1.5) / 2.0));
    CHECK(*dot.visits.value == Approx((1.0 + 0.5) / 2.0));
    CHECK(*dot.reached.value == Approx((1.0 + 0.5) / 2.0));
    CHECK(*dot.first_arrival_s.value == Approx((0.8 + 1.0) / 2.0));
    CHECK(*row("smooth", "dot").dwell_share.value == Approx((0.3 + 0.0) / 2.0));
    CHECK(*row("rough", "dot").dwell_share.value == Approx(1.0));
    CHECK_FALSE(row("smooth", "dot").first_arrival_s.value == row("", "dot").first_arrival_s.value);
}

TEST_CASE("without a known screen there is no chance, without fixations no share, without areas nothing",
          "[unit]") {
    ScreenStudy study;
    study.results.objects[0].screen.screen_px = {0, 0};
    study.add(0, 4.0, sign_and_dot, {});
    study.results.groups = make_groups(study.results, {}, {});
    add_screen_area_looks(study.results, {}, study.options);
    CHECK_FALSE(study.of_trial(0, "sign").share_by_chance);
    CHECK_FALSE(study.of_trial(0, "sign").dwell_share);
    REQUIRE(study.results.screen_area_groups.size() == 3);
    CHECK(study.results.screen_area_groups[0].observers == 0);
    CHECK_FALSE(study.results.screen_area_groups[0].share_by_chance);
    CHECK_FALSE(study.results.screen_area_groups[0].dwell_share.value);
    ScreenStudy bare;
    bare.add(0, 4.0, {}, {{0.5, 0.5, 5, 10}});
    bare.results.screen_areas.clear();
    add_screen_area_looks(bare.results, {}, bare.options);
    CHECK(bare.results.screen_area_groups.empty());
}

TEST_CASE("a trial comes to its counted fixations, in number and time, by area, and to their spread",
          "[unit]") {
    StudyResults results;
    StudyObject& object = results.objects.emplace_back();
    object.part_names = {"body", "head", "head/nose"};
    object.areas = Areas(object.part_names);
    object.mm_per_unit = 3.0;
    results.areas = {"head", "nose", "foot"};
    const std::array<double, 4> x{0.0, 2.0, 4.0, 100.0};
    for (std::size_t i = 0; i < 4; ++i) {
        StudyFixation& fixation = results.fixations.emplace_back();
        fixation.duration_s = 0.25 * static_cast<double>(i + 1);
        fixation.part = static_cast<PartIndex>(i % 3);
        fixation.position = {x[i], 0.0, 0.0};
    }
    results.fixations[3].why = NotCounted::too_short;
    StudyTrial trial;
    trial.fixations = 4;
    const TrialSummaryRow row = trial_summary(results, trial);
    CHECK(row.counted == 3);
    CHECK(row.counted_s == Approx(0.25 + 0.5 + 0.75));
    REQUIRE(row.areas.size() == 3);
    CHECK(row.areas[0]->fixations == 2);
    CHECK(row.areas[0]->seconds == Approx(1.25));
    CHECK(row.areas[1]->fixations == 1);
    CHECK(row.areas[1]->seconds == Approx(0.75));
    CHECK_FALSE(row.areas[2]);
    CHECK(*row.wss_mm2 == Approx(9.0 * 4.0)); // variance of 0, 2, 4 by N - 1
    trial.fixations = 1;
    CHECK_FALSE(trial_summary(results, trial).wss_mm2);
    trial.fixations = 2;
    CHECK(*trial_summary(results, trial).wss_mm2 == Approx(9.0 * 2.0));
    results.objects[0].mm_per_unit.reset();
    CHECK_FALSE(trial_summary(results, trial).wss_mm2);
}
