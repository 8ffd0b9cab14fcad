#include <algorithm>
#include <cstdio>
#include <memory>
#include <vector>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/record/asc/asc_parser.h"

namespace overt {

void parse_asc_file(const std::filesystem::path& file, AscParser& parser,
                    const std::function<void(std::int64_t, std::int64_t)>& progress) {
    std::error_code error;
    const auto all = static_cast<std::int64_t>(std::filesystem::file_size(file, error));
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(
        error || !std::filesystem::is_regular_file(file) ? nullptr : std::fopen(file.c_str(), "rb"),
        &std::fclose);
    if (!stream)
        throw InputError(
            fmt::format("{}: this file cannot be read. Give the path of a recording in EyeLink's "
                        "text form (.asc).",
                        file.string()));
    std::vector<char> piece(std::size_t{1} << 20);
    std::string unfinished;
    std::int64_t read = 0;
    while (const std::size_t count = std::fread(piece.data(), 1, piece.size(), stream.get())) {
        std::string_view text(piece.data(), count);
        for (std::size_t end = text.find('\n'); end != std::string_view::npos; end = text.find('\n')) {
            if (unfinished.empty()) {
                parser.line(text.substr(0, end));
            } else {
                unfinished.append(text.substr(0, end));
                parser.line(unfinished);
                unfinished.clear();
            }
            text.remove_prefix(end + 1);
        }
        // Of a line that is too long anyway not all needs to be kept.
        unfinished.append(text.substr(0, std::min(text.size(), 2 * longest_asc_line)));
        unfinished.resize(std::min(unfinished.size(), 4 * longest_asc_line));
        read += static_cast<std::int64_t>(count);
        if (progress)
            progress(read, all);
    }
    if (std::ferror(stream.get()) != 0)
        throw InputError(fmt::format("{}: reading failed after {} bytes.", file.string(), read));
    if (!unfinished.empty())
        parser.line(unfinished);
    parser.end();
}

} // namespace overt
