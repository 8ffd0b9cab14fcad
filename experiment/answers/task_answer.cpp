#include "experiment/answers/task_answer.h"

#include "experiment/answers/answer_kinds.h"

namespace overt {

bool TaskAnswer::accepts_by_key() const {
    return accept.value_or(row_of(kind).accepts_by_key ? AnswerAccept::by_key : AnswerAccept::at_once) ==
           AnswerAccept::by_key;
}

std::string TaskAnswer::key_of_step(int index) const {
    constexpr int most_digits = 9;
    const auto at = static_cast<std::size_t>(index);
    if (!keys.empty())
        return at < keys.size() ? keys[at] : std::string();
    return steps && *steps <= most_digits ? std::string(1, static_cast<char>('1' + index)) : std::string();
}

} // namespace overt
