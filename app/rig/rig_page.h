/// The page of what was measured on a rig when it was set up (overt doctor --first-day): kept with the rig
/// between runs, and named in the record of each session that runs on it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/figures.h"
#include "app/rig/rig_facts.h"
#include "experiment/base/content_hash.h"
#include "experiment/base/enum_names.h"

namespace overt {

enum class StepVerdict : std::uint8_t {
    open,   ///< not done yet, or left out for now
    proved, ///< by devices that are there
    failed, ///< measured, and not as it has to be
    not_proved
};
template <>
inline constexpr auto names_of<StepVerdict> = enum_names<StepVerdict>("open", "proved", "failed",
                                                                      "not proved");

/// What became of one step of the first day.
struct RigStep {
    std::string name; ///< as --step has it
    StepVerdict verdict = StepVerdict::open;
    bool is_simulated = false; ///< a device was simulated: never proved
    std::string finding;       ///< in sentences
    std::string remedy;        ///< what to do about it; empty: nothing
    std::string measured_utc;  ///< as utc_now() writes it; empty while it is open
    BenchFigures figures;
    RigFacts facts; ///< of the rig that it was measured on, as far as it depends on them
};

struct RigPage {
    std::string begun_utc;
    std::string protocol; ///< name of the protocol that the rig is for
    std::string program;  ///< version and commit of the program that began it
    std::vector<RigStep> steps;

    bool is_finished() const; ///< no step is open
};

/// Where pages are kept: rig/ in state_folder().
std::filesystem::path rig_folder();
/// The machine-readable page, which a further run goes on with; the page to be read lies beside it.
std::filesystem::path rig_page_file(const std::filesystem::path& folder);

std::string to_json_text(const RigPage& page);
/// Throws InputError naming `file` if the text is no such page.
RigPage rig_page_from(const std::string& text, const std::filesystem::path& file);

/// A page as it lies on the disk.
struct KeptRigPage {
    RigPage page;
    std::filesystem::path file;
    ContentHash sha256;
};
/// Nothing if none was begun. Throws as rig_page_from().
std::optional<KeptRigPage> read_rig_page(const std::filesystem::path& folder);

/// What the record of a session says of it, whose rig is now `now`: what is proved, what failed, what is not
/// proved, and which measurements are of another rig. In one line, without places on the machine.
std::string sentence_of(const std::optional<KeptRigPage>& kept, const RigFacts& now);

} // namespace overt
