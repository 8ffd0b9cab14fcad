#include "experiment/study/tables/answer_layouts.h"

#include "experiment/study/tables/study_layout.h"

namespace overt {

namespace {

/// What the rows of both tables say first.
template <class Row> void add_match_of(StudyLayout<Row>& to) {
    to.text("observer", "Label of the observer; all: all together",
            [](const Row& row) { return row.of.observer.empty() ? std::string("all") : row.of.observer; });
    to.text("task", "Task", [](const Row& row) { return row.of.task; });
    to.text("answer", "As the protocol calls the match", [](const Row& row) { return row.of.answer; });
    to.text("along", "The column that was set", &Row::along);
    to.text("compared", "A factor of what is matched; n/a: all trials", &Row::column);
    to.text("compared_level", "The level of it that this is of", &Row::level);
}

} // namespace

RowLayout<AnswerMatchRow> matches_layout() {
    using Row = AnswerMatchRow;
    StudyLayout<Row> to("matches", "What was set to look like each level of a reference.");
    add_match_of(to);
    to.number("reference", "Level of the reference", "", &Row::reference);
    to.count("settings", "Settings that were accepted", &Row::settings);
    to.estimate("match",
                "Mean of the settings, the point of subjective equality; of all observers the mean of their "
                "means, with the interval over observers",
                "", &Row::match);
    to.number("constant_error", "The match less the reference", "", &Row::constant_error);
    to.number("sd", "Standard deviation of the settings; of all, the mean of the observers'", "", &Row::sd);
    to.number("just_noticeable", "0.67449 of it: half of the settings lie as close; n/a: of all observers",
              "", &Row::just_noticeable);
    to.number("mean_start", "Mean of the levels that settings began with", "", &Row::mean_start);
    to.number("mean_changes", "Mean number of changes", "", &Row::mean_changes);
    to.number("mean_reversals", "Mean number of changes against the direction of the one before", "",
              &Row::mean_reversals);
    to.count("at_end", "Settings that were stopped at the lowest or the highest level", &Row::at_end);
    return to;
}

RowLayout<AnswerMatchLineRow> match_lines_layout() {
    using Row = AnswerMatchLineRow;
    StudyLayout<Row> to("match_lines", "The line of settings over references.");
    add_match_of(to);
    to.count("references", "Levels of the reference", &Row::references);
    to.count("settings", "Settings that were accepted", &Row::settings);
    to.estimate(
        "slope",
        "By least squares; 1: what is set grows as the reference does. Of one observer with the interval "
        "by the bootstrap over settings, of all the mean of the observers'",
        "", &Row::slope);
    to.estimate("intercept", "Where the line is at a reference of 0; the same", "", &Row::intercept);
    to.number("deming_slope", "Slope with errors of the same size in both (Deming)", "", &Row::deming_slope);
    to.number("deming_intercept", "Its intercept", "", &Row::deming_intercept);
    to.estimate(
        "brunswik",
        "Constancy: mean over settings of (setting - proximal) / (reference - proximal), the column "
        "`proximal` of the trial or of what it shows saying what would be set by the light at the eye "
        "alone; 0: no constancy, 1: all of it. With the interval over settings, of all over observers",
        "", &Row::brunswik);
    to.estimate("thouless", "The same of logarithms; n/a: a number is not positive", "", &Row::thouless);
    to.number("planted", "Of simulated observers: the slope that they mean to give", "", &Row::planted);
    return to;
}

} // namespace overt
