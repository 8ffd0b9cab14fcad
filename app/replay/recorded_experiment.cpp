#include "app/replay/recorded_experiment.h"

#include <algorithm>

#include <fmt/format.h>

#include "app/inputs/protocol_file.h"
#include "app/session/recorded_options.h"
#include "experiment/base/path_inside.h"

namespace overt {

namespace fs = std::filesystem;

fs::path place_of_protocol(const SessionRecord& record, const fs::path& files) {
    const std::vector<RecordedOption> options = record.run_options(1);
    const std::string* const way = recorded_value(options, "protocol");
    const std::string name = way ? fs::path(*way).filename().string() : "protocol.toml";
    if (!files.empty())
        return files / name;
    const fs::path folder = fs::absolute(record.directory());
    return (way ? folder / *way : folder / name).lexically_normal();
}

std::optional<RecordDifference> changed_content(const SessionRecord& record) {
    const SessionHeader& header = record.header();
    const auto changed = [](std::string table, std::string row, std::string column, const ContentHash& hash,
                            const std::string& text) -> std::optional<RecordDifference> {
        if (hash_of_text(text) == hash)
            return std::nullopt;
        return RecordDifference{std::move(table),
                                {},
                                {},
                                std::move(row),
                                std::move(column),
                                "a text with the SHA-256 " + hash,
                                "that text has another, " + hash_of_text(text)};
    };
    if (auto difference =
            changed("session", "", "protocol_text", header.protocol.sha256, header.protocol.text))
        return difference;
    for (const RecordedProtocol::Included& file : header.protocol.included)
        if (auto difference =
                changed("protocol_file", fmt::format("name {}", file.name), "text", file.sha256, file.text))
            return difference;
    for (const RecordedMap& map : header.maps)
        if (ContentHash found = hash_of_file(require_file_inside(record.directory(), map.file));
            found != map.sha256)
            return RecordDifference{"map",
                                    {},
                                    {},
                                    fmt::format("object {}, view {}, pose {}", map.viewed.object,
                                                map.viewed.view, map.pose.value),
                                    "sha256",
                                    map.sha256,
                                    fmt::format("its file {} has {}", map.file, found)};
    return std::nullopt;
}

Experiment recorded_experiment(const SessionRecord& record, const fs::path& files, const fs::path& cache) {
    const fs::path place = place_of_protocol(record, files);
    Diagnostics diagnostics;
    std::optional<Experiment> experiment =
        read_recorded_experiment(record.header().protocol, place, cache, diagnostics);
    if (experiment) {
        const auto& objects = experiment->protocol.objects;
        const bool has_meshes =
            std::ranges::any_of(objects, [](const auto& object) { return !object.mesh.empty(); });
        // The meshes in the session's folder are those that were made of the protocol's.
        if (has_meshes && files.empty() && record.run_options(1).empty())
            throw InputError(
                fmt::format("{}: this session does not say where the files lay that its protocol "
                            "names: give the folder of the protocol with --files DIR",
                            record.directory().string()));
        return *std::move(experiment);
    }
    print_findings(diagnostics);
    fmt::print(stderr,
               "{}: the recorded protocol cannot be used from {}. If the files that it names lie elsewhere "
               "now, give their folder with --files DIR.\n",
               record.directory().string(), place.parent_path().string());
    throw FindingsPrinted("the recorded protocol cannot be used");
}

} // namespace overt
