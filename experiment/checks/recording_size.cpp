#include "experiment/checks/recording_size.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "experiment/animation.h"
#include "experiment/base/bytes_in_words.h"
#include "experiment/maps/light_pictures.h"
#include "experiment/protocol/all_stimuli.h"

namespace overt {

namespace {

// Measured in session.sqlite: 41.4 bytes for each of 492,920 samples, 51.5 for each of 28,800 flips.
constexpr double bytes_per_sample = 42.0, bytes_per_flip = 52.0;
// The same of a flip's row for a further slot: key, three small numbers.
constexpr double bytes_per_slot_flip = 16.0;
constexpr double bytes_at_first = 300e3; ///< of a record without rows, protocol and manifest
constexpr double bytes_per_px = 0.5;
// Binary PLY: three float32; a count, three numbers of 32 bits and a part.
constexpr double bytes_per_vertex = 12.0, bytes_per_triangle = 14.0;

} // namespace

RecordingSize recording_size(const Protocol& protocol, std::span<const Object> objects, int trials,
                             double answer_s) {
    // As if all trials had the longest motion.
    const std::vector<PageCycle> cycles = page_cycles(protocol);
    const PageCycle& cycle = std::ranges::max(cycles, {}, &PageCycle::total_refreshes);
    const double recorded_s =
        cycle.total_refreshes / protocol.display.refresh_hz + 2.0 * protocol.screens.recording_lead_s;
    // Each tracker's record has the flips as well.
    std::size_t slots = 1;
    for (int task = 0; task < static_cast<int>(protocol.tasks.size()); ++task)
        slots = std::max(slots, slots_of_task(protocol, task).size());
    const double flip_bytes =
        cycle.total_refreshes * (bytes_per_flip + bytes_per_slot_flip * static_cast<double>(slots - 1));
    const auto bytes_of = [&](const TrackerSettings& tracker) {
        return recorded_s * (row_of(tracker.kind).measures_gaze ? tracker.rate_hz : 0.0) * bytes_per_sample +
               flip_bytes;
    };
    double trial_bytes = bytes_of(protocol.tracker);
    for (const FurtherTrackerSettings& further : protocol.further_trackers)
        trial_bytes += bytes_of(further);
    const double records = 1.0 + static_cast<double>(protocol.further_trackers.size());
    const auto object_count = static_cast<double>(objects.size());
    // Objects that are frames only have no maps.
    double mapped = 0.0;
    for (std::size_t i = 0; i < objects.size(); ++i)
        mapped += objects[i].has_mesh() || (i < protocol.objects.size() && !protocol.objects[i].lut.empty());
    // One picture, and one of its light, in each view at each size that slots have.
    double picture_bytes = 0.0, light_bytes = 0.0;
    for (std::size_t i = 0; i < protocol.views_at_all_sizes(); ++i) {
        const ViewSettings& view = protocol.view_at(static_cast<int>(i));
        const glm::ivec2 image_px(view.width_px, view.height_px);
        const LightPictures light{.image_px = image_px, .square_px = light_square_px(image_px)};
        picture_bytes += bytes_per_px * image_px.x * image_px.y;
        light_bytes += bytes_per_px * static_cast<double>(light.squares());
    }
    RecordingSize size;
    // SQLite's log holds a trial's rows until they are in the file.
    size.rows = records * bytes_at_first + (trials + 1) * trial_bytes;
    size.maps = picture_bytes * mapped * poses_of(protocol).count();
    const auto per_object =
        static_cast<double>(protocol.materials.size() * protocol.lights.size() * protocol.backgrounds.size());
    for (const Animation& motion : protocol.motions)
        size.pictures += per_object * (picture_bytes * object_count +
                                       light_bytes * mapped * static_cast<double>(motion.pictures().size()));
    std::set<const Mesh*> meshes; // each is kept once
    for (const Object& object : objects)
        if (meshes.insert(&*object.mesh).second)
            size.meshes += bytes_per_vertex * static_cast<double>(object.mesh->positions.size()) +
                           bytes_per_triangle * static_cast<double>(object.mesh->triangles.size());
    if (protocol.answers.record != AnswerUse::none)
        size.answers =
            trials * std::clamp(answer_s, protocol.screens.response_min_s, protocol.screens.response_max_s) *
            protocol.answers.sample_rate_hz * protocol.answers.bits / 8.0;
    return size;
}

std::string to_text(const RecordingSize& size) {
    std::string parts;
    const auto add = [&](const char* what, double bytes) {
        if (bytes > 0.0)
            parts += fmt::format("{}{} {}", parts.empty() ? "" : ", ", what, in_bytes(bytes));
    };
    add("gaze and flips", size.rows);
    add("maps", size.maps);
    add("meshes", size.meshes);
    add("pictures", size.pictures);
    add("spoken answers", size.answers);
    return fmt::format("{}: {}", in_bytes(size.total()), parts);
}

nlohmann::ordered_json to_json(const RecordingSize& size) {
    return {{"gaze_and_flips_bytes", size.rows}, {"maps_bytes", size.maps},
            {"meshes_bytes", size.meshes},       {"pictures_bytes", size.pictures},
            {"answers_bytes", size.answers},     {"total_bytes", size.total()}};
}

} // namespace overt
