#include "experiment/timing/lit_frames.h"

namespace overt {

LitFrames::LitFrames(const ScanOut& scan_out, std::size_t most_flips)
    : scan_out_(scan_out), refresh_ns_(1e9 / scan_out.refresh_hz),
      ring_(std::max<std::size_t>(most_flips, 1)) {}

void LitFrames::add(const FlipRecord& flip) noexcept {
    ring_[count_++ % ring_.size()] = {flip.report.vertical_blank, flip.pose};
}

std::optional<PoseIndex> LitFrames::pose_at(SessionTime time, double row_px) const noexcept {
    if (count_ == 0)
        return std::nullopt;
    const SessionTime blank = blank_lighting(scan_out_, refresh_ns_, time, row_px);
    const Lit& last = ring_[(count_ - 1) % ring_.size()];
    if (blank >= last.vertical_blank + from_seconds(1.0 / scan_out_.refresh_hz))
        return std::nullopt;
    // Gaze is some milliseconds old: what it fell on is among the last few.
    for (std::size_t back = 1; back <= std::min(count_, ring_.size()); ++back) {
        const Lit& lit = ring_[(count_ - back) % ring_.size()];
        if (lit.vertical_blank <= blank)
            return lit.pose;
    }
    return std::nullopt;
}

} // namespace overt
