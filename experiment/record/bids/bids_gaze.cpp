#include "experiment/record/bids/bids_gaze.h"

#include <algorithm>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "experiment/base/error.h"
#include "experiment/base/json_text.h"
#include "experiment/record/bids/bids_gaze_events.h"
#include "experiment/record/bids/bids_tracker.h"
#include "experiment/record/read/tracker_facts.h"
#include "experiment/record/tables/export_tables.h"
#include "experiment/record/tables/joined_cells.h"
#include "experiment/record/tables/sample_rows.h"

namespace fs = std::filesystem;

namespace overt {
namespace {

using Json = nlohmann::ordered_json;

/// BIDS wants these three first, in this order.
JoinedColumns first_columns() {
    return {
        {{"timestamp", "Time of the sample by the tracker's own clock", "us"}, tracker_time_us},
        {{"x_coordinate", "Gaze on the screen, to the right from its left edge, as the tracker gave it",
          "pixel"},
         gaze_x},
        {{"y_coordinate", "Gaze on the screen, downwards from its top edge, as the tracker gave it", "pixel"},
         gaze_y},
    };
}

/// BIDS has one name for it, and wants the words area or diameter.
RowLayout<JoinedRow> physio_layout(const PupilWords& words) {
    RowLayout<JoinedRow> layout("", "", first_columns());
    layout.add<JoinedRow>({
        {{"pupil_size", words.meaning + (words.unit == "mm" ? "" : ", in the tracker's own unit"),
          words.unit == "mm" ? "mm" : "arbitrary"},
         pupil_size},
    });
    return layout;
}

RowLayout<JoinedRow> surface_layout(const SessionHeader& header) {
    RowLayout<JoinedRow> layout("", "", first_columns());
    layout.add<JoinedRow>(time_columns());
    layout.add<JoinedRow>(place_columns(header));
    if (const SharedColumns shared(header); shared.has_slots)
        layout.add<JoinedRow>({{shared.slot, [](auto& row) { return row.in_slot; }}});
    return layout;
}

/// The files of one eye.
class EyeFiles {
  public:
    EyeFiles(const SessionRecord& record, Eye eye, int number, int run, const PupilWords& pupil,
             const fs::path& raw, const fs::path& derived)
        : record_(record), eye_(eye), stem_(BidsNames(record.header()).eye_stem(run, number)),
          surface_stem_(BidsNames(record.header()).surface_stem(run, number)), raw_(raw), derived_(derived),
          physio_(physio_layout(pupil)), surface_(surface_layout(record.header())),
          samples_(raw / (stem_ + "_physio.tsv.gz"), physio_.table(), TableFormat::tsv, Packing::gzip,
                   TableWriter::Header::none) {
        if (!record.header().stimuli.empty())
            places_ =
                std::make_unique<TableWriter>(derived / (surface_stem_ + "_physio.tsv.gz"), surface_.table(),
                                              TableFormat::tsv, Packing::gzip, TableWriter::Header::none);
    }

    Eye eye() const { return eye_; }
    bool has_places() const { return places_ != nullptr; }

    void sample(const JoinedRow& row) {
        if (!first_)
            first_ = row.sample.sampled_at;
        physio_.write(samples_, row);
        if (places_)
            surface_.write(*places_, row);
    }

    void close(const std::optional<ClockMap>& clock_map, std::optional<SessionTime> zero, int run,
               BidsGazeCounts& counts);

  private:
    Json side_car(const Table& table, double start_s, int run) const;

    const SessionRecord& record_;
    Eye eye_;
    std::string stem_, surface_stem_;
    fs::path raw_, derived_;
    RowLayout<JoinedRow> physio_, surface_;
    TableWriter samples_;
    std::unique_ptr<TableWriter> places_; ///< null: nothing was presented
    std::optional<TrackerTime> first_;
};

Json EyeFiles::side_car(const Table& table, double start_s, int run) const {
    Json json = bids_tracker(record_, run, eye_);
    json["StartTime"] = start_s;
    json["PhysioType"] = "eyetrack";
    json["RecordedEye"] = word_of_eye(eye_);
    json["SampleCoordinateSystem"] = "gaze-on-screen";
    Json columns = Json::array();
    for (const TableColumn& column : table.columns)
        columns.push_back(column.name);
    json["Columns"] = std::move(columns);
    json.update(describe_columns(table.columns, TableFormat::tsv));
    return json;
}

void EyeFiles::close(const std::optional<ClockMap>& clock_map, std::optional<SessionTime> zero, int run,
                     BidsGazeCounts& counts) {
    const double start_s =
        clock_map && zero && first_ ? to_seconds(clock_map->to_session(*first_).time - *zero) : 0.0;
    for (TableWriter* writer : {&samples_, places_.get()}) {
        if (!writer)
            continue;
        counts.rows += writer->rows();
        counts.bytes += writer->bytes();
        writer->close();
    }
    write_text_file(raw_ / (stem_ + "_physio.json"), json_text(side_car(physio_.table(), start_s, run)));
    if (places_)
        write_text_file(derived_ / (surface_stem_ + "_physio.json"),
                        json_text(side_car(surface_.table(), start_s, run)));
    counts.samples += samples_.rows();
    ++counts.recordings;
    write_bids_gaze_events(record_, run, eye_, raw_ / (stem_ + "_physioevents"));
}

EyeFiles& file_of(const std::vector<std::unique_ptr<EyeFiles>>& files, Eye eye, const SessionRecord& record) {
    const auto of_eye =
        std::find_if(files.begin(), files.end(), [&](const auto& file) { return file->eye() == eye; });
    if (of_eye == files.end())
        throw RecordError(fmt::format("{}: a sample is of an eye that no trial's samples are of: the session "
                                      "file is damaged.",
                                      record.directory().string()));
    return **of_eye;
}

/// With what each eye saw.
SampleJoin join_of(const SessionRecord& record, const TrialRecord& trial, const LookupFor& lookup_for) {
    return {record, trial, lookups_in(record.header(), trial.trial, lookup_for)};
}

/// The samples of a trial that shows several stimuli, each with the one whose slot it lies in.
void write_presentations(const SessionRecord& record, const TrialRecord& trial, const LookupFor& lookup_for,
                         const std::vector<std::unique_ptr<EyeFiles>>& files) {
    const std::vector<GazeSample> samples = record.samples(trial);
    std::vector<JoinedSample> joined(samples.size()), in_slot(samples.size());
    std::vector<std::size_t> place_of(samples.size(), trial.trial.shown_count());
    std::vector<std::vector<std::string>> parts;
    for (std::size_t place = 0; place < trial.trial.shown_count(); ++place) {
        const TrialRecord seen = trial.seen_in(place);
        const int object = seen.trial.stimulus.object;
        parts.push_back(part_cells_of(record.header(), object, TableFormat::tsv));
        join_of(record, seen, lookup_for).join(samples, in_slot);
        for (std::size_t i = 0; i < samples.size(); ++i) {
            // Of two slots at one place, the one that was lit then.
            const bool is_here = !in_slot[i].is_elsewhere && in_slot[i].image_px;
            if (place > 0 && (!is_here || (joined[i].shown && !in_slot[i].shown)))
                continue;
            joined[i] = in_slot[i];
            if (joined[i].shown)
                place_of[i] = place;
        }
    }
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const std::size_t place = place_of[i];
        const bool is_in_one = place < parts.size();
        const std::string_view slot =
            is_in_one ? std::string_view(
                            record.header().slots[static_cast<std::size_t>(trial.trial.shown(place).slot)].id)
                      : std::string_view();
        file_of(files, samples[i].eye, record)
            .sample({samples[i], joined[i], is_in_one ? parts[place] : parts.front(), slot});
    }
}

} // namespace

std::optional<SessionTime> bids_zero(const SessionRecord& record, int run) {
    const std::optional<ClockMap> clock_map = record.clock_map(run);
    if (!clock_map)
        return std::nullopt;
    for (const TrialRecord& trial : record.trials())
        if (trial.sitting == run)
            if (const auto span = record.sample_span(trial))
                return clock_map->to_session(span->first).time;
    return std::nullopt;
}

BidsGazeCounts write_bids_gaze(const SessionRecord& record, int run, const LookupFor& lookup_for,
                               const fs::path& raw, const fs::path& derived) {
    const SessionRecord::Eyes eyes = record.eyes(run);
    const PupilWords pupil = pupil_words(record, run);
    std::vector<std::unique_ptr<EyeFiles>> files;
    for (const Eye eye : {Eye::left, Eye::right})
        if (eye == Eye::left ? eyes.left : eyes.right)
            files.push_back(std::make_unique<EyeFiles>(record, eye, static_cast<int>(files.size()) + 1, run,
                                                       pupil, raw, derived));
    std::vector<JoinedSample> joined;
    for (const TrialRecord& trial : record.trials()) {
        if (trial.sitting != run || files.empty())
            continue;
        const bool has_places = files.front()->has_places();
        if (has_places && trial.trial.shown_count() > 1) {
            write_presentations(record, trial, lookup_for, files);
            continue;
        }
        const int object = trial.trial.stimulus.object;
        const SampleJoin join =
            has_places ? join_of(record, trial, lookup_for) : SampleJoin(record, trial, {});
        const std::vector<std::string> parts = part_cells_of(record.header(), object, TableFormat::tsv);
        const std::string_view slot = record.header().slots[static_cast<std::size_t>(trial.trial.slot)].id;
        const auto take = [&](std::span<const GazeSample> samples) {
            joined.resize(samples.size());
            if (has_places)
                join.join(samples, joined);
            for (std::size_t i = 0; i < samples.size(); ++i)
                file_of(files, samples[i].eye, record)
                    .sample({samples[i], joined[i], parts, joined[i].shown ? slot : std::string_view()});
        };
        record.read_samples(trial, samples_at_a_time, take);
        record.read_samples_after(trial, samples_at_a_time, take);
    }
    BidsGazeCounts counts;
    const std::optional<ClockMap> clock_map = record.clock_map(run);
    const std::optional<SessionTime> zero = bids_zero(record, run);
    for (const auto& eye : files)
        eye->close(clock_map, zero, run, counts);
    return counts;
}

} // namespace overt
