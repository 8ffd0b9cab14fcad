#include "experiment/study/read/open_sessions.h"

#include <algorithm>
#include <map>
#include <set>
#include <thread>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/error.h"
#include "experiment/study/read/session_setup.h"

namespace overt {

namespace {

std::string folder_name(const std::filesystem::path& session) {
    std::filesystem::path path = std::filesystem::absolute(session).lexically_normal();
    if (!path.has_filename() || path.filename() == "session.sqlite")
        path = path.parent_path();
    return path.filename().string();
}

/// Each holds up to three descriptors, of which a process may have as few as 64.
constexpr std::size_t most_open_files = 8;

/// What two records of one session have in common, wherever they lie, and however far each has got.
std::string identity_of(const SessionHeader& header) {
    return fmt::format("{} {} {} {} {} {}", header.schedule.observer.label, header.session_number,
                       header.started_utc, header.schedule.seed, header.protocol.name,
                       header.protocol.sha256);
}

/// The file that a session was imported from, by its bytes; empty: it was recorded.
std::string recording_of(const SessionRecord& record) {
    const std::optional<GazeSource> source =
        record.header().stimuli.empty() ? record.gaze_source(1) : std::nullopt;
    return source ? source->sha256 : "";
}

/// Everything that would count twice, each with the one that it is the same as.
class Doubles {
  public:
    void add(const SessionRecord& record) {
        const SessionHeader& header = record.header();
        const std::string path = record.directory().string();
        const std::string recording = recording_of(record);
        if (const auto [same, is_new] = sessions_.emplace(identity_of(header), path); !is_new)
            found_.push_back(fmt::format("{} is the same session as {} (observer {}, session {}, begun {})",
                                         path, same->second, header.schedule.observer.label,
                                         header.session_number, header.started_utc));
        else if (!recording.empty())
            if (const auto [other, is_first] = recordings_.emplace(recording, path); !is_first)
                found_.push_back(
                    fmt::format("{} was imported from the same recording as {}", path, other->second));
    }

    /// Throws InputError if there are any.
    void refuse() const {
        if (!found_.empty())
            throw InputError(
                fmt::format("{}. Its gaze would count twice: give one of them.", fmt::join(found_, ";\n")));
    }

  private:
    std::map<std::string, std::string> sessions_, recordings_;
    std::vector<std::string> found_;
};

} // namespace

std::vector<OpenSession> open_sessions(std::span<const std::filesystem::path> sessions,
                                       const std::optional<ChosenThresholds>& detect_events) {
    std::vector<OpenSession> open;
    const std::size_t processors = std::max(1u, std::thread::hardware_concurrency());
    const std::size_t readers = (processors + sessions.size() - 1) / sessions.size();
    Doubles doubles;
    std::set<std::filesystem::path> seen;
    for (const std::filesystem::path& session : sessions) {
        if (!seen.insert(std::filesystem::weakly_canonical(session)).second)
            throw InputError(fmt::format("{}: this session was named twice.", session.string()));
        OpenSession& one = open.emplace_back();
        one.path = std::filesystem::weakly_canonical(session);
        for (std::size_t i = 0; i < readers; ++i) {
            one.readers.push_back(std::make_unique<SessionRecord>(session));
            if (i > 0)
                one.readers.back()->detect_events_as(*one.readers.front());
            else if (detect_events)
                one.readers.front()->detect_events(*detect_events);
            else
                one.readers.front()->detect_events_of_imports();
            one.keys.push_back(std::make_unique<TrialKeys>(*one.readers.back()));
        }
        one.presentations = one.record().presentations();
        doubles.add(one.record());
        one.validations = validations_of(one.record());
        one.is_one_of_many = sessions.size() * readers > most_open_files;
        one.rest();
    }
    doubles.refuse();
    return open;
}

StudySession describe_session(const OpenSession& open, const std::filesystem::path& path) {
    const SessionRecord& record = open.record();
    const SessionHeader& header = record.header();
    StudySession session;
    session.folder = folder_name(path);
    session.observer = header.schedule.observer.label;
    session.number = header.session_number;
    session.protocol = header.protocol.title.empty() ? header.protocol.name : header.protocol.title;
    for (const RecordedObserverField& field : record.observer_fields())
        session.form.push_back({field.id, field.value});
    session.is_complete = record.is_complete();
    session.setup = setup_of(record);
    for (const TrialRecord& trial : record.trials())
        session.trials += trial.gives_results();
    return session;
}

bool is_same_object(const SessionHeader& a, const ViewedObject& in_a, const SessionHeader& b,
                    const ViewedObject& in_b) {
    const RecordedObject &one = a.objects[static_cast<std::size_t>(in_a.object)],
                         &other = b.objects[static_cast<std::size_t>(in_b.object)];
    const Camera &camera = one.camera(in_a.view), &other_camera = other.camera(in_b.view);
    const auto maps_of = [](const SessionHeader& header, const ViewedObject& viewed) {
        std::vector<std::pair<int, ContentHash>> maps;
        for (const RecordedMap& map : header.maps) {
            if (map.viewed == viewed)
                maps.emplace_back(map.pose.value, map.sha256);
        }
        std::sort(maps.begin(), maps.end());
        return maps;
    };
    const ScreenGeometry screen = a.screen_of_view(in_a.view), other_screen = b.screen_of_view(in_b.view);
    // Maps are looked up by the number of the pose.
    return a.poses.angles == b.poses.angles && one.id == other.id &&
           one.mesh_file.empty() == other.mesh_file.empty() && one.mesh_sha256 == other.mesh_sha256 &&
           camera == other_camera && screen.image_px == other_screen.image_px &&
           screen.screen_px == other_screen.screen_px && screen.screen_mm == other_screen.screen_mm &&
           screen.viewing_distance_mm == other_screen.viewing_distance_mm &&
           (!one.mesh_file.empty() || maps_of(a, in_a) == maps_of(b, in_b));
}

StudyObject describe_object(const SessionHeader& header, const ViewedObject& viewed) {
    const RecordedObject& recorded = header.objects[static_cast<std::size_t>(viewed.object)];
    StudyObject object;
    object.id = recorded.id;
    object.title = recorded.title;
    // Views count on from those of the list, for each further size that slots have.
    const std::size_t views = std::max<std::size_t>(1, header.views.size()),
                      view = static_cast<std::size_t>(viewed.view);
    if (views > 1)
        object.title += ", " + header.views[view % views].title;
    if (!header.display.stereo.empty())
        object.title += recorded.camera(viewed.view).aside < 0.0 ? ", left eye" : ", right eye";
    if (std::ranges::any_of(header.slots, [&](const RecordedSlot& slot) {
            return slot.size_px != header.slots.front().size_px;
        }))
        object.title += fmt::format(", at {} px", header.screen_of_view(viewed.view).image_px.y);
    object.part_names = recorded.part_names;
    object.areas = Areas(recorded.part_names);
    object.camera = recorded.camera(viewed.view);
    object.axis_point = recorded.axis_point;
    object.unit = recorded.unit;
    object.origin = recorded.origin;
    object.screen = header.screen_of_view(viewed.view);
    for (const RecordedPoint& point : header.points)
        if (point.object == viewed.object)
            object.points.push_back({point.name, point.position});
    return object;
}

// Who resumes a session adds to both.
std::string state_of(const SessionRecord& record) {
    return fmt::format("{} trials, last time {} ns", record.trials().size(),
                       record.last_time().time_since_epoch().count());
}

} // namespace overt
