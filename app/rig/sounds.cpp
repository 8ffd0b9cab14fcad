#include "app/rig/sounds.h"

#include <fmt/format.h>

#include "devices/sound/beeper.h"
#include "experiment/base/error.h"

namespace overt {

Sounds::Sounds(bool wanted) : description_("none") {
    if (!wanted)
        return;
    try {
        beeper_ = std::make_unique<Beeper>();
        description_ = beeper_->name();
    } catch (const DeviceError& error) {
        description_ = fmt::format("none: {}", error.what());
    }
}

Sounds::~Sounds() = default;

void Sounds::play(Beep beep) noexcept {
    if (beeper_)
        beeper_->play(beep);
}

} // namespace overt
