/// manifest.json in a session's folder: the hash and size of each file, of what the session was made from,
/// and of the programs that ran it. Nothing in it names a place on the machine.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "experiment/base/content_hash.h"
#include "experiment/record/session_header.h"

namespace overt {

inline constexpr const char* manifest_file_name = "manifest.json";

struct SessionManifest {
    struct Program {
        std::string name, version;
        ContentHash sha256; ///< of its file
        bool operator==(const Program&) const = default;
    };
    /// What is not in the folder, and is known by its hash.
    struct Input {
        std::string what;
        ContentHash sha256;
    };
    struct File {
        std::string path; ///< relative to the folder, with "/"
        std::uint64_t bytes = 0;
        ContentHash sha256;
    };
    std::string protocol, observer;
    int session_number = 1;
    bool is_closed = false; ///< the session ended in order: session.sqlite is among the files
    std::vector<Program> programs;
    std::vector<Input> inputs;
    std::vector<File> files;
};

/// JSON, with the hash of all that stands before it in its last line.
std::string to_text(const SessionManifest& manifest);

/// Throws RecordError naming `file` if one byte of the text is not as to_text() made it.
SessionManifest manifest_from(const std::string& text, const std::filesystem::path& file);

/// Throws RecordError if it is not there or damaged.
SessionManifest read_manifest(const std::filesystem::path& folder);

/// What the name of a file ends with that a transfer did not bring whole: it gets its own name, and its whole
/// content, when it is fetched again.
inline constexpr const char* partial_suffix = ".part";

/// All files of a session's folder that a manifest names, with relative paths, sorted: not itself, no hidden
/// file, no link, nothing that is no file, no folder of an export, nothing that belongs to session.sqlite, no
/// file that has come in part (partial_suffix); session.sqlite only if wanted.
std::vector<std::string> files_of_session(const std::filesystem::path& folder, bool with_session_file);

/// Writes the manifest of a folder that is being made: all files but session.sqlite, which is about to
/// change. Throws RecordError.
void begin_manifest(const std::filesystem::path& folder, const SessionHeader& header,
                    const SessionManifest::Program& program);

/// Before a session is gone on with: session.sqlite will change. Makes a manifest anew where there is none,
/// or none that can be read. Throws RecordError.
void reopen_manifest(const std::filesystem::path& folder, const SessionHeader& header,
                     const SessionManifest::Program& program);

/// When the session has ended in order: adds session.sqlite and the files that have come since. Those that
/// were there keep the hashes they had. False, and nothing done, while session.sqlite still needs its log,
/// because somebody reads it or the disk is full. Throws RecordError.
[[nodiscard]] bool close_manifest(const std::filesystem::path& folder);

} // namespace overt
