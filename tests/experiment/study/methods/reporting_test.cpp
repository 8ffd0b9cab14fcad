#include "experiment/study/methods/reporting.h"

#include <algorithm>

#include <catch2/catch.hpp>

using namespace overt;

namespace {

const ReportingItem& item_of(const std::vector<ReportingItem>& items, const std::string& item) {
    const auto found = std::ranges::find(items, item, &ReportingItem::item);
    REQUIRE(found != items.end());
    return *found;
}

} // namespace

TEST_CASE("what an article has to report is named item by item, with its value or what to add", "[unit]") {
    StudyResults results;
    for (const std::string model : {"EyeLink 1000", "EyeLink 1000", "GP3 HD"}) {
        StudySession& session = results.sessions.emplace_back();
        session.observer = session.setup.gaze.tracker = model;
        session.setup.gaze.rate_hz = 1000.0;
        session.events = "Fixations are those that the tracker told.";
        session.form = {{"age", "31"}, {"hand", "left"}};
    }
    for (const double accuracy : {0.3, 0.5, 0.4, 9.0}) {
        StudyTrial& trial = results.trials.emplace_back();
        trial.quality.accuracy_deg = accuracy;
        trial.quality.samples = 1000.0;
        trial.quality.lost = 20.0;
        trial.excluded = accuracy > 1.0;
    }
    results.sessions.front().setup.rig = "begun 2026-11-27T09:00:00Z; proved: light";
    results.glance.observers = 2;
    results.glance.sessions = 3;
    results.glance.trials = 4;
    results.glance.excluded_trials = 1;
    StudyOptions options;
    options.exclude.most_accuracy_deg = 1.0;
    const std::vector<ReportingItem> items = reporting_items(results, options);
    CHECK(item_of(items, "manufacturer, model").value == "EyeLink 1000 (2 sessions); GP3 HD (1 session)");
    CHECK(item_of(items, "nominal rate").value == "1000 Hz");
    CHECK(item_of(items, "accuracy (mean error of the validation)").value ==
          "0.400 deg (median over 3 presentations; 0.300 to 0.500 deg)");
    CHECK(item_of(items, "data loss, blinks apart").value == "2.00 % (the same in 3 presentations)");
    CHECK(item_of(items, "what was proved on the rig").value ==
          "begun 2026-11-27T09:00:00Z; proved: light (1 session)");
    CHECK(item_of(items, "trials").value ==
          "1 of 4 presentations excluded; rules: a validation with a mean error above 1 deg");
    CHECK(item_of(items, "participants").value ==
          "2 observers in 3 sessions; of each are recorded: age, hand");
    CHECK(item_of(items, "fixations, saccades, blinks").value ==
          "Fixations are those that the tracker told.");
    // Of gaze that nobody's eyes gave there is no tracker to name.
    StudyResults simulated = results;
    for (StudySession& session : simulated.sessions)
        session.setup.gaze.origin = GazeOrigin::simulated;
    CHECK(item_of(reporting_items(simulated, options), "manufacturer, model").value ==
          "none: gaze was simulated");
    constexpr const char* scatter = "precision (SD around the motion of the eye, a line through each 0.2 s)";
    for (const char* const missing :
         {"head stabilisation", "room and its light", scatter, "firmware of the tracker",
          "from vertical blank to light", "technique", "questions asked", "calibration"}) {
        INFO(missing);
        CHECK_FALSE(item_of(items, missing).is_recorded);
        CHECK(item_of(items, missing).value.starts_with("not recorded: "));
    }
    // What is taken out of the scatter is said.
    for (StudyTrial& trial : results.trials)
        trial.quality.sd_deg = 0.07;
    CHECK(item_of(reporting_items(results, options), scatter).value ==
          "0.0700 deg (the same in 3 presentations)");
    // Each of the nine aspects is there, in their order.
    char last = '0';
    for (const ReportingItem& item : items) {
        CHECK((item.topic[0] == last || item.topic[0] == last + 1));
        last = item.topic[0];
    }
    CHECK(last == '9');
}
