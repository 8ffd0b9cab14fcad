#include "experiment/record/tables/ledger_rows.h"

#include "experiment/record/tables/joined_cells.h"

namespace overt {

namespace {

class LedgerRows {
  public:
    LedgerRows(TableWriter& writer, const SessionHeader& header, const TrialRecord& trial)
        : row_(writer), header_(header), number_(trial.trial.index + 1),
          plan_(make_page_cycle(header_.animation, header_.display.refresh_hz)) {}

    /// `fitted` is `recorded` at the times of the line.
    void flip(const FlipRecord& recorded, const FlipRecord& fitted) {
        begin(fitted.refresh_in_trial, "flipped");
        // Where the count was inferred anew, the plan has another frame for this refresh than was noted.
        frames(fitted.refresh_in_trial == recorded.refresh_in_trial ? fitted.planned
                                                                    : planned_at(fitted.refresh_in_trial),
               fitted);
        row_.seconds(fitted.report.requested).seconds(fitted.report.swapped);
        row_.seconds(recorded.report.vertical_blank).seconds(recorded.report.uncertainty);
        row_.seconds(fitted.report.vertical_blank).seconds(fitted.report.uncertainty);
        row_.text(name_of(fitted.report.source)).integer(fitted.report.missed_refreshes).missing().end_row();
    }

    /// The refreshes of a run, one by one; after the plan's end the count in the flip that follows says it.
    void missed(const MissedRun& run, const LedgerFit& fit, const FlipRecord& before) {
        for (int i = 0; i < run.count && run.refresh_in_trial + i < plan_.total_refreshes; ++i) {
            const int refresh = run.refresh_in_trial + i;
            begin(refresh, "missed");
            frames(planned_at(refresh), before);
            const MappedTime at = fit.begin_of(refresh);
            row_.missing(4).seconds(at.time).seconds(at.uncertainty);
            row_.text(name_of(before.report.source)).integer(0).word(name_of(run.cause)).end_row();
        }
    }

  private:
    AnimationFrameIndex planned_at(int refresh) const {
        return refresh < plan_.total_refreshes ? plan_.entry_at(refresh).frame : no_frame;
    }
    void begin(int refresh, std::string_view state) { row_.integer(number_).integer(refresh).word(state); }
    void frames(AnimationFrameIndex planned, const FlipRecord& lit) {
        planned == no_frame ? row_.missing() : row_.integer(planned.value);
        row_.integer(lit.shown.value);
        write_angle(row_, header_, lit.pose);
    }

    TableWriter& row_;
    const SessionHeader& header_;
    int number_;
    PageCycle plan_;
};

} // namespace

std::int64_t write_ledger(TableWriter& writer, const SessionHeader& header, const TrialRecord& trial,
                          const std::optional<TrialLedger>& ledger) {
    if (!ledger)
        return 0;
    const auto& [recorded, fit] = *ledger;
    LedgerRows rows(writer, header, trial);
    auto run = fit.missed_runs().begin();
    for (std::size_t i = 0; i < recorded.size(); ++i) {
        const FlipRecord& fitted = fit.flips()[i];
        if (i > 0 && fitted.report.missed_refreshes > 0)
            rows.missed(*run++, fit, fit.flips()[i - 1]);
        rows.flip(recorded[i], fitted);
    }
    return static_cast<std::int64_t>(recorded.size());
}

} // namespace overt
