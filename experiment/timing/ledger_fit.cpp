#include "experiment/timing/ledger_fit.h"

#include <algorithm>

namespace overt {

namespace {

RefreshFit line_through(std::span<const FlipRecord> flips, double nominal_hz,
                        std::optional<KnownInterval> known) {
    std::vector<StampedRefresh> stamps;
    stamps.reserve(flips.size());
    bool counted = true;
    for (const FlipRecord& flip : flips) {
        stamps.push_back({flip.refresh_in_trial, flip.report.vertical_blank});
        counted = counted && counts_refreshes(flip.report.source);
    }
    return RefreshFit(stamps, nominal_hz, counted, known);
}

} // namespace

std::string_view name_of(MissCause cause) {
    switch (cause) {
    case MissCause::asked_late:
        return "asked late";
    case MissCause::drawn_late:
        return "drawn late";
    case MissCause::shown_late:
        return "shown late";
    }
    return "unknown";
}

LedgerFit::LedgerFit(std::span<const FlipRecord> flips, double nominal_hz, std::optional<KnownInterval> known)
    : flips_(flips.begin(), flips.end()), line_(line_through(flips, nominal_hz, known)),
      stamps_stand_(line_.jitter_sd_ns() < trusted_scatter_ns) {
    for (std::size_t i = 0; i < flips_.size(); ++i) {
        FlipRecord& flip = flips_[i];
        const auto refresh = static_cast<int>(line_.refresh_of(i));
        flip.report.refresh.value += refresh - flip.refresh_in_trial;
        flip.refresh_in_trial = refresh;
        const bool agrees = !line_.is_inconsistent(i);
        const MappedTime fitted = line_.begin_of(refresh);
        times_.push_back({stamps_stand_ && agrees
                              ? MappedTime{flip.report.vertical_blank, flip.report.uncertainty}
                              : fitted,
                          agrees});
        flip.report.vertical_blank = times_.back().begin.time;
        flip.report.uncertainty = times_.back().begin.uncertainty;
    }
    find_misses();
}

void LedgerFit::find_misses() {
    for (std::size_t i = 1; i < flips_.size(); ++i) {
        FlipRecord& flip = flips_[i];
        if (flip.step != flips_[i - 1].step)
            continue; // between two shows something else is on the screen
        // A gap without a miss in the record of a counting source is flips that could not be written down.
        if (!counts_refreshes(flip.report.source))
            flip.missed_refreshes = flip.refresh_in_trial - flips_[i - 1].refresh_in_trial - 1;
        if (flip.missed_refreshes <= 0)
            continue;
        const int aimed_at = flip.refresh_in_trial - flip.missed_refreshes;
        const SessionTime due = begin_of(aimed_at).time;
        const MissCause cause = flip.report.requested >= due ? MissCause::asked_late
                                : flip.report.swapped >= due ? MissCause::drawn_late
                                                             : MissCause::shown_late;
        runs_.push_back({aimed_at, flip.missed_refreshes, cause, due - flip.report.swapped});
    }
}

MappedTime LedgerFit::begin_of(int refresh_in_trial) const {
    const auto flip =
        std::lower_bound(flips_.begin(), flips_.end(), refresh_in_trial,
                         [](const FlipRecord& one, int refresh) { return one.refresh_in_trial < refresh; });
    if (flip != flips_.end() && flip->refresh_in_trial == refresh_in_trial &&
        static_cast<std::size_t>(flip - flips_.begin()) < times_.size())
        return times_[static_cast<std::size_t>(flip - flips_.begin())].begin;
    return line_.begin_of(refresh_in_trial);
}

} // namespace overt
