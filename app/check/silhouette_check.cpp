#include "app/check/silhouette_check.h"

#include <algorithm>
#include <cmath>
#include <mutex>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/cli/progress_bar.h"
#include "experiment/base/error.h"
#include "experiment/base/parallel.h"
#include "experiment/maps/coordinate_image_file.h"
#include "experiment/protocol/all_stimuli.h"
#include "render/stimulus/ready_made_frames.h"

namespace overt {

namespace {

using Silhouette = std::vector<std::uint8_t>;

/// Area and middle of a silhouette.
struct Area {
    double pixels = 0.0;
    glm::dvec2 sum{0.0};

    void add(std::size_t index, int width_px) {
        const auto i = static_cast<int>(index);
        pixels += 1.0;
        sum += glm::dvec2(i % width_px, i / width_px);
    }
};

Silhouette silhouette_of_map(const StimulusLibrary& library, const ViewedObject& viewed, bool has_mesh,
                             PoseIndex pose) {
    Silhouette silhouette;
    if (has_mesh) {
        for (const std::uint32_t code : library.cache().read_map(viewed, pose).codes)
            silhouette.push_back(code != 0);
        return silhouette;
    }
    for (const glm::vec4& pixel : read_coordinate_image(library.cache().map_file(viewed, pose)).image.pixels)
        silhouette.push_back(pixel.w != 0.0f);
    return silhouette;
}

/// As match_silhouettes, with each pixel of the frame taken to where `place_of` has it.
double iou_with(std::span<const std::uint8_t> frame, std::span<const std::uint8_t> map,
                const auto& place_of) {
    std::size_t both = 0, either = 0;
    for (std::size_t i = 0; i < frame.size(); ++i) {
        const bool is_object = frame[place_of(i)] != 0, is_covered = map[i] != 0;
        both += is_object && is_covered;
        either += is_object || is_covered;
    }
    return either > 0 ? static_cast<double>(both) / static_cast<double>(either) : 1.0;
}

/// In words, the likeliest cause.
std::string hint_of(const SilhouetteMatch& match) {
    if (match.frame_share == 0.0)
        return "there is nothing but background in that frame: it is empty, or alpha, background_colour or "
               "background_tolerance leave nothing of it";
    if (match.frame_share == 1.0)
        return "there is no background in that frame: render with a transparent one, or give "
               "background_colour";
    if (match.mirrored_iou >= least_silhouette_iou)
        return "mirrored from left to right that frame would agree: an axis of the camera or mesh is turned "
               "round";
    if (match.upside_down_iou >= least_silhouette_iou)
        return "turned upside down that frame would agree: its rows are written from the bottom";
    std::string text = fmt::format(
        "there the frame's silhouette lies {:.1f} px {} and {:.1f} px {} of the map's and is {:.3f} times as "
        "large",
        std::abs(match.offset_px.x), match.offset_px.x < 0.0 ? "to the left" : "to the right",
        std::abs(match.offset_px.y), match.offset_px.y < 0.0 ? "above" : "below", match.size_ratio);
    return text + ": camera, angle or mesh differ, or what is background";
}

struct MatchedFrames {
    SequenceSilhouette result;
    bool has_silhouette = true;
};

MatchedFrames match_sequence(const Experiment& experiment, const FrameSequenceSettings& sequence,
                             const Stimulus& stimulus, const StimulusLibrary& library) {
    const Protocol& protocol = experiment.protocol;
    const int count = protocol.motion_of(stimulus).frame_count;
    const bool has_mesh = experiment.objects[static_cast<std::size_t>(stimulus.object)].has_mesh();
    MatchedFrames matched;
    matched.result.stimulus = stimulus_name(protocol, stimulus);
    std::vector<SilhouetteMatch> matches(static_cast<std::size_t>(count));
    std::mutex mutex;
    parallel_for(count, [&](int frame) {
        const auto pixels = object_pixels(sequence, {frame});
        if (!pixels) {
            const std::scoped_lock lock(mutex);
            matched.has_silhouette = false;
            return;
        }
        matches[static_cast<std::size_t>(frame)] =
            match_silhouettes(*pixels,
                              silhouette_of_map(library, viewed(stimulus), has_mesh,
                                                library.cache().poses().pose_of(stimulus.motion, {frame})),
                              protocol.view_of(stimulus).width_px);
    });
    std::size_t both = 0, either = 0;
    for (int frame = 0; frame < count; ++frame) {
        const SilhouetteMatch& match = matches[static_cast<std::size_t>(frame)];
        both += match.both;
        either += match.either;
        if (frame == 0 || match.iou < matched.result.worst.iou) {
            matched.result.worst = match;
            matched.result.worst_frame = frame;
        }
    }
    matched.result.iou = either > 0 ? static_cast<double>(both) / static_cast<double>(either) : 1.0;
    return matched;
}

} // namespace

SilhouetteMatch match_silhouettes(std::span<const std::uint8_t> frame, std::span<const std::uint8_t> map,
                                  int width_px) {
    OVERT_EXPECTS(frame.size() == map.size());
    SilhouetteMatch match;
    Area of_frame, of_map;
    for (std::size_t i = 0; i < frame.size(); ++i) {
        match.both += frame[i] && map[i];
        match.either += frame[i] || map[i];
        if (frame[i])
            of_frame.add(i, width_px);
        if (map[i])
            of_map.add(i, width_px);
    }
    if (match.either > 0)
        match.iou = static_cast<double>(match.both) / static_cast<double>(match.either);
    match.frame_share = frame.empty() ? 0.0 : of_frame.pixels / static_cast<double>(frame.size());
    const auto width = static_cast<std::size_t>(width_px);
    const std::size_t height = frame.size() / width;
    match.mirrored_iou =
        iou_with(frame, map, [&](std::size_t i) { return i - i % width + (width - 1 - i % width); });
    match.upside_down_iou =
        iou_with(frame, map, [&](std::size_t i) { return (height - 1 - i / width) * width + i % width; });
    if (of_frame.pixels > 0.0 && of_map.pixels > 0.0) {
        match.offset_px = of_frame.sum / of_frame.pixels - of_map.sum / of_map.pixels;
        match.size_ratio = std::sqrt(of_frame.pixels / of_map.pixels);
    }
    return match;
}

std::vector<SequenceSilhouette> check_silhouettes(const Experiment& experiment, StimulusLibrary& library,
                                                  Diagnostics& diagnostics) {
    const Protocol& protocol = experiment.protocol;
    std::vector<SequenceSilhouette> sequences;
    ProgressBar bar;
    const int count = static_cast<int>(protocol.frames.size());
    for (int i = 0; i < count; ++i) {
        const FrameSequenceSettings& sequence = protocol.frames[static_cast<std::size_t>(i)];
        if (sequence.picture_of >= 0)
            continue; // a picture fills its map
        const Stimulus stimulus = stimulus_of(protocol, sequence);
        const bool has_mesh = experiment.objects[static_cast<std::size_t>(stimulus.object)].has_mesh();
        if (!has_mesh && !library.cache().has_given_maps(stimulus.object))
            continue;
        if (has_mesh)
            library.maps().prepare_maps(viewed(stimulus), std::ref(bar));
        else
            library.maps().prepare_given_maps(std::ref(bar));
        bar.update("comparing silhouettes", i, count);
        const MatchedFrames matched = match_sequence(experiment, sequence, stimulus, library);
        const std::string key = fmt::format("frames[{}].files", i);
        if (!matched.has_silhouette) {
            diagnostics.warning(protocol.file.string(), protocol.places.of(key),
                                "the frames have no alpha: it cannot be told whether they show the object "
                                "where the hidden maps have it",
                                "give background_colour, or render with alpha");
            continue;
        }
        if (matched.result.worst.iou < least_silhouette_iou) {
            diagnostics.warning(
                protocol.file.string(), protocol.places.of(key),
                fmt::format("{} shows the object elsewhere than its hidden map: their silhouettes "
                            "have {:.1f} % of their pixels in common, {:.1f} % over all frames",
                            frame_file(sequence, {matched.result.worst_frame}).filename().string(),
                            100.0 * matched.result.worst.iou, 100.0 * matched.result.iou),
                hint_of(matched.result.worst));
        }
        sequences.push_back(matched.result);
    }
    if (count > 0)
        bar.update("comparing silhouettes", count, count);
    return sequences;
}

std::string to_text(const std::vector<SequenceSilhouette>& sequences) {
    if (sequences.empty())
        return {};
    std::string text = "\nSilhouettes of ready-made frames and of their hidden maps, pixels in common\n";
    std::size_t width = 8;
    for (const SequenceSilhouette& sequence : sequences)
        width = std::max(width, sequence.stimulus.size());
    text += fmt::format("  {:<{}}  {:>10}  {:>12}\n", "stimulus", width, "all frames", "worst frame");
    for (const SequenceSilhouette& sequence : sequences)
        text += fmt::format("  {:<{}}  {:>8.2f} %  {:>8.2f} % ({})\n", sequence.stimulus, width,
                            100.0 * sequence.iou, 100.0 * sequence.worst.iou, sequence.worst_frame);
    return text;
}

nlohmann::ordered_json to_json(const std::vector<SequenceSilhouette>& sequences) {
    auto list = nlohmann::ordered_json::array();
    for (const SequenceSilhouette& sequence : sequences)
        list.push_back({{"stimulus", sequence.stimulus},
                        {"iou", sequence.iou},
                        {"worst_frame", sequence.worst_frame},
                        {"worst_iou", sequence.worst.iou},
                        {"worst_offset_px", {sequence.worst.offset_px.x, sequence.worst.offset_px.y}},
                        {"worst_size_ratio", sequence.worst.size_ratio}});
    return list;
}

} // namespace overt
