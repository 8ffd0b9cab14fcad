#include "experiment/study/tables/answer_layouts.h"

#include <algorithm>
#include <functional>
#include <iterator>

#include <fmt/format.h>

#include "experiment/study/tables/study_layout.h"

namespace overt {

namespace {

template <class Row> void add_answer_of(StudyLayout<Row>& to) {
    to.text("observer", "Label of the observer; all: all together",
            [](const Row& row) { return row.of.observer.empty() ? std::string("all") : row.of.observer; });
    to.text("task", "Id of the task", [](const Row& row) { return row.of.task; });
    to.text("answer", "Id of the answer", [](const Row& row) { return row.of.answer; });
    to.text("item", "Of a scale with several items; n/a: it has one",
            [](const Row& row) { return row.of.item; });
}

} // namespace

RowLayout<StudyAnswer> answer_trials_layout(const std::vector<StudyAnswer>& answers) {
    using Row = StudyAnswer;
    StudyLayout<Row> to("answer_trials",
                        "Each answer of trials that give results, with what was shown: the input of "
                        "answer_models.R.");
    to.text("observer", "Label of the observer", &Row::observer);
    to.count("session", "Place of the session among those analysed, from 1",
             [](const Row& row) { return row.session + 1; });
    to.count("trial", "Number of the trial in the session's order", &Row::trial);
    to.text("task", "Id of the task", &Row::task);
    to.text("answer", "Id of the answer", &Row::answer);
    to.text("item", "Of a scale with several items; n/a: it has one", &Row::item);
    to.text("kind", "Kind of answer", &Row::kind);
    to.count("missed", "1: it was not given", &Row::is_missed);
    to.text("value", "What was answered; n/a: missed", &Row::value);
    to.number("number", "Of scales and numbers", "", &Row::number);
    to.text("correct", "What is correct; n/a: nothing is", &Row::correct);
    to.text("is_correct", "1: correct; 0: wrong; n/a: neither", [](const Row& row) {
        return row.is_correct ? std::string(*row.is_correct ? "1" : "0") : std::string();
    });
    to.number("response_s", "Response time, from the zero that the protocol names", "s", &Row::response_s);
    std::vector<std::string> factors, slots, of_slots;
    const auto add_once = [](std::vector<std::string>& names, const std::string& name) {
        if (std::ranges::find(names, name) == names.end())
            names.push_back(name);
    };
    for (const StudyAnswer& answer : answers) {
        for (const auto& [factor, level] : answer.levels)
            add_once(factors, factor);
        if (answer.shown.size() < 2)
            continue;
        for (const AnsweredStimulus& shown : answer.shown) {
            add_once(slots, shown.slot);
            for (const auto& [factor, level] : shown.levels)
                if (answer.level(factor).empty())
                    add_once(of_slots, factor);
        }
    }
    for (const std::string& factor : factors)
        to.text(factor, "Level of this factor, of the trial or of all that it shows; n/a: they differ",
                [factor](const Row& row) { return row.level(factor); });
    for (const std::string& slot : slots)
        for (const std::string& factor : of_slots)
            to.text(fmt::format("{}.{}", slot, factor), "Level of this factor in this slot",
                    [slot, factor](const Row& row) {
                        for (const AnsweredStimulus& shown : row.shown)
                            for (const auto& [name, level] : shown.levels)
                                if (shown.slot == slot && name == factor)
                                    return level;
                        return std::string();
                    });
    return to;
}

RowLayout<AnswerSummaryRow> answers_layout() {
    using Row = AnswerSummaryRow;
    StudyLayout<Row> to("answers",
                        "Answers by observer and over all: how many, how right, how fast. Of trials that "
                        "give results; catch trials and practice are none of them.");
    add_answer_of(to);
    to.count("trials", "Trials that ask for it", &Row::trials);
    to.count("missed",
             "Of these without an answer, which is neither right nor wrong unless the protocol says so",
             &Row::missed);
    to.estimate("correct", "Share of correct answers, with Wilson's interval", "", &Row::correct);
    to.number("correct_planted", "Of simulated observers: how often they mean to be right", "",
              &Row::planted_correct);
    to.number(
        "d_prime",
        "Where one of two answers is right in each trial: sensitivity, log-linear correction of all shares; "
        "choices of slots as two alternatives, with the bias taken out",
        "", &Row::d_prime);
    to.number("d_prime_se", "Its standard error by the delta method", "", &Row::d_prime_se);
    to.number("criterion", "c, above 0 against the answer that comes first by its letters", "",
              &Row::criterion);
    to.number("median_response_s", "Median response time, from the zero that the protocol names", "s",
              &Row::median_response_s);
    to.number("mean_response_s", "Mean response time", "s", &Row::mean_response_s);
    to.text("design",
            "How answers come about, told by what was shown, where it is another design than yes-no or two "
            "alternatives",
            &Row::design);
    to.number("design_d_prime", "Sensitivity by this design, log-linear correction", "",
              &Row::design_d_prime);
    to.number("design_d_prime_se", "Its standard error by the delta method; n/a: of same-different", "",
              &Row::design_d_prime_se);
    return to;
}

RowLayout<AnswerChoiceRow> answer_choices_layout() {
    using Row = AnswerChoiceRow;
    StudyLayout<Row> to("answer_choices", "How often each choice was made, of all answers that were given.");
    add_answer_of(to);
    to.text("choice", "What was chosen", &Row::choice);
    to.count("chosen", "How often", &Row::chosen);
    to.count("answered", "Trials with an answer", &Row::answered);
    to.estimate("share",
                "Share of these, with Wilson's interval (trials of several observers taken as independent)",
                "", &Row::share);
    return to;
}

RowLayout<AnswerCurveRow> psychometric_functions_layout() {
    using Row = AnswerCurveRow;
    StudyLayout<Row> to(
        "psychometric_functions",
        "Logistic functions of a factor, guess + (1 - guess - lapse) / (1 + exp(-slope (x - threshold))), "
        "by maximum likelihood; of all observers the means of theirs, without those whose threshold lies "
        "farther beyond the levels than these reach.");
    add_answer_of(to);
    to.text("factor", "Factor whose levels are x", &Row::factor);
    to.text("within", "A factor of which trials of one level alone are taken; n/a: all trials", &Row::column);
    to.text("within_level", "That level", &Row::level);
    to.text("yes", "Which answers are counted, over which x", &Row::yes);
    to.number("guess", "Guess rate, held", "", &Row::guess);
    to.number("lapse", "Lapse rate, free from 0 to 0.06; n/a: held at 0", "", &Row::lapse);
    to.count("trials", "Trials with an answer", &Row::trials);
    to.count("levels", "Levels of x", &Row::levels);
    to.estimate("threshold",
                "x at which the logistic is one half; its interval is by the nonparametric bootstrap over "
                "trials, 999 "
                "samples, percentiles; of all observers by the bootstrap over observers",
                "", &Row::threshold);
    to.number("threshold_se", "Standard error from the observed information; n/a: there is none", "",
              &Row::threshold_se);
    to.number("slope", "Slope, per unit of x", "", &Row::slope);
    to.number("slope_se", "Its standard error", "", &Row::slope_se);
    to.number("deviance", "Deviance", "", &Row::deviance);
    to.number("pearson_x2", "Pearson's X2", "", &Row::pearson_x2);
    to.count("degrees", "Degrees of freedom of both", &Row::degrees);
    to.number("deviance_limit",
              "Below which that share of the samples' deviances lies that the confidence is", "",
              &Row::deviance_limit);
    to.count("failures", "Samples of the bootstrap without a slope, which are left out", &Row::failures);
    to.text("note", "What has to be known of it", &Row::note);
    to.number("planted_threshold", "Of simulated observers: what they were given", "",
              &Row::planted_threshold);
    to.number("planted_slope", "The same of the slope", "", &Row::planted_slope);
    return to;
}

RowLayout<AnswerPointRow> psychometric_points_layout() {
    using Row = AnswerPointRow;
    StudyLayout<Row> to("psychometric_points",
                        "What psychometric_functions were fitted to: answers by level of x.");
    const auto of_curve = [](auto member) {
        return [member](const Row& row) { return std::invoke(member, row.curve); };
    };
    to.text("observer", "Label of the observer; all: all together", [](const Row& row) {
        return row.curve.of.observer.empty() ? std::string("all") : row.curve.of.observer;
    });
    to.text("task", "Id of the task", [](const Row& row) { return row.curve.of.task; });
    to.text("answer", "Id of the answer", [](const Row& row) { return row.curve.of.answer; });
    to.text("item", "Of a scale with several items; n/a: it has one",
            [](const Row& row) { return row.curve.of.item; });
    to.text("factor", "Factor whose levels are x", of_curve(&AnswerCurveRow::factor));
    to.text("yes", "Which answers are counted, over which x", of_curve(&AnswerCurveRow::yes));
    to.text("within", "A factor of which trials of one level alone are taken; n/a: all trials",
            of_curve(&AnswerCurveRow::column));
    to.text("within_level", "That level", of_curve(&AnswerCurveRow::level));
    to.number("x", "Level", "", [](const Row& row) { return std::optional(row.point.level); });
    to.number("trials", "Answers", "", [](const Row& row) { return std::optional(row.point.trials); });
    to.number("yes_answers", "Of these those that are counted", "",
              [](const Row& row) { return std::optional(row.point.yes); });
    to.number("share", "Their share", "",
              [](const Row& row) { return std::optional(row.point.yes / row.point.trials); });
    to.number("share_low", "Lower end of Wilson's interval of confidence", "",
              [](const Row& row) { return std::optional(row.point.share.low); });
    to.number("share_high", "Upper end of it", "",
              [](const Row& row) { return std::optional(row.point.share.high); });
    to.number("fitted", "What the function has there; n/a: of all together", "",
              [](const Row& row) { return row.point.fitted; });
    return to;
}

RowLayout<AnswerTrackRow> procedure_tracks_layout() {
    using Row = AnswerTrackRow;
    StudyLayout<Row> to("procedure_tracks",
                        "Levels that procedures chose, trial by trial in the order of their tracks.");
    add_answer_of(to);
    to.text("procedure", "Id of the procedure", &Row::procedure);
    to.text("factor", "Factor whose level it chose", &Row::factor);
    to.count("track", "Condition of the task, from 1", &Row::track);
    to.count("place", "Of the trial in its track, from 1", &Row::place);
    to.count("trial", "Number of the trial in the session's order", &Row::trial);
    to.number("level", "Level that was chosen", "", [](const Row& row) { return std::optional(row.level); });
    to.text("value", "What was answered; n/a: missed", &Row::value);
    to.text("is_correct", "1: correct; 0: wrong; n/a: neither", [](const Row& row) {
        return row.is_correct ? std::string(*row.is_correct ? "1" : "0") : std::string();
    });
    to.count("reversal", "1: the levels turn there", &Row::is_reversal);
    return to;
}

RowLayout<AnswerTimeRow> response_times_layout() {
    using Row = AnswerTimeRow;
    StudyLayout<Row> to("response_times",
                        "Response times, from the zero that the protocol names. Of one observer two "
                        "distributions by maximum likelihood where there are 40 times at least; the better "
                        "one has the larger logarithm of the likelihood.");
    add_answer_of(to);
    to.text("which", "Of which answers: all, correct, wrong, or a choice", &Row::which);
    to.count("times", "Answers with a time", &Row::times);
    to.estimate("median_s", "Median; of all observers the mean of their medians", "s", &Row::median_s);
    to.number("mean_s", "Mean of all times", "s", &Row::mean_s);
    to.number("sd_s", "Standard deviation", "s", &Row::sd_s);
    for (std::size_t i = 0; i < std::size(response_quantiles); ++i) {
        const int percent = static_cast<int>(100.0 * response_quantiles[i] + 0.5);
        to.number(fmt::format("q{}_s", percent), fmt::format("{} % of the times lie below", percent), "s",
                  [i](const Row& row) {
                      return i < row.quantiles_s.size() ? std::optional(row.quantiles_s[i]) : std::nullopt;
                  });
    }
    to.number("ex_mu_s", "Of the ex-Gaussian: mean of its normal part", "s", &Row::ex_mu_s);
    to.number("ex_sigma_s", "Standard deviation of its normal part", "s", &Row::ex_sigma_s);
    to.number("ex_tau_s", "Mean of its exponential part", "s", &Row::ex_tau_s);
    to.number("ex_log_likelihood", "Logarithm of its likelihood", "", &Row::ex_log_likelihood);
    to.number("shift_s", "Of the shifted log-normal: shift", "s", &Row::shift_s);
    to.number("log_mean", "Mean of the logarithm of what is added to it, of s", "", &Row::log_mean);
    to.number("log_sd", "Standard deviation of that logarithm", "", &Row::log_sd);
    to.number("log_normal_log_likelihood", "Logarithm of its likelihood", "",
              &Row::log_normal_log_likelihood);
    return to;
}

RowLayout<AnswerSpeedRow> speed_and_accuracy_layout() {
    using Row = AnswerSpeedRow;
    StudyLayout<Row> to("speed_and_accuracy",
                        "Correct answers by how fast they came: the conditional accuracy function.");
    add_answer_of(to);
    to.count("part", "Of the observer's times, the fastest being 1", &Row::part);
    to.count("parts", "Parts of equally many times", &Row::parts);
    to.count("trials", "Answers", &Row::trials);
    to.number("mean_response_s", "Mean response time of the part", "s", &Row::mean_response_s);
    to.estimate("correct", "Share of correct answers; of all observers the mean, with the interval over them",
                "", &Row::correct);
    return to;
}

RowLayout<AnswerDifferenceRow> answer_differences_layout() {
    using Row = AnswerDifferenceRow;
    StudyLayout<Row> to("answer_differences",
                        "Two levels of a factor compared within observers by what they answered.");
    to.text("task", "Id of the task", [](const Row& row) { return row.of.task; });
    to.text("answer", "Id of the answer", [](const Row& row) { return row.of.answer; });
    to.text("item", "Of a scale with several items; n/a: it has one",
            [](const Row& row) { return row.of.item; });
    to.text("measure", "What is compared", &Row::measure);
    to.text("compared", "The factor whose levels are compared", &Row::column);
    to.text("a", "First level", &Row::a);
    to.text("b", "Second level", &Row::b);
    to.estimate("difference", "Of a less b: mean over observers", "", &Row::difference);
    to.number("p", "Flips of the signs of observers' differences", "", &Row::p);
    to.number("p_holm", "After Holm, over the rows of the answer's measure", "", &Row::p_holm);
    to.evidence("", "differences", &Row::evidence);
    to.count("observers", "Observers who have a value in both levels", &Row::observers);
    to.number("planted", "Of simulated observers: what they were given", "", &Row::planted);
    return to;
}

RowLayout<AnswerGazeRow> answer_gaze_layout() {
    using Row = AnswerGazeRow;
    StudyLayout<Row> to(
        "answer_gaze", "What was looked at before each answer: a row for each stimulus that was lit, and for "
                       "each area of its object that is compared. Counted fixations that began before the "
                       "answer, up to it.");
    to.text("observer", "Label of the observer", &Row::observer);
    to.count("session", "Place of the session among those analysed, from 1",
             [](const Row& row) { return row.session + 1; });
    to.count("trial", "Number of the trial in the session's order", &Row::trial);
    to.text("task", "Id of the task", &Row::task);
    to.text("answer", "Id of the answer", &Row::answer);
    to.text("item", "Of a scale with several items; n/a: it has one", &Row::item);
    to.text("value", "What was answered", &Row::value);
    to.text("slot", "Slot of the stimulus; n/a: the experiment has none", &Row::slot);
    to.text("area", "Area of its object; all: the whole of it",
            [](const Row& row) { return row.area.empty() ? std::string("all") : row.area; });
    to.text("is_chosen", "1: this slot was the answer; 0: another; n/a: slots were not to choose from",
            [](const Row& row) {
                return row.is_chosen ? std::string(*row.is_chosen ? "1" : "0") : std::string();
            });
    to.number("until_s", "From the stimulus's onset to the answer", "s",
              [](const Row& row) { return std::optional(row.until_s); });
    to.number("dwell_s", "Time of fixation there until the answer", "s",
              [](const Row& row) { return std::optional(row.dwell_s); });
    to.number("dwell_share", "Of the time of fixation on all stimuli of the trial until then", "",
              &Row::dwell_share);
    to.number("last_second_share", "The same of the last second before the answer", "",
              &Row::last_second_share);
    to.count("visits", "Runs of fixations there", &Row::visits);
    to.count("is_first", "1: the first fixation on any stimulus was there", &Row::is_first);
    to.count("is_last", "1: the last one before the answer was there", &Row::is_last);
    to.number("first_arrival_s", "From the stimulus's onset to the first fixation there; n/a: there was none",
              "s", &Row::first_arrival_s);
    return to;
}

RowLayout<AnswerTrendRow> answer_trends_layout() {
    using Row = AnswerTrendRow;
    StudyLayout<Row> to(
        "answer_trends",
        "Lines of what was answered over factors whose levels are numbers, such as the set size "
        "of a search.");
    add_answer_of(to);
    to.text("measure", "What is a line of the factor; response times are of answers that are not wrong",
            &Row::measure);
    to.text("along", "The factor", &Row::along);
    to.text("within", "A factor of which trials of one level alone are taken; n/a: all trials", &Row::column);
    to.text("within_level", "That level", &Row::level);
    to.estimate("slope",
                "Per unit of the factor, by least squares over single answers; of all observers the mean of "
                "theirs",
                "", &Row::slope);
    to.estimate("intercept", "Where the factor is 0", "", &Row::intercept);
    to.count("answers", "Answers that it is made of", &Row::answers);
    to.count("observers", "Observers", &Row::observers);
    to.number("planted", "Of simulated observers: the slope that they mean to have", "", &Row::planted);
    return to;
}

RowLayout<AnswerTrendPointRow> answer_trend_points_layout() {
    using Row = AnswerTrendPointRow;
    StudyLayout<Row> to("answer_trend_points",
                        "What the lines of answer_trends go through: means at each level.");
    to.text("observer", "Label of the observer; all: all together", [](const Row& row) {
        return row.trend.of.observer.empty() ? std::string("all") : row.trend.of.observer;
    });
    to.text("task", "Id of the task", [](const Row& row) { return row.trend.of.task; });
    to.text("answer", "Id of the answer", [](const Row& row) { return row.trend.of.answer; });
    to.text("item", "Of a scale with several items; n/a: it has one",
            [](const Row& row) { return row.trend.of.item; });
    to.text("measure", "What is a line of the factor", [](const Row& row) { return row.trend.measure; });
    to.text("along", "The factor", [](const Row& row) { return row.trend.along; });
    to.text("within", "A factor of which trials of one level alone are taken; n/a: all trials",
            [](const Row& row) { return row.trend.column; });
    to.text("within_level", "That level", [](const Row& row) { return row.trend.level; });
    to.number("x", "Level of the factor", "", [](const Row& row) { return std::optional(row.point.x); });
    to.estimate("mean", "Mean there; of all observers the mean of theirs", "",
                [](const Row& row) { return row.point.mean; });
    return to;
}

RowLayout<AnswerLikenessRow> answer_likenesses_layout() {
    using Row = AnswerLikenessRow;
    StudyLayout<Row> to("answer_likenesses",
                        "How alike two levels of a factor are: how often two stimuli stay together where the "
                        "one that does not belong was chosen.");
    add_answer_of(to);
    to.text("factor", "The factor", &Row::factor);
    to.text("a", "First level", &Row::a);
    to.text("b", "Second level; the same as the first, where two stimuli of a trial have it", &Row::b);
    to.count("trials", "Pairs of such stimuli in trials that were answered", &Row::trials);
    to.count("together", "Of these the pairs of which neither was chosen", &Row::together);
    to.estimate(
        "share",
        "Share of the pairs that stayed together: of an observer with Wilson's interval, of all the "
        "mean over observers with the interval over them, or Wilson's of all answers where that is wider",
        "", &Row::share);
    to.number("chance", "What it would be if each stimulus were chosen as often", "",
              [](const Row& row) { return std::optional(row.chance); });
    to.number("planted", "Of simulated observers: what they were given", "", &Row::planted);
    return to;
}

RowLayout<GazeChoiceRow> gaze_choices_layout() {
    using Row = GazeChoiceRow;
    StudyLayout<Row> to(
        "gaze_and_choice",
        "Whether looking goes with answering: how the stimulus that was chosen was looked at, "
        "or where gaze was before one answer and before another.");
    add_answer_of(to);
    to.text("measure", "What is told of gaze", &Row::measure);
    to.text("area", "Area of the surface; n/a: the whole stimulus", &Row::area);
    to.text("a", "First answer, or kind of stimulus; n/a: the chosen stimulus alone", &Row::a);
    to.text("b", "Second one", &Row::b);
    to.estimate("value", "Of the chosen stimulus, or of a less b: mean over observers", "", &Row::value);
    to.number("chance",
              "What it would be if each observer chose as often, and looked as much, independently of each "
              "other",
              "", [](const Row& row) { return std::optional(row.chance); });
    to.number("p", "Flips of the signs of observers' differences from it", "", &Row::p);
    to.number("p_holm", "After Holm, over the rows of the answer", "", &Row::p_holm);
    to.evidence("", "differences from chance", &Row::evidence);
    to.count("observers", "Observers", &Row::observers);
    to.count("trials", "Answers", &Row::trials);
    to.number("planted", "Of simulated observers: what they were given", "", &Row::planted);
    return to;
}

RowLayout<AnswerScaleRow> answer_scales_layout() {
    using Row = AnswerScaleRow;
    StudyLayout<Row> to(
        "answer_scales",
        "Scales of comparisons by maximum likelihood. Bradley-Terry (logits) and Thurstone's Case V (in "
        "standard deviations of one percept) with a mean of 0; MLDS from 0 to 1; MLCM, what each level adds "
        "to the first of its factor, in standard deviations of the judgement.");
    add_answer_of(to);
    to.text("method", "Model", &Row::method);
    to.text("factor", "Factor on whose levels it is", &Row::factor);
    to.text("level", "Level", &Row::level);
    to.estimate(
        "value",
        "Its place on the scale; interval of pairs by the standard error, of MLDS by 999 parametric samples",
        "", &Row::value);
    to.number("se", "Standard error; of MLDS standard deviation of the samples", "", &Row::se);
    to.number("first_slot", "What being in the first slot adds to a choice, on the scale; n/a: of MLDS", "",
              &Row::first_slot);
    to.number("sigma", "Noise of a judgement in units of the scale; n/a: of pairs", "", &Row::sigma);
    to.count("trials", "Judgements", &Row::trials);
    to.count(
        "penalised",
        "1: the answers are so consistent that the likelihood has no maximum, and Jeffreys' prior was added",
        &Row::is_penalised);
    to.number("planted", "Of simulated observers: what they were given", "", &Row::planted);
    return to;
}

RowLayout<AnswerRatingRow> ratings_layout() {
    using Row = AnswerRatingRow;
    StudyLayout<Row> to("ratings", "Means of scales and numbers, by each factor's levels and over all.");
    add_answer_of(to);
    to.text("factor", "Factor; n/a: all trials", &Row::factor);
    to.text("level", "Level of it", &Row::level);
    to.count("ratings", "Answers", &Row::ratings);
    to.estimate("mean", "Mean; of all observers the mean of their means, with the interval over observers",
                "", &Row::mean);
    to.number("sd", "Standard deviation of the answers", "", &Row::sd);
    to.number(
        "place",
        "Of scales with steps: place of the level on a continuous quality that the steps cut up, in standard "
        "deviations of a judgement (cumulative probit, maximum likelihood), the factor's first level being "
        "0; n/a: there "
        "is none",
        "", &Row::place);
    to.number("place_se", "Its standard error", "", &Row::place_se);
    to.number("planted", "Of simulated observers: the mean that they mean to give", "", &Row::planted);
    return to;
}

} // namespace overt
