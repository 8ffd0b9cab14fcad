#include <fmt/format.h>

#include "experiment/study/methods/methods_topics.h"
#include "experiment/study/methods/sentences.h"

namespace overt {

namespace {

std::string who_took_part(const StudyResults& results) {
    const ObserverCounts observers = observer_counts(results);
    const std::string presentations =
        unit_of_gaze(results) == "trial"
            ? std::string()
            : fmt::format(" ({})", as_counted(results.glance.trials, unit_of_gaze(results)));
    const std::string what =
        fmt::format("{} with {}{} that came to an end", as_counted(results.glance.sessions, "session"),
                    as_counted(trials_of_presentations(results), "trial"), presentations);
    if (observers.simulated == observers.all)
        return fmt::format("{} took part in {}", as_counted(observers.all, "simulated observer"), what);
    if (observers.simulated == 0)
        return fmt::format("{} took part in {}", as_counted(observers.all, "observer"), what);
    return fmt::format("{}, of whom {} simulated, took part in {}", as_counted(observers.all, "observer"),
                       observers.simulated == 1 ? "1 was" : fmt::format("{} were", observers.simulated),
                       what);
}

/// Whether a value of a form may stand in a sentence: short, and of letters, digits and a few signs.
bool is_plain_value(const std::string& value) {
    constexpr std::size_t longest = 30;
    return !value.empty() && value.size() <= longest &&
           value.find_first_of("<>{}[]\"\\\n\t;:|") == std::string::npos;
}

std::string what_the_form_says(const FormField& field) {
    std::string name = field.field;
    std::ranges::replace(name, '_', ' ');
    const std::string observers = as_counted(field.observers, "observer");
    if (field.numbers) {
        const Spread& spread = *field.numbers;
        if (spread.least == spread.most)
            return fmt::format("the {} was {} ({})", name, as_set(spread.median), observers);
        return fmt::format("the {} was {} to {}, with a median of {} ({})", name, as_set(spread.least),
                           as_set(spread.most), as_set(spread.median), observers);
    }
    // What is as good as different for each may be words of their own.
    constexpr std::size_t most_values = 4;
    const bool are_words =
        field.values.size() > most_values ||
        !std::ranges::all_of(field.values, is_plain_value, [](const auto& one) { return one.first; });
    if (are_words)
        return fmt::format("the {} is on record of {}", name, observers);
    std::vector<std::string> values;
    for (const auto& [value, count] : field.values)
        values.push_back(fmt::format("\"{}\" for {}", value, as_counted(count, "observer")));
    return fmt::format("the {} was {}", name, joined_words(values));
}

std::string limit_of(ExclusionRule rule, const ExclusionRules& rules) {
    switch (rule) {
    case ExclusionRule::lost_share:
        return fmt::format("more than {} % of its samples were lost outside of blinks",
                           as_set(100.0 * *rules.most_lost_share));
    case ExclusionRule::accuracy:
        return fmt::format("the validation before it had a mean error above {} deg",
                           as_set(*rules.most_accuracy_deg));
    case ExclusionRule::drift:
        return fmt::format("the drift check before it found an error above {} deg",
                           as_set(*rules.most_drift_deg));
    case ExclusionRule::missed_refreshes:
        return fmt::format("more than {} of its refreshes were missed, or their number is not proven",
                           *rules.most_missed_refreshes);
    }
    return {};
}

std::string_view reason_of(ExclusionRule rule) {
    switch (rule) {
    case ExclusionRule::lost_share:
        return "lost samples";
    case ExclusionRule::accuracy:
        return "the validation";
    case ExclusionRule::drift:
        return "the drift check";
    case ExclusionRule::missed_refreshes:
        return "missed refreshes";
    }
    return {};
}

/// Observers and trials of whom there is nothing to analyse.
void add_those_without_gaze(std::string& text, const StudyResults& results) {
    const int without = results.glance.without_gaze;
    if (without > 0)
        add_sentence(text, fmt::format("{} {} excluded, since no gaze was recorded in {}",
                                       share_of(without, results.glance.trials, unit_of_gaze(results)),
                                       without == 1 ? "was" : "were", without == 1 ? "it" : "them"));
    const ObserverCounts observers = observer_counts(results);
    if (results.glance.observers == 0)
        add_sentence(text, "of no observer there is a trial to analyse");
    else if (results.glance.observers < observers.all)
        add_sentence(text,
                     fmt::format("the results are of {}, since of the others there is no trial to analyse",
                                 share_of(results.glance.observers, observers.all, "observer")));
}

void add_exclusions(std::string& text, const StudyResults& results, const ExclusionRules& rules) {
    const std::vector<ExclusionRule> set = rules_of(rules);
    if (set.empty())
        return;
    std::string limits;
    for (const ExclusionRule rule : set)
        limits += fmt::format("{}{}", limits.empty() ? "if " : ", or if ", limit_of(rule, rules));
    add_sentence(text, fmt::format("a trial was to be excluded {}", limits));
    const int excluded = results.glance.excluded_trials - results.glance.without_gaze;
    if (excluded == 0) {
        add_sentence(text, "this excluded no trial");
        return;
    }
    std::vector<std::string> reasons;
    for (const auto& [rule, count] : results.glance.excluded_by)
        reasons.push_back(fmt::format("{} for {}", as_count(count), reason_of(rule)));
    add_sentence(text,
                 fmt::format("{} {}{}", share_of(excluded, results.glance.trials, unit_of_gaze(results)),
                             excluded == 1 ? "was excluded" : "were excluded",
                             set.size() == 1 ? "" : ", " + joined_words(reasons)));
    if (reasons.size() > 1)
        add_sentence(text, "a trial that breaks several of these limits is counted with the first");
}

} // namespace

std::string observers_text(const StudyResults& results, const ExclusionRules& rules) {
    std::string text;
    add_sentence(text, who_took_part(results));
    if (results.glance.any_simulated)
        add_sentence(text, observer_counts(results).simulated == observer_counts(results).all
                               ? "nothing here was measured of people"
                               : "the gaze of simulated observers is no measurement of people");
    const int incomplete = incomplete_sessions(results);
    if (incomplete > 0)
        add_sentence(text, fmt::format("in {} not all trials were run",
                                       share_of(incomplete, results.glance.sessions, "session")));
    for (const FormField& field : form_fields(results))
        add_sentence(text, what_the_form_says(field));
    add_exclusions(text, results, rules);
    add_those_without_gaze(text, results);
    return text;
}

} // namespace overt
