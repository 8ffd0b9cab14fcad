#include "experiment/record/bids/bids_dataset.h"

#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "experiment/base/error.h"
#include "experiment/base/json_text.h"
#include "experiment/base/output_file.h"
#include "experiment/base/whole_file.h"
#include "experiment/record/tables/export_tables.h"

namespace fs = std::filesystem;

namespace overt {
namespace {

using Json = nlohmann::ordered_json;

const fs::path derivative = fs::path("derivatives") / "overt";

Json generated_by(const SessionHeader& header) {
    return Json::array({{{"Name", "overt"}, {"Version", header.program.version}}});
}

/// What the protocol says of the dataset, by the words of BIDS. A DOI is to be a URI.
void describe(Json& json, const SessionHeader& header) {
    struct Entry {
        std::string_view key, name;
        bool is_list;
    };
    constexpr Entry entries[] = {{"license", "License", false},
                                 {"authors", "Authors", true},
                                 {"keywords", "Keywords", true},
                                 {"acknowledgements", "Acknowledgements", false},
                                 {"how_to_acknowledge", "HowToAcknowledge", false},
                                 {"funding", "Funding", true},
                                 {"ethics_approvals", "EthicsApprovals", true},
                                 {"references", "ReferencesAndLinks", true}};
    for (const Entry& entry : entries) {
        for (const RecordedDatasetEntry& said : header.dataset) {
            if (said.key != entry.key)
                continue;
            if (entry.is_list)
                json[std::string(entry.name)].push_back(said.value);
            else
                json[std::string(entry.name)] = said.value;
        }
    }
}

std::string said_of(const SessionHeader& header, std::string_view key) {
    for (const RecordedDatasetEntry& said : header.dataset)
        if (said.key == key)
            return said.value;
    return {};
}

void write_if_missing(const fs::path& file, const std::string& text) {
    if (!fs::exists(file))
        write_text_file(file, text);
}

/// Sessions of all kinds may join the dataset later: it says of each kind what it has.
constexpr const char* readme =
    "# Eye tracking\n\n"
    "Put into the layout of BIDS with eye tracking by overt. Each sitting of a session is a run. Gaze is "
    "raw, "
    "as the tracker gave it, in pixels and in\n"
    "the time of the tracker's own clock (`timestamp`). `onset` of the events is by the clock of the "
    "session, "
    "from the first gaze sample of the run:\n"
    "the two clocks run apart, by milliseconds in some minutes. `tracker_onset` gives the same instant by "
    "the "
    "tracker's clock, to go with `timestamp`.\n"
    "Of recordings that were made with other programs, and imported, the session's clock is the tracker's, "
    "and there is what the recording says.\n"
    "Of sessions whose stimuli overt showed, `derivatives/overt` has where each sample was on the surface of "
    "the object, row by row as the samples.\n"
    "In texts, tab, newline, carriage return and backslash are written as \\t, \\n, \\r and \\\\.\n";

constexpr const char* derivative_readme =
    "# Places on the surface\n\n"
    "For each row of a recording the time by the session's clock with a bound on its error, the animation "
    "frame that\n"
    "was lit at the gaze's row at that time, and the place on the object that it showed there.\n";

/// Files of the session and task, in the dataset and its derivative.
std::vector<fs::path> files_of(const fs::path& dataset, const BidsNames& names) {
    std::vector<fs::path> files;
    for (const fs::path& root : {dataset, dataset / derivative, dataset / "sourcedata"}) {
        std::error_code none;
        for (const auto& entry : fs::directory_iterator(root / names.folder(), none))
            if (entry.path().filename().string().starts_with(names.task_stem()))
                files.push_back(entry.path());
    }
    return files;
}

bool is_ours(const fs::path& dataset) {
    int error = 0;
    const auto text = read_whole_file(dataset / "dataset_description.json", most_text_bytes, error);
    const Json json = parse_json(text.value_or(""));
    if (!json.is_object() || !json.contains("GeneratedBy") || !json["GeneratedBy"].is_array())
        return false;
    for (const Json& program : json["GeneratedBy"])
        if (program.is_object() && program.value("Name", Json()) == "overt")
            return true;
    return false;
}

[[noreturn]] void cannot_move(const fs::path& to, const std::error_code& error) {
    throw RecordError(fmt::format("{}: cannot be written: {}. Check the folder's permissions.", to.string(),
                                  error.message()));
}

} // namespace

void check_bids_dataset(const fs::path& dataset, const BidsNames& names, bool overwrite) {
    if (!fs::exists(dataset) || (fs::is_directory(dataset) && fs::is_empty(dataset)))
        return;
    if (!fs::is_directory(dataset) || !is_ours(dataset))
        throw InputError(fmt::format("{}: exists and is no dataset that overt has made (by its "
                                     "dataset_description.json). Name another folder.",
                                     dataset.string()));
    if (const std::vector<fs::path> files = files_of(dataset, names); !files.empty() && !overwrite)
        throw InputError(
            fmt::format("{}: the dataset holds this session already. Replace it with --overwrite, or name "
                        "another folder.",
                        files.front().string()));
}

void describe_bids_dataset(const fs::path& dataset, const SessionHeader& header) {
    std::string title = said_of(header, "name");
    if (title.empty())
        title = bids_task_name(header);
    std::string doi = said_of(header, "doi");
    if (doi.starts_with("10."))
        doi = "doi:" + doi;
    Json description{{"Name", title},
                     {"BIDSVersion", bids_version},
                     {"DatasetType", "raw"},
                     {"GeneratedBy", generated_by(header)}};
    Json of_derivative{{"Name", title + ": places on the surface"},
                       {"BIDSVersion", bids_version},
                       {"DatasetType", "derivative"},
                       {"GeneratedBy", generated_by(header)},
                       {"SourceDatasets", Json::array({{{"URL", "../../"}}})}};
    describe(description, header);
    describe(of_derivative, header);
    if (!doi.empty()) {
        description["DatasetDOI"] = doi;
        of_derivative["SourceDatasets"][0]["DOI"] = doi;
    }
    write_if_missing(dataset / "dataset_description.json", json_text(description));
    write_if_missing(dataset / "README.md", readme);
    if (!fs::exists(dataset / derivative))
        return;
    write_if_missing(dataset / derivative / "dataset_description.json", json_text(of_derivative));
    write_if_missing(dataset / derivative / "README.md", derivative_readme);
}

void merge_into_bids_dataset(const fs::path& staged, const fs::path& dataset, const BidsNames& names) {
    std::error_code error;
    for (const fs::path& file : files_of(dataset, names))
        if (!fs::remove(file, error))
            cannot_move(file, error);
    for (const auto& entry : fs::recursive_directory_iterator(staged)) {
        const fs::path to = dataset / fs::relative(entry.path(), staged);
        if (entry.is_directory())
            fs::create_directories(to, error);
        else if (!fs::exists(to)) // what describes the dataset, and stimuli, may be there
            fs::rename(entry.path(), to, error);
        if (error)
            cannot_move(to, error);
    }
}

} // namespace overt
