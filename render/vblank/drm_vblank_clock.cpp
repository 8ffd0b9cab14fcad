// The kernel's vertical blanks (DRM_IOCTL_CRTC_GET_SEQUENCE, Linux 4.15): the count of a controller with its
// time in nanoseconds of CLOCK_MONOTONIC. Any program that may open the card may ask, master or not.
#include <cerrno>
#include <cstring>
#include <ctime>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <glob.h>
#include <unistd.h>
#include <xf86drm.h>
#include <xf86drmMode.h>

#include "experiment/base/error.h"
#include "render/vblank/vblank_sources.h"
#include "render/window/screen_output.h"

namespace overt {
namespace {

struct Card {
    int file = -1;
    explicit Card(const char* path) : file(open(path, O_RDWR | O_CLOEXEC)) {}
    Card(Card&& other) noexcept : file(std::exchange(other.file, -1)) {}
    Card& operator=(Card&&) = delete;
    ~Card() {
        if (file >= 0)
            close(file);
    }
};

/// The controller that feeds a connector now; 0 if this card has no such connector, or it is dark.
std::uint32_t controller_of(const Card& card, std::uint32_t connector) {
    std::uint32_t controller = 0;
    if (drmModeConnector* const found = drmModeGetConnectorCurrent(card.file, connector)) {
        if (drmModeEncoder* const encoder = drmModeGetEncoder(card.file, found->encoder_id)) {
            controller = encoder->crtc_id;
            drmModeFreeEncoder(encoder);
        }
        drmModeFreeConnector(found);
    }
    return controller;
}

class DrmVblankClock final : public VblankClock {
  public:
    DrmVblankClock(Card card, std::uint32_t controller, const Clock& clock)
        : card_(std::move(card)), controller_(controller), clock_(&clock), time_(clock) {}

    VblankSource source() const noexcept override { return VblankSource::drm_vblank; }

    std::optional<VblankStamp> last() noexcept override {
        std::uint64_t count = 0, nanoseconds = 0;
        if (drmCrtcGetSequence(card_.file, controller_, &count, &nanoseconds) != 0)
            return std::nullopt;
        return VblankStamp{static_cast<std::int64_t>(count),
                           time_.of_nanoseconds(static_cast<std::int64_t>(nanoseconds))};
    }

    std::optional<VblankStamp> await(std::int64_t count) noexcept override {
        const SessionTime end = clock_->now() + patience;
        for (;;) {
            const std::optional<VblankStamp> stamp = last();
            if (!stamp || stamp->count >= count)
                return stamp;
            if (clock_->now() > end)
                return std::nullopt;
            nanosleep(&between_questions, nullptr);
        }
    }

  private:
    Card card_;
    std::uint32_t controller_;
    const Clock* clock_;
    MonotonicTime time_;
};

} // namespace

std::unique_ptr<VblankClock> open_drm_vblank(const NativeWindow& window, const Clock& clock) {
    const std::optional<std::uint32_t> connector = examine_output(window).connector;
    if (!connector)
        throw GraphicsError("the X server does not say which connector of the kernel shows the window");
    glob_t cards{};
    std::string reasons;
    std::unique_ptr<VblankClock> source;
    if (glob("/dev/dri/card*", 0, nullptr, &cards) == 0) {
        for (std::size_t i = 0; i < cards.gl_pathc && !source; ++i) {
            Card card(cards.gl_pathv[i]);
            if (card.file < 0)
                reasons += fmt::format(", {}: {}", cards.gl_pathv[i], std::strerror(errno));
            else if (const std::uint32_t controller = controller_of(card, *connector))
                source = std::make_unique<DrmVblankClock>(std::move(card), controller, clock);
        }
    }
    globfree(&cards);
    if (!source)
        throw GraphicsError(fmt::format("no card in /dev/dri has a lit connector {}{}", *connector, reasons));
    return source;
}

} // namespace overt
