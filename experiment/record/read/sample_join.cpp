#include "experiment/record/read/sample_join.h"

#include <algorithm>
#include <array>
#include <utility>

#include "experiment/base/error.h"

namespace overt {

namespace {

/// Samples whose places are looked up together: enough to keep the memory busy, few enough for the stack.
constexpr std::size_t batch = 256;

} // namespace

SampleJoin::SampleJoin(const SessionRecord& record, const TrialRecord& trial, const LookupsOfEyes& lookups)
    : SampleJoin(record, trial, record.ledger(trial), lookups) {}

SampleJoin::SampleJoin(const SessionRecord& record, const TrialRecord& trial,
                       const std::optional<TrialLedger>& ledger, const LookupsOfEyes& lookups)
    : SampleJoin(record.header().screen_of_slot(trial.trial.slot), record.clock_map(trial),
                 record.flip_history(trial, ledger), lookups, !trial.trial.beside.empty()) {}

SampleJoin::SampleJoin(const ScreenGeometry& screen, std::optional<ClockMap> clock_map, FlipHistory history,
                       const LookupsOfEyes& lookups, bool has_other_slots)
    : screen_(screen), clock_map_(std::move(clock_map)), flip_history_(std::move(history)), lookups_(lookups),
      has_other_slots_(has_other_slots) {}

// Into `joined` field by field: it is large, and copying it would take longer than all of this.
void SampleJoin::join_time_and_frame(const GazeSample& sample, JoinedSample& joined) const {
    joined.at.reset();
    joined.image_px.reset();
    joined.shown.reset();
    joined.sight.surface.reset();
    joined.sight.outline_px.reset();
    joined.outline_distance.reset();
    joined.off_plan = false;
    joined.is_elsewhere = false;
    if (clock_map_)
        joined.at.emplace(clock_map_->to_session(sample.sampled_at));
    if (!sample.gaze)
        return;
    joined.image_px.emplace(screen_.image_from_screen(*sample.gaze));
    if (has_other_slots_ && !screen_.is_inside_image(*joined.image_px)) {
        joined.is_elsewhere = true;
        return;
    }
    if (!joined.at)
        return;
    const Lighting lighting = flip_history_.lighting_at(joined.at->time, sample.gaze->y_px);
    if (lighting.shown)
        joined.shown.emplace(*lighting.shown);
    joined.off_plan = lighting.off_plan;
}

void SampleJoin::join_surfaces(std::span<const GazeSample> samples, std::span<JoinedSample> joined,
                               Eye eye) const {
    std::array<ImagePlace, batch> places;
    std::array<Sight*, batch> sights;
    std::array<std::size_t, batch> sample_of;
    std::size_t count = 0;
    for (std::size_t i = 0; i < joined.size(); ++i) {
        if (!joined[i].shown || samples[i].eye != eye)
            continue;
        sights[count] = &joined[i].sight;
        places[count] = {joined[i].shown->pose, *joined[i].image_px};
        sample_of[count++] = i;
    }
    lookups_.of(eye)->look(std::span(places).first(count), std::span(sights).first(count));
    for (std::size_t k = 0; k < count; ++k) {
        JoinedSample& sample = joined[sample_of[k]];
        if (sample.sight.outline_px) {
            const Degrees angle = screen_.angle_between(*samples[sample_of[k]].gaze,
                                                        screen_.screen_from_image(*sample.sight.outline_px));
            sample.outline_distance = Degrees{sample.sight.surface ? -angle.value : angle.value};
        }
    }
}

void SampleJoin::join(std::span<const GazeSample> samples, std::span<JoinedSample> joined) const {
    OVERT_EXPECTS(samples.size() == joined.size());
    for (std::size_t begin = 0; begin < samples.size(); begin += batch) {
        const auto of_batch = samples.subspan(begin, std::min(batch, samples.size() - begin));
        const auto into = joined.subspan(begin, of_batch.size());
        for (std::size_t i = 0; i < of_batch.size(); ++i)
            join_time_and_frame(of_batch[i], into[i]);
        for (const Eye eye : {Eye::left, Eye::right})
            if (lookups_.of(eye))
                join_surfaces(of_batch, into, eye);
    }
}

JoinedSample SampleJoin::join(const GazeSample& sample) const {
    JoinedSample joined;
    join(std::span(&sample, 1), std::span(&joined, 1));
    return joined;
}

} // namespace overt
