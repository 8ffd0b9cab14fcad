/// Game pads and boxes that present themselves as keyboards or joysticks, by their own report descriptor.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "devices/hid/hid_line.h"
#include "experiment/ports/button_box.h"

namespace overt {

/// Numbers of keys of keyboards begin here: 256 + the number of the usage page Keyboard.
inline constexpr int first_key_number = 256;

/// Which buttons and keys reports say to be down. Nothing allocates after construction.
class HidButtons {
  public:
    explicit HidButtons(const HidDescriptor& descriptor);

    bool has_any() const noexcept { return !states_.empty(); }

    /// Takes a report and calls on_change(number, is_down) for each button that it changes. Reports that say
    /// that too many keys are down to tell which, and those of other ids, change nothing.
    template <class OnChange> void take(std::span<const std::byte> report, OnChange&& on_change) noexcept;

    /// Takes what has come so far, at most a thousand reports: it is known then what is down. `report`: room
    /// for one. Throws DeviceError if the device is lost.
    void read_away(HidLine& line, std::span<std::byte> report, Clock& clock);

  private:
    struct State {
        int number = 0;
        std::uint8_t report_id = 0;
        bool is_down = false, was_down = false;
    };
    bool read(std::span<const std::byte> report) noexcept;

    bool has_ids_ = false;
    std::vector<HidField> fields_;
    std::vector<State> states_; ///< by number
};

/// "1" for a button, "a", "5", "enter" or "key 57" for a key.
std::string hid_button_name(int button);

class HidButtonBox final : public ButtonBox {
  public:
    /// `descriptor`: of the device. `clock` must outlive this. Throws DeviceError if it has neither buttons
    /// nor keys.
    HidButtonBox(std::unique_ptr<HidLine> line, const HidDescriptor& descriptor, std::string model,
                 Clock& clock);

    ButtonBoxDescription description() const override { return {"hid", model_, false}; }
    std::string button_name(int button) const override { return hid_button_name(button); }
    void begin() override;
    std::size_t poll(std::span<ButtonChange> into) noexcept override;
    bool lost() const noexcept override { return line_->lost(); }

  private:
    std::unique_ptr<HidLine> line_;
    Clock* clock_;
    std::string model_;
    HidButtons buttons_;
    std::vector<std::byte> report_;
    std::vector<ButtonChange> held_; ///< of the last report, for which there was no room
    std::size_t given_ = 0;
    SessionTime looked_;
};

template <class OnChange>
void HidButtons::take(std::span<const std::byte> report, OnChange&& on_change) noexcept {
    if (!read(report))
        return;
    for (State& state : states_) {
        if (state.is_down != state.was_down)
            on_change(state.number, state.is_down);
        state.was_down = state.is_down;
    }
}

} // namespace overt
