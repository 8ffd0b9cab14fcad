#include "experiment/protocol/protocol.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "experiment/protocol/entry_ids.h"

namespace overt {

Protocol protocol_of_further(const Protocol& protocol, std::size_t index) {
    Protocol further = protocol;
    const TrackerSettings& own = protocol.tracker;
    TrackerSettings& settings = further.tracker = protocol.further_trackers.at(index);
    // These are the session's, whichever tracker it has.
    settings.drift_limit_deg = own.drift_limit_deg;
    settings.on_drift = own.on_drift;
    settings.drift_checks = own.drift_checks;
    further.further_trackers.clear();
    return further;
}

namespace {

template <class Pointer, class OfProtocol>
std::vector<Pointer> pointers_to_entries(OfProtocol& protocol, std::size_t list) {
    std::vector<Pointer> entries;
    std::size_t at = 0;
    const auto take = [&](auto of_list) {
        if (at++ == list)
            for (auto& entry : protocol.*of_list)
                entries.push_back(&entry);
    };
    std::apply([&](auto... of_list) { (take(of_list), ...); }, entries_of_lists);
    return entries;
}

} // namespace

std::vector<const ListEntry*> entries_of(const Protocol& protocol, std::size_t list) {
    return pointers_to_entries<const ListEntry*>(protocol, list);
}

std::vector<ListEntry*> entries_of(Protocol& protocol, std::size_t list) {
    return pointers_to_entries<ListEntry*>(protocol, list);
}

std::vector<std::string_view> ids_in_list(const Protocol& protocol, std::size_t list) {
    std::vector<std::string_view> ids;
    for (const ListEntry* entry : entries_of(protocol, list))
        ids.push_back(entry->id);
    return ids;
}

Factors factors_of(const Protocol& protocol) {
    FactorSources sources;
    sources.tasks = ids_of(protocol.tasks);
    sources.blocks = ids_of(protocol.blocks);
    for (std::size_t list = 0; list < stimulus_lists.size(); ++list)
        for (const ListEntry* entry : entries_of(protocol, list))
            sources.lists[list].push_back(*entry);
    sources.own = own_levels_of(protocol);
    return Factors(sources);
}

std::array<std::vector<bool>, stimulus_lists.size()> chosen_by(const Protocol& protocol,
                                                               const SimulatedEffect& effect) {
    std::array<std::vector<bool>, stimulus_lists.size()> chosen;
    for (std::size_t list = 0; list < stimulus_lists.size(); ++list) {
        for (const ListEntry* entry : entries_of(protocol, list)) {
            // A column of another list says nothing here.
            const auto has = [&](const NamedWord& wanted) {
                const auto found = std::ranges::find(entry->columns, wanted.name, &NamedWord::name);
                return found != entry->columns.end() && found->text == wanted.text;
            };
            const auto is_here = [&](const NamedWord& wanted) {
                return std::ranges::any_of(entries_of(protocol, list), [&](const ListEntry* any) {
                    return std::ranges::find(any->columns, wanted.name, &NamedWord::name) !=
                           any->columns.end();
                });
            };
            chosen[list].push_back((effect.entries[list].empty() || effect.entries[list] == entry->id) &&
                                   std::ranges::all_of(effect.where, [&](const NamedWord& wanted) {
                                       return !is_here(wanted) || has(wanted);
                                   }));
        }
    }
    return chosen;
}

ScreenGeometry screen_geometry_of(const Protocol& protocol) {
    const DisplaySettings& display = protocol.display;
    ScreenGeometry geometry;
    geometry.screen_px = field_of(protocol, Eye::left).size_px;
    geometry.screen_mm = glm::dvec2(display.width_mm, display.height_mm) * glm::dvec2(geometry.screen_px) /
                         glm::dvec2(display.width_px, display.height_px);
    geometry.viewing_distance_mm = display.viewing_distance_mm;
    geometry.image_px = {protocol.views.front().width_px, protocol.views.front().height_px};
    geometry.image_origin_px = centred_origin_px(geometry.screen_px, geometry.image_px);
    const ViewSettings& view = protocol.views.front();
    // The pixel whose distance from the middle is seen under the angle: tan(angle) * distance.
    const auto px_of = [&](double deg, int axis) {
        return std::tan(to_radians({deg}).value) * geometry.viewing_distance_mm * geometry.screen_px[axis] /
               geometry.screen_mm[axis];
    };
    const auto first_px = [&](double centre_px, int axis) {
        return static_cast<int>(std::lround(centre_px - 0.5 * geometry.image_px[axis]));
    };
    if (view.left_px) {
        geometry.image_origin_px.x = *view.left_px;
    } else if (view.centre_right_deg) {
        geometry.image_origin_px.x = first_px(geometry.centre().x_px + px_of(*view.centre_right_deg, 0), 0);
    }
    if (view.top_px) {
        geometry.image_origin_px.y = *view.top_px;
    } else if (view.centre_up_deg) {
        geometry.image_origin_px.y = first_px(geometry.centre().y_px - px_of(*view.centre_up_deg, 1), 1);
    }
    return geometry;
}

namespace {

/// The path with its #s replaced by a number, zeros in front.
std::filesystem::path numbered(const std::string& files, int number) {
    const std::size_t begin = files.find('#');
    if (begin == std::string::npos)
        return files;
    const std::size_t end = std::min(files.find_first_not_of('#', begin), files.size());
    return fmt::format("{}{:0{}}{}", files.substr(0, begin), number, end - begin, files.substr(end));
}

} // namespace

std::filesystem::path frame_file(const FrameSequenceSettings& sequence, AnimationFrameIndex frame) {
    return numbered(sequence.files, sequence.first_number + frame.value);
}

std::string place_of_frames(const Protocol& protocol, std::size_t index) {
    const int object = protocol.frames.at(index).picture_of;
    return object < 0 ? fmt::format("frames[{}].files", index) : fmt::format("object[{}].picture", object);
}

std::filesystem::path lut_file(const ObjectSettings& object, AnimationFrameIndex frame) {
    return numbered(object.lut, object.lut_first_number + frame.value);
}

const FrameSequenceSettings* find_frames(const Protocol& protocol, const Stimulus& stimulus) {
    const auto is_of = [](const std::string& id, const ListEntry& entry, std::size_t entries) {
        return id.empty() ? entries == 1 : id == entry.id;
    };
    const auto found = std::ranges::find_if(protocol.frames, [&](const FrameSequenceSettings& sequence) {
        return sequence.object == protocol.object_of(stimulus).id &&
               sequence.material == protocol.material_of(stimulus).id &&
               is_of(sequence.light, protocol.light_of(stimulus), protocol.lights.size()) &&
               is_of(sequence.motion, protocol.motion_of(stimulus), protocol.motions.size()) &&
               is_of(sequence.view, protocol.view_of(stimulus), protocol.views.size());
    });
    return found == protocol.frames.end() ? nullptr : &*found;
}

} // namespace overt
