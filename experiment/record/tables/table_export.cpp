#include "experiment/record/tables/table_export.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "experiment/base/export_folder.h"
#include "experiment/base/whole_file.h"
#include "experiment/record/tables/export_tables.h"
#include "experiment/record/tables/pupil_words.h"

namespace fs = std::filesystem;

namespace overt {
namespace {

constexpr const char* dictionary_file = "dictionary.json";

ExportTables with_words(ExportTables tables, const TrialWords& words) {
    tables.trials.add<TrialRow>(trial_word_columns(words));
    return tables;
}

/// Writes one session's tables into a directory.
class TableExport {
  public:
    TableExport(const SessionRecord& record, const fs::path& directory, const TableExportOptions& options)
        : record_(record), header_(record.header()), format_(options.format), words_(trial_words(record)),
          participant_(participant_row(record)),
          tables_(with_words(ExportTables(header_, options.cone_accuracy, record.event_origins(),
                                          {participant_}, pupil_words(record)),
                             words_)),
          directory_(directory), sample_rows_(tables_.samples, record, format_, options.cone_accuracy) {
        for (const Table* table : tables_.all())
            writers_.try_emplace(table, directory, *table, format_);
    }

    /// Puts the samples of the trial aside: those of trials of one sculpture come one after another.
    void join_samples(const TrialRecord& trial, const SurfaceLookup* lookup);
    /// With the samples that were put aside.
    void write_trial(const TrialRecord& trial);
    /// One that has no rows in the other tables.
    void write_other_attempt(const TrialRecord& trial) { write(tables_.trials, TrialRow{trial, nullptr}); }
    void write_what_belongs_to_no_trial();
    void close();
    const TableExportCounts& counts() const { return counts_; }

  private:
    template <class Row> TableWriter& writer(const RowLayout<Row>& layout) {
        return writers_.at(&layout.table());
    }
    template <class Row> void write(const RowLayout<Row>& layout, const Row& row) {
        layout.write(writer(layout), row);
    }

    const SessionRecord& record_;
    const SessionHeader& header_;
    const TableFormat format_;
    const TrialWords words_;
    const ParticipantRow participant_;
    const ExportTables tables_;
    std::map<const Table*, TableWriter> writers_;
    const fs::path directory_;
    SampleRows sample_rows_;
    TableExportCounts counts_;
    std::map<std::int64_t, SampleCounts> aside_; ///< by the trial's id
    fs::path aside_file(const TrialRecord& trial) const {
        return directory_ / fmt::format("samples_{}.part", trial.id);
    }
};

void TableExport::join_samples(const TrialRecord& trial, const SurfaceLookup* lookup) {
    TableWriter aside(aside_file(trial), tables_.samples.table(), format_, Packing::none,
                      TableWriter::Header::none);
    aside_[trial.id] = sample_rows_.write(aside, trial, record_.ledger(trial), lookup);
    aside.close();
}

void TableExport::write_trial(const TrialRecord& trial) {
    counts_.flips +=
        write_ledger(writer(tables_.flips), tables_.flips, header_, trial, record_.ledger(trial));
    const SampleCounts of_trial = aside_.at(trial.id);
    TableWriter& samples = writer(tables_.samples);
    samples.take(aside_file(trial), of_trial.samples);
    fs::remove(aside_file(trial));
    const SampleCounts after = sample_rows_.write_after(samples, trial);
    counts_.samples += after.samples;
    counts_.samples_without_gaze += after.without_gaze;
    write_gaze_events(writer(tables_.gaze_events), tables_.gaze_events, record_, trial);
    write(tables_.responses, trial);
    write(tables_.trials, TrialRow{trial, &of_trial});

    ++counts_.trials;
    counts_.samples += of_trial.samples;
    counts_.samples_without_gaze += of_trial.without_gaze;
    counts_.samples_on_object += of_trial.on_object;
    counts_.samples_off_plan += of_trial.off_plan;
}

void TableExport::write_what_belongs_to_no_trial() {
    write_gaze_events_outside(writer(tables_.gaze_events), tables_.gaze_events, record_);
    record_.read_events([this](const RecordedEvent& event) { write(tables_.events, event); });
    write(tables_.participants, participant_);
    for (const RecordedStimulus& stimulus : header_.stimuli)
        write(tables_.stimuli, stimulus);
    for (const RecordedButton& button : record_.button_changes())
        write(tables_.buttons, button);
    for (const RecordedMarker& marker : record_.markers())
        write(tables_.markers, marker);
    for (const auto& [sitting, box] : record_.display_boxes()) {
        const auto readings = record_.box_clock_readings(sitting);
        write(tables_.display_box,
              DisplayBoxRow{sitting, box,
                            readings.empty() ? std::nullopt : std::optional(fit_box_clock(readings))});
    }
}

void TableExport::close() {
    for (auto& [table, writer] : writers_) {
        counts_.rows += writer.rows();
        counts_.bytes += writer.bytes();
        writer.close();
    }
    write_text_file(directory_ / dictionary_file, table_dictionary(tables_, format_));
}

std::vector<std::string> file_names(const SessionHeader& header, TableFormat format) {
    std::vector<std::string> names{dictionary_file};
    const ExportTables tables(header);
    for (const Table* table : tables.all())
        names.push_back(file_name_of(*table, format));
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
    // Sculpture by sculpture, for the maps of one take much memory, and making them ready much time.
    std::set<int> sculptures;
    for (const TrialRecord& trial : record.trials())
        if (trial.counts)
            sculptures.insert(trial.trial.condition.sculpture);
    for (const int sculpture : sculptures) {
        const SurfaceLookup* const lookup = lookup_for(sculpture);
        for (const TrialRecord& trial : record.trials()) {
            if (!trial.counts || trial.trial.condition.sculpture != sculpture)
                continue;
            tables.join_samples(trial, lookup);
            if (options.progress)
                options.progress(++done, all);
        }
    }
    for (const TrialRecord& trial : record.trials()) {
        if (trial.counts) {
            tables.write_trial(trial);
            continue;
        }
        tables.write_other_attempt(trial);
        if (options.progress)
            options.progress(++done, all);
    }
    tables.write_what_belongs_to_no_trial();
    tables.close();
    folder.publish();
    return tables.counts();
}

fs::path write_participants(const std::vector<ParticipantRow>& rows, const fs::path& directory,
                            TableFormat format) {
    const RowLayout<ParticipantRow> layout = participants_layout(rows);
    fs::path file = participants_file(directory, format);
    TableText text(layout.table(), format);
    for (const ParticipantRow& row : rows)
        layout.write(text, row);
    write_whole_file(file, names_line(layout.table(), format) + text.all());
    return file;
}

fs::path participants_file(const fs::path& directory, TableFormat format) {
    return directory / fmt::format("participants.{}", ending_of(format));
}

} // namespace overt
