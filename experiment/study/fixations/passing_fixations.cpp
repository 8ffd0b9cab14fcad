#include "experiment/study/fixations/passing_fixations.h"

#include <algorithm>

namespace overt {

PassingFixations::PassingFixations(const FixationContext& context, std::span<const GazeEvent> events,
                                   Eye unnamed, Degrees reach)
    : context_(context), events_(events), reach_(reach), found_(events.size()) {
    for (std::size_t i = 0; i < events.size(); ++i)
        if (events[i].kind == GazeEvent::Kind::fixation)
            eyes_[static_cast<std::size_t>(events[i].eye.value_or(unnamed))].events.push_back(i);
    for (OfEye& eye : eyes_) {
        eye.lookup = context.lookup;
        std::stable_sort(eye.events.begin(), eye.events.end(),
                         [&](std::size_t a, std::size_t b) { return events[a].start < events[b].start; });
    }
}

PlacedSample PassingFixations::place(const GazeSample& sample, const JoinedSample& joined) const {
    return placed_sample(sample, joined, eyes_[static_cast<std::size_t>(sample.eye)].lookup, context_.onset,
                         reach_);
}

void PassingFixations::take(Eye of, const PlacedSample& sample) {
    OfEye& eye = eyes_[static_cast<std::size_t>(of)];
    while (eye.next < eye.events.size() && events_[eye.events[eye.next]].end < sample.sampled_at)
        settle(eye);
    if (eye.next < eye.events.size() && events_[eye.events[eye.next]].start <= sample.sampled_at)
        eye.samples.push_back(sample);
}

std::vector<std::optional<StudyFixation>> PassingFixations::finish() {
    for (OfEye& eye : eyes_)
        while (eye.next < eye.events.size())
            settle(eye);
    return std::move(found_);
}

void PassingFixations::settle(OfEye& eye) {
    FixationContext context = context_;
    context.samples = eye.samples;
    context.lookup = eye.lookup;
    const std::size_t event = eye.events[eye.next++];
    found_[event] = surface_fixation(events_[event], context);
    const auto from =
        eye.next < eye.events.size()
            ? std::partition_point(eye.samples.begin(), eye.samples.end(),
                                   [&](const PlacedSample& sample) {
                                       return sample.sampled_at < events_[eye.events[eye.next]].start;
                                   })
            : eye.samples.end();
    eye.samples.erase(eye.samples.begin(), from);
}

} // namespace overt
