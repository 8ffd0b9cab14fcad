/// Marks by which a tracker, and whoever reads what it recorded, know a trial and what it shows.
#pragma once

#include <charconv>
#include <optional>
#include <string_view>

namespace overt {

inline constexpr std::string_view trial_mark = "TRIALID "; ///< followed by the trial's number, from 1
/// When a stimulus was taken away. No word that ends in END: readers of recordings look for that anywhere in
/// a line, and take it for the end of a recording.
inline constexpr std::string_view presentation_end_mark = "PRESENTATION_OFFSET";

/// Whether a mark begins a trial, or a practice trial.
inline bool begins_trial(std::string_view mark) noexcept { return mark.starts_with(trial_mark); }

/// The index of the trial that a mark begins, from 0; nothing for practice, and for all other marks.
inline std::optional<int> trial_of_mark(std::string_view mark) noexcept {
    if (!begins_trial(mark))
        return std::nullopt;
    const std::string_view number = mark.substr(trial_mark.size());
    int trial = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), trial);
    const bool is_number = error == std::errc() && end == number.data() + number.size() && trial >= 1;
    return is_number ? std::optional(trial - 1) : std::nullopt;
}

} // namespace overt
