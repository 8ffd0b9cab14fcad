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

template <class Entries>
std::size_t index_of(std::string_view entry, std::string_view list, const Entries& entries,
                     std::string_view id) {
    const auto found =
        std::ranges::find(entries, id, [](const auto& one) { return std::string_view(one.id); });
    if (found == entries.end())
        throw InputError(fmt::format("\"{}\": there is no {} \"{}\"", entry, list, id));
    return static_cast<std::size_t>(found - entries.begin());
}

int largest_of(const std::vector<int>& codes) {
    return codes.empty() ? 0 : *std::max_element(codes.begin(), codes.end());
}

} // namespace

MarkerCodes::MarkerCodes(const Protocol& protocol, const MarkerOutputSettings& output)
    : tasks_(protocol.tasks.size()), objects_(protocol.objects.size()),
      materials_(protocol.materials.size()) {
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
                fmt::format("\"{}\" is not task, object or material, its id, and what it adds, such "
                            "as \"material gold 20\"",
                            entry));
        int* code = nullptr;
        if (words[0] == "task")
            code = &tasks_[index_of(entry, words[0], protocol.tasks, words[1])];
        else if (words[0] == "object")
            code = &objects_[index_of(entry, words[0], protocol.objects, words[1])];
        else if (words[0] == "material")
            code = &materials_[index_of(entry, words[0], protocol.materials, words[1])];
        else
            throw InputError(fmt::format("\"{}\": \"{}\" is not task, object or material", entry, words[0]));
        *code = number_in(entry, words[2], 0, most, "what is added to a code");
    }
    const int onset = events_[static_cast<std::size_t>(MarkedEvent::onset)];
    const int highest = onset + largest_of(tasks_) + largest_of(objects_) + largest_of(materials_);
    if (!output.condition_codes.empty() && highest > most)
        throw InputError(
            fmt::format("the onset of some trials would have the code {}: {} is the largest", highest, most));
    for (const std::string& entry : output.refresh_codes) {
        const auto words = words_of(entry);
        if (words.size() != 2)
            throw InputError(fmt::format("\"{}\" is not a refresh and its code, such as \"120 4\"", entry));
        const int refreshes = std::max(
            1, static_cast<int>(protocol.motions.front().duration_s * protocol.display.refresh_hz + 0.5));
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
    const auto add = [&](const std::vector<int>& codes, int index) {
        if (index >= 0 && static_cast<std::size_t>(index) < codes.size())
            code += codes[static_cast<std::size_t>(index)];
    };
    add(tasks_, trial.task);
    add(objects_, trial.stimulus.object);
    add(materials_, trial.stimulus.material);
    return code;
}

} // namespace overt
