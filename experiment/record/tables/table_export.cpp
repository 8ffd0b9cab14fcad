#include "experiment/record/tables/table_export.h"

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "experiment/base/export_folder.h"
#include "experiment/record/read/trial_rows.h"
#include "experiment/record/tables/export_tables.h"
#include "experiment/record/tables/gaze_event_rows.h"
#include "experiment/record/tables/ledger_rows.h"
#include "experiment/record/tables/sample_rows.h"

namespace fs = std::filesystem;

namespace overt {
namespace {

constexpr const char* dictionary_file = "dictionary.json";
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
class TableExport {
  public:
    TableExport(const SessionRecord& record, const fs::path& directory, const TableExportOptions& options)
        : record_(record), header_(record.header()), format_(options.format),
          tables_(header_, options.cone_accuracy), trials_(directory, tables_.trials, format_),
          flips_(directory, tables_.flips, format_), samples_(directory, tables_.samples, format_),
          gaze_events_(directory, tables_.gaze_events, format_), events_(directory, tables_.events, format_),
          responses_(directory, tables_.responses, format_), stimuli_(directory, tables_.stimuli, format_),
          display_box_(directory, tables_.display_box, format_), directory_(directory),
          sample_rows_(samples_, record, tables_, options.cone_accuracy) {}

    void write_trial(const TrialRecord& trial, const SurfaceLookup* lookup);
    /// One that has no rows in the other tables.
    void write_other_attempt(const TrialRecord& trial);
    void write_what_belongs_to_no_trial();
    void write_display_boxes();
    void close();
    const TableExportCounts& counts() const { return counts_; }

  private:
    PreparedCells condition_cells(const Trial& trial) const;
    void begin_trial_row(const TrialRecord& trial);
    void write_outcome(const TrialRecord& trial);
    void write_response(const TrialRecord& trial);

    const SessionRecord& record_;
    const SessionHeader& header_;
    const TableFormat format_;
    const ExportTables tables_;
    TableWriter trials_, flips_, samples_, gaze_events_, events_, responses_, stimuli_, display_box_;
    const fs::path directory_;
    SampleRows sample_rows_;
    TableExportCounts counts_;
};

/// Task, sculpture and material.
PreparedCells TableExport::condition_cells(const Trial& trial) const {
    return prepare_cells({item(header_.tasks, trial.task)->id,
                          item(header_.sculptures, trial.condition.sculpture)->id,
                          item(header_.materials, trial.condition.material)->id},
                         format_);
}

void TableExport::begin_trial_row(const TrialRecord& trial) {
    trials_.integer(number_of(trial.trial)).integer(trial.attempt).integer(trial.sitting);
    const std::string* const block = item(header_.blocks, trial.trial.block);
    block ? trials_.text(*block) : trials_.missing();
    trials_.prepared(condition_cells(trial.trial)).word(name_of(trial.status));
    trials_.word(trial.counts ? "yes" : "no");
    const TrialOutcome& outcome = trial.outcome;
    const bool has_failed = trial.has_outcome() && !outcome.failure.empty();
    has_failed ? trials_.text(outcome.failure) : trials_.missing();
    const std::string_view afterwards = trial.has_outcome() ? name_of(outcome.afterwards) : "";
    afterwards.empty() ? trials_.missing() : trials_.word(afterwards);
    trials_.seconds(trial.started);
}

/// Its times as far as it came, refreshes, drift check and what was lost.
void TableExport::write_outcome(const TrialRecord& trial) {
    const TrialOutcome& outcome = trial.outcome;
    for (const SessionTime at :
         {outcome.task_screen_onset, outcome.presentation_onset, outcome.presentation_end,
          outcome.response_screen_onset, outcome.responded_at})
        at >= trial.started ? trials_.seconds(at) : trials_.missing();
    trials_.integer(outcome.shown_refreshes).integer(outcome.missed_refreshes);
    outcome.drift ? trials_.fixed(outcome.drift->value, angle_decimals) : trials_.missing();
    trials_.integer(trial.lost_flips).integer(trial.lost_samples);
}

void TableExport::write_other_attempt(const TrialRecord& trial) {
    constexpr int of_outcome = 10, of_samples = 4;
    begin_trial_row(trial);
    trial.has_outcome() ? write_outcome(trial) : static_cast<void>(trials_.missing(of_outcome));
    trials_.missing(of_samples).end_row();
}

void TableExport::write_trial(const TrialRecord& trial, const SurfaceLookup* lookup) {
    const std::optional<TrialLedger> ledger = record_.ledger(trial);
    counts_.flips += write_ledger(flips_, header_, trial, ledger);
    const SampleCounts of_trial = sample_rows_.write(trial, ledger, lookup);
    write_gaze_events(gaze_events_, record_, trial);
    write_response(trial);

    begin_trial_row(trial);
    write_outcome(trial);
    trials_.integer(of_trial.samples)
        .integer(of_trial.without_gaze)
        .integer(of_trial.on_object)
        .integer(of_trial.off_plan)
        .end_row();

    ++counts_.trials;
    counts_.samples += of_trial.samples;
    counts_.samples_without_gaze += of_trial.without_gaze;
    counts_.samples_on_object += of_trial.on_object;
    counts_.samples_off_plan += of_trial.off_plan;
}

void TableExport::write_response(const TrialRecord& trial) {
    const TrialOutcome& outcome = trial.outcome;
    responses_.integer(number_of(trial.trial)).prepared(condition_cells(trial.trial));
    responses_.text(item(header_.tasks, trial.trial.task)->question)
        .seconds(outcome.response_screen_onset)
        .seconds(outcome.responded_at)
        .seconds(outcome.responded_at - outcome.response_screen_onset)
        .text(outcome.answer)
        .end_row();
}

void TableExport::write_what_belongs_to_no_trial() {
    write_gaze_events_outside(gaze_events_, record_);
    record_.read_events([this](const RecordedEvent& event) {
        events_.seconds(event.at);
        event.trial < 0 ? events_.missing() : events_.integer(event.trial + 1);
        events_.text(event.kind).text(event.detail).end_row();
    });
    for (const RecordedStimulus& stimulus : header_.stimuli) {
        const RecordedSculpture* const sculpture = item(header_.sculptures, stimulus.condition.sculpture);
        const RecordedMaterial* const material = item(header_.materials, stimulus.condition.material);
        stimuli_.text(sculpture ? sculpture->id : "").text(material ? material->id : "");
        stimuli_.text(stimulus.source).text(stimulus.frames_sha256);
        stimuli_.text(sculpture ? sculpture->mesh_file : "").text(sculpture ? sculpture->mesh_sha256 : "");
        stimuli_.end_row();
    }
}

void TableExport::write_display_boxes() {
    TableWriter& row = display_box_;
    for (const auto& [sitting, box] : record_.display_boxes()) {
        row.integer(sitting).word(name_of(box.use));
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

void TableExport::close() {
    for (TableWriter* writer :
         {&trials_, &flips_, &samples_, &gaze_events_, &events_, &responses_, &stimuli_, &display_box_}) {
        counts_.rows += writer->rows();
        counts_.bytes += writer->bytes();
        writer->close();
    }
    write_text_file(directory_ / dictionary_file, table_dictionary(tables_, format_));
}

std::vector<std::string> file_names(const SessionHeader& header, TableFormat format) {
    std::vector<std::string> names{dictionary_file};
    const ExportTables tables(header);
    for (const Table* table : tables.all())
        names.push_back(fmt::format("{}.{}", table->name, ending_of(format)));
    return names;
}

} // namespace

TableExportCounts export_tables(const SessionRecord& record, const LookupFor& lookup_for,
                                const fs::path& directory, const TableExportOptions& options) {
    const std::vector<std::string> names = file_names(record.header(), options.format);
    ExportFolder folder(directory, options.overwrite, [&](const std::string& name) {
        return std::find(names.begin(), names.end(), name) != names.end();
    });
    TableExport tables(record, folder.path(), options);
    const int all = static_cast<int>(record.trials().size());
    int done = 0;
    for (const TrialRecord& trial : record.trials()) {
        if (trial.counts)
            tables.write_trial(trial, lookup_for(trial.trial.condition.sculpture));
        else
            tables.write_other_attempt(trial);
        if (options.progress)
            options.progress(++done, all);
    }
    tables.write_what_belongs_to_no_trial();
    tables.write_display_boxes();
    tables.close();
    folder.publish();
    return tables.counts();
}

} // namespace overt
