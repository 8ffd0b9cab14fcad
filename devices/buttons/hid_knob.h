/// Knobs: HID dials, which tell how far they were turned, and 3D mice, which tell how far they are held.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "devices/buttons/hid_button_box.h"
#include "devices/hid/hid_line.h"
#include "experiment/ports/button_box.h"
#include "experiment/protocol/device_settings.h"

namespace overt {

/// One axis of a knob as whole steps. Pure; nothing allocates.
class KnobAxis {
  public:
    /// Of a dial: adds what it was turned by.
    void add(double steps) noexcept { steps_ += steps; }

    /// Of a 3D mouse: is held at this deflection, -1 … 1, from now on. Until then it went on as it was held
    /// before, but for no longer than `longest_hold` after the report that said so, so that a report of a
    /// release that is lost lets nothing turn on.
    void hold(double deflection, double full_steps_s, double dead_zone, SessionTime at) noexcept;
    /// Goes on as it is held.
    void go_on(SessionTime now) noexcept;

    /// The whole steps since they were taken last; what is left of one stays for the next, until it is let
    /// go.
    int take_steps() noexcept;
    void forget() noexcept { *this = {}; }

    static constexpr SessionDuration longest_hold = std::chrono::milliseconds(100);

  private:
    double steps_ = 0.0, steps_s_ = 0.0;
    SessionTime gone_to_{}, held_until_{};
};

/// What its reports say, by the device's own report descriptor (HID Usage Tables 1.3, page 01 Generic
/// Desktop): of a dial, the relative values Dial (37 hex) and Wheel (38 hex), clockwise positive; of a 3D
/// mouse, Rz (35 hex), twisted clockwise seen from above, and Rx (33 hex), with its top towards the hand,
/// both positive, wherever in its reports they are: older ones have translations and rotations in reports of
/// their own, newer ones all in one. Nothing of it has been tried on a device.
class HidKnob final : public ButtonBox {
  public:
    /// `settings`: of kind dial or spacemouse. `clock` must outlive this. Throws DeviceError if the
    /// descriptor has no such values.
    HidKnob(std::unique_ptr<HidLine> line, const HidDescriptor& descriptor, std::string model,
            const ButtonBoxSettings& settings, Clock& clock);

    ButtonBoxDescription description() const override {
        return {std::string(row_of(settings_.kind).name), model_, false};
    }
    std::string button_name(int button) const override { return hid_button_name(button); }
    void begin() override;
    std::size_t poll(std::span<ButtonChange> into) noexcept override;
    bool lost() const noexcept override { return line_->lost(); }

  private:
    bool is_dial() const noexcept;
    void take(std::span<const std::byte> report, SessionTime now) noexcept;
    void note_turns(SessionTime now) noexcept;

    std::unique_ptr<HidLine> line_;
    Clock* clock_;
    std::string model_;
    ButtonBoxSettings settings_;
    bool has_ids_ = false;
    std::vector<HidField> turns_, tilts_;
    HidButtons buttons_;
    KnobAxis turn_, tilt_;
    std::vector<std::byte> report_;
    std::vector<ButtonChange> held_; ///< for which there was no room
    std::size_t given_ = 0;
    SessionTime looked_;
};

/// Whether a descriptor has what a kind of knob tells.
bool is_dial(const HidDescriptor& descriptor);
bool is_spacemouse(const HidDeviceInfo& device);

} // namespace overt
