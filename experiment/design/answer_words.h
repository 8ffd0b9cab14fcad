/// What a task asks, in sentences.
#pragma once

#include <string>

#include "experiment/protocol/protocol.h"

namespace overt {

/// Lines on each answer of a task for a person: what is asked, with which keys, when presses begin and cease
/// to count, what the response time counts from, and what is correct. Empty where the answer is spoken.
std::string describe_answers(const Protocol& protocol, const Task& task);

} // namespace overt
