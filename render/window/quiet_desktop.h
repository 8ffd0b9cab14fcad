/// Keeps a desktop from what it does when nobody types: screen savers, screens that switch off,
/// notifications.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "render/window/native_window.h"
#include "render/window/screen_check.h"

namespace overt {

/// For as long as it lives, and no longer however the program ends: what is asked for is bound to connections
/// of its own, to the X server (MIT-SCREEN-SAVER 1.1, with which DPMS is held back as well) and to the
/// session's D-Bus (org.freedesktop.ScreenSaver of the Idle Inhibition Service, org.freedesktop.Notifications
/// of desktops that can be asked to be quiet).
class QuietDesktop {
  public:
    /// Asks all of them; throws nothing.
    explicit QuietDesktop(const NativeWindow& window);
    ~QuietDesktop();

    /// What was granted, and, as risks, what was not.
    const std::vector<ScreenFinding>& findings() const { return findings_; }

  private:
    struct Connections;
    std::unique_ptr<Connections> connections_;
    std::vector<ScreenFinding> findings_;
};

} // namespace overt
