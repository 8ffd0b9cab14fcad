/// What the command line takes, as a table: what man pages and the completion of shells are made of, so that
/// they say what the program does and nothing else.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace overt {

/// What a shell offers for a word.
enum class WordKind {
    other,
    choice,
    file,
    folder,
    protocol,
    session,
    // By what stands in the protocol, or the session, that the line names: see known_words().
    stimulus,
    object,
    further_tracker,
    trial
};

/// Whether a shell has to ask for the words, and by which name it asks; `other` for a name that is none.
bool is_asked_for(WordKind kind);
std::string_view name_of(WordKind kind);
WordKind kind_named(std::string_view name);

/// An option, or a word without a name (a positional).
struct CommandWord {
    std::vector<std::string> names; ///< "-h", "--help"; of a positional its one name, "PROTOCOL"
    std::string value;              ///< what is to be written after it, "DEG"; empty: a flag
    std::string range;              ///< what holds for the value: "FLOAT in [0 - 20]"; may be empty
    std::string standard;           ///< the value that is taken if none is given; may be empty
    std::string what;
    std::vector<std::string> choices; ///< the words that it takes, where these are listed
    bool is_required = false, may_come_again = false;
    WordKind kind = WordKind::other;
};

/// A command with its own commands, in the order of the help.
struct CommandEntry {
    std::string path; ///< "tracker calibrate"; empty: the program itself
    std::string what;
    std::vector<CommandWord> options, positionals;
    std::vector<std::string> examples; ///< command lines, or what stands around them
    std::vector<CommandEntry> commands;
};

/// The table of a command line; commands of the group "" are hidden and left out.
CommandEntry command_table(const CLI::App& app);

/// The entry and all below it, itself first.
std::vector<const CommandEntry*> all_entries(const CommandEntry& entry);

} // namespace overt
