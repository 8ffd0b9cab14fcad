/// The presenter: a frame store of ready-encoded pages, and a canvas that is what the display shows.
#pragma once

#include <functional>
#include <optional>

#include "experiment/ports.h"
#include "experiment/screen_geometry.h"
#include "render/display_encoder.h"
#include "render/display_surface.h"
#include "render/linear_image.h"

namespace overt {

/// Where the presenter takes a stimulus's frames from.
class FrameSource {
  public:
    virtual ~FrameSource() = default;
    /// Which page of the frame store shows each animation frame; frames that look alike share one. Pages
    /// count from 0.
    virtual std::vector<int> page_of_frame(const Condition& condition) const = 0;
    /// The picture for one page. May be called from several threads at once. Throws InputError.
    virtual LinearImage page(const Condition& condition, int page) const = 0;
};

class PagePresenter final : public Presenter {
  public:
    /// All references must outlive the presenter. Throws GraphicsError.
    PagePresenter(const GlContext& context, DisplaySurface& surface, const FrameSource& frames,
                  const ScreenGeometry& geometry, const DisplaySettings& display,
                  const ScreenSettings& screens);

    DisplayTiming timing() const override { return surface_->timing(); }
    void load_frames(const Condition& condition) override;
    FlipReport show(const Screen& screen) override;
    FlipReport flip(AnimationFrameIndex frame) noexcept override;
    bool closed() const noexcept override { return surface_->closed(); }

    /// The bytes of the screen as it is sent to the display: RGBA, top row first.
    std::vector<std::byte> read_canvas() const;

  private:
    void clear_canvas() noexcept;
    void draw_centred(const LinearImage& picture);

    const GlContext* context_;
    DisplaySurface* surface_;
    const FrameSource* frames_;
    ScreenGeometry geometry_;
    DisplaySettings display_;
    ScreenSettings screens_;
    DisplayEncoder encoder_;
    Texture2D background_;
    Framebuffer background_target_;
    Texture2D canvas_;
    Framebuffer canvas_target_;
    Texture2D upload_;
    std::optional<TextureArray> store_;
    Framebuffer page_target_;
    std::vector<int> page_of_frame_;
    std::optional<Condition> loaded_;
    bool canvas_holds_page_ = false;
};

} // namespace overt
