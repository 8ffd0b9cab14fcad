#include "experiment/study/results/answer_rows.h"

#include <algorithm>

namespace overt {

const std::string& StudyAnswer::level(const std::string& factor) const {
    static const std::string none;
    const auto found = std::ranges::find(levels, factor, &std::pair<std::string, std::string>::first);
    return found != levels.end() ? found->second : none;
}

std::optional<double> AnsweredStimulus::number(const std::string& factor) const {
    const auto found = std::ranges::find(numbers, factor, &std::pair<std::string, double>::first);
    return found != numbers.end() ? std::optional(found->second) : std::nullopt;
}

bool asks_for_choice(const StudyAnswer& answer) {
    return answer.kind == "choice" || answer.kind == "key" || answer.kind == odd_one_out_kind;
}

bool is_choice(const StudyAnswer& answer) {
    return !answer.is_missed && !answer.number && answer.kind != "text" && answer.kind != "spoken" &&
           answer.kind != "point" && answer.kind != "gauge";
}

bool is_rating(const StudyAnswer& answer) {
    return answer.number && answer.kind != "match" && answer.kind != "gauge";
}

} // namespace overt
