#include "render/vblank/vblank_clock.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "render/vblank/vblank_sources.h"
#include "render/window/window_context.h"

namespace overt {
namespace {

/// Stamps may lie ahead of the clock by as much as a server rounds.
constexpr SessionDuration future_tolerance = std::chrono::milliseconds(2);

/// Rates of screens; outside of it a count is not one of refreshes, or its times are of another unit.
constexpr double lowest_hz = 10.0, highest_hz = 1000.0;

constexpr int refreshes_of_trial = 6;

} // namespace

MonotonicTime::MonotonicTime(const Clock& clock) {
    auto narrowest = std::chrono::steady_clock::duration::max();
    for (int i = 0; i < 16; ++i) {
        const auto before = std::chrono::steady_clock::now();
        const SessionTime session = clock.now();
        const auto width = std::chrono::steady_clock::now() - before;
        if (width < narrowest) {
            narrowest = width;
            offset_ = session.time_since_epoch() -
                      std::chrono::duration_cast<SessionDuration>(before.time_since_epoch() + width / 2);
        }
    }
}

std::string why_unfit(VblankClock& source, const Clock& clock) {
    std::optional<VblankStamp> first = source.last();
    if (!first)
        return "it says nothing";
    first = source.await(first->count + 1);
    std::optional<VblankStamp> stamp = first;
    for (int i = 0; i < refreshes_of_trial; ++i) {
        if (!stamp)
            return "its count stands still";
        const SessionDuration age = clock.now() - stamp->at;
        if (age < -future_tolerance || age > VblankClock::patience)
            return fmt::format("its clock is not the session's: a vertical blank of {:.3f} s ago",
                               to_seconds(age));
        const std::int64_t count = stamp->count;
        stamp = source.await(count + 1);
        if (stamp && stamp->count <= count)
            return "its count does not go on";
    }
    if (!stamp)
        return "its count stands still";
    const double hz =
        static_cast<double>(stamp->count - first->count) / std::max(1e-9, to_seconds(stamp->at - first->at));
    if (hz < lowest_hz || hz > highest_hz)
        return fmt::format("it counts {:.4g} refreshes a second", hz);
    return {};
}

bool stamps_stand_still(VblankClock& source, Clock& clock) {
    // Asked right after a blank, so that the next is not between the two; more than once, as it may be.
    for (int i = 0; i < 4; ++i) {
        const std::optional<VblankStamp> now = source.last();
        const std::optional<VblankStamp> next =
            now ? source.await(now->count + 1) : std::optional<VblankStamp>();
        const std::optional<VblankStamp> once = next ? source.last() : std::optional<VblankStamp>();
        if (!once)
            return false;
        clock.wait_until(clock.now() + std::chrono::milliseconds(1));
        if (source.last() == once)
            return true;
    }
    return false;
}

VblankChoice choose_vblank_clock(const std::vector<VblankCandidate>& candidates, Clock& clock) {
    VblankChoice choice;
    for (const VblankCandidate& candidate : candidates) {
        std::string reason;
        std::unique_ptr<VblankClock> source;
        try {
            source = candidate.open();
            reason = why_unfit(*source, clock);
        } catch (const Error& error) {
            reason = error.what();
        }
        if (reason.empty() && stamps_stand_still(*source, clock)) {
            if (choice.clock)
                choice.refused.push_back(fmt::format("{}: not a real one", name_of(choice.clock->source())));
            choice.clock = std::move(source);
            choice.is_real = true;
            return choice;
        }
        if (reason.empty() && !choice.clock)
            choice.clock = std::move(source);
        else
            choice.refused.push_back(
                fmt::format("{}: {}", name_of(candidate.source), reason.empty() ? "not a real one" : reason));
    }
    return choice;
}

std::vector<VblankCandidate> vblank_candidates(const WindowContext& window, const Clock& clock) {
    const NativeWindow native = window.native();
    return {
        {VblankSource::glx_sync_control, [=, &clock] { return open_glx_sync_control(native, clock); }},
        {VblankSource::present_count, [=, &clock] { return open_x_present(native, clock); }},
        {VblankSource::egl_sync_control, [=, &clock] { return open_egl_sync_control(native, clock); }},
        {VblankSource::glx_video_sync, [=, &clock] { return open_glx_video_sync(native, clock); }},
        {VblankSource::drm_vblank, [=, &clock] { return open_drm_vblank(native, clock); }},
    };
}

} // namespace overt
