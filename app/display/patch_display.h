/// Plain patches on a display, to be looked at by a photometer.
#pragma once

#include <memory>
#include <optional>

#include "app/rig/open_display.h"
#include "render/presenter/page_presenter.h"

namespace overt {

struct PatchDisplayRequest {
    DisplaySettings display; ///< gamma, characterisation and background have no part in it
    ContextChoice context;
    bool virtual_time = false;
    bool windowed = false;
    std::string monitor;   ///< see WindowRequest
    double size_deg = 0.0; ///< side of the square patch; 0: the whole screen
    double surround = 0.0; ///< signal around it
};

/// The whole way to the display without its last curve: what is shown is the signal itself.
class PatchDisplay {
  public:
    /// Opens the display. Throws GraphicsError, and InputError for an output that shows greys only or a patch
    /// that is larger than the screen.
    explicit PatchDisplay(const PatchDisplayRequest& request);
    ~PatchDisplay();

    /// Shows a signal of 0 … 1 in red, green and blue for so long, and gives the signal that the display
    /// received, read back from where it takes it and decoded: a level of the mode's.
    glm::dvec3 show(const glm::dvec3& signal, double seconds);

    /// Somebody pressed Escape or closed the window.
    bool is_cancelled();

  private:
    class Page;
    glm::dvec3 received_signal() const;

    OutputMode mode_;
    ScreenGeometry geometry_;
    OpenDisplay display_;
    std::unique_ptr<Page> page_;
    std::unique_ptr<PagePresenter> presenter_;
    int shown_ = 0;
    bool is_cancelled_ = false;
};

} // namespace overt
