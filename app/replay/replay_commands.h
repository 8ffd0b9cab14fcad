/// `overt replay`: a recorded session presented again.
#pragma once

#include <filesystem>
#include <optional>

#include "app/cli/chosen_command.h"
#include "app/cli/context_choice.h"

namespace overt {

void add_replay_commands(CLI::App& app, ChosenCommand& chosen);

struct ReplayOptions {
    std::filesystem::path session; ///< its folder, or the session file in it
    std::filesystem::path files;   ///< the folder that the protocol's paths start from; empty: as recorded
    ContextChoice context;         ///< left out: that of the record, a window's in memory
    std::optional<int> trial;      ///< of picture or movie, from 1
    std::string slot;              ///< the same; empty: the first that the trial shows something in
    std::optional<int> frame;      ///< of the picture: a frame period of the presentation, from 1
    std::filesystem::path picture; ///< instead of the comparison; empty: none
    std::filesystem::path movie;   ///< likewise
    bool overwrite = false;        ///< replace picture or movie
    bool json = false;
};
int run_replay(const ReplayOptions& options);

} // namespace overt
