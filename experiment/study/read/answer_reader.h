/// What was answered in the trials of a study's sessions.
#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "experiment/factors.h"
#include "experiment/ports/attempt_step.h"
#include "experiment/study/results/answer_rows.h"

namespace overt {

/// Of all trials that give results, in the order of the sessions and their attempts; sessions without answers
/// of [[task.answer]] have none. `same_observer`: labels that stand for another. Throws as SessionRecord
/// does.
std::vector<StudyAnswer> read_answers(std::span<const std::filesystem::path> sessions,
                                      std::span<const std::pair<std::string, std::string>> same_observer);

/// The steps of attempts, by StudyAnswer::session and trial.
using StepsOfTrials = std::map<std::pair<int, int>, std::vector<AttemptStep>>;

/// Adds the drawn times of steps as levels of a factor, "blank_s", to answers whose trials have them: where a
/// step takes a few times, each in several trials. Times that are drawn from a range are none. With several
/// such steps of a kind, "blank_s_2" is the second.
void add_drawn_times(std::vector<StudyAnswer>& answers, const StepsOfTrials& steps);

/// What a trial shows, by place: of each stimulus its level of each factor of stimuli with several. `slots`:
/// ids, by Trial::slot; empty where there are none.
std::vector<AnsweredStimulus> answered_stimuli(const Factors& factors, std::span<const std::string> slots,
                                               const Trial& trial);

/// StudyAnswer::levels of a trial that shows these.
std::vector<std::pair<std::string, std::string>> levels_of(const Trial& trial,
                                                           std::span<const AnsweredStimulus> shown);

} // namespace overt
