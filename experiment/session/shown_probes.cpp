#include "experiment/session/shown_probes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiment/answers/answer_kinds.h"
#include "experiment/design/answer_forms.h"
#include "experiment/factors.h"
#include "experiment/session/session_ports.h"

namespace overt {

StimulusMark gauge_mark(const ProbeView& view, const SeenProbe& at, const Attitude& attitude,
                        double radius_px, double line_px) {
    // Of the length that has so many pixels in the depth of the place.
    const double radius = radius_px * -at.position.z / view.px_at_unit_depth;
    const glm::dvec3 normal = frame_of_sight(at.position) * normal_of(attitude);
    const glm::dvec3 aside = std::abs(normal.x) < 0.9 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
    const glm::dvec3 u = glm::normalize(glm::cross(normal, aside)), v = glm::cross(normal, u);
    StimulusMark mark;
    mark.count = 2;
    MarkLine& circle = mark.lines[0];
    circle.width_px = line_px;
    circle.count = MarkLine::most_points;
    for (std::size_t i = 0; i < circle.count; ++i) {
        const double turn =
            2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(circle.count - 1);
        circle.points[i] = view.on_screen(at.position + radius * (std::cos(turn) * u + std::sin(turn) * v));
    }
    MarkLine& rod = mark.lines[1];
    rod.width_px = line_px;
    rod.count = 2;
    rod.points[0] = view.on_screen(at.position);
    rod.points[1] = view.on_screen(at.position + radius * normal);
    return mark;
}

ShownProbes::ShownProbes(const Protocol& protocol, const SessionPorts& ports)
    : protocol_(protocol), ports_(ports), px_per_deg_(screen_geometry_of(protocol).px_per_deg_at_centre()) {}

StimulusMark ShownProbes::mark_of(const ProbeSettings& probe) const {
    StimulusMark mark;
    mark.light = probe.light;
    mark.rim_px = probe.rim_deg * px_per_deg_;
    if (probe.mark == ProbeMark::none)
        return mark;
    mark.count = 1;
    MarkLine& line = mark.lines[0];
    const double diameter = probe.size_deg * px_per_deg_;
    line.count = probe.mark == ProbeMark::dot ? 1 : MarkLine::most_points;
    line.width_px = probe.mark == ProbeMark::dot ? diameter : probe.line_deg * px_per_deg_;
    // About the place, to which it is moved.
    for (std::size_t i = 0; i < line.count && line.count > 1; ++i) {
        const double turn =
            2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(line.count - 1);
        line.points[i] = {0.5 * diameter * std::cos(turn), 0.5 * diameter * std::sin(turn)};
    }
    return mark;
}

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
                                   .mark = mark_of(settings)});
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
    if (mark_count_ > 0 || has_marked_)
        ports_.presenter.mark_stimuli({marks_.data(), mark_count_});
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
        StimulusMark& mark = marks_[mark_count_++];
        mark = gauge_mark(*probe.view, probe.seen, *attitude, gauge.settings().size_deg * px_per_deg_,
                          probe.settings->line_deg * px_per_deg_);
        mark.light = probe.mark.light;
        mark.rim_px = probe.mark.rim_px;
    }
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
        StimulusMark& mark = marks_[mark_count_++];
        mark = probe.mark;
        for (std::size_t i = 0; i < mark.lines[0].count; ++i) {
            mark.lines[0].points[i].x_px += at.x_px;
            mark.lines[0].points[i].y_px += at.y_px;
        }
    }
    if (gauge)
        add_gauge(*gauge);
    has_marked_ = true;
    ports_.presenter.mark_stimuli({marks_.data(), mark_count_});
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
