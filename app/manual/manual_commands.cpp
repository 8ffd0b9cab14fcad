#include "app/manual/manual_commands.h"

#include <cstdio>
#include <filesystem>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/cli/command_options.h"
#include "app/cli/this_program.h"
#include "app/manual/completion.h"
#include "app/manual/man_page.h"
#include "experiment/base/whole_file.h"

namespace overt {

namespace {

int print_completion(const CLI::App& app, const std::string& shell) {
    const CommandEntry table = command_table(app);
    fmt::print("{}", shell == "bash"  ? bash_completion(table)
                     : shell == "zsh" ? zsh_completion(table)
                                      : fish_completion(table));
    return 0;
}

int write_man_pages(const CLI::App& app, const std::filesystem::path& folder) {
    const CommandEntry table = command_table(app);
    std::filesystem::create_directories(folder);
    for (const CommandEntry* entry : all_entries(table))
        write_whole_file(folder / fmt::format("{}.1", man_page_name(*entry)),
                         man_page(*entry, this_build().version));
    return 0;
}

} // namespace

void add_manual_commands(CLI::App& app, ChosenCommand& chosen) {
    const auto shell = std::make_shared<std::string>();
    CLI::App& completion =
        add_command(app, "completion", "Prints a script by which a shell completes command lines",
                    "overt completion bash > ~/.local/share/bash-completion/completions/overt");
    completion.add_option("SHELL", *shell, "Shell")->required()->check(one_of({"bash", "zsh", "fish"}));
    run_when_chosen(completion, chosen, [&app, shell] { return print_completion(app, *shell); });

    const auto folder = std::make_shared<std::filesystem::path>();
    CLI::App& pages = add_command(app, "man-pages", "Writes the manual pages", "overt man-pages man1");
    pages.add_option("DIR", *folder, "Folder to write to")->required();
    // For those who build and package it.
    pages.group("");
    run_when_chosen(pages, chosen, [&app, folder] { return write_man_pages(app, *folder); });
}

} // namespace overt
