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

} // namespace overt
