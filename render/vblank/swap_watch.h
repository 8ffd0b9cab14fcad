/// Whether the pictures of a window are flipped to or copied, told by the server beside whatever source tells
/// when.
#pragma once

#include <memory>
#include <optional>

#include "experiment/swap_modes.h"
#include "render/vblank/present_listener.h"

namespace overt {

/// Completions gather at the connection until they are asked for, so that it costs nothing while pictures are
/// shown. For the thread of the window.
class SwapWatch {
  public:
    /// Null for a window that is not one of X11, or whose server has no Present.
    static std::unique_ptr<SwapWatch> of(const NativeWindow& window);

    /// Of the pictures shown since the last call. Asks the server and waits for its answer, so not for use
    /// between a presentation's first and last flip. None at all: the driver shows its pictures by other
    /// means. Nothing: the server is gone.
    std::optional<SwapModes> take() noexcept;

  private:
    explicit SwapWatch(const NativeWindow& window) : listener_(window) {}
    PresentListener listener_;
};

} // namespace overt
