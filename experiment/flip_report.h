/// What is known of one refresh of the display: the row of the flip ledger.
#pragma once

#include <cstdint>
#include <string_view>

#include "experiment/animation.h"
#include "experiment/session_time.h"

namespace overt {

/// Counts refreshes of the display since the presenter was opened.
struct RefreshIndex {
    std::int64_t value = 0;
    friend constexpr auto operator<=>(const RefreshIndex&, const RefreshIndex&) = default;
};

/// Where a time of vertical blank comes from.
enum class VblankSource : std::uint8_t {
    virtual_display, ///< our own display clock: exact by construction
    swap_return,     ///< the time at which the buffer swap and a glFinish returned
};
std::string_view name_of(VblankSource source);

/// The refresh at which a picture became visible, in session time.
struct FlipReport {
    RefreshIndex refresh;
    SessionTime requested;      ///< when flip() was called
    SessionTime swapped;        ///< when the swap had been handed over
    SessionTime vertical_blank; ///< when scan-out of this refresh began
    VblankSource source = VblankSource::virtual_display;
    int missed_refreshes = 0; ///< refreshes that went by with the old picture since the one asked for
};

/// A row of the ledger: what was planned for a refresh of a presentation, and what was shown.
struct FlipRecord {
    int trial = 0;
    int refresh_in_trial = 0; ///< since the presentation's onset, by the display's count
    AnimationFrameIndex planned;
    AnimationFrameIndex shown;
    PoseIndex page;
    FlipReport report;
};

} // namespace overt
