#include "experiment/record/header_checks.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <span>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/path_inside.h"

namespace overt {
namespace {

/// Finite, too.
bool is_within(double number, double least, double most) { return number >= least && number <= most; }

bool is_screen(const ScreenGeometry& screen) {
    constexpr int most_px = 100'000;
    constexpr double most_mm = 1e6;
    const auto are_pixels = [](glm::ivec2 px) {
        return px.x > 0 && px.x <= most_px && px.y > 0 && px.y <= most_px;
    };
    return are_pixels(screen.screen_px) && are_pixels(screen.image_px) &&
           std::abs(static_cast<std::int64_t>(screen.image_origin_px.x)) <= most_px &&
           std::abs(static_cast<std::int64_t>(screen.image_origin_px.y)) <= most_px &&
           is_within(screen.screen_mm.x, 0.0, most_mm) && is_within(screen.screen_mm.y, 0.0, most_mm) &&
           is_within(screen.viewing_distance_mm, 0.0, most_mm);
}

/// A presentation must be one that can be laid out refresh by refresh.
bool is_animation(const Animation& animation, double refresh_hz) {
    constexpr double most_refreshes = 1e7;
    // Where a recording was imported, no rate is known.
    return (refresh_hz == 0.0 || is_within(refresh_hz, 0.1, 1e5)) &&
           is_within(animation.frame_rate_hz, 1e-3, 1e5) && is_within(animation.duration_s, 0.0, 1e6) &&
           is_within(animation.amplitude.value, -1e6, 1e6) && is_within(animation.angle.value, -1e6, 1e6) &&
           is_within(animation.light_amplitude.value, -1e6, 1e6) &&
           is_within(animation.frame_count, 1, 1e6) && animation.duration_s * refresh_hz <= most_refreshes &&
           animation.duration_s * animation.frame_rate_hz <= most_refreshes &&
           animation.frame_count / animation.frame_rate_hz * refresh_hz <= most_refreshes;
}

/// With a pose for each frame of each motion.
bool is_pose_table(const PoseTable& poses, std::span<const Animation> animations) {
    if (poses.angles.empty() || poses.of_motion.size() != animations.size())
        return false;
    for (std::size_t motion = 0; motion < animations.size(); ++motion) {
        const std::vector<PoseIndex>& frames = poses.of_motion[motion];
        const auto is_pose = [&](PoseIndex pose) { return pose.value >= 0 && pose.value < poses.count(); };
        if (frames.size() != static_cast<std::size_t>(animations[motion].frame_count) ||
            !std::ranges::all_of(frames, is_pose))
            return false;
    }
    return true;
}

template <class Items> bool is_index(int index, const Items& items) {
    return index >= 0 && static_cast<std::size_t>(index) < items.size();
}

/// `entries`: how many each list has.
bool is_stimulus(const Stimulus& stimulus, const SessionHeader& header,
                 const std::array<std::size_t, stimulus_lists.size()>& entries) {
    for (std::size_t list = 0; list < stimulus_lists.size(); ++list)
        if (const int index = stimulus.*stimulus_lists[list].index;
            index < 0 || static_cast<std::size_t>(index) >= entries[list])
            return false;
    return is_index(stimulus.motion, header.animations) && is_index(stimulus.object, header.objects) &&
           is_index(stimulus.view, header.objects[static_cast<std::size_t>(stimulus.object)].cameras);
}

bool is_label(const std::string& label) {
    return !label.empty() && std::all_of(label.begin(), label.end(), [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) != 0;
    });
}

} // namespace

void check_header(const SessionHeader& header, const std::filesystem::path& file) {
    constexpr std::chrono::hours longest_latency{1};
    const auto counts = entry_counts(header);
    const auto demand = [&](bool holds, std::string_view what) {
        if (!holds)
            throw RecordError(fmt::format("{}: {} of the session cannot be right: the file is damaged.",
                                          file.string(), what));
    };
    demand(is_label(header.schedule.observer.label), "the observer's label");
    demand(is_screen(header.display.screen), "the screen");
    for (const Animation& animation : header.animations)
        demand(is_animation(animation, header.display.refresh_hz),
               "the animation, or the display's refresh rate,");
    demand(header.display.latency <= longest_latency && header.display.latency >= -longest_latency,
           "the display's latency");
    demand(is_within(header.tracker.sample_rate_hz, 0.0, 1e6), "the tracker's rate");
    demand(is_pose_table(header.poses, header.animations), "the table of poses");
    // They name folders and files of exports, and files that are read.
    // An imported session may have none.
    demand(header.protocol.name.empty() || is_plain_name(header.protocol.name), "the protocol's name");
    for (const RecordedObject& object : header.objects)
        demand(is_plain_name(object.id) && (object.mesh_file.empty() || stays_inside(object.mesh_file)),
               fmt::format("the id or the mesh file of object \"{}\"", object.id));
    for (const RecordedMap& map : header.maps) {
        demand(stays_inside(map.file), fmt::format("the map file \"{}\"", map.file));
        demand(is_index(map.viewed.object, header.objects) && is_index(map.pose.value, header.poses.angles) &&
                   is_index(map.viewed.view,
                            header.objects[static_cast<std::size_t>(map.viewed.object)].cameras),
               fmt::format("the object or the pose of map \"{}\"", map.file));
    }
    for (const RecordedStimulus& stimulus : header.stimuli) {
        Stimulus of_list = stimulus.stimulus;
        of_list.view %= static_cast<int>(std::max<std::size_t>(1, header.views.size()));
        demand(is_stimulus(of_list, header, counts) &&
                   is_index(stimulus.stimulus.view,
                            header.objects[static_cast<std::size_t>(of_list.object)].cameras),
               "the object or the material of a stimulus");
    }
    for (const RecordedObject& object : header.objects)
        demand(header.display.stereo.empty() || object.cameras.size() >= 2 * header.views_of_an_eye(),
               fmt::format("the two eyes' cameras before object \"{}\"", object.id));
    for (const Trial& trial : header.schedule.trials)
        demand(is_index(trial.task, header.tasks) && is_stimulus(trial.stimulus, header, counts) &&
                   (header.blocks.empty() || is_index(trial.block, header.blocks)),
               fmt::format("the task, object, material or block of planned trial {}", trial.index + 1));
    for (const RecordedSlot& slot : header.slots) {
        const glm::ivec2 end = slot.origin_px + slot.size_px, screen = header.display.screen.screen_px;
        const bool is_on_screen = slot.origin_px.x >= 0 && slot.origin_px.y >= 0 && slot.size_px.x > 0 &&
                                  slot.size_px.y > 0 && end.x <= screen.x && end.y <= screen.y;
        // The only one is where the image is, which an imported session may not know.
        demand(is_plain_name(slot.id) && (header.slots.size() == 1 || is_on_screen),
               fmt::format("the id or the place of slot \"{}\"", slot.id));
    }
    for (const Trial& trial : header.schedule.trials)
        for (std::size_t i = 0; i < trial.shown_count(); ++i)
            demand(is_index(trial.shown(i).slot, header.slots) &&
                       is_stimulus(trial.shown(i).stimulus, header, counts),
                   fmt::format("a slot, or what is in it, of planned trial {}", trial.index + 1));
    const auto have_plain_names = [](const auto& entries) {
        return std::ranges::all_of(entries, [](const auto& entry) { return is_plain_name(entry.id); });
    };
    demand(have_plain_names(header.tasks), "the id of a task");
    for (std::size_t list = 0; list < stimulus_lists.size(); ++list) {
        demand(have_plain_names(entries_of(header, list)),
               fmt::format("the id of a {}", stimulus_lists[list].name));
        for (const ListEntry& entry : entries_of(header, list))
            for (const NamedWord& column : entry.columns)
                demand(is_plain_name(column.name), fmt::format("a column of {}", entry.id));
    }
}

} // namespace overt
