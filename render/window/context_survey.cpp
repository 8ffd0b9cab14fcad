#include "render/window/context_survey.h"

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "render/window/window_context.h"
#include "render/window/window_system.h"

namespace overt {

std::vector<ContextAttempt> survey_contexts() {
    std::vector<ContextAttempt> found = survey_headless_contexts();
    std::string outcome = "refused: no display (DISPLAY and WAYLAND_DISPLAY are not set)";
    if (display_is_available()) {
        try {
            outcome = summary_of(WindowContext({{64, 64}, "overt", false, false}).description());
        } catch (const GraphicsError& error) {
            outcome = fmt::format("refused: {}", error.what());
        }
    }
    found.push_back({ContextKind::window, outcome});
    return found;
}

} // namespace overt
