#include "experiment/record/read/session_faults.h"

#include <algorithm>
#include <sstream>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/ports/event_kinds.h"
#include "experiment/ports/session_phase.h"

namespace overt {

namespace {

constexpr std::pair<std::string_view, FaultSide> sides_of_events[] = {
    {tracker_lost_event, FaultSide::eye_tracker},       {tracker_clock_jumped_event, FaultSide::eye_tracker},
    {tracker_fault_event, FaultSide::eye_tracker},      {calibration_failed_event, FaultSide::eye_tracker},
    {drift_check_failed_event, FaultSide::eye_tracker}, {display_box_lost_event, FaultSide::display},
    {display_fault_event, FaultSide::display},          {response_box_lost_event, FaultSide::response_device},
    {program_crashed_event, FaultSide::machine},        {machine_slept_event, FaultSide::machine},
    {wall_clock_set_event, FaultSide::machine}};

/// By what an attempt failed that was a device's doing (TrialFailure). What the eye tracker's events tell
/// already is not told twice.
constexpr std::pair<std::string_view, FaultSide> sides_of_failures[] = {
    {"gaze lost", FaultSide::eye_tracker}, {"missed refreshes", FaultSide::display}};

template <std::size_t count>
const FaultSide* side_in(const std::pair<std::string_view, FaultSide> (&table)[count],
                         std::string_view word) {
    const auto found = std::ranges::find(table, word, &std::pair<std::string_view, FaultSide>::first);
    return found == std::end(table) ? nullptr : &found->second;
}

/// Reads events in their order: some kinds tell of faults only at certain places.
class FaultsOfEvents {
  public:
    explicit FaultsOfEvents(std::vector<SessionFault>& into) : into_(into) {}

    void take(const RecordedEvent& event) {
        if (event.kind == phase_event)
            has_ended_ = event.detail == name_of(SessionPhase::end);
        if (const FaultSide* const side = side_in(sides_of_events, event.kind))
            add(*side, event);
        else if (event.kind == further_tracker_event && tells_of_fault(event.detail))
            add(FaultSide::eye_tracker, event);
        else if (event.kind == keyboard_event && event.detail.starts_with("went"))
            add(FaultSide::response_device, event);
        else if (event.kind == answer_recording_event && event.trial >= 0)
            add(FaultSide::sound, event);
        // At the beginning an output says what it is, at the end what it failed at.
        else if (event.kind == marker_output_event && has_ended_)
            add(FaultSide::markers, event);
    }

  private:
    static bool tells_of_fault(const std::string& detail) {
        return std::ranges::any_of(sides_of_events, [&](const auto& entry) {
            return detail.find(fmt::format(": {}", entry.first)) != std::string::npos;
        });
    }
    void add(FaultSide side, const RecordedEvent& event) {
        into_.push_back({side, event.sitting, event.trial, event.kind, event.detail});
    }

    std::vector<SessionFault>& into_;
    bool has_ended_ = false;
};

} // namespace

std::vector<SessionFault> faults_of(const SessionRecord& record) {
    std::vector<SessionFault> faults;
    for (const TrialRecord& attempt : record.trials()) {
        const FaultSide* const side = side_in(sides_of_failures, attempt.outcome.failure);
        if (!attempt.has_outcome() || !side)
            continue;
        const std::optional<GazeYield>& gaze = attempt.outcome.gaze;
        faults.push_back({*side, attempt.sitting, attempt.trial.index, attempt.outcome.failure,
                          *side == FaultSide::eye_tracker && gaze
                              ? fmt::format("{:.1f} % of its gaze came", 100.0 * gaze->share())
                              : ""});
    }
    FaultsOfEvents of_events(faults);
    record.read_events([&](const RecordedEvent& event) { of_events.take(event); });
    std::ranges::stable_sort(faults, {}, &SessionFault::side);
    return faults;
}

SimulatedSides simulated_sides(std::string_view faults) {
    // The words with which tables and keys of the file begin; a text that has none of them is of the display,
    // as all texts of earlier programs were.
    SimulatedSides sides;
    std::istringstream lines{std::string(faults)};
    for (std::string line; std::getline(lines, line);) {
        const std::size_t begin = line.find_first_not_of("[ \t\"'");
        if (begin == std::string::npos)
            continue;
        const std::string word =
            line.substr(begin, line.find_first_not_of("abcdefghijklmnopqrstuvwxyz-", begin) - begin);
        sides.eye_tracker |= word == "tracker" || word == "tracker-fault";
        sides.display |= word == "display" || word == "chance" || word == "fault";
    }
    sides.display |= sides.are_none();
    return sides;
}

SimulatedSides simulated_sides(const SessionRecord& record) {
    SimulatedSides sides;
    record.read_events([&](const RecordedEvent& event) {
        if (event.kind != simulated_faults_event && event.kind != simulated_tracker_faults_event)
            return;
        const SimulatedSides told = simulated_sides(event.detail);
        sides.display |= told.display;
        sides.eye_tracker |= told.eye_tracker;
    });
    return sides;
}

std::vector<std::string> summary_of(const std::vector<SessionFault>& faults) {
    std::vector<std::string> lines;
    for (auto begin = faults.begin(); begin != faults.end();) {
        const auto end = std::find_if(begin, faults.end(),
                                      [&](const SessionFault& fault) { return fault.side != begin->side; });
        // Of each kind, the trials once each, and what was said of it first.
        struct Kind {
            std::string what, said;
            std::vector<std::string> places;
        };
        std::vector<Kind> kinds;
        for (auto fault = begin; fault != end; ++fault) {
            auto kind = std::ranges::find(kinds, fault->what, &Kind::what);
            if (kind == kinds.end())
                kind = kinds.insert(kinds.end(), {fault->what, {}, {}});
            if (kind->said.empty())
                kind->said = fault->detail;
            std::string place =
                fault->trial < 0 ? "between trials" : fmt::format("trial {}", fault->trial + 1);
            if (std::ranges::find(kind->places, place) == kind->places.end())
                kind->places.push_back(std::move(place));
        }
        std::string line = fmt::format("{}: ", name_of(begin->side));
        for (const Kind& kind : kinds)
            line += fmt::format("{}{} ({}){}{}", kind.what == kinds.front().what ? "" : "; ", kind.what,
                                fmt::join(kind.places, ", "), kind.said.empty() ? "" : ": ", kind.said);
        lines.push_back(std::move(line));
        begin = end;
    }
    return lines;
}

} // namespace overt
