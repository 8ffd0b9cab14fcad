#include "app/manual/man_page.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace overt {

namespace {

/// A text that says itself: no letter of it is a request, and a hyphen is one that can be copied.
std::string roff(const std::string& text) {
    std::string escaped;
    for (const char letter : text) {
        if (letter == '\\')
            escaped += "\\e";
        else if (letter == '-')
            escaped += "\\-";
        else
            escaped += letter;
    }
    if (!escaped.empty() && (escaped.front() == '.' || escaped.front() == '\''))
        escaped.insert(0, "\\&");
    return escaped;
}

std::string shown_name(const CommandEntry& entry) {
    return entry.path.empty() ? "overt" : fmt::format("overt {}", entry.path);
}

/// What stands between brackets after an option's text.
std::string conditions(const CommandWord& word) {
    std::vector<std::string> parts;
    if (!word.choices.empty())
        parts.push_back(fmt::format("one of {}", fmt::join(word.choices, ", ")));
    if (!word.range.empty())
        parts.push_back(word.range);
    if (!word.standard.empty())
        parts.push_back(fmt::format("default: {}", word.standard));
    if (word.is_required && word.names.front().starts_with('-'))
        parts.emplace_back("required");
    return parts.empty() ? "" : fmt::format(" ({})", fmt::join(parts, "; "));
}

void add_word(std::string& page, const CommandWord& word) {
    page += ".TP\n";
    std::vector<std::string> names;
    for (const std::string& name : word.names)
        names.push_back(fmt::format("\\fB{}\\fR", roff(name)));
    page += fmt::format("{}", fmt::join(names, ", "));
    if (word.names.front().starts_with('-') && !word.value.empty())
        page += fmt::format(" \\fI{}\\fR", roff(word.value));
    page += fmt::format("\n{}{}\n", roff(word.what), roff(conditions(word)));
}

} // namespace

std::string man_page_name(const CommandEntry& entry) {
    std::string name = shown_name(entry);
    std::replace(name.begin(), name.end(), ' ', '-');
    return name;
}

std::string man_page(const CommandEntry& entry, const std::string& version) {
    std::string page =
        fmt::format(".\\\" Written by the program from its table of commands.\n"
                    ".TH {} 1 \"\" \"overt {}\" \"User Commands\"\n.SH NAME\n{} \\- {}\n.SH SYNOPSIS\n",
                    man_page_name(entry), version, roff(man_page_name(entry)), roff(entry.what));
    page += fmt::format(".B {}\n", roff(shown_name(entry)));
    if (!entry.options.empty())
        page += "[\\fIOPTIONS\\fR]\n";
    for (const CommandWord& word : entry.positionals) {
        const std::string name =
            fmt::format("\\fI{}\\fR{}", roff(word.names.front()), word.may_come_again ? "..." : "");
        page += word.is_required ? fmt::format("{}\n", name) : fmt::format("[{}]\n", name);
    }
    if (!entry.commands.empty())
        page += "\\fICOMMAND\\fR\n";
    if (!entry.positionals.empty()) {
        page += ".SH ARGUMENTS\n";
        for (const CommandWord& word : entry.positionals)
            add_word(page, word);
    }
    if (!entry.commands.empty()) {
        page += ".SH COMMANDS\n";
        for (const CommandEntry& command : entry.commands)
            page += fmt::format(".TP\n\\fB{}\\fR(1)\n{}\n", roff(man_page_name(command)), roff(command.what));
    }
    page += ".SH OPTIONS\n";
    for (const CommandWord& word : entry.options)
        add_word(page, word);
    if (!entry.examples.empty()) {
        page += ".SH EXAMPLES\n.nf\n";
        for (const std::string& example : entry.examples)
            page += fmt::format("{}\n", roff(example));
        page += ".fi\n";
    }
    page += ".SH EXIT STATUS\n0: done; 1: failed; 2: bad input.\n"
            ".SH ENVIRONMENT\n.TP\n\\fBOVERT_CACHE\\fR\nFolder of frames, maps and objects "
            "(default: ~/.cache/overt).\n"
            ".TP\n\\fBOVERT_STATE\\fR\nFolder of what is remembered between calls (default: "
            "~/.local/state/overt).\n";
    if (!entry.path.empty())
        page += ".SH SEE ALSO\n\\fBovert\\fR(1), and the documentation in /usr/share/doc/overt.\n";
    else
        page += ".SH SEE ALSO\nThe documentation in /usr/share/doc/overt.\n";
    return page;
}

} // namespace overt
