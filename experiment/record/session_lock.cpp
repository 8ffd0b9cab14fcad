#include "experiment/record/session_lock.h"

#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {

SessionLock::SessionLock(const std::filesystem::path& directory)
    : lock_(directory, FolderLock::Patience::none) {
    if (!lock_.has_folder())
        throw RecordError(fmt::format("{}: there is no session here.", directory.string()));
    if (lock_.is_refused())
        throw RecordError(fmt::format("{}: another program is running this session: wait until it has ended.",
                                      directory.string()));
}

} // namespace overt
