#include "experiment/record/tables/sample_rows.h"

#include <algorithm>

#include <fmt/format.h>

#include "experiment/base/parallel.h"

namespace overt {
namespace {

constexpr int probability_decimals = 4;

} // namespace

RowLayout<SampleCells> samples_layout(const SharedColumns& shared, const SessionHeader& header,
                                      std::optional<Degrees> cone_accuracy) {
    RowLayout<SampleCells> layout{
        "samples",
        "One row for each gaze sample of the completed trials, joined with the frame that was lit on its row "
        "when it was taken. Pixels: origin at the top left corner, y down, pixel centres at 0.5.",
        {
            {shared.trial, [](auto& to, auto& row) { to.integer(row.trial); }},
            {shared.task, [](auto& to, auto& row) { to.ready(row.task); }},
            {shared.sculpture, [](auto& to, auto& row) { to.ready(row.sculpture); }},
            {shared.material, [](auto& to, auto& row) { to.ready(row.material); }},
        }};
    layout.add<JoinedRow>(time_columns());
    layout.add<SampleCells>({
        {{"tracker_time_us", "When the sample was taken, by the tracker's own clock", "us", {}},
         [](auto& to, auto& row) { to.integer(row.sample.sampled_at.time_since_epoch().count()); }},
        {{"eye", "Which eye", "", {{"left", "left eye"}, {"right", "right eye"}}},
         [](auto& to, auto& row) { to.word(row.sample.eye == Eye::left ? "left" : "right"); }},
        {{"x_px", "Gaze on the screen, to the right", "px", {}},
         [](auto& to, auto& row) { write_gaze_x(to, row.sample); }},
        {{"y_px", "Gaze on the screen, downwards", "px", {}},
         [](auto& to, auto& row) { write_gaze_y(to, row.sample); }},
        {{"pupil_area", "Pupil area", "the tracker's own unit", {}},
         [](auto& to, auto& row) { write_pupil(to, row.sample); }},
    });
    layout.add<JoinedRow>(place_columns(header));
    if (!cone_accuracy)
        return layout;
    const Degrees accuracy = *cone_accuracy;
    layout.add<SampleCells>({
        {{"p_object",
          fmt::format(
              "Probability that the gaze was on the sculpture, taking the tracker to be {} degrees off "
              "on average, normally distributed to all sides; n/a as in silhouette_distance_deg",
              accuracy.value),
          "",
          {}},
         [](auto& to, auto& row) {
             row.shares && !row.shares->of_part.empty()
                 ? to.fixed(row.shares->of_object, probability_decimals)
                 : to.missing();
         }},
    });
    for (const std::string& part : all_part_names(header))
        layout.add<SampleCells>({
            {{"p_" + part,
              fmt::format(
                  "The same for the part \"{}\"; n/a, too, if the sculpture has no such part. All parts "
                  "together make p_object",
                  part),
              "",
              {}},
             [part](auto& to, auto& row) {
                 const auto own = std::find(row.own_parts.begin(), row.own_parts.end(), part);
                 row.shares && !row.shares->of_part.empty() && own != row.own_parts.end()
                     ? to.fixed(row.shares->of_part[static_cast<std::size_t>(own - row.own_parts.begin())],
                                probability_decimals)
                     : to.missing();
             }},
        });
    return layout;
}

SampleRows::SampleRows(TableWriter& writer, const RowLayout<SampleCells>& layout, const SessionRecord& record,
                       std::optional<Degrees> cone_accuracy)
    : row_(writer), layout_(layout), record_(record), header_(record.header()) {
    if (cone_accuracy)
        cone_.emplace(header_.display.screen, *cone_accuracy);
}

SampleCounts SampleRows::write(const TrialRecord& trial, const std::optional<TrialLedger>& ledger,
                               const SurfaceLookup* lookup) {
    const SampleJoin join(record_, trial, ledger, lookup);
    counts_ = {};
    record_.read_samples(trial, samples_at_a_time, [&](std::span<const GazeSample> samples) {
        write_piece(samples, trial, join, lookup);
    });
    return counts_;
}

void SampleRows::write_piece(std::span<const GazeSample> samples, const TrialRecord& trial,
                             const SampleJoin& join, const SurfaceLookup* lookup) {
    const Condition condition = trial.trial.condition;
    const TableFormat format = row_.format();
    const std::string task = text_cell(item(header_.tasks, trial.trial.task).id, format);
    const std::string sculpture = text_cell(item(header_.sculptures, condition.sculpture).id, format);
    const std::string material = text_cell(item(header_.materials, condition.material).id, format);
    const std::vector<std::string> parts = part_cells_of(header_, condition.sculpture, format);
    const std::vector<std::string>& own_parts = item(header_.sculptures, condition.sculpture).part_names;
    joined_.resize(samples.size());
    join.join(samples, joined_);
    std::vector<GazeCone::Shares> shares;
    if (cone_ && lookup)
        shares = cone_shares(*lookup, samples, own_parts.size());

    for (std::size_t i = 0; i < samples.size(); ++i) {
        layout_.write(row_, {{samples[i], joined_[i], parts},
                             trial.trial.index + 1,
                             task,
                             sculpture,
                             material,
                             own_parts,
                             shares.empty() ? nullptr : &shares[i]});
        counts_.without_gaze += !samples[i].gaze;
        counts_.on_object += joined_[i].sight.surface.has_value();
        counts_.off_plan += joined_[i].off_plan;
    }
    counts_.samples += static_cast<std::int64_t>(samples.size());
}

/// Of each sample that fell on a lit frame; the others' shares are empty.
std::vector<GazeCone::Shares> SampleRows::cone_shares(const SurfaceLookup& lookup,
                                                      std::span<const GazeSample> samples,
                                                      std::size_t parts) const {
    std::vector<GazeCone::Shares> shares(samples.size());
    constexpr std::size_t batch = 256;
    parallel_for(static_cast<int>((samples.size() + batch - 1) / batch), [&](int index) {
        const std::size_t begin = static_cast<std::size_t>(index) * batch;
        for (std::size_t i = begin; i < std::min(begin + batch, samples.size()); ++i) {
            if (joined_[i].shown)
                shares[i] = cone_->shares(lookup, joined_[i].shown->pose, *samples[i].gaze, parts);
        }
    });
    return shares;
}

} // namespace overt
