#include "experiment/record/tables/sample_rows.h"

#include <algorithm>
#include <memory>

#include <fmt/format.h>

#include "experiment/base/parallel.h"

namespace overt {
namespace {

constexpr int probability_decimals = 4;

/// A coordinate of the place that is looked at through glass.
auto far_coordinate(int axis) {
    return [axis](const SampleCells& row) {
        return of_maybe(row.far,
                        [axis](auto& far) { return surface_coordinate(far.surface.position[axis]); });
    };
}

void add_far_columns(RowLayout<SampleCells>& layout, const SessionHeader& header) {
    const LengthWords length = length_words(header);
    const std::string place = fmt::format("Place of the unturned surface where the line of sight, bent by "
                                          "Snell's law at 587.6 nm, leaves a body of clear glass{}",
                                          length.remark);
    layout.add<SampleCells>({
        {{"through_x",
          fmt::format("{}; n/a of all other materials, where the gaze did not meet it, and where the line is "
                      "reflected totally more than {} times",
                      place, most_total_reflections),
          length.unit},
         far_coordinate(0)},
        {{"through_y", place, length.unit}, far_coordinate(1)},
        {{"through_z", place + ", upwards", length.unit}, far_coordinate(2)},
        {{"through_triangle", "Index of the mesh's triangle at that place, from 0"},
         [](auto& row) { return of_maybe(row.far, [](auto& far) { return far.surface.triangle; }); }},
        {{"through_reflections", "How often the line was reflected totally inside before it left"},
         [](auto& row) { return of_maybe(row.far, &FarPoint::reflections); }},
    });
}

} // namespace

RowLayout<SampleCells> samples_layout(const SharedColumns& shared, const SessionHeader& header,
                                      const PupilWords& pupil, const FurtherColumns& further) {
    RowLayout<SampleCells> layout{
        "samples",
        "One row for each gaze sample of the completed trials, and of an imported recording also for those "
        "between a trial's result and the next trial, joined with the frame that was lit on its row "
        "when it was taken. Pixels: origin at the top left corner, y down, pixel centres at 0.5.",
        {
            {shared.trial, &SampleCells::trial},
            {shared.task, [](auto& to, auto& row) { to.ready(row.task); }},
        }};
    for (std::size_t i = 0; i < shared.stimulus.size(); ++i)
        layout.add<SampleCells>(
            {{shared.stimulus[i].what, [i](auto& to, auto& row) { to.ready(row.stimulus[i]); }}});
    if (shared.has_slots)
        layout.add<SampleCells>({{shared.slot, [](auto& to, auto& row) { to.ready(row.slot); }}});
    layout.add<JoinedRow>(time_columns());
    layout.add<SampleCells>({
        {{"tracker_time_us", "When the sample was taken, by the tracker's own clock", "us"}, tracker_time_us},
        {eye_column(), [](auto& to, auto& row) { to.word(word_of_eye(row.sample.eye)); }},
        {{"x_px", "Gaze on the screen, to the right", "px"}, gaze_x},
        {{"y_px", "Gaze on the screen, downwards", "px"}, gaze_y},
        {{pupil.column, pupil.meaning, pupil.unit}, pupil_size},
    });
    layout.add<JoinedRow>(place_columns(header));
    if (further.far_points)
        add_far_columns(layout, header);
    if (!further.cone_accuracy)
        return layout;
    const Degrees accuracy = *further.cone_accuracy;
    layout.add<SampleCells>({
        {{"p_object",
          fmt::format("Probability that the gaze was on the object, taking the tracker to be {} degrees off "
                      "on average, normally distributed to all sides; n/a as in silhouette_distance_deg",
                      accuracy.value)},
         [](auto& row) {
             return of_maybe(row.shares, [](const GazeCone::Shares& shares) {
                 return Fixed{shares.of_object, probability_decimals};
             });
         }},
    });
    for (const std::string& part : all_part_names(header))
        layout.add<SampleCells>({
            {{"p_" + part,
              fmt::format("The same for the part \"{}\"; n/a, too, if the object has no such part. All parts "
                          "together make p_object",
                          part)},
             [part](auto& row) {
                 const auto own = std::ranges::find(row.own_parts, part) - row.own_parts.begin();
                 const auto index = static_cast<std::size_t>(own);
                 return row.shares && index < row.own_parts.size()
                            ? std::optional(Fixed{row.shares->of_part[index], probability_decimals})
                            : std::nullopt;
             }},
        });
    return layout;
}

SampleRows::SampleRows(const RowLayout<SampleCells>& layout, const SessionRecord& record, TableFormat format,
                       const FurtherColumns& further)
    : layout_(layout), record_(record), header_(record.header()), format_(format),
      nothing_(text_cell("", format)), columns_(stimulus_columns_of(header_)),
      no_stimulus_(columns_.size(), nothing_) {
    for (int slot = 0; further.cone_accuracy && slot < static_cast<int>(header_.slots.size()); ++slot)
        cones_.emplace_back(header_.screen_of_slot(slot), *further.cone_accuracy);
}

SampleCounts SampleRows::write(TableWriter& to, const TrialRecord& trial,
                               const std::optional<TrialLedger>& ledger, const LookupsOfEyes& lookups,
                               const GlassOfEyes& glass, PassingFixations& fixations) {
    return write_all(to, trial, SampleJoin(record_, trial, ledger, lookups), lookups, glass, &fixations);
}

SampleCounts SampleRows::write_after(TableWriter& to, const TrialRecord& trial) {
    const SampleJoin join(header_.display.screen, record_.clock_map(trial),
                          record_.flip_history(trial, std::nullopt), {});
    return write_all(to, trial, join, {}, {}, nullptr);
}

SampleCounts SampleRows::write_all(TableWriter& to, const TrialRecord& trial, const SampleJoin& join,
                                   const LookupsOfEyes& lookups, const GlassOfEyes& glass,
                                   PassingFixations* fixations) const {
    constexpr std::size_t batch = 1024;
    const bool is_after = !fixations;
    const Stimulus stimulus = trial.trial.stimulus;
    const std::string task = text_cell(is_after ? "" : item(header_.tasks, trial.trial.task).id, format_);
    std::vector<std::string> shown = no_stimulus_;
    for (std::size_t i = 0; i < columns_.size() && !is_after; ++i)
        shown[i] = level_cell(columns_[i].level_of(stimulus), format_);
    const std::string slot = text_cell(is_after ? "" : item(header_.slots, trial.trial.slot).id, format_);
    const GazeCone* const cone = cones_.empty() ? nullptr : &item(cones_, trial.trial.slot);
    const std::vector<std::string> parts = part_cells_of(header_, stimulus.object, format_);
    const std::vector<std::string>& own_parts = item(header_.objects, stimulus.object).part_names;
    const auto number = is_after ? std::nullopt : std::optional(trial.trial.index + 1);
    SampleCounts counts;
    const auto take = [&](std::span<const GazeSample> samples) {
        const std::size_t batches = (samples.size() + batch - 1) / batch;
        std::vector<std::unique_ptr<TableText>> texts(batches);
        std::vector<std::vector<PlacedSample>> placed(batches);
        std::vector<SampleCounts> of_batch(batches);
        parallel_for(static_cast<int>(batches), [&](int index) {
            const auto i = static_cast<std::size_t>(index);
            const auto piece = samples.subspan(i * batch, std::min(batch, samples.size() - i * batch));
            texts[i] = std::make_unique<TableText>(layout_.table(), format_);
            of_batch[i] = write_batch(
                *texts[i], placed[i],
                {piece, number, join, lookups, glass, task, slot, shown, cone, parts, own_parts, fixations});
        });
        for (std::size_t i = 0; i < batches; ++i) {
            to.take(*texts[i]);
            counts += of_batch[i];
            for (std::size_t k = 0; k < placed[i].size(); ++k)
                fixations->take(samples[i * batch + k].eye, placed[i][k]);
        }
    };
    if (is_after)
        record_.read_samples_after(trial, samples_at_a_time, take);
    else
        record_.read_samples(trial, samples_at_a_time, take);
    return counts;
}

SampleCounts SampleRows::write_batch(TableText& to, std::vector<PlacedSample>& placed,
                                     const Piece& piece) const {
    std::vector<JoinedSample> joined(piece.samples.size());
    piece.join.join(piece.samples, joined);
    const std::vector<GazeCone::Shares> shares = cone_shares(piece, joined);
    SampleCounts counts;
    for (std::size_t i = 0; i < piece.samples.size(); ++i) {
        const bool is_elsewhere = joined[i].is_elsewhere;
        const GlassSight* const glass = piece.glass.of(piece.samples[i].eye);
        const std::optional<SurfacePoint>& front = joined[i].sight.surface;
        layout_.write(to, {{piece.samples[i], joined[i], piece.parts},
                           piece.trial,
                           piece.task,
                           is_elsewhere || !piece.samples[i].gaze ? nothing_ : piece.slot,
                           is_elsewhere ? no_stimulus_ : piece.stimulus,
                           piece.own_parts,
                           shares.empty() || shares[i].of_part.empty() ? nullptr : &shares[i],
                           glass && front ? glass->far_point(joined[i].shown->pose, *front) : std::nullopt});
        if (piece.fixations)
            placed.push_back(piece.fixations->place(piece.samples[i], joined[i]));
        counts.without_gaze += !piece.samples[i].gaze;
        counts.on_object += joined[i].sight.surface.has_value();
        counts.off_plan += joined[i].off_plan;
    }
    counts.samples = static_cast<std::int64_t>(piece.samples.size());
    return counts;
}

/// Of each sample that fell on a lit frame; the others' shares are empty.
std::vector<GazeCone::Shares> SampleRows::cone_shares(const Piece& piece,
                                                      std::span<const JoinedSample> joined) {
    if (!piece.cone || (!piece.lookups.left && !piece.lookups.right))
        return {};
    std::vector<GazeCone::Shares> shares(joined.size());
    for (std::size_t i = 0; i < joined.size(); ++i)
        if (joined[i].shown)
            shares[i] = piece.cone->shares(*piece.lookups.of(piece.samples[i].eye), joined[i].shown->pose,
                                           *piece.samples[i].gaze, piece.own_parts.size());
    return shares;
}

} // namespace overt
