#include "experiment/record/bids/bids_export.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "experiment/base/content_hash.h"
#include "experiment/base/error.h"
#include "experiment/base/partial_directory.h"
#include "experiment/base/path_inside.h"
#include "experiment/record/bids/bids_answers.h"
#include "experiment/record/bids/bids_dataset.h"
#include "experiment/record/bids/bids_events.h"
#include "experiment/record/bids/bids_gaze.h"
#include "experiment/record/bids/bids_participants.h"
#include "experiment/record/manifest.h"
#include "experiment/record/preview_file.h"
#include "experiment/record/session_lock.h"

namespace fs = std::filesystem;

namespace overt {
namespace {

/// Puts pictures of stimuli into the staged dataset when they are first named.
class Stimuli {
  public:
    Stimuli(const SessionRecord& record, fs::path staged, fs::path dataset, const BidsNames& names)
        : record_(record), staged_(std::move(staged)), dataset_(std::move(dataset)), task_(names.task) {
        try {
            for (const SessionManifest::File& file : read_manifest(record.directory()).files)
                listed_[file.path] = file.sha256;
        } catch (const RecordError&) {
            // Sessions of the first formats have none.
        }
    }

    /// Its path under "stimuli", or empty.
    const std::string& file_of(const Stimulus& stimulus) {
        const auto known = files_.find(stimulus);
        return known != files_.end() ? known->second : files_[stimulus] = put(stimulus);
    }

    std::vector<std::string> remarks; ///< on what was left out

  private:
    std::string put(const Stimulus& stimulus) {
        const std::string recorded = preview_file(record_.header(), stimulus);
        const fs::path from = record_.directory() / recorded;
        const std::string why = why_no_file_inside(record_.directory(), recorded);
        const ContentHash hash = why.empty() ? hash_of_file(from) : ContentHash();
        const auto listed = listed_.find(recorded);
        const bool is_listed = listed_.empty() || (listed != listed_.end() && listed->second == hash);
        if (!why.empty() || !is_listed) {
            if (why != "is missing")
                remarks.push_back(fmt::format("{} was left out: it {}", recorded,
                                              why.empty() ? "is not the file that the manifest names" : why));
            return {};
        }
        std::string name = fmt::format("{}/{}", task_, from.filename().string());
        // Another session may have shown something else under this name.
        if (const fs::path there = dataset_ / "stimuli" / name;
            fs::exists(there) && hash_of_file(there) != hash)
            name = fmt::format("{}/{}_{}{}", task_, from.stem().string(), hash.substr(0, 8),
                               from.extension().string());
        const fs::path to = staged_ / "stimuli" / name;
        std::error_code error;
        fs::create_directories(to.parent_path(), error);
        if (!error && !fs::exists(to))
            fs::copy_file(from, to, error);
        if (error)
            throw RecordError(fmt::format("{}: cannot be written: {}. Check the disk's space.", to.string(),
                                          error.message()));
        return name;
    }

    const SessionRecord& record_;
    const fs::path staged_, dataset_;
    const std::string task_;
    std::map<Stimulus, std::string> files_;
    std::map<std::string, ContentHash> listed_; ///< by the manifest
};

} // namespace

BidsExportCounts export_bids(const SessionRecord& record, const LookupFor& lookup_for,
                             const fs::path& dataset, const BidsExportOptions& options) {
    const BidsNames names(record.header());
    check_bids_dataset(dataset, names, options.overwrite);
    const bool is_new = !fs::exists(dataset) || fs::is_empty(dataset);
    PartialDirectory staged(dataset);
    const fs::path raw = staged.path() / names.folder();
    const fs::path derived = staged.path() / "derivatives" / "overt" / names.folder();
    fs::create_directories(raw);
    if (!record.header().stimuli.empty())
        fs::create_directories(derived);
    Stimuli stimuli(record, staged.path(), dataset, names);
    std::set<int> runs;
    for (const TrialRecord& trial : record.trials())
        runs.insert(trial.sitting);
    if (runs.empty())
        throw InputError(
            fmt::format("{}: has no trials: there is nothing to export.", record.directory().string()));

    BidsExportCounts counts;
    for (const int run : runs) {
        const std::optional<SessionTime> zero = bids_zero(record, run);
        write_bids_events(
            record, run, zero, [&](const Stimulus& stimulus) { return stimuli.file_of(stimulus); },
            raw / (names.run_stem(run) + "_events"));
        // The derivative is to be valid on its own: its gaze needs a screen, too. It has no stimuli.
        if (!record.header().stimuli.empty() && !record.eyes(run).none())
            write_bids_events(
                record, run, zero, [](const Stimulus&) { return std::string(); },
                derived / (names.surface_run_stem(run) + "_events"));
        const BidsGazeCounts gaze = write_bids_gaze(record, run, lookup_for, raw, derived);
        if (gaze.samples == 0)
            counts.remarks.push_back(fmt::format("Run {} has no gaze samples, only events.", run));
        else if (!zero)
            counts.remarks.push_back(
                fmt::format("The tracker's clock was never read in run {}: nothing relates the "
                            "times of its gaze and its events.",
                            run));
        counts.samples += gaze.samples;
        counts.rows += gaze.rows;
        counts.bytes += gaze.bytes;
        counts.recordings += gaze.recordings;
        ++counts.runs;
        const int answers = count_answers(record, run);
        if (answers > 0 && options.with_answers)
            copy_bids_answers(record, run, names, staged.path() / "sourcedata");
        else if (answers > 0)
            counts.remarks.push_back(
                fmt::format("Spoken answers of run {} were left out, for voices tell who "
                            "somebody is: {}. --with-answers puts them into sourcedata.",
                            run, answers));
        if (options.progress)
            options.progress(counts.runs, static_cast<int>(runs.size()));
    }
    std::ranges::move(stimuli.remarks, std::back_inserter(counts.remarks));
    const auto finish = [&](const fs::path& folder) {
        describe_bids_dataset(folder, record.header());
        return add_bids_participant(folder, record);
    };
    std::optional<std::vector<std::string>> remarks;
    if (is_new) {
        remarks = finish(staged.path());
        std::error_code error;
        fs::remove(dataset, error); // an empty folder
        if (!staged.publish_if_free())
            remarks.reset(); // another export has begun the dataset meanwhile: it takes this one, too
    }
    if (!remarks) {
        const SessionLock lock(dataset);
        check_bids_dataset(dataset, names, options.overwrite);
        merge_into_bids_dataset(staged.path(), dataset, names);
        remarks = finish(dataset);
    }
    std::move(remarks->begin(), remarks->end(), std::back_inserter(counts.remarks));
    return counts;
}

} // namespace overt
