#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/check/check_commands.h"
#include "app/check/shipped_protocols.h"
#include "experiment/base/error.h"
#include "experiment/protocol/keys/protocol_schema.h"
#include "experiment/protocol/keys/protocol_starter.h"

namespace overt {

namespace {

/// A name for the protocol, from its file's: what cannot stand in file names of sessions becomes _.
std::string name_from(const std::filesystem::path& file) {
    std::string name = file.stem().string().substr(0, 40);
    for (char& letter : name) {
        const bool is_kept = (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') ||
                             (letter >= '0' && letter <= '9') || letter == '-' || letter == '_';
        if (!is_kept)
            letter = '_';
    }
    return name;
}

/// Writes a file that is not there. Throws InputError or RecordError naming it.
void write_new(const std::filesystem::path& file, std::string_view bytes) {
    std::FILE* const stream = std::fopen(file.c_str(), "wbx"); // x: not over one that came meanwhile
    if (!stream)
        throw InputError(fmt::format("{}: cannot be written", file.string()));
    const bool is_written = std::fwrite(bytes.data(), 1, bytes.size(), stream) == bytes.size();
    if (std::fclose(stream) != 0 || !is_written)
        throw RecordError(fmt::format("{}: cannot be written", file.string()));
}

const ShippedProtocol& shipped(const std::string& name) {
    const std::span<const ShippedProtocol> all = shipped_protocols();
    const auto found = std::ranges::find(all, name, &ShippedProtocol::name);
    if (found != all.end())
        return *found;
    std::string known;
    for (const ShippedProtocol& one : all)
        known += fmt::format("\n  {:20} {}", one.name, one.what);
    throw InputError(
        fmt::format("--from {}: no protocol of that name comes with overt; there are{}", name, known));
}

} // namespace

int run_new(const NewOptions& options) {
    const std::filesystem::path& file = options.protocol;
    if (file.extension() != ".toml")
        throw InputError(fmt::format("{}: a protocol's name ends in .toml", file.string()));
    std::error_code ignored;
    if (std::filesystem::exists(std::filesystem::symlink_status(file, ignored)))
        throw InputError(fmt::format("{}: exists already, and is not overwritten", file.string()));
    const std::string name = name_from(file);
    if (options.from.empty()) {
        write_new(file, options.is_short ? short_protocol_starter(name) : protocol_starter(name));
    } else {
        const ShippedProtocol& from = shipped(options.from);
        const std::filesystem::path folder = file.parent_path();
        for (const ShippedProtocol::Picture& picture : from.pictures)
            if (std::filesystem::exists(std::filesystem::symlink_status(folder / picture.file, ignored)))
                throw InputError(fmt::format("{}: exists already, and is not overwritten",
                                             (folder / picture.file).string()));
        write_new(file, begun_from(from, name, file.string()));
        for (const ShippedProtocol::Picture& picture : from.pictures) {
            const std::filesystem::path place = folder / picture.file;
            std::filesystem::create_directories(place.parent_path(), ignored);
            write_new(place, picture.bytes);
        }
        if (!from.pictures.empty())
            fmt::print("written: {} pictures in {}\n", from.pictures.size(),
                       (folder / from.pictures.front().file).parent_path().string());
    }
    fmt::print("written: {}\nnext: overt check {}\n", file.string(), file.string());
    return 0;
}

int run_schema() {
    const std::string text = protocol_schema().dump(2) + "\n";
    std::fwrite(text.data(), 1, text.size(), stdout);
    return 0;
}

} // namespace overt
