/// Whether a session on disk is what was recorded, byte by byte.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "experiment/record/verify/seal_check.h"

namespace overt {

struct Verification {
    enum class State : std::uint8_t {
        closed,      ///< ended in order
        interrupted, ///< was killed, or failed: to be gone on with
        running      ///< a program is writing it now
    };
    State state = State::closed;
    std::vector<Damage> damages;
    std::vector<std::string> notes; ///< what is no damage, and is to be known
    std::int64_t seals = 0, files = 0, bytes = 0;
    bool is_sound() const { return damages.empty(); }
};
std::string_view name_of(Verification::State state);

/// Reads all of a session: the files of its manifest, its write-ahead log and all sealed rows. Changes
/// nothing. Throws InputError if the folder is no session's, or if it is as it was recorded, by a newer
/// program.
Verification verify_session(const std::filesystem::path& folder);

/// What is not as it was sealed among the rows of a session, a sentence for each; nothing else of the session is
/// looked at, and nothing said of what has no seals: sessions of early formats, and rows of a trial that runs.
/// What cannot be opened has none: reading it says why. From any thread.
std::vector<std::string> broken_seals(const std::filesystem::path& session);

} // namespace overt
