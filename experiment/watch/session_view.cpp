#include "experiment/watch/session_view.h"

#include <algorithm>
#include <utility>

#include <nlohmann/json.hpp>

#include "experiment/base/base64.h"

namespace overt {

namespace {

using Json = nlohmann::ordered_json;

/// Of texts that people read, and of ids and files.
constexpr std::size_t longest_word = 400, longest_name = 60;
/// So many entries of a list are written.
constexpr std::size_t most_entries = 64;

std::string bounded(const std::string& text, std::size_t longest = longest_word) {
    if (text.size() <= longest)
        return text;
    std::size_t end = longest;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0u) == 0x80u)
        --end;
    return text.substr(0, end) + "…";
}

std::string line_of_json(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

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

// The members of a list's entries, once for writing and reading.
template <class Members, class Slot>
requires std::is_same_v<std::remove_const_t<Slot>, ViewedSlot>
void entry_members(Members& members, Slot& slot) {
    members.name("id", slot.id);
    members.value("left_px", slot.left_px);
    members.value("top_px", slot.top_px);
    members.value("width_px", slot.width_px);
    members.value("height_px", slot.height_px);
}
template <class Members, class Shown>
requires std::is_same_v<std::remove_const_t<Shown>, ViewedStimulus>
void entry_members(Members& members, Shown& shown) {
    members.value("slot", shown.slot);
    members.name("object", shown.object);
    members.name("material", shown.material);
    members.name("light_file", shown.light_file);
    members.value("seen_in", shown.seen_in);
    members.value("pictures", shown.pictures);
    members.value("pose", shown.pose);
    members.value("picture", shown.picture);
}

/// Puts the members of a line's object; words are cut to a length.
struct MemberWriter {
    Json json = Json::object();
    template <class T> void value(const char* name, const T& of) { json[name] = of; }
    void value(const char* name, const std::optional<double>& of) {
        json[name] = of ? Json(*of) : Json(nullptr);
    }
    void words(const char* name, const std::string& of) { json[name] = bounded(of); }
    void name(const char* name, const std::string& of) { json[name] = bounded(of, longest_name); }
    template <class Entry> void entries(const char* name, const std::vector<Entry>& of) {
        json[name] = Json::array();
        for (std::size_t i = 0; i < std::min(of.size(), most_entries); ++i) {
            MemberWriter entry;
            entry_members(entry, of[i]);
            json[name].push_back(std::move(entry.json));
        }
    }
    void words(const char* name, const std::vector<std::string>& of) {
        json[name] = Json::array();
        for (const std::string& one : of)
            json[name].push_back(bounded(one));
    }
};

struct MemberReader {
    const Json& json;
    template <class T> void value(const char* name, T& into) { take(json, name, into); }
    template <class T> void words(const char* name, T& into) { take(json, name, into); }
    void name(const char* name, std::string& into) { take(json, name, into); }
    template <class Entry> void entries(const char* name, std::vector<Entry>& into) {
        const auto found = json.find(name);
        if (found == json.end() || !found->is_array())
            return;
        for (const Json& one : *found)
            if (one.is_object() && into.size() < most_entries) {
                MemberReader reader{one};
                entry_members(reader, into.emplace_back());
            }
    }
};

// The members of each object, once for writing and reading.
template <class Members, class Facts> void facts_members(Members& members, Facts& facts) {
    members.words("protocol", facts.protocol);
    members.words("observer", facts.observer);
    members.value("folder", facts.folder);
    members.value("trials", facts.trials);
    members.value("refresh_hz", facts.refresh_hz);
    members.value("width_px", facts.width_px);
    members.value("height_px", facts.height_px);
    members.entries("slots", facts.slots);
    members.value("poses", facts.poses);
    members.value("has_tracker", facts.has_tracker);
    members.value("is_timing_unproven", facts.is_timing_unproven);
    members.value("drift_limit_deg", facts.drift_limit_deg);
    members.value("mean_limit_deg", facts.mean_limit_deg);
    members.value("max_limit_deg", facts.max_limit_deg);
    members.words("skip_reasons", facts.skip_reasons);
    members.value("clock_zero_s", facts.clock_zero_s);
}

template <class Members, class View> void view_members(Members& members, View& view) {
    members.value("time_s", view.time_s);
    members.value("phase", view.phase);
    members.value("trial", view.trial);
    members.words("task", view.task);
    members.words("question", view.question);
    members.entries("shown", view.shown);
    members.value("done", view.done);
    members.value("failed", view.failed);
    members.value("first_trial_s", view.first_trial_s);
    members.value("done_before", view.done_before);
    members.value("refresh", view.refresh);
    members.value("missed", view.missed);
    members.value("missed_in_trial", view.missed_in_trial);
    members.value("samples", view.samples);
    members.value("lost", view.lost);
    members.value("samples_in_trial", view.samples_in_trial);
    members.value("lost_in_trial", view.lost_in_trial);
    members.value("validation_mean_deg", view.validation_mean_deg);
    members.value("validation_max_deg", view.validation_max_deg);
    members.value("drift_deg", view.drift_deg);
    members.value("tracker_is_lost", view.tracker_is_lost);
    members.words("asks", view.asks);
    members.value("level_rms", view.level_rms);
    members.value("level_peak", view.level_peak);
    members.value("is_clipping", view.is_clipping);
    members.words("answer", view.answer);
    members.value("dropped", view.dropped);
    members.value("is_over", view.is_over);
}

template <class Members, class Event> void event_members(Members& members, Event& event) {
    members.value("at_s", event.at_s);
    members.value("trial", event.trial);
    members.words("kind", event.kind);
    members.words("detail", event.detail);
}

/// A point is [eye, trial, shown, pose, at_s, sampled_us], and then [x, y] unless the eye was lost.
std::vector<ViewedGaze> read_gaze(const Json& points) {
    std::vector<ViewedGaze> gaze;
    for (const Json& point : points) {
        const bool is_point =
            point.is_array() && (point.size() == 6 || point.size() == 8) && point[0].is_string() &&
            std::all_of(point.begin() + 1, point.end(), [](const Json& part) { return part.is_number(); }) &&
            point[1].is_number_integer() && point[2].is_number_integer() && point[3].is_number_integer() &&
            point[5].is_number_integer();
        if (!is_point || gaze.size() == longest_gaze)
            continue;
        ViewedGaze one{point[0] == "right",         {},
                       point[1].get<int>(),         point[2].get<int>(),
                       point[3].get<int>(),         point[4].get<double>(),
                       point[5].get<std::int64_t>()};
        if (point.size() == 8)
            one.place = ScreenPoint{point[6].get<double>(), point[7].get<double>()};
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

} // namespace

std::string line_of(const SessionFacts& facts) {
    MemberWriter writer;
    writer.value("overt_watch", view_version);
    facts_members(writer, facts);
    return line_of_json(writer.json);
}

std::string line_of(const SessionView& view) {
    MemberWriter writer;
    view_members(writer, view);
    return line_of_json({{"state", std::move(writer.json)}});
}

std::string line_of(const ViewedEvent& event) {
    MemberWriter writer;
    event_members(writer, event);
    return line_of_json({{"event", std::move(writer.json)}});
}

std::string line_of(std::span<const ViewedGaze> gaze) {
    Json points = Json::array();
    for (const ViewedGaze& one : gaze.last(std::min(gaze.size(), longest_gaze))) {
        Json point = Json::array(
            {one.is_right ? "right" : "left", one.trial, one.shown, one.pose, one.at_s, one.sampled_us});
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
        MemberReader reader{json};
        if (read.version == view_version)
            facts_members(reader, read.facts.emplace());
    } else if (const auto state = json.find("state"); state != json.end() && state->is_object()) {
        MemberReader reader{*state};
        view_members(reader, read.view.emplace());
    } else if (const auto event = json.find("event"); event != json.end() && event->is_object()) {
        MemberReader reader{*event};
        event_members(reader, read.event.emplace());
    } else if (const auto gaze = json.find("gaze"); gaze != json.end() && gaze->is_array()) {
        read.gaze = read_gaze(*gaze);
    } else if (const auto camera = json.find("camera"); camera != json.end() && camera->is_object()) {
        read.camera = read_camera(*camera);
    }
    return read;
}

bool SessionView::is_lit() const {
    return std::ranges::any_of(shown, [](const ViewedStimulus& one) { return one.pose >= 0; });
}

std::string words_of_shown(const SessionFacts& facts, const SessionView& view) {
    std::string words;
    for (const ViewedStimulus& shown : view.shown) {
        const auto slot = static_cast<std::size_t>(shown.slot);
        if (!words.empty())
            words += "; ";
        if (facts.slots.size() > 1 && slot < facts.slots.size())
            words += facts.slots[slot].id + ": ";
        words += shown.object + ", " + shown.material;
    }
    return words;
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
