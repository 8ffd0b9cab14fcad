#include "experiment/record/tables/ledger_rows.h"

#include <algorithm>

#include "experiment/record/tables/joined_cells.h"

namespace overt {

namespace {

/// How the object stands where it does more than turn about the vertical.
void add_tilt_columns(RowLayout<LedgerRow>& layout, const SessionHeader& header) {
    const auto number = [&header](auto member, int of) {
        return [&header, member, of](auto& row) -> std::optional<Fixed> {
            constexpr int decimals = 9;
            const ObjectPose* const object = item_of(header.poses.angles, row.lit.pose.value);
            return object ? std::optional(Fixed{(object->*member)[of], decimals}) : std::nullopt;
        };
    };
    // A quaternion of glm has x, y, z and w in this order.
    layout.add<LedgerRow>(
        {{{"tilt_w",
           "Rotation of the object about the centre of its box after its turn by the angle about the "
           "vertical, a quaternion of length 1: its real part"},
          number(&ObjectPose::tilt, 3)},
         {{"tilt_x", "Likewise: to the right of the front view"}, number(&ObjectPose::tilt, 0)},
         {{"tilt_y", "Likewise: away from it"}, number(&ObjectPose::tilt, 1)},
         {{"tilt_z", "Likewise: upwards"}, number(&ObjectPose::tilt, 2)},
         {{"shift_x", "How far the object was moved after that, in the unit of its mesh"},
          number(&ObjectPose::shift, 0)},
         {{"shift_y", "Likewise"}, number(&ObjectPose::shift, 1)},
         {{"shift_z", "Likewise"}, number(&ObjectPose::shift, 2)}});
}

} // namespace

RowLayout<LedgerRow> ledger_layout(const SharedColumns& shared, const SessionHeader& header) {
    RowLayout<LedgerRow> layout{
        "flips",
        "The ledger of the completed trials: one row for each refresh of the display, from the "
        "presentation's onset to the plan's end, or longer where pictures came later.",
        {{shared.trial, &LedgerRow::trial}}};
    if (shared.has_slots)
        layout.add<LedgerRow>(
            {{shared.slot, [&header](auto& row) { return item(header.slots, row.slot).id; }}});
    layout.add<LedgerRow>(
        {{{"refresh", "Refresh of the display since the presentation's onset, from 0"}, &LedgerRow::refresh},
         {{"state",
           "Whether a picture was handed over for this refresh",
           "",
           {{"flipped", "shown_frame began, or went on, by a flip"},
            {"missed", "it went by with the frame before"}}},
          [](auto& row) { return row.flipped ? "flipped" : "missed"; }},
         {{"planned_frame", "Animation frame that the plan had for this refresh; n/a after the plan's end"},
          [](auto& row) { return when(row.planned != no_frame, row.planned.value); }},
         {{"shown_frame", "Animation frame that was lit"},
          [](auto& row) { return when(row.lit.shown != no_frame, row.lit.shown.value); }},
         {shared.angle, [&header](auto& row) { return angle_of(header, row.lit.pose); }},
         {session_seconds("requested_s", "When the picture was asked for"),
          [](auto& row) { return of_maybe(row.flipped, &FlipReport::requested); }},
         {session_seconds("swapped_s", "When the buffer swap had been handed over"),
          [](auto& row) { return of_maybe(row.flipped, &FlipReport::swapped); }},
         {session_seconds("vertical_blank_s", "When scan-out of this refresh began, by its own time stamp"),
          [](auto& row) { return of_maybe(row.flipped, &FlipReport::vertical_blank); }},
         {{"vertical_blank_uncertainty_s", "How far off the source may be", "s"},
          [](auto& row) { return of_maybe(row.flipped, &FlipReport::uncertainty); }},
         {session_seconds("onset_s",
                          "The same by the line through all time stamps of the presentation; of a missed "
                          "refresh, too"),
          [](auto& row) { return row.onset.time; }},
         {{"onset_uncertainty_s",
           "Two standard errors of the line; where time stamps scatter by less than 1 us they stand as "
           "they "
           "are, with their own uncertainty",
           "s"},
          [](auto& row) { return row.onset.uncertainty; }},
         {{"source",
           "Where vertical_blank_s comes from",
           "",
           {{std::string(name_of(VblankSource::virtual_display)), "the program's own clock, exact"},
            {std::string(name_of(VblankSource::swap_return)),
             "no source: when the swap, and a pixel drawn after it, were done"},
            {std::string(name_of(VblankSource::glx_sync_control)),
             "GLX_OML_sync_control: the refresh at which the swap was lit"},
            {std::string(name_of(VblankSource::present_swap)),
             "X Present: the refresh at which the swap was lit"},
            {std::string(name_of(VblankSource::present_count)),
             "X Present, which only counts: the first refresh after the swap"},
            {std::string(name_of(VblankSource::egl_sync_control)),
             "EGL_CHROMIUM_sync_control: the refresh at which the swap was lit"},
            {std::string(name_of(VblankSource::drm_vblank)),
             "the kernel's count for the screen: the first refresh after the swap"},
            {std::string(name_of(VblankSource::glx_video_sync)),
             "GLX_SGI_video_sync, which only counts, stamped by a thread that waits for each: the first "
             "refresh "
             "after the swap"}}},
          [](auto& row) { return name_of(row.lit.report.source); }},
         {{"missed",
           "Refreshes that went by with the old picture before this one; n/a: the session's timing is "
           "unproven"},
          [&header](auto& row) { return when(!header.is_timing_unproven(), row.missed_before); }},
         {{"cause",
           "Why a refresh was missed",
           "",
           {{std::string(name_of(MissCause::asked_late)),
             "the flip was asked for when the refresh had begun"},
            {std::string(name_of(MissCause::drawn_late)), "it was asked for in time, but drawn too late"},
            {std::string(name_of(MissCause::shown_late)),
             "it was drawn in time, but the display took it later"}}},
          [](auto& row) { return of_maybe(row.cause, [](MissCause cause) { return name_of(cause); }); }}});
    if (std::ranges::any_of(header.animations, [](const Animation& motion) { return motion.turns_light(); }))
        layout.add<LedgerRow>(
            {{{"light_angle_deg",
               "Turn of the light from where the protocol has it, counter-clockwise seen from above", "deg"},
              [&header](auto& row) -> std::optional<Fixed> {
                  if (row.lit.shown == no_frame)
                      return std::nullopt;
                  const Animation& motion = item(header.animations, row.motion);
                  return Fixed{motion.pose_of(row.lit.shown).light.value, angle_decimals};
              }}});
    if (!std::ranges::all_of(header.poses.angles, &ObjectPose::is_turn))
        add_tilt_columns(layout, header);
    return layout;
}

std::int64_t write_ledger(TableWriter& writer, const RowLayout<LedgerRow>& layout,
                          const SessionHeader& header, const TrialRecord& trial,
                          const std::optional<TrialLedger>& ledger) {
    if (!ledger)
        return 0;
    const auto& [recorded, fit] = *ledger;
    const int number = trial.trial.index + 1;
    std::int64_t flips = 0;
    for (const RecordedShow& show : shows_of(header, trial, fit.flips())) {
        if (!show.is_lit)
            continue;
        const int end = show.first_refresh + show.plan.total_refreshes;
        const auto planned_at = [&](int refresh) {
            return refresh < end ? show.plan.entry_at(refresh - show.first_refresh).frame : no_frame;
        };
        auto run = std::ranges::find_if(fit.missed_runs(), [&](const MissedRun& missed) {
            return missed.refresh_in_trial > show.first_refresh;
        });
        for (std::size_t i = show.begin; i < show.end; ++i) {
            const FlipRecord& fitted = fit.flips()[i];
            if (i > show.begin && fitted.missed_refreshes > 0) {
                // One by one to the plan's end; after it the count in the flip that follows says it.
                for (int k = 0; k < run->count && run->refresh_in_trial + k < end; ++k) {
                    const int refresh = run->refresh_in_trial + k;
                    layout.write(writer, {number, trial.trial.slot, refresh, nullptr, planned_at(refresh),
                                          fit.flips()[i - 1], fit.begin_of(refresh), 0, run->cause,
                                          trial.trial.stimulus.motion});
                }
                ++run;
            }
            const int refresh = fitted.refresh_in_trial;
            const bool is_as_noted = refresh == recorded[i].refresh_in_trial;
            // Where the count was inferred anew, the plan has another frame for this refresh than was noted.
            layout.write(writer, {number,
                                  trial.trial.slot,
                                  refresh,
                                  &recorded[i].report,
                                  is_as_noted ? fitted.planned : planned_at(refresh),
                                  fitted,
                                  {fitted.report.vertical_blank, fitted.report.uncertainty},
                                  fitted.missed_refreshes,
                                  std::nullopt,
                                  trial.trial.stimulus.motion});
            ++flips;
        }
    }
    return flips;
}

} // namespace overt
