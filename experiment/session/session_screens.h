/// All screens of a session that stand between its presentations, in the protocol's words.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "experiment/ports/presenter.h"
#include "experiment/protocol/protocol.h"

namespace overt::screens {

/// A text that a key ends.
Screen text(const Protocol& protocol, std::string text);

Screen consent(const Protocol& protocol);
/// `page`: from 0.
Screen instructions(const Protocol& protocol, std::size_t page);
Screen farewell(const Protocol& protocol);

Screen question(const Protocol& protocol, int task);
Screen response(const Protocol& protocol, int task);

/// What is answered in a trial of a task, as it looks now. The task's question stands above it where no
/// answer has one of its own, and always with [screens] repeat_question.
Screen answers(const Protocol& protocol, int task, AnswerView view);
/// Of each task the screens of its answers before anything is answered, of several pages the first, as a
/// trial that asks in the order of the protocol has them.
struct TaskScreen {
    int task = 0;
    std::string name; ///< the task's id, with a number where it asks on several
    Screen screen;
};
std::vector<TaskScreen> answers_of_tasks(const Protocol& protocol);

/// How long keys do nothing in a break, or how long it lasts, if only time ends it; s.
double break_asleep_s(const BreakSettings& breaks);
/// While keys do nothing, and after that.
Screen break_asleep(const Protocol& protocol);
Screen break_awake(const Protocol& protocol);

/// What is not the observer's to answer stands in a frame.
Screen pause(const Protocol& protocol);
Screen keyboard_lost(const Protocol& protocol);
Screen operator_question(const Protocol& protocol, const std::string& question);
/// With the reasons, which digits choose.
std::string skip_question(const Protocol& protocol);

/// Gaze beside its targets, and a question to the operator.
Screen validation(const Protocol& protocol, const ValidationResult& found, const std::string& question);

/// While the session is at work.
Screen please_wait(const Protocol& protocol);

/// Every screen that this protocol's sessions can show, with a short name for it: results of a validation
/// with errors that are made up, one within the protocol's limits and one beyond them. A camera's image is
/// none of them: the tracker makes it.
std::vector<std::pair<std::string, Screen>> all_of(const Protocol& protocol);

} // namespace overt::screens
