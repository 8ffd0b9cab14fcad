#include "experiment/record/manifest.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "experiment/base/error.h"
#include "experiment/base/json_text.h"
#include "experiment/base/path_inside.h"
#include "experiment/base/whole_file.h"
#include "experiment/record/session_schema.h"

namespace fs = std::filesystem;

namespace overt {
namespace {

using Json = nlohmann::ordered_json;

constexpr int manifest_format = 1;
constexpr std::string_view own_hash_key = "\n  \"sha256_of_the_above\": \"";

std::string with_own_hash(std::string text) {
    return fmt::format("{}{}{}\"\n}}\n", text, own_hash_key, hash_of_text(text));
}

Json to_json(const SessionManifest& manifest) {
    Json json{{"format", manifest_format},
              {"protocol", manifest.protocol},
              {"observer", manifest.observer},
              {"session", manifest.session_number},
              {"closed", manifest.is_closed}};
    json["programs"] = Json::array();
    for (const SessionManifest::Program& program : manifest.programs)
        json["programs"].push_back(
            {{"name", program.name}, {"version", program.version}, {"sha256", program.sha256}});
    json["made_from"] = Json::array();
    for (const SessionManifest::Input& input : manifest.inputs)
        json["made_from"].push_back({{"what", input.what}, {"sha256", input.sha256}});
    json["files"] = Json::array();
    for (const SessionManifest::File& file : manifest.files)
        json["files"].push_back({{"path", file.path}, {"bytes", file.bytes}, {"sha256", file.sha256}});
    return json;
}

SessionManifest::File describe_file(const fs::path& folder, const std::string& name) {
    return {name, fs::file_size(folder / name), hash_of_file(folder / name)};
}

/// In one step: a reader finds the old text or the new one.
void write_manifest(const fs::path& folder, const SessionManifest& manifest) {
    write_whole_file(folder / manifest_file_name, to_text(manifest),
                     ". Make room or check the permissions, then finish with overt run … --resume.");
}

SessionManifest new_manifest(const fs::path& folder, const SessionHeader& header) {
    SessionManifest manifest;
    manifest.protocol = header.protocol.name;
    manifest.observer = header.schedule.observer.label;
    manifest.session_number = header.session_number;
    for (const RecordedObject& object : header.objects)
        if (!object.mesh_sha256.empty())
            manifest.inputs.push_back({"mesh " + object.id, object.mesh_sha256});
    for (const RecordedObject& object : header.objects)
        if (!object.surface_sha256.empty())
            manifest.inputs.push_back({"surface " + object.id, object.surface_sha256});
    for (const RecordedStimulus& stimulus : header.stimuli)
        manifest.inputs.push_back(
            {fmt::format("frames {}", stimulus_name(header, stimulus.stimulus)),
             stimulus.frames_sha256.empty() ? stimulus.made_from_sha256 : stimulus.frames_sha256});
    if (header.characterisation)
        manifest.inputs.push_back({"characterisation of the display", header.characterisation->sha256});
    for (const std::string& name : files_of_session(folder, false))
        manifest.files.push_back(describe_file(folder, name));
    return manifest;
}

void add_program(SessionManifest& manifest, const SessionManifest::Program& program) {
    if (std::find(manifest.programs.begin(), manifest.programs.end(), program) == manifest.programs.end())
        manifest.programs.push_back(program);
}

} // namespace

std::string to_text(const SessionManifest& manifest) {
    std::string text = json_text(to_json(manifest));
    text.erase(text.size() - 3); // the last brace and the newlines around it
    return with_own_hash(text + ",");
}

SessionManifest manifest_from(const std::string& text, const fs::path& file) {
    const std::size_t end = text.rfind(own_hash_key);
    if (end == std::string::npos || with_own_hash(text.substr(0, end)) != text)
        throw RecordError(fmt::format("{}: is not as it was written", file.string()));
    try {
        const Json json = parse_json(text);
        if (json.at("format").get<int>() != manifest_format)
            throw RecordError(
                fmt::format("{}: written by a newer overt: update overt to read it.", file.string()));
        SessionManifest manifest;
        manifest.protocol = json.at("protocol");
        manifest.observer = json.at("observer");
        manifest.session_number = json.at("session");
        manifest.is_closed = json.at("closed");
        for (const Json& program : json.at("programs"))
            manifest.programs.push_back({program.at("name"), program.at("version"), program.at("sha256")});
        for (const Json& input : json.at("made_from"))
            manifest.inputs.push_back({input.at("what"), input.at("sha256")});
        for (const Json& entry : json.at("files"))
            manifest.files.push_back({entry.at("path"), entry.at("bytes"), entry.at("sha256")});
        for (const SessionManifest::File& listed : manifest.files)
            if (!stays_inside(listed.path))
                throw RecordError(
                    fmt::format("{}: names a file outside of the session, \"{}\": it is damaged, or "
                                "was not made by overt",
                                file.string(), listed.path));
        return manifest;
    } catch (const nlohmann::json::exception& error) {
        throw RecordError(fmt::format("{}: is no manifest: {}", file.string(), error.what()));
    }
}

SessionManifest read_manifest(const fs::path& folder) {
    const fs::path file = folder / manifest_file_name;
    int error = 0;
    std::optional<std::string> text;
    if (is_file_inside(folder, manifest_file_name))
        text = read_whole_file(file, most_text_bytes, error);
    if (!text)
        throw RecordError(fmt::format("{}: is not there, or cannot be read", file.string()));
    return manifest_from(*text, file);
}

std::vector<std::string> files_of_session(const fs::path& folder, bool with_session_file) {
    std::vector<std::string> names;
    for (auto entry = fs::recursive_directory_iterator(folder); entry != fs::recursive_directory_iterator();
         ++entry) {
        const std::string name = entry->path().filename().string();
        const fs::file_type type = entry->symlink_status().type();
        const bool is_folder = type == fs::file_type::directory;
        const bool is_export = entry.depth() == 0 && is_folder && name.starts_with("export_");
        // Records of further trackers have manifests of their own.
        const bool is_further = entry.depth() == 0 && is_folder && name == further_records_folder;
        if (name.starts_with('.') || is_export || is_further) {
            entry.disable_recursion_pending();
            continue;
        }
        const std::string path = entry->path().lexically_relative(folder).generic_string();
        const std::string session_file = session_file_name;
        if (type != fs::file_type::regular || name.ends_with(partial_suffix) || path == manifest_file_name ||
            path == session_file + "-wal" || path == session_file + "-shm" ||
            path == session_file + "-journal" || (path == session_file && !with_session_file))
            continue;
        names.push_back(path);
    }
    std::sort(names.begin(), names.end());
    return names;
}

void begin_manifest(const fs::path& folder, const SessionHeader& header,
                    const SessionManifest::Program& program) {
    SessionManifest manifest = new_manifest(folder, header);
    add_program(manifest, program);
    write_manifest(folder, manifest);
}

void reopen_manifest(const fs::path& folder, const SessionHeader& header,
                     const SessionManifest::Program& program) {
    SessionManifest manifest;
    try {
        manifest = read_manifest(folder);
    } catch (const RecordError&) {
        manifest = new_manifest(folder, header);
    }
    manifest.is_closed = false;
    std::erase_if(manifest.files,
                  [](const SessionManifest::File& file) { return file.path == session_file_name; });
    add_program(manifest, program);
    write_manifest(folder, manifest);
}

bool close_manifest(const fs::path& folder) {
    std::error_code none;
    if (const fs::path log = folder / (std::string(session_file_name) + "-wal");
        fs::exists(log, none) && fs::file_size(log, none) > 0)
        return false;
    SessionManifest manifest = read_manifest(folder);
    for (const std::string& name : files_of_session(folder, true)) {
        const bool is_known =
            std::any_of(manifest.files.begin(), manifest.files.end(),
                        [&](const SessionManifest::File& file) { return file.path == name; });
        if (!is_known)
            manifest.files.push_back(describe_file(folder, name));
    }
    std::sort(manifest.files.begin(), manifest.files.end(),
              [](const SessionManifest::File& a, const SessionManifest::File& b) { return a.path < b.path; });
    manifest.is_closed = true;
    write_manifest(folder, manifest);
    return true;
}

} // namespace overt
