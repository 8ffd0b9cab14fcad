#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/record/header_rows.h"
#include "experiment/record/seal_chain.h"
#include "experiment/record/session_schema.h"
#include "experiment/record/sql.h"

namespace overt {
namespace {

template <class... Values> void insert(SQLite::Database& database, const char* sql, const Values&... values) {
    SQLite::Statement statement(database, sql);
    run_statement(statement, values...);
}

void insert_session(SQLite::Database& database, const SessionHeader& header) {
    const ScreenGeometry& screen = header.display.screen;
    insert(database,
           "INSERT INTO session VALUES (1, ?,?,?,?, ?,?,?,?,?, ?, ?,?,?,?, ?,?,?,?, ?,?,?, "
           "?,?,?,?,?, ?,?,?,?, ?,?,?,?, ?,?,?,?,?,?)",
           header.protocol.name, header.protocol.title, header.protocol.text, header.protocol.sha256,
           header.schedule.observer.label, header.schedule.observer.number, header.session_number,
           std::to_string(header.schedule.seed), header.started_utc,
           header.clock == ClockKind::steady ? "steady" : "virtual", header.program.version,
           header.program.compiler, header.program.flags, header.program.commit, header.graphics.context,
           header.graphics.vendor, header.graphics.renderer, header.graphics.version, header.tracker.name,
           header.tracker.sample_rate_hz, header.tracker.eye == Eye::left ? "left" : "right",
           screen.screen_px.x, screen.screen_px.y, screen.screen_mm.x, screen.screen_mm.y,
           screen.viewing_distance_mm, screen.image_origin_px.x, screen.image_origin_px.y, screen.image_px.x,
           screen.image_px.y, header.display.refresh_hz,
           static_cast<std::int64_t>(header.display.latency.count()), header.display.output_mode,
           header.display.background, header.animation.frame_count, header.animation.frame_rate_hz,
           header.animation.amplitude.value,
           header.animation.playback == Playback::cycle ? "cycle" : "ping-pong", header.animation.duration_s,
           header.animation.when_late == WhenLate::drop ? "drop" : "stretch");
}

void insert_characterisation(SQLite::Database& database, const RecordedCharacterisation& light) {
    const auto& [red, green, blue] = light.primaries_xyz;
    const glm::dvec3& black = light.black_xyz;
    insert(database, "INSERT INTO characterisation VALUES (1, ?,?,?,?, ?,?,?, ?,?,?, ?,?,?, ?,?,?)",
           light.display, light.date, light.instrument, light.sha256, black.x, black.y, black.z, red.x, red.y,
           red.z, green.x, green.y, green.z, blue.x, blue.y, blue.z);
    int index = 0;
    for (const RecordedCharacterisation::File& file : light.files)
        insert(database, "INSERT INTO characterisation_file VALUES (?,?,?)", index++, file.name, file.text);
}

void insert_design(SQLite::Database& database, const SessionHeader& header) {
    for (const Trial& trial : header.schedule.trials)
        insert(database, "INSERT INTO schedule VALUES (?,?,?,?,?)", trial.index, trial.task,
               trial.condition.sculpture, trial.condition.material, trial.block);
    int index = 0;
    for (const std::string& block : header.blocks)
        insert(database, "INSERT INTO block VALUES (?,?)", index++, block);
    index = 0;
    for (const RecordedProtocol::Included& file : header.protocol.included)
        insert(database, "INSERT INTO protocol_file VALUES (?,?,?,?)", index++, file.name, file.text,
               file.sha256);
    index = 0;
    for (const RecordedDatasetEntry& entry : header.dataset)
        insert(database, "INSERT INTO dataset_entry VALUES (?,?,?)", index++, entry.key, entry.value);
    index = 0;
    for (const RecordedTask& task : header.tasks)
        insert(database, "INSERT INTO task VALUES (?,?,?)", index++, task.id, task.question);
    index = 0;
    for (const RecordedMaterial& material : header.materials)
        insert(database, "INSERT INTO material VALUES (?,?,?)", index++, material.id, material.title);
    index = 0;
    for (const Degrees angle : header.poses.angles)
        insert(database, "INSERT INTO pose VALUES (?,?)", index++, angle.value);
    index = 0;
    for (const PoseIndex pose : header.poses.of_frame)
        insert(database, "INSERT INTO animation_frame VALUES (?,?)", index++, pose.value);
}

void insert_sculptures(SQLite::Database& database, const SessionHeader& header) {
    int index = 0;
    for (const RecordedSculpture& sculpture : header.sculptures) {
        const Camera& camera = sculpture.camera;
        const Bounds& bounds = sculpture.bounds;
        insert(database, "INSERT INTO sculpture VALUES (?,?,?,?,?, ?,?,?, ?,?,?,?, ?,?,?, ?,?,?, ?,?,?)",
               index, sculpture.id, sculpture.title, sculpture.mesh_sha256, sculpture.mesh_file,
               camera.position.x, camera.position.y, camera.position.z, camera.target.x, camera.target.y,
               camera.target.z, camera.vertical_fov.value, sculpture.axis_point.x, sculpture.axis_point.y,
               sculpture.axis_point.z, bounds.min.x, bounds.min.y, bounds.min.z, bounds.max.x, bounds.max.y,
               bounds.max.z);
        int part = 0;
        for (const std::string& name : sculpture.part_names)
            insert(database, "INSERT INTO part VALUES (?,?,?)", index, part++, name);
        ++index;
    }
    for (const RecordedStimulus& stimulus : header.stimuli)
        insert(database, "INSERT INTO stimulus VALUES (?,?,?,?)", stimulus.condition.sculpture,
               stimulus.condition.material, stimulus.source, stimulus.frames_sha256);
    for (const RecordedMap& map : header.maps)
        insert(database, "INSERT INTO map VALUES (?,?,?,?,?,?)", map.sculpture, map.pose.value, map.file,
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
        insert_session(database, header);
        if (header.characterisation)
            insert_characterisation(database, *header.characterisation);
        insert_design(database, header);
        insert_sculptures(database, header);
        SealWriter(database).begin(0);
        transaction.commit();
    } catch (const SQLite::Exception& reason) {
        throw_record_error(file, "writing the session's header", reason);
    }
}

} // namespace overt
