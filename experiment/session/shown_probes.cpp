#include "experiment/session/shown_probes.h"

#include <algorithm>

#include "experiment/answers/answer_kinds.h"
#include "experiment/design/answer_forms.h"
#include "experiment/design/probe_marks.h"
#include "experiment/factors.h"
#include "experiment/session/session_ports.h"

namespace overt {

ShownProbes::ShownProbes(const Protocol& protocol, const SessionPorts& ports)
    : protocol_(protocol), ports_(ports), px_per_deg_(screen_geometry_of(protocol).px_per_deg_at_centre()) {}

void ShownProbes::begin_trial(const Trial& trial) {
    probes_.clear();
    gauges_.clear();
    const Task& task = protocol_.tasks[static_cast<std::size_t>(trial.task)];
    for (const ProbeSettings& settings : task.probes) {
        const std::string_view point = own_level(trial, settings.id);
        if (point.empty() || !ports_.probe_of)
            continue;
        for (int place = 0; place < static_cast<int>(trial.shown_count()); ++place) {
            const PlacedStimulus placed = trial.shown(static_cast<std::size_t>(place));
            const std::string& slot = protocol_.slots[static_cast<std::size_t>(placed.slot)].id;
            if (!settings.slot.empty() && slot != settings.slot)
                continue;
            if (auto view = ports_.probe_of(placed, std::string(point)))
                probes_.push_back({.settings = &settings,
                                   .point = std::string(point),
                                   .place = place,
                                   .view = std::move(view),
                                   .mark = probe_mark(settings, px_per_deg_)});
            break;
        }
    }
    for (const TaskAnswer& answer : task.answers)
        if (row_of(answer.kind).has_key("probe"))
            if (const ProbeSettings* const probe = probe_of(task, answer))
                for (std::size_t i = 0; i < probes_.size(); ++i)
                    if (probes_[i].settings == probe)
                        gauges_.push_back({.answer = answer.id, .probe = i});
}

void ShownProbes::see(Probe& probe, std::span<const AnimationFrameIndex> frames) const noexcept {
    const auto place = static_cast<std::size_t>(probe.place);
    probe.frame = place < frames.size() ? frames[place] : AnimationFrameIndex{-1};
    if (probe.frame.value >= 0)
        probe.seen = probe.view->seen_in(probe.frame);
}

void ShownProbes::begin_show(const PlannedStep& step, int number, std::span<const AnimationFrameIndex> first,
                             std::vector<ShownProbe>& rows) {
    for (Probe& probe : probes_) {
        probe.row = -1;
        see(probe, first);
        const std::vector<std::string>* const named =
            step.settings && step.settings->probes ? &*step.settings->probes : nullptr;
        const bool is_named = !named || std::ranges::find(*named, probe.settings->id) != named->end();
        const bool is_lit = std::ranges::find(step.places, probe.place) != step.places.end();
        if (!is_named || !is_lit)
            continue;
        probe.row = static_cast<int>(rows.size());
        rows.push_back(
            {.step = number, .id = probe.settings->id, .point = probe.point, .place = probe.place});
    }
    // Those of the show before go; lights that come are made known.
    mark_count_ = 0;
    for (const Probe& probe : probes_)
        if (mark_count_ < marks_.size()) {
            marks_[mark_count_] = probe.mark;
            marks_[mark_count_++].count = 0;
        }
    others_ = marks_;
    if (mark_count_ > 0 || has_marked_)
        show_marks();
    has_marked_ = mark_count_ > 0;
}

void ShownProbes::add_gauge(const Answering& gauge) noexcept {
    const std::optional<Attitude> attitude = gauge.attitude();
    for (SetGauge& set : gauges_) {
        if (set.answer != gauge.settings().id || !attitude)
            continue;
        const Probe& probe = probes_[set.probe];
        set.seen = probe.seen;
        set.frame = probe.frame;
        set.is_known = probe.frame.value >= 0;
        if (!set.is_known || !probe.seen.is_visible || mark_count_ == marks_.size())
            continue;
        const auto seen_by = [&](bool of_other_eye) {
            StimulusMark mark =
                gauge_mark(*probe.view, probe.seen, *attitude, gauge.settings().size_deg * px_per_deg_,
                           probe.settings->line_deg * px_per_deg_, of_other_eye);
            mark.light = probe.mark.light;
            mark.rim_px = probe.mark.rim_px;
            return mark;
        };
        add_mark(seen_by(false), protocol_.stereo.is_on() ? seen_by(true) : StimulusMark());
    }
}

void ShownProbes::add_mark(const StimulusMark& mark, const StimulusMark& of_other_eye) noexcept {
    marks_[mark_count_] = mark;
    others_[mark_count_++] = of_other_eye;
}

void ShownProbes::show_marks() const noexcept {
    ports_.presenter.mark_stimuli({marks_.data(), mark_count_},
                                  {others_.data(), protocol_.stereo.is_on() ? mark_count_ : 0});
}

void ShownProbes::before_flip(std::span<const AnimationFrameIndex> frames, const Answering* gauge,
                              std::vector<ShownProbe>& rows) noexcept {
    if (probes_.empty())
        return;
    mark_count_ = 0;
    for (Probe& probe : probes_) {
        see(probe, frames);
        if (probe.row < 0 || probe.frame.value < 0)
            continue;
        const ScreenPoint at = probe.view->on_screen(probe.seen.position);
        ShownProbe& row = rows[static_cast<std::size_t>(probe.row)];
        if (row.shown_refreshes++ == 0) {
            row.was_visible = probe.seen.is_visible;
            row.at = at;
            row.truth = probe.seen.attitude();
        }
        if (!probe.seen.is_visible)
            continue;
        ++row.visible_refreshes;
        if (probe.mark.count == 0 || mark_count_ == marks_.size())
            continue;
        add_mark(moved_to(probe.mark, at),
                 moved_to(probe.mark, probe.view->in_other_eye(probe.seen.position)));
    }
    if (gauge)
        add_gauge(*gauge);
    has_marked_ = true;
    show_marks();
}

const ShownProbes::Probe* ShownProbes::find(std::string_view id) const noexcept {
    const auto found =
        std::ranges::find_if(probes_, [&](const Probe& probe) { return probe.settings->id == id; });
    return found == probes_.end() ? nullptr : &*found;
}

std::optional<Attitude> ShownProbes::truth_at(std::string_view probe) const noexcept {
    const Probe* const at = find(probe);
    return at && at->frame.value >= 0 ? std::optional(at->seen.attitude()) : std::nullopt;
}

void ShownProbes::complete(std::vector<GivenAnswer>& given) const {
    for (GivenAnswer& answer : given) {
        const auto set = std::ranges::find(gauges_, answer.id, &SetGauge::answer);
        if (!answer.gauge || set == gauges_.end() || !set->is_known)
            continue;
        answer.gauge->truth = set->seen.attitude();
        answer.gauge->frame = set->frame.value;
        answer.gauge->is_visible = set->seen.is_visible;
    }
}

} // namespace overt
