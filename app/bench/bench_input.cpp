#include "app/bench/bench_command.h"
#include "app/bench/random_pages.h"
#include "app/rig/input_latency.h"
#include "app/rig/open_display.h"
#include "experiment/base/error.h"
#include "render/window/window_system.h"

namespace overt {

BenchFigures bench_input(const BenchOptions& options) {
    if (!display_is_available())
        throw GraphicsError(
            "keys are sent to a window, and there is no window system: log in to a session of "
            "X11, or start Xvfb");
    ScreenGeometry geometry;
    geometry.image_px = glm::ivec2(std::min(options.size_px, 1024));
    geometry.image_origin_px = centred_origin_px(geometry.screen_px, geometry.image_px);
    const RandomPages pages(geometry.image_px.x);
    DisplaySettings settings;
    settings.output = OutputMode::color_plus_plus;
    settings.gamma = 1.0;
    OpenDisplay display({.context = ContextKind::window,
                         .size_px = geometry.screen_px,
                         .title = "overt bench",
                         .refresh_hz = settings.refresh_hz,
                         .windowed = true,
                         .finds_blanks = true});
    display.start();
    PagePresenter presenter(display.context(), display.surface(), pages, geometry, settings, {});
    presenter.show({});
    presenter.load_frames({0, 0});
    const InputLatency found =
        measure_input_latency(*display.window(), display.clock(), options.seconds, 1,
                              [&](int presses) { return presenter.flip({presses % RandomPages::count}); });
    BenchFigures figures{at_most("keys sent to the window that did not come", found.sent - found.seen, "", 0),
                         {"keys that came", static_cast<double>(found.seen), ""},
                         {"a flip, median", found.refresh_ms, "ms"}};
    if (found.delays) {
        // One that comes right after a look waits for two refreshes; more than three say that one went by.
        const std::string what = "from a key to the refresh that shows it, ";
        figures.push_back({what + "median", 1e3 * found.delays->median_s, "ms"});
        figures.push_back(at_most(what + "median, in flips", found.median_refreshes(), "", 2.0));
        figures.push_back({what + "95 % within", 1e3 * found.delays->most_s, "ms"});
        figures.push_back({what + "longest", 1e3 * found.delays->longest_s, "ms"});
    }
    return figures;
}

} // namespace overt
