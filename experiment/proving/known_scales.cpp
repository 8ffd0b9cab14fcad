#include "experiment/fits/difference_scaling.h"
#include "experiment/fits/pair_scaling.h"
#include "experiment/proving/known_table.h"

#include <fmt/format.h>
#include <numbers>

#include "known_answer_tables.h"

namespace overt {

namespace {

std::vector<DifferenceCount> difference_counts(std::string_view text) {
    const KnownTable table(text);
    std::vector<DifferenceCount> counts;
    for (std::size_t row = 0; row < table.size(); ++row) {
        DifferenceCount& one = counts.emplace_back();
        for (const std::string& column : table.header())
            if (column.front() == 'S')
                one.places.push_back(static_cast<int>(table.number(row, column)) - 1);
        one.trials = table.number(row, "n");
        one.upper = table.number(row, "k");
    }
    return counts;
}

void add_difference_scale(KnownAnswers& answers, std::string_view name, std::string_view text,
                          const std::vector<double>& raw, const std::vector<double>& errors,
                          const std::vector<double>& normalised, double sigma, double log_likelihood) {
    const auto levels = static_cast<int>(raw.size()) + 1;
    const std::optional<DifferenceScale> scale = fit_difference_scale(difference_counts(text), levels);
    WorstAnswer coefficients(fmt::format("MLDS {}: coefficient", name), 2e-6),
        se(fmt::format("MLDS {}: SE", name), 1e-5),
        values(fmt::format("MLDS {}: normalised scale", name), 1e-6);
    for (std::size_t i = 0; i < raw.size(); ++i) {
        coefficients.add(raw[i], scale ? scale->raw[i + 1] : NAN);
        se.add(errors[i], scale ? scale->raw_se[i + 1] : NAN);
        values.add(normalised[i], scale ? scale->scale[i + 1] : NAN);
    }
    for (const WorstAnswer* one : {&coefficients, &se, &values})
        answers.push_back(one->answer());
    answers.push_back({fmt::format("MLDS {}: sigma", name), sigma, scale ? scale->sigma : NAN, 1e-6});
    answers.push_back({fmt::format("MLDS {}: log-likelihood", name), log_likelihood,
                       scale ? scale->log_likelihood : NAN, 1e-6});
}

} // namespace

KnownAnswers known_scales() {
    KnownAnswers answers;
    add_difference_scale(answers, "triads", embedded::mlds_triads_csv,
                         {0.666165, 1.828360, 3.619914, 5.984069}, {0.284576, 0.457217, 0.775097, 1.297588},
                         {0.111323, 0.305538, 0.604925, 1.0}, 0.167110, -42.933420);
    add_difference_scale(answers, "quadruples", embedded::mlds_quads_csv,
                         {0.253332, 0.627625, 1.280040, 2.340966, 3.375373},
                         {0.198330, 0.287434, 0.388599, 0.522249, 0.709760},
                         {0.075053, 0.185942, 0.379229, 0.693543, 1.0}, 0.296264, -103.771094);
    const KnownTable table(embedded::pairs_wins_csv);
    std::vector<PairCount> pairs;
    std::vector<std::vector<double>> wins;
    for (std::size_t i = 0; i < table.size(); ++i) {
        std::vector<double>& row = wins.emplace_back();
        for (std::size_t j = 0; j < table.size(); ++j)
            row.push_back(table.number(i, table.header()[j + 1]));
    }
    for (std::size_t i = 0; i < wins.size(); ++i)
        for (std::size_t j = i + 1; j < wins.size(); ++j)
            pairs.push_back({i, j, wins[i][j] + wins[j][i], wins[i][j]});
    const auto compare = [&](const std::string& what, const std::vector<double>& known,
                             const std::vector<double>& ours) {
        WorstAnswer worst(what, 2e-6);
        for (std::size_t i = 0; i < known.size(); ++i)
            worst.add(known[i], i < ours.size() ? ours[i] : NAN);
        answers.push_back(worst.answer());
    };
    const std::optional<PairScale> terry = fit_pairs(pairs, wins.size(), PairModel::bradley_terry);
    const std::optional<PairScale> thurstone = fit_pairs(pairs, wins.size(), PairModel::thurstone);
    const PairScale none;
    const PairScale& logit = terry ? *terry : none;
    const PairScale& probit = thurstone ? *thurstone : none;
    compare("Bradley-Terry: centred", {-1.070331, -0.558276, -0.044956, 0.657011, 1.016551}, logit.centred);
    compare("Bradley-Terry: SE, centred", {0.223329, 0.202640, 0.195219, 0.205421, 0.220273},
            logit.centred_se);
    compare("Bradley-Terry: from the first item", {0, 0.512055, 1.025374, 1.727342, 2.086882},
            logit.from_first);
    compare("Bradley-Terry: SE, from the first item", {0, 0.325114, 0.329458, 0.348915, 0.364915},
            logit.from_first_se);
    answers.push_back({"Bradley-Terry: deviance", 1.280193, logit.deviance, 1e-6});
    answers.push_back({"Bradley-Terry: degrees of freedom", 6, static_cast<double>(logit.degrees), 0.0});
    compare("Thurstone Case V: centred", {-0.914550, -0.482044, -0.038040, 0.563331, 0.871303},
            probit.centred);
    std::vector<double> of_difference;
    for (const double one : probit.centred)
        of_difference.push_back(one / std::numbers::sqrt2);
    compare("Thurstone Case V: centred, in noise of a difference",
            {-0.646685, -0.340857, -0.026898, 0.398335, 0.616104}, of_difference);
    answers.push_back({"Thurstone Case V: deviance", 1.158388, probit.deviance, 1e-6});
    compare("Thurstone Case V by least squares", {-0.649164, -0.350074, -0.025537, 0.401148, 0.623627},
            row_mean_scale(wins).value_or(std::vector<double>{}));
    const CircularTriads circular = circular_triads({{false, true, false, true, false},
                                                     {false, false, true, true, true},
                                                     {true, false, false, false, true},
                                                     {false, false, true, false, false},
                                                     {true, false, false, true, false}});
    answers.push_back({"circular triads", 4, circular.count, 0.0});
    answers.push_back({"circular triads, most", 5, circular.most, 0.0});
    answers.push_back({"circular triads, expected of guesses", 2.5, circular.expected, 0.0});
    answers.push_back({"circular triads: consistency", 0.2, circular.consistency, 1e-12});
    return answers;
}

} // namespace overt
