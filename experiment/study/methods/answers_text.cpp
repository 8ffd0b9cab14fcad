#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "experiment/study/methods/methods_topics.h"
#include "experiment/study/methods/sentences.h"

namespace overt {

namespace {

/// Of the bootstraps of functions and difference scales.
constexpr int function_samples = 999;

std::string guess_rates(const StudyAnswers& answers) {
    std::set<double> rates;
    for (const AnswerCurveRow& row : answers.curves)
        rates.insert(row.guess);
    std::vector<std::string> words;
    for (const double rate : rates)
        words.push_back(as_set(rate));
    return joined_words(words);
}

} // namespace

std::string answers_text(const StudyResults& results, const StudyOptions& options) {
    const StudyAnswers& answers = results.answers;
    if (answers.given.empty())
        return {};
    std::string text;
    const auto missed =
        std::ranges::count_if(answers.given, [](const StudyAnswer& one) { return one.is_missed; });
    const auto given = static_cast<std::int64_t>(answers.given.size()) - missed;
    add_sentence(text, fmt::format("{} {} given and {} missed", as_counted(given, "answer"),
                                   given == 1 ? "was" : "were", as_count(missed)));
    std::map<std::string, std::set<std::pair<std::string, int>>> tracks; ///< by procedure
    for (const AnswerTrackRow& row : answers.tracks)
        tracks[row.procedure].insert({row.of.observer, row.track});
    for (const auto& [procedure, own] : tracks)
        add_sentence(text, fmt::format("the procedure {} chose the level of the next trial in {}", procedure,
                                       as_counted(static_cast<std::int64_t>(own.size()), "track")));
    if (std::ranges::any_of(answers.summaries,
                            [](const AnswerSummaryRow& row) { return row.d_prime || row.design_d_prime; }))
        add_sentence(text, "d' was reckoned with the log-linear correction of all shares (Hautus, 1995)");
    std::set<std::string> designs;
    for (const AnswerSummaryRow& row : answers.summaries)
        if (row.design_d_prime)
            designs.insert(fmt::format("\"{}\"", row.design));
    if (!designs.empty())
        add_sentence(text,
                     fmt::format("by what was shown in the trials, answers came about as in the design {}, "
                                 "of which d' is given as well",
                                 joined_words(std::vector(designs.begin(), designs.end()))));
    if (!answers.curves.empty())
        add_sentence(
            text,
            fmt::format(
                "logistic functions were fitted to each observer's answers by maximum likelihood, with "
                "a guess rate of {}; intervals of {} % are percentiles of {} samples drawn from the "
                "answers to each level, with the seed {}, and over observers those of the bootstrap of "
                "their thresholds",
                guess_rates(answers), as_set(100.0 * options.confidence), function_samples, options.seed));
    std::set<std::string> methods;
    for (const AnswerScaleRow& row : answers.scales)
        methods.insert(row.method);
    if (methods.contains("MLDS"))
        add_sentence(text, fmt::format("difference scales were fitted by maximum likelihood (Maloney & Yang, "
                                       "2003) as generalised linear models with the probit link (Knoblauch & "
                                       "Maloney, 2008), with intervals by {} parametric samples",
                                       function_samples));
    if (methods.contains("Bradley-Terry"))
        add_sentence(text, "paired comparisons were scaled by the model of Bradley and Terry (1952) and by "
                           "Thurstone's Case V, with an effect of the first slot");
    if (std::ranges::any_of(answers.scales, &AnswerScaleRow::is_penalised))
        add_sentence(
            text,
            "where answers were so consistent that the likelihood has no maximum, Jeffreys' prior was added "
            "(Firth, 1993)");
    if (std::ranges::any_of(answers.times, [](const AnswerTimeRow& row) { return row.ex_mu_s.has_value(); }))
        add_sentence(text, "ex-Gaussian and shifted log-normal distributions were fitted to each observer's "
                           "response times by maximum likelihood");
    if (std::ranges::any_of(answers.differences,
                            [](const AnswerDifferenceRow& row) { return row.p.has_value(); }))
        add_sentence(text, "levels of factors were compared within observers, by flips of the signs of their "
                           "differences, and each p is given as it is and after Holm's correction for the "
                           "levels and factors that are compared by the same measure");
    if (!answers.gaze.empty())
        add_sentence(text, "what was looked at before an answer are counted fixations that began before it, "
                           "up to it");
    if (std::ranges::any_of(answers.gaze_choices,
                            [](const GazeChoiceRow& row) { return row.measure == "dwell share"; }))
        add_sentence(text,
                     "how much the chosen stimulus was looked at is compared with what it would be if "
                     "each observer chose each slot as often, and looked at it as much, independently of "
                     "each other");
    if (std::ranges::any_of(results.reliefs.reliefs,
                            [](const ReliefRow& row) { return row.gain.has_value(); }))
        add_sentence(text,
                     "settings of gauges at a place were averaged as unit normals and put together to a "
                     "relief by least squares over neighbouring places, in the camera's perspective "
                     "(after Koenderink, van Doorn & Kappers, 1992; Wijntjes, 2012); its depth is compared "
                     "with the true one by regression, with and without shears (Belhumeur, Kriegman & "
                     "Yuille, 1999)");
    if (std::ranges::any_of(results.points.spreads,
                            [](const PointSpreadRow& row) { return row.between_mm.value.has_value(); }))
        add_sentence(text,
                     "places that were pointed at were found on the surface by the frame that was lit "
                     "then; the mean distance of two observers' places, straight through space, has the "
                     "interval of the jackknife over observers (Arvesen, 1969), and is compared with "
                     "that of places drawn evenly from the object's pictures");
    if (std::ranges::any_of(results.answer_maps, [](const DifferenceMap& map) { return map.absent.empty(); }))
        add_sentence(text, "where gaze before one answer differs from gaze before another was tested on the "
                           "surface by clusters within observers");
    return text;
}

} // namespace overt
