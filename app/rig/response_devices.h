/// The devices by which observer and operator answer in a session: one row for each.
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "experiment/ports/clock.h"
#include "experiment/ports/response_panel.h"
#include "experiment/protocol/protocol.h"

namespace overt {

class SimulatedAnswers;
class SimulatedObserver;
class WindowContext;
struct ScriptedOperatorKey;

/// What a response device can be made from. All of it must outlive the device.
struct ResponseParts {
    const Protocol& protocol;
    const Clock& clock;
    const SimulatedObserver& observer;
    WindowContext* window = nullptr; ///< null in a session without a window
    bool simulate_observer = false;
    const std::vector<ScriptedOperatorKey>& operator_keys; ///< of a simulated operator
    const SimulatedAnswers* answers = nullptr;             ///< of the simulated observer, by keys
};

struct ResponseDevice {
    std::string_view name;
    bool (*is_used)(const ResponseParts& parts) = nullptr;
    /// `answering`: the device of a row above that is used too, and that this one asks as well; null if there
    /// is none.
    std::unique_ptr<ResponsePanel> (*make)(const ResponseParts& parts, ResponsePanel* answering) = nullptr;
};

/// All of them.
std::span<const ResponseDevice> response_devices();

/// Those that a session uses. It asks the last of them, which asks the others.
std::vector<std::unique_ptr<ResponsePanel>>
make_response_devices(const ResponseParts& parts, std::span<const ResponseDevice> among = response_devices());

} // namespace overt
