#include "app/replay/export_comparison.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/record/export_formats.h"
#include "experiment/base/error.h"
#include "experiment/base/whole_file.h"
#include "experiment/pictures/picture_file.h"
#include "experiment/record/manifest.h"

namespace overt {

namespace {

namespace fs = std::filesystem;

std::set<std::string> files_below(const fs::path& folder) {
    std::set<std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file())
            files.insert(entry.path().lexically_relative(folder).generic_string());
    return files;
}

/// What a picture says of itself but the date, and its pixels as they are stored.
std::string content_of(const fs::path& file) {
    PictureFile picture(file, "picture");
    const PictureHeader& header = picture.header();
    std::string content = fmt::format("{}x{} {} {}\n", header.size_px.x, header.size_px.y,
                                      fmt::join(header.channels, ","), header.type_name);
    for (const auto& [name, value] : header.attributes)
        if (name != "DateTime")
            content += name + "=" +
                       std::visit(
                           []<class Value>(const Value& is) {
                               if constexpr (std::is_same_v<Value, glm::dvec3>)
                                   return fmt::format("{},{},{}", is.x, is.y, is.z);
                               else
                                   return fmt::format("{}", is);
                           },
                           value) +
                       "\n";
    const std::size_t begin = content.size();
    constexpr std::size_t most_bytes_of_value = 4;
    content.resize(begin + most_bytes_of_value * static_cast<std::size_t>(header.channel_count()) *
                               static_cast<std::size_t>(header.size_px.x) *
                               static_cast<std::size_t>(header.size_px.y));
    picture.read(header.channel_count(), PixelType::other, content.data() + begin);
    return content;
}

bool is_same_picture(const fs::path& a, const fs::path& b) {
    try {
        return a.extension() == ".exr" && content_of(a) == content_of(b);
    } catch (const InputError&) {
        return false; // what is damaged is not the same
    }
}

bool is_text(const std::string& content) { return content.find('\0') == std::string::npos; }

std::string line_at(const std::string& text, std::size_t begin) {
    constexpr std::size_t longest = 160;
    std::string line = text.substr(begin, text.find('\n', begin) - begin);
    return line.size() > longest ? line.substr(0, longest) + " …" : line;
}

std::string difference_of(const std::string& recorded, const std::string& replayed) {
    const auto [a, b] = std::mismatch(recorded.begin(), recorded.end(), replayed.begin(), replayed.end());
    const auto at = static_cast<std::size_t>(a - recorded.begin());
    if (!is_text(recorded) || !is_text(replayed))
        return fmt::format("byte {} of {} differs", at, recorded.size());
    const std::size_t begin = at == 0 ? 0 : recorded.rfind('\n', at - 1) + 1;
    return fmt::format(
        "line {}: recorded {}, replayed {}",
        1 + std::count(recorded.begin(), recorded.begin() + static_cast<std::ptrdiff_t>(begin), '\n'),
        line_at(recorded, begin), line_at(replayed, begin));
}

void compare_files(const fs::path& recorded, const fs::path& replayed, const std::string& prefix,
                   const std::set<std::string>& ours, const std::set<std::string>& theirs,
                   FileComparison& comparison) {
    std::set<std::string> all = ours;
    all.insert(theirs.begin(), theirs.end());
    for (const std::string& file : all) {
        if (!ours.contains(file) || !theirs.contains(file)) {
            comparison.differences.push_back({prefix + file, ours.contains(file)
                                                                 ? "the file is only in the record"
                                                                 : "the file is only in the replay"});
            continue;
        }
        constexpr std::size_t any_size = std::size_t{1} << 40;
        const std::string a = read_whole_file(recorded / file, any_size);
        const std::string b = read_whole_file(replayed / file, any_size);
        ++comparison.files;
        comparison.bytes += a.size();
        if (a != b && !is_same_picture(recorded / file, replayed / file))
            comparison.differences.push_back({prefix + file, difference_of(a, b)});
    }
}

void export_to(const SessionRecord& record, const ExportFormatEntry& entry, const std::string& name,
               const fs::path& folder) {
    static_cast<void>(entry.make()->write({record, name, folder, false, [](int, int) {}}));
}

} // namespace

FileComparison compare_session_files(const fs::path& recorded, const fs::path& replayed,
                                     const std::vector<std::string>& left_out) {
    const auto files_of = [&](const fs::path& folder) {
        std::set<std::string> files;
        for (const std::string& file : files_of_session(folder, false))
            if (std::find(left_out.begin(), left_out.end(), file) == left_out.end())
                files.insert(file);
        return files;
    };
    FileComparison comparison;
    compare_files(recorded, replayed, "", files_of(recorded), files_of(replayed), comparison);
    return comparison;
}

FileComparison compare_exports(const fs::path& recorded, const fs::path& replayed, const fs::path& work,
                               const std::function<void(int done, int all)>& progress) {
    const SessionRecord ours(recorded), theirs(replayed);
    FileComparison comparison;
    int all = 0, done = 0;
    for (const ExportFormatEntry& entry : export_formats())
        all += static_cast<int>(entry.names.size());
    for (const ExportFormatEntry& entry : export_formats()) {
        for (const std::string& name : entry.names) {
            const fs::path a = work / "recorded" / name, b = work / "replayed" / name;
            fs::create_directories(a.parent_path());
            fs::create_directories(b.parent_path());
            export_to(ours, entry, name, a);
            export_to(theirs, entry, name, b);
            compare_files(a, b, name + ": ", files_below(a), files_below(b), comparison);
            fs::remove_all(a);
            fs::remove_all(b);
            progress(++done, all);
        }
    }
    return comparison;
}

} // namespace overt
