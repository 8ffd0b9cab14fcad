/// Which frame is lit on a row of the screen, told while a presentation runs.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include "experiment/flip_report.h"

namespace overt {

/// How light follows a vertical blank on one display.
struct ScanOut {
    SessionDuration latency{};  ///< from the vertical blank to the light of the first row
    double refresh_hz = 120.0;  ///< nominal
    double screen_rows = 1080.; ///< rows are lit one after another, evenly over one refresh
};

/// The vertical blank, latency included, whose scan-out reaches a row at a time. Rows above and below the
/// screen are taken as its first and last. `refresh_ns`: 1e9 / refresh_hz.
inline SessionTime blank_lighting(const ScanOut& scan_out, double refresh_ns, SessionTime time,
                                  double row_px) {
    const double row_share = std::clamp(row_px / scan_out.screen_rows, 0.0, 1.0);
    return time - scan_out.latency - SessionDuration(static_cast<std::int64_t>(row_share * refresh_ns + 0.5));
}

/// Row y of refresh r is lit from vertical_blank(r) + latency + y / screen_rows * one nominal refresh until
/// the same row of the next flip. Flips are entered as they come; says of a time up to the last of them what
/// FlipHistory says of it afterwards. One thread; add() and pose_at() allocate and throw nothing.
class LitFrames {
  public:
    /// `most_flips` are kept; further ones take the place of the oldest.
    LitFrames(const ScanOut& scan_out, std::size_t most_flips);

    void clear() noexcept { count_ = 0; }
    void add(const FlipRecord& flip) noexcept;

    /// Nothing before the first flip, and more than one nominal refresh after the last.
    std::optional<PoseIndex> pose_at(SessionTime time, double row_px) const noexcept;

  private:
    struct Lit {
        SessionTime vertical_blank;
        PoseIndex pose;
    };
    ScanOut scan_out_;
    double refresh_ns_;
    std::vector<Lit> ring_;
    std::size_t count_ = 0; ///< entered since clear()
};

} // namespace overt
