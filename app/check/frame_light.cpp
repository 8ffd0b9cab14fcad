#include "app/check/frame_light.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/cli/own_folders.h"
#include "app/cli/progress_bar.h"
#include "experiment/base/parallel.h"
#include "experiment/protocol/all_stimuli.h"
#include "render/gl/headless_context.h"
#include "render/stimulus/stimulus_library.h"

namespace overt {

std::vector<StimulusLight> measure_light(const Experiment& experiment) {
    const Protocol& protocol = experiment.protocol;
    const auto context = make_headless_context(std::nullopt);
    StimulusLibrary library(*context, protocol, experiment.objects, cache_folder());
    ProgressBar bar;
    std::vector<StimulusLight> stimuli;
    const std::vector<Stimulus> shown = stimuli_in_slots(protocol);
    const int count = static_cast<int>(shown.size());
    // What a session would show; where it would be refused, the best that there is.
    if (const std::optional<FrameQuality> quality = library.quality_of_session(protocol.bake.least())) {
        library.take_frames(*quality);
    } else {
        for (const Stimulus& stimulus : shown)
            library.prepare_frames(stimulus, std::ref(bar));
    }
    for (int i = 0; i < count; ++i) {
        bar.update("light of stimuli", i, count);
        const Stimulus& stimulus = shown[static_cast<std::size_t>(i)];
        StimulusLight light;
        light.stimulus = stimulus_name(protocol, stimulus);
        const std::vector<int> pages = library.page_of_frame(stimulus);
        std::vector<ClippedPixels> counts(
            1 + static_cast<std::size_t>(*std::max_element(pages.begin(), pages.end())));
        parallel_for(static_cast<int>(counts.size()), [&](int page) {
            counts[static_cast<std::size_t>(page)] =
                count_clipped(library.object_on_page(stimulus, page), protocol.display.background);
        });
        for (const ClippedPixels& page : counts) {
            light.clipped += page;
            for (std::size_t channel = 0; channel < 3; ++channel)
                light.worst_page =
                    std::max(light.worst_page, page.share_below(channel) + page.share_above(channel));
        }
        stimuli.push_back(std::move(light));
    }
    bar.update("light of stimuli", count, count);
    bar.finish();
    return stimuli;
}

std::string to_text(const std::vector<StimulusLight>& stimuli) {
    std::string text = "\nLight that the display cannot show, in % of the object's pixels, by channel\n";
    std::size_t width = 8;
    for (const StimulusLight& light : stimuli)
        width = std::max(width, light.stimulus.size());
    text += fmt::format("  {:<{}}  {:>7} {:>7} {:>7}  {:>7} {:>7} {:>7}  {:>10}\n", "stimulus", width,
                        "R > 1", "G > 1", "B > 1", "R < 0", "G < 0", "B < 0", "worst page");
    for (const StimulusLight& light : stimuli) {
        text += fmt::format("  {:<{}} ", light.stimulus, width);
        for (std::size_t channel = 0; channel < 3; ++channel)
            text += fmt::format(" {:>7.3f}", 100.0 * light.clipped.share_above(channel));
        text += " ";
        for (std::size_t channel = 0; channel < 3; ++channel)
            text += fmt::format(" {:>7.3f}", 100.0 * light.clipped.share_below(channel));
        text += fmt::format("  {:>10.3f}\n", 100.0 * light.worst_page);
    }
    return text + "  It is clipped to 0 and 1, channel by channel; exposure of [light], or of [[frames]], "
                  "scales all of it.\n";
}

nlohmann::ordered_json to_json(const std::vector<StimulusLight>& stimuli) {
    auto list = nlohmann::ordered_json::array();
    for (const StimulusLight& light : stimuli) {
        const ClippedPixels& clipped = light.clipped;
        list.push_back(
            {{"stimulus", light.stimulus},
             {"object_pixels", clipped.object_pixels},
             {"share_above", {clipped.share_above(0), clipped.share_above(1), clipped.share_above(2)}},
             {"share_below", {clipped.share_below(0), clipped.share_below(1), clipped.share_below(2)}},
             {"worst_page", light.worst_page}});
    }
    return list;
}

} // namespace overt
