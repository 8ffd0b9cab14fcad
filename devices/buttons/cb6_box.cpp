#include "devices/buttons/cb6_box.h"

#include <fmt/format.h>

#include "devices/buttons/button_box_device.h"
#include "experiment/base/error.h"

namespace overt {
namespace {

constexpr int infrared_buttons = 6, box_clock_readings = 3;

} // namespace

Cb6Box::Cb6Box(DisplayPlusPlus& box, Clock& clock) : box_(&box), clock_(&clock) { begin(); }

Cb6Box::~Cb6Box() {
    try {
        box_->stop_status();
    } catch (const Error&) { // it is gone, and then the session knows
    }
}

ButtonBoxDescription Cb6Box::description() const {
    return {"cb6", fmt::format("{} {}", box_->identity().product, box_->identity().serial_number), true};
}

std::string Cb6Box::button_name(int button) const {
    if (button >= 1 && button <= infrared_buttons)
        return std::string(1, static_cast<char>('A' + button - 1));
    return fmt::format("Din{}", button - infrared_buttons - 1);
}

void Cb6Box::begin() {
    // The box's clock may have been set to zero since: only what is read now counts.
    std::vector<BoxClockPair> pairs;
    for (int i = 0; i < box_clock_readings; ++i)
        pairs.push_back(box_->read_clocks());
    map_.emplace(pairs);
    edges_ = BoxEdgeDetector();
    held_count_ = given_ = 0;
    box_->start_status();
}

void Cb6Box::keep(const BoxEvent& event) noexcept {
    int button = event.input.index + 1;
    if (event.input.kind == BoxInput::Kind::digital)
        button += infrared_buttons;
    else if (event.input.kind != BoxInput::Kind::infrared)
        return;
    // It happened between two samples.
    const MappedTime from = map_->to_session(event.not_before), to = map_->to_session(event.at);
    ButtonChange change;
    change.button = button;
    change.is_down = event.active;
    change.device_time = event.at;
    change.at = from.time + (to.time - from.time) / 2;
    change.uncertainty = (to.time - from.time) / 2 + std::max(from.uncertainty, to.uncertainty);
    held_[held_count_++] = change;
}

std::size_t Cb6Box::poll(std::span<ButtonChange> into) noexcept {
    std::size_t taken = 0;
    for (;;) {
        while (taken < into.size() && given_ < held_count_)
            into[taken++] = held_[given_++];
        if (taken == into.size())
            return taken;
        held_count_ = given_ = 0;
        ArrivedStatus sample;
        if (box_->poll_status({&sample, 1}) == 0)
            return taken;
        for (const BoxEvent& event : edges_.feed(sample.sample))
            keep(event);
    }
}

template <> ButtonBoxDevice button_box_device_of<kind_called<ButtonBoxKind>("cb6")>() {
    return {.open = [](const ButtonBoxParts& parts) -> std::unique_ptr<ButtonBox> {
        if (!parts.display_box)
            throw DeviceError(
                "a CB6 is read through the Display++ or Bits#, which this session does not use: it has "
                "no real screen in real time");
        return std::make_unique<Cb6Box>(*parts.display_box, parts.clock);
    }};
}

} // namespace overt
