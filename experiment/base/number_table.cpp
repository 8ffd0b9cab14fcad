#include "experiment/base/number_table.h"

#include <algorithm>
#include <charconv>
#include <utility>

#include "experiment/base/error.h"

namespace overt {

std::vector<std::vector<double>> rows_of_table(std::string_view table, std::size_t columns) {
    std::vector<std::vector<double>> rows;
    bool is_header = true;
    while (!table.empty()) {
        std::string_view line = table.substr(0, table.find('\n'));
        table.remove_prefix(std::min(line.size() + 1, table.size()));
        if (line.empty() || line.front() == '#')
            continue;
        if (!std::exchange(is_header, false))
            rows.emplace_back();
        while (!rows.empty() && rows.back().size() < columns) {
            double value = 0.0;
            const auto parsed = std::from_chars(line.data(), line.data() + line.size(), value);
            OVERT_EXPECTS(parsed.ec == std::errc());
            rows.back().push_back(value);
            line.remove_prefix(std::min(static_cast<std::size_t>(parsed.ptr - line.data()) + 1, line.size()));
        }
    }
    return rows;
}

} // namespace overt
