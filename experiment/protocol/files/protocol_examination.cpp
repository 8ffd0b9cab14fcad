#include "experiment/protocol/files/protocol_examination.h"

#include <algorithm>

#include <fmt/format.h>

namespace overt {

void ProtocolExamination::error(std::initializer_list<std::string_view> paths, std::string message,
                                std::string hint) {
    if (!is_any_faulty(paths))
        diagnostics_.error(file_, protocol.places.first_written(paths), std::move(message), std::move(hint));
}

void ProtocolExamination::error(const std::vector<std::string>& paths, std::string message,
                                std::string hint) {
    const auto written =
        std::find_if(paths.begin(), paths.end(), [&](const std::string& path) { return is_written(path); });
    const bool is_faulty = std::any_of(paths.begin(), paths.end(),
                                       [&](const std::string& path) { return faulty.contains(path); });
    if (!is_faulty)
        error({written == paths.end() ? paths.front() : *written}, std::move(message), std::move(hint));
}

void ProtocolExamination::warning(std::initializer_list<std::string_view> paths, std::string message,
                                  std::string hint) {
    if (!is_any_faulty(paths))
        diagnostics_.warning(file_, protocol.places.first_written(paths), std::move(message),
                             std::move(hint));
}

std::string ProtocolExamination::line_of(std::string_view path, std::string_view seen_from) const {
    const Place there = protocol.places.of(path);
    if (there.file == protocol.places.of(seen_from).file)
        return fmt::format("line {}", there.line);
    const auto included = std::ranges::find(protocol.included, there.file, &IncludedText::number);
    return fmt::format("line {} of {}", there.line,
                       included == protocol.included.end() ? protocol.file.filename().string()
                                                           : included->name);
}

bool ProtocolExamination::is_any_faulty(std::initializer_list<std::string_view> paths) const {
    return std::any_of(paths.begin(), paths.end(),
                       [&](std::string_view path) { return faulty.contains(path); });
}

} // namespace overt
