#include "app/rig/output_verification.h"

#include <algorithm>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/design/match_levels.h"
#include "experiment/ports/event_kinds.h"

namespace overt {

namespace {

std::vector<Stimulus> distinct_stimuli(const Protocol& protocol, const Schedule& schedule) {
    std::vector<Stimulus> stimuli;
    for (const Trial& trial : schedule.trials) {
        for (const PlacedStimulus& shown : loaded_for(protocol, trial))
            if (std::find(stimuli.begin(), stimuli.end(), shown.stimulus) == stimuli.end())
                stimuli.push_back(shown.stimulus);
    }
    return stimuli;
}

/// What the record says of a page.
std::string sentence_on(const PageVerification& page, const std::string& stimulus) {
    const SignalFindings& found = page.findings;
    std::string text = fmt::format("{} page {}: {} of {} values differ from the prediction", stimulus,
                                   page.page, found.different, found.compared);
    if (found.different > 0)
        text += fmt::format(", by {} at most, the first at {}", found.largest_difference, found.first);
    if (page.clipped.any()) {
        text += fmt::format(
            "; of the object's pixels {:.4g} % in red, {:.4g} % in green and {:.4g} % in blue are clipped",
            100.0 * (page.clipped.share_below(0) + page.clipped.share_above(0)),
            100.0 * (page.clipped.share_below(1) + page.clipped.share_above(1)),
            100.0 * (page.clipped.share_below(2) + page.clipped.share_above(2)));
    }
    return text + "; wire sha256 " + page.signal_sha256;
}

} // namespace

std::vector<PageVerification> verify_pages(PagePresenter& presenter, const FrameSource& pages,
                                           const Stimulus& stimulus, const ScreenGeometry& geometry,
                                           const DisplaySettings& display, Eye eye) {
    presenter.load_frames(stimulus);
    std::vector<PageVerification> verified;
    for (int page = 0; page < presenter.pages(); ++page) {
        const LinearImage picture = pages.page(pages.in_slot({stimulus, 0}, eye), page);
        const std::vector<std::byte> bytes = presenter.read_page(page);
        verified.push_back(
            {page, check_signal({geometry.screen_px, bytes}, display, {&picture, geometry.image_origin_px}),
             ContentHasher().add_bytes(bytes).finish(), count_clipped(picture, display.background)});
    }
    return verified;
}

void record_verification(std::span<PagePresenter* const> presenters, const FrameSource& pages,
                         const Protocol& protocol, const Schedule& schedule, const Clock& clock,
                         SessionLog& log, const StimulusProgress& progress) {
    const std::vector<Stimulus> stimuli = distinct_stimuli(protocol, schedule);
    // In the first slot: the others have the same bytes.
    const ScreenGeometry geometry = slot_geometry(protocol, protocol.slots.front());
    const DisplaySettings display = display_of_field(protocol);
    std::string first_difference;
    int done = 0;
    for (const Stimulus& stimulus : stimuli) {
        if (progress)
            progress(done++, static_cast<int>(stimuli.size()));
        for (std::size_t of = 0; of < presenters.size(); ++of) {
            std::string name = protocol.objects[static_cast<std::size_t>(stimulus.object)].id + "/" +
                               protocol.materials[static_cast<std::size_t>(stimulus.material)].id;
            if (presenters.size() > 1)
                name += of == 0 ? ", left eye," : ", right eye,";
            for (const PageVerification& page :
                 verify_pages(*presenters[of], pages, stimulus, geometry, display, static_cast<Eye>(of))) {
                const std::string sentence = sentence_on(page, name);
                log.event({clock.now(), -1, output_verified_event, sentence});
                if (page.findings.different > 0 && first_difference.empty())
                    first_difference = sentence;
            }
        }
    }
    if (progress)
        progress(done, static_cast<int>(stimuli.size()));
    if (!first_difference.empty())
        throw GraphicsError("the display would not receive the stimuli as they are: " + first_difference);
}

} // namespace overt
