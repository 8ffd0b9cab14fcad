#include "app/session/presentation_check.h"

#include <deque>

#include <fmt/format.h>

#include "experiment/base/counted.h"
#include "experiment/base/scratch_folder.h"
#include "experiment/ports/event_kinds.h"
#include "experiment/record/header_rows.h"
#include "experiment/session/presentation_check.h"
#include "experiment/session/shared_log.h"

namespace overt {

void check_presentation(Rig& rig, const Protocol& protocol, const Schedule& schedule,
                        const SessionHeader& header, const std::filesystem::path& folder,
                        SessionStore& store) {
    if (!rig.is_on_a_real_screen() || schedule.trials.empty())
        return;
    fmt::print("checking the timing of a presentation on a dark screen …\n");
    PresentationCheck check;
    LostRows lost;
    {
        const ScratchFolder scratch(".overt-presentation-check", folder.parent_path());
        std::deque<SessionStore> stores; // one for each tracker, as in the session
        const auto make_store = [&]() -> SessionStore& {
            const std::filesystem::path file = scratch.path() / fmt::format("{}.sqlite", stores.size());
            create_session_file(file, header);
            return stores.emplace_back(file, SessionStore::Options());
        };
        std::vector<CheckedTracker> trackers{{rig.tracker(), make_store()}};
        SharedLog log(stores.front());
        for (Rig::Further& further : rig.further_trackers()) {
            trackers.push_back({*further.tracker, make_store()});
            log.add(stores.back());
        }
        std::vector<PresentationListener*> listeners;
        if (LiveMaps* const maps = rig.live_maps())
            listeners.push_back(maps);
        check = check_presentation(
            protocol, schedule.trials.front(),
            {rig.clock(), rig.presenter(), log, listeners, trackers, !header.is_timing_unproven()});
        for (SessionStore& written : stores) {
            written.close();
            lost += written.lost();
        }
    }
    std::string found = describe(check);
    if (lost.flips + lost.samples > 0)
        found += fmt::format("; the record could not keep {} and {}", counted(lost.flips, "flip"),
                             counted(lost.samples, "sample"));
    store.event({rig.clock().now(), -1, presentation_check_event, found});
    fmt::print("{}: {}; the distribution of times is in the record\n", presentation_check_event,
               counts_of(check));
    if (misses_too_many(check))
        fmt::print(
            stderr,
            "risk: a presentation on a dark screen missed {} of {}: trials will miss as many. Close other "
            "programs, take --realtime, or see `overt check` for what a refresh costs\n",
            check.missed, counted(check.missed + check.refreshes, "refresh", "refreshes"));
}

} // namespace overt
