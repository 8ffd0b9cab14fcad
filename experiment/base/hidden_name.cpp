#include "experiment/base/hidden_name.h"

#include <cerrno>
#include <charconv>
#include <csignal>
#include <optional>

#include <fmt/format.h>
#include <unistd.h>

namespace overt {
namespace {

std::string infix_of_machine() {
    char host[65] = "";
    ::gethostname(host, sizeof host - 1);
    return fmt::format(".partial-{}-", host);
}

/// The process of this machine that hid something under this name; nothing if none did.
std::optional<::pid_t> writer_of(std::string_view name) {
    const std::string between = infix_of_machine();
    const std::size_t at = name.rfind(between);
    if (!name.starts_with('.') || at == std::string_view::npos)
        return std::nullopt;
    ::pid_t writer = 0;
    const char* const end = name.data() + name.size();
    const auto [rest, error] = std::from_chars(name.data() + at + between.size(), end, writer);
    if (error != std::errc() || writer <= 0 || rest == end || *rest != '-')
        return std::nullopt;
    return writer;
}

} // namespace

std::string hidden_infix() { return fmt::format("{}{}-", infix_of_machine(), ::getpid()); }

bool is_abandoned_name(std::string_view name) {
    const std::optional<::pid_t> writer = writer_of(name);
    return writer && ::kill(*writer, 0) != 0 && errno == ESRCH;
}

void remove_abandoned_folders(const std::filesystem::path& path) noexcept {
    namespace fs = std::filesystem;
    std::error_code ignored;
    try {
        const std::string begin = fmt::format(".{}.partial-", path.filename().string());
        for (const auto& entry : fs::directory_iterator(path.parent_path(), ignored)) {
            const std::string name = entry.path().filename().string();
            const bool is_folder = entry.symlink_status(ignored).type() == fs::file_type::directory;
            if (is_folder && name.starts_with(begin) && is_abandoned_name(name))
                fs::remove_all(entry.path(), ignored);
        }
    } catch (...) {
        // A folder that cannot be read keeps what is in it.
    }
}

} // namespace overt
