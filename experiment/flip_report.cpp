#include "experiment/flip_report.h"

namespace overt {

std::string_view name_of(VblankSource source) {
    switch (source) {
    case VblankSource::virtual_display:
        return "virtual display";
    case VblankSource::swap_return:
        return "return of the buffer swap";
    case VblankSource::glx_sync_control:
        return "GLX_OML_sync_control";
    case VblankSource::present_swap:
        return "X Present, the swap";
    case VblankSource::present_count:
        return "X Present, the count";
    case VblankSource::egl_sync_control:
        return "EGL_CHROMIUM_sync_control";
    case VblankSource::drm_vblank:
        return "DRM, the count";
    case VblankSource::glx_video_sync:
        return "GLX_SGI_video_sync";
    }
    return "unknown";
}

} // namespace overt
