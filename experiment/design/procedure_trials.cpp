#include "experiment/design/procedure_trials.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "experiment/design/task_trials.h"

namespace overt {

/// The trials of a task in a block that have alike what their rule does not change.
struct ProcedureTrials::Condition {
    int task = 0, block = 0, number = 0;
    std::string factor;
    std::vector<std::pair<double, Stimulus>> stimuli; ///< by level, rising
    std::vector<const ProcedureSettings*> procedures; ///< by track
    std::unique_ptr<InterleavedTracks> tracks;
};

namespace {

const TrialsSettings& trials_of_task(const Protocol& protocol, const Trial& trial) {
    return protocol.tasks[static_cast<std::size_t>(trial.task)].trials;
}

bool is_chosen(const Protocol& protocol, const Trial& trial) {
    return trial.role != TrialRole::catch_trial && !trials_of_task(protocol, trial).procedures.empty();
}

const std::string& slot_id(const Protocol& protocol, const Trial& trial, std::size_t place) {
    return protocol.slots[static_cast<std::size_t>(trial.shown(place).slot)].id;
}

void put(Trial& trial, std::size_t place, const Stimulus& stimulus) {
    if (place == 0)
        trial.stimulus = stimulus;
    else
        trial.beside[place - 1].stimulus = stimulus;
}

} // namespace

std::string ProcedureChoice::in_words() const {
    std::string words = fmt::format("{}: {} {:.6g}, condition {}, trial {} of the track", procedure, factor,
                                    level, condition + 1, before.trials + 1);
    if (before.reversals)
        words += fmt::format(", reversals {}", *before.reversals);
    if (before.was_clipped)
        words += ", clipped";
    if (before.estimate)
        words += fmt::format(", estimate {:.6g}", *before.estimate);
    if (before.spread)
        words += fmt::format(", SD {:.6g}", *before.spread);
    if (before.entropy_bits)
        words += fmt::format(", entropy {:.6g} bits", *before.entropy_bits);
    return words;
}

std::string describe_procedures(const Protocol& protocol, const Task& task) {
    std::string text;
    for (const std::string& id : task.trials.procedures) {
        const auto found = std::ranges::find(protocol.procedures, id, &ProcedureSettings::id);
        if (found == protocol.procedures.end())
            continue;
        const std::string yes = !found->yes.empty()             ? found->yes
                                : !task.trials.standard.empty() ? "test"
                                                                : "correct";
        text += fmt::format(
            "  procedure {}: {}; {} trials in each condition{}. \"Yes\" is {}; a missed answer {}.\n", id,
            procedure_in_words(*found), found->trials,
            found->reversals > 0  ? fmt::format(", or {} reversals", found->reversals)
            : found->entropy_bits ? fmt::format(", or until {} bits are left", *found->entropy_bits)
                                  : "",
            yes == "test"      ? "the slot with the level that was chosen"
            : yes == "correct" ? "the correct answer"
                               : fmt::format("the answer \"{}\"", yes),
            found->missed == UnansweredTrial::repeat   ? "has the level come again"
            : found->missed == UnansweredTrial::ignore ? "says nothing"
                                                       : "counts as \"no\"");
    }
    return text;
}

std::size_t chosen_place(const Protocol& protocol, const Trial& trial) {
    const std::string_view side = own_level(trial, "side");
    const std::string_view slot = side.empty() ? std::string_view(trials_of_task(protocol, trial).in) : side;
    for (std::size_t place = 0; place < trial.shown_count(); ++place)
        if (slot_id(protocol, trial, place) == slot)
            return place;
    return 0;
}

TrackAnswer track_answer(const ProcedureSettings& settings, bool has_standard, const std::string& test,
                         std::span<const GivenAnswer> given) {
    const auto read =
        settings.answer.empty() ? given.begin() : std::ranges::find(given, settings.answer, &GivenAnswer::id);
    if (read == given.end() || read->is_missed)
        return TrackAnswer::missed;
    const std::string_view yes = !settings.yes.empty() ? std::string_view(settings.yes)
                                 : has_standard        ? "test"
                                                       : "correct";
    if (yes == "correct")
        return !read->is_correct   ? TrackAnswer::missed
               : *read->is_correct ? TrackAnswer::yes
                                   : TrackAnswer::no;
    return read->value == (yes == "test" ? std::string_view(test) : yes) ? TrackAnswer::yes : TrackAnswer::no;
}

ProcedureTrials::ProcedureTrials(const Protocol& protocol, const Schedule& schedule)
    : protocol_(protocol), schedule_(schedule) {
    // What each task shows in each block, as its places in the order do.
    std::map<std::pair<int, int>, std::vector<Stimulus>> shown;
    for (const Trial& trial : schedule.trials)
        if (is_chosen(protocol, trial))
            shown[{trial.task, trial.block}].push_back(trial.shown(chosen_place(protocol, trial)).stimulus);
    const Factors factors = factors_of(protocol);
    for (auto& [of, stimuli] : shown) {
        std::ranges::sort(stimuli);
        stimuli.erase(std::unique(stimuli.begin(), stimuli.end()), stimuli.end());
        const RuleTask by = rule_task(protocol, of.first, stimuli);
        const RuleFactor& moved = by.request.of.front();
        const Factor& factor = factors.at(moved.name);
        std::map<int, std::unique_ptr<Condition>> found;
        for (std::size_t i = 0; i < stimuli.size(); ++i) {
            const int level = moved.of_stimulus[i];
            if (level < 0 || !factor.levels[static_cast<std::size_t>(level)].number)
                continue;
            std::unique_ptr<Condition>& condition = found[by.request.context[i]];
            if (!condition) {
                condition = std::make_unique<Condition>();
                condition->task = of.first;
                condition->block = of.second;
                condition->number = static_cast<int>(found.size()) - 1;
                condition->factor = moved.name;
            }
            condition->stimuli.emplace_back(*factor.levels[static_cast<std::size_t>(level)].number,
                                            stimuli[i]);
        }
        for (auto& [context, condition] : found) {
            std::ranges::sort(condition->stimuli);
            for (const std::string& id : protocol.tasks[static_cast<std::size_t>(of.first)].trials.procedures)
                condition->procedures.push_back(
                    &*std::ranges::find(protocol.procedures, id, &ProcedureSettings::id));
            make_tracks(*condition);
            conditions_.push_back(std::move(condition));
        }
    }
}
ProcedureTrials::~ProcedureTrials() = default;

void ProcedureTrials::make_tracks(Condition& condition) const {
    std::vector<double> levels;
    for (const auto& [level, stimulus] : condition.stimuli)
        levels.push_back(level);
    // A condition's draws are its own: another one more or less changes nothing in it.
    const std::string purpose =
        fmt::format("procedures of task {} in block {}",
                    protocol_.tasks[static_cast<std::size_t>(condition.task)].id, condition.block);
    RandomStream random(schedule_.seed, purpose, static_cast<std::uint64_t>(condition.number));
    std::vector<std::unique_ptr<LevelTrack>> tracks;
    for (const ProcedureSettings* settings : condition.procedures)
        tracks.push_back(make_track(*settings, levels, random.next_bits()));
    condition.tracks = std::make_unique<InterleavedTracks>(std::move(tracks), random.next_bits());
}

ProcedureTrials::Condition* ProcedureTrials::condition_of(const Trial& trial) const {
    if (!is_chosen(protocol_, trial))
        return nullptr;
    const Stimulus stimulus = trial.shown(chosen_place(protocol_, trial)).stimulus;
    for (const std::unique_ptr<Condition>& one : conditions_)
        if (one->task == trial.task && one->block == trial.block &&
            std::ranges::any_of(one->stimuli, [&](const auto& of) { return of.second == stimulus; }))
            return one.get();
    return nullptr;
}

std::optional<ProcedureChoice> ProcedureTrials::decide(Trial& trial) const {
    const Condition* const condition = condition_of(trial);
    if (!condition)
        return std::nullopt;
    const std::optional<InterleavedTracks::Choice> choice = condition->tracks->next();
    if (!choice)
        return std::nullopt;
    const ProcedureSettings& settings = *condition->procedures[choice->track];
    const double wanted = level_of_track(settings, choice->level);
    const auto nearest = std::ranges::min_element(condition->stimuli, {}, [&](const auto& of) {
        return std::abs(track_level(settings, of.first) - track_level(settings, wanted));
    });
    put(trial, chosen_place(protocol_, trial), nearest->second);
    return ProcedureChoice{settings.id, condition->factor, nearest->first, condition->number,
                           condition->tracks->track(choice->track).state()};
}

void ProcedureTrials::tell(const Trial& trial, std::span<const GivenAnswer> given) {
    Condition* const condition = condition_of(trial);
    const auto choice = condition ? condition->tracks->next() : std::nullopt;
    if (!choice)
        return;
    const ProcedureSettings& settings = *condition->procedures[choice->track];
    const std::size_t place = chosen_place(protocol_, trial);
    const auto shown = std::ranges::find(condition->stimuli, trial.shown(place).stimulus,
                                         [](const auto& of) { return of.second; });
    condition->tracks->tell(track_level(settings, shown->first),
                            track_answer(settings, !trials_of_task(protocol_, trial).standard.empty(),
                                         slot_id(protocol_, trial, place), given));
}

bool ProcedureTrials::has_ended(const Trial& trial) const {
    const Condition* const condition = condition_of(trial);
    return condition && !condition->tracks->next();
}

bool ProcedureTrials::is_same_condition(const Trial& one, const Trial& other) const {
    const Condition* const condition = condition_of(one);
    return condition && condition == condition_of(other);
}

void ProcedureTrials::restart(int block) {
    for (const std::unique_ptr<Condition>& condition : conditions_)
        if (condition->block == block)
            make_tracks(*condition);
}

} // namespace overt
