#include "experiment/record/tables/table_export.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "experiment/base/export_folder.h"
#include "experiment/base/whole_file.h"
#include "experiment/maps/coordinate_maps.h"
#include "experiment/record/read/gaze_answer.h"
#include "experiment/record/tables/export_tables.h"
#include "experiment/record/tables/imported_trials.h"
#include "experiment/study/fixations/passing_fixations.h"
#include "experiment/study/fixations/trial_presentation.h"

namespace fs = std::filesystem;

namespace overt {
namespace {

constexpr const char* dictionary_file = "dictionary.json";

ExportTables with_messages(ExportTables tables, const TrialMessages& messages) {
    tables.trials.add<TrialRow>(imported_trial_columns(messages));
    return tables;
}

/// Of a recording of which nobody knows when a presentation ended.
constexpr double without_end_s = 1e9;

/// Writes one session's tables into a directory.
class TableExport {
  public:
    TableExport(const SessionRecord& record, const fs::path& directory, const TableExportOptions& options)
        : record_(record), header_(record.header()), format_(options.format),
          messages_(trial_messages(record)), participant_(participant_row(record)),
          tables_(with_messages(ExportTables(header_, pupil_words(record), options.further,
                                             record.event_origins(), {participant_}),
                                messages_)),
          directory_(directory), sample_rows_(tables_.samples, record, format_, options.further),
          validations_(validations_of(record)) {
        for (const Table* table : tables_.all())
            writers_.try_emplace(table, directory, *table, format_);
    }

    /// What the samples of presentations of the object in a view are to be joined with.
    void begin_object(const ViewedObject& viewed, const LookupsOfEyes& lookups);
    /// Puts the samples and events of a presentation aside: those of one object come one after another.
    void join_samples(const TrialRecord& trial, const GlassOfEyes& glass);
    /// With what was put aside.
    void write_trial(const TrialRecord& trial);
    /// One that has no rows in the other tables.
    void write_other_attempt(const TrialRecord& trial) { write(tables_.trials, TrialRow{trial, nullptr}); }
    void write_what_belongs_to_no_trial();
    void write_probes();
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
    const TrialMessages messages_;
    const ParticipantRow participant_;
    const ExportTables tables_;
    std::map<const Table*, TableWriter> writers_;
    const fs::path directory_;
    SampleRows sample_rows_;
    TableExportCounts counts_;
    struct Aside {
        SampleCounts samples;
        std::int64_t events = 0;
    };
    std::map<std::pair<std::int64_t, int>, Aside> aside_; ///< by the trial's id, and the presentation's place
    TableWriter aside_writer(const Table& table, const TrialRecord& trial) const {
        return {aside_file(table, trial), table, format_, Packing::none, TableWriter::Header::none};
    }
    fs::path aside_file(const Table& table, const TrialRecord& trial) const {
        return directory_ / fmt::format("{}_{}_{}.part", table.name, trial.id, trial.place);
    }
    template <class Row>
    void take_aside(const RowLayout<Row>& layout, const TrialRecord& trial, std::int64_t rows) {
        writer(layout).take(aside_file(layout.table(), trial), rows);
        fs::remove(aside_file(layout.table(), trial));
    }

    /// Of what a trial shows, the place in whose slot gaze lies.
    class PlaceFinder {
      public:
        PlaceFinder(const SessionRecord& record, const TrialRecord& trial);
        /// Of several slots that gaze lies in, the one that was lit at this time of the tracker's; the first,
        /// if none was, or if gaze lies in none.
        std::size_t place_with(const std::optional<ScreenPoint>& gaze, TrackerTime at) const;

      private:
        std::optional<ClockMap> clock_map_;
        std::vector<ScreenGeometry> screens_;
        std::vector<FlipHistory> lit_;
    };
    /// Puts what was put aside of all presentations of a trial into the tables: each sample and event once.
    void merge_presentations(const TrialRecord& trial, std::int64_t samples);
    /// Makes of the lines put aside of each presentation those of the trial: the n-th is that of places[n].
    void take_lines_of(const Table& table, const TrialRecord& trial,
                       const std::vector<std::size_t>& places) const;

    /// `accuracy`: of gaze, by its validation.
    void note_points(const TrialRecord& trial, const std::optional<TrialLedger>& ledger,
                     const std::optional<Degrees>& accuracy);
    std::map<std::pair<std::int64_t, std::size_t>, PointedAnswer>
        points_; ///< by trial's id, and which answer

    /// Whose the fixations are that name no eye: they are of the one that was recorded.
    Eye eye_of_unnamed(std::span<const GazeEvent> events, int sitting) const;

    /// The object's whose trials are joined now.
    LookupsOfEyes lookups_;
    const SurfaceLookup* lookup_ = nullptr; ///< of the eye that is analysed
    std::optional<ObjectScale> scale_;
    std::optional<SurfaceWays> ways_;
    const StudyOptions analysis_; ///< the rules of `overt analyze` without options
    const std::vector<RecordedAccuracy> validations_;
};

void TableExport::begin_object(const ViewedObject& viewed, const LookupsOfEyes& lookups) {
    const RecordedObject& recorded = item(header_.objects, viewed.object);
    lookups_ = lookups;
    lookup_ = lookups.of(header_.tracker.eye);
    scale_ = object_scale(recorded.camera(viewed.view), recorded.axis_point,
                          header_.screen_of_view(viewed.view), recorded.unit);
    ways_.reset();
    const auto* maps = dynamic_cast<const CoordinateMaps*>(lookup_);
    if (maps && scale_)
        ways_.emplace(maps->mesh(), *scale_);
}

Eye TableExport::eye_of_unnamed(std::span<const GazeEvent> events, int sitting) const {
    const Eye usual = header_.tracker.eye;
    // To know which eyes there are takes a look at all samples.
    if (std::ranges::all_of(events, [](const GazeEvent& event) {
            return event.kind != GazeEvent::Kind::fixation || event.eye.has_value();
        }))
        return usual;
    const SessionRecord::Eyes eyes = record_.eyes(sitting);
    const bool has_usual = usual == Eye::left ? eyes.left : eyes.right;
    return has_usual || eyes.none() ? usual : usual == Eye::left ? Eye::right : Eye::left;
}

/// Of several slots that a place lies in, the one that was lit.
void TableExport::note_points(const TrialRecord& trial, const std::optional<TrialLedger>& ledger,
                              const std::optional<Degrees>& accuracy) {
    const std::vector<GivenAnswer>& given = trial.outcome.given;
    for (std::size_t i = 0; i < given.size(); ++i) {
        if (given[i].kind != point_kind)
            continue;
        const FlipHistory history = record_.flip_history(trial, ledger);
        std::optional<PointedAnswer> pointed = pointed_answer(header_, trial, history, lookup_, given[i]);
        if (const std::optional<GazeOfAnswer> gaze = gaze_of_answer(record_, trial, given[i])) {
            PointedPlace place{.at = gaze->place, .when = gaze->at};
            if (accuracy)
                place.covariance_px = covariance_of_gaze(header_.display.screen, gaze->place, *accuracy);
            pointed = pointed_answer(header_, trial, history, lookup_, place);
        }
        if (!pointed)
            continue;
        const auto [known, is_new] = points_.try_emplace({trial.id, i}, *pointed);
        if (!is_new && !known->second.shown)
            known->second = *pointed;
    }
}

void TableExport::join_samples(const TrialRecord& trial, const GlassOfEyes& glass) {
    std::vector<GazeEvent> events;
    record_.read_gaze_events(trial, [&](const GazeEvent& event) { events.push_back(event); });
    const std::optional<TrialLedger> ledger = record_.ledger(trial);
    const TrialPresentation presentation = presentation_of(header_, trial, ledger.has_value(), validations_);
    const std::optional<ClockMap> clock_map = record_.clock_map(trial);
    FixationContext context{analysis_,
                            {},
                            clock_map,
                            presentation.onset,
                            presentation.duration_s.value_or(without_end_s),
                            header_.poses.angles,
                            scale_,
                            lookup_ != nullptr,
                            presentation.has_stimulus,
                            dynamic_cast<const CoordinateMaps*>(lookup_) != nullptr,
                            ways_ ? &*ways_ : nullptr,
                            lookup_};
    context.has_other_slots = !trial.trial.beside.empty();
    note_points(trial, ledger,
                presentation.validation ? std::optional(Degrees{presentation.validation->mean_deg})
                                        : std::nullopt);
    PassingFixations fixations(context, events, eye_of_unnamed(events, trial.sitting),
                               Degrees{presentation.validation ? presentation.validation->mean_deg : 0.0});
    for (const Eye eye : {Eye::left, Eye::right})
        fixations.look_up(eye, lookups_.of(eye));
    Aside& aside = aside_[{trial.id, trial.place}];
    TableWriter samples = aside_writer(tables_.samples.table(), trial);
    aside.samples = sample_rows_.write(samples, trial, ledger, lookups_, glass, fixations);
    samples.close();
    TableWriter rows = aside_writer(tables_.gaze_events.table(), trial);
    write_gaze_events(rows, tables_.gaze_events, record_, trial, events, fixations.finish());
    aside.events = rows.rows();
    rows.close();
}

void TableExport::write_trial(const TrialRecord& trial) {
    SampleCounts of_trial;
    for (std::size_t i = 0; i < trial.trial.shown_count(); ++i) {
        const TrialRecord seen = trial.seen_in(i);
        const std::optional<TrialLedger> ledger = record_.ledger(seen);
        const std::int64_t flips = write_ledger(writer(tables_.flips), tables_.flips, header_, seen, ledger);
        write_moves(writer(tables_.moves), tables_.moves, record_, seen, ledger);
        for (const ObserverTurns& turns : observer_turns(record_, seen, ledger))
            write(tables_.turns, TurnRow{seen, turns});
        write_courses(writer(tables_.courses), tables_.courses, record_, seen, ledger);
        const SampleCounts& samples = aside_.at({trial.id, seen.place}).samples;
        of_trial.on_object += samples.on_object;
        of_trial.off_plan += samples.off_plan;
        if (i == 0) {
            counts_.flips += flips;
            of_trial.samples = samples.samples;
            of_trial.without_gaze = samples.without_gaze;
        }
        if (header_.slots.size() > 1)
            write(tables_.presentations, TrialRow{seen, &samples});
    }
    merge_presentations(trial, of_trial.samples);
    const SampleCounts after = sample_rows_.write_after(writer(tables_.samples), trial);
    counts_.samples += after.samples;
    counts_.samples_without_gaze += after.without_gaze;
    write(tables_.responses, trial);
    write(tables_.trials, TrialRow{trial, &of_trial});

    ++counts_.trials;
    counts_.samples += of_trial.samples;
    counts_.samples_without_gaze += of_trial.without_gaze;
    counts_.samples_on_object += of_trial.on_object;
    counts_.samples_off_plan += of_trial.off_plan;
}

TableExport::PlaceFinder::PlaceFinder(const SessionRecord& record, const TrialRecord& trial)
    : clock_map_(record.clock_map(trial)) {
    for (std::size_t i = 0; i < trial.trial.shown_count(); ++i) {
        const TrialRecord seen = trial.seen_in(i);
        screens_.push_back(record.header().screen_of_slot(seen.trial.slot));
        lit_.push_back(record.flip_history(seen, record.ledger(seen)));
    }
}

std::size_t TableExport::PlaceFinder::place_with(const std::optional<ScreenPoint>& gaze,
                                                 TrackerTime at) const {
    std::optional<std::size_t> first;
    for (std::size_t i = 0; gaze && i < screens_.size(); ++i) {
        if (!screens_[i].is_inside_image(screens_[i].image_from_screen(*gaze)))
            continue;
        if (clock_map_ && lit_[i].frame_shown_at(clock_map_->to_session(at).time, gaze->y_px))
            return i;
        first = first.value_or(i);
    }
    return first.value_or(0);
}

void TableExport::merge_presentations(const TrialRecord& trial, std::int64_t samples) {
    const std::int64_t events = aside_.at({trial.id, 0}).events;
    if (trial.trial.shown_count() > 1) {
        const PlaceFinder finder(record_, trial);
        std::vector<std::size_t> places;
        record_.read_samples(trial, samples_at_a_time, [&](std::span<const GazeSample> piece) {
            for (const GazeSample& sample : piece)
                places.push_back(finder.place_with(sample.gaze, sample.sampled_at));
        });
        take_lines_of(tables_.samples.table(), trial, places);
        places.clear();
        record_.read_gaze_events(trial, [&](const GazeEvent& event) {
            places.push_back(finder.place_with(event.place, event.start + (event.end - event.start) / 2));
        });
        take_lines_of(tables_.gaze_events.table(), trial, places);
    }
    take_aside(tables_.samples, trial, samples);
    take_aside(tables_.gaze_events, trial, events);
}

void TableExport::take_lines_of(const Table& table, const TrialRecord& trial,
                                const std::vector<std::size_t>& places) const {
    std::vector<std::ifstream> of_place;
    for (std::size_t i = 0; i < trial.trial.shown_count(); ++i)
        of_place.emplace_back(aside_file(table, trial.seen_in(i)), std::ios::binary);
    const fs::path merged = directory_ / fmt::format("{}_{}_merged.part", table.name, trial.id);
    {
        OutputFile file(merged);
        std::string line, taken;
        for (const std::size_t place : places) {
            for (std::size_t i = 0; i < of_place.size(); ++i)
                if (std::getline(of_place[i], line); i == place)
                    taken = line + '\n';
            file.text() += taken;
            file.flush_if_full();
        }
        file.close();
    }
    for (std::size_t i = 0; i < of_place.size(); ++i)
        fs::remove(aside_file(table, trial.seen_in(i)));
    fs::rename(merged, aside_file(table, trial));
}

void TableExport::write_probes() {
    if (header_.points.empty())
        return;
    for (const RecordedPoint& point : header_.points)
        write(tables_.points, point);
    for (const TrialRecord& trial : record_.trials()) {
        for (const ShownProbe& probe : trial.outcome.probes)
            write(tables_.probes, ProbeRow{trial, probe});
        for (const GivenAnswer& given : trial.outcome.given)
            if (given.gauge)
                write(tables_.gauges, GaugeRow{trial, given, *given.gauge});
        int number = 0;
        for (const AnswerInput& input : trial.outcome.inputs) {
            ++number;
            if (input.attitude)
                write(tables_.gauge_changes, GaugeChangeRow{trial, number, input});
        }
    }
}

void TableExport::write_what_belongs_to_no_trial() {
    write_gaze_events_outside(writer(tables_.gaze_events), tables_.gaze_events, record_);
    record_.read_events([this](const RecordedEvent& event) { write(tables_.events, event); });
    write(tables_.participants, participant_);
    for (const RecordedStimulus& stimulus : header_.stimuli)
        write(tables_.stimuli, stimulus);
    for (const RecordedButton& button : record_.button_changes())
        write(tables_.buttons, button);
    for (const RecordedKeyPress& press : record_.key_presses())
        write(tables_.key_presses, press);
    for (const RecordedMarker& marker : record_.markers())
        write(tables_.markers, marker);
    for (const TrialRecord& trial : record_.trials()) {
        int number = 0;
        for (const AttemptStep& step : trial.outcome.steps)
            write(tables_.steps, StepRow{trial, ++number, step});
        for (std::size_t i = 0; i < trial.outcome.given.size(); ++i) {
            const auto pointed = points_.find({trial.id, i});
            write(tables_.given_answers,
                  GivenAnswerRow{trial, trial.outcome.given[i],
                                 pointed == points_.end() ? nullptr : &pointed->second});
        }
        for (const GivenAnswer& given : trial.outcome.given)
            for (const MatchSetting& set : given.settings)
                write(tables_.settings, SettingRow{trial, given, set});
        number = 0;
        for (const AnswerInput& input : trial.outcome.inputs)
            write(tables_.answer_inputs, AnswerInputRow{trial, ++number, input});
    }
    write_probes();
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

LookupsOfEyes lookups_in(const SessionHeader& header, const Trial& trial, const LookupFor& lookup_for) {
    const ViewedObject left = viewed_in(header, trial, Eye::left),
                       right = viewed_in(header, trial, Eye::right);
    const SurfaceLookup* const of_left = lookup_for(left);
    return {of_left, right == left ? of_left : lookup_for(right)};
}

/// How each eye looked through a trial's stimulus.
static GlassOfEyes glass_in(const SessionHeader& header, const Trial& trial, const GlassFor& glass_for) {
    const ViewedObject left = viewed_in(header, trial, Eye::left),
                       right = viewed_in(header, trial, Eye::right);
    const GlassSight* const of_left = glass_for(left, trial.stimulus.material);
    return {of_left, right == left ? of_left : glass_for(right, trial.stimulus.material)};
}

TableExportCounts export_tables(const SessionRecord& record, const LookupFor& lookup_for,
                                const fs::path& directory, const TableExportOptions& options,
                                const GlassFor& glass_for) {
    const std::vector<std::string> names = file_names(record.header(), options.format);
    ExportFolder folder(directory, options.overwrite, [&](const std::string& name) {
        return std::find(names.begin(), names.end(), name) != names.end();
    });
    TableExport tables(record, folder.path(), options);
    const int all = static_cast<int>(record.trials().size());
    int done = 0;
    // Object by object, for the maps of one take much memory, and making them ready much time.
    std::set<ViewedObject> seen;
    const std::vector<TrialRecord> presentations = record.presentations();
    for (const TrialRecord& trial : presentations)
        if (trial.counts)
            seen.insert(viewed_in(record.header(), trial.trial));
    for (const ViewedObject& object : seen) {
        bool is_begun = false;
        for (const TrialRecord& trial : presentations) {
            if (!trial.counts || viewed_in(record.header(), trial.trial) != object)
                continue;
            if (!std::exchange(is_begun, true))
                tables.begin_object(object, lookups_in(record.header(), trial.trial, lookup_for));
            tables.join_samples(trial, options.further.far_points
                                           ? glass_in(record.header(), trial.trial, glass_for)
                                           : GlassOfEyes{});
            if (options.progress && trial.place == 0)
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
