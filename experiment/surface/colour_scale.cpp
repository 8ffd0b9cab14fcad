#include "experiment/surface/colour_scale.h"

#include <algorithm>
#include <charconv>

#include "colour_scale_tables.h"
#include "experiment/base/error.h"

namespace overt {
namespace {

ColourTable read_table(std::string_view csv) {
    ColourTable table{};
    csv.remove_prefix(csv.find('\n') + 1);
    const char* at = csv.data();
    for (auto& colour : table) {
        for (std::uint8_t& channel : colour) {
            const auto [end, failure] = std::from_chars(at, csv.data() + csv.size(), channel);
            OVERT_EXPECTS(failure == std::errc{});
            at = end + 1; // past the comma or the line's end
        }
    }
    return table;
}

} // namespace

const ColourTable& colour_table(ColourMap map) {
    static const ColourTable viridis = read_table(embedded::viridis_csv);
    static const ColourTable cividis = read_table(embedded::cividis_csv);
    static const ColourTable coolwarm = read_table(embedded::coolwarm_csv);
    return map == ColourMap::viridis ? viridis : map == ColourMap::cividis ? cividis : coolwarm;
}

std::string_view name_of(ColourMap map) {
    return map == ColourMap::viridis ? "viridis" : map == ColourMap::cividis ? "cividis" : "coolwarm";
}

} // namespace overt
