#include "experiment/record/tsv_export.h"

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "experiment/analysis/gaze_cone.h"
#include "experiment/analysis/surface_walk.h"
#include "experiment/error.h"
#include "experiment/parallel.h"
#include "experiment/record/ledger_rows.h"
#include "experiment/record/partial_directory.h"
#include "experiment/record/sample_join.h"
#include "experiment/record/tsv_tables.h"
#include "experiment/record/tsv_writer.h"

namespace fs = std::filesystem;

namespace overt {
namespace {

constexpr const char* dictionary_file = "dictionary.json";
constexpr int angle_decimals = 6; // a millionth of a degree
constexpr int pixel_decimals = 3; // a thousandth of a pixel
constexpr int pupil_decimals = 4;
constexpr int surface_decimals = 6; // a nanometre, if the mesh is in millimetres
constexpr int incidence_decimals = 4;
constexpr int silhouette_decimals = 4; // a hundredth of a pixel
constexpr int probability_decimals = 4;
constexpr int rate_decimals = 3;  // a millihertz
constexpr int drift_decimals = 3; // a thousandth of a millionth

template <class List> const auto* item(const List& list, int index) {
    return index >= 0 && static_cast<std::size_t>(index) < list.size()
               ? &list[static_cast<std::size_t>(index)]
               : nullptr;
}

/// People count trials from 1.
int number_of(const Trial& trial) { return trial.index + 1; }

/// Writes one session's tables into a directory.
class TsvExport {
  public:
    TsvExport(const SessionRecord& record, const fs::path& directory, std::optional<Degrees> cone_accuracy)
        : record_(record), header_(record.header()), tables_(header_, cone_accuracy),
          trials_(directory, tables_.trials), flips_(directory, tables_.flips),
          samples_(directory, tables_.samples), events_(directory, tables_.events),
          responses_(directory, tables_.responses), stimuli_(directory, tables_.stimuli),
          display_box_(directory, tables_.display_box), directory_(directory) {
        if (cone_accuracy)
            cone_.emplace(header_.display.screen, *cone_accuracy);
    }

    void write_trial(const TrialRecord& trial, const SurfaceLookup* lookup);
    void write_attempt_without_rows(const TrialRecord& trial);
    void write_what_belongs_to_no_trial();
    void write_display_boxes();
    void close();
    const TsvExportCounts& counts() const { return counts_; }

  private:
    std::string condition_cells(const Trial& trial) const;
    void begin_trial_row(const TrialRecord& trial);
    TsvExportCounts write_samples(const TrialRecord& trial, const SurfaceLookup* lookup);
    void write_sample(const GazeSample& sample, const JoinedSample& joined,
                      const std::vector<std::string>& part_cells);
    std::vector<GazeCone::Shares> cone_shares(const SurfaceLookup& lookup,
                                              const std::vector<GazeSample>& samples,
                                              const std::vector<JoinedSample>& joined,
                                              std::size_t parts) const;
    void write_cone(const GazeCone::Shares& shares, int sculpture);
    void write_response(const TrialRecord& trial);
    void angle(TsvWriter& writer, PoseIndex pose) const;

    const SessionRecord& record_;
    const SessionHeader& header_;
    const TsvTables tables_;
    TsvWriter trials_, flips_, samples_, events_, responses_, stimuli_, display_box_;
    const fs::path directory_;
    std::optional<GazeCone> cone_;
    TsvExportCounts counts_;
};

/// Task, sculpture and material.
std::string TsvExport::condition_cells(const Trial& trial) const {
    return fmt::format("{}\t{}\t{}", tsv_cell(item(header_.tasks, trial.task)->id),
                       tsv_cell(item(header_.sculptures, trial.condition.sculpture)->id),
                       tsv_cell(item(header_.materials, trial.condition.material)->id));
}

void TsvExport::angle(TsvWriter& writer, PoseIndex pose) const {
    const Degrees* const angle = item(header_.poses.angles, pose.value);
    angle ? writer.fixed(angle->value, angle_decimals) : writer.missing();
}

void TsvExport::begin_trial_row(const TrialRecord& trial) {
    trials_.integer(number_of(trial.trial)).integer(trial.attempt).integer(trial.sitting);
    const std::string* const block = item(header_.blocks, trial.trial.block);
    block ? trials_.ready(tsv_cell(*block)) : trials_.missing();
    trials_.ready(condition_cells(trial.trial), 3).ready(name_of(trial.status)).seconds(trial.started);
}

void TsvExport::write_attempt_without_rows(const TrialRecord& trial) {
    begin_trial_row(trial);
    trials_.missing(static_cast<int>(tables_.trials.columns.size()) - 9).end_row();
}

void TsvExport::write_trial(const TrialRecord& trial, const SurfaceLookup* lookup) {
    counts_.flips += write_ledger(flips_, record_, trial);
    const TsvExportCounts of_trial = write_samples(trial, lookup);
    write_response(trial);

    const TrialOutcome& outcome = trial.outcome;
    begin_trial_row(trial);
    trials_.seconds(outcome.task_screen_onset)
        .seconds(outcome.presentation_onset)
        .seconds(outcome.presentation_end)
        .seconds(outcome.response_screen_onset)
        .seconds(outcome.responded_at);
    trials_.integer(outcome.shown_refreshes).integer(outcome.missed_refreshes);
    outcome.drift ? trials_.fixed(outcome.drift->value, angle_decimals) : trials_.missing();
    trials_.integer(trial.lost_flips).integer(trial.lost_samples);
    trials_.integer(of_trial.samples)
        .integer(of_trial.samples_without_gaze)
        .integer(of_trial.samples_on_object)
        .integer(of_trial.samples_off_plan)
        .end_row();

    ++counts_.trials;
    counts_.samples += of_trial.samples;
    counts_.samples_without_gaze += of_trial.samples_without_gaze;
    counts_.samples_on_object += of_trial.samples_on_object;
    counts_.samples_off_plan += of_trial.samples_off_plan;
}

TsvExportCounts TsvExport::write_samples(const TrialRecord& trial, const SurfaceLookup* lookup) {
    const SampleJoin join(record_, trial, lookup);
    const std::string trial_cells =
        fmt::format("{}\t{}", number_of(trial.trial), condition_cells(trial.trial));
    std::vector<std::string> part_cells;
    for (const std::string& name : item(header_.sculptures, trial.trial.condition.sculpture)->part_names)
        part_cells.push_back(tsv_cell(name));

    const std::vector<GazeSample> samples = record_.samples(trial);
    std::vector<JoinedSample> joined(samples.size());
    join.join(samples, joined);
    std::vector<GazeCone::Shares> shares;
    if (cone_ && lookup)
        shares = cone_shares(*lookup, samples, joined, part_cells.size());

    TsvExportCounts counts;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        samples_.ready(trial_cells, 4);
        write_sample(samples[i], joined[i], part_cells);
        if (cone_)
            write_cone(shares.empty() ? GazeCone::Shares{} : shares[i], trial.trial.condition.sculpture);
        samples_.end_row();
        ++counts.samples;
        counts.samples_without_gaze += !samples[i].gaze;
        counts.samples_on_object += joined[i].sight.surface.has_value();
        counts.samples_off_plan += joined[i].off_plan;
    }
    return counts;
}

void TsvExport::write_sample(const GazeSample& sample, const JoinedSample& joined,
                             const std::vector<std::string>& part_cells) {
    if (joined.at)
        samples_.seconds(joined.at->time).seconds(joined.at->uncertainty);
    else
        samples_.missing(2);
    samples_.integer(sample.sampled_at.time_since_epoch().count());
    samples_.ready(sample.eye == Eye::left ? "left" : "right");
    if (sample.gaze)
        samples_.fixed(sample.gaze->x_px, pixel_decimals).fixed(sample.gaze->y_px, pixel_decimals);
    else
        samples_.missing(2);
    sample.pupil_area > 0.0f ? samples_.fixed(static_cast<double>(sample.pupil_area), pupil_decimals)
                             : samples_.missing();
    if (joined.shown) {
        samples_.integer(joined.shown->frame.value);
        angle(samples_, joined.shown->pose);
    } else {
        samples_.missing(2);
    }
    if (joined.image_px)
        samples_.fixed(joined.image_px->x, pixel_decimals).fixed(joined.image_px->y, pixel_decimals);
    else
        samples_.missing(2);
    if (const auto& surface = joined.sight.surface) {
        for (const double coordinate : {surface->position.x, surface->position.y, surface->position.z})
            samples_.fixed(coordinate, surface_decimals);
        surface->triangle == no_triangle ? samples_.missing() : samples_.integer(surface->triangle);
        const std::string* const part = item(part_cells, surface->part);
        part ? samples_.ready(*part) : samples_.missing();
        samples_.fixed(surface->depth, surface_decimals).fixed(surface->incidence.value, incidence_decimals);
    } else {
        samples_.missing(7);
    }
    joined.outline_distance ? samples_.fixed(joined.outline_distance->value, silhouette_decimals)
                            : samples_.missing();
}

/// Of each sample that fell on a lit frame; the others' shares are empty.
std::vector<GazeCone::Shares> TsvExport::cone_shares(const SurfaceLookup& lookup,
                                                     const std::vector<GazeSample>& samples,
                                                     const std::vector<JoinedSample>& joined,
                                                     std::size_t parts) const {
    std::vector<GazeCone::Shares> shares(samples.size());
    constexpr std::size_t batch = 256;
    parallel_for(static_cast<int>((samples.size() + batch - 1) / batch), [&](int index) {
        const std::size_t begin = static_cast<std::size_t>(index) * batch;
        for (std::size_t i = begin; i < std::min(begin + batch, samples.size()); ++i) {
            if (joined[i].shown)
                shares[i] = cone_->shares(lookup, joined[i].shown->pose, *samples[i].gaze, parts);
        }
    });
    return shares;
}

void TsvExport::write_cone(const GazeCone::Shares& shares, int sculpture) {
    const std::vector<std::string>& own_parts = item(header_.sculptures, sculpture)->part_names;
    if (shares.of_part.empty()) {
        samples_.missing(1 + static_cast<int>(tables_.cone_parts.size()));
        return;
    }
    samples_.fixed(shares.of_object, probability_decimals);
    for (const std::string& name : tables_.cone_parts) {
        const auto own = std::find(own_parts.begin(), own_parts.end(), name);
        own == own_parts.end()
            ? samples_.missing()
            : samples_.fixed(shares.of_part[static_cast<std::size_t>(own - own_parts.begin())],
                             probability_decimals);
    }
}

void TsvExport::write_response(const TrialRecord& trial) {
    const TrialOutcome& outcome = trial.outcome;
    responses_.integer(number_of(trial.trial)).ready(condition_cells(trial.trial), 3);
    responses_.text(item(header_.tasks, trial.trial.task)->question)
        .seconds(outcome.response_screen_onset)
        .seconds(outcome.responded_at)
        .seconds(outcome.responded_at - outcome.response_screen_onset)
        .text(outcome.answer)
        .end_row();
}

void TsvExport::write_what_belongs_to_no_trial() {
    for (const RecordedEvent& event : record_.events()) {
        events_.seconds(event.at);
        event.trial < 0 ? events_.missing() : events_.integer(event.trial + 1);
        events_.text(event.kind).text(event.detail).end_row();
    }
    for (const RecordedStimulus& stimulus : header_.stimuli) {
        const RecordedSculpture* const sculpture = item(header_.sculptures, stimulus.condition.sculpture);
        const RecordedMaterial* const material = item(header_.materials, stimulus.condition.material);
        stimuli_.text(sculpture ? sculpture->id : "").text(material ? material->id : "");
        stimuli_.text(stimulus.source).text(stimulus.frames_sha256);
        stimuli_.text(sculpture ? sculpture->mesh_file : "").text(sculpture ? sculpture->mesh_sha256 : "");
        stimuli_.end_row();
    }
}

void TsvExport::write_display_boxes() {
    TsvWriter& row = display_box_;
    for (const auto& [sitting, box] : record_.display_boxes()) {
        row.integer(sitting).ready(name_of(box.use));
        row.text(box.product).text(box.serial_number).text(box.firmware_date).text(box.port);
        row.text(box.mode).text(box.gamma_table);
        if (box.use == RecordedBox::Use::box)
            row.seconds(box.settled_after).fixed(box.video_rate_hz, rate_decimals);
        else
            row.missing(2);
        if (const auto readings = record_.box_clock_readings(sitting); readings.empty()) {
            row.integer(0).missing(4);
        } else {
            const BoxClockFit fit = fit_box_clock(readings);
            row.integer(fit.readings).seconds(fit.zero).seconds(fit.uncertainty);
            row.fixed(fit.drift_ppm, drift_decimals).fixed(fit.drift_uncertainty_ppm, drift_decimals);
        }
        row.end_row();
    }
}

void TsvExport::close() {
    for (TsvWriter* writer : {&trials_, &flips_, &samples_, &events_, &responses_, &stimuli_, &display_box_})
        writer->close();
    std::ofstream dictionary(directory_ / dictionary_file, std::ios::binary);
    dictionary << tsv_dictionary(tables_);
    if (!dictionary.flush())
        throw RecordError(fmt::format("{}: writing failed. Check the disk's space.",
                                      (directory_ / dictionary_file).string()));
}

/// An existing directory is replaced only if nobody can lose anything by it.
void refuse_target(const SessionHeader& header, const fs::path& directory, bool overwrite) {
    if (!fs::exists(directory) || (fs::is_directory(directory) && fs::is_empty(directory)))
        return;
    if (!overwrite || !fs::is_directory(directory))
        throw InputError(fmt::format(
            "{}: exists already. Name another folder, or allow it to be overwritten.", directory.string()));
    const TsvTables tables(header);
    std::vector<std::string> ours{dictionary_file};
    for (const TsvTable* table : {&tables.trials, &tables.flips, &tables.samples, &tables.events,
                                  &tables.responses, &tables.stimuli, &tables.display_box})
        ours.push_back(table->file);
    for (const auto& entry : fs::directory_iterator(directory))
        if (std::find(ours.begin(), ours.end(), entry.path().filename().string()) == ours.end())
            throw InputError(
                fmt::format("{}: holds «{}», which no export has written, so it is not overwritten. "
                            "Name another folder.",
                            directory.string(), entry.path().filename().string()));
}

} // namespace

TsvExportCounts export_tsv(const SessionRecord& record, const LookupFor& lookup_for,
                           const fs::path& directory, const TsvExportOptions& options) {
    refuse_target(record.header(), directory, options.overwrite);
    PartialDirectory partial(directory);
    TsvExport tables(record, partial.path(), options.cone_accuracy);
    const int all = static_cast<int>(record.trials().size());
    int done = 0;
    for (const TrialRecord& trial : record.trials()) {
        if (trial.status == TrialRecord::Status::completed)
            tables.write_trial(trial, lookup_for(trial.trial.condition.sculpture));
        else
            tables.write_attempt_without_rows(trial);
        if (options.progress)
            options.progress(++done, all);
    }
    tables.write_what_belongs_to_no_trial();
    tables.write_display_boxes();
    tables.close();
    std::error_code error;
    fs::remove_all(partial.final_path(), error);
    if (error)
        throw RecordError(fmt::format("{}: the earlier export cannot be removed: {}. Check the permissions.",
                                      directory.string(), error.message()));
    partial.publish();
    return tables.counts();
}

} // namespace overt
