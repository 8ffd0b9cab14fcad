#include <charconv>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/record/header_rows.h"
#include "experiment/record/sql.h"

namespace overt {
namespace {

std::uint64_t seed_from(const std::string& text) {
    std::uint64_t seed = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
    if (error != std::errc() || end != text.data() + text.size())
        throw RecordError(fmt::format("table session: the seed is no number: {}", text));
    return seed;
}

glm::dvec3 read_vector(Query& row) {
    const double x = row.real(), y = row.real(), z = row.real();
    return {x, y, z};
}
glm::ivec2 read_pixels(Query& row) {
    const int x = row.small(), y = row.small();
    return {x, y};
}

void read_session(Query& row, SessionHeader& header) {
    header.protocol = {row.text(), row.text(), row.text(), row.text(), {}};
    header.schedule.observer = {row.text(), row.small()};
    header.session_number = row.small();
    header.schedule.seed = seed_from(row.text());
    header.started_utc = row.text();
    header.clock = row.text() == "steady" ? ClockKind::steady : ClockKind::virtual_time;
    header.program = {row.text(), row.text(), row.text(), row.text()};
    header.graphics = {row.text(), row.text(), row.text(), row.text()};
    header.tracker = {row.text(), row.real(), row.text() == "left" ? Eye::left : Eye::right};
    ScreenGeometry& screen = header.display.screen;
    screen.screen_px = read_pixels(row);
    screen.screen_mm.x = row.real();
    screen.screen_mm.y = row.real();
    screen.viewing_distance_mm = row.real();
    screen.image_origin_px = read_pixels(row);
    screen.image_px = read_pixels(row);
    header.display.refresh_hz = row.real();
    header.display.latency = SessionDuration(row.integer());
    header.display.output_mode = row.text();
    header.display.background = row.real();
    header.animation.frame_count = row.small();
    header.animation.frame_rate_hz = row.real();
    header.animation.amplitude.value = row.real();
    header.animation.playback = row.text() == "cycle" ? Playback::cycle : Playback::ping_pong;
    header.animation.duration_s = row.real();
    header.animation.when_late = row.text() == "stretch" ? WhenLate::stretch : WhenLate::drop;
}

void read_characterisation(const SQLite::Database& database, SessionHeader& header) {
    // Sessions of earlier programs have no such table.
    if (!has_table(database, "characterisation"))
        return;
    Query row(database, "SELECT display, date, instrument, sha256, black_x, black_y, black_z, red_x, red_y, "
                        "red_z, green_x, green_y, green_z, blue_x, blue_y, blue_z FROM characterisation");
    if (!row.step())
        return;
    RecordedCharacterisation light;
    light.display = row.text();
    light.date = row.text();
    light.instrument = row.text();
    light.sha256 = row.text();
    light.black_xyz = read_vector(row);
    for (glm::dvec3& primary : light.primaries_xyz)
        primary = read_vector(row);
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

void read_dataset(const SQLite::Database& database, SessionHeader& header) {
    if (!has_table(database, "dataset_entry"))
        return;
    for (Query row(database, "SELECT key, value FROM dataset_entry ORDER BY n"); row.step();)
        header.dataset.push_back({row.text(), row.text()});
}

void read_design(const SQLite::Database& database, SessionHeader& header) {
    for (Query row(database, "SELECT trial, task, sculpture, material FROM schedule ORDER BY trial");
         row.step();)
        header.schedule.trials.push_back({row.small(), row.small(), {row.small(), row.small()}});
    read_blocks(database, header);
    read_dataset(database, header);
    for (Query row(database, "SELECT id, question FROM task ORDER BY task"); row.step();)
        header.tasks.push_back({row.text(), row.text()});
    for (Query row(database, "SELECT id, title FROM material ORDER BY material"); row.step();)
        header.materials.push_back({row.text(), row.text()});
    for (Query row(database, "SELECT angle_deg FROM pose ORDER BY pose"); row.step();)
        header.poses.angles.push_back({row.real()});
    for (Query row(database, "SELECT pose FROM animation_frame ORDER BY frame"); row.step();)
        header.poses.of_frame.push_back({row.small()});
}

RecordedSculpture read_sculpture(Query& row) {
    RecordedSculpture sculpture;
    sculpture.id = row.text();
    sculpture.title = row.text();
    sculpture.mesh_sha256 = row.text();
    sculpture.mesh_file = row.text();
    sculpture.camera.position = read_vector(row);
    sculpture.camera.target = read_vector(row);
    sculpture.camera.vertical_fov.value = row.real();
    sculpture.axis_point = read_vector(row);
    sculpture.bounds.min = read_vector(row);
    sculpture.bounds.max = read_vector(row);
    return sculpture;
}

void read_sculptures(const SQLite::Database& database, SessionHeader& header) {
    for (Query row(database,
                   "SELECT id, title, mesh_sha256, mesh_file, camera_x, camera_y, camera_z, target_x, "
                   "target_y, target_z, vertical_fov_deg, axis_x, axis_y, axis_z, min_x, min_y, "
                   "min_z, max_x, max_y, max_z FROM sculpture ORDER BY sculpture");
         row.step();)
        header.sculptures.push_back(read_sculpture(row));
    for (Query row(database, "SELECT sculpture, name FROM part ORDER BY sculpture, part"); row.step();) {
        const auto sculpture = static_cast<std::size_t>(row.small());
        if (sculpture >= header.sculptures.size())
            throw RecordError(fmt::format("table part: there is no sculpture {}", sculpture));
        header.sculptures[sculpture].part_names.push_back(row.text());
    }
    for (Query row(database, "SELECT sculpture, material, source, frames_sha256 FROM stimulus"); row.step();)
        header.stimuli.push_back({{row.small(), row.small()}, row.text(), row.text()});
    // In version 1 all maps were of triangles.
    Query version(database, "PRAGMA user_version");
    const bool has_kind = version.step() && version.small() >= 2;
    for (Query row(database, has_kind ? "SELECT sculpture, pose, file, sha256, made, kind FROM map"
                                      : "SELECT sculpture, pose, file, sha256, made, 'triangles' FROM map");
         row.step();)
        header.maps.push_back(
            {row.small(),
             {row.small()},
             row.text(),
             row.text(),
             row.text() == "prepared" ? RecordedMap::Made::prepared : RecordedMap::Made::live,
             row.text() == "triangles" ? RecordedMap::Kind::triangles : RecordedMap::Kind::coordinates});
}

} // namespace

SessionHeader read_session_header(const SQLite::Database& database) {
    SessionHeader header;
    // By name, so that columns added by a later version of the program change nothing here.
    const char* const when_late = has_column(database, "session", "when_late") ? "when_late" : "'drop'";
    const std::string sql = fmt::format(
        "SELECT protocol_name, protocol_title, protocol_text, protocol_sha256, observer_label, "
        "observer_number, session_number, seed, started_utc, clock, program_version, compiler, "
        "compiler_flags, commit_id, gl_context, gl_vendor, gl_renderer, gl_version, tracker_name, "
        "tracker_rate_hz, tracker_eye, screen_width_px, screen_height_px, screen_width_mm, "
        "screen_height_mm, viewing_distance_mm, image_left_px, image_top_px, image_width_px, "
        "image_height_px, refresh_hz, display_latency_ns, output_mode, background, frame_count, "
        "frame_rate_hz, amplitude_deg, playback, duration_s, {} FROM session",
        when_late);
    Query row(database, sql.c_str());
    if (!row.step())
        throw RecordError(fmt::format("{}: table session: the one row that describes the session is missing",
                                      database.getFilename()));
    read_session(row, header);
    read_characterisation(database, header);
    read_design(database, header);
    read_sculptures(database, header);
    return header;
}

} // namespace overt
