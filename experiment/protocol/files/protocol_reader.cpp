#include "experiment/protocol/files/protocol_reader.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <fmt/format.h>

#include "experiment/keys/key_walk.h"
#include "experiment/protocol/files/flat_pictures.h"
#include "experiment/protocol/files/keyframes.h"
#include "experiment/protocol/files/old_words.h"
#include "experiment/protocol/files/recorded_courses.h"
#include "experiment/protocol/files/written_series.h"
#include "experiment/protocol/keys/protocol_keys.h"
#include "experiment/protocol/protocol_sources.h"
#include "experiment/spectra/metal_table.h"

namespace overt {

namespace {

/// The folder that a path counts from: that of the file in which it stands.
std::filesystem::path folder_of(const Protocol& protocol, std::string_view key_path) {
    if (protocol.places.is_written(key_path)) {
        const int number = protocol.places.of(key_path).file;
        for (const IncludedText& included : protocol.included) {
            if (number != 0 && included.number == number)
                return included.file.parent_path();
        }
    }
    return protocol.file.parent_path();
}

/// The files that a pattern stands for. Their names are kept beside the texts of included files, so that a
/// session is taken up, and replayed, with those that it was begun with.
std::optional<std::vector<std::string>> files_of(ProtocolExamination& examination,
                                                 const IncludeReader& reader, const std::string& pattern,
                                                 Place place) {
    Protocol& protocol = examination.protocol;
    std::filesystem::path folder = protocol.file.parent_path();
    for (const IncludedText& included : protocol.included)
        if (place.file != 0 && included.number == place.file)
            folder = included.file.parent_path();
    UnreadFile why_not;
    const IncludedText* const list = text_beside(protocol.included, protocol.file, folder / pattern, reader,
                                                 examination.diagnostics(), why_not);
    if (!list) {
        examination.diagnostics().error(protocol.file.string(), place,
                                        fmt::format("\"{}\": {}", pattern, why_not.message), why_not.hint);
        return std::nullopt;
    }
    std::vector<std::string> names;
    std::istringstream lines(list->text);
    for (std::string name; std::getline(lines, name);)
        names.push_back(name);
    return names;
}

/// Titles left out take the ids; paths become independent of the working directory of whoever reads on.
/// Of one motion.
constexpr int most_frames = 10000;

void complete(Protocol& protocol) {
    if (protocol.title.empty())
        protocol.title = protocol.name;
    for (std::size_t i = 0; i < protocol.observer_fields.size(); ++i)
        complete_field(protocol.observer_fields[i],
                       protocol.places.is_written(fmt::format("observer_field[{}].kind", i)));
    add_material_of_pictures(protocol);
    for (std::size_t list = 0; list < stimulus_lists.size(); ++list) {
        for (ListEntry* entry : entries_of(protocol, list)) {
            if (entry->id.empty() && protocol_keys().section(stimulus_lists[list].name).is_never_empty())
                entry->id = stimulus_lists[list].name;
            if (entry->title.empty())
                entry->title = entry->id;
        }
    }
    for (std::size_t i = 0; i < protocol.objects.size(); ++i) {
        ObjectSettings& object = protocol.objects[i];
        const auto folder = folder_of(protocol, fmt::format("object[{}]", i));
        if (!object.mesh.empty())
            object.mesh = folder / object.mesh;
        if (!object.labels.empty())
            object.labels = folder / object.labels;
        if (!object.lut.empty())
            object.lut = (folder / object.lut).string();
        if (!object.picture.empty())
            object.picture = folder / object.picture;
    }
    for (std::size_t i = 0; i < protocol.materials.size(); ++i) {
        MaterialSettings& material = protocol.materials[i];
        if (is_metal_file(material.metal))
            material.metal = (folder_of(protocol, fmt::format("material[{}]", i)) / material.metal).string();
    }
    for (std::size_t i = 0; i < protocol.frames.size(); ++i) {
        FrameSequenceSettings& sequence = protocol.frames[i];
        if (!sequence.files.empty())
            sequence.files = (folder_of(protocol, fmt::format("frames[{}]", i)) / sequence.files).string();
    }
    protocol.slots = written_out(protocol.slot_entries);
    fit_views_to_slots(protocol);
    add_views_of_eyes(protocol);
    // What is set to match stands in the only slot, if the task has only one.
    for (std::size_t task = 0; task < protocol.tasks.size(); ++task)
        if (const std::vector<int> slots = slots_of_task(protocol, static_cast<int>(task)); slots.size() == 1)
            for (TaskAnswer& answer : protocol.tasks[task].answers)
                if (answer.slot.empty())
                    answer.slot = protocol.slots[static_cast<std::size_t>(slots.front())].id;
    if (!protocol.display.characterisation_file.empty())
        protocol.display.characterisation_file =
            folder_of(protocol, "display.characterisation") / protocol.display.characterisation_file;
    for (std::size_t i = 0; i < protocol.motions.size(); ++i) {
        // What does not move has one frame.
        MotionSettings& motion = protocol.motions[i];
        if (!motion.moves() && !protocol.places.is_written(fmt::format("motion[{}].frame_count", i)))
            motion.frame_count = 1;
        // What the observer turns has a frame for each pose.
        if (motion.by_observer.has_elevations() &&
            !protocol.places.is_written(fmt::format("motion[{}].keys", i)))
            motion.by_observer.keys = {"left", "right", "up", "down"};
        if (motion.kind == MotionKind::observer)
            motion.frame_count = std::clamp(motion.by_observer.pose_count(), 1, most_frames);
    }
    for (std::size_t i = 0; i < protocol.backgrounds.size(); ++i) {
        std::string& picture = protocol.backgrounds[i].picture;
        if (!picture.empty())
            picture = (folder_of(protocol, fmt::format("background[{}].picture", i)) / picture).string();
    }
    for (std::size_t i = 0; i < protocol.lights.size(); ++i) {
        LightSettings& light = protocol.lights[i];
        if (light.is_file())
            light.probe = (folder_of(protocol, fmt::format("light[{}].probe", i)) / light.probe).string();
        for (const std::string& id : light.lamps)
            if (const auto found = std::ranges::find(protocol.lamps, id, &LampSettings::id);
                found != protocol.lamps.end())
                light.shining.push_back(*found);
    }
    complete_pictures(protocol);
    const std::vector<LightSettings> lights = protocol.lights;
    for (LightSettings& light : protocol.lights)
        for (const auto& [id, share] : light.sum)
            if (const auto found = std::ranges::find(lights, id, &LightSettings::id); found != lights.end())
                light.parts.push_back(*found);
}

/// Reads the table that a key of a task names; its text stands beside those of included files. -1 where there
/// is none.
int read_trial_table(ProtocolExamination& examination, const IncludeReader& reader, int task,
                     std::string_view key, const std::filesystem::path& file) {
    Protocol& protocol = examination.protocol;
    const std::string path = fmt::format("task[{}].{}", task, key);
    UnreadFile why_not;
    const IncludedText* const text =
        file.empty() ? nullptr
                     : text_beside(protocol.included, protocol.file, folder_of(protocol, path) / file, reader,
                                   examination.diagnostics(), why_not);
    if (!text) {
        if (!file.empty())
            examination.error({path}, fmt::format("trials \"{}\": {}", file.string(), why_not.message),
                              why_not.hint);
        return -1;
    }
    const std::string name = text->file.string();
    const auto table = parse_delimited(text->text, name, text->number, examination.diagnostics());
    protocol.trial_tables.push_back(
        table ? trial_table_of(*table, protocol, task, name, examination.diagnostics())
              : TrialTable{name, {}, {}});
    return static_cast<int>(protocol.trial_tables.size()) - 1;
}

void read_trial_tables(ProtocolExamination& examination, const IncludeReader& reader) {
    for (int i = 0; i < static_cast<int>(examination.protocol.tasks.size()); ++i) {
        Task& task = examination.protocol.tasks[static_cast<std::size_t>(i)];
        task.trials.table = read_trial_table(examination, reader, i, "trials", task.trials_file);
        task.catch_trials.table =
            read_trial_table(examination, reader, i, "catch.trials", task.catch_trials.trials_file);
    }
}

/// Reads the tables that motions of kind "keyframes" name; their texts stand beside those of included files.
void read_keyframes(ProtocolExamination& examination, const IncludeReader& reader) {
    Protocol& protocol = examination.protocol;
    for (std::size_t i = 0; i < protocol.motions.size(); ++i) {
        MotionSettings& motion = protocol.motions[i];
        if (motion.kind != MotionKind::keyframes || motion.keyframes.empty())
            continue;
        const std::string path = fmt::format("motion[{}].keyframes", i);
        UnreadFile why_not;
        const IncludedText* const text =
            text_beside(protocol.included, protocol.file, folder_of(protocol, path) / motion.keyframes,
                        reader, examination.diagnostics(), why_not);
        if (!text) {
            examination.error({path},
                              fmt::format("keyframes \"{}\": {}", motion.keyframes.string(), why_not.message),
                              why_not.hint);
            continue;
        }
        const std::string name = text->file.string();
        const auto table = parse_delimited(text->text, name, text->number, examination.diagnostics());
        if (!table)
            continue;
        if (!protocol.places.is_written(fmt::format("motion[{}].frame_count", i)))
            motion.frame_count = std::clamp(
                static_cast<int>(std::lround(seconds_of_keyframes(*table) * motion.frame_rate_hz)) + 1, 1,
                most_frames);
        motion.given = poses_of_keyframes(*table, motion, name, examination.diagnostics());
    }
}

/// Reads a table of courses; its text stands beside those of included files.
void read_courses_of(ProtocolExamination& examination, const IncludeReader& reader, std::size_t motion,
                     const std::string& file) {
    Protocol& protocol = examination.protocol;
    const std::string path = fmt::format("motion[{}].recorded", motion);
    UnreadFile why_not;
    const IncludedText* const text =
        text_beside(protocol.included, protocol.file, folder_of(protocol, path) / file, reader,
                    examination.diagnostics(), why_not);
    if (!text)
        return examination.error({path}, fmt::format("recorded \"{}\": {}", file, why_not.message),
                                 why_not.hint);
    const std::string name = text->file.string();
    const auto table = parse_delimited(text->text, name, text->number, examination.diagnostics());
    if (table)
        add_courses(*table, protocol.motions[motion], name, examination.diagnostics());
}

/// What motions of kind "recorded" show again. Left out, a presentation lasts as long as the longest of it.
void read_courses(ProtocolExamination& examination, const IncludeReader& reader) {
    Protocol& protocol = examination.protocol;
    for (std::size_t i = 0; i < protocol.motions.size(); ++i) {
        if (protocol.motions[i].kind != MotionKind::recorded)
            continue;
        for (const std::string& file : protocol.motions[i].recorded)
            read_courses_of(examination, reader, i, file);
        MotionSettings& motion = protocol.motions[i];
        if (motion.courses.empty())
            continue;
        motion.frame_count = static_cast<int>(motion.given.size());
        if (motion.frame_count > most_frames)
            examination.error({fmt::format("motion[{}].recorded", i)},
                              fmt::format("the tables have {} different poses, and a motion has up to {}",
                                          motion.frame_count, most_frames),
                              "round the angles, or take fewer recordings");
        if (!protocol.places.is_written(fmt::format("motion[{}].duration_s", i)))
            motion.duration_s =
                std::max(1.0,
                         std::ceil(
                             std::ranges::max_element(motion.courses, {}, &RecordedCourse::lasts_s)->lasts_s *
                                 motion.frame_rate_hz -
                             1e-6)) /
                motion.frame_rate_hz;
    }
}

} // namespace

bool read_written_keys(ProtocolExamination& examination, std::string_view text, const IncludeReader& reader) {
    Protocol& protocol = examination.protocol;
    Diagnostics& diagnostics = examination.diagnostics();
    protocol.text = text;
    diagnostics.quote_from(protocol.file.string(), text);
    JoinedToml joined = read_joined_toml(text, protocol.file, reader, diagnostics);
    protocol.included = std::move(joined.included);
    put_todays_words(joined.toml, protocol.file.string(), diagnostics);
    take_out_libraries(joined.toml, protocol.file.string(), diagnostics);
    write_out_series(
        joined.toml, protocol.file.string(),
        [&](const std::string& pattern, Place place) {
            return files_of(examination, reader, pattern, place);
        },
        diagnostics);
    name_entries(joined.toml);
    KeyWalk(protocol_keys(), protocol.file.string(), protocol.places, examination.faulty, diagnostics)
        .read(joined.toml, protocol);
    complete(protocol);
    if (joined.toml.is_whole)
        read_trial_tables(examination, reader);
    if (joined.toml.is_whole)
        read_keyframes(examination, reader);
    if (joined.toml.is_whole)
        read_courses(examination, reader);
    return joined.toml.is_whole;
}

} // namespace overt
