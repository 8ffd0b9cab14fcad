#include "experiment/design/answer_words.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/answers/answer_kinds.h"
#include "experiment/base/counted.h"
#include "experiment/base/plain_text.h"
#include "experiment/design/answer_forms.h"
#include "experiment/design/match_levels.h"
#include "experiment/design/schedule.h"
#include "experiment/design/trial_plan.h"

namespace overt {

namespace {

std::string choices_in_words(const Protocol& protocol, const TaskAnswer& answer) {
    const std::vector<std::string> labels = labels_of(protocol, answer);
    const std::vector<std::string>& values = answer.is_choice() ? answer.choices : answer.keys;
    const bool by_keys = answer.with != AnsweredWith::mouse;
    std::vector<std::string> parts;
    for (std::size_t i = 0; i < values.size(); ++i) {
        std::string part = labels[i] == values[i] ? values[i] : fmt::format("{} ({})", labels[i], values[i]);
        if (by_keys && answer.is_choice() && i < answer.keys.size())
            part += fmt::format(" by the key {}", answer.keys[i]);
        parts.push_back(std::move(part));
    }
    std::string text =
        fmt::format("{}{}", answer.is_choice() ? "" : "one of the keys ", fmt::join(parts, ", "));
    if (answer.with != AnsweredWith::keys)
        text += by_keys ? ", or by a click" : ", by a click";
    return text;
}

std::string gauge_in_words(const Task& task, const TaskAnswer& answer) {
    const ProbeSettings* const probe = probe_of(task, answer);
    return fmt::format(
        "leaned by drags of the mouse ({:g} deg a pixel) or arrows ({:g} deg) at probe {}; {} takes "
        "back; a click with the right button accepts",
        answer.slant_per_px_deg, answer.key_step_deg, probe ? probe->id : "", answer.undo_key);
}

std::string_view name_of_end(MatchStart::From from) { return from == MatchStart::From::low ? "low" : "high"; }

/// What is set, along what, and with which keys; levels by the first of the observer's trials that has them.
std::string match_in_words(const Protocol& protocol, const Task& task, const TaskAnswer& answer) {
    const std::vector<std::string> keys = answer.match_keys(), coarse = answer.match_coarse_keys();
    const auto index = static_cast<int>(&task - protocol.tasks.data());
    MatchLevels levels;
    for (const Trial& trial : trials_of(protocol, 1))
        if (trial.task == index && levels.axes.empty())
            levels = match_levels(protocol, answer, trial);
    std::string text = fmt::format("what is in {} is set", answer.slot);
    for (std::size_t i = 0; i < answer.along.size(); ++i) {
        text += fmt::format("{} along {}", i == 0 ? "" : ", and", answer.along[i]);
        if (i < levels.axes.size())
            text += fmt::format(", {} levels from {:g} to {:g}", levels.axes[i].values.size(),
                                levels.axes[i].values.front(), levels.axes[i].values.back());
        if (answer.with == AnsweredWith::mouse)
            continue;
        text += fmt::format(", by {} and {}", keys[2 * i], keys[2 * i + 1]);
        if (2 * i + 1 < coarse.size())
            text += fmt::format(", {} at once by {} and {}", answer.coarse_steps, coarse[2 * i],
                                coarse[2 * i + 1]);
    }
    if (answer.with != AnsweredWith::keys)
        text += answer.with == AnsweredWith::mouse ? ", by the wheel of the mouse" : ", or by the wheel";
    std::string start = "at a level that is drawn";
    if (answer.start.from == MatchStart::From::low || answer.start.from == MatchStart::From::high)
        start = fmt::format("at the {} end", name_of_end(answer.start.from));
    else if (answer.start.from == MatchStart::From::values)
        start = fmt::format("at {:g}", fmt::join(answer.start.values, ", "));
    return text + fmt::format("; it begins {}; {} takes back", start, answer.undo_key);
}

std::string range_in_words(const TaskAnswer& answer) {
    std::string text;
    if (answer.steps) {
        text = fmt::format("{} steps, {:g} to {:g}", *answer.steps, answer.low(), answer.high());
        if (!answer.key_of_step(0).empty())
            text += fmt::format(", by the keys {} to {}", answer.key_of_step(0),
                                answer.key_of_step(*answer.steps - 1));
        text += ", or left and right";
    } else if (row_of(answer.kind).has_key("ends")) {
        text = fmt::format("a line from {:g} to {:g}, by left and right", answer.low(), answer.high());
    } else if (answer.min || answer.max) {
        text = answer.min && answer.max ? fmt::format("a number from {:g} to {:g}", *answer.min, *answer.max)
               : answer.min             ? fmt::format("a number of {:g} at least", *answer.min)
                                        : fmt::format("a number of {:g} at most", *answer.max);
    } else {
        text = "a number";
    }
    if (answer.ends.size() >= 2)
        text += fmt::format(", from \"{}\" to \"{}\"", answer.ends.front(), answer.ends.back());
    return text;
}

std::string window_in_words(const TaskAnswer& answer, bool waits_unseen) {
    using From = AnswerOpening::From;
    const From from = answer.opens.from != From::usual ? answer.opens.from
                      : waits_unseen                   ? From::onset
                                                       : From::screen;
    const std::string_view begin = from == From::onset    ? "the stimulus's onset"
                                   : from == From::offset ? "the stimulus's offset"
                                                          : "the onset of its screen";
    std::string text = answer.opens.after_s > 0.0
                           ? fmt::format("presses count from {:g} s after {}", answer.opens.after_s, begin)
                           : fmt::format("presses count from {}", begin);
    text += answer.limit_s ? fmt::format(" for {:g} s", *answer.limit_s) : " until its last step is over";
    const AnswerZero zero =
        answer.zero.value_or(from == From::onset ? AnswerZero::stimulus : AnswerZero::window);
    text += fmt::format("; the response time counts from {}",
                        zero == AnswerZero::stimulus ? "the stimulus's onset"
                        : zero == AnswerZero::screen ? "the onset of its screen"
                                                     : "then on");
    if (answer.counts == AnswerCounts::last)
        text += "; the last press counts";
    if (waits_unseen && !answer.ends_stimulus)
        text += "; the stimulus stays for its time";
    return text;
}

std::string correct_in_words(const Protocol& protocol, const TaskAnswer& answer) {
    if (answer.correct == "none")
        return "nothing is correct";
    if (answer.correct.starts_with("column:"))
        return fmt::format("correct is what the column {} says",
                           answer.correct.substr(answer.correct.find(':') + 1));
    if (!answer.correct.empty())
        return fmt::format("correct is {}", answer.correct);
    const std::vector<std::string>& values = answer.is_choice() ? answer.choices : answer.keys;
    const std::vector<NamedWord> own = own_levels_of(protocol);
    const bool is_known = std::ranges::any_of(own, [&](const NamedWord& level) {
        return level.name == correct_answer && std::ranges::find(values, level.text) != values.end();
    });
    return is_known ? "correct is what the trial says" : "nothing is correct";
}

} // namespace

std::string describe_answers(const Protocol& protocol, const Task& task) {
    if (task.answers.empty())
        return {};
    Trial trial;
    trial.task = static_cast<int>(&task - protocol.tasks.data());
    const TrialPlan plan = plan_trial(protocol, 0, trial, false);
    std::string text = fmt::format("answers of task {}:\n", task.id);
    for (std::size_t i = 0; i < task.answers.size(); ++i) {
        const TaskAnswer& answer = task.answers[i];
        const AnswerKindRow& kind = row_of(answer.kind);
        const std::string question = plain_line_of(answer.question.empty() ? task.question : answer.question);
        text += fmt::format("  {}, a {}: \"{}\"\n", answer.id, kind.name, question);
        if (!kind.make) {
            text += "    spoken; a key goes on\n";
            continue;
        }
        const auto sheet = std::ranges::find_if(plan.sheets, [&](const PlannedSheet& one) {
            return std::ranges::find(one.answers, static_cast<int>(i)) != one.answers.end();
        });
        std::string how = kind.has_key("probe")     ? gauge_in_words(task, answer)
                          : is_match(answer)        ? match_in_words(protocol, task, answer)
                          : kind.has_key("choices") ? choices_in_words(protocol, answer)
                          : kind.has_key("min")     ? range_in_words(answer)
                                                    : fmt::format("up to {} characters", answer.longest);
        if (answer.accepts_by_key())
            how += fmt::format("; {} accepts it", answer.accept_key);
        text += fmt::format("    {}\n", how);
        if (!answer.items.empty())
            text +=
                fmt::format("    of each of {}: {}\n", counted(static_cast<int>(answer.items.size()), "item"),
                            fmt::join(answer.items, ", "));
        text += fmt::format("    {}\n",
                            window_in_words(answer, sheet != plan.sheets.end() && sheet->waits_unseen));
        if (answer.mapping != AnswerMapping::fixed)
            text +=
                fmt::format("    {} {}\n",
                            kind.has_key("ends") ? "its ends change sides" : "what the keys mean goes round",
                            answer.mapping == AnswerMapping::observer ? "from observer to observer"
                                                                      : "from trial to trial, drawn");
        text += fmt::format("    {}\n", correct_in_words(protocol, answer));
    }
    return text;
}

} // namespace overt
