#include "experiment/gaze_event.h"

#include <array>

namespace overt {
namespace {

constexpr std::array<std::string_view, 9> names{"fixation", "saccade", "blink", "message", "button",
                                                "input",    "started", "ended", "note"};

} // namespace

std::string_view name_of(GazeEvent::Kind kind) { return names[static_cast<std::size_t>(kind)]; }

bool is_eye_event(GazeEvent::Kind kind) {
    using Kind = GazeEvent::Kind;
    return kind == Kind::fixation || kind == Kind::saccade || kind == Kind::blink;
}

std::optional<GazeEvent::Kind> gaze_event_kind(std::string_view word) {
    for (std::size_t i = 0; i < names.size(); ++i)
        if (names[i] == word)
            return static_cast<GazeEvent::Kind>(i);
    return std::nullopt;
}

} // namespace overt
