#include "experiment/design/answer_forms.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <span>

#include <fmt/format.h>

#include "experiment/answers/answer_kinds.h"
#include "experiment/base/random.h"
#include "experiment/design/match_levels.h"
#include "experiment/factors.h"

namespace overt {

namespace {

constexpr std::string_view of_column = "column:";

int mapping_of(const AskedTrial& asked, const TaskAnswer& answer) {
    const int count = mappings_of(answer);
    if (answer.mapping == AnswerMapping::fixed || count < 2)
        return 0;
    if (answer.mapping == AnswerMapping::observer)
        return (asked.observer - 1) % count;
    // Of so many trials in a row each mapping comes once, in an order that is drawn.
    std::vector<int> round(static_cast<std::size_t>(count));
    std::iota(round.begin(), round.end(), 0);
    RandomStream stream(asked.seed,
                        fmt::format("{}answer mapping {} {}", asked.is_practice ? "practice " : "",
                                    asked.trial.task, answer.id),
                        static_cast<std::uint64_t>(asked.rank / count));
    stream.shuffle(std::span(round));
    return round[static_cast<std::size_t>(asked.rank % count)];
}

std::vector<std::string> items_of(const AskedTrial& asked, const TaskAnswer& answer) {
    std::vector<std::string> items = answer.items;
    if (items.empty())
        items.emplace_back();
    if (answer.order == ItemOrder::drawn) {
        RandomStream stream(asked.seed,
                            fmt::format("{}answer order {}", asked.is_practice ? "practice " : "", answer.id),
                            static_cast<std::uint64_t>(asked.trial.index));
        stream.shuffle(std::span(items));
    }
    return items;
}

/// A gauge stands in any direction at first, none of them more often, and never nearly as steep as it gets.
constexpr Degrees steepest_start{60.0};

Attitude drawn_start(const AskedTrial& asked, const TaskAnswer& answer) {
    RandomStream stream(asked.seed,
                        fmt::format("{}gauge start {}", asked.is_practice ? "practice " : "", answer.id),
                        static_cast<std::uint64_t>(asked.trial.index));
    // Normals evenly over the cap: their z is uniform.
    const double z = stream.uniform(std::cos(to_radians(steepest_start).value), 1.0);
    return {to_degrees(Radians{std::acos(z)}), Degrees{stream.uniform(0.0, 360.0)}};
}

/// A match's levels, and where it begins in this trial.
MatchLevels levels_with_starts(const AskedTrial& asked, const TaskAnswer& answer) {
    MatchLevels levels = match_levels(asked.protocol, answer, asked.trial);
    RandomStream stream(asked.seed,
                        fmt::format("{}match start {}", asked.is_practice ? "practice " : "", answer.id),
                        static_cast<std::uint64_t>(asked.trial.index));
    for (std::size_t i = 0; i < levels.axes.size(); ++i) {
        MatchLevels::Axis& axis = levels.axes[i];
        const auto count = static_cast<int>(axis.values.size());
        switch (answer.start.from) {
        case MatchStart::From::drawn:
            axis.start = static_cast<int>(stream.below(static_cast<std::uint32_t>(count)));
            break;
        case MatchStart::From::low:
            axis.start = 0;
            break;
        case MatchStart::From::high:
            axis.start = count - 1;
            break;
        case MatchStart::From::values:
            axis.start = level_at(axis.values, answer.start.values.at(i)).value_or(0);
            break;
        }
    }
    return levels;
}

} // namespace

const ProbeSettings* probe_of(const Task& task, const TaskAnswer& answer) {
    if (answer.probe.empty())
        return task.probes.empty() ? nullptr : &task.probes.front();
    const auto found = std::ranges::find(task.probes, answer.probe, &ProbeSettings::id);
    return found == task.probes.end() ? nullptr : &*found;
}

int mappings_of(const TaskAnswer& answer) {
    return row_of(answer.kind).has_key("direction")
               ? 2
               : static_cast<int>(std::max(answer.choices.size(), answer.keys.size()));
}

std::vector<std::string> labels_of(const Protocol& protocol, const TaskAnswer& answer) {
    if (!answer.labels.empty())
        return answer.labels;
    std::vector<std::string> labels = answer.is_choice() ? answer.choices : answer.keys;
    for (std::string& label : labels) {
        const auto slot = std::ranges::find(protocol.slots, label, &Slot::id);
        if (answer.is_choice() && slot != protocol.slots.end())
            label = slot->title;
    }
    return labels;
}

std::string correct_value(const Protocol& protocol, const TaskAnswer& answer, const Trial& trial) {
    if (answer.correct.empty()) {
        // Of the trial's only where it is one of the choices: a rating of its confidence is not.
        const std::vector<std::string>& values = answer.is_choice() ? answer.choices : answer.keys;
        return std::ranges::find(values, trial.correct) != values.end() ? trial.correct : std::string();
    }
    if (answer.correct == "none")
        return {};
    if (!answer.correct.starts_with(of_column))
        return answer.correct;
    const std::string_view column = std::string_view(answer.correct).substr(of_column.size());
    if (const std::string_view own = own_level(trial, column); !own.empty())
        return std::string(own);
    const Factors factors = factors_of(protocol);
    const Factor* const factor = factors.find(column);
    if (!factor || factor->source == Factor::Source::own)
        return {};
    const std::string& level =
        factor->levels[static_cast<std::size_t>(factors.level_of(*factor, trial))].name;
    return level == no_level ? std::string() : level;
}

std::vector<int> ranks_in_tasks(const std::vector<Trial>& trials) {
    std::map<int, int> count;
    std::vector<int> ranks;
    for (const Trial& trial : trials)
        ranks.push_back(count[trial.task]++);
    return ranks;
}

std::vector<AnswerForm> answer_forms(const AskedTrial& asked, const std::vector<int>& answers,
                                     int first_place) {
    const Task& task = asked.protocol.tasks[static_cast<std::size_t>(asked.trial.task)];
    std::vector<AnswerForm> forms;
    for (const int index : answers) {
        const TaskAnswer& answer = task.answers[static_cast<std::size_t>(index)];
        for (const std::string& item : items_of(asked, answer)) {
            forms.push_back({.settings = &answer,
                             .item = item,
                             .labels = labels_of(asked.protocol, answer),
                             .mapping = mapping_of(asked, answer),
                             .correct = correct_value(asked.protocol, answer, asked.trial),
                             .place = first_place++});
            if (is_match(answer))
                forms.back().levels = levels_with_starts(asked, answer);
            if (!row_of(answer.kind).has_key("probe"))
                continue;
            if (const ProbeSettings* const probe = probe_of(task, answer)) {
                forms.back().probe = probe->id;
                forms.back().point = own_level(asked.trial, probe->id);
            }
            forms.back().start = drawn_start(asked, answer);
        }
    }
    return forms;
}

} // namespace overt
