#include "app/manual/known_words.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include "app/inputs/protocol_file.h"
#include "experiment/protocol/all_stimuli.h"
#include "experiment/record/read/session_record.h"
#include "experiment/record/session_schema.h"

namespace overt {

namespace {

namespace fs = std::filesystem;

/// What a shell would make of a word: without quotes and backslashes, with the home folder.
std::string plain_word(const std::string& word) {
    std::string plain;
    for (std::size_t i = 0; i < word.size(); ++i) {
        if (word[i] == '\\' && i + 1 < word.size())
            plain += word[++i];
        else if (word[i] != '\'' && word[i] != '"')
            plain += word[i];
    }
    const char* const home = std::getenv("HOME");
    if (home && plain.starts_with("~/"))
        plain.replace(0, 1, home);
    return plain;
}

std::optional<fs::path> named_file(std::span<const std::string> line, bool (*is_it)(const fs::path&)) {
    for (const std::string& word : line) {
        const fs::path path = plain_word(word);
        std::error_code error;
        if (fs::exists(path, error) && is_it(path))
            return path;
    }
    return std::nullopt;
}

bool is_protocol(const fs::path& path) { return path.extension() == ".toml"; }
bool is_session(const fs::path& path) { return fs::exists(path / session_file_name); }

std::vector<std::string> words_of_protocol(WordKind kind, const Protocol& protocol) {
    std::vector<std::string> words;
    if (kind == WordKind::further_tracker)
        for (const FurtherTrackerSettings& further : protocol.further_trackers)
            words.push_back(further.id);
    for (const ObjectSettings& object : protocol.objects) {
        if (kind == WordKind::object)
            words.push_back(object.id);
    }
    if (kind == WordKind::stimulus)
        for (const Stimulus& stimulus : all_stimuli(protocol))
            words.push_back(stimulus_name(protocol, stimulus));
    return words;
}

} // namespace

std::vector<std::string> known_words(WordKind kind, std::span<const std::string> line) try {
    std::vector<std::string> words;
    if (kind == WordKind::trial) {
        if (const auto session = named_file(line, is_session)) {
            const SessionRecord record(*session);
            for (const TrialRecord& trial : record.trials())
                words.push_back(std::to_string(trial.trial.index + 1));
        }
        words.erase(std::unique(words.begin(), words.end()), words.end()); // of a trial that was repeated
        return words;
    }
    Diagnostics unused;
    const auto file = named_file(line, is_protocol);
    const auto protocol = file ? read_protocol_file(*file, unused) : std::nullopt;
    return protocol ? words_of_protocol(kind, *protocol) : words;
} catch (const std::exception&) {
    return {};
}

bool answer_shell(std::span<const std::string> words) {
    if (words.size() < 2 || words[0] != "completion-words")
        return false;
    for (const std::string& word : known_words(kind_named(words[1]), words.subspan(2)))
        fmt::print("{}\n", word);
    return true;
}

} // namespace overt
