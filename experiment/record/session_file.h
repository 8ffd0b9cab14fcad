/// Opening a session file, and refusing what is none.
#pragma once

#include <chrono>
#include <filesystem>

#include <SQLiteCpp/Database.h>

#include "experiment/base/error.h"

namespace overt {

/// A session of a format that this program does not know yet.
class NewerFormatError : public RecordError {
  public:
    using RecordError::RecordError;
};

enum class SessionFileUse {
    read,     ///< by today's names, whatever the file's format (old_names.h)
    as_it_is, ///< to be read by the names that the file itself has
    write
};

/// How long a writer waits for somebody who looks into the session with a tool that locks it: its ring holds
/// what comes in meanwhile.
inline constexpr int writer_patience_ms = 20'000;

/// Opens session.sqlite of any state: closed, in use, or left behind by a program that was killed. A change
/// of the file itself that was cut off is taken back first, for readers, too. Throws RecordError if there is
/// none, if it is another kind of file, damaged, or written by a newer program.
SQLite::Database open_session_file(const std::filesystem::path& file, SessionFileUse use);

/// How long a session that has ended waits for whoever reads it, before it leaves its log to be.
inline constexpr std::chrono::milliseconds fold_patience{2'000};

/// Brings what a log still holds into the file and takes the log away: one plain file can be read from any
/// place, a read-only one too. That takes a moment in which nobody else has the file open; false if there was
/// none for so long: then it stays as it is, which is as good but for that. Throws SQLite::Exception.
[[nodiscard]] bool fold_log(SQLite::Database& database, std::chrono::milliseconds patience = fold_patience);

/// The same of a file that is not open. Throws RecordError.
[[nodiscard]] bool fold_session_file(const std::filesystem::path& file);

} // namespace overt
