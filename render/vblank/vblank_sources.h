/// The sources of vertical blanks there are for a window. Each open_… throws GraphicsError with the reason if
/// its source is not there.
#pragma once

#include <memory>

#include "render/vblank/vblank_clock.h"
#include "render/window/native_window.h"

namespace overt {

/// GLX_OML_sync_control: the server's count and time, and which refresh a swap was lit at.
std::unique_ptr<VblankClock> open_glx_sync_control(const NativeWindow& window, const Clock& clock);

/// GLX_SGI_video_sync: counts refreshes, on a thread that waits for each. What NVIDIA's own driver offers in
/// the place of GLX_OML_sync_control.
std::unique_ptr<VblankClock> open_glx_video_sync(const NativeWindow& window, const Clock& clock);

/// EGL_CHROMIUM_sync_control: as GLX_OML_sync_control where the context is EGL's.
std::unique_ptr<VblankClock> open_egl_sync_control(const NativeWindow& window, const Clock& clock);

/// The Present extension of X: counts the refreshes of the window's screen. A driver that shows swaps through
/// it (DRI3) tells at which refresh each was lit, whichever source is asked.
std::unique_ptr<VblankClock> open_x_present(const NativeWindow& window, const Clock& clock);

/// The kernel's own count for the screen that shows the window. Cards must be readable by the user (group
/// video), and the server must say which connector of the kernel its output is.
std::unique_ptr<VblankClock> open_drm_vblank(const NativeWindow& window, const Clock& clock);

} // namespace overt
