#include "app/display/patch_stage.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/protocol/protocol_keys.h"
#include "render/gl/headless_context.h"
#include "render/signal/signal_decoder.h"
#include "render/window/window_system.h"

namespace overt {

/// One picture of one colour at a time.
class PatchStage::Page final : public FrameSource {
  public:
    explicit Page(glm::ivec2 size_px) : size_px_(size_px) {}
    void set(const glm::dvec3& signal) { signal_ = glm::vec3(signal); }
    std::vector<int> page_of_frame(const Condition&) const override { return {0}; }
    LinearImage page(const Condition&, int) const override {
        LinearImage image(size_px_);
        std::fill(image.pixels.begin(), image.pixels.end(), glm::vec4(signal_, 1.0f));
        return image;
    }

  private:
    glm::ivec2 size_px_;
    glm::vec3 signal_{0.0f};
};

namespace {

/// Where the patch stands: all of the screen below the rows that speak to the display, or its middle.
ScreenGeometry geometry_of(const PatchStageRequest& request) {
    const DisplaySettings& display = request.display;
    ScreenGeometry geometry;
    geometry.screen_px = {display.width_px, display.height_px};
    geometry.screen_mm = {display.width_mm, display.height_mm};
    geometry.viewing_distance_mm = display.viewing_distance_mm;
    const int rows = reserved_rows(display.output);
    if (request.size_deg <= 0.0) {
        geometry.image_px = geometry.screen_px - glm::ivec2(0, rows);
        geometry.image_origin_px = {0, rows};
        return geometry;
    }
    const double half_mm =
        std::tan(0.5 * request.size_deg * std::numbers::pi / 180.0) * display.viewing_distance_mm;
    const int side = 2 * static_cast<int>(std::lround(half_mm * display.width_px / display.width_mm));
    const int most = std::min(display.width_px, display.height_px - 2 * rows);
    if (side < 2 || side > most)
        throw InputError(
            fmt::format("a patch of {} deg has {} px at this distance, and the screen holds 2 to "
                        "{}: take another --size.",
                        request.size_deg, side, most));
    geometry.image_px = glm::ivec2(side);
    geometry.image_origin_px = centred_origin_px(geometry.screen_px, geometry.image_px);
    return geometry;
}

bool shows_colours(OutputMode mode) {
    return mode == OutputMode::native_8bit || mode == OutputMode::native_10bit ||
           mode == OutputMode::color_plus_plus || mode == OutputMode::vpixx_c48;
}

DisplaySettings without_curves(DisplaySettings display, double surround) {
    display.gamma = 1.0;
    display.characterisation.reset();
    display.dither = Dithering::none;
    display.onset_trigger = 0;
    display.background = surround;
    return display;
}

} // namespace

PatchStage::PatchStage(const PatchStageRequest& request)
    : mode_(request.display.output), geometry_(geometry_of(request)) {
    if (!shows_colours(mode_))
        throw InputError(fmt::format("{} shows greys only, and the channels are measured one at a time: take "
                                     "--mode color++ or vpixx-c48, in which the same display has the same "
                                     "curves.",
                                     name_of(mode_)));
    const DisplaySettings display = without_curves(request.display, request.surround);
    const int bits = mode_ == OutputMode::native_10bit ? 10 : 8;
    if (request.virtual_time)
        clock_ = std::make_unique<VirtualClock>();
    else
        clock_ = std::make_unique<SteadyClock>();
    if (request.context ? *request.context == ContextKind::window
                        : !request.virtual_time && display_is_available()) {
        WindowRequest window;
        window.size_px = geometry_.screen_px;
        window.title = "overt display characterise";
        window.fullscreen = !request.windowed && !request.virtual_time;
        window.bits_per_channel = bits;
        window.monitor = request.monitor;
        auto context = std::make_unique<WindowContext>(window);
        window_ = context.get();
        surface_ =
            std::make_unique<WindowDisplay>(*context, *clock_, display.refresh_hz, request.virtual_time);
        context_ = std::move(context);
    } else {
        context_ = make_headless_context(request.context);
        surface_ = std::make_unique<VirtualDisplay>(*context_, *clock_, display.refresh_hz, bits);
    }
    page_ = std::make_unique<Page>(geometry_.image_px);
    presenter_ =
        std::make_unique<PagePresenter>(*context_, *surface_, *page_, geometry_, display, ScreenSettings{});
}

PatchStage::~PatchStage() = default;

glm::dvec3 PatchStage::show(const glm::dvec3& signal, double seconds) {
    page_->set(signal);
    presenter_->load_frames({shown_++, 0});
    const SessionTime end = clock_->now() + from_seconds(seconds);
    // In refreshes, so that the window stays alive.
    do {
        presenter_->flip({0});
    } while (clock_->now() < end && !is_cancelled());
    return received_signal();
}

glm::dvec3 PatchStage::received_signal() const {
    const std::vector<std::byte> bytes = presenter_->read_canvas();
    const glm::ivec2 middle = geometry_.image_origin_px + geometry_.image_px / 2;
    const auto stride = static_cast<std::size_t>(4 * geometry_.screen_px.x);
    const SignalScreen row{{geometry_.screen_px.x, 1},
                           std::span(bytes).subspan(static_cast<std::size_t>(middle.y) * stride, stride)};
    const ReceivedLight light = receive_light(row, mode_);
    const auto& levels = light.at(joins_pixels_in_pairs(mode_) ? middle.x / 2 : middle.x, 0);
    return glm::dvec3(levels[0], levels[1], levels[2]) / static_cast<double>(light.highest);
}

bool PatchStage::is_cancelled() {
    WindowKeyPress press{};
    while (window_ && window_->next_key_press(press))
        is_cancelled_ = is_cancelled_ || press.key == WindowKey::escape;
    is_cancelled_ = is_cancelled_ || surface_->closed();
    return is_cancelled_;
}

} // namespace overt
