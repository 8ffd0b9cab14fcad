#include "app/manual/command_table.h"

#include <algorithm>
#include <sstream>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace overt {

namespace {

constexpr std::pair<WordKind, std::string_view> asked_kinds[] = {{WordKind::stimulus, "STIMULUS"},
                                                                 {WordKind::object, "OBJECT"},
                                                                 {WordKind::further_tracker, "FURTHER"},
                                                                 {WordKind::trial, "TRIAL"}};

/// By the name under which a word stands in the help.
WordKind kind_called(const std::string& name) {
    if (name == "PROTOCOL")
        return WordKind::protocol;
    if (name == "SESSION")
        return WordKind::session;
    for (const auto& [kind, value] : asked_kinds)
        if (name == value)
            return kind;
    if (name == "DIR")
        return WordKind::folder;
    return name.starts_with("FILE") || name == "MESH" ? WordKind::file : WordKind::other;
}

/// Takes CLI11's "TEXT:{tsv,csv}" or "PX:INT in [16 - 8192]" apart.
void read_type(const std::string& type, CommandWord& word) {
    const std::size_t colon = type.find(':');
    word.value = type.substr(0, colon);
    const std::size_t open = colon + 1, close = type.rfind('}');
    if (colon != std::string::npos && type[open] == '{' && close != std::string::npos) {
        std::istringstream choices(type.substr(open + 1, close - open - 1));
        for (std::string choice; std::getline(choices, choice, ',');)
            word.choices.push_back(choice.substr(0, choice.find("->")));
        word.kind = WordKind::choice;
    } else if (colon != std::string::npos && type.substr(colon + 1) != word.value) {
        word.range = type.substr(colon + 1);
    }
    if (word.value == "TEXT")
        word.value = word.choices.empty() ? "TEXT" : "WORD";
}

CommandWord word_of(const CLI::Option& option) {
    CommandWord word;
    word.what = option.get_description();
    word.is_required = option.get_required();
    word.may_come_again = option.get_expected_max() >= CLI::detail::expected_max_vector_size;
    if (option.get_items_expected_max() > 0) {
        read_type(option.get_type_name(), word);
        word.standard = option.get_default_str();
        if (word.kind == WordKind::other)
            word.kind = kind_called(option.get_positional() ? option.get_name(true) : word.value);
    }
    if (option.get_positional()) {
        word.names = {option.get_name(true)};
        return word;
    }
    for (const std::string& name : option.get_snames())
        word.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames())
        word.names.push_back("--" + name);
    return word;
}

void add_words(CommandEntry& entry, const CLI::App& app) {
    for (const CLI::Option* option : app.get_options()) {
        if (option->get_positional())
            entry.positionals.push_back(word_of(*option));
        else if (!option->get_group().empty())
            entry.options.push_back(word_of(*option));
    }
}

CommandEntry entry_of(const CLI::App& app, const std::string& path) {
    CommandEntry entry;
    entry.path = path;
    entry.what = app.get_description();
    add_words(entry, app);
    std::istringstream footer(app.get_footer());
    for (std::string line; std::getline(footer, line);) {
        if (line.starts_with("  "))
            entry.examples.push_back(line.substr(2));
    }
    for (const CLI::App* command : app.get_subcommands({})) {
        // Without a name it is a group of the command's own options.
        if (command->get_name().empty())
            add_words(entry, *command);
        else if (!command->get_group().empty())
            entry.commands.push_back(
                entry_of(*command, path.empty() ? command->get_name()
                                                : fmt::format("{} {}", path, command->get_name())));
    }
    return entry;
}

} // namespace

bool is_asked_for(WordKind kind) { return !name_of(kind).empty(); }

std::string_view name_of(WordKind kind) {
    const auto* const found =
        std::ranges::find(asked_kinds, kind, &std::pair<WordKind, std::string_view>::first);
    return found == std::end(asked_kinds) ? "" : found->second;
}

WordKind kind_named(std::string_view name) {
    const auto* const found =
        std::ranges::find(asked_kinds, name, &std::pair<WordKind, std::string_view>::second);
    return found == std::end(asked_kinds) ? WordKind::other : found->first;
}

CommandEntry command_table(const CLI::App& app) { return entry_of(app, ""); }

std::vector<const CommandEntry*> all_entries(const CommandEntry& entry) {
    std::vector<const CommandEntry*> all{&entry};
    for (const CommandEntry& command : entry.commands) {
        const std::vector<const CommandEntry*> below = all_entries(command);
        all.insert(all.end(), below.begin(), below.end());
    }
    return all;
}

} // namespace overt
