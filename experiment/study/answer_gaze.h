/// What was looked at before each answer, and whether looking goes with answering.
#pragma once

#include <vector>

#include "experiment/study/answers/answer_results.h"
#include "experiment/study/fixation_maps.h"
#include "experiment/study/results/study_groups.h"

namespace overt {

/// In place of answers where these are slots.
inline const std::string chosen_stimulus = "chosen", other_stimulus = "not chosen";

/// The counted fixations of a presentation that began before an answer.
struct GazeBeforeAnswer {
    const StudyAnswer* answer = nullptr;
    int trial = 0;        ///< index into StudyResults::trials: a slot's presentation
    std::string slot;     ///< id; empty: the experiment has no slots
    double until_s = 0.0; ///< from its onset to the answer
    Fixations fixations;
};

/// Of each answer that was given, one for each stimulus that was lit before it, in trials that are not
/// excluded.
std::vector<GazeBeforeAnswer> gaze_before_answers(const StudyResults& results);

/// For each answer and stimulus a row for the whole and one for each area of its object that is compared.
/// Fixations under way at the answer count up to it.
std::vector<AnswerGazeRow> answer_gaze(const StudyResults& results);

/// By observer and over all, of choices. Among slots: how the stimulus that was chosen was looked at, beside
/// what it would be if each observer chose as often, and looked at each slot as much, independently; and what
/// part of the time on a stimulus was spent on each area, of the chosen less the others. Of words: the same
/// part of a less b. p by flips of the signs of observers' differences, after Holm over the rows of an
/// answer.
///
/// What a stimulus is can make it both looked at and chosen: the rows say that looking goes with answering,
/// not which of them makes the other.
std::vector<GazeChoiceRow> gaze_choices(const StudyResults& results, const StudyOptions& options);

/// Where on each object's surface gaze before one choice differs from gaze before another, within observers,
/// with the test of difference_maps(): of words, a less b for each two of at most three; among slots the
/// chosen stimuli less the others. `p_of_all` is corrected over these maps.
std::vector<DifferenceMap> answer_maps(const StudyResults& results, const ObjectFixationMaps& maps,
                                       const StudyOptions& options);

} // namespace overt
