#include "devices/eyelink/left_on_host.h"

#include <algorithm>
#include <cstring>
#include <span>
#include <sstream>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/whole_file.h"

namespace overt {
namespace {

namespace fs = std::filesystem;

fs::path note_file(const fs::path& notes) { return notes / "eyelink-files.txt"; }

/// A line each: name, host and folder between tabs, of which names and addresses have none.
void write_left(const fs::path& notes, const std::vector<LeftOnHost>& all) {
    std::error_code error;
    fs::create_directories(notes, error);
    std::string text;
    for (const LeftOnHost& left : all)
        text += fmt::format("{}\t{}\t{}\n", left.name, left.host, left.folder.string());
    const fs::path file = note_file(notes);
    if (const int reason = replace_file(file, std::as_bytes(std::span(text))); reason != 0)
        throw RecordError(fmt::format("{} cannot be written: {}; it notes which files are still on the "
                                      "EyeLink's host, see that the folder is writable.",
                                      file.string(), std::strerror(reason)));
}

} // namespace

std::vector<LeftOnHost> read_left_on_host(const fs::path& notes) {
    std::vector<LeftOnHost> all;
    std::error_code error;
    if (!fs::exists(note_file(notes), error))
        return all;
    std::istringstream lines(read_whole_file(note_file(notes)));
    for (std::string line; std::getline(lines, line);) {
        const std::size_t first = line.find('\t');
        const std::size_t second = first == std::string::npos ? first : line.find('\t', first + 1);
        if (second != std::string::npos)
            all.push_back({line.substr(0, first), line.substr(first + 1, second - first - 1),
                           fs::path(line.substr(second + 1))});
    }
    return all;
}

void note_left_on_host(const fs::path& notes, const LeftOnHost& left) {
    std::vector<LeftOnHost> all = read_left_on_host(notes);
    if (std::ranges::find(all, left) != all.end())
        return;
    all.push_back(left);
    write_left(notes, all);
}

void forget_left_on_host(const fs::path& notes, const LeftOnHost& left) {
    std::vector<LeftOnHost> all = read_left_on_host(notes);
    if (std::erase(all, left) > 0)
        write_left(notes, all);
}

} // namespace overt
