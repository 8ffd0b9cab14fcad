// GLX_OML_sync_control and EGL_CHROMIUM_sync_control: three numbers of a drawable, read together. UST is the
// time of the last vertical blank in microseconds, MSC its count, SBC how many swaps have been lit.
#include <cstring>
#include <ctime>

#include "experiment/base/error.h"
#include "render/vblank/vblank_sources.h"

namespace overt {
namespace {

struct SyncValues {
    std::int64_t ust = 0, msc = 0, sbc = 0;
};

class SyncControlClock : public VblankClock {
  public:
    explicit SyncControlClock(const Clock& clock) : clock_(&clock), time_(clock) {}

    std::optional<VblankStamp> last() noexcept override {
        SyncValues values;
        if (!read(values))
            return std::nullopt;
        swaps_before_ = values.sbc;
        return stamp_of(values);
    }

    std::optional<VblankStamp> await(std::int64_t count) noexcept override {
        return poll([count](const SyncValues& values) { return values.msc >= count; });
    }

    std::optional<VblankStamp> after_swap(const VblankStamp&) noexcept override {
        // Asked again and again instead of waiting in the library, which on a screen that went dark would be
        // for ever.
        const std::int64_t swap = swaps_before_ + 1;
        std::optional<VblankStamp> lit =
            poll([swap](const SyncValues& values) { return values.sbc >= swap; });
        SyncValues values;
        return lit && read_of_swap(swap, values) ? stamp_of(values) : lit;
    }

  protected:
    virtual bool read(SyncValues& values) noexcept = 0;
    /// Of a swap that has been lit: its own refresh, where the system remembers it.
    virtual bool read_of_swap(std::int64_t, SyncValues&) noexcept { return false; }

  private:
    VblankStamp stamp_of(const SyncValues& values) const noexcept {
        return {values.msc, time_.of_microseconds(values.ust)};
    }

    template <class Reached> std::optional<VblankStamp> poll(Reached reached) noexcept {
        const SessionTime end = clock_->now() + patience;
        for (SyncValues values; read(values); nanosleep(&between_questions, nullptr)) {
            if (reached(values))
                return stamp_of(values);
            if (clock_->now() > end)
                break;
        }
        return std::nullopt;
    }

    const Clock* clock_;
    MonotonicTime time_;
    std::int64_t swaps_before_ = 0;
};

/// Types as in the specification of the extension; Bool is int, a drawable an XID.
class GlxSyncControl final : public SyncControlClock {
  public:
    GlxSyncControl(const NativeWindow& window, const Clock& clock)
        : SyncControlClock(clock), display_(window.x11_display), drawable_(window.glx_drawable) {
        if (!display_ || drawable_ == 0)
            throw GraphicsError("the context is not GLX's");
        using Extensions = const char* (*)(void*, int);
        const auto extensions = reinterpret_cast<Extensions>(window.function("glXQueryExtensionsString"));
        const char* const offered = extensions ? extensions(display_, 0) : nullptr;
        if (!offered || !std::strstr(offered, "GLX_OML_sync_control"))
            throw GraphicsError("the server does not offer it");
        read_ = reinterpret_cast<Read>(window.function("glXGetSyncValuesOML"));
        wait_ = reinterpret_cast<Wait>(window.function("glXWaitForSbcOML"));
        if (!read_ || !wait_)
            throw GraphicsError("the library lacks its functions");
    }
    VblankSource source() const noexcept override { return VblankSource::glx_sync_control; }

  protected:
    bool read(SyncValues& values) noexcept override {
        return read_(display_, drawable_, &values.ust, &values.msc, &values.sbc) != 0;
    }
    bool read_of_swap(std::int64_t swap, SyncValues& values) noexcept override {
        return wait_(display_, drawable_, swap, &values.ust, &values.msc, &values.sbc) != 0;
    }

  private:
    using Read = int (*)(void*, unsigned long, std::int64_t*, std::int64_t*, std::int64_t*);
    using Wait = int (*)(void*, unsigned long, std::int64_t, std::int64_t*, std::int64_t*, std::int64_t*);
    void* display_;
    unsigned long drawable_;
    Read read_ = nullptr;
    Wait wait_ = nullptr;
};

class EglSyncControl final : public SyncControlClock {
  public:
    EglSyncControl(const NativeWindow& window, const Clock& clock)
        : SyncControlClock(clock), display_(window.egl_display), surface_(window.egl_surface) {
        if (!display_ || !surface_)
            throw GraphicsError("the context is not EGL's");
        using Query = const char* (*)(void*, int);
        const auto query = reinterpret_cast<Query>(window.function("eglQueryString"));
        constexpr int egl_extensions = 0x3055;
        const char* const offered = query ? query(display_, egl_extensions) : nullptr;
        if (!offered || !std::strstr(offered, "EGL_CHROMIUM_sync_control"))
            throw GraphicsError("the display does not offer it");
        read_ = reinterpret_cast<Read>(window.function("eglGetSyncValuesCHROMIUM"));
        if (!read_)
            throw GraphicsError("the library lacks its function");
    }
    VblankSource source() const noexcept override { return VblankSource::egl_sync_control; }

  protected:
    bool read(SyncValues& values) noexcept override {
        return read_(display_, surface_, &values.ust, &values.msc, &values.sbc) != 0;
    }

  private:
    using Read = unsigned int (*)(void*, void*, std::int64_t*, std::int64_t*, std::int64_t*);
    void *display_, *surface_;
    Read read_ = nullptr;
};

} // namespace

std::unique_ptr<VblankClock> open_glx_sync_control(const NativeWindow& window, const Clock& clock) {
    return std::make_unique<GlxSyncControl>(window, clock);
}

std::unique_ptr<VblankClock> open_egl_sync_control(const NativeWindow& window, const Clock& clock) {
    return std::make_unique<EglSyncControl>(window, clock);
}

} // namespace overt
