#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "experiment/study/methods/methods_topics.h"
#include "experiment/study/methods/sentences.h"

namespace overt {

std::string answers_text(const StudyResults& results, const StudyOptions& options) {
    const StudyAnswers& answers = results.answers;
    if (answers.given.empty())
        return {};
    std::string text;
    const auto missed =
        std::ranges::count_if(answers.given, [](const StudyAnswer& one) { return one.is_missed; });
    add_sentence(text, fmt::format("observers gave {} answers and missed {}",
                                   static_cast<std::ptrdiff_t>(answers.given.size()) - missed, missed));
    if (std::ranges::any_of(answers.summaries,
                            [](const AnswerSummaryRow& row) { return row.d_prime.has_value(); }))
        add_sentence(text, "d' was reckoned with the log-linear correction of all shares (Hautus, 1995)");
    if (!answers.curves.empty())
        add_sentence(
            text,
            fmt::format("logistic functions were fitted to each observer's answers by maximum likelihood; "
                        "intervals at {:.4g} % are percentiles of 999 samples drawn from the answers to each "
                        "level, with the seed {}, and over observers those of the bootstrap of their "
                        "thresholds",
                        100.0 * options.confidence, options.seed));
    std::set<std::string> methods;
    for (const AnswerScaleRow& row : answers.scales)
        methods.insert(row.method);
    if (methods.contains("MLDS"))
        add_sentence(
            text, "difference scales were fitted by maximum likelihood (Maloney & Yang, 2003) as generalised "
                  "linear "
                  "models with the probit link (Knoblauch & Maloney, 2008), with intervals by 999 parametric "
                  "samples");
    if (methods.contains("Bradley-Terry"))
        add_sentence(text, "paired comparisons were scaled by the model of Bradley and Terry (1952) and by "
                           "Thurstone's Case V, "
                           "with an effect of the first slot");
    if (std::ranges::any_of(answers.scales, &AnswerScaleRow::is_penalised))
        add_sentence(
            text,
            "where answers were so consistent that the likelihood has no maximum, Jeffreys' prior was added "
            "(Firth, 1993)");
    return text;
}

} // namespace overt
