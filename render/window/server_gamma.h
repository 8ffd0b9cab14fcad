/// The gamma that an X server reckons into every monitor's table, as `xgamma` sets it.
#pragma once

struct xcb_connection_t;

namespace overt {

/// Values that leave as they are have 1.
struct ServerGamma {
    double red = 1.0, green = 1.0, blue = 1.0;
    bool operator==(const ServerGamma&) const = default;
};

/// Of an X screen. RandR's table does not show it: it is asked for by XFree86-VidModeExtension. All 1 where a
/// server lacks that. Throws nothing.
ServerGamma server_gamma(xcb_connection_t* link, int screen);

/// Of the screen that DISPLAY names; all 1 without an X server.
ServerGamma server_gamma();

} // namespace overt
