#include "experiment/study/methods/headline.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "experiment/base/text_number.h"
#include "experiment/scene/areas.h"
#include "experiment/statistics/bootstrap.h"
#include "experiment/study/methods/sentences.h"
#include "experiment/study/results/study_groups.h"

namespace overt {

namespace {

/// "0.21 (95 % interval 0.19 to 0.23)".
std::string with_interval(const Estimate& of, double confidence, double scale = 1.0, const char* unit = "") {
    const auto text = [&](double number) { return fmt::format("{:.3g}", scale * number); };
    std::string words = text(of.value.value_or(0.0)) + unit;
    if (of.interval)
        words += fmt::format(" ({} % interval {} to {}{})", as_set(100.0 * confidence),
                             text(of.interval->low), text(of.interval->high), unit);
    return words;
}

std::string over(int observers) { return fmt::format("over {}", as_counted(observers, "observer")); }

/// An answer of which there may be a result, with the number of its observers.
struct FirstAnswer {
    AnswerOf of;
    int observers = 0;
    bool is_judged = false; ///< right or wrong
};

/// In the order of the protocol's tasks, since that of trials is drawn; of a task as the data have them.
std::vector<FirstAnswer> answers_in_order(const StudyResults& results) {
    const StudyAnswers& answers = results.answers;
    std::vector<FirstAnswer> found;
    std::map<AnswerOf, std::set<std::string>> observers;
    for (const StudyAnswer& one : answers.given) {
        const AnswerOf of{"", one.task, one.answer, one.item};
        auto known = std::ranges::find(found, of, &FirstAnswer::of);
        if (known == found.end())
            known = found.insert(found.end(), {of, 0, false});
        known->is_judged = known->is_judged || one.is_correct.has_value();
        observers[of].insert(one.observer);
        known->observers = static_cast<int>(observers[of].size());
    }
    const std::vector<NamedThing> tasks = tasks_asked(results);
    std::ranges::stable_sort(found, {}, [&](const FirstAnswer& one) {
        return std::ranges::find(tasks, one.of.task, &NamedThing::id) - tasks.begin();
    });
    return found;
}

template <class Row>
const Row* row_of_all(const std::vector<Row>& rows, const AnswerOf& of, const auto& fits) {
    const auto found = std::ranges::find_if(rows, [&](const Row& row) { return row.of == of && fits(row); });
    return found == rows.end() ? nullptr : &*found;
}

std::string named_answer(const AnswerOf& of) {
    return of.item.empty() ? fmt::format("\"{}\"", of.answer) : fmt::format("\"{}\"", of.item);
}

std::string curve_sentence(const StudyAnswers& answers, const FirstAnswer& first, double confidence) {
    const AnswerCurveRow* const curve = row_of_all(answers.curves, first.of, [](const AnswerCurveRow& row) {
        return row.column.empty() && row.threshold.value && !row.yes.starts_with("the first slot");
    });
    if (!curve)
        return {};
    return fmt::format("the threshold of {} is {}, {}", curve->factor,
                       with_interval(curve->threshold, confidence), over(first.observers));
}

std::string match_sentence(const StudyAnswers& answers, const FirstAnswer& first, double confidence) {
    const AnswerMatchLineRow* const line =
        row_of_all(answers.match_lines, first.of, [](const AnswerMatchLineRow& row) {
            return row.column.empty() && row.slope.value.has_value();
        });
    if (!line)
        return {};
    return fmt::format("the slope of matches of {} over references is {}, {}", line->along,
                       with_interval(line->slope, confidence), over(first.observers));
}

std::string scale_sentence(const StudyAnswers& answers, const FirstAnswer& first, double confidence) {
    const AnswerScaleRow *least = nullptr, *most = nullptr;
    std::string method;
    for (const AnswerScaleRow& row : answers.scales) {
        if (row.of != first.of || !row.value.value || (!method.empty() && row.method != method))
            continue;
        method = row.method;
        least = !least || *row.value.value < *least->value.value ? &row : least;
        most = !most || *row.value.value > *most->value.value ? &row : most;
    }
    if (!least || least == most || method == "MLDS")
        return {};
    return fmt::format("on the scale of {} ({}) {} lies highest, at {}, and {} lowest, at {}", most->factor,
                       method, most->level, with_interval(most->value, confidence), least->level,
                       with_interval(least->value, confidence));
}

std::string noise_sentence(const StudyAnswers& answers, const FirstAnswer& first) {
    const AnswerScaleRow* const row = row_of_all(answers.scales, first.of, [](const AnswerScaleRow& one) {
        return one.method == "MLDS" && one.sigma;
    });
    if (!row)
        return {};
    return fmt::format("the difference scale of {} has a judgement noise of {:.3g} of its range, {}",
                       row->factor, *row->sigma, over(first.observers));
}

/// How far settings of a gauge are from the surface's own normals: the mean over observers of theirs.
std::string gauge_sentence(const StudyResults& results, const FirstAnswer& first,
                           const StudyOptions& options) {
    std::map<std::string, std::pair<double, double>> observers; ///< sums over settings, and their number
    for (const ReliefRow& row : results.reliefs.reliefs) {
        if (row.of.observer.empty() || row.of.task != first.of.task || row.of.answer != first.of.answer ||
            !row.deviation_deg)
            continue;
        auto& [sum, settings] = observers[row.of.observer];
        sum += *row.deviation_deg * row.settings;
        settings += row.settings;
    }
    std::vector<double> means;
    for (const auto& [observer, sums] : observers)
        means.push_back(sums.first / sums.second);
    const Estimate mean =
        estimated_mean(means, options.bootstrap(), "no setting has a normal beside it", {0.0, 180.0});
    if (!mean.value)
        return {};
    return fmt::format("settings of {} lie {} from the surface's own normals in the mean, {}",
                       named_answer(first.of), with_interval(mean, options.confidence, 1.0, " deg"),
                       over(static_cast<int>(means.size())));
}

/// How far places that were pointed at lie apart.
std::string point_sentence(const StudyResults& results, const FirstAnswer& first, double confidence) {
    const auto row = std::ranges::find_if(results.points.spreads, [&](const PointSpreadRow& one) {
        return one.of.observer.empty() && one.of.task == first.of.task && one.of.answer == first.of.answer &&
               one.between_mm.value;
    });
    if (row == results.points.spreads.end())
        return {};
    std::string words =
        fmt::format("places of {} by different observers lie {} apart in the mean", named_answer(first.of),
                    with_interval(row->between_mm, confidence, 1.0, " mm"));
    if (row->chance_mm)
        words += fmt::format(", where chance gives {:.3g} mm", *row->chance_mm);
    return fmt::format("{}, {}", words, over(row->observers));
}

/// The difference of two levels that is surest, over all items of a scale; else the mean of the first.
std::string rating_sentence(const StudyAnswers& answers, const FirstAnswer& first, double confidence) {
    const auto is_of_scale = [&](const AnswerOf& of) {
        return of.observer.empty() && of.task == first.of.task && of.answer == first.of.answer;
    };
    const AnswerDifferenceRow* surest = nullptr; ///< of those beyond chance
    const auto size = [](const AnswerDifferenceRow& row) {
        return std::abs(row.evidence.effect_size.value.value_or(0.0));
    };
    std::set<std::string> items, with_difference;
    for (const AnswerRatingRow& row : answers.ratings)
        if (is_of_scale(row.of))
            items.insert(row.of.item);
    for (const AnswerDifferenceRow& row : answers.differences) {
        if (!is_of_scale(row.of) || row.measure != "mean" || !row.p_holm || !row.difference.value ||
            *row.p_holm > 1.0 - confidence)
            continue;
        with_difference.insert(row.of.item);
        if (!surest || *row.p_holm < *surest->p_holm ||
            (*row.p_holm == *surest->p_holm && size(row) > size(*surest)))
            surest = &row;
    }
    const AnswerOf& of = surest ? surest->of : first.of;
    const AnswerRatingRow* const all =
        row_of_all(answers.ratings, of, [](const AnswerRatingRow& row) { return row.factor.empty(); });
    if (!all || !all->mean.value)
        return {};
    std::string words =
        fmt::format("the mean of {} is {}", named_answer(of), with_interval(all->mean, confidence));
    if (surest)
        words += fmt::format("; of {} {} it is by {} {} than of {}", surest->column, surest->a,
                             with_interval({std::abs(*surest->difference.value),
                                            surest->difference.interval && *surest->difference.value < 0.0
                                                ? std::optional(Interval{-surest->difference.interval->high,
                                                                         -surest->difference.interval->low})
                                                : surest->difference.interval,
                                            {}},
                                           confidence),
                             *surest->difference.value < 0.0 ? "lower" : "higher", surest->b);
    if (items.size() > 1)
        words += fmt::format("; {} of {} items differ between levels beyond chance", with_difference.size(),
                             items.size());
    return words + ", " + over(first.observers);
}

std::string share_sentence(const StudyResults& results, const FirstAnswer& first,
                           const StudyOptions& options) {
    std::map<std::string, std::pair<double, double>> observers; ///< counted, and of how many
    std::string choice;
    for (const StudyAnswer& one : results.answers.given) {
        if (AnswerOf{"", one.task, one.answer, one.item} != first.of || !is_choice(one))
            continue;
        if (!first.is_judged && (choice.empty() || one.value < choice))
            choice = one.value;
    }
    for (const StudyAnswer& one : results.answers.given) {
        if (AnswerOf{"", one.task, one.answer, one.item} != first.of || one.is_missed)
            continue;
        if (first.is_judged ? !one.is_correct : choice.empty())
            continue;
        auto& [counted, all] = observers[one.observer];
        all += 1.0;
        counted += (first.is_judged ? *one.is_correct : one.value == choice) ? 1.0 : 0.0;
    }
    std::vector<double> shares;
    for (const auto& [observer, sums] : observers)
        shares.push_back(sums.first / sums.second);
    const Estimate mean = estimated_mean(shares, options.bootstrap(), "nobody answered", zero_to_one);
    if (!mean.value)
        return {};
    const std::string share = with_interval(mean, options.confidence, 100.0, " %");
    return first.is_judged ? fmt::format("{} of the answers were correct, {}", share, over(first.observers))
                           : fmt::format("\"{}\" was chosen in {} of the answers, {}", choice, share,
                                         over(first.observers));
}

std::string area_sentence(const StudyResults& results, double confidence) {
    const bool by_duration = rate_too_low_for_counts(results).has_value();
    for (const AreaRow& row : results.area_rows)
        if (row.area == results.area && row.keys.empty() && row.by_count.value)
            return fmt::format(
                "{} of the {} on {}, {}",
                with_interval(by_duration ? row.by_duration : row.by_count, confidence, 100.0, " %"),
                by_duration ? "time of fixation is" : "fixations lie",
                row.area == head_area ? "the head" : fmt::format("the area {}", row.area),
                over(row.observers));
    return {};
}

/// Of a search: how answers slow down with every further stimulus.
std::string trend_sentence(const StudyAnswers& answers, const FirstAnswer& first, double confidence) {
    constexpr std::string_view set_size = "set_size";
    std::vector<std::string> clauses;
    const auto add = [&](const AnswerTrendRow& row, const std::string& where) {
        clauses.push_back(fmt::format("{}{}", with_interval(row.slope, confidence, 1000.0, " ms"), where));
    };
    const auto is_wanted = [&](const AnswerTrendRow& row) {
        return row.of == first.of && row.along == set_size && row.measure.find("time") != std::string::npos &&
               row.slope.value;
    };
    for (const AnswerTrendRow& row : answers.trends)
        if (is_wanted(row) && row.column == "target")
            add(row, fmt::format(" with the target {}", row.level));
    if (clauses.empty())
        for (const AnswerTrendRow& row : answers.trends)
            if (is_wanted(row) && row.column.empty())
                add(row, "");
    if (clauses.empty())
        return {};
    return fmt::format("response times grow by {} for every further stimulus, {}", joined_words(clauses),
                       over(first.observers));
}

/// Which two levels stay together most often, and which least.
std::string likeness_sentence(const StudyAnswers& answers, const FirstAnswer& first, double confidence) {
    const AnswerLikenessRow *most = nullptr, *least = nullptr;
    std::string factor;
    for (const AnswerLikenessRow& row : answers.likenesses) {
        if (row.of != first.of || !row.share.value || row.a == row.b ||
            (!factor.empty() && row.factor != factor))
            continue;
        factor = row.factor;
        most = !most || *row.share.value > *most->share.value ? &row : most;
        least = !least || *row.share.value < *least->share.value ? &row : least;
    }
    if (!most || most == least)
        return {};
    return fmt::format(
        "of the levels of {}, {} and {} stay together most often, in {} of the trials that show both, {} "
        "and {} least, in {}; by chance it would be {:.3g} %, {}",
        factor, most->a, most->b, with_interval(most->share, confidence, 100.0, " %"), least->a, least->b,
        with_interval(least->share, confidence, 100.0, " %"), 100.0 * most->chance, over(first.observers));
}

/// The main result in a sentence, and what it is of.
struct MainResult {
    std::string measure, clause;
};

MainResult main_result(const StudyResults& results, const StudyOptions& options) {
    const StudyAnswers& answers = results.answers;
    for (const FirstAnswer& first : answers_in_order(results))
        for (MainResult& found :
             std::vector<MainResult>{{"curves", curve_sentence(answers, first, options.confidence)},
                                     {"matches", match_sentence(answers, first, options.confidence)},
                                     {"likenesses", likeness_sentence(answers, first, options.confidence)},
                                     {"scales", scale_sentence(answers, first, options.confidence)},
                                     {"scales", noise_sentence(answers, first)},
                                     {"trends", trend_sentence(answers, first, options.confidence)},
                                     {"reliefs", gauge_sentence(results, first, options)},
                                     {"points", point_sentence(results, first, options.confidence)},
                                     {"ratings", rating_sentence(answers, first, options.confidence)},
                                     {"choices", share_sentence(results, first, options)}})
            if (!found.clause.empty())
                return std::move(found);
    std::string clause = area_sentence(results, options.confidence);
    return {clause.empty() ? "" : "areas", std::move(clause)};
}

/// Which things have the same level as which: the number of the first thing of each one's level.
std::vector<std::size_t> partition_of(const std::vector<std::string>& levels) {
    std::map<std::string, std::size_t> first;
    std::vector<std::size_t> parts;
    for (std::size_t i = 0; i < levels.size(); ++i)
        parts.push_back(first.try_emplace(levels[i], i).first->second);
    return parts;
}

/// A factor with the level of everything that was shown, n/a where it has none.
struct ShownFactor {
    std::string name;
    std::vector<std::string> levels;

    std::size_t count() const {
        std::set<std::string> known(levels.begin(), levels.end());
        known.erase("n/a");
        return known.size();
    }
    bool has_numbers() const {
        return std::ranges::all_of(
            levels, [](const std::string& level) { return number_in<double>(level).has_value(); });
    }
};

std::vector<ShownFactor> shown_factors(const StudyResults& results) {
    std::vector<ShownFactor> factors;
    std::size_t things = 0;
    const auto add = [&](const std::string& name, const std::string& level) {
        auto known = std::ranges::find(factors, name, &ShownFactor::name);
        if (known == factors.end())
            known = factors.insert(factors.end(), {name, {}});
        known->levels.resize(things, "n/a");
        known->levels.push_back(level.empty() ? "n/a" : level);
    };
    for (const StudyAnswer& one : results.answers.given)
        for (const AnsweredStimulus& shown : one.shown) {
            for (const auto& [name, level] : shown.levels)
                add(name, level);
            // Of the trial's own, such as a set size, what is no stimulus's.
            for (const auto& [name, level] : one.levels)
                if (std::ranges::find(shown.levels, name, &std::pair<std::string, std::string>::first) ==
                    shown.levels.end())
                    add(name, level);
            ++things;
        }
    if (results.answers.given.empty())
        for (const StudyTrial& trial : results.trials) {
            for (const std::string& column : results.by)
                if (column != "observer")
                    add(column, trial.key(column));
            ++things;
        }
    for (ShownFactor& factor : factors)
        factor.levels.resize(things, "n/a");
    return factors;
}

/// Factors with several levels, in the order in which trials have them. Of those that go together everywhere,
/// as the entries of a series and its numbers do, one: the numbers, where all have one, else the first.
std::vector<std::string> varied_factors(const StudyResults& results) {
    std::vector<ShownFactor> varied;
    for (ShownFactor& factor : shown_factors(results)) {
        if (factor.count() < 2)
            continue;
        const auto same = std::ranges::find_if(varied, [&](const ShownFactor& other) {
            return partition_of(other.levels) == partition_of(factor.levels);
        });
        if (same == varied.end())
            varied.push_back(std::move(factor));
        else if (factor.has_numbers() && !same->has_numbers())
            *same = std::move(factor);
    }
    std::vector<std::string> words;
    for (const ShownFactor& factor : varied)
        words.push_back(fmt::format("{} ({} levels)", factor.name, factor.count()));
    return words;
}

std::string design_clause(const StudyResults& results) {
    const std::int64_t trials = trials_of_presentations(results);
    if (trials == 0)
        return {};
    const std::vector<std::string> factors = varied_factors(results);
    std::string clause = as_counted(trials, "trial");
    const double each = static_cast<double>(results.trials.size()) / static_cast<double>(trials);
    if (each > 1.0)
        clause += fmt::format(" with {} {:.3g} stimuli each", each == std::floor(each) ? "" : "about", each);
    for (std::size_t at; (at = clause.find("  ")) != std::string::npos;)
        clause.erase(at, 1);
    if (!factors.empty())
        clause += fmt::format("; what differs is {}", joined_words(factors));
    return clause;
}

} // namespace

StudyHeadline study_headline(const StudyResults& results, const StudyOptions& options) {
    StudyHeadline headline;
    std::vector<std::string> questions;
    for (const NamedThing& task : tasks_asked(results))
        if (!task.title.empty() && std::ranges::find(questions, task.title) == questions.end())
            questions.push_back(task.title);
    constexpr std::size_t most_questions = 4;
    // Of many the first, and how many more there are.
    const std::size_t shown = questions.size() <= most_questions ? questions.size() : most_questions - 1;
    for (std::size_t i = 0; i < shown; ++i)
        headline.question += (i == 0 ? "" : " / ") + questions[i];
    if (shown < questions.size())
        headline.question += fmt::format(" / and {} more", questions.size() - shown);
    add_sentence(headline.design, design_clause(results));
    const StudyGlance& glance = results.glance;
    std::vector<std::string> left_out;
    for (const StudyObserver& one : results.observers)
        if (!one.counts)
            left_out.push_back(one.label);
    add_sentence(
        headline.sample,
        fmt::format("N = {}{}{}",
                    as_counted(glance.observers, glance.any_simulated ? "simulated observer" : "observer"),
                    left_out.empty() ? ", none left out"
                                     : fmt::format(", without {}", joined_words(left_out)),
                    glance.excluded_trials > 0
                        ? fmt::format("; {} excluded",
                                      share_of(glance.excluded_trials, glance.trials, unit_of_gaze(results)))
                        : fmt::format("; no {} excluded", unit_of_gaze(results))));
    MainResult result = main_result(results, options);
    headline.measure = std::move(result.measure);
    add_sentence(headline.result, std::move(result.clause));
    return headline;
}

} // namespace overt
