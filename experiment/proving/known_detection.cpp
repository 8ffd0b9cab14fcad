#include "experiment/fits/detection.h"
#include "experiment/proving/known_table.h"

#include <fmt/format.h>

#include "known_answer_tables.h"

namespace overt {

KnownAnswers known_detection() {
    struct Column {
        std::string_view name;
        DetectionDesign design;
        int alternatives = 2;
    };
    constexpr Column columns[] = {{"yesno_unbiased", DetectionDesign::yes_no},
                                  {"afc2", DetectionDesign::alternatives, 2},
                                  {"afc3", DetectionDesign::alternatives, 3},
                                  {"afc4", DetectionDesign::alternatives, 4},
                                  {"afc6", DetectionDesign::alternatives, 6},
                                  {"afc8", DetectionDesign::alternatives, 8},
                                  {"abx_diff", DetectionDesign::abx_differencing},
                                  {"abx_io", DetectionDesign::abx_independent},
                                  {"oddity3", DetectionDesign::oddity},
                                  {"samediff_io", DetectionDesign::same_different_independent}};
    KnownAnswers answers;
    const KnownTable table(embedded::dprime_tables_csv);
    for (const Column& column : columns) {
        WorstAnswer shares(fmt::format("d': share correct, {}", column.name), 1e-6),
            inverse(fmt::format("d': of a share correct, {}", column.name), 4e-5);
        for (std::size_t row = 0; row < table.size(); ++row) {
            const double d = table.number(row, "dprime");
            shares.add(table.number(row, column.name), correct_share(column.design, d, column.alternatives));
            inverse.add(d,
                        d_prime_of_share(column.design, correct_share(column.design, d, column.alternatives),
                                         column.alternatives)
                            .value_or(NAN));
        }
        answers.push_back(shares.answer());
        answers.push_back(inverse.answer());
    }
    for (const double alarms : {0.1, 0.2}) {
        WorstAnswer hits(fmt::format("d': hits, same-different by differencing at F = {}", alarms), 1e-6);
        for (std::size_t row = 0; row < table.size(); ++row)
            hits.add(table.number(row, fmt::format("sd_diff_H_at_F{}", alarms)),
                     same_different_hits(table.number(row, "dprime"), alarms));
        answers.push_back(hits.answer());
    }
    const auto known = [&](std::string what, double value, double ours) {
        answers.push_back({std::move(what), value, ours, 1e-6});
    };
    const auto raw = [](DetectionCounts counts) { return yes_no(counts, ShareCorrection::none); };
    const auto log_linear = [](DetectionCounts counts) {
        return yes_no(counts, ShareCorrection::log_linear);
    };
    const DetectionCounts first{20, 5, 6, 19}, second{40, 10, 2, 48}, third{25, 0, 3, 22};
    known("yes-no 20 5 6 19: d'", 1.547924, raw(first).d_prime);
    known("yes-no 20 5 6 19: c", -0.067659, raw(first).criterion);
    known("yes-no 20 5 6 19: SE", 0.396421, raw(first).se.value_or(NAN));
    known("yes-no 20 5 6 19: d' log-linear", 1.475584, log_linear(first).d_prime);
    known("yes-no 20 5 6 19: c log-linear", -0.063302, log_linear(first).criterion);
    known("yes-no 40 10 2 48: d'", 2.592307, raw(second).d_prime);
    known("yes-no 40 10 2 48: c", 0.454532, raw(second).criterion);
    known("yes-no 40 10 2 48: SE", 0.379801, raw(second).se.value_or(NAN));
    known("yes-no 40 10 2 48: d' log-linear", 2.475227, log_linear(second).d_prime);
    known("yes-no 40 10 2 48: c log-linear", 0.416821, log_linear(second).criterion);
    known("yes-no 25 0 3 22: d' log-linear", 3.174738, log_linear(third).d_prime);
    known("yes-no 25 0 3 22: c log-linear", -0.482533, log_linear(third).criterion);
    known("yes-no 25 0 3 22: d' with 1/(2N)", 3.228736, yes_no(third, ShareCorrection::extreme).d_prime);
    known("yes-no 25 0 3 22: c with 1/(2N)", -0.439381, yes_no(third, ShareCorrection::extreme).criterion);
    answers.push_back(
        {"yes-no 25 0 3 22: d' raw is infinite", 1.0, std::isinf(raw(third).d_prime) ? 1.0 : 0.0, 0.0});
    return answers;
}

} // namespace overt
