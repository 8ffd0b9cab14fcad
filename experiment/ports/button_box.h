/// The port of a response box: buttons whose times are known better than those of a keyboard, or that lie in
/// another hand.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "experiment/box_time.h"

namespace overt {

/// A button went down or up, or a knob was turned.
struct ButtonChange {
    int button = 0; ///< as the box numbers them, see ButtonBox::button_name()
    bool is_down = false;
    std::optional<BoxTime> device_time; ///< of the box's own clock, where it has one
    SessionTime at;                     ///< the estimate of when it happened
    SessionDuration uncertainty{};      ///< it happened within ± this of `at`
    // Of a knob: then it is no button's. Whole steps since the last change; clockwise seen from above, and
    // with the top towards the hand, are positive.
    int turn_steps = 0, tilt_steps = 0;

    bool is_turn() const { return turn_steps != 0 || tilt_steps != 0; }
};

struct ButtonBoxDescription {
    std::string name;       ///< the kind, such as "iolab"
    std::string model;      ///< as the box tells it
    bool has_clock = false; ///< else changes are timed by when they were fetched
};

/// On one thread. What is noexcept may be called while a presentation runs, and allocates and waits for
/// nothing.
class ButtonBox {
  public:
    virtual ~ButtonBox() = default;
    virtual ButtonBoxDescription description() const = 0;

    /// What is written on a button, or its number as a word.
    virtual std::string button_name(int button) const { return std::to_string(button); }

    /// Forgets what has happened so far and reads both clocks, where the box has one: before a trial, and not
    /// in it. Takes 100 ms at most. Throws DeviceError if the box does not answer.
    virtual void begin() = 0;

    /// The changes that have arrived, oldest first; gives their number. Call until it gives less than the
    /// span holds.
    virtual std::size_t poll(std::span<ButtonChange> into) noexcept = 0;

    /// The box was unplugged or does not answer any more. Stays true.
    virtual bool lost() const noexcept = 0;
};

} // namespace overt
