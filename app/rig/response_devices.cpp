#include "app/rig/response_devices.h"

#include "devices/simulated/simulated_response_panel.h"
#include "render/window/window_response_panel.h"

namespace overt {
namespace {

constexpr ResponseDevice known_devices[] = {
    {"simulated", [](const ResponseParts& parts) { return parts.simulate_observer; },
     [](const ResponseParts& parts, ResponsePanel*) -> std::unique_ptr<ResponsePanel> {
         return std::make_unique<SimulatedResponsePanel>(parts.clock, parts.observer, parts.operator_keys,
                                                         parts.answers);
     }},
    {"window keyboard", [](const ResponseParts& parts) { return parts.window != nullptr; },
     [](const ResponseParts& parts, ResponsePanel* answering) -> std::unique_ptr<ResponsePanel> {
         auto panel = std::make_unique<WindowResponsePanel>(
             *parts.window, parts.clock, parts.protocol.operators, parts.protocol.consent, answering);
         panel->take_places_by([&protocol = parts.protocol](glm::dvec2 from_middle_px) {
             return in_field(protocol, from_middle_px);
         });
         return panel;
     }},
};

} // namespace

std::span<const ResponseDevice> response_devices() { return known_devices; }

std::vector<std::unique_ptr<ResponsePanel>> make_response_devices(const ResponseParts& parts,
                                                                  std::span<const ResponseDevice> among) {
    std::vector<std::unique_ptr<ResponsePanel>> made;
    for (const ResponseDevice& device : among)
        if (device.is_used(parts))
            made.push_back(device.make(parts, made.empty() ? nullptr : made.back().get()));
    return made;
}

} // namespace overt
