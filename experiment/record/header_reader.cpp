#include <algorithm>
#include <tuple>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/record/header_rows.h"
#include "experiment/record/header_tables.h"
#include "experiment/record/no_stimulus.h"
#include "experiment/record/sql.h"
#include "experiment/record/stimulus_columns.h"

namespace overt {
namespace {

void read_characterisation(const SQLite::Database& database, SessionHeader& header) {
    // Sessions of earlier programs have no such table.
    if (!has_table(database, "characterisation"))
        return;
    std::vector<RecordedCharacterisation> rows = read_table(database, characterisation_table());
    if (rows.empty())
        return;
    RecordedCharacterisation& light = rows.front();
    for (Query file(database, "SELECT name, text FROM characterisation_file ORDER BY n"); file.step();) {
        std::string name = file.text();
        light.files.push_back({std::move(name), file.text()});
    }
    header.characterisation = std::move(light);
}

/// Sessions of earlier programs have neither blocks nor included files.
void read_blocks(const SQLite::Database& database, SessionHeader& header) {
    if (!has_table(database, "block"))
        return;
    for (Query row(database, "SELECT id FROM block ORDER BY block"); row.step();)
        header.blocks.push_back(row.text());
    std::size_t trial = 0;
    for (Query row(database, "SELECT block FROM schedule ORDER BY trial"); row.step(); ++trial)
        if (trial < header.schedule.trials.size())
            header.schedule.trials[trial].block = row.small();
    for (Query row(database, "SELECT name, text, sha256 FROM protocol_file ORDER BY n"); row.step();)
        header.protocol.included.push_back({row.text(), row.text(), row.text()});
}

/// What planned trials show in slots, where that is more than one stimulus in the first.
void read_slots(const SQLite::Database& database, SessionHeader& header) {
    if (has_table(database, "slot")) {
        for (Query row(database,
                       "SELECT id, title, left_px, top_px, width_px, height_px FROM slot ORDER BY slot");
             row.step();)
            header.slots.push_back(
                {row.text(), row.text(), {row.small(), row.small()}, {row.small(), row.small()}});
        for (Query row(database,
                       fmt::format("SELECT trial, place, slot, {} FROM schedule_slot ORDER BY trial, "
                                   "place",
                                   stimulus_columns_of(database, "schedule_slot"))
                           .c_str());
             row.step();) {
            const int index = row.small(), place = row.small();
            PlacedStimulus shown;
            row.read(shown.slot, shown.stimulus);
            const auto trial = std::ranges::find(header.schedule.trials, index, &Trial::index);
            if (trial == header.schedule.trials.end())
                throw RecordError(fmt::format("table schedule_slot: there is no trial {}", index));
            if (place == 0)
                trial->slot = shown.slot;
            else
                trial->beside.push_back(shown);
        }
    }
    const ScreenGeometry& screen = header.display.screen;
    if (header.slots.empty())
        header.slots.push_back({"centre", "centre", screen.image_origin_px, screen.image_px});
}

/// What planned trials have besides their stimuli.
void read_own_levels(const SQLite::Database& database, SessionHeader& header) {
    if (!has_table(database, "schedule_level"))
        return;
    const auto trial_at = [&](int index) -> Trial& {
        const auto trial = std::ranges::find(header.schedule.trials, index, &Trial::index);
        if (trial == header.schedule.trials.end())
            throw RecordError(
                fmt::format("table schedule_level or schedule_answer: there is no trial {}", index));
        return *trial;
    };
    for (Query row(database, "SELECT trial, factor, level FROM schedule_level ORDER BY trial, n");
         row.step();) {
        Trial& trial = trial_at(row.small());
        std::string factor = row.text();
        trial.levels.push_back({std::move(factor), row.text()});
    }
    for (Query row(database, "SELECT trial, correct, role FROM schedule_answer"); row.step();) {
        Trial& trial = trial_at(row.small());
        trial.correct = row.text();
        const auto role = std::ranges::find(names_of<TrialRole>, row.text());
        if (role == names_of<TrialRole>.end())
            throw RecordError("table schedule_answer: there is no such role of a trial");
        trial.role = static_cast<TrialRole>(role - names_of<TrialRole>.begin());
    }
}

void read_dataset(const SQLite::Database& database, SessionHeader& header) {
    if (!has_table(database, "dataset_entry"))
        return;
    for (Query row(database, "SELECT key, value FROM dataset_entry ORDER BY n"); row.step();)
        header.dataset.push_back({row.text(), row.text()});
}

/// In those of earlier programs objects only turn about the vertical.
void read_poses(const SQLite::Database& database, SessionHeader& header) {
    if (!has_column(database, "pose", "tilt_w")) {
        for (Query row(database, "SELECT angle_deg FROM pose ORDER BY pose"); row.step();)
            header.poses.angles.push_back({{row.real()}});
        return;
    }
    for (Query row(database, "SELECT angle_deg, tilt_w, tilt_x, tilt_y, tilt_z, shift_x, shift_y, shift_z "
                             "FROM pose ORDER BY pose");
         row.step();) {
        auto& [angle, tilt, shift] = header.poses.angles.emplace_back();
        row.read(angle.value, tilt.w, tilt.x, tilt.y, tilt.z, shift.x, shift.y, shift.z);
    }
}

/// How each frame of each motion is, as it was recorded: what a program makes of a kind of motion may change.
void read_given_poses(const SQLite::Database& database, SessionHeader& header) {
    for (Query row(database, "SELECT motion, pose, light_deg FROM animation_frame ORDER BY motion, frame");
         row.step();) {
        const auto motion = static_cast<std::size_t>(row.small()),
                   pose = static_cast<std::size_t>(row.small());
        if (pose >= header.poses.angles.size())
            throw RecordError(fmt::format("table animation_frame: there is no pose {}", pose));
        header.animations[motion].given.push_back({header.poses.angles[pose], {row.real()}});
    }
}

/// Sessions of earlier formats have one motion, which the session's own row tells, and one view.
void read_motions(const SQLite::Database& database, SessionHeader& header) {
    if (has_table(database, "animation"))
        if (std::vector<Animation> motions = read_table(database, animation_table()); !motions.empty())
            header.animations = std::move(motions);
    header.poses.of_motion.resize(header.animations.size());
    const bool has_motion = has_column(database, "animation_frame", "motion");
    for (Query row(database, has_motion ? "SELECT motion, pose FROM animation_frame ORDER BY motion, frame"
                                        : "SELECT 0, pose FROM animation_frame ORDER BY frame");
         row.step();) {
        const auto motion = static_cast<std::size_t>(row.small());
        if (motion >= header.poses.of_motion.size())
            throw RecordError(fmt::format("table animation_frame: there is no motion {}", motion));
        header.poses.of_motion[motion].push_back({row.small()});
    }
    if (has_column(database, "animation_frame", "light_deg"))
        read_given_poses(database, header);
}

void read_cameras(const SQLite::Database& database, SessionHeader& header) {
    if (!has_table(database, "camera"))
        return;
    for (Query row(database, fmt::format("SELECT object, view, x, y, z, target_x, target_y, target_z, "
                                         "vertical_fov_deg, {} FROM camera ORDER BY object, view",
                                         has_column(database, "camera", "aside") ? "aside" : "0.0")
                                 .c_str());
         row.step();) {
        const auto object = static_cast<std::size_t>(row.small()),
                   view = static_cast<std::size_t>(row.small());
        constexpr std::size_t most_views = 255;
        if (object >= header.objects.size() || view > most_views)
            throw RecordError(fmt::format("table camera: there is no object {} in view {}", object, view));
        std::vector<Camera>& cameras = header.objects[object].cameras;
        if (cameras.size() <= view)
            cameras.resize(view + 1);
        Camera& camera = cameras[view];
        row.read(camera.position.x, camera.position.y, camera.position.z, camera.target.x, camera.target.y,
                 camera.target.z, camera.vertical_fov.value, camera.aside);
    }
}

void read_design(const SQLite::Database& database, SessionHeader& header) {
    for (Query row(database, fmt::format("SELECT trial, task, {} FROM schedule ORDER BY trial",
                                         stimulus_columns_of(database, "schedule"))
                                 .c_str());
         row.step();) {
        Trial& trial = header.schedule.trials.emplace_back();
        row.read(trial.index, trial.task, trial.stimulus);
    }
    read_blocks(database, header);
    read_slots(database, header);
    read_own_levels(database, header);
    read_dataset(database, header);
    for (Query row(database, "SELECT id, question FROM task ORDER BY task"); row.step();)
        header.tasks.push_back({row.text(), row.text()});
    read_poses(database, header);
    read_motions(database, header);
}

void read_points(const SQLite::Database& database, SessionHeader& header) {
    if (!has_table(database, "point"))
        return;
    for (Query row(database,
                   "SELECT object, name, triangle, weight_a, weight_b, weight_c, x, y, z, vertex, part "
                   "FROM point ORDER BY n");
         row.step();) {
        RecordedPoint& point = header.points.emplace_back();
        std::int64_t triangle = 0;
        std::optional<std::int64_t> vertex;
        row.read(point.object, point.name, triangle, point.barycentric.x, point.barycentric.y,
                 point.barycentric.z, point.position.x, point.position.y, point.position.z, vertex,
                 point.part);
        point.triangle = static_cast<std::uint32_t>(triangle);
        if (vertex)
            point.vertex = static_cast<std::uint32_t>(*vertex);
        if (point.object < 0 || static_cast<std::size_t>(point.object) >= header.objects.size())
            throw RecordError(fmt::format("table point: there is no object {}", point.object));
    }
}

void read_objects(const SQLite::Database& database, SessionHeader& header) {
    header.objects = read_table(database, object_table());
    for (Query row(database, "SELECT object, name FROM part ORDER BY object, part"); row.step();) {
        const auto object = static_cast<std::size_t>(row.small());
        if (object >= header.objects.size())
            throw RecordError(fmt::format("table part: there is no object {}", object));
        header.objects[object].part_names.push_back(row.text());
    }
    read_cameras(database, header);
    const auto or_empty = [&](const char* column) {
        return has_column(database, "stimulus", column) ? column : "''";
    };
    for (Query row(database, fmt::format("SELECT {}, source, frames_sha256, {}, {} FROM stimulus",
                                         stimulus_columns_of(database, "stimulus"),
                                         or_empty("made_from_sha256"), or_empty("drawn_by"))
                                 .c_str());
         row.step();) {
        RecordedStimulus& stimulus = header.stimuli.emplace_back();
        row.read(stimulus.stimulus, stimulus.source, stimulus.frames_sha256, stimulus.made_from_sha256,
                 stimulus.drawn_by);
        // What earlier programs called the hash of the frames is that of what they are made from.
        if (stimulus.made_from_sha256.empty())
            std::swap(stimulus.frames_sha256, stimulus.made_from_sha256);
    }
    // In version 1 all maps were of triangles.
    Query version(database, "PRAGMA user_version");
    const bool has_kind = version.step() && version.small() >= 2;
    const bool has_view = has_column(database, "map", "view");
    for (Query row(database, fmt::format("SELECT object, {}, pose, file, sha256, made, {} FROM map",
                                         has_view ? "view" : "0", has_kind ? "kind" : "'triangles'")
                                 .c_str());
         row.step();)
        header.maps.push_back(
            {{row.small(), row.small()},
             {row.small()},
             row.text(),
             row.text(),
             row.text() == "prepared" ? RecordedMap::Made::prepared : RecordedMap::Made::live,
             row.text() == "triangles" ? RecordedMap::Kind::triangles : RecordedMap::Kind::coordinates});
}

/// Sessions of earlier formats have one light, one motion and one view, and no columns.
void read_lists(const SQLite::Database& database, SessionHeader& header) {
    for (std::size_t list = 0; list < stimulus_lists.size(); ++list) {
        const std::string name(stimulus_lists[list].name);
        std::size_t at = 0;
        const auto read = [&](auto of_list) {
            if (at++ != list)
                return;
            auto& entries = header.*of_list;
            if constexpr (std::is_same_v<std::remove_reference_t<decltype(entries)>, std::vector<ListEntry>>)
                if (has_table(database, name.c_str()))
                    for (Query row(database,
                                   fmt::format("SELECT id, title FROM {0} ORDER BY {0}", name).c_str());
                         row.step();) {
                        ListEntry& entry = entries.emplace_back();
                        row.read(entry.id, entry.title);
                    }
            if (!has_table(database, "entry_column"))
                return;
            for (Query row(database, fmt::format("SELECT entry, name, text, number FROM entry_column WHERE "
                                                 "list = '{}' ORDER BY entry, n",
                                                 name)
                                         .c_str());
                 row.step();) {
                const auto entry = static_cast<std::size_t>(row.small());
                if (entry >= entries.size())
                    throw RecordError(fmt::format("table entry_column: there is no {} {}", name, entry));
                NamedWord& column = entries[entry].columns.emplace_back();
                row.read(column.name, column.text, column.number);
            }
        };
        std::apply([&](auto... of_list) { (read(of_list), ...); }, recorded_lists);
    }
}

} // namespace

SessionHeader read_session_header(const SQLite::Database& database) {
    std::vector<SessionHeader> rows = read_table(database, session_table());
    if (rows.empty())
        throw RecordError(fmt::format("{}: table session: the one row that describes the session is missing",
                                      database.getFilename()));
    SessionHeader& header = rows.front();
    read_characterisation(database, header);
    read_design(database, header);
    read_objects(database, header);
    read_points(database, header);
    read_lists(database, header);
    // Imports of earlier programs have the motion of a protocol, which nothing went through, and one pose.
    if (knows_no_stimulus(header) && header.animations.size() == 1 &&
        header.poses.of_motion.front().size() == 1)
        header.animations = {no_animation};
    return std::move(header);
}

} // namespace overt
