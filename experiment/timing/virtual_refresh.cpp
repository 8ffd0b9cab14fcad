#include "experiment/timing/virtual_refresh.h"

#include <algorithm>
#include <cmath>

namespace overt {

namespace {

/// Faults by chance are drawn for so many refreshes: a quarter of an hour at 120 Hz.
constexpr int refreshes_drawn = 1 << 17;

constexpr double widest_jitter_sd = 3.0;

} // namespace

VirtualRefresh::VirtualRefresh(Clock& clock, double refresh_hz, DisplayFaults faults)
    : clock_(&clock), refresh_hz_(refresh_hz), true_hz_(refresh_hz * (1.0 + 1e-6 * faults.drift_ppm)),
      faults_(std::move(faults)), jitter_(faults_.seed, "time stamps"), count_(refresh_hz) {}

DisplayTiming VirtualRefresh::timing() const noexcept {
    return {refresh_hz_,
            faults_.counts_refreshes ? VblankSource::virtual_display : VblankSource::swap_return};
}

SessionTime VirtualRefresh::time_of(std::int64_t refresh) const noexcept {
    return SessionTime(SessionDuration(std::llround(static_cast<double>(refresh) * 1e9 / true_hz_)));
}

std::int64_t VirtualRefresh::first_after(SessionTime time) const noexcept {
    auto refresh = static_cast<std::int64_t>(std::floor(to_seconds(time) * true_hz_)) + 1;
    // Rounded to nanoseconds, a refresh may lie a hair to either side of the quotient.
    while (time_of(refresh - 1) > time)
        --refresh;
    while (time_of(refresh) <= time)
        ++refresh;
    return refresh;
}

void VirtualRefresh::presentation_begins(const Trial& lit, int show) noexcept {
    in_presentation_ = true;
    if (show > 0)
        return; // faults count from the attempt's first onset
    onset_ = -1;
    next_fault_ = 0;
    struck_.clear();
    if (faults_.is_clean())
        return;
    planned_ = faults_in(faults_, lit.index, refreshes_drawn);
    struck_.reserve(planned_.size());
}

/// What the faults of this kind at this refresh of the presentation add up to; faults of refreshes that have
/// gone by are left behind.
double VirtualRefresh::amount_ms(DisplayFault::Kind kind, std::int64_t refresh) noexcept {
    if (!in_presentation_ || faults_.is_clean())
        return 0.0;
    while (next_fault_ < planned_.size() && planned_[next_fault_].refresh < refresh)
        ++next_fault_;
    double amount = 0.0;
    for (std::size_t i = next_fault_; i < planned_.size() && planned_[i].refresh == refresh; ++i) {
        const DisplayFault& fault = planned_[i];
        if (fault.kind == kind) {
            amount += kind == DisplayFault::Kind::skip ? fault.refreshes : fault.amount_ms;
            struck_.push_back(fault);
        }
    }
    return amount;
}

void VirtualRefresh::stand_still(double milliseconds) noexcept {
    if (milliseconds > 0.0)
        clock_->wait_until(clock_->now() + from_seconds(1e-3 * milliseconds));
}

FlipReport VirtualRefresh::next(SessionTime requested) noexcept {
    using Kind = DisplayFault::Kind;
    const std::int64_t aimed_at = onset_ < 0 ? 0 : last_ + 1 - onset_;
    stand_still(amount_ms(Kind::late, aimed_at));
    FlipReport report;
    report.requested = requested;
    report.swapped = clock_->now();
    const std::int64_t refresh =
        first_after(report.swapped) + static_cast<std::int64_t>(amount_ms(Kind::skip, aimed_at));
    report.vertical_blank = time_of(refresh) + from_seconds(1e-3 * amount_ms(Kind::stamp, aimed_at));
    clock_->wait_until(time_of(refresh));
    last_ = refresh;
    if (in_presentation_ && onset_ < 0)
        onset_ = refresh;
    stamp(report);
    stand_still(amount_ms(Kind::stall, refresh + 1 - onset_));
    return report;
}

/// What the program gets to know of the refresh that was lit.
void VirtualRefresh::stamp(FlipReport& report) noexcept {
    if (faults_.jitter_sd_ms > 0.0) {
        double deviation = jitter_.normal();
        while (std::abs(deviation) > widest_jitter_sd)
            deviation = jitter_.normal();
        report.vertical_blank += from_seconds(1e-3 * faults_.jitter_sd_ms * deviation);
        report.uncertainty = from_seconds(1e-3 * faults_.jitter_sd_ms * widest_jitter_sd);
    }
    report.source = timing().source;
    report.refresh = {faults_.counts_refreshes ? last_ : count_.at(report.vertical_blank)};
}

} // namespace overt
