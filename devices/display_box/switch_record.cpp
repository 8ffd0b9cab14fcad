#include "devices/display_box/switch_record.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <string_view>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "experiment/base/error.h"

namespace overt {
namespace {

namespace fs = std::filesystem;

fs::path record_file(const fs::path& folder) { return folder / "display-switched.txt"; }

[[noreturn]] void refuse(const fs::path& file, int error) {
    throw RecordError(fmt::format(
        "{} cannot be written: {}; it must note that the display is switched, see that the folder "
        "is writable.",
        file.string(), std::strerror(error)));
}

/// Writes, and waits until the disk has it: a note that a crash takes along is of no use.
void write_through(const fs::path& file, std::string_view text) {
    const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
    if (descriptor < 0)
        refuse(file, errno);
    bool good = true;
    while (good && !text.empty()) {
        const ssize_t written = ::write(descriptor, text.data(), text.size());
        good = written > 0;
        if (good)
            text.remove_prefix(static_cast<std::size_t>(written));
    }
    good = good && ::fsync(descriptor) == 0;
    const int error = errno;
    ::close(descriptor);
    if (!good)
        refuse(file, error);
}

} // namespace

void write_switch_record(const fs::path& folder, const SwitchRecord& record) {
    std::error_code error;
    fs::create_directories(folder, error);
    const fs::path file = record_file(folder);
    const fs::path fresh = file.string() + ".new";
    write_through(fresh, fmt::format("port={}\nserial_number={}\nmode={}\nkept={}\n", record.port,
                                     record.serial_number, record.mode, record.kept ? "yes" : "no"));
    fs::rename(fresh, file, error);
    if (error)
        refuse(file, error.value());
}

std::optional<SwitchRecord> read_switch_record(const fs::path& folder) {
    const fs::path file = record_file(folder);
    std::error_code error;
    if (!fs::exists(file, error))
        return std::nullopt;
    std::ifstream stream(file);
    SwitchRecord record;
    for (std::string line; std::getline(stream, line);) {
        const std::size_t equals = line.find('=');
        const std::string key = line.substr(0, equals);
        const std::string value = equals == std::string::npos ? "" : line.substr(equals + 1);
        if (key == "port")
            record.port = value;
        else if (key == "serial_number")
            record.serial_number = value;
        else if (key == "mode")
            record.mode = value;
        else if (key == "kept")
            record.kept = value == "yes";
    }
    if (record.port.empty())
        throw RecordError(fmt::format(
            "{} should say which display was switched and names no port; remove it once the display "
            "shows the desktop as usual.",
            file.string()));
    return record;
}

void remove_switch_record(const fs::path& folder) noexcept {
    std::error_code ignored;
    fs::remove(record_file(folder), ignored);
}

} // namespace overt
