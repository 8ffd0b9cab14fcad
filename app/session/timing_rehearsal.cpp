#include "app/session/timing_rehearsal.h"

#include <deque>

#include <fmt/format.h>

#include "experiment/base/counted.h"
#include "experiment/base/scratch_folder.h"
#include "experiment/ports/event_kinds.h"
#include "experiment/record/header_rows.h"
#include "experiment/session/presentation_rehearsal.h"
#include "experiment/session/shared_log.h"

namespace overt {

void rehearse_timing(Rig& rig, const Protocol& protocol, const Schedule& schedule,
                     const SessionHeader& header, const std::filesystem::path& folder, SessionStore& store) {
    if (!rig.is_on_a_real_screen() || schedule.trials.empty())
        return;
    fmt::print("rehearsing a presentation on a dark screen …\n");
    RehearsedPresentation rehearsed;
    LostRows lost;
    {
        const ScratchFolder scratch(".overt-rehearsal", folder.parent_path());
        std::deque<SessionStore> stores; // one for each tracker, as in the session
        const auto make_store = [&]() -> SessionStore& {
            const std::filesystem::path file = scratch.path() / fmt::format("{}.sqlite", stores.size());
            create_session_file(file, header);
            return stores.emplace_back(file, SessionStore::Options());
        };
        std::vector<RehearsedTracker> trackers{{rig.tracker(), make_store()}};
        SharedLog log(stores.front());
        for (Rig::Further& further : rig.further_trackers()) {
            trackers.push_back({*further.tracker, make_store()});
            log.add(stores.back());
        }
        std::vector<PresentationListener*> listeners;
        if (LiveMaps* const maps = rig.live_maps())
            listeners.push_back(maps);
        rehearsed = rehearse_presentation(protocol, schedule.trials.front(),
                                          {rig.clock(), rig.presenter(), log, listeners, trackers});
        for (SessionStore& written : stores) {
            written.close();
            lost += written.lost();
        }
    }
    std::string found = describe(rehearsed);
    if (lost.flips + lost.samples > 0)
        found += fmt::format("; the record could not keep {} and {}", counted(lost.flips, "flip"),
                             counted(lost.samples, "sample"));
    store.event({rig.clock().now(), -1, timing_rehearsed_event, found});
    fmt::print("{}: {}; the distribution of times is in the record\n", timing_rehearsed_event,
               counts_of(rehearsed));
    if (misses_too_many(rehearsed))
        fmt::print(stderr,
                   "risk: a rehearsed presentation missed {} of {}: trials will miss as many. Close other "
                   "programs, take --realtime, or see `overt check` for what a refresh costs\n",
                   rehearsed.missed, counted(rehearsed.missed + rehearsed.refreshes, "refresh", "refreshes"));
}

} // namespace overt
