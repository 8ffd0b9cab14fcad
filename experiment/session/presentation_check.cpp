#include "experiment/session/presentation_check.h"

#include <algorithm>

#include <fmt/format.h>

#include "experiment/base/counted.h"
#include "experiment/protocol/all_stimuli.h"
#include "experiment/session/missed_in_words.h"
#include "experiment/session/tracker_feed.h"
#include "experiment/timing/refresh_ledger.h"
#include "experiment/timing/slot_cycles.h"

namespace overt {
namespace {

constexpr double tolerable_share = 0.01;

std::string quantiles_of(std::vector<double> values) {
    if (values.empty())
        return "none";
    std::ranges::sort(values);
    const auto at = [&](double share) {
        return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
    };
    return fmt::format(
        "least {:.3f}, 1 % {:.3f}, 5 % {:.3f}, 25 % {:.3f}, median {:.3f}, 75 % {:.3f}, 95 % {:.3f}, 99 % "
        "{:.3f}, most {:.3f}",
        at(0.0), at(0.01), at(0.05), at(0.25), at(0.5), at(0.75), at(0.95), at(0.99), at(1.0));
}

} // namespace

PresentationCheck check_presentation(const Protocol& protocol, const Trial& trial,
                                     const PresentationCheckPorts& ports) {
    PresentationCheck check;
    const Animation& motion = protocol.motion_of(trial.stimulus);
    const std::vector<PageCycle> cycles = page_cycles(protocol);
    PageCycle cycle = cycles[static_cast<std::size_t>(trial.stimulus.motion)];
    cycle.total_refreshes = std::min(cycle.total_refreshes, static_cast<int>(cycle.entry_of_refresh.size()));
    RefreshLedger ledger(cycle, motion.when_late);
    std::vector<TrackerFeed> feeds;
    for (const CheckedTracker& checked : ports.trackers)
        feeds.emplace_back(checked.tracker);
    const auto take_items = [&]() noexcept {
        for (std::size_t i = 0; i < feeds.size(); ++i)
            feeds[i].take_items(trial.index, ports.trackers[i].log);
    };
    std::vector<FlipReport> flips;
    flips.reserve(static_cast<std::size_t>(cycle.total_refreshes));

    ports.presenter.load_slots(trial.all_shown());
    SlotCycles slots;
    std::vector<PageCycle> cycles_beside;
    for (const PlacedStimulus& further : trial.beside)
        cycles_beside.push_back(cycles[static_cast<std::size_t>(further.stimulus.motion)]);
    std::vector<int> all;
    for (std::size_t i = 0; i < trial.shown_count(); ++i)
        all.push_back(static_cast<int>(i));
    slots.begin(trial.index, trial.shown_count(), std::move(all), std::move(cycles_beside));
    ports.presenter.veil(true);
    ports.presenter.show({});
    ports.log.trial_started(trial, ports.clock.now());
    for (TrackerFeed& feed : feeds)
        if (!feed.start_recording(ports.clock.now()) && !check.tracker_refusal)
            check.tracker_refusal = feed.why_lost();
    for (PresentationListener* listener : ports.listeners)
        listener->presentation_begins(trial, 0);
    ledger.begin(trial.index);
    while (!ledger.is_complete() && !ports.presenter.closed()) {
        take_items();
        const FlipRecord& flip = ledger.enter(
            ports.presenter.flip_slots(slots.frames(ledger.next().frame, ledger.next_refresh())));
        for (int i = 0; i < ledger.missed_count(); ++i)
            ports.log.missed(ledger.missed(i));
        ports.log.flip(flip);
        for (const SlotFlip& of_slot : slots.enter(flip, ledger.last_refresh()))
            ports.log.slot_flip(of_slot);
        for (PresentationListener* listener : ports.listeners)
            listener->flipped(flip);
        flips.push_back(flip.report);
    }
    const SessionTime end = ports.presenter.show({}).vertical_blank;
    for (PresentationListener* listener : ports.listeners)
        listener->screen_shown({}, end);
    for (TrackerFeed& feed : feeds)
        feed.stop_recording(ports.clock.now());
    take_items();
    for (const TrackerFeed& feed : feeds)
        check.samples += feed.sample_count();
    ports.presenter.veil(false);
    ports.presenter.show({});

    check.refreshes = ledger.shown_refreshes();
    check.missed = ledger.missed_refreshes();
    check.has_proven_times = ports.has_proven_times;
    for (std::size_t i = 0; i < flips.size(); ++i) {
        check.work_ms.push_back(1e3 * to_seconds(flips[i].swapped - flips[i].requested));
        if (i > 0)
            check.intervals_ms.push_back(1e3 *
                                         to_seconds(flips[i].vertical_blank - flips[i - 1].vertical_blank));
    }
    return check;
}

std::string counts_of(const PresentationCheck& check) {
    const std::string missed = check.has_proven_times ? fmt::format("{} missed", check.missed)
                                                      : missed_in_words(check.missed, check.has_proven_times);
    return fmt::format("{}, {}, {}", counted(check.refreshes, "refresh", "refreshes"), missed,
                       check.tracker_refusal ? "without the eye tracker: " + *check.tracker_refusal
                                             : counted(check.samples, "sample") + " of gaze");
}

std::string describe(const PresentationCheck& check) {
    return fmt::format(
        "{}; from picture to picture in ms: {}; from asking for a picture to its swap in ms: {}",
        counts_of(check), quantiles_of(check.intervals_ms), quantiles_of(check.work_ms));
}

bool misses_too_many(const PresentationCheck& check) {
    return check.missed > tolerable_share * (check.missed + check.refreshes);
}

} // namespace overt
