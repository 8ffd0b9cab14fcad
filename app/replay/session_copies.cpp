#include "app/replay/session_copies.h"

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/path_inside.h"
#include "experiment/record/schema_migration.h"

namespace overt {

namespace fs = std::filesystem;

void copy_file_to(const fs::path& from, const fs::path& to) {
    std::error_code error;
    fs::create_directories(to.parent_path(), error);
    fs::copy_file(from, to, fs::copy_options::overwrite_existing, error);
    if (error)
        throw RecordError(fmt::format("{}: cannot be copied to {} ({}): make room, or set TMPDIR",
                                      from.string(), to.string(), error.message()));
}

void copy_session_file(const fs::path& from, const fs::path& to) {
    copy_file_to(require_file_inside(from.parent_path(), from.filename().string()), to);
    const std::string log = from.filename().string() + "-wal";
    if (is_file_inside(from.parent_path(), log))
        copy_file_to(from.parent_path() / log, to.string() + "-wal");
    migrate_session_file(to, KeptCopy::none);
}

void take_map_files(const SessionRecord& from, const fs::path& into) {
    for (const RecordedMap& map : from.header().maps)
        copy_file_to(require_file_inside(from.directory(), map.file), into / map.file);
}

} // namespace overt
