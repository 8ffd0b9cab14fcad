#include "app/record/export_formats.h"

namespace overt {

std::span<const ExportFormatEntry> export_formats() {
    static const ExportFormatEntry formats[] = {
        {{"tsv", "csv", "jsonl"}, "tables with a dictionary of their columns", false, table_format},
        {{"bids"}, "a BIDS dataset that all sessions join", true, bids_format},
        {{"asc"}, "as EyeLink's edf2asc writes recordings", false, asc_format},
    };
    return formats;
}

} // namespace overt
