#include "app/display/patch_display.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/protocol/keys/protocol_keys.h"
#include "render/signal/signal_decoder.h"

namespace overt {

/// One picture of one colour at a time.
class PatchDisplay::Page final : public FrameSource {
  public:
    explicit Page(glm::ivec2 size_px) : size_px_(size_px) {}
    void set(const glm::dvec3& signal) { signal_ = glm::vec3(signal); }
    std::vector<int> page_of_frame(const Stimulus&) const override { return {0}; }
    LinearImage page(const Stimulus&, int) const override {
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
ScreenGeometry geometry_of(const PatchDisplayRequest& request) {
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

DisplaySettings without_curves(DisplaySettings display, double surround) {
    display.gamma = 1.0;
    display.characterisation.reset();
    display.dither = Dithering::none;
    display.onset_trigger = 0;
    display.background = surround;
    return display;
}

/// Throws InputError for a mode that shows greys only.
DisplayRequest display_of(const PatchDisplayRequest& request) {
    const DisplaySettings& display = request.display;
    if (is_grey(display.output))
        throw InputError(fmt::format(
            "{} shows greys only, and the channels are measured one at a time: take --mode {}, in which "
            "the same display has the same curves.",
            name_of(display.output), listed(names_of_modes([](const OutputModeRow& row) {
                return row.is_packed && row.shows == ShownLight::colours;
            }))));
    return {.context = request.context,
            .size_px = {display.width_px, display.height_px},
            .title = "overt display characterise",
            .refresh_hz = display.refresh_hz,
            .bits_per_channel = row_of(display.output).framebuffer_bits,
            .virtual_time = request.virtual_time,
            .windowed = request.windowed,
            .monitor = request.monitor.empty() ? display.monitor : request.monitor,
            .headless = request.virtual_time};
}

} // namespace

PatchDisplay::PatchDisplay(const PatchDisplayRequest& request)
    : mode_(request.display.output), geometry_(geometry_of(request)), display_(display_of(request)) {
    display_.start();
    page_ = std::make_unique<Page>(geometry_.image_px);
    presenter_ =
        std::make_unique<PagePresenter>(display_.context(), display_.surface(), *page_, geometry_,
                                        without_curves(request.display, request.surround), ScreenSettings{});
}

PatchDisplay::~PatchDisplay() = default;

glm::dvec3 PatchDisplay::show(const glm::dvec3& signal, double seconds) {
    page_->set(signal);
    presenter_->load_frames({shown_++, 0});
    const SessionTime end = display_.clock().now() + from_seconds(seconds);
    // In refreshes, so that the window stays alive.
    do {
        presenter_->flip({0});
    } while (display_.clock().now() < end && !is_cancelled());
    return received_signal();
}

glm::dvec3 PatchDisplay::received_signal() const {
    const std::vector<std::byte> bytes = presenter_->read_canvas();
    const glm::ivec2 middle = geometry_.image_origin_px + geometry_.image_px / 2;
    const auto stride = static_cast<std::size_t>(4 * geometry_.screen_px.x);
    const SignalScreen row{{geometry_.screen_px.x, 1},
                           std::span(bytes).subspan(static_cast<std::size_t>(middle.y) * stride, stride)};
    const ReceivedLight light = receive_light(row, mode_);
    const auto& levels = light.at(joins_pixels_in_pairs(mode_) ? middle.x / 2 : middle.x, 0);
    return glm::dvec3(levels[0], levels[1], levels[2]) / static_cast<double>(light.highest);
}

bool PatchDisplay::is_cancelled() {
    WindowKeyPress press{};
    while (display_.window() && display_.window()->next_key_press(press))
        is_cancelled_ = is_cancelled_ || press.key == WindowKey::escape;
    is_cancelled_ = is_cancelled_ || display_.surface().closed();
    return is_cancelled_;
}

} // namespace overt
