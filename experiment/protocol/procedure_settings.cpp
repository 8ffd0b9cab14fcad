#include "experiment/protocol/procedure_settings.h"

#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/procedures/constant_stimuli.h"
#include "experiment/procedures/quest.h"

namespace overt {

namespace {

bool is_in_decibels(const ProcedureSettings& settings) {
    return settings.kind == ProcedureKind::quest_plus && settings.function == QuestFunction::weibull_db;
}

StaircaseSettings staircase_of(const ProcedureSettings& settings, const std::vector<double>& levels) {
    StaircaseSettings made;
    made.start = settings.start.value_or(levels.back());
    made.up_after = settings.up;
    made.down_after = settings.down;
    made.scale = settings.scale;
    made.steps = settings.steps;
    made.steps_down = settings.steps_down;
    made.lowest = settings.lowest.value_or(levels.front());
    made.highest = settings.highest.value_or(levels.back());
    made.initial_rule = settings.initial_rule;
    made.trials = settings.trials;
    made.reversals = settings.reversals;
    made.stop = StopRule::either;
    made.discard = settings.discard;
    made.missed = settings.missed;
    if (settings.scale == StepScale::places)
        for (const double level : levels)
            if (level >= *made.lowest && level <= *made.highest)
                made.levels.push_back(level);
    return made;
}

} // namespace

double track_level(const ProcedureSettings& settings, double level) {
    if (settings.kind == ProcedureKind::quest)
        return std::log10(level);
    return is_in_decibels(settings) ? 20.0 * std::log10(level) : level;
}

double level_of_track(const ProcedureSettings& settings, double track_level) {
    if (settings.kind == ProcedureKind::quest)
        return std::pow(10.0, track_level);
    return is_in_decibels(settings) ? std::pow(10.0, track_level / 20.0) : track_level;
}

std::unique_ptr<LevelTrack> make_track(const ProcedureSettings& settings, const std::vector<double>& levels,
                                       std::uint64_t seed) {
    std::vector<double> on_track;
    for (const double level : levels)
        on_track.push_back(track_level(settings, level));
    switch (settings.kind) {
    case ProcedureKind::constant: {
        const std::vector<double>& chosen = settings.levels.empty() ? levels : settings.levels;
        const int repetitions =
            (settings.trials + static_cast<int>(chosen.size()) - 1) / static_cast<int>(chosen.size());
        return std::make_unique<ConstantStimuli>(
            ConstantStimuliSettings{chosen, repetitions, settings.missed, seed});
    }
    case ProcedureKind::staircase:
        return std::make_unique<Staircase>(staircase_of(settings, levels));
    case ProcedureKind::quest: {
        QuestSettings quest;
        quest.guess = settings.start ? track_level(settings, *settings.start)
                                     : 0.5 * (on_track.front() + on_track.back());
        quest.guess_sd = settings.guess_sd;
        quest.p_threshold = settings.p_threshold;
        quest.beta = settings.beta;
        quest.delta = settings.delta;
        quest.gamma = settings.guess_rate;
        quest.trials = settings.trials;
        quest.levels = on_track;
        quest.missed = settings.missed;
        return std::make_unique<Quest>(quest);
    }
    case ProcedureKind::quest_plus:
        break;
    }
    QuestPlusSettings quest;
    quest.function = settings.function;
    quest.levels = on_track;
    quest.threshold.values = settings.thresholds.empty() ? on_track : settings.thresholds;
    quest.slope.values = settings.slopes;
    quest.guess.values = {settings.guess_rate};
    quest.lapse.values = settings.lapse_rates;
    quest.trials = settings.trials;
    quest.entropy_bits = settings.entropy_bits;
    quest.missed = settings.missed;
    return std::make_unique<QuestPlus>(std::move(quest));
}

std::string procedure_in_words(const ProcedureSettings& settings) {
    switch (settings.kind) {
    case ProcedureKind::constant:
        return settings.levels.empty() ? "all levels equally often, in an order that is drawn"
                                       : fmt::format("the levels {} equally often, in an order that is drawn",
                                                     fmt::join(settings.levels, ", "));
    case ProcedureKind::staircase: {
        const double up = settings.steps.back(),
                     down = settings.steps_down.empty() ? up : settings.steps_down.back();
        const std::string_view unit = settings.scale == StepScale::places ? " place(s) of the series"
                                      : settings.scale == StepScale::db   ? " dB"
                                      : settings.scale == StepScale::log  ? " log units"
                                                                          : "";
        return fmt::format("a staircase from {}, {} up {} down in steps of {}{}, which settles where {:.1f} "
                           "% answer \"yes\"",
                           settings.start ? fmt::format("{}", *settings.start) : "the highest level",
                           settings.up, settings.down, fmt::join(settings.steps, ", "), unit,
                           100.0 * staircase_target(settings.up, settings.down, up, down));
    }
    case ProcedureKind::quest:
        return fmt::format("QUEST: the level at which {:.0f} % answer \"yes\", by its posterior",
                           100.0 * settings.p_threshold);
    case ProcedureKind::quest_plus:
        break;
    }
    return fmt::format("QUEST+: the level whose answer says most about threshold and slope of a {} function",
                       name_of(settings.function));
}

} // namespace overt
