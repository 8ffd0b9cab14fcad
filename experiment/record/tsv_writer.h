/// Tables as tab-separated text, the same bytes on every machine, and fast.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiment/session_time.h"

namespace overt {

struct TsvColumn {
    std::string name;
    std::string meaning;
    std::string unit;                                        ///< empty: none
    std::vector<std::pair<std::string, std::string>> levels; ///< value and what it means; empty: any value
};

/// One file of an export, and what stands in it.
struct TsvTable {
    std::string file;
    std::string description;
    std::vector<TsvColumn> columns;
};

/// A text as a cell: tab, newline, carriage return and backslash become \t, \n, \r and \\; an empty one
/// becomes n/a.
std::string tsv_cell(std::string_view text);

/// Writes the rows of one table, cell by cell from left to right, in large pieces. Nothing depends on a
/// locale; lines end with a newline.
class TsvWriter {
  public:
    /// Makes the file and writes the line of column names. Throws RecordError.
    TsvWriter(const std::filesystem::path& directory, const TsvTable& table);
    ~TsvWriter();
    TsvWriter(const TsvWriter&) = delete;
    TsvWriter& operator=(const TsvWriter&) = delete;

    TsvWriter& text(std::string_view text);
    /// Cells that were made before: `cells` of them, with tabs between.
    TsvWriter& ready(std::string_view text, int cells = 1);
    TsvWriter& integer(std::int64_t number);
    /// With that many decimals (0 … 9), half away from zero; n/a if it is no finite number.
    TsvWriter& fixed(double number, int decimals);
    /// Seconds with nine decimals: each nanosecond is kept.
    TsvWriter& seconds(SessionDuration duration);
    TsvWriter& seconds(SessionTime time) { return seconds(time.time_since_epoch()); }
    TsvWriter& missing(int cells = 1);

    /// Each column must have got its cell. Throws RecordError.
    void end_row();

    std::int64_t rows() const { return rows_; }

    /// Brings the rest to the file. Throws RecordError.
    void close();

  private:
    void begin_cell();
    void write_buffer();

    std::filesystem::path file_;
    int descriptor_ = -1;
    std::string buffer_;
    int columns_;
    int cells_ = 0; ///< in the row so far
    std::int64_t rows_ = 0;
};

} // namespace overt
