#include "app/stimuli/live_play.h"

#include <algorithm>
#include <thread>

#include <fmt/format.h>

#include "app/rig/open_display.h"
#include "experiment/base/error.h"
#include "render/gl/headless_context.h"
#include "render/image/text_layout.h"
#include "render/signal/display_encoder.h"
#include "render/stimulus/live_view.h"
#include "render/window/window_system.h"

namespace overt {

namespace {

/// How often a picture at rest looks for something to do.
constexpr auto idle = std::chrono::milliseconds(10);

constexpr const char* keys_text =
    "drag: turn    wheel: nearer    ← →: material    ↑ ↓: sculpture    space: animation    Esc: end";

/// Pictures of linear light in a window that is as large as they are, on an ordinary screen.
class PictureWindow {
  public:
    explicit PictureWindow(const OpenDisplay& opened)
        : opened_(&opened), encoder_([&] {
              DisplaySettings display;
              display.output = OutputMode::native_8bit;
              display.gamma = 2.2;
              display.width_px = opened.window()->framebuffer_px().x;
              display.height_px = opened.window()->framebuffer_px().y;
              return display;
          }()),
          texture_(opened.context(), opened.window()->framebuffer_px(), encoder_.format()),
          canvas_(opened.context(), {&texture_}, false) {}

    /// Over its lower edge stand the keys.
    void show(LinearImage picture) {
        write_on(picture, keys_text, {picture.size_px.x / 2, picture.size_px.y - 1});
        bytes_.resize(bytes_per_pixel(encoder_.format()) * picture.pixels.size());
        encoder_.encode(picture, {0, 0}, bytes_);
        texture_.upload(bytes_);
        opened_->surface().present(canvas_);
    }

  private:
    const OpenDisplay* opened_;
    DisplayEncoder encoder_;
    Texture2D texture_;
    Framebuffer canvas_;
    std::vector<std::byte> bytes_;
};

/// Of the protocol's shape, large enough for a hand, and as large as the screen has room for beside its
/// panels.
glm::ivec2 window_size_of(const ViewSettings& view, glm::ivec2 screen_px) {
    constexpr double least_px = 768.0, share_of_screen = 0.85;
    const glm::dvec2 most = share_of_screen * glm::dvec2(screen_px);
    const double scale = std::min({std::max(1.0, least_px / std::max(view.width_px, view.height_px)),
                                   most.x / view.width_px, most.y / view.height_px});
    return {static_cast<int>(scale * view.width_px), static_cast<int>(scale * view.height_px)};
}

int next_of(int index, int by, std::size_t count) {
    const int all = static_cast<int>(count);
    return ((index + by) % all + all) % all;
}

/// What the keys and the mouse have asked for.
struct Wishes {
    Condition stimulus;
    Orbit orbit;
    bool is_turning = false;
    bool has_ended = false;
    bool has_changed = true;
};

void take_keys(WindowContext& window, const Protocol& protocol, std::span<const Sculpture> sculptures,
               Wishes& wishes) {
    WindowKeyPress press{};
    while (window.next_key_press(press)) {
        int sculpture_step = 0;
        switch (press.key) {
        case WindowKey::left:
        case WindowKey::right:
            wishes.stimulus.material = next_of(
                wishes.stimulus.material, press.key == WindowKey::left ? -1 : 1, protocol.materials.size());
            break;
        case WindowKey::up:
        case WindowKey::down:
            sculpture_step = press.key == WindowKey::up ? -1 : 1;
            // One that is there only as frames cannot be turned.
            do {
                wishes.stimulus.sculpture =
                    next_of(wishes.stimulus.sculpture, sculpture_step, sculptures.size());
            } while (!sculptures[static_cast<std::size_t>(wishes.stimulus.sculpture)].has_mesh());
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
                       std::span<const Sculpture> sculptures, const Condition& first) {
    opened.start();
    WindowContext& window = *opened.window();
    PictureWindow picture(opened);
    const SessionTime begin = opened.clock().now();
    Wishes wishes;
    wishes.stimulus = first;
    while (!window.close_requested()) {
        window.poll_events();
        take_keys(window, protocol, sculptures, wishes);
        if (wishes.has_ended)
            return;
        if (!wishes.has_changed && !wishes.is_turning) {
            std::this_thread::sleep_for(idle);
            continue;
        }
        wishes.has_changed = false;
        view.choose(wishes.stimulus);
        Orbit orbit = wishes.orbit;
        if (wishes.is_turning) {
            const int step =
                static_cast<int>(to_seconds(opened.clock().now() - begin) * protocol.animation.frame_rate_hz);
            orbit.turn_deg += protocol.animation.angle_of(protocol.animation.frame_at_step(step)).value;
        }
        picture.show(view.draw(orbit));
    }
}

} // namespace

int play_live(const Protocol& protocol, std::span<const Sculpture> sculptures, const Condition& stimulus,
              const PlayOptions& options) {
    if (options.picture.empty()) {
        if (!display_is_available())
            throw InputError("there is no display to play on: write a frame with --picture FILE instead");
        const std::vector<MonitorInfo> monitors = list_monitors();
        const glm::ivec2 image_px = window_size_of(
            protocol.view, monitors.empty() ? glm::ivec2(1024, 768) : monitors.front().size_px);
        fmt::print("{}\n", keys_text);
        OpenDisplay window({.context = ContextKind::window,
                            .size_px = image_px,
                            .title = "overt play --live",
                            .refresh_hz = protocol.display.refresh_hz,
                            .windowed = true});
        LiveView view(window.context(), protocol, sculptures, image_px);
        play_until_closed(window, view, protocol, sculptures, stimulus);
        return 0;
    }
    const auto context =
        make_headless_context(options.context == ContextKind::window ? std::nullopt : options.context);
    LiveView view(*context, protocol, sculptures, {protocol.view.width_px, protocol.view.height_px});
    view.choose(stimulus);
    Orbit orbit;
    orbit.turn_deg = protocol.animation.angle_of({options.frame.value_or(0)}).value;
    write_srgb_png(options.picture, view.draw(orbit));
    fmt::print("{}\n", options.picture.string());
    return 0;
}

} // namespace overt
