#include "experiment/procedures/quest.h"
#include "experiment/procedures/quest_plus.h"
#include "experiment/proving/known_table.h"

#include <fmt/format.h>

#include "known_answer_tables.h"

namespace overt {

namespace {

std::vector<double> counted(double from, double to) {
    std::vector<double> values;
    for (double one = from; one <= to; one += 1.0)
        values.push_back(one);
    return values;
}

QuestPlusSettings quest_plus_case(std::string_view name) {
    QuestPlusSettings settings;
    if (name == "B") {
        settings.function = QuestFunction::normal;
        settings.levels = counted(-10, 10);
        settings.threshold.values = counted(-5, 5);
        settings.slope.values = counted(1, 6);
        settings.guess.values = settings.lapse.values = {0.02};
        return settings;
    }
    settings.levels = settings.threshold.values = counted(-40, 0);
    settings.slope.values = name == "A" ? std::vector<double>{2, 3, 4, 5} : std::vector<double>{3.5};
    settings.lapse.values = name == "A" ? std::vector<double>{0.0, 0.02, 0.04} : std::vector<double>{0.02};
    if (name == "C")
        for (const double alpha : settings.threshold.values)
            settings.threshold.prior.push_back(std::exp(-0.5 * std::pow((alpha + 15.0) / 6.0, 2)));
    return settings;
}

} // namespace

KnownAnswers known_quest() {
    QuestSettings settings;
    settings.guess = -1.0;
    Quest quest(settings);
    KnownAnswers answers{{"QUEST: shift of the function", 0.00484354, quest.shift(), 5e-9},
                         {"QUEST: order of the quantile", 0.58979247, quest.quantile_order(), 5e-9}};
    WorstAnswer levels("QUEST: level", 1e-8), means("QUEST: mean", 1e-8), sds("QUEST: SD", 1e-8),
        modes("QUEST: mode", 1e-8);
    const KnownTable trace(embedded::quest_trace_csv);
    for (std::size_t row = 0; row < trace.size(); ++row) {
        const double level = quest.next().value_or(NAN);
        levels.add(trace.number(row, "log_intensity"), level);
        quest.tell(level, trace.number(row, "response") > 0.5 ? TrackAnswer::yes : TrackAnswer::no);
        means.add(trace.number(row, "mean"), quest.mean());
        sds.add(trace.number(row, "sd"), quest.sd());
        modes.add(trace.number(row, "mode"), quest.mode());
    }
    levels.add(-0.94790558, quest.next().value_or(NAN));
    for (const WorstAnswer* one : {&levels, &means, &sds, &modes})
        answers.push_back(one->answer());
    return answers;
}

KnownAnswers known_quest_plus() {
    using Parameter = QuestPlus::Parameter;
    KnownAnswers answers;
    const KnownTable traces(embedded::questplus_traces_csv);
    for (const std::string_view name : {"A", "B", "C"}) {
        QuestPlus track(quest_plus_case(name));
        const auto worst = [&](std::string_view what, double tolerance) {
            return WorstAnswer(fmt::format("QUEST+ {}: {}", name, what), tolerance);
        };
        WorstAnswer levels = worst("level", 0.0), expected = worst("expected entropy, bits", 1e-6),
                    after = worst("entropy after the answer, bits", 1e-6),
                    first = worst("mean of threshold", 1e-6), second = worst("mean of slope", 1e-6),
                    third = worst("mean of lapse", 1e-6);
        for (std::size_t row = 0; row < traces.size(); ++row) {
            if (traces.text(row, "case") != name)
                continue;
            const double level = track.next().value_or(NAN);
            levels.add(traces.number(row, "stimulus"), level);
            expected.add(traces.number(row, "expected_entropy_bits"), track.expected_entropy_bits());
            track.tell(level, traces.number(row, "correct") > 0.5 ? TrackAnswer::yes : TrackAnswer::no);
            after.add(traces.number(row, "entropy_after_bits"), track.entropy_bits());
            first.add(traces.number(row, "mean_p1"), track.estimate(Parameter::threshold).mean);
            second.add(traces.number(row, "mean_p2"), track.estimate(Parameter::slope).mean);
            third.add(traces.number(row, "mean_lapse"), track.estimate(Parameter::lapse).mean);
        }
        for (const WorstAnswer* one : {&levels, &expected, &after, &first, &second, &third})
            answers.push_back(one->answer());
        const auto known = [&](std::string_view what, double value, double ours, double tolerance) {
            answers.push_back({fmt::format("QUEST+ {}: {}", name, what), value, ours, tolerance});
        };
        const ParameterEstimate threshold = track.estimate(Parameter::threshold);
        if (name == "A") {
            known("SD of threshold", 5.024497, threshold.sd, 1e-6);
            known("SD of slope", 1.116562, track.estimate(Parameter::slope).sd, 1e-6);
            known("SD of lapse", 0.016325, track.estimate(Parameter::lapse).sd, 1e-6);
            known("mode of threshold", -21.0, threshold.mode, 0.0);
            known("mode of slope", 5.0, track.estimate(Parameter::slope).mode, 0.0);
            known("mode of lapse", 0.0, track.estimate(Parameter::lapse).mode, 0.0);
        } else if (name == "B") {
            known("mode of threshold", -2.0, threshold.mode, 0.0);
            known("mode of slope", 2.0, track.estimate(Parameter::slope).mode, 0.0);
        } else {
            known("SD of threshold", 2.595512, threshold.sd, 1e-6);
        }
    }
    return answers;
}

} // namespace overt
