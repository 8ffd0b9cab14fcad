#include "experiment/protocol/marker_codes.h"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/error.h"

namespace overt {
namespace {

std::vector<std::string_view> words_of(std::string_view text) {
    std::vector<std::string_view> words;
    while (true) {
        const std::size_t begin = text.find_first_not_of(' ');
        if (begin == std::string_view::npos)
            return words;
        const std::size_t end = std::min(text.find(' ', begin), text.size());
        words.push_back(text.substr(begin, end - begin));
        text.remove_prefix(end);
    }
}

/// A whole number from `low` to `high`.
int number_in(std::string_view entry, std::string_view word, int low, int high, std::string_view what) {
    int number = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc() || end != word.data() + word.size() || number < low || number > high)
        throw InputError(fmt::format("\"{}\": {} is a whole number from {} to {}", entry, what, low, high));
    return number;
}

int largest_of(const std::vector<int>& codes) {
    return codes.empty() ? 0 : *std::max_element(codes.begin(), codes.end());
}

} // namespace

MarkerCodes::MarkerCodes(const Protocol& protocol, const MarkerOutputSettings& output)
    : factors_(factors_of(protocol)) {
    const int most = row_of(output.kind).largest_code;
    for (const std::string& entry : output.codes) {
        const auto words = words_of(entry);
        const auto event = words.size() == 2 ? std::ranges::find(names_of<MarkedEvent>, words[0])
                                             : names_of<MarkedEvent>.end();
        if (event == names_of<MarkedEvent>.end())
            throw InputError(
                fmt::format("\"{}\" is not an event and its code, such as \"onset 10\"; events are {}", entry,
                            fmt::join(names_of<MarkedEvent>, ", ")));
        int& code = events_[static_cast<std::size_t>(event - names_of<MarkedEvent>.begin())];
        if (code != 0)
            throw InputError(fmt::format("\"{}\": the event {} has a code already", entry, words[0]));
        code = number_in(entry, words[1], 1, most, "a code");
    }
    for (const std::string& entry : output.condition_codes) {
        const auto words = words_of(entry);
        if (words.size() != 3)
            throw InputError(
                fmt::format("\"{}\" is not a factor such as task, object or material, a level of "
                            "it, and what it adds, such as \"material gold 20\"",
                            entry));
        std::vector<std::string_view> names;
        for (const Factor& factor : factors_.all())
            if (!factor.levels.empty())
                names.push_back(factor.name);
        if (std::ranges::find(names, words[0]) == names.end())
            throw InputError(fmt::format("\"{}\": there is no factor \"{}\"; there are {}", entry, words[0],
                                         fmt::join(names, ", ")));
        const Factor& factor = factors_.at(words[0]);
        const auto level = std::ranges::find(factor.levels, words[1], &FactorLevel::name);
        if (level == factor.levels.end())
            throw InputError(fmt::format("\"{}\": there is no {} \"{}\"", entry, words[0], words[1]));
        auto known = std::ranges::find(levels_, factor.name,
                                       [](const LevelCodes& codes) { return codes.factor.name; });
        if (known == levels_.end())
            known = levels_.insert(known, {factor, std::vector<int>(factor.levels.size())});
        known->codes[static_cast<std::size_t>(level - factor.levels.begin())] =
            number_in(entry, words[2], 0, most, "what is added to a code");
    }
    const int onset = events_[static_cast<std::size_t>(MarkedEvent::onset)];
    int highest = onset;
    for (const LevelCodes& of_factor : levels_)
        highest += largest_of(of_factor.codes);
    if (!output.condition_codes.empty() && highest > most)
        throw InputError(
            fmt::format("the onset of some trials would have the code {}: {} is the largest", highest, most));
    for (const std::string& entry : output.refresh_codes) {
        const auto words = words_of(entry);
        if (words.size() != 2)
            throw InputError(fmt::format("\"{}\" is not a refresh and its code, such as \"120 4\"", entry));
        const int refreshes = std::max(
            1,
            static_cast<int>(std::ranges::max(protocol.motions, {}, &MotionSettings::duration_s).duration_s *
                                 protocol.display.refresh_hz +
                             0.5));
        const int refresh = number_in(entry, words[0], 0, refreshes - 1, "a refresh of the animation");
        if (std::ranges::find(refreshes_, refresh, &RefreshCode::refresh) != refreshes_.end())
            throw InputError(fmt::format("\"{}\": the refresh {} has a code already", entry, refresh));
        refreshes_.push_back({refresh, number_in(entry, words[1], 1, most, "a code")});
    }
    std::ranges::sort(refreshes_, {}, &RefreshCode::refresh);
}

int MarkerCodes::code_of(MarkedEvent event, const Trial& trial) const noexcept {
    int code = events_[static_cast<std::size_t>(event)];
    if (event != MarkedEvent::onset)
        return code;
    for (const LevelCodes& of_factor : levels_)
        code += of_factor.codes[static_cast<std::size_t>(factors_.level_of(of_factor.factor, trial))];
    return code;
}

} // namespace overt
