/// What one of several machines has read of a study's sessions, as a file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiment/study/read/study_reader.h"
#include "experiment/study/results/study_options.h"

namespace overt {

struct StudyShard {
    int number = 1, count = 1;              ///< "2/4"
    std::vector<std::string> sessions;      ///< of the whole study, absolute, in its order
    std::vector<StudyParameter> parameters; ///< those that decide what is read: reading_parameters()
    std::vector<ReadSession> read;          ///< its own: of sessions number - 1, number - 1 + count, …
};

/// The file's name in the folder of a shard.
inline constexpr const char* shard_file_name = "shard.overt";

bool is_shard(const std::filesystem::path& folder);

/// Of parameters_of(options) those that change what is read from a trial; others only say what is reckoned
/// from it.
std::vector<StudyParameter> reading_parameters(const StudyOptions& options);

/// Numbers are written with all their bits, followed by the SHA-256 of all before. Throws RecordError.
void write_shard(const std::filesystem::path& folder, StudyShard shard);

/// Throws InputError if the folder has none, or one of another version, RecordError if it is damaged.
StudyShard read_shard(const std::filesystem::path& folder);

/// All sessions of the study in its order. `names` are the shards' folders, for messages. Throws InputError
/// if a shard is missing or twice, if they are of different studies, or were read with other options than
/// these.
std::vector<ReadSession> joined_shards(std::vector<StudyShard> shards, const std::vector<std::string>& names,
                                       const StudyOptions& options);

} // namespace overt
