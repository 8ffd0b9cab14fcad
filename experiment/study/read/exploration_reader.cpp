#include "experiment/study/read/exploration_reader.h"

#include <algorithm>

#include "experiment/record/read/observer_turns.h"
#include "experiment/record/read/session_record.h"

namespace overt {

namespace {

/// The task, and the entries of the lists that the protocol has several of.
std::vector<std::pair<std::string, std::string>> levels_of(const SessionHeader& header, int task,
                                                           const Stimulus& stimulus) {
    std::vector<std::pair<std::string, std::string>> levels;
    if (header.tasks.size() > 1)
        levels.emplace_back("task", header.tasks[static_cast<std::size_t>(task)].id);
    for (std::size_t list = 0; list < stimulus_lists.size(); ++list) {
        const std::vector<ListEntry> entries = entries_of(header, list);
        if (entries.size() > 1)
            levels.emplace_back(stimulus_lists[list].name,
                                entries[static_cast<std::size_t>(stimulus.*stimulus_lists[list].index)].id);
    }
    return levels;
}

void add_shows(const SessionRecord& record, int session, const std::string& observer,
               std::vector<ExplorationRow>& shows) {
    const SessionHeader& header = record.header();
    for (const TrialRecord& trial : record.trials()) {
        if (!trial.gives_results())
            continue;
        for (std::size_t place = 0; place < trial.trial.shown_count(); ++place) {
            const Stimulus& stimulus = trial.trial.shown(place).stimulus;
            if (header.animation_of(stimulus).kind != MotionKind::observer)
                continue;
            const TrialRecord seen = trial.seen_in(place);
            for (const ObserverTurns& turns : observer_turns(record, seen, record.ledger(seen)))
                shows.push_back({observer, session, trial.trial.index + 1, turns.step,
                                 levels_of(header, trial.trial.task, stimulus), turns.seconds,
                                 turns.turning_s, turns.path.value, turns.net.value, turns.reversals,
                                 turns.poses});
        }
    }
}

} // namespace

std::vector<ExplorationRow>
read_explorations(std::span<const std::filesystem::path> sessions,
                  std::span<const std::pair<std::string, std::string>> same_observer) {
    std::vector<ExplorationRow> shows;
    for (std::size_t session = 0; session < sessions.size(); ++session) {
        const SessionRecord record(sessions[session]);
        if (std::ranges::none_of(record.header().animations,
                                 [](const Animation& motion) { return motion.kind == MotionKind::observer; }))
            continue;
        std::string observer = record.header().schedule.observer.label;
        const auto same =
            std::ranges::find(same_observer, observer, &std::pair<std::string, std::string>::first);
        if (same != same_observer.end())
            observer = same->second;
        add_shows(record, static_cast<int>(session), observer, shows);
    }
    return shows;
}

} // namespace overt
