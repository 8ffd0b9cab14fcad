#include "experiment/watch/session_view.h"

#include <algorithm>
#include <utility>

#include <nlohmann/json.hpp>

#include "experiment/base/base64.h"

namespace overt {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t longest_word = 400;

std::string bounded(const std::string& text) {
    if (text.size() <= longest_word)
        return text;
    std::size_t end = longest_word;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0u) == 0x80u)
        --end;
    return text.substr(0, end) + "…";
}

std::string line_of_json(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Json or_null(const std::optional<double>& number) { return number ? Json(*number) : Json(nullptr); }

/// The member of a line, if it is there and of the kind that is asked for; else the value stays.
template <class T> void take(const Json& from, const char* name, T& into) {
    const auto found = from.find(name);
    if (found == from.end() || found->is_null())
        return;
    if constexpr (std::is_same_v<T, bool>) {
        if (found->is_boolean())
            into = found->template get<bool>();
    } else if constexpr (std::is_integral_v<T>) {
        if (found->is_number_integer() && std::in_range<T>(found->template get<std::int64_t>()))
            into = found->template get<T>();
    } else if constexpr (std::is_floating_point_v<T>) {
        if (found->is_number())
            into = found->template get<T>();
    } else if constexpr (std::is_same_v<T, std::string>) {
        if (found->is_string())
            into = found->template get<std::string>();
    } else if constexpr (std::is_same_v<T, std::optional<double>>) {
        if (found->is_number())
            into = found->template get<double>();
    } else {
        if (found->is_array())
            for (const Json& word : *found)
                if (word.is_string())
                    into.push_back(word.template get<std::string>());
    }
}

SessionFacts read_facts(const Json& json) {
    SessionFacts facts;
    take(json, "protocol", facts.protocol);
    take(json, "observer", facts.observer);
    take(json, "folder", facts.folder);
    take(json, "trials", facts.trials);
    take(json, "refresh_hz", facts.refresh_hz);
    take(json, "width_px", facts.width_px);
    take(json, "height_px", facts.height_px);
    take(json, "image_width_px", facts.image_width_px);
    take(json, "image_height_px", facts.image_height_px);
    take(json, "poses", facts.poses);
    take(json, "has_tracker", facts.has_tracker);
    take(json, "is_timing_unproven", facts.is_timing_unproven);
    take(json, "drift_limit_deg", facts.drift_limit_deg);
    take(json, "mean_limit_deg", facts.mean_limit_deg);
    take(json, "max_limit_deg", facts.max_limit_deg);
    take(json, "skip_reasons", facts.skip_reasons);
    take(json, "clock_zero_s", facts.clock_zero_s);
    return facts;
}

/// A point is [eye, trial, pose, at_s, sampled_us], and then [x, y] unless the eye was lost.
std::vector<ViewedGaze> read_gaze(const Json& points) {
    std::vector<ViewedGaze> gaze;
    for (const Json& point : points) {
        const bool is_point =
            point.is_array() && (point.size() == 5 || point.size() == 7) && point[0].is_string() &&
            std::all_of(point.begin() + 1, point.end(), [](const Json& part) { return part.is_number(); }) &&
            point[1].is_number_integer() && point[2].is_number_integer() && point[4].is_number_integer();
        if (!is_point || gaze.size() == longest_gaze)
            continue;
        ViewedGaze one{point[0] == "right",    {},
                       point[1].get<int>(),    point[2].get<int>(),
                       point[3].get<double>(), point[4].get<std::int64_t>()};
        if (point.size() == 7)
            one.place = ScreenPoint{point[5].get<double>(), point[6].get<double>()};
        gaze.push_back(one);
    }
    return gaze;
}

std::optional<ViewedCamera> read_camera(const Json& json) {
    ViewedCamera camera;
    std::string rgb;
    take(json, "width_px", camera.width_px);
    take(json, "height_px", camera.height_px);
    take(json, "title", camera.title);
    take(json, "rgb", rgb);
    if (camera.width_px < 1 || camera.width_px > ViewedCamera::most_width_px || camera.height_px < 1 ||
        camera.height_px > ViewedCamera::most_height_px)
        return std::nullopt;
    std::optional<std::vector<std::byte>> bytes = bytes_of_base64(rgb);
    if (!bytes || bytes->size() != 3 * static_cast<std::size_t>(camera.width_px) *
                                       static_cast<std::size_t>(camera.height_px))
        return std::nullopt;
    camera.rgb = std::move(*bytes);
    return camera;
}

SessionView read_view(const Json& json) {
    SessionView view;
    take(json, "time_s", view.time_s);
    take(json, "phase", view.phase);
    take(json, "trial", view.trial);
    take(json, "task", view.task);
    take(json, "question", view.question);
    take(json, "sculpture", view.sculpture);
    take(json, "material", view.material);
    take(json, "light_file", view.light_file);
    take(json, "done", view.done);
    take(json, "failed", view.failed);
    take(json, "first_trial_s", view.first_trial_s);
    take(json, "done_before", view.done_before);
    take(json, "pose", view.pose);
    take(json, "refresh", view.refresh);
    take(json, "missed", view.missed);
    take(json, "missed_in_trial", view.missed_in_trial);
    take(json, "samples", view.samples);
    take(json, "lost", view.lost);
    take(json, "samples_in_trial", view.samples_in_trial);
    take(json, "lost_in_trial", view.lost_in_trial);
    take(json, "validation_mean_deg", view.validation_mean_deg);
    take(json, "validation_max_deg", view.validation_max_deg);
    take(json, "drift_deg", view.drift_deg);
    take(json, "tracker_is_lost", view.tracker_is_lost);
    take(json, "asks", view.asks);
    take(json, "level_rms", view.level_rms);
    take(json, "level_peak", view.level_peak);
    take(json, "is_clipping", view.is_clipping);
    take(json, "answer", view.answer);
    take(json, "dropped", view.dropped);
    take(json, "is_over", view.is_over);
    return view;
}

} // namespace

std::string line_of(const SessionFacts& facts) {
    std::vector<std::string> reasons;
    for (const std::string& reason : facts.skip_reasons)
        reasons.push_back(bounded(reason));
    return line_of_json({{"overt_watch", view_version},
                         {"protocol", bounded(facts.protocol)},
                         {"observer", bounded(facts.observer)},
                         {"folder", facts.folder},
                         {"trials", facts.trials},
                         {"refresh_hz", facts.refresh_hz},
                         {"width_px", facts.width_px},
                         {"height_px", facts.height_px},
                         {"image_width_px", facts.image_width_px},
                         {"image_height_px", facts.image_height_px},
                         {"poses", facts.poses},
                         {"has_tracker", facts.has_tracker},
                         {"is_timing_unproven", facts.is_timing_unproven},
                         {"drift_limit_deg", facts.drift_limit_deg},
                         {"mean_limit_deg", facts.mean_limit_deg},
                         {"max_limit_deg", facts.max_limit_deg},
                         {"skip_reasons", reasons},
                         {"clock_zero_s", or_null(facts.clock_zero_s)}});
}

std::string line_of(const SessionView& view) {
    return line_of_json({{"state",
                          {{"time_s", view.time_s},
                           {"phase", view.phase},
                           {"trial", view.trial},
                           {"task", bounded(view.task)},
                           {"question", bounded(view.question)},
                           {"sculpture", bounded(view.sculpture)},
                           {"material", bounded(view.material)},
                           {"light_file", view.light_file},
                           {"done", view.done},
                           {"failed", view.failed},
                           {"first_trial_s", or_null(view.first_trial_s)},
                           {"done_before", view.done_before},
                           {"pose", view.pose},
                           {"refresh", view.refresh},
                           {"missed", view.missed},
                           {"missed_in_trial", view.missed_in_trial},
                           {"samples", view.samples},
                           {"lost", view.lost},
                           {"samples_in_trial", view.samples_in_trial},
                           {"lost_in_trial", view.lost_in_trial},
                           {"validation_mean_deg", or_null(view.validation_mean_deg)},
                           {"validation_max_deg", or_null(view.validation_max_deg)},
                           {"drift_deg", or_null(view.drift_deg)},
                           {"tracker_is_lost", view.tracker_is_lost},
                           {"asks", bounded(view.asks)},
                           {"level_rms", or_null(view.level_rms)},
                           {"level_peak", or_null(view.level_peak)},
                           {"is_clipping", view.is_clipping},
                           {"answer", bounded(view.answer)},
                           {"dropped", view.dropped},
                           {"is_over", view.is_over}}}});
}

std::string line_of(const ViewedEvent& event) {
    return line_of_json({{"event",
                          {{"at_s", event.at_s},
                           {"trial", event.trial},
                           {"kind", bounded(event.kind)},
                           {"detail", bounded(event.detail)}}}});
}

std::string line_of(std::span<const ViewedGaze> gaze) {
    Json points = Json::array();
    for (const ViewedGaze& one : gaze.last(std::min(gaze.size(), longest_gaze))) {
        Json point =
            Json::array({one.is_right ? "right" : "left", one.trial, one.pose, one.at_s, one.sampled_us});
        if (one.place) {
            point.push_back(one.place->x_px);
            point.push_back(one.place->y_px);
        }
        points.push_back(std::move(point));
    }
    return line_of_json({{"gaze", std::move(points)}});
}

std::string line_of(const ViewedCamera& camera) {
    return line_of_json({{"camera",
                          {{"width_px", camera.width_px},
                           {"height_px", camera.height_px},
                           {"title", bounded(camera.title)},
                           {"rgb", base64_of(camera.rgb)}}}});
}

ViewLine read_view_line(std::string_view line) {
    ViewLine read;
    const Json json = Json::parse(line, nullptr, false);
    if (!json.is_object())
        return read;
    if (json.contains("overt_watch")) {
        take(json, "overt_watch", read.version);
        if (read.version == view_version)
            read.facts = read_facts(json);
    } else if (const auto state = json.find("state"); state != json.end() && state->is_object()) {
        read.view = read_view(*state);
    } else if (const auto event = json.find("event"); event != json.end() && event->is_object()) {
        read.event.emplace();
        take(*event, "at_s", read.event->at_s);
        take(*event, "trial", read.event->trial);
        take(*event, "kind", read.event->kind);
        take(*event, "detail", read.event->detail);
    } else if (const auto gaze = json.find("gaze"); gaze != json.end() && gaze->is_array()) {
        read.gaze = read_gaze(*gaze);
    } else if (const auto camera = json.find("camera"); camera != json.end() && camera->is_object()) {
        read.camera = read_camera(*camera);
    }
    return read;
}

std::optional<double> time_left_s(const SessionFacts& facts, const SessionView& view) {
    const int done_now = view.done - view.done_before;
    if (!view.first_trial_s || done_now <= 0)
        return std::nullopt;
    const double per_trial_s = (view.time_s - *view.first_trial_s) / done_now;
    return per_trial_s * std::max(0, facts.trials - view.done);
}

std::optional<double> lost_share(std::int64_t samples, std::int64_t lost) {
    if (samples <= 0)
        return std::nullopt;
    return static_cast<double>(lost) / static_cast<double>(samples);
}

} // namespace overt
