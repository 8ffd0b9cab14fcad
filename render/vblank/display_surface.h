/// Where finished screens go: a display that exists, or one that only keeps time.
#pragma once

#include "experiment/ports/clock.h"
#include "experiment/ports/presenter.h"
#include "experiment/timing/virtual_refresh.h"
#include "render/gl/gl_objects.h"
#include "render/vblank/swap_watch.h"
#include "render/vblank/window_flips.h"

namespace overt {

class DisplaySurface {
  public:
    virtual ~DisplaySurface() = default;
    virtual DisplayTiming timing() const = 0;

    /// Makes the canvas visible at the next refresh and returns when that has begun. Allocates and throws
    /// nothing.
    virtual FlipReport present(const Framebuffer& canvas) noexcept = 0;
    /// The same of a canvas for each eye, through shutters.
    virtual FlipReport present_pair(const Framebuffer& left, const Framebuffer& /*right*/) noexcept {
        return present(left);
    }
    virtual bool closed() const noexcept = 0;

    /// Whether the mouse's pointer is seen, where there is one that would be hidden.
    virtual void show_pointer(bool /*is_shown*/) noexcept {}

    /// See Presenter::take_swap_modes().
    virtual std::optional<SwapModes> take_swap_modes() noexcept { return {}; }

    /// Why, once closed().
    virtual std::string why_closed() const { return "the display was closed"; }

    /// What a channel's byte, or ten bits, have in the framebuffer that is scanned out.
    virtual int bits_per_channel() const = 0;

    /// The pixels that present() sends for a canvas, read back from where the display takes them: top row
    /// first, in `format`.
    virtual void read(const Framebuffer& canvas, PixelFormat format, std::span<std::byte> into) = 0;
};

/// Copies a canvas into a framebuffer of its size as a window takes it: the canvas holds its top row first, a
/// window its bottom row.
void copy_for_window(const GladGLContext& gl, const Framebuffer& canvas, unsigned int into) noexcept;

/// Headless: the canvas stays in memory, in whatever depth it has.
class VirtualDisplay final : public DisplaySurface {
  public:
    VirtualDisplay(const GlContext& context, Clock& clock, double refresh_hz, int bits_per_channel = 8,
                   DisplayFaults faults = {})
        : context_(&context), clock_(&clock), refresh_(clock, refresh_hz, std::move(faults)),
          bits_per_channel_(bits_per_channel) {}
    DisplayTiming timing() const override { return refresh_.timing(); }
    FlipReport present(const Framebuffer& canvas) noexcept override;
    bool closed() const noexcept override { return false; }
    int bits_per_channel() const override { return bits_per_channel_; }
    void read(const Framebuffer& canvas, PixelFormat format, std::span<std::byte> into) override;
    VirtualRefresh& refresh() { return refresh_; }

  private:
    const GlContext* context_;
    Clock* clock_;
    VirtualRefresh refresh_;
    int bits_per_channel_;
};

/// A window. In virtual time it shows everything as fast as it can and takes its times from the virtual
/// clock.
class WindowDisplay final : public DisplaySurface {
  public:
    /// In real time, stamps are those of `vblanks`.
    WindowDisplay(WindowContext& window, Clock& clock, double refresh_hz, bool virtual_time,
                  DisplayFaults faults = {}, VblankChoice vblanks = {});
    DisplayTiming timing() const override;
    FlipReport present(const Framebuffer& canvas) noexcept override;
    /// Into the buffers of a window that was opened for two eyes.
    FlipReport present_pair(const Framebuffer& left, const Framebuffer& right) noexcept override;
    /// A black screen, in real time, for what is measured with it.
    FlipReport present_dark() noexcept;
    /// Of the source of times in real time: whether its blanks are real ones, and which better ones were
    /// refused, why.
    bool blanks_are_real() const { return blanks_are_real_; }
    const std::vector<std::string>& refused_sources() const { return refused_sources_; }
    std::optional<SwapModes> take_swap_modes() noexcept override {
        return watch_ ? watch_->take() : std::nullopt;
    }
    void show_pointer(bool is_shown) noexcept override { window_->show_pointer(is_shown); }
    bool closed() const noexcept override {
        return window_->close_requested() || window_->disturbance() != WindowDisturbance::none;
    }
    std::string why_closed() const override;
    int bits_per_channel() const override { return window_->bits_per_channel(); }
    /// What keeps its time in virtual time.
    VirtualRefresh& refresh() { return virtual_refresh_; }
    /// From the window's back buffer, into which the canvas is drawn once more.
    void read(const Framebuffer& canvas, PixelFormat format, std::span<std::byte> into) override;

  private:
    void draw_into_window(const Framebuffer& canvas) noexcept;
    FlipReport swapped(SessionTime requested) noexcept;

    WindowContext* window_;
    Clock* clock_;
    bool virtual_time_;
    VirtualRefresh virtual_refresh_;
    bool blanks_are_real_;
    std::vector<std::string> refused_sources_;
    SessionDuration uncertainty_; ///< of a source's stamps
    WindowFlips flips_;
    std::unique_ptr<SwapWatch> watch_; ///< in real time, where the server tells it
};

} // namespace overt
