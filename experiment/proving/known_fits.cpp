#include "experiment/fits/psychometric_fit.h"
#include "experiment/proving/known_table.h"

#include <fmt/format.h>

#include "known_answer_tables.h"

namespace overt {

namespace {

std::vector<LevelCount> counts_of(std::string_view data) {
    const KnownTable table(data == "mcs_2afc" ? embedded::mcs_2afc_csv : embedded::mcs_yesno_csv);
    std::vector<LevelCount> counts;
    for (std::size_t row = 0; row < table.size(); ++row)
        counts.push_back({table.number(row, "x"), table.number(row, "n"), table.number(row, "k")});
    return counts;
}

CurveShape shape_called(std::string_view name) {
    return name == "weibull"    ? CurveShape::weibull
           : name == "logistic" ? CurveShape::logistic
                                : CurveShape::normal;
}

} // namespace

KnownAnswers known_psychometric_fits() {
    KnownAnswers answers;
    const KnownTable expected(embedded::mcs_expected_csv);
    for (std::size_t row = 0; row < expected.size(); ++row) {
        const std::string data = expected.text(row, "data"), lapse = expected.text(row, "lapse");
        PsychometricModel model;
        model.shape = shape_called(expected.text(row, "function"));
        model.guess.value = expected.number(row, "guess");
        const bool is_free = lapse == "free";
        model.lapse = is_free ? Asymptote{0.02, true, 0.0, 0.2} : Asymptote{expected.number(row, "lapse")};
        const std::optional<PsychometricFit> fit = fit_psychometric(counts_of(data), model);
        const std::string named =
            fmt::format("{}, {}, lapse {}: ", data, expected.text(row, "function"), lapse);
        const auto known = [&](std::string_view what, std::string_view column, std::optional<double> ours,
                               double tolerance) {
            answers.push_back(
                {named + std::string(what), expected.number(row, column), ours.value_or(NAN), tolerance});
        };
        if (!fit) {
            known("alpha", "p1", {}, 0.0);
            continue;
        }
        // Programs stop at the maximum to about this; the likelihood and the deviance are flat there.
        const double near = is_free ? 2e-5 : 5e-6, error = is_free ? 2e-4 : 5e-6;
        known("alpha", "p1", fit->alpha.value, near);
        known("beta", "p2", fit->beta.value, near);
        known("SE of alpha, observed", "se_obs1", fit->alpha.se_observed, error);
        known("SE of beta, observed", "se_obs2", fit->beta.se_observed, error);
        known("SE of alpha, expected", "se_exp1", fit->alpha.se_expected, error);
        known("SE of beta, expected", "se_exp2", fit->beta.se_expected, error);
        if (is_free) {
            known("lapse", "p3", fit->lapse.value, near);
            known("SE of lapse, observed", "se_obs3", fit->lapse.se_observed, error);
            known("SE of lapse, expected", "se_exp3", fit->lapse.se_expected, error);
        }
        known("log-likelihood", "logLik_kernel", fit->log_likelihood, 1e-6);
        known("deviance", "deviance", fit->deviance, 1e-6);
        known("Pearson X2", "X2", fit->pearson_x2, 2e-5);
        known("degrees of freedom", "df", fit->degrees, 0.0);
    }
    PsychometricModel weibull{CurveShape::weibull, {0.5}, {0.02}};
    const auto fit = fit_psychometric(counts_of("mcs_2afc"), weibull);
    for (const auto& [psi, level, error] :
         {std::array{0.75, 1.882904, 0.236574}, std::array{0.82, 2.344995, 0.251762}}) {
        const auto threshold = fit ? fit->threshold(psi) : std::nullopt;
        answers.push_back({fmt::format("mcs_2afc, weibull, lapse 0.02: threshold at {}", psi), level,
                           threshold ? threshold->level : NAN, 2e-6});
        answers.push_back({fmt::format("mcs_2afc, weibull, lapse 0.02: SE of the threshold at {}", psi),
                           error, threshold ? threshold->se.value_or(NAN) : NAN, 5e-6});
    }
    constexpr double shares[] = {0.530322, 0.599203, 0.684653, 0.768897, 0.894310, 0.953969, 0.978938};
    WorstAnswer curve("mcs_2afc, weibull, lapse 0.02: share at a level", 1e-6);
    const std::vector<LevelCount> counts = counts_of("mcs_2afc");
    for (std::size_t i = 0; i < counts.size(); ++i)
        curve.add(shares[i], fit ? fit->share_at(counts[i].level) : NAN);
    answers.push_back(curve.answer());
    // lambda = gamma free goes to its bound.
    PsychometricModel bounded{CurveShape::logistic, {0.0}, {0.02, true}};
    const auto at_bound = fit_psychometric(counts_of("mcs_yesno"), bounded);
    answers.push_back(
        {"mcs_yesno, logistic, free lapse: at its bound", 0.0, at_bound ? at_bound->lapse.value : NAN, 0.0});
    answers.push_back({"mcs_yesno, logistic, free lapse: has no SE", 1.0,
                       at_bound && at_bound->lapse.is_at_bound && !at_bound->lapse.se_observed ? 1.0 : 0.0,
                       0.0});
    return answers;
}

} // namespace overt
