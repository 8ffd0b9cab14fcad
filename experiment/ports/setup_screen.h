/// The port through which a tracker's set-up shows its targets and camera images, beeps, and reads keys. The
/// session lends it to the tracker (or to a calibration of the program's own) for the time of a calibration.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "experiment/ports/beep.h"
#include "experiment/ports/validation.h"
#include "experiment/screen_geometry.h"
#include "experiment/session_time.h"
#include "experiment/units.h"

namespace overt {

/// What a tracker's camera sees, top row first, four bytes a pixel: red, green, blue, and one not used.
struct CameraImage {
    int width_px = 0, height_px = 0;
    std::vector<std::byte> rgba;
    std::string title; ///< UTF-8, such as which eye and the thresholds
};

/// A key of the operator, for the tracker's host or for the program's own calibration.
struct SetupKey {
    enum class Kind : std::uint8_t {
        character, ///< a letter, digit or sign: see `character`
        enter,
        escape,
        space,
        backspace,
        tab,
        up,
        down,
        left,
        right,
        page_up,
        page_down,
        function ///< `character` is its number, from 1
    };
    Kind kind = Kind::character;
    char32_t character = 0;
    bool shift = false, control = false, alt = false;
};

/// Not for use between a presentation's first and last flip; on the session's thread.
class SetupScreen {
  public:
    virtual ~SetupScreen() = default;
    virtual const ScreenGeometry& geometry() const = 0;
    /// Shows a target with its middle at `place` on an otherwise empty screen; gives when it was lit.
    /// `diameter`: of its outer disc.
    virtual SessionTime show_target(ScreenPoint place, Degrees diameter) = 0;
    /// Shows nothing but the background.
    virtual SessionTime clear() = 0;
    virtual void show_camera(const CameraImage& image) = 0;
    /// Shows words to the operator (UTF-8), such as what keys do.
    virtual void show_text(const std::string& text) = 0;
    /// Shows where each target was and where gaze was measured, with the words below.
    virtual void show_result(const ValidationResult& result, const std::string& text) = 0;
    virtual void beep(Beep beep) = 0;
    /// The next key that was pressed, if there was one.
    virtual std::optional<SetupKey> next_key() = 0;
    virtual SessionTime now() const noexcept = 0;
    /// Lets this much time pass; the window stays alive.
    virtual void wait(SessionDuration time) = 0;
    /// The display was closed or the operator ended the set-up: it is to return as soon as it can.
    virtual bool is_cancelled() const noexcept = 0;

    /// Takes the keys that were pressed: whether it was cancelled, or the operator wants it to be (Escape).
    bool wants_out() {
        bool escaped = is_cancelled();
        while (const std::optional<SetupKey> key = next_key())
            escaped = escaped || key->kind == SetupKey::Kind::escape;
        return escaped;
    }
};

} // namespace overt
