#include "app/cli/old_spellings.h"

#include <algorithm>
#include <string_view>

namespace overt {

namespace {

struct OldSpelling {
    std::string_view command;        ///< the words of its path
    std::string_view old_name, name; ///< an empty name: its value stands without one now
};

constexpr OldSpelling old_spellings[] = {
    {"run", "--tracker-address", "--address"},
    {"watch", "--socket", "--operator-socket"},
    {"play", "--duration", "--seconds"},
    {"bake", "--only", "--stimulus"},
    {"bake", "--force", "--overwrite"},
    {"display characterise", "--force", "--overwrite"},
    {"display characterise", "--simulated", "--simulate-photometer"},
    {"display colour", "--observer", "--standard-observer"},
    {"doctor", "--protocol", ""},
};

/// Whether the first words are those of a command's path.
bool is_call_of(std::string_view command, const std::vector<std::string>& words) {
    std::string path;
    for (const std::string& word : words) {
        path += path.empty() ? word : " " + word;
        if (path == command)
            return true;
        if (path.size() > command.size())
            return false;
    }
    return false;
}

} // namespace

std::vector<std::string> with_new_spellings(std::vector<std::string> words) {
    std::vector<std::string> renamed;
    for (const std::string& word : words) {
        const std::string_view name = std::string_view(word).substr(0, word.find('='));
        const auto* const old = std::ranges::find_if(old_spellings, [&](const OldSpelling& one) {
            return one.old_name == name && is_call_of(one.command, words);
        });
        if (old == std::end(old_spellings))
            renamed.push_back(word);
        else if (!old->name.empty())
            renamed.push_back(std::string(old->name) + word.substr(name.size()));
        else if (name.size() < word.size())
            renamed.push_back(word.substr(name.size() + 1));
    }
    return renamed;
}

} // namespace overt
