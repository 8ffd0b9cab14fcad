#include "experiment/checks/protocol_checks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "experiment/protocol/all_stimuli.h"
#include "experiment/protocol/entry_ids.h"
#include "experiment/protocol/keys/protocol_keys.h"
#include "experiment/scene/areas.h"
#include "experiment/spectra/metal_table.h"
#include "experiment/stimulus/object.h"
#include "experiment/table_columns.h"

namespace overt {

namespace {

std::string entry_path(std::string_view list, std::size_t index, std::string_view key = {}) {
    return key.empty() ? fmt::format("{}[{}]", list, index) : fmt::format("{}[{}].{}", list, index, key);
}

void check_list(ProtocolExamination& examination, std::string_view list,
                const std::vector<std::string_view>& ids) {
    // Indices into the lists travel as bytes in records and textures, 255 meaning none.
    constexpr std::size_t most_entries = 254;
    if (ids.size() > most_entries) {
        examination.error({entry_path(list, most_entries)},
                          fmt::format("more than {} entries of [[{}]]", most_entries, list));
    }
    check_ids_differ(examination, list, ids);
}

bool is_column_name(std::string_view name) {
    return !name.empty() && name.front() >= 'a' && name.front() <= 'z' &&
           std::ranges::all_of(name, [](char letter) {
               return (letter >= 'a' && letter <= 'z') || (letter >= '0' && letter <= '9') || letter == '_';
           });
}

void check_columns(ProtocolExamination& examination, std::size_t list);

/// One of the lists that stimuli are made of. Its only entry may be without an id (name_entries).
void check_entries(ProtocolExamination& examination, std::size_t list) {
    const std::string_view name = stimulus_lists[list].name;
    std::vector<std::string_view> ids;
    for (const ListEntry* entry : entries_of(std::as_const(examination.protocol), list)) {
        const std::string id = entry_path(name, ids.size(), "id");
        const bool has_id = examination.is_written(id) || examination.faulty.contains(id);
        ids.push_back(has_id ? std::string_view(entry->id) : std::string_view());
    }
    check_list(examination, name, ids);
    check_columns(examination, list);
}

/// Words or numbers, the same in all entries; a name that no other list and no table has.
void check_columns(ProtocolExamination& examination, std::size_t list) {
    const Protocol& protocol = examination.protocol;
    std::map<std::string, std::pair<std::string, bool>, std::less<>> known; // path of the first, is a number
    const auto entries = entries_of(protocol, list);
    for (std::size_t i = 0; i < entries.size(); ++i) {
        for (const NamedWord& column : entries[i]->columns) {
            const std::string path = entry_path(stimulus_lists[list].name, i, "columns." + column.name);
            const auto [first, is_new] =
                known.try_emplace(column.name, std::pair(path, column.number.has_value()));
            if (!is_new && first->second.second != column.number.has_value())
                examination.error({path},
                                  fmt::format("the column \"{}\" has a {} here and a {} in {}", column.name,
                                              column.number ? "number" : "word",
                                              column.number ? "word" : "number",
                                              examination.line_of(first->second.first, path)),
                                  "a column holds words or numbers, not both");
            if (!is_new)
                continue;
            if (!is_column_name(column.name))
                examination.error({path}, fmt::format("\"{}\" is no name for a column", column.name),
                                  "letters a to z, digits and _, beginning with a letter");
            else if (is_name_of_factor(column.name) || is_column_of_tables(column.name))
                examination.error(
                    {path}, fmt::format("tables have a column \"{}\" already", column.name),
                    fmt::format(
                        "call it otherwise; in place of a series of it write an entry for each value, "
                        "with the number in a column of another name: columns = {{ {} = 30 }}",
                        column.name == "angle_deg" ? "turned_deg" : "my_" + column.name));
            for (std::size_t earlier = 0; earlier < list; ++earlier)
                for (const ListEntry* other : entries_of(protocol, earlier))
                    if (std::ranges::find(other->columns, column.name, &NamedWord::name) !=
                        other->columns.end())
                        examination.error({path},
                                          fmt::format("entries of [[{}]] have a column \"{}\", too",
                                                      stimulus_lists[earlier].name, column.name),
                                          "call one of them otherwise");
        }
    }
}

bool is_covered_by_frames(const Protocol& protocol, std::size_t object) {
    return !protocol.materials.empty() &&
           std::ranges::all_of(all_stimuli(protocol), [&](const Stimulus& stimulus) {
               return stimulus.object != static_cast<int>(object) || find_frames(protocol, stimulus);
           });
}

/// Warns of keys that are written though they have no effect without another.
void check_idle_keys(ProtocolExamination& examination, std::size_t index,
                     std::initializer_list<std::string_view> keys, const char* without, const char* remark) {
    for (const std::string_view key : keys) {
        const std::string path = entry_path("object", index, key);
        if (examination.is_written(path))
            examination.warning({path}, fmt::format("\"{}\" has no effect without {}", key, without), remark);
    }
}

/// Whether a path has one group of # for a number; if not, reports it.
void check_numbered_path(ProtocolExamination& examination, const std::string& path, const std::string& files,
                         const char* example) {
    const std::size_t begin = files.find('#');
    const std::size_t end = begin == std::string::npos ? begin : files.find_first_not_of('#', begin);
    if (begin != std::string::npos && (end == std::string::npos || files.find('#', end) == std::string::npos))
        return;
    examination.error({path}, "the path needs one group of # for the digits of the frame number", example);
    examination.faulty.insert(path);
}

/// Ready-made maps: what they are maps of must be shown ready-made, too, and their box must be whole.
void check_lut(ProtocolExamination& examination, std::size_t index) {
    const auto path = [&](std::string_view key) { return entry_path("object", index, key); };
    const ObjectSettings& object = examination.protocol.objects[index];
    check_numbered_path(examination, path("lut"), object.lut, "such as \"maps/frame_####.png\"");
    if (!is_covered_by_frames(examination.protocol, index)) {
        examination.error(
            {path("lut")},
            fmt::format("object \"{}\" has maps, but not [[frames]] for every material", object.id),
            "without a mesh nothing can be rendered");
    }
    // Their files have the numbers of one motion's frames.
    for (const auto& [list, entries] : {std::pair{"motion", examination.protocol.motions.size()},
                                        std::pair{"view", examination.protocol.views.size()}}) {
        if (entries > 1)
            examination.error({path("lut"), entry_path(list, 1)},
                              fmt::format("ready-made maps are of one {0}, and the protocol has {1}: nothing "
                                          "says of which the maps of \"{2}\" are",
                                          list, entries, object.id),
                              "give the mesh, from which maps are made for all");
    }
    if (object.lut_min.has_value() != object.lut_max.has_value()) {
        examination.error({path("lut_min"), path("lut_max")}, "a box needs both \"lut_min\" and \"lut_max\"");
    } else if (object.lut_min && glm::any(glm::greaterThan(*object.lut_min, *object.lut_max))) {
        examination.error({path("lut_min"), path("lut_max")},
                          "a coordinate of \"lut_min\" is larger than that of \"lut_max\"");
    }
}

/// An object that nothing is known of but its pictures.
void check_shapeless(ProtocolExamination& examination, std::size_t index) {
    const std::string& id = examination.protocol.objects[index].id;
    const std::string entry = entry_path("object", index);
    if (is_covered_by_frames(examination.protocol, index)) {
        examination.warning({entry},
                            fmt::format("object \"{}\" has frames, but no shape: gaze on it cannot be "
                                        "projected to its surface",
                                        id),
                            "give the \"mesh\" that the frames were rendered from, or maps, \"lut\"");
    } else {
        examination.error({entry}, fmt::format("object \"{}\" has neither \"shipped\" nor \"mesh\"", id),
                          "or [[frames]] for every material");
    }
}

/// What the numbers of ready-made frames mean.
void check_frame_colours(ProtocolExamination& examination, std::size_t index) {
    const auto path = [&](std::string_view key) { return entry_path("frames", index, key); };
    const FrameSequenceSettings& sequence = examination.protocol.frames[index];
    if (sequence.colour_space == FrameColours::xyz && sequence.encoding == FrameEncoding::srgb)
        examination.error({path("encoding"), path("colour_space")}, "XYZ are not encoded as sRGB",
                          "encoding = \"linear\"");
    if (!sequence.background_colour && examination.is_written(path("background_tolerance")))
        examination.warning({path("background_tolerance")},
                            "\"background_tolerance\" has no effect without \"background_colour\"");
}

/// The path of an area's key, under whichever name of the table it was written.
std::string area_path(const ProtocolExamination& examination, std::size_t object, const std::string& area) {
    const std::string path = entry_path("object", object, fmt::format("areas.{}", area));
    return examination.is_written(path) ? path : entry_path("object", object, area);
}

void check_areas(ProtocolExamination& examination, std::size_t index) {
    const ObjectSettings& object = examination.protocol.objects[index];
    const std::string areas = entry_path("object", index, "areas"),
                      head = entry_path("object", index, "head");
    for (std::size_t i = 0; i < object.areas.size(); ++i) {
        const AreaSettings& area = object.areas[i];
        const std::string path = area_path(examination, index, area.name);
        for (std::size_t before = 0; before < i; ++before) {
            if (object.areas[before].name == area.name)
                examination.error({head, path}, fmt::format("\"{}\" is described twice", area.name),
                                  "write it either as \"head\" or in \"areas\"");
        }
        if (!area.rectangles.empty() || !area.discs.empty()) {
            examination.error({path},
                              "\"rectangles\" and \"discs\" lie on a flat picture, and this is a shape",
                              "give spheres, boxes, groups or planes");
            continue;
        }
        const bool is_anywhere = !area.spheres.empty() || !area.boxes.empty() || !area.groups.empty();
        const bool is_said =
            std::ranges::any_of(std::array{"spheres", "boxes", "groups", "planes"}, [&](const char* key) {
                return examination.is_written(fmt::format("{}.{}", path, key));
            });
        if (!is_anywhere && area.planes.empty() && !is_said)
            examination.error({path}, fmt::format("nothing says where \"{}\" is", area.name),
                              "give it \"spheres\", \"boxes\", \"groups\" or \"planes\"");
        else if (!is_anywhere && !area.planes.empty() && area.name == head_area)
            examination.warning({path}, "\"planes\" alone make no head", "give \"spheres\" that hold it");
        if (!object.lut.empty() && !area.groups.empty())
            examination.error({path}, "ready-made maps have no groups", "give spheres, boxes or planes");
    }
    if (!object.lut.empty() && object.areas.size() > most_map_areas)
        examination.error({areas},
                          fmt::format("{} areas are described, and maps take {} at most", object.areas.size(),
                                      most_map_areas),
                          "take some out, or give the object's mesh in place of \"lut\"");
}

/// A flat picture: nothing else says what the object is, nothing turns it, and its areas lie on it.
void check_picture(ProtocolExamination& examination, std::size_t index) {
    const Protocol& protocol = examination.protocol;
    const ObjectSettings& object = protocol.objects[index];
    const auto path = [&](std::string_view key) { return entry_path("object", index, key); };
    for (const std::string_view key : {"shipped", "mesh", "lut"})
        if (examination.is_written(path(key)))
            examination.error({path("picture"), path(key)},
                              fmt::format("an object is either a \"picture\" or a \"{}\", not both", key),
                              "take one of the two lines out");
    check_idle_keys(examination, index,
                    {"up", "scale", "unit", "labels", "weld_tolerance", "lut_first_number", "lut_scale",
                     "lut_min", "lut_max"},
                    "\"mesh\"", "it describes a shape, and this is a picture");
    const bool is_numbered = object.picture.string().find('#') != std::string::npos;
    if (is_numbered)
        check_numbered_path(examination, path("picture"), object.picture.string(),
                            "such as \"film/frame_####.png\"");
    else
        check_idle_keys(examination, index, {"picture_first_number"}, "a \"picture\" with #",
                        "it is the number of a movie's first picture");
    for (std::size_t i = 0; i < protocol.motions.size(); ++i) {
        const MotionSettings& motion = protocol.motions[i];
        const std::string kind = entry_path("motion", i, "kind");
        if (motion.kind != MotionKind::still && motion.kind != MotionKind::movie)
            examination.error({kind, entry_path("motion", i), path("picture")},
                              fmt::format("a flat picture does not move, and the motion \"{}\" would move "
                                          "\"{}\"",
                                          motion.id, object.id),
                              "kind = \"still\", or \"movie\" for pictures one after the other");
    }
    const glm::dvec2 size_px(protocol.views.front().width_px, protocol.views.front().height_px);
    for (std::size_t i = 1; i < protocol.views.size(); ++i)
        if (glm::dvec2(protocol.views[i].width_px, protocol.views[i].height_px) != size_px)
            examination.error({entry_path("view", i), path("picture")},
                              fmt::format("the views \"{}\" and \"{}\" are of two sizes, and a picture is of "
                                          "one",
                                          protocol.views.front().id, protocol.views[i].id));
    for (const AreaSettings& area : object.areas) {
        const std::string place = area_path(examination, index, area.name);
        for (const std::string_view key : {"spheres", "boxes", "groups", "planes"})
            if (examination.is_written(fmt::format("{}.{}", place, key)))
                examination.error(
                    {fmt::format("{}.{}", place, key)},
                    fmt::format("\"{}\" describes places of a shape, and this is a picture", key),
                    "\"rectangles\" and \"discs\" are in pixels of the picture");
        for (const auto& [left, top, right, bottom] : area.rectangles)
            if (!(left < right && top < bottom && right > 0.0 && bottom > 0.0 && left < size_px.x &&
                  top < size_px.y))
                examination.error(
                    {fmt::format("{}.rectangles", place), place},
                    fmt::format(
                        "the rectangle [{}, {}, {}, {}] has nothing of the picture, which is {} x {} px",
                        left, top, right, bottom, size_px.x, size_px.y),
                    "left, top, right and bottom, from the top left corner");
        if (area.rectangles.empty() && area.discs.empty())
            examination.error({place}, fmt::format("nothing says where \"{}\" is", area.name),
                              "give it \"rectangles\" or \"discs\"");
    }
}

} // namespace

void check_ids(ProtocolExamination& examination) {
    check_list(examination, "task", ids_of<std::string_view>(examination.protocol.tasks));
    for (std::size_t list = 0; list < stimulus_lists.size(); ++list)
        check_entries(examination, list);
    // All of them are counted, task by task.
    constexpr double most_stimuli = 100000.0;
    double stimuli = 1.0;
    for (std::size_t list = 0; list < stimulus_lists.size(); ++list)
        stimuli *= static_cast<double>(ids_in_list(examination.protocol, list).size());
    if (stimuli > most_stimuli)
        examination.error({"object[0]"}, fmt::format("the lists make {:.0f} stimuli; {:.0f} is the most",
                                                     stimuli, most_stimuli));
}

void check_objects(ProtocolExamination& examination, std::span<const std::string_view> shipped_sculptures) {
    const Protocol& protocol = examination.protocol;
    for (std::size_t i = 0; i < protocol.objects.size(); ++i) {
        const ObjectSettings& object = protocol.objects[i];
        const std::string shipped = entry_path("object", i, "shipped"),
                          mesh = entry_path("object", i, "mesh"), lut = entry_path("object", i, "lut");
        const bool has_shipped = examination.is_written(shipped), has_mesh = examination.is_written(mesh),
                   has_lut = examination.is_written(lut);
        if (object.is_flat()) {
            check_picture(examination, i);
            continue;
        }
        if (has_shipped && has_mesh) {
            examination.error({mesh, shipped}, "an object is either \"shipped\" or a \"mesh\", not both",
                              "take one of the two lines out");
        } else if (has_lut && (has_shipped || has_mesh)) {
            examination.error({lut}, "\"lut\" stands instead of \"shipped\" or \"mesh\", not beside it",
                              "with a mesh, the maps are made from it, and more exactly");
        } else if (has_shipped && std::find(shipped_sculptures.begin(), shipped_sculptures.end(),
                                            object.shipped) == shipped_sculptures.end()) {
            examination.error({shipped}, fmt::format("overt has no sculpture \"{}\"", object.shipped),
                              suggest_name(object.shipped, shipped_sculptures));
        } else if (has_lut) {
            check_lut(examination, i);
        } else if (!has_shipped && !has_mesh) {
            check_shapeless(examination, i);
        }
        if (!has_mesh)
            check_idle_keys(examination, i, {"up", "scale", "unit", "labels", "weld_tolerance"}, "\"mesh\"",
                            "it describes the coordinates of a mesh file");
        if (!has_lut)
            check_idle_keys(examination, i, {"lut_first_number", "lut_scale", "lut_min", "lut_max"},
                            "\"lut\"", "it describes ready-made maps");
        if (!has_mesh && !has_lut)
            check_idle_keys(examination, i, {"head", "areas"}, "\"mesh\"",
                            "it describes places in a mesh file");
        else
            check_areas(examination, i);
    }
}

/// What stands behind an object is one thing.
void check_backgrounds(ProtocolExamination& examination) {
    for (std::size_t i = 0; i < examination.protocol.backgrounds.size(); ++i) {
        std::string_view first;
        for (const std::string_view key : {"grey", "colour", "picture"}) {
            const std::string path = entry_path("background", i, key);
            if (!examination.is_written(path))
                continue;
            if (!first.empty())
                examination.error({path},
                                  fmt::format("\"{}\" already says what is behind the object", first));
            else
                first = key;
        }
    }
}

namespace {

/// What is by the millimetre needs millimetres, and what is lit through needs light that can be met.
void check_translucent(ProtocolExamination& examination, std::size_t index) {
    const Protocol& protocol = examination.protocol;
    const std::string kind = entry_path("material", index, "kind");
    for (std::size_t i = 0; i < protocol.objects.size(); ++i)
        if (protocol.objects[i].unit == "own")
            examination.warning(
                {kind, entry_path("object", i, "unit")},
                "what is scattered and absorbed \"per_mm\" is by one of the mesh's own units, "
                "which are not known",
                "give the object's \"unit\"");
    for (std::size_t i = 0; i < protocol.lights.size(); ++i)
        if (protocol.lights[i].has_sources())
            examination.warning({kind, entry_path("light", i, "sun_lux"), entry_path("light", i, "lamps"),
                                 entry_path("light", i)},
                                "a sun or lamp is met by chance alone where light leaves a translucent body: "
                                "the smaller it is, the more noise",
                                "take large lamps or a probe, or more paths: [bake] target_error_de");
}

} // namespace

void check_materials(ProtocolExamination& examination) {
    std::set<std::string_view> keys;
    for (const MaterialKindRow& row : material_kinds)
        keys.insert(row.keys.begin(), row.keys.end());
    keys.erase(std::string_view()); // behind the last of each
    const std::vector<MaterialSettings>& materials = examination.protocol.materials;
    constexpr std::string_view metals[] = {"Au", "Ag"};
    for (std::size_t i = 0; i < materials.size(); ++i) {
        const std::string& metal = materials[i].metal;
        if (!is_metal_file(metal) &&
            std::find(std::begin(metals), std::end(metals), metal) == std::end(metals)) {
            examination.error(
                {entry_path("material", i, "metal")}, fmt::format("there is no metal \"{}\"", metal),
                "known are \"Au\" and \"Ag\"; for another give a table, a file that ends in .csv");
        }
        if (const std::string path = entry_path("material", i, "reflectance");
            materials[i].base == MaterialBase::own && row_of(materials[i].kind).has_key("base") &&
            examination.is_written(path))
            examination.warning({path, entry_path("material", i, "base")},
                                "\"reflectance\" has no effect on a material with base = \"own\"",
                                "its colour is that of the object's file");
        if (materials[i].anisotropy > 0.0 && materials[i].multiple_scattering)
            examination.error(
                {entry_path("material", i, "anisotropy"), entry_path("material", i, "multiple_scattering")},
                "a brushed metal is followed by one reflection at each meeting",
                "take one of the two lines out");
        if (materials[i].anisotropy > 0.0 && materials[i].clear_coat > 0.0)
            examination.error(
                {entry_path("material", i, "anisotropy"), entry_path("material", i, "clear_coat")},
                "a brushed metal has no clear coat", "take one of the two lines out");
        if (!(materials[i].clear_coat > 0.0) &&
            !examination.faulty.contains(entry_path("material", i, "clear_coat")) &&
            examination.is_written(entry_path("material", i, "clear_coat_roughness")))
            examination.warning({entry_path("material", i, "clear_coat_roughness")},
                                "\"clear_coat_roughness\" has no effect without \"clear_coat\"");
        if (materials[i].kind == MaterialKind::translucent)
            check_translucent(examination, i);
        if (!materials[i].film_nm && examination.is_written(entry_path("material", i, "film_ior")))
            examination.warning({entry_path("material", i, "film_ior")},
                                "\"film_ior\" has no effect without \"film_nm\"");
        const bool gives_any = materials[i].reflectance || materials[i].metallic || materials[i].roughness;
        if (!materials[i].of.empty() && materials[i].kind == MaterialKind::own && !gives_any)
            examination.warning({entry_path("material", i, "of")},
                                "\"of\" has no effect where nothing is given in place of what the file says",
                                "give \"roughness\", \"metallic\" or \"reflectance\"");
        for (const std::string_view key : keys) {
            const std::string path = entry_path("material", i, key), kind = entry_path("material", i, "kind");
            if (!row_of(materials[i].kind).has_key(key) && examination.is_written(path)) {
                examination.warning({path, kind},
                                    fmt::format("\"{}\" has no effect on a material of kind \"{}\"", key,
                                                name_of(materials[i].kind)));
            }
        }
    }
}

namespace {

/// Frames are of one light, motion and view: where there are several, they say which.
template <class Entry>
void check_choice_of_frames(ProtocolExamination& examination, std::size_t index, std::string_view list,
                            const std::string& id, const std::vector<Entry>& entries) {
    const std::string path = entry_path("frames", index, list);
    if (!id.empty()) {
        is_known(examination, path, fmt::format("[[{}]]", list), id, ids_of<std::string_view>(entries));
    } else if (entries.size() > 1) {
        examination.error({path, entry_path("frames", index)},
                          fmt::format("the frames do not say of which [[{}]] they are, and there are {}",
                                      list, entries.size()),
                          fmt::format("such as {} = \"{}\"", list, entries.front().id));
    }
}

} // namespace

void check_frames(ProtocolExamination& examination) {
    const Protocol& protocol = examination.protocol;
    const auto objects = ids_of<std::string_view>(protocol.objects),
               materials = ids_of<std::string_view>(protocol.materials);
    std::map<std::array<std::string, 5>, std::size_t> seen;
    for (std::size_t i = 0; i < protocol.frames.size(); ++i) {
        const FrameSequenceSettings& sequence = protocol.frames[i];
        if (sequence.picture_of >= 0)
            continue; // made of what was checked with its object
        is_known(examination, entry_path("frames", i, "object"), "[[object]]", sequence.object, objects);
        is_known(examination, entry_path("frames", i, "material"), "[[material]]", sequence.material,
                 materials);
        check_choice_of_frames(examination, i, "light", sequence.light, protocol.lights);
        check_choice_of_frames(examination, i, "motion", sequence.motion, protocol.motions);
        check_choice_of_frames(examination, i, "view", sequence.view, protocol.views);
        const auto [first, is_new] = seen.try_emplace(
            {sequence.object, sequence.material, sequence.light, sequence.motion, sequence.view}, i);
        if (!is_new) {
            examination.error(
                {entry_path("frames", i, "object"), entry_path("frames", i, "material")},
                fmt::format("\"{}\" in \"{}\" has frames already", sequence.object, sequence.material),
                fmt::format("from the [[frames]] in line {}",
                            protocol.places.of(entry_path("frames", first->second)).line));
        }
        check_numbered_path(examination, entry_path("frames", i, "files"), sequence.files,
                            "such as \"gold/frame_####.exr\"");
        check_frame_colours(examination, i);
    }
}

void check_bake(ProtocolExamination& examination) {
    const BakingSettings& bake = examination.protocol.bake;
    const DisplaySettings& display = examination.protocol.display;
    if (bake.quality == BakeQuality::live) {
        for (const std::string_view key :
             {"bake.samples", "bake.target_error_de", "bake.filter", "bake.filter_width_px", "bake.seed"}) {
            if (examination.is_written(key))
                examination.warning({key, "bake.quality"},
                                    fmt::format("\"{}\" has no effect on frames that OpenGL draws",
                                                key.substr(key.find('.') + 1)));
        }
    }
    if (bake.observer == StandardObserver::cie1931)
        return;
    if (display.characterisation_file.empty()) {
        examination.error({"bake.observer"},
                          "how CIE 2006 sees the display's light is not known without its spectra",
                          "name a characterisation with spectra with display.characterisation");
    } else if (display.characterisation && !display.characterisation->spectra) {
        examination.error(
            {"bake.observer", "display.characterisation"},
            fmt::format("{} has no spectra, without which its CIE 2006 colour cannot be computed",
                        display.characterisation_file.filename().string()),
            "measure them, and name the table with [light] spectra in that file");
    }
    if (bake.quality == BakeQuality::live)
        examination.error({"bake.observer", "bake.quality"}, "OpenGL draws for CIE 1931 only",
                          "choose another quality, such as \"preview\"");
}

} // namespace overt
