/// What a trial asks, made before it runs: which keys mean what, in which order items come, and what is
/// correct.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "experiment/answers/answering.h"
#include "experiment/protocol/protocol.h"

namespace overt {

/// What the answers of a trial depend on.
struct AskedTrial {
    const Protocol& protocol; ///< outlives the forms
    const Trial& trial;
    std::uint64_t seed = 0; ///< of the session
    int observer = 1;       ///< the observer's number, from 1
    int rank = 0;           ///< which of its task's trials it is in the observer's order, from 0
    bool is_practice = false;
};

/// One for each answer, or for each item of a scale, in the order in which they are asked. `answers`: indices
/// into the task's, none of them spoken. `first_place`: of the first among all that the trial asks. Orders
/// and mappings are drawn from streams of their own by seed and trial: each attempt has the same.
std::vector<AnswerForm> answer_forms(const AskedTrial& asked, const std::vector<int>& answers,
                                     int first_place);

/// The probe at which a gauge stands; null if there is none.
const ProbeSettings* probe_of(const Task& task, const TaskAnswer& answer);

/// How many ways round the keys of an answer can be: its choices, or the two sides of a scale.
int mappings_of(const TaskAnswer& answer);

/// The correct answer as a value; empty: there is none.
std::string correct_value(const Protocol& protocol, const TaskAnswer& answer, const Trial& trial);

/// Of an answer's choices, as the observer reads them: its labels, the titles of slots, or the choices.
std::vector<std::string> labels_of(const Protocol& protocol, const TaskAnswer& answer);

/// For each trial, which of its task's it is in the order, from 0.
std::vector<int> ranks_in_tasks(const std::vector<Trial>& trials);

} // namespace overt
