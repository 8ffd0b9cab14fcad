/// The formats of `overt export`: one line each in the table of export_formats.cpp, and a file of its own.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiment/record/read/session_record.h"

namespace CLI {
class App;
}

namespace overt {

/// One session, and where it goes.
struct ExportRequest {
    const SessionRecord& record;
    std::string_view format; ///< by the name that was asked for
    std::filesystem::path folder;
    bool overwrite;
    std::function<void(int done, int all)> progress;
};

class ExportFormat {
  public:
    virtual ~ExportFormat() = default;

    /// Adds what only this format takes. Its values live as long as the format.
    virtual void add_options(CLI::App& /*command*/) {}

    /// Where several sessions are written to folders of their own in one: what belongs to all of them
    /// together. Gives the lines that tell of it. Throws RecordError.
    virtual std::string write_pooled(std::string_view /*format*/,
                                     const std::vector<std::filesystem::path>& /*sessions*/,
                                     const std::filesystem::path& /*folder*/) const {
        return {};
    }

    /// Writes the session and gives the lines that tell of it. Throws InputError and RecordError.
    virtual std::string write(const ExportRequest& request) const = 0;
};

struct ExportFormatEntry {
    std::vector<std::string> names; ///< as --format takes them
    const char* help;
    bool joins_sessions; ///< all sessions go to one folder, not to one each
    std::unique_ptr<ExportFormat> (*make)();
};
std::span<const ExportFormatEntry> export_formats();

// The formats, each in a file of its name.
std::unique_ptr<ExportFormat> table_format();
std::unique_ptr<ExportFormat> bids_format();
std::unique_ptr<ExportFormat> asc_format();

} // namespace overt
