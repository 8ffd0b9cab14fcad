#include "experiment/study/tables/answer_layouts.h"

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
    to.number("ex_mu_s",
              "Of the ex-Gaussian by maximum likelihood, with 40 times at least: mean of its normal part",
              "s", &Row::ex_mu_s);
    to.number("ex_sigma_s", "Standard deviation of its normal part", "s", &Row::ex_sigma_s);
    to.number("ex_tau_s", "Mean of its exponential part", "s", &Row::ex_tau_s);
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
        "by maximum likelihood; of all observers the mean of their thresholds.");
    add_answer_of(to);
    to.text("factor", "Factor whose levels are x", &Row::factor);
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
    return to;
}

} // namespace overt
