#include "experiment/record/tables/steered_tables.h"

#include <algorithm>

#include "experiment/record/tables/attempt_cells.h"
#include "experiment/record/tables/joined_cells.h"

namespace overt {

namespace {

constexpr int setting_decimals = 9;
/// So exact that poses are those of the protocol's steps again when they are read.
constexpr int course_decimals = 9;

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
        {{"elevation_deg", "As in courses", "deg"},
         [&header](auto& row) {
             return of_maybe(item_of(header.poses.angles, row.lit.pose.value), [](const ObjectPose& pose) {
                 return Fixed{elevation_of(pose).value, angle_decimals};
             });
         }},
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
        "turns",
        "A row for each show of an object that the observer turned, or that turned as another had turned it, "
        "of trials that count.",
        {}};
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
        {{"net_deg", "Sum of all turns about the vertical, clockwise ones negative", "deg"},
         degrees(&ObserverTurns::net)},
        {{"start_elevation_deg", "Elevation at first, as in courses", "deg"},
         degrees(&ObserverTurns::start_elevation)},
        {{"end_elevation_deg", "The same at last", "deg"}, degrees(&ObserverTurns::end_elevation)},
        {{"path_deg", "Sum of the angles from pose to pose, whatever they are about", "deg"},
         degrees(&ObserverTurns::path)},
        {{"turning_s", "Time between refreshes whose poses differ", "s"},
         [](auto& row) { return from_seconds(row.turns.turning_s); }},
        {{"changes", "Changes of the pose"}, [](auto& row) { return row.turns.changes; }},
        {{"reversals", "Turns about the vertical against the direction of the one before"},
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

RowLayout<CourseRow> courses_layout(const SharedColumns& shared, const SessionHeader& header) {
    RowLayout<CourseRow> layout{
        "courses",
        "A row for each pose that was lit of an object that the observer turned, where it changed, and one "
        "for the end of each show, of trials that count. A motion of kind \"recorded\" shows it again.",
        {}};
    layout.add<TrialRecord>({{shared.trial, number_of_trial}, {shared.slot, slot_of_seen(header)}});
    layout.add<TrialRecord>(shared.of_stimulus<TrialRecord>(shown_in));
    layout.add<CourseRow>({
        {{"step", "Which of the attempt's steps, from 1"}, [](auto& row) { return row.step; }},
        {{"t_s",
          "Since the show's first refresh, in refreshes by the protocol's rate; missed ones count, and the "
          "picture before them stood",
          "s"},
         [](auto& row) { return from_seconds(row.t_s); }},
        {{"angle_deg", "Turn of the object from then on, counter-clockwise seen from above", "deg"},
         [](auto& row) {
             return Fixed{row.pose.angle.value, course_decimals};
         }},
        {{"elevation_deg",
          "After it, turn about the horizontal line to the observer's right; positive: seen more from above",
          "deg"},
         [](auto& row) {
             return Fixed{elevation_of(row.pose).value, course_decimals};
         }},
    });
    return layout;
}

void write_courses(TableWriter& writer, const RowLayout<CourseRow>& layout, const SessionRecord& record,
                   const TrialRecord& seen, const std::optional<TrialLedger>& ledger) {
    const SessionHeader& header = record.header();
    if (!ledger || header.animation_of(seen.trial.stimulus).has_plan())
        return;
    const std::span<const FlipRecord> flips = ledger->fit.flips();
    for (const RecordedShow& show : shows_of(header, seen, flips)) {
        if (!show.is_lit)
            continue;
        std::optional<PoseIndex> before;
        const auto write = [&](const FlipRecord& flip, int refreshes) {
            layout.write(writer, {seen, flip.step, refreshes / header.display.refresh_hz,
                                  header.poses.object_of(flip.pose)});
        };
        const FlipRecord* last = nullptr;
        for (const FlipRecord& flip : flips.subspan(show.begin, show.end - show.begin)) {
            if (flip.shown == no_frame)
                continue;
            last = &flip;
            if (before == flip.pose)
                continue;
            before = flip.pose;
            write(flip, flip.refresh_in_trial - show.first_refresh);
        }
        if (last)
            write(*last, last->refresh_in_trial - show.first_refresh + 1);
    }
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
