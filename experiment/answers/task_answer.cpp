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

std::vector<std::string> TaskAnswer::match_keys() const {
    if (!keys.empty())
        return keys;
    return along.size() > 1 ? std::vector<std::string>{"left", "right", "down", "up"}
                            : std::vector<std::string>{"left", "right"};
}

std::vector<std::string> TaskAnswer::match_coarse_keys() const {
    if (!coarse_keys.empty() || !keys.empty() || along.size() > 1)
        return coarse_keys;
    return {"page down", "page up"};
}

} // namespace overt
