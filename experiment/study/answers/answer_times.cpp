#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "experiment/fits/response_time_fit.h"
#include "experiment/statistics/bootstrap.h"
#include "experiment/study/answers/answer_results.h"

namespace overt {

namespace {

constexpr std::size_t least_times_for_shape = 40;
constexpr int speed_parts = 5;
constexpr std::size_t least_times_of_part = 10;

void add_shapes(AnswerTimeRow& row, std::span<const double> times) {
    if (times.size() < least_times_for_shape)
        return;
    if (const auto fit = fit_ex_gaussian(times)) {
        row.ex_mu_s = fit->mu;
        row.ex_sigma_s = fit->sigma;
        row.ex_tau_s = fit->tau;
        row.ex_log_likelihood = fit->log_likelihood;
    }
    if (const auto fit = fit_shifted_log_normal(times)) {
        row.shift_s = fit->shift;
        row.log_mean = fit->mu;
        row.log_sd = fit->sigma;
        row.log_normal_log_likelihood = fit->log_likelihood;
    }
}

std::optional<AnswerTimeRow> time_row(const AnswerOf& of, const std::string& which,
                                      const std::vector<const StudyAnswer*>& given, const auto& is_one,
                                      const StudyOptions& options) {
    AnswerTimeRow row;
    row.of = of;
    row.which = which;
    std::vector<double> times;
    std::map<std::string, std::vector<double>> by_observer;
    for (const StudyAnswer* one : given) {
        if (!one->response_s || !is_one(*one))
            continue;
        times.push_back(*one->response_s);
        by_observer[one->observer].push_back(*one->response_s);
    }
    if (times.empty())
        return std::nullopt;
    row.times = static_cast<int>(times.size());
    std::ranges::sort(times);
    double sum = 0.0, squares = 0.0;
    for (const double time : times)
        sum += time;
    const double mean = sum / row.times;
    for (const double time : times)
        squares += (time - mean) * (time - mean);
    row.mean_s = mean;
    if (row.times > 1)
        row.sd_s = std::sqrt(squares / (row.times - 1));
    for (const double share : response_quantiles)
        row.quantiles_s.push_back(quantile_of_sorted(times, share));
    if (!of.observer.empty()) {
        row.median_s = Estimate::of(quantile_of_sorted(times, 0.5));
        add_shapes(row, times);
    } else {
        std::vector<double> medians;
        for (auto& [observer, own] : by_observer) {
            std::ranges::sort(own);
            medians.push_back(quantile_of_sorted(own, 0.5));
        }
        row.median_s = estimated_mean(medians, options.bootstrap(), "no response times", from_zero_on);
    }
    return row;
}

/// An observer's share of correct answers and mean time in each part, from the fastest on.
struct SpeedPart {
    double correct = 0.0, mean_s = 0.0;
    int trials = 0;
};

std::vector<SpeedPart> speed_parts_of(const std::vector<const StudyAnswer*>& given) {
    std::vector<std::pair<double, bool>> times;
    for (const StudyAnswer* one : given)
        if (one->response_s && one->is_correct)
            times.emplace_back(*one->response_s, *one->is_correct);
    if (times.size() < speed_parts * least_times_of_part)
        return {};
    std::ranges::stable_sort(times, {}, &std::pair<double, bool>::first);
    std::vector<SpeedPart> parts(speed_parts);
    for (std::size_t i = 0; i < times.size(); ++i) {
        SpeedPart& part = parts[i * speed_parts / times.size()];
        part.correct += times[i].second ? 1.0 : 0.0;
        part.mean_s += times[i].first;
        ++part.trials;
    }
    for (SpeedPart& part : parts) {
        part.correct /= part.trials;
        part.mean_s /= part.trials;
    }
    return parts;
}

} // namespace

std::vector<AnswerTimeRow> answer_times(const AnswersBy& answers, const StudyOptions& options) {
    std::vector<AnswerTimeRow> rows;
    for (const auto& [of, given] : answers) {
        const auto add = [&](const std::string& which, const auto& is_one) {
            if (auto row = time_row(of, which, given, is_one, options))
                rows.push_back(*std::move(row));
        };
        add("all", [](const StudyAnswer&) { return true; });
        if (std::ranges::any_of(given, [](const StudyAnswer* one) { return one->is_correct.has_value(); })) {
            add("correct", [](const StudyAnswer& one) { return one.is_correct == true; });
            add("wrong", [](const StudyAnswer& one) { return one.is_correct == false; });
            continue;
        }
        std::set<std::string> choices;
        for (const StudyAnswer* one : given)
            if (!one->is_missed && asks_for_choice(*one))
                choices.insert(one->value);
        for (const std::string& choice : choices)
            add(choice, [&](const StudyAnswer& one) { return one.value == choice; });
    }
    return rows;
}

std::vector<AnswerSpeedRow> answer_speeds(const AnswersBy& answers, const StudyOptions& options) {
    std::vector<AnswerSpeedRow> rows;
    std::map<AnswerOf, std::vector<std::vector<SpeedPart>>> of_all;
    for (const auto& [of, given] : answers) {
        if (of.observer.empty())
            continue;
        const std::vector<SpeedPart> parts = speed_parts_of(given);
        if (parts.empty())
            continue;
        AnswerOf together = of;
        together.observer.clear();
        of_all[together].push_back(parts);
        for (int i = 0; i < speed_parts; ++i) {
            const SpeedPart& part = parts[static_cast<std::size_t>(i)];
            rows.push_back({of, i + 1, speed_parts, part.trials, Estimate::of(part.correct), part.mean_s});
        }
    }
    std::vector<AnswerSpeedRow> all;
    for (const auto& [of, observers] : of_all)
        for (int i = 0; i < speed_parts; ++i) {
            AnswerSpeedRow& row = all.emplace_back(AnswerSpeedRow{of, i + 1, speed_parts, 0, {}, 0.0});
            std::vector<double> correct;
            for (const std::vector<SpeedPart>& parts : observers) {
                const SpeedPart& part = parts[static_cast<std::size_t>(i)];
                correct.push_back(part.correct);
                row.trials += part.trials;
                *row.mean_response_s += part.mean_s / static_cast<double>(observers.size());
            }
            row.correct = estimated_mean(correct, options.bootstrap(), "", zero_to_one);
        }
    rows.insert(rows.begin(), all.begin(), all.end());
    return rows;
}

std::vector<AnswerTrackRow> answer_tracks(std::span<const StudyAnswer> answers) {
    // A procedure reads one answer, and all answers of a trial stand beside the level it chose.
    std::map<std::tuple<AnswerOf, std::string, int>, std::vector<const StudyAnswer*>> tracks;
    for (const StudyAnswer& one : answers)
        if (!one.procedure.empty() && one.item.empty())
            tracks[{{one.observer, one.task, one.answer, ""}, one.procedure, one.track}].push_back(&one);
    std::vector<AnswerTrackRow> rows;
    for (const auto& [key, own] : tracks) {
        const auto& [of, procedure, track] = key;
        const std::size_t from = rows.size();
        for (const StudyAnswer* one : own) {
            // The level that was chosen is the one that is not the standard's: that which changes.
            std::optional<double> level;
            for (const AnsweredStimulus& shown : one->shown) {
                const std::optional<double> number = shown.number(one->procedure_factor);
                const bool is_side = shown.slot == one->level("side") || one->shown.size() == 1;
                if (number && (is_side || !level))
                    level = number;
            }
            if (!level)
                continue;
            AnswerTrackRow& row = rows.emplace_back();
            row.of = of;
            row.procedure = procedure;
            row.factor = one->procedure_factor;
            row.track = track;
            row.place = static_cast<int>(rows.size() - from);
            row.trial = one->trial;
            row.level = *level;
            row.value = one->is_missed ? std::string() : one->value;
            row.is_correct = one->is_correct;
        }
        // A reversal is where the level that follows lies on the other side than the one before.
        for (std::size_t i = from + 1; i + 1 < rows.size(); ++i) {
            double before = 0.0;
            for (std::size_t k = i; k-- > from && before == 0.0;)
                before = rows[i].level - rows[k].level;
            rows[i].is_reversal = before * (rows[i + 1].level - rows[i].level) < 0.0;
        }
    }
    return rows;
}

} // namespace overt
