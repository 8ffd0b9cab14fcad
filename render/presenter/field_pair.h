/// The two fields of a screen, each as a surface of its own.
#pragma once

#include <array>

#include "experiment/protocol/protocol.h"
#include "render/vblank/display_surface.h"

namespace overt {

/// What is presented on the surface of the following eye waits until the leading eye's is presented; then
/// both are shown with one refresh.
class FieldPair {
  public:
    /// Of a protocol with [stereo]. References must outlive the pair. Throws GraphicsError.
    FieldPair(const GlContext& context, DisplaySurface& surface, const Protocol& protocol);

    DisplaySurface& of(Eye eye) { return fields_[static_cast<std::size_t>(eye)]; }

    /// Of mirrors: what was presented last, read back from where the display takes it.
    bool holds_screen() const { return whole_.has_value(); }
    std::vector<std::byte> read_screen() const;

    /// The eye that has the left half, in which the screen's messages begin; with shutters the left one.
    static Eye leading_eye(const StereoSettings& stereo);

  private:
    class Field final : public DisplaySurface {
      public:
        Field(FieldPair& pair, Eye eye) : pair_(&pair), eye_(eye) {}
        DisplayTiming timing() const override { return pair_->surface_->timing(); }
        FlipReport present(const Framebuffer& canvas) noexcept override {
            return pair_->present(eye_, canvas);
        }
        bool closed() const noexcept override { return pair_->surface_->closed(); }
        void show_pointer(bool is_shown) noexcept override { pair_->surface_->show_pointer(is_shown); }
        std::optional<SwapModes> take_swap_modes() noexcept override {
            return pair_->surface_->take_swap_modes();
        }
        std::string why_closed() const override { return pair_->surface_->why_closed(); }
        int bits_per_channel() const override { return pair_->surface_->bits_per_channel(); }
        void read(const Framebuffer& canvas, PixelFormat format, std::span<std::byte> into) override {
            pair_->read(eye_, canvas, format, into);
        }

      private:
        FieldPair* pair_;
        Eye eye_;
    };

    /// Which pixels of a field's canvas are seen, and where on the whole screen.
    struct Part {
        glm::ivec2 from_px{0}, to_px{0}, size_px{0};
        bool is_empty() const { return size_px.x <= 0 || size_px.y <= 0; }
    };
    /// Below the rows that messages take.
    Part picture_of(Eye eye) const;

    void put_background(const Protocol& protocol);
    void put(Eye eye, const Framebuffer& canvas) noexcept;
    FlipReport present(Eye eye, const Framebuffer& canvas) noexcept;
    void read(Eye eye, const Framebuffer& canvas, PixelFormat format, std::span<std::byte> into);

    const GlContext* context_;
    PixelFormat format_ = PixelFormat::rgba8; ///< of what goes to the display
    DisplaySurface* surface_;
    StereoSettings stereo_;
    Eye leading_;
    std::array<ImageBox, 2> places_; ///< by eye
    int message_rows_;
    std::array<Field, 2> fields_;
    /// Of mirrors: the whole screen, as it goes to the display.
    std::optional<Framebuffer> whole_;
    /// Of shutters: what the following eye is going to see; null before it saw anything.
    const Framebuffer* waiting_ = nullptr;
};

} // namespace overt
