#include "experiment/record/tables/sample_rows.h"

#include <algorithm>

#include "experiment/base/number_text.h"
#include "experiment/base/parallel.h"

namespace overt {
namespace {

constexpr int probability_decimals = 4;

const auto& item(const auto& list, int index) { return list[static_cast<std::size_t>(index)]; }

} // namespace

SampleRows::SampleRows(TableWriter& writer, const SessionRecord& record, const ExportTables& tables,
                       std::optional<Degrees> cone_accuracy)
    : row_(writer), record_(record), header_(record.header()), tables_(tables) {
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
    const PreparedCells trial_cells = prepare_cells({item(header_.tasks, trial.trial.task).id,
                                                     item(header_.sculptures, condition.sculpture).id,
                                                     item(header_.materials, condition.material).id},
                                                    row_.format());
    const JoinedCells cells(header_, condition.sculpture, row_.format());
    joined_.resize(samples.size());
    join.join(samples, joined_);
    std::vector<GazeCone::Shares> shares;
    if (cone_ && lookup)
        shares =
            cone_shares(*lookup, samples, item(header_.sculptures, condition.sculpture).part_names.size());

    for (std::size_t i = 0; i < samples.size(); ++i) {
        row_.integer(trial.trial.index + 1).prepared(trial_cells);
        cells.time(row_, joined_[i]);
        write_gaze(samples[i]);
        cells.place(row_, joined_[i]);
        if (cone_)
            write_cone(shares.empty() ? GazeCone::Shares{} : shares[i], condition.sculpture);
        row_.end_row();
        counts_.without_gaze += !samples[i].gaze;
        counts_.on_object += joined_[i].sight.surface.has_value();
        counts_.off_plan += joined_[i].off_plan;
    }
    counts_.samples += static_cast<std::int64_t>(samples.size());
}

void SampleRows::write_gaze(const GazeSample& sample) {
    row_.integer(sample.sampled_at.time_since_epoch().count());
    row_.word(sample.eye == Eye::left ? "left" : "right");
    if (sample.gaze)
        row_.fixed(sample.gaze->x_px, pixel_decimals).fixed(sample.gaze->y_px, pixel_decimals);
    else
        row_.missing(2);
    sample.pupil_area > 0.0f ? row_.fixed(shortest_decimal(sample.pupil_area), pupil_decimals)
                             : row_.missing();
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

void SampleRows::write_cone(const GazeCone::Shares& shares, int sculpture) {
    const std::vector<std::string>& own_parts = item(header_.sculptures, sculpture).part_names;
    if (shares.of_part.empty()) {
        row_.missing(1 + static_cast<int>(tables_.cone_parts.size()));
        return;
    }
    row_.fixed(shares.of_object, probability_decimals);
    for (const std::string& name : tables_.cone_parts) {
        const auto own = std::find(own_parts.begin(), own_parts.end(), name);
        own == own_parts.end() ? row_.missing()
                               : row_.fixed(shares.of_part[static_cast<std::size_t>(own - own_parts.begin())],
                                            probability_decimals);
    }
}

} // namespace overt
