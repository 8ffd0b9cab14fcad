/// Effects that a planned study is to find, as they are written on the command line.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "experiment/protocol/protocol.h"
#include "experiment/study/results/study_results.h"

namespace overt {

/// What is tested between two levels of a factor.
enum class PowerMeasure : std::uint8_t {
    area, ///< share of fixations on an area, by flips of the signs of observers' differences
    wss,  ///< the spread of fixations, by the same
    cc,   ///< the maps of all observers, by swaps of the levels within observers
    // Of answers: differences of answer_differences.h, by flips of the signs of observers' differences.
    threshold, ///< of a psychometric function over the factor that the answer's truth goes by
    slope,     ///< natural logarithm of its slope
    correct,   ///< share of correct answers
    d_prime,
    choice, ///< share of the choice that comes first by its letters
    rating  ///< mean of a scale or a number
};
constexpr bool is_of_answers(PowerMeasure measure) { return measure >= PowerMeasure::threshold; }

/// How an effect on gaze is tested.
enum class PowerTest : std::uint8_t {
    pair,        ///< the difference of two levels, as PowerMeasure says
    factor,      ///< area, wss: the row of the effect's column in factor_effects, over all its levels
    interaction, ///< area, wss: the row of that column and the one that confines the effect
    cluster      ///< cc: clusters of differences on the surface (difference_clusters)
};

/// One planted difference between two levels, and its test.
struct PowerEffect {
    PowerMeasure measure = PowerMeasure::area;
    std::string area;             ///< of an area's share
    std::string answer;           ///< id of the answer, of measures of answers
    std::string task;             ///< id of a task that asks for it
    std::string column;           ///< a factor: "material", "task", "roughness" …
    std::string level, against;   ///< ids of the protocol
    std::vector<StudyKey> within; ///< only in trials of these; empty: all
    /// area: odds of the area in `level` as a multiple of those in `against`. wss: WSS as a multiple. cc:
    /// share of the fixations that goes to one spot in `level`. threshold: how much higher it is in `level`,
    /// in units of its factor. slope: as a multiple. correct, d_prime: odds of a correct answer as a
    /// multiple. choice: how much more its judgement favours the first choice, in standard deviations.
    /// rating: how much higher it is.
    double size = 1.0;
    /// Of a threshold among slots, of which one shows a standard: how many times as far it is from it.
    bool is_ratio = false;
    /// Standard deviation over observers: of the logarithm of odds or ratio, or of the share or shift.
    double sd = 0.0;
    PowerTest test = PowerTest::pair;

    /// The size is a difference, and not a ratio.
    bool is_shift() const {
        return measure == PowerMeasure::cc || (measure == PowerMeasure::threshold && !is_ratio) ||
               measure == PowerMeasure::choice || measure == PowerMeasure::rating;
    }
    /// Of an interaction: the column that confines the effect.
    const std::string& interacting_column() const { return within.front().column; }
    /// Nothing is planted, on average.
    bool is_none() const { return size == (is_shift() ? 0.0 : 1.0); }
    /// As --effect takes it, whole.
    std::string text() const;
    /// "share of fixations on the head, material rough against smooth, task free".
    std::string words() const;
};

/// What is chosen is a slot of the task.
bool is_among_slots(const Task& task, const TaskAnswer& answer);

/// Reads "head:material=rough:odds=1.5", "area=rim:material=rough:odds=1.5", "wss:material=rough:ratio=1.2",
/// "cc:material=rough:share=0.2", and of answers "threshold:object=bust:shift=0.05",
/// "slope:object=bust:ratio=2", "correct:material=rough:odds=1.5", "dprime:material=rough:odds=1.5",
/// "threshold:object=bust:ratio=1.5" of choices among slots, "choice:object=bust:shift=0.5" and
/// "rating:material=rough:shift=0.5", which may name ":answer=ID" (else the first that has the measure); each
/// may go on with ":against=LEVEL" (else the first other level of the protocol), ":sd=0.3", and
/// ":task=ID", ":object=ID" or ":material=ID" for trials of these only. Of gaze ":test=factor",
/// ":test=interaction" (with one column that confines the effect, and is not the object) and, of cc,
/// ":test=cluster" name other tests. "none" is every measure between the first two materials, and the area
/// that is usual (usual_area) of those that simulated observers look at between the first two tasks, without
/// an effect. `areas`: those that the objects have. Throws InputError, which names what is known, and for an
/// area of which the protocol's tasks do not say how often it is looked at.
std::vector<PowerEffect> power_effects(const std::vector<std::string>& texts, const Protocol& protocol,
                                       std::span<const std::string> areas);

/// Reads "12", "6:24", "6:24:3" or "6,12,18": numbers of observers, rising, each once. Throws InputError.
std::vector<int> observer_counts(const std::string& text);

} // namespace overt
