/// A sample that was joined with its frame and its surface, as cells of a row.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiment/record/read/sample_join.h"
#include "experiment/record/tables/row_layout.h"

namespace overt {

// Decimals of what is written about gaze; the same in each kind of export.
inline constexpr int pixel_decimals = 3; // a thousandth of a pixel
inline constexpr int pupil_decimals = 4;
inline constexpr int angle_decimals = 6; // a millionth of a degree

struct JoinedRow {
    const GazeSample& sample;
    const JoinedSample& joined;
    std::span<const std::string> part_cells; ///< of the sample's object, by PartIndex: part_cells_of()
    std::string_view in_slot = {};           ///< where a table of all samples says so
};
using JoinedColumns = std::vector<RowLayout<JoinedRow>::Column>;

/// The names of an object's parts as cells, made once for many rows.
std::vector<std::string> part_cells_of(const SessionHeader& header, int object, TableFormat format);

/// The unit of lengths on and before the objects, and what has to be added to a column's meaning where not
/// all of them are known to be in millimetres; else empty.
struct LengthWords {
    std::string unit, remark;
};
LengthWords length_words(const SessionHeader& header);

/// By the session's clock, and how far that can be off.
JoinedColumns time_columns();
/// The frame that was lit, the place in the image and on the surface. `header` must outlive them.
JoinedColumns place_columns(const SessionHeader& header);

// Cells of a sample itself.
std::int64_t tracker_time_us(const JoinedRow& row);
std::optional<Fixed> gaze_x(const JoinedRow& row);
std::optional<Fixed> gaze_y(const JoinedRow& row);
std::optional<Fixed> pupil_size(const JoinedRow& row);

/// A frame's angle; nothing if the session knows no such pose.
std::optional<Fixed> angle_of(const SessionHeader& header, PoseIndex pose);

/// Which part of the figure something is on. `header` gives the levels.
TableColumn part_column(const SessionHeader& header);

/// A coordinate on a surface, with the decimals of all of them.
Fixed surface_coordinate(double value);

/// The parts of all objects, each name once.
std::vector<std::string> all_part_names(const SessionHeader& header);

} // namespace overt
