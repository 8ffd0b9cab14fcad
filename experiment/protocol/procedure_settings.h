/// What chooses the levels of a task's trials, as a protocol states it. Explained key by key in
/// procedure_keys.cpp.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiment/base/enum_names.h"
#include "experiment/procedures/quest_plus.h"
#include "experiment/procedures/staircase.h"

namespace overt {

enum class ProcedureKind : std::uint8_t { constant, staircase, quest, quest_plus };
template <>
inline constexpr auto names_of<ProcedureKind> = enum_names<ProcedureKind>("constant", "staircase", "quest",
                                                                          "quest-plus");

/// [[procedure]]: one track in each condition of each task that names it. Levels are those of the factor that
/// the task's trials go by; `quest` takes their common logarithms, and `quest-plus` with the Weibull function
/// 20 times these (decibels).
struct ProcedureSettings {
    std::string id;
    ProcedureKind kind = ProcedureKind::staircase;
    int trials = 40;                         ///< in each condition, at most
    int reversals = 0;                       ///< of a staircase, after which it ends; 0: by its trials alone
    std::optional<double> entropy_bits = {}; ///< of QUEST+, at which it ends
    std::string answer;                      ///< id of the answer that it reads; empty: the first of the task
    std::string yes;                         ///< "correct", "test", or a choice; empty: see yes_of()
    UnansweredTrial missed = UnansweredTrial::repeat;

    std::vector<double> levels; ///< of constant stimuli; empty: all

    // Of staircases.
    std::optional<double> start; ///< also the guess of QUEST
    int up = 1, down = 2;
    StepScale scale = StepScale::places;
    std::vector<double> steps{1.0}, steps_down;
    std::optional<double> lowest, highest;
    bool initial_rule = true;
    int discard = 2;

    // Of QUEST.
    double guess_sd = 0.5, p_threshold = 0.82, beta = 3.5, delta = 0.01;
    double guess_rate = 0.5; ///< also of QUEST+

    // Of QUEST+.
    QuestFunction function = QuestFunction::logistic;
    std::vector<double> thresholds, slopes;
    std::vector<double> lapse_rates{0.02};
};

/// The level as the procedure reckons with it, and back.
double track_level(const ProcedureSettings& settings, double level);
double level_of_track(const ProcedureSettings& settings, double track_level);

/// A track of the procedure over these levels, rising. The settings must be sound (check_procedures).
std::unique_ptr<LevelTrack> make_track(const ProcedureSettings& settings, const std::vector<double>& levels,
                                       std::uint64_t seed);

/// What a procedure does, for a person: "from 0.2, 1 up 2 down in steps of 1 place, which settles where 70.7
/// % answer yes".
std::string procedure_in_words(const ProcedureSettings& settings);

} // namespace overt
