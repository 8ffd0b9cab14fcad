#include <chrono>

#include <fmt/format.h>

#include "app/cli/own_folders.h"
#include "app/cli/progress_bar.h"
#include "app/inputs/protocol_file.h"
#include "app/inputs/protocol_inputs.h"
#include "app/rig/open_display.h"
#include "app/stimuli/live_play.h"
#include "app/stimuli/stimulus_commands.h"
#include "render/image/text_layout.h"
#include "render/presenter/stereo_presenter.h"
#include "render/stimulus/stimulus_library.h"
#include "render/window/window_system.h"

namespace overt {

namespace {

void write_frame(const StimulusLibrary& library, const Stimulus& stimulus, const PlayOptions& options) {
    const auto frame = static_cast<std::size_t>(options.frame.value_or(0));
    const int page = library.page_of_frame(stimulus)[frame];
    LinearImage picture = library.page_on_screen(stimulus, page);
    // What is only a preview must not be taken for the stimulus.
    const bool is_preview = !library.cache().is_ready_made(stimulus) &&
                            library.quality_of_frames(stimulus).level <= BakeQuality::preview;
    if (is_preview)
        write_on(picture, library.source_of(stimulus), {picture.size_px.x / 2, picture.size_px.y - 1});
    write_srgb_png(options.picture, picture);
    if (is_preview)
        fmt::print(stderr, "{}: a preview ({}); `overt bake` makes what observers see\n",
                   options.picture.string(), library.source_of(stimulus));
    fmt::print("{}\n", options.picture.string());
}

/// Plays in a window until the time is up, it is closed, or a key is pressed.
void play_in_window(OpenDisplay& window, StimulusLibrary& library, const Stimulus& stimulus,
                    const Protocol& protocol, double duration_s) {
    window.start();
    DisplaySettings display = protocol.display;
    // For a look on an ordinary screen: the packed signal of a Display++ would be unreadable there.
    display.output = OutputMode::native_8bit;
    display.gamma = 2.2;
    Protocol shown = protocol;
    shown.display = display;
    std::unique_ptr<Presenter> made;
    if (protocol.stereo.is_on())
        made = std::make_unique<StereoPresenter>(window.context(), window.surface(), library, shown);
    else
        made = std::make_unique<PagePresenter>(window.context(), window.surface(), library,
                                               screen_geometry_of(protocol), display, protocol.screens);
    Presenter& presenter = *made;
    presenter.load_frames(stimulus);
    const Animation& motion = protocol.motion_of(stimulus);
    const double frame_s = 1.0 / motion.frame_rate_hz;
    const SessionTime begin = window.clock().now();
    WindowKeyPress press{};
    while (!presenter.closed() && !window.window()->next_key_press(press)) {
        const double elapsed_s = to_seconds(window.clock().now() - begin);
        if (elapsed_s >= duration_s)
            break;
        presenter.flip(motion.frame_at_step(static_cast<int>(elapsed_s / frame_s)));
    }
}

} // namespace

int run_play(const PlayOptions& options) {
    const Experiment experiment =
        read_experiment_or_report(options.protocol, cache_folder(), InputDepth::objects);
    const Protocol& protocol = experiment.protocol;
    const std::vector<Object>& objects = experiment.objects;
    const Stimulus stimulus = stimulus_called(protocol, options.stimulus);
    const int frame_count = protocol.motion_of(stimulus).frame_count;
    if (options.frame.value_or(0) >= frame_count) {
        throw InputError(
            fmt::format("--frame {}: the animation has frames 0 to {}", *options.frame, frame_count - 1));
    }
    const bool in_window = options.picture.empty();
    if (options.live)
        return play_live(protocol, objects, stimulus, options);
    if (in_window && !display_is_available())
        throw InputError("there is no display to play on: write a frame with --picture FILE instead");

    DisplayRequest request{.context = options.context, .headless = true};
    if (in_window)
        request = {.context = ContextKind::window,
                   .size_px = {protocol.display.width_px, protocol.display.height_px},
                   .title = "overt play",
                   .refresh_hz = protocol.display.refresh_hz,
                   .windowed = true,
                   .has_two_eyes = protocol.stereo.kind == StereoKind::frame_sequential};
    else if (options.context == ContextKind::window)
        request.context = {};
    OpenDisplay display(request);
    StimulusLibrary library(display.context(), protocol, objects, cache_folder());
    ProgressBar bar;
    library.prepare_frames(stimulus, std::ref(bar),
                           in_window ? std::nullopt
                                     : std::optional(AnimationFrameIndex{options.frame.value_or(0)}));
    bar.finish();
    if (in_window) {
        play_in_window(display, library, stimulus, protocol, options.repeat_s);
    } else {
        write_frame(library, stimulus, options);
    }
    return 0;
}

} // namespace overt
