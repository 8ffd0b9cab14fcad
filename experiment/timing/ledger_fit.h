/// A presentation's ledger read again, afterwards: when each refresh began by all the time stamps together,
/// which ones were missed, and why.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "experiment/timing/refresh_fit.h"

namespace overt {

/// Why refreshes were missed, as far as the ledger tells.
enum class MissCause : std::uint8_t {
    asked_late, ///< the flip was asked for when the refresh had begun: the program was away
    drawn_late, ///< asked for in time, but handed to the display too late
    shown_late, ///< handed over in time: the display, its driver or a compositor took its time
};
std::string_view name_of(MissCause cause);

/// Refreshes that went by one after the other.
struct MissedRun {
    int refresh_in_trial = 0; ///< the first
    int count = 1;
    MissCause cause = MissCause::shown_late;
    /// From the begin of the first missed refresh back to when the picture was handed over; negative: it was
    /// handed over so long after.
    SessionDuration margin{};
    friend bool operator==(const MissedRun&, const MissedRun&) = default;
};

/// A flip or a missed refresh, and when it began.
struct FittedRefresh {
    MappedTime begin;
    bool is_consistent = true; ///< its own time stamp agrees with the others; true of missed ones
};

/// Where stamps scatter by less than this they stand as they are: there is nothing to gain.
inline constexpr double trusted_scatter_ns = 1000.0;

class LedgerFit {
  public:
    /// The flips of one attempt, in their order; at least one. `known`: see RefreshFit. Where the source
    /// of the times counts no refreshes, their numbers are inferred anew.
    LedgerFit(std::span<const FlipRecord> flips, double nominal_hz,
              std::optional<KnownInterval> known = std::nullopt);

    /// The flips with inferred numbers of refreshes and misses where their source gives none, and with
    /// fitted times as vertical blanks.
    const std::vector<FlipRecord>& flips() const { return flips_; }
    /// By index of flips().
    const std::vector<FittedRefresh>& times() const { return times_; }

    const std::vector<MissedRun>& missed_runs() const { return runs_; }

    /// When a refresh since onset began; also one that was missed.
    MappedTime begin_of(int refresh_in_trial) const;

    const RefreshFit& line() const { return line_; }

  private:
    void find_misses();

    std::vector<FlipRecord> flips_;
    RefreshFit line_;
    bool stamps_stand_; ///< they scatter so little that the flips keep them
    std::vector<FittedRefresh> times_;
    std::vector<MissedRun> runs_;
};

} // namespace overt
