#include <set>

#include <fmt/format.h>

#include "experiment/checks/protocol_checks.h"
#include "experiment/protocol/entry_ids.h"

namespace overt {

namespace {

template <class Entry>
void check_id(ProtocolExamination& examination, const std::string& path, const std::string& id,
              const std::vector<Entry>& entries, std::string_view noun) {
    is_known(examination, path, noun, id, ids_of<std::string_view>(entries));
}

/// Where an entry of each list is named by its id; empty ones are not.
void check_entries_named(ProtocolExamination& examination, const std::string& path,
                         const EntryOfEach& entries) {
    for (std::size_t list = 0; list < stimulus_lists.size(); ++list)
        if (!entries[list].empty())
            is_known(examination, fmt::format("{}.{}", path, stimulus_lists[list].name),
                     stimulus_lists[list].name, entries[list], ids_in_list(examination.protocol, list));
}

/// Levels of columns.
void check_where(ProtocolExamination& examination, const std::string& path, const NamedWords& where) {
    const Factors factors = factors_of(examination.protocol);
    for (const NamedWord& wanted : where) {
        const std::string here = fmt::format("{}.{}", path, wanted.name);
        std::vector<std::string_view> columns, levels;
        for (const Factor& factor : factors.all())
            if (factor.source == Factor::Source::column)
                columns.push_back(factor.name);
        if (!is_known(examination, here, "column", wanted.name, columns))
            continue;
        for (const FactorLevel& level : factors.at(wanted.name).levels)
            levels.push_back(level.name);
        is_known(examination, here, fmt::format("level of {}", wanted.name), wanted.text, levels);
    }
}

/// Whether two effects can hold for one stimulus.
bool can_meet(const Protocol& protocol, const SimulatedEffect& one, const SimulatedEffect& other) {
    const auto of_one = chosen_by(protocol, one), of_other = chosen_by(protocol, other);
    for (std::size_t list = 0; list < stimulus_lists.size(); ++list) {
        bool meets = false;
        for (std::size_t entry = 0; entry < of_one[list].size(); ++entry)
            meets = meets || (of_one[list][entry] && of_other[list][entry]);
        if (!meets)
            return false;
    }
    return true;
}

} // namespace

void check_practice(ProtocolExamination& examination) {
    const Protocol& protocol = examination.protocol;
    for (std::size_t i = 0; i < protocol.practice.size(); ++i) {
        const PracticeSettings& practice = protocol.practice[i];
        const auto path = [&](std::string_view key) { return fmt::format("practice[{}].{}", i, key); };
        check_id(examination, path("task"), practice.task, protocol.tasks, "task");
        check_entries_named(examination, fmt::format("practice[{}]", i), practice.entries);
        if (!practice.block.empty())
            check_id(examination, path("block"), practice.block, protocol.blocks, "block");
    }
}

namespace {

void check_simulated_shares(ProtocolExamination& examination) {
    const Protocol& protocol = examination.protocol;
    std::set<std::string> areas{"head"};
    for (std::size_t i = 0; i < protocol.tasks.size(); ++i) {
        const Task& task = protocol.tasks[i];
        const auto path = [&](std::string_view key) { return fmt::format("task[{}].{}", i, key); };
        double all = 0.0;
        for (const auto& [area, share] : simulated_shares(task))
            all += share;
        for (const auto& [area, share] : task.simulated_area_shares) {
            areas.insert(area);
            if (area == "head" && task.simulated_head_share)
                examination.error({path("simulated_head_share"), path("simulated_area_shares")},
                                  "the head has two shares", "take one of them out");
        }
        if (all > 1.0 + 1e-9)
            examination.error({path("simulated_area_shares"), path("simulated_head_share")},
                              fmt::format("{:.3g} of the fixations would go to areas: 1 is all", all));
    }
    if (areas.size() > most_simulated_areas)
        examination.error({"task"}, fmt::format("{} areas have shares: {} can be kept apart", areas.size(),
                                                most_simulated_areas));
}

/// That there is what an effect on answers is of.
template <class Path>
void check_effect_on_answers(ProtocolExamination& examination, const SimulatedEffect& effect,
                             const Path& path) {
    for (const char* key : {"answer_shift", "answer_slope", "answer_odds"})
        if (effect.answer.empty() && examination.is_written(path(key)))
            examination.error({path(key)}, fmt::format("\"{}\" without \"answer\" is of nothing", key),
                              "name the answer");
    if (effect.answer.empty())
        return;
    std::vector<std::string_view> ids;
    for (const Task& task : examination.protocol.tasks)
        for (const TaskAnswer& answer : task.answers)
            if (effect.task.empty() || effect.task == task.id)
                ids.push_back(answer.id);
    if (std::ranges::find(ids, effect.answer) == ids.end())
        examination.error({path("answer")}, fmt::format("there is no answer \"{}\"", effect.answer),
                          suggest_name(effect.answer, ids));
}

} // namespace

void check_simulated_effects(ProtocolExamination& examination) {
    const Protocol& protocol = examination.protocol;
    const auto& effects = protocol.simulated_effects;
    check_simulated_shares(examination);
    int spots = 0;
    double shares = 0.0;
    for (std::size_t i = 0; i < effects.size(); ++i) {
        const auto path = [&](std::string_view key) {
            return fmt::format("simulated_effect[{}].{}", i, key);
        };
        const SimulatedEffect& effect = effects[i];
        if (!effect.task.empty())
            check_id(examination, path("task"), effect.task, protocol.tasks, "task");
        check_entries_named(examination, fmt::format("simulated_effect[{}]", i), effect.entries);
        check_where(examination, fmt::format("simulated_effect[{}].where", i), effect.where);
        if (effect.area.empty() && examination.is_written(path("area_odds")))
            examination.error({path("area_odds")}, "\"area_odds\" without \"area\" is of nothing",
                              "name the area, or write head_odds");
        if (!effect.area.empty() && examination.is_written(path("head_odds")))
            examination.error({path("head_odds"), path("area")}, "one effect has the odds of one area",
                              "write a [[simulated_effect]] for each");
        check_effect_on_answers(examination, effect, path);
        spots += effect.spot_share > 0.0;
        // What can hold in one trial with this effect, this one included.
        shares = 0.0;
        for (const SimulatedEffect& other : effects) {
            const auto meet = [](const std::string& a, const std::string& b) {
                return a.empty() || b.empty() || a == b;
            };
            if (meet(effect.task, other.task) && can_meet(protocol, effect, other))
                shares += other.spot_share;
        }
        if (effect.spot_share > 0.0 && shares > 1.0)
            examination.error(
                {path("spot_share")},
                fmt::format("with the effects that can hold in the same trials, {:.3g} of the fixations "
                            "would go to spots: 1 is all",
                            shares));
    }
    if (spots > most_simulated_spots)
        examination.error({"simulated_effect"}, fmt::format("{} effects have a spot: {} can be kept apart",
                                                            spots, most_simulated_spots));
}

void check_breaks(ProtocolExamination& examination) {
    const BreakSettings& breaks = examination.protocol.breaks;
    if (breaks.pace == BreakPace::timed && examination.is_written("breaks.min_s"))
        examination.error({"breaks.min_s"}, "\"min_s\" is for breaks that a key ends",
                          "the length of a timed break is \"duration_s\"");
    if (breaks.pace == BreakPace::timed && breaks.duration_s <= 0.0)
        examination.error({"breaks.duration_s"}, "a timed break of 0 s is none");
    if (breaks.between_blocks && examination.protocol.blocks.size() < 2)
        examination.warning({"breaks.between_blocks"}, "there are no blocks to break between");
    const RepeatSettings& repeat = examination.protocol.repeat;
    const bool is_repeated = repeat.missed_refreshes != RepeatWhen::never ||
                             repeat.gaze_lost != RepeatWhen::never || repeat.rejected != RepeatWhen::never;
    if (examination.is_written("repeat.most_attempts") && (!is_repeated || repeat.most_attempts == 1))
        examination.warning({"repeat.most_attempts"},
                            is_repeated ? "with one attempt nothing is ever repeated"
                                        : "nothing is ever repeated: \"missed_refreshes\", \"gaze_lost\" and "
                                          "\"rejected\" are all \"never\"");
}

} // namespace overt
