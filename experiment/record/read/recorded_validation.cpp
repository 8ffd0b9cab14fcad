#include "experiment/record/read/recorded_validation.h"

#include <algorithm>
#include <charconv>
#include <string_view>

#include "experiment/ports/event_kinds.h"

namespace overt {
namespace {

std::optional<Degrees> degrees_after(std::string_view text, std::string_view words) {
    const std::size_t at = text.find(words);
    if (at == std::string_view::npos)
        return std::nullopt;
    text.remove_prefix(at + words.size());
    double degrees = 0.0;
    const auto result = std::from_chars(text.data(), text.data() + text.size(), degrees);
    return result.ec == std::errc() ? std::optional(Degrees{degrees}) : std::nullopt;
}

} // namespace

// "mean error 0.312 deg, largest 0.754 deg"
std::optional<ValidationResult> validation_of(const RecordedEvent& event) {
    if (event.kind != validation_event)
        return std::nullopt;
    const auto mean = degrees_after(event.detail, "mean error "),
               max = degrees_after(event.detail, "largest ");
    return mean && max ? std::optional(ValidationResult{*mean, *max}) : std::nullopt;
}

ValidationOfEye validation_of_eye(const ValidationResult& validation, Eye eye) {
    ValidationOfEye found{validation.mean_error, validation.max_error, {}};
    double sum_deg = 0.0, max_deg = 0.0;
    int measured = 0;
    for (const ValidatedTarget& target : validation.targets) {
        if (target.eye != eye)
            continue;
        found.targets.push_back(target);
        if (target.gaze) {
            sum_deg += target.error.value;
            max_deg = std::max(max_deg, target.error.value);
            ++measured;
        }
    }
    if (measured > 0) {
        found.mean_error = {sum_deg / measured};
        found.max_error = {max_deg};
    }
    return found;
}

} // namespace overt
