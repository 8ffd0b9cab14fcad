#include "experiment/record/tables/steered_tables.h"

#include <algorithm>

#include "experiment/record/tables/attempt_cells.h"
#include "experiment/record/tables/joined_cells.h"

namespace overt {

namespace {

constexpr int setting_decimals = 9;

std::vector<RowLayout<TrialRecord>::Column> steered_attempt_columns() {
    return {{{"trial", "Position of the trial in the observer's order, from 1"}, number_of_trial},
            {{"attempt", "Which attempt at this trial, from 1"}, attempt_number},
            {{"counts", "Whether this is the attempt that counts"}, attempt_counts}};
}

auto slot_of_seen(const SessionHeader& header) {
    return [&header](const TrialRecord& seen) -> std::string_view {
        const auto* const slot = item_of(header.slots, seen.trial.slot);
        return slot ? std::string_view(slot->id) : std::string_view();
    };
}

} // namespace

RowLayout<SettingRow> settings_layout(const SharedColumns& shared, const SessionHeader& header) {
    RowLayout<SettingRow> layout{
        "settings",
        "A row for each column along which something was set to match, in each attempt that ended.",
        {}};
    layout.add<TrialRecord>(steered_attempt_columns());
    layout.add<TrialRecord>({{shared.task, task_of(header)}});
    layout.add<TrialRecord>(shared.of_stimulus<TrialRecord>(shown_in));
    layout.add<TrialRecord>(own_columns<RowLayout<TrialRecord>::Column>(header));
    const auto number = [](double MatchSetting::*of) {
        return [of](const SettingRow& row) { return Fixed{row.set.*of, setting_decimals}; };
    };
    layout.add<SettingRow>({
        {{"id", "As the protocol calls the answer"}, [](auto& row) { return row.given.id; }},
        {{"slot", "Whose stimulus was set"},
         [&header](auto& row) {
             const auto* const slot = item_of(header.slots, row.given.slot);
             return of_maybe(slot, [](const auto& of) { return of.id; });
         }},
        {{"along", "The column that was gone through"}, [](auto& row) { return row.set.along; }},
        {{"setting", "The level that it was left at"}, number(&MatchSetting::final)},
        {{"accepted", "Whether the observer accepted it", "", {{"yes", ""}, {"no", "time was up before"}}},
         [](auto& row) -> std::string_view { return row.given.is_missed ? "no" : "yes"; }},
        {{"reference", "The level of the stimulus beside it; n/a: that has none, or there is none"},
         [](auto& row) {
             return Fixed{row.set.reference, setting_decimals};
         }},
        {{"error", "The setting less the reference"},
         [](auto& row) {
             return Fixed{row.set.reference ? std::optional(row.set.final - *row.set.reference)
                                            : std::nullopt,
                          setting_decimals};
         }},
        {{"start", "The level that it began with"}, number(&MatchSetting::start)},
        {{"low", "The lowest level"}, number(&MatchSetting::low)},
        {{"high", "The highest level"}, number(&MatchSetting::high)},
        {{"changes", "How often it was changed, taking back included"},
         [](auto& row) { return row.set.changes; }},
        {{"reversals", "Changes against the direction of the one before"},
         [](auto& row) { return row.set.reversals; }},
        {{"stopped_low", "Inputs that would have gone below the lowest level"},
         [](auto& row) { return row.set.stopped_low; }},
        {{"stopped_high", "Inputs that would have gone above the highest level"},
         [](auto& row) { return row.set.stopped_high; }},
        {{"response_time_s", "As in given_answers", "s"},
         [](auto& row) { return row.given.response_time(); }},
    });
    return layout;
}

RowLayout<MoveRow> moves_layout(const SharedColumns& shared, const SessionHeader& header) {
    RowLayout<MoveRow> layout{
        "moves",
        "A row for each flip, of trials that count, of what the observer moves: which level or pose was lit, "
        "and the latest input that it contains.",
        {}};
    layout.add<TrialRecord>({{shared.trial, number_of_trial}, {shared.slot, slot_of_seen(header)}});
    layout.add<MoveRow>({
        {{"refresh", "As in flips: refresh of the display since the presentation's onset, from 0"},
         [](auto& row) { return row.moved.refresh_in_trial; }},
        {session_seconds("onset_s", "When scan-out of this refresh began, as in flips"),
         [](auto& row) { return row.lit.report.vertical_blank; }},
        {{"level", "Of a match: which of its levels was lit, from 0; of two columns the second runs faster"},
         [](auto& row) { return when(row.moved.level >= 0, row.moved.level); }},
        {{"value", "The level's number in the first column"},
         [](auto& row) {
             return Fixed{row.level && !row.level->values.empty() ? std::optional(row.level->values[0])
                                                                  : std::nullopt,
                          setting_decimals};
         }},
        {{"second_value", "The same in the second column, where there are two"},
         [](auto& row) {
             return Fixed{row.level && row.level->values.size() > 1 ? std::optional(row.level->values[1])
                                                                    : std::nullopt,
                          setting_decimals};
         }},
        {shared.angle, [&header](auto& row) { return angle_of(header, row.lit.pose); }},
        {session_seconds("input_s", "The latest input that moved what was lit; n/a: none had"),
         [](auto& row) { return row.moved.input_at; }},
        {{"delay_s", "From that input to the refresh, without the display's latency", "s"},
         [](auto& row) {
             return of_maybe(row.moved.input_at,
                             [&](SessionTime at) { return row.lit.report.vertical_blank - at; });
         }},
    });
    return layout;
}

RowLayout<TurnRow> turns_layout(const SharedColumns& shared, const SessionHeader& header) {
    RowLayout<TurnRow> layout{
        "turns", "A row for each show of an object that the observer turned, of trials that count.", {}};
    layout.add<TrialRecord>({{shared.trial, number_of_trial},
                             {shared.task, task_of(header)},
                             {shared.slot, slot_of_seen(header)}});
    layout.add<TrialRecord>(shared.of_stimulus<TrialRecord>(shown_in));
    const auto degrees = [](Degrees ObserverTurns::*of) {
        return [of](const TurnRow& row) { return Fixed{(row.turns.*of).value, angle_decimals}; };
    };
    layout.add<TurnRow>({
        {{"step", "Which of the attempt's steps, from 1"}, [](auto& row) { return row.turns.step; }},
        {{"shown_s", "From its first refresh to its last", "s"},
         [](auto& row) { return from_seconds(row.turns.seconds); }},
        {{"start_deg", "Turn of the object at first, counter-clockwise seen from above", "deg"},
         degrees(&ObserverTurns::start)},
        {{"end_deg", "The same at last", "deg"}, degrees(&ObserverTurns::end)},
        {{"net_deg", "Sum of all turns, clockwise ones negative", "deg"}, degrees(&ObserverTurns::net)},
        {{"path_deg", "Sum of their sizes", "deg"}, degrees(&ObserverTurns::path)},
        {{"turning_s", "Time between refreshes whose poses differ", "s"},
         [](auto& row) { return from_seconds(row.turns.turning_s); }},
        {{"changes", "Changes of the pose"}, [](auto& row) { return row.turns.changes; }},
        {{"reversals", "Changes against the direction of the one before"},
         [](auto& row) { return row.turns.reversals; }},
        {{"poses", "Poses that were seen"}, [](auto& row) { return row.turns.poses; }},
        {{"median_delay_s",
          "From each further input to the refresh that contains it, in the median, without the display's "
          "latency; n/a: nothing moved it",
          "s"},
         [](auto& row) {
             return of_maybe(row.turns.median_delay_s, [](double seconds) { return from_seconds(seconds); });
         }},
        {{"longest_delay_s", "The longest of them", "s"},
         [](auto& row) {
             return of_maybe(row.turns.longest_delay_s, [](double seconds) { return from_seconds(seconds); });
         }},
    });
    return layout;
}

std::int64_t write_moves(TableWriter& writer, const RowLayout<MoveRow>& layout, const SessionRecord& record,
                         const TrialRecord& seen, const std::optional<TrialLedger>& ledger) {
    if (!ledger)
        return 0;
    const std::vector<MatchLevel>* levels = nullptr;
    for (const GivenAnswer& given : seen.outcome.given)
        if (given.slot == seen.trial.slot && !given.levels.empty())
            levels = &given.levels;
    std::int64_t rows = 0;
    const std::span<const FlipRecord> flips = ledger->fit.flips();
    auto flip = flips.begin();
    for (const SteeredFlip& moved : steered_as_fitted(record, seen, *ledger)) {
        flip = std::ranges::find(flip, flips.end(), moved.refresh_in_trial, &FlipRecord::refresh_in_trial);
        if (flip == flips.end())
            break;
        const MatchLevel* level = nullptr;
        if (levels && moved.level >= 0)
            if (const auto found = std::ranges::find(*levels, moved.level, &MatchLevel::level);
                found != levels->end())
                level = &*found;
        layout.write(writer, {seen, moved, *flip, level});
        ++rows;
    }
    return rows;
}

} // namespace overt
