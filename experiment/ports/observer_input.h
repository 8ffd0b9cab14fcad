/// What the observer does at a device while something is to be answered.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

#include "experiment/base/enum_names.h"
#include "experiment/session_time.h"

namespace overt {

/// A short name that lies in no memory of its own: a presentation must not allocate. Longer ones are cut off.
class ShortName {
  public:
    static constexpr std::size_t capacity = 31;
    constexpr ShortName() = default;
    constexpr ShortName(std::string_view name) noexcept
        : length_(static_cast<std::uint8_t>(std::min(name.size(), capacity))) {
        std::copy_n(name.begin(), length_, letters_.begin());
    }
    constexpr std::string_view view() const noexcept { return {letters_.data(), length_}; }
    friend constexpr bool operator==(const ShortName& a, const ShortName& b) noexcept {
        return a.view() == b.view();
    }

  private:
    std::array<char, capacity> letters_{};
    std::uint8_t length_ = 0;
};

/// A press, a release, a movement. What it answers is decided by who asks (experiment/answers).
struct ObserverInput {
    enum class Kind : std::uint8_t {
        key_down, ///< a key or a button of a response box; a key that repeats while it is held does not come
                  ///< again
        key_up,
        text,          ///< a character that keys wrote, composed where the layout composes; U'\b' of a
                       ///< backspace that repeats
        pointer_moved, ///< to `right_px`, `down_px`
        pointer_down,  ///< the button `button` of the mouse, there
        pointer_up,
        wheel,  ///< by `steps`: of the mouse away from the hand is positive
        dial,   ///< by `steps`: clockwise is positive
        let_go, ///< the keyboard went to another window: whatever was held counts as released
        tilt    ///< of a knob, by `steps`: with its top towards the hand is positive
    };
    Kind kind = Kind::key_down;
    SessionTime at{};
    /// A key of the keyboard came so long before `at` at most; of a box, within ± this.
    SessionDuration uncertainty{};
    ShortName device{}; ///< "keyboard", "mouse", or the box as the protocol calls it
    ShortName key{}; ///< what is written on it, in the words of [operator] keys: "7", "f", "left", "space",
                     ///< "enter", "escape"
    char32_t character = 0;
    /// From the middle of the screen, in pixels of the display (not of the window where the desktop enlarges
    /// it).
    double right_px = 0.0, down_px = 0.0;
    int button = 0; ///< 1 left, 2 middle, 3 right
    double steps = 0.0;
};

/// As the record calls them.
template <>
inline constexpr auto names_of<ObserverInput::Kind> =
    enum_names<ObserverInput::Kind>("key down", "key up", "text", "pointer moved", "pointer down",
                                    "pointer up", "wheel", "dial", "let go", "tilt");

} // namespace overt
