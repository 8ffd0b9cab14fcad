/// What becomes of a session's record when the program crashes, as a vendor's library may have it do.
///
/// The handler of the signal does only what is safe in one: it notes where the program stood, and has this
/// very process begin again as a program that knows nothing but the note (execve). That one has sound memory,
/// closes the record, says which library it was, and ends by the same signal, so that whoever started the
/// session sees what a crash looks like.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace overt {

/// While one lives, a crash closes the record of a session. One at a time; main thread. In programs built
/// with a sanitizer, which has handlers of its own, it does nothing.
class CrashGuard {
  public:
    /// `session`: its folder. The vendors' libraries must be loaded (loaded_vendor_libraries()). Where there
    /// are no means for it, a crash is as it would be without.
    explicit CrashGuard(const std::filesystem::path& session);
    ~CrashGuard();
    CrashGuard(const CrashGuard&) = delete;
    CrashGuard& operator=(const CrashGuard&) = delete;
};

/// The first word on the command line of the program that a crash begins.
inline constexpr const char* close_crashed_word = "close-crashed-session";

/// What that program does. `given`: its words, the first of them close_crashed_word. Ends the process by the
/// signal of the crash; gives an exit code where that cannot be.
int close_crashed_session(const std::vector<std::string>& given);

/// Where a program stood when it crashed: a line of /proc/self/maps each, and addresses from the faulting
/// instruction outwards. Gives the file of `libraries` that was at work, which is the one of the first
/// address that lies in the code of one; else the file of the first address; empty if that is in none.
std::string library_at_work(const std::string& maps, const std::vector<std::uint64_t>& addresses,
                            const std::vector<std::string>& libraries);

} // namespace overt
