#include "experiment/study/tables/screen_area_layouts.h"

#include "experiment/study/tables/study_layout.h"

namespace overt {

namespace {

/// Observer, session and trial, and the columns that make the groups.
template <class Row> void add_trial_of_area(StudyLayout<Row>& to, const StudyResults& results) {
    const auto trial = [&results](const Row& row) -> const StudyTrial& {
        return item(results.trials, row.trial);
    };
    const auto value = [trial](const std::string& column) {
        return [trial, column](const Row& row) { return trial(row).key(column); };
    };
    to.text("observer", "Label of the observer", value("observer"));
    to.text("session_folder", "Folder of the session",
            [&results, trial](const Row& row) { return item(results.sessions, trial(row).session).folder; });
    to.count("trial", "Position of the trial in the observer's order, from 1",
             [trial](const Row& row) { return trial(row).number; });
    for (const std::string& column : results.by)
        if (column != "observer" && column != "session_folder" && column != "trial")
            to.text(column, "As in the table of trials", value(column));
}

auto of_visits(auto what) {
    return [what](const ScreenAreaTrialRow& row) { return std::invoke(what, row.visits); };
}

} // namespace

RowLayout<ScreenAreaTrialRow> screen_area_trials_layout(const StudyResults& results) {
    using Row = ScreenAreaTrialRow;
    StudyLayout<Row> to(
        "screen_area_trials",
        "One row for each area of the screen in each trial that is not excluded, and one for "
        "fixations in none of them, (none). A fixation is in an area if its mean place is, and if "
        "the area is there halfway through it; where areas overlap it is in all of them.");
    add_trial_of_area(to, results);
    to.text("area", "Name of the area; (none): fixations in none of the trial's areas", &Row::area);
    to.number("there_s", "How long of the presentation the area was there", "s", &Row::there_s);
    to.number(
        "share_by_chance",
        "Share of the fixation time that gaze would have in it that is spread evenly over the screen and the "
        "presentation; n/a: their size or duration is not known",
        "", &Row::share_by_chance);
    to.count("fixations", "Fixations in it", of_visits(&AreaVisits::fixations));
    to.number("dwell_s", "Time of these fixations", "s", of_visits(&AreaVisits::dwell_s));
    to.number("dwell_share", "Of the time of all fixations of the trial; n/a: it has none", "",
              &Row::dwell_share);
    to.count("visits", "Runs of fixations in it, one after the other", of_visits(&AreaVisits::visits));
    to.number("visits_s",
              "From the begin of the first to the end of the last fixation of each visit, added up", "s",
              of_visits(&AreaVisits::visits_s));
    to.number("first_arrival_s",
              "Onset of the first fixation in it, since the presentation's onset; n/a: there is none", "s",
              of_visits(&AreaVisits::first_arrival_s));
    to.number("first_visit_s", "Time of the fixations of the first visit", "s",
              of_visits(&AreaVisits::first_visit_s));
    return to;
}

RowLayout<AreaTransitionRow> area_transitions_layout(const StudyResults& results) {
    using Row = AreaTransitionRow;
    StudyLayout<Row> to(
        "screen_area_transitions",
        "How often gaze went straight from one area of the screen to another in a trial: of two "
        "successive fixations the first is in one and not in the other, the second the other way "
        "round. Ways that were not taken have no row.");
    add_trial_of_area(to, results);
    to.text("from_area", "Where gaze came from; (none): from no area", &Row::from);
    to.text("to_area", "Where it went", &Row::to);
    to.count("count", "How often", &Row::count);
    return to;
}

RowLayout<ScreenAreaRow> screen_areas_layout(const StudyResults& results) {
    using Row = ScreenAreaRow;
    StudyLayout<Row> to(
        "screen_areas",
        "Areas of the screen over the trials that have them: of groups, of each level of each "
        "column, and of all; means over observers of their own means.");
    to.keys(results.by, &Row::keys);
    to.text("area", "Name of the area; (none): fixations in none of a trial's areas", &Row::area);
    to.number("share_by_chance", "As in screen_area_trials, mean over trials", "", &Row::share_by_chance);
    to.estimate("dwell_share", "Share of an observer's time of fixation that is in it", "",
                &Row::dwell_share);
    to.estimate("visits", "Visits in a trial", "", &Row::visits);
    to.estimate("reached", "Share of trials with a fixation in it", "", &Row::reached);
    to.estimate("first_arrival_s", "Onset of the first fixation in it, of trials with one", "s",
                &Row::first_arrival_s);
    to.count("observers", "Observers with fixations in these trials", &Row::observers);
    to.count("trials", "Trials that have the area", &Row::trials);
    to.count("fixations", "Fixations in it", &Row::fixations);
    return to;
}

} // namespace overt
