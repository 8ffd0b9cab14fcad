#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/record/header_rows.h"
#include "experiment/record/header_tables.h"
#include "experiment/record/seal_chain.h"
#include "experiment/record/session_schema.h"
#include "experiment/record/sql.h"
#include "experiment/record/stimulus_columns.h"

namespace overt {
namespace {

void insert_characterisation(SQLite::Database& database, const RecordedCharacterisation& light) {
    insert_row(database, characterisation_table(), 1, light);
    int index = 0;
    for (const RecordedCharacterisation::File& file : light.files)
        insert_values(database, "INTO characterisation_file", index++, file.name, file.text);
}

void insert_design(SQLite::Database& database, const SessionHeader& header) {
    for (const Trial& trial : header.schedule.trials)
        insert_values(database, fmt::format("INTO schedule (trial, task, {}, block)", stimulus_columns()),
                      trial.index, trial.task, trial.stimulus, trial.block);
    int index = 0;
    for (const Trial& trial : header.schedule.trials) {
        for (std::size_t i = 0; i < trial.shown_count() && (trial.slot != 0 || !trial.beside.empty()); ++i) {
            const auto [stimulus, slot] = trial.shown(i);
            insert_values(database,
                          fmt::format("INTO schedule_slot (trial, place, slot, {})", stimulus_columns()),
                          trial.index, static_cast<int>(i), slot, stimulus);
        }
    }
    for (const Trial& trial : header.schedule.trials) {
        int level = 0;
        for (const TrialLevel& of : trial.levels)
            insert_values(database, "INTO schedule_level", trial.index, level++, of.factor, of.level);
        if (!trial.correct.empty() || trial.role != TrialRole::trial)
            insert_values(database, "INTO schedule_answer", trial.index, trial.correct,
                          std::string(name_of(trial.role)));
    }
    for (const std::string& block : header.blocks)
        insert_values(database, "INTO block", index++, block);
    index = 0;
    for (const RecordedProtocol::Included& file : header.protocol.included)
        insert_values(database, "INTO protocol_file", index++, file.name, file.text, file.sha256);
    index = 0;
    for (const RecordedDatasetEntry& entry : header.dataset)
        insert_values(database, "INTO dataset_entry", index++, entry.key, entry.value);
    index = 0;
    for (const RecordedTask& task : header.tasks)
        insert_values(database, "INTO task", index++, task.id, task.question);
    index = 0;
    for (const auto& [angle, tilt, shift] : header.poses.angles)
        insert_values(database, "INTO pose", index++, angle.value, tilt.w, tilt.x, tilt.y, tilt.z, shift.x,
                      shift.y, shift.z);
    int motion = 0;
    for (const Animation& animation : header.animations) {
        insert_row(database, animation_table(), motion, animation);
        index = 0;
        for (const PoseIndex pose : header.poses.frames_of(motion)) {
            const Degrees light = animation.pose_of({index}).light;
            insert_values(database, "INTO animation_frame", motion, index++, pose.value, light.value);
        }
        ++motion;
    }
}

/// Ids and titles of each list, but for the objects', and the columns of all.
void insert_lists(SQLite::Database& database, const SessionHeader& header) {
    for (std::size_t list = 0; list < stimulus_lists.size(); ++list) {
        const std::string name(stimulus_lists[list].name);
        int index = 0;
        for (const ListEntry& entry : entries_of(header, list)) {
            if (name != object_table().name)
                insert_values(database, "INTO " + name, index, entry.id, entry.title);
            int n = 0;
            for (const NamedWord& column : entry.columns)
                insert_values(database, "INTO entry_column", name, index, n++, column.name, column.text,
                              column.number);
            ++index;
        }
    }
}

void insert_slots(SQLite::Database& database, const SessionHeader& header) {
    int index = 0;
    for (const RecordedSlot& slot : header.slots)
        insert_values(database, "INTO slot", index++, slot.id, slot.title, slot.origin_px.x, slot.origin_px.y,
                      slot.size_px.x, slot.size_px.y);
}

void insert_points(SQLite::Database& database, const SessionHeader& header) {
    int n = 0;
    for (const RecordedPoint& point : header.points)
        insert_values(database, "INTO point", point.object, n++, point.name,
                      static_cast<std::int64_t>(point.triangle), point.barycentric.x, point.barycentric.y,
                      point.barycentric.z, point.position.x, point.position.y, point.position.z,
                      point.vertex ? std::optional(static_cast<std::int64_t>(*point.vertex)) : std::nullopt,
                      point.part);
}

void insert_objects(SQLite::Database& database, const SessionHeader& header) {
    int index = 0;
    for (const RecordedObject& object : header.objects) {
        insert_row(database, object_table(), index, object);
        int part = 0;
        for (const std::string& name : object.part_names)
            insert_values(database, "INTO part", index, part++, name);
        int view = 0;
        for (const auto& [at, target, fov, aside] : object.cameras)
            insert_values(database, "INTO camera", index, view++, at.x, at.y, at.z, target.x, target.y,
                          target.z, fov.value, aside);
        ++index;
    }
    for (const RecordedStimulus& stimulus : header.stimuli)
        insert_values(database,
                      fmt::format("INTO stimulus ({}, source, frames_sha256, made_from_sha256, drawn_by)",
                                  stimulus_columns()),
                      stimulus.stimulus, stimulus.source, stimulus.frames_sha256, stimulus.made_from_sha256,
                      stimulus.drawn_by);
    for (const RecordedMap& map : header.maps)
        insert_values(database, "INTO map", map.viewed.object, map.viewed.view, map.pose.value, map.file,
                      map.sha256, map.made == RecordedMap::Made::prepared ? "prepared" : "live",
                      map.kind == RecordedMap::Kind::triangles ? "triangles" : "coordinates");
}

} // namespace

void create_session_file(const std::filesystem::path& file, const SessionHeader& header) {
    if (std::filesystem::exists(file))
        throw RecordError(
            fmt::format("{}: there is a session file already; it is not overwritten.", file.string()));
    try {
        SQLite::Database database(file.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
        database.exec(fmt::format("PRAGMA application_id = {}; PRAGMA user_version = {}; "
                                  "PRAGMA synchronous = FULL",
                                  session_application_id, session_schema_version));
        SQLite::Transaction transaction(database);
        make_session_tables(database);
        insert_row(database, session_table(), 1, header);
        if (header.characterisation)
            insert_characterisation(database, *header.characterisation);
        insert_design(database, header);
        insert_lists(database, header);
        insert_slots(database, header);
        insert_objects(database, header);
        insert_points(database, header);
        SealWriter(database).begin(0);
        transaction.commit();
    } catch (const SQLite::Exception& reason) {
        throw_record_error(file, "writing the session's header", reason);
    }
}

} // namespace overt
