#include "app/session/session_recording.h"

#include <fmt/format.h>

#include "app/cli/this_program.h"
#include "experiment/base/error.h"
#include "experiment/base/parallel.h"
#include "experiment/base/whole_file.h"
#include "experiment/protocol/files/written_series.h"
#include "experiment/protocol/keys/protocol_keys.h"
#include "experiment/record/header_rows.h"
#include "experiment/record/session_schema.h"
#include "experiment/scene/files/ply_writer.h"

namespace overt {

namespace {

void copy_into(const std::filesystem::path& from, const std::filesystem::path& to) {
    std::error_code error;
    std::filesystem::create_directories(to.parent_path(), error);
    if (!error)
        std::filesystem::copy_file(from, to, error);
    if (error)
        throw RecordError(fmt::format("{}: cannot be written: {}", to.string(), error.message()));
}

/// Of an object in one of so many views, at each size that slots have.
std::string map_name(const std::string& object, const ViewedObject& viewed, std::size_t views,
                     PoseIndex pose) {
    const std::string view = views > 1 ? fmt::format("view_{}/", viewed.view + 1) : "";
    return fmt::format("maps/{}/{}pose_{:02}.exr", object, view, pose.value);
}

/// `folder`: id of the object under which the maps are kept, which is another's of the same mesh where there
/// is one.
void add_prepared_maps(SessionHeader& header, const RecordedObject& object, const std::string& folder,
                       const ViewedObject& viewed, const StimulusLibrary& library) {
    const auto kind = library.cache().has_given_maps(viewed.object) ? RecordedMap::Kind::coordinates
                                                                    : RecordedMap::Kind::triangles;
    for (int pose = 0; pose < library.cache().poses().count(); ++pose) {
        header.maps.push_back({viewed,
                               {pose},
                               map_name(folder, viewed, object.cameras.size(), {pose}),
                               hash_of_file(library.cache().map_file(viewed, {pose})),
                               RecordedMap::Made::prepared,
                               kind});
    }
}

void describe_objects(SessionHeader& header, const Protocol& protocol, std::span<const Object> objects,
                      const StimulusLibrary& library, bool with_prepared_maps) {
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const Object& object = objects[i];
        // One mesh is one file, and so are its maps, however many objects are of it.
        const auto first = std::ranges::find_if(objects, [&](const Object& other) {
            return &other == &object || (object.has_mesh() && other.mesh_hash == object.mesh_hash &&
                                         other.origin == object.origin);
        });
        const std::string& folder = first->id;
        RecordedObject recorded;
        recorded.id = object.id;
        recorded.title = protocol.objects[i].title;
        recorded.mesh_sha256 = object.mesh_hash;
        recorded.surface_sha256 = object.appearance_hash;
        recorded.surface_files = object.appearance_files;
        recorded.part_names = object.mesh->part_names;
        recorded.unit = unit_of_lengths(protocol.objects[i]);
        recorded.origin = object.origin;
        const bool has_given_maps = library.cache().has_given_maps(static_cast<int>(i));
        recorded.cameras.resize(protocol.views_at_all_sizes());
        for (std::size_t view = 0; view < recorded.cameras.size(); ++view) {
            const ViewedObject viewed{static_cast<int>(i), static_cast<int>(view)};
            if (!object.has_mesh() && !has_given_maps)
                continue;
            const SceneView scene =
                object.has_mesh() ? object.scenes[view] : library.cache().scene_of_given_maps(viewed);
            recorded.cameras[view] = scene.view.camera;
            recorded.bounds = scene.bounds;
            recorded.axis_point = scene.bounds.centre();
            if (with_prepared_maps || has_given_maps)
                add_prepared_maps(header, recorded, folder, viewed, library);
        }
        if (object.has_mesh())
            recorded.mesh_file = fmt::format("meshes/{}.ply", folder);
        header.objects.push_back(std::move(recorded));
    }
}

std::optional<RecordedCharacterisation> recorded(const std::optional<DisplayCharacterisation>& light) {
    if (!light)
        return std::nullopt;
    RecordedCharacterisation recorded{
        light->display,       light->date, light->instrument, light->sha256, light->black_xyz,
        light->primaries_xyz, {}};
    for (const CharacterisationFile& file : light->files)
        recorded.files.push_back({file.name, file.text});
    return recorded;
}

/// By the keys of the table, so that a new one is recorded as it is.
std::vector<RecordedDatasetEntry> recorded(const DatasetSettings& dataset) {
    std::vector<RecordedDatasetEntry> entries;
    const auto add = [&](std::string_view key, const std::string& value) {
        if (!value.empty())
            entries.push_back({std::string(key), value});
    };
    for (const Key& key : protocol_keys().section("dataset").keys) {
        if (const auto* text = key.get_if<std::string>(&dataset))
            add(key.rule.name, *text);
        if (const auto* list = key.get_if<std::vector<std::string>>(&dataset))
            for (const std::string& value : *list)
                add(key.rule.name, value);
    }
    return entries;
}

void record_points(SessionHeader& header, std::span<const Object> objects) {
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const Mesh& mesh = objects[i].mesh;
        for (const ObjectPoint& point : objects[i].points)
            header.points.push_back({.object = static_cast<int>(i),
                                     .name = point.name,
                                     .triangle = point.site.triangle,
                                     .barycentric = point.site.barycentric,
                                     .position = point.position,
                                     .vertex = point.vertex,
                                     .part = mesh.part_names[mesh.triangle_parts[point.site.triangle]]});
    }
}

} // namespace

SessionHeader make_session_header(const Protocol& protocol, const Schedule& schedule,
                                  std::span<const Object> objects, const StimulusLibrary& library,
                                  const GlDescription& graphics, const TrackerDescription& tracker,
                                  ClockKind clock, bool with_prepared_maps, bool with_frames) {
    SessionHeader header;
    header.protocol = {protocol.name, protocol.title, protocol.text, hash_of_text(protocol.text), {}};
    for (const IncludedText& file : protocol.included)
        header.protocol.included.push_back({file.name, file.text, hash_of_text(file.text)});
    header.dataset = recorded(protocol.dataset);
    for (const BlockSettings& block : protocol.blocks)
        header.blocks.push_back(block.id);
    header.schedule = schedule;
    header.started_utc = utc_now();
    header.clock = clock;
    header.program = this_build();
    header.graphics = {std::string(name_of(graphics.kind)), graphics.vendor, graphics.renderer,
                       graphics.version};
    header.tracker = tracker;
    header.display = {screen_geometry_of(protocol), protocol.display.refresh_hz,
                      from_seconds(1e-3 * protocol.display.latency_ms),
                      std::string(name_of(protocol.display.output)), protocol.display.background};
    if (protocol.stereo.is_on()) {
        header.display.stereo = name_of(protocol.stereo.kind);
        header.display.interocular_mm = protocol.stereo.interocular_mm;
    }
    for (const Slot& slot : protocol.slots) {
        const ScreenGeometry at = slot_geometry(protocol, slot);
        header.slots.push_back({slot.id, slot.title, at.image_origin_px, at.image_px});
    }
    header.characterisation = recorded(protocol.display.characterisation);
    header.animations.assign(protocol.motions.begin(), protocol.motions.end());
    header.poses = library.cache().poses();
    for (const Task& task : protocol.tasks)
        header.tasks.push_back({task.id, task.question});
    for (const Stimulus& stimulus : stimuli_in_slots(protocol))
        header.stimuli.push_back({stimulus, library.source_of(stimulus),
                                  with_frames ? library.frames_hash(stimulus) : ContentHash(),
                                  library.made_from_hash(stimulus),
                                  with_frames ? library.renderer_of(stimulus) : std::string()});
    describe_objects(header, protocol, objects, library, with_prepared_maps);
    record_points(header, objects);
    for (std::size_t list = 0; list < stimulus_lists.size(); ++list)
        record_entries(header, list, entries_of(protocol, list));
    return header;
}

namespace {

void put_all_files(const SessionDirectory& directory, const SessionHeader& header,
                   std::span<const Object> objects, const StimulusLibrary& library, bool with_pictures) {
    for (std::size_t i = 0; i < objects.size(); ++i) {
        if (!objects[i].has_mesh())
            continue;
        const std::filesystem::path file = directory.path() / header.objects[i].mesh_file;
        if (std::filesystem::exists(file))
            continue;
        std::filesystem::create_directories(file.parent_path());
        write_ply(file, objects[i].mesh);
    }
    for (const RecordedMap& map : header.maps)
        if (!std::filesystem::exists(directory.path() / map.file))
            copy_into(library.cache().map_file(map.viewed, map.pose), directory.path() / map.file);
    for (const RecordedStimulus& stimulus : header.stimuli) {
        // Without a surface there is nothing to ask of it.
        if (header.camera_of(stimulus.stimulus).vertical_fov.value > 0.0) {
            if (const auto light = library.light_file(stimulus.stimulus, with_pictures))
                copy_into(*light, directory.path() / light_file(header, stimulus.stimulus));
        }
        if (!with_pictures)
            continue;
        copy_into(library.first_frame_file(stimulus.stimulus),
                  directory.path() / preview_file(header, stimulus.stimulus));
    }
    write_to(directory.path() / "protocol.toml", header.protocol.text);
    for (const RecordedProtocol::Included& included : header.protocol.included) {
        // Beside the copy of the protocol as it was beside the protocol. What lay outside of its folder is in
        // the session file alone, and so are the names of files that a pattern stands for.
        const std::filesystem::path name = included.name;
        if (name.is_absolute() || included.name.starts_with("..") || is_pattern(name))
            continue;
        std::filesystem::create_directories((directory.path() / name).parent_path());
        write_to(directory.path() / name, included.text);
    }
    create_session_file(directory.session_file(), header);
    begin_manifest(directory.path(), header, this_program());
}

} // namespace

void put_files(const SessionDirectory& directory, const SessionHeader& header,
               std::span<const Object> objects, const StimulusLibrary& library, bool with_pictures) {
    try {
        put_all_files(directory, header, objects, library, with_pictures);
    } catch (const std::exception& error) {
        throw RecordError(
            fmt::format("{}\nThe session was not begun, and nothing is left of it. Make room on the "
                        "disk or name another folder with --sessions, then run it again.",
                        error.what()));
    }
}

void share_file(const std::filesystem::path& session, const std::filesystem::path& further,
                const std::string& name) {
    std::error_code error;
    std::filesystem::create_directories((further / name).parent_path(), error);
    if (!error)
        std::filesystem::create_hard_link(session / name, further / name, error);
    if (error)
        copy_into(session / name, further / name);
}

void put_further_record(const std::filesystem::path& session, const SessionHeader& further) {
    const std::filesystem::path folder = further_record(session, further.further_tracker);
    for (const std::string& name : files_of_session(session, false))
        share_file(session, folder, name);
    create_session_file(folder / session_file_name, further);
    begin_manifest(folder, further, this_program());
}

std::vector<RecordedMap> record_live_maps(std::vector<LiveMap> maps, const std::filesystem::path& folder,
                                          const SessionHeader& header) {
    std::erase_if(maps, [&](const LiveMap& map) {
        return std::any_of(header.maps.begin(), header.maps.end(), [&](const RecordedMap& recorded) {
            return recorded.viewed == map.viewed && recorded.pose == map.pose;
        });
    });
    std::vector<RecordedMap> recorded(maps.size());
    parallel_for(static_cast<int>(maps.size()), [&](int i) {
        const LiveMap& map = maps[static_cast<std::size_t>(i)];
        const RecordedObject& object = header.objects[static_cast<std::size_t>(map.viewed.object)];
        const std::string name = map_name(object.id, map.viewed, object.cameras.size(), map.pose);
        const std::filesystem::path file = folder / name;
        std::filesystem::create_directories(file.parent_path());
        const double angle_deg = header.poses.angles[static_cast<std::size_t>(map.pose.value)].angle.value;
        write_triangle_map(
            file, map.map,
            {{"mesh_sha256", object.mesh_sha256}, {"angle_deg", fmt::format("{}", angle_deg)}});
        recorded[static_cast<std::size_t>(i)] = {map.viewed, map.pose, name, hash_of_file(file),
                                                 RecordedMap::Made::live};
    });
    return recorded;
}

} // namespace overt
