#include "devices/display_box/switch_record.h"

#include <cstring>
#include <span>
#include <sstream>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/whole_file.h"

namespace overt {
namespace {

namespace fs = std::filesystem;

fs::path record_file(const fs::path& folder) { return folder / "display-switched.txt"; }

} // namespace

void write_switch_record(const fs::path& folder, const SwitchRecord& record) {
    std::error_code error;
    fs::create_directories(folder, error);
    const fs::path file = record_file(folder);
    // A note that a crash takes along is of no use: it is on the disk when this returns.
    const std::string text = fmt::format("port={}\nserial_number={}\nmode={}\nkept={}\n", record.port,
                                         record.serial_number, record.mode, record.kept ? "yes" : "no");
    if (const int reason = replace_file(file, std::as_bytes(std::span(text))); reason != 0)
        throw RecordError(fmt::format(
            "{} cannot be written: {}; it must note that the display is switched, see that the folder "
            "is writable.",
            file.string(), std::strerror(reason)));
}

std::optional<SwitchRecord> read_switch_record(const fs::path& folder) {
    const fs::path file = record_file(folder);
    std::error_code error;
    if (!fs::exists(file, error))
        return std::nullopt;
    std::istringstream stream(read_whole_file(file));
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
