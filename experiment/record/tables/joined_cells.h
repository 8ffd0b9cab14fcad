/// A sample that was joined with its frame and its surface, as cells of a row.
#pragma once

#include <string>
#include <vector>

#include "experiment/record/read/sample_join.h"
#include "experiment/record/tables/table_writer.h"

namespace overt {

// Decimals of what is written about gaze; the same in each kind of export.
inline constexpr int pixel_decimals = 3; // a thousandth of a pixel
inline constexpr int pupil_decimals = 4;
inline constexpr int angle_decimals = 6; // a millionth of a degree

/// Of the samples of one sculpture.
class JoinedCells {
  public:
    /// `header` must outlive this.
    JoinedCells(const SessionHeader& header, int sculpture, TableFormat format);

    /// As time_columns() has them.
    void time(TableWriter& row, const JoinedSample& joined) const;
    /// As place_columns() has them.
    void place(TableWriter& row, const JoinedSample& joined) const;

  private:
    const SessionHeader& header_;
    std::vector<PreparedCells> parts_; ///< by PartIndex
};

/// A frame's angle; n/a if the session knows no such pose.
void write_angle(TableWriter& row, const SessionHeader& header, PoseIndex pose);

} // namespace overt
