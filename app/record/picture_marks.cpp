#include "app/record/picture_marks.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "app/inputs/protocol_file.h"
#include "experiment/base/error.h"
#include "experiment/checks/checked_protocol.h"
#include "experiment/design/answer_forms.h"
#include "experiment/design/probe_marks.h"

namespace overt {

namespace {

/// An occluder that is nearer by no more than this share of the distance is the surface itself.
constexpr double same_depth = 1e-3;

double distance_to_segment(glm::dvec2 from, glm::dvec2 to, glm::dvec2 at) {
    const glm::dvec2 along = to - from;
    const double squared = glm::dot(along, along);
    const double share = squared > 0.0 ? std::clamp(glm::dot(at - from, along) / squared, 0.0, 1.0) : 0.0;
    return glm::distance(at, from + share * along);
}

double distance_to_line(const MarkLine& line, glm::dvec2 at) {
    const auto point = [&](std::size_t i) { return glm::dvec2(line.points[i].x_px, line.points[i].y_px); };
    double nearest = glm::distance(at, point(0));
    for (std::size_t i = 1; i < line.count; ++i)
        nearest = std::min(nearest, distance_to_segment(point(i - 1), point(i), at));
    return nearest;
}

void draw_line_of_mark(LinearImage& picture, const MarkLine& line, double reach_px, const glm::vec4& light) {
    if (line.count == 0)
        return;
    glm::dvec2 first(1e9), last(-1e9);
    for (std::size_t i = 0; i < line.count; ++i) {
        const glm::dvec2 point(line.points[i].x_px, line.points[i].y_px);
        first = glm::min(first, point);
        last = glm::max(last, point);
    }
    const glm::ivec2 begin = glm::max(glm::ivec2(glm::floor(first - reach_px)), glm::ivec2(0));
    const glm::ivec2 end = glm::min(glm::ivec2(glm::ceil(last + reach_px)) + 1, picture.size_px);
    for (int y = begin.y; y < end.y; ++y)
        for (int x = begin.x; x < end.x; ++x)
            if (distance_to_line(line, {x + 0.5, y + 0.5}) <= reach_px)
                picture.at(x, y) = light;
}

/// The camera of a picture; marks' places come in its pixels.
class PictureView final : public ProbeView {
  public:
    explicit PictureView(const View& view) {
        const glm::dvec2 ahead_px = view.straight_ahead_px();
        middle = {ahead_px.x, ahead_px.y};
        px_at_unit_depth = view.px_at_unit_depth();
    }
    SeenProbe seen_in(AnimationFrameIndex) const noexcept override { return {}; }

    /// Of an image point and its depth, in the camera's coordinates.
    SeenProbe seen_at(const glm::dvec3& seen) const {
        const double scale = seen.z / px_at_unit_depth;
        SeenProbe probe;
        probe.position = {(seen.x - middle.x_px) * scale, (middle.y_px - seen.y) * scale, -seen.z};
        probe.is_visible = true;
        return probe;
    }
};

std::optional<Protocol> protocol_of(const SessionRecord& record) {
    const SessionHeader& header = record.header();
    IncludedTexts included;
    for (const RecordedProtocol::Included& file : header.protocol.included)
        included[file.name] = file.text;
    Diagnostics diagnostics;
    std::optional<Protocol> protocol = read_protocol_text(header.protocol.text, "protocol.toml",
                                                          shipped_sculpture_names(), diagnostics, included);
    if (!protocol)
        throw InputError(
            fmt::format("{}: this version of the program cannot read the recorded protocol, which says what "
                        "the marks of probes look like:\n{}",
                        record.directory().string(), diagnostics.print()));
    return protocol;
}

} // namespace

void draw_mark(LinearImage& picture, const StimulusMark& mark) {
    const glm::vec4 light(mark.light[0], mark.light[1], mark.light[2], 1.0);
    for (const bool is_rim : {true, false}) {
        if (is_rim && !(mark.rim_px > 0.0))
            continue;
        for (std::size_t i = 0; i < mark.count; ++i)
            draw_line_of_mark(picture, mark.lines[i],
                              0.5 * mark.lines[i].width_px + (is_rim ? mark.rim_px : 0.0),
                              is_rim ? glm::vec4(0.0f, 0.0f, 0.0f, 1.0f) : light);
    }
}

PictureMarks::PictureMarks(const SessionRecord& record, const TrialRecord& seen, const SurfaceLookup* surface)
    : record_(&record), seen_(&seen), maps_(dynamic_cast<const CoordinateMaps*>(surface)) {
    const SessionHeader& header = record.header();
    if (!maps_ || std::ranges::none_of(seen.outcome.probes,
                                       [&](const ShownProbe& probe) { return probe.place == seen.place; }))
        return;
    protocol_ = protocol_of(record);
    const Task& task = protocol_->tasks.at(static_cast<std::size_t>(seen.trial.task));
    for (const ShownProbe& shown : seen.outcome.probes) {
        const auto settings = std::ranges::find(task.probes, shown.id, &ProbeSettings::id);
        const auto point = std::ranges::find_if(header.points, [&](const RecordedPoint& one) {
            return one.name == shown.point && one.object == seen.trial.stimulus.object;
        });
        if (shown.place == seen.place && settings != task.probes.end() && point != header.points.end())
            probes_.push_back({&*settings, &shown, point->position});
    }
    flips_ = record.flips(seen);
}

bool PictureMarks::is_visible(PoseIndex pose, const glm::dvec3& seen) const {
    if (!(seen.z > 0.0))
        return false;
    const std::optional<SurfacePoint> first = maps_->surface_at(pose, {seen.x, seen.y});
    return first && first->depth >= (1.0 - same_depth) * seen.z;
}

void PictureMarks::draw_gauges(LinearImage& picture, const Placed& probe, const glm::dvec3& seen,
                               std::optional<SessionTime> at) const {
    const SessionHeader& header = record_->header();
    const Task& task = protocol_->tasks.at(static_cast<std::size_t>(seen_->trial.task));
    const Stimulus stimulus = header.in_slot(seen_->trial.shown(0));
    const PictureView view(View{header.camera_of(stimulus), picture.size_px});
    const double px_per_deg = header.display.screen.px_per_deg_at_centre();
    for (const GivenAnswer& given : seen_->outcome.given) {
        const auto answer = std::ranges::find(task.answers, given.id, &TaskAnswer::id);
        if (!given.gauge || given.gauge->probe != probe.settings->id || answer == task.answers.end())
            continue;
        Attitude attitude = given.gauge->set;
        if (at) {
            const std::optional<SessionTime> opened =
                given.stimulus_onset ? given.stimulus_onset : given.window_onset;
            if (!opened || *at < *opened || (given.answered_at && *at > *given.answered_at))
                continue;
            attitude = given.gauge->start;
            for (const AnswerInput& input : seen_->outcome.inputs)
                if (input.id == given.id && input.attitude && input.input.at <= *at)
                    attitude = *input.attitude;
        }
        StimulusMark mark = gauge_mark(view, view.seen_at(seen), attitude, answer->size_deg * px_per_deg,
                                       probe.settings->line_deg * px_per_deg);
        mark.light = probe.settings->light;
        mark.rim_px = probe.settings->rim_deg * px_per_deg;
        draw_mark(picture, mark);
    }
}

void PictureMarks::draw(LinearImage& picture, AnimationFrameIndex frame, int step,
                        std::optional<SessionTime> at) const {
    const SessionHeader& header = record_->header();
    const PoseIndex pose = header.poses.pose_of(header.in_slot(seen_->trial.shown(0)).motion, frame);
    for (const bool are_gauges : {false, true}) // a session draws gauges over marks
        for (const Placed& probe : probes_) {
            const glm::dvec3 seen = maps_->sight_lines(pose).project(probe.position);
            if (probe.shown->step != step || !is_visible(pose, seen))
                continue;
            if (are_gauges)
                draw_gauges(picture, probe, seen, at);
            else
                draw_mark(picture,
                          moved_to(probe_mark(*probe.settings, header.display.screen.px_per_deg_at_centre()),
                                   {seen.x, seen.y}));
        }
}

void PictureMarks::draw_lit(LinearImage& picture, const LitFrame& lit) const {
    if (probes_.empty())
        return;
    // The flip that lit it, and the one before, after which inputs were looked at.
    const FlipRecord *flip = nullptr, *before = nullptr;
    for (const FlipRecord& one : flips_) {
        if (one.report.refresh.value > lit.refresh.value)
            break;
        before = flip;
        flip = &one;
    }
    if (flip)
        draw(picture, lit.frame, flip->step,
             before ? before->report.vertical_blank : flip->report.vertical_blank);
}

void PictureMarks::draw_set(LinearImage& picture, AnimationFrameIndex frame) const {
    if (!probes_.empty())
        draw(picture, frame, probes_.front().shown->step, std::nullopt);
}

} // namespace overt
