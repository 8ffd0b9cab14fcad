#include "experiment/design/block_feedback.h"

#include <algorithm>

#include <fmt/format.h>

namespace overt {

AnswerSummary summary_of(const AnsweredTrials& trials) {
    AnswerSummary summary;
    std::vector<double> times_s;
    for (const std::vector<GivenAnswer>& given : trials) {
        if (given.empty())
            continue;
        ++summary.trials;
        const bool is_missed = std::ranges::any_of(given, &GivenAnswer::is_missed);
        ++(is_missed ? summary.missed : summary.answered);
        if (const std::optional<bool> is_correct = correctness_of(given)) {
            ++summary.known;
            summary.correct += *is_correct ? 1 : 0;
        }
        if (const auto time = given.front().response_time())
            times_s.push_back(to_seconds(*time));
    }
    if (!times_s.empty()) {
        std::ranges::sort(times_s);
        const std::size_t half = times_s.size() / 2;
        summary.median_s =
            times_s.size() % 2 == 1 ? times_s[half] : 0.5 * (times_s[half - 1] + times_s[half]);
    }
    return summary;
}

std::string in_numbers(std::string words, const AnsweredTrials& trials) {
    const AnswerSummary summary = summary_of(trials);
    const std::string none = "–";
    const std::pair<std::string_view, std::string> numbers[] = {
        {"{percent_correct}",
         summary.known > 0 ? fmt::format("{:.0f}", 100.0 * summary.correct / summary.known) : none},
        {"{correct}", summary.known > 0 ? fmt::format("{}", summary.correct) : none},
        {"{answered}", fmt::format("{}", summary.answered)},
        {"{missed}", fmt::format("{}", summary.missed)},
        {"{trials}", fmt::format("{}", summary.trials)},
        {"{median_s}", summary.median_s ? fmt::format("{:.2f}", *summary.median_s) : none}};
    for (const auto& [name, number] : numbers)
        for (std::size_t at = words.find(name); at != std::string::npos; at = words.find(name, at))
            words.replace(at, name.size(), number);
    return words;
}

} // namespace overt
