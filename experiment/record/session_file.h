/// Opening a session file, and refusing what is none.
#pragma once

#include <filesystem>

#include <SQLiteCpp/Database.h>

#include "experiment/error.h"

namespace overt {

/// A session of a format that this program does not know yet.
class NewerFormatError : public RecordError {
  public:
    using RecordError::RecordError;
};

enum class SessionFileUse { read, write };

/// How long a writer waits for somebody who looks into the session with a tool that locks it: its ring holds
/// what comes in meanwhile.
inline constexpr int writer_patience_ms = 20'000;

/// Opens session.sqlite of any state: closed, in use, or left behind by a program that was killed. A change
/// of the file itself that was cut off is taken back first, for readers, too. Throws RecordError if there is
/// none, if it is another kind of file, damaged, or written by a newer program.
SQLite::Database open_session_file(const std::filesystem::path& file, SessionFileUse use);

/// Brings what a log still holds into the file and takes the log away, where nobody else has the file open.
/// Throws RecordError.
void fold_session_file(const std::filesystem::path& file);

} // namespace overt
