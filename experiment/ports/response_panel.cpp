#include "experiment/ports/response_panel.h"

namespace overt {

std::string_view name_of(ResponsePress::Key key) noexcept {
    using Key = ResponsePress::Key;
    switch (key) {
    case Key::pause:
        return "pause";
    case Key::recalibrate:
        return "recalibrate";
    case Key::drift_check:
        return "drift check";
    case Key::repeat:
        return "repeat";
    case Key::reject:
        return "reject";
    case Key::skip:
        return "skip";
    case Key::abort:
        return "abort";
    default:
        return {};
    }
}

} // namespace overt
