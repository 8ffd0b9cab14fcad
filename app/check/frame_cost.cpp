#include "app/check/frame_cost.h"

#include <algorithm>
#include <array>
#include <chrono>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "devices/host/clocks.h"
#include "experiment/base/random.h"
#include "render/presenter/page_presenter.h"
#include "render/stimulus/coordinate_pass.h"

namespace overt {

namespace {

constexpr int pages = 4;
constexpr int flips = 60;

double milliseconds_of(const auto& work) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    return 1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// One picture of random light for all pages: what is timed does not depend on what is on them.
class NoisePages final : public FrameSource {
  public:
    explicit NoisePages(glm::ivec2 size_px) : picture_(size_px) {
        RandomStream random(1, "frame cost");
        for (glm::vec4& pixel : picture_.pixels)
            pixel = glm::vec4(glm::vec3(static_cast<float>(random.uniform())), 1.0f);
    }
    std::vector<int> page_of_frame(const Stimulus&) const override { return {0, 1, 2, 3}; }
    LinearImage page(const Stimulus&, int) const override { return picture_; }
    const LinearImage& read_page(const Stimulus&, int, LinearImage&) const override { return picture_; }

  private:
    LinearImage picture_;
};

/// Keeps time, and costs what a window of the screen's size costs.
class CopyingDisplay final : public DisplaySurface {
  public:
    CopyingDisplay(const GlContext& context, Clock& clock, const DisplaySettings& display,
                   glm::ivec2 screen_px)
        : context_(&context),
          display_(context, clock, display.refresh_hz, row_of(display.output).framebuffer_bits),
          window_(context, screen_px,
                  display_.bits_per_channel() == 10 ? PixelFormat::rgb10_a2 : PixelFormat::rgba8) {}
    DisplayTiming timing() const override { return display_.timing(); }
    FlipReport present(const Framebuffer& canvas) noexcept override {
        context_->gl().Finish(); // what was drawn before is not the copy's
        copies_ms_[next_++ % copies_ms_.size()] = milliseconds_of([&] {
            copy_for_window(context_->gl(), canvas, window_.name());
            context_->gl().Finish();
        });
        return display_.present(canvas);
    }
    bool closed() const noexcept override { return false; }
    int bits_per_channel() const override { return display_.bits_per_channel(); }
    void read(const Framebuffer& canvas, PixelFormat format, std::span<std::byte> into) override {
        display_.read(canvas, format, into);
    }
    /// Of the last `flips` pictures.
    double median_copy_ms() const {
        std::array<double, flips> sorted = copies_ms_;
        std::ranges::sort(sorted);
        return sorted[sorted.size() / 2];
    }

  private:
    const GlContext* context_;
    VirtualDisplay display_;
    Framebuffer window_;
    std::array<double, flips> copies_ms_{};
    std::size_t next_ = 0;
};

} // namespace

FrameCost measure_frame_cost(const GlContext& context, const Protocol& protocol,
                             std::span<const Object> objects) {
    FrameCost cost;
    const ScreenGeometry geometry = screen_geometry_of(protocol);
    const NoisePages noise(geometry.image_px);
    VirtualClock clock;
    CopyingDisplay display(context, clock, protocol.display, geometry.screen_px);
    PagePresenter presenter(context, display, noise, geometry, protocol.display, protocol.screens);
    cost.page_ms = milliseconds_of([&] { presenter.load_frames({0, 0}); }) / pages;
    for (int page = 0; page < pages; ++page) // the first time sets things up
        presenter.flip({page});
    std::vector<double> times_ms;
    for (int flip = 0; flip < flips; ++flip)
        times_ms.push_back(milliseconds_of([&] { presenter.flip({flip % pages}); }));
    std::ranges::sort(times_ms);
    cost.flips = flips;
    cost.median_flip_ms = times_ms[times_ms.size() / 2];
    cost.worst_flip_ms = times_ms.back();
    cost.copy_ms = display.median_copy_ms();
    for (const Object& object : objects) {
        if (!object.has_mesh())
            continue;
        const SceneView& scene = object.scene();
        CoordinatePass pass(context, scene.view.image_px);
        const MeshBuffers buffers(context, object.mesh);
        pass.draw(buffers, scene, {{0.0}});
        const double map_ms = milliseconds_of([&] { pass.draw(buffers, scene, {{0.0}}); });
        cost.worst_map_ms = std::max(cost.worst_map_ms.value_or(0.0), map_ms);
    }
    return cost;
}

std::vector<ForecastLine> forecast_of(const FrameCost& cost, const Protocol& protocol,
                                      const GlDescription& graphics) {
    const double refresh_ms = 1e3 / protocol.display.refresh_hz;
    std::vector<ForecastLine> lines;
    lines.push_back(
        {"a flip",
         fmt::format(
             "{:.2f} ms, at worst {:.2f} ms of {}, of the {:.2f} ms of a refresh; {:.2f} ms of it copy the "
             "screen into the window ({})",
             cost.median_flip_ms, cost.worst_flip_ms, cost.flips, refresh_ms, cost.copy_ms,
             graphics.renderer)});
    if (cost.median_flip_ms > refresh_ms)
        lines.push_back({"",
                         "longer than a refresh: in real time most refreshes would be missed. Show a smaller "
                         "stimulus, or give the machine a graphics card; --virtual-time is exact anyhow"});
    else if (cost.worst_flip_ms > 0.5 * refresh_ms)
        lines.push_back(
            {"", "the worst takes more than half of a refresh: close other programs, and see --realtime"});
    lines.push_back({"a page", fmt::format("{:.1f} ms to pack and load", cost.page_ms)});
    if (cost.worst_map_ms) {
        // As the rig decides: live where a graphics processor draws.
        const double frame_ms =
            1e3 / std::ranges::max(protocol.motions, {}, &MotionSettings::frame_rate_hz).frame_rate_hz;
        lines.push_back(
            {"hidden map",
             fmt::format("{:.1f} ms of the {:.1f} ms of a frame; {}", *cost.worst_map_ms, frame_ms,
                         graphics.is_software ? "drawn before the session, not in it"
                                              : "drawn while its frame is shown")});
        if (!graphics.is_software && *cost.worst_map_ms > frame_ms)
            lines.push_back({"", "longer than a frame: give --maps prepared"});
    }
    return lines;
}

nlohmann::ordered_json to_json(const FrameCost& cost) {
    return {{"flips", cost.flips},
            {"median_flip_ms", cost.median_flip_ms},
            {"worst_flip_ms", cost.worst_flip_ms},
            {"copy_ms", cost.copy_ms},
            {"page_ms", cost.page_ms},
            {"worst_map_ms", cost.worst_map_ms ? nlohmann::ordered_json(*cost.worst_map_ms) : nullptr}};
}

} // namespace overt
