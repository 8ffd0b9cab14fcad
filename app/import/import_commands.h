/// The command `import`: an EyeLink recording as a session, or what any other program recorded while another
/// presented.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/cli/chosen_command.h"
#include "app/cli/context_choice.h"
#include "app/record/record_commands.h"

namespace overt {

void add_import_commands(CLI::App& app, ChosenCommand& chosen);

/// Of an import with --protocol; `of_gaze` has what both kinds have alike.
struct ForeignImportOptions {
    ImportOptions of_gaze;
    std::filesystem::path protocol; ///< of what was shown; empty: an EyeLink recording without stimuli
    std::filesystem::path trials;   ///< log of trials; empty: the gaze's own column says what was shown
    std::filesystem::path frames;   ///< log of frames; empty: as the protocol plans them
    std::vector<std::string> columns, trial_columns, frame_columns; ///< KEY=COLUMN
    ContextChoice context;
};
int run_any_import(const ForeignImportOptions& options);

/// Makes the session of a protocol that other programs presented and recorded. Throws as run_import().
int run_foreign_import(const ForeignImportOptions& options);

} // namespace overt
