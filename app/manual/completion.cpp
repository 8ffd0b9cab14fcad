#include "app/manual/completion.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace overt {

namespace {

/// In single quotes for a shell, in which a single quote itself is written as `quote`.
std::string quoted(const std::string& text, const std::string& quote) {
    std::string result = "'";
    for (const char letter : text)
        result += letter == '\'' ? quote : std::string(1, letter);
    return result + "'";
}

std::string command_names(const CommandEntry& entry) {
    std::vector<std::string> names;
    for (const CommandEntry& command : entry.commands)
        names.push_back(command.path.substr(command.path.rfind(' ') + 1));
    return fmt::format("{}", fmt::join(names, " "));
}

std::string own_name(const CommandEntry& entry) { return entry.path.substr(entry.path.rfind(' ') + 1); }

std::string above(const CommandEntry& entry) {
    const std::size_t space = entry.path.rfind(' ');
    return space == std::string::npos ? "" : entry.path.substr(0, space);
}

/// Sets `words`, `files` or `asked` of the bash script.
std::string bash_offer(const CommandWord& word) {
    if (is_asked_for(word.kind))
        return fmt::format("asked={}", name_of(word.kind));
    switch (word.kind) {
    case WordKind::choice:
        return fmt::format("words='{}'", fmt::join(word.choices, " "));
    case WordKind::file:
        return "files=all";
    case WordKind::protocol:
        return "files=toml";
    case WordKind::folder:
    case WordKind::session:
        return "files=folders";
    default:
        break;
    }
    return "words=''";
}

/// The action of zsh's _arguments for a word's value.
std::string zsh_action(const CommandWord& word) {
    if (is_asked_for(word.kind))
        return fmt::format(" _overt_asked {}", name_of(word.kind));
    switch (word.kind) {
    case WordKind::choice:
        return fmt::format("({})", fmt::join(word.choices, " "));
    case WordKind::file:
        return "_files";
    case WordKind::protocol:
        return "_files -g \"*.toml(-.)\"";
    case WordKind::folder:
    case WordKind::session:
        return "_files -/";
    default:
        break;
    }
    return " ";
}

/// A text inside a specification of _arguments, where brackets and colons have a meaning.
std::string zsh_text(const std::string& text) {
    std::string escaped;
    for (const char letter : text) {
        if (letter == '[' || letter == ']' || letter == ':' || letter == '\\')
            escaped += '\\';
        escaped += letter;
    }
    return escaped;
}

} // namespace

std::string bash_completion(const CommandEntry& program) {
    std::string steps, values, words;
    for (const CommandEntry* entry : all_entries(program)) {
        if (!entry->path.empty())
            steps += fmt::format("        '{} {}') command='{}'; at=$i ;;\n", above(*entry), own_name(*entry),
                                 entry->path);
        std::vector<std::string> options;
        for (const CommandWord& option : entry->options) {
            options.insert(options.end(), option.names.begin(), option.names.end());
            std::vector<std::string> patterns;
            for (const std::string& name : option.names)
                patterns.push_back(fmt::format("'{} {}'", entry->path, name));
            if (!option.value.empty())
                values += fmt::format("    {}) {} ;;\n", fmt::join(patterns, "|"), bash_offer(option));
        }
        std::string offer = "words=''";
        if (!entry->commands.empty())
            offer = fmt::format("words='{}'", command_names(*entry));
        else if (!entry->positionals.empty())
            offer = bash_offer(entry->positionals.front());
        words +=
            fmt::format("        '{}') options='{}'; {} ;;\n", entry->path, fmt::join(options, " "), offer);
    }
    return fmt::format(R"(# Completion of overt for bash. Written by `overt completion bash`.
_overt() {{
    local current=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}}
    local command='' at=0 i options='' words='' files='' asked=''
    # bash takes "--option=value" for three words.
    if [[ $current == '=' ]]; then
        current=''
    elif [[ $before == '=' ]]; then
        before=${{COMP_WORDS[COMP_CWORD-2]}}
    fi
    for ((i = 1; i < COMP_CWORD; ++i)); do
        ((i == at + 1)) || break
        case "$command ${{COMP_WORDS[i]}}" in
{}        esac
    done
    case "$command $before" in
{}    *)
        case "$command" in
{}        esac
        [[ $current == -* ]] && words=$options files='' ;;
    esac
    # The protocol or the session on the line knows.
    [[ -n $asked ]] && words=$("${{COMP_WORDS[0]/#\~/$HOME}}" completion-words "$asked" "${{COMP_WORDS[@]:1}}" 2>/dev/null)
    COMPREPLY=()
    local IFS=$' \t\n' found
    [[ -n $words ]] && COMPREPLY=($(compgen -W "$words" -- "$current"))
    IFS=$'\n'
    case $files in
    all) COMPREPLY+=($(compgen -f -- "$current")) ;;
    folders) COMPREPLY+=($(compgen -d -- "$current")) ;;
    toml) COMPREPLY+=($(compgen -d -- "$current") $(compgen -f -X '!*.toml' -- "$current")) ;;
    esac
    [[ -n $files ]] && compopt -o filenames 2>/dev/null
    return 0
}}
complete -F _overt overt
)",
                       steps, values, words);
}

std::string zsh_completion(const CommandEntry& program) {
    std::string steps, cases;
    for (const CommandEntry* entry : all_entries(program)) {
        if (!entry->path.empty())
            steps += fmt::format("            ('{} {}') command='{}'; at=$i ;;\n", above(*entry),
                                 own_name(*entry), entry->path);
        std::string specifications;
        for (const CommandWord& option : entry->options) {
            for (const std::string& name : option.names) {
                std::string one = fmt::format("{}[{}]", name, zsh_text(option.what));
                if (!option.value.empty())
                    one += fmt::format(":{}:{}", zsh_text(option.value), zsh_action(option));
                specifications += fmt::format(" \\\n                {}", quoted(one, "'\\''"));
            }
        }
        if (!entry->commands.empty())
            specifications +=
                fmt::format(" \\\n                {}",
                            quoted(fmt::format("1:command:({})", command_names(*entry)), "'\\''"));
        for (const CommandWord& word : entry->positionals)
            specifications += fmt::format(" \\\n                {}",
                                          quoted(fmt::format("{}{}:{}", word.may_come_again ? "*:" : ":",
                                                             zsh_text(word.names.front()), zsh_action(word)),
                                                 "'\\''"));
        cases += fmt::format("        ('{}') _arguments{} ;;\n", entry->path, specifications);
    }
    return fmt::format(R"script(#compdef overt
# Completion of overt for zsh. Written by `overt completion zsh`.
# The protocol or the session on the line knows.
_overt_asked() {{
    compadd -- ${{(f)"$($overt_program completion-words $1 "${{(@)words}}" 2>/dev/null)"}}
}}
_overt() {{
    local command='' at=1 i overt_program=${{~words[1]}}
    for ((i = 2; i < CURRENT; ++i)); do
        ((i == at + 1)) || break
        case "$command ${{words[i]}}" in
{}        esac
    done
    # The command stands first for what follows.
    words=("${{(@)words[at,-1]}}")
    ((CURRENT -= at - 1))
    case "$command" in
{}    esac
}}
_overt "$@"
)script",
                       steps, cases);
}

std::string fish_completion(const CommandEntry& program) {
    std::string script = "# Completion of overt for fish. Written by `overt completion fish`.\n"
                         "complete -c overt -f\n";
    for (const CommandEntry* entry : all_entries(program)) {
        std::string condition = "__fish_use_subcommand";
        if (!entry->path.empty()) {
            const std::string first = entry->path.substr(0, entry->path.find(' '));
            condition = fmt::format("__fish_seen_subcommand_from {}", first);
            if (first != entry->path)
                condition += fmt::format("; and __fish_seen_subcommand_from {}", own_name(*entry));
        }
        if (!entry->path.empty() && !entry->commands.empty())
            condition += fmt::format("; and not __fish_seen_subcommand_from {}", command_names(*entry));
        for (const CommandEntry& command : entry->commands)
            script += fmt::format("complete -c overt -n '{}' -a {} -d {}\n", condition, own_name(command),
                                  quoted(command.what, "\\'"));
        for (const CommandWord& option : entry->options) {
            script += fmt::format("complete -c overt -n '{}'", condition);
            for (const std::string& name : option.names)
                script += name.starts_with("--") ? fmt::format(" -l {}", name.substr(2))
                                                 : fmt::format(" -s {}", name.substr(1));
            if (!option.value.empty())
                script += option.kind == WordKind::other || is_asked_for(option.kind) ? " -x" : " -r";
            if (!option.choices.empty())
                script += fmt::format(" -f -a '{}'", fmt::join(option.choices, " "));
            else if (is_asked_for(option.kind))
                script += fmt::format(
                    " -f -a '(overt completion-words {} (commandline -opc)[2..-1] 2>/dev/null)'",
                    name_of(option.kind));
            else if (!option.value.empty() && option.kind != WordKind::other)
                script += " -F";
            script += fmt::format(" -d {}\n", quoted(option.what, "\\'"));
        }
        for (const CommandWord& word : entry->positionals) {
            if (word.kind == WordKind::choice)
                script += fmt::format("complete -c overt -n '{}' -a '{}'\n", condition,
                                      fmt::join(word.choices, " "));
            else if (word.kind != WordKind::other)
                script += fmt::format("complete -c overt -n '{}' -F\n", condition);
        }
    }
    return script;
}

} // namespace overt
