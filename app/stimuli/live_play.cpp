#include "app/stimuli/live_play.h"

#include <algorithm>
#include <thread>

#include <fmt/format.h>

#include "app/stimuli/live_errors.h"
#include "app/stimuli/picture_window.h"
#include "experiment/base/error.h"
#include "render/gl/headless_context.h"
#include "render/stimulus/live_view.h"
#include "render/window/window_system.h"

namespace overt {

namespace {

constexpr const char* keys_text =
    "drag: turn    wheel: nearer    ← →: material    ↑ ↓: object    space: animation    Esc: end";

int next_of(int index, int by, std::size_t count) {
    const int all = static_cast<int>(count);
    return ((index + by) % all + all) % all;
}

/// What the keys and the mouse have asked for.
struct Wishes {
    Stimulus stimulus;
    Orbit orbit;
    bool is_turning = false;
    bool has_ended = false;
    bool has_changed = true;
};

void take_keys(WindowContext& window, const Protocol& protocol, std::span<const Object> objects,
               Wishes& wishes) {
    WindowKeyPress press{};
    while (window.next_key_press(press)) {
        int object_step = 0;
        switch (press.key) {
        case WindowKey::left:
        case WindowKey::right:
            wishes.stimulus.material = next_of(
                wishes.stimulus.material, press.key == WindowKey::left ? -1 : 1, protocol.materials.size());
            break;
        case WindowKey::up:
        case WindowKey::down:
            object_step = press.key == WindowKey::up ? -1 : 1;
            // One that is there only as frames cannot be turned.
            do {
                wishes.stimulus.object = next_of(wishes.stimulus.object, object_step, objects.size());
            } while (!objects[static_cast<std::size_t>(wishes.stimulus.object)].has_mesh());
            break;
        case WindowKey::space:
            wishes.is_turning = !wishes.is_turning;
            break;
        case WindowKey::escape:
        case WindowKey::enter:
            wishes.has_ended = true;
            break;
        default:
            continue;
        }
        wishes.has_changed = true;
    }
    const WindowContext::Dragging dragging = window.take_dragging();
    if (dragging.by_px != glm::dvec2(0.0) || dragging.wheel_steps != 0.0) {
        wishes.orbit.drag(dragging.by_px);
        wishes.orbit.zoom(dragging.wheel_steps);
        wishes.has_changed = true;
    }
}

void play_until_closed(OpenDisplay& opened, LiveView& view, const Protocol& protocol,
                       std::span<const Object> objects, const Stimulus& first) {
    opened.start();
    WindowContext& window = *opened.window();
    PictureWindow picture(opened);
    const SessionTime begin = opened.clock().now();
    Wishes wishes;
    wishes.stimulus = first;
    while (!window.close_requested()) {
        window.poll_events();
        take_keys(window, protocol, objects, wishes);
        if (wishes.has_ended)
            return;
        if (!wishes.has_changed && !wishes.is_turning) {
            std::this_thread::sleep_for(picture_rest);
            continue;
        }
        wishes.has_changed = false;
        view.choose(wishes.stimulus);
        const Orbit orbit = wishes.orbit;
        Pose pose;
        if (wishes.is_turning) {
            const Animation& motion = protocol.motion_of(wishes.stimulus);
            const int step =
                static_cast<int>(to_seconds(opened.clock().now() - begin) * motion.frame_rate_hz);
            pose = motion.pose_of(motion.frame_at_step(step));
        }
        picture.show(view.draw(orbit, pose), keys_text);
    }
}

} // namespace

int play_live(const Protocol& protocol, std::span<const Object> objects, const Stimulus& stimulus,
              const PlayOptions& options) {
    fmt::print(stderr, "{}\n", live_differences_of(protocol));
    if (options.picture.empty()) {
        if (!display_is_available())
            throw InputError("there is no display to play on: write a frame with --picture FILE instead");
        const glm::ivec2 image_px = picture_window_size(protocol.view_of(stimulus));
        fmt::print("{}\n", keys_text);
        OpenDisplay window({.context = ContextKind::window,
                            .size_px = image_px,
                            .title = "overt play --live",
                            .refresh_hz = protocol.display.refresh_hz,
                            .windowed = true});
        LiveView view(window.context(), protocol, objects, image_px);
        play_until_closed(window, view, protocol, objects, stimulus);
        return 0;
    }
    const auto context =
        make_headless_context(options.context == ContextKind::window ? std::nullopt : options.context);
    const ViewSettings& settings = protocol.view_of(stimulus);
    LiveView view(*context, protocol, objects, {settings.width_px, settings.height_px});
    view.choose(stimulus);
    const Pose pose = protocol.motion_of(stimulus).pose_of({options.frame.value_or(0)});
    write_srgb_png(options.picture, view.draw({}, pose));
    fmt::print("{}\n", options.picture.string());
    return 0;
}

} // namespace overt
