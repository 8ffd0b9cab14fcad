#include "app/check/streaming_cost.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <fcntl.h>
#include <unistd.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "devices/host/clocks.h"
#include "experiment/protocol/all_stimuli.h"
#include "experiment/stimulus/frame_memory.h"
#include "render/presenter/page_presenter.h"

namespace overt {

namespace {

/// What is timed begins when the pictures that were there from the start are used up.
constexpr int stretches = 3, pictures_each = 24, pictures_before = 2 * least_streamed_pages;

/// Reading has to be so much faster than showing, since a session's own work comes on top.
constexpr double least_margin = 1.25;

std::optional<Stimulus> fastest_streamed(const Protocol& protocol) {
    std::optional<Stimulus> fastest;
    for (const Stimulus& stimulus : all_stimuli(protocol))
        if (is_streamed(protocol, stimulus.motion) &&
            (!fastest ||
             protocol.motion_of(stimulus).frame_rate_hz > protocol.motion_of(*fastest).frame_rate_hz))
            fastest = stimulus;
    return fastest;
}

/// Has the system read a file from its disk the next time. Where it cannot, it stays in memory.
void forget_in_memory(const std::filesystem::path& file) {
    const int opened = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
    if (opened < 0)
        return;
    ::posix_fadvise(opened, 0, 0, POSIX_FADV_DONTNEED);
    ::close(opened);
}

/// Of the pictures that are to be read, in bytes; forgets them.
double mean_file_bytes(const StimulusLibrary& library, const Stimulus& stimulus) {
    const std::vector<int> page_of_frame = library.page_of_frame(stimulus);
    const std::size_t read = std::min<std::size_t>(
        page_of_frame.size(), pictures_before + stretches * pictures_each + least_streamed_pages);
    double bytes = 0.0;
    for (std::size_t frame = 0; frame < read; ++frame) {
        const std::filesystem::path file = library.page_file(stimulus, page_of_frame[frame]);
        bytes += static_cast<double>(std::filesystem::file_size(file)) / static_cast<double>(read);
        forget_in_memory(file);
    }
    return bytes;
}

double found_hz(const GlContext& context, const Protocol& protocol, const StimulusLibrary& library,
                const Stimulus& stimulus) {
    const ScreenGeometry geometry = screen_geometry_of(protocol);
    DisplaySettings display = protocol.display;
    display.frame_store_mb = 1.001e-6 * least_streamed_pages * page_bytes(protocol);
    VirtualClock clock;
    VirtualDisplay surface(context, clock, display.refresh_hz, row_of(display.output).framebuffer_bits);
    PagePresenter presenter(context, surface, library, geometry, display, protocol.screens);
    presenter.load_frames(stimulus);
    const int frames = protocol.motion_of(stimulus).frame_count;
    int frame = 0;
    const auto show = [&](int count) {
        for (int i = 0; i < count; ++i)
            presenter.flip({frame++ % frames});
        if (presenter.closed())
            throw InputError(presenter.why_closed());
    };
    show(pictures_before);
    double slowest_hz = 0.0;
    for (int stretch = 0; stretch < stretches; ++stretch) {
        const auto begin = std::chrono::steady_clock::now();
        show(pictures_each);
        const double hz =
            pictures_each / std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        slowest_hz = stretch == 0 ? hz : std::min(slowest_hz, hz);
    }
    return slowest_hz;
}

} // namespace

bool StreamingCost::is_enough() const { return !found_hz || *found_hz >= least_margin * needed_hz; }

std::optional<StreamingCost> measure_streaming(const GlContext& context, const Protocol& protocol,
                                               StimulusLibrary& library) {
    const std::optional<Stimulus> stimulus = fastest_streamed(protocol);
    if (!stimulus)
        return std::nullopt;
    StreamingCost cost{
        stimulus_name(protocol, *stimulus), protocol.motion_of(*stimulus).frame_rate_hz, {}, 0.0};
    const std::optional<FrameQuality> quality = library.quality_of_session(protocol.bake.least());
    if (quality)
        library.take_frames(*quality);
    if (!quality && !find_frames(protocol, *stimulus))
        return cost;
    cost.disk_mb_s = 1e-6 * cost.needed_hz * mean_file_bytes(library, *stimulus);
    cost.found_hz = found_hz(context, protocol, library, *stimulus);
    return cost;
}

void check_streaming(const StreamingCost& cost, const Protocol& protocol, Diagnostics& diagnostics) {
    if (cost.is_enough())
        return;
    diagnostics.warning(
        protocol.file.string(), protocol.places.of("display.frame_store_mb"),
        fmt::format("{} does not fit into the frame store and comes from disk while it is "
                    "shown, at {:.0f} pictures a second on this machine, where {:.4g} are shown: "
                    "refreshes would be missed",
                    cost.stimulus, *cost.found_hz, cost.needed_hz),
        fmt::format("give the frame store more, show fewer or smaller pictures, or take a "
                    "faster machine: {:.0f} a second are enough",
                    std::ceil(least_margin * cost.needed_hz)));
}

ForecastLine forecast_of(const StreamingCost& cost) {
    return {"from disk", cost.found_hz
                             ? fmt::format("{}: {:.0f} pictures a second arrive while it is shown, {:.4g} "
                                           "are needed, {:.1f} MB a second of the disk",
                                           cost.stimulus, *cost.found_hz, cost.needed_hz, cost.disk_mb_s)
                             : fmt::format("{}: {:.4g} pictures a second are needed; how many arrive is "
                                           "measured when they are rendered",
                                           cost.stimulus, cost.needed_hz)};
}

nlohmann::ordered_json to_json(const StreamingCost& cost) {
    return {{"stimulus", cost.stimulus},
            {"needed_hz", cost.needed_hz},
            {"found_hz", cost.found_hz ? nlohmann::ordered_json(*cost.found_hz) : nullptr},
            {"disk_mb_s", cost.found_hz ? nlohmann::ordered_json(cost.disk_mb_s) : nullptr},
            {"is_enough", cost.is_enough()}};
}

} // namespace overt
