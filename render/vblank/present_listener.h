/// What the Present extension of X completes for a window, heard over a connection of its own.
#pragma once

#include <cstdint>

#include <xcb/present.h>

#include "render/window/native_window.h"

namespace overt {

/// Who listens to a window is told of pictures of others, too: so the swaps of its driver are seen.
class PresentListener {
  public:
    /// Throws GraphicsError if the window is not one of X11, or its server does not offer Present for it.
    explicit PresentListener(const NativeWindow& window);
    ~PresentListener();
    PresentListener(const PresentListener&) = delete;
    PresentListener& operator=(const PresentListener&) = delete;

    /// The connection, for requests of one's own; owned here.
    xcb_connection_t* link() const noexcept { return link_; }

    /// The next completion that has arrived; false: none has. Does not wait.
    bool next(xcb_present_complete_notify_event_t& completion) noexcept;

  private:
    xcb_connection_t* link_;
    xcb_special_event_t* events_ = nullptr;
};

} // namespace overt
